"""With the layer ``corrected`` the programs find the exact hull of two-digit integers.

``tests/modern/edition/test_known_faults.py`` tests the decks of single faults.

A larger run: ``HULL1620_SETS=5000 pytest tests/modern/thesis/test_corrected.py``.
"""

import os
import random
from itertools import product

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from emulator.errors import DeckError
from emulator.language.compiler import compile_deck
from emulator.machine.result import Options
from modern.edition import programs
from modern.thesis.job import HullRun
from tests.support.judged import Point, differences, faults, faulty_sets, run, run_all, sets

COUNT = int(os.environ.get("HULL1620_SETS", "240"))


def test_a_cube_is_right_in_sixty_orders_of_its_corners() -> None:
    """KNOWN-FAULTS 2 and 3: the listing finishes none of them."""
    corners: list[Point] = [(x, y, z) for x, y, z in product((0, 1), repeat=3)]
    orders = [(str(seed), random.Random(seed).sample(corners, 8)) for seed in range(60)]
    assert not faulty_sets(orders, "corrected")


def test_sets_of_two_digit_integers_are_right() -> None:
    assert not faulty_sets(sets(COUNT, 1963), "corrected")


@settings(deadline=None, max_examples=40)
@given(st.lists(st.tuples(*[st.integers(0, 2)] * 3), min_size=4, max_size=14, unique=True))
def test_any_points_of_a_3_3_3_grid_are_right(points: list[Point]) -> None:
    assert not faults(points, "corrected")


@settings(deadline=None, max_examples=30)
@given(st.lists(st.tuples(*[st.integers(-99, 99)] * 3), min_size=4, max_size=16, unique=True))
def test_any_points_of_two_digits_are_right(points: list[Point]) -> None:
    assert not faults(points, "corrected")


def test_if_the_listing_is_right_the_layer_changes_no_card() -> None:
    point_sets = [points for _, points in sets(60, 7)]
    listed = run_all(point_sets, options=Options(limit=300_000))
    corrected = run_all(point_sets, "corrected")
    same = 0
    for points, without, with_layer in zip(point_sets, listed, corrected, strict=True):
        assert isinstance(without, HullRun)
        assert isinstance(with_layer, HullRun)
        if not differences(points, without):
            assert with_layer.final.result.punched == without.final.result.punched
            same += 1
    assert same > 30


def test_layers_compile_and_the_larger_tables_need_a_core_of_60000() -> None:
    with pytest.raises(DeckError, match="OVERLAP"):
        run([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], "corrected", options=Options())
    for name in ("program1", "program2", "program3"):
        for included in product((False, True), repeat=3):
            layers = [layer for layer, on in zip(("epsilon", "translation", "corrected"), included, strict=True) if on]
            deck = programs.built(name, layers)
            compile_deck(deck)
            assert max(len(card.text.rstrip()) for card in deck.cards) <= 72


def test_the_comparison_detects_every_kind_of_difference() -> None:
    points: list[Point] = [(0, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 4), (1, 1, 1), (2, 2, 0)]
    hull_run = run(points, "corrected")
    assert not differences(points, hull_run)
    for k, replacement in ((4, (1, 1, 2)), (5, (2, 1, 0)), (3, (0, 0, 5)), (0, (-1, 0, 0))):
        changed = [*points[:k], replacement, *points[k + 1 :]]
        assert differences(changed, hull_run), replacement

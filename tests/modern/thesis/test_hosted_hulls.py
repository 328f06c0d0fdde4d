"""The hull programs over other numbers: the decks run in 1963's way, the examples, and the judge."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest

from emulator.language.cards import Deck, deck_from_lines, read_deck
from emulator.machine.divergence import diverge
from emulator.machine.endings import looped
from emulator.machine.result import LOOP_WINDOW, Result
from emulator.machine.session import Session
from emulator.numbers import numbers
from modern.comparison.difference import disagreement
from modern.comparison.outcome import Vector, from_cards, from_judge
from modern.edition import chapter6, programs
from modern.exact_hull import exact_hull
from modern.thesis.job import HullRun, Step, run_hull
from tests.support.deckwork import until
from tests.support.judged import OPTIONS, deck_of, differences, sets
from tests.support.paths import MACHINE_RUNS

RUNS = MACHINE_RUNS
FOLDERS = sorted(path for path in RUNS.iterdir() if path.is_dir())
DECIMAL = {"18_dec3_n6", "23_dec2_n15"}
"""Decks whose points are not whole."""


LIMIT = 60_000


def hull(deck: Deck, name: str = "", layers: tuple[str, ...] = (), uncut: bool = False, limit: int = LIMIT) -> HullRun:
    options = replace(OPTIONS, limit=limit, uncut=uncut, numbers=numbers(name or "truncating"))
    return run_hull(deck, lambda program: programs.with_layers(program, layers), options)


def deck_of_folder(folder: Path) -> Deck:
    return read_deck(str(folder / "deck.cards"))


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
@pytest.mark.parametrize("name", ["exact", "float64", "mp:120"])
def test_the_decks_of_whole_numbers(folder: Path, name: str) -> None:
    """On whole coordinates of two digits eight decimal digits decide as exact numbers do: same points, planes, end."""
    if folder.name in DECIMAL:
        pytest.skip("not whole")
    plain = hull(deck_of_folder(folder))
    endless = plain.final.result.ending.kind == "limit"
    other = hull(deck_of_folder(folder), name, limit=LIMIT if endless else 100 * LIMIT)
    results = [step.result for step in other.steps]
    if endless:
        results[-1] = after_statements(other.final, name, LIMIT)
    assert [result.counts for result in results] == [step.result.counts for step in plain.steps]
    assert [result.ending for result in results] == [step.result.ending for step in plain.steps]
    if name == "exact":
        assert [result.punched for result in results] == [step.result.punched for step in plain.steps]


def after_statements(step: Step, name: str, statements: int) -> Result:
    """What a step has done after so many statements, with the ending of a run whose limit that is.

    A limit of work would stop it elsewhere: what costs more than a statement of eight digits counts for more.
    """
    session = Session(step.program, step.deck, replace(OPTIONS, limit=100 * statements, numbers=numbers(name)))
    assert until(session, statements - LOOP_WINDOW) is None
    before = list(session.state.counts)
    assert until(session, statements) is None
    return session.result(looped(step.program, statements, before, session.state.counts, session.state.decision))


@pytest.mark.parametrize("example", chapter6.EXAMPLES)
def test_the_examples_exactly(example: int) -> None:
    """Exact numbers give the thesis's six examples as the exact judge has them."""
    deck = chapter6.input_deck(example)
    points = [
        (Fraction(card.columns(1, 14)), Fraction(card.columns(15, 28)), Fraction(card.columns(29, 42)))
        for card in deck.cards[1:]
    ]
    run = hull(deck, "exact")
    assert run.complete
    given: list[Vector] = [tuple(point) for point in points]
    judge = from_judge(exact_hull(points), given)
    found = disagreement(from_cards("exact", run, given), judge, given)
    assert found.agrees or judge.dimension < 2
    assert not found.missed
    assert not found.added


def test_whole_points_exactly_and_corrected() -> None:
    """Exact numbers and the layer ``corrected``: what the judge says, on sets of every family."""
    for name, points in sets(60, 7):
        if len(points) > 17:
            continue
        run = run_hull(
            deck_of(points),
            lambda program: programs.with_layers(program, ("corrected",)),
            replace(OPTIONS, numbers=numbers("exact"), limit=1_000_000),
        )
        assert differences(points, run) == [], name


def decimals(seed: int) -> list[tuple[str, ...]]:
    """Points with up to seven decimals: coefficients have more digits than a card holds."""
    r = random.Random(seed)
    places = r.choice((1, 3, 5, 7))
    return [
        tuple(f"{r.randint(-(10**places), 10**places) / 10**places:.{places}f}" for _ in range(3))
        for _ in range(r.choice((4, 6, 9)))
    ]


def test_decimals_exactly_and_uncut() -> None:
    """With numbers uncut between the programs exact runs are right; through the cards most are refused."""
    refused = 0
    for seed in range(40):
        points = decimals(seed)
        deck, given = deck_of(points), [tuple(Fraction(x) for x in p) for p in points]
        run = hull(deck, "exact", ("corrected",), uncut=True)
        assert run.complete, seed
        judge = from_judge(exact_hull(points), given)
        outcome = from_cards("exact", run, given)
        assert (outcome.vertices, outcome.inside) == (judge.vertices, judge.inside), seed
        refused += not hull(deck, "exact", ("corrected",)).complete
    assert refused > 10


def test_where_eight_digits_decide_otherwise() -> None:
    """Program 3 on the cards of a deck of decimals: a plane's own point is not on it, and exactly it is."""
    points = [("0", "0", "0"), ("1", "0", "0"), ("0", "1", "0"), ("0.1234567", "0.7654321", "1.3333333")]
    points += [("0.1010101", "0.3333333", "-1.7777777"), ("0.9999999", "0.8888888", "0.0123456")]
    deck = deck_of(points)
    middle = deck_from_lines("middle", hull(deck).steps[0].result.punched)
    found = diverge(programs.program("program3"), middle, numbers("truncating"), numbers("exact"))
    assert found.first_value is not None
    assert found.first_value.line.place.card < 60
    assert found.digits == 8
    assert any(loss.worst > 3 for loss in found.losses)


def test_program_2_decides_its_roots_exactly() -> None:
    """AL+CL-BL of points in line is zero exactly, whatever the lengths, and eight digits miss some of the zeros.

    The last of the points with the least x is taken for a vertex first, though it lies between two others.
    """
    r = random.Random(5)
    missed = 0
    for _ in range(80):
        x, low, high, t = r.randint(-9, 0), r.randint(-20, 0), r.randint(1, 20), r.randint(1, 7)
        between = Fraction(low * (8 - t) + high * t, 8)
        corners = [(x, low), (x + r.randint(1, 9), r.randint(-9, 9)), (x, high), (x, float(between))]
        points = [(str(u), str(v), "1") for u, v in corners]
        run = hull(deck_of(points), "exact")
        assert run.final.name == "program2"
        given = [tuple(Fraction(x) for x in p) for p in points]
        judge = from_judge(exact_hull(points), given)
        outcome = from_cards("exact", run, given)
        assert (outcome.vertices, outcome.boundary) == (judge.vertices, judge.boundary), points
        middle = deck_from_lines("middle", run.steps[0].result.punched)
        for name in ("truncating", "float64"):
            found = diverge(programs.program("program2"), middle, numbers(name), numbers("exact"), values=False)
            assert found.apart == ""
            if name == "truncating" and found.first_decision is not None:
                missed += 1
                assert "AL" in found.first_decision.line.text
                assert found.first_decision.values[1] == "0"
    assert missed

"""The procedure that finds its first visible face without a search, compared with one that tests every face."""

from __future__ import annotations

import random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from modern.digital.solids import Volume, ball, half_ball
from modern.papers.kovalevsky_schulz import INVISIBLE, VERTICES, VISIBLE, Coplanar, Flat, convex_polyhedron
from modern.papers.kovalevsky_schulz.corners import local_corners
from tests.support.every_face import by_search

COPLANAR = st.sampled_from([VISIBLE, INVISIBLE])
GRID = [(x, y, z) for z in range(4) for y in range(4) for x in range(4)]
POINTS = st.lists(st.tuples(*[st.integers(-3, 3)] * 3), min_size=1, max_size=60)
SOLIDS = [
    ball(20),
    ball(17, "vertex"),
    half_ball(22),
    Volume(np.ones((5, 4, 3), dtype=np.bool_), (0, 0, 0), "box"),
    Volume(np.indices((7, 7, 7)).sum(axis=0) == 9, (-2, 0, 5), "slanted layer"),
]


def agree(points: object, coplanar: Coplanar) -> bool:
    actual, expected = convex_polyhedron(points, coplanar), by_search(points, coplanar)  # type: ignore[arg-type]
    return expected is None if isinstance(actual, Flat) else actual == expected


@settings(max_examples=50)
@given(POINTS, COPLANAR)
def test_points_in_any_order_have_the_cell_list_of_the_full_search(
    points: list[tuple[int, int, int]], coplanar: Coplanar
) -> None:
    assert agree(points, coplanar)


@settings(max_examples=50)
@given(POINTS, COPLANAR)
def test_points_in_raster_order_have_the_cell_list_of_the_full_search(
    points: list[tuple[int, int, int]], coplanar: Coplanar
) -> None:
    assert agree(sorted(set(points), key=lambda p: p[::-1]), coplanar)


@pytest.mark.parametrize("coplanar", [VISIBLE, INVISIBLE])
def test_subsets_of_a_grid_have_the_cell_list_of_the_full_search(coplanar: Coplanar) -> None:
    source = random.Random(5)
    for _ in range(15):
        points = source.sample(GRID, source.randint(20, 64))
        assert agree(points, coplanar)
        assert agree(sorted(points, key=lambda p: p[::-1]), coplanar)


@pytest.mark.parametrize("coplanar", [VISIBLE, INVISIBLE])
@pytest.mark.parametrize("solid", SOLIDS, ids=lambda v: v.source)
def test_named_solids_have_the_cell_list_of_the_full_search(solid: Volume, coplanar: Coplanar) -> None:
    points = local_corners(solid, VERTICES, 6)
    assert agree(points, coplanar)
    assert agree(np.random.default_rng(6).permutation(points), coplanar)


def test_another_order_gives_another_cell_list() -> None:
    assert by_search(GRID, VISIBLE) != convex_polyhedron(GRID[::-1], VISIBLE)

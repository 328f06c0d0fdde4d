"""The procedure that finds its first face without a search, against the one that tries every face."""

from __future__ import annotations

import random

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from modern.digital.solids import Volume, ball, half_ball
from modern.papers.kovalevsky_schulz import INVISIBLE, VERTICES, VISIBLE, Coplanar, Flat, convex_polyhedron
from modern.papers.kovalevsky_schulz.corners import local_corners
from tests.support.every_face import by_search

COPLANAR = st.sampled_from([VISIBLE, INVISIBLE])
GRID = [(x, y, z) for z in range(4) for y in range(4) for x in range(4)]
POINTS = st.lists(st.tuples(*[st.integers(-3, 3)] * 3), min_size=1, max_size=60)
SOLIDS = [
    ball(32),
    ball(17, "vertex"),
    half_ball(22),
    Volume(np.ones((5, 4, 3), dtype=np.bool_), (0, 0, 0), "box"),
    Volume(np.indices((7, 7, 7)).sum(axis=0) == 9, (-2, 0, 5), "slanted layer"),
]


def agree(points: object, coplanar: Coplanar) -> bool:
    found, searched = convex_polyhedron(points, coplanar), by_search(points, coplanar)  # type: ignore[arg-type]
    return searched is None if isinstance(found, Flat) else found == searched


@given(POINTS, COPLANAR)
def test_points_in_any_order_make_the_cell_list_of_the_search(
    points: list[tuple[int, int, int]], coplanar: Coplanar
) -> None:
    assert agree(points, coplanar)


@given(POINTS, COPLANAR)
def test_points_in_raster_order_do_too(points: list[tuple[int, int, int]], coplanar: Coplanar) -> None:
    assert agree(sorted(set(points), key=lambda p: p[::-1]), coplanar)


@pytest.mark.parametrize("coplanar", [VISIBLE, INVISIBLE])
def test_a_grid_with_all_its_lines_and_planes(coplanar: Coplanar) -> None:
    draw = random.Random(5)
    for _ in range(30):
        points = draw.sample(GRID, draw.randint(20, 64))
        assert agree(points, coplanar)
        assert agree(sorted(points, key=lambda p: p[::-1]), coplanar)


@pytest.mark.parametrize("coplanar", [VISIBLE, INVISIBLE])
@pytest.mark.parametrize("solid", SOLIDS, ids=lambda v: v.source)
def test_named_solids(solid: Volume, coplanar: Coplanar) -> None:
    for neighbours in (6, 26):
        points = local_corners(solid, VERTICES, neighbours)
        assert agree(points, coplanar)
        assert agree(np.random.default_rng(neighbours).permutation(points), coplanar)


def test_the_comparison_can_fail() -> None:
    """Another order makes other triangles of the grid, and other numbers."""
    assert by_search(GRID, VISIBLE) != convex_polyhedron(GRID[::-1], VISIBLE)

"""Digital convexity (3.2.1 to 3.2.3), half-cell expansion and convex deficiency."""

import random
from itertools import product

import numpy as np
import pytest

from modern.papers.yau_srihari import convexity, octree_hull
from modern.papers.yau_srihari.hull import components
from tests.support.digital_judge import random_solid, solid_of

RING = [
    *[(2, y, 0) for y in range(3)],
    *[(x, 2, 0) for x in range(2)],
    *[(0, 2, z) for z in (1, 2)],
    *[(0, y, 2) for y in (0, 1)],
    *[(x, 0, 2) for x in (1, 2)],
    (2, 0, 1),
]
"""Twelve voxels along six edges of a cube, around its diagonal."""


def solids(count: int, side: int) -> list[np.ndarray]:
    return [random_solid(random.Random(seed), side) for seed in range(count)]


def test_the_half_cell_expansion_has_eight_cells_per_voxel() -> None:
    assert convexity.half_cell_expansion(solid_of([(0, 0, 0)])).all()
    for array in solids(10, 4):
        expected = {
            tuple(a + b for a, b in zip(v, s, strict=True))
            for v in convexity.voxels_of(array)
            for s in product((0, 1), repeat=3)
        }
        assert set(convexity.voxels_of(convexity.half_cell_expansion(array))) == expected


def test_gaps_make_solids_neither_simple_nor_midpoint_convex() -> None:
    assert convexity.is_simple(solid_of([(0, 0, 0), (1, 0, 0), (1, 1, 0)]))
    assert not convexity.is_simple(solid_of([(0, 0, 0), (2, 0, 0), (0, 1, 0), (1, 1, 0), (2, 1, 0)]))
    assert not convexity.is_simple(solid_of([(0, 0, 0), (1, 1, 0)]))
    assert convexity.is_simple(solid_of(RING))
    assert convexity.is_midpoint_convex(solid_of([(0, 0, 0), (1, 1, 1)]))
    assert not convexity.is_midpoint_convex(solid_of([(0, 0, 0), (2, 0, 0)]))


@pytest.mark.parametrize(
    ("x", "y", "cells"), [((0, 0, 0), (2, 2, 2), 1), ((0, 0, 0), (1, 2, 2), 2), ((0, 0, 0), (1, 1, 1), 8)]
)
def test_a_midpoint_cover_doubles_for_each_odd_sum(x, y, cells) -> None:
    assert len(convexity.midpoint_cover(x, y)) == cells


def test_hulls_are_digitally_convex_except_of_some_paths() -> None:
    for array in solids(30, 5):
        hull = octree_hull(array).filled
        assert convexity.is_simple(hull)
        assert convexity.is_digitally_convex(hull)
    path = solid_of([(0, 0, 0), (1, 0, 0), (2, 0, 0), (0, 1, 0), (0, 1, 1), (0, 1, 2)])
    assert convexity.is_simple(path)
    assert np.array_equal(octree_hull(path).filled, path)
    assert not convexity.is_digitally_convex(path)


def test_the_hull_of_a_connected_solid_need_not_be_connected() -> None:
    """The midpoint of the ends of these stairs is a voxel of the hull that shares no face with another one."""
    steps = [(0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 2, 0), (2, 2, 0), (3, 2, 0), (3, 2, 1), (4, 2, 1), (4, 2, 2)]
    stairs = solid_of(steps)
    assert components(stairs) == 1
    filled = octree_hull(stairs).filled
    assert {*convexity.voxels_of(filled)} - {*steps} == {(2, 1, 1)}
    assert components(filled) == 2


def test_bends_and_deficiencies_are_not_convex() -> None:
    bend = solid_of([*((x, 0, 0) for x in range(4)), *((0, y, 0) for y in range(1, 4))])
    assert convexity.is_simple(bend)
    assert not convexity.is_digitally_convex(bend)
    assert not convexity.is_digitally_convex(solid_of(RING))
    assert convexity.is_digitally_convex(np.ones((2, 3, 2), dtype=np.bool_))
    assert convexity.is_digitally_convex(solid_of([(0, 0, 0), (1, 0, 0), (1, 1, 0)]))
    for array in solids(10, 5):
        missing = convexity.convex_deficiency(array)
        assert np.array_equal(octree_hull(array).filled & ~missing, array)
        assert not (missing & array).any()

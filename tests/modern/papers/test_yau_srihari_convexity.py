"""Digital convexity (3.2.1 to 3.2.3), half-cell expansion and convex deficiency."""

from __future__ import annotations

import random
from itertools import product

import numpy as np
import pytest

from modern.digital.intervals import lower_chain
from modern.papers.yau_srihari import octree_hull
from modern.papers.yau_srihari.convexity import (
    convex_deficiency,
    half_cell_expansion,
    is_digitally_convex,
    is_image_of_hull,
    is_midpoint_convex,
    is_simple,
    midpoint_cover,
    voxels_of,
)
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
"""Along six edges of a cube, around its diagonal."""


def solids(count: int, side: int) -> list[np.ndarray]:
    return [random_solid(random.Random(seed), side) for seed in range(count)]


def test_half_cell_expansion_has_eight_cells_of_a_voxel() -> None:
    assert half_cell_expansion(solid_of([(0, 0, 0)])).all()
    for array in solids(10, 4):
        expected = {
            tuple(a + b for a, b in zip(v, s, strict=True)) for v in voxels_of(array) for s in product((0, 1), repeat=3)
        }
        assert set(voxels_of(half_cell_expansion(array))) == expected


def test_simple_solids() -> None:
    assert is_simple(solid_of([(0, 0, 0), (1, 0, 0), (1, 1, 0)]))
    assert not is_simple(solid_of([(0, 0, 0), (2, 0, 0), (0, 1, 0), (1, 1, 0), (2, 1, 0)]))
    assert not is_simple(solid_of([(0, 0, 0), (1, 1, 0)]))
    assert is_simple(solid_of(RING))


@pytest.mark.parametrize(
    ("x", "y", "cells"), [((0, 0, 0), (2, 2, 2), 1), ((0, 0, 0), (1, 2, 2), 2), ((0, 0, 0), (1, 1, 1), 8)]
)
def test_a_midpoint_cover_has_two_cells_for_each_odd_sum(
    x: tuple[int, int, int], y: tuple[int, int, int], cells: int
) -> None:
    assert len(midpoint_cover(x, y)) == cells


def test_a_straight_gap_is_not_midpoint_convex() -> None:
    assert is_midpoint_convex(solid_of([(0, 0, 0), (1, 1, 1)]))
    assert not is_midpoint_convex(solid_of([(0, 0, 0), (2, 0, 0)]))


def test_the_kim_rosenfeld_test_on_small_solids() -> None:
    """Digital points of the hulls of these connected solids pass; a solid that is not its own hull does not."""
    passed = refused = 0
    for array in solids(40, 5):
        hull = octree_hull(array).filled
        assert is_simple(hull)
        assert is_digitally_convex(hull)
        passed += 1
        if (hull & ~array).any() and is_simple(array):
            refused += not is_digitally_convex(array)
    assert passed == 40


def test_digital_points_of_the_hull_of_a_connected_solid_need_not_be_convex() -> None:
    """A path of six voxels; and of solids at random a few."""
    path = solid_of([(0, 0, 0), (1, 0, 0), (2, 0, 0), (0, 1, 0), (0, 1, 1), (0, 1, 2)])
    assert is_simple(path)
    assert np.array_equal(octree_hull(path).filled, path)
    assert not is_digitally_convex(path)
    refused = sum(not is_digitally_convex(octree_hull(array).filled) for array in solids(100, 6))
    assert 0 < refused < 10


def test_digital_points_of_the_hull_of_a_connected_solid_need_not_be_connected() -> None:
    """Stairs of nine voxels: the middle of the ends is a voxel of the hull and touches no other by a face."""
    steps = [(0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 2, 0), (2, 2, 0), (3, 2, 0), (3, 2, 1), (4, 2, 1), (4, 2, 2)]
    stairs = solid_of(steps)
    assert components(stairs) == 1
    filled = octree_hull(stairs).filled
    assert {*voxels_of(filled)} - {*steps} == {(2, 1, 1)}
    assert components(filled) == 2


def test_a_bend_and_a_ring_are_not_convex() -> None:
    bend = solid_of([*((x, 0, 0) for x in range(4)), *((0, y, 0) for y in range(1, 4))])
    assert is_simple(bend)
    assert not is_digitally_convex(bend)
    assert not is_digitally_convex(solid_of(RING))
    assert is_digitally_convex(np.ones((2, 3, 2), dtype=np.bool_))
    assert is_digitally_convex(solid_of([(0, 0, 0), (1, 0, 0), (1, 1, 0)]))


def test_a_hull_that_meets_no_other_voxel_is_a_preimage() -> None:
    assert is_image_of_hull(np.ones((2, 2, 2), dtype=np.bool_))
    assert is_image_of_hull(solid_of([(0, 0, 0), (1, 0, 0), (2, 0, 0)]))
    assert not is_image_of_hull(solid_of([(0, 0, 0), (2, 1, 0)]))


def test_the_solid_is_its_hull_less_its_deficiency() -> None:
    for array in solids(20, 5):
        missing = convex_deficiency(array)
        assert np.array_equal(octree_hull(array).filled & ~missing, array)
        assert not (missing & array).any()


def test_a_chain_of_sorted_points_takes_linear_time() -> None:
    """Each point is put on the chain once and taken off once at most: comparisons are below two a point."""
    looked = 0

    class Counted(int):
        def __mul__(self, other: object) -> int:  # type: ignore[override]
            nonlocal looked
            looked += 1
            return int(self) * int(other)  # type: ignore[call-overload, no-any-return]

    draw = random.Random(1)
    products = []
    for count in (100, 400):
        looked = 0
        lower_chain([(Counted(k), Counted(draw.randint(0, 99))) for k in range(count)])
        products.append(looked)
    assert products[1] <= 6 * products[0] or products == [0, 0]

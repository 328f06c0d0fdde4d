"""Yau and Srihari: Theorem 1 and its consequence on random solids, and a case for each correction."""

import math
import random
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from modern.digital.intervals import lower_chain
from modern.digital.solids import VolumeError
from modern.exact_hull import exact_hull
from modern.papers.yau_srihari import OctreeHull, Printed, octree_hull
from modern.papers.yau_srihari.envelope import Envelope
from modern.papers.yau_srihari.hull import components
from modern.papers.yau_srihari.printed import LITERAL, NAMES
from tests.support.digital_judge import judged, random_solid, solid_of

SEEDS = st.integers(0, 10**9)
FEW = settings(max_examples=40)


def solid(seed: int, side: int = 8) -> Any:
    return random_solid(random.Random(seed), side)


def plane_of(normal: tuple[int, ...], point: tuple[int, ...]) -> tuple[int, ...]:
    divisor = math.gcd(*normal)
    a, b, c = (number // divisor for number in normal)
    return a, b, c, -(a * point[0] + b * point[1] + c * point[2])


def planes(envelope: Envelope, sign: int) -> dict[tuple[int, ...], set[tuple[int, int, int]]]:
    """Return the outward planes of an envelope's faces with their vertices. ``sign`` is -1 for the ceiling."""
    result = {}
    for face in envelope.faces:
        vertices = [(x, y, sign * z) for x, y, z in face.vertices]
        a, b, c = face.normal
        result[plane_of((a, b, sign * c), vertices[0])] = set(vertices)
    return result


@FEW
@given(SEEDS)
def test_theorem_1_the_envelopes_are_the_two_sides_of_the_euclidean_hull(seed: int) -> None:
    array = solid(seed)
    hull = octree_hull(array)
    judge = exact_hull(np.argwhere(array))
    if judge.dimension == 3:
        for envelope, sign in ((hull.lower, 1), (hull.upper, -1)):
            expected = {
                facet.plane: {judge.scaled[k] for k in facet.polygon}
                for facet in judge.facets
                if sign * facet.plane[2] < 0
            }
            assert planes(envelope, sign) == expected
            assert len(envelope.faces) == len(expected)


@FEW
@given(SEEDS)
def test_consequence_the_digital_hull_is_the_digital_points_of_the_euclidean_hull(seed: int) -> None:
    hull = octree_hull(solid(seed, 9))
    assert np.array_equal(hull.filled, judged(solid(seed, 9))[1])
    assert hull.components == components(hull.filled) == 1
    assert not hull.faults


@FEW
@given(arrays.arrays(np.bool_, arrays.array_shapes(min_dims=2, max_dims=3, max_side=6)))
def test_the_result_for_any_volume_is_the_digital_points_of_the_hull(array: np.ndarray) -> None:
    if array.any():
        assert np.array_equal(octree_hull(array).filled, judged(array)[1])


CASES = {
    "angle": [(0, 1, 0), (1, 0, 0), (1, 1, 0), (2, 0, 0), (2, 0, 1), (2, 1, 1), (2, 2, 1)],
    "start": [(0, 0, 1), (0, 1, 0), (0, 1, 1), (0, 2, 1), (1, 1, 1)],
    "triangles": [
        *[(0, 1, 2), (1, 0, 2), (1, 1, 1), (1, 1, 2), (1, 2, 1), (2, 2, 0), (2, 2, 1), (3, 0, 0)],
        *[(3, 1, 0), (3, 1, 2), (3, 2, 1), (3, 2, 2), (4, 0, 1), (4, 1, 0), (4, 1, 1), (4, 1, 2)],
    ],
    "truncation": [(0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 2, 1), (1, 0, 0)],
    "bound": [(0, 1, 0), (0, 2, 0), (1, 0, 1), (1, 1, 0), (1, 1, 1), (2, 0, 1), (2, 1, 0)],
    "corners": [(0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 2, 1), (0, 2, 2), (1, 2, 2)],
    "marks": [(0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 1, 1), (1, 2, 0), (2, 1, 0)],
}
"""For each statement a 6-connected solid whose hull is wrong if only that statement is applied as printed."""


def difference(hull: OctreeHull, array: Any) -> int:
    """Return the number of surplus voxels, or minus the number of missing ones. No case has both."""
    expected = judged(array)[1]
    missing, surplus = np.count_nonzero(expected & ~hull.filled), np.count_nonzero(hull.filled & ~expected)
    assert not (missing and surplus)
    return int(surplus) - int(missing)


@pytest.mark.parametrize("name", NAMES)
def test_every_correction_is_needed(name: str) -> None:
    array = solid_of(CASES[name])
    corrected, printed = octree_hull(array), octree_hull(array, Printed.only(name))
    assert corrected.components == 1
    assert difference(corrected, array) == 0
    assert difference(printed, array) != 0
    assert (difference(printed, array) > 0) == (name == "truncation")


@FEW
@given(SEEDS)
def test_the_reduced_set_contains_every_vertex(seed: int) -> None:
    array = solid(seed)
    hull = octree_hull(array)
    judge = exact_hull(np.argwhere(array))
    for envelope, sign in ((hull.lower, 1), (hull.upper, -1)):
        facets = [facet for facet in judge.facets if sign * facet.plane[2] < 0 and judge.dimension == 3]
        vertices = {judge.scaled[k] for facet in facets for k in facet.polygon}
        assert {(x, y, sign * z) for x, y, z in vertices} <= set(envelope.reduced)
        assert {point[:2] for point in envelope.reduced} <= set(hull.floor)
        for axis in (0, 1):
            for at in range(hull.side):
                on_line = sorted((point[1 - axis], point[2]) for point in envelope.reduced if point[axis] == at)
                assert lower_chain(on_line) == on_line


@FEW
@given(SEEDS)
def test_every_queued_edge_is_taken_or_removed_exactly_once(seed: int) -> None:
    steps = octree_hull(solid(seed)).lower.steps
    entered = [edge for step in steps for edge in step.entered]
    finished = [edge for step in steps for edge in (step.edge, *step.removed)]
    assert len(finished) == len(set(finished))
    assert set(entered) <= set(finished)
    assert not steps or steps[-1].waiting == 0


@pytest.mark.parametrize(
    ("voxels", "faces", "chain"),
    [
        ([(0, 0, 0)], 0, 1),
        ([(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0)], 0, 2),
        ([(0, 0, 0), (0, 0, 1), (0, 0, 2)], 0, 1),
        ([(0, 0, 0), (0, 1, 0), (0, 1, 1), (0, 1, 2), (0, 2, 2)], 0, 3),  # an upright layer
        ([(0, 0, 0), (1, 0, 0), (1, 1, 0), (2, 1, 0), (2, 2, 0)], 1, 0),  # a layer
        ([(0, 0, 0), (2, 4, 1)], 0, 2),  # not connected, a slanting line
    ],
)
def test_flat_solids_have_hulls(voxels: list[tuple[int, int, int]], faces: int, chain: int) -> None:
    array = solid_of(voxels)
    hull = octree_hull(array)
    assert np.array_equal(hull.filled, judged(array)[1])
    assert (len(hull.lower.faces), len(hull.lower.chain)) == (faces, chain)


def test_components_are_counted_and_large_cubes_rejected() -> None:
    array = solid_of([(0, 0, 0), (1, 1, 0), (5, 5, 5)])
    hull = octree_hull(array)
    assert hull.components == 3
    assert (hull.solid_voxels, hull.voxels) == (3, judged(array)[1].sum())
    with pytest.raises(VolumeError, match="the octree's cube of side 2048 has more than 2147483648 voxels"):
        octree_hull(np.ones((1025, 1, 1), dtype=np.bool_))


@given(arrays.arrays(np.bool_, arrays.array_shapes(min_dims=2, max_dims=3, max_side=5)))
def test_components_agree_with_a_flood_fill(array: np.ndarray) -> None:
    remaining = set(map(tuple, np.argwhere(array).tolist()))
    count = 0
    while remaining:
        count += 1
        reached = [remaining.pop()]
        for voxel in reached:
            for axis in range(array.ndim):
                for step in (-1, 1):
                    neighbour = (*voxel[:axis], voxel[axis] + step, *voxel[axis + 1 :])
                    if neighbour in remaining:
                        remaining.remove(neighbour)
                        reached.append(neighbour)
    assert components(array) == count


@pytest.mark.parametrize("array", [np.zeros((3, 3, 3), dtype=np.bool_), np.ones((2, 2, 2)), np.ones(4, dtype=np.bool_)])
def test_arrays_that_are_not_solids_are_rejected(array: np.ndarray) -> None:
    with pytest.raises(VolumeError, match=r"no voxels|expected an array of truth values"):
        octree_hull(array)


def test_printed_selects_statements_by_name() -> None:
    assert tuple(CASES) == NAMES
    assert Printed.only("angle", "marks").names() == ("angle", "marks")
    assert LITERAL.names() == NAMES
    assert Printed().names() == ()
    with pytest.raises(ValueError, match="not one of the names angle"):
        Printed.only("corner")

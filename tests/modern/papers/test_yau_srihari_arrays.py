"""Yau and Srihari's trees in arrays, and faces compared with the search step by step."""

import random
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from modern.digital.hull import digital_hull
from modern.papers.yau_srihari import OctreeHull, Printed, octree_hull, search
from modern.papers.yau_srihari import octree as trees
from modern.papers.yau_srihari.envelope import Envelope, _leaves, reduced_tree
from modern.papers.yau_srihari.octree import Octree, octree
from modern.papers.yau_srihari.quadtree import Quadtree, mirrored, written
from modern.papers.yau_srihari.search import Candidates, Search

FEW = settings(max_examples=40)
SIDES = st.sampled_from([1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17])


@st.composite
def solids(draw: st.DrawFn) -> Any:
    """Draw voxels in a box of any sides: none, blocks that may reach the box's ends, and scattered ones."""
    array = np.zeros(draw(st.tuples(SIDES, SIDES, SIDES)), dtype=np.bool_)
    for _ in range(draw(st.integers(0, 4))):
        block = []
        for length in array.shape:
            first, last = sorted(draw(st.tuples(*[st.integers(0, length - 1)] * 2)))
            block.append(slice(first, last + 1))
        array[tuple(block)] = draw(st.booleans()) or draw(st.booleans())
    source = np.random.default_rng(draw(st.integers(0, 2**32)))
    share = draw(st.sampled_from([0, 0, 0.02, 0.5]))
    return array ^ (source.random(array.shape) < share)


def test_trees_are_equal_if_side_and_leaves_are() -> None:
    single = octree(np.ones((1, 1, 1), dtype=np.bool_))
    full = octree(np.ones((4, 4, 4), dtype=np.bool_))
    assert single != full
    assert full == Octree(4, np.zeros(1, dtype=np.int64), np.zeros(1, dtype=np.int64))
    assert full != octree(np.ones((4, 4, 3), dtype=np.bool_))
    assert full != "full"


@FEW
@given(solids(), solids())
def test_an_intersection_agrees_with_that_of_the_arrays(first: Any, second: Any) -> None:
    a, b = (np.zeros((16, 16, 16), dtype=np.bool_) for _ in range(2))
    for cube, array in ((a, first), (b, second)):
        clipped = array[:16, :16, :16]
        cube[tuple(map(slice, clipped.shape))] = clipped
    assert trees.intersection(octree(a), octree(b)) == octree(a & b)


def by_steps(envelope: Envelope, tree: Quadtree) -> Quadtree:
    """Return the tree after the heights of every step's face are entered in turn."""
    for step in envelope.steps:
        assert step.face is not None
        tree = written(tree, _leaves(step.face, Printed()))
    return tree


def check(hull: OctreeHull) -> None:
    """Assert that faces and heights are those of the search of the tree, in its order."""
    for envelope, ends in ((hull.lower, hull.lowest), (hull.upper, mirrored(hull.highest))):
        assert tuple(step.face for step in envelope.steps) == envelope.faces
        if not envelope.chain:
            expected = by_steps(envelope, reduced_tree(ends))
            assert np.array_equal(envelope.tree.there, expected.there)
            assert np.array_equal(envelope.tree.values, expected.values)
            assert np.array_equal(envelope.tree.marked, expected.marked)


@FEW
@given(solids())
def test_candidates_find_the_same_faces_as_the_search(array: Any) -> None:
    if array.any():
        hull = octree_hull(array)
        check(hull)
        assert np.array_equal(digital_hull(array).filled, hull.filled)
        assert hull.hull == octree(hull.filled)
        assert hull.columns == len(hull.floor) == len(hull.ceiling) == np.count_nonzero(array.any(axis=2))


@pytest.mark.parametrize("length", [1, 2, 31, 32, 33])
def test_a_single_voxel_at_the_end_of_a_box_is_its_own_hull(length: int) -> None:
    for place in ((0, 0, 0), (length - 1, 0, length - 1), (length - 1,) * 3):
        array = np.zeros((length,) * 3, dtype=np.bool_)
        array[place] = True
        hull = octree_hull(array)
        assert hull.solid == hull.hull
        assert hull.hull.corners().tolist() == [[*place]]
        assert (hull.voxels, hull.floor) == (1, {place[:2]: place[2]})


def scored(points: list[tuple[int, int, int]]) -> tuple[list[Any], set[Any]]:
    """Return the points of the face next to the upright face over the first two, by Candidates and by scores."""
    start, end, *rest = points
    normal = search.normal_of(start, end, (*start[:2], start[2] + 1))
    fractions = Search(end, start, normal, Printed())
    for point in rest:
        if fractions.beyond(*point[:2]):
            fractions.take(point)
    return Candidates(points).face_on(end, start), {*fractions.points}


FAR = st.tuples(*[st.integers(0, 1023)] * 3)


@given(st.lists(FAR, min_size=3, max_size=30, unique_by=lambda point: point[:2]))
def test_candidates_find_the_best_of_distant_points(points: list[tuple[int, int, int]]) -> None:
    actual, expected = scored(points)
    assert {*actual} == expected


def in_a_plane(seed: int) -> list[tuple[int, int, int]]:
    """Return points of one plane across the largest cube: the ends of an edge, then points on one side of it."""
    source = random.Random(seed)
    places = {(source.randrange(512), source.randrange(2, 512)) for _ in range(60)}
    return [(0, 0, 0), (1021, 1, 1022), *((x, y, x + y) for x, y in places)]


@pytest.mark.parametrize("seed", range(5))
def test_all_points_of_one_plane_are_found(seed: int) -> None:
    points = in_a_plane(seed)
    actual, expected = scored(points)
    assert {*actual} == expected == {*points[2:]}
    places = [(x, y) for x, y, _ in actual]
    assert places == in_order(places)


def in_order(places: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """Sort places in the order of a quadtree's sons: at each level y decides before x."""
    return sorted(places, key=lambda place: [(place[1] >> k & 1, place[0] >> k & 1) for k in range(9, -1, -1)])


def test_candidates_lie_beyond_the_known_side_and_are_marked_once() -> None:
    start, end, apex = (0, 0, 0), (4, 0, 0), (2, 3, 0)
    assert Candidates([start, end, apex]).face_on(start, end) == []
    assert Candidates([start, end, apex]).face_on(end, start) == [apex]
    points = [(0, 0, 0), (4, 0, 0), (2, 2, 0), (0, 4, 0)]
    candidates = Candidates(points)
    edge = ((4, 0, 0), (0, 0, 0))
    assert candidates.face_on(*edge) == [points[2], points[3]]
    candidates.mark([points[2], points[3]], [points[3]])
    assert candidates.face_on(*edge) == [points[3]]

"""Yau and Srihari in arrays: the same octrees, quadtrees and faces as the plain way, node by node and step by step."""

from __future__ import annotations

import random
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from modern.digital.hull import digital_hull
from modern.papers.yau_srihari import OctreeHull, Printed, octree_hull, search
from modern.papers.yau_srihari import octree as trees
from modern.papers.yau_srihari.envelope import Envelope, _values, reduced_tree
from modern.papers.yau_srihari.octree import Octree, octree, voxels_of
from modern.papers.yau_srihari.quadtree import (
    Quadtree,
    ceiling,
    floor,
    graph_side,
    heights,
    mirrored,
    no_columns,
    with_columns,
    written,
)
from modern.papers.yau_srihari.search import Candidates, Search
from tests.support import nested_trees
from tests.support.digital_judge import judged, random_solid
from tests.support.nested_trees import nested, nested_heights

SIDES = st.sampled_from([1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17])


@st.composite
def solids(draw: st.DrawFn) -> Any:
    """Voxels in a box of any sides, flat ones among them: none, one, blocks as far as the box's ends, or scattered."""
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


def side_of(array: Any) -> int:
    return trees.side_for(max(array.shape))


@given(solids())
def test_an_octree_is_the_one_made_node_by_node(array: Any) -> None:
    tree, plain = octree(array), nested_trees.octree(array, side_of(array))
    assert nested(tree) == plain
    assert trees.nodes(tree) == nested_trees.nodes(plain)
    assert trees.count(tree) == nested_trees.count(plain, tree.side)
    assert np.array_equal(voxels_of(tree, array.shape), array)
    assert np.array_equal(
        tree.corners() + (tree.side >> tree.levels)[:, None] <= tree.side, np.ones((len(tree.codes), 3))
    )


def test_trees_are_equal_where_side_and_leaves_are() -> None:
    one = octree(np.ones((1, 1, 1), dtype=np.bool_))
    full = octree(np.ones((4, 4, 4), dtype=np.bool_))
    assert one != full
    assert full == Octree(4, np.zeros(1, dtype=np.int64), np.zeros(1, dtype=np.int64))
    assert full != octree(np.ones((4, 4, 3), dtype=np.bool_))
    assert full != "full"


def test_parts_of_an_array_are_divided_alike(monkeypatch: pytest.MonkeyPatch) -> None:
    array = np.random.default_rng(3).random((23, 9, 14)) < 0.9
    array[4:20, :8, :8] = True
    whole = octree(array)
    monkeypatch.setattr(trees, "SLAB", 1)
    assert octree(array) == whole


@given(solids())
def test_floor_and_ceiling_are_those_made_node_by_node(array: Any) -> None:
    tree, plain = octree(array), nested_trees.octree(array, side_of(array))
    assert nested_heights(floor(tree)) == nested_trees.ends(plain, tree.side, top=False)
    assert nested_heights(ceiling(tree)) == nested_trees.ends(plain, tree.side, top=True)


@st.composite
def height_trees(draw: st.DrawFn) -> Quadtree:
    """Heights over some places, as far as above and below the cube."""
    side = draw(st.sampled_from([1, 2, 4, 8]))
    x, y = np.nonzero(draw(arrays.arrays(np.bool_, (side, side), fill=st.just(True))))
    z = draw(arrays.arrays(np.int64, len(x), elements=st.integers(-3, side + 3)))
    return with_columns(no_columns(side), x, y, z)


@given(height_trees(), height_trees())
def test_epigraph_hypograph_and_intersection_are_those_made_node_by_node(low: Quadtree, high: Quadtree) -> None:
    plain = {}
    for tree in (low, high):
        for above in (True, False):
            plain[tree.side, id(tree), above] = nested_trees.graph_side(nested_heights(tree), tree.side, above)
            assert nested(graph_side(tree, above)) == plain[tree.side, id(tree), above]
    if low.side == high.side:
        both = trees.intersection(graph_side(low, above=True), graph_side(high, above=False))
        assert nested(both) == nested_trees.intersection(
            plain[low.side, id(low), True], plain[low.side, id(high), False]
        )


@given(solids(), solids())
def test_an_intersection_is_the_one_made_node_by_node(first: Any, second: Any) -> None:
    a, b = (np.zeros((16, 16, 16), dtype=np.bool_) for _ in range(2))
    for cube, array in ((a, first), (b, second)):
        part = array[:16, :16, :16]
        cube[tuple(map(slice, part.shape))] = part
    both = trees.intersection(octree(a), octree(b))
    assert nested(both) == nested_trees.intersection(nested_trees.octree(a, 16), nested_trees.octree(b, 16))
    assert both == octree(a & b)


def by_steps(found: Envelope, tree: Quadtree) -> Quadtree:
    """The tree after the values of every step's face are entered in turn."""
    for step in found.steps:
        assert step.face is not None
        tree = written(tree, _values(step.face, Printed()))
    return tree


def check(hull: OctreeHull) -> None:
    """Whether faces and heights are those of the search of the tree, in its order."""
    for found, ends in ((hull.lower, hull.lowest), (hull.upper, mirrored(hull.highest))):
        assert tuple(step.face for step in found.steps) == found.faces
        if not found.chain:
            after = by_steps(found, reduced_tree(ends))
            assert np.array_equal(after.there, found.tree.there)
            assert np.array_equal(after.values, found.tree.values)
            assert np.array_equal(after.marked, found.tree.marked)


@given(solids())
def test_faces_found_at_once_are_those_the_search_finds_one_by_one(array: Any) -> None:
    if array.any():
        hull = octree_hull(array)
        check(hull)
        assert np.array_equal(digital_hull(array).filled, hull.filled)
        assert hull.hull == octree(hull.filled)
        assert hull.columns == len(hull.floor) == len(hull.ceiling) == np.count_nonzero(array.any(axis=2))


@given(st.integers(0, 10**9))
def test_the_same_of_connected_solids_and_by_the_judge(seed: int) -> None:
    array = random_solid(random.Random(seed), side=9)
    hull = octree_hull(array)
    check(hull)
    assert np.array_equal(hull.filled, judged(array)[1])


@pytest.mark.parametrize("length", [1, 2, 31, 32, 33])
def test_single_voxels_at_the_ends_of_a_box(length: int) -> None:
    for place in ((0, 0, 0), (length - 1, 0, length - 1), (length - 1,) * 3):
        array = np.zeros((length,) * 3, dtype=np.bool_)
        array[place] = True
        hull = octree_hull(array)
        assert hull.solid == hull.hull
        assert hull.hull.corners().tolist() == [[*place]]
        assert (hull.voxels, hull.floor) == (1, {place[:2]: place[2]})


# Scores in float64, fractions where they are close.


def scored(points: list[tuple[int, int, int]]) -> tuple[list[Any], set[Any]]:
    """The next face's points from the upright face over the first two, at once and by all fractions."""
    start, end, *others = points
    normal = search.normal_of(start, end, (*start[:2], start[2] + 1))
    fractions = Search(start, end, normal, Printed())
    for point in others:
        if fractions.beyond(*point[:2]):
            fractions.take(point)
    return Candidates(points).face_on(start, end, normal), {*fractions.points}


FAR = st.tuples(*[st.integers(0, 1023)] * 3)


@given(st.lists(FAR, min_size=3, max_size=30, unique_by=lambda point: point[:2]))
def test_the_best_of_far_points_is_found(points: list[tuple[int, int, int]]) -> None:
    found, expected = scored(points)
    assert {*found} == expected


def in_a_plane(seed: int) -> list[tuple[int, int, int]]:
    """Points as far apart as in the largest cube, all in one plane: an edge, then those on one side of it."""
    source = random.Random(seed)
    places = {(source.randrange(512), source.randrange(2, 512)) for _ in range(60)}
    return [(1021, 1, 1022), (0, 0, 0), *((x, y, x + y) for x, y in places)]


@pytest.mark.parametrize("seed", range(5))
def test_points_in_one_plane_are_found_together(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Their scores are one fraction and many float64."""
    points = in_a_plane(seed)
    found, expected = scored(points)
    assert {*found} == expected == {*points[2:]}
    places = [(x, y) for x, y, _ in found]
    assert places == in_order(places)
    monkeypatch.setattr(search, "ROUNDED", 0.0)
    assert {*scored(points)[0]} < expected


def in_order(places: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """Places in the order of a quadtree's sons: y decides at each level before x."""
    return sorted(places, key=lambda place: [(place[1] >> k & 1, place[0] >> k & 1) for k in range(9, -1, -1)])


def test_no_face_is_found_where_all_points_lie_on_the_known_side() -> None:
    start, end, other = (0, 0, 0), (4, 0, 0), (2, 3, 0)
    normal = (0, -1, 0)
    assert Candidates([start, end, other]).face_on(start, end, normal) == []
    assert Candidates([start, end, other]).face_on(end, start, normal) == [other]


def test_marked_points_are_not_found_again() -> None:
    points = [(0, 0, 0), (4, 0, 0), (2, 2, 0), (0, 4, 0)]
    candidates = Candidates(points)
    edge = ((4, 0, 0), (0, 0, 0), (0, -1, 0))
    assert candidates.face_on(*edge) == [points[2], points[3]]
    candidates.mark([points[2], points[3]], [points[3]])
    assert candidates.face_on(*edge) == [points[3]]


def test_heights_of_a_tree_are_those_of_its_columns() -> None:
    tree = with_columns(no_columns(4), np.array([3, 0]), np.array([1, 2]), np.array([7, -5]))
    assert heights(tree) == {(3, 1): 7, (0, 2): -5}

"""Yau and Srihari: octrees, the quadtrees of floor and ceiling, and the search with its bounds."""

import random
from collections import Counter
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from modern.digital.intervals import lower_chain
from modern.papers.yau_srihari import Printed, octree_hull
from modern.papers.yau_srihari import quadtree as trees
from modern.papers.yau_srihari.envelope import outline, reduced_tree
from modern.papers.yau_srihari.octree import QUADRANTS, Octree, count, octree, side_for, voxels_of
from modern.papers.yau_srihari.search import Search, normal_of
from tests.support.digital_judge import random_solid, solid_of

FEW = settings(max_examples=40)
ARRAYS = arrays.arrays(np.bool_, st.tuples(*[st.integers(1, 9)] * 3))
CUBES = st.sampled_from([1, 2, 4, 8]).flatmap(lambda side: arrays.arrays(np.bool_, (side, side, side)))


@FEW
@given(ARRAYS)
def test_an_octree_stores_its_array(array: np.ndarray) -> None:
    side = side_for(max(array.shape))
    cube = np.zeros((side, side, side), dtype=np.bool_)
    cube[tuple(slice(length) for length in array.shape)] = array
    tree = octree(array)
    assert tree == octree(cube)
    # No eight leaves fill a node together.
    parents = zip(tree.levels.tolist(), (tree.codes >> 3 * (tree.depth - tree.levels + 1)).tolist(), strict=True)
    assert max(Counter(parents).values(), default=0) < 8
    assert (np.diff(tree.codes) > 0).all()
    assert np.array_equal(voxels_of(tree, array.shape), array)
    assert np.array_equal(voxels_of(tree, cube.shape), cube)
    assert tree.side == side
    assert count(tree) == np.count_nonzero(array)


def test_sons_lie_over_quadrants_and_marked_nodes_have_no_value() -> None:
    for number in range(8):
        i, j = QUADRANTS[number // 2]
        cube = np.zeros((2, 2, 2), dtype=np.bool_)
        cube[i, j, number % 2] = True
        assert octree(cube) == Octree(2, np.array([number]), np.array([1]))
    tree = trees.written(trees.no_columns(2), {(0, 0): trees.Leaf(3, marked=True), (1, 0): trees.Leaf(5, marked=True)})
    assert trees.heights(tree) == {(0, 0): 3, (1, 0): 5}
    assert (tree.low, tree.high) == (None, None)


@FEW
@given(CUBES)
def test_floor_and_ceiling_are_the_ends_of_columns(cube: np.ndarray) -> None:
    tree = octree(cube)
    lowest: dict[tuple[int, int], int] = {}
    highest: dict[tuple[int, int], int] = {}
    for x, y, z in np.argwhere(cube).tolist():
        lowest.setdefault((x, y), z)
        highest[x, y] = z
    assert trees.heights(trees.floor(tree)) == lowest
    assert trees.heights(trees.ceiling(tree)) == highest
    assert trees.heights(trees.mirrored(trees.ceiling(tree))) == {place: -z for place, z in highest.items()}


def values_hold(tree: trees.Quadtree) -> bool:
    """Return True if every node and every level has the least and the greatest unmarked height below it."""
    levels = trees.bounds_by_level(tree)
    for part, x, y, side in squares(tree, tree.side):
        columns = zip(*map(np.ravel, (part.values, part.there, part.marked)), strict=True)
        below = [int(z) for z, there, marked in columns if there and not marked]
        low, high = (grid[x // side, y // side] for grid in levels[side.bit_length() - 1])
        if (part.low, part.high) != (min(below, default=None), max(below, default=None)):
            return False
        if (low, high) != (min(below, default=trees.NO_COLUMN), max(below, default=-trees.NO_COLUMN)):
            return False
    return True


@FEW
@given(CUBES)
def test_a_line_of_a_quadtree_lists_its_columns(cube: np.ndarray) -> None:
    side = len(cube)
    tree = trees.floor(octree(cube))
    columns = trees.heights(tree)
    assert values_hold(tree)
    for at in range(side):
        assert list(trees.line(tree, 0, at)) == sorted((y, z) for (x, y), z in columns.items() if x == at)
        assert list(trees.line(tree, 1, at)) == sorted((x, z) for (x, y), z in columns.items() if y == at)


@FEW
@given(CUBES, st.data())
def test_written_leaves_replace_those_of_the_tree(cube: np.ndarray, data: st.DataObject) -> None:
    side = len(cube)
    places = st.tuples(*[st.integers(0, side - 1)] * 2)
    cells = data.draw(st.dictionaries(places, st.builds(trees.Leaf, st.integers(-9, 9), st.booleans()), max_size=9))
    tree = trees.floor(octree(cube))
    after = trees.written(tree, cells)
    assert trees.heights(after) == trees.heights(tree) | {place: leaf.value for place, leaf in cells.items()}
    assert values_hold(after)


@FEW
@given(CUBES, st.data())
def test_epigraph_and_hypograph_are_the_voxels_above_and_below(columns: np.ndarray, data: st.DataObject) -> None:
    """The heights may lie above and below the cube."""
    side = len(columns)
    x, y = np.nonzero(columns[0])
    z = data.draw(arrays.arrays(np.int64, len(x), elements=st.integers(-3, side + 3)))
    for above in (True, False):
        voxels = np.zeros((side, side, side), dtype=np.bool_)
        voxels[x, y] = (np.arange(side) >= z[:, None]) if above else (np.arange(side) <= z[:, None])
        assert trees.graph_side(trees.with_columns(trees.no_columns(side), x, y, z), above) == octree(voxels)


@given(st.dictionaries(st.integers(-9, 9), st.integers(-9, 9), min_size=1))
def test_a_lower_chain_turns_left_and_has_no_point_below(points: dict[int, int]) -> None:
    chain = lower_chain(sorted(points.items()))
    assert (chain[0][0], chain[-1][0]) == (min(points), max(points))
    for (a, x), (b, y), (c, z) in zip(chain, chain[1:], chain[2:], strict=False):
        assert (b - a) * (z - y) > (c - b) * (y - x)
    for (a, x), (b, y) in pairwise(chain):
        assert all((b - a) * (z - x) >= (y - x) * (t - a) for t, z in points.items() if a <= t <= b)


@pytest.mark.parametrize(
    ("places", "corners"),
    [
        ([(3, 4)], [(3, 4)]),
        ([(0, 0), (1, 1), (2, 2)], [(0, 0), (2, 2)]),
        ([(1, 0), (1, 1), (1, 2)], [(1, 0), (1, 2)]),
        ([(x, y) for x in range(3) for y in range(2)], [(0, 0), (2, 0), (2, 1), (0, 1)]),
    ],
)
def test_an_outline_is_the_hull_of_places(places: list[tuple[int, int]], corners: list[tuple[int, int]]) -> None:
    assert outline(places) == corners


# The bounds of section 4.6.2.


def squares(tree: trees.Quadtree, side: int, x: int = 0, y: int = 0) -> Iterator[tuple[trees.Quadtree, int, int, int]]:
    if tree.there.any():
        yield tree, x, y, side
        half = side // 2
        for (i, j), son in zip(QUADRANTS, trees.sons_of(tree), strict=True):
            if half:
                yield from squares(son, half, x + i * half, y + j * half)


def lower_tree(array: Any) -> trees.Quadtree:
    """Return the reduced tree in which the faces of the lower half of a solid's hull are searched."""
    return reduced_tree(trees.floor(octree(array)))


def violations(array: Any, printed: Printed) -> tuple[int, int, int]:
    """Count the squares with bounds, those without a point at delta_1 or above, and those with one above delta_2.

    The edges and faces are those of the corrected algorithm.
    """
    hull = octree_hull(array)
    tree = lower_tree(array)
    bounded = least_violated = most_violated = 0
    for step in hull.lower.steps:
        search = Search(*step.edge, step.normal, printed)
        for square in squares(tree, hull.side):
            part, x, y, side = square
            assert part.low is not None
            assert part.high is not None
            least, most = search.bounds(part.low, part.high, x, y, side)
            if least is None or most is None:
                continue
            scores = [search.score((x + i, y + j, z)) for (i, j), z in trees.heights(part).items()]
            best = max(score for score in scores if score is not None)
            bounded += 1
            least_violated += best < least
            most_violated += best > most
    return bounded, least_violated, most_violated


@settings(max_examples=25)
@given(st.integers(0, 10**9))
def test_the_bounds_hold_for_every_square(seed: int) -> None:
    array = random_solid(random.Random(seed), side=9, steps=60)
    assert violations(array, Printed())[1:] == (0, 0)
    # Theorem 2 as printed requires the greatest angle, which z = max fits.
    assert violations(array, Printed(angle=True))[1:] == (0, 0)


@settings(max_examples=25)
@given(st.integers(0, 10**9))
def test_the_next_face_has_no_vertex_in_a_square_on_the_known_side(seed: int) -> None:
    """Rule 1: n_3(r) >= 0 in such a square."""
    array = random_solid(random.Random(seed), side=9, steps=60)
    hull = octree_hull(array)
    tree = lower_tree(array)
    for step in hull.lower.steps:
        start, end = step.edge
        search = Search(start, end, step.normal, Printed())
        for face in hull.lower.faces:
            if face.normal == step.normal and {start, end} <= {*face.vertices}:
                assert not any(search.beyond(x, y) for x, y, _ in face.vertices), "the known face lies beyond its edge"
        for part, x, y, side in squares(tree, hull.side):
            if any(search.beyond(x + i * (side - 1), y + j * (side - 1)) for i, j in QUADRANTS):
                continue
            points = [(x + i, y + j, z) for (i, j), z in trees.heights(part).items()]
            assert all(normal_of(start, end, point)[2] >= 0 for point in points)
            if step.face:
                assert {*points} & {*step.face.vertices} <= {start, end}


@settings(max_examples=25)
@given(st.integers(0, 10**9))
def test_the_search_finds_the_best_of_all_points(seed: int) -> None:
    """Rule 2, with the least angle, skips only squares without a point of the next face."""
    array = random_solid(random.Random(seed), side=9, steps=60)
    hull = octree_hull(array)
    tree = lower_tree(array)
    for step in hull.lower.steps:
        search = Search(*step.edge, step.normal, Printed())
        every = [(x, y, z) for (x, y), z in trees.heights(tree).items() if search.beyond(x, y)]
        scores = {point: score for point in every if (score := search.score(point)) is not None}
        best = max(scores.values(), default=None)
        assert {*search.run(tree)} == {point for point, score in scores.items() if score == best}
        assert Search(*step.edge, step.normal, Printed()).run(trees.no_columns(hull.side)) == []


def test_z_max_does_not_bound_the_least_angle() -> None:
    array = solid_of([(0, 1, 0), (0, 2, 0), (1, 0, 1), (1, 1, 0), (1, 1, 1), (2, 0, 1), (2, 1, 0)])
    bounded, _, most_violated = violations(array, Printed(bound=True))
    assert 0 < most_violated < bounded


LOW_CORNER = [
    *[(1, 2, 4), (1, 2, 5), (1, 3, 3), (1, 3, 4), (1, 4, 5), (2, 3, 3), (2, 3, 4), (2, 4, 2), (2, 4, 3), (2, 4, 5)],
    *[(3, 1, 4), (3, 2, 3), (3, 2, 4), (3, 3, 3), (3, 3, 4), (3, 4, 2), (3, 4, 3), (3, 4, 4), (3, 4, 5), (4, 1, 3)],
    *[(4, 2, 2), (4, 2, 3), (4, 2, 4), (4, 3, 3), (4, 4, 4), (5, 0, 2), (5, 1, 2), (5, 1, 3), (5, 2, 2), (5, 2, 3)],
    *[(6, 0, 2), (6, 1, 3)],
]
"""A solid with a square that has a corner below the plane of a face and a point at a small angle to that face."""


def test_a_corner_below_the_known_face_must_count_as_in_its_plane(monkeypatch) -> None:
    array = np.zeros((8, 5, 6), dtype=np.bool_)
    array[tuple(np.array(LOW_CORNER).T)] = True
    assert violations(array, Printed())[1:] == (0, 0)
    monkeypatch.setattr(Search, "_corner", lambda search, corner: search.score(corner))
    assert violations(array, Printed())[2] > 0

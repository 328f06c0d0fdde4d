"""Laws of the exact hull: what reordering, moving, scaling and shearing the points changes."""

import math
import random
from fractions import Fraction

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from modern.exact_hull import exact_hull
from modern.exact_hull.coordinates import read_points
from modern.exact_hull.facets import faces, independent
from modern.exact_hull.surface import convex_surface

LAW = settings(deadline=None, max_examples=60)
tiny = st.integers(-2, 2)
mixed = st.one_of(tiny, st.integers(-(10**8), 10**8), st.integers(-(10**30), 10**30))
point_sets = st.one_of(
    st.lists(st.tuples(tiny, tiny, tiny), min_size=1, max_size=25),
    st.lists(st.tuples(mixed, mixed, mixed), min_size=1, max_size=14),
    st.lists(st.tuples(tiny, tiny, st.just(1)), min_size=1, max_size=12),
)


def from_smallest(cycle):
    start = cycle.index(min(cycle))
    return (*cycle[start:], *cycle[:start])


def planes(hull) -> set[tuple[int, ...]]:
    """Return the planes of the facets for unscaled coordinates."""
    return {hull.plane_of(facet) for facet in hull.facets}


def polygons(hull) -> set[tuple[int, ...]]:
    return {facet.polygon for facet in hull.facets}


def classes(hull) -> tuple[object, ...]:
    return hull.dimension, hull.vertices, hull.boundary, hull.inside, hull.duplicates


@LAW
@given(point_sets, st.randoms(use_true_random=False))
def test_reordering_changes_only_the_indices_of_points(points, rng) -> None:
    points = list(dict.fromkeys(points))
    order = list(range(len(points)))
    rng.shuffle(order)
    hull, shuffled = exact_hull(points), exact_hull([points[index] for index in order])
    assert (shuffled.dimension, shuffled.plane) == (hull.dimension, hull.plane)
    for name in ("vertices", "boundary", "inside"):
        assert tuple(sorted(order[index] for index in getattr(shuffled, name))) == getattr(hull, name)
    assert [facet.plane for facet in shuffled.facets] == [facet.plane for facet in hull.facets]
    for facet, shuffled_facet in zip(hull.facets, shuffled.facets, strict=True):
        assert from_smallest([order[index] for index in shuffled_facet.polygon]) == facet.polygon


@LAW
@given(point_sets)
@example([(2**63, 0, 0), (2**63, 0, 1)])
def test_reflection_reverses_every_face(points) -> None:
    hull, mirrored = exact_hull(points), exact_hull([(-x, y, z) for x, y, z in points])
    assert classes(mirrored) == classes(hull)
    if hull.dimension == 3:
        assert polygons(mirrored) == {from_smallest(polygon[::-1]) for polygon in polygons(hull)}
    assert planes(mirrored) == {(-a, b, c, d) for a, b, c, d in planes(hull)}


@LAW
@given(point_sets, st.data())
def test_a_point_between_points_changes_no_facet(points, data) -> None:
    """Neither does removing all points that are not vertices."""
    hull = exact_hull(points)
    weights = data.draw(st.lists(st.integers(0, 5), min_size=len(points), max_size=len(points)).filter(any))
    total = sum(weights)
    between = tuple(
        Fraction(sum(weight * point[axis] for weight, point in zip(weights, points, strict=True)), total)
        for axis in range(3)
    )
    extended = exact_hull([*points, between])
    assert (extended.vertices, planes(extended), polygons(extended)) == (hull.vertices, planes(hull), polygons(hull))
    assert planes(exact_hull([points[index] for index in hull.vertices])) == planes(hull)


@LAW
@given(point_sets, st.randoms(use_true_random=False))
def test_the_order_of_insertion_changes_no_face(points, rng) -> None:
    points = list(dict.fromkeys(points))
    simplex = independent(points)
    if len(simplex) < 4:
        return
    expected = {facet.polygon for facet in exact_hull(points).facets}
    for _ in range(3):
        others = [index for index in range(len(points)) if index not in simplex]
        rng.shuffle(others)
        facets = faces(convex_surface(read_points(points), rng.sample(simplex, 4), others), points)
        assert len(facets) == len(expected)
        assert {facet.polygon for facet in facets} == expected


@pytest.mark.parametrize(("seed", "count"), [(1, 4), (2, 6), (3, 10), (4, 50), (5, 400), (6, 2000)])
@pytest.mark.parametrize("shape", ["cube", "ball", "sphere"])
def test_points_in_general_position_have_the_vertices_and_facets_of_qhull(seed: int, count: int, shape: str) -> None:
    spatial = pytest.importorskip("scipy.spatial")
    rng = random.Random(f"{seed} {shape}")
    points = []
    while len(points) < count:
        point = [rng.uniform(-1, 1) for _ in range(3)]
        length = math.hypot(*point)
        if shape != "cube" and not 0.1 < length < 1:
            continue
        points.append(tuple(round(10**8 * number / (length if shape == "sphere" else 1)) for number in point))
    hull, qhull = exact_hull(points), spatial.ConvexHull(points)
    assert list(hull.vertices) == sorted(qhull.vertices.tolist())
    assert {frozenset(facet.polygon) for facet in hull.facets} == {frozenset(s) for s in qhull.simplices.tolist()}

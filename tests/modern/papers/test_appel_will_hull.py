"""The complete method compared with the exact hull on general and degenerate input, and every kind of result."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import combinations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from modern.exact_hull import exact_hull
from modern.papers.appel_will import CORRECTED, Method, appel_will, printed
from modern.papers.appel_will.star import as_corrected
from tests.support.judged import sets

Point = tuple[int, int, int]
FIRST_LINE = printed("step3")


def cycle_from_lowest(polygon: Sequence[int]) -> tuple[int, ...]:
    start = polygon.index(min(polygon))
    return (*polygon[start:], *polygon[:start])


def cycle(polygon: Sequence[int]) -> tuple[int, ...]:
    """Return a polygon in a form that does not depend on its first point and its sense."""
    from_lowest = cycle_from_lowest(polygon)
    return min(from_lowest, (from_lowest[0], *from_lowest[:0:-1]))


def differences(points: Sequence[Sequence[object]], method: Method = CORRECTED) -> list[str]:
    """Name the properties in which the method differs from the exact hull."""
    ours, judge = appel_will(points, method=method), exact_hull(points)
    polygons = {3: [facet.polygon for facet in judge.facets], 2: [judge.polygon]}.get(judge.dimension, [])
    compared = {
        "fault": (ours.fault, ""),
        "dimension": (ours.dimension, judge.dimension),
        "scale": (ours.scale, judge.scale),
        "vertices": (ours.vertices, judge.vertices),
        "duplicates": (ours.duplicates, judge.duplicates),
        "edges": (ours.edges, judge.edges()),
        "faces": (Counter(map(cycle, ours.surfaces)), Counter(map(cycle, polygons))),
    }
    return [name for name, (actual, expected) in compared.items() if actual != expected]


def test_point_sets_agree_with_the_exact_hull_by_every_method() -> None:
    for name, points in sets(150, 1):
        assert differences(points) == [], name
    for name, points in sets(40, 3):
        assert differences(points, FIRST_LINE) == [], name
        assert differences(points, Method(star=as_corrected)) == [], name


coordinate = st.one_of(st.integers(-1, 2), st.fractions(-2, 2, max_denominator=3))


@given(st.lists(st.tuples(coordinate, coordinate, coordinate), min_size=1, max_size=10))
@settings(max_examples=60, deadline=None)
def test_duplicates_and_fractions_agree_with_the_exact_hull(points: list[tuple[Fraction, Fraction, Fraction]]) -> None:
    assert differences(points) == []


@given(st.lists(st.tuples(*[st.integers(-(10**30), 10**30)] * 3), min_size=4, max_size=9))
@settings(max_examples=30, deadline=None)
def test_integers_of_thirty_digits_agree_with_the_exact_hull(points: list[Point]) -> None:
    assert differences(points) == []


@pytest.mark.parametrize(
    ("points", "dimension", "edges", "loops"),
    [
        ([(1, 2, 3)], 0, 0, 0),
        ([(1, 2, 3)] * 3, 0, 0, 0),
        ([(1, 2, 3), (4, 5, 6)], 1, 1, 0),
        ([(0, 0, 0), (2, 2, 2), (1, 1, 1), (5, 5, 5)], 1, 1, 0),
        ([(0, 0, 0), (1, 0, 0), (0, 1, 0)], 2, 3, 1),
        ([(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (1, 1, 0), (1, 0, 0)], 2, 4, 1),
        ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], 3, 6, 4),
    ],
    ids=["point", "one point thrice", "two points", "collinear", "triangle", "flat", "tetrahedron"],
)
def test_hulls_of_every_dimension(points: list[Point], dimension: int, edges: int, loops: int) -> None:
    hull = appel_will(points)
    assert (hull.dimension, len(hull.edges), len(hull.surfaces), hull.fault) == (dimension, edges, loops, "")
    assert hull.table.closed == (dimension == 3)


def test_edges_and_loops_that_are_not_a_hull_have_a_fault() -> None:
    hull = appel_will([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)])
    assert hull.fault == ""
    fewer = replace(hull.table, loops=hull.table.loops[1:])
    assert replace(hull, table=fewer).fault == "3 of 6 edges are not used by exactly two loops"
    assert replace(hull, surfaces=hull.surfaces[1:]).fault == "V - E + F is 4 - 6 + 3 = 1, not 2"
    square = [(x, y, 0) for x in (0, 1) for y in (0, 1)]
    diagonals = appel_will([*square, (3, 1, 0)], method=replace(printed("step3"), star=lambda images: True))
    assert diagonals.dimension == 2
    assert diagonals.fault.endswith("loops do not form one polygon")


def test_points_between_others_are_deleted_in_any_order() -> None:
    """Only the two ends of each line remain (Fig. 13)."""
    line = [(0, 0, 0), (3, 3, 3), (1, 1, 1), (2, 2, 2)]
    for order in ([0, 1, 2, 3], [2, 3, 0, 1], [3, 0, 2, 1], [2, 0, 3, 1]):
        points = [line[k] for k in order] + [(9, 0, 0), (0, 9, 0)]
        hull = appel_will(points)
        assert {points[d.point] for d in hull.deleted} == {(1, 1, 1), (2, 2, 2)}
        assert all({points[k] for k in d.between} == {(0, 0, 0), (3, 3, 3)} for d in hull.deleted)
        assert differences(points) == []


def test_every_pair_is_projected_once_and_surfaces_face_outward() -> None:
    points = [(k, k * k, k**3) for k in range(-4, 5)]
    assert appel_will(points).projections == len(list(combinations(points, 2)))
    for _, points in sets(30, 4):
        hull, judge = appel_will(points), exact_hull(points)
        if hull.dimension == 3:
            outward = {cycle_from_lowest(face) for face in hull.outward()}
            assert outward == {facet.polygon for facet in judge.facets}

"""The port with exact numbers compared with the judge, which shares no code with it.

HULL1620_SETS sets the number of random sets.
"""

import os
import random
from collections.abc import Callable
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from modern.exact_hull import ExactHull, exact_hull
from modern.geometry.hull import DETERMINED, Hull
from modern.port import convex_hull

SETS = int(os.environ.get("HULL1620_SETS", "200"))
Triples = list[tuple[object, object, object]]


def check(points: Triples, arithmetic: str = "exact", judge: ExactHull | None = None) -> Hull:
    """Compare vertices, boundary, inside, duplicates, planes and polygons with the judge."""
    hull, judge = convex_hull(points, arithmetic), judge or exact_hull(points)
    assert hull.status == DETERMINED, points
    assert hull.dimension == judge.dimension, points
    assert sorted(hull.vertices) == list(judge.vertices), points
    assert sorted(hull.boundary) == list(judge.boundary), points
    assert sorted(hull.inside) == list(judge.inside), points
    assert hull.duplicates == judge.duplicates, points
    (check_polyhedron if judge.dimension == 3 else check_polygon if judge.dimension == 2 else check_ends)(hull, judge)
    return hull


def check_polyhedron(hull: Hull, judge: ExactHull) -> None:
    mine = {face.lowest: face.polygon for face in hull.faces}
    assert len(mine) == len(hull.faces)
    assert {plane: turned(polygon) for plane, polygon in mine.items()} == {
        judge.plane_of(facet): facet.polygon for facet in judge.facets
    }
    for face in hull.faces:
        on = {k for k in (*hull.vertices, *hull.boundary) if value(face.lowest, hull.points[k]) == 0}
        assert on == {*face.polygon, *face.on}


def check_polygon(hull: Hull, judge: ExactHull) -> None:
    assert hull.plane is not None
    assert judge.plane is not None
    assert proportional([Fraction(c) for c in hull.plane], judge.plane_of(judge.plane))
    assert sorted(tuple(sorted(face.polygon)) for face in hull.faces) == sorted(f.polygon for f in judge.facets)
    for face in hull.faces:
        values = [value(face.lowest, hull.points[k]) for k in (*hull.vertices, *hull.boundary, *hull.inside)]
        assert max(values) == 0
        on = {k for k in (*hull.vertices, *hull.boundary) if value(face.lowest, hull.points[k]) == 0}
        assert on == {*face.polygon, *face.on}


def check_ends(hull: Hull, judge: ExactHull) -> None:
    assert len(hull.lines) == 2 * judge.dimension
    for line in hull.lines:
        assert any(Fraction(c) for c in line[:3])
        assert all(value([Fraction(c) for c in line], p) == 0 for p in hull.points)


def turned(polygon: tuple[int, ...]) -> tuple[int, ...]:
    """Rotate the polygon to start with its smallest index, as the judge does."""
    first = polygon.index(min(polygon))
    return polygon[first:] + polygon[:first]


def value(equation: object, point: tuple[str, str, str]) -> Fraction:
    a, b, c, d = equation
    x, y, z = map(Fraction, point)
    return Fraction(a * x + b * y + c * z + d)


def proportional(plane: list[Fraction], reference: tuple[int, ...]) -> bool:
    return all(plane[i] * reference[j] == plane[j] * reference[i] for i in range(4) for j in range(i))


def lattice(r: random.Random, n: int) -> Triples:
    a = r.choice((1, 1, 2, 2, 3))
    return [(r.randint(0, a), r.randint(0, a), r.randint(0, a)) for _ in range(n)]


def flat(r: random.Random, n: int) -> Triples:
    axis, a = r.randrange(3), r.choice((1, 2, 3, 5))
    return [tuple(7 if k == axis else r.randint(-a, a) for k in range(3)) for _ in range(n)]


def tilted(r: random.Random, n: int) -> Triples:
    a = r.choice((1, 2, 3, 5))
    u, v, o = ([r.randint(-3, 3) for _ in range(3)] for _ in range(3))
    steps = [(r.randint(-a, a), r.randint(-a, a)) for _ in range(n)]
    return [tuple(o[k] + s * u[k] + t * v[k] for k in range(3)) for s, t in steps]


def line(r: random.Random, n: int) -> Triples:
    u, o = ([r.randint(-3, 3) for _ in range(3)] for _ in range(2))
    return [tuple(o[k] + t * u[k] for k in range(3)) for t in (r.randint(-5, 5) for _ in range(n))]


@pytest.mark.parametrize("family", [lattice, flat, tilted, line])
def test_port_agrees_with_the_judge_on_tiny_grids(family: Callable[[random.Random, int], Triples]) -> None:
    """Cover sets of 1 to 22 points with many points on edges, coplanar faces and duplicates."""
    for seed in range(SETS):
        r = random.Random(seed)
        check(family(r, r.randint(1, r.choice((4, 8, 14, 22)))))


def test_arithmetics_that_represent_tiny_grids_exactly_agree_with_the_judge() -> None:
    """Small integers are exact in eight digits, in floats and in sixty bits, and the corrections apply there too."""
    for seed in range(SETS // 4):
        r = random.Random(seed)
        points = r.choice((lattice, flat, tilted))(r, r.randint(1, 14))
        judge = exact_hull(points)
        for arithmetic in ("truncating", "ibm1962", "rounding:8", "float64", "mp:60"):
            check(points, arithmetic, judge)


exponents = st.sampled_from((0, 0, 1, -1, 40, -40, 300, -300))
coordinate = st.one_of(
    st.integers(-2, 2),
    st.integers(-(10**25), 10**25),
    st.fractions(max_denominator=12),
    st.tuples(st.integers(-9, 9), exponents).map(lambda t: f"{t[0]}e{t[1]}"),
    st.floats(allow_nan=False, allow_infinity=False, width=32),
)


@given(st.lists(st.tuples(coordinate, coordinate, coordinate), min_size=1, max_size=12))
def test_port_agrees_with_the_judge_on_huge_and_tiny_coordinates(points: Triples) -> None:
    check(points)


small = st.integers(-2, 2)


@given(st.lists(st.tuples(small, small, small), min_size=1, max_size=12), st.integers(0, 200), small)
def test_scaling_and_translation_change_no_decision(points: Triples, power: int, shift: int) -> None:
    hull = convex_hull(points)
    scaled = convex_hull([tuple(f"{c}e{power}" for c in p) for p in points])
    parts = [tuple(Fraction(c, 7) + shift for c in p) for p in points]
    assert (scaled.vertices, scaled.boundary, scaled.inside) == (hull.vertices, hull.boundary, hull.inside)
    assert sorted(convex_hull(parts).vertices) == sorted(hull.vertices)


def test_few_points_and_long_integers_have_a_hull() -> None:
    assert check([(1, 2, 3)]).vertices == (0,)
    assert check([(1, 2, 3), (1, 2, 3)]).duplicates == ((1, 0),)
    assert check([(1, 2, 3), (1, 2, 4)]).lines == (("1", "0", "0", "-1"), ("0", "1", "0", "-2"))
    assert len(check([(0, 0, 0), (1, 0, 0), (0, 0, 1)]).lines) == 6
    r = random.Random(62)
    points: Triples = [tuple(r.randint(-20_000, 20_000) for _ in range(3)) for _ in range(60)]
    short = check(points)
    long = convex_hull([tuple(c * 10**12 for c in p) for p in points])
    assert (short.vertices, short.inside) == (long.vertices, long.inside)
    assert [f.defining for f in short.faces] == [f.defining for f in long.faces]

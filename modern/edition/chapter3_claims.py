"""Claims of chapters 1 to 3: definitions, the equations (3.1) to (3.5) and V, and the steps of the procedure.

Equations are transcribed as they are printed and compared with what they are to be, over integers.  What is said of
the approximations H_j is looked at in every stage of the construction of small sets (``count`` of them).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction
from itertools import combinations, pairwise, product
from random import Random

from modern.edition.sampled_sets import Plane, Point, SampledSet, sampled_sets, through, value
from modern.edition.statements import CONDITION, FAILS, HOLDS, Seen, counterexample, seen
from modern.exact_hull import exact_hull
from modern.formats.csv import points as csv_points
from modern.geometry.vectors import cross, dot, minus
from modern.port import convex_hull

COUNT = "2"
"""Sets of each dimension that ``reproduce`` looks at; the tests take more."""


def both(count: str) -> tuple[SampledSet, ...]:
    """Sets in a plane and sets in space."""
    return (*sampled_sets(2, int(count)), *sampled_sets(3, int(count)))


def points_of(name: str) -> list[Point]:
    """The points of a counterexample, which are whole."""
    found, _ = csv_points(counterexample(name), name)
    return [(int(x), int(y), int(z)) for x, y, z in found]


def triples(count: int = 6) -> Iterator[tuple[Point, Point, Point]]:
    """Three points at random, ``count`` times."""
    random = Random(3)
    for _ in range(count):
        p, q, r = (tuple(random.randint(-9, 9) for _ in range(3)) for _ in range(3))
        yield p, q, r  # type: ignore[misc]


def procedure_is_right(count: str = COUNT) -> Seen:
    """The procedure over exact numbers against the judge: vertices, boundary and inside points, planes."""
    right = sets = 0
    for one in both(count):
        sets += 1
        found = ({*one.hull.vertices}, {*one.hull.boundary}, {*one.hull.inside}, len(one.hull.faces))
        right += found == ({*one.judge.vertices}, {*one.judge.boundary}, {*one.judge.inside}, len(one.judge.facets))
    return Seen(CONDITION if right == sets else FAILS, f"{right} of {sets} sets as the exact judge, in exact numbers")


def approximations(kind: str, count: str = COUNT) -> Seen:
    """One property of H_1, H_2, ... in every stage of some sets: ``contain``, ``hulls``, ``struck``, ..."""
    looked = good = 0
    for one in sampled_sets(2, int(count)) if kind == "lines" else both(count):
        for right in _PROPERTIES[kind](one):
            looked += 1
            good += right
    words = f"{good} of {looked} cases in the construction of {'the' if kind != 'lines' else 'the flat'} sets"
    if good < looked or not looked:
        return Seen(FAILS, words)
    return Seen(CONDITION if kind in _WITH_CONDITION else HOLDS, words)


def _contain(one: SampledSet) -> Iterator[bool]:
    stages = one.stages()
    for before, after in pairwise(stages):
        yield all(value(plane, one.points[k]) <= 0 for plane in after.equations for k in before.vertices)


def _hulls(one: SampledSet) -> Iterator[bool]:
    for stage in one.stages():
        judge = exact_hull([one.points[k] for k in stage.vertices])
        planes = {_lowest(plane) for plane in stage.equations}
        yield planes == {facet.plane for facet in judge.facets}


def _struck(one: SampledSet) -> Iterator[bool]:
    for stage in one.hull.history:
        yield not set(stage.struck) & {*one.judge.vertices}


def _finite(one: SampledSet) -> Iterator[bool]:
    yield len(one.hull.history) - 1 <= len(one.points) - one.judge.dimension - 1


def _settled(one: SampledSet) -> Iterator[bool]:
    stages = one.stages()
    for before, after in zip(stages, one.hull.history[1:], strict=False):
        for plane in before.equations[: after.checked - 1]:
            yield all(value(plane, point) <= 0 for point in one.points)


def _outside(one: SampledSet) -> Iterator[bool]:
    gone: set[int] = set()
    for before, news, after in zip(one.stages(), one.hull.history, one.hull.history[1:], strict=False):
        gone.update(news.struck)
        plane = before.equations[after.checked - 1]
        most = max(value(plane, point) for k, point in enumerate(one.points) if k not in gone)
        yield value(plane, one.points[after.added[0]]) == most > 0


def _one_more(one: SampledSet) -> Iterator[bool]:
    for before, after in pairwise(one.hull.history):
        if after.outside == 1:
            yield len(after.equations) - len(before.equations) == one.judge.dimension - 1


_PROPERTIES = {
    "contain": _contain,
    "hulls": _hulls,
    "struck": _struck,
    "finite": _finite,
    "settled": _settled,
    "outside": _outside,
    "lines": _one_more,
    "planes": _one_more,
}
_WITH_CONDITION = ("planes",)


def _lowest(plane: Plane) -> Plane:
    divisor = math.gcd(*plane)
    a, b, c, d = (number // divisor for number in plane)
    return a, b, c, d


def same_hull_in_any_order(count: str = COUNT) -> Seen:
    """The judge's hull of the points backwards."""
    same = [
        {one.points[k] for k in one.judge.vertices}
        == {one.points[::-1][k] for k in exact_hull(one.points[::-1]).vertices}
        for one in both(count)
    ]
    return seen(all(same), f"{sum(same)} of {len(same)} sets, taken backwards, have the same vertices")


def collinear_ends() -> Seen:
    """Points on five lines: the ends, and that each point satisfies both equations."""
    good = 0
    lines: tuple[Point, ...] = ((1, 0, 0), (0, 2, 0), (0, 0, 3), (0, 1, -2), (3, -1, 2))
    for x, y, z in lines:
        points = [(1 + k * x, 2 + k * y, 3 + k * z) for k in (2, 0, -3, 5, 1)]
        hull = convex_hull(points)
        good += hull.dimension == 1 and {*hull.vertices} == {2, 3}
        good += all(not dot(tuple(map(int, e[:3])), p) + int(e[3]) for e in hull.lines for p in points)  # type: ignore[arg-type]
    return seen(good == 2 * len(lines), f"{good // 2} of {len(lines)} lines")


def weights_not_negative() -> Seen:
    """2 P_1 - P_2 is a combination with sum 1, outside of the segment."""
    hull = exact_hull([(0, 0, 0), (1, 0, 0), (-1, 0, 0)])
    return Seen(CONDITION if 0 not in hull.vertices else FAILS, "2 P - Q, with weights 2 and -1, lies beyond P")


def hull_is_the_combinations() -> Seen:
    """Every grid point of a triangle is a combination of its corners, and no other is."""
    p, q, r = (0, 0), (4, 1), (1, 5)
    good = looked = 0
    for x, y in product((-1, 1, 2, 4), repeat=2):
        area = _area(p, q, r)
        weights = [Fraction(_area(*three), area) for three in (((x, y), q, r), (p, (x, y), r), (p, q, (x, y)))]
        inside = not set(exact_hull([(*t, 0) for t in (p, q, r)]).vertices) ^ set(
            exact_hull([(*t, 0) for t in (p, q, r, (x, y))]).vertices
        )
        looked += 1
        good += (min(weights) >= 0) == inside and sum(weights) == 1
    return seen(good == looked, f"{good} of {looked} grid points")


def _area(p: tuple[int, int], q: tuple[int, int], r: tuple[int, int]) -> int:
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])


def supporting_planes(count: str = COUNT) -> Seen:
    """The judge's planes meet the definition."""
    return _supporting(sampled_sets(3, int(count)), 3)


def supporting_lines(count: str = COUNT) -> Seen:
    """The judge's lines meet the definition."""
    return _supporting(sampled_sets(2, int(count)), 2)


def _supporting(sets: tuple[SampledSet, ...], least: int) -> Seen:
    good = looked = 0
    for one in sets:
        for facet in one.judge.facets:
            values = [value(facet.plane, point) for point in one.points]
            looked += 1
            good += max(values) == 0 and values.count(0) >= least
    return seen(good == looked > 0, f"{good} of {looked} have {least} points on them and none beyond")


def vertex_with_minus() -> Seen:
    """The middle of three points in line, by the print: no two points give it, so it would be a vertex."""
    points = points_of("middle.csv")
    middle = points[1]
    half = Fraction(1, 2)
    found = [
        (p, q)
        for p in points
        for q in points
        if [half * p[0] + half * q[0], *(half * p[k] - half * q[k] for k in (1, 2))] == [*map(Fraction, middle)]
    ]
    vertices = exact_hull(points).vertices
    wrong = 1 not in vertices and (points[0], points[2]) not in found
    return Seen(FAILS if wrong else HOLDS, "by the printed signs the ends do not give the middle point")


def vertex_of_the_hull() -> Seen:
    """(1, 1) in the triangle (0, 0), (3, 0), (0, 3): between no two of the four points, yet no vertex."""
    points = [(0, 0, 0), (3, 0, 0), (0, 3, 0), (1, 1, 0)]
    between = [(p, q) for p, q in combinations(points[:3], 2) if not any(cross(minus(q, p), minus(points[3], p)))]
    good = not between and 3 not in exact_hull(points).vertices
    return Seen(CONDITION if good else FAILS, "(1, 1) of that triangle is on no line of two of the others")


def all_triples(count: str = COUNT) -> Seen:
    """Planes of all triples that support, against the judge's."""
    good = 0
    sets = sampled_sets(3, int(count))
    for one in sets:
        planes = set()
        for three in combinations(one.points, 3):
            plane = through(*three)
            values = [value(plane, point) for point in one.points]
            if any(plane[:3]) and (max(values) <= 0 or min(values) >= 0):
                planes.add(_lowest(plane if max(values) <= 0 else tuple(-x for x in plane)))  # type: ignore[arg-type]
        good += planes == {facet.plane for facet in one.judge.facets}
    return seen(good == len(sets), f"{good} of {len(sets)} sets")


def all_pairs(count: str = COUNT) -> Seen:
    """Lines of all pairs that support, against the judge's edges."""
    good = 0
    sets = sampled_sets(2, int(count))
    for one in sets:
        lines = set()
        flat = [(x, y) for x, y, _ in one.points]
        for p, q in combinations(flat, 2):
            sides = [_area(p, q, r) for r in flat]
            if max(sides) <= 0 or min(sides) >= 0:
                lines.add(frozenset(k for k, side in enumerate(sides) if not side))
        good += len(lines) == len(one.judge.facets)
    return seen(good == len(sets), f"{good} of {len(sets)} sets")


def all_triples_cost() -> Seen:
    """C(N, 3) planes with N substitutions each."""
    cost = {n: math.comb(n, 3) * n for n in (8, 16, 51)}
    words = ", ".join(f"{n} points: {math.comb(n, 3):,} planes, {cost[n]:,} substitutions" for n in cost)
    return seen(cost[16] > 2**3 * cost[8], words)


def few_points() -> Seen:
    """One, two and three points."""
    hulls = [convex_hull([(1, 2, 3), (4, 0, 1), (0, 5, 5)][:n]) for n in (1, 2, 3)]
    good = [(h.status, h.dimension, len(h.vertices)) for h in hulls]
    return seen(good == [("determined", k, k + 1) for k in range(3)], "a point, a segment, a triangle")


def equation(number: str) -> Seen:
    """An equation as printed, against what it is to be, for points at random."""
    good = all(_EQUATIONS[number](p, q, r) for p, q, r in triples())
    return seen(good, "exactly, for six triples of points")


def _three_point_one(p: Point, q: Point, _: Point) -> bool:
    return _upright(p, q, 0, 1)


def _upright(p: Point, q: Point, u: int, v: int) -> bool:
    """(v2 - v1) U + (u1 - u2) V + (u2 - u1) v1 + (v1 - v2) u1 = 0 holds at both points and moved off the line fails."""
    u1, v1, u2, v2 = p[u], p[v], q[u], q[v]

    def left(a: int, b: int) -> int:
        return (v2 - v1) * a + (u1 - u2) * b + (u2 - u1) * v1 + (v1 - v2) * u1

    apart = (v2 - v1, u1 - u2)
    return left(u1, v1) == left(u2, v2) == 0 and (apart == (0, 0) or left(u1 + apart[0], v1 + apart[1]) != 0)


def _three_point_four(p: Point, q: Point, r: Point) -> bool:
    return plane_as_printed(p, q, r) == through(p, q, r)


def plane_as_printed(i: Point, j: Point, k: Point) -> Plane:
    """(3.4) as page 15 prints it."""
    (xi, yi, zi), (xj, yj, zj), (xk, yk, zk) = i, j, k
    a = yi * zj + yj * zk + zi * yk - yk * zj - yi * zk - yj * zi
    b = xk * zj + xi * zk + xj * zi - xi * zj - xj * zk - xk * zi
    c = xi * yj + xj * yk + yi * xk - yj * xk - xi * yk - xj * yi
    d = xk * yj * zi + yk * zj * xi + xj * yi * zk - xj * yk * zi - yi * zj * xk - xi * yj * zk
    return a, b, c, d


def _three_point_five(k: Point, m: Point, _: Point) -> bool:
    def left(x: int, y: int) -> int:
        return (k[1] - m[1]) * x + (m[0] - k[0]) * y + (k[0] - m[0]) * m[1] + (m[1] - k[1]) * m[0]

    normal = (k[1] - m[1], m[0] - k[0])
    return left(k[0], k[1]) == left(m[0], m[1]) == 0 and left(k[0] + normal[0], k[1] + normal[1]) != 0


_EQUATIONS = {
    "3.1": _three_point_one,
    "3.2": lambda p, q, _: _upright(p, q, 0, 2),
    "3.3": lambda p, q, _: _upright(p, q, 1, 2),
    "3.4": _three_point_four,
    "3.5": _three_point_five,
}

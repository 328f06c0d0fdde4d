"""Claims of chapter 2: convex combinations, supporting planes, vertices, and the older ways to a hull.

The older ways are made here for small sets: all planes of three points and all lines of two, and a plane or a line
that is turned about points and edges.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations, permutations, product

from modern.claims.register import CONDITION, FAILS, HOLDS, Seen, seen
from modern.claims.sampled_sets import Plane, Point, SampledSet, sampled_sets, through, value
from modern.claims.thesis.chapter3_equations import COUNT, lowest_terms, points_of
from modern.exact_hull import exact_hull
from modern.geometry.vectors import cross, dot, minus


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


def _supporting(sets: tuple[SampledSet, ...], dimension: int) -> Seen:
    """Three points on it that are not collinear, or two that are distinct, and none beyond."""
    good = looked = 0
    for one in sets:
        for facet in one.judge.facets:
            values = [value(facet.plane, point) for point in one.points]
            on = [point for point, v in zip(one.points, values, strict=True) if not v]
            looked += 1
            good += max(values) == 0 and exact_hull(on).dimension == dimension - 1
    words = {2: "two distinct points", 3: "three noncollinear points"}[dimension]
    return seen(good == looked > 0, f"{good} of {looked} have {words} on them and none beyond")


def vertex_with_minus() -> Seen:
    """The middle of three points in line: by the printed signs no two points give it, whatever lambda is.

    lambda follows from the coordinate x, which differs in the three; so every ordered pair has one at most.
    """
    points = points_of("middle.csv")
    middle = points[1]
    given = {"+": 0, "-": 0}
    for p, q in permutations(points, 2):
        share = Fraction(middle[0] - p[0], q[0] - p[0])
        for sign, factor in (("+", 1), ("-", -1)):
            right = all((1 - share) * p[k] + factor * share * q[k] == middle[k] for k in (1, 2))
            given[sign] += 0 < share < 1 and right
    wrong = 1 not in exact_hull(points).vertices and given == {"+": 2, "-": 0}
    words = f"pairs that give {middle}: {given['+']} with a plus, {given['-']} with the printed minus"
    return Seen(FAILS if wrong else HOLDS, words)


def vertex_of_the_hull() -> Seen:
    """(1, 1) in the triangle (0, 0), (3, 0), (0, 3): between no two of the four points, yet no vertex."""
    points = [(0, 0, 0), (3, 0, 0), (0, 3, 0), (1, 1, 0)]
    between = [(p, q) for p, q in combinations(points[:3], 2) if not any(cross(minus(q, p), minus(points[3], p)))]
    good = not between and 3 not in exact_hull(points).vertices
    return Seen(CONDITION if good else FAILS, "(1, 1) of that triangle is on no line of two of the others")


def vertex_in_space(count: str = COUNT) -> Seen:
    """With a plus for the minus: between no two points of the hull, by lines through each point and the others.

    A point is between two points of the hull if and only if the hull without it holds it.  Among the given points
    alone the inside of a tetrahedron lies between no two.
    """
    good = []
    for one in sampled_sets(3, int(count)):
        for k, point in enumerate(one.points):
            rest = exact_hull([p for p in one.points if p != point])
            held = rest.dimension == 3 and max(value(f.plane, point) for f in rest.facets) <= 0
            good.append(held == (k not in one.judge.vertices))
    points = [(0, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 4), (1, 1, 1)]
    between = [1 for p, q in combinations(points[:4], 2) if not any(cross(minus(q, p), minus(points[4], p)))]
    alone = not between and 4 not in exact_hull(points).vertices
    words = f"{sum(good)} of {len(good)} points; (1, 1, 1) in a tetrahedron is between no two of the given points"
    return Seen(CONDITION if all(good) and alone else FAILS, words)


def rotations(kind: str, count: str = COUNT) -> Seen:
    """Planes turned about points and edges, ``lines`` in a plane about points: they hold what the judge's do."""
    good = []
    for one in sampled_sets(2 if kind == "lines" else 3, int(count)):
        wanted = {_on(one.points, facet.plane) for facet in one.judge.facets}
        good.append((_turned_lines(one) if kind == "lines" else _turned_planes(one.points)) == wanted)
    return seen(all(good), f"{sum(good)} of {len(good)} sets: all supporting {kind} are met, and no others")


def _on(points: Sequence[Point], plane: Plane) -> frozenset[int]:
    return frozenset(k for k, point in enumerate(points) if not value(plane, point))


def _turned(points: Sequence[Point], p: Point, q: Point) -> Plane:
    """The plane about the line of p and q that has turned until no point is beyond it."""
    best: Plane = (0, 0, 0, 0)
    for point in points:
        if not any(best[:3]) or value(best, point) > 0:
            best = through(p, q, point)
    return best


def _turned_planes(points: Sequence[Point]) -> set[frozenset[int]]:
    x, y, z = p = min(points)
    plane = _turned(points, p, (x, y, z + 1))
    found: set[frozenset[int]] = set()
    waiting = [plane]
    while waiting:
        plane = waiting.pop()
        on = sorted(_on(points, plane))
        flat = exact_hull([points[k] for k in on])
        if flat.dimension == 2 and frozenset(on) in found:
            continue
        if flat.dimension == 2:
            found.add(frozenset(on))
        ring = [points[on[k]] for k in (flat.polygon if flat.dimension == 2 else flat.vertices)]
        sides = zip(ring, (*ring[1:], ring[0]), strict=True)
        waiting += [_turned(points, *ends) for a, b in sides for ends in ((a, b), (b, a))]
    return found


def _turned_lines(one: SampledSet) -> set[frozenset[int]]:
    plane = one.judge.plane
    assert plane is not None
    found: set[frozenset[int]] = set()
    first = p = min(one.points)
    while not found or p != first:
        above = (p[0] + plane[0], p[1] + plane[1], p[2] + plane[2])
        line = _turned(one.points, p, above)
        found.add(_on(one.points, line))
        on = [one.points[k] for k in _on(one.points, line)]
        p = max(on, key=lambda q: dot(minus(q, p), minus(q, p)))
    return found


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
                planes.add(lowest_terms(plane if max(values) <= 0 else tuple(-x for x in plane)))  # type: ignore[arg-type]
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

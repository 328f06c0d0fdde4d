"""Checks of chapters 1 and 3: the result of the procedure, very small sets, and the equations (3.1) to (3.5).

The equations are transcribed as printed and compared with independent formulas over integers.
"""

from __future__ import annotations

from modern.claims.evidence import Check, claim, holds_if
from modern.claims.sampled_sets import CASES, Plane, Point, flat_and_spatial_sets, plane_through, random_triples
from modern.exact_hull import exact_hull
from modern.geometry.vectors import dot
from modern.port import convex_hull

Line = tuple[int, int, int]


@claim("thesis.1", "thesis.8", "thesis.86", "thesis.106", "thesis.179")
def procedure_against_judge(cases: int = CASES) -> Check:
    """Compare the procedure in exact arithmetic with the exact hull: vertices, other points and planes."""
    right = sets = 0
    for sampled in flat_and_spatial_sets(cases):
        sets += 1
        classification = (
            {*sampled.hull.vertices},
            {*sampled.hull.boundary},
            {*sampled.hull.inside},
            len(sampled.hull.faces),
        )
        right += classification == (
            {*sampled.judge.vertices},
            {*sampled.judge.boundary},
            {*sampled.judge.inside},
            len(sampled.judge.facets),
        )
    message = f"in exact arithmetic {right} of {sets} sets agree with the exact hull"
    return holds_if(right == sets, message, conditional=True)


@claim("thesis.6")
def reversed_order(cases: int = CASES) -> Check:
    """Check that the exact hull does not depend on the order of the points."""
    same = [
        {sampled.points[k] for k in sampled.judge.vertices}
        == {sampled.points[::-1][k] for k in exact_hull(sampled.points[::-1]).vertices}
        for sampled in flat_and_spatial_sets(cases)
    ]
    return holds_if(all(same), f"{sum(same)} of {len(same)} sets have the same vertices when their points are reversed")


@claim("thesis.7", "thesis.48")
def collinear_points() -> Check:
    """Check the two ends and the two equations of points on each of five lines."""
    passed = 0
    lines: tuple[Point, ...] = ((1, 0, 0), (0, 2, 0), (0, 0, 3), (0, 1, -2), (3, -1, 2))
    for x, y, z in lines:
        points = [(1 + k * x, 2 + k * y, 3 + k * z) for k in (2, 0, -3, 5, 1)]
        hull = convex_hull(points)
        passed += hull.dimension == 1 and {*hull.vertices} == {2, 3}
        passed += all(not dot(tuple(map(int, e[:3])), p) + int(e[3]) for e in hull.lines for p in points)  # type: ignore[arg-type]
    return holds_if(passed == 2 * len(lines), f"{passed // 2} of {len(lines)} lines have the right ends and equations")


@claim("thesis.32", "thesis.270")
def few_points() -> Check:
    hulls = [convex_hull([(1, 2, 3), (4, 0, 1), (0, 5, 5)][:n]) for n in (1, 2, 3)]
    outcomes = [(h.status, h.dimension, len(h.vertices)) for h in hulls]
    message = "the hulls are a point, a segment and a triangle"
    return holds_if(outcomes == [("determined", k, k + 1) for k in range(3)], message)


@claim("thesis.211", "thesis.46")
def first_two_points() -> Check:
    """Check that the first two points are the largest and the smallest in x, or in y if all x are equal, or in z."""
    base = [(3, 1), (-2, 5), (4, 0), (0, 2), (4, 4)]
    sets = {
        0: [(a, b, (3 * a + b) % 5) for a, b in base],
        1: [(7, b, (2 * a + b) % 7) for a, b in base],
        2: [(7, -1, a + 5 * b) for a, b in base],
    }
    checks = []
    for axis, points in sets.items():
        hull = convex_hull(points, history=True)
        first, second, *_ = hull.history[0].added if hull.history else hull.vertices
        values = [point[axis] for point in points]
        checks.append((points[first][axis], points[second][axis]) == (max(values), min(values)))
        checks.append(max(values) > min(values))
    message = "the first two points are extreme in x, in y if all x are equal, or in z if all y are equal too"
    return holds_if(all(checks), message)


@claim("thesis.40", number="3.1")
@claim("thesis.41", number="3.2")
@claim("thesis.43", number="3.3")
@claim("thesis.51", number="3.4")
@claim("thesis.62", number="3.5")
def equation(number: str) -> Check:
    """Check an equation as printed on random points."""
    passed = all(_EQUATIONS[number](p, q, r) for p, q, r in random_triples())
    return holds_if(passed, "the equation agrees exactly for six triples of points")


def _three_point_one(p: Point, q: Point, _: Point) -> bool:
    return _upright(p, q, 0, 1)


def _upright(p: Point, q: Point, u: int, v: int) -> bool:
    """Return True if the line as printed is 0 at both points, and not 0 at a point moved off the line."""
    return _through_both(line_as_printed(p[u], p[v], q[u], q[v]), (p[u], p[v]), (q[u], q[v]))


def line_as_printed(u1: int, v1: int, u2: int, v2: int) -> Line:
    """Return (3.1), (3.2) or (3.3): (v2 - v1) U + (u1 - u2) V + (u2 - u1) v1 + (v1 - v2) u1 = 0."""
    return v2 - v1, u1 - u2, (u2 - u1) * v1 + (v1 - v2) * u1


def _through_both(line: Line, p: tuple[int, int], q: tuple[int, int]) -> bool:
    a, b, c = line

    def left(u: int, v: int) -> int:
        return a * u + b * v + c

    return left(*p) == left(*q) == 0 and (p == q or left(p[0] + a, p[1] + b) != 0)


def _three_point_four(p: Point, q: Point, r: Point) -> bool:
    return plane_as_printed(p, q, r) == plane_through(p, q, r)


def plane_as_printed(i: Point, j: Point, k: Point) -> Plane:
    """Return equation (3.4) as page 15 prints it."""
    (xi, yi, zi), (xj, yj, zj), (xk, yk, zk) = i, j, k
    a = yi * zj + yj * zk + zi * yk - yk * zj - yi * zk - yj * zi
    b = xk * zj + xi * zk + xj * zi - xi * zj - xj * zk - xk * zi
    c = xi * yj + xj * yk + yi * xk - yj * xk - xi * yk - xj * yi
    d = xk * yj * zi + yk * zj * xi + xj * yi * zk - xj * yk * zi - yi * zj * xk - xi * yj * zk
    return a, b, c, d


def _three_point_five(k: Point, m: Point, _: Point) -> bool:
    return _through_both(line_of_page_19(k, m), k[:2], m[:2])


def line_of_page_19(k: Point, m: Point) -> Line:
    """Return equation (3.5) as page 19 prints it."""
    return k[1] - m[1], m[0] - k[0], (k[0] - m[0]) * m[1] + (m[1] - k[1]) * m[0]


_EQUATIONS = {
    "3.1": _three_point_one,
    "3.2": lambda p, q, _: _upright(p, q, 0, 2),
    "3.3": lambda p, q, _: _upright(p, q, 1, 2),
    "3.4": _three_point_four,
    "3.5": _three_point_five,
}

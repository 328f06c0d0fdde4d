"""Checks of chapters 1 and 3: the result of the procedure, very small sets, and the equations (3.1) to (3.5).

The equations are transcribed as printed and compared with independent formulas over integers.
"""

from collections.abc import Sequence
from itertools import product
from random import Random
from typing import Any

from modern.claims.evidence import Check, Generator, claim, identity, search, searched
from modern.claims.hulls import convex_hull, exact_hull
from modern.claims.sampled_sets import BOTH, CASES, SETS, Plane, Point, flat_and_spatial_sets, plane_value, sampled_sets
from modern.exact_hull import ExactHull
from modern.geometry.hull import Hull
from modern.geometry.vectors import cross


def procedure_against_judge(dimensions: Sequence[int], cases: int = CASES) -> Check:
    """Check that the procedure in exact arithmetic finds the vertices, other points and planes of the exact hull."""
    sets = [sampled for dimension in dimensions for sampled in sampled_sets(dimension, cases)]
    same = [parts(sampled.points, sampled.hull) == parts(sampled.points, sampled.judge) for sampled in sets]
    message = f"in exact arithmetic, the hulls of {sum(same)} of {len(same)} sets agree with the exact hulls"
    return searched(BOTH if len(dimensions) == 2 else SETS[dimensions[0]], len(same), same, message)


def parts(points: Sequence[Point], hull: Hull | ExactHull) -> tuple[object, ...]:
    """Return the class of each point and the points on each plane or line, with the plane that contains a flat set."""
    planes = [face.lowest for face in hull.faces] if isinstance(hull, Hull) else [f.plane for f in hull.facets]
    # The exact hull represents a line of a flat set by the plane through the line perpendicular to the set.
    flat: list[Plane] = [tuple(map(int, hull.plane))] if hull.plane else []  # type: ignore[list-item]
    on = [[k for k, point in enumerate(points) if not plane_value(plane, point)] for plane in (*planes, *flat)]
    return {*hull.vertices}, {*hull.boundary}, {*hull.inside}, sorted(on)


@claim("thesis.6", full=400)
def other_orders(cases: int = CASES) -> Check:
    same = []
    for sampled in flat_and_spatial_sets(cases):
        orders = [sampled.points, sampled.points[::-1], sorted(sampled.points, key=lambda p: (*p[1:], p[0]))]
        hulls = [(points, exact_hull(points)) for points in orders]
        first, *others = (({p[k] for k in hull.vertices}, {facet.plane for facet in hull.facets}) for p, hull in hulls)
        same += [hull == first for hull in others]
    return searched(BOTH, 2 * cases, same, f"{sum(same)} of {len(same)} other orders of the points give the same hull")


def _draw_line(random: Random) -> tuple[Point, ...]:
    x, y, z, a, b, c = (random.randint(-3, 3) for _ in range(6))
    return tuple((x + k * a, y + k * b, z + k * c) for k in random.sample(range(-6, 7), random.randint(2, 7)))


LINES: Generator[tuple[Point, ...]] = Generator(
    "2 to 7 points of a line with a direction from -3 to 3", 1620, _draw_line, lambda p: len({*p}) == len(p) > 1
)


@claim("thesis.1", "thesis.7", "thesis.48", full=2_000)
def collinear_points(cases: int = 8) -> Check:
    def ends_and_equations(points: tuple[Point, ...]) -> bool:
        hull = convex_hull(points)
        equations: list[Plane] = [tuple(map(int, line)) for line in hull.lines]  # type: ignore[misc]
        on = not any(plane_value(equation, p) for equation in equations for p in points)
        # Two planes that are not the same intersect in the line.
        two_planes = len(equations) == 2 and any(cross(equations[0][:3], equations[1][:3]))
        ends = [{points[k] for k in vertices} for vertices in (hull.vertices, exact_hull(points).vertices)]
        return on and two_planes and ends == [{min(points), max(points)}] * 2

    message = "for each set of collinear points the procedure finds its two ends, and two planes that meet in its line"
    return search(LINES, ends_and_equations, cases, message)


_CUBE: list[Point] = [(x, y, z) for x, y, z in product(range(-1, 2), repeat=3)]
FEW: Generator[tuple[Point, ...]] = Generator(
    "1 to 12 points, coordinates from -1 to 1", 27, lambda random: tuple(random.sample(_CUBE, random.randint(1, 12)))
)


@claim("thesis.1", "thesis.32", full=2_000)
def few_points(cases: int = 24) -> Check:
    def is_right(points: tuple[Point, ...]) -> bool:
        hull, judge = convex_hull(points), exact_hull(points)
        # The exact hull of collinear points has no planes.
        same = judge.dimension == 1 or parts(points, hull) == parts(points, judge)
        return hull.determined and same and {*hull.vertices} == {*judge.vertices}

    message = "the procedure finds the vertices of all sets, and the planes or lines of all sets that are not collinear"
    return search(FEW, is_right, cases, message)


@claim("thesis.138", "thesis.211", "thesis.53", full=400)
def first_two_points(cases: int = CASES) -> Check:
    checks = []
    for sampled in flat_and_spatial_sets(cases):
        for axis in range(3):
            # The coordinates before the axis are made equal.
            points = [*dict.fromkeys((*(0,) * axis, *point[axis:]) for point in sampled.points)]
            values = [point[axis] for point in points]
            if min(values) < max(values):
                hull = convex_hull(points, history=True)
                first, second, *_ = hull.history[0].added if hull.history else hull.vertices
                checks.append((values[first], values[second]) == (max(values), min(values)))
    message = "the first two points are extreme in x, in y if all x are equal, or in z if all y are equal too"
    return searched(BOTH, 2 * cases, checks, message)


def line_as_printed(u1: int, v1: int, u2: int, v2: int) -> tuple[int, int, int]:
    """Return the coefficients that equations (3.1), (3.2), (3.3) and (3.5) all have, in two coordinates U and V."""
    return v2 - v1, u1 - u2, (u2 - u1) * v1 + (v1 - v2) * u1


@claim("thesis.40", "thesis.41", "thesis.43", "thesis.62")
@claim("thesis.63", conclusion="; a triangle has one corner off each such line, so no corners are on opposite sides")
def equation_of_line(conclusion: str = "") -> Check:
    def difference(u1: int, v1: int, u: int, v: int, along: int, right: int) -> int:
        a, b, c = line_as_printed(u1, v1, u1 + u, v1 + v)
        return a * (u1 + along * u + right * v) + b * (v1 + along * v - right * u) + c - right * (u * u + v * v)

    message = "in the plane of its two coordinates, the equation is 0 exactly on the line through the two points"
    argument = "Its value at a point is the distance to the right of the line times the distance of the two points."
    return identity(difference, (2, 2, 2, 2, 1, 1), message + conclusion, argument)


def with_0(point: Sequence[Any], axis: int) -> tuple[Any, Any, Any]:
    """Return a point or a polynomial point with 0 in place of one coordinate."""
    x, y, z = (0 if k == axis else number for k, number in enumerate(point))
    return x, y, z


def plane_as_printed(i: Point, j: Point, k: Point) -> Plane:
    """Return equation (3.4) as page 15 prints it."""
    (xi, yi, zi), (xj, yj, zj), (xk, yk, zk) = i, j, k
    a = yi * zj + yj * zk + zi * yk - yk * zj - yi * zk - yj * zi
    b = xk * zj + xi * zk + xj * zi - xi * zj - xj * zk - xk * zi
    c = xi * yj + xj * yk + yi * xk - yj * xk - xi * yk - xj * yi
    d = xk * yj * zi + yk * zj * xi + xj * yi * zk - xj * yk * zi - yi * zj * xk - xi * yj * zk
    return a, b, c, d

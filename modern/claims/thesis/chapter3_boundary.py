"""Checks of the steps of chapter 3 that project points, find boundary points and remove duplicate equations.

A *used* point is a point that the procedure has added to the hull under construction; it need not be a vertex at the
end. *Eliminated* points lie inside that hull.
"""

from collections.abc import Sequence
from functools import partial
from random import Random

from modern.claims.evidence import Check, Generator, claim, exhibited, searched, slip
from modern.claims.hulls import convex_hull, exact_hull
from modern.claims.register import statements_of
from modern.claims.sampled_sets import CASES, SETS, Point, added_points, plane_value, sampled_sets
from modern.claims.thesis.chapter3_equations import parts, with_0
from modern.claims.thesis.identities import coordinate_planes
from modern.exact_hull import ExactHull, Facet
from modern.geometry.vectors import cross, dot, minus

# A triangle, and a point on one of its sides that the procedure adds to the hull under construction.
_POINT_ON_A_SIDE: list[Point] = [(3, 0, 0), (4, 4, 0), (4, 2, 0), (4, 3, 0)]
# A pyramid whose square base contains nine of the points.
PYRAMID: list[Point] = [(x, y, 0) for x in (0, 1, 2) for y in (0, 1, 2)] + [(1, 1, 2)]
# A set in space for which the procedure uses two points that are not vertices of the last hull.
_USED_POINTS: list[Point] = [(3, 0, 0), (3, 2, 1), (0, 2, 0), (0, 0, 0), (3, 0, 2), (3, 1, 1), (0, 1, 0)]


@claim("thesis.81")
def used_boundary_point() -> Check:
    points = _POINT_ON_A_SIDE
    used = sorted(added_points(convex_hull(points, history=True)))
    on_one = [points[k] for k in used if len(_facets_at(points[k], exact_hull(points))) == 1]
    return exhibited(on_one, f"added points that are on only one line of the last hull: {', '.join(map(str, on_one))}")


def _facets_at(point: Point, judge: ExactHull) -> list[Facet]:
    return [facet for facet in judge.facets if not plane_value(facet.plane, point)]


def _draw_lattice(random: Random, depth: int) -> tuple[Point, ...]:
    lattice = [(x, y, z) for x in range(4) for y in range(4 - (depth > 1)) for z in range(depth)]
    return tuple(random.sample(lattice, random.randint(6, 14)))


# Sets with many points on the same lines and planes, by dimension.
LATTICE_SETS: dict[int, Generator[tuple[Point, ...]]] = {
    2: Generator("subsets of a lattice of 4 x 4 points", 85, partial(_draw_lattice, depth=1)),
    3: Generator("subsets of a lattice of 4 x 3 x 3 points", 34, partial(_draw_lattice, depth=3), SETS[3].accepts),
}


@claim("thesis.80", "thesis.221", "thesis.223", dimension=2, full=400)
@claim("thesis.102", "thesis.229", "thesis.256", dimension=3, full=400)
def end_of_the_procedure(dimension: int, cases: int = 2) -> Check:
    outcomes, removed = [], [0, 0, 0]
    for points in (*LATTICE_SETS[dimension].cases(cases), _POINT_ON_A_SIDE if dimension == 2 else _USED_POINTS):
        hull, judge = convex_hull(points, history=True), exact_hull(points)
        used = {*added_points(hull)}
        remaining = {*range(len(points))} - used - {k for stage in hull.history for k in stage.struck}
        outcomes.append(remaining <= {*judge.boundary} and {*hull.vertices} == {*judge.vertices} <= used)
        outcomes.append(len({face.lowest for face in hull.faces}) == len(hull.faces) == len(judge.facets))
        removed[0] += len(remaining)
        removed[1] += len(used) - len(hull.vertices)
        removed[2] += len(hull.history[-1].equations) - len(hull.faces)
    remain, added, repeats = removed
    message = f"in {cases} drawn sets and a fixed one, the procedure adds all vertices; points that it neither adds "
    message += f"nor eliminates ({remain}) are on the boundary; at the end, it removes added points that are no "
    message += f"vertices ({added}), and duplicate equations ({repeats})"
    return searched(LATTICE_SETS[dimension], cases, [*outcomes, *removed], message)


@claim("thesis.85", full=400)
def duplicate_lines(cases: int = 3 * CASES) -> Check:
    outcomes = []
    for points in (*LATTICE_SETS[2].cases(cases), _POINT_ON_A_SIDE):
        hull = convex_hull(points, history=True)
        sides = [{*added_points(hull)} & {*on_line(points, *face.polygon)} for face in hull.faces]
        last = hull.history[-1].equations
        outcomes += [sum({*ends} <= side for ends in last) >= 2 for side in sides if len(side) > 2]
    message = f"{sum(outcomes)} of {len(outcomes)} sides with three or more added points, in {cases} drawn sets and a "
    message += "fixed one, have two or more equations"
    return searched(LATTICE_SETS[2], cases, outcomes, message)


def on_line(points: Sequence[Point], a: int, b: int) -> list[int]:
    """Return the indices of the points on the line through two of them."""
    p, q = points[a], points[b]
    return [k for k, x in enumerate(points) if not any(cross(minus(q, p), minus(x, p)))]


@claim("thesis.104", "thesis.105", full=300)
def planes_at_vertex(cases: int = CASES) -> Check:
    checks = []
    for points in (*LATTICE_SETS[3].cases(cases), PYRAMID):
        judge = exact_hull(points)
        checks += [(len(_facets_at(p, judge)) >= 3) == (k in judge.vertices) for k, p in enumerate(points)]
    message = f"{sum(checks)} of {len(checks)} points of {cases} drawn sets and a pyramid: a vertex lies in three or "
    message += "more planes, any other point in two or fewer"
    return searched(LATTICE_SETS[3], cases, checks, message)


@claim("thesis.231")
def used_points_in_planes() -> Check:
    points = _USED_POINTS
    hull, judge = convex_hull(points, history=True), exact_hull(points)
    used = sorted({*hull.history[0].added} - {*judge.vertices})
    planes = {points[k]: len(_facets_at(points[k], judge)) for k in used}
    passed = {*planes.values()} == {1, 2} and {*hull.vertices} == {*judge.vertices}
    message = ", ".join(f"{n} for {point}" for point, n in planes.items())
    return exhibited(passed, f"number of planes of the last hull that contain a vertex of H_1: {message}")


@claim("thesis.230", full=400)
def boundary_points_on_edges(cases: int = 5) -> Check:
    checks, in_one_plane = [], 0
    for points in LATTICE_SETS[3].cases(cases):
        judge = exact_hull(points)
        for k, point in enumerate(points):
            on = _facets_at(point, judge)
            edges = [{*on[0].polygon} & {*on[1].polygon}] if len(on) == 2 else judge.edges()
            ways = [[minus(point, points[j]) for j in edge] for edge in edges]
            between = any(not any(cross(u, v)) and dot(u, v) < 0 for u, v in ways)
            in_one_plane += len(on) == 1 and not between
            checks += [between and k not in judge.vertices] if len(on) == 2 else []
    message = f"{sum(checks)} of {len(checks)} points in exactly two planes lie between the ends of their common edge"
    check = searched(LATTICE_SETS[3], cases, checks, message)
    return check.unless(in_one_plane, "a point in one plane only, which is not between the ends of any edge")


@claim("thesis.274", full=400)
def hull_of_projection(cases: int = CASES) -> Check:
    checks = []
    for sampled in sampled_sets(2, cases):
        plane = sampled.judge.plane
        assert plane is not None
        for axis in (k for k in range(3) if plane[k]):
            image = [with_0(point, axis) for point in sampled.points]
            checks.append(parts(sampled.points, sampled.judge) == parts(image, exact_hull(image)))
    message = f"{sum(checks)} of {len(checks)} projections keep the vertices, boundary and inside points, and lines"
    return searched(SETS[2], cases, checks, message)


@claim("thesis.273")
def sum_that_ends_with_plus() -> Check:
    (row,) = (row for row in statements_of("thesis") if row.id == "thesis.273")
    *_, last = row.words.partition(r"\neq")[0].split("+")
    right = coordinate_planes().check().holds
    message = "nothing follows the last plus; the product D_0 D_C would be 0, because D_C is 0 for a coordinate plane"
    return slip(last.strip(), right, "a sum without the plus, or with D_0 D_C", message)

"""Checks of the steps of chapter 3: the first points, inside points, new planes and boundary points.

Each step that fails as printed has a counterexample in ``transcripts/counterexamples``.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from modern.claims.evidence import Check, claim, holds_if, refuted
from modern.claims.sampled_sets import (
    CASES,
    Approximation,
    Point,
    SampledSet,
    counterexample_points,
    flat_and_spatial_sets,
    plane_through,
    plane_value,
    random_triples,
    reduced_plane,
    sampled_sets,
)
from modern.claims.thesis.chapter3_equations import plane_as_printed
from modern.exact_hull import exact_hull
from modern.geometry.vectors import cross, dot, minus
from modern.port import convex_hull
from modern.port.arithmetic import moments

# A triangle, and a point on one of its sides that the procedure uses.
_POINT_ON_A_SIDE: list[Point] = [(3, 0, 0), (4, 4, 0), (4, 2, 0), (4, 3, 0)]
# A pyramid over nine points of a square.
PYRAMID: list[Point] = [(x, y, 0) for x in (0, 1, 2) for y in (0, 1, 2)] + [(1, 1, 2)]


def all_hold(cases: Iterator[bool] | list[bool], message: str) -> Check:
    """Return HOLDS if there are cases and all of them are true; the message starts with their number."""
    checks = list(cases)
    return holds_if(bool(checks) and all(checks), f"{sum(checks)} of {len(checks)} {message}")


@claim("thesis.42", which="1")
@claim("thesis.44", which="2")
@claim("thesis.45", which="3")
def line_pairs(which: str) -> Check:
    """Check that the two equations of a line of each kind hold at its points and have independent normals."""
    ends = {"1": ((1, 2, 3), (4, 0, 5)), "2": ((1, 2, 3), (1, 0, 5)), "3": ((1, 2, 3), (1, 2, 5))}[which]
    lines = convex_hull(ends).lines
    planes = [(int(a), int(b), int(c), int(d)) for a, b, c, d in lines]
    on = all(plane_value(plane, p) == 0 for plane in planes for p in ends)
    independent = any(cross(planes[0][:3], planes[1][:3]))
    return holds_if(on and independent, "both equations hold at the two points, and their normals are independent")


@claim("thesis.49")
def third_point(cases: int = CASES) -> Check:
    """Check that no point is farther from the line of the first two points than the third point of H_1."""
    return all_hold(list(_farthest(flat_and_spatial_sets(cases))), "sets: no point is farther than the third of H_1")


def _farthest(sets: tuple[SampledSet, ...]) -> Iterator[bool]:
    for sampled in sets:
        p, q, r = (sampled.points[k] for k in sampled.hull.history[0].added[:3])
        areas = [_square(cross(minus(q, p), minus(x, p))) for x in (*sampled.points, r)]
        yield areas[-1] == max(areas)


def _square(u: Point) -> int:
    return dot(u, u)


@claim("thesis.50")
def value_v() -> Check:
    """Check that V by the formula of the proof is the square of a vector product, and by the display of our text is
    not.
    """
    right = all(
        sum(o * o for o in moments(x, p, q)) == _square(cross(minus(q, p), minus(x, p))) for p, q, x in random_triples()
    )
    p, q, x = counterexample_points("v_as_our_text.csv")
    on_line = not any(cross(minus(q, p), minus(x, p)))
    (x1, y1, z1), (x2, y2, z2), (xi, yi, zi) = p, q, x
    # The display of page 14 in our text: the first and third factors have the index 1 for i.
    as_text = ((y2 - y1) * (z2 - z1) - (z2 - zi) * (y2 - y1)) ** 2
    as_text += ((z2 - z1) * (x2 - x1) - (x2 - xi) * (z2 - z1)) ** 2
    as_text += ((x2 - x1) * (y2 - y1) - (y2 - yi) * (x2 - x1)) ** 2
    message = (
        f"with y_i and z_i V is d squared times D squared; as displayed in our text it is {as_text} at a "
        "point of the line"
    )
    return holds_if(right and on_line and as_text, message, conditional=True)


@claim("thesis.52")
def coplanarity_test(cases: int = CASES) -> Check:
    """Check that all values of (3.4) are 0 in the flat sets and in no others."""
    checks = []
    for sampled in flat_and_spatial_sets(cases):
        first = plane_as_printed(*(sampled.points[k] for k in sampled.hull.history[0].added[:3]))
        checks.append(any(plane_value(first, point) for point in sampled.points) == (not sampled.flat))
    return all_hold(checks, "sets: all values of (3.4) are 0 if and only if the set is flat")


@claim("thesis.53")
def common_first_steps(cases: int = CASES) -> Check:
    """Check that flat sets and sets with one more point outside their plane start with the same three points."""
    checks = []
    for sampled in sampled_sets(2, cases):
        # Scale the set so that its mean moved by one unit is an integer point near the plane.
        size = 9 * len(sampled.points)
        flat = [(size * x, size * y, size * z) for x, y, z in sampled.points]
        x, y, z = (9 * sum(point[axis] for point in sampled.points) for axis in range(3))
        hulls = [convex_hull(points, history=True) for points in (flat, [*flat, (x, y, z + 1)])]
        firsts = [[hull.points[k] for k in hull.history[0].added[:3]] for hull in hulls]
        checks.append([hull.dimension for hull in hulls] == [2, 3] and firsts[0] == firsts[1])
    return all_hold(checks, "sets start with the same three points; the plane of these decides which case applies")


@claim("thesis.213", "thesis.57", "thesis.58", "thesis.59", "thesis.254")
def classification_by_signs(cases: int = CASES) -> Check:
    """Check the classification into vertices, boundary and inside points by the signs of the exact equations."""
    checks = []
    some_boundary = bool(exact_hull([(0, 0, 0), (2, 0, 0), (1, 0, 0), (0, 2, 0)]).boundary)
    for sampled in flat_and_spatial_sets(cases):
        for k, point in enumerate(sampled.points):
            largest = max(plane_value(facet.plane, point) for facet in sampled.judge.facets)
            checks.append(largest <= 0 and (largest == 0) == (k not in sampled.judge.inside))
    message = f"{sum(checks)} of {len(checks)} points are classified correctly; the midpoint of a side is not a vertex"
    return holds_if(all(checks) and some_boundary, message)


@claim("thesis.215", "thesis.61", "thesis.63", "thesis.64", "thesis.88")
def mean_of_first_hull(cases: int = CASES) -> Check:
    """Check that the equations of H_1 are those of the exact hull and are negative at the mean of its points."""
    checks = []
    for sampled in flat_and_spatial_sets(cases):
        first = sampled.stages()[0]
        judge = exact_hull([sampled.points[k] for k in first.vertices])
        x, y, z = (sum(sampled.points[k][axis] for k in first.vertices) for axis in range(3))
        vertex_count = len(first.vertices)
        checks.append({reduced_plane(plane) for plane in first.equations} == {f.plane for f in judge.facets})
        checks += [dot(f.plane[:3], (x, y, z)) + vertex_count * f.plane[3] < 0 for f in judge.facets]
    return all_hold(checks, "equations are exact and negative at C")


@claim("thesis.67")
def outside_convention() -> Check:
    """Check a point that is inside the line x = 0 and by the printed definition also outside it."""
    ((x, _, _),) = counterexample_points("both_sides.csv")
    message = f"at the point x is {x}: by the printed definition it is both inside and outside the line x = 0"
    return refuted(x < 0, message)


@claim("thesis.80", dimension="2")
@claim("thesis.102", dimension="3")
def remaining_points(dimension: str) -> Check:
    """Check that the points of a grid that are neither eliminated nor used lie on the boundary."""
    sizes = (5, 5, 1) if dimension == "2" else (3, 3, 3)
    points = [(x, y, z) for x in range(sizes[0]) for y in range(sizes[1]) for z in range(sizes[2])]
    hull, judge = convex_hull(points, history=True), exact_hull(points)
    used = {k for stage in hull.history for k in stage.added}
    eliminated = {k for stage in hull.history for k in stage.struck}
    remaining = set(range(len(points))) - used - eliminated
    passed = (
        bool(remaining)
        and remaining <= {*judge.boundary}
        and eliminated == {*judge.inside}
        and {*judge.vertices} <= used
    )
    message = f"{len(remaining)} of {len(points)} points remain; all of them are on the boundary and none is a vertex"
    return holds_if(passed, message)


@claim("thesis.81")
def used_boundary_point() -> Check:
    """Check four points, one of which is used for a hull although it lies between two others."""
    points = _POINT_ON_A_SIDE
    hull = convex_hull(points, history=True)
    used = {k for stage in hull.history for k in stage.added}
    boundary_used = used & {*hull.boundary}
    message = f"points used that lie on one line only: {', '.join(str(points[k]) for k in sorted(boundary_used))}"
    return holds_if(bool(boundary_used), message)


@claim("thesis.82")
def between_by_distances() -> Check:
    """Check that sums of distances tell which of three collinear points lies between the others."""
    checks = []
    for a, b, c in ((0, 5, 2), (0, 2, 5), (5, 0, -3), (1, 0, 2)):
        between = _between(a, b, c, *(5 * abs(p - q) for p, q in ((b, a), (a, c), (b, c))))
        checks.append(between == sorted((a, b, c))[1])
    return all_hold(checks, "cases of points (3t, 4t) are decided correctly")


def _between(a: int, b: int, c: int, ab: int, ac: int, bc: int) -> int:
    return a if ab + ac - bc == 0 else b if ab + bc - ac == 0 else c


@claim("thesis.85")
def duplicate_lines() -> Check:
    """Check that a side with three used points has two equations before duplicates are removed."""
    points = _POINT_ON_A_SIDE
    hull = convex_hull(points, history=True)
    last = hull.history[-1].equations
    used = {k for stage in hull.history for k in stage.added}
    sides = [{k for k in used if _on_side(points, face.polygon, k)} for face in hull.faces]
    counted = [(len(side), sum(set(ends) <= side for ends in last)) for side in sides]
    passed = all(equations >= 2 for used_count, equations in counted if used_count >= 3)
    message = f"numbers of used points and of equations for each side: {counted}"
    return holds_if(passed and any(used_count >= 3 for used_count, _ in counted), message)


def _on_side(points: list[Point], ends: tuple[int, ...], k: int) -> bool:
    p, q = points[ends[0]], points[ends[1]]
    return not any(cross(minus(q, p), minus(points[k], p)))


@claim("thesis.87")
def fourth_point_by_largest() -> Check:
    """Check a tetrahedron whose fourth corner is on the negative side of the first three: the largest value U is 0."""
    points = counterexample_points("negative_side.csv")
    plane = plane_as_printed(*points[:3])
    values = [plane_value(plane, point) for point in points]
    text, listing = convex_hull(points, text=True, on_refusal="return"), convex_hull(points)
    wrong = max(values) == 0 and not text.determined and listing.determined
    message = (
        f"the values are {', '.join(map(str, values))}; the largest belongs to a point of the plane itself, "
        "but the listing finds the hull"
    )
    return refuted(wrong, message)


@claim("thesis.94", kind="counts")
@claim("thesis.95", kind="order")
@claim("thesis.199", kind="as_worded")
@claim("thesis.97", kind="pairs")
@claim("thesis.98", kind="names")
def visible_planes(kind: str, cases: int = CASES) -> Check:
    """Check how the planes that a new point is outside of are replaced.

    kind: ``counts`` of planes, ``pairs`` of planes with a common edge, the step ``as_worded``, the ``names`` MM,
    NN and KK of common points, or the ``order`` of the planes.
    """
    if kind == "order":
        return _order(cases)
    checks: list[bool] = []
    same_places = pairs = 0
    for sampled in sampled_sets(3, cases):
        for before, after in zip(sampled.stages(), sampled.stages()[1:], strict=False):
            point = sampled.points[after.vertices[-1]]
            # Page 31: the planes that the added point is outside of, and their pairs with a common edge.
            visible = [k for k, plane in enumerate(before.equations) if plane_value(plane, point) > 0]
            shared = list(_shared(before, visible))
            pairs += len(shared)
            same_places += sum(_same_places(before.defining[i], before.defining[m], edge) for i, m, edge in shared)
            if kind == "counts":
                added = len(after.equations) - len(before.equations)
                checks.append(added == 2 * len(visible) - 2 * len(shared))
            else:
                checks += [_separated(sampled.points, before, i, m, edge, point) for i, m, edge in shared]
    if kind == "names":
        message = f"in {same_places} of {pairs} pairs the two common points have the same positions among MM, NN and KK"
        return holds_if(pairs, message, conditional=same_places < pairs)
    if kind == "as_worded":
        return holds_if(all(checks), f"{len(checks)} pairs of planes i and m agree", conditional=True)
    return all_hold(
        checks,
        "stages have the expected number of planes"
        if kind == "counts"
        else "pairs: the third points are on opposite sides",
    )


def _shared(before: Approximation, visible: list[int]) -> Iterator[tuple[int, int, set[int]]]:
    for i, m in combinations(visible, 2):
        edge = set(before.defining[i]) & set(before.defining[m])
        if len(edge) == 2:
            yield i, m, edge


def _same_places(first_triple: tuple[int, ...], second_triple: tuple[int, ...], edge: set[int]) -> bool:
    return all(first_triple.index(k) == second_triple.index(k) for k in edge)


def _separated(points: tuple[Point, ...], before: Approximation, i: int, m: int, edge: set[int], new: Point) -> bool:
    p, q = (points[k] for k in edge)
    plane = plane_through(p, q, new)
    (first_corner,), (second_corner,) = (set(before.defining[k]) - edge for k in (i, m))
    return plane_value(plane, points[first_corner]) * plane_value(plane, points[second_corner]) < 0


def _order(cases: int) -> Check:
    same = reordered = sets = 0
    for sampled in sampled_sets(3, cases):
        text = convex_hull(sampled.points, text=True, on_refusal="return")
        if text.determined:
            sets += 1
            same += {f.lowest for f in text.faces} == {f.lowest for f in sampled.hull.faces}
            reordered += [f.lowest for f in text.faces] != [f.lowest for f in sampled.hull.faces]
    message = f"{same} of {sets} sets get the same planes, {reordered} of them in another order"
    return holds_if(same == sets, message, conditional=True)


@claim("thesis.96")
def without_constant_term() -> Check:
    """Check the centre of a cube away from the origin: without D it is outside a plane that it is inside of."""
    *corners, middle = counterexample_points("without_d.csv")
    planes = [facet.plane for facet in exact_hull(corners).facets]
    wrong = [plane for plane in planes if dot(plane[:3], middle) > 0 > plane_value(plane, middle)]
    return refuted(wrong, f"without D {len(wrong)} of {len(planes)} planes are positive at the centre")


@claim("thesis.103")
def duplicate_planes() -> Check:
    """Check that a pyramid over nine points of a square keeps one equation of each plane."""
    hull = convex_hull(PYRAMID, history=True)
    equation_count = len(hull.history[-1].equations)
    message = f"{equation_count} equations were made, and {len(hull.faces)} planes remain"
    return holds_if(len(hull.faces) == 5 < equation_count, message)


@claim("thesis.104")
@claim("thesis.105", kind="condition")
def planes_at_vertex(kind: str = "", cases: int = CASES) -> Check:
    """Check how many planes of the exact hull contain each point."""
    checks = []
    for points in (*(sampled.points for sampled in sampled_sets(3, cases)), tuple(PYRAMID)):
        judge = exact_hull(points)
        for k, point in enumerate(points):
            on = sum(not plane_value(facet.plane, point) for facet in judge.facets)
            checks.append((on >= 3) == (k in judge.vertices))
    message = (
        f"{sum(checks)} of {len(checks)} points: a vertex lies in three or more planes, any other point in two or fewer"
    )
    return holds_if(all(checks), message, conditional=kind)


@claim("thesis.223")
def duplicates_removed() -> Check:
    """Check a triangle with a used point on a side: three of four vertices and of four equations remain."""
    hull = convex_hull(_POINT_ON_A_SIDE, history=True)
    used = [k for stage in hull.history for k in stage.added]
    equation_count, kept_equations = len(hull.history[-1].equations), [face.lowest for face in hull.faces]
    passed = len(used) > len(hull.vertices) == 3 == len(set(kept_equations)) == len(kept_equations) < equation_count
    return holds_if(
        passed,
        f"{len(hull.vertices)} of {len(used)} used points remain, "
        f"and {len(kept_equations)} of {equation_count} equations",
    )


# A set in space for which the procedure uses a point that is not a vertex of the last hull.
_TWO_PLANES: list[Point] = [(2, 1, 1), (1, 1, 3), (0, 1, 3), (0, 0, 0), (0, 2, 3), (0, 0, 2), (0, 1, 2)]


@claim("thesis.231", "thesis.256")
def used_points_in_planes() -> Check:
    """Count the planes of the last hull that contain each used point that is not a vertex."""
    hull, judge = convex_hull(_TWO_PLANES, history=True), exact_hull(_TWO_PLANES)
    used = {k for stage in hull.history for k in stage.added} - {*judge.vertices}
    planes = {_TWO_PLANES[k]: sum(not plane_value(f.plane, _TWO_PLANES[k]) for f in judge.facets) for k in sorted(used)}
    passed = bool(planes) and {*planes.values()} <= {1, 2} and {*hull.vertices} == {*judge.vertices}
    return holds_if(passed, ", ".join(f"{point} is in planes of the last hull: {n}" for point, n in planes.items()))


@claim("thesis.230")
def boundary_points_on_edges() -> Check:
    """Check that surface points of a pyramid in two planes lie between the ends of the common edge."""
    points = [(x, y, 0) for x in (0, 2, 4) for y in (0, 2, 4)] + [(2, 2, 4), (1, 1, 2)]
    judge = exact_hull(points)
    checks, in_one_plane = [], 0
    for k, point in enumerate(points):
        on = [f for f in judge.facets if not plane_value(f.plane, point)]
        in_one_plane += len(on) == 1
        if len(on) == 2:
            p, q = (points[j] for j in {*on[0].polygon} & {*on[1].polygon})
            checks.append(not any(cross(minus(point, p), minus(q, p))) and dot(minus(point, p), minus(point, q)) < 0)
            checks.append(k not in judge.vertices)
    message = (
        f"{len(checks) // 2} points are in two planes; "
        f"{in_one_plane} is in one plane and between no two ends of an edge"
    )
    return holds_if(checks and all(checks) and in_one_plane, message, conditional=True)

"""Claims of chapter 3, step by step: the first points, projections, what is inside, new planes, boundary points.

The steps are looked at in small sets in a plane and in space (:mod:`modern.claims.sampled_sets`); those that do not
hold as they are printed have their counterexample in ``transcripts/counterexamples``.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from modern.claims.register import CONDITION, FAILS, HOLDS, CheckResult, fails_if, holds_if
from modern.claims.sampled_sets import (
    COUNT,
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
from modern.port.formulas import moments


def _all(cases: Iterator[bool] | list[bool], message: str) -> CheckResult:
    checks = list(cases)
    return holds_if(bool(checks) and all(checks), f"{sum(checks)} of {len(checks)} {message}")


def line_pairs(which: str) -> CheckResult:
    """The two equations of a line of each kind meet in just that line: their normals are independent."""
    ends = {"1": ((1, 2, 3), (4, 0, 5)), "2": ((1, 2, 3), (1, 0, 5)), "3": ((1, 2, 3), (1, 2, 5))}[which]
    lines = convex_hull(ends).lines
    normals = [tuple(map(int, line[:3])) for line in lines]
    on = all(dot(n, p) + int(line[3]) == 0 for n, line in zip(normals, lines, strict=True) for p in ends)  # type: ignore[arg-type]
    return holds_if(on and any(cross(*normals)), "both hold at the two points and their normals are independent")  # type: ignore[arg-type]


def third_point(count: str = COUNT) -> CheckResult:
    """No point is farther from the line of the first two than the third of H_1."""
    return _all(list(_farthest(flat_and_spatial_sets(count))), "sets")


def _farthest(sets: tuple[SampledSet, ...]) -> Iterator[bool]:
    for sampled in sets:
        p, q, r = (sampled.points[k] for k in sampled.hull.history[0].added[:3])
        areas = [_square(cross(minus(q, p), minus(x, p))) for x in (*sampled.points, r)]
        yield areas[-1] == max(areas)


def _square(u: Point) -> int:
    return dot(u, u)


def value_v() -> CheckResult:
    """V by the proof's formula is the squared vector product; by our text of the display it is not 0 on the line."""
    right = all(
        sum(o * o for o in moments(x, p, q)) == _square(cross(minus(q, p), minus(x, p))) for p, q, x in random_triples()
    )
    p, q, x = counterexample_points("v_as_our_text.csv")
    on_line = not any(cross(minus(q, p), minus(x, p)))
    (x1, y1, z1), (x2, y2, z2), (xi, yi, zi) = p, q, x
    as_text = ((y2 - y1) * (z2 - z1) - (z2 - zi) * (y2 - y1)) ** 2
    as_text += ((z2 - z1) * (x2 - x1) - (x2 - xi) * (z2 - z1)) ** 2
    as_text += ((x2 - x1) * (y2 - y1) - (y2 - yi) * (x2 - x1)) ** 2
    message = f"with y_i and z_i it is d squared times D squared; as our text has it {as_text} at a point of the line"
    return holds_if(right and on_line and as_text, message, conditional=True)


def coplanarity_test(count: str = COUNT) -> CheckResult:
    """All values of (3.4) are 0 in the flat sets and not in the others."""
    checks = []
    for sampled in flat_and_spatial_sets(count):
        first = plane_as_printed(*(sampled.points[k] for k in sampled.hull.history[0].added[:3]))
        checks.append(any(plane_value(first, point) for point in sampled.points) == (not sampled.flat))
    return _all(checks, "sets")


def common_first_steps(count: str = COUNT) -> CheckResult:
    """Flat sets, and the same with one point more that is not in their plane: the first three points are the same."""
    checks = []
    for sampled in sampled_sets(2, int(count)):
        size = 9 * len(sampled.points)
        flat = [(size * x, size * y, size * z) for x, y, z in sampled.points]
        x, y, z = (9 * sum(point[axis] for point in sampled.points) for axis in range(3))
        hulls = [convex_hull(points, history=True) for points in (flat, [*flat, (x, y, z + 1)])]
        firsts = [[hull.points[k] for k in hull.history[0].added[:3]] for hull in hulls]
        checks.append([hull.dimension for hull in hulls] == [2, 3] and firsts[0] == firsts[1])
    return _all(checks, "sets: the first three points are the same, and their plane decides the case")


def perpendicular_projection() -> CheckResult:
    """Three points in planes of small normals: in line on the coordinate plane just if the coefficient is 0."""
    checks = [(_image_area(normal, axis) == 0) == (normal[axis] == 0) for normal in _normals() for axis in range(3)]
    return _all(checks, "planes and coordinate planes: a segment if and only if they are perpendicular")


def _normals() -> list[Point]:
    return [(a, b, c) for a in (-1, 0, 2) for b in (-1, 0, 2) for c in (-1, 0, 2) if (a, b, c) != (0, 0, 0)]


def _image_area(normal: Point, axis: int) -> int:
    """Twice the area of the image of a triangle in a plane of the normal, where one coordinate is made 0."""
    first_side = cross(normal, (1, 0, 0)) if any(normal[1:]) else cross(normal, (0, 1, 0))
    second_side = cross(normal, first_side)
    u, v = (tuple(0 if k == axis else x for k, x in enumerate(side)) for side in (first_side, second_side))
    return cross(u, v)[axis]  # type: ignore[arg-type]


def projection_along_axis() -> CheckResult:
    """The foot of a point on a coordinate plane: the point less a multiple of the plane's normal, one coordinate 0."""
    checks = []
    for point in (p for triple in random_triples() for p in triple):
        for axis in range(3):
            foot = tuple(0 if k == axis else x for k, x in enumerate(point))
            unit = tuple(int(k == axis) for k in range(3))
            checks.append(not any(cross(minus(point, foot), unit)))  # type: ignore[arg-type]
    return _all(checks, "feet: the way to the point is at right angles to the plane")


def choice_of_projection() -> CheckResult:
    """For every small normal a triangle in its plane keeps an area on the coordinate plane that the rule chooses."""
    chosen = [(normal, 0 if normal[0] else 1 if normal[1] else 2) for normal in _normals()]
    return _all([_image_area(normal, axis) != 0 for normal, axis in chosen], "normals: the image is no segment")


def classification_by_signs(count: str = COUNT) -> CheckResult:
    """Vertices, boundary and inside points by the signs of the judge's equations."""
    checks = []
    some_boundary = bool(exact_hull([(0, 0, 0), (2, 0, 0), (1, 0, 0), (0, 2, 0)]).boundary)
    for sampled in flat_and_spatial_sets(count):
        for k, point in enumerate(sampled.points):
            most = max(plane_value(facet.plane, point) for facet in sampled.judge.facets)
            checks.append(most <= 0 and (most == 0) == (k not in sampled.judge.inside))
    return holds_if(
        all(checks) and some_boundary, f"{sum(checks)} of {len(checks)} points; a midpoint of a side is no vertex"
    )


def mean_of_first_hull(count: str = COUNT) -> CheckResult:
    """The judge's planes or lines of H_1 are the procedure's, and each is below zero at the mean of its points."""
    checks = []
    for sampled in flat_and_spatial_sets(count):
        first = sampled.stages()[0]
        judge = exact_hull([sampled.points[k] for k in first.vertices])
        x, y, z = (sum(sampled.points[k][axis] for k in first.vertices) for axis in range(3))
        vertex_count = len(first.vertices)
        checks.append({reduced_plane(plane) for plane in first.equations} == {f.plane for f in judge.facets})
        checks += [dot(f.plane[:3], (x, y, z)) + vertex_count * f.plane[3] < 0 for f in judge.facets]
    return _all(checks, "equations are below zero at C")


def outside_convention() -> CheckResult:
    """A point of a counterexample, inside of the line x = 0: by the print outside of it too."""
    ((x, _, _),) = counterexample_points("both_sides.csv")
    return fails_if(x < 0, f"x at the point is {x}: inside and outside of x = 0 by the same words")


def remaining_points(dimension: str) -> CheckResult:
    """A grid of a square, or of a cube: what is neither struck nor used at the end is on the boundary, and some is."""
    sizes = (5, 5, 1) if dimension == "2" else (3, 3, 3)
    points = [(x, y, z) for x in range(sizes[0]) for y in range(sizes[1]) for z in range(sizes[2])]
    hull, judge = convex_hull(points, history=True), exact_hull(points)
    used = {k for stage in hull.history for k in stage.added}
    struck = {k for stage in hull.history for k in stage.struck}
    left_points = set(range(len(points))) - used - struck
    passed = (
        bool(left_points)
        and left_points <= {*judge.boundary}
        and struck == {*judge.inside}
        and {*judge.vertices} <= used
    )
    return holds_if(
        passed, f"{len(left_points)} of {len(points)} points are left, all of them on the boundary and no vertices"
    )


def used_boundary_point() -> CheckResult:
    """Four points of which one is used for H_1 or a later hull and lies between two others of a side."""
    points = [(3, 0, 0), (4, 4, 0), (4, 2, 0), (4, 3, 0)]
    hull = convex_hull(points, history=True)
    used = {k for stage in hull.history for k in stage.added}
    none = used & {*hull.boundary}
    message = f"points {', '.join(str(points[k]) for k in sorted(none))} were used and lie in one line only"
    return holds_if(bool(none), message)


def between_by_distances() -> CheckResult:
    """On a line of a whole direction distances are whole, and the sums tell which point is between."""
    checks = []
    for a, b, c in ((0, 5, 2), (0, 2, 5), (5, 0, -3), (1, 0, 2)):
        between = _between(a, b, c, *(5 * abs(p - q) for p, q in ((b, a), (a, c), (b, c))))
        checks.append(between == sorted((a, b, c))[1])
    return _all(checks, "cases, points (3t, 4t)")


def _between(a: int, b: int, c: int, ab: int, ac: int, bc: int) -> int:
    """Which of three points of a line is between the others, by the sums of their distances."""
    return a if ab + ac - bc == 0 else b if ab + bc - ac == 0 else c


def duplicate_lines() -> CheckResult:
    """Before repeats are struck a side with three used points has two equations."""
    points = [(3, 0, 0), (4, 4, 0), (4, 2, 0), (4, 3, 0)]
    hull = convex_hull(points, history=True)
    last = hull.history[-1].equations
    used = {k for stage in hull.history for k in stage.added}
    sides = [{k for k in used if _on_side(points, face.polygon, k)} for face in hull.faces]
    counted = [(len(side), sum(set(ends) <= side for ends in last)) for side in sides]
    passed = all(equations >= 2 for used_count, equations in counted if used_count >= 3)
    return holds_if(
        passed and any(used_count >= 3 for used_count, _ in counted),
        f"used points and equations of each side: {counted}",
    )


def _on_side(points: list[Point], ends: tuple[int, ...], k: int) -> bool:
    p, q = points[ends[0]], points[ends[1]]
    return not any(cross(minus(q, p), minus(points[k], p)))


def fourth_point_by_largest() -> CheckResult:
    """A tetrahedron whose fourth corner is on the negative side of the first three: the largest U is 0."""
    points = counterexample_points("negative_side.csv")
    plane = plane_as_printed(*points[:3])
    values = [plane_value(plane, point) for point in points]
    text, listing = convex_hull(points, text=True, on_refusal="return"), convex_hull(points)
    wrong = max(values) == 0 and not text.determined and listing.determined
    message = (
        f"values {', '.join(map(str, values))}: the largest is that of a point of the plane; the listing finds the hull"
    )
    return fails_if(wrong, message)


def visible_planes(kind: str, count: str = COUNT) -> CheckResult:
    """What happens to the planes a new point is outside of: ``counts``, ``pairs``, ``letter``, ``names``, ``order``."""
    if kind == "order":
        return _order(count)
    checks: list[bool] = []
    same_places = pairs = 0
    for sampled in sampled_sets(3, int(count)):
        for before, after in zip(sampled.stages(), sampled.stages()[1:], strict=False):
            point = sampled.points[after.vertices[-1]]
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
        message = f"{same_places} of {pairs} pairs have their two common points in the same places of MM, NN and KK"
        return CheckResult(CONDITION if same_places < pairs else HOLDS, message)
    if kind == "letter":
        return holds_if(all(checks), f"{len(checks)} pairs of planes i and m", conditional=True)
    return _all(checks, "stages" if kind == "counts" else "pairs")


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


def _order(count: str) -> CheckResult:
    same = reordered = sets = 0
    for sampled in sampled_sets(3, int(count)):
        text = convex_hull(sampled.points, text=True, on_refusal="return")
        if text.determined:
            sets += 1
            same += {f.lowest for f in text.faces} == {f.lowest for f in sampled.hull.faces}
            reordered += [f.lowest for f in text.faces] != [f.lowest for f in sampled.hull.faces]
    message = f"the same planes in {same} of {sets} sets, in another order in {reordered}"
    return holds_if(same == sets, message, conditional=True)


def without_constant_term() -> CheckResult:
    """The middle of a cube away from the origin: without D it is outside of a plane it is inside of."""
    *corners, middle = counterexample_points("without_d.csv")
    planes = [facet.plane for facet in exact_hull(corners).facets]
    wrong = [plane for plane in planes if dot(plane[:3], middle) > 0 > plane_value(plane, middle)]
    return fails_if(wrong, f"{len(wrong)} of {len(planes)} planes are above 0 there without D")


def duplicate_planes() -> CheckResult:
    """The last hull of a pyramid over nine points of a square has repeats; one equation of each plane stays."""
    points = [(x, y, 0) for x in (0, 1, 2) for y in (0, 1, 2)] + [(1, 1, 2)]
    hull = convex_hull(points, history=True)
    made = len(hull.history[-1].equations)
    return holds_if(len(hull.faces) == 5 < made, f"{made} equations were made, {len(hull.faces)} planes stay")


def planes_at_vertex(kind: str = "", count: str = COUNT) -> CheckResult:
    """How many of the judge's planes each point satisfies."""
    checks = []
    pyramid = [(x, y, 0) for x in (0, 1, 2) for y in (0, 1, 2)] + [(1, 1, 2)]
    for points in (*(sampled.points for sampled in sampled_sets(3, int(count))), tuple(pyramid)):
        judge = exact_hull(points)
        for k, point in enumerate(points):
            on = sum(not plane_value(facet.plane, point) for facet in judge.facets)
            checks.append((on >= 3) == (k in judge.vertices))
    message = f"{sum(checks)} of {len(checks)} points: three or more for a vertex, two or fewer else"
    if not all(checks):
        return CheckResult(FAILS, message)
    return CheckResult(CONDITION if kind else HOLDS, message)


def duplicates_removed() -> CheckResult:
    """A triangle with a used point on a side: three vertices and three equations stay of four and four."""
    hull = convex_hull([(3, 0, 0), (4, 4, 0), (4, 2, 0), (4, 3, 0)], history=True)
    used = [k for stage in hull.history for k in stage.added]
    made, stay = len(hull.history[-1].equations), [face.lowest for face in hull.faces]
    passed = len(used) > len(hull.vertices) == 3 == len(set(stay)) == len(stay) < made
    return holds_if(
        passed, f"{len(used)} points used, {len(hull.vertices)} stay; {made} equations made, {len(stay)} stay"
    )


_TWO_PLANES: list[Point] = [(2, 1, 1), (1, 1, 3), (0, 1, 3), (0, 0, 0), (0, 2, 3), (0, 0, 2), (0, 1, 2)]
"""A set in space of which the procedure uses a point that is no vertex of the last hull."""


def used_points_in_planes() -> CheckResult:
    """Used points of that set that are no vertices, with the number of planes of the last hull each is in."""
    hull, judge = convex_hull(_TWO_PLANES, history=True), exact_hull(_TWO_PLANES)
    used = {k for stage in hull.history for k in stage.added} - {*judge.vertices}
    planes = {_TWO_PLANES[k]: sum(not plane_value(f.plane, _TWO_PLANES[k]) for f in judge.facets) for k in sorted(used)}
    passed = bool(planes) and {*planes.values()} <= {1, 2} and {*hull.vertices} == {*judge.vertices}
    return holds_if(passed, ", ".join(f"{point} is in {n}" for point, n in planes.items()))


def boundary_points_on_edges() -> CheckResult:
    """Lattice points of a pyramid's surface: those in two planes lie between the ends of the edge the planes share."""
    points = [(x, y, 0) for x in (0, 2, 4) for y in (0, 2, 4)] + [(2, 2, 4), (1, 1, 2)]
    judge = exact_hull(points)
    checks, one_plane = [], 0
    for k, point in enumerate(points):
        on = [f for f in judge.facets if not plane_value(f.plane, point)]
        one_plane += len(on) == 1
        if len(on) == 2:
            p, q = (points[j] for j in {*on[0].polygon} & {*on[1].polygon})
            checks.append(not any(cross(minus(point, p), minus(q, p))) and dot(minus(point, p), minus(point, q)) < 0)
            checks.append(k not in judge.vertices)
    message = f"{len(checks) // 2} points in two planes; {one_plane} in one, which is between no two ends of an edge"
    return holds_if(checks and all(checks) and one_plane, message, conditional=True)

"""Claims of chapter 3, step by step: the first points, projections, what is inside, new planes, boundary points.

The steps are looked at in small sets in a plane and in space (:mod:`modern.claims.sampled_sets`); those that do not
hold as they are printed have their counterexample in ``transcripts/counterexamples``.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from modern.claims.register import CONDITION, FAILS, HOLDS, Seen, seen
from modern.claims.sampled_sets import Grown, Point, SampledSet, sampled_sets, through, value
from modern.claims.thesis.chapter3_equations import COUNT, both, lowest_terms, plane_as_printed, points_of, triples
from modern.exact_hull import exact_hull
from modern.geometry.vectors import cross, dot, minus
from modern.port import convex_hull
from modern.port.formulas import moments


def _all(cases: Iterator[bool] | list[bool], words: str) -> Seen:
    found = list(cases)
    return seen(bool(found) and all(found), f"{sum(found)} of {len(found)} {words}")


def line_pairs(which: str) -> Seen:
    """The two equations of a line of each kind meet in just that line: their normals are independent."""
    ends = {"1": ((1, 2, 3), (4, 0, 5)), "2": ((1, 2, 3), (1, 0, 5)), "3": ((1, 2, 3), (1, 2, 5))}[which]
    lines = convex_hull(ends).lines
    normals = [tuple(map(int, line[:3])) for line in lines]
    on = all(dot(n, p) + int(line[3]) == 0 for n, line in zip(normals, lines, strict=True) for p in ends)  # type: ignore[arg-type]
    return seen(on and any(cross(*normals)), "both hold at the two points and their normals are independent")  # type: ignore[arg-type]


def third_point(count: str = COUNT) -> Seen:
    """No point is farther from the line of the first two than the third of H_1."""
    return _all(list(_farthest(both(count))), "sets")


def _farthest(sets: tuple[SampledSet, ...]) -> Iterator[bool]:
    for one in sets:
        p, q, r = (one.points[k] for k in one.hull.history[0].added[:3])
        areas = [_square(cross(minus(q, p), minus(x, p))) for x in (*one.points, r)]
        yield areas[-1] == max(areas)


def _square(u: Point) -> int:
    return dot(u, u)


def value_v() -> Seen:
    """V by the proof's formula is the squared vector product; by our text of the display it is not 0 on the line."""
    right = all(
        sum(o * o for o in moments(x, p, q)) == _square(cross(minus(q, p), minus(x, p))) for p, q, x in triples()
    )
    p, q, x = points_of("v_as_our_text.csv")
    on_line = not any(cross(minus(q, p), minus(x, p)))
    (x1, y1, z1), (x2, y2, z2), (xi, yi, zi) = p, q, x
    as_text = ((y2 - y1) * (z2 - z1) - (z2 - zi) * (y2 - y1)) ** 2
    as_text += ((z2 - z1) * (x2 - x1) - (x2 - xi) * (z2 - z1)) ** 2
    as_text += ((x2 - x1) * (y2 - y1) - (y2 - yi) * (x2 - x1)) ** 2
    words = f"with y_i and z_i it is d squared times D squared; as our text has it {as_text} at a point of the line"
    return Seen(CONDITION if right and on_line and as_text else FAILS, words)


def coplanar_iff(count: str = COUNT) -> Seen:
    """All values of (3.4) are 0 in the flat sets and not in the others."""
    found = []
    for one in both(count):
        first = plane_as_printed(*(one.points[k] for k in one.hull.history[0].added[:3]))
        found.append(any(value(first, point) for point in one.points) == (not one.flat))
    return _all(found, "sets")


def opening_is_shared(count: str = COUNT) -> Seen:
    """Flat sets, and the same with one point more that is not in their plane: the first three points are the same."""
    found = []
    for one in sampled_sets(2, int(count)):
        size = 9 * len(one.points)
        flat = [(size * x, size * y, size * z) for x, y, z in one.points]
        x, y, z = (9 * sum(point[axis] for point in one.points) for axis in range(3))
        hulls = [convex_hull(points, history=True) for points in (flat, [*flat, (x, y, z + 1)])]
        firsts = [[hull.points[k] for k in hull.history[0].added[:3]] for hull in hulls]
        found.append([hull.dimension for hull in hulls] == [2, 3] and firsts[0] == firsts[1])
    return _all(found, "sets: the first three points are the same, and their plane decides the case")


def perpendicular_projection() -> Seen:
    """Three points in planes of small normals: in line on the coordinate plane just if the coefficient is 0."""
    found = [(_image_area(normal, axis) == 0) == (normal[axis] == 0) for normal in _normals() for axis in range(3)]
    return _all(found, "planes and coordinate planes: a segment if and only if they are perpendicular")


def _normals() -> list[Point]:
    return [(a, b, c) for a in (-1, 0, 2) for b in (-1, 0, 2) for c in (-1, 0, 2) if (a, b, c) != (0, 0, 0)]


def _image_area(normal: Point, axis: int) -> int:
    """Twice the area of the image of a triangle in a plane of the normal, where one coordinate is made 0."""
    one = cross(normal, (1, 0, 0)) if any(normal[1:]) else cross(normal, (0, 1, 0))
    other = cross(normal, one)
    u, v = (tuple(0 if k == axis else x for k, x in enumerate(side)) for side in (one, other))
    return cross(u, v)[axis]  # type: ignore[arg-type]


def projection_leaves_one_coordinate_out() -> Seen:
    """The foot of a point on a coordinate plane: the point less a multiple of the plane's normal, one coordinate 0."""
    found = []
    for point in (p for triple in triples() for p in triple):
        for axis in range(3):
            foot = tuple(0 if k == axis else x for k, x in enumerate(point))
            unit = tuple(int(k == axis) for k in range(3))
            found.append(not any(cross(minus(point, foot), unit)))  # type: ignore[arg-type]
    return _all(found, "feet: the way to the point is at right angles to the plane")


def choice_of_projection() -> Seen:
    """For every small normal a triangle in its plane keeps an area on the coordinate plane that the rule chooses."""
    chosen = [(normal, 0 if normal[0] else 1 if normal[1] else 2) for normal in _normals()]
    return _all([_image_area(normal, axis) != 0 for normal, axis in chosen], "normals: the image is no segment")


def three_parts(count: str = COUNT) -> Seen:
    """Vertices, boundary and inside points by the signs of the judge's equations."""
    found = []
    some_boundary = bool(exact_hull([(0, 0, 0), (2, 0, 0), (1, 0, 0), (0, 2, 0)]).boundary)
    for one in both(count):
        for k, point in enumerate(one.points):
            most = max(value(facet.plane, point) for facet in one.judge.facets)
            found.append(most <= 0 and (most == 0) == (k not in one.judge.inside))
    return seen(all(found) and some_boundary, f"{sum(found)} of {len(found)} points; a midpoint of a side is no vertex")


def mean_is_inside(count: str = COUNT) -> Seen:
    """The judge's planes or lines of H_1 are the procedure's, and each is below zero at the mean of its points."""
    found = []
    for one in both(count):
        first = one.stages()[0]
        judge = exact_hull([one.points[k] for k in first.vertices])
        x, y, z = (sum(one.points[k][axis] for k in first.vertices) for axis in range(3))
        number = len(first.vertices)
        found.append({lowest_terms(plane) for plane in first.equations} == {f.plane for f in judge.facets})
        found += [dot(f.plane[:3], (x, y, z)) + number * f.plane[3] < 0 for f in judge.facets]
    return _all(found, "equations are below zero at C")


def outside_below_zero() -> Seen:
    """A point of a counterexample, inside of the line x = 0: by the print outside of it too."""
    ((x, _, _),) = points_of("both_sides.csv")
    return Seen(FAILS if x < 0 else HOLDS, f"x at the point is {x}: inside and outside of x = 0 by the same words")


def left_over(dimension: str) -> Seen:
    """A grid of a square, or of a cube: what is neither struck nor used at the end is on the boundary, and some is."""
    sizes = (5, 5, 1) if dimension == "2" else (3, 3, 3)
    points = [(x, y, z) for x in range(sizes[0]) for y in range(sizes[1]) for z in range(sizes[2])]
    hull, judge = convex_hull(points, history=True), exact_hull(points)
    used = {k for stage in hull.history for k in stage.added}
    struck = {k for stage in hull.history for k in stage.struck}
    left = set(range(len(points))) - used - struck
    good = bool(left) and left <= {*judge.boundary} and struck == {*judge.inside} and {*judge.vertices} <= used
    return seen(good, f"{len(left)} of {len(points)} points are left, all of them on the boundary and no vertices")


def used_but_no_vertex() -> Seen:
    """Four points of which one is used for H_1 or a later hull and lies between two others of a side."""
    points = [(3, 0, 0), (4, 4, 0), (4, 2, 0), (4, 3, 0)]
    hull = convex_hull(points, history=True)
    used = {k for stage in hull.history for k in stage.added}
    none = used & {*hull.boundary}
    words = f"points {', '.join(str(points[k]) for k in sorted(none))} were used and lie in one line only"
    return seen(bool(none), words)


def between_by_distances() -> Seen:
    """On a line of a whole direction distances are whole, and the sums tell which point is between."""
    found = []
    for a, b, c in ((0, 5, 2), (0, 2, 5), (5, 0, -3), (1, 0, 2)):
        said = _between(a, b, c, *(5 * abs(p - q) for p, q in ((b, a), (a, c), (b, c))))
        found.append(said == sorted((a, b, c))[1])
    return _all(found, "cases, points (3t, 4t)")


def _between(a: int, b: int, c: int, ab: int, ac: int, bc: int) -> int:
    """Which of three points of a line is between the others, by the sums of their distances."""
    return a if ab + ac - bc == 0 else b if ab + bc - ac == 0 else c


def doubled_lines() -> Seen:
    """Before repeats are struck a side with three used points has two equations."""
    points = [(3, 0, 0), (4, 4, 0), (4, 2, 0), (4, 3, 0)]
    hull = convex_hull(points, history=True)
    last = hull.history[-1].equations
    used = {k for stage in hull.history for k in stage.added}
    sides = [{k for k in used if _on_side(points, face.polygon, k)} for face in hull.faces]
    counted = [(len(side), sum(set(ends) <= side for ends in last)) for side in sides]
    good = all(equations >= 2 for number, equations in counted if number >= 3)
    return seen(
        good and any(number >= 3 for number, _ in counted), f"used points and equations of each side: {counted}"
    )


def _on_side(points: list[Point], ends: tuple[int, ...], k: int) -> bool:
    p, q = points[ends[0]], points[ends[1]]
    return not any(cross(minus(q, p), minus(points[k], p)))


def fourth_point_by_largest() -> Seen:
    """A tetrahedron whose fourth corner is on the negative side of the first three: the largest U is 0."""
    points = points_of("negative_side.csv")
    plane = plane_as_printed(*points[:3])
    values = [value(plane, point) for point in points]
    text, listing = convex_hull(points, text=True, on_refusal="return"), convex_hull(points)
    wrong = max(values) == 0 and not text.determined and listing.determined
    words = (
        f"values {', '.join(map(str, values))}: the largest is that of a point of the plane; the listing finds the hull"
    )
    return Seen(FAILS if wrong else HOLDS, words)


def visible_planes(kind: str, count: str = COUNT) -> Seen:
    """What happens to the planes a new point is outside of: ``counts``, ``pairs``, ``letter``, ``names``, ``order``."""
    if kind == "order":
        return _order(count)
    found: list[bool] = []
    same_places = pairs = 0
    for one in sampled_sets(3, int(count)):
        for before, after in zip(one.stages(), one.stages()[1:], strict=False):
            point = one.points[after.vertices[-1]]
            visible = [k for k, plane in enumerate(before.equations) if value(plane, point) > 0]
            shared = list(_shared(before, visible))
            pairs += len(shared)
            same_places += sum(_same_places(before.defining[i], before.defining[m], edge) for i, m, edge in shared)
            if kind == "counts":
                added = len(after.equations) - len(before.equations)
                found.append(added == 2 * len(visible) - 2 * len(shared))
            else:
                found += [_separated(one.points, before, i, m, edge, point) for i, m, edge in shared]
    if kind == "names":
        words = f"{same_places} of {pairs} pairs have their two common points in the same places of MM, NN and KK"
        return Seen(CONDITION if same_places < pairs else HOLDS, words)
    if kind == "letter":
        return Seen(CONDITION if all(found) else FAILS, f"{len(found)} pairs of planes i and m")
    return _all(found, "stages" if kind == "counts" else "pairs")


def _shared(before: Grown, visible: list[int]) -> Iterator[tuple[int, int, set[int]]]:
    for i, m in combinations(visible, 2):
        edge = set(before.defining[i]) & set(before.defining[m])
        if len(edge) == 2:
            yield i, m, edge


def _same_places(one: tuple[int, ...], other: tuple[int, ...], edge: set[int]) -> bool:
    return all(one.index(k) == other.index(k) for k in edge)


def _separated(points: tuple[Point, ...], before: Grown, i: int, m: int, edge: set[int], new: Point) -> bool:
    p, q = (points[k] for k in edge)
    plane = through(p, q, new)
    (one,), (other,) = (set(before.defining[k]) - edge for k in (i, m))
    return value(plane, points[one]) * value(plane, points[other]) < 0


def _order(count: str) -> Seen:
    same = reordered = sets = 0
    for one in sampled_sets(3, int(count)):
        text = convex_hull(one.points, text=True, on_refusal="return")
        if text.determined:
            sets += 1
            same += {f.lowest for f in text.faces} == {f.lowest for f in one.hull.faces}
            reordered += [f.lowest for f in text.faces] != [f.lowest for f in one.hull.faces]
    words = f"the same planes in {same} of {sets} sets, in another order in {reordered}"
    return Seen(CONDITION if same == sets else FAILS, words)


def without_constant_term() -> Seen:
    """The middle of a cube away from the origin: without D it is outside of a plane it is inside of."""
    *corners, middle = points_of("without_d.csv")
    planes = [facet.plane for facet in exact_hull(corners).facets]
    wrong = [plane for plane in planes if dot(plane[:3], middle) > 0 > value(plane, middle)]
    return Seen(FAILS if wrong else HOLDS, f"{len(wrong)} of {len(planes)} planes are above 0 there without D")


def repeats_by_points() -> Seen:
    """The last hull of a pyramid over nine points of a square has repeats; one equation of each plane stays."""
    points = [(x, y, 0) for x in (0, 1, 2) for y in (0, 1, 2)] + [(1, 1, 2)]
    hull = convex_hull(points, history=True)
    made = len(hull.history[-1].equations)
    return seen(len(hull.faces) == 5 < made, f"{made} equations were made, {len(hull.faces)} planes stay")


def planes_of_a_vertex(kind: str = "", count: str = COUNT) -> Seen:
    """How many of the judge's planes each point satisfies."""
    found = []
    pyramid = [(x, y, 0) for x in (0, 1, 2) for y in (0, 1, 2)] + [(1, 1, 2)]
    for points in (*(one.points for one in sampled_sets(3, int(count))), tuple(pyramid)):
        judge = exact_hull(points)
        for k, point in enumerate(points):
            on = sum(not value(facet.plane, point) for facet in judge.facets)
            found.append((on >= 3) == (k in judge.vertices))
    words = f"{sum(found)} of {len(found)} points: three or more for a vertex, two or fewer else"
    if not all(found):
        return Seen(FAILS, words)
    return Seen(CONDITION if kind else HOLDS, words)


def taken_out() -> Seen:
    """A triangle with a used point on a side: three vertices and three equations stay of four and four."""
    hull = convex_hull([(3, 0, 0), (4, 4, 0), (4, 2, 0), (4, 3, 0)], history=True)
    used = [k for stage in hull.history for k in stage.added]
    made, stay = len(hull.history[-1].equations), [face.lowest for face in hull.faces]
    good = len(used) > len(hull.vertices) == 3 == len(set(stay)) == len(stay) < made
    return seen(good, f"{len(used)} points used, {len(hull.vertices)} stay; {made} equations made, {len(stay)} stay")


_TWO_PLANES: list[Point] = [(2, 1, 1), (1, 1, 3), (0, 1, 3), (0, 0, 0), (0, 2, 3), (0, 0, 2), (0, 1, 2)]
"""A set in space of which the procedure uses a point that is no vertex of the last hull."""


def used_in_two_planes() -> Seen:
    """Used points of that set that are no vertices, with the number of planes of the last hull each is in."""
    hull, judge = convex_hull(_TWO_PLANES, history=True), exact_hull(_TWO_PLANES)
    used = {k for stage in hull.history for k in stage.added} - {*judge.vertices}
    planes = {_TWO_PLANES[k]: sum(not value(f.plane, _TWO_PLANES[k]) for f in judge.facets) for k in sorted(used)}
    good = bool(planes) and {*planes.values()} <= {1, 2} and {*hull.vertices} == {*judge.vertices}
    return seen(good, ", ".join(f"{point} is in {n}" for point, n in planes.items()))


def between_the_ends() -> Seen:
    """Lattice points of a pyramid's surface: those in two planes lie between the ends of the edge the planes share."""
    points = [(x, y, 0) for x in (0, 2, 4) for y in (0, 2, 4)] + [(2, 2, 4), (1, 1, 2)]
    judge = exact_hull(points)
    good, one_plane = [], 0
    for k, point in enumerate(points):
        on = [f for f in judge.facets if not value(f.plane, point)]
        one_plane += len(on) == 1
        if len(on) == 2:
            p, q = (points[j] for j in {*on[0].polygon} & {*on[1].polygon})
            good.append(not any(cross(minus(point, p), minus(q, p))) and dot(minus(point, p), minus(point, q)) < 0)
            good.append(k not in judge.vertices)
    words = f"{len(good) // 2} points in two planes; {one_plane} in one, which is between no two ends of an edge"
    return Seen(CONDITION if good and all(good) and one_plane else FAILS, words)

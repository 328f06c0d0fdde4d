"""Checks of Appel and Will: the whole method, steps as printed, polygons, and the star test for images of points."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import partial
from itertools import combinations, permutations, product
from random import Random

from modern.claims.evidence import Check, Generator, claim, exhausted, exhibited, refuted, search, searched, slip
from modern.claims.hulls import exact_hull
from modern.claims.sampled_sets import CASES, SETS, Point, counterexample_points, sampled_sets
from modern.geometry.mesh import sides
from modern.geometry.vectors import area_vector, dot, minus
from modern.papers.appel_will import CORRECTED, Method, appel_will, printed
from modern.papers.appel_will.star import as_corrected, as_printed, on_one_ray, project, star_polygon, vorticity

Flat = tuple[int, int]
CUBE = tuple(product((0, 1), repeat=3))


def area(p: Flat, q: Flat, r: Flat) -> int:
    """Return twice the area of a triangle in the plane, positive if its corners are counterclockwise."""
    return vorticity((q[0] - p[0], q[1] - p[1]), (r[0] - p[0], r[1] - p[1]))


def turns(ring: Sequence[Flat]) -> list[int]:
    """Return, for each corner of a polygon, a number that is positive if the polygon turns left there."""
    return [area(ring[k - 1], corner, ring[(k + 1) % len(ring)]) for k, corner in enumerate(ring)]


@claim("appel-will.1", full=300)
def corrected_method(cases: int = CASES) -> Check:
    check = method_against_judge(cases, printed("step3", "step5", "step7"))
    by_9 = _missing_faces("prism.csv", "step9")
    with_5, with_7 = (_missing_faces("one_ray.csv", "step10", step) for step in ("step5", "step7"))
    case = f"the rule of Fig. 12; by step 9 as printed, which misses {by_9} faces of a prism; and by step 10 as "
    case += f"printed, which misses {with_5} or {with_7} faces of a hull if step 5 or step 7 is also applied as printed"
    return check.unless(not star_as_captioned().holds and by_9 and with_5 and with_7, case)


@claim("appel-will.107", full=300)
def next_line(cases: int = CASES) -> Check:
    missing = _missing_faces("prism.csv", "step9")
    case = f"a prism, for which searches that begin at the head of the list miss {missing} faces"
    message = f"if step 9 excludes the lines that it added, the loops of {cases} sets run around the faces of the hull"
    return replace(method_against_judge(cases), message=message).unless(missing, case)


def _missing_faces(name: str, *steps: str) -> int:
    """Return how many faces of a counterexample's hull the method misses if the given steps are done as printed."""
    points = counterexample_points(name)
    return len(exact_hull(points).facets) - len({*map(frozenset, appel_will(points, method=printed(*steps)).surfaces)})


@claim("appel-will.67", "appel-will.68", "appel-will.98", full=300)
@claim("appel-will.36", "appel-will.116", "appel-will.120", "yau-srihari.112", full=300)
def method_against_judge(cases: int = CASES, method: Method = CORRECTED) -> Check:
    checks = []
    for sampled in sampled_sets(3, cases):
        hull = appel_will(sampled.points, method=method)
        # A face is compared by its sides, so that the order of its points counts.
        rings = [facet.polygon for facet in sampled.judge.facets], hull.surfaces
        faces, loops = ({frozenset(map(frozenset, sides(ring))) for ring in part} for part in rings)
        checks += [hull.edges == sampled.judge.edges(), loops == faces, hull.table.closed, {*hull.table.uses} == {2}]
        # Each line of a loop starts at a point of the map, at LC1 if its entry is positive, and ends at the next point.
        for loop, ring in zip(hull.table.loops, hull.surfaces, strict=True):
            ends = [hull.edges[abs(entry) - 1][:: 1 if entry > 0 else -1] for entry in loop.entries]
            checks.append(all(ends[k - 1][1] == point == ends[k][0] for k, point in enumerate(ring)))
            normal = area_vector(sampled.points, ring)
            values = [dot(normal, minus(point, sampled.points[ring[0]])) for point in sampled.points]
            checks.append(min(values) == 0 or max(values) == 0)
    message = f"for {cases} sets of points, the loops run around the faces of the exact hull, which are convex, and "
    message += "use each edge twice; no plane of a loop has points on both sides; the topological map lists, for each "
    message += "loop, the points at which its lines begin (LC1 if the entry of the line is positive, otherwise LC2)"
    return searched(SETS[3], cases, checks, message)


def draw_points(random: Random, count: tuple[int, int], coordinates: tuple[int, int]) -> tuple[Flat, ...]:
    """Draw points in the plane; their number and their coordinates are between the given limits."""
    return tuple((random.randint(*coordinates), random.randint(*coordinates)) for _ in range(random.randint(*count)))


# A corridor that winds around itself, by x and y; in the end its outer wall remains, all points of which are convex.
SPIRAL = (*zip((-1, 6, 6, 0, 0, 4, 4, 3, 3, 1, 1, 5, 5, -1), (0, 0, 6, 6, 2, 2, 4, 4, 3, 3, 5, 5, 1, 1), strict=True),)
RINGS: Generator[tuple[Flat, ...]] = Generator(
    "simple polygons of 4 to 8 corners on a grid of 7 by 7",
    4,
    partial(draw_points, count=(4, 8), coordinates=(0, 6)),
    lambda ring: len(ring) > 3 and _simple(ring),
)


@claim("appel-will.10", full=20_000)
def deletion_passes(cases: int = 8) -> Check:
    def crosses_or_ends_as_hull(ring: tuple[Flat, ...]) -> tuple[bool, bool]:
        passes, vertices = _passes(ring), exact_hull([(x, y, 0) for x, y in ring]).vertices
        return any(map(_crosses, passes)), {*passes[-1]} == {ring[k] for k in vertices}

    message = "each polygon is reduced to its hull, or has sides that meet after a pass and are not neighbours"
    check = search(RINGS, lambda ring: any(crosses_or_ends_as_hull(ring)), cases, message)
    end = len(_passes(SPIRAL)[-1])
    case = f"a spiral of {len(SPIRAL)} points, which ends as a polygon of {end} points that crosses itself"
    return check.unless(_simple(SPIRAL) and crosses_or_ends_as_hull(SPIRAL) == (True, False), case)


@claim("appel-will.11")
def deletion_makes_nonconvex() -> Check:
    ring = [(0, 0), (10, 0), (10, 10), (6, 1), (5, 5), (4, 1), (0, 10)]
    before = _convex_points(ring)
    lost = sorted({*before} - {*_convex_points(before)})
    message = f"the corner {', '.join(map(str, lost))} of a polygon is convex at first and nonconvex after a deletion"
    return exhibited(_simple(ring) and lost, message)


def _convex_points(ring: Sequence[Flat]) -> list[Flat]:
    return [p for p, turn in zip(ring, turns(ring), strict=True) if turn > 0]


def _passes(ring: Sequence[Flat]) -> list[list[Flat]]:
    """Delete the nonconvex corners of a polygon in passes until none is left; return the polygon after each pass."""
    remaining = _convex_points(ring)
    return [remaining] if len(remaining) in (len(ring), 2) else [remaining, *_passes(remaining)]


def _crosses(ring: Sequence[Flat]) -> bool:
    """Return True if two sides of a polygon that are not neighbours meet. The corners must be distinct."""
    return any(_meet(p, q, r, s) for (p, q), (r, s) in combinations(sides(ring), 2) if q != r and s != p)


def _meet(p: Flat, q: Flat, r: Flat, s: Flat) -> bool:
    # The last comparison, in the order of x and y, decides for two segments on one line.
    is_apart = area(p, q, r) * area(p, q, s) > 0 or area(r, s, p) * area(r, s, q) > 0
    return not is_apart and max(min(p, q), min(r, s)) <= min(max(p, q), max(r, s))


def _simple(ring: Sequence[Flat]) -> bool:
    """Return True if a polygon is counterclockwise and no sides meet except neighbours at their common end."""
    return len({*ring}) == len(ring) and not _crosses(ring) and sum(vorticity(p, q) for p, q in sides(ring)) > 0


@claim("appel-will.15", full=400)
def start_of_jarvis(cases: int = CASES) -> Check:
    checks = []
    for sampled in sampled_sets(2, cases):
        polygon = [*sides([sampled.points[k][:2] for k in sampled.judge.polygon])]
        for x, y in product(range(-6, 7), repeat=2):
            if not any(_meet(p, q, (x, y), (9, y)) for p, q in polygon):
                checks.append(_smallest_angle((x, y), sampled.points) not in sampled.judge.inside)
    message = f"for {len(checks)} origins whose ray to the right misses the hull, the point found is on the border"
    check = searched(SETS[2], cases, checks, message)
    origin, *points = counterexample_points("jarvis.csv")
    first = _smallest_angle(origin[:2], points)
    is_inside = first in exact_hull(points).inside and 0 in exact_hull([origin, *points]).vertices
    is_beside = min(y for _, y, _ in points) <= origin[1] <= max(y for _, y, _ in points)
    case = f"the origin {origin[:2]}: the point {points[first][:2]} inside the hull has the smallest angle about it"
    return check.unless(is_inside and is_beside, case)


def _smallest_angle(origin: Sequence[int], points: Sequence[Point], way: float = 0) -> int:
    angles = [(math.atan2(y - origin[1], x - origin[0]) - way) % (2 * math.pi) for x, y, _ in points]
    return angles.index(min(angles))


@claim("appel-will.160", full=400)
def next_points_of_jarvis(cases: int = CASES) -> Check:
    checks = []
    for sampled in sampled_sets(2, cases):
        # The origin is below all points, and the first angles are measured from the horizontal line.
        listed: list[Point] = [(-1, -6, 0), (0, -6, 0)]
        while len(listed) < len(sampled.points) + 3:
            last, new = listed[-2:]
            others = [p for p in sampled.points if p != new]
            listed.append(others[_smallest_angle(new, others, math.atan2(new[1] - last[1], new[0] - last[0]))])
        found = {*map(sampled.points.index, listed[2:])}
        checks += [not found & {*sampled.judge.inside}, found >= {*sampled.judge.vertices}]
    message = f"in {cases} sets, angles from the line that leads to the new origin find only points on the border of "
    check = searched(SETS[2], cases, checks, f"{message}the hull, and all vertices of the hull")
    origin, *points = counterexample_points("jarvis_steps.csv")
    listed, remaining = [origin], [*points]
    while len(listed) < 5:
        listed.append(remaining.pop(_smallest_angle(listed[-1], remaining)))
    is_wrong = points.index(listed[4]) in exact_hull(points).inside and 3 in exact_hull(listed[1:]).vertices
    case = f"angles from the horizontal line: the fourth point found, {listed[4][:2]}, is inside the hull but outside "
    return check.unless(is_wrong, f"{case}the triangle of the first three")


@claim("appel-will.37")
def number_of_combinations() -> Check:
    f = math.factorial
    outcomes = [len([*combinations(range(n), r)]) * f(r) * f(n - r) == f(n) for n in range(13) for r in range(n + 1)]
    message = "N! divided by the product r! (N - r)! is the number of combinations of r out of N objects"
    return exhausted("combinations of at most 12 objects", outcomes, message)


def holds_origin(images: Iterable[Flat]) -> bool:
    """Return True if the hull of points in the plane contains the origin: if added, the origin is then not a vertex."""
    flat = [(a, b, 0) for a, b in {*images}]
    return len(flat) not in exact_hull([*flat, (0, 0, 0)]).vertices


@claim("appel-will.40", "appel-will.47", "appel-will.48", "appel-will.93", "appel-will.142", full=200)
def edge_by_star_test(cases: int = 1) -> Check:
    checks = []
    for sampled in sampled_sets(3, cases):
        points, edges = sampled.points, {*sampled.judge.edges()}
        for pair in combinations(range(len(points)), 2):
            projection = project(points, pair, range(len(points)))
            is_corner = not holds_origin(projection.images)
            # If more than two points have the image of the pair, only the two outer ones of them can be an edge.
            is_edge = is_corner and {*pair} == {projection.line[0], projection.line[-1]}
            test, outside = as_corrected(projection.images), _outside_star(projection.images)
            checks.append(test == outside == is_corner and is_edge == (pair in edges))
    message = f"for each of {len(checks)} pairs of points, the corrected star polygon test tells if the image of the "
    message += "pair is outside the star polygon, and so a corner of the hull of all images; the edges of the hull are "
    message += "exactly the pairs with such an image whose points are the outermost ones on their line"
    return searched(SETS[3], cases, checks, message)


@claim("yau-srihari.12", full=200)
def edge_by_image(cases: int = 1) -> Check:
    points, pair = [(0, 0, 0), (2, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 4)], (0, 2)
    # A third point on the line has the image of the pair, so that this image is in the hull of the other images.
    is_rejected = len(project(points, pair, range(len(points))).line) > 2
    case = f"{points[1]}, which has the image of the edge from {points[0]} to {points[2]} of a tetrahedron"
    return edge_by_star_test(cases).unless(is_rejected and pair in exact_hull(points).edges(), case)


@claim("appel-will.54", full=200)
def corrected_star_test(cases: int = 1) -> Check:
    case = "the test with the rule in the caption of Fig. 12, which finds an edge that the hull does not have"
    return edge_by_star_test(cases).unless(not star_as_captioned().holds, case)


@claim("appel-will.59")
def star_as_captioned() -> Check:
    points = counterexample_points("one_ray.csv")
    wrong = {*appel_will(points, method=Method(star=as_printed)).edges} - {*exact_hull(points).edges()}
    pairs = ", ".join(f"{points[a]} to {points[b]}" for a, b in sorted(wrong))
    return refuted(wrong, f"with the rule of Fig. 12, the test finds an edge that the hull does not have: {pairs}")


NONCONVEX: Generator[tuple[Flat, ...]] = replace(
    RINGS, name=f"{RINGS.name}, not convex", accepts=lambda ring: RINGS.accepts(ring) and min(turns(ring)) < 0
)


@claim("appel-will.128", full=5_000)
def new_lines(cases: int = 10) -> Check:
    def is_changed(ring: Sequence[Flat]) -> bool:
        # Two sides on one line make one line, which is not new if it is a side of the hull.
        ring = [corner for corner, turn in zip(ring, turns(ring), strict=True) if turn]
        polygon = exact_hull([(x, y, 0) for x, y in ring]).polygon
        lines, edges = ({*map(frozenset, sides(corners))} for corners in (range(len(ring)), polygon))
        return len(polygon) < len(ring) and not edges <= lines

    check = search(NONCONVEX, is_changed, cases, "each hull has fewer corners than its polygon, and a new line")
    return check.unless(not is_changed([(0, 0), (1, 0), (1, 1), (0, 1)]), "a square, which is its own hull")


IMAGES: Generator[tuple[Flat, ...]] = Generator(
    "3 to 5 images with coordinates from -4 to 4, none at the origin",
    12,
    partial(draw_points, count=(3, 5), coordinates=(-4, 4)),
    lambda images: len({*images}) == len(images) > 2 and (0, 0) not in images,
)


@claim("appel-will.131", "appel-will.55", "appel-will.58", full=5_000)
def star_test(cases: int = 20) -> Check:
    def is_right(images: tuple[Flat, ...]) -> bool:
        is_outside, senses = as_corrected(images), [vorticity(a, b) for a, b in sides(star_polygon(images))]
        # The test as printed must give the same result as the corrected one if no two images are on one ray.
        as_stated = is_outside == as_printed(images) or any(on_one_ray(a, b) for a, b in combinations(images, 2))
        changes = min(senses) < 0 < max(senses)
        return as_stated and is_outside == _outside_star(images) != holds_origin(images) and changes <= is_outside

    message = "the senses of rotation tell whether the tested point is outside the star polygon, and so outside the "
    message += "hull of the images; if the sense changes, the point is outside"
    return search(IMAGES, is_right, cases, message)


def _outside_star(images: Sequence[Flat]) -> bool:
    """Return True if the origin is on no side of the star polygon, and a ray from it crosses evenly many sides."""
    star = [*sides(star_polygon(images))]
    crossings = [(a[1] > 0) != (b[1] > 0) and vorticity(a, b) * (b[1] - a[1]) > 0 for a, b in star]
    return sum(crossings) % 2 == 0 and all(vorticity(a, b) or on_one_ray(a, b) for a, b in star)


@claim("appel-will.119", full=1_000)
def order_on_one_ray(cases: int = 10) -> Check:
    def is_listed_order(images: tuple[Flat, ...]) -> bool:
        near, far = images[0], (2 * images[0][0], 2 * images[0][1])
        rest = [image for image in images if image not in (near, far)]
        return all([p for p in star_polygon([*o, *rest]) if p not in rest] == o for o in ([near, far], [far, near]))

    message = "if one of two images on a ray is twice as far as the other, either may come first in the star polygon"
    return search(IMAGES, is_listed_order, cases, message)


@claim("appel-will.60", full=1_000)
def opposite_images(cases: int = 10) -> Check:
    def is_inside(images: tuple[Flat, ...]) -> bool:
        opposite = (*images[:3], (-images[0][0], -images[0][1]))
        return holds_origin(opposite) and not any(as_corrected([*order]) for order in permutations(opposite))

    message = "C is in the hull of three images and one opposite to the first; in any order, the test finds C inside"
    return search(IMAGES, is_inside, cases, message)


@claim("appel-will.103", step="step5")
@claim("appel-will.105", step="step7")
def step_as_printed(step: str) -> Check:
    points = counterexample_points("fig23.csv" if step == "step7" else "fig14.csv")
    table, corrected = (appel_will(points, method=method).table for method in (printed(step), CORRECTED))
    firsts = [(abs(a.entries[0]), abs(b.entries[0])) for a, b in zip(table.loops, corrected.loops, strict=True)]
    begins = [f"loop {n} begins with line {a} instead of {b}" for n, (a, b) in enumerate(firsts, 1) if a != b]
    return slip(not begins, corrected.closed, "step 3", f"with the printed step number, {', '.join(begins)}")


@claim("appel-will.148")
def limit_of_searches() -> Check:
    points = counterexample_points("pentagon.csv")
    hull = appel_will(points, method=printed("step9", "step3"))
    polygon, endless = exact_hull(points).polygon, 0
    # A loop begins with the lines from a corner to its neighbours SP and MP. A search that returns to an MP never ends.
    starts = [ring[k:] + ring[:k] for ring in (polygon, polygon[::-1]) for k in range(len(polygon))]
    for corner, match, *_, start in starts:
        visited: set[int] = set()
        while match not in (start, *visited):
            visited.add(match)
            match = next(sum(edge) - match for edge in hull.edges if match in edge and corner not in edge)
        endless += match != start
    message = f"{endless} of {len(starts)} searches around a pentagon never end; a limit stops the method: {hull.fault}"
    return exhibited(endless > 0 and hull.fault.endswith("does not return to its start"), message)

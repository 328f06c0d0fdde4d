"""Claims of Appel and Will on objects given by surfaces: the map, lines and planes, inside corners, preprocessing."""

from __future__ import annotations

import math
from collections import Counter
from fractions import Fraction
from functools import cache
from itertools import combinations

from modern.claims.appel_will.convexity import CUBE, Flat
from modern.claims.published import PAPERS, printed_lines
from modern.claims.register import CheckResult, counterexample, fails_if, holds_if
from modern.claims.sampled_sets import Point, counterexample_points, plane_through, plane_value, random_triples
from modern.exact_hull import exact_hull
from modern.formats.off import parse_off
from modern.geometry.vectors import cross, dot, lowest, minus
from modern.papers.appel_will import Method, appel_will
from modern.papers.appel_will.corners import corners, preprocess, triple_product
from modern.papers.appel_will.results import Solid, printed_solid
from modern.papers.appel_will.star import as_corrected
from modern.papers.appel_will.surfaces import area_normal, lines, oriented

Whole = tuple[int, int, int]
TETRAHEDRON: tuple[Point, ...] = ((0, 0, 0), (12, 0, 0), (0, 12, 0), (0, 0, 12))
PITS: dict[tuple[int, int, int], Point] = {
    (0, 2, 1): (4, 4, 1),
    (0, 1, 3): (4, 1, 4),
    (0, 3, 2): (1, 4, 4),
    (1, 2, 3): (3, 3, 3),
}
"""The apex of the pit in each face of the tetrahedron."""


@cache
def fig_4() -> Solid:
    """The object of Fig. 4 as the corrected print has it."""
    return printed_solid(printed_lines(next(paper for paper in PAPERS if paper.name == "appel-will")))


def crown() -> Solid:
    """A pyramid over a star with four points."""
    mesh = parse_off(counterexample("crown.off"), "crown.off")
    points = tuple((int(x), int(y), int(z)) for x, y, z in mesh.points)
    return Solid(points, tuple(tuple(face) for face in mesh.faces))


def bent() -> Solid:
    """An L of three cubes, where three planes meet at each point."""
    ring: list[Flat] = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
    sides = [(k, (k + 1) % 6, (k + 1) % 6 + 6, k + 6) for k in range(6)]
    return Solid(tuple((x, y, z) for z in (0, 1) for x, y in ring), ((5, 4, 3, 2, 1, 0), (6, 7, 8, 9, 10, 11), *sides))


def pitted() -> Solid:
    """A tetrahedron with a pit in every face, the apex of each as PITS has it."""
    points, surfaces = [*TETRAHEDRON], []
    for face, apex in PITS.items():
        points.append(apex)
        surfaces += [(a, b, len(points) - 1) for a, b in zip(face, (*face[1:], face[0]), strict=True)]
    return Solid(tuple(points), tuple(surfaces))


def surface_three() -> CheckResult:
    """The object of Fig. 4 with surface III as it is numbered: two of its lines are on no other surface."""
    mesh = parse_off(counterexample("fig4_printed.off"), "fig4_printed.off")
    sides = Counter(frozenset(pair) for face in mesh.faces for pair in zip(face, (*face[1:], face[0]), strict=True))
    alone = sorted(tuple(sorted(k + 1 for k in side)) for side, n in sides.items() if n == 1)
    return fails_if(alone, f"lines on one surface only: {', '.join(f'{a}-{b}' for a, b in alone)}")


def inside_corner_at_vertex(kind: str = "") -> CheckResult:
    """A crown: rule ``any`` deletes a vertex of the hull, a condition where it is said to delete none."""
    solid = crown()
    deleted = preprocess(solid.points, solid.surfaces, "any").deleted
    lost = [k + 1 for k in deleted if k in exact_hull(solid.points).vertices]
    message = f"point {', '.join(map(str, lost))} is deleted"
    return holds_if(lost, message, conditional=not kind)


def two_inside_corners() -> CheckResult:
    """A crown: points on two inside corners or more, and those of them with at most one outside corner."""
    solid = crown()
    vertices = {*exact_hull(solid.points).vertices}
    preprocessed = preprocess(solid.points, solid.surfaces, "two")
    at = Counter(end for corner in preprocessed.inside for end in corner.line.ends)
    wrong = [k for k, count in at.items() if count >= 2 and k in vertices]
    message = f"point {', '.join(f'{k + 1} is on {at[k]} inside corners' for k in wrong)} and a vertex of the hull"
    return holds_if(wrong and not vertices & {*preprocessed.deleted}, message, conditional=True)


def preprocessing_cost(kind: str = "") -> CheckResult:
    """Fig. 4: projections and star polygons with inside corners and without; where nothing is deleted, as many.

    ``cheap``: one triple product a line, against the images that are saved: of each pair all other points have one.
    """
    solid, counts, stars = fig_4(), {}, [0]

    def counted(images: object) -> bool:
        stars[0] += 1
        return as_corrected(images)  # type: ignore[arg-type]

    for rule in (None, "any", "two"):
        stars[0] = 0
        hull = appel_will(solid.points, solid.surfaces, Method(star=counted, inside_corners=rule))
        counts[rule] = (hull.projections, stars[0])
    plain, fewer = counts[None], counts["any"]
    passed = fewer[0] < plain[0] and fewer[1] < plain[1] and counts["two"] == plain
    message = f"{plain[0]} projections and {plain[1]} stars, {fewer[0]} and {fewer[1]} without two points"
    if kind:
        products = len(corners(solid.points, oriented(solid.points, solid.surfaces)))
        points_kept = len(solid.points) - len(preprocess(solid.points, solid.surfaces, "any").deleted)
        images = plain[0] * (len(solid.points) - 2) - fewer[0] * (points_kept - 2)
        return holds_if(passed and products < images, f"{products} triple products save {images} images of points")
    return holds_if(passed, f"{message}; as many where none is deleted", conditional=True)


def minimum_data() -> CheckResult:
    """Fig. 4: its lines from its surfaces as sets of points alone; by its points alone another object is described.

    Of a cube the points alone are enough.
    """
    solid = fig_4()
    sets = [frozenset(surface) for surface in solid.surfaces]
    shared = Counter(
        pair
        for first_set, second_set in combinations(sets, 2)
        if len(both := first_set & second_set) == 2
        for pair in [both]
    )
    mapped = {frozenset(line.ends) for line in lines(oriented(solid.points, solid.surfaces))}
    without = {frozenset(edge) for edge in exact_hull(solid.points).edges()}
    cube = exact_hull(CUBE)
    passed = {*shared} == mapped != without and (len(cube.vertices), len(cube.facets)) == (8, 6)
    return holds_if(
        passed, f"{len(mapped)} lines out of {len(sets)} surfaces; a cube from its points", conditional=True
    )


def hulls_of_surfaces(kind: str) -> CheckResult:
    """Objects of four kinds: in how many surfaces' own hulls each point stands.

    ``redundant``: each is looked at three times or more; ``relation``: a vertex of the hull is one of the hulls of all
    surfaces it is on, and some points are that and no vertices.
    """
    checks, exceptions, point_count = [], 0, 0
    for solid in (fig_4(), crown(), bent(), pitted()):
        vertices = exact_hull(solid.points).vertices
        for point in range(len(solid.points)):
            on = [surface for surface in solid.surfaces if point in surface]
            own = all(surface.index(point) in exact_hull([solid.points[k] for k in surface]).vertices for surface in on)
            point_count += 1
            checks.append(len(on) >= 3 if kind == "redundant" else own or point not in vertices)
            exceptions += own and point not in vertices
    if kind == "redundant":
        return holds_if(all(checks), f"{point_count} points, each on three surfaces or more")
    message = f"{exceptions} of {point_count} points are vertices of all their surfaces' hulls and not of the hull"
    return holds_if(all(checks) and exceptions, message, conditional=True)


def vertex_without_supporting_surface() -> CheckResult:
    """A pit in every face of a tetrahedron: no surface of the object supports, its corners are vertices all the same.

    No two surfaces are in one plane.
    """
    solid = pitted()
    planes = {}
    for surface in oriented(solid.points, solid.surfaces):
        normal = lowest(area_normal(solid.points, surface))
        sign = 1 if max(normal, minus((0, 0, 0), normal)) == normal else -1
        planes[surface] = (*(sign * n for n in normal), -sign * dot(normal, solid.points[surface[0]]))
    supporting = 0
    for plane in planes.values():
        values = [plane_value(plane, point) for point in solid.points]  # type: ignore[arg-type]
        supporting += max(values) <= 0 or min(values) >= 0
    passed = supporting == 0 and exact_hull(solid.points).vertices == (0, 1, 2, 3)
    passed &= len({*planes.values()}) == len(solid.surfaces) == 12
    return holds_if(passed, f"{len({*planes.values()})} planes, {supporting} of them supporting; four vertices")


def objects_with_same_hull() -> CheckResult:
    """A cube with 1, 2 and 3 further points inside has the cube's hull."""
    hulls = [
        exact_hull([*((4 * x, 4 * y, 4 * z) for x, y, z in CUBE), *((k, k, 1) for k in range(1, 1 + n))])
        for n in (1, 2, 3)
    ]
    return holds_if(all(h.vertices == tuple(range(8)) and len(h.facets) == 6 for h in hulls), "three objects, one hull")


def direction(p: Whole, q: Whole) -> tuple[Fraction, Fraction, Fraction, int]:
    """a, b, c and l of the line from p to q, as printed.  Raises ValueError if l is no whole number."""
    square = sum((b - a) ** 2 for a, b in zip(p, q, strict=True))
    length = math.isqrt(square)
    if length * length != square:
        raise ValueError(f"the length of {p} to {q} is no whole number")
    a, b, c = (Fraction(end - start, length) for start, end in zip(p, q, strict=True))
    return a, b, c, length


def unit_directions() -> CheckResult:
    """Lines whose length is whole: a, b, c are of length 1, and x1 + a t is at t = 0 one end, at t = l the other."""
    checks = []
    for p, q in (((1, 2, 3), (2, 4, 5)), ((4, 0, -1), (6, 3, 5)), ((0, 0, 7), (4, -8, 6)), ((2, 2, 2), (2, 5, -2))):
        a, b, c, length = direction(p, q)
        checks.append(a * a + b * b + c * c == 1)
        for t, at in ((0, p), (length, q)):
            checks += [x + u * t == expected for x, u, expected in zip(p, (a, b, c), at, strict=True)]
        third = Fraction(length, 3)
        gone = [u * third for u in (a, b, c)]
        checks.append(9 * sum(u * u for u in gone) == length * length)
    return holds_if(all(checks), "four lines; at a third of l a third of the way is gone")


def unit_plane(p: Whole, q: Whole, r: Whole) -> tuple[Fraction, ...]:
    """a, b, c of length 1 by the cross product of two lines, and d = -(a x0 + b y0 + c z0) of the point p."""
    a, b, c, _ = direction((0, 0, 0), cross(minus(q, p), minus(r, p)))
    return a, b, c, -(a * p[0] + b * p[1] + c * p[2])


def planes_of_surfaces() -> CheckResult:
    """Planes of three points, whose normals have a whole length: all three are on it; beyond it, the value is t."""
    checks = []
    for n, length in (((1, 2, 2), 3), ((2, 3, 6), 7), ((4, -1, 8), 9)):
        u = (n[1], -n[0], 0)
        p: Whole = (1, 1, -2)
        q: Whole = (p[0] + u[0], p[1] + u[1], p[2])
        v = cross(n, u)
        r: Whole = (p[0] + v[0], p[1] + v[1], p[2] + v[2])
        a, b, c, d = unit_plane(p, q, r)
        checks += [a * x + b * y + c * z + d == 0 for x, y, z in (p, q, r)]
        x, y, z = (k + m for k, m in zip(q, n, strict=True))
        checks.append(abs(a * x + b * y + c * z + d) == length)
    return holds_if(all(checks), f"{len(checks)} values of three planes")


def normal_from_two_lines() -> CheckResult:
    """Three objects: at each corner of each surface the cross product of its two lines stands upright on the surface.

    Of unit directions it has the length 1 at right angles only; at a concave corner it points the other way.
    """
    checks, turned, shorter = [], 0, 0
    for solid in (fig_4(), crown(), bent()):
        for ring in oriented(solid.points, solid.surfaces):
            normal = area_normal(solid.points, ring)
            for k, corner in enumerate(ring):
                u, v = (
                    minus(solid.points[b], solid.points[a])
                    for a, b in ((ring[k - 1], corner), (corner, ring[k - len(ring) + 1]))
                )
                product_ = cross(u, v)
                checks.append(lowest(product_) in (lowest(normal), minus((0, 0, 0), lowest(normal))))
                turned += dot(product_, normal) < 0
                shorter += dot(product_, product_) < dot(u, u) * dot(v, v)
    message = f"{len(checks)} corners, {turned} where the product is turned over, {shorter} where its length is below 1"
    return holds_if(all(checks) and 0 < turned < len(checks) and 0 < shorter < len(checks), message, conditional=True)


def product_of_directions() -> CheckResult:
    """Two sides of a triangle that meet at an obtuse angle: the product of their directions is negative."""
    p, corner, r = counterexample_points("obtuse.csv")
    product_ = dot(minus(p, corner), minus(r, corner))
    return fails_if(product_ < 0, f"the product is {product_}, the angle between 90 and 180 degrees")


def normal_line() -> CheckResult:
    """From a point of a plane along its normal: at t the value of the plane is t times the normal's square."""
    checks = []
    for p, q, r in random_triples():
        plane = plane_through(p, q, r)
        square = dot(plane[:3], plane[:3])
        for t in (-2, 0, 3):
            x, y, z = (a + t * n for a, n in zip(p, plane[:3], strict=True))
            checks.append(plane_value(plane, (x, y, z)) == t * square)
    return holds_if(all(checks), f"{len(checks)} points of normals; with unit normals the value is t")


def direction_of_line(kind: str = "") -> CheckResult:
    """Fig. 18's determinants with the line run the other way, and with the surfaces exchanged: each sign turns."""
    rows = {"512": ((-1, 0, 0), (0, 0, -1), (0, -1, 0)), "723": ((-1, 0, 0), (0, -1, 0), (0, 0, -1))}
    signs = {}
    for name, matrix in rows.items():
        columns: list[Whole] = [(matrix[0][k], matrix[1][k], matrix[2][k]) for k in range(3)]
        i, k, m = columns
        signs[name] = (triple_product(i, k, m), triple_product(minus((0, 0, 0), i), k, m), triple_product(i, m, k))
    passed = signs == {"512": (1, -1, -1), "723": (-1, 1, 1)}
    message = "[512] is 1 and [723] -1; run the other way, or with surfaces exchanged, -1 and 1"
    return holds_if(passed, message, conditional=kind)


def corners_of_three_planes() -> CheckResult:
    """An L of three cubes, where three planes meet at each point: no point of its inside corner is a vertex."""
    points, faces = bent().points, bent().surfaces
    deleted = preprocess(points, faces, "any").deleted
    meeting = {sum(k in face for face in faces) for k in range(12)}
    passed = {*deleted} == {3, 9} and meeting == {3} and not {*deleted} & {*exact_hull(points).vertices}
    return holds_if(passed, f"points {', '.join(str(points[k]) for k in sorted(deleted))} are deleted")


def simple_hull_of_complex_object() -> CheckResult:
    """A pit of 27 points in a cube's top, and the cube has its eight vertices and six faces still."""
    cube = [(8 * x, 8 * y, 8 * z) for x, y, z in CUBE]
    pit = [(x, y, 7 - (x + y) % 3) for x in range(1, 8, 1) for y in range(1, 8, 2)][:27]
    hull = exact_hull([*cube, *pit])
    return holds_if(hull.vertices == tuple(range(8)) and len(hull.facets) == 6, f"{8 + len(pit)} points, 8 vertices")

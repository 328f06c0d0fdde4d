"""Checks of Appel and Will on objects given by surfaces: maps, lines and planes, inside corners, preprocessing."""

from collections import Counter
from functools import cache
from itertools import combinations

from modern.claims.appel_will.convexity import CUBE, RINGS, Flat
from modern.claims.appel_will.proofs import product_of_lines
from modern.claims.evidence import Check, claim, exhibited, refuted, search, slip
from modern.claims.invariants import is_sphere
from modern.claims.kovalevsky_schulz.proofs import vertex_is_no_combination
from modern.claims.published import PAPERS, findings, printed_lines
from modern.claims.sampled_sets import (
    Point,
    counterexample,
    counterexample_points,
    plane_value,
)
from modern.exact_hull import exact_hull
from modern.formats.off import parse_off
from modern.geometry.vectors import area_vector, cross, dot, lowest, minus
from modern.papers.appel_will import Method, appel_will
from modern.papers.appel_will.corners import Rule, corners, preprocess, triple_product
from modern.papers.appel_will.results import Solid, printed_solid
from modern.papers.appel_will.star import as_corrected
from modern.papers.appel_will.surfaces import lines, oriented

Whole = tuple[int, int, int]
TETRAHEDRON: tuple[Point, ...] = ((0, 0, 0), (12, 0, 0), (0, 12, 0), (0, 0, 12))
# The apex of the pit in each face of the tetrahedron.
PITS: dict[tuple[int, int, int], Point] = {
    (0, 2, 1): (4, 4, 1),
    (0, 1, 3): (4, 1, 4),
    (0, 3, 2): (1, 4, 4),
    (1, 2, 3): (3, 3, 3),
}


@cache
def fig_4() -> Solid:
    return printed_solid(printed_lines(next(paper for paper in PAPERS if paper.name == "appel-will")))


def crown() -> Solid:
    """Return a pyramid whose base is a star with four points."""
    mesh = parse_off(counterexample("crown.off"), "crown.off")
    points = tuple((int(x), int(y), int(z)) for x, y, z in mesh.points)
    return Solid(points, tuple(tuple(face) for face in mesh.faces))


def bent() -> Solid:
    """Return an L-shaped solid of three cubes, at each point of which three planes meet."""
    ring: list[Flat] = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
    sides = [(k, (k + 1) % 6, (k + 1) % 6 + 6, k + 6) for k in range(6)]
    return Solid(tuple((x, y, z) for z in (0, 1) for x, y in ring), ((5, 4, 3, 2, 1, 0), (6, 7, 8, 9, 10, 11), *sides))


def pitted() -> Solid:
    """Return a tetrahedron with a pit in every face."""
    points, surfaces = [*TETRAHEDRON], []
    for face, apex in PITS.items():
        points.append(apex)
        surfaces += [(a, b, len(points) - 1) for a, b in zip(face, (*face[1:], face[0]), strict=True)]
    return Solid(tuple(points), tuple(surfaces))


def objects() -> tuple[Solid, ...]:
    return fig_4(), crown(), bent(), pitted()


@claim("appel-will.22")
def surface_three() -> Check:
    """Check that the object of Fig. 4 is not closed with surface III as printed: some lines have only one surface."""
    mesh = parse_off(counterexample("fig4_printed.off"), "fig4_printed.off")
    sides = Counter(frozenset(pair) for face in mesh.faces for pair in zip(face, (*face[1:], face[0]), strict=True))
    alone = sorted(tuple(sorted(k + 1 for k in side)) for side, n in sides.items() if n == 1)
    rings = [[k + 1 for k in face] for face in mesh.faces]
    corrected = is_sphere([[5, 6, 9, 10] if ring == [5, 6, 10, 9] else ring for ring in rings])
    message = f"lines on one surface only: {', '.join(f'{a}-{b}' for a, b in alone)}"
    return slip(not alone, corrected, "5, 6, 9, 10", message)


@claim("appel-will.155")
def inside_corner_at_vertex() -> Check:
    """Check that deleting all points on inside corners deletes a vertex of the hull of a pyramid on a star."""
    solid = crown()
    deleted = preprocess(solid.points, solid.surfaces, "any").deleted
    lost = [k + 1 for k in deleted if k in exact_hull(solid.points).vertices]
    return exhibited(
        lost, f"point {', '.join(map(str, lost))} of the crown is deleted although it is a vertex of the hull"
    )


def prism(ring: tuple[Flat, ...]) -> Solid:
    """Return a prism on a simple polygon; three of its planes meet at each point."""
    n = len(ring)
    sides = [(k, (k + 1) % n, (k + 1) % n + n, k + n) for k in range(n)]
    points = tuple((x, y, z) for z in (0, 1) for x, y in ring)
    return Solid(points, (tuple(range(n))[::-1], tuple(range(n, 2 * n)), *sides))


def keeps_vertices(ring: tuple[Flat, ...], rule: Rule) -> bool:
    """Return True if a deletion rule deletes no vertex of the hull of the prism over a polygon."""
    solid = prism(ring)
    return not {*preprocess(solid.points, solid.surfaces, rule).deleted} & {*exact_hull(solid.points).vertices}


@claim("appel-will.72", "appel-will.75", "appel-will.136", rule="any", full=2_000)
@claim("appel-will.74", rule="two", full=2_000)
def deletion_in_prisms(rule: Rule, cases: int = 5) -> Check:
    """Check that a deletion rule deletes no vertex of the hull of a prism, at each point of which three planes meet."""
    return search(RINGS, lambda ring: keeps_vertices(ring, rule), cases, "no vertex of the hull of a prism is deleted")


@claim("appel-will.43", full=2_000)
def inside_corners_deleted(cases: int = 5) -> Check:
    """Check that deletion keeps the vertices of prisms, but not those of the crown, a pyramid over a star."""
    crown_ = inside_corner_at_vertex()
    return deletion_in_prisms("any", cases).unless(crown_.holds, f"a star: {crown_.message}")


@claim("appel-will.84")
def sense_of_surfaces() -> Check:
    """Check that listing surfaces in the opposite sense does not change the inside corners of four objects."""
    same = []
    for solid in objects():
        turned = tuple(surface[::-1] if k % 2 else surface for k, surface in enumerate(solid.surfaces))
        both = [corners(solid.points, oriented(solid.points, surfaces)) for surfaces in (solid.surfaces, turned)]
        kinds = [{frozenset(c.line.ends): c.product < 0 for c in of_solid} for of_solid in both]
        same.append(kinds[0] == kinds[1])
    return exhibited(all(same), "the corners of four objects do not depend on the sense of their surfaces")


@claim("appel-will.73")
def two_inside_corners() -> Check:
    """Check that a vertex of the hull can be on two inside corners of the object if it has several outside corners."""
    solid = crown()
    vertices = {*exact_hull(solid.points).vertices}
    preprocessed = preprocess(solid.points, solid.surfaces, "two")
    at = Counter(end for corner in preprocessed.inside for end in corner.line.ends)
    wrong = [k for k, count in at.items() if count >= 2 and k in vertices]
    message = f"point {', '.join(f'{k + 1} is on {at[k]} inside corners' for k in wrong)} and is a vertex of the hull"
    check = exhibited(
        not vertices & {*preprocessed.deleted}, "a limit of one outside corner keeps all vertices of the crown"
    )
    return check.unless(wrong, message)


@claim("appel-will.152")
@claim("appel-will.69", subject="cost")
def preprocessing_cost(subject: str = "projections") -> Check:
    """Check that deleting the inside corners of Fig. 4 saves projections and star polygons.

    subject: ``cost`` compares one triple product for each line with the saved projections of points.
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
    passed = fewer[0] < plain[0] and fewer[1] < plain[1]
    message = f"{plain[0]} projections and {plain[1]} stars; {fewer[0]} and {fewer[1]} after two points are deleted"
    if subject == "cost":
        products = len(corners(solid.points, oriented(solid.points, solid.surfaces)))
        points_kept = len(solid.points) - len(preprocess(solid.points, solid.surfaces, "any").deleted)
        images = plain[0] * (len(solid.points) - 2) - fewer[0] * (points_kept - 2)
        return exhibited(passed and products < images, f"{products} triple products save {images} images of points")
    nothing = "rule two, which deletes no point of Fig. 4 and saves nothing"
    return exhibited(passed, message).unless(counts["two"] == plain, nothing)


@claim("appel-will.154")
def minimum_data() -> Check:
    """Check that the surfaces of Fig. 4, as sets of points, determine its lines, whereas its points alone do not."""
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
    message = f"{len(sets)} surfaces of Fig. 4 determine its {len(mapped)} lines, and its points alone do not"
    points_enough = (len(cube.vertices), len(cube.facets)) == (8, 6)
    check = exhibited({*shared} == mapped != without, message)
    return check.unless(points_enough, "a cube, whose points are enough")


@claim("appel-will.77")
def points_on_three_surfaces() -> Check:
    """Check that points of four objects are on three or more surfaces."""
    counts = [sum(k in surface for surface in s.surfaces) for s in objects() for k in range(len(s.points))]
    return exhibited(min(counts) >= 3, f"each of {len(counts)} points of four objects is on three or more surfaces")


@claim("appel-will.78")
def hulls_of_surfaces() -> Check:
    """Check that a vertex of a surface's hull may not be a vertex of the object's hull; the converse always holds."""
    solid = pitted()
    apex = max(range(len(solid.points)), key=lambda k: k not in exact_hull(solid.points).vertices)
    surfaces_at = [surface for surface in solid.surfaces if apex in surface]
    own = all(s.index(apex) in exact_hull([solid.points[k] for k in s]).vertices for s in surfaces_at)
    unrelated = own and apex not in exact_hull(solid.points).vertices
    check = exhibited(unrelated, "the apex of a pit is a vertex of the hulls of its surfaces, but not of the hull")
    case = "a vertex of the hull, which is a vertex of the hull of each of its surfaces (proved)"
    return check.unless(vertex_is_no_combination().check().holds, case)


@claim("appel-will.138", "appel-will.76")
def vertex_without_supporting_surface() -> Check:
    """Check that a vertex of the hull need not be on a surface of the object whose plane supports the hull."""
    solid = pitted()
    planes = {}
    for surface in oriented(solid.points, solid.surfaces):
        normal = lowest(area_vector(solid.points, surface))
        sign = 1 if max(normal, minus((0, 0, 0), normal)) == normal else -1
        planes[surface] = (*(sign * n for n in normal), -sign * dot(normal, solid.points[surface[0]]))
    supporting = 0
    for plane in planes.values():
        values = [plane_value(plane, point) for point in solid.points]  # type: ignore[arg-type]
        supporting += max(values) <= 0 or min(values) >= 0
    passed = supporting == 0 and exact_hull(solid.points).vertices == (0, 1, 2, 3)
    passed &= len({*planes.values()}) == len(solid.surfaces) == 12
    message = f"{supporting} of {len({*planes.values()})} planes of surfaces support, but the hull has four vertices"
    return exhibited(passed, message)


@claim("appel-will.157")
def normal_from_two_lines() -> Check:
    """Check that the cross product of two lines of a surface is normal to it, and points inward at a concave corner."""
    solid, turned, shorter = bent(), 0, 0
    for ring in oriented(solid.points, solid.surfaces):
        normal = area_vector(solid.points, ring)
        for a, corner, b in zip(ring, (*ring[1:], ring[0]), (*ring[2:], *ring[:2]), strict=True):
            u, v = (minus(solid.points[q], solid.points[p]) for p, q in ((a, corner), (corner, b)))
            turned += dot(cross(u, v), normal) < 0
    for ring in oriented(crown().points, crown().surfaces):
        u, v = (minus(crown().points[k], crown().points[ring[1]]) for k in (ring[0], ring[2]))
        # For unit directions the length of the product is the sine of the angle.
        shorter += dot(cross(u, v), cross(u, v)) < dot(u, u) * dot(v, v)
    case = f"corners where the product is reversed ({turned}) or shorter than 1 ({shorter})"
    return product_of_lines().check().unless(turned and shorter, case)


@claim("appel-will.83")
def product_of_directions() -> Check:
    """Check that the dot product of the directions of two sides is negative if their angle is obtuse."""
    p, corner, r = counterexample_points("obtuse.csv")
    product_ = dot(minus(p, corner), minus(r, corner))
    return refuted(product_ < 0, f"the product is {product_} for an obtuse angle")


@claim("appel-will.85")
def direction_of_line() -> Check:
    """Check that the determinants of Fig. 18 change sign if the line is reversed or its two surfaces are exchanged."""
    rows = {"512": ((-1, 0, 0), (0, 0, -1), (0, -1, 0)), "723": ((-1, 0, 0), (0, -1, 0), (0, 0, -1))}
    signs = {}
    for name, matrix in rows.items():
        columns: list[Whole] = [(matrix[0][k], matrix[1][k], matrix[2][k]) for k in range(3)]
        i, k, m = columns
        signs[name] = (triple_product(i, k, m), triple_product(minus((0, 0, 0), i), k, m), triple_product(i, m, k))
    kept = [product_[0] for product_ in signs.values()] == [1, -1]
    changed = [product_[1:] for product_ in signs.values()] == [(-1, -1), (1, 1)]
    check = exhibited(kept, "[512] is 1 and [723] is -1")
    return check.unless(changed, "a reversed line, or exchanged surfaces: the sign changes")


@claim("appel-will.140")
def sense_of_line() -> Check:
    """Check that the direction of a line decides the sign of the determinant that tests for an inside corner."""
    check = direction_of_line()
    return exhibited(check.evidence.violation, f"{check.message}; {check.evidence.violation}")


@claim("appel-will.80")
def figure_of_minimum_data() -> Check:
    """Check that the figure with a list of points and a topological map is Fig. 4, although the text says Fig. 3."""
    paper = next(paper for paper in PAPERS if paper.name == "appel-will")
    finding = next(finding for finding in findings(paper) if finding.result.id == "figure-number")
    words, printed, corrected = (
        " ".join(lines).split() for lines in (finding.produced, finding.result.printed, finding.result.corrected)
    )
    return slip(
        words == printed, words == corrected, "Fig. 4", "Fig. 3 shows no polyhedron; Fig. 4 has a list and a map"
    )


@claim("appel-will.79", "appel-will.91")
def simple_hull_of_complex_object() -> Check:
    """Check that a cube with a pit of 1, 2, 3 or 27 points has the hull of the cube: 8 vertices and 6 faces."""
    cube = [(8 * x, 8 * y, 8 * z) for x, y, z in CUBE]
    pit = [(x, y, 7 - (x + y) % 3) for x in range(1, 8) for y in range(1, 8, 2)]
    hulls = [exact_hull([*cube, *pit[:n]]) for n in (1, 2, 3, 27)]
    same = all(hull.vertices == tuple(range(8)) and len(hull.facets) == 6 for hull in hulls)
    return exhibited(same, "four objects, one of 35 points, have the hull of a cube")

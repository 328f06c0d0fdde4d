"""Checks of Appel and Will on objects given by surfaces: maps, lines and planes, inside corners, preprocessing."""

from collections import Counter
from collections.abc import Collection, Sequence
from functools import cache
from itertools import combinations, pairwise, product

from modern.claims.appel_will.convexity import CUBE, RINGS, Flat
from modern.claims.appel_will.proofs import outside_corners
from modern.claims.evidence import Check, claim, exhibited, refuted, search, slip
from modern.claims.hulls import exact_hull
from modern.claims.invariants import corrected_print, is_sphere, numbers_in
from modern.claims.kovalevsky_schulz.proofs import vertex_is_no_combination
from modern.claims.published import PAPERS, findings, results_of
from modern.claims.sampled_sets import Plane, Point, counterexample, counterexample_points, plane_value
from modern.formats.off import parse_off
from modern.geometry.mesh import sides
from modern.geometry.vectors import area_vector, cross, dot, lowest, minus
from modern.papers.appel_will import Method, appel_will
from modern.papers.appel_will.corners import Rule, preprocess
from modern.papers.appel_will.results import Solid, printed_solid
from modern.papers.appel_will.star import as_corrected

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
    return printed_solid(corrected_print("appel-will"))


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


def twisted() -> Solid:
    """Return a twisted prism: its six upright triangles meet in pairs at inside corners, so that it is not convex."""
    points: tuple[Point, ...] = ((6, 0, 0), (-3, 5, 0), (-3, -5, 0), (5, 3, 6), (-5, 3, 6), (0, -6, 6))
    upright = (((k, (k + 1) % 3, (k + 1) % 3 + 3), (k, (k + 1) % 3 + 3, k + 3)) for k in range(3))
    return Solid(points, ((2, 1, 0), (3, 4, 5), *(surface for pair in upright for surface in pair)))


@claim("appel-will.24")
def changes_of_hull() -> Check:
    """Check that the hull of Fig. 4 lacks points and has new lines and planes, unlike those of two other objects."""
    block = solid_of_cubes([cube for cube in product(range(3), repeat=3) if cube != (1, 1, 2)])
    changes = [_changes(solid) for solid in (fig_4(), twisted(), block)]
    deleted, new_lines, new_planes = changes[0]
    message = f"the hull of Fig. 4: {deleted} points deleted, new lines: {new_lines}, new planes: {new_planes}"
    others = changes[1][0] == 0 < min(changes[1][1:]) and changes[2][0] > 0 == max(changes[2][1:])
    case = "a twisted prism, all points of which remain, and a block with a pit, whose hull has no new line or plane"
    return exhibited(min(changes[0]) > 0, message).unless(others, case)


def _changes(solid: Solid) -> tuple[int, int, int]:
    """Return three numbers: points that are no vertices of the hull, and new lines and planes of the hull.

    An edge of the hull that consists of several lines of the solid is not new.
    """
    points, judge = solid.points, exact_hull(solid.points)
    of_surfaces = {_plane_of(points, surface) for surface in solid.surfaces}
    planes = {_plane_of(points, facet.polygon) for facet in judge.facets} - of_surfaces
    at = _surfaces_at_lines(solid)
    edges = 0
    for a, b in judge.edges():
        way = minus(points[b], points[a])
        on = sorted((p, k) for k, p in enumerate(points) if not any(cross(way, minus(p, points[a]))))
        edges += any(frozenset((k, m)) not in at for (_, k), (_, m) in pairwise(on))
    return len(points) - len(judge.vertices), edges, len(planes)


@claim("appel-will.22")
def surface_three() -> Check:
    """Check that the object of Fig. 4 is not closed with surface III as printed: some lines have only one surface."""
    mesh = parse_off(counterexample("fig4_printed.off"), "fig4_printed.off")
    solid = Solid((), tuple(tuple(k + 1 for k in face) for face in mesh.faces))
    corrected = [numbers_in(row) for row in corrected_print("appel-will")["fig4-topological-map"]]
    (result,) = (result for result in results_of(PAPERS[0]) if result.id == "fig4-topological-map")
    printed = [*corrected[:2], numbers_in(result.printed[2]), *corrected[3:]]
    alone = sorted(tuple(sorted(line)) for line, count in _surfaces_at_lines(solid).items() if count == 1)
    message = f"lines on one surface only: {', '.join(f'{a}-{b}' for a, b in alone)}"
    is_refuted = alone and printed == [[*face] for face in solid.surfaces]
    return slip(not is_refuted, is_sphere(corrected), ", ".join(map(str, corrected[2])), message)


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
    """Return a prism on a simple polygon; at most three of its planes meet at each point."""
    n = len(ring)
    sides = [(k, (k + 1) % n, (k + 1) % n + n, k + n) for k in range(n)]
    points = tuple((x, y, z) for z in (0, 1) for x, y in ring)
    return Solid(points, (tuple(range(n))[::-1], tuple(range(n, 2 * n)), *sides))


def keeps_vertices(ring: tuple[Flat, ...], rule: Rule) -> bool:
    """Return True if a deletion rule deletes no vertex of the hull of the prism over a polygon."""
    solid = prism(ring)
    return not {*preprocess(solid.points, solid.surfaces, rule).deleted} & {*exact_hull(solid.points).vertices}


@claim("appel-will.72", rule="any", full=2_000)
@claim("appel-will.75", rule="concave", full=2_000)
def deletion_in_prisms(rule: Rule, cases: int = 5) -> Check:
    """Check that a rule deletes no vertex of the hull of a prism, at whose points at most three planes meet."""
    return search(RINGS, lambda ring: keeps_vertices(ring, rule), cases, "no vertex of the hull of a prism is deleted")


def _surfaces_at_lines(solid: Solid) -> Counter[frozenset[int]]:
    return Counter(frozenset(line) for surface in solid.surfaces for line in sides(surface))


def solid_of_cubes(cubes: Collection[tuple[int, ...]]) -> Solid:
    """Return the solid that unit cubes fill; its surfaces are the squares that belong to one cube only."""
    squares: Counter[frozenset[tuple[int, ...]]] = Counter()
    for cube, axis, side in product(cubes, range(3), (0, 1)):
        corners_ = (tuple(c + d for c, d in zip(cube, way, strict=True)) for way in CUBE if way[axis] == side)
        squares[frozenset(corners_)] += 1
    outer = [sorted(square) for square, count in squares.items() if count == 1]
    points = sorted({point for square in outer for point in square})
    # Sorted corners a, b, c, d of a square follow each other in the order a, b, d, c.
    return Solid(tuple(points), tuple(tuple(points.index(s[k]) for k in (0, 1, 3, 2)) for s in outer))  # type: ignore[arg-type]


@claim("appel-will.73")
def two_inside_corners() -> Check:
    """Prove that the limit of one outside corner keeps all vertices; without it, the apex of the crown is deleted."""
    solid = crown()
    vertices = {*exact_hull(solid.points).vertices}
    preprocessed = preprocess(solid.points, solid.surfaces, "two")
    at = Counter(end for corner in preprocessed.inside for end in corner.line.ends)
    wrong = [k for k, count in at.items() if count >= 2 and k in vertices]
    points = ", ".join(f"point {k + 1} of the crown, a vertex of the hull on {at[k]} inside corners" for k in wrong)
    return outside_corners().check().unless(wrong, points)


@claim("appel-will.152")
def preprocessing_saves() -> Check:
    """Check that deleting the points on inside corners of Fig. 4 saves projections and star polygons."""
    solid, counts, stars = fig_4(), [], [0]

    def counted(images: object) -> bool:
        stars[0] += 1
        return as_corrected(images)  # type: ignore[arg-type]

    for rule in (None, "any"):
        stars[0] = 0
        hull = appel_will(solid.points, solid.surfaces, Method(star=counted, inside_corners=rule))
        counts.append((hull.projections, stars[0]))
    plain, fewer = (f"{projections} projections and {tests} star polygon tests" for projections, tests in counts)
    saved = all(after < before for before, after in zip(*counts, strict=True))
    return exhibited(saved, f"in Fig. 4, {plain}; after the points on inside corners are deleted, {fewer}")


@claim("appel-will.154")
def minimum_data() -> Check:
    """Check that a twisted prism and its hull have the same points but other lines; two objects need less than a map.

    The lines of Fig. 4 follow from the sets of points of its surfaces, and all of a cube from its points.
    """
    solid, figure, cube = twisted(), fig_4(), exact_hull(CUBE)
    judge = exact_hull(solid.points)
    differ = {*_surfaces_at_lines(solid)} != {*map(frozenset, judge.edges())}
    shared = {first & second for first, second in combinations(map(frozenset, figure.surfaces), 2)}
    of_sets = {pair for pair in shared if len(pair) == 2} == {*_surfaces_at_lines(figure)}
    message = f"a twisted prism and its hull have the same {len(judge.vertices)} points but different lines"
    check = exhibited(differ and len(judge.vertices) == len(solid.points), message)
    case = "a cube, whose points are enough, and Fig. 4, whose lines follow from its surfaces as sets of points"
    return check.unless(of_sets and (len(cube.vertices), len(cube.facets)) == (8, 6), case)


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
    case = "the proved relation that a vertex of the object's hull is a vertex of the hull of each of its surfaces"
    return check.unless(vertex_is_no_combination().check().holds, case)


@claim("appel-will.91", "appel-will.138", "appel-will.76")
def vertex_without_supporting_surface() -> Check:
    """Check that a vertex of the hull need not be on a surface of the object whose plane supports the hull."""
    solid = pitted()
    planes = {surface: _plane_of(solid.points, surface) for surface in solid.surfaces}
    supporting = 0
    for plane in planes.values():
        values = [plane_value(plane, point) for point in solid.points]
        supporting += max(values) <= 0 or min(values) >= 0
    passed = supporting == 0 and exact_hull(solid.points).vertices == (0, 1, 2, 3)
    passed &= len({*planes.values()}) == len(solid.surfaces) == 12
    message = (
        f"an object with {len(planes)} surfaces, whose hull is a tetrahedron; planes that support it: {supporting}"
    )
    return exhibited(passed, message)


def _plane_of(points: Sequence[Point], surface: Sequence[int]) -> Plane:
    """Return the plane of a surface in lowest terms; its sign does not depend on the side from which it is seen."""
    a, b, c = max((normal := lowest(area_vector(points, surface))), minus((0, 0, 0), normal))
    return a, b, c, -dot((a, b, c), points[surface[0]])


@claim("appel-will.83")
def product_of_directions() -> Check:
    """Check that the dot product of two directions may be negative or 0 although their angle is below 180 degrees."""
    p, corner, r = counterexample_points("obtuse.csv")
    u, v = minus(p, corner), minus(r, corner)
    products = dot(u, v), dot(u, (0, 1, 0))
    is_refuted = any(cross(u, v)) and products[0] < 0 == products[1]
    return refuted(is_refuted, f"the product is {products[0]} for an obtuse angle, and {products[1]} for a right one")


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

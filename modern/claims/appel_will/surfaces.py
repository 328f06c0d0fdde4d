"""Checks of Appel and Will on objects given by surfaces: maps, lines, planes, and inside corners (reentrant edges)."""

import math
from collections import Counter
from collections.abc import Collection, Sequence
from fractions import Fraction
from itertools import combinations, pairwise, product

from modern.claims.appel_will.convexity import CUBE, RINGS, Flat
from modern.claims.appel_will.proofs import fewer_wasted_tests, least_surface
from modern.claims.evidence import Check, claim, exhibited, refuted, search, slip
from modern.claims.hulls import exact_hull
from modern.claims.invariants import columns, corrected_print, is_closed_loop, is_sphere, numbers_in
from modern.claims.kovalevsky_schulz.proofs import no_combination
from modern.claims.published import PAPERS, findings, results_of
from modern.claims.sampled_sets import Plane, Point, counterexample, counterexample_points, plane_value
from modern.formats.off import parse_off
from modern.geometry.mesh import sides
from modern.geometry.vectors import area_vector, cross, dot, lowest, minus
from modern.papers.appel_will import CORRECTED, Method, appel_will, printed
from modern.papers.appel_will.corners import Rule, preprocess, triple_product
from modern.papers.appel_will.results import Solid, printed_solid
from modern.papers.appel_will.star import as_corrected

TETRAHEDRON: tuple[Point, ...] = ((0, 0, 0), (12, 0, 0), (0, 12, 0), (0, 0, 12))
# The apex of the pit in each face of the tetrahedron.
PITS = {(0, 2, 1): (4, 4, 1), (0, 1, 3): (4, 1, 4), (0, 3, 2): (1, 4, 4), (1, 2, 3): (3, 3, 3)}
# The points of the tetrahedron with a low pyramid on each face in place of the pit.
RAISED: tuple[Point, ...] = (*TETRAHEDRON, (4, 4, -1), (4, -1, 4), (-1, 4, 4), (5, 5, 5))


def fig_4() -> Solid:
    return printed_solid(corrected_print("appel-will"))


def solid_in(name: str) -> Solid:
    """Return the polyhedron of an OFF file in ``transcripts/counterexamples``."""
    mesh = parse_off(counterexample(name), name)
    return Solid(tuple((int(x), int(y), int(z)) for x, y, z in mesh.points), mesh.faces)


def prism(ring: tuple[Flat, ...]) -> Solid:
    """Return a prism on a simple polygon. At most three planes of the prism meet at each point."""
    n = len(ring)
    upright = [(a, b, b + n, a + n) for a, b in sides(range(n))]
    points = tuple((x, y, z) for z in (0, 1) for x, y in ring)
    return Solid(points, (tuple(range(n))[::-1], tuple(range(n, 2 * n)), *upright))


def pitted() -> Solid:
    """Return a tetrahedron with a pit in every face."""
    surfaces = ((a, b, k) for k, face in enumerate(PITS, len(TETRAHEDRON)) for a, b in sides(face))
    return Solid((*TETRAHEDRON, *PITS.values()), tuple(surfaces))


def twisted() -> Solid:
    """Return a twisted prism, which is not convex: its six upright triangles meet in pairs at reentrant edges."""
    points: tuple[Point, ...] = ((6, 0, 0), (-3, 5, 0), (-3, -5, 0), (5, 3, 6), (-5, 3, 6), (0, -6, 6))
    upright = (surface for a, b in sides(range(3)) for surface in ((a, b, b + 3), (a, b + 3, a + 3)))
    return Solid(points, ((2, 1, 0), (3, 4, 5), *upright))


@claim("appel-will.24")
def changes_of_hull() -> Check:
    block = solid_of_cubes([cube for cube in product(range(3), repeat=3) if cube != (1, 1, 2)])
    changes = [_changes(solid) for solid in (fig_4(), twisted(), block)]
    message = f"{changes[0][0]} points of the polyhedron of Fig. 4 are no vertices of its hull, which has new lines "
    message += f"({changes[0][1]}) and new planes ({changes[0][2]})"
    others = changes[1][0] == 0 < min(changes[1][1:]) and changes[2][0] > 0 == max(changes[2][1:])
    case = "a twisted prism, all points of which remain, and a block with a pit, whose hull has no new line or plane"
    return exhibited(min(changes[0]) > 0, message).unless(others, case)


def _changes(solid: Solid) -> tuple[int, int, int]:
    """Count a solid's points that are no vertices of its hull, and the hull's edges and planes that the solid lacks."""
    points, judge = solid.points, exact_hull(solid.points)
    polygons = [facet.polygon for facet in judge.facets], solid.surfaces
    hull_planes, planes = ({_plane_of(points, polygon) for polygon in part} for part in polygons)
    # An edge of the hull that consists of several lines of the solid is not new.
    at = _surfaces_at_lines(solid)
    edges = 0
    for a, b in judge.edges():
        way = minus(points[b], points[a])
        on = sorted((p, k) for k, p in enumerate(points) if not any(cross(way, minus(p, points[a]))))
        edges += any(frozenset((k, m)) not in at for (_, k), (_, m) in pairwise(on))
    return len(points) - len(judge.vertices), edges, len(hull_planes - planes)


@claim("appel-will.22")
def surface_three() -> Check:
    solid = solid_in("fig4_printed.off")
    corrected = [numbers_in(row) for row in corrected_print("appel-will")["fig4-topological-map"]]
    (result,) = (result for result in results_of(PAPERS[0]) if result.id == "fig4-topological-map")
    printed = [*corrected[:2], numbers_in(result.printed[2]), *corrected[3:]]
    alone = sorted(sorted(line) for line, count in _surfaces_at_lines(solid).items() if count == 1)
    message = "with the printed order, these lines are on one surface only, although each line should be on two: "
    message += ", ".join(f"{a + 1}-{b + 1}" for a, b in alone)
    is_refuted = alone and printed == [[k + 1 for k in face] for face in solid.surfaces]
    return slip(not is_refuted, is_sphere(corrected), ", ".join(map(str, corrected[2])), message)


@claim("appel-will.155")
def inside_corner_at_vertex() -> Check:
    lost = ", ".join(str(k + 1) for k in deleted_vertices(solid_in("crown.off"), "any"))
    return exhibited(lost, f"point {lost} of a pyramid on a star is deleted although it is a vertex of the hull")


@claim("appel-will.75")
def points_kept_by_rule_2() -> Check:
    solid, vertices = pitted(), exact_hull(pitted().points).vertices
    on_inside, deleted = (preprocess(solid.points, solid.surfaces, rule).deleted for rule in ("any", "concave"))
    message = f"a tetrahedron with pits has {len(on_inside)} points on inside corners, {len(vertices)} of which are "
    message += "vertices of the hull, and the rule keeps all of them"
    return exhibited({*vertices} < {*on_inside} and not deleted, message)


def deleted_vertices(solid: Solid, rule: Rule) -> list[int]:
    """Return the vertices of the hull that a rule deletes because they lie on inside corners (reentrant edges)."""
    vertices = exact_hull(solid.points).vertices
    return [k for k in preprocess(solid.points, solid.surfaces, rule).deleted if k in vertices]


@claim("appel-will.72", rule="any", full=2_000)
@claim("appel-will.75", rule="concave", full=2_000)
def deletion_in_prisms(rule: Rule, cases: int = 5) -> Check:
    message = "applied to prisms, the rule of the statement deletes no vertex of the hull"
    return search(RINGS, lambda ring: not deleted_vertices(prism(ring), rule), cases, message)


def _surfaces_at_lines(solid: Solid) -> Counter[frozenset[int]]:
    return Counter(frozenset(line) for surface in solid.surfaces for line in sides(surface))


def solid_of_cubes(cubes: Collection[tuple[int, ...]]) -> Solid:
    """Return the solid that unit cubes fill. Its surfaces are the sides of the cubes that belong to one cube only."""
    squares: Counter[frozenset[tuple[int, ...]]] = Counter()
    for cube, axis, side in product(cubes, range(3), (0, 1)):
        corners_ = (tuple(c + d for c, d in zip(cube, way, strict=True)) for way in CUBE if way[axis] == side)
        squares[frozenset(corners_)] += 1
    outer = [sorted(square) for square, count in squares.items() if count == 1]
    points = sorted({point for square in outer for point in square})
    # Sorted corners a, b, c, d of a square follow each other in the order a, b, d, c.
    return Solid(tuple(points), tuple(tuple(points.index(s[k]) for k in (0, 1, 3, 2)) for s in outer))  # type: ignore[arg-type]


@claim("appel-will.33")
def surface_of_star() -> Check:
    # Each of the three arms of the star has nine cubes.
    star = solid_of_cubes({tuple(k * c for c in axis) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1)) for k in range(10)})
    normals = [area_vector(star.points, facet.polygon) for facet in exact_hull(star.points).facets]
    # All surfaces of the star are squares with the area 1.
    surface, around = len(star.surfaces), sum(math.hypot(*normal) for normal in normals) / 2
    case = f"a star with three arms of cubes, whose surface is {surface}, whereas that of its hull is {around:.0f}"
    return least_surface().check().unless(surface < around, case)


@claim("appel-will.161")
def wasted_tests() -> Check:
    hull = exact_hull([(0, 0, 0), (2, 0, 0), (3, 2, 0), (1, 3, 0), (-1, 2, 0), (1, 1, 1)])
    triples = [any({*triple} <= {*f.polygon} for f in hull.facets) for triple in combinations(range(6), 3)]
    parts = Fraction(15 - len(hull.edges()), 15), Fraction(triples.count(False), len(triples))
    case = "a tetrahedron, for which no test is wasted, and, if all triples in its planes count as useful, by a "
    case += f"pyramid on a pentagon, for which {parts[0]} of the pairs and {parts[1]} of the triples are wasted"
    return fewer_wasted_tests().check().unless(parts[0] > parts[1] and len(exact_hull(TETRAHEDRON).edges()) == 6, case)


@claim("appel-will.152")
def preprocessing_saves() -> Check:
    solid, counts, stars = fig_4(), [], [0]

    def counted(images: Sequence[Flat]) -> bool:
        stars[0] += 1
        return as_corrected(images)

    for rule in (None, "any"):
        stars[0] = 0
        hull = appel_will(solid.points, solid.surfaces, Method(star=counted, inside_corners=rule))
        counts.append((hull.projections, stars[0]))
    plain, fewer = (f"{projections} projections and {tests} star polygon tests" for projections, tests in counts)
    saved = all(after < before for before, after in zip(*counts, strict=True))
    return exhibited(saved, f"Fig. 4 needs {plain}; after the points on inside corners are deleted, it needs {fewer}")


@claim("appel-will.154")
def minimum_data() -> Check:
    solid, figure, box = twisted(), fig_4(), exact_hull(CUBE)
    judge = exact_hull(solid.points)
    differ = {*_surfaces_at_lines(solid)} != {*map(frozenset, judge.edges())}
    same_map = {*_surfaces_at_lines(pitted())} == {*map(frozenset, exact_hull(RAISED).edges())}
    pairs = {a & b for a, b in combinations(map(frozenset, figure.surfaces), 2) if len(a & b) == 2}
    message = f"a twisted prism and its hull have the same {len(judge.vertices)} points but different lines; a "
    message += "tetrahedron with a pit in each face and one with a pyramid on each face have the same map"
    check = exhibited(differ and same_map and len(judge.vertices) == len(solid.points), message)
    case = "a cube known to be convex, whose points are enough, and Fig. 4, whose map needs no order of the points"
    return check.unless(pairs == {*_surfaces_at_lines(figure)} and (len(box.vertices), len(box.facets)) == (8, 6), case)


@claim("appel-will.77")
def points_on_three_surfaces() -> Check:
    # The crown is a pyramid on a star with four points. The third object consists of three cubes in the shape of an L.
    objects = fig_4(), solid_in("crown.off"), prism(((0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2))), pitted()
    counts = [sum(k in surface for surface in s.surfaces) for s in objects for k in range(len(s.points))]
    return exhibited(min(counts) >= 3, f"each of {len(counts)} points of four objects is on three or more surfaces")


@claim("appel-will.78")
def hulls_of_surfaces() -> Check:
    surfaces = pitted().surfaces
    counts = [len(exact_hull(points).vertices) for points in (pitted().points, RAISED)]
    own = {exact_hull([points[k] for k in s]).vertices for points in (pitted().points, RAISED) for s in surfaces}
    message = f"two objects have the same map, with {len(surfaces)} triangles as surfaces, but their hulls have "
    message += f"{counts[0]} and {counts[1]} vertices: the apex of a pit is no vertex of the hull of its object"
    check = exhibited(own == {(0, 1, 2)} and counts[0] < counts[1] == len(RAISED), message)
    case = "the proved relation that a vertex of the object's hull is a vertex of the hull of each of its surfaces"
    return check.unless(no_combination().check().holds, case)


@claim("appel-will.91", "appel-will.138", "appel-will.76")
def vertex_without_supporting_surface() -> Check:
    solid = pitted()
    planes = {_plane_of(solid.points, surface) for surface in solid.surfaces}
    values = [[plane_value(plane, point) for point in solid.points] for plane in planes]
    valid = len(planes) == len(solid.surfaces) and not any(max(row) <= 0 or min(row) >= 0 for row in values)
    message = f"the hull of an object with {len(planes)} surfaces, none in a supporting plane, is a tetrahedron"
    return exhibited(valid and exact_hull(solid.points).vertices == (0, 1, 2, 3), message)


def _plane_of(points: Sequence[Point], surface: Sequence[int]) -> Plane:
    """Return the plane of a surface in lowest terms, with the same signs for both orientations of the surface."""
    a, b, c = max((normal := lowest(area_vector(points, surface))), minus((0, 0, 0), normal))
    return a, b, c, -dot((a, b, c), points[surface[0]])


@claim("appel-will.83")
def product_of_directions() -> Check:
    p, corner, r = counterexample_points("obtuse.csv")
    u, v = minus(p, corner), minus(r, corner)
    products = dot(u, v), dot(u, (0, 1, 0))
    message = f"the scalar product is {products[0]} for an obtuse angle, and {products[1]} for a right one"
    return refuted(any(cross(u, v)) and products[0] < 0 == products[1], message)


@claim("appel-will.80")
def figure_of_minimum_data() -> Check:
    (finding,) = (finding for finding in findings(PAPERS[0]) if finding.result.id == "figure-number")
    texts = finding.produced, finding.result.printed, finding.result.corrected
    words, printed, corrected = (" ".join(lines).split() for lines in texts)
    message = "Fig. 3 shows no polyhedron; Fig. 4 has a vertex list and a topological map"
    return slip(words == printed, words == corrected, "Fig. 4", message)


@claim("appel-will.111")
def fourth_loop() -> Check:
    lines = {label: (start, end) for label, start, end in map(numbers_in, corrected_print("appel-will")["fig14"])}
    (result,) = (result for result in results_of(PAPERS[0]) if result.id == "fig22-loops-4-5")
    as_printed, corrected = (numbers_in(text.split("\t")[1]) for text in (result.printed[0], result.corrected[0]))
    reading = " ".join(map(str, corrected))
    message = f"the loop {' '.join(map(str, as_printed))} of the lines of Fig. 14 is not closed, but {reading} is"
    return slip(is_closed_loop(as_printed, lines), is_closed_loop(corrected, lines), reading, message)


@claim("appel-will.108")
def counts_of_step_10() -> Check:
    points, rows_of = counterexample_points("fig14.csv"), corrected_print("appel-will")
    # In Fig. 22, every second column, from the first, has the counts IUC of all lines after one loop.
    fig22 = [tuple(counts) for n in ("1-3", "4-5") for counts in columns(rows_of[f"fig22-loops-{n}"][1:])[::2]]
    loops, corrected = (appel_will(points, method=m).table.loops for m in (printed("step10"), CORRECTED))
    wrong = [(k, a.uses, b) for k, (a, b) in enumerate(zip(loops, fig22, strict=True), 1) if a.uses != b]
    message = f"with the printed step number, the {len(loops)} loops are the same, but "
    message += "; ".join(f"the counts IUC after loop {k} are {a} instead of {b}" for k, a, b in wrong[:1])
    is_refuted = wrong and [a.entries for a in loops] == [b.entries for b in corrected]
    return slip(not is_refuted, [b.uses for b in corrected] == fig22, "step 2", message)


@claim("appel-will.159")
def product_with_repeated_vector() -> Check:
    # The columns of each printed determinant are the vectors I, K and L. Its value follows.
    rows = [numbers_in(line.partition("=")[2]) for line in corrected_print("appel-will")["fig18"][::2]]
    with_i = [triple_product((a, b, c), (d, e, f), (a, b, c)) for a, d, _, b, e, _, c, f, _, _ in rows]
    with_l = [triple_product((a, b, c), (d, e, f), (g, h, i)) for a, d, g, b, e, h, c, f, i, _ in rows]
    message = f"the determinants of Fig. 18 are {with_l} with the index l, but {with_i} with the index i as displayed"
    return slip(any(with_i), with_l == [row[-1] for row in rows], "l", message)

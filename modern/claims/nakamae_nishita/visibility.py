"""Checks of Nakamae and Nishita on visibility: hidden edges, indices of intersections, nearer polyhedra, and counts."""

from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import permutations

from modern.claims import algebra
from modern.claims.evidence import Check, claim, exhibited, proved, refuted, searched, slip
from modern.claims.invariants import counts_in_table_1
from modern.claims.nakamae_nishita.drawings import box, pieces_against_rays, polyhedra
from modern.claims.nakamae_nishita.proofs import one_order
from modern.claims.nakamae_nishita.tables import POLYGONS, SQUARE, Place, between, crosses, lines_of
from modern.claims.sampled_sets import counterexample, counterexample_points
from modern.drawing.visible import CONTOUR, INNER, sign, value
from modern.geometry.mesh import sides
from modern.geometry.vectors import dot, minus, plus
from modern.papers.nakamae_nishita.contours import values
from modern.papers.nakamae_nishita.crossings import CLEAR, as_printed, clipped
from modern.papers.nakamae_nishita.hidden import Drawing, draw
from modern.papers.nakamae_nishita.nearness import BY_CROSSING
from modern.papers.nakamae_nishita.projection import parallel
from modern.papers.nakamae_nishita.scenes import parse


@claim("nakamae-nishita.16", full=600)
def hidden_contour_edges(cases: int = 1) -> Check:
    drawing, behind = _two_boxes((1, 3, -1)), edges_wholly_behind()
    both = drawing.relations[0].by == BY_CROSSING and _hidden(drawing, INNER) and _hidden(drawing, CONTOUR)
    case = f"hidden contour edges of the farther box, and by a box partly behind a wall: {behind.message}"
    return pieces_against_rays(cases).unless(both and not behind.holds, case)


@claim("nakamae-nishita.49", full=600)
def order_of_invisibility(cases: int = 1) -> Check:
    behind, corners = edges_wholly_behind(), indices(1).evidence.violation
    case = f"a box partly behind a wall: {behind.message}; and by {corners}"
    return pieces_against_rays(cases).unless(not behind.holds and corners, case)


def _two_boxes(at: tuple[int, int, int]) -> Drawing:
    return draw(polyhedra((box((0, 0, 0), (2, 2, 2)), box(at, plus(at, (2, 2, 2))))), parallel((2, -3, 1)), hidden=True)


@cache
def _scene(name: str, *without: str) -> Drawing:
    scene = parse(counterexample(name), name)
    return draw(scene.make, scene.sight.observer(scene.make), without, hidden=True)


def _hidden(drawing: Drawing, kind: str) -> int:
    kinds = {(k, frozenset((e.start, e.end))): e.kind for k, solid in enumerate(drawing.solids) for e in solid.edges}
    return sum(not p.visible and kinds[p.solid, frozenset((p.start, p.end))] == kind for p in drawing.pieces)


# The ends of the segments that are compared with the contour of a convex polygon.
_ENDS: tuple[Place, ...] = tuple((x, y) for x in (-3, 1, 2, 8) for y in (-2, 1, 3, 6))


@claim("nakamae-nishita.45", "nakamae-nishita.59", full=100)
def indices(cases: int = 3) -> Check:
    checks, ways = [], set()
    for v in (SQUARE, *POLYGONS.cases(cases)):
        for a, b in permutations(_ENDS, 2):
            if any(between(a, b, p) for p in v):
                continue
            met = []
            for line, (p, q) in zip(lines_of(v), sides(v), strict=True):
                if crosses(p, q, a, b):
                    # Formula (6): the sign of the determinant tells whether the segment enters or leaves.
                    determinant = (q[0] - p[0]) * (a[1] - b[1]) - (q[1] - p[1]) * (a[0] - b[0])
                    at_a, at_b = (value(line, (*end, 1)) for end in (a, b))
                    met.append((Fraction(at_a, at_a - at_b), sign(determinant)))
            by_six = tuple((place, len(met) * index) for place, index in sorted(met))
            of_contour = values(lines_of(v), [(*a, 0, 1), (*b, 0, 1)])
            marks = clipped(of_contour, 0, 1).marks if of_contour else ()
            checks.append(marks == by_six)
            ways.add(tuple(index for _, index in marks))
    message = f"of {len(checks)} segments, some enter a contour with the index 1, some leave it with the index -1, and "
    message += "some do both, with the indices 2 and -2"
    # An intersection with the index -1 is alone on its segment.
    check = searched(_CONTOURS, cases, [*checks, ways == {(), (1,), (-1,), (2, -2)}], message)
    # From the middle of the square through a corner. The ends are on opposite sides of both sides at the corner.
    leaving = values(lines_of(SQUARE), ends := ((2, 2, 0, 1), (6, 6, 0, 1))) or []
    missed = as_printed(leaving, 0, 1, ends, [(x, y, 0, 1) for x, y in SQUARE]) == CLEAR != clipped(leaving, 0, 1)
    case = "a segment that leaves a square at a corner: by d it gets no index, or the index -2 twice instead of -1 once"
    return check.unless(missed and sum(a * b < 0 for a, b in leaving) == 2, case)


_CONTOURS = replace(POLYGONS, name="a square and convex polygons, coordinates -2 to 6; segments between 16 points")


@claim("nakamae-nishita.35")
def formula_4() -> Check:
    # As P_0, P_1 and P_2 are collinear, P_1 - P_0 = s u and P_2 - P_0 = t u with the direction u and s, t > 0.
    s, t, u = *algebra.variables("s t"), algebra.point("u", 3)
    value_of_4 = algebra.dot([s * c for c in u], [(s - t) * c for c in u])
    signs = {"s": algebra.positive(s), "nearer": algebra.positive(t - s), "u": algebra.positive(algebra.dot(u, u))}
    nearer = algebra.Step("dr < 0 if s < t", signs, algebra.positive(-value_of_4), (algebra.term("s nearer u"),))
    signs = {**signs, "nearer": algebra.positive(s - t)}
    farther = algebra.Step("dr > 0 if s > t", signs, algebra.positive(value_of_4), (algebra.term("s nearer u"),))
    argument = "Let the points P_1 and P_2 be at s u and t u from the eye P_0. Then formula (4) gives dr = s (s - t) u "
    argument += "u, which is negative if P_1 is nearer, and positive if P_2 is nearer."
    decided = [(relation.by, relation.nearer) for relation in _two_boxes((1, 3, 0)).relations] == [(BY_CROSSING, 1)]
    check = proved(argument, [nearer.is_valid(), farther.is_valid()], "the sign of formula (4) tells the nearer point")
    return check.unless(decided and _touching_boxes(), _touching_boxes())


def _touching_boxes() -> str:
    """Return the case of two boxes for which formula (4) decides nothing and hidden parts of an edge are missed."""
    scenes = [_scene("stacked.toml", *without) for without in (("touching",), ())]
    hidden = [_hidden(scene, INNER) + _hidden(scene, CONTOUR) for scene in scenes]
    orders, crossings = [scene.relations[0].nearer for scene in scenes], scenes[0].relations[0].tables.crossings()
    undecided = len([*crossings]) == 2 and orders[0] == 0 != orders[1] and hidden[0] < hidden[1]
    return "two boxes that touch where their contours cross: formula (4) is 0 at both crossings" if undecided else ""


@claim("nakamae-nishita.36")
def nearer_polyhedron() -> Check:
    return one_order().check().unless(_touching_boxes(), _touching_boxes())


@claim("nakamae-nishita.48")
def edges_wholly_behind() -> Check:
    scenes = [_scene("partly_behind.toml", *without) for without in ((), ("enclosed",))]
    correct, shown = ({(p.start, p.end) for p in scene.pieces if p.visible and p.solid == 1} for scene in scenes)
    inner = {(edge.start, edge.end) for edge in scenes[0].solids[1].edges if edge.kind == INNER}
    wrong = shown - correct
    # The contours cross, so that this is case 2 of section 3 and not case 3, in which one contour encloses the other.
    message = f"{len(wrong)} edges of the box, {len(wrong & inner)} of them inner, would be visible through the wall"
    return refuted(scenes[0].relations[0].by == BY_CROSSING and wrong & inner, message)


@claim("nakamae-nishita.65")
def table_by_formula_4() -> Check:
    (eye, *contour), ends = (points := counterexample_points("table_by_4.csv"))[:-2], points[-2:]
    by_4 = {sign(dot(minus(p, eye), minus(p, end))) for p in contour for end in ends}
    flat = tuple((x, y) for x, y, _ in contour)
    by_1 = [[sign(value(line, (x, y, 1))) for line in lines_of(flat)] for x, y, _ in ends]
    message = "by the sign of formula (4) every element of the table is -1, as if nothing intersected; by the sign of "
    message += "formula (1), the edge enters the contour"
    return slip(by_4 != {-1}, -1 in by_1[0] and -1 not in by_1[1], "the tables of section 3.2, by formula (1)", message)


@claim("nakamae-nishita.56")
def counts_of_table_1d() -> Check:
    parts, vertices, faces, _ = counts_in_table_1("d")
    # 25 prisms, 23 on quadrangles and 2 on triangles, and five plates with four corners and two faces.
    plates = (25 + 5, 2 * (23 * 4 + 2 * 3) + 5 * 4, 23 * (4 + 2) + 2 * (3 + 2) + 5 * 2)
    message = "25 prisms and five plates, each with four corners and two faces, have the printed counts"
    check = exhibited(plates == (parts, vertices, faces), message)
    most = 2 * faces - 4 * parts  # A solid with F faces has at most 2 F - 4 vertices.
    case = f"solids without plates, which have at most {most} vertices if they have {faces} faces"
    return check.unless(most < vertices, case)

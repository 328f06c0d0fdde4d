"""Checks of section 3 of Kovalevsky and Schulz: lemmas LZ, CH and BE and the intermediate claims of their proofs."""

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations, product

from modern.claims import sampled_sets as sets
from modern.claims.evidence import Check, Generator, claim, refuted, search, searched
from modern.claims.hulls import exact_hull
from modern.claims.kovalevsky_schulz.polyhedra import OUTSIDE, growing_polyhedra, horizon, hulls, polyhedron
from modern.claims.kovalevsky_schulz.proofs import lemma_be, lemma_ch, lemma_lz
from modern.claims.kovalevsky_schulz.voxels import DIRECTIONS, KINDS, SOLIDS, Voxels, local, points_of
from modern.claims.sampled_sets import CASES, SETS, counterexample_points, is_closed_curve, plane_through, plane_value
from modern.digital.solids import listed
from modern.exact_hull import ExactHull
from modern.geometry.vectors import cross, dot, minus, plus
from modern.papers.kovalevsky_schulz import local_corners
from modern.papers.kovalevsky_schulz.corners import Of
from modern.papers.kovalevsky_schulz.hull import merged


@claim("kovalevsky-schulz.120", vertices="interior")
@claim("kovalevsky-schulz.70", vertices="moved")
def smaller_polyhedron(vertices: str) -> Check:
    *corners, lower = counterexample_points("shortened.csv")
    larger, smaller = exact_hull([*corners, lower]), exact_hull([*corners[:-1], lower])
    wrong = larger.vertices == smaller.vertices == (0, 1, 2, 3) and larger.boundary == (4,)
    message = "all vertices of a smaller tetrahedron are on the boundary of a larger one"
    if vertices == "moved":
        doubled_middles = [plus(p, q) for p, q in combinations(corners, 2)]
        message += f", and {lower} is no vertex of the larger one; the midpoints of its edges form an octahedron"
        return refuted(wrong and len(exact_hull(doubled_middles).vertices) == 6, message)
    four = [p for p in product((0, 1), repeat=3) if sum(p) % 2 == 0]
    message += "; four corners of a cube, no two of them adjacent, form a smaller tetrahedron in the cube"
    return refuted(wrong and exact_hull(four).dimension == 3, message)


@claim("kovalevsky-schulz.126", "kovalevsky-schulz.125", "kovalevsky-schulz.75", full=1_000)
def vertices_are_local_corners(cases: int = 2) -> Check:
    def agrees(solid: Voxels, of: Of) -> bool:
        cells, points = merged(polyhedron(local_corners(listed(solid), of))), points_of(solid, of)
        # A local corner is no combination of its neighbours in the set.
        near = [[*(plus(p, d) for d in DIRECTIONS if plus(p, d) in points), p] for p in cells.points]
        are_local = {*cells.points} <= local(solid, of) and all(len(n) - 1 in exact_hull(n).vertices for n in near)
        return are_local and {*cells.planes()} == {facet.plane for facet in exact_hull(points).facets}

    message = "the hull of the local corners is that of all points, and its vertices are local corners"
    return search(SOLIDS, lambda solid: all(agrees(solid, of) for of in KINDS), cases, message)


@claim("kovalevsky-schulz.1", full=400)
def proof_of_the_algorithm(cases: int = CASES) -> Check:
    lemmas = [lemma().check().holds for lemma in (lemma_lz, lemma_ch, lemma_be)]
    construction = growing_polyhedra(cases)
    false = [smaller_polyhedron("interior"), smaller_polyhedron("moved"), coefficients_by_cosines()]
    message = f"the project proves the paper's {sum(lemmas)} lemmas; {construction.message}"
    check = searched(SETS[3], cases, [*lemmas, construction.holds], message)
    case = f"the printed proof, which has {len(false)} false statements and omits faces coplanar with the new point"
    # A point beyond the edge of the cube with corners from 0 to 2 that is between the faces x = 2 and z = 0.
    visible, hidden, way = (1, 0, 0), (0, 0, -1), minus((4, 1, 0), (2, 1, 0))
    has_zero_coefficient = -dot(hidden, way) == 0 < dot(visible, way)
    return check.unless(not any(statement.holds for statement in false) and has_zero_coefficient, case)


def _planes_at(edge: tuple[int, int], judge: ExactHull, new: sets.Point) -> list[sets.Plane]:
    """Return the outward planes of the two faces at an edge of a hull, sorted by their values at the new point."""
    return sorted((f.plane for f in judge.facets if {*edge} <= {*f.polygon}), key=lambda f: plane_value(f, new))


def _new_normal(edge: tuple[int, int], points: Sequence[sets.Point], new: sets.Point) -> sets.Point:
    """Return the outward normal of the face that joins an edge to the new point."""
    corners = {*edge, len(points)}
    return next(f.plane[:3] for f in exact_hull([*points, new]).facets if corners <= {*f.polygon})


def _is_general(points: tuple[sets.Point, ...]) -> bool:
    """Return True if no four points are coplanar and the last one is outside the hull of the others."""
    if any(plane_value(plane_through(p, q, r), s) == 0 for p, q, r, s in combinations(points, 4)):
        return False
    *first, new = points
    return len(first) > 3 and any(plane_value(facet.plane, new) > 0 for facet in exact_hull(first).facets)


NO_FOUR_COPLANAR: Generator[tuple[sets.Point, ...]] = Generator(
    f"{SETS[3].name}, and a point outside their hull, no four of them coplanar",
    14,
    lambda random: (*SETS[3].draw(random), random.choice(OUTSIDE)),
    _is_general,
)


@claim("yau-srihari.14", full=400)
def closed_boundary(cases: int = CASES) -> Check:
    message = "the boundary between the light and the dark faces is one closed curve"
    return search(NO_FOUR_COPLANAR, lambda p: is_closed_curve(horizon(exact_hull(p[:-1]), p[-1])), cases, message)


@claim("kovalevsky-schulz.73", full=400)
def section_angles(cases: int = CASES) -> Check:
    right, sharp, elsewhere = list[bool](), list[bool](), list[bool]()
    for (points, judge), new in product(hulls(cases), OUTSIDE):
        for edge in horizon(judge, new):
            hidden, visible = _planes_at(edge, judge, new)
            if plane_value(hidden, new) == 0:
                continue
            outward = _new_normal(edge, points, new)
            along, way = minus(points[edge[1]], points[edge[0]]), minus(new, points[edge[0]])
            # The way to P from the foot of the perpendicular, and from an end of the edge.
            share = Fraction(dot(along, way), dot(along, along))
            upright = [w - share * a for w, a in zip(way, along, strict=True)]
            # An edge is sharp if the faces form an acute angle, so that the angle of their normals is obtuse.
            at_foot = right if dot(visible[:3], hidden[:3]) >= 0 else sharp
            # The angle beta is 90 - alpha or alpha - 90 if it is acute and the squares of the cosines add up to 1.
            for line, normal in product((upright, way), (visible[:3], hidden[:3])):
                is_right = dot(normal, outward) > 0 and _cosine(normal, line) + _cosine(normal, outward) == 1
                (elsewhere if line is way else at_foot).append(is_right)
    message = f"{len(right)} angles are as in the proof if the edge is not sharp and Q is the foot of the perpendicular"
    case = f"{elsewhere.count(False)} angles if Q is an end of the edge, and by {sharp.count(False)} at sharp edges"
    return searched(SETS[3], cases, right, message).unless(False in elsewhere and False in sharp, case)


def _cosine(u: Sequence[int | Fraction], v: Sequence[int | Fraction]) -> Fraction:
    """Return the square of the cosine of the angle between two vectors."""
    uv, uu, vv = (sum(a * b for a, b in zip(p, q, strict=True)) for p, q in ((u, v), (u, u), (v, v)))
    return Fraction(uv * uv) / (Fraction(uu) * vv)


@claim("kovalevsky-schulz.122")
def coefficients_by_cosines() -> Check:
    *body, new = counterexample_points("cosines.csv")
    hidden, visible = (plane[:3] for plane in _planes_at((1, 2), exact_hull(body), new))
    outer = _new_normal((1, 2), body, new)
    # The normals are perpendicular to the edge. So the vector products give a : b in outer = a visible + b hidden.
    a, b = (dot(cross(visible, hidden), c) for c in (cross(outer, hidden), cross(visible, outer)))
    # Compare squares for unit normals, so that no roots are needed.
    ratio = Fraction(a * a * dot(visible, visible), b * b * dot(hidden, hidden))
    cosines = _cosine(visible, outer) / _cosine(hidden, outer)
    sines = (1 - _cosine(hidden, outer)) / (1 - _cosine(visible, outer))
    way = minus(new, body[1])
    one_face_visible = dot(visible, way) > 0 > dot(hidden, way)
    message = f"(a : b)^2 is {ratio}, (cos beta_v : cos beta_n)^2 is {cosines}, (sin beta_n : sin beta_v)^2 is {sines}"
    return refuted(one_face_visible and a > 0 < b and ratio == sines and ratio not in (cosines, 1 / cosines), message)

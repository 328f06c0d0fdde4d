"""Checks of section 3 of Kovalevsky and Schulz: lemmas LZ, CH and BE and the intermediate claims of their proofs."""

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import product

from modern.claims.evidence import Check, claim, refuted, search, searched
from modern.claims.hulls import convex_polyhedron, exact_hull
from modern.claims.kovalevsky_schulz.polyhedra import growing_polyhedra, hulls
from modern.claims.kovalevsky_schulz.proofs import formula_4, lemma_be, lemma_ch, lemma_lz
from modern.claims.kovalevsky_schulz.voxels import KINDS, SOLIDS, Voxels, local, points_of
from modern.claims.sampled_sets import (
    CASES,
    SETS,
    Plane,
    Point,
    counterexample_points,
    is_closed_curve,
    plane_through,
    plane_value,
)
from modern.digital.solids import listed
from modern.geometry.vectors import dot, minus
from modern.papers.kovalevsky_schulz import local_corners
from modern.papers.kovalevsky_schulz.cells import CellList


@claim("kovalevsky-schulz.120", vertices="interior")
@claim("kovalevsky-schulz.70", vertices="moved")
def smaller_polyhedron(vertices: str) -> Check:
    """Check a counterexample: a tetrahedron inside another, made by moving the apex down along an edge.

    vertices: ``interior``, no vertex of the smaller tetrahedron is in the interior of the larger, as with four
    alternate corners of a cube; ``moved``, one of them is neither a vertex of the larger tetrahedron nor in its
    interior.
    """
    *corners, lower = counterexample_points("shortened.csv")
    larger, smaller = exact_hull(corners), exact_hull([*corners[:-1], lower])
    within = [max(plane_value(f.plane, p) for f in larger.facets) for p in (*corners[:-1], lower)]
    wrong = smaller.vertices == (0, 1, 2, 3) and max(within) == min(within) == 0 and lower not in corners
    message = f"{lower} is a vertex of the smaller tetrahedron and on the boundary of the larger"
    if vertices == "moved":
        return refuted(wrong, f"{message}, but not one of its vertices")
    four = [p for p in product((0, 1), repeat=3) if sum(p) % 2 == 0]
    return refuted(
        wrong and exact_hull(four).dimension == 3, f"{message}, like all of four alternate corners of a cube"
    )


@claim("kovalevsky-schulz.126", "kovalevsky-schulz.75", full=1_000)
def vertices_are_local_corners(cases: int = 2) -> Check:
    """Check that the polyhedron of the local corners is the hull of the voxels, or of their corners."""

    def agrees(solid: Voxels) -> bool:
        for of in KINDS:
            cells = convex_polyhedron(local_corners(listed(solid), of))
            planes = {facet.plane for facet in exact_hull(points_of(solid, of)).facets}
            if not (
                isinstance(cells, CellList) and {*cells.planes()} == planes and {*cells.points} <= local(solid, of)
            ):
                return False
        return True

    return search(SOLIDS, agrees, cases, "the hull of the local corners is that of the points, with local corners only")


@claim("kovalevsky-schulz.1", full=400)
def proof_of_the_algorithm(cases: int = CASES) -> Check:
    """Check that the proof of theorem PL is right if the project's steps replace three false statements.

    The lemmas are proved. That each polyhedron of the construction is the intersection of the half-spaces of its faces,
    which the proof of the theorem concludes from lemma BE, is searched.
    """
    lemmas = [lemma().check().holds for lemma in (lemma_lz, lemma_ch, lemma_be)]
    construction = growing_polyhedra(cases)
    false = [smaller_polyhedron("interior"), smaller_polyhedron("moved"), coefficients_by_cosines()]
    message = f"{sum(lemmas)} lemmas are proved; {construction.message}"
    check = searched(SETS[3], cases, [*lemmas, construction.holds], message)
    case = f"the printed proof, in which {len(false)} statements are false and no face is coplanar with the new point"
    return check.unless(not any(statement.holds for statement in false) and formula_4().evidence.violation, case)


def _horizons(cases: int) -> Iterator[tuple[Point, Plane, Plane, Plane, list[Point], tuple[Point, Point]]]:
    """Yield sampled edges between a visible and an invisible face, each with the new point and the planes involved."""
    for points, judge in hulls(cases):
        for new in ((9, 1, 0), (-8, 3, 7)):
            for edge in judge.edges():
                first_plane, second_plane = (f.plane for f in judge.facets if {*edge} <= {*f.polygon})
                # The edge is on the horizon if exactly one of its faces is visible from the new point.
                visible, hidden = (
                    (first_plane, second_plane) if plane_value(first_plane, new) > 0 else (second_plane, first_plane)
                )
                if plane_value(visible, new) > 0 > plane_value(hidden, new):
                    ends = points[edge[0]], points[edge[1]]
                    yield new, visible, hidden, plane_through(*ends, new), [points[k] for k in judge.vertices], ends


@claim("yau-srihari.14", full=400)
def closed_boundary(cases: int = CASES) -> Check:
    """Check that the edges between a visible and an invisible face of a hull form one closed curve."""
    checks = []
    for _, judge in hulls(cases):
        for new in ((9, 1, 0), (-8, 3, 7), (11, -4, 13)):
            visible = [f for f in judge.facets if plane_value(f.plane, new) > 0]
            rim = [e for e in judge.edges() if sum({*e} <= {*f.polygon} for f in visible) == 1]
            checks.append(is_closed_curve(rim))
    return searched(SETS[3], cases, checks, f"the boundary is closed for {len(checks)} points outside a hull")


@claim("kovalevsky-schulz.73", full=400)
def section_angles(cases: int = CASES) -> Check:
    """Check that the angles of Fig. 9 are right if Q is the foot of the perpendicular and the edge is not sharp.

    The angle beta is 90 - alpha or alpha - 90 if it is acute and the squares of the two cosines add up to 1.
    """
    right: list[bool] = []
    sharp: list[bool] = []
    elsewhere: list[bool] = []
    for new, visible, hidden, plane, vertices, edge in _horizons(cases):
        sign = -1 if max(plane_value(plane, p) for p in vertices) > 0 else 1
        outward = tuple(sign * n for n in plane[:3])
        along = minus(edge[1], edge[0])
        share = Fraction(dot(along, minus(new, edge[0])), dot(along, along))
        # The foot of the perpendicular from P on the line of the edge.
        foot = [a + share * d for a, d in zip(edge[0], along, strict=True)]
        # An edge is sharp if the faces form an acute angle, so that the angle of their normals is obtuse.
        at_foot = right if dot(visible[:3], hidden[:3]) >= 0 else sharp
        for q, sums in ((foot, at_foot), ([*map(Fraction, edge[0])], elsewhere)):
            line = [p - c for p, c in zip(new, q, strict=True)]
            for normal in (visible[:3], hidden[:3]):
                acute = dot(normal, outward) > 0  # type: ignore[arg-type]
                sums.append(acute and _cosine(normal, line) + _cosine(normal, outward) == 1)
    check = searched(SETS[3], cases, right, f"{len(right)} angles are right with Q at the foot of the perpendicular")
    case = f"Q at an end of the edge, with {elsewhere.count(False)} wrong angles, and sharp edges, {sharp.count(False)}"
    return check.unless(False in elsewhere and False in sharp, case)


def _cosine(u: Sequence[int | Fraction], v: Sequence[int | Fraction]) -> Fraction:
    """Return the square of the cosine of an angle."""
    uv, uu, vv = (sum(a * b for a, b in zip(p, q, strict=True)) for p, q in ((u, v), (u, u), (v, v)))
    return Fraction(uv * uv) / (Fraction(uu) * vv)


@claim("kovalevsky-schulz.122")
def coefficients_by_cosines() -> Check:
    """Check the counterexample of an edge for which the coefficients a : b are a ratio of sines and not of cosines.

    For unit normals a : b is sin(beta_n) : sin(beta_v); the squares are compared.
    """
    *_, apex, new = points = counterexample_points("cosines.csv")
    p, q = points[1], points[2]
    slanted, below = plane_through(p, q, apex), plane_through(p, points[0], q)
    normal = plane_through(p, q, new)[:3]
    inner = points[0], apex
    visible, hidden, outer = (
        tuple(-n for n in face) if any(dot(face, minus(r, p)) > 0 for r in inner) else face
        for face in (below[:3], slanted[:3], normal)
    )
    a, b = _coefficients(visible, hidden, outer)  # type: ignore[arg-type]
    # Compare squares for unit normals, so that no roots are needed.
    ratio = a * a * dot(visible, visible) / (b * b * dot(hidden, hidden))  # type: ignore[arg-type]
    cosines = _cosine(visible, outer) / _cosine(hidden, outer)
    sines = (1 - _cosine(hidden, outer)) / (1 - _cosine(visible, outer))
    one_face_visible = dot(visible, minus(new, p)) > 0 > dot(hidden, minus(new, p))  # type: ignore[arg-type]
    message = f"(a : b)^2 is {ratio}, (cos beta_v : cos beta_n)^2 is {cosines}, (sin beta_n : sin beta_v)^2 is {sines}"
    return refuted(one_face_visible and a > 0 < b and ratio == sines != cosines, message)


def _coefficients(u: Point, v: Point, w: Point) -> tuple[Fraction, Fraction]:
    """Return a and b of w = a u + b v."""
    uu, uv, vv, uw, vw = dot(u, u), dot(u, v), dot(v, v), dot(u, w), dot(v, w)
    determinant = uu * vv - uv * uv
    return Fraction(uw * vv - vw * uv, determinant), Fraction(vw * uu - uw * uv, determinant)

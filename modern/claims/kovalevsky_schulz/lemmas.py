"""Checks of section 3 of Kovalevsky and Schulz: lemmas LZ, CH and BE and the intermediate claims of their proofs."""

from collections import Counter
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import combinations, product

from modern.claims.evidence import Check, claim, exhibited, refuted, search, searched
from modern.claims.kovalevsky_schulz.polyhedra import hulls
from modern.claims.kovalevsky_schulz.voxels import SOLIDS, Voxels
from modern.claims.sampled_sets import CASES, SETS, Plane, Point, counterexample_points, plane_through, plane_value
from modern.digital.solids import listed
from modern.exact_hull import ExactHull, exact_hull
from modern.geometry.vectors import cross, dot, minus, plus
from modern.papers.kovalevsky_schulz import CENTRES, convex_polyhedron, local_corners
from modern.papers.kovalevsky_schulz.cells import CellList

DIRECTIONS: tuple[Point, ...] = ((1, 0, 0), (1, -2, 1), (0, 3, -1))
# The corners of a triangle and a point inside it that lies on no line through two of them.
TRIANGLE: tuple[Point, ...] = ((0, 0, 0), (3, 0, 0), (0, 3, 0), (1, 1, 0))


def has_vertex_above(points: Sequence[Point], judge: ExactHull, direction: Point, height: int) -> bool:
    return any(dot(direction, points[k]) >= height for k in judge.vertices)


@claim("kovalevsky-schulz.65", full=400)
def lemma_lz(cases: int = CASES) -> Check:
    """Check that each nonempty part that a plane cuts off a set of points contains a vertex of the hull of the set."""
    outcomes = [
        has_vertex_above(points, judge, direction, dot(direction, point))
        for points, judge in hulls(cases)
        for direction in DIRECTIONS
        for point in points
    ]
    points, judge = hulls(1)[0]
    empty = has_vertex_above(points, judge, (1, 0, 0), 1 + max(p[0] for p in points))
    check = searched(SETS[3], cases, outcomes, f"{len(outcomes)} parts cut off by planes contain a vertex")
    return check.unless(not empty, "an empty part, beyond the largest x")


@claim("kovalevsky-schulz.66", "kovalevsky-schulz.68", full=400)
def last_maximum(cases: int = CASES) -> Check:
    """Check that the point with the largest value of an inequality (then of x, y and z) is unique and a vertex."""
    outcomes = []
    for points, judge in hulls(cases):
        for direction in DIRECTIONS:
            most = max(dot(direction, p) for p in points)
            largest = [k for k, p in enumerate(points) if dot(direction, p) == most]
            outcomes.append(max(largest, key=lambda k: points[k]) in judge.vertices)
    return searched(SETS[3], cases, outcomes, f"{len(outcomes)} points that are largest in this order are vertices")


@claim("kovalevsky-schulz.67")
def combination_of_three() -> Check:
    """Check that a point between two others combines these two, whereas (1, 1) in a triangle needs three points."""
    middle = 2 not in exact_hull([(0, 0, 0), (2, 0, 0), (1, 0, 0)]).vertices
    corners, inner = TRIANGLE[:3], TRIANGLE[3]
    two = [1 for p, q in combinations(corners, 2) if not any(cross(minus(q, p), minus(inner, p)))]
    message = "the middle of three collinear points is a combination of two"
    return exhibited(middle, message).unless(
        not two and 3 not in exact_hull(TRIANGLE).vertices,
        "(1, 1) in the triangle (0, 0), (3, 0), (0, 3), a combination of three points and of no two",
    )


@claim("kovalevsky-schulz.69", full=4_000)
def lemma_ch(cases: int = 10) -> Check:
    """Check that a convex polyhedron with corners among the local corners, all of which it has, has all voxels."""

    def contains_all(solid: Voxels) -> bool:
        judge = exact_hull([*map(tuple, local_corners(listed(solid), CENTRES).tolist())])
        return judge.dimension < 3 or all(plane_value(f.plane, p) <= 0 for f in judge.facets for p in solid)

    return search(SOLIDS, contains_all, cases, "all voxels are in the hull of the local corners")


@claim("kovalevsky-schulz.121", full=400)
def hull_without_a_vertex(cases: int = CASES) -> Check:
    """Check that each vertex of a hull is outside the hull of the other vertices."""
    outcomes = []
    for points, judge in hulls(cases):
        for k in judge.vertices:
            rest = exact_hull([points[i] for i in judge.vertices if i != k])
            outcomes.append(rest.dimension < 3 or max(plane_value(f.plane, points[k]) for f in rest.facets) > 0)
    return searched(SETS[3], cases, outcomes, f"{len(outcomes)} vertices are outside the hull of the others")


@claim("kovalevsky-schulz.120", vertices="interior")
@claim("kovalevsky-schulz.70", vertices="moved")
def smaller_polyhedron(vertices: str) -> Check:
    """Check the counterexample: a tetrahedron in a tetrahedron, with the apex moved down along an edge.

    vertices: ``interior``, no vertex of the smaller tetrahedron is in the interior of the larger, as with four
    alternate corners of a cube; ``moved``, one of them is neither a vertex of the larger tetrahedron nor in its
    interior.
    """
    *corners, lower = counterexample_points("shortened.csv")
    larger, smaller = exact_hull(corners), exact_hull([*corners[:-1], lower])
    within = [max(plane_value(f.plane, p) for f in larger.facets) for p in (*corners[:-1], lower)]
    wrong = smaller.dimension == 3 and smaller.vertices == (0, 1, 2, 3) and max(within) == min(within) == 0
    message = f"{lower} is a vertex of the smaller tetrahedron and on the boundary of the larger"
    if vertices == "moved":
        return refuted(wrong and lower not in corners, f"{message}, but not one of its vertices")
    four = [p for p in product((0, 1), repeat=3) if sum(p) % 2 == 0]
    return refuted(
        wrong and exact_hull(four).dimension == 3, f"{message}, like all of four alternate corners of a cube"
    )


@claim("kovalevsky-schulz.151", "kovalevsky-schulz.126", full=1_000)
def vertices_are_local_corners(cases: int = 10) -> Check:
    """Check that the polyhedron constructed from the local corners has the vertices of the hull of all voxels."""

    def agrees(solid: Voxels) -> bool:
        cells = convex_polyhedron(local_corners(listed(solid), CENTRES))
        hull_vertices = {solid[k] for k in exact_hull(solid).vertices}
        return not isinstance(cells, CellList) or hull_vertices <= {v.point for v in cells.vertices} <= {*solid}

    return search(SOLIDS, agrees, cases, "the constructed polyhedra have the vertices of the hulls of all voxels")


@claim("kovalevsky-schulz.129")
def complex_of_polyhedron() -> Check:
    """Check that "bounds" is a partial order of a hull's vertices, edges, faces and body; dimensions rise along it."""
    _, judge = hulls(1)[0]
    cells = [(0, frozenset([k])) for k in judge.vertices] + [(1, frozenset(e)) for e in judge.edges()]
    cells += [(2, frozenset(f.polygon)) for f in judge.facets] + [(3, frozenset(judge.vertices))]
    pairs = {(a, b) for a in cells for b in cells if a[1] < b[1]}
    passed = all(a[0] < b[0] for a, b in pairs) and not any((b, a) in pairs for a, b in pairs)
    passed &= all((a, c) in pairs for a, b in pairs for c in cells if (b, c) in pairs)
    return exhibited(passed, f"{len(cells)} cells have {len(pairs)} pairs of which one bounds the other")


@claim("kovalevsky-schulz.124", full=400)
def maximum_of_combinations(cases: int = CASES) -> Check:
    """Check that the midpoint of two points has the largest value of a linear function only if both points have it."""
    outcomes = []
    for points, _ in hulls(cases):
        for direction in DIRECTIONS:
            most = max(dot(direction, p) for p in points)
            for p, q in combinations(points, 2):
                both_highest = dot(direction, p) == most == dot(direction, q)
                outcomes.append((dot(direction, plus(p, q)) == 2 * most) == both_highest)
    return searched(SETS[3], cases, outcomes, f"true for {len(outcomes)} midpoints")


def _horizons(cases: int = CASES) -> Iterator[tuple[Point, Plane, Plane, Plane, list[Point], tuple[Point, Point]]]:
    """Yield sampled horizon edges: new point, visible, invisible and new plane, vertices, and edge."""
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


@claim("kovalevsky-schulz.71", full=400)
def lemma_be(cases: int = CASES) -> Check:
    """Check that the plane through a horizon edge and the new point supports the hull, unless the two are collinear."""
    outcomes = []
    for _, _, _, plane, vertices, _ in _horizons(cases):
        values = [plane_value(plane, p) for p in vertices]
        outcomes.append(max(values) <= 0 or min(values) >= 0)
    on_line = plane_through((0, 0, 0), (2, 0, 0), (4, 0, 0))
    check = searched(SETS[3], cases, outcomes, f"{len(outcomes)} planes through edges of horizons support")
    return check.unless(not any(on_line), "a point on the line of the edge, which determines no plane with it")


@claim("kovalevsky-schulz.72", full=400)
def positive_combination(cases: int = CASES) -> Check:
    """Check that the new normal is a N_v + b N_n with positive a and b; if F_n is coplanar with P, a is 0."""
    outcomes = []
    for _, visible, hidden, plane, vertices, _ in _horizons(cases):
        sign = -1 if max(plane_value(plane, p) for p in vertices) > 0 else 1
        normal = tuple(sign * n for n in plane[:3])
        outcomes.append(min(_coefficients(visible[:3], hidden[:3], normal)) > 0)  # type: ignore[arg-type]
    side, new = plane_through((0, 0, 0), (2, 0, 0), (0, 0, 2)), plane_through((0, 0, 0), (2, 0, 0), (4, -1, 0))
    check = searched(SETS[3], cases, outcomes, f"{len(outcomes)} normals are combinations with positive coefficients")
    return check.unless(
        _coefficients(side[:3], (0, 0, 1), new[:3])[0] == 0, "(4, -1, 0), in the plane of a square: a is 0"
    )


@claim("kovalevsky-schulz.76", full=400)
def closed_boundary(cases: int = CASES) -> Check:
    """Check that the edges between a visible and an invisible face of a hull form one closed curve."""
    checks = []
    for _, judge in hulls(cases):
        for new in ((9, 1, 0), (-8, 3, 7)):
            visible = [f for f in judge.facets if plane_value(f.plane, new) > 0]
            rim = [e for e in judge.edges() if sum({*e} <= {*f.polygon} for f in visible) == 1]
            ends = Counter(end for edge in rim for end in edge)
            checks.append(bool(rim) and {*ends.values()} == {2})
    return searched(SETS[3], cases, checks, f"the boundary is closed for {len(checks)} points outside a hull")


@claim("kovalevsky-schulz.73")
def section_angles() -> Check:
    """Check that the angles of Fig. 9 are right if Q is the foot of the perpendicular from P on the edge.

    They are not if Q is an end of the edge. Only squares of cosines are compared: beta is 90 - alpha or alpha - 90 if
    the squares add up to 1.
    """
    right: list[bool] = []
    elsewhere: list[bool] = []
    for new, visible, hidden, plane, vertices, edge in _horizons():
        sign = -1 if max(plane_value(plane, p) for p in vertices) > 0 else 1
        outward = tuple(sign * n for n in plane[:3])
        along = minus(edge[1], edge[0])
        share = Fraction(dot(along, minus(new, edge[0])), dot(along, along))
        # The foot of the perpendicular from P on the line of the edge.
        foot = [a + share * d for a, d in zip(edge[0], along, strict=True)]
        for q, sums in ((foot, right), ([*map(Fraction, edge[0])], elsewhere)):
            line = [p - c for p, c in zip(new, q, strict=True)]
            for normal in (visible[:3], hidden[:3]):
                sums.append(_cosine(normal, line) + _cosine(normal, outward) == 1)
    check = searched(SETS[3], CASES, right, f"{len(right)} angles are right with Q at the foot of the perpendicular")
    return check.unless(not all(elsewhere), f"Q at an end of the edge, where only {sum(elsewhere)} angles are right")


def _cosine(u: Sequence[int | Fraction], v: Sequence[int | Fraction]) -> Fraction:
    """Return the square of the cosine of an angle."""
    uv, uu, vv = (sum(a * b for a, b in zip(p, q, strict=True)) for p, q in ((u, v), (u, u), (v, v)))
    return Fraction(uv * uv) / (Fraction(uu) * vv)


@claim("kovalevsky-schulz.122")
def coefficients_by_cosines() -> Check:
    """Check the counterexample: a : b, of an edge of a tetrahedron, is no ratio of cosines but a ratio of sines.

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


@claim("kovalevsky-schulz.169", "kovalevsky-schulz.77", full=400)
def hulls_of_more_points(cases: int = CASES) -> Check:
    """Check that the hull of some of a set's points lies in the hull of more of them."""
    checks = []
    for points, _ in hulls(cases):
        for n in range(5, len(points)):
            few, more = exact_hull(points[:n]), exact_hull(points[: n + 1])
            if few.dimension == more.dimension == 3:
                checks.append(all(plane_value(f.plane, points[k]) <= 0 for f in more.facets for k in few.vertices))
    return searched(SETS[3], cases, checks, f"{len(checks)} hulls lie in the next one")


@claim("kovalevsky-schulz.167", full=400)
def moved_vertex(cases: int = CASES) -> Check:
    """Check that a vertex that is moved to the mean of all vertices leaves its old place outside the new hull."""
    checks = []
    for points, judge in hulls(cases):
        count = len(judge.vertices)
        x, y, z = (sum(points[k][axis] for k in judge.vertices) for axis in range(3))
        for k in judge.vertices:
            rest = [tuple(count * c for c in points[j]) for j in judge.vertices if j != k]
            moved = exact_hull([*rest, (x, y, z)])
            old = tuple(count * moved.scale * c for c in points[k])
            checks.append(max(plane_value(f.plane, old) for f in moved.facets) > 0)  # type: ignore[arg-type]
    return searched(SETS[3], cases, checks, f"{len(checks)} vertices are lost when they are moved")


@claim("kovalevsky-schulz.168", full=400)
def inner_side(cases: int = CASES) -> Check:
    """Check that no vertex of a hull is beyond the visible, the invisible or the new plane at a horizon edge."""
    checks = []
    for _, visible, hidden, plane, vertices, edge in _horizons(cases):
        ways = [minus(p, edge[0]) for p in vertices]
        sign = -1 if max(plane_value(plane, p) for p in vertices) > 0 else 1
        for normal in (visible[:3], hidden[:3], tuple(sign * n for n in plane[:3])):
            checks.append(max(dot(normal, way) for way in ways) == 0)  # type: ignore[arg-type]
    return searched(SETS[3], cases, checks, f"{len(checks)} normals point away from all vertices")


@claim("kovalevsky-schulz.173", full=400)
def angles_at_edge(cases: int = CASES) -> Check:
    """Check that the ways from an edge to the new point make acute angles with one normal, obtuse with the other."""
    checks = []
    for new, visible, hidden, _, _, (start, end) in _horizons(cases):
        for share in (0, 1, 2):
            way = [2 * p - (2 - share) * a - share * b for p, a, b in zip(new, start, end, strict=True)]
            of_visible, of_hidden = (sum(n * w for n, w in zip(p[:3], way, strict=True)) for p in (visible, hidden))
            checks.append(of_visible > 0 > of_hidden)
    return searched(SETS[3], cases, checks, f"{len(checks)} points of edges have an acute and an obtuse angle")

"""Checks of section 3 of Kovalevsky and Schulz: lemmas LZ, CH and BE and the intermediate claims of their proofs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import combinations, product

from modern.claims.evidence import Check, claim, holds_if, refuted
from modern.claims.kovalevsky_schulz.polyhedra import random_solid, sampled_hulls
from modern.claims.sampled_sets import Plane, Point, counterexample_points, plane_through, plane_value
from modern.exact_hull import exact_hull
from modern.geometry.vectors import cross, dot, minus, plus
from modern.papers.kovalevsky_schulz import CENTRES, convex_polyhedron, local_corners
from modern.papers.kovalevsky_schulz.cells import CellList


@claim("kovalevsky-schulz.65")
@claim("kovalevsky-schulz.66", "kovalevsky-schulz.68", kind="proof")
def lemma_lz(kind: str = "") -> Check:
    """Check that each part of a hull cut off by a plane contains a vertex."""
    checks = []
    for points, judge in sampled_hulls():
        for a, b, c in ((1, 0, 0), (1, -2, 1), (0, 3, -1)):
            heights = [dot((a, b, c), p) for p in points]
            for cut in sorted(set(heights)):
                checks.append(any(heights[k] >= cut for k in judge.vertices))
            most = [k for k, h in enumerate(heights) if h == max(heights)]
            checks.append(max(most, key=lambda k: points[k]) in judge.vertices)
    return holds_if(all(checks), f"{len(checks)} parts cut off by planes contain a vertex", conditional=not kind)


@claim("kovalevsky-schulz.67")
def combination_of_three() -> Check:
    """Check that (1, 1) in the triangle (0, 0), (3, 0), (0, 3) is a combination of three points and not of two."""
    points: list[Point] = [(0, 0, 0), (3, 0, 0), (0, 3, 0), (1, 1, 0)]
    two = [1 for p, q in combinations(points[:3], 2) if not any(cross(minus(q, p), minus(points[3], p)))]
    passed = not two and 3 not in exact_hull(points).vertices
    message = "(1, 1) in the triangle (0, 0), (3, 0), (0, 3) is a combination of three points and not of two"
    return holds_if(passed, message, conditional=True)


@claim("kovalevsky-schulz.149", "kovalevsky-schulz.69")
def lemma_ch() -> Check:
    """Check that a polyhedron with corners among the local corners that contains all of these contains all voxels."""
    volume = random_solid(3)
    corners = [*map(tuple, local_corners(volume, CENTRES).tolist())]
    judge = exact_hull(corners)
    checks = [
        max(plane_value(f.plane, p) for f in judge.facets) <= 0 for p in map(tuple, volume.coordinates().tolist())
    ]
    return holds_if(all(checks), f"{len(checks)} voxels are in the hull of the local corners")


@claim("kovalevsky-schulz.150", "kovalevsky-schulz.121")
def hull_without_a_vertex() -> Check:
    """Check that a vertex is outside the hull of the other vertices."""
    checks = []
    for points, judge in sampled_hulls():
        for k in judge.vertices[:4]:
            rest = exact_hull([points[i] for i in judge.vertices if i != k])
            checks.append(rest.dimension < 3 or max(plane_value(f.plane, points[k]) for f in rest.facets) > 0)
    return holds_if(all(checks), f"{len(checks)} vertices are outside the hull of the others")


@claim("kovalevsky-schulz.120")
@claim("kovalevsky-schulz.70", kind="moved")
def smaller_polyhedron(kind: str = "") -> Check:
    """Check the counterexample: a tetrahedron that contains another one, whose apex is moved down an edge.

    No vertex of the smaller one is in the interior of the larger, contrary to the proof. ``moved``: one of them is
    neither a vertex of the larger one nor in its interior, so that vertices moved into the interior never give it.
    """
    *corners, lower = counterexample_points("shortened.csv")
    larger, smaller = exact_hull(corners), exact_hull([*corners[:-1], lower])
    within = [max(plane_value(f.plane, p) for f in larger.facets) for p in (*corners[:-1], lower)]
    wrong = smaller.dimension == 3 and smaller.vertices == (0, 1, 2, 3) and max(within) == min(within) == 0
    message = f"{lower} is a vertex of the smaller tetrahedron and on the boundary of the larger"
    if kind:
        return holds_if(not (wrong and lower not in corners), f"{message}, but not one of its vertices")
    cube = [*product((0, 1), repeat=3)]
    four = [p for p in cube if sum(p) % 2 == 0]
    wrong &= exact_hull(four).dimension == 3
    return holds_if(not wrong, f"{message}, like all of four alternate corners of a cube")


@claim("kovalevsky-schulz.172", "kovalevsky-schulz.151", "kovalevsky-schulz.126")
def third_condition() -> Check:
    """Check that the vertices of the constructed polyhedron are local corners."""
    volume = random_solid(2)
    corners = local_corners(volume, CENTRES)
    cells = convex_polyhedron(corners)
    assert isinstance(cells, CellList)
    hull_vertices = {v.point for v in cells.vertices}
    message = f"all {len(hull_vertices)} vertices are among {len(corners)} local corners"
    return holds_if(hull_vertices <= {*map(tuple, corners.tolist())}, message)


@claim("kovalevsky-schulz.129")
def complex_of_polyhedron() -> Check:
    """Check that bounding is a partial order of the vertices, edges, faces and body of a hull; dimensions rise."""
    _, judge = sampled_hulls()[0]
    cells = [(0, frozenset([k])) for k in judge.vertices] + [(1, frozenset(e)) for e in judge.edges()]
    cells += [(2, frozenset(f.polygon)) for f in judge.facets] + [(3, frozenset(judge.vertices))]
    pairs = {(a, b) for a in cells for b in cells if a[1] < b[1]}
    passed = all(a[0] < b[0] for a, b in pairs) and not any((b, a) in pairs for a, b in pairs)
    passed &= all((a, c) in pairs for a, b in pairs for c in cells if (b, c) in pairs)
    return holds_if(passed, f"{len(cells)} cells have {len(pairs)} bounding pairs")


@claim("kovalevsky-schulz.124")
def maximum_of_combinations() -> Check:
    """Check that a midpoint has the largest value if and only if both of its ends have it."""
    checks = []
    for points, _ in sampled_hulls():
        for direction in ((1, 0, 0), (1, -2, 1), (0, 3, -1)):
            most = max(dot(direction, p) for p in points)
            for p, q in combinations(points, 2):
                if most in (dot(direction, p), dot(direction, q)):
                    both_highest = dot(direction, p) == dot(direction, q)
                    checks.append((dot(direction, plus(p, q)) == 2 * most) == both_highest)
    return holds_if(all(checks), f"{len(checks)} midpoints agree")


def _horizons() -> Iterator[tuple[Point, Plane, Plane, Plane, list[Point], tuple[Point, Point]]]:
    """Yield new points with the visible, invisible and new plane, the vertices and the edge at sampled horizons."""
    for points, judge in sampled_hulls():
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


@claim("kovalevsky-schulz.71")
@claim("kovalevsky-schulz.72", kind="normals")
def lemma_be(kind: str = "") -> Check:
    """Check that the new plane supports and, with ``kind``, that its normal is a positive combination."""
    checks = []
    for _, visible, hidden, plane, vertices, _ in _horizons():
        values = [plane_value(plane, p) for p in vertices]
        sign = -1 if max(values) > 0 else 1
        checks.append(max(sign * v for v in values) <= 0)
        if kind:
            normal = tuple(sign * n for n in plane[:3])
            a, b = _coefficients(visible[:3], hidden[:3], normal)  # type: ignore[arg-type]
            checks.append(a > 0 and b > 0)
    if kind:
        new, apex = (4, -1, 0), (0, 0, 2)
        coplanar = plane_through((0, 0, 0), (2, 0, 0), new)
        checks.append(_coefficients(plane_through((0, 0, 0), (2, 0, 0), apex)[:3], (0, 0, 1), coplanar[:3])[0] == 0)
    return holds_if(all(checks) and checks, f"{len(checks)} conditions at edges hold", conditional=True)


@claim("kovalevsky-schulz.76")
def closed_boundary() -> Check:
    """Check that the edges that bound one visible and one invisible face form closed boundaries."""
    checks = []
    for _, judge in sampled_hulls():
        for new in ((9, 1, 0), (-8, 3, 7)):
            visible = [f for f in judge.facets if plane_value(f.plane, new) > 0]
            rim = [e for e in judge.edges() if sum({*e} <= {*f.polygon} for f in visible) == 1]
            ends = Counter(end for edge in rim for end in edge)
            checks.append(bool(rim) and {*ends.values()} == {2})
    return holds_if(all(checks), f"the boundary is closed for {len(checks)} points outside a hull")


@claim("kovalevsky-schulz.73")
def section_angles() -> Check:
    """Check the angles of Fig. 9 with Q at the foot of the perpendicular from P on the edge, and with Q at an end.

    Only squares of cosines are compared: beta is 90 - alpha or alpha - 90 if the squares add up to 1.
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
    passed = all(right) and right and not all(elsewhere)
    message = (
        f"{sum(right)} of {len(right)} angles agree with Q at the foot of the perpendicular, and "
        f"{sum(elsewhere)} with Q at an end of the edge"
    )
    return holds_if(passed, message, conditional=True)


def _cosine(u: Sequence[int | Fraction], v: Sequence[int | Fraction]) -> Fraction:
    """Return the square of the cosine of an angle."""
    uv, uu, vv = (sum(a * b for a, b in zip(p, q, strict=True)) for p, q in ((u, v), (u, u), (v, v)))
    return Fraction(uv * uv) / (Fraction(uu) * vv)


@claim("kovalevsky-schulz.122")
def coefficients_by_cosines() -> Check:
    """Check the counterexample: an edge of a tetrahedron between the one face that a point sees and a slanted face.

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


@claim("kovalevsky-schulz.169", "kovalevsky-schulz.77")
def hulls_of_more_points() -> Check:
    """Check that the vertices of a hull lie in the hull of more points."""
    checks = []
    for points, _ in sampled_hulls():
        for n in range(5, len(points)):
            few, more = exact_hull(points[:n]), exact_hull(points[: n + 1])
            if few.dimension == more.dimension == 3:
                checks.append(all(plane_value(f.plane, points[k]) <= 0 for f in more.facets for k in few.vertices))
    return holds_if(bool(checks) and all(checks), f"{len(checks)} hulls lie in the next one")


@claim("kovalevsky-schulz.167")
def moved_vertex() -> Check:
    """Check that a vertex is outside the hull after it is moved to the mean of all vertices."""
    checks = []
    for points, judge in sampled_hulls():
        count = len(judge.vertices)
        x, y, z = (sum(points[k][axis] for k in judge.vertices) for axis in range(3))
        for k in judge.vertices:
            rest = [tuple(count * c for c in points[j]) for j in judge.vertices if j != k]
            moved = exact_hull([*rest, (x, y, z)])
            old = tuple(count * moved.scale * c for c in points[k])
            checks.append(max(plane_value(f.plane, old) for f in moved.facets) > 0)  # type: ignore[arg-type]
    return holds_if(all(checks), f"{len(checks)} vertices are lost when they are moved")


@claim("kovalevsky-schulz.168")
def inner_side() -> Check:
    """Check that no vertex lies on the outer side of the two faces or of the new plane."""
    checks = []
    for _, visible, hidden, plane, vertices, edge in _horizons():
        ways = [minus(p, edge[0]) for p in vertices]
        sign = -1 if max(plane_value(plane, p) for p in vertices) > 0 else 1
        for normal in (visible[:3], hidden[:3], tuple(sign * n for n in plane[:3])):
            checks.append(max(dot(normal, way) for way in ways) == 0)  # type: ignore[arg-type]
    return holds_if(bool(checks) and all(checks), f"{len(checks)} normals point away from all vertices")


@claim("kovalevsky-schulz.173")
def angles_at_edge() -> Check:
    """Check the signs of the products of both normals with the direction to the new point, from points of each edge."""
    checks = []
    for new, visible, hidden, _, _, (start, end) in _horizons():
        for share in (0, 1, 2):
            way = [2 * p - (2 - share) * a - share * b for p, a, b in zip(new, start, end, strict=True)]
            of_visible, of_hidden = (sum(n * w for n, w in zip(p[:3], way, strict=True)) for p in (visible, hidden))
            checks.append(of_visible > 0 > of_hidden)
    return holds_if(bool(checks) and all(checks), f"{len(checks)} points of edges have an acute and an obtuse angle")

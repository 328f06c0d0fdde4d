"""Claims of section 3 of Kovalevsky and Schulz: lemmas LZ, CH and BE and what their proofs say on the way."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import combinations, product

from modern.claims.kovalevsky_schulz.polyhedra import grown, solid_at_random
from modern.claims.register import CONDITION, FAILS, HOLDS, Seen, seen
from modern.claims.sampled_sets import Plane, Point, through, value
from modern.claims.thesis.chapter3_equations import points_of
from modern.exact_hull import exact_hull
from modern.geometry.vectors import cross, dot, minus, plus
from modern.papers.kovalevsky_schulz import CENTRES, convex_polyhedron, local_corners
from modern.papers.kovalevsky_schulz.cells import CellList


def lemma_lz(kind: str = "") -> Seen:
    """What planes through the middle cut off holds a vertex."""
    good = []
    for points, judge in grown():
        for a, b, c in ((1, 0, 0), (1, -2, 1), (0, 3, -1)):
            heights = [dot((a, b, c), p) for p in points]
            for cut in sorted(set(heights)):
                good.append(any(heights[k] >= cut for k in judge.vertices))
            most = [k for k, h in enumerate(heights) if h == max(heights)]
            good.append(max(most, key=lambda k: points[k]) in judge.vertices)
    return Seen((HOLDS if kind else CONDITION) if all(good) else FAILS, f"{len(good)} cuts")


def two_do_not_do() -> Seen:
    """(1, 1) within (0, 0), (3, 0), (0, 3): a combination of three, of no two."""
    points: list[Point] = [(0, 0, 0), (3, 0, 0), (0, 3, 0), (1, 1, 0)]
    two = [1 for p, q in combinations(points[:3], 2) if not any(cross(minus(q, p), minus(points[3], p)))]
    good = not two and 3 not in exact_hull(points).vertices
    return Seen(CONDITION if good else FAILS, "(1, 1) of that triangle")


def lemma_ch() -> Seen:
    """A polyhedron on corners that holds all of them holds all voxels."""
    volume = solid_at_random(3)
    corners = [*map(tuple, local_corners(volume, CENTRES).tolist())]
    judge = exact_hull(corners)
    good = [max(value(f.plane, p) for f in judge.facets) <= 0 for p in map(tuple, volume.coordinates().tolist())]
    return seen(all(good), f"{len(good)} voxels")


def smaller_loses_a_vertex() -> Seen:
    """Each vertex left out is outside of the hull of the others."""
    good = []
    for points, judge in grown():
        for k in judge.vertices[:4]:
            rest = exact_hull([points[i] for i in judge.vertices if i != k])
            good.append(rest.dimension < 3 or max(value(f.plane, points[k]) for f in rest.facets) > 0)
    return seen(all(good), f"{len(good)} vertices")


def smaller_polyhedron(kind: str = "") -> Seen:
    """The counterexample: a tetrahedron, and one within it with its apex moved down an edge.

    No vertex of the smaller one is in the interior of the larger, as the proof has it; and with ``moved``, one of
    them is neither a vertex of the larger nor in its interior, so that no moves of vertices into it end there.
    """
    *corners, lower = points_of("shortened.csv")
    larger, smaller = exact_hull(corners), exact_hull([*corners[:-1], lower])
    within = [max(value(f.plane, p) for f in larger.facets) for p in (*corners[:-1], lower)]
    wrong = smaller.dimension == 3 and smaller.vertices == (0, 1, 2, 3) and max(within) == min(within) == 0
    words = f"{lower} is a vertex of the smaller one, on the boundary of the larger"
    if kind:
        return seen(not (wrong and lower not in corners), f"{words} and none of its vertices")
    cube = [*product((0, 1), repeat=3)]
    four = [p for p in cube if sum(p) % 2 == 0]
    wrong &= exact_hull(four).dimension == 3
    return seen(not wrong, f"{words}; and so are all of four alternate corners of a cube")


def third_condition() -> Seen:
    """Vertices of the polyhedron that is made are local corners."""
    volume = solid_at_random(2)
    corners = local_corners(volume, CENTRES)
    cells = convex_polyhedron(corners)
    assert isinstance(cells, CellList)
    found = {v.point for v in cells.vertices}
    return seen(found <= {*map(tuple, corners.tolist())}, f"{len(found)} vertices of {len(corners)} local corners")


def polyhedron_is_a_complex() -> Seen:
    """Vertices, edges, faces and body of a hull: bounding is a partial order, and dimensions rise with it."""
    _, judge = grown()[0]
    cells = [(0, frozenset([k])) for k in judge.vertices] + [(1, frozenset(e)) for e in judge.edges()]
    cells += [(2, frozenset(f.polygon)) for f in judge.facets] + [(3, frozenset(judge.vertices))]
    pairs = {(a, b) for a in cells for b in cells if a[1] < b[1]}
    good = all(a[0] < b[0] for a, b in pairs) and not any((b, a) in pairs for a, b in pairs)
    good &= all((a, c) in pairs for a, b in pairs for c in cells if (b, c) in pairs)
    return seen(good, f"{len(cells)} cells, {len(pairs)} pairs")


def maximum_of_the_highest() -> Seen:
    """Means of a point with the largest value and one with less have less, those of two with the largest have it."""
    good = []
    for points, _ in grown():
        for direction in ((1, 0, 0), (1, -2, 1), (0, 3, -1)):
            most = max(dot(direction, p) for p in points)
            for p, q in combinations(points, 2):
                if most in (dot(direction, p), dot(direction, q)):
                    both = dot(direction, p) == dot(direction, q)
                    good.append((dot(direction, plus(p, q)) == 2 * most) == both)
    return seen(all(good), f"{len(good)} combinations")


def _horizons() -> Iterator[tuple[Point, Plane, Plane, Plane, list[Point], tuple[Point, Point]]]:
    """New point, planes of a visible and an invisible face, plane of the point and their edge, vertices, the edge."""
    for points, judge in grown():
        for new in ((9, 1, 0), (-8, 3, 7)):
            for edge in judge.edges():
                one, other = (f.plane for f in judge.facets if {*edge} <= {*f.polygon})
                visible, hidden = (one, other) if value(one, new) > 0 else (other, one)
                if value(visible, new) > 0 > value(hidden, new):
                    ends = points[edge[0]], points[edge[1]]
                    yield new, visible, hidden, through(*ends, new), [points[k] for k in judge.vertices], ends


def lemma_be(kind: str = "") -> Seen:
    """The plane supports; its normal is a combination with positive coefficients, of a coplanar face with a = 0."""
    good = []
    for _, visible, hidden, plane, vertices, _ in _horizons():
        values = [value(plane, p) for p in vertices]
        sign = -1 if max(values) > 0 else 1
        good.append(max(sign * v for v in values) <= 0)
        if kind:
            normal = tuple(sign * n for n in plane[:3])
            a, b = _coefficients(visible[:3], hidden[:3], normal)  # type: ignore[arg-type]
            good.append(a > 0 and b > 0)
    if kind:
        new, apex = (4, -1, 0), (0, 0, 2)
        coplanar = through((0, 0, 0), (2, 0, 0), new)
        good.append(_coefficients(through((0, 0, 0), (2, 0, 0), apex)[:3], (0, 0, 1), coplanar[:3])[0] == 0)
    return Seen(CONDITION if all(good) and good else FAILS, f"{len(good)} edges")


def closed_boundary() -> Seen:
    """Edges around the visible faces bound one visible and one invisible face, by the vertices of the edges."""
    good = []
    for _, judge in grown():
        for new in ((9, 1, 0), (-8, 3, 7)):
            visible = [f for f in judge.facets if value(f.plane, new) > 0]
            rim = [e for e in judge.edges() if sum({*e} <= {*f.polygon} for f in visible) == 1]
            ends = Counter(end for edge in rim for end in edge)
            good.append(bool(rim) and {*ends.values()} == {2})
    return seen(all(good), f"{len(good)} points outside of a hull")


def section() -> Seen:
    """The angles of Fig. 9 with Q at the foot of P on the edge's line, and with Q at the edge's end.

    Of the angles only squares of cosines and their signs are used: beta = 90 - alpha or alpha - 90 if the squares of
    the two cosines add up to 1.
    """
    right: list[bool] = []
    elsewhere: list[bool] = []
    for new, visible, hidden, plane, vertices, edge in _horizons():
        sign = -1 if max(value(plane, p) for p in vertices) > 0 else 1
        outward = tuple(sign * n for n in plane[:3])
        along = minus(edge[1], edge[0])
        share = Fraction(dot(along, minus(new, edge[0])), dot(along, along))
        foot = [a + share * d for a, d in zip(edge[0], along, strict=True)]
        for q, found in ((foot, right), ([*map(Fraction, edge[0])], elsewhere)):
            line = [p - c for p, c in zip(new, q, strict=True)]
            for normal in (visible[:3], hidden[:3]):
                found.append(_cosine(normal, line) + _cosine(normal, outward) == 1)
    good = all(right) and right and not all(elsewhere)
    words = (
        f"{sum(right)} of {len(right)} angles with Q at the foot of P, {sum(elsewhere)} with Q at an end of the edge"
    )
    return Seen(CONDITION if good else FAILS, words)


def _cosine(u: Sequence[int | Fraction], v: Sequence[int | Fraction]) -> Fraction:
    """The square of the cosine of an angle."""
    uv, uu, vv = (sum(a * b for a, b in zip(p, q, strict=True)) for p, q in ((u, v), (u, u), (v, v)))
    return Fraction(uv * uv) / (Fraction(uu) * vv)


def coefficients_by_cosines() -> Seen:
    """The counterexample: a tetrahedron, of which a point sees one face, and its edge with the slanted one.

    a : b of the unit normals is sin(beta_n) : sin(beta_v); compared are the squares.
    """
    *_, apex, new = points = points_of("cosines.csv")
    p, q = points[1], points[2]
    slanted, below = through(p, q, apex), through(p, points[0], q)
    normal = through(p, q, new)[:3]
    inner = points[0], apex
    visible, hidden, outer = (
        tuple(-n for n in face) if any(dot(face, minus(r, p)) > 0 for r in inner) else face
        for face in (below[:3], slanted[:3], normal)
    )
    a, b = _coefficients(visible, hidden, outer)  # type: ignore[arg-type]
    ratio = a * a * dot(visible, visible) / (b * b * dot(hidden, hidden))  # type: ignore[arg-type]
    cosines = _cosine(visible, outer) / _cosine(hidden, outer)
    sines = (1 - _cosine(hidden, outer)) / (1 - _cosine(visible, outer))
    seen_one = dot(visible, minus(new, p)) > 0 > dot(hidden, minus(new, p))  # type: ignore[arg-type]
    words = f"(a : b)^2 is {ratio}, (cos beta_v : cos beta_n)^2 is {cosines}, (sin beta_n : sin beta_v)^2 is {sines}"
    return Seen(FAILS if seen_one and a > 0 < b and ratio == sines != cosines else HOLDS, words)


def _coefficients(u: Point, v: Point, w: Point) -> tuple[Fraction, Fraction]:
    """a and b of w = a u + b v."""
    uu, uv, vv, uw, vw = dot(u, u), dot(u, v), dot(v, v), dot(u, w), dot(v, w)
    determinant = uu * vv - uv * uv
    return Fraction(uw * vv - vw * uv, determinant), Fraction(vw * uu - uw * uv, determinant)


def polyhedra_grow() -> Seen:
    """Vertices of a hull lie in that of more points."""
    good = []
    for points, _ in grown():
        for n in range(5, len(points)):
            few, more = exact_hull(points[:n]), exact_hull(points[: n + 1])
            if few.dimension == more.dimension == 3:
                good.append(all(value(f.plane, points[k]) <= 0 for f in more.facets for k in few.vertices))
    return seen(bool(good) and all(good), f"{len(good)} steps")


def moved_vertex_is_lost() -> Seen:
    """Each vertex of a hull moved into its interior, to the mean of all vertices: it is outside of what is left."""
    good = []
    for points, judge in grown():
        number = len(judge.vertices)
        x, y, z = (sum(points[k][axis] for k in judge.vertices) for axis in range(3))
        for k in judge.vertices:
            rest = [tuple(number * c for c in points[j]) for j in judge.vertices if j != k]
            moved = exact_hull([*rest, (x, y, z)])
            old = tuple(number * moved.scale * c for c in points[k])
            good.append(max(value(f.plane, old) for f in moved.facets) > 0)  # type: ignore[arg-type]
    return seen(all(good), f"{len(good)} vertices")


def inner_side() -> Seen:
    """From a point of the edge to any vertex: not along the two faces' normals, nor along that of the new plane."""
    good = []
    for _, visible, hidden, plane, vertices, edge in _horizons():
        ways = [minus(p, edge[0]) for p in vertices]
        sign = -1 if max(value(plane, p) for p in vertices) > 0 else 1
        for normal in (visible[:3], hidden[:3], tuple(sign * n for n in plane[:3])):
            good.append(max(dot(normal, way) for way in ways) == 0)  # type: ignore[arg-type]
    return seen(bool(good) and all(good), f"{len(good)} normals")


def acute_and_obtuse() -> Seen:
    """Products of the two normals with the way to the new point, from three points of each edge."""
    good = []
    for new, visible, hidden, _, _, (start, end) in _horizons():
        for share in (0, 1, 2):
            way = [2 * p - (2 - share) * a - share * b for p, a, b in zip(new, start, end, strict=True)]
            of_visible, of_hidden = (sum(n * w for n, w in zip(p[:3], way, strict=True)) for p in (visible, hidden))
            good.append(of_visible > 0 > of_hidden)
    return seen(bool(good) and all(good), f"{len(good)} points of edges")

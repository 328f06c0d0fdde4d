"""Claims of Appel and Will: properties of convex polyhedra, their two-dimensional methods, steps as printed."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from itertools import combinations, pairwise, product
from random import Random

from modern.claims.register import CONDITION, FAILS, HOLDS, Seen, seen
from modern.claims.sampled_sets import Point, sampled_sets, value
from modern.claims.thesis.chapter3_equations import COUNT, points_of
from modern.exact_hull import ExactHull, exact_hull
from modern.geometry.vectors import cross, dot, minus
from modern.papers.appel_will import Method, appel_will, printed
from modern.papers.appel_will.edges import project
from modern.papers.appel_will.star import as_corrected, as_printed, vorticity

Flat = tuple[int, int]
CUBE = tuple(product((0, 1), repeat=3))


def _area(p: Flat, q: Flat, r: Flat) -> int:
    return vorticity((q[0] - p[0], q[1] - p[1]), (r[0] - p[0], r[1] - p[1]))


def method_is_right(kind: str = "", count: str = COUNT) -> Seen:
    """Edges and faces by the corrected method, against the judge's."""
    good = []
    for one in sampled_sets(3, int(count)):
        hull = appel_will(one.points)
        faces = {frozenset(facet.polygon) for facet in one.judge.facets}
        good.append(hull.edges == one.judge.edges() and {frozenset(s) for s in hull.surfaces} == faces)
    words = f"{sum(good)} of {len(good)} sets as the exact judge"
    return Seen((HOLDS if kind else CONDITION) if all(good) else FAILS, words)


def _hulls(count: str = COUNT) -> list[tuple[tuple[Point, ...], ExactHull]]:
    return [(one.points, one.judge) for one in sampled_sets(3, int(count))]


def convex_body() -> Seen:
    """Midpoints of vertices of hulls have no positive value."""
    good = []
    for points, judge in _hulls("1"):
        for i, j in combinations(judge.vertices, 2):
            good.append(max(value(f.plane, points[i]) + value(f.plane, points[j]) for f in judge.facets) <= 0)
    return seen(all(good), f"{len(good)} segments")


def convex_points() -> Seen:
    """Corners of the judge's polygons turn left, all of them."""
    good = []
    for one in sampled_sets(2, 2):
        ring = [one.points[k][:2] for k in one.judge.polygon]
        turns = [_area(ring[k - 2], ring[k - 1], ring[k]) for k in range(len(ring))]
        good.append(len({turn > 0 for turn in turns}) == 1 and 0 not in turns)
    return seen(all(good), f"{len(good)} polygons")


def deleting_passes() -> Seen:
    """Simple polygons at random: passes that delete all nonconvex points end with the hull."""
    random = Random(4)
    good: list[bool] = []
    while len(good) < 12:
        ring = [(random.randint(0, 6), random.randint(0, 6)) for _ in range(random.randint(4, 7))]
        if _simple(ring):
            hull = exact_hull([(x, y, 0) for x, y in ring])
            good.append({*_passed(ring)} == {ring[k] for k in hull.vertices})
    return Seen(CONDITION if all(good) else FAILS, f"{sum(good)} of {len(good)} polygons")


def deleting_makes_nonconvex() -> Seen:
    """A polygon with a convex point that is nonconvex once a nonconvex one beside it is deleted."""
    ring = [(0, 0), (10, 0), (10, 10), (6, 1), (5, 5), (4, 1), (0, 10)]
    before = {p for k, p in enumerate(ring) if _area(ring[k - 1], p, ring[(k + 1) % len(ring)]) > 0}
    left = [p for p in ring if p in before]
    after = {p for k, p in enumerate(left) if _area(left[k - 1], p, left[(k + 1) % len(left)]) > 0}
    lost = sorted(before - after)
    return seen(bool(lost), f"{', '.join(map(str, lost))} is convex at first and not afterwards")


def _passed(ring: Sequence[Flat]) -> list[Flat]:
    left = [p for k, p in enumerate(ring) if _area(ring[k - 1], p, ring[(k + 1) % len(ring)]) > 0]
    return left if len(left) in (len(ring), 2) else _passed(left)


def _simple(ring: Sequence[Flat]) -> bool:
    n = len(ring)
    sides = [(ring[k], ring[(k + 1) % n]) for k in range(n)]
    apart = ((i, j) for i, j in combinations(range(n), 2) if j - i not in (1, n - 1))
    cut = any(
        _area(*sides[i], sides[j][0]) * _area(*sides[i], sides[j][1]) <= 0
        and _area(*sides[j], sides[i][0]) * _area(*sides[j], sides[i][1]) <= 0
        for i, j in apart
    )
    turned = any(not _area(ring[k - 2], ring[k - 1], ring[k]) for k in range(n))
    return len({*ring}) == n and not cut and not turned and sum(p[0] * q[1] - p[1] * q[0] for p, q in sides) > 0


def jarvis_by_the_letter() -> Seen:
    """The first point of least polar angle, from 0 to below 360, about an origin outside the set."""
    origin, *points = points_of("jarvis.csv")
    angles = [math.atan2(y - origin[1], x - origin[0]) % (2 * math.pi) for x, y, _ in points]
    first = angles.index(min(angles))
    inside = first not in exact_hull(points).vertices and 0 in exact_hull([origin, *points]).vertices
    return Seen(FAILS if inside else HOLDS, f"{points[first][:2]} is taken first and lies inside the hull")


def jarvis_deletions(kind: str = "") -> Seen:
    """A point inside the polygon of some hull points is no vertex of the hull."""
    good = []
    for one in sampled_sets(2, 2):
        some = one.judge.vertices[:3]
        corners = [one.points[k] for k in some]
        for k, point in enumerate(one.points):
            if k not in some and 3 not in exact_hull([*corners, point]).vertices:
                good.append(k not in one.judge.vertices)
    return Seen(
        (CONDITION if kind else HOLDS) if all(good) else FAILS, f"{len(good)} points within triangles of vertices"
    )


def properties(number: str) -> Seen:
    """A property of convex polyhedra, on the judge's hulls, of which some have points inside."""
    good = [right for points, judge in _hulls("4") for right in _PROPERTIES[number](points, judge)]
    return seen(bool(good) and all(good), f"{len(good)} cases")


def _inside_of_all(points: Sequence[Point], judge: ExactHull) -> list[bool]:
    """The mean of the vertices, times their number, which is inside whatever the hull."""
    number = len(judge.vertices)
    x, y, z = (sum(points[k][axis] for k in judge.vertices) for axis in range(3))
    return [dot(f.plane[:3], (x, y, z)) + number * f.plane[3] < 0 for f in judge.facets]


def _cones(points: Sequence[Point], judge: ExactHull) -> list[bool]:
    """All points lie in the cone of the planes at a vertex, and only the vertex is on all of them."""
    found = []
    for k in judge.vertices:
        planes = [f.plane for f in judge.facets if k in f.polygon]
        found.append(all(value(p, q) <= 0 for p in planes for q in points))
        found.append(sum(not any(value(p, q) for p in planes) for q in points) == 1)
    return found


def _dihedral(points: Sequence[Point], judge: ExactHull) -> list[bool]:
    found = []
    for edge in judge.edges():
        both = [f for f in judge.facets if {*edge} <= {*f.polygon}]
        far = [value(both[0].plane, points[k]) < 0 for k in both[-1].polygon if k not in edge]
        found.append(len(both) == 2 and all(far))
    return found


def _faces(points: Sequence[Point], judge: ExactHull) -> list[bool]:
    found = []
    for facet in judge.facets:
        ring = [points[k] for k in facet.polygon]
        turns = [
            dot(cross(minus(ring[k - 1], ring[k - 2]), minus(ring[k], ring[k - 1])), facet.plane[:3])
            for k in range(len(ring))
        ]
        found.append(min(turns) > 0)
    return found


def _projections(points: Sequence[Point], judge: ExactHull) -> list[bool]:
    """The image of the hull is the hull of the images: no image of another point is a corner of it."""
    found = []
    for u, v in ((0, 1), (1, 2), (0, 2)):
        images = [(p[u], p[v], 0) for p in points]
        corners = {images[k] for k in exact_hull(images).vertices}
        found.append(corners <= {images[k] for k in judge.vertices})
    return found


_PROPERTIES = {"1": _inside_of_all, "2": _cones, "3": _dihedral, "4": _faces, "5": _projections}


ARM = 9
"""Cubes in each of the three arms of a star."""


def surface_area() -> Seen:
    """A hull inside of a box has less surface than the box; three arms of cubes have less than their hull."""
    octahedron: list[Point] = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    box = [(2 * x - 1, 2 * y - 1, 2 * z - 1) for x, y, z in CUBE]
    inner, outer = _surface(octahedron), _surface(box)
    cubes = (
        {(k, 0, 0) for k in range(ARM + 1)} | {(0, k, 0) for k in range(ARM + 1)} | {(0, 0, k) for k in range(ARM + 1)}
    )
    ways = [step for step in product((-1, 0, 1), repeat=3) if sum(map(abs, step)) == 1]
    star = sum((x + i, y + j, z + k) not in cubes for x, y, z in cubes for i, j, k in ways)
    around = _surface(sorted({(x + i, y + j, z + k) for x, y, z in cubes for i, j, k in CUBE}))
    words = f"an octahedron {inner:.2f}, its cube {outer:.2f}; three arms of cubes {star}, their hull {around:.0f}"
    return Seen(CONDITION if inner < outer and star < around else FAILS, words)


def _surface(points: list[Point]) -> float:
    total = 0.0
    for facet in exact_hull(points).facets:
        first, *rest = (points[k] for k in facet.polygon)
        for p, q in pairwise(rest):
            normal = cross(minus(p, first), minus(q, first))
            total += math.sqrt(dot(normal, normal)) / 2
    return total


def numbers_of_combinations(kind: str) -> Seen:
    """Pairs and triples of 4 to 12 things."""
    pairs = {n: (math.comb(n, 2), math.comb(n, 3)) for n in range(4, 13)}
    if kind == "formula":
        good = all(
            math.factorial(n) // (math.factorial(2) * math.factorial(n - 2)) == two for n, (two, _) in pairs.items()
        )
        return Seen(CONDITION if good else FAILS, "N! / (r! (N - r)!)")
    fewer = [n for n, (two, three) in pairs.items() if two < three]
    return Seen(
        CONDITION if fewer == list(range(6, 13)) else FAILS, "6 and 4 of four, 10 and 10 of five, 15 and 20 of six"
    )


def outside_of_the_others() -> Seen:
    """The definition with all other images, against the judge's edges."""
    good = []
    for points, judge in _hulls("1"):
        edges = {*judge.edges()}
        for pair in combinations(range(len(points)), 2):
            found = project(points, pair, range(len(points)))
            if len(found.line) == 2:
                good.append(as_corrected(found.images) == (pair in edges))
    return seen(all(good), f"{len(good)} pairs")


def area_of_triangle() -> Seen:
    """The determinant is positive counterclockwise, negative clockwise, and 0 in line."""
    p, q, r = (0, 0), (4, 0), (0, 2)
    found = (determinant(p, q, r), determinant(p, r, q), determinant(p, q, (2, 0)), determinant(p, p, q))
    return seen(found == (8, -8, 0, 0), f"twice the area: {', '.join(map(str, found))}")


def determinant(p: Flat, q: Flat, r: Flat) -> int:
    """That of the rows x, y, 1 of three points."""
    return p[0] * (q[1] - r[1]) - p[1] * (q[0] - r[0]) + (q[0] * r[1] - q[1] * r[0])


def inside_a_triangle() -> Seen:
    """Grid points and a triangle: inside where the three senses are those of the corners."""
    p, q, r = (0, 0), (5, 1), (1, 4)
    good = []
    for point in product((-1, 1, 2, 4), repeat=2):
        x, y = point[0], point[1]
        senses = {_area(a, b, (x, y)) > 0 and _area(a, b, (x, y)) != 0 for a, b in ((p, q), (q, r), (r, p))}
        hull = exact_hull([(*t, 0) for t in (p, q, r, (x, y))])
        good.append((senses == {True}) == (3 in hull.inside))
    return seen(all(good), f"{len(good)} points")


def star_by_the_letter() -> Seen:
    """A cube's edges by Fig. 12 as it is captioned."""
    cube = points_of("cube.csv")
    edges = appel_will(cube, method=Method(star=as_printed)).edges
    return Seen(
        FAILS if len(edges) > 12 else HOLDS, f"{len(edges)} edges of a cube, which has {len(exact_hull(cube).edges())}"
    )


def step_by_the_letter(step: str) -> Seen:
    """A step of the appendix as printed, on its counterexample."""
    name = {"step5": "fig14.csv", "step7": "octahedron.csv", "step9": "pentagon.csv", "step10": "fig14.csv"}[step]
    points = points_of(name)
    also = ("step3",) if step == "step9" else ()
    letter, corrected = appel_will(points, method=printed(step, *also)), appel_will(points, method=printed(*also))
    same = [loop.entries for loop in letter.table.loops] == [loop.entries for loop in corrected.table.loops]
    words = letter.fault or ("the same loops" if same else "the loops come in another order than the printed ones")
    return Seen(FAILS if letter.fault or not same else HOLDS, words)


def planar_graph() -> Seen:
    """The faces put the graph on a surface without crossings: each edge once in each sense, one ring of faces around
    each vertex; connected and with V - E + F = 2 that surface is a sphere."""
    good = []
    for _, hull in _hulls():
        rings = [f.polygon for f in hull.facets]
        sides = Counter(side for ring in rings for side in zip(ring, (*ring[1:], ring[0]), strict=True))
        good.append(set(sides.values()) == {1} and {*sides} == {(b, a) for a, b in sides})
        for vertex in hull.vertices:
            after = {
                ring[k - 1]: ring[(k + 1) % len(ring)] for ring in rings for k, v in enumerate(ring) if v == vertex
            }
            first = at = next(iter(after))
            turns = [at := after[at] for _ in after]
            good.append(turns[-1] == first and len({*turns}) == len(after))
        reached, waiting = {hull.vertices[0]}, [hull.vertices[0]]
        while waiting:
            here = waiting.pop()
            new = {b for a, b in sides if a == here} - reached
            reached |= new
            waiting += new
        good.append(reached == {*hull.vertices})
        good.append(len(hull.vertices) - len(hull.edges()) + len(hull.facets) == 2)
    return seen(all(good), f"{len(good)} conditions of faces, vertices and hulls")

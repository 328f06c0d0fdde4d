"""The proof that a result is the convex hull of points: simple checks that trust nothing of its construction.

``certify`` checks, from the points and the result alone and in exact arithmetic:

1. the integers are the points times the least common scale; every index has exactly one class; every duplicate
   names the first equal point; the dimension is the rank of the points;
2. every facet's plane is in lowest terms, occurs once and holds the facet's own vertices; no point is outside of
   any plane; the vertices a plane touches are exactly those of its facet; a point that is no vertex touches a plane
   if and only if it is called boundary;
3. every vertex is on planes enough to have no freedom: on three with independent normals in space, on two in a
   plane; so no two other points have it between them;
4. the facets close. In space: every polygon turns left at every vertex, seen from outside, and goes around once;
   every directed edge occurs once and its reverse once; V - E + F = 2. In a plane: the edges are the cycle of
   the polygon, which is such a polygon too. On a line: two ends at right angles to it.

Why this proves it.  By 2 the hull of the points is within all planes, and each listed plane supports it.  Say two
facets meet in an edge and a point of the first's plane lay beyond that edge: it would be outside of the second's
plane, which has the first polygon's other vertices strictly inside.  So by 2 and 4 every listed polygon is the whole
face of the hull in its plane.  Then the listed faces are whole facets, and beyond each edge of each lies a listed
one; as the facets of a polytope are connected through their edges, all are listed.  The classes follow from 2 and 3.
Euler's relation is not needed for this, and checked as a count.

Every point against every plane is too much for many points and facets.  From MANY of these pairs on a polyhedron is
proved to be convex by its edges, and every point is put into the plane of one facet: the same facts, by other means
(:mod:`modern.exact_hull.convexity`).

The proof shares nothing with the construction: it has its own vectors, float64 images and bounds.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from itertools import chain

from modern.exact_hull.convexity import Undecided, prove
from modern.exact_hull.coordinates import IntPoint, Points, read_points
from modern.exact_hull.incidences import Incidences, incidences
from modern.exact_hull.polygons import check_convex, difference, dot, product
from modern.exact_hull.result import Certificate, CertificateError, ExactHull, require

MANY = 1 << 18
"""Points times facets from which on a polyhedron is proved by its convexity."""


def _is_plane(plane: Sequence[int]) -> bool:
    """Four Python integers: numpy's would overflow without a word."""
    return len(plane) == 4 and all(type(number) is int for number in plane)


def rank(vectors: Iterable[Sequence[int]]) -> int:
    """The rank of vectors of three integers, by elimination without fractions; stops at 3."""
    rows: list[tuple[int, list[int]]] = []
    for vector in vectors:
        rest = list(vector)
        for pivot, row in rows:
            if rest[pivot]:
                factor, divisor = rest[pivot], row[pivot]
                rest = [divisor * number - factor * other for number, other in zip(rest, row, strict=True)]
        for axis in range(3):
            if rest[axis]:
                common = math.gcd(*rest)
                rows.append((axis, [number // common for number in rest]))
                break
        if len(rows) == 3:
            break
    return len(rows)


def _are_integers(rows: Iterable[Iterable[object]]) -> bool:
    """Whether all members are Python integers; in one pass, since most points are."""
    return set(map(type, chain.from_iterable(rows))) == {int}


def _check_integers(points: Points, hull: ExactHull) -> None:
    """The scale and the scaled integers."""
    given = read_points(points)
    scale, scaled = hull.scale, hull.scaled
    if scale == 1 and set(map(len, scaled)) == {3} and _are_integers(scaled) and given == list(map(tuple, scaled)):
        return  # then the given ones are integers too, and 1 the least scale
    least = math.lcm(*{number.denominator for point in given for number in point})
    require(scale == least, "the scale is not the least that makes every coordinate an integer")
    require(len(scaled) == len(given), f"{len(scaled)} scaled points for {len(given)} points")
    for index, (point, integers) in enumerate(zip(given, scaled, strict=True)):
        require(
            len(integers) == 3
            and all(
                type(number) is int and number * value.denominator == value.numerator * scale
                for number, value in zip(integers, point, strict=True)
            ),
            f"point {index}: its scaled coordinates are not the given ones times the scale",
        )


def _check_classes(hull: ExactHull) -> None:
    """Every index once, sorted; duplicates name the first."""
    require(all(len(pair) == 2 for pair in hull.duplicates), "a duplicate is not a pair of indices")
    for name in ("vertices", "boundary", "inside", "duplicates"):
        members = getattr(hull, name)
        require(list(members) == sorted(members), f"{name} is not sorted")
    members = [*hull.vertices, *hull.boundary, *hull.inside, *(index for index, _ in hull.duplicates)]
    require(
        sorted(members) == list(range(len(hull.scaled))),
        "a point is in no class, in two, or is no point at all",
    )
    if not hull.duplicates and len(set(hull.scaled)) == len(hull.scaled):
        return
    first: dict[IntPoint, int] = {}
    stated = dict(hull.duplicates)
    for index, point in enumerate(hull.scaled):
        earlier = first.setdefault(point, index)
        require(
            stated.get(index, index) == earlier,
            f"point {index} is stated to be point {stated.get(index, index)}, its first occurrence is {earlier}",
        )


def _check_dimension(hull: ExactHull) -> None:
    origin = hull.scaled[0]
    found = rank(difference(point, origin) for point in hull.scaled)
    require(hull.dimension == found, f"the dimension is stated as {hull.dimension}, the points have rank {found}")
    require((hull.plane is not None) == (found == 2), "a plane is stated if and only if the dimension is 2")
    require(bool(hull.polygon) == (found == 2), "a polygon is stated if and only if the dimension is 2")


def _check_planes(hull: ExactHull) -> None:
    """Each plane by itself and with its own facet."""
    vertices = set(hull.vertices)
    planes = [facet.plane for facet in hull.facets]
    require(bool(planes), "there are no facets")
    require(all(_is_plane(plane) for plane in planes), "a facet's plane is not four integers")
    require(planes == sorted(set(planes)), "the facets are not sorted by plane, or a plane occurs twice")
    for number, facet in enumerate(hull.facets):
        a, b, c, d = facet.plane
        require(any((a, b, c)), f"facet {number}: the normal is 0")
        require(math.gcd(a, b, c, d) == 1, f"facet {number}: the plane is not in lowest terms")
        polygon = facet.polygon
        require(len(set(polygon)) == len(polygon), f"facet {number}: a vertex occurs twice")
        require(vertices.issuperset(polygon), f"facet {number}: a point of the polygon is no vertex")
        require(bool(polygon) and polygon[0] == min(polygon), f"facet {number}: the smallest vertex is not first")
        for index in polygon:
            x, y, z = hull.scaled[index]
            require(a * x + b * y + c * z + d == 0, f"facet {number}: vertex {index} is not in its plane")


def _check_points(hull: ExactHull) -> Incidences:
    """All points against all planes; and every vertex held fast by its planes."""
    unique = [*hull.vertices, *hull.boundary, *hull.inside]
    found = incidences([facet.plane for facet in hull.facets], [hull.scaled[index] for index in unique])
    if found.outside is not None:
        facet, place = found.outside
        raise CertificateError(f"point {unique[place]} is outside of facet {facet}")
    corners: list[set[int]] = [set() for _ in hull.facets]
    normals: dict[int, list[IntPoint]] = {index: [] for index in hull.vertices}
    touching = set()
    for facet, place in found.touching:
        index = unique[place]
        if place < len(hull.vertices):
            corners[facet].add(index)
            normals[index].append(hull.facets[facet].plane[:3])
        else:
            touching.add(index)
    for number, (facet_corners, stated) in enumerate(zip(corners, hull.facets, strict=True)):
        require(facet_corners == set(stated.polygon), f"facet {number}: its plane holds other vertices than it names")
    for index in sorted(touching.symmetric_difference(hull.boundary)):
        where = "on" if index in touching else "not on"
        raise CertificateError(f"point {index} is {where} a facet, its class says otherwise")
    for index, around in normals.items():
        require(rank(around) == hull.dimension, f"point {index} is called a vertex; its planes do not hold it fast")
    return found


def _check_polyhedron(hull: ExactHull) -> int:
    """The facets as a closed surface; the number of edges."""
    edges: set[tuple[int, int]] = set()
    count = 0
    for number, facet in enumerate(hull.facets):
        check_convex(facet.polygon, facet.plane[:3], hull.scaled, f"facet {number}")
        edges.update(zip(facet.polygon, (*facet.polygon[1:], facet.polygon[0]), strict=True))
        count += len(facet.polygon)
    require(count > 0 and len(edges) == count, "an edge occurs twice in the same sense, or there are no edges")
    for start, end in edges:
        require((end, start) in edges, f"the edge {start}-{end} has a facet on one side only")
    shape = f"{len(hull.vertices)} vertices, {count // 2} edges, {len(hull.facets)} facets"
    require(len(hull.vertices) - count // 2 + len(hull.facets) == 2, f"not Euler's relation: {shape}")
    return count // 2


def _check_polygon(hull: ExactHull) -> int:
    """The plane of all points, and the edges as the polygon's cycle; the number of edges."""
    assert hull.plane is not None  # by _check_dimension
    require(_is_plane(hull.plane), "the polygon's plane is not four integers")
    a, b, c, d = hull.plane
    normal = (a, b, c)
    require(next((number for number in normal if number), 0) > 0, "the polygon's plane has not the stated sense")
    require(math.gcd(a, b, c, d) == 1, "the polygon's plane is not in lowest terms")
    for index, (x, y, z) in enumerate(hull.scaled):
        require(a * x + b * y + c * z + d == 0, f"point {index} is not in the polygon's plane")
    cycle = hull.polygon
    require(
        sorted(cycle) == list(hull.vertices) and cycle[0] == min(cycle), "the polygon is not an order of the vertices"
    )
    check_convex(cycle, normal, hull.scaled, "the polygon")
    pairs = [(min(p, q), max(p, q)) for p, q in zip(cycle, (*cycle[1:], cycle[0]), strict=True)]
    require(sorted(facet.polygon for facet in hull.facets) == sorted(pairs), "the facets are not the polygon's edges")
    for number, facet in enumerate(hull.facets):
        require(dot(facet.plane[:3], normal) == 0, f"facet {number} is not at right angles to the polygon's plane")
    return len(pairs)


def _check_segment(hull: ExactHull) -> int:
    """Two ends, each with a plane at right angles to the line of all points; the number of edges."""
    require(len(hull.facets) == 2, f"a segment with {len(hull.facets)} ends")
    for number, end in enumerate(hull.facets):
        for index, point in enumerate(hull.scaled):
            along = difference(point, hull.scaled[0])
            require(
                not any(product(along, end.plane[:3])),
                f"facet {number} is not at right angles to the line through point {index}",
            )
    return 1


def _proved(hull: ExactHull) -> tuple[int, Incidences]:
    """The facets and classes of a hull that is no point; the number of edges, and what was counted."""
    if hull.dimension == 3 and len(hull.scaled) * len(hull.facets) >= MANY:
        with suppress(Undecided):
            return prove(hull)
    _check_planes(hull)
    found = _check_points(hull)
    close: Callable[[ExactHull], int] = (_check_segment, _check_polygon, _check_polyhedron)[hull.dimension - 1]
    return close(hull), found


def certify(points: Points, hull: ExactHull) -> Certificate:
    """Prove that ``hull`` is the convex hull of ``points``, or raise CertificateError.

    points: as for ``exact_hull``, and not a one-pass iterator.  What ``hull.certificate`` says is not looked at.
    Raises PointsError if the points cannot be read.
    """
    _check_integers(points, hull)
    _check_classes(hull)
    _check_dimension(hull)
    if hull.dimension == 0:
        require(not hull.facets and len(hull.vertices) == 1, "a point has one vertex and no facets")
        return Certificate(0, len(hull.scaled), 1, 0, 0, "none", 0, 0)
    edges, found = _proved(hull)
    return Certificate(
        hull.dimension,
        len(hull.scaled),
        len(hull.vertices),
        edges,
        len(hull.facets),
        found.arithmetic,
        found.evaluations,
        found.in_integers,
    )

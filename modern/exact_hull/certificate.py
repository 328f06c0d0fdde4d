"""Prove that a given result is the convex hull of points, by simple checks that do not depend on its construction.

``certify`` checks the following in exact arithmetic, from the points and the result alone:

1. The integers are the points times the least common scale.  Each index has exactly one class.  Every duplicate
   is paired with the first point equal to it.  The dimension is the rank of the points.
2. Every facet's plane is in lowest terms, occurs once and contains the vertices of the facet.  No point is outside any
   plane.  The vertices in a plane are exactly those of its facet.  A point that is not a vertex lies in some plane if
   and only if its class is boundary.
3. Each vertex lies in enough facet planes to be their only common point.  In space, three of these planes have
   independent normals.  If all points lie in one plane, each vertex lies in two facet planes.  Therefore a vertex does
   not lie between two other points.
4. The facets form a closed surface.  In space, every polygon turns left at every vertex, seen from outside, and goes
   around once.  Every directed edge of the polygons occurs once, and its reverse also occurs once.  The numbers of
   vertices, edges and facets satisfy V - E + F = 2.  In a plane, the edges are those of the polygon, which satisfies
   the same conditions.  On a line, the facets are the two ends, with planes at right angles to the line.

Evaluating every plane at every point takes too long for many points and facets.  If there are at least MANY pairs of a
plane and a point, the convexity of a polyhedron is proved from its edges, and each point is evaluated in the plane of
only one facet.  This establishes the same facts by other means (:mod:`modern.exact_hull.convexity`).

The proof shares with the construction only the reading of the points and the filter for signs (``planes``), whose bound
is proved there.  It computes its own planes and vectors.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import replace

import numpy as np

from modern.exact_hull.convexity import Undecided, prove
from modern.exact_hull.coordinates import Coordinates, IntPoint, read_points
from modern.exact_hull.planes import Planes, facet_planes
from modern.exact_hull.polygons import check_convex, difference, dot, product
from modern.exact_hull.result import Certificate, CertificateError, ExactHull, Facets, facets_as_arrays, require
from modern.geometry.points import Points

# Why this is a proof.  By 2 the hull of the points is inside all planes, and each listed plane supports it.  Suppose
# that two facets meet in an edge and that a point in the plane of the first one lay beyond that edge.  The point would
# be outside the plane of the second facet, because the other vertices of the first polygon are strictly inside it.
# Therefore, by 2 and 4, every listed polygon is the whole face of the hull in its plane.  Thus the listed faces are
# whole facets, and beyond each edge of a listed facet there is another listed one.  Since the facets of a polytope are
# connected through their edges, all facets are listed.  The classes follow from 2 and 3.  Euler's relation is not
# needed; it is an additional check of the counts.
# The number of points times facets from which a polyhedron is proved by its convexity.
MANY = 1 << 18
_FEW, _FILTERED = 64, "float64 and integers"


def _is_plane(plane: Sequence[int]) -> bool:
    """Return True for four Python integers.  numpy's integers are rejected, because they overflow silently."""
    return len(plane) == 4 and all(type(number) is int for number in plane)


def rank(vectors: Iterable[Sequence[int]]) -> int:
    """Return the rank of a set of vectors with three integer components."""
    rest = iter(vectors)
    first = next(filter(any, rest), None)
    if first is None:
        return 0
    # The vectors skipped are multiples of the first one.
    normal = next(filter(any, (product(first, vector) for vector in rest)), None)
    if normal is None:
        return 1
    return 3 if any(dot(normal, vector) for vector in rest) else 2


def _check_integers(points: Coordinates, hull: ExactHull) -> None:
    least = hull.scale == points.scale and points.is_least_scale()
    require(least, "the scale is not the least number that makes every coordinate an integer")
    require(len(hull.scaled) == len(points), f"expected {len(points)} scaled points, found {len(hull.scaled)}")
    if isinstance(hull.scaled, Coordinates) and hull.scaled == points:
        return
    for index, (point, integers) in enumerate(zip(points, hull.scaled, strict=True)):
        require(
            tuple(integers) == point and set(map(type, integers)) == {int},
            f"point {index}: its scaled coordinates are not the coordinates of the input times the scale",
        )


def _check_classes(points: Coordinates, hull: ExactHull) -> None:
    require(all(len(pair) == 2 for pair in hull.duplicates), "a duplicate is not a pair of indices")
    for name in ("vertices", "boundary", "inside", "duplicates"):
        members = getattr(hull, name)
        require(list(members) == sorted(members), "the list {} is not sorted", name)
    members = [*hull.vertices, *hull.boundary, *hull.inside, *(index for index, _ in hull.duplicates)]
    complete = len(members) == len(points) and set(map(type, members)) == {int} and min(members) >= 0
    complete = complete and max(members) < len(points) and bool(np.bincount(members, minlength=len(points)).all())
    lists = "vertices, boundary points, inside points and duplicates"
    require(complete, "a point is in none or in several of the lists of {}, or an index is invalid", lists)
    # A point must be listed as a duplicate of the first point with its coordinates, unless it is that first point.
    stated, true = dict(hull.duplicates), dict(points.duplicates)
    for index in sorted(stated.keys() | true.keys()):
        earlier, first = stated.get(index, index), true.get(index, index)
        require(
            earlier == first,
            f"point {index} is stated to equal point {earlier}, but first occurs as point {first}",
        )


def _check_dimension(hull: ExactHull) -> None:
    # The first points usually suffice; the others are made integers only if these lie in a plane.
    origin = hull.scaled[0]
    dimension = rank(difference(point, origin) for point in hull.scaled[:_FEW])
    if dimension < 3:
        dimension = rank(difference(point, origin) for point in hull.scaled)
    require(
        hull.dimension == dimension,
        f"the dimension is stated as {hull.dimension}, but that of the points is {dimension}",
    )
    require((hull.plane is not None) == (dimension == 2), "a plane must be stated for dimension 2, and only then")
    require(bool(hull.polygon) == (dimension == 2), "a polygon must be stated for dimension 2, and only then")


def _check_planes(hull: ExactHull) -> None:
    vertices = set(hull.vertices)
    planes = [facet.plane for facet in hull.facets]
    require(bool(planes), "there are no facets")
    require(all(_is_plane(plane) for plane in planes), "a facet's plane is not four integers")
    require(planes == sorted(set(planes)), "the facets are not sorted by plane, or a plane occurs twice")
    for number, facet in enumerate(hull.facets):
        a, b, c, d = facet.plane
        require(any((a, b, c)), "facet {}: the normal is 0", number)
        require(math.gcd(a, b, c, d) == 1, "facet {}: the plane is not in lowest terms", number)
        polygon = facet.polygon
        require(len(set(polygon)) == len(polygon), "facet {}: a vertex occurs twice", number)
        require(vertices.issuperset(polygon), "facet {}: a point of the polygon is not a vertex", number)
        require(
            bool(polygon) and polygon[0] == min(polygon),
            "facet {}: the vertex with the smallest index is not the first of its polygon",
            number,
        )
        for index in polygon:
            x, y, z = hull.scaled[index]
            if a * x + b * y + c * z + d:
                raise CertificateError(f"facet {number}: vertex {index} is not in its plane")


def _check_points(hull: ExactHull) -> Planes:
    """Check conditions 2 and 3 of the module's docstring by evaluating every plane at every point."""
    unique = [*hull.vertices, *hull.boundary, *hull.inside]
    corners: list[set[int]] = [set() for _ in hull.facets]
    normals: dict[int, list[IntPoint]] = {index: [] for index in hull.vertices}
    on_facets = set()
    planes = facet_planes(read_points(hull.scaled), hull.facets)
    for block in planes.near(np.array(unique)):
        for row, facet, sign in zip(*(column.tolist() for column in block), strict=True):
            if sign > 0:
                raise CertificateError(f"point {unique[row]} is outside of facet {facet}")
            if sign == 0 and row < len(hull.vertices):  # the vertices come first in ``unique``
                corners[facet].add(unique[row])
                normals[unique[row]].append(hull.facets[facet].plane[:3])
            elif sign == 0:
                on_facets.add(unique[row])
    for number, (facet_corners, stated) in enumerate(zip(corners, hull.facets, strict=True)):
        require(
            facet_corners == set(stated.polygon), "facet {}: its plane contains other vertices than its polygon", number
        )
    for index in sorted(on_facets.symmetric_difference(hull.boundary)):
        where = "on" if index in on_facets else "not on"
        raise CertificateError(f"point {index} is {where} a facet, but the hull states the opposite")
    for index, around in normals.items():
        require(
            rank(around) == hull.dimension,
            "point {} is called a vertex, but the planes through it meet in more than one point",
            index,
        )
    return planes


def _check_polyhedron(hull: ExactHull) -> int:
    """Check that the facets form a closed surface, and return the number of edges."""
    # A closed surface traverses every edge exactly once in each direction.
    edges: set[tuple[int, int]] = set()
    count = 0
    for number, facet in enumerate(hull.facets):
        check_convex(facet.polygon, facet.plane[:3], hull.scaled, f"facet {number}")
        edges.update(zip(facet.polygon, (*facet.polygon[1:], facet.polygon[0]), strict=True))
        count += len(facet.polygon)
    require(count > 0 and len(edges) == count, "an edge occurs twice in the same direction, or there are no edges")
    for start, end in edges:
        if (end, start) not in edges:
            raise CertificateError(f"the edge {start}-{end} belongs to only one facet")
    shape = f"{len(hull.vertices)} vertices, {count // 2} edges, {len(hull.facets)} facets"
    require(len(hull.vertices) - count // 2 + len(hull.facets) == 2, f"Euler's relation does not hold: {shape}")
    return count // 2


def _check_polygon(hull: ExactHull) -> int:
    assert hull.plane is not None  # checked by _check_dimension
    require(_is_plane(hull.plane), "the polygon's plane is not four integers")
    a, b, c, d = hull.plane
    normal = (a, b, c)
    require(
        next((number for number in normal if number), 0) > 0,
        "the first nonzero coefficient of the polygon's plane is not positive",
    )
    require(math.gcd(a, b, c, d) == 1, "the polygon's plane is not in lowest terms")
    for index, (x, y, z) in enumerate(hull.scaled):
        if a * x + b * y + c * z + d:
            raise CertificateError(f"point {index} is not in the polygon's plane")
    cycle = hull.polygon
    require(
        sorted(cycle) == list(hull.vertices) and cycle[0] == min(cycle),
        "the polygon does not name every vertex once, beginning with the smallest index",
    )
    check_convex(cycle, normal, hull.scaled, "the polygon")
    # The facets of a polygon are its edges, with planes at right angles to its own.
    pairs = [(min(p, q), max(p, q)) for p, q in zip(cycle, (*cycle[1:], cycle[0]), strict=True)]
    require(sorted(facet.polygon for facet in hull.facets) == sorted(pairs), "the facets are not the polygon's edges")
    for number, facet in enumerate(hull.facets):
        require(dot(facet.plane[:3], normal) == 0, "facet {} is not at right angles to the polygon's plane", number)
    return len(pairs)


def _check_segment(hull: ExactHull) -> int:
    """Check that both end planes are at right angles to the line of all points, and return the number of edges."""
    require(len(hull.facets) == 2, f"the segment has {len(hull.facets)} ends")
    for number, end in enumerate(hull.facets):
        for index, point in enumerate(hull.scaled):
            along = difference(point, hull.scaled[0])
            require(
                not any(product(along, end.plane[:3])),
                "facet {} is not at right angles to the line through point {}",
                number,
                index,
            )
    return 1


def _proved(hull: ExactHull) -> tuple[int, Planes, str]:
    """Check a hull of dimension 1 to 3.  Return the number of edges, the planes, and the kind of arithmetic used."""
    # For many points and facets, prove convexity from the edges, unless the surface is too thin for float64.
    if hull.dimension == 3 and len(hull.scaled) * len(hull.facets) >= MANY:
        with suppress(Undecided):  # in that case every plane is evaluated at every point, below
            return *prove(hull), _FILTERED
    if isinstance(hull.facets, Facets):
        hull = replace(hull, facets=facets_as_arrays(hull.facets).all())
    if hull.dimension < 3 or len(hull.scaled) < _FEW**2:
        read_points(hull.scaled).all()  # many accesses to few points are faster if all points are made at once
    _check_planes(hull)
    planes = _check_points(hull)
    close: Callable[[ExactHull], int] = (_check_segment, _check_polygon, _check_polyhedron)[hull.dimension - 1]
    return close(hull), planes, _FILTERED if planes.whole is None else "int64"


def certify(points: Points, hull: ExactHull) -> Certificate:
    """Prove that ``hull`` is the convex hull of ``points``, or raise CertificateError."""
    own = read_points(points)
    _check_integers(own, hull)
    _check_classes(own, hull)
    hull = replace(hull, scaled=own)
    _check_dimension(hull)
    if hull.dimension == 0:
        require(not hull.facets and len(hull.vertices) == 1, "a point has one vertex and no facets")
        return Certificate(0, len(hull.scaled), 1, 0, 0, "none", 0, 0)
    edges, planes, arithmetic = _proved(hull)
    return Certificate(
        hull.dimension,
        len(hull.scaled),
        len(hull.vertices),
        edges,
        len(hull.facets),
        arithmetic,
        planes.evaluations,
        planes.in_integers,
    )

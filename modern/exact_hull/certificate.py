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

This module shares nothing with the construction: it has its own vectors, and for every point against every plane it
moves the points, makes its own float64 images and has its own bound.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from modern.exact_hull.coordinates import IntPoint, Points, read_points
from modern.exact_hull.result import Certificate, ExactHull, Plane

# Values at a time: they stay in the cache, and the product of matrices is too small for numpy's library to split
# among threads, which costs more than it gains when other programs run.
_BLOCK = 1 << 16
BOUND = 2.0**-47


class CertificateError(Exception):
    """The result is not proved to be the hull of the points; the message says which check failed, and where."""


def _require(condition: bool, message: str) -> None:
    if not condition:
        raise CertificateError(message)


def _difference(p: Sequence[int], q: Sequence[int]) -> IntPoint:
    return p[0] - q[0], p[1] - q[1], p[2] - q[2]


def _product(u: Sequence[int], v: Sequence[int]) -> IntPoint:
    return u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]


def _dot(u: Sequence[int], v: Sequence[int]) -> int:
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


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


def _check_integers(points: Points, hull: ExactHull) -> None:
    """The scale and the scaled integers."""
    given = read_points(points)
    scale, scaled = hull.scale, hull.scaled
    least = math.lcm(*{number.denominator for point in given for number in point})
    _require(scale == least, "the scale is not the least that makes every coordinate an integer")
    _require(len(scaled) == len(given), f"{len(scaled)} scaled points for {len(given)} points")
    for index, (point, integers) in enumerate(zip(given, scaled, strict=True)):
        _require(
            len(integers) == 3
            and all(
                type(number) is int and number * value.denominator == value.numerator * scale
                for number, value in zip(integers, point, strict=True)
            ),
            f"point {index}: its scaled coordinates are not the given ones times the scale",
        )


def _check_classes(hull: ExactHull) -> None:
    """Every index once, sorted; duplicates name the first."""
    _require(all(len(pair) == 2 for pair in hull.duplicates), "a duplicate is not a pair of indices")
    for name in ("vertices", "boundary", "inside", "duplicates"):
        members = getattr(hull, name)
        _require(list(members) == sorted(members), f"{name} is not sorted")
    members = [*hull.vertices, *hull.boundary, *hull.inside, *(index for index, _ in hull.duplicates)]
    _require(
        sorted(members) == list(range(len(hull.scaled))),
        "a point is in no class, in two, or is no point at all",
    )
    first: dict[IntPoint, int] = {}
    stated = dict(hull.duplicates)
    for index, point in enumerate(hull.scaled):
        earlier = first.setdefault(point, index)
        _require(
            stated.get(index, index) == earlier,
            f"point {index} is stated to be point {stated.get(index, index)}, its first occurrence is {earlier}",
        )


def _check_dimension(hull: ExactHull) -> None:
    origin = hull.scaled[0]
    found = rank(_difference(point, origin) for point in hull.scaled)
    _require(hull.dimension == found, f"the dimension is stated as {hull.dimension}, the points have rank {found}")
    _require((hull.plane is not None) == (found == 2), "a plane is stated if and only if the dimension is 2")
    _require(bool(hull.polygon) == (found == 2), "a polygon is stated if and only if the dimension is 2")


def _check_planes(hull: ExactHull) -> None:
    """Each plane by itself and with its own facet."""
    vertices = set(hull.vertices)
    planes = [facet.plane for facet in hull.facets]
    _require(bool(planes), "there are no facets")
    _require(all(_is_plane(plane) for plane in planes), "a facet's plane is not four integers")
    _require(planes == sorted(set(planes)), "the facets are not sorted by plane, or a plane occurs twice")
    for number, facet in enumerate(hull.facets):
        a, b, c, d = facet.plane
        _require(any((a, b, c)), f"facet {number}: the normal is 0")
        _require(math.gcd(a, b, c, d) == 1, f"facet {number}: the plane is not in lowest terms")
        polygon = facet.polygon
        _require(len(set(polygon)) == len(polygon), f"facet {number}: a vertex occurs twice")
        _require(vertices.issuperset(polygon), f"facet {number}: a point of the polygon is no vertex")
        _require(bool(polygon) and polygon[0] == min(polygon), f"facet {number}: the smallest vertex is not first")
        for index in polygon:
            x, y, z = hull.scaled[index]
            _require(a * x + b * y + c * z + d == 0, f"facet {number}: vertex {index} is not in its plane")


@dataclass(frozen=True, slots=True)
class Incidences:
    """The pairs (plane, point) with the value 0, and the pair of a point outside a plane, if there is one."""

    touching: list[tuple[int, int]]
    outside: tuple[int, int] | None
    arithmetic: str
    evaluations: int
    in_integers: int


def _in_int64(planes: Sequence[Plane], points: Sequence[IntPoint]) -> Incidences:
    normals = np.array(planes, dtype=np.int64)
    columns = np.array(points, dtype=np.int64).T
    step = max(1, _BLOCK // len(points))
    touching: list[tuple[int, int]] = []
    for start in range(0, len(planes), step):
        block = normals[start : start + step]
        values = block[:, :1] * columns[0] + block[:, 1:2] * columns[1] + block[:, 2:3] * columns[2] + block[:, 3:]
        if (values > 0).any():
            row, column = np.argwhere(values > 0)[0].tolist()
            return Incidences(touching, (start + row, column), "int64", (start + step) * len(points), 0)
        rows, matches = np.nonzero(values == 0)
        touching += zip((rows + start).tolist(), matches.tolist(), strict=True)
    return Incidences(touching, None, "int64", len(planes) * len(points), 0)


def _images(planes: Sequence[Plane], points: Sequence[IntPoint]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Planes (m, 4) and points (4, n) as float64, of size at most 1 except D.

    With the corner c of the points' box and the box's side s: u = (x - c) / s, normal / w, D / (s w), where w is the
    largest of |A|, |B|, |C|, and D is the value at c.
    """
    corner = [min(column) for column in zip(*points, strict=True)]
    side = max(max(column) - low for column, low in zip(zip(*points, strict=True), corner, strict=True))
    place = np.ones((4, len(points)))
    for axis in range(3):
        place[axis] = [(point[axis] - corner[axis]) / side for point in points]
    image = np.empty((len(planes), 4))
    for row, (a, b, c, d) in enumerate(planes):
        width = max(abs(a), abs(b), abs(c))
        at_corner = a * corner[0] + b * corner[1] + c * corner[2] + d
        image[row] = (a / width, b / width, c / width, at_corner / (side * width))
    return image, place


def _in_floats(planes: Sequence[Plane], points: Sequence[IntPoint]) -> Incidences:
    """float64 first, integers where it cannot say.

    Every plane holds a point of the box, so |D| / (s w) <= 3.  With e = 2**-54 the quotients are off by at most e,
    D's by 4e; a product by 3e once rounded, three by 9e; three additions of partial sums below 8 by 24e.  Together
    37e, less than a quarter of the bound 2**-47 = 128e.
    """
    image, place = _images(planes, points)
    step = max(1, _BLOCK // len(points))
    touching: list[tuple[int, int]] = []
    in_integers = 0
    for start in range(0, len(planes), step):
        values = image[start : start + step] @ place
        rows, columns = np.nonzero(values > -BOUND)
        in_integers += len(rows)
        for row, column in zip((rows + start).tolist(), columns.tolist(), strict=True):
            a, b, c, d = planes[row]
            x, y, z = points[column]
            exact = a * x + b * y + c * z + d
            if exact > 0:
                return Incidences(touching, (row, column), "float64 and integers", start * len(points), in_integers)
            if exact == 0:
                touching.append((row, column))
    return Incidences(touching, None, "float64 and integers", len(planes) * len(points), in_integers)


def incidences(planes: Sequence[Plane], points: Sequence[IntPoint]) -> Incidences:
    """Every point against every plane, exactly; stops at the first point outside.

    Every plane has a normal other than 0 and holds one of the points (for the bound on D), and there are at least
    two distinct points.
    """
    reach = [max(1, *(abs(number) for number in column)) for column in zip(*points, strict=True)]
    sizes = [max(1, *(abs(number) for number in column)) for column in zip(*planes, strict=True)]
    if sum(size * most for size, most in zip(sizes, [*reach, 1], strict=True)) < 2**62:
        return _in_int64(planes, points)
    return _in_floats(planes, points)


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
        _require(facet_corners == set(stated.polygon), f"facet {number}: its plane holds other vertices than it names")
    for index in sorted(touching.symmetric_difference(hull.boundary)):
        where = "on" if index in touching else "not on"
        raise CertificateError(f"point {index} is {where} a facet, its class says otherwise")
    for index, around in normals.items():
        _require(rank(around) == hull.dimension, f"point {index} is called a vertex; its planes do not hold it fast")
    return found


def _check_convex(polygon: Sequence[int], normal: IntPoint, scaled: Sequence[IntPoint], name: str) -> None:
    """A polygon turns left everywhere, seen from where ``normal`` points to, and goes around once.

    It goes around as often as the side's direction comes to have a positive coordinate, on an axis that is not the
    normal's: a turn of less than 180 degrees passes over no half of the directions.
    """
    _require(len(polygon) >= 3, f"{name}: fewer than three vertices")
    sides = [
        _difference(scaled[end], scaled[start]) for start, end in zip(polygon, (*polygon[1:], polygon[0]), strict=True)
    ]
    for before, after, index in zip(sides, sides[1:] + sides[:1], (*polygon[1:], polygon[0]), strict=True):
        _require(_dot(_product(before, after), normal) > 0, f"{name}: no left turn at vertex {index}")
    axis = 2 if any(normal[:2]) else 1
    upper = [side[axis] > 0 for side in sides]
    entries = sum(after and not before for before, after in zip(upper, upper[1:] + upper[:1], strict=True))
    _require(entries == 1, f"{name}: the polygon goes around {entries} times")


def _check_polyhedron(hull: ExactHull) -> int:
    """The facets as a closed surface; the number of edges."""
    edges: set[tuple[int, int]] = set()
    count = 0
    for number, facet in enumerate(hull.facets):
        _check_convex(facet.polygon, facet.plane[:3], hull.scaled, f"facet {number}")
        edges.update(zip(facet.polygon, (*facet.polygon[1:], facet.polygon[0]), strict=True))
        count += len(facet.polygon)
    _require(count > 0 and len(edges) == count, "an edge occurs twice in the same sense, or there are no edges")
    for start, end in edges:
        _require((end, start) in edges, f"the edge {start}-{end} has a facet on one side only")
    shape = f"{len(hull.vertices)} vertices, {count // 2} edges, {len(hull.facets)} facets"
    _require(len(hull.vertices) - count // 2 + len(hull.facets) == 2, f"not Euler's relation: {shape}")
    return count // 2


def _check_polygon(hull: ExactHull) -> int:
    """The plane of all points, and the edges as the polygon's cycle; the number of edges."""
    assert hull.plane is not None  # by _check_dimension
    _require(_is_plane(hull.plane), "the polygon's plane is not four integers")
    a, b, c, d = hull.plane
    normal = (a, b, c)
    _require(next((number for number in normal if number), 0) > 0, "the polygon's plane has not the stated sense")
    _require(math.gcd(a, b, c, d) == 1, "the polygon's plane is not in lowest terms")
    for index, (x, y, z) in enumerate(hull.scaled):
        _require(a * x + b * y + c * z + d == 0, f"point {index} is not in the polygon's plane")
    cycle = hull.polygon
    _require(
        sorted(cycle) == list(hull.vertices) and cycle[0] == min(cycle), "the polygon is not an order of the vertices"
    )
    _check_convex(cycle, normal, hull.scaled, "the polygon")
    pairs = [(min(p, q), max(p, q)) for p, q in zip(cycle, (*cycle[1:], cycle[0]), strict=True)]
    _require(sorted(facet.polygon for facet in hull.facets) == sorted(pairs), "the facets are not the polygon's edges")
    for number, facet in enumerate(hull.facets):
        _require(_dot(facet.plane[:3], normal) == 0, f"facet {number} is not at right angles to the polygon's plane")
    return len(pairs)


def _check_segment(hull: ExactHull) -> int:
    """Two ends, each with a plane at right angles to the line of all points; the number of edges."""
    _require(len(hull.facets) == 2, f"a segment with {len(hull.facets)} ends")
    for number, end in enumerate(hull.facets):
        for index, point in enumerate(hull.scaled):
            along = _difference(point, hull.scaled[0])
            _require(
                not any(_product(along, end.plane[:3])),
                f"facet {number} is not at right angles to the line through point {index}",
            )
    return 1


def certify(points: Points, hull: ExactHull) -> Certificate:
    """Prove that ``hull`` is the convex hull of ``points``, or raise CertificateError.

    points: as for ``exact_hull``, and not a one-pass iterator.  What ``hull.certificate`` says is not looked at.
    Raises PointsError if the points cannot be read.
    """
    _check_integers(points, hull)
    _check_classes(hull)
    _check_dimension(hull)
    if hull.dimension == 0:
        _require(not hull.facets and len(hull.vertices) == 1, "a point has one vertex and no facets")
        return Certificate(0, len(hull.scaled), 1, 0, 0, "none", 0, 0)
    _check_planes(hull)
    found = _check_points(hull)
    close: Callable[[ExactHull], int] = (_check_segment, _check_polygon, _check_polyhedron)[hull.dimension - 1]
    edges = close(hull)
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

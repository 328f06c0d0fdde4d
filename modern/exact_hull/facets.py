"""Integer planes and facets for the construction of the exact hull.  The proof does not use these functions.

The triangles of a polyhedron that share a plane become one polygon.  Points on one line or in one plane need no surface
of triangles: their facets, the ends of a segment or the edges of a polygon, are found by sorting the points.
"""

import math
from collections.abc import Iterable, Sequence
from contextlib import suppress
from itertools import chain

import numpy as np

from modern.exact_hull.coordinates import Coordinates, IntPoint, Ints, Objects
from modern.exact_hull.result import Facet, Facets, Plane

Triangle = tuple[int, int, int]


def minus(p: IntPoint, q: IntPoint) -> IntPoint:
    return p[0] - q[0], p[1] - q[1], p[2] - q[2]


def cross(u: IntPoint, v: IntPoint) -> IntPoint:
    return u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]


def value(plane: Plane, p: IntPoint) -> int:
    """Return the value A x + B y + C z + D of a plane at the point p."""
    return plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + plane[3]


def plane_at(normal: IntPoint, p: IntPoint) -> Plane:
    """Return the plane through ``p`` with the given normal.  The numbers of the plane may have a common divisor."""
    return (*normal, -(normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2]))


def plane_through(p: IntPoint, q: IntPoint, r: IntPoint) -> Plane:
    """Return the plane through three points that are counterclockwise seen from its positive side.

    The numbers of the plane may have a common divisor.
    """
    # Written out, because the construction calls it for every triangle.
    x, y, z = p
    u, v, w = q[0] - x, q[1] - y, q[2] - z
    k, l, m = r[0] - x, r[1] - y, r[2] - z  # noqa: E741
    a, b, c = v * m - w * l, w * k - u * m, u * l - v * k
    return a, b, c, -(a * x + b * y + c * z)


def lowest_terms(plane: Plane) -> Plane:
    """Return the plane divided by the greatest common divisor of its numbers.  The normal must not be zero."""
    divisor = math.gcd(*plane)
    a, b, c, d = plane
    return a // divisor, b // divisor, c // divisor, d // divisor


def independent(points: Sequence[IntPoint]) -> tuple[int, ...]:
    """Return the indices of affinely independent points: four if the points span space, fewer if they do not."""
    if len(points) == 1:
        return (0,)
    origin = points[0]
    # The first two points span a line.  Look for a point that is not on it, then for one not in the plane of the three.
    along = minus(points[1], origin)
    for third in range(2, len(points)):
        normal = cross(along, minus(points[third], origin))
        if any(normal):
            break
    else:
        return (0, 1)
    plane = plane_at(normal, origin)
    for fourth in range(third + 1, len(points)):
        if value(plane, points[fourth]):
            return (0, 1, third, fourth)
    return (0, 1, third)


def rotated(polygon: Sequence[int]) -> tuple[int, ...]:
    """Return a cycle, rotated so that its smallest member comes first."""
    start = polygon.index(min(polygon))
    return (*polygon[start:], *polygon[:start])


def corners_only(cycle: Sequence[int], points: Sequence[IntPoint]) -> list[int]:
    """Remove from a convex cycle every point that lies on the line between its neighbours."""
    corners = []
    for before, here, after in zip((cycle[-1], *cycle[:-1]), cycle, (*cycle[1:], cycle[0]), strict=True):
        if any(cross(minus(points[here], points[before]), minus(points[after], points[here]))):
            corners.append(here)
    return corners


def _outline(triangles: Iterable[tuple[int, ...]]) -> list[int]:
    """Return the corners of the polygon that coplanar triangles form, counterclockwise if the triangles are."""
    edges = {edge for a, b, c in triangles for edge in ((a, b), (b, c), (c, a))}
    # An edge inside the polygon occurs in both directions.
    following = {a: b for a, b in edges if (b, a) not in edges}
    # Follow the border from its smallest point; it must return there after all border edges.
    start = here = min(following)
    cycle = []
    while True:
        cycle.append(here)
        here = following[here]
        if here == start or len(cycle) > len(following):
            break
    if len(cycle) != len(following):
        raise RuntimeError("the triangles of one plane do not fill one polygon: the surface was not convex")
    return cycle


def faces(triangles: Iterable[tuple[Triangle, Plane]], points: Sequence[IntPoint]) -> list[Facet]:
    """Return the faces of a convex surface of triangles.  Triangles in one plane become one face."""
    # Triangles with the same plane in lowest terms belong to one face.
    groups: dict[Plane, list[Triangle]] = {}
    for corners, plane in triangles:
        groups.setdefault(lowest_terms(plane), []).append(corners)
    return [Facet(plane, _face(group, points)) for plane, group in groups.items()]


def _face(triangles: Sequence[tuple[int, ...]], points: Sequence[IntPoint]) -> tuple[int, ...]:
    return rotated(triangles[0] if len(triangles) == 1 else corners_only(_outline(triangles), points))


def merged(triangles: Ints, planes: Objects, points: Coordinates) -> tuple[Facets, Ints]:
    """Merge triangles (m, 3) that lie in one plane.  Return the faces, sorted by plane, and each triangle's face.

    ``planes`` (m, 4) are the planes of the triangles in lowest terms.
    """
    # Sorting is faster after the triangles are roughly in order, by the nearest doubles of A.
    order = np.arange(len(triangles))
    with suppress(OverflowError):
        order = np.argsort(planes[:, 0].astype(np.float64))
    rows = list(zip(*planes.T.tolist(), strict=True))
    order = np.array(sorted(order.tolist(), key=rows.__getitem__))
    triangles, planes = triangles[order], planes[order]
    is_first = np.ones(len(order), np.bool_)
    is_first[1:] = (planes[1:] != planes[:-1]).any(axis=1)
    face = np.empty(len(order), np.int64)
    face[order] = np.cumsum(is_first) - 1
    if is_first.all():
        turn = triangles.argmin(axis=1)[:, None]
        corners = triangles[np.arange(len(triangles))[:, None], (turn + np.arange(3)) % 3]
        return Facets(planes, corners.ravel(), np.full(len(planes), 3)), face
    groups = np.split(triangles, np.flatnonzero(is_first)[1:])
    polygons = [_face(group.tolist(), points) for group in groups]
    corners, counts = np.array(list(chain.from_iterable(polygons))), np.array(list(map(len, polygons)))
    return Facets(planes[is_first], corners, counts), face


def planes_of(triangles: Ints, points: Coordinates) -> Objects:
    """Return the planes through triangles (m, 3), in lowest terms.  Raise ValueError if a triangle has no area."""
    distinct, positions = np.unique(triangles, return_inverse=True)
    coordinates = points.integers(distinct)
    moved = coordinates
    if max(np.ptp(coordinates, axis=0).tolist()) < 2**30:  # the numbers of a normal are below 2**62 and fit int64
        moved = (coordinates - coordinates[0]).astype(np.int64)
    p, q, r = (moved[positions.reshape(-1, 3)[:, k]].T for k in range(3))
    (u1, u2, u3), (v1, v2, v3) = q - p, r - p
    normals = [u2 * v3 - u3 * v2, u3 * v1 - u1 * v3, u1 * v2 - u2 * v1]
    divisor = np.gcd.reduce(normals)
    if not divisor.all():
        raise ValueError("a triangle has no area")
    a, b, c = (axis // divisor for axis in normals)
    # D has three factors and needs Python integers.
    x, y, z = coordinates[positions.reshape(-1, 3)[:, 0]].T
    d = -(a.astype(object) * x + b.astype(object) * y + c.astype(object) * z)
    return np.stack([a.astype(object), b.astype(object), c.astype(object), d], axis=1)


def segment(points: Sequence[IntPoint]) -> list[Facet]:
    """Return the two facets of collinear points: each end, with the plane through it at right angles to the line."""
    # The lexicographic order of coordinates is the order of the points along the line.
    indices = range(len(points))
    low, high = min(indices, key=points.__getitem__), max(indices, key=points.__getitem__)
    along = minus(points[high], points[low])
    return [
        Facet(lowest_terms(plane_at(along, points[high])), (high,)),
        Facet(lowest_terms(plane_at((-along[0], -along[1], -along[2]), points[low])), (low,)),
    ]


def positive(plane: Plane) -> Plane:
    """Return the plane in lowest terms, with the sign that makes its first nonzero number among A, B, C positive."""
    a, b, c, d = lowest_terms(plane)
    return (a, b, c, d) if (a, b, c) > (0, 0, 0) else (-a, -b, -c, -d)


def polygon(points: Sequence[IntPoint], three: Sequence[int]) -> tuple[Plane, tuple[int, ...], list[Facet]]:
    """Return the hull of coplanar points: its plane, its vertices in cyclic order, and its edges as facets.

    ``three`` holds the indices of three points that are not collinear.  The algorithm of monotone chains (Andrew,
    Information Processing Letters 9 (1979), 216-219) is applied to two of the coordinates.
    """
    plane = positive(plane_through(points[three[0]], points[three[1]], points[three[2]]))
    normal = plane[:3]
    # Dropping the coordinate with the largest component of the normal keeps distinct points distinct.
    dropped = max(range(3), key=lambda axis: abs(normal[axis]))
    u, v = (dropped + 1) % 3, (dropped + 2) % 3
    if normal[dropped] < 0:
        u, v = v, u

    def left_turn(i: int, j: int, k: int) -> bool:
        p, q, r = points[i], points[j], points[k]
        return (q[u] - p[u]) * (r[v] - p[v]) > (q[v] - p[v]) * (r[u] - p[u])

    def chain(order: Sequence[int]) -> list[int]:
        half: list[int] = []
        for index in order:
            while len(half) >= 2 and not left_turn(half[-2], half[-1], index):
                half.pop()
            half.append(index)
        return half[:-1]

    order = sorted(range(len(points)), key=lambda index: (points[index][u], points[index][v]))
    cycle = rotated(chain(order) + chain(order[::-1]))
    edges = []
    for start, end in zip(cycle, cycle[1:] + cycle[:1], strict=True):
        outward = cross(minus(points[end], points[start]), normal)
        edges.append(Facet(lowest_terms(plane_at(outward, points[start])), (min(start, end), max(start, end))))
    return plane, cycle, edges

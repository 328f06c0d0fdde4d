"""The polygons of a surface as arrays of directed sides, and checks of polygons and planes for the proof."""

import math
import operator
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modern.exact_hull.coordinates import IntPoint, Ints, read_points
from modern.exact_hull.planes import Planes, facet_planes
from modern.exact_hull.result import CertificateError, ExactHull, Facets, require


def difference(p: Sequence[int], q: Sequence[int]) -> IntPoint:
    return p[0] - q[0], p[1] - q[1], p[2] - q[2]


def product(u: Sequence[int], v: Sequence[int]) -> IntPoint:
    return u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]


def dot(u: Sequence[int], v: Sequence[int]) -> int:
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def check_convex(
    polygon: Sequence[int], normal: IntPoint, scaled: Sequence[IntPoint] | dict[int, IntPoint], name: str
) -> None:
    """Check that a polygon, seen from the side of ``normal``, turns left everywhere and goes around once."""
    require(len(polygon) >= 3, "{}: fewer than three vertices", name)
    corners, (a, b, c) = [scaled[index] for index in polygon], normal
    sides = [(u - x, v - y, w - z) for (x, y, z), (u, v, w) in zip(corners, corners[1:] + corners[:1], strict=True)]
    ahead = sides[1:] + sides[:1]
    for (x, y, z), (u, v, w), index in zip(sides, ahead, (*polygon[1:], polygon[0]), strict=True):
        # The triple product of two sides and the normal, written out because the proof computes it at every vertex.
        if a * (y * w - z * v) + b * (z * u - x * w) + c * (x * v - y * u) <= 0:
            raise CertificateError(f"{name}: the polygon does not turn left at vertex {index}")
    # Each turn is less than 180 degrees, so no turn can skip half of the directions.  The polygon therefore goes around
    # as often as the direction of its sides enters the half with a positive coordinate on an axis not along the normal.
    axis = 2 if any(normal[:2]) else 1
    upper = [side[axis] > 0 for side in sides]
    entries = sum(after and not before for before, after in zip(upper, upper[1:] + upper[:1], strict=True))
    require(entries == 1, "{}: the sides of the polygon turn around {} times, expected once", name, entries)


@dataclass(frozen=True, slots=True)
class Polygons:
    """The directed sides of all polygons of a surface, as arrays with one entry for each side, facet after facet.

    For each side, ``facet`` has the facet to which it belongs, ``corner`` has the point at which it begins, ``next``
    has the following side of the same facet, and ``twin`` has the side of the neighbouring facet that is the same edge.
    For each facet, ``first`` has its first side and ``count`` the number of its sides.
    """

    corner: Ints
    facet: Ints
    next: Ints
    twin: Ints
    first: Ints
    count: Ints


def polygons(hull: ExactHull, facets: Facets) -> Polygons:
    """Return the sides of a hull's polygons.  Raise CertificateError if the polygons do not form a closed surface."""
    require(bool(facets), "there are no facets")
    corner, count = facets.corners, facets.counts
    if count.min() < 3:
        raise CertificateError(f"facet {int(count.argmin())}: fewer than three vertices")
    used = np.unique(corner)
    require(not np.setdiff1d(used, hull.vertices, assume_unique=True).size, "a point of a polygon is not a vertex")
    # The sides of all facets are stored in a row.  The side that follows the last side of a facet is the facet's first
    # side.
    facet = np.repeat(np.arange(len(facets)), count)
    first = np.cumsum(count) - count
    after = np.arange(1, len(corner) + 1)
    after[first + count - 1] = first
    lone = np.setdiff1d(hull.vertices, used)
    if lone.size:
        raise CertificateError(f"point {lone[0]} is called a vertex, but is a vertex of no facet")
    for number in np.flatnonzero(np.minimum.reduceat(corner, first) != corner[first]):
        raise CertificateError(f"facet {number}: the vertex with the smallest index is not the first of its polygon")
    size = len(hull.scaled)
    # Pairs of indices become single integers, so that sorting shows repetitions.
    pairs = np.sort(facet * size + corner)
    require(not (pairs[1:] == pairs[:-1]).any(), "a facet has a vertex twice")
    keys, reverse = corner * size + corner[after], corner[after] * size + corner
    order = np.argsort(keys)
    keys = keys[order]
    require(not (keys[1:] == keys[:-1]).any(), "an edge occurs twice in the same direction")
    # The twin of a side is the side whose key is reversed.
    positions = np.searchsorted(keys, reverse).clip(max=len(keys) - 1)
    for side in np.flatnonzero(keys[positions] != reverse):
        raise CertificateError(f"the edge {corner[side]}-{corner[after[side]]} belongs to only one facet")
    shape = f"{len(hull.vertices)} vertices, {len(corner) // 2} edges, {len(facets)} facets"
    require(len(hull.vertices) - len(corner) // 2 + len(facets) == 2, f"Euler's relation does not hold: {shape}")
    return Polygons(corner, facet, after, order[positions], first, count)


def check_planes(hull: ExactHull, facets: Facets, sides: Polygons) -> Planes:
    """Return the planes of the facets.  Check that they are in lowest terms and contain the corners of their facets."""
    columns = facets.planes.T.tolist()
    planes = list(zip(*columns, strict=True))
    ordered = all(map(operator.lt, planes, planes[1:]))
    require(ordered, "the facets are not sorted by plane, or a plane occurs twice")
    exact = facet_planes(read_points(hull.scaled), facets)
    for number in np.flatnonzero((exact.table[:, :3] == 0).all(axis=1)):
        raise CertificateError(f"facet {number}: the normal is 0")
    divisors = list(map(math.gcd, *columns))
    if max(divisors) > 1:
        raise CertificateError(f"facet {divisors.index(max(divisors))}: the plane is not in lowest terms")
    for side in exact.outside(sides.facet, sides.corner):
        raise CertificateError(f"facet {sides.facet[side]}: vertex {sides.corner[side]} is not in its plane")
    many = np.flatnonzero(sides.count > 3)
    members = np.unique(sides.corner[np.isin(sides.facet, many)])
    places = dict(zip(members.tolist(), map(tuple, exact.points.integers(members).tolist()), strict=True))
    for order in many.tolist():
        check_convex(facets.polygons[order], planes[order][:3], places, f"facet {order}")
    return exact

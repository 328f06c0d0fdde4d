"""Planes and vectors of integers, for the construction only; the certificate has its own."""

from __future__ import annotations

import math
from collections.abc import Sequence

from modern.exact_hull.coordinates import IntPoint
from modern.exact_hull.result import Plane


def minus(p: IntPoint, q: IntPoint) -> IntPoint:
    """p - q."""
    return p[0] - q[0], p[1] - q[1], p[2] - q[2]


def cross(u: IntPoint, v: IntPoint) -> IntPoint:
    """The vector product."""
    return u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]


def value(plane: Plane, p: IntPoint) -> int:
    """A x + B y + C z + D."""
    return plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + plane[3]


def plane_at(normal: IntPoint, p: IntPoint) -> Plane:
    """The plane through ``p`` with the given normal, not reduced."""
    return (*normal, -(normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2]))


def plane_through(p: IntPoint, q: IntPoint, r: IntPoint) -> Plane:
    """The plane of three points, positive on the side from which they run counterclockwise; not reduced."""
    return plane_at(cross(minus(q, p), minus(r, p)), p)


def lowest_terms(plane: Plane) -> Plane:
    """The plane without common divisor, its sense kept.  The normal is not zero."""
    divisor = math.gcd(*plane)
    a, b, c, d = plane
    return a // divisor, b // divisor, c // divisor, d // divisor


def independent(points: Sequence[IntPoint]) -> tuple[int, ...]:
    """The first affinely independent points, at most four: their number less one is the dimension.

    The points are distinct.
    """
    if len(points) == 1:
        return (0,)
    origin = points[0]
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

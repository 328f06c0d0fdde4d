"""Vectors of three exact numbers, integers or fractions; the results have the type of the arguments.

Butler's procedure (:mod:`modern.port`) uses these functions. The exact hull, which checks the results of the procedure,
has functions of its own.
"""

import math
from collections.abc import Iterable, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import TypeVar

Vector = tuple[Fraction, Fraction, Fraction]
N = TypeVar("N", int, Fraction)


def plus(p: tuple[N, N, N], q: tuple[N, N, N]) -> tuple[N, N, N]:
    return p[0] + q[0], p[1] + q[1], p[2] + q[2]


def minus(p: tuple[N, N, N], q: tuple[N, N, N]) -> tuple[N, N, N]:
    return p[0] - q[0], p[1] - q[1], p[2] - q[2]


def cross(u: tuple[N, N, N], v: tuple[N, N, N]) -> tuple[N, N, N]:
    """Return the vector product of u and v."""
    return u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]


def dot(u: tuple[N, N, N], v: tuple[N, N, N]) -> N:
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def whole(points: Sequence[tuple[N, N, N]]) -> tuple[int, list[tuple[int, int, int]]]:
    """Return the least positive scale that makes all coordinates integers, and the points multiplied by it."""
    scale = math.lcm(*{number.denominator for point in points for number in point})
    rows = ([number.numerator * (scale // number.denominator) for number in point] for point in points)
    return scale, [(x, y, z) for x, y, z in rows]


def lowest(vector: Sequence[int | Fraction]) -> tuple[int, int, int]:
    """Return the direction of a vector as integers without a common divisor; the zero vector stays zero."""
    x, y, z = _reduced(vector)
    return x, y, z


def lowest_equation(equation: Sequence[int | Fraction]) -> tuple[int, int, int, int]:
    """Return a positive multiple of an equation's four coefficients as integers without a common divisor."""
    a, b, c, d = _reduced(equation)
    return a, b, c, d


def _reduced(numbers: Sequence[int | Fraction]) -> list[int]:
    scale = math.lcm(*[number.denominator for number in numbers])
    multiples = [number.numerator * (scale // number.denominator) for number in numbers]
    divisor = math.gcd(*multiples) or 1
    return [multiple // divisor for multiple in multiples]


def independent(points: Sequence[tuple[N, N, N]]) -> list[int]:
    """Return the indices of the first four distinct points that are not coplanar, or of fewer if all are coplanar.

    The first two points must be distinct. The number of indices is the dimension of the set of points plus 1.
    """
    simplex: list[int] = [0]
    normal = minus(points[0], points[0])
    for number in range(1, len(points)):
        arm = minus(points[number], points[0])
        if len(simplex) == 1:
            simplex.append(number)
        elif len(simplex) == 2:
            normal = cross(minus(points[simplex[1]], points[0]), arm)
            if any(normal):
                simplex.append(number)
        elif dot(normal, arm):
            return [*simplex, number]
    return simplex


def area_vector(points: Sequence[tuple[N, N, N]], face: Sequence[int]) -> tuple[N, N, N]:
    """Return the normal of a polygon, with a length of twice the polygon's area.

    Seen from the tip of the normal, the corners are counterclockwise.
    """
    origin = points[face[0]]
    total = minus(origin, origin)
    for here, ahead in pairwise(face[1:]):
        total = plus(total, cross(minus(points[here], origin), minus(points[ahead], origin)))
    return total


def six_volumes(points: Sequence[tuple[N, N, N]], faces: Iterable[Sequence[int]]) -> N:
    """Return six times the volume inside a closed surface, negative if its faces are clockwise seen from outside."""
    first = points[0]
    arms = [minus(point, first) for point in points]
    total = dot(arms[0], arms[0])
    for face in faces:
        for here, ahead in pairwise(face[1:]):
            total += dot(arms[face[0]], cross(arms[here], arms[ahead]))
    return total

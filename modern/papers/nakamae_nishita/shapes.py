"""Create and place the paper's standard shapes: parallelepiped, column and polygonal plate (section 2).

All coordinates are fractions. The cosine and sine of a rotation are fractions too, so a rotated shape is exactly
congruent with the original.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction

from modern.geometry.vectors import Vector, cross, dot, minus, plus
from modern.papers.nakamae_nishita.polyhedron import Figure, Polyhedron, SceneError, turns_once

Move = Callable[[Vector], Vector]
_MOST_SIDES = 1000
_FINEST = 100_000


def parallelepiped(name: str, a: Vector, b: Vector, c: Vector) -> Polyhedron:
    """Return the parallelepiped at the origin with these three edges. Raise SceneError if they lie in one plane."""
    if not dot(cross(a, b), c):
        raise SceneError(f"{name}: expected three edges that do not lie in one plane")
    return column(name, [_ZERO, a, plus(a, b), b], c)


def cuboid(name: str, x: Fraction, y: Fraction, z: Fraction) -> Polyhedron:
    """Return the cuboid from the origin to (x, y, z). Raise SceneError for a side of length 0."""
    if not (x and y and z):
        raise SceneError(f"{name}: expected sides longer than 0")
    return parallelepiped(name, (x, _N, _N), (_N, y, _N), (_N, _N, z))


def column(name: str, base: Sequence[Vector], along: Vector) -> Polyhedron:
    """Return the prism over a convex polygon. Its vertices are those of the base, then those of the top.

    The base may run in either direction. Raise SceneError if the base is not a plane convex polygon or ``along`` is in
    its plane.
    """
    normal = _normal(name, base)
    rise = dot(normal, along)
    if not rise:
        raise SceneError(f"{name}: the column rises within the plane of its base; expected another direction")
    corners = list(base) if rise > 0 else [base[0], *base[:0:-1]]
    # Section 2 describes a column by its base and the direction in which the base is moved.
    # The base runs counterclockwise as seen from the top, so it is clockwise as seen from outside, from below.
    n = len(corners)
    walls = [(k, k + n, (k + 1) % n + n, (k + 1) % n) for k in range(n)]
    faces = (tuple(range(n)), tuple(range(2 * n - 1, n - 1, -1)), *walls)
    return Polyhedron(name, (*corners, *(plus(corner, along) for corner in corners)), faces)


def plate(name: str, corners: Sequence[Vector]) -> Polyhedron:
    """Return a convex polygon without thickness. Raise SceneError if the corners are not a convex polygon."""
    _normal(name, corners)
    places = tuple(range(len(corners)))
    return Polyhedron(name, tuple(corners), (places, places[::-1]))


def round_base(name: str, sides: int, radius: Fraction) -> list[Vector]:
    """Return a nearly regular polygon whose corners lie exactly on a circle about the origin.

    Each corner is within 1/1000 degree of the corner of the regular polygon. Raise SceneError for fewer than 3 or more
    than 1000 sides.
    """
    if not 3 <= sides <= _MOST_SIDES:
        raise SceneError(f"{name}: expected 3 to {_MOST_SIDES} sides, found {sides}")
    rotations = [rotation(Fraction(360 * k, sides)) for k in range(sides)]
    return [(radius * cosine, radius * sine, _N) for cosine, sine in rotations]


def rotation(degrees: Fraction) -> tuple[Fraction, Fraction]:
    """Return the cosine and sine of an angle as fractions exactly on the unit circle.

    The angle deviates by at most 1/1000 degree. Multiples of 90 degrees are exact. If the angle is reduced by a
    multiple of 90 degrees, the tangent of half the remainder is rounded to a fraction with a denominator of at most
    100,000.
    """
    # With t = tan(angle / 2), ((1 - t^2) / (1 + t^2), 2 t / (1 + t^2)) is a rational point of the circle.
    quarters = round(degrees / 90)
    half = math.radians(float(degrees - 90 * quarters) / 2)
    t = Fraction(math.tan(half)).limit_denominator(_FINEST)
    cosine, sine = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
    # Turns by 90 degrees are exact: they exchange the coordinates and one sign.
    for _ in range(quarters % 4):
        cosine, sine = -sine, cosine
    return cosine, sine


def turned(degrees: Fraction) -> Move:
    """Return the function that rotates a point about the z axis, counterclockwise seen from above."""
    cosine, sine = rotation(degrees)
    return lambda p: (cosine * p[0] - sine * p[1], sine * p[0] + cosine * p[1], p[2])


def scaled(times: Fraction) -> Move:
    return lambda p: (times * p[0], times * p[1], times * p[2])


def moved(shift: Vector) -> Move:
    return lambda p: plus(p, shift)


def placed(polyhedron: Polyhedron, move: Move, name: str) -> Polyhedron:
    """Return a polyhedron, with the figures on its faces, renamed and with each corner moved by ``move``."""
    figures = tuple(Figure(f.face, tuple(map(move, f.corners))) for f in polyhedron.figures)
    return replace(polyhedron, name=name, vertices=tuple(map(move, polyhedron.vertices)), figures=figures)


def _normal(name: str, corners: Sequence[Vector]) -> Vector:
    """Return the normal of a convex polygon. Seen from the tip of the normal, the corners run counterclockwise."""
    if len(corners) < 3:
        raise SceneError(f"{name}: expected at least 3 corners, found {len(corners)}")
    # The first corner that is not in line with its neighbours determines the normal, and its sense if it is convex.
    ring = [*corners, *corners[:2]]
    bends = [cross(minus(q, p), minus(r, q)) for p, q, r in zip(ring, ring[1:], ring[2:], strict=False)]
    normal = next((bend for bend in bends if any(bend)), _ZERO)
    if not any(normal) or any(dot(normal, minus(corner, corners[0])) for corner in corners):
        raise SceneError(f"{name}: the corners do not lie in one plane, or all lie in a line")
    if not turns_once(corners, normal):
        raise SceneError(f"{name}: the polygon is not convex")
    return normal


_N = Fraction(0)
_ZERO: Vector = (_N, _N, _N)

"""The standard shapes that section 2 has subroutines for, and their placing: parallelepiped, column, polygonal plate.

All coordinates are fractions; a turn is made by fractions too, so that a turned shape is exactly the shape.
"""

from __future__ import annotations

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
    """The parallelepiped at the origin with these three edges.  Raises SceneError where they lie in one plane."""
    if not dot(cross(a, b), c):
        raise SceneError(f"{name}: the three edges lie in one plane")
    return column(name, [_ZERO, a, plus(a, b), b], c)


def cuboid(name: str, x: Fraction, y: Fraction, z: Fraction) -> Polyhedron:
    """The cuboid from the origin to (x, y, z).  Raises SceneError for a side of length 0."""
    if not (x and y and z):
        raise SceneError(f"{name}: a side of a cuboid has the length 0")
    return parallelepiped(name, (x, _N, _N), (_N, y, _N), (_N, _N, z))


def column(name: str, base: Sequence[Vector], along: Vector) -> Polyhedron:
    """The prism over a convex polygon.  Its vertices are those of the base, then those of the top.

    base: the corners in either sense.  Raises SceneError for a base that is no plane convex polygon, or an ``along``
    in its plane.
    """
    normal = _normal(name, base)
    rise = dot(normal, along)
    if not rise:
        raise SceneError(f"{name}: the column does not rise from its base")
    corners = list(base) if rise > 0 else [base[0], *base[:0:-1]]
    # Seen from the top the base runs counterclockwise: clockwise from outside, below it.
    n = len(corners)
    walls = [(k, k + n, (k + 1) % n + n, (k + 1) % n) for k in range(n)]
    faces = (tuple(range(n)), tuple(range(2 * n - 1, n - 1, -1)), *walls)
    return Polyhedron(name, (*corners, *(plus(corner, along) for corner in corners)), faces)


def plate(name: str, corners: Sequence[Vector]) -> Polyhedron:
    """A convex polygon without thickness, seen from both sides.  Raises SceneError where it is none."""
    _normal(name, corners)
    places = tuple(range(len(corners)))
    return Polyhedron(name, tuple(corners), (places, places[::-1]))


def round_base(name: str, sides: int, radius: Fraction) -> list[Vector]:
    """A polygon of corners exactly on a circle about the origin, each within 1/1000 degree of its place if regular.

    Raises SceneError for fewer than three sides, or more than 1000.
    """
    if not 3 <= sides <= _MOST_SIDES:
        raise SceneError(f"{name}: {sides} is not a number of sides from 3 to {_MOST_SIDES}")
    turns = [rotation(Fraction(360 * k, sides)) for k in range(sides)]
    return [(radius * cosine, radius * sine, _N) for cosine, sine in turns]


def rotation(degrees: Fraction) -> tuple[Fraction, Fraction]:
    """Cosine and sine, both fractions and exactly on the unit circle, of an angle within 1/1000 degree of this one.

    Multiples of 90 degrees are exact.  The tangent of half the rest is rounded to a denominator of at most 100,000.
    """
    quarters = round(degrees / 90)
    half = math.radians(float(degrees - 90 * quarters) / 2)
    t = Fraction(math.tan(half)).limit_denominator(_FINEST)
    cosine, sine = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
    for _ in range(quarters % 4):
        cosine, sine = -sine, cosine
    return cosine, sine


def turned(degrees: Fraction) -> Move:
    """A turn about the z axis, counterclockwise from above."""
    cosine, sine = rotation(degrees)
    return lambda p: (cosine * p[0] - sine * p[1], sine * p[0] + cosine * p[1], p[2])


def scaled(times: Fraction) -> Move:
    """Larger or smaller about the origin."""
    return lambda p: (times * p[0], times * p[1], times * p[2])


def moved(shift: Vector) -> Move:
    """A move by a vector."""
    return lambda p: plus(p, shift)


def placed(polyhedron: Polyhedron, move: Move, name: str) -> Polyhedron:
    """The polyhedron and its figures, moved and named."""
    figures = tuple(Figure(f.face, tuple(map(move, f.corners))) for f in polyhedron.figures)
    return replace(polyhedron, name=name, vertices=tuple(map(move, polyhedron.vertices)), figures=figures)


def _normal(name: str, corners: Sequence[Vector]) -> Vector:
    """A vector at right angles to a convex polygon, from where it runs counterclockwise."""
    if len(corners) < 3:
        raise SceneError(f"{name}: a polygon has three corners or more, not {len(corners)}")
    bends = [
        cross(minus(q, p), minus(r, q))
        for p, q, r in zip(corners, [*corners[1:], corners[0]], [*corners[2:], *corners[:2]], strict=True)
    ]
    normal = next((bend for bend in bends if any(bend)), _ZERO)
    if not any(normal) or any(dot(normal, minus(corner, corners[0])) for corner in corners):
        raise SceneError(f"{name}: the corners do not lie in one plane, or all lie in a line")
    if not turns_once(corners, normal):
        raise SceneError(f"{name}: the polygon is not convex")
    return normal


_N = Fraction(0)
_ZERO: Vector = (_N, _N, _N)

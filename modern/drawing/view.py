"""Parallel projection along a direction, exactly, and the choice of a direction.

The direction points from the solid to the eye.  The image's x axis is ``z x eye`` and its y axis ``eye x (z x eye)``,
so that the z axis of space stands upright; seen along z itself, x is to the right and y upright.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from modern.exact_hull.coordinates import common_scale, to_integers
from modern.geometry.vectors import Vector, cross, dot, lowest, minus

Eye = tuple[int, int, int]
Flat = tuple[Fraction, Fraction]

EYES: tuple[Eye, ...] = (
    (24, -55, 29),
    (-31, -53, 28),
    (47, -41, 33),
    (17, -56, 41),
    (38, -49, 19),
    (-13, -59, 31),
    (57, -29, 26),
    (11, -43, 57),
    (-43, -37, 39),
    (29, -61, 9),
    (7, -62, 17),
    (51, -37, 47),
    (61, -9, 23),
    (-58, -21, 27),
    (-59, -14, 49),
    (62, 13, 32),
    (49, 42, 27),
    (-47, 43, 31),
    (23, 57, 26),
    (-19, 58, 37),
    (3, 61, 14),
    (-37, 39, 53),
    (34, 31, 59),
    (27, -57, -22),
)
"""Directions tried for a view of a polyhedron: from the front and a little above, then from other sides."""

_CLEAR_FACE = 40
_CLEAR_PAIR = 600
_MOST_PAIRS = 60
_ROOT = 10**15


@dataclass(frozen=True, slots=True)
class View:
    """A direction of view in lowest terms, and the two axes of the image (not of unit length)."""

    eye: Eye
    right: Eye
    up: Eye
    stretch: Fraction
    """The length of ``eye``: x of the image times it is of the same scale as y; a root, to 15 decimals."""

    def project(self, point: Vector) -> Flat:
        """The image of a point, to a common scale."""
        return along(self.right, point) * self.stretch, along(self.up, point)


def view(eye: Eye) -> View:
    """The view from a direction that is not zero."""
    right, up = _axes(eye)
    return View(eye, right, up, root(Fraction(dot(eye, eye))))


def root(square: Fraction) -> Fraction:
    """The square root to 15 decimals beyond the first digit, from below; of integers of at least 1."""
    return Fraction(math.isqrt(square.numerator * _ROOT * _ROOT // square.denominator), _ROOT)


def along(direction: Eye, point: Vector) -> Fraction:
    """The scalar product."""
    return direction[0] * point[0] + direction[1] * point[1] + direction[2] * point[2]


def choose(points: Sequence[Vector], normals: Sequence[Vector]) -> Eye:
    """A direction in which no face is edge-on and no two vertices fall together, exactly.

    Of ``EYES``, the one that shows most faces, counted for less where a face is near to edge-on or vertices are near to
    each other; the first of equals.  Where none serves, the first on the curve (t, -t t - 1, t t t) that does, t being
    2, 3, 4 and so on: a face or a pair of vertices rules out three of its directions at the most, so there is one.
    """
    places = to_integers(points, common_scale(points))
    flanks = [lowest(normal) for normal in normals if any(normal)]
    best, most = None, Fraction(0)
    for eye in EYES:
        merit = _clearness(places, flanks, eye) * sum(dot(normal, eye) > 0 for normal in flanks)
        if merit > most:
            best, most = eye, merit
    if best is not None:
        return best
    t = 2
    while not _serves(places, flanks, (t, -t * t - 1, t * t * t)):
        t += 1
    return t, -t * t - 1, t * t * t


def across(line: Vector) -> Eye:
    """A direction from which a segment of direction ``line`` is seen at its full length: level, and from the front."""
    if not (line[0] or line[1]):
        return 0, -1, 0
    x, y, _ = lowest((line[1], -line[0], Fraction(0)))
    return (x, y, 0) if (-y, x) > (0, 0) else (-x, -y, 0)


def towards(normal: Vector) -> Eye:
    """The direction at right angles to a polygon: from above, or from the front, or from the right."""
    x, y, z = lowest(normal)
    return (x, y, z) if (z, -y, x) > (0, 0, 0) else (-x, -y, -z)


def _serves(points: Sequence[Eye], normals: Sequence[Eye], eye: Eye) -> bool:
    right, up = _axes(eye)
    images = {(dot(right, point), dot(up, point)) for point in points}
    return len(images) == len(points) and all(dot(normal, eye) for normal in normals)


def _axes(eye: Eye) -> tuple[Eye, Eye]:
    upright = (0, 0, 1) if eye[0] or eye[1] else (0, 1 if eye[2] > 0 else -1, 0)
    right = cross(upright, eye)
    return right, cross(eye, right)


def _clearness(points: Sequence[Eye], normals: Sequence[Eye], eye: Eye) -> Fraction:
    """0 where the direction does not serve, 1 where it serves well; between, the better the larger."""
    if not _serves(points, normals, eye):
        return Fraction(0)
    square = dot(eye, eye)
    clear = Fraction(1)
    for normal in normals:
        clear = min(clear, Fraction(dot(normal, eye) ** 2 * _CLEAR_FACE, dot(normal, normal) * square))
    if len(points) <= _MOST_PAIRS:
        pairs = [minus(p, q) for k, p in enumerate(points) for q in points[:k]]
        extent = max(dot(pair, pair) for pair in pairs)
        nearest = min(dot(apart, apart) for apart in (cross(pair, eye) for pair in pairs))
        clear = min(clear, Fraction(nearest * _CLEAR_PAIR, square * extent))
    return clear

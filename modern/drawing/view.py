"""Project points exactly along a direction of view, and choose a good direction.

The direction points from the solid to the eye. The x axis of the image is the vector product ``z x eye`` and its y axis
``eye x (z x eye)``. The z axis of space is therefore upright. If the direction is along z, x points right and y is
upright.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from modern.geometry.vectors import Vector, cross, dot, lowest, minus, whole

Eye = tuple[int, int, int]
Flat = tuple[Fraction, Fraction]

# The directions from which the view of a polyhedron is chosen: first from the front and slightly above, then from other
# sides.
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

_CLEAR_FACE = 40
_CLEAR_PAIR = 600
_MOST_PAIRS = 60
_ROOT = 10**15


@dataclass(frozen=True, slots=True)
class View:
    """A direction of view and the two axes of the picture, as integer vectors, which are not unit vectors."""

    eye: Eye
    right: Eye
    up: Eye
    # The length of ``eye`` to 15 decimals. x of the image, multiplied by it, has the same scale as y.
    stretch: Fraction

    def project(self, point: Vector) -> Flat:
        """Return the exact position of a point in the picture. Both axes have the same scale."""
        return along(self.right, point) * self.stretch, along(self.up, point)


def view(eye: Eye) -> View:
    right, up = _axes(eye)
    return View(eye, right, up, root(Fraction(dot(eye, eye))))


def root(square: Fraction) -> Fraction:
    """Return the square root of a number, truncated to 15 decimals. The number is at least 1."""
    return Fraction(math.isqrt(square.numerator * _ROOT * _ROOT // square.denominator), _ROOT)


def along(direction: Eye, point: Vector) -> Fraction:
    return direction[0] * point[0] + direction[1] * point[1] + direction[2] * point[2]


def choose(points: Sequence[Vector], normals: Sequence[Vector]) -> Eye:
    """Return a direction in which no face is edge-on and no two vertices coincide, decided exactly.

    Among the fixed directions ``EYES``, choose the one with the greatest score: the number of visible faces, reduced if
    a face is nearly edge-on or two vertices nearly coincide. Of several directions with the greatest score, choose the
    first. If no direction of ``EYES`` is suitable, choose the first suitable direction on the curve (t, -t^2 - 1, t^3)
    for t = 2, 3, 4 and so on. A face or a pair of vertices excludes at most three directions of the curve, so a
    suitable direction exists.
    """
    _, places = whole(points)
    primitive_normals = [lowest(normal) for normal in normals if any(normal)]
    best, most = None, Fraction(0)
    for eye in EYES:
        score = _clearness(places, primitive_normals, eye) * sum(dot(normal, eye) > 0 for normal in primitive_normals)
        if score > most:
            best, most = eye, score
    if best is not None:
        return best
    t = 2
    while not _is_suitable(places, primitive_normals, (t, -t * t - 1, t * t * t)):
        t += 1
    return t, -t * t - 1, t * t * t


def across(line: Vector) -> Eye:
    """Return a horizontal direction of view at right angles to a segment with the direction ``line``."""
    if not (line[0] or line[1]):
        return 0, -1, 0
    x, y, _ = lowest((line[1], -line[0], Fraction(0)))
    return (x, y, 0) if (-y, x) > (0, 0) else (-x, -y, 0)


def towards(normal: Vector) -> Eye:
    """Return the direction of view along the normal of a polygon: from above, or for an upright polygon from the front
    or the right.
    """
    x, y, z = lowest(normal)
    return (x, y, z) if (z, -y, x) > (0, 0, 0) else (-x, -y, -z)


def _is_suitable(points: Sequence[Eye], normals: Sequence[Eye], eye: Eye) -> bool:
    right, up = _axes(eye)
    images = {(dot(right, point), dot(up, point)) for point in points}
    return len(images) == len(points) and all(dot(normal, eye) for normal in normals)


def _axes(eye: Eye) -> tuple[Eye, Eye]:
    upright = (0, 0, 1) if eye[0] or eye[1] else (0, 1 if eye[2] > 0 else -1, 0)
    right = cross(upright, eye)
    return right, cross(eye, right)


def _clearness(points: Sequence[Eye], normals: Sequence[Eye], eye: Eye) -> Fraction:
    """Return a score, from 0 (unsuitable) to 1, for how clearly a direction shows all faces and vertices."""
    if not _is_suitable(points, normals, eye):
        return Fraction(0)
    square = dot(eye, eye)
    clear = Fraction(1)
    # The squared sine of the angle between face and direction, scaled, and limited to 1.
    for normal in normals:
        clear = min(clear, Fraction(dot(normal, eye) ** 2 * _CLEAR_FACE, dot(normal, normal) * square))
    if len(points) <= _MOST_PAIRS:
        pairs = [minus(p, q) for k, p in enumerate(points) for q in points[:k]]
        extent = max(dot(pair, pair) for pair in pairs)
        # The distance between two images is |pair x eye| / |eye|. It is compared with the extent of the solid.
        nearest = min(dot(apart, apart) for apart in (cross(pair, eye) for pair in pairs))
        clear = min(clear, Fraction(nearest * _CLEAR_PAIR, square * extent))
    return clear

"""Project points in parallel or in perspective, with exact integers.

Both projections map points to homogeneous coordinates: (x, y, z, w) is the point (x/w, y/w, z/w). After the map, the
eye is at infinity on the z axis, and z grows towards the eye. In parallel projection w is the common denominator of a
polyhedron's coordinates. In perspective w is proportional to the distance of the point from the eye along the direction
of view, and z/w to the inverse of this distance. Both maps preserve planes, lines and the sense of rotation, so
formulas (1) to (6) of the paper hold for the mapped coordinates.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from modern.drawing.view import Eye, view
from modern.geometry.vectors import Vector, dot, lowest, minus, whole
from modern.papers.nakamae_nishita.polyhedron import Polyhedron, SceneError

Homogeneous = tuple[int, int, int, int]


@dataclass(frozen=True, slots=True)
class Observer:
    """The viewpoint of a scene: the direction to the eye, the axes of the picture, and in perspective the eye."""

    eye: Eye
    right: Eye
    up: Eye
    # The position of the eye, or None in parallel projection.
    point: Vector | None = None
    # The length of ``eye`` to 15 decimals. x of the image, multiplied by it, has the same scale as y.
    stretch: Fraction = Fraction(1)
    # The distance of the near plane from the eye in perspective, along the direction of view.
    near: Fraction | None = None


def parallel(direction: Sequence[Fraction | int]) -> Observer:
    """Return the observer at infinity in a direction. Raise SceneError for the direction 0,0,0."""
    if not any(direction):
        raise SceneError("expected a direction of view other than 0,0,0")
    sight = view(lowest([Fraction(number) for number in direction]))
    return Observer(sight.eye, sight.right, sight.up, None, sight.stretch)


def perspective(point: Vector, towards: Vector, near: Fraction | None = None) -> Observer:
    """Return the observer at a point who looks towards another point. Raise SceneError if they are the same."""
    if point == towards:
        raise SceneError("expected an observation point other than the point looked at")
    sight = parallel(minus(point, towards))
    return Observer(sight.eye, sight.right, sight.up, point, sight.stretch, near)


def project(polyhedron: Polyhedron, observer: Observer, origin: Vector) -> list[Homogeneous]:
    """Return the homogeneous images of a polyhedron's vertices, then of the corners of the figures on its faces.

    If A and B are the images of the ends of an edge, the point at the fraction s of the edge has the image
    (1 - s) A + s B. In parallel projection ``origin`` is subtracted from all points, to keep the integers short.

    Raise SceneError if a part of the polyhedron is not in front of the observation point.
    """
    points = [*polyhedron.vertices, *(corner for figure in polyhedron.figures for corner in figure.corners)]
    centre = observer.point or origin
    scale, (*integers, c) = whole([*points, centre])
    right, up, eye = observer.right, observer.up, observer.eye
    # The products are written out because this runs for every vertex of a scene.
    away = [(x - c[0], y - c[1], z - c[2]) for x, y, z in integers]
    flat = [
        (right[0] * x + right[1] * y + right[2] * z, up[0] * x + up[1] * y + up[2] * z, dot(eye, (x, y, z)))
        for x, y, z in away
    ]
    # In parallel projection w is one denominator for all points. In perspective the division by the distance -z makes
    # lines of sight parallel.
    if observer.point is None:
        return [(x, y, z, scale) for x, y, z in flat]
    if any(z >= 0 for _, _, z in flat):
        raise SceneError(
            f"{polyhedron.name}: not entirely in front of the observation point; set a near plane to clip it"
        )
    return [(x, y, scale, -z) for x, y, z in flat]


def image(point: Homogeneous, observer: Observer) -> tuple[Fraction, Fraction]:
    """Return the position of a projected point in the picture, with y upwards and one scale for both axes."""
    return Fraction(point[0], point[3]) * observer.stretch, Fraction(point[1], point[3])

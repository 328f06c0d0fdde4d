"""The projection: from a direction, or from an observation point, in integers.

Both are one map of homogeneous coordinates, (x, y, z, w) for the point (x/w, y/w, z/w), after which the eye is far
away on the z axis and z grows towards it: in parallel projection w is the denominator of a polyhedron's coordinates;
in perspective w grows with the distance from the eye's plane, and z/w is its inverse.  Planes and lines stay planes
and lines and the sense of rotation stays, so formulas (1) to (6) of the paper hold for the mapped coordinates.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from modern.drawing.view import Eye, view
from modern.exact_hull.coordinates import common_scale, to_integers
from modern.geometry.vectors import Vector, dot, lowest, minus
from modern.papers.nakamae_nishita.polyhedron import Polyhedron, SceneError

Homogeneous = tuple[int, int, int, int]


@dataclass(frozen=True, slots=True)
class Observer:
    """From where a scene is seen: ``eye`` the direction to the eye, ``point`` the eye itself, in perspective."""

    eye: Eye
    right: Eye
    up: Eye
    point: Vector | None = None
    stretch: Fraction = Fraction(1)
    """x of the image times it is of the same scale as y: the length of ``eye``, to 15 decimals."""
    near: Fraction | None = None
    """In perspective, how far from the eye the near plane is, at right angles to the direction of view."""


def parallel(direction: Sequence[Fraction | int]) -> Observer:
    """Seen from far away in a direction.  Raises SceneError for 0,0,0."""
    if not any(direction):
        raise SceneError("the direction of view is 0,0,0")
    sight = view(lowest([Fraction(number) for number in direction]))
    return Observer(sight.eye, sight.right, sight.up, None, sight.stretch)


def perspective(point: Vector, towards: Vector, near: Fraction | None = None) -> Observer:
    """Seen from a point towards another one, what lies beyond a near plane if one is given.

    Raises SceneError where the points are the same.
    """
    if point == towards:
        raise SceneError("the observation point is the point looked at")
    sight = parallel(minus(point, towards))
    return Observer(sight.eye, sight.right, sight.up, point, sight.stretch, near)


def project(polyhedron: Polyhedron, observer: Observer, origin: Vector) -> list[Homogeneous]:
    """The images of the vertices, then of the corners of the figures, all to one scale: a point that divides an edge
    in space as s to 1 - s has the image (1 - s) A + s B.

    origin: subtracted from all of a scene's points in parallel projection, to keep numbers short.
    Raises SceneError where part of the polyhedron lies beside or behind the observation point.
    """
    points = [*polyhedron.vertices, *(corner for figure in polyhedron.figures for corner in figure.corners)]
    centre = observer.point or origin
    scale = common_scale([*points, centre])
    *whole, c = to_integers([*points, centre], scale)
    right, up, eye = observer.right, observer.up, observer.eye
    # Products written out: this is done for every vertex of a scene.
    away = [(x - c[0], y - c[1], z - c[2]) for x, y, z in whole]
    flat = [
        (right[0] * x + right[1] * y + right[2] * z, up[0] * x + up[1] * y + up[2] * z, dot(eye, (x, y, z)))
        for x, y, z in away
    ]
    if observer.point is None:
        return [(x, y, z, scale) for x, y, z in flat]
    if any(z >= 0 for _, _, z in flat):
        raise SceneError(f"{polyhedron.name}: not wholly before the observation point; a near plane cuts it")
    return [(x, y, scale, -z) for x, y, z in flat]


def image(point: Homogeneous, observer: Observer) -> tuple[Fraction, Fraction]:
    """Where a point is drawn, y upward, true to scale."""
    return Fraction(point[0], point[3]) * observer.stretch, Fraction(point[1], point[3])

"""What there is to draw of a hull seen from a direction: images of points, edges seen and hidden, marks.

Which faces are seen and which edges are hidden is found as Nakamae and Nishita find it.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from modern.drawing.view import Eye, Flat, View, across, along, choose, root, towards, view
from modern.drawing.visible import BACK, FLAT, classify, facing
from modern.geometry.hull import Hull
from modern.geometry.mesh import ExportError, Mesh, mesh
from modern.geometry.numbers import coordinates, number, quoted
from modern.geometry.vectors import Vector, area_vector, cross, dot, lowest, minus

_ONE = Fraction(1)


@dataclass(frozen=True, slots=True)
class Edge:
    """An edge between two vertices, by place from 0; hidden where all of its faces turn away."""

    start: int
    end: int
    hidden: bool


@dataclass(frozen=True, slots=True)
class Mark:
    """A boundary or inside point: its index in the input, its image, and whether it is behind the faces seen."""

    index: int
    image: Flat
    hidden: bool


@dataclass(frozen=True, slots=True)
class Pane:
    """A face that is seen: its corners by place, and how much light falls on it, from 0 to 1."""

    corners: tuple[int, ...]
    light: Fraction


@dataclass(frozen=True, slots=True)
class Scene:
    """A picture without a size.  ``images`` and ``hidden`` are of the vertices, in the order of ``Hull.vertices``."""

    dimension: int
    view: View
    chosen: bool
    images: tuple[Flat, ...]
    hidden: tuple[bool, ...]
    edges: tuple[Edge, ...]
    panes: tuple[Pane, ...]
    boundary: tuple[Mark, ...]
    inside: tuple[Mark, ...]
    faces: int
    behind: bool = True
    """Whether what is hidden is shown."""


def scene(hull: Hull, eye: Sequence[Fraction] | None = None) -> Scene:
    """The picture of a hull from a direction, or from one chosen for it.

    Raises ExportError where there is no hull, or the direction is zero or shows a polygon or segment edge-on.
    """
    surface = mesh(hull)
    points = surface.numbers()
    normals = [area_vector(points, face) for face in surface.faces]
    sight = view(_direction(surface, points, normals, eye))
    images = tuple(sight.project(point) for point in points)
    # A mesh has its faces counterclockwise from outside, the paper clockwise.
    faces = [face[::-1] for face in surface.faces]
    signs = [facing([(*images[place], _ONE) for place in face]) for face in faces]
    if surface.dimension == 2:
        # A polygon has two sides; whichever the eye is on is the one drawn.
        signs = [abs(sign) for sign in signs]
    around: dict[int, list[int]] = defaultdict(list)
    for face, sign in zip(surface.faces, signs, strict=True):
        for place in face:
            around[place].append(sign)

    def mark(index: int, solid: bool) -> Mark:
        point = coordinates(hull.points[index])
        return Mark(index, sight.project(point), solid and _behind(index, point, hull, surface, points, normals, signs))

    return Scene(
        surface.dimension,
        sight,
        eye is None,
        images,
        tuple(_away(around[place]) for place in range(len(points))),
        _edges(surface, faces, normals, signs),
        tuple(
            Pane(face, _light(normal, sight) if surface.dimension == 3 else Fraction(1))
            for face, normal, sign in zip(surface.faces, normals, signs, strict=True)
            if sign > 0
        ),
        tuple(mark(index, surface.dimension == 3) for index in hull.boundary),
        tuple(mark(index, False) for index in hull.inside),
        len(surface.faces),
    )


def _away(signs: Sequence[int]) -> bool:
    """Whether all faces turn away.  One that is edge-on does not: what lies in it is on the outline."""
    return bool(signs) and all(sign < 0 for sign in signs)


def _direction(
    surface: Mesh, points: Sequence[Vector], normals: Sequence[Vector], eye: Sequence[Fraction] | None
) -> Eye:
    if eye is not None:
        given = lowest(eye)
        direction = (Fraction(given[0]), Fraction(given[1]), Fraction(given[2]))
        if not any(given):
            raise ExportError("the direction of view is 0,0,0")
        if surface.dimension == 1 and not any(cross(minus(points[1], points[0]), direction)):
            raise ExportError("the direction of view is along the segment, which would be a point")
        if surface.dimension == 2 and not along(given, normals[0]):
            raise ExportError("the direction of view is in the plane of the polygon, which would be a line")
        return given
    if surface.dimension == 3:
        return choose(points, normals)
    if surface.dimension == 2:
        return towards(normals[0])
    return across(minus(points[-1], points[0]))


def _edges(
    surface: Mesh, faces: Sequence[tuple[int, ...]], normals: Sequence[Vector], signs: Sequence[int]
) -> tuple[Edge, ...]:
    """Every edge between faces of different planes; of a segment its one."""
    if surface.dimension < 2:
        return tuple(Edge(a, b, False) for a, b in surface.edges() if surface.dimension)
    found = classify(faces, signs, lambda a, b: _parallel(normals[a], normals[b]))
    return tuple(Edge(edge.start, edge.end, edge.kind == BACK) for edge in found if edge.kind != FLAT)


def _parallel(u: Vector, v: Vector) -> bool:
    return not any(cross(u, v)) and dot(u, v) > 0


def _behind(
    index: int,
    point: Vector,
    hull: Hull,
    surface: Mesh,
    points: Sequence[Vector],
    normals: Sequence[Vector],
    signs: Sequence[int],
) -> bool:
    """Whether every face a boundary point lies on turns away."""
    on = [
        sign
        for face, polygon, normal, sign in zip(hull.faces, surface.faces, normals, signs, strict=True)
        if index in face.on or not dot(normal, minus(point, points[polygon[0]]))
    ]
    return _away(on)


def _light(normal: Vector, sight: View) -> Fraction:
    """From 0 to 1: half of one plus the cosine to a lamp behind the eye's left shoulder, above."""
    length = sight.stretch
    level = root(Fraction(dot(sight.right, sight.right)))
    tall = level * length
    r, u, e = sight.right, sight.up, sight.eye
    lamp = tuple(Fraction(7 * e[k]) / (10 * length) - r[k] / (2 * level) + 5 * u[k] / (9 * tall) for k in range(3))
    direction = (lamp[0], lamp[1], lamp[2])
    size = dot(normal, normal) * dot(direction, direction)
    if not size:
        return Fraction(1)
    value = dot(normal, direction)
    cosine = root(value * value / size)
    return (1 + (cosine if value > 0 else -cosine)) / 2


def eye_of(texts: Sequence[str]) -> tuple[Fraction, ...]:
    """A direction from three decimals.  Raises ExportError."""
    if len(texts) != 3:
        raise ExportError(f"the direction of view is {len(texts)} numbers; it has three, X,Y,Z")
    found = []
    for text in texts:
        try:
            found.append(number(text))
        except ValueError:
            raise ExportError(f"the direction of view: {quoted(text)} is not a number") from None
    return tuple(found)

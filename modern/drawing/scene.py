"""Project a hull for a picture, and find its visible and hidden edges by Nakamae and Nishita's method."""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from emulator.errors import quoted
from modern.drawing.view import Eye, Flat, View, across, along, choose, root, towards, view
from modern.drawing.visible import BACK, FLAT, classify, facing
from modern.geometry.hull import Hull
from modern.geometry.mesh import ExportError, Mesh, mesh
from modern.geometry.numbers import coordinates, number
from modern.geometry.vectors import Vector, area_vector, cross, dot, lowest, minus

_ONE = Fraction(1)


@dataclass(frozen=True, slots=True)
class Edge:
    """An edge of a hull in a picture: the indices of its two vertices, and True if the edge is hidden."""

    start: int
    end: int
    hidden: bool


@dataclass(frozen=True, slots=True)
class Mark:
    """A point that is not a vertex: its input index, its position in the picture, and True if a face hides it."""

    index: int
    image: Flat
    hidden: bool


@dataclass(frozen=True, slots=True)
class Pane:
    """A visible face in a picture: the indices of its vertices, and its brightness from 0 to 1."""

    corners: tuple[int, ...]
    light: Fraction


@dataclass(frozen=True, slots=True)
class Scene:
    """The projection of a hull, before its size in pixels is known.

    ``images`` are the positions of the vertices in the order of ``Hull.vertices``, and ``hidden`` is True for each
    hidden vertex. ``boundary`` and ``inside`` have the boundary points and the inside points. ``faces`` is the number
    of faces.
    """

    dimension: int
    view: View
    # True if the program has chosen the direction of view.
    chosen: bool
    images: tuple[Flat, ...]
    hidden: tuple[bool, ...]
    edges: tuple[Edge, ...]
    panes: tuple[Pane, ...]
    boundary: tuple[Mark, ...]
    inside: tuple[Mark, ...]
    faces: int
    # True if hidden edges and vertices are drawn.
    behind: bool = True


def scene(hull: Hull, eye: Sequence[Fraction] | None = None) -> Scene:
    """Return the projection of a hull along the direction ``eye``. If it is None, choose a suitable direction.

    Raise ExportError if there is no hull, if the direction is 0,0,0, or if a polygon would appear as a line or a
    segment as a point.
    """
    surface = mesh(hull)
    points = surface.numbers()
    normals = [area_vector(points, face) for face in surface.faces]
    sight = view(_direction(surface, points, normals, eye))
    images = tuple(sight.project(point) for point in points)
    # The faces of a mesh are counterclockwise from outside, whereas the paper's method expects them clockwise.
    faces = [face[::-1] for face in surface.faces]
    signs = [facing([(*images[place], _ONE) for place in face]) for face in faces]
    if surface.dimension == 2:
        # A polygon has two sides. The side that faces the eye is drawn.
        signs = [abs(sign) for sign in signs]
    around: dict[int, list[int]] = defaultdict(list)
    for face, sign in zip(surface.faces, signs, strict=True):
        for place in face:
            around[place].append(sign)

    def mark(index: int, on_solid: bool) -> Mark:
        point = coordinates(hull.points[index])
        faces_at = zip(hull.faces, surface.faces, normals, signs, strict=True) if on_solid else ()
        signs_at = [
            sign
            for face, polygon, normal, sign in faces_at
            if index in face.on or not dot(normal, minus(point, points[polygon[0]]))
        ]
        return Mark(index, sight.project(point), _away(signs_at))

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
    """Return True if every face at a point is turned away from the eye, i.e. has the sign -1 (0 means edge-on)."""
    return bool(signs) and all(sign < 0 for sign in signs)


def _direction(
    surface: Mesh, points: Sequence[Vector], normals: Sequence[Vector], eye: Sequence[Fraction] | None
) -> Eye:
    if eye is not None:
        integers = lowest(eye)
        direction = (Fraction(integers[0]), Fraction(integers[1]), Fraction(integers[2]))
        if not any(integers):
            raise ExportError("expected a direction of view other than 0,0,0")
        if surface.dimension == 1 and not any(cross(minus(points[1], points[0]), direction)):
            raise ExportError("the direction of view is along the segment, which would appear as a point")
        if surface.dimension == 2 and not along(integers, normals[0]):
            raise ExportError("the direction of view is in the plane of the polygon, which would appear as a line")
        return integers
    if surface.dimension == 3:
        return choose(points, normals)
    if surface.dimension == 2:
        return towards(normals[0])
    return across(minus(points[-1], points[0]))


def _edges(
    surface: Mesh, faces: Sequence[tuple[int, ...]], normals: Sequence[Vector], signs: Sequence[int]
) -> tuple[Edge, ...]:
    """Return every edge between faces in different planes, with its visibility, or the only edge of a segment."""
    if surface.dimension < 2:
        return tuple(Edge(a, b, False) for a, b in surface.edges() if surface.dimension)

    def coplanar(a: int, b: int) -> bool:
        return not any(cross(normals[a], normals[b])) and dot(normals[a], normals[b]) > 0

    classified = classify(faces, signs, coplanar)
    return tuple(Edge(edge.start, edge.end, edge.kind == BACK) for edge in classified if edge.kind != FLAT)


def _light(normal: Vector, sight: View) -> Fraction:
    """Return the brightness of a face, (1 + c) / 2.

    c is the cosine of the angle between the face's normal and the direction of the lamp, which is at the left shoulder
    of the viewer.
    """
    length = sight.stretch
    level = root(Fraction(dot(sight.right, sight.right)))
    tall = level * length
    r, u, e = sight.right, sight.up, sight.eye
    # The axes of the image are vectors of different lengths, so each component is divided by the length of its axis.
    lamp = tuple(Fraction(7 * e[k]) / (10 * length) - r[k] / (2 * level) + 5 * u[k] / (9 * tall) for k in range(3))
    direction = (lamp[0], lamp[1], lamp[2])
    # The cosine is the scalar product divided by both lengths. Its square is rational, so only one root is rounded.
    size = dot(normal, normal) * dot(direction, direction)
    if not size:
        return Fraction(1)
    value = dot(normal, direction)
    cosine = root(value * value / size)
    return (1 + (cosine if value > 0 else -cosine)) / 2


def eye_of(texts: Sequence[str]) -> tuple[Fraction, ...]:
    """Return the direction of view given by three decimal numbers as text. Raise ExportError if it is invalid."""
    if len(texts) != 3:
        raise ExportError(f"the direction of view: expected 3 numbers X,Y,Z, found {len(texts)}")
    numbers = []
    for text in texts:
        try:
            numbers.append(number(text))
        except ValueError:
            raise ExportError(f"the direction of view: {quoted(text)} is not a number") from None
    return tuple(numbers)

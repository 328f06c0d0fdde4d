"""A hull as vertices and polygons: what every mesh format is written from, and what a drawing shows."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

from emulator.errors import EmulatorError
from modern.geometry.hull import Hull
from modern.geometry.numbers import Point, coordinates, decimal_text, number
from modern.geometry.vectors import Vector, area_vector, dot

Triangle = tuple[int, int, int]


class ExportError(EmulatorError):
    """A hull that cannot be written in the format asked for, or not drawn as asked; one line."""


@dataclass(frozen=True, slots=True)
class Mesh:
    """The surface of a hull.  ``points`` are its vertices in the order of ``Hull.vertices``, as exact text.

    ``faces`` name them by place, from 0: of a polyhedron its faces, of a polygon one face, else none; each
    counterclockwise seen from outside (of a polygon from where its plane's A, B, C point to).
    """

    dimension: int
    points: tuple[Point, ...]
    faces: tuple[tuple[int, ...], ...]

    def numbers(self) -> tuple[Vector, ...]:
        """The points as fractions."""
        return tuple(coordinates(point) for point in self.points)

    def decimals(self, digits: int | None) -> tuple[str, ...]:
        """The points as lines ``x y z`` of exact decimals; see ``decimal_text``.  Raises ExportError."""
        lines = []
        for place, point in enumerate(self.points, 1):
            texts = []
            for axis, text in zip("xyz", point, strict=True):
                try:
                    texts.append(decimal_text(text, digits))
                except ValueError as error:
                    raise ExportError(f"vertex {place}, {axis}: {error}") from None
            lines.append(" ".join(texts))
        return tuple(lines)

    def edges(self) -> tuple[tuple[int, int], ...]:
        """Every edge once, the smaller place first, sorted; of a segment its one."""
        if self.dimension == 1:
            return ((0, 1),)
        return tuple(sorted({(min(a, b), max(a, b)) for face in self.faces for a, b in sides(face)}))

    def planes(self, hull: Hull) -> Iterator[tuple[Fraction, Fraction, Fraction, Fraction]]:
        """A, B, C, D of each face's plane, the normal outward: of a polyhedron the hull's own equations."""
        points = self.numbers()
        for order, polygon in enumerate(self.faces):
            if self.dimension == 3:
                a, b, c, d = map(Fraction, hull.faces[order].coefficients)
            else:
                a, b, c = area_vector(points, polygon)
                d = -dot((a, b, c), points[polygon[0]])
            yield a, b, c, d

    def squared_areas(self) -> tuple[Fraction, ...]:
        """The square of each face's area."""
        points = self.numbers()
        normals = (area_vector(points, face) for face in self.faces)
        return tuple(dot(normal, normal) / 4 for normal in normals)

    @property
    def closed(self) -> bool:
        """Whether every edge lies between two faces, which run along it in opposite ways."""
        edges = [edge for face in self.faces for edge in sides(face)]
        known = set(edges)
        return len(known) == len(edges) and all((b, a) in known for a, b in edges)

    def triangles(self) -> tuple[Triangle, ...]:
        """The faces cut into triangles, each from its first vertex."""
        return tuple((face[0], face[k], face[k + 1]) for face in self.faces for k in range(1, len(face) - 1))


def mesh(hull: Hull) -> Mesh:
    """The surface of a hull.  Raises ExportError where none was determined or its polygons do not fit together."""
    if not hull.determined:
        raise ExportError(f"there is no hull: {hull.status}")
    wanted = {0: 1, 1: 2}.get(hull.dimension)
    if wanted is not None and len(hull.vertices) != wanted:
        raise ExportError(f"a hull of dimension {hull.dimension} has {wanted} vertices, not {len(hull.vertices)}")
    places = {index: place for place, index in enumerate(hull.vertices)}
    points = tuple(hull.points[index] for index in hull.vertices)
    polygons = []
    for order, face in enumerate(hull.faces if hull.dimension > 1 else (), 1):
        strange = [index for index in face.polygon if index not in places]
        if strange:
            raise ExportError(f"face {order} names point {strange[0] + 1}, which is no vertex")
        polygons.append(tuple(places[index] for index in face.polygon))
    if hull.dimension == 2:
        # Program 1 punches no supporting lines for a triangle; it needs none.
        polygons = [_cycle(polygons, len(points)) if polygons or len(points) != 3 else (0, 1, 2)]
        if hull.plane is not None:
            polygons = [_turned(polygons[0], tuple(coordinates(p) for p in points), hull.plane)]
    elif hull.dimension == 3 and not polygons:
        raise ExportError("the polyhedron has no faces")
    elif any(len(polygon) < 3 for polygon in polygons):
        raise ExportError("a face has fewer than three vertices")
    return Mesh(hull.dimension, points, tuple(polygons))


def sides(face: Sequence[int]) -> Iterator[tuple[int, int]]:
    """The directed edges of a face."""
    return zip(face, (*face[1:], face[0]), strict=True)


def _cycle(lines: list[tuple[int, ...]], count: int) -> tuple[int, ...]:
    """The polygon that ``lines``, pairs of vertices, make up, from vertex 0 on."""
    beside: list[list[int]] = [[] for _ in range(count)]
    for line in lines:
        if len(line) != 2:
            raise ExportError("a line of the polygon does not join two vertices")
        beside[line[0]].append(line[1])
        beside[line[1]].append(line[0])
    way = [0]
    while all(len(pair) == 2 for pair in beside) and len(way) <= count:
        ahead = beside[way[-1]]
        step = ahead[0] if len(way) == 1 or ahead[0] != way[-2] else ahead[1]
        if step == 0:
            break
        way.append(step)
    if len(way) != count or count < 3 or len(set(way)) != count:
        raise ExportError("the lines of the polygon do not close to one polygon")
    return tuple(way)


def _turned(face: tuple[int, ...], points: tuple[Vector, ...], plane: tuple[str, ...]) -> tuple[int, ...]:
    """The face counterclockwise seen from where the plane's A, B, C point to."""
    normal = (number(plane[0]), number(plane[1]), number(plane[2]))
    return face if dot(area_vector(points, face), normal) >= 0 else (face[0], *face[:0:-1])

"""The surface of a hull as vertices and polygons, for mesh formats and drawings."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import chain, repeat
from typing import TypeVar

from emulator.errors import EmulatorError
from modern.geometry.hull import Hull, LazyMembers, polygons_of
from modern.geometry.numbers import Point, coordinates, decimal_text
from modern.geometry.vectors import Vector, area_vector, dot

T = TypeVar("T")
Triangle = tuple[int, int, int]


class ExportError(EmulatorError):
    """Raised if a file format cannot hold a hull, or if a hull cannot be drawn.  The message is one line."""


@dataclass(frozen=True, slots=True)
class Mesh:
    """The surface of a hull.

    points: the vertices in the order of ``Hull.vertices``, as exact text, which may be computed on access.
    faces: for each face the indices of its vertices in ``points``, counterclockwise seen from outside.  The face of a
        polygon is counterclockwise seen from the side to which (A, B, C) of its plane points.  A segment or a point has
        no faces.
    """

    dimension: int
    points: Sequence[Point]
    faces: tuple[tuple[int, ...], ...]

    def numbers(self) -> tuple[Vector, ...]:
        return tuple(coordinates(point) for point in self.points)

    def decimals(self, digits: int | None) -> tuple[str, ...]:
        """Return each point as a text ``x y z`` of decimals, rounded to ``digits`` digits if necessary."""
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
        """Return every edge once, with the smaller index first, in sorted order.  A segment has one edge."""
        if self.dimension == 1:
            return ((0, 1),)
        return tuple(sorted({(min(a, b), max(a, b)) for face in self.faces for a, b in sides(face)}))

    def planes(self, hull: Hull) -> Iterator[tuple[Fraction, Fraction, Fraction, Fraction]]:
        """Yield the plane A x + B y + C z + D = 0 of each face, with its normal pointing outward."""
        points = self.numbers()
        for order, polygon in enumerate(self.faces):
            if self.dimension == 3:
                a, b, c, d = map(Fraction, hull.faces[order].lowest)
            else:
                a, b, c = area_vector(points, polygon)
                d = -dot((a, b, c), points[polygon[0]])
            yield a, b, c, d

    def squared_areas(self) -> tuple[Fraction, ...]:
        """Return the square of each face's area.  The square is always rational, but the area may be irrational."""
        points = self.numbers()
        normals = (area_vector(points, face) for face in self.faces)
        return tuple(dot(normal, normal) / 4 for normal in normals)

    @property
    def closed(self) -> bool:
        """True if every edge belongs to exactly two faces, which traverse it in opposite directions."""
        edges = [edge for face in self.faces for edge in sides(face)]
        known = set(edges)
        return len(known) == len(edges) and all((b, a) in known for a, b in edges)

    def triangles(self) -> tuple[Triangle, ...]:
        """Return the faces divided into triangles, all from the first vertex of the face."""
        fans = ([face] if len(face) == 3 else zip(repeat(face[0]), face[1:-1], face[2:]) for face in self.faces)
        return tuple(chain.from_iterable(fans))


def mesh(hull: Hull) -> Mesh:
    """Return the surface of a hull.  Raise ExportError if the hull was not determined or its polygons do not close."""
    if not hull.determined:
        raise ExportError(f"there is no hull: {hull.status}")
    expected = {0: 1, 1: 2}.get(hull.dimension)
    if expected is not None and len(hull.vertices) != expected:
        raise ExportError(f"a hull of dimension {hull.dimension} has {expected} vertices, not {len(hull.vertices)}")
    new_indices = {index: new for new, index in enumerate(hull.vertices)}
    points = LazyMembers(len(hull.vertices), lambda place: hull.points[hull.vertices[place]])
    cycles = polygons_of(hull.faces) if hull.dimension > 1 else ()
    try:
        polygons = [tuple(map(new_indices.__getitem__, cycle)) for cycle in cycles]
    except KeyError as error:
        order = next(order for order, cycle in enumerate(cycles, 1) if error.args[0] in cycle)
        raise ExportError(f"face {order} names point {error.args[0] + 1}, which is not a vertex") from None
    if hull.dimension == 2:
        # Program 1 finds the hull of exactly three points without program 2, and punches no supporting lines for it.
        polygons = [_cycle(polygons, len(points)) if polygons or len(points) != 3 else (0, 1, 2)]
        if hull.plane is not None:
            polygons = [_turned(polygons[0], [coordinates(p) for p in points], hull.plane)]
    elif hull.dimension == 3 and not polygons:
        raise ExportError("the polyhedron has no faces")
    elif min(map(len, polygons), default=3) < 3:
        raise ExportError("a face has fewer than three vertices")
    return Mesh(hull.dimension, points, tuple(polygons))


def sides(face: Sequence[T]) -> Iterator[tuple[T, T]]:
    """Yield the edges of a face as pairs of vertices, in the face's order."""
    return zip(face, (*face[1:], face[0]), strict=True)


def cycle_of(successors: Mapping[int, int]) -> list[int]:
    """Return the only cycle of a mapping from each vertex to the next, beginning with its smallest vertex."""
    cycle = [min(successors)]
    while successors[cycle[-1]] != cycle[0]:
        cycle.append(successors[cycle[-1]])
    return cycle


def _cycle(lines: list[tuple[int, ...]], count: int) -> tuple[int, ...]:
    neighbours: list[list[int]] = [[] for _ in range(count)]
    for line in lines:
        if len(line) != 2:
            raise ExportError("a line of the polygon does not join two vertices")
        neighbours[line[0]].append(line[1])
        neighbours[line[1]].append(line[0])
    cycle = [0]
    while all(len(pair) == 2 for pair in neighbours) and len(cycle) <= count:
        a, b = neighbours[cycle[-1]]
        following = a if len(cycle) == 1 or a != cycle[-2] else b
        if following == 0:
            break
        cycle.append(following)
    if len(cycle) != count or count < 3 or len(set(cycle)) != count:
        raise ExportError("the lines of the polygon do not form one closed polygon")
    return tuple(cycle)


def _turned(face: tuple[int, ...], points: Sequence[Vector], plane: tuple[str, ...]) -> tuple[int, ...]:
    """Return the face counterclockwise seen from the side to which the normal (A, B, C) of ``plane`` points."""
    normal = coordinates(plane[:3])
    return face if dot(area_vector(points, face), normal) >= 0 else (face[0], *face[:0:-1])

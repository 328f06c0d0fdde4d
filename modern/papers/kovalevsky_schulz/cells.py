"""The two-dimensional cell list: vertices, edges and faces of a polyhedron's surface, each naming its neighbours.

Tables 1 to 3 of the paper fix the form; all numbers count from 1, as there.  ``CellList`` is the redundant list,
``Economical`` what is left of it when only the coordinates and the vertices of each face are kept; ``expanded`` makes
the first from the second.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from emulator.errors import EmulatorError
from modern.geometry.mesh import sides
from modern.geometry.vectors import cross, minus

IntPoint = tuple[int, int, int]
Plane = tuple[int, int, int, int]
_BLOCK = 1 << 18


class CellListError(EmulatorError):
    """A list of cells that is not the surface of a convex polyhedron; the message names vertex or face, from 1."""


@dataclass(frozen=True, slots=True)
class Vertex:
    """A 0-cell (Table 1).

    ``edges``: the edges at it in order of their numbers, -e where edge e starts here and +e where it ends here.
    """

    point: IntPoint
    edges: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Edge:
    """A 1-cell (Table 2): its two vertices, and the faces on its left and right.

    Left and right are those of one who stands outside and looks from ``start`` to ``end``.
    """

    start: int
    end: int
    left: int
    right: int


@dataclass(frozen=True, slots=True)
class Face:
    """A 2-cell (Table 3): pairs (P, L) counterclockwise seen from outside; edge L leads from P to the next pair's P.

    L is positive where the edge is followed from its start to its end, so that the face is on its left.
    """

    pairs: tuple[tuple[int, int], ...]

    @property
    def vertices(self) -> tuple[int, ...]:
        return tuple(vertex for vertex, _ in self.pairs)


@dataclass(frozen=True, slots=True)
class Economical:
    """The economical encoding: coordinates of the vertices, and the vertices of each face by number from 1.

    The cycles run counterclockwise seen from outside.
    """

    points: tuple[IntPoint, ...]
    faces: tuple[tuple[int, ...], ...]

    def integers(self) -> tuple[int, ...]:
        """The encoding as a row of numbers: how many vertices and faces; x, y, z of each vertex; n and n vertices of
        each face."""
        head = (len(self.points), len(self.faces))
        coordinates = (number for point in self.points for number in point)
        return (*head, *coordinates, *(number for face in self.faces for number in (len(face), *face)))


@dataclass(frozen=True, slots=True)
class CellList:
    """The redundant cell list of a polyhedron's surface."""

    vertices: tuple[Vertex, ...]
    edges: tuple[Edge, ...]
    faces: tuple[Face, ...]

    @property
    def points(self) -> tuple[IntPoint, ...]:
        """The coordinates of the vertices, in their order."""
        return tuple(vertex.point for vertex in self.vertices)

    def economical(self) -> Economical:
        """The list without what can be found again: the edges, and the edges named by vertices and faces."""
        return Economical(self.points, tuple(face.vertices for face in self.faces))

    def planes(self) -> tuple[Plane, ...]:
        """The plane of every face in lowest terms: H(x, y, z) = a x + b y + c z + d is at most 0 in the polyhedron."""
        points = self.points
        return tuple(plane_of([points[number - 1] for number in face.vertices]) for face in self.faces)


def plane_of(polygon: Sequence[IntPoint]) -> Plane:
    """The plane of a plane polygon in lowest terms, outward where the polygon is counterclockwise seen from outside.

    Vertices in line with their neighbours do no harm.  Raises CellListError for a polygon without area.
    """
    origin = polygon[0]
    arms = [minus(point, origin) for point in polygon[1:]]
    parts = [cross(one, other) for one, other in pairwise(arms)]
    a, b, c = (sum(column) for column in zip(*parts, strict=True))
    divisor = math.gcd(a, b, c)
    if not divisor:
        raise CellListError("a face has no area")
    a, b, c = a // divisor, b // divisor, c // divisor
    return a, b, c, -(a * origin[0] + b * origin[1] + c * origin[2])


def assembled(
    points: Mapping[int, IntPoint], ends: Mapping[int, tuple[int, int]], cycles: Iterable[Sequence[int]]
) -> CellList:
    """A cell list from faces as cycles of signed edges: everything is numbered anew, without gaps and in order.

    points: coordinates by vertex; ends: start and end by edge; cycles: of each face its edges as ``Face.pairs`` has
    them.  A face's first pair becomes that of its vertex of lowest number.
    """
    vertex_numbers = {old: new for new, old in enumerate(sorted(points), 1)}
    edge_numbers = {old: new for new, old in enumerate(sorted(ends), 1)}
    around: dict[int, list[int]] = {number: [] for number in vertex_numbers.values()}
    pairs_of_ends = []
    for old, edge in edge_numbers.items():
        start, end = (vertex_numbers[vertex] for vertex in ends[old])
        around[start].append(-edge)
        around[end].append(edge)
        pairs_of_ends.append((start, end))
    sides: dict[int, int] = {}
    faces = []
    for face, cycle in enumerate(cycles, 1):
        signed = [edge_numbers[edge] if edge > 0 else -edge_numbers[-edge] for edge in cycle]
        sides.update((edge, face) for edge in signed)
        pairs = [(pairs_of_ends[abs(edge) - 1][edge < 0], edge) for edge in signed]
        first = pairs.index(min(pairs))
        faces.append(Face((*pairs[first:], *pairs[:first])))
    return CellList(
        tuple(Vertex(points[old], tuple(around[new])) for old, new in vertex_numbers.items()),
        tuple(Edge(start, end, sides[edge], sides[-edge]) for edge, (start, end) in enumerate(pairs_of_ends, 1)),
        tuple(faces),
    )


def expanded(encoding: Economical) -> CellList:
    """The redundant cell list from the economical encoding.

    The edges are numbered as the faces, one after another, first come along them, and start where they are first
    left.  Raises CellListError for what is not the surface of a convex polyhedron.
    """
    points, faces = encoding.points, encoding.faces
    known: dict[tuple[int, int], int] = {}
    ends: dict[int, tuple[int, int]] = {}
    cycles = []
    for number, face in enumerate(faces, 1):
        if len(set(face)) != len(face) or len(face) < 3:
            raise CellListError(f"face {number}: it has fewer than three vertices, or one of them twice")
        cycle = []
        for start, end in sides(face):
            if not 1 <= start <= len(points):
                raise CellListError(f"face {number}: there is no vertex {start}")
            if (start, end) in known:
                edge = known.pop((start, end))
            else:
                edge = len(ends) + 1
                ends[edge] = (start, end)
                known[end, start] = -edge
            cycle.append(edge)
        cycles.append(cycle)
    if known:
        end, start = next(iter(known))
        raise CellListError(f"the edge from vertex {start} to {end} has a face on one side only")
    unused = set(range(1, len(points) + 1)).difference(*faces)
    if unused:
        raise CellListError(f"vertex {min(unused)}: no face has it")
    if len(points) - len(ends) + len(faces) != 2:
        raise CellListError(f"{len(points)} vertices, {len(ends)} edges and {len(faces)} faces make no polyhedron")
    cells = assembled(dict(enumerate(points, 1)), ends, cycles)
    _check_convex(cells)
    return cells


def decoded(numbers: Iterable[int]) -> Economical:
    """The economical encoding from its row of numbers.  Raises CellListError where the row ends early or late."""
    row = iter(numbers)
    vertices, faces = _taken(row, 2)
    points = [_taken(row, 3) for _ in range(vertices)]
    cycles = []
    for _ in range(faces):
        (size,) = _taken(row, 1)
        cycles.append(tuple(_taken(row, size)))
    if next(row, None) is not None:
        raise CellListError("numbers are left over after the last face")
    return Economical(tuple((x, y, z) for x, y, z in points), tuple(cycles))


def _taken(row: Iterator[int], count: int) -> list[int]:
    found = [number for _, number in zip(range(count), row, strict=False)]
    if len(found) < count or count < 0:
        raise CellListError("the row of numbers ends before its last face")
    return found


def _check_convex(cells: CellList) -> None:
    """Definition CP: no vertex outside of a face's plane; and each face's vertices in its plane."""
    planes = cells.planes()
    reach = max(1, *(abs(number) for point in cells.points for number in point))
    kind = np.int64 if sum(max(abs(plane[k]) for plane in planes) for k in range(4)) * reach < 2**62 else object
    columns = np.array([(*point, 1) for point in cells.points], dtype=kind).T
    step = max(1, _BLOCK // len(cells.points))
    for first in range(0, len(planes), step):
        values = np.array(planes[first : first + step], dtype=kind) @ columns
        outside = np.argwhere(values > 0)
        if len(outside):
            plane, place = (int(number) + 1 for number in outside[0])
            raise CellListError(f"face {first + plane}: vertex {place} lies outside of its plane")
        for number, (row, face) in enumerate(zip(values, cells.faces[first:], strict=False), first + 1):
            if any(row[[vertex - 1 for vertex in face.vertices]]):
                raise CellListError(f"face {number}: its vertices do not lie in one plane")

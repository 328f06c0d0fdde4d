"""A literal version of Kovalevsky and Schulz's procedure, which compares every point with the plane of every face.

The tests compare :mod:`modern.papers.kovalevsky_schulz.polyhedron` with it.  It has other data structures and finds the
first visible face in another way, but makes the same decisions.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from modern.geometry.vectors import cross, dot, minus
from modern.papers.kovalevsky_schulz.cells import CellList, Edge, Face, IntPoint, Vertex
from modern.papers.kovalevsky_schulz.polyhedron import INVISIBLE, Coplanar, independent

_HIDDEN = (0, 0, 0, -1)
"""A plane that no point sees, for the rows of removed faces."""


def assembled(
    points: Mapping[int, IntPoint], ends: Mapping[int, tuple[int, int]], cycles: Iterable[Sequence[int]]
) -> CellList:
    """Return a cell list of faces that are cycles of signed edges, numbered again in order and without gaps.

    points: the coordinates of each vertex.  ends: start and end of each edge.  cycles: the edges of each face as in
    ``Face.pairs``.  The first pair of a face becomes that of its vertex with the lowest number.
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


class Planes:
    """The planes of the faces as rows of an array, so that one product shows which faces a point sees."""

    def __init__(self, points: Sequence[IntPoint]) -> None:
        columns = list(zip(*points, strict=True))
        self.low = [min(column) for column in columns]
        reach = max(max(column) - least for column, least in zip(columns, self.low, strict=True))
        # Relative to the lowest corner of the bounding box, the components of a normal are at most 2 reach^2, and each
        # of the four terms of a plane's value at most 6 reach^3.
        self.dtype: Any = np.int64 if 24 * reach**3 < 2**63 else object
        self.rows: NDArray[Any] = np.empty((64, 4), dtype=self.dtype)
        self.rows[:] = _HIDDEN
        self.faces: list[int] = []
        self.free: list[int] = []

    def add(self, face: int, p: IntPoint, q: IntPoint, r: IntPoint) -> int:
        """Add the plane of three points, counterclockwise seen from outside, and return its row."""
        normal = cross(minus(q, p), minus(r, p))
        if self.free:
            row = self.free.pop()
            self.faces[row] = face
        else:
            row = len(self.faces)
            self.faces.append(face)
            if row == len(self.rows):
                extension = np.empty_like(self.rows)
                extension[:] = _HIDDEN
                self.rows = np.concatenate((self.rows, extension))
        self.rows[row] = (*normal, -dot(normal, self._moved(p)))
        return row

    def remove(self, row: int) -> None:
        self.rows[row] = _HIDDEN
        self.free.append(row)

    def visible(self, p: IntPoint, coplanar: Coplanar) -> list[int]:
        """Return the numbers of the faces visible from ``p`` (Definition VI), sorted.

        ``coplanar`` determines whether a face whose plane contains ``p`` is visible.
        """
        values = self.rows @ np.array((*self._moved(p), 1), dtype=self.dtype)
        visible = values > 0 if coplanar == INVISIBLE else values >= 0
        return sorted(self.faces[row] for row in np.flatnonzero(visible).tolist())

    def _moved(self, p: IntPoint) -> IntPoint:
        return p[0] - self.low[0], p[1] - self.low[1], p[2] - self.low[2]


class CurrentPolyhedron:
    """The paper's CP, a polyhedron that changes in place: vertices, edges and triangles by number.

    points: all points; the number of a vertex is its index.  around: the edges at each vertex.  ends: start and end of
    each edge.  sides: the face on the left of edge e is sides[e], that on its right sides[-e].  cycles: the signed
    edges of each face.
    """

    def __init__(self, points: Sequence[IntPoint], simplex: Sequence[int]) -> None:
        """Begin with the tetrahedron of four points that are not coplanar."""
        self.points = points
        self.planes = Planes(points)
        self.around: dict[int, set[int]] = {}
        self.ends: dict[int, tuple[int, int]] = {}
        self.sides: dict[int, int] = {}
        self.cycles: dict[int, tuple[int, int, int]] = {}
        self.row: dict[int, int] = {}
        self._edges = self._faces = 0
        a, b, c, d = simplex
        base = [points[number] for number in (a, b, c)]
        if dot(cross(minus(base[1], base[0]), minus(base[2], base[0])), minus(points[d], base[0])) > 0:
            b, c = c, b
        first, second, third = self._edge(a, b), self._edge(b, c), self._edge(c, a)
        self._face(a, (first, second, third))
        self._cone(d, (-first, -second, -third))

    def extend(self, number: int, coplanar: Coplanar) -> bool:
        """Insert a point if it sees a face, and return True if it became a vertex.

        Remove the visible faces, the edges between two of them and the vertices that have no other face.  Join every
        edge of their boundary to the point by a triangle.
        """
        visible = self.planes.visible(self.points[number], coplanar)
        if not visible:
            return False
        going = set(visible)
        boundary: list[int] = []
        inner: set[int] = set()
        for face in visible:
            for edge in self.cycles[face]:
                if self.sides[-edge] in going:
                    inner.add(abs(edge))
                else:
                    boundary.append(edge)
            del self.cycles[face]
            self.planes.remove(self.row.pop(face))
        for edge in inner:
            for vertex in self.ends.pop(edge):
                self.around[vertex].discard(edge)
                if not self.around[vertex]:
                    del self.around[vertex]
            del self.sides[edge], self.sides[-edge]
        self._cone(number, boundary)
        return True

    def cell_list(self) -> CellList:
        """Return the cell list of the current surface, with vertices in the order of the points."""
        return assembled(
            {vertex: self.points[vertex] for vertex in self.around},
            self.ends,
            (self.cycles[face] for face in sorted(self.cycles)),
        )

    def _cone(self, top: int, boundary: Iterable[int]) -> None:
        """Add a triangle from ``top`` over every signed edge, in the direction in which the new face traverses it."""
        spokes: dict[int, int] = {}
        for edge in boundary:
            near, far = self.ends[abs(edge)][:: 1 if edge > 0 else -1]
            if near not in spokes:
                spokes[near] = self._edge(top, near)
            if far not in spokes:
                spokes[far] = -self._edge(far, top)
            self._face(top, (spokes[near], edge, -spokes[far]))

    def _edge(self, start: int, end: int) -> int:
        self._edges += 1
        self.ends[self._edges] = (start, end)
        for vertex in (start, end):
            self.around.setdefault(vertex, set()).add(self._edges)
        return self._edges

    def _face(self, first: int, cycle: tuple[int, int, int]) -> None:
        self._faces += 1
        self.cycles[self._faces] = cycle
        for edge in cycle:
            self.sides[edge] = self._faces
        second, third = (self.ends[abs(edge)][edge > 0] for edge in cycle[:2])
        corners = (self.points[first], self.points[second], self.points[third])
        self.row[self._faces] = self.planes.add(self._faces, *corners)


def by_search(points: Iterable[Sequence[int]], coplanar: Coplanar) -> CellList | None:
    """Return the cell list of triangles of points inserted in their order, or None if all are coplanar."""
    distinct = list(dict.fromkeys((int(x), int(y), int(z)) for x, y, z in points))
    simplex = independent(distinct)
    if len(simplex) < 4:
        return None
    polyhedron = CurrentPolyhedron(distinct, simplex)
    for number in range(len(distinct)):
        if number not in simplex:
            polyhedron.extend(number, coplanar)
    return polyhedron.cell_list()

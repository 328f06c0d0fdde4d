"""The current polyhedron and its extension by one local corner after another (section 2, Figs. 5 to 7).

The surface is kept as a cell list whose edges name their faces, so that the boundary of what a point sees is found
without a search.  All arithmetic is in integers: int64 where the coordinates' range proves that it suffices, Python's
else.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Final, Literal

import numpy as np
from numpy.typing import NDArray

from modern.exact_hull import exact_hull
from modern.geometry.vectors import cross, dot, minus
from modern.papers.kovalevsky_schulz.cells import CellList, IntPoint, assembled

Coplanar = Literal["visible", "invisible"]
"""What a face in one plane with a new point counts as."""
VISIBLE: Final = "visible"
INVISIBLE: Final = "invisible"
_KINDS = ("point", "segment", "polygon")
_HIDDEN = (0, 0, 0, -1)
"""A plane that no point sees, in the places of removed faces."""


@dataclass(frozen=True, slots=True)
class Flat:
    """The hull of points in one plane, where there is no polyhedron and no cell list.

    ``dimension``: 0, 1 or 2.  ``vertices``: the point, the segment's ends, or the polygon's corners in cyclic order.
    """

    dimension: int
    vertices: tuple[IntPoint, ...]

    @property
    def kind(self) -> str:
        """``point``, ``segment`` or ``polygon``."""
        return _KINDS[self.dimension]


class Planes:
    """The planes of the faces as rows of an array, so that one product tells which faces a point sees."""

    def __init__(self, points: Sequence[IntPoint]) -> None:
        columns = list(zip(*points, strict=True))
        self.low = [min(column) for column in columns]
        reach = max(max(column) - least for column, least in zip(columns, self.low, strict=True))
        # Seen from the lowest corner of the points' box, a normal's components are at most 2 reach^2 and each of the
        # four terms of a plane's value at most 6 reach^3.
        self.dtype: Any = np.int64 if 24 * reach**3 < 2**63 else object
        self.rows: NDArray[Any] = np.empty((64, 4), dtype=self.dtype)
        self.rows[:] = _HIDDEN
        self.faces: list[int] = []
        self.free: list[int] = []

    def add(self, face: int, p: IntPoint, q: IntPoint, r: IntPoint) -> int:
        """Keep the plane of a face, three points counterclockwise seen from outside; returns its row."""
        normal = cross(minus(q, p), minus(r, p))
        if self.free:
            row = self.free.pop()
            self.faces[row] = face
        else:
            row = len(self.faces)
            self.faces.append(face)
            if row == len(self.rows):
                more = np.empty_like(self.rows)
                more[:] = _HIDDEN
                self.rows = np.concatenate((self.rows, more))
        self.rows[row] = (*normal, -dot(normal, self._moved(p)))
        return row

    def remove(self, row: int) -> None:
        self.rows[row] = _HIDDEN
        self.free.append(row)

    def seen(self, p: IntPoint, coplanar: Coplanar) -> list[int]:
        """The numbers of the faces visible from ``p`` (Definition VI), in order; coplanar ones as one is told."""
        values = self.rows @ np.array((*self._moved(p), 1), dtype=self.dtype)
        visible = values > 0 if coplanar == INVISIBLE else values >= 0
        return sorted(self.faces[row] for row in np.flatnonzero(visible).tolist())

    def _moved(self, p: IntPoint) -> IntPoint:
        return p[0] - self.low[0], p[1] - self.low[1], p[2] - self.low[2]


class CurrentPolyhedron:
    """The paper's CP: vertices, edges and triangles by number, changed in place.

    points: all that may become vertices, a vertex's number is its place from 0.  around: the edges at a vertex.
    ends: start and end of an edge.  sides: the face on the left of edge e is sides[e], on its right sides[-e].
    cycles: of a face its signed edges.
    """

    def __init__(self, points: Sequence[IntPoint], simplex: Sequence[int]) -> None:
        """The tetrahedron of four points that lie in no plane."""
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
        """Take a further point in, if it sees a face; returns whether it became a vertex.

        The visible faces go, with the edges between two of them and the vertices that have no other face; every edge
        of their boundary is joined to the point by a triangle.
        """
        visible = self.planes.seen(self.points[number], coplanar)
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
        """The cell list of the surface as it is: vertices in the order of the points, edges and faces as made."""
        return assembled(
            {vertex: self.points[vertex] for vertex in self.around},
            self.ends,
            (self.cycles[face] for face in sorted(self.cycles)),
        )

    def _cone(self, top: int, boundary: Iterable[int]) -> None:
        """A triangle from ``top`` over every signed edge, each in the sense in which its new face follows it."""
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


def convex_polyhedron(points: Iterable[Sequence[int]], coplanar: Coplanar = VISIBLE) -> CellList | Flat:
    """The convex hull of points with whole coordinates, as triangles, inserting the points in the order given.

    coplanar: whether a face whose plane holds a point counts as ``visible`` from it, as the paper decides, or
    ``invisible``, as its figure of 1404 triangles needs.  Points that are given before are passed over.  For points in
    one plane, of which the paper does not speak, the answer is ``Flat``, its vertices found by ``modern.exact_hull``.
    Raises ValueError for no points and for another ``coplanar``.
    """
    if coplanar not in (VISIBLE, INVISIBLE):
        raise ValueError(f"coplanar faces are {VISIBLE} or {INVISIBLE}, not {coplanar!r}")
    distinct = list(dict.fromkeys((int(x), int(y), int(z)) for x, y, z in points))
    if not distinct:
        raise ValueError("there are no points")
    simplex = independent(distinct)
    if len(simplex) < 4:
        flat = exact_hull(distinct)
        return Flat(flat.dimension, tuple(distinct[number] for number in flat.polygon or flat.vertices))
    polyhedron = CurrentPolyhedron(distinct, simplex)
    used = set(simplex)
    for number in range(len(distinct)):
        if number not in used:
            polyhedron.extend(number, coplanar)
    return polyhedron.cell_list()


def independent(points: Sequence[IntPoint]) -> list[int]:
    """The first four points that lie in no plane, or fewer where there are none."""
    found = [0]
    normal: IntPoint = (0, 0, 0)
    for number in range(1, len(points)):
        arm = minus(points[number], points[0])
        if len(found) == 1:
            found.append(number)
        elif len(found) == 2:
            normal = cross(minus(points[found[1]], points[0]), arm)
            if any(normal):
                found.append(number)
        elif dot(normal, arm):
            return [*found, number]
    return found

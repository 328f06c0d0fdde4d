"""The current polyhedron and its extension by one local corner after another (section 2, Figs. 5 to 7).

The surface is kept as edges that name their faces, so that what a point sees, and its boundary, are found from one
face that it sees, without a search.  All arithmetic is in integers of any length.

Where the first face is found.  The faces that a point sees are connected through edges, also where a face counts as
seen whose plane holds the point: such a face, or others of its plane, borders on one that sees the point from above,
or else the point lies in that plane's face itself.

1. Points in raster order: a point further in that order than all vertices sees a face at the last of these, V.
   Else the point would be in the cone of the faces at V, and V + t (P - V) with a small t in the polyhedron, further
   than V.  The faces at V are those made last.  (Only points in the plane of the first, which wait for a fourth point,
   may be found by a search of all faces.)
2. Points in another order: every point that waits keeps one face that it sees, every face a list of these points.
   Where faces go, the points of their lists are tried against the new ones and against no others.  Let P see a face
   that goes, m be a point within it, and P still see a face.  The way from P to m meets the new surface first at a
   point x of a face that P sees.  If that one is not new, x was in the polyhedron before.  But of that the way, in the
   plane of m's face or above, meets only faces of this plane, which all go together: x lies on an edge between them and
   the face that stays, hence on a boundary edge and in a new face, and P sees this one too.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
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
_MANY = 128
"""Points times faces from which on values are computed in one product."""
Triangle = tuple[int, int, int, int, int, int, int]
"""Three signed edges, and the plane: four numbers, positive outside."""


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


class CurrentPolyhedron:
    """The paper's CP: edges and triangles by number, in the order in which they are made, changed in place.

    points: all that may become vertices, a vertex's number is its place from 0; moved: from the lowest corner of their
    box.  ends: start and end of an edge.  sides: the face on the left of edge e is sides[e], on its right sides[-e].
    least: the least value of its plane at which a face is seen.  made: the number of the last face; new: of the first
    of those made together with it.
    """

    def __init__(self, points: Sequence[IntPoint], simplex: Sequence[int], coplanar: Coplanar) -> None:
        """The tetrahedron of four points that lie in no plane."""
        self.points = points
        low = [min(column) for column in zip(*points, strict=True)]
        self.moved = [(x - low[0], y - low[1], z - low[2]) for x, y, z in points]
        self.least = 0 if coplanar == VISIBLE else 1
        self.ends: dict[int, tuple[int, int]] = {}
        self.sides: dict[int, int] = {}
        self.faces: dict[int, Triangle] = {}
        self.edges = self.made = self.new = 0
        a, b, c, d = simplex
        base = [points[number] for number in (a, b, c)]
        if dot(cross(minus(base[1], base[0]), minus(base[2], base[0])), minus(points[d], base[0])) > 0:
            b, c = c, b
        first, second, third = self._edge(a, b), self._edge(b, c), self._edge(c, a)
        self._face(first, second, third, a, b, c)
        self._cone(d, (-first, -second, -third))
        self.new = 1

    def first_seen(self, number: int) -> int:
        """A face that the point sees, one of those made last if it can be; 0 where there is none."""
        x, y, z = self.moved[number]
        last = range(self.new, self.made + 1)
        for chosen in (last, self.faces):
            for face in chosen:
                _, _, _, a, b, c, d = self.faces[face]
                if a * x + b * y + c * z + d >= self.least:
                    return face
        return 0

    def extend(self, number: int, first: int) -> list[int]:
        """Take in a point that sees the face ``first``; returns the faces that are no more.

        The visible faces go, with the edges between two of them and the vertices that have no other face; every edge
        of their boundary is joined to the point by a triangle.
        """
        visible = self._visible(number, first)
        going = set(visible)
        faces, sides, ends = self.faces, self.sides, self.ends
        boundary: list[int] = []
        inner: list[int] = []
        for face in visible:
            for edge in faces.pop(face)[:3]:
                if sides[-edge] not in going:
                    boundary.append(edge)
                elif edge > 0:
                    inner.append(edge)
        for edge in inner:
            del ends[edge], sides[edge], sides[-edge]
        self.new = self.made + 1
        self._cone(number, boundary)
        return visible

    def _visible(self, number: int, first: int) -> list[int]:
        """The numbers of the faces visible from a point (Definition VI), in order; one is known to be."""
        x, y, z = self.moved[number]
        faces, sides, least = self.faces, self.sides, self.least
        found, known = [first], {first}
        for face in found:
            for edge in faces[face][:3]:
                beyond = sides[-edge]
                if beyond not in known:
                    known.add(beyond)
                    _, _, _, a, b, c, d = faces[beyond]
                    if a * x + b * y + c * z + d >= least:
                        found.append(beyond)
        return sorted(found)

    def cell_list(self) -> CellList:
        """The cell list of the surface as it is: vertices in the order of the points, edges and faces as made."""
        edges, faces = sorted(self.ends), sorted(self.faces)
        ends = np.array([self.ends[edge] for edge in edges])
        vertices, renamed = np.unique(ends, return_inverse=True)
        starts, ends = renamed.reshape(-1, 2).T + 1
        signed = np.array([self.faces[face][:3] for face in faces]).ravel()
        numbers = np.sign(signed) * (np.searchsorted(edges, abs(signed)) + 1)
        points = [self.points[vertex] for vertex in vertices.tolist()]
        return assembled(points, starts, ends, np.full(len(faces), 3), numbers)

    def _cone(self, top: int, boundary: Iterable[int]) -> None:
        """A triangle from ``top`` over every signed edge, each in the sense in which its new face follows it."""
        spokes: dict[int, int] = {}
        for edge in boundary:
            near, far = self.ends[edge] if edge > 0 else self.ends[-edge][::-1]
            if near not in spokes:
                spokes[near] = self._edge(top, near)
            if far not in spokes:
                spokes[far] = -self._edge(far, top)
            self._face(spokes[near], edge, -spokes[far], top, near, far)

    def _edge(self, start: int, end: int) -> int:
        self.edges += 1
        self.ends[self.edges] = (start, end)
        return self.edges

    def _face(self, first: int, second: int, third: int, p: int, q: int, r: int) -> None:
        """A triangle by its signed edges and by its corners, counterclockwise seen from outside."""
        self.made = face = self.made + 1
        sides = self.sides
        sides[first] = sides[second] = sides[third] = face
        x, y, z = self.moved[p]
        u1, u2, u3 = self.moved[q]
        v1, v2, v3 = self.moved[r]
        u1, u2, u3, v1, v2, v3 = u1 - x, u2 - y, u3 - z, v1 - x, v2 - y, v3 - z
        a, b, c = u2 * v3 - u3 * v2, u3 * v1 - u1 * v3, u1 * v2 - u2 * v1
        self.faces[face] = (first, second, third, a, b, c, -(a * x + b * y + c * z))


class Waiting:
    """Of each point that is still to come one face that it sees (2. above): ``face`` by point, ``lists`` by face."""

    def __init__(self, polyhedron: CurrentPolyhedron, numbers: Iterable[int]) -> None:
        self.polyhedron = polyhedron
        self.face: dict[int, int] = {}
        self.lists: dict[int, list[int]] = {}
        reach = max(map(max, polyhedron.moved))
        # A normal's components are at most 2 reach^2, and each of the four terms of a value at most 6 reach^3.
        self.places: NDArray[Any] | None = np.array(polyhedron.moved) if 24 * reach**3 < 2**63 else None
        self._give(list(numbers), range(1, polyhedron.made + 1))

    def renew(self, gone: Iterable[int], inserted: int) -> None:
        """After an extension: the points of the faces that went are given to new ones, those that see none are done."""
        orphans = [number for face in gone for number in self.lists.pop(face, ()) if number != inserted]
        for number in orphans:
            del self.face[number]
        self._give(orphans, range(self.polyhedron.new, self.polyhedron.made + 1))

    def _give(self, numbers: list[int], faces: range) -> None:
        if not numbers:
            return
        least = self.polyhedron.least
        planes = [self.polyhedron.faces[face][3:] for face in faces]
        if self.places is not None and len(numbers) * len(planes) >= _MANY:
            table = np.array(planes)
            seen = self.places[numbers] @ table[:, :3].T + table[:, 3] >= least
            first = seen.argmax(axis=1)
            for row in np.flatnonzero(seen[np.arange(len(numbers)), first]).tolist():
                self._put(numbers[row], faces[first[row]])
            return
        for number in numbers:
            x, y, z = self.polyhedron.moved[number]
            for face, (a, b, c, d) in zip(faces, planes, strict=True):
                if a * x + b * y + c * z + d >= least:
                    self._put(number, face)
                    break

    def _put(self, number: int, face: int) -> None:
        self.face[number] = face
        self.lists.setdefault(face, []).append(number)


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
        return flat_hull(distinct)
    polyhedron = CurrentPolyhedron(distinct, simplex, coplanar)
    rest = sorted(set(range(len(distinct))).difference(simplex))
    if all(p[::-1] < q[::-1] for p, q in pairwise(distinct)):
        for number in rest:
            first = polyhedron.first_seen(number)
            if first:
                polyhedron.extend(number, first)
    else:
        waiting = Waiting(polyhedron, rest)
        for number in rest:
            if number in waiting.face:
                waiting.renew(polyhedron.extend(number, waiting.face.pop(number)), number)
    return polyhedron.cell_list()


def flat_hull(points: Sequence[IntPoint]) -> Flat:
    """The hull of distinct points in one plane."""
    flat = exact_hull(points)
    return Flat(flat.dimension, tuple(points[number] for number in flat.polygon or flat.vertices))


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

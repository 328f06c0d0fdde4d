"""The growing polyhedron of the method: a hull that is extended to one point after another (section 2, Figs. 5 to 7).

Every edge stores its two faces. The search for the faces visible from a point therefore starts at one visible face and
proceeds from neighbour to neighbour, without testing all faces. All arithmetic is in integers of any length.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Final, Literal

import numpy as np
from numpy.typing import NDArray

from emulator.errors import quoted
from modern.exact_hull import ExactHull, exact_hull
from modern.geometry.vectors import cross, dot, independent, minus
from modern.papers.kovalevsky_schulz.cells import CellList, IntPoint, assembled

# How one visible face is found. The faces visible from a point are connected through edges. This is true even if a face
# whose plane contains the point counts as visible: that face or another face of its plane has a neighbour from whose
# outer side the point is seen, or the point lies in the face itself.
#
# 1. Points in raster order: a point later in that order than all vertices sees a face at the last vertex, V. Otherwise
#    the point would be in the cone of the faces at V, and V + t (P - V) for a small t would be a point of the
#    polyhedron later than V. The faces at V are those created last. Only points in the plane of the first points,
#    before a fourth point gives a tetrahedron, may need a search of all faces.
# 2. Points in another order: every remaining point stores one face that it sees, and every face a list of such points.
#    When faces are removed, the points in their lists are tested against the new faces only. This is enough. Let P see
#    a removed face, let m be a point within that face, and let P still see some face. The segment from P to m first
#    meets the new surface at a point x of a face that P sees. If that face is not new, x was in the old polyhedron. But
#    the segment, in or above the plane of m's face, meets only faces of this plane in the old polyhedron, and all of
#    them are removed together. So x lies on an edge between them and the remaining face. This is a boundary edge, x
#    lies in a new face at this edge, and P sees that face too.
# The two treatments of a face whose plane contains the new point.
Coplanar = Literal["visible", "invisible"]
VISIBLE: Final = "visible"
INVISIBLE: Final = "invisible"
_KINDS = ("point", "segment", "polygon")
# If points times faces are at least this number, one matrix product computes the values of all planes at all points.
_MANY = 128
# Three signed edges and the four coefficients of the plane, whose value is positive outside.
Triangle = tuple[int, int, int, int, int, int, int]


@dataclass(frozen=True, slots=True)
class Flat:
    """The hull of points in one plane, which has no cell list: its dimension, and its vertices in cyclic order."""

    dimension: int
    vertices: tuple[IntPoint, ...]

    @property
    def kind(self) -> str:
        return _KINDS[self.dimension]


class CurrentPolyhedron:
    """The polyhedron under construction, the paper's CP: numbered edges and triangles, changed in place.

    ``points`` are all points that may become vertices, and ``shifted`` are the same points relative to the lowest
    corner of their bounding box. A face is visible from a point if the value of its plane at the point is at least
    ``least``. ``ends`` has the start and the end of each edge. The face on the left of edge e is ``sides[e]``, and the
    face on its right ``sides[-e]``. ``first_new`` is the number of the first face created in the last extension.
    """

    def __init__(self, points: Sequence[IntPoint], simplex: Sequence[int], coplanar: Coplanar) -> None:
        """Begin with the tetrahedron of four points, whose indices are ``simplex`` and which are not coplanar."""
        self.points = points
        low = [min(column) for column in zip(*points, strict=True)]
        self.shifted = [(x - low[0], y - low[1], z - low[2]) for x, y, z in points]
        self.least = 0 if coplanar == VISIBLE else 1
        self.ends: dict[int, tuple[int, int]] = {}
        self.sides: dict[int, int] = {}
        self.faces: dict[int, Triangle] = {}
        self.last_edge = self.last_face = self.first_new = 0
        a, b, c, d = simplex
        # The first triangle must run counterclockwise as seen from outside, so d must be behind it.
        base = [points[number] for number in (a, b, c)]
        if dot(cross(minus(base[1], base[0]), minus(base[2], base[0])), minus(points[d], base[0])) > 0:
            b, c = c, b
        first, second, third = self._edge(a, b), self._edge(b, c), self._edge(c, a)
        self._face(first, second, third, a, b, c)
        self._cone(d, (-first, -second, -third))
        self.first_new = 1

    def first_visible(self, number: int) -> int:
        """Return the number of a face that is visible from a point, or 0. The faces created last are tested first."""
        x, y, z = self.shifted[number]
        newest = range(self.first_new, self.last_face + 1)
        for candidates in (newest, self.faces):
            for face in candidates:
                _, _, _, a, b, c, d = self.faces[face]
                if a * x + b * y + c * z + d >= self.least:
                    return face
        return 0

    def extend(self, number: int, first: int) -> list[int]:
        """Extend the polyhedron to a point from which the face ``first`` is visible. Return the removed faces.

        The visible faces are removed, together with the edges between two visible faces and the vertices whose faces
        are all visible. Each edge between a visible and an invisible face forms a new triangle with the point (section
        2).
        """
        visible = self._visible(number, first)
        removed = set(visible)
        faces, sides, ends = self.faces, self.sides, self.ends
        boundary: list[int] = []
        inner: list[int] = []
        for face in visible:
            for edge in faces.pop(face)[:3]:
                if sides[-edge] not in removed:
                    boundary.append(edge)
                elif edge > 0:
                    # An inner edge occurs in two removed faces, once with each sign.
                    inner.append(edge)
        for edge in inner:
            del ends[edge], sides[edge], sides[-edge]
        self.first_new = self.last_face + 1
        self._cone(number, boundary)
        return visible

    def _visible(self, number: int, first: int) -> list[int]:
        """Return the sorted numbers of all faces visible from a point. The face ``first`` is one of them."""
        x, y, z = self.shifted[number]
        faces, sides, least = self.faces, self.sides, self.least
        visible, tested = [first], {first}
        for face in visible:
            for edge in faces[face][:3]:
                neighbour = sides[-edge]
                if neighbour not in tested:
                    tested.add(neighbour)
                    _, _, _, a, b, c, d = faces[neighbour]
                    if a * x + b * y + c * z + d >= least:
                        visible.append(neighbour)
        return sorted(visible)

    def cell_list(self) -> CellList:
        """Return the cell list of the surface: vertices in the order of ``points``, edges and faces as created."""
        edges, faces = sorted(self.ends), sorted(self.faces)
        ends = np.array([self.ends[edge] for edge in edges])
        vertices, renamed = np.unique(ends, return_inverse=True)
        starts, ends = renamed.reshape(-1, 2).T + 1
        signed = np.array([self.faces[face][:3] for face in faces]).ravel()
        numbers = np.sign(signed) * (np.searchsorted(edges, abs(signed)) + 1)
        points = [self.points[vertex] for vertex in vertices.tolist()]
        return assembled(points, starts, ends, np.full(len(faces), 3), numbers)

    def _cone(self, top: int, boundary: Iterable[int]) -> None:
        """Add a triangle from the vertex ``top`` to each edge of a boundary.

        The sign of an edge's number gives its direction.
        """
        spokes: dict[int, int] = {}
        for edge in boundary:
            # Neighbouring triangles share the edge between top and their common boundary vertex. The edge is created
            # when the vertex occurs first. It has a negative sign if it runs towards top.
            near, far = self.ends[edge] if edge > 0 else self.ends[-edge][::-1]
            if near not in spokes:
                spokes[near] = self._edge(top, near)
            if far not in spokes:
                spokes[far] = -self._edge(far, top)
            self._face(spokes[near], edge, -spokes[far], top, near, far)

    def _edge(self, start: int, end: int) -> int:
        self.last_edge += 1
        self.ends[self.last_edge] = (start, end)
        return self.last_edge

    def _face(self, first: int, second: int, third: int, p: int, q: int, r: int) -> None:
        """Add a triangle, given by three signed edges and three vertices, counterclockwise as seen from outside."""
        self.last_face = face = self.last_face + 1
        sides = self.sides
        sides[first] = sides[second] = sides[third] = face
        x, y, z = self.shifted[p]
        u1, u2, u3 = self.shifted[q]
        v1, v2, v3 = self.shifted[r]
        u1, u2, u3, v1, v2, v3 = u1 - x, u2 - y, u3 - z, v1 - x, v2 - y, v3 - z
        # The plane need not be in lowest terms, because only the signs of its values are used.
        a, b, c = u2 * v3 - u3 * v2, u3 * v1 - u1 * v3, u1 * v2 - u2 * v1
        self.faces[face] = (first, second, third, a, b, c, -(a * x + b * y + c * z))


class Waiting:
    """The points still to be inserted, each with one face that is visible from it.

    ``face`` has this face for each point, and ``lists`` has, for each face, the points to which it is assigned.
    """

    def __init__(self, polyhedron: CurrentPolyhedron, numbers: Iterable[int]) -> None:
        self.polyhedron = polyhedron
        self.face: dict[int, int] = {}
        self.lists: dict[int, list[int]] = {}
        extent = max(map(max, polyhedron.shifted))
        # The components of a normal are at most 2 extent^2, and each of the four terms of a value at most 6 extent^3.
        self.array: NDArray[Any] | None = np.array(polyhedron.shifted) if 24 * extent**3 < 2**63 else None
        self._assign(list(numbers), range(1, polyhedron.last_face + 1))

    def renew(self, removed: Iterable[int], inserted: int) -> None:
        """Assign each point of a removed face to a new face visible from it, or drop the point if there is none."""
        orphans = [number for face in removed for number in self.lists.pop(face, ()) if number != inserted]
        for number in orphans:
            del self.face[number]
        self._assign(orphans, range(self.polyhedron.first_new, self.polyhedron.last_face + 1))

    def _assign(self, numbers: list[int], faces: range) -> None:
        if not numbers:
            return
        least = self.polyhedron.least
        planes = [self.polyhedron.faces[face][3:] for face in faces]
        if self.array is not None and len(numbers) * len(planes) >= _MANY:
            # The same test for all points and planes at once: argmax gives the first visible face of each point.
            coefficients = np.array(planes)
            visible = self.array[numbers] @ coefficients[:, :3].T + coefficients[:, 3] >= least
            first = visible.argmax(axis=1)
            for row in np.flatnonzero(visible[np.arange(len(numbers)), first]).tolist():
                self._store(numbers[row], faces[first[row]])
            return
        for number in numbers:
            x, y, z = self.polyhedron.shifted[number]
            for face, (a, b, c, d) in zip(faces, planes, strict=True):
                if a * x + b * y + c * z + d >= least:
                    self._store(number, face)
                    break

    def _store(self, number: int, face: int) -> None:
        self.face[number] = face
        self.lists.setdefault(face, []).append(number)


def convex_polyhedron(points: Iterable[Sequence[int]], coplanar: Coplanar = VISIBLE) -> CellList | Flat:
    """Return the hull of points with integer coordinates as triangles. The points are inserted in the given order.

    ``coplanar`` applies to a face whose plane contains the new point. Such a face counts as ``visible``, as the paper's
    text prefers, or as ``invisible``, which reproduces the printed number of 1404 triangles for a ball. Repeated points
    are ignored. For points in one plane, which the paper does not treat, the result is ``Flat``, computed by
    ``modern.exact_hull``.

    Raise ValueError if there are no points or ``coplanar`` is unknown.
    """
    if coplanar not in (VISIBLE, INVISIBLE):
        raise ValueError(f"expected {VISIBLE} or {INVISIBLE} for coplanar faces, found {quoted(coplanar)}")
    distinct = list(dict.fromkeys((int(x), int(y), int(z)) for x, y, z in points))
    if not distinct:
        raise ValueError("there are no points")
    simplex = independent(distinct)
    if len(simplex) < 4:
        return flat_hull(exact_hull(distinct))
    polyhedron = CurrentPolyhedron(distinct, simplex, coplanar)
    remaining = sorted(set(range(len(distinct))).difference(simplex))
    # In raster order (by z, then y, then x) the first of the two ways to find a visible face is possible.
    if all(p[::-1] < q[::-1] for p, q in pairwise(distinct)):
        for number in remaining:
            first = polyhedron.first_visible(number)
            if first:
                polyhedron.extend(number, first)
    else:
        waiting = Waiting(polyhedron, remaining)
        for number in remaining:
            if number in waiting.face:
                waiting.renew(polyhedron.extend(number, waiting.face.pop(number)), number)
    return polyhedron.cell_list()


def flat_hull(hull: ExactHull) -> Flat:
    return Flat(hull.dimension, tuple(hull.scaled[index] for index in hull.polygon or hull.vertices))

"""The two other treatments of coplanar faces (section 2, Figs. 7 and 8), which the paper tried and gave up.

A new point P lies in the plane of a face that it does not see.  *Quadrangles* (Fig. 7): the face counts as invisible,
and of all its edges to visible faces together with P one new face is made, coplanar with it, not a triangle for each;
the two are merged.  *Extended* (Fig. 8): the face itself is extended to P, as a hull in its plane.

Faces are kept whole, one of each plane, as the set of their corners; a corner in line with two others goes.  All
arithmetic is in integers.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Final, Literal

from modern.geometry.vectors import cross, dot, lowest, minus
from modern.papers.kovalevsky_schulz.cells import IntPoint
from modern.papers.kovalevsky_schulz.polyhedron import independent

Treatment = Literal["quadrangles", "extended"]
QUADRANGLES: Final = "quadrangles"
EXTENDED: Final = "extended"
Plane = tuple[int, int, int, int]
Edge = tuple[int, int]


@dataclass(frozen=True, slots=True)
class Treated:
    """A hull with maximal faces and what it took.

    ``faces``: of each its corners, counterclockwise seen from outside, the smallest first.  ``made``: faces made from a
    new point, triangles and others; ``larger``: those of them with more than three corners; ``merged``: how often a new
    face was merged with another of its plane; ``extended``: how often a face was extended to a point; ``straightened``:
    corners that went because two edges of a face came to lie in one line.
    """

    faces: tuple[tuple[int, ...], ...]
    made: int
    larger: int
    merged: int
    extended: int
    straightened: int


def coplanar_hull(points: Iterable[Sequence[int]], treatment: Treatment) -> Treated:
    """The hull of points with whole coordinates by one of the two treatments, inserting them in the order given.

    Raises ValueError for points in one plane and for another treatment.
    """
    if treatment not in (QUADRANGLES, EXTENDED):
        raise ValueError(f"coplanar faces are made {QUADRANGLES} or {EXTENDED}, not {treatment!r}")
    given = list(dict.fromkeys((int(x), int(y), int(z)) for x, y, z in points))
    simplex = independent(given)
    if len(simplex) < 4:
        raise ValueError("the points lie in one plane")
    hull = _Growing(given, simplex)
    for number in range(len(given)):
        if number not in simplex:
            hull.extend(number, treatment)
    return Treated(tuple(sorted(hull.cycles())), *hull.counts)


class _Growing:
    """The faces so far, by plane, with their corners in order."""

    def __init__(self, points: Sequence[IntPoint], simplex: Sequence[int]) -> None:
        self.points = points
        self.faces: dict[Plane, tuple[int, ...]] = {}
        self.made = self.larger = self.merged = self.extended = self.straightened = 0
        for k in range(4):
            a, b, c = (simplex[i] for i in range(4) if i != k)
            plane = self.plane(a, b, c)
            if self.value(plane, simplex[k]) > 0:
                plane = (-plane[0], -plane[1], -plane[2], -plane[3])
            self.faces[plane] = self.ring(plane, (a, b, c))

    @property
    def counts(self) -> tuple[int, int, int, int, int]:
        return self.made, self.larger, self.merged, self.extended, self.straightened

    def cycles(self) -> list[tuple[int, ...]]:
        return list(self.faces.values())

    def extend(self, new: int, treatment: Treatment) -> None:
        values = {plane: self.value(plane, new) for plane in self.faces}
        visible = [plane for plane, value in values.items() if value > 0]
        if not visible:
            return
        beside = {edge: plane for plane, ring in self.faces.items() for edge in _edges(ring)}
        boundary: dict[Plane, list[Edge]] = {}
        for plane in visible:
            for a, b in _edges(self.faces[plane]):
                if values[beside[b, a]] <= 0:
                    boundary.setdefault(beside[b, a], []).append((a, b))
        for plane in visible:
            del self.faces[plane]
        for plane, edges in boundary.items():
            if values[plane] == 0:
                self.join_coplanar(plane, edges, new, treatment)
            else:
                for a, b in edges:
                    self.take(self.plane(a, b, new), (a, b, new))
        # A point on the line in which two coplanar faces meet extends both, whether or not it saw one of their edges.
        for plane, value in values.items():
            if value == 0 and plane not in boundary:
                self.enlarge(plane, (new,))

    def join_coplanar(self, plane: Plane, edges: Sequence[Edge], new: int, treatment: Treatment) -> None:
        """The face of a plane that holds the point, and its edges to visible faces."""
        if treatment == QUADRANGLES:
            self.made += 1
            self.larger += len(edges) > 1
            self.merged += 1
        else:
            self.extended += 1
        self.enlarge(plane, (new,))

    def take(self, plane: Plane, corners: tuple[int, int, int]) -> None:
        """A new triangle, merged with a face of its plane if there is one."""
        self.made += 1
        if plane in self.faces:
            self.merged += 1
            self.enlarge(plane, corners)
        else:
            self.faces[plane] = self.ring(plane, corners)

    def enlarge(self, plane: Plane, corners: Sequence[int]) -> None:
        before = dict.fromkeys((*self.faces[plane], *corners))
        self.faces[plane] = self.ring(plane, tuple(before))

    def plane(self, a: int, b: int, c: int) -> Plane:
        """The plane of three points, counterclockwise seen from outside, in lowest terms."""
        p, q, r = self.points[a], self.points[b], self.points[c]
        normal = lowest(cross(minus(q, p), minus(r, p)))
        return (*normal, -dot(normal, p))

    def value(self, plane: Plane, k: int) -> int:
        return dot(plane[:3], self.points[k]) + plane[3]

    def ring(self, plane: Plane, corners: Sequence[int]) -> tuple[int, ...]:
        """The hull of a face's corners in its plane, counterclockwise seen from outside, the smallest first."""
        axis = max(range(3), key=lambda k: abs(plane[k]))
        u, v = ((axis + 1) % 3, (axis + 2) % 3)[:: 1 if plane[axis] > 0 else -1]
        order = sorted(corners, key=lambda k: (self.points[k][u], self.points[k][v]))
        lower, upper = self.chain(order, u, v), self.chain(order[::-1], u, v)
        found = (*lower[:-1], *upper[:-1])
        start = found.index(min(found))
        return found[start:] + found[:start]

    def chain(self, order: Sequence[int], u: int, v: int) -> list[int]:
        found: list[int] = []
        for k in order:
            while len(found) > 1:
                p, q, r = (self.points[i] for i in (*found[-2:], k))
                turn = (q[u] - p[u]) * (r[v] - p[v]) - (q[v] - p[v]) * (r[u] - p[u])
                if turn > 0:
                    break
                self.straightened += turn == 0
                found.pop()
            found.append(k)
        return found


def _edges(ring: Sequence[int]) -> list[Edge]:
    return list(zip(ring, (*ring[1:], ring[0]), strict=True))

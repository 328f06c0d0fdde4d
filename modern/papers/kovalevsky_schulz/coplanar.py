"""Two treatments of a new point in the plane of a face, which the paper tried and gave up (section 2, Figs. 7 and 8).

Let P be a new point in the plane of a face. *Quadrangles* (Fig. 7): the face counts as invisible. The edges between
this face and visible faces, together with P, form one new face in the same plane, instead of a triangle for each edge.
The new face is merged with the old one. *Extended* (Fig. 8): the face itself is extended to P by a hull in its plane.

There is one face for each plane. A face is stored as the cycle of its vertices, without vertices that lie in line with
two others. All arithmetic is in integers.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Final, Literal

from emulator.errors import quoted
from modern.geometry.mesh import sides
from modern.geometry.vectors import cross, dot, independent, lowest, minus
from modern.papers.kovalevsky_schulz.cells import IntPoint, Plane

Treatment = Literal["quadrangles", "extended"]
QUADRANGLES: Final = "quadrangles"
EXTENDED: Final = "extended"
Edge = tuple[int, int]


@dataclass(frozen=True, slots=True)
class MergedHull:
    """A hull whose coplanar faces are merged, and counts of the steps that computed it.

    Each face lists its vertices counterclockwise as seen from outside, beginning with the smallest index. ``created``
    is the number of new faces, ``larger`` is the number of new faces with more than three vertices, and ``merged`` is
    the number of new faces that were merged with a face of the same plane. ``extended`` is the number of extensions of
    a face to a new point of its plane. ``straightened`` is the number of vertices removed because they lay in line with
    their neighbours.
    """

    faces: tuple[tuple[int, ...], ...]
    created: int
    larger: int
    merged: int
    extended: int
    straightened: int


def coplanar_hull(points: Iterable[Sequence[int]], treatment: Treatment) -> MergedHull:
    """Return the hull of points with integer coordinates by the treatment ``quadrangles`` or ``extended``.

    Raise ValueError for points in one plane or another treatment.
    """
    if treatment not in (QUADRANGLES, EXTENDED):
        raise ValueError(
            f"expected {QUADRANGLES} or {EXTENDED} as the treatment of coplanar faces, found {quoted(treatment)}"
        )
    distinct = list(dict.fromkeys((int(x), int(y), int(z)) for x, y, z in points))
    simplex = independent(distinct)
    if len(simplex) < 4:
        raise ValueError("expected points in space, but all points lie in one plane")
    hull = _Growing(distinct, simplex)
    for number in range(len(distinct)):
        if number not in simplex:
            hull.extend(number, treatment)
    counts = (hull.created, hull.larger, hull.merged, hull.extended, hull.straightened)
    return MergedHull(tuple(sorted(hull.faces.values())), *counts)


class _Growing:
    """The growing hull: the cycle of vertices of each face, keyed by the face's plane."""

    def __init__(self, points: Sequence[IntPoint], simplex: Sequence[int]) -> None:
        self.points = points
        self.faces: dict[Plane, tuple[int, ...]] = {}
        self.created = self.larger = self.merged = self.extended = self.straightened = 0
        for k in range(4):
            a, b, c = (simplex[i] for i in range(4) if i != k)
            # Orient the plane so that the fourth point of the tetrahedron is on its inner side.
            plane = self.plane(a, b, c)
            if self.value(plane, simplex[k]) > 0:
                plane = (-plane[0], -plane[1], -plane[2], -plane[3])
            self.faces[plane] = self.convex_cycle(plane, (a, b, c))

    def extend(self, new: int, treatment: Treatment) -> None:
        values = {plane: self.value(plane, new) for plane in self.faces}
        visible = [plane for plane, value in values.items() if value > 0]
        if not visible:
            return
        # Collect the edges between visible and other faces, grouped by the face on their other side.
        plane_at = {edge: plane for plane, cycle in self.faces.items() for edge in sides(cycle)}
        boundary: dict[Plane, list[Edge]] = {}
        for plane in visible:
            for a, b in sides(self.faces[plane]):
                if values[plane_at[b, a]] <= 0:
                    boundary.setdefault(plane_at[b, a], []).append((a, b))
        for plane in visible:
            del self.faces[plane]
        # A coplanar face is treated as in Fig. 7 or 8. Each other boundary edge and the new point form a triangle.
        for plane, edges in boundary.items():
            if values[plane] == 0:
                self.join_coplanar(plane, edges, new, treatment)
            else:
                for a, b in edges:
                    self.add_triangle(self.plane(a, b, new), (a, b, new))
        # A point in the planes of two faces extends both of them, even if no neighbour of a face is visible.
        for plane, value in values.items():
            if value == 0 and plane not in boundary:
                self.enlarge(plane, (new,))

    def join_coplanar(self, plane: Plane, edges: Sequence[Edge], new: int, treatment: Treatment) -> None:
        """Merge a face with a new point in its plane. ``edges`` are the face's common edges with visible faces."""
        # Fig. 7 creates one polygon from these edges and merges it with the face. Fig. 8 extends the face itself. Both
        # result in the hull of the face and the point within their plane. Only the counts differ.
        if treatment == QUADRANGLES:
            self.created += 1
            self.larger += len(edges) > 1
            self.merged += 1
        else:
            self.extended += 1
        self.enlarge(plane, (new,))

    def add_triangle(self, plane: Plane, corners: tuple[int, int, int]) -> None:
        """Add a new triangle to the hull, or merge it with a face in the same plane."""
        self.created += 1
        if plane in self.faces:
            self.merged += 1
            self.enlarge(plane, corners)
        else:
            self.faces[plane] = self.convex_cycle(plane, corners)

    def enlarge(self, plane: Plane, corners: Sequence[int]) -> None:
        vertices = dict.fromkeys((*self.faces[plane], *corners))
        self.faces[plane] = self.convex_cycle(plane, tuple(vertices))

    def plane(self, a: int, b: int, c: int) -> Plane:
        """Return the plane, in lowest terms, of three points that run counterclockwise as seen from outside."""
        p, q, r = self.points[a], self.points[b], self.points[c]
        normal = lowest(cross(minus(q, p), minus(r, p)))
        return (*normal, -dot(normal, p))

    def value(self, plane: Plane, k: int) -> int:
        return dot(plane[:3], self.points[k]) + plane[3]

    def convex_cycle(self, plane: Plane, corners: Sequence[int]) -> tuple[int, ...]:
        """Return the hull of points in a plane as a cycle of indices, counterclockwise, beginning with the smallest."""
        # Dropping the coordinate of the largest component of the normal projects the plane one to one. If that
        # component is negative, the other two coordinates are exchanged, which keeps the sense of rotation.
        axis = max(range(3), key=lambda k: abs(plane[k]))
        u, v = ((axis + 1) % 3, (axis + 2) % 3)[:: 1 if plane[axis] > 0 else -1]
        order = sorted(corners, key=lambda k: (self.points[k][u], self.points[k][v]))
        lower, upper = self.chain(order, u, v), self.chain(order[::-1], u, v)
        cycle = (*lower[:-1], *upper[:-1])
        start = cycle.index(min(cycle))
        return cycle[start:] + cycle[:start]

    def chain(self, order: Sequence[int], u: int, v: int) -> list[int]:
        """Return half of the convex hull of sorted points in two coordinates (Andrew's monotone chain)."""
        chain: list[int] = []
        for k in order:
            # A point at which the chain turns right or does not turn is not a vertex of the face.
            while len(chain) > 1:
                p, q, r = (self.points[i] for i in (*chain[-2:], k))
                turn = (q[u] - p[u]) * (r[v] - p[v]) - (q[v] - p[v]) * (r[u] - p[u])
                if turn > 0:
                    break
                self.straightened += turn == 0
                chain.pop()
            chain.append(k)
        return chain

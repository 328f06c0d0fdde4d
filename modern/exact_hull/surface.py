"""Construct an exact polyhedron by inserting points one at a time into a closed convex surface of triangles.

The algorithm is the randomised insertion of Clarkson and Shor (Discrete & Computational Geometry 4 (1989), section 3).
In the variant used here, every point that waits outside remembers *one* triangle that it sees.  All signs are exact.

A point "sees" a triangle if it is strictly outside its plane.  If the plane of a triangle contains the point, the point
does not see the triangle, which therefore stays.  So a point sees either all triangles of a face or none of them.  The
triangles that a point sees are also those that it would see after a slight move towards the inside of the hull.  They
form a disc, whose border (the horizon) is one simple cycle.  No edge of the horizon is in line with the new point,
since otherwise the plane of the seen triangle at that edge would contain the point.  So no triangle without area
arises.  Triangles may share a plane, and a former corner may end up inside a face or an edge.  ``facets.faces`` merges
such triangles at the end.

Signs are first computed with the filter of ``planes``.  A sign that the filter does not decide is computed in integers.
"""

from collections.abc import Sequence

import numpy as np

from modern.exact_hull.coordinates import Coordinates, Floats
from modern.exact_hull.facets import Triangle, plane_through, value
from modern.exact_hull.planes import BOUND, normal_image
from modern.exact_hull.result import Plane

# The number of signs that are computed one by one faster than by numpy.
_FEW = 24
# Planes through points with coordinates below this limit have values below 2**51 at them, which float64 holds exactly.
_NEAR = 2**15

# Why one triangle for each waiting point is enough: let q see the triangle f, which point p sees and removes, and let m
# be a point inside f.  The segment q m is outside the old hull up to m, and m is interior to the new hull.  The segment
# therefore enters the new hull through a new triangle, which q sees.  So a waiting point needs to be compared only with
# the new triangles, and if it sees none of them it belongs to the hull.
_Horizon = list[tuple[int, int, int]]
_Image = tuple[float, float, float, float]


class Surface:
    """The surface while it grows, as parallel lists indexed by triangle.  A removed triangle keeps its index.

    Corners are counterclockwise seen from outside. ``neighbours[t][k]`` is the triangle beyond edge k of triangle t.
    ``waiting`` has the points waiting outside each triangle, and ``home`` has the triangle outside of which each point
    waits, or -1. ``mark`` encodes which point last tested each triangle, and whether the point saw it (see
    ``_visible``).
    """

    def __init__(self, points: Coordinates, simplex: Sequence[int]) -> None:
        self.points = points.all()
        # Small integers need no images: they and their planes are used as they are, without shifts.
        near = points.kind == "i" and abs(points.numbers).max() < _NEAR
        self.shifts = None if near else points.images.shifts
        self.bound = 0.0 if near or points.images.are_small else BOUND
        self.places = np.ones((len(points), 4))
        self.places[:, :3] = points.numbers if near else points.images.places
        self.rows: Sequence[Sequence[float]] = self.points if near else points.images.places.tolist()
        self.corners: list[Triangle] = []
        self.neighbours: list[list[int]] = []
        self.planes: list[Plane] = []
        self.images: list[_Image] = []
        self.waiting: list[list[int]] = []
        self.alive: list[bool] = []
        self.mark: list[int] = []
        self.home: list[int] = [-1] * len(points)
        # The first tetrahedron.  Its fourth point is on the inner side of the plane of the first triangle.
        a, b, c, d = simplex
        if value(plane_through(self.points[a], self.points[b], self.points[c]), self.points[d]) > 0:
            b, c = c, b
        for corners, neighbours in (
            ((a, b, c), [1, 2, 3]),
            ((b, a, d), [0, 3, 2]),
            ((c, b, d), [0, 1, 3]),
            ((a, c, d), [0, 2, 1]),
        ):
            self._add(corners, neighbours)
        used = set(simplex)
        self._distribute([p for p in range(len(points)) if p not in used], range(4))

    def _add(self, corners: Triangle, neighbours: list[int]) -> None:
        p, q, r = corners
        plane = plane_through(self.points[p], self.points[q], self.points[r])
        image: _Image = plane
        if self.shifts:
            a, b, c = normal_image(plane, self.shifts)
            x, y, z = self.rows[p]
            image = a, b, c, -(a * x + b * y + c * z)
        self.corners.append(corners)
        self.neighbours.append(neighbours)
        self.planes.append(plane)
        self.images.append(image)
        self.waiting.append([])
        self.alive.append(True)
        self.mark.append(-1)

    def sees(self, p: int, triangle: int) -> bool:
        """Return True if point ``p`` sees the triangle, that is, if it is strictly outside the triangle's plane."""
        a, b, c, d = self.images[triangle]
        x, y, z = self.rows[p]
        approximate = a * x + b * y + c * z + d
        if approximate > self.bound:
            return True
        if approximate < -self.bound:
            return False
        return value(self.planes[triangle], self.points[p]) > 0

    def _distribute(self, points: list[int], triangles: range) -> None:
        """Assign each point to one of ``triangles`` that it is outside of.  Points outside of none are in the hull."""
        if len(points) * len(triangles) <= _FEW:
            for p in points:
                self._wait(p, next((triangle for triangle in triangles if self.sees(p, triangle)), -1))
            return
        # One matrix product gives all approximate values; each point takes the triangle with the largest one.
        values: Floats = self.places[points] @ np.array(self.images[triangles.start :]).T
        chosen: list[int] = values.argmax(axis=1).tolist()
        for row, (p, largest) in enumerate(zip(points, values.max(axis=1).tolist(), strict=True)):
            triangle = -1
            if largest > self.bound:
                triangle = triangles.start + chosen[row]
            elif self.bound and largest >= -self.bound:
                doubtful = (np.flatnonzero(values[row] >= -self.bound) + triangles.start).tolist()
                triangle = next((t for t in doubtful if value(self.planes[t], self.points[p]) > 0), -1)
            self._wait(p, triangle)

    def _wait(self, p: int, triangle: int) -> None:
        self.home[p] = triangle
        if triangle >= 0:
            self.waiting[triangle].append(p)

    def _visible(self, p: int) -> tuple[list[int], _Horizon]:
        """Return the triangles that point ``p`` sees, and the edges around them: start, end, and triangle beyond."""
        # The search begins at the remembered triangle and spreads across edges; visible triangles are connected.
        visible = [self.home[p]]
        horizon: _Horizon = []
        yes, no = 2 * p, 2 * p + 1  # marks that belong to this point, so that older marks need not be reset
        mark = self.mark
        mark[visible[0]] = yes
        for triangle in visible:
            corners = self.corners[triangle]
            for k, beyond in enumerate(self.neighbours[triangle]):
                if mark[beyond] != yes and mark[beyond] != no:
                    if self.sees(p, beyond):
                        mark[beyond] = yes
                        visible.append(beyond)
                    else:
                        mark[beyond] = no
                if mark[beyond] == no:
                    horizon.append((corners[k], corners[k - 2], beyond))
        return visible, horizon

    def insert(self, p: int) -> None:
        """Insert ``p`` into the hull, unless the hull already contains it."""
        if self.home[p] < 0:
            return
        visible, horizon = self._visible(p)
        first = len(self.corners)
        leaving = {edge[0]: first + number for number, edge in enumerate(horizon)}
        arriving = {edge[1]: first + number for number, edge in enumerate(horizon)}
        if len(leaving) != len(horizon) or leaving.keys() != arriving.keys():
            raise RuntimeError("the horizon is not a simple cycle: the surface was not convex")
        # A new triangle joins each edge of the horizon to p; its other neighbours share the ends of the edge.
        for number, (u, v, beyond) in enumerate(horizon):
            self._add((u, v, p), [beyond, leaving[v], arriving[u]])
            self.neighbours[beyond][self.corners[beyond].index(v)] = first + number
        # Points that remember a removed triangle are compared with the new triangles.
        orphans = []
        for triangle in visible:
            orphans += self.waiting[triangle]
            self.waiting[triangle] = []
            self.alive[triangle] = False
        orphans.remove(p)
        self.home[p] = -1
        self._distribute(orphans, range(first, len(self.corners)))

    def triangles(self) -> list[tuple[Triangle, Plane]]:
        """Return the triangles with their planes, whose numbers may have a common divisor."""
        return [
            (corners, plane)
            for corners, plane, alive in zip(self.corners, self.planes, self.alive, strict=True)
            if alive
        ]


def convex_surface(points: Coordinates, simplex: Sequence[int], order: Sequence[int]) -> list[tuple[Triangle, Plane]]:
    """Return the hull as triangles, built from four points, ``simplex``, by inserting the other points in ``order``."""
    surface = Surface(points, simplex)
    for p in order:
        surface.insert(p)
    return surface.triangles()

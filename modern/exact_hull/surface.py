"""A polyhedron by inserting its points one at a time: a closed surface of triangles that is always convex.

Randomised insertion after Clarkson and Shor (Discrete & Computational Geometry 4 (1989), section 3), in the form in
which every point that waits outside keeps *one* triangle it sees.  All signs are exact.

"Sees" means strictly: a triangle whose plane holds the point is not seen and stays.  So triangles of one face are
seen together or not at all, the seen ones are those that a point moved slightly towards the inside would see, they
form a disc, and their border (the horizon) is one simple cycle.  No horizon edge is in line with the new point, or
the seen triangle at that edge would hold the point in its plane; so no triangle without area ever arises.  Triangles
may share a plane, and a former corner may end up within a face or an edge; ``faces`` sorts that out at the end.

Why one triangle a waiting point is enough: let q see the seen triangle f that point p removes, and let m be a point
within f.  The segment q m lies outside the old hull until m, and m is interior to the new hull.  It therefore enters
the new hull through a new triangle, and q sees that one.  So a waiting point needs to be tried against the new
triangles only, and if it sees none of them it is in the hull.

Signs are first computed in floating point, from images of points and planes, with a bound on what they may be off.

Points are moved by an integer vector so that they lie about the origin, then every axis is divided by its own power
of two, so that every image |x| <= 1.  A plane A x + B y + C z + D through one of the points is divided by the power
of two that brings the largest of |A| 2^k, |B| 2^l, |C| 2^m (2^k, 2^l, 2^m: the divisors of the axes) to at most 1;
then |D| <= 3.  All images are the nearest float64 (Python's int / int rounds correctly at any length).

The bound.  With e = 2**-54 the images of x and A are off by at most e each, that of D by 4e.  A product of images
is off by 2e, and by e more once rounded; three of them by 9e.  The three additions, in any order and with or without
fused products, meet partial sums below 8 and round by at most 8e each, 24e together.  The sum is off by at most
9e + 4e + 24e = 37e < 64e = 2**-48.  Underflow adds at most some 2**-1070.  So a computed value beyond 2**-48 has the
true sign, and anything nearer to zero is decided in integers.

When the points are small enough all of this arithmetic is exact and the bound is 0; see ``Frame.bound``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from modern.exact_hull.coordinates import IntPoint
from modern.exact_hull.facets import Triangle, plane_through, value
from modern.exact_hull.result import Plane

BOUND = 2.0**-48


@dataclass(frozen=True, slots=True)
class Frame:
    """The points a hull is built in: integers about the origin, and their images.

    integers: the points less ``centre``.  images: (n, 4) float64, the fourth column 1.
    shifts: the powers of two that divide the axes.
    bound: 2**-48, or 0 if a plane's value is an integer below 2**53 in all its steps, when float64 is exact: for
    |x| <= X, |y| <= Y, |z| <= Z the normal of a plane through three points is at most 8YZ, 8ZX, 8XY, its D at most
    24XYZ, and every partial sum at most 48XYZ.
    """

    centre: IntPoint
    shifts: IntPoint
    integers: list[IntPoint]
    images: NDArray[np.float64]
    bound: float


def frame(points: Sequence[IntPoint]) -> Frame:
    """The frame of points that do not lie in one plane."""
    columns = list(zip(*points, strict=True))
    centre = tuple((min(column) + max(column)) // 2 for column in columns)
    moved = [[number - middle for number in column] for column, middle in zip(columns, centre, strict=True)]
    largest = [max(max(column), -min(column)) for column in moved]
    shifts = tuple(number.bit_length() for number in largest)
    images = np.ones((len(points), 4))
    for axis in range(3):
        divisor = 1 << shifts[axis]
        images[:, axis] = [number / divisor for number in moved[axis]]
    exact = 48 * largest[0] * largest[1] * largest[2] < 2**53
    return Frame(
        (centre[0], centre[1], centre[2]),
        (shifts[0], shifts[1], shifts[2]),
        list(zip(*moved, strict=True)),
        images,
        0.0 if exact else BOUND,
    )


def plane_image(plane: Plane, shifts: IntPoint) -> tuple[float, float, float, float]:
    """The image of a plane through a point of the frame (its integers, not the points as given)."""
    a, b, c, d = plane
    k, l, m = shifts  # noqa: E741
    power = max(
        a.bit_length() + k if a else 0,
        b.bit_length() + l if b else 0,
        c.bit_length() + m if c else 0,
    )
    return (
        a / (1 << power - k) if a else 0.0,
        b / (1 << power - l) if b else 0.0,
        c / (1 << power - m) if c else 0.0,
        d / (1 << power),
    )


_Horizon = list[tuple[int, int, int]]


class Surface:
    """The triangles so far, as parallel lists over triangle numbers (removed ones keep their number).

    corners: counterclockwise seen from outside; neighbours[t][k] is the triangle beyond the edge from corner k to
    the next one.  planes, images: of the triangle.  waiting: the points that keep this triangle.
    home: for every point the triangle it keeps, or -1.
    """

    def __init__(self, frame: Frame, simplex: Sequence[int]) -> None:
        self.frame = frame
        self.places: list[list[float]] = frame.images[:, :3].tolist()
        self.corners: list[Triangle] = []
        self.neighbours: list[list[int]] = []
        self.planes: list[Plane] = []
        self.images: list[tuple[float, float, float, float]] = []
        self.waiting: list[list[int]] = []
        self.alive: list[bool] = []
        self.mark: list[int] = []
        self.home: list[int] = [-1] * len(frame.integers)
        a, b, c, d = simplex
        points = frame.integers
        if value(plane_through(points[a], points[b], points[c]), points[d]) > 0:
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
        points = self.frame.integers
        plane = plane_through(points[corners[0]], points[corners[1]], points[corners[2]])
        self.corners.append(corners)
        self.neighbours.append(neighbours)
        self.planes.append(plane)
        self.images.append(plane_image(plane, self.frame.shifts))
        self.waiting.append([])
        self.alive.append(True)
        self.mark.append(-1)

    def sees(self, p: int, triangle: int) -> bool:
        """Whether point ``p`` is strictly outside the triangle's plane."""
        a, b, c, d = self.images[triangle]
        x, y, z = self.places[p]
        guess = a * x + b * y + c * z + d
        if guess > self.frame.bound:
            return True
        if guess < -self.frame.bound:
            return False
        return value(self.planes[triangle], self.frame.integers[p]) > 0

    def _distribute(self, points: list[int], triangles: range) -> None:
        """Let every point keep a triangle it sees among those given, or none."""
        if not points:
            return
        bound = self.frame.bound
        values: NDArray[np.float64] = self.frame.images[points] @ np.array(self.images[triangles.start :]).T
        chosen: list[int] = values.argmax(axis=1).tolist()
        largest: list[float] = values.max(axis=1).tolist()
        first = triangles.start
        for row, p in enumerate(points):
            triangle = -1
            if largest[row] > bound:
                triangle = first + chosen[row]
            elif bound and largest[row] >= -bound:
                triangle = self._exactly_seen(p, np.flatnonzero(values[row] >= -bound) + first)
            self.home[p] = triangle
            if triangle >= 0:
                self.waiting[triangle].append(p)

    def _exactly_seen(self, p: int, doubtful: NDArray[np.intp]) -> int:
        """The first of the doubtful triangles that ``p`` sees, or -1."""
        for triangle in doubtful.tolist():
            if value(self.planes[triangle], self.frame.integers[p]) > 0:
                return int(triangle)
        return -1

    def _seen(self, p: int) -> tuple[list[int], _Horizon]:
        """The triangles ``p`` sees, and the horizon: edges (from, to) in the sense of the seen triangle, and the
        triangle beyond."""
        seen = [self.home[p]]
        horizon: _Horizon = []
        yes, no = 2 * p, 2 * p + 1
        mark = self.mark
        mark[seen[0]] = yes
        for triangle in seen:
            corners = self.corners[triangle]
            for k, beyond in enumerate(self.neighbours[triangle]):
                if mark[beyond] != yes and mark[beyond] != no:
                    if self.sees(p, beyond):
                        mark[beyond] = yes
                        seen.append(beyond)
                    else:
                        mark[beyond] = no
                if mark[beyond] == no:
                    horizon.append((corners[k], corners[k - 2], beyond))
        return seen, horizon

    def insert(self, p: int) -> None:
        """Make ``p`` part of the hull; nothing happens if it is in the hull already."""
        if self.home[p] < 0:
            return
        seen, horizon = self._seen(p)
        first = len(self.corners)
        leaving = {edge[0]: first + number for number, edge in enumerate(horizon)}
        arriving = {edge[1]: first + number for number, edge in enumerate(horizon)}
        if len(leaving) != len(horizon) or leaving.keys() != arriving.keys():
            raise RuntimeError("the horizon is not a simple cycle: the surface was not convex")
        for number, (u, v, beyond) in enumerate(horizon):
            self._add((u, v, p), [beyond, leaving[v], arriving[u]])
            self.neighbours[beyond][self.corners[beyond].index(v)] = first + number
        orphans = []
        for triangle in seen:
            orphans += self.waiting[triangle]
            self.waiting[triangle] = []
            self.alive[triangle] = False
        orphans.remove(p)
        self.home[p] = -1
        self._distribute(orphans, range(first, len(self.corners)))

    def triangles(self) -> list[tuple[Triangle, Plane]]:
        """The triangles of the surface with their planes in the frame, not reduced."""
        return [
            (corners, plane)
            for corners, plane, alive in zip(self.corners, self.planes, self.alive, strict=True)
            if alive
        ]


def convex_surface(frame: Frame, simplex: Sequence[int], order: Sequence[int]) -> list[tuple[Triangle, Plane]]:
    """The hull of the frame's points as triangles, starting from four independent ones.

    ``order`` names every other point; the result's faces do not depend on it, the time does.
    """
    surface = Surface(frame, simplex)
    for p in order:
        surface.insert(p)
    return surface.triangles()

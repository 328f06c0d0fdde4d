"""Construct a polyhedron by inserting its points one at a time into a closed convex surface of triangles.

The algorithm is the randomised insertion of Clarkson and Shor (Discrete & Computational Geometry 4 (1989), section 3),
in the variant in which every point that waits outside remembers *one* triangle that it sees.  All signs are exact.

A point "sees" a triangle if it is strictly outside its plane.  A triangle whose plane contains the point stays.
Therefore a point sees either all triangles of a face or none of them.  The seen triangles are those that the point
would also see if it moved slightly towards the inside.  They form a disc, whose border (the horizon) is one simple
cycle.  No edge of the horizon is in line with the new point, since otherwise the plane of the seen triangle at that
edge would contain the point.  So no triangle without area arises.  Triangles may share a plane, and a former corner may
end up inside a face or an edge; ``facets.faces`` merges such triangles at the end.

Signs are first computed in floating point, from images of points and planes, with a bound on their errors.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from modern.exact_hull.coordinates import IntPoint
from modern.exact_hull.facets import Triangle, plane_through, value
from modern.exact_hull.result import Plane

# Points are moved by an integer vector so that the origin is their middle.  Each axis is then divided by a power of two
# such that every image has |x| <= 1.  A plane A x + B y + C z + D through one of the points is divided by the power of
# two that brings the largest of |A| 2^k, |B| 2^l, |C| 2^m (2^k, 2^l, 2^m being the divisors of the axes) to at most 1;
# then |D| <= 3.  All images are the nearest float64 (Python's int / int rounds correctly at any length).
#
# The bound: with e = 2**-54 the images of x and A have errors of at most e each, that of D 4e.  A product of images has
# an error of 2e, and e more once it is rounded; three of them have 9e.  The three additions, in any order and with or
# without fused products, have partial sums below 8 and round by at most 8e each, together 24e.  The sum has an error of
# at most 9e + 4e + 24e = 37e < 64e = 2**-48.  Underflow adds at most about 2**-1070.  So a computed value beyond 2**-48
# has the true sign, and any value closer to zero is computed in integers.
#
# If the points are small enough, all of this arithmetic is exact and the bound is 0; see ``Frame.bound``.
BOUND = 2.0**-48


@dataclass(frozen=True, slots=True)
class Frame:
    """Points moved by an integer vector so that the origin is in their middle, and their float64 images.

    centre: the point that is moved to the origin. shifts: the exponents of the powers of two that divide the axes.
    integers: the moved points. images: (n, 4) float64, with 1 in the fourth column. bound: 2**-48, or 0 if every step
    of evaluating a plane is an integer below 2**53, which float64 holds exactly (48 times the product of the largest
    coordinates is a bound).
    """

    centre: IntPoint
    shifts: IntPoint
    integers: list[IntPoint]
    images: NDArray[np.float64]
    bound: float


def frame(points: Sequence[IntPoint]) -> Frame:
    """Return the frame of points that do not lie in one plane."""
    columns = list(zip(*points, strict=True))
    centre = tuple((min(column) + max(column)) // 2 for column in columns)
    moved = [[number - middle for number in column] for column, middle in zip(columns, centre, strict=True)]
    largest = [max(max(column), -min(column)) for column in moved]
    shifts = tuple(number.bit_length() for number in largest)
    images = np.ones((len(points), 4))
    for axis in range(3):
        divisor = 1 << shifts[axis]
        images[:, axis] = [number / divisor for number in moved[axis]]
    # See ``Frame.bound``.
    exact = 48 * largest[0] * largest[1] * largest[2] < 2**53
    return Frame(
        (centre[0], centre[1], centre[2]),
        (shifts[0], shifts[1], shifts[2]),
        list(zip(*moved, strict=True)),
        images,
        0.0 if exact else BOUND,
    )


def plane_image(plane: Plane, shifts: IntPoint) -> tuple[float, float, float, float]:
    """Return the float64 image of a plane through a point of the frame."""
    a, b, c, d = plane
    k, l, m = shifts  # noqa: E741
    power = max(a.bit_length() + k if a else 0, b.bit_length() + l if b else 0, c.bit_length() + m if c else 0)
    return (
        a / (1 << power - k) if a else 0.0,
        b / (1 << power - l) if b else 0.0,
        c / (1 << power - m) if c else 0.0,
        d / (1 << power),
    )


# Why one triangle for each waiting point is enough: let q see the triangle f, which point p sees and removes, and let m
# be a point inside f.  The segment q m is outside the old hull up to m, and m is interior to the new hull.  The segment
# therefore enters the new hull through a new triangle, which q sees.  So a waiting point needs to be compared only with
# the new triangles, and if it sees none of them it belongs to the hull.
_Horizon = list[tuple[int, int, int]]


class Surface:
    """The surface while it grows, as parallel lists indexed by triangle, in which removed triangles keep their index.

    Corners are counterclockwise seen from outside. ``neighbours[t][k]`` is the triangle beyond edge k of triangle t.
    ``waiting`` has the points waiting outside each triangle, and ``home`` the triangle of each point, or -1. ``mark``
    is the result of the last test of visibility with its point (see ``_visible``).
    """

    def __init__(self, frame: Frame, simplex: Sequence[int]) -> None:
        self.frame = frame
        self.point_images: list[list[float]] = frame.images[:, :3].tolist()
        self.corners: list[Triangle] = []
        self.neighbours: list[list[int]] = []
        self.planes: list[Plane] = []
        self.images: list[tuple[float, float, float, float]] = []
        self.waiting: list[list[int]] = []
        self.alive: list[bool] = []
        self.mark: list[int] = []
        self.home: list[int] = [-1] * len(frame.integers)
        # The first tetrahedron.  Its fourth point is on the inner side of the plane of the first triangle.
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
        """Return True if point ``p`` sees the triangle, that is, if it is strictly outside the triangle's plane."""
        a, b, c, d = self.images[triangle]
        x, y, z = self.point_images[p]
        approximate = a * x + b * y + c * z + d
        if approximate > self.frame.bound:
            return True
        if approximate < -self.frame.bound:
            return False
        return value(self.planes[triangle], self.frame.integers[p]) > 0

    def _distribute(self, points: list[int], triangles: range) -> None:
        """Let every point wait outside one of ``triangles`` (up to the newest) that it sees; the others are inside."""
        if not points:
            return
        bound = self.frame.bound
        # One matrix product gives all approximate values; each point takes the triangle with the largest one.
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
        for triangle in doubtful.tolist():
            if value(self.planes[triangle], self.frame.integers[p]) > 0:
                return int(triangle)
        return -1

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
        """Return the triangles with their planes in the coordinates of the frame, not reduced to lowest terms."""
        return [
            (corners, plane)
            for corners, plane, alive in zip(self.corners, self.planes, self.alive, strict=True)
            if alive
        ]


def convex_surface(frame: Frame, simplex: Sequence[int], order: Sequence[int]) -> list[tuple[Triangle, Plane]]:
    """Return the hull as triangles, from four affinely independent points and the others in ``order``."""
    surface = Surface(frame, simplex)
    for p in order:
        surface.insert(p)
    return surface.triangles()

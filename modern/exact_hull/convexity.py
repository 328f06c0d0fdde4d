"""The proof that a closed surface of polygons is the hull of many points, without every point against every plane.

``prove`` checks, in exact arithmetic:

a. every plane is in lowest terms, occurs once and holds the corners of its polygon; every corner is called a vertex,
   and every vertex is a corner; a polygon turns left everywhere and goes around once, seen from outside;
b. every directed edge occurs once and its reverse once, and V - E + F = 2;
c. the point o is strictly inside of every facet's plane;
d. at every edge, the polygon beyond it is strictly inside of this polygon's plane;
e. the ray from o through the middle of the first triangle meets no other triangle, where every polygon is cut into
   triangles from its first corner;
f. every other point has been found in the cone from o over one triangle, and is inside of that facet's plane, or on
   it if and only if it is called boundary; or, where no cone was found, it has been put into every plane.

Why this proves it (Mehlhorn, Naeher, Seel, Seidel, Schilz, Schirra and Uhrig, Checking geometric programs or
verification of geometric structures, Computational Geometry 12 (1999), 85-103, prove c, d and e enough for closed
simplicial surfaces of any dimension; for polygons in space it runs as follows).

1. Look at the facets from o.  By a and c every facet is seen from behind, its corners in the same sense of rotation,
   and covers a convex spherical polygon.  By b two facets at an edge run along it in opposite senses, so they lie on
   both sides of what is seen of it.  So the surface covers the sphere of directions without folds except, perhaps, at
   the finitely many corners: a direction that is no corner's has a neighbourhood that every sheet over it covers once.
   The number of sheets is thus constant over the sphere without those directions, which is connected; by e it is 1
   somewhere (the ray runs within one triangle and misses all others, their borders included).  So the cones over the
   facets fill space, and no two have inner points in common.  A corner at which the surface touched itself would have
   two sheets around.
2. For a facet f let L(f) be the linear function that is 0 at o and 1 on its plane: where the plane's value at x is
   v(x), L(f)(x) = 1 - v(x) / v(o), and v(o) < 0 by c.  Let g be the function that is L(f) in the cone over f.  It is
   defined everywhere by 1, and continuous, since two facets at an edge both have the value 1 on it and 0 at o.  At the
   wall between the cones of f and of its neighbour h, g bends upwards: by d a corner q of h has L(f)(q) < 1 = L(h)(q).
   On a line that meets walls only where two cones meet g is linear in pieces with slopes that grow, so it is convex
   there; every segment is a limit of such, so g is convex, and it is the largest of all L(f).
3. So the body K of all x with g(x) <= 1 is convex, it is where all planes have no positive value, and the polygons
   are its surface.  As g really bends at every edge, K's face in the plane of f is the polygon f and no more, and by
   a its corners are corners of K: points that no two others of K have between them.
4. A point x in the cone over f has g(x) = L(f)(x): it is in K if and only if v(x) <= 0, and on the surface if and
   only if v(x) = 0.  By f every point is in K; and K is the hull of its corners, which are points.

How a cone is found is of no account: a walk from cone to cone over planes through o that the point is beyond, in
float64, and where these leave a doubt in integers.  Points on an edge of the hull are always in doubt: they are in the
plane through o and the edge, and so in the cones of both sides.

Signs are computed in float64 first.  The points' box has the corner c, and each axis its own power of two s not less
than the box's side: the image of x is (x - c) / s, from 0 to 1.  A normal's image is (A sx, B sy, C sz) / w, w the
power of two that makes the largest of them at most 1.  With e = 2**-54 all images are off by at most e (nearest
float64 of the exact quotient; the division by a power of two is exact).  o is given by its image, exactly.  A
difference of images d is below 1 in size and off by at most 3e: by e for each image and e once rounded.

A plane's value, N . (x - p) with a corner p, has products off by 3e + e + e = 5e, three by 15e; the additions, of sums
below 2 and below 4, round by 2e and 4e: 21e.  The plane of a cone's wall through o and the edge a b has the normal
m = (a - o) x (b - o) with products off by 3e + 3e + e = 7e, two by 14e, and the subtraction rounds by 2e: m is off by
16e and at most 2 in size.  In m . (x - o) a product is off by 16e + 2 * 3e + 2e = 24e, three by 72e; the additions, of
sums below 4 and below 8, round by 4e and 8e: 84e.  Products of two errors and underflow add less than e.  All this
is below BOUND = 2**-47 = 128e, and holds with fused products too, which round less often.  A value beyond the bound has
the true sign; the others, and what were no number, are computed in integers.

Most points of a large set are nearer to o than any plane, which one distance each tells.  With r the least of
-N . (o - p) / |N| over all planes, a point whose image is within r of o has N . (x - p) = N . (o - p) + N . (x - o) <
-|N| r + |N| r = 0 for every plane.  As computed r and the distance are off by less than 128e each, |N| being at least
1/2; points are taken that are within r - 2**-40.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from modern.exact_hull.coordinates import IntPoint
from modern.exact_hull.incidences import BOUND, Incidences
from modern.exact_hull.polygons import (
    Floats,
    Images,
    Ints,
    Objects,
    Polygons,
    check_planes,
    images_of,
    normal_images,
    polygons,
    values,
)
from modern.exact_hull.result import CertificateError, ExactHull

_BLOCK = 1 << 12
_BALL = 2.0**-40
_STARTS = 256
"""Triangles among which a walk's first is chosen."""
_STEPS = 64
"""Steps of a walk in integers, which begins beside the cone."""


class Undecided(Exception):
    """The surface is too thin for o, or for the ray, as float64 has them: every point is to be put into every plane."""


@dataclass(frozen=True, slots=True)
class Cones:
    """The triangles that the polygons are cut into from their first corners, and their cones from o.

    corners (t, 3); facet; beyond (t, 3): the triangle beyond the edge from corner k to the next; walls (t, 3, 3):
    m of that edge, positive towards the triangle.
    """

    corners: Ints
    facet: Ints
    beyond: Ints
    walls: Floats


def cones(sides: Polygons, images: Images, o: Floats) -> Cones:
    """The cones over all polygons."""
    each = sides.count - 2
    facet = np.repeat(np.arange(len(each)), each)
    start = np.cumsum(each) - each
    number = np.arange(len(facet)) - start[facet]
    first = sides.first[facet]
    corners = np.stack([first, first + number + 1, first + number + 2], axis=1)
    place = np.arange(len(sides.corner)) - sides.first[sides.facet]
    triangle = start[sides.facet] + np.clip(place - 1, 0, sides.count[sides.facet] - 3)
    across = triangle[sides.twin]
    own = np.arange(len(facet))
    beyond = np.stack(
        [
            np.where(number == 0, across[first], own - 1),
            across[first + number + 1],
            np.where(number == each[facet] - 1, across[first + sides.count[facet] - 1], own + 1),
        ],
        axis=1,
    )
    corners = sides.corner[corners]
    a, b, c = (images.places[corners[:, k]] - o for k in range(3))
    walls = np.stack([_product(a, b), _product(b, c), _product(c, a)], axis=1)
    return Cones(corners, facet, beyond, walls)


def _product(u: Floats, v: Floats) -> Floats:
    (u1, u2, u3), (v1, v2, v3) = u.T, v.T
    return np.stack([u2 * v3 - u3 * v2, u3 * v1 - u1 * v3, u1 * v2 - u2 * v1], axis=1)


@dataclass
class _Proof:
    """The parts put together, and what was counted."""

    hull: ExactHull
    sides: Polygons
    planes: Objects
    images: Images
    normals: Floats
    o: Floats
    cones: Cones
    evaluations: int = 0
    in_integers: int = 0

    @cached_property
    def middle(self) -> tuple[IntPoint, int]:
        """o as integers and what to divide them by."""
        return self.images.exactly(self.o)

    def signs(self, facets: Ints, points: Ints) -> Ints:
        """Signs of planes at points, pair by pair."""
        base = self.images.places[self.sides.corner[self.sides.first[facets]]]
        found = np.einsum("ij,ij->i", self.normals[facets], self.images.places[points] - base)
        signs: Ints = np.sign(found).astype(np.int64)
        doubtful = np.flatnonzero(~(abs(found) > BOUND))
        if doubtful.size:
            exact = values(self.planes, self.hull.scaled, facets[doubtful], points[doubtful])
            signs[doubtful] = (exact > 0).astype(np.int64) - (exact < 0)
        self.evaluations += len(facets)
        self.in_integers += len(doubtful)
        return signs

    def check_middle(self) -> float:
        """That o is strictly inside of every plane; returns r."""
        bases = self.images.places[self.sides.corner[self.sides.first]]
        found = np.einsum("ij,ij->i", self.normals, self.o - bases)
        for facet in np.flatnonzero(~(found < -BOUND)).tolist():
            a, b, c, d = self.hull.facets[facet].plane
            (x, y, z), weight = self.middle
            self.in_integers += 1
            if a * x + b * y + c * z + d * weight >= 0:
                raise Undecided(f"facet {facet} has the middle of the vertices outside")
        self.evaluations += len(found)
        return float((-found / np.sqrt((self.normals**2).sum(axis=1))).min())

    def check_edges(self) -> None:
        """d."""
        sides = self.sides
        beyond = sides.corner[sides.next[sides.next[sides.twin]]]
        for side in np.flatnonzero(self.signs(sides.facet, beyond) >= 0):
            raise CertificateError(f"point {beyond[side]} is outside of facet {sides.facet[side]}, or in its plane")

    def wall_sign(self, triangle: int, edge: int, place: Floats | int) -> int:
        """The exact sign of m . (x - o); x is a point, or what has an image."""
        o, weight = self.middle
        corners = self.cones.corners[triangle].tolist()

        def from_o(point: IntPoint, divisor: int = 1) -> IntPoint:
            x, y, z = (number * weight - middle * divisor for number, middle in zip(point, o, strict=True))
            return x, y, z

        a1, a2, a3 = from_o(self.hull.scaled[corners[edge]])
        b1, b2, b3 = from_o(self.hull.scaled[corners[edge - 2]])
        x, y, z = from_o(self.hull.scaled[place]) if isinstance(place, int) else from_o(*self.images.exactly(place))
        value = (a2 * b3 - a3 * b2) * x + (a3 * b1 - a1 * b3) * y + (a1 * b2 - a2 * b1) * z
        self.in_integers += 1
        return (value > 0) - (value < 0)

    def check_cones(self) -> None:
        """The triangles' sense of rotation; and e."""
        cones = self.cones
        third = self.images.places[cones.corners[:, 2]] - self.o
        size = np.einsum("ij,ij->i", cones.walls[:, 0], third)
        for triangle in np.flatnonzero(~(size > BOUND) & (self.sides.count[cones.facet] == 3)).tolist():
            if self.wall_sign(triangle, 0, int(cones.corners[triangle, 2])) <= 0:
                raise CertificateError(f"facet {cones.facet[triangle]}: no left turn")
        first = int(size.argmax())
        middle = self.images.places[cones.corners[first]].mean(axis=0)
        found = cones.walls @ (middle - self.o)
        missed = (found < -BOUND).any(axis=1)
        for edge in np.flatnonzero(~(found[first] > BOUND)).tolist():
            if self.wall_sign(first, edge, middle) <= 0:
                raise Undecided("the ray is not within its triangle")
        missed[first] = True
        for triangle in np.flatnonzero(~missed).tolist():
            if all(self.wall_sign(triangle, edge, middle) >= 0 for edge in range(3)):
                raise CertificateError(f"a ray meets the facets {cones.facet[first]} and {cones.facet[triangle]}")

    def check_points(self, r: float) -> None:
        """f."""
        hull = self.hull
        points = np.array(hull.boundary + hull.inside, np.int64)
        expected = np.repeat([0, -1], [len(hull.boundary), len(hull.inside)])
        away = self.images.places[points] - self.o
        within = (away**2).sum(axis=1) < max(0.0, r - _BALL) ** 2
        found = np.where(within, -1, 1)
        far = np.flatnonzero(~within)
        facets = np.full(len(points), -1)
        for start in range(0, len(far), _BLOCK):
            block = far[start : start + _BLOCK]
            triangles, sure = self._located(away[block])
            for k in np.flatnonzero(~sure).tolist():
                triangles[k] = self._walked(int(triangles[k]), int(points[block[k]]))
            known = triangles >= 0
            facets[block[known]] = self.cones.facet[triangles[known]]
            found[block[known]] = self.signs(facets[block[known]], points[block[known]])
            doubtful = block[~known]
            height = max(1, _BLOCK // len(self.planes))
            for begin in range(0, len(doubtful), height):
                some = doubtful[begin : begin + height]
                facets[some], found[some] = self._in_every_plane(points[some])
        for place in np.flatnonzero(found > 0):
            raise CertificateError(f"point {points[place]} is outside of facet {facets[place]}")
        for place in np.flatnonzero(found != expected):
            where = "not on" if found[place] else "on"
            raise CertificateError(f"point {points[place]} is {where} a facet, its class says otherwise")

    def _located(self, away: Floats) -> tuple[Ints, NDArray[np.bool_]]:
        """For each of the differences from o the triangle whose cone it is in, and whether that is certain."""
        cones = self.cones
        some = np.linspace(0, len(cones.corners) - 1, min(_STARTS, len(cones.corners))).astype(np.int64)
        middles = self.images.places[cones.corners[some]].mean(axis=1) - self.o
        middles /= np.sqrt((middles**2).sum(axis=1))[:, None]
        at: Ints = some[(away @ middles.T).argmax(axis=1)]
        sure = np.ones(len(away), np.bool_)
        walking = np.arange(len(away))
        for _ in range(len(cones.corners) + 1):
            found = np.einsum("ijk,ik->ij", cones.walls[at[walking]], away[walking])
            edge = found.argmin(axis=1)
            least: Floats = found[np.arange(len(found)), edge]
            beyond = least < -BOUND
            sure[walking[~(least > BOUND) & ~beyond]] = False
            walking, edge = walking[beyond], edge[beyond]
            at[walking] = cones.beyond[at[walking], edge]
            if not walking.size:
                break
        sure[walking] = False
        return at, sure

    def _walked(self, triangle: int, point: int) -> int:
        """The triangle whose cone a point is in, by exact signs, from a triangle beside it on; or -1."""
        for _ in range(_STEPS):
            beyond = [edge for edge in range(3) if self.wall_sign(triangle, edge, point) < 0]
            if not beyond:
                return triangle
            triangle = int(self.cones.beyond[triangle, beyond[0]])
        return -1

    def _in_every_plane(self, points: Ints) -> tuple[Ints, Ints]:
        """For each point a facet whose plane it is outside of, or else on, if there is one; and its sign there."""
        count = len(self.planes)
        every = np.tile(np.arange(count), len(points))
        signs = self.signs(every, np.repeat(points, count)).reshape(len(points), count)
        facets = signs.argmax(axis=1)
        return facets, signs[np.arange(len(points)), facets]


def prove(hull: ExactHull) -> tuple[int, Incidences]:
    """All of the above; the number of edges, and what was counted.

    The hull's points are of dimension 3, its indices those of its points, each in one class.
    Raises CertificateError, and Undecided.
    """
    sides = polygons(hull)
    planes = check_planes(hull, sides)
    images = images_of(hull.scaled)
    names = np.array(hull.vertices)
    # Unequal weights: few points of a symmetrical set are then in a plane through o and an edge.
    o = np.average(images.places[names], axis=0, weights=1 + np.arange(len(names)) * 0.618 % 1)
    normals = normal_images(planes, images.shifts)
    seen = len(sides.corner)  # corners put into their own planes, in integers
    proof = _Proof(hull, sides, planes, images, normals, o, cones(sides, images, o), seen, seen)
    r = proof.check_middle()
    proof.check_edges()
    proof.check_cones()
    proof.check_points(r)
    found = Incidences([], None, "float64 and integers", proof.evaluations, proof.in_integers)
    return len(sides.corner) // 2, found

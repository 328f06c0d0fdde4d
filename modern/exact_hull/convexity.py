"""Prove that a surface of polygons is the hull of many points, without evaluating every plane at every point.

``prove`` checks the following in exact arithmetic:

a. Every plane is in lowest terms, occurs once and contains the corners of its polygon.  The corners of the polygons are
   exactly the points that the result calls vertices.  A polygon turns left everywhere and goes around once, seen from
   outside.
b. Every directed edge occurs once and so does its reverse, and V - E + F = 2.
c. The point o is strictly inside the plane of every facet.
d. If two polygons share an edge, each is strictly inside the plane of the other, except for the shared edge.
e. Every polygon is split into triangles from its first corner.  The ray from o through the middle of the first triangle
   meets no other triangle.
f. For each point that is not a vertex, a triangle is found whose cone from o contains the point.  The point must lie
   in the plane of this triangle if its class is boundary, and strictly inside the plane otherwise.  A point for which
   no cone is found is evaluated in every plane.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from modern.exact_hull.coordinates import Floats, Images, IntPoint, Ints
from modern.exact_hull.planes import BOUND, Planes
from modern.exact_hull.polygons import Polygons, check_planes, polygons
from modern.exact_hull.result import CertificateError, ExactHull, facets_as_arrays

# Why this is a proof.  (Mehlhorn, Naeher, Seel, Seidel, Schilz, Schirra and Uhrig, Checking geometric programs or
# verification of geometric structures, Computational Geometry 12 (1999), 85-103, prove that c, d and e suffice for
# closed simplicial surfaces of any dimension.  For polygons in space the argument is as follows.)
#
# 1. Look at the facets from o.  By a and c every facet is seen from behind, with its corners in the same sense of
#    rotation, and covers a convex spherical polygon.  By b two facets at an edge traverse it in opposite directions, so
#    they lie on different sides of it as seen from o.  Therefore the surface covers the sphere of directions without
#    folds except, perhaps, at the finitely many corners: a direction that is not a corner's has a neighbourhood that
#    every sheet over it covers once.  The number of sheets is thus constant over the sphere without those directions,
#    which is connected.  By e it is 1 somewhere, because the ray passes through the interior of one triangle and misses
#    all others and their borders.  So the cones over the facets fill space, and no two have interior points in common.
#    A corner at which the surface touched itself would be surrounded by two sheets.
# 2. For a facet f let L(f) be the linear function that is 0 at o and 1 on its plane.  If v(x) is the plane's value at
#    x, L(f)(x) = 1 - v(x) / v(o), and v(o) < 0 by c.  Let g be the function that equals L(f) in the cone over f.  It is
#    defined everywhere by 1, and continuous, since two facets at an edge both have the value 1 on it and 0 at o.  At
#    the wall between the cones of f and of its neighbour h, g bends upwards: by d a corner q of h has L(f)(q) < 1 =
#    L(h)(q). On a line that crosses walls only where two cones meet, g is piecewise linear with increasing slopes, so
#    it is convex there.  Every segment is a limit of such segments, so g is convex, and it is the maximum of all L(f).
# 3. So the body K of all x with g(x) <= 1 is convex, it consists of the points at which no plane has a positive value,
#    and the polygons are its surface.  As g bends strictly at every edge, the face of K in the plane of f is exactly
#    the polygon f, and by a its corners are corners of K, which lie between no two other points of K.
# 4. A point x in the cone over f has g(x) = L(f)(x): it is in K if and only if v(x) <= 0, and on the surface if and
#    only if v(x) = 0.  By f every point is in K, and K is the hull of its corners, which are points.
#
# The proof does not depend on how a cone is found.  The search walks from cone to cone across planes through o that the
# point is beyond, in float64, and in integers if the sign is in doubt.  Points on an edge of the hull are always in
# doubt: they lie in the plane through o and the edge, and so in the cones of both sides.
_BLOCK = 1 << 12
# Signs of planes at points are exact (see ``planes``), and o is given by its image, exactly.  The wall of a cone, the
# plane through o and the edge a b, has the normal m = (a - o) x (b - o).  With e = 2**-54 its products have errors of
# 3e + 3e + e = 7e, two of them 14e, and the subtraction rounds by 2e, so m has an error of 16e and is at most 2 in
# absolute value.  In m . (x - o) a product has an error of 16e + 2 * 3e + 2e = 24e, three of them 72e.  The additions,
# of sums below 4 and below 8, round by 4e and 8e.  The total is 84e, below BOUND = 128e, also with fused products.
# Most points of a large set are closer to o than any plane, which one distance shows for all planes.  Let r be the
# least of -N . (o - p) / |N| over all planes.  A point whose image is within r of o has N . (x - p) = N . (o - p) + N .
# (x - o) < -|N| r + |N| r = 0 for every plane.  The computed r and distance have errors below 128e each, |N| being at
# least 1/2. Points within r - 2**-40 are accepted in this way.
_BALL = 2.0**-40
# The walk to a point's cone begins at one of this number of triangles.
_STARTS = 256
# The maximum number of steps of a walk in integers, which begins near the cone of the point.
_STEPS = 64


class Undecided(Exception):
    """Raised if float64 is not precise enough to find an inner point or ray.

    The caller then evaluates every plane at every point.
    """


@dataclass(frozen=True, slots=True)
class Cones:
    """The polygons split into triangles, and for each triangle the cone from the inner point o through it.

    For each of the t triangles, ``corners`` (t, 3) has the indices of its corners, ``facet`` (t) has the facet that it
    belongs to, and ``beyond`` (t, 3) has the neighbouring triangle at each edge.  ``walls`` (t, 3, 3) has, for each
    edge of each triangle, the normal of the plane through o and the edge, which points towards the inside of the cone.
    """

    corners: Ints
    facet: Ints
    beyond: Ints
    walls: Floats


def cones(sides: Polygons, images: Images, o: Floats) -> Cones:
    # A polygon of n sides is split into n - 2 triangles, which are numbered consecutively, facet after facet.
    triangles = sides.count - 2
    facet = np.repeat(np.arange(len(triangles)), triangles)
    start = np.cumsum(triangles) - triangles
    number = np.arange(len(facet)) - start[facet]
    first = sides.first[facet]
    corners = np.stack([first, first + number + 1, first + number + 2], axis=1)
    # For each side of a polygon, the triangle that contains it: the first triangle also has side 0, the last also the
    # last side.
    position = np.arange(len(sides.corner)) - sides.first[sides.facet]
    triangle = start[sides.facet] + np.clip(position - 1, 0, sides.count[sides.facet] - 3)
    across = triangle[sides.twin]
    own = np.arange(len(facet))
    # Two edges of an inner triangle are diagonals of its polygon, beyond which are the previous and the next triangle.
    beyond = np.stack(
        [
            np.where(number == 0, across[first], own - 1),
            across[first + number + 1],
            np.where(number == triangles[facet] - 1, across[first + sides.count[facet] - 1], own + 1),
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
    """The data of a proof of convexity, and the checks of its conditions."""

    hull: ExactHull
    sides: Polygons
    planes: Planes
    images: Images
    o: Floats
    cones: Cones

    @cached_property
    def middle(self) -> tuple[IntPoint, int]:
        """The inner point o exactly: three numerators and their common denominator."""
        return self.images.exactly(self.o)

    def check_middle(self) -> float:
        """Check that the inner point o is inside all planes (condition c).  Return its least distance from a plane."""
        bases = self.images.places[self.sides.corner[self.sides.first]]
        normals = self.planes.normals
        approximate = np.einsum("ij,ij->i", normals, self.o - bases)
        for facet in np.flatnonzero(~(approximate < -BOUND)).tolist():
            a, b, c, d = self.planes.table[facet].tolist()
            (x, y, z), weight = self.middle
            self.planes.in_integers += 1
            if a * x + b * y + c * z + d * weight >= 0:
                raise Undecided(f"the middle of the vertices is not inside facet {facet}")
        self.planes.evaluations += len(approximate)
        return float((-approximate / np.sqrt((normals**2).sum(axis=1))).min())

    def check_edges(self) -> None:
        """Check that each polygon's neighbours are strictly inside its plane (condition d)."""
        sides = self.sides
        # The corner that follows the edge in the neighbouring polygon.
        beyond = sides.corner[sides.next[sides.next[sides.twin]]]
        for side in np.flatnonzero(self.planes.signs(sides.facet, beyond) >= 0):
            raise CertificateError(f"point {beyond[side]} is outside of facet {sides.facet[side]}, or in its plane")

    def wall_sign(self, triangle: int, edge: int, place: Floats | int) -> int:
        """Return the exact sign that shows on which side of a cone's wall a point lies.

        The wall is the plane through o and an edge of the triangle.  ``place`` is the index of the point, or its
        coordinates in the unit box.
        """
        o, weight = self.middle
        corners = self.cones.corners[triangle].tolist()

        def from_o(point: IntPoint, divisor: int = 1) -> IntPoint:
            x, y, z = (number * weight - middle * divisor for number, middle in zip(point, o, strict=True))
            return x, y, z

        a1, a2, a3 = from_o(self.hull.scaled[corners[edge]])
        b1, b2, b3 = from_o(self.hull.scaled[corners[edge - 2]])
        x, y, z = from_o(self.hull.scaled[place]) if isinstance(place, int) else from_o(*self.images.exactly(place))
        value = (a2 * b3 - a3 * b2) * x + (a3 * b1 - a1 * b3) * y + (a1 * b2 - a2 * b1) * z
        self.planes.in_integers += 1
        return (value > 0) - (value < 0)

    def check_cones(self) -> None:
        """Check that facets face outward and that a ray from the inner point meets only one triangle (condition e)."""
        cones = self.cones
        third = self.images.places[cones.corners[:, 2]] - self.o
        size = np.einsum("ij,ij->i", cones.walls[:, 0], third)
        for triangle in np.flatnonzero(~(size > BOUND) & (self.sides.count[cones.facet] == 3)).tolist():
            if self.wall_sign(triangle, 0, int(cones.corners[triangle, 2])) <= 0:
                raise CertificateError(f"facet {cones.facet[triangle]}: the polygon does not turn left at a vertex")
        first = int(size.argmax())
        middle = self.images.places[cones.corners[first]].mean(axis=0)
        # The ray passes through the middle of the largest triangle, because it then misses the others most clearly.
        wall_values = cones.walls @ (middle - self.o)
        missed = (wall_values < -BOUND).any(axis=1)
        for edge in np.flatnonzero(~(wall_values[first] > BOUND)).tolist():
            if self.wall_sign(first, edge, middle) <= 0:
                raise Undecided("the ray does not pass through the triangle through which it was drawn")
        missed[first] = True
        for triangle in np.flatnonzero(~missed).tolist():
            if all(self.wall_sign(triangle, edge, middle) >= 0 for edge in range(3)):
                pair = f"{cones.facet[first]} and {cones.facet[triangle]}"
                raise CertificateError(f"a ray from inside meets two facets: {pair}")

    def check_points(self, r: float) -> None:
        """Check that each inside point is inside the surface, and each boundary point on it (condition f)."""
        hull = self.hull
        points = np.array(hull.boundary + hull.inside, np.int64)
        expected = np.repeat([0, -1], [len(hull.boundary), len(hull.inside)])
        away = self.images.places[points] - self.o
        # A point in the ball of radius r around o is inside all planes.
        within = (away**2).sum(axis=1) < max(0.0, r - _BALL) ** 2
        signs = np.where(within, -1, 1)
        far = np.flatnonzero(~within)
        facets = np.full(len(points), -1)
        for start in range(0, len(far), _BLOCK):
            block = far[start : start + _BLOCK]
            triangles, certain = self._located(away[block])
            # For doubtful points, a walk in integers decides on which side of a wall they are.
            for k in np.flatnonzero(~certain).tolist():
                triangles[k] = self._walked(int(triangles[k]), int(points[block[k]]))
            known = triangles >= 0
            facets[block[known]] = self.cones.facet[triangles[known]]
            signs[block[known]] = self.planes.signs(facets[block[known]], points[block[known]])
            # Points for which no cone was found are evaluated in every plane.
            if not known.all():
                facets[block[~known]], signs[block[~known]] = self.planes.largest(points[block[~known]])
        for row in np.flatnonzero(signs > 0):
            raise CertificateError(f"point {points[row]} is outside of facet {facets[row]}")
        for row in np.flatnonzero(signs != expected):
            where = "not on" if signs[row] else "on"
            raise CertificateError(f"point {points[row]} is {where} a facet, but the hull states the opposite")

    def _located(self, away: Floats) -> tuple[Ints, NDArray[np.bool_]]:
        """Return, for each point, the triangle whose cone contains it, and True if float64 proves this."""
        cones = self.cones
        # Start at the triangle, in a sample of them, whose direction from o is closest to the direction of the point.
        sample = np.linspace(0, len(cones.corners) - 1, min(_STARTS, len(cones.corners))).astype(np.int64)
        middles = self.images.places[cones.corners[sample]].mean(axis=1) - self.o
        middles /= np.sqrt((middles**2).sum(axis=1))[:, None]
        at: Ints = sample[(away @ middles.T).argmax(axis=1)]
        certain = np.ones(len(away), np.bool_)
        walking = np.arange(len(away))
        for _ in range(len(cones.corners) + 1):
            wall_values = np.einsum("ijk,ik->ij", cones.walls[at[walking]], away[walking])
            edge = wall_values.argmin(axis=1)
            least: Floats = wall_values[np.arange(len(wall_values)), edge]
            # Cross the wall that the point is farthest beyond.  If the point is near a wall, the result is in doubt.
            beyond = least < -BOUND
            certain[walking[~(least > BOUND) & ~beyond]] = False
            walking, edge = walking[beyond], edge[beyond]
            at[walking] = cones.beyond[at[walking], edge]
            if not walking.size:
                break
        certain[walking] = False
        return at, certain

    def _walked(self, triangle: int, point: int) -> int:
        """Walk from ``triangle`` to the triangle whose cone contains the point.  Return -1 if this fails."""
        for _ in range(_STEPS):
            beyond = [edge for edge in range(3) if self.wall_sign(triangle, edge, point) < 0]
            if not beyond:
                return triangle
            triangle = int(self.cones.beyond[triangle, beyond[0]])
        return -1


def prove(hull: ExactHull) -> tuple[int, Planes]:
    """Prove that a three-dimensional hull is convex (conditions a to f).  Return the number of edges and the planes.

    Raise CertificateError if a condition fails, and Undecided if no suitable inner point or ray is found.
    """
    facets = facets_as_arrays(hull.facets)
    sides = polygons(hull, facets)
    planes = check_planes(hull, facets, sides)
    images = planes.points.images
    vertices = np.array(hull.vertices)
    # o is a mean with unequal weights, so that few points of a symmetrical set lie in a plane through o and an edge.
    o = np.average(images.places[vertices], axis=0, weights=1 + np.arange(len(vertices)) * 0.618 % 1)
    proof = _Proof(hull, sides, planes, images, o, cones(sides, images, o))
    r = proof.check_middle()
    proof.check_edges()
    proof.check_cones()
    proof.check_points(r)
    return len(sides.corner) // 2, planes

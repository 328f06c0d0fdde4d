"""The data types of an exact hull and of its proof."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import chain, islice

import numpy as np

from modern.exact_hull.coordinates import IntPoint, Ints, Objects
from modern.geometry.hull import LazyTuple

Plane = tuple[int, int, int, int]


class CertificateError(Exception):
    """Raised if a result cannot be proved to be the hull of the points.  The message names the check and the place."""


def require(condition: bool, message: str, *values: object) -> None:
    """Raise CertificateError if the condition is false.  ``values`` are inserted into the message only in this case."""
    if not condition:
        raise CertificateError(message.format(*values))


@dataclass(frozen=True, slots=True)
class Facet:
    """A facet of the hull: a face of a polyhedron, an edge of a polygon, or an end of a segment.

    plane: (A, B, C, D) without a common divisor.  A x + B y + C z + D is 0 on the facet and < 0 at every other point of
        the hull, for *scaled* integer coordinates (x, y, z).  For an edge of a polygon it is the plane through the edge
        at right angles to the plane of the polygon.  For an end of a segment it is the plane through the end at right
        angles to the segment.
    polygon: indices of vertices, beginning with the smallest one.  A face lists them counterclockwise seen from
        outside, an edge has its two ends, and an end of a segment one vertex.
    """

    plane: Plane
    polygon: tuple[int, ...]


class Facets(LazyTuple[Facet]):
    """The facets of a hull as arrays.  An instance equals the tuple of the facets, which are made on access.

    ``planes`` (m, 4) are Python integers. ``corners`` has the corners of all polygons, one polygon after another, and
    ``counts`` has the number of corners of each polygon.
    """

    def __init__(self, planes: Objects, corners: Ints, counts: Ints) -> None:
        self.planes, self.corners, self.counts = planes, corners, counts
        for array in (planes, corners, counts):
            array.flags.writeable = False
        super().__init__(len(planes), lambda: map(Facet, zip(*planes.T.tolist(), strict=True), self.polygons))

    @cached_property
    def polygons(self) -> list[tuple[int, ...]]:
        rest = iter(self.corners.tolist())
        return [tuple(islice(rest, count)) for count in self.counts.tolist()]


def facets_as_arrays(facets: Sequence[Facet]) -> Facets:
    """Return the facets as arrays.  Raise CertificateError if a plane or polygon does not consist of integers."""
    if isinstance(facets, Facets):
        planes, counts = facets.planes, facets.counts
        is_index = facets.corners.dtype == counts.dtype == np.int64 and counts.sum() == len(facets.corners)
    else:
        numbers = list(chain.from_iterable(facet.plane for facet in facets))
        require({len(facet.plane) for facet in facets} <= {4}, "a facet's plane is not four integers")
        planes = np.fromiter(numbers, object, len(numbers)).reshape(-1, 4)
        members = list(chain.from_iterable(facet.polygon for facet in facets))
        is_index = set(map(type, members)) <= {int}
    require(set(map(type, planes.ravel().tolist())) <= {int}, "a facet's plane is not four integers")
    require(is_index, "a polygon contains something that is not an index")
    if isinstance(facets, Facets):
        return facets
    return Facets(planes, np.array(members, np.int64), np.array([len(facet.polygon) for facet in facets], np.int64))


@dataclass(frozen=True, slots=True)
class Certificate:
    """Counts from a successful proof that a hull is correct.

    dimension, points, vertices, edges, facets: the hull's dimension, and its numbers of points, vertices, edges and
    facets.
    arithmetic: "int64", or "float64 and integers" if a floating-point filter was used, or "none" for a point.
    evaluations: how many exact signs of the values of planes at points were computed.
    in_integers: the number of these signs that the floating-point filter could not determine.
    """

    dimension: int
    points: int
    vertices: int
    edges: int
    facets: int
    arithmetic: str
    evaluations: int
    in_integers: int


@dataclass(frozen=True, slots=True)
class ExactHull:
    """An exact convex hull.  All indices refer to the points of the input, from 0.

    dimension: 0 for a point, 1 for a segment, 2 for a polygon, 3 for a polyhedron.
    scale: the least positive integer whose product with every coordinate is an integer.
    scaled: the coordinates times ``scale``, as integers that are made on access (``Coordinates``), or as a tuple.
    vertices, boundary, inside: each point belongs to exactly one of these, except a duplicate, which belongs to none.
        ``boundary`` has the points on the relative boundary that are not vertices, and ``inside`` has the points in the
        relative interior (for a polygon, the interior within its plane).  All three are sorted.
    duplicates: pairs of a point and the first point with the same coordinates, sorted.
    plane: for a polygon only, its plane without a common divisor, with the first nonzero number of A, B, C positive.
    facets: the facets sorted by plane, as a tuple or as ``Facets``.  The hull of a single point has none.
    polygon: for a polygon only, its vertices, smallest index first, counterclockwise seen from the side to which
        (A, B, C) points.
    certificate: the counts of the proof.
    """

    dimension: int
    scale: int
    scaled: Sequence[IntPoint]
    vertices: tuple[int, ...]
    boundary: tuple[int, ...]
    inside: tuple[int, ...]
    duplicates: tuple[tuple[int, int], ...]
    plane: Plane | None
    facets: Sequence[Facet]
    polygon: tuple[int, ...] = ()
    certificate: Certificate | None = field(default=None, compare=False)

    def plane_of(self, facet: Facet | Plane) -> Plane:
        """Convert a plane from the scaled to the original coordinates, in lowest terms."""
        a, b, c, d = facet.plane if isinstance(facet, Facet) else facet
        a, b, c = a * self.scale, b * self.scale, c * self.scale
        divisor = math.gcd(a, b, c, d)
        return a // divisor, b // divisor, c // divisor, d // divisor

    def edges(self) -> tuple[tuple[int, int], ...]:
        """Return the edges as pairs of vertices, smaller index first, sorted."""
        if self.dimension < 2:
            return ((self.vertices[0], self.vertices[1]),) if self.dimension else ()
        pairs = {
            (min(a, b), max(a, b))
            for facet in self.facets
            for a, b in zip(facet.polygon, facet.polygon[1:] + facet.polygon[:1], strict=True)
        }
        return tuple(sorted(pairs))

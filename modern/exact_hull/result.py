"""The result types of the exact hull."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from modern.exact_hull.coordinates import IntPoint

Plane = tuple[int, int, int, int]


class CertificateError(Exception):
    """The result is not proved to be the hull of the points; the message says which check failed, and where."""


def require(condition: bool, message: str) -> None:
    """Raise CertificateError unless the condition holds."""
    if not condition:
        raise CertificateError(message)


@dataclass(frozen=True, slots=True)
class Facet:
    """One facet of the hull within its affine hull: a face of a polyhedron, an edge of a polygon, an end of a segment.

    ``plane`` is (A, B, C, D) without common divisor: A x + B y + C z + D is 0 on the facet and < 0 at every other
    point of the hull, (x, y, z) being the *scaled* integer coordinates.  For a polyhedron that fixes it.  An edge of
    a polygon carries the plane through the edge at right angles to the polygon's own plane; an end of a segment the
    plane at right angles to the segment.

    ``polygon`` holds indices of vertices, from the smallest on: for a face in cyclic order, counterclockwise seen
    from outside; for an edge its two ends, in the polygon's sense of rotation but the smaller index first; for an
    end of a segment that one vertex.
    """

    plane: Plane
    polygon: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Certificate:
    """What ``certify`` counted while it proved a hull.  It has no field for failure: failure is an exception.

    ``evaluations`` are the signs of plane against point that were needed, ``in_integers`` those of them for which
    the floating-point filter could not answer (all are exact; with ``arithmetic`` "int64" no filter is used).
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
    """The convex hull of points, exactly.  All indices are into the points as given, from 0.

    dimension: 0 point, 1 segment, 2 polygon, 3 polyhedron.
    scale: the least positive integer by which every coordinate becomes an integer; ``scaled`` are these integers.
    vertices, boundary, inside: every point belongs to exactly one of these, or is a duplicate.  Duplicates are
        represented by their first occurrence.  ``boundary`` holds points on the relative boundary that are no
        vertices, ``inside`` those in the relative interior (of a polygon: within its plane).  All are sorted.
    duplicates: (index, index of the first point with the same coordinates), sorted.
    plane: of a polygon only: its plane without common divisor, the first nonzero of A, B, C positive.
    facets: see Facet, sorted by plane.  A point has none.
    polygon: of a polygon only: its vertices, counterclockwise seen from the side (A, B, C) points to, smallest first.
    certificate: the proof's counts.
    """

    dimension: int
    scale: int
    scaled: tuple[IntPoint, ...]
    vertices: tuple[int, ...]
    boundary: tuple[int, ...]
    inside: tuple[int, ...]
    duplicates: tuple[tuple[int, int], ...]
    plane: Plane | None
    facets: tuple[Facet, ...]
    polygon: tuple[int, ...] = ()
    certificate: Certificate | None = field(default=None, compare=False)

    def plane_of(self, facet: Facet | Plane) -> Plane:
        """The plane of a facet (or ``plane``) for the coordinates as given, without common divisor."""
        a, b, c, d = facet.plane if isinstance(facet, Facet) else facet
        a, b, c = a * self.scale, b * self.scale, c * self.scale
        divisor = math.gcd(a, b, c, d)
        return a // divisor, b // divisor, c // divisor, d // divisor

    def edges(self) -> tuple[tuple[int, int], ...]:
        """The edges as pairs of vertices, the smaller index first, sorted."""
        if self.dimension < 2:
            return ((self.vertices[0], self.vertices[1]),) if self.dimension else ()
        pairs = {
            (min(a, b), max(a, b))
            for facet in self.facets
            for a, b in zip(facet.polygon, facet.polygon[1:] + facet.polygon[:1], strict=True)
        }
        return tuple(sorted(pairs))

"""Decide exactly if a set of voxels is digitally convex, by the definitions of sections 3.2.2 and 3.2.3.

A digital region is a set of voxels, given as an array of truth values. Definition 3.2.2 requires a voxel of the region
at the midpoint of any two of its voxels. Definition 3.2.3 requires that the half-cell expansion of the region is the
image of a convex solid. Kim and Rosenfeld's test for this property examines the semidigital points (points with at
least one integer coordinate) on the faces of the hull.
"""

import math
from collections.abc import Iterator
from fractions import Fraction
from itertools import combinations, product

import numpy as np
from numpy.typing import NDArray

from modern.exact_hull import ExactHull, exact_hull
from modern.papers.yau_srihari.hull import components, octree_hull

Voxels = NDArray[np.bool_]
Voxel = tuple[int, int, int]
Place = tuple[Fraction, Fraction, Fraction]


def voxels_of(region: Voxels) -> list[Voxel]:
    return [(x, y, z) for x, y, z in np.argwhere(region).tolist()]


def half_cell_expansion(region: Voxels) -> Voxels:
    """Return the half-cell expansion E(S) of a region (3.2.3).

    The lattice of voxels is shifted by half a cell, and E(S) consists of the shifted cells that meet the region. Each
    voxel of the region meets eight shifted cells.
    """
    expanded = np.zeros([size + 1 for size in region.shape], dtype=np.bool_)
    for step in product((0, 1), repeat=3):
        expanded[tuple(slice(k, k + size) for k, size in zip(step, region.shape, strict=True))] |= region
    return expanded


def is_simple(region: Voxels) -> bool:
    """Return True if a set of voxels is simple: 6-connected, and without a gap in any row along an axis (3.2.3)."""
    if components(region) != 1:
        return False
    for axis in range(3):
        padded = np.pad(np.moveaxis(region, axis, -1), ((0, 0), (0, 0), (1, 0)))
        runs = np.count_nonzero(padded[..., 1:] & ~padded[..., :-1], axis=-1)
        if runs.max() > 1:
            return False
    return True


def is_midpoint_convex(region: Voxels) -> bool:
    """Return True if, for any two voxels of a region, a voxel at their midpoint belongs to the region (3.2.2)."""
    inside = set(voxels_of(region))
    return all(any(z in inside for z in midpoint_cover(x, y)) for x, y in combinations(inside, 2))


def midpoint_cover(x: Voxel, y: Voxel) -> list[Voxel]:
    """Return the one, two, four or eight midpoint voxels of two voxels (3.2.2).

    The midpoints between the points of one voxel and the points of the other fill a unit cube around the midpoint of
    the two centres. On each axis on which the sum of the two coordinates is odd, this cube reaches into two voxels.
    """
    ranges = [range((a + b) // 2, (a + b + 1) // 2 + 1) for a, b in zip(x, y, strict=True)]
    return [(i, j, k) for i, j, k in product(*ranges)]


def is_digitally_convex(region: Voxels) -> bool:
    """Return True if a region of voxels passes Kim and Rosenfeld's test of digital convexity (3.2.3).

    The region must be simple (see ``is_simple``). The test examines the semidigital points of the hull of its voxel
    centres: the points on the faces with at least one integer coordinate. Each of these points must be less than 1
    away, on every axis, from the centre of a voxel of the region.
    """
    if not is_simple(region):
        return False
    points = voxels_of(region)
    hull = exact_hull(points)
    return all(_covered(segment, points) for segment in semidigital_segments(hull))


def semidigital_segments(hull: ExactHull) -> Iterator[tuple[Place, Place]]:
    """Yield the segments in which the planes x = k, y = k and z = k, with integers k, intersect the faces of a hull.

    For a face that lies in such a plane, only its intersections with the other two kinds of planes are yielded. This is
    enough for the test in ``is_digitally_convex``. A point within a unit square of the face's plane is less than 1
    away, on every axis, from all four corners of the square. One of the corners belongs to the region if the points on
    the sides of the square pass the test.

    The face of a flat hull is its polygon. If the hull is a segment, the segment itself is yielded, because the region
    can be simple only if the segment is along an axis.
    """
    corners = [tuple(map(Fraction, point)) for point in hull.scaled]
    if hull.dimension < 2:
        ends = hull.vertices
        yield corners[ends[0]], corners[ends[-1]]  # type: ignore[misc]
        return
    cycles = [facet.polygon for facet in hull.facets] if hull.dimension == 3 else [hull.polygon]
    for cycle in cycles:
        polygon: list[Place] = [corners[k] for k in cycle]  # type: ignore[misc]
        for axis in range(3):
            low, high = min(p[axis] for p in polygon), max(p[axis] for p in polygon)
            for k in range(math.ceil(low), math.floor(high) + 1):
                # A plane cuts the boundary of a convex polygon in two points, in one vertex or along an edge.
                section = sorted(set(_boundary_points(polygon, axis, Fraction(k))))
                if section and low < high:
                    yield section[0], section[-1]


def _boundary_points(polygon: list[Place], axis: int, at: Fraction) -> Iterator[Place]:
    """Yield the vertices of a polygon in the plane x[axis] = at, and the points where its sides cross this plane."""
    for p, q in zip(polygon, (*polygon[1:], polygon[0]), strict=True):
        if p[axis] == at:
            yield p
        elif min(p[axis], q[axis]) < at < max(p[axis], q[axis]):
            share = (at - p[axis]) / (q[axis] - p[axis])
            x, y, z = (a + share * (b - a) for a, b in zip(p, q, strict=True))
            yield x, y, z


def _covered(segment: tuple[Place, Place], points: list[Voxel]) -> bool:
    """Return True if every point of a segment is less than 1 away, on every axis, from one of the given voxels."""
    p, q = segment
    # Only a point within the box of the segment, enlarged by less than 1, can be near it.
    box = [range(math.floor(min(a, b)), math.ceil(max(a, b)) + 1) for a, b in zip(p, q, strict=True)]
    inside = [point for point in points if point[0] in box[0] and point[1] in box[1] and point[2] in box[2]]
    spans = sorted(span for point in inside if (span := near_span(p, q, point)))
    reached = Fraction(0)
    if not any(low < 0 for low, _ in spans):
        return False
    # The spans are open intervals sorted by their lower ends. They must cover the interval from t = 0 to t = 1.
    for low, high in spans:
        if low < reached or (low < 0 and reached == 0):
            reached = max(reached, high)
    return reached > 1


def near_span(p: Place, q: Place, point: Voxel) -> tuple[Fraction, Fraction] | None:
    """Return the open interval of t for which p + t (q - p) is less than 1 from ``point`` on every axis, or None."""
    low, high = Fraction(-1), Fraction(2)
    for a, b, c in zip(p, q, point, strict=True):
        along = b - a
        if not along:
            if abs(a - c) >= 1:
                return None
            continue
        first, last = sorted(((c - 1 - a) / along, (c + 1 - a) / along))
        low, high = max(low, first), min(high, last)
    return (low, high) if low < high else None


def convex_deficiency(region: Voxels) -> Voxels:
    """Return the voxels that are in the region's digital hull but not in the region (section 1)."""
    return octree_hull(region).filled & ~region

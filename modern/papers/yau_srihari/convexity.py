"""Digital convexity as section 3.2 defines it, three ways, and the convex deficiency of section 1.

A digital region is a set of voxels, here the truth values of an array.  All tests are exact.  3.2.1 asks for a convex
object whose image the region is; only an object that is given can be proved to be one (:func:`is_image_of_hull`).
3.2.2 asks of every two voxels for a voxel at their midpoint.  3.2.3 asks for a convex solid with the image of the
half-cell expansion; Kim and Rosenfeld's test for it looks at the semidigital points on the faces of the hull.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
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
    """The voxels of a region by their indices."""
    return [(x, y, z) for x, y, z in np.argwhere(region).tolist()]


def half_cell_expansion(region: Voxels) -> Voxels:
    """E(S): the voxels of the lattice moved by half a cell that the region's voxels meet, eight of each (3.2.3)."""
    wide = np.zeros([size + 1 for size in region.shape], dtype=np.bool_)
    for step in product((0, 1), repeat=3):
        wide[tuple(slice(k, k + size) for k, size in zip(step, region.shape, strict=True))] |= region
    return wide


def is_simple(region: Voxels) -> bool:
    """Whether a region is 6-connected and no line along an axis leaves it and comes back (3.2.3)."""
    if components(region) != 1:
        return False
    for axis in range(3):
        padded = np.pad(np.moveaxis(region, axis, -1), ((0, 0), (0, 0), (1, 0)))
        runs = np.count_nonzero(padded[..., 1:] & ~padded[..., :-1], axis=-1)
        if runs.max() > 1:
            return False
    return True


def is_midpoint_convex(region: Voxels) -> bool:
    """Whether of every two voxels a midpoint voxel is in the region (3.2.2).

    Midpoints of points of X and Y fill a unit cube about the middle of the two centres: where X + Y is odd it reaches
    into two voxels, so the cover has one, two, four or eight.
    """
    inside = set(voxels_of(region))
    return all(any(z in inside for z in midpoint_cover(x, y)) for x, y in combinations(inside, 2))


def midpoint_cover(x: Voxel, y: Voxel) -> list[Voxel]:
    """The midpoint voxels of two voxels (3.2.2)."""
    ranges = [range((a + b) // 2, (a + b + 1) // 2 + 1) for a, b in zip(x, y, strict=True)]
    return [(i, j, k) for i, j, k in product(*ranges)]


def is_image_of_hull(region: Voxels) -> bool:
    """Whether the Euclidean hull of the digital points meets no voxel outside the region and so is a preimage.

    A voxel is met if its cube and the hull are not separated by a plane; cubes are taken closed, so the answer True
    is certain, and False says nothing about other objects.
    """
    points = voxels_of(region)
    inside = set(points)
    low, high = (tuple(f(p[k] for p in points) for k in range(3)) for f in (min, max))
    around = product(*(range(a - 1, b + 2) for a, b in zip(low, high, strict=True)))
    return all(place in inside or _apart(points, place) for place in around)


def _apart(points: list[Voxel], voxel: Iterable[int]) -> bool:
    """Whether the hull of the points and the closed cube about a voxel have no point in common.

    They have one if and only if the origin is in the hull of all differences of their corners.
    """
    corners = [[2 * c + d for c, d in zip(voxel, step, strict=True)] for step in product((-1, 1), repeat=3)]
    differences = {tuple(2 * a - b for a, b in zip(p, c, strict=True)) for p in points for c in corners}
    hull = exact_hull([*differences])
    return any(facet.plane[3] > 0 for facet in hull.facets)


def is_digitally_convex(region: Voxels) -> bool:
    """Kim and Rosenfeld's test (3.2.3): the region is simple, and every semidigital point on the faces of the hull of
    its digital points is near one of them."""
    if not is_simple(region):
        return False
    points = voxels_of(region)
    hull = exact_hull(points)
    return all(_covered(segment, points) for segment in semidigital_segments(hull))


def semidigital_segments(hull: ExactHull) -> Iterator[tuple[Place, Place]]:
    """Where the faces of a hull have a whole coordinate: the segments in which planes x = k, y = k, z = k cut them.

    A polygon that lies in such a plane is cut by the other two kinds only: in an open unit square of its plane a
    point is near all four corners, and one of them is a digital point of the region if the polygon's points on the
    square's sides are near one.  Of a flat hull the one polygon is its face, of a segment, which is simple along an
    axis only, the segment.
    """
    corners = [tuple(map(Fraction, point)) for point in hull.scaled]
    if hull.dimension < 2:
        ends = hull.vertices
        yield corners[ends[0]], corners[ends[-1]]  # type: ignore[misc]
        return
    rings = [facet.polygon for facet in hull.facets] if hull.dimension == 3 else [hull.polygon]
    for ring in rings:
        polygon: list[Place] = [corners[k] for k in ring]  # type: ignore[misc]
        for axis in range(3):
            low, high = min(p[axis] for p in polygon), max(p[axis] for p in polygon)
            for k in range(math.ceil(low), math.floor(high) + 1):
                cut = sorted(set(_cut(polygon, axis, Fraction(k))))
                if cut and low < high:
                    yield cut[0], cut[-1]


def _cut(polygon: list[Place], axis: int, at: Fraction) -> Iterator[Place]:
    for p, q in zip(polygon, (*polygon[1:], polygon[0]), strict=True):
        if p[axis] == at:
            yield p
        elif min(p[axis], q[axis]) < at < max(p[axis], q[axis]):
            share = (at - p[axis]) / (q[axis] - p[axis])
            x, y, z = (a + share * (b - a) for a, b in zip(p, q, strict=True))
            yield x, y, z


def _covered(segment: tuple[Place, Place], points: list[Voxel]) -> bool:
    """Whether every point of a segment is near a digital point, that is less than 1 away on every axis."""
    p, q = segment
    spans = sorted(span for point in points if (span := near_span(p, q, point)))
    reached = Fraction(0)
    if not any(low < 0 for low, _ in spans):
        return False
    for low, high in spans:
        if low < reached or (low < 0 and reached == 0):
            reached = max(reached, high)
    return reached > 1


def near_span(p: Place, q: Place, point: Voxel) -> tuple[Fraction, Fraction] | None:
    """The open interval of t in which p + t (q - p) is near a digital point, None where it nowhere is."""
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
    """The voxels of the digital hull that are not in the region (section 1)."""
    return octree_hull(region).filled & ~region

"""The polygons of a surface side by side, their planes as integers, and float64 images, for the proof of its convexity.

What the images are, and how far off: :mod:`modern.exact_hull.convexity`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from modern.exact_hull.coordinates import IntPoint, columns_of
from modern.exact_hull.result import CertificateError, ExactHull, require

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Objects = NDArray[np.object_]

_WIDE, _APART = 1 << 900, 100
"""Integers below 2**900, and these times 2**100, are rounded to float64 without overflow."""


def difference(p: Sequence[int], q: Sequence[int]) -> IntPoint:
    """p - q."""
    return p[0] - q[0], p[1] - q[1], p[2] - q[2]


def product(u: Sequence[int], v: Sequence[int]) -> IntPoint:
    """The vector product."""
    return u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]


def dot(u: Sequence[int], v: Sequence[int]) -> int:
    """The scalar product."""
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def check_convex(polygon: Sequence[int], normal: IntPoint, scaled: Sequence[IntPoint], name: str) -> None:
    """A polygon turns left everywhere, seen from where ``normal`` points to, and goes around once.

    It goes around as often as the side's direction comes to have a positive coordinate, on an axis that is not the
    normal's: a turn of less than 180 degrees passes over no half of the directions.
    """
    require(len(polygon) >= 3, f"{name}: fewer than three vertices")
    sides = [
        difference(scaled[end], scaled[start]) for start, end in zip(polygon, (*polygon[1:], polygon[0]), strict=True)
    ]
    for before, after, index in zip(sides, sides[1:] + sides[:1], (*polygon[1:], polygon[0]), strict=True):
        require(dot(product(before, after), normal) > 0, f"{name}: no left turn at vertex {index}")
    axis = 2 if any(normal[:2]) else 1
    upper = [side[axis] > 0 for side in sides]
    entries = sum(after and not before for before, after in zip(upper, upper[1:] + upper[:1], strict=True))
    require(entries == 1, f"{name}: the polygon goes around {entries} times")


@dataclass(frozen=True, slots=True)
class Polygons:
    """The polygons' corners in a row, one *side* each: from the corner to the next.

    corner: the points (k).  facet: whose side it is.  next: the side after it.  twin: the side that is its reverse.
    first, count: of every facet its first side, and how many it has.
    """

    corner: Ints
    facet: Ints
    next: Ints
    twin: Ints
    first: Ints
    count: Ints


def polygons(hull: ExactHull) -> Polygons:
    """The polygons with what lies beyond their sides.  Raises CertificateError where they do not close."""
    require(bool(hull.facets), "there are no facets")
    given = [facet.polygon for facet in hull.facets]
    count = np.array(list(map(len, given)), np.int64)
    if count.min() < 3:
        raise CertificateError(f"facet {int(count.argmin())}: fewer than three vertices")
    members = list(chain.from_iterable(given))
    require(set(map(type, members)) == {int}, "a polygon is not of indices")
    require(set(hull.vertices).issuperset(members), "a point of a polygon is no vertex")
    corner = np.array(members, np.int64)
    facet = np.repeat(np.arange(len(given)), count)
    first = np.cumsum(count) - count
    after = np.arange(1, len(corner) + 1)
    after[first + count - 1] = first
    lone = np.setdiff1d(hull.vertices, corner)
    if lone.size:
        raise CertificateError(f"point {lone[0]} is called a vertex; no facet has it")
    for number in np.flatnonzero(np.minimum.reduceat(corner, first) != corner[first]):
        raise CertificateError(f"facet {number}: the smallest vertex is not first")
    size = len(hull.scaled)
    pairs = np.sort(facet * size + corner)
    require(not (pairs[1:] == pairs[:-1]).any(), "a facet has a vertex twice")
    keys, reverse = corner * size + corner[after], corner[after] * size + corner
    order = np.argsort(keys)
    keys = keys[order]
    require(not (keys[1:] == keys[:-1]).any(), "an edge occurs twice in the same sense")
    found = np.searchsorted(keys, reverse).clip(max=len(keys) - 1)
    for side in np.flatnonzero(keys[found] != reverse):
        raise CertificateError(f"the edge {corner[side]}-{corner[after[side]]} has a facet on one side only")
    shape = f"{len(hull.vertices)} vertices, {len(corner) // 2} edges, {len(given)} facets"
    require(len(hull.vertices) - len(corner) // 2 + len(given) == 2, f"not Euler's relation: {shape}")
    return Polygons(corner, facet, after, order[found], first, count)


def check_planes(hull: ExactHull, sides: Polygons) -> Objects:
    """The planes (m, 4) as integers: each by itself, and that it holds its polygon's corners.

    Polygons of more than three corners turn left everywhere; of triangles that is left to be seen.
    """
    planes = [facet.plane for facet in hull.facets]
    require(
        set(map(len, planes)) == {4} and set(map(type, chain.from_iterable(planes))) == {int},
        "a facet's plane is not four integers",
    )
    require(planes == sorted(set(planes)), "the facets are not sorted by plane, or a plane occurs twice")
    table: Objects = np.array(planes, object)
    for number in np.flatnonzero((table[:, :3] == 0).all(axis=1)):
        raise CertificateError(f"facet {number}: the normal is 0")
    for number in np.flatnonzero(np.gcd.reduce(table, axis=1) != 1):
        raise CertificateError(f"facet {number}: the plane is not in lowest terms")
    for side in np.flatnonzero(values(table, hull.scaled, sides.facet, sides.corner) != 0):
        raise CertificateError(f"facet {sides.facet[side]}: vertex {sides.corner[side]} is not in its plane")
    for many in np.flatnonzero(sides.count > 3).tolist():
        facet = hull.facets[many]
        check_convex(facet.polygon, facet.plane[:3], hull.scaled, f"facet {many}")
    return table


def values(planes: Objects, scaled: Sequence[IntPoint], facets: Ints, points: Ints) -> Objects:
    """Planes' values at points, pair by pair, as Python integers."""
    names, places = np.unique(points, return_inverse=True)
    known: Objects = np.array([scaled[name] for name in names.tolist()], object).reshape(-1, 3)
    found, at = planes[facets], known[places]
    return np.asarray(found[:, 0] * at[:, 0] + found[:, 1] * at[:, 1] + found[:, 2] * at[:, 2] + found[:, 3])


@dataclass(frozen=True, slots=True)
class Images:
    """The images of points (n, 3), with c and the exponents of s: x = c + s u."""

    low: tuple[int, ...]
    shifts: tuple[int, ...]
    places: Floats

    def exactly(self, place: Floats) -> tuple[IntPoint, int]:
        """The point that has this image, as integers and what to divide them by."""
        pairs = [number.as_integer_ratio() for number in place.tolist()]
        weight = max(under for _, under in pairs)  # powers of two
        x, y, z = (
            low * weight + (over * (weight // under) << shift)
            for (over, under), low, shift in zip(pairs, self.low, self.shifts, strict=True)
        )
        return (x, y, z), weight


def images_of(scaled: Sequence[IntPoint]) -> Images:
    """The images of points that have more than one value on every axis."""
    places = np.empty((len(scaled), 3))
    lows, shifts = [], []
    for axis, column in enumerate(columns_of(scaled)):
        low, high = int(column.min()), int(column.max())
        shift = (high - low).bit_length()
        if column.dtype == np.int64:
            places[:, axis] = np.ldexp((column - low).astype(np.float64), -shift)
        else:
            places[:, axis] = (column - low) / (1 << shift)
        lows.append(low)
        shifts.append(shift)
    return Images(tuple(lows), tuple(shifts), places)


def normal_images(planes: Objects, shifts: Sequence[int]) -> Floats:
    """The images of the planes' normals (m, 3)."""
    normals = planes[:, :3]
    if abs(normals).max() < _WIDE and max(shifts) - min(shifts) < _APART:
        floats = np.ldexp(normals.astype(np.float64), np.array(shifts) - min(shifts))
        exponents = np.frexp(abs(floats).max(axis=1))[1]
        return np.asarray(np.ldexp(floats, -exponents[:, None]))
    rows = []
    for normal in normals.tolist():
        power = max(number.bit_length() + shift for number, shift in zip(normal, shifts, strict=True) if number)
        rows.append([n / (1 << power - shift) if n else 0.0 for n, shift in zip(normal, shifts, strict=True)])
    return np.array(rows)

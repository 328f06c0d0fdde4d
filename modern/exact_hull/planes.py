"""Compute exact signs of planes at points, in floating point if its error bound decides, otherwise in integers.

The construction and the proof use these functions.  The proof computes its planes again, from its own data.

The floating-point filter.  Let c be the corner of the bounding box of the points, and s for each axis a power of two
greater than the side of the box.  The image of x is (x - c) / s, from 0 to 1.  A normal's image is (A sx, B sy, C sz) /
w, where w is the power of two that makes the largest of them at most 1.  With e = 2**-54 all images have an error of at
most e: each image is the float64 nearest to the exact quotient.  Dividing by a power of two is exact.

A difference d of images is below 1 in absolute value and has an error of at most 3e: e for each image and e for
rounding.  The value of a plane is N . (x - p) with a corner p.  Each of its three products has an error of 3e + e + e =
5e, and all three together have an error of 15e.  The additions, of sums below 2 and below 4, round by 2e and 4e.  The
total is 21e.

If many points are compared with many planes, the value is N . x + D with D = -N . p.  Each product has an error of 3e,
and the three together have an error of 9e.  D is below 3 in absolute value.  The three products of D also have errors
of 9e together, and the two additions of D round by 2e each.  The additions to N . x, in any order and with or without
fused products, have partial sums below 8 and round by at most 8e each, together 24e.  The total is 46e.

Products of two errors and underflow add less than e.  All of this is below BOUND = 2**-47 = 128e.  A value beyond the
bound has the true sign.  All others, and NaN, are computed in integers.
"""

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from itertools import chain

import numpy as np

from modern.exact_hull.coordinates import Coordinates, Floats, Ints, Objects
from modern.exact_hull.result import Facet, Facets

BOUND = 2.0**-47
# Numbers below 2**900 may be multiplied by 2**100 in float64 without overflow.
_WIDE, _APART = 2.0**900, 100
_LOW = (1 << 31) - 1
# The number of values computed at a time, small enough to stay in the cache. Their matrix product is also too small for
# numpy's library to split it among threads, which would cost more than it gains while other programs are running.
_BLOCK = 1 << 16


def normal_images(planes: Objects, shifts: Sequence[int]) -> Floats:
    """Return the normals of planes scaled to the unit box of the points, as float64, shape (m, 3)."""
    normals = planes[:, :3]
    # A fast path for numbers of moderate size.  It has the same results as ``normal_image``.
    with suppress(OverflowError):
        floats = normals.astype(np.float64)
        if abs(floats).max() < _WIDE and max(shifts) - min(shifts) < _APART:
            floats = np.ldexp(floats, np.array(shifts) - min(shifts))
            exponents = np.frexp(abs(floats).max(axis=1))[1]
            return np.asarray(np.ldexp(floats, -exponents[:, None]))
    return np.array([normal_image(normal, shifts) for normal in normals.tolist()])


def normal_image(plane: Sequence[int], shifts: Sequence[int]) -> tuple[float, float, float]:
    """Return the normal of one plane scaled to the unit box, as :func:`normal_images` does for many planes."""
    a, b, c = plane[:3]
    k, l, m = shifts  # noqa: E741
    power = max(a.bit_length() + k if a else 0, b.bit_length() + l if b else 0, c.bit_length() + m if c else 0)
    return (
        a / (1 << power - k) if a else 0.0,
        b / (1 << power - l) if b else 0.0,
        c / (1 << power - m) if c else 0.0,
    )


def long_signs(normals: Ints, differences: Ints) -> Ints:
    """Return the exact sign of the scalar product of each row of ``normals`` and the same row of ``differences``.

    Normals are below 2**61 and differences below 2**30 in absolute value.
    """
    # Split each number of the normal into 2**31 high + low, and carry the high part of the sum of low products.
    high = ((normals >> 31) * differences).sum(axis=1)
    low = ((normals & _LOW) * differences).sum(axis=1)
    high += low >> 31
    low &= _LOW
    return np.asarray(np.where(high == 0, low > 0, np.sign(high)), np.int64)


@dataclass
class Planes:
    """Planes as integers, with the points at which they are evaluated.  The points span space.

    ``table`` (m, 4) has the integers A, B, C and D of each plane, and ``bases`` has the index of a point in each plane.

    ``evaluations`` counts the signs computed, and ``in_integers`` those of them that the filter did not determine.
    """

    points: Coordinates
    table: Objects
    bases: Ints
    evaluations: int = 0
    in_integers: int = 0

    @cached_property
    def normals(self) -> Floats:
        return normal_images(self.table, self.points.images.shifts)

    @cached_property
    def whole(self) -> Ints | None:
        """The planes as int64 if every value at a point is below 2**62, else None."""
        if self.points.kind != "i":
            return None
        reach = [max(1, int(column.max()), -int(column.min())) for column in self.points.numbers.T]
        sizes = [max(map(abs, column)) for column in self.table.T.tolist()]
        fits = sum(size * most for size, most in zip(sizes, [*reach, 1], strict=True)) < 2**62
        return self.table.astype(np.int64) if fits else None

    @cached_property
    def _axes(self) -> Ints:
        """The coordinate axis to which each plane is perpendicular, or -1 if there is none."""
        zeros = self.table[:, :3] == 0
        return np.where(zeros.sum(axis=1) == 2, zeros.argmin(axis=1), -1)

    @cached_property
    def _small(self) -> tuple[Ints, bool] | None:
        """The normals as int64, and True if int64 also holds all scalar products of normals and points.

        If int64 does not hold the scalar products, :func:`long_signs` finds their signs.  The value is None if the
        normals themselves do not fit into int64.
        """
        if self.points.kind != "i":
            return None
        sides = [1 << shift for shift in self.points.images.shifts]
        largest = [max(1, *map(abs, column)) for column in self.table[:, :3].T.tolist()]
        if sum(side * most for side, most in zip(sides, largest, strict=True)) < 2**62:
            return self.table[:, :3].astype(np.int64), True
        if max(largest) < 2**61 and max(sides) <= 2**30:
            return self.table[:, :3].astype(np.int64), False
        return None

    def exact(self, facets: Ints, indices: Ints) -> Ints:
        """Return the sign of a plane at a point for each pair of a facet and a point, computed in integers."""
        self.in_integers += len(facets)
        numbers, bases = self.points.numbers, self.bases[facets]
        if self._small:
            normals, single = self._small
            steps = numbers[indices] - numbers[bases]
            if single:
                return np.asarray(np.sign((normals[facets] * steps).sum(axis=1)))
            return long_signs(normals[facets], steps)
        axes = self._axes[facets]
        signs = np.empty(len(facets), np.int64)
        # At a plane perpendicular to an axis, two coordinates are compared.
        rows = np.flatnonzero(axes >= 0)
        if rows.size:
            axis, sense = axes[rows], np.sign(self.table[facets[rows], axes[rows]]).astype(np.int64)
            x, base = numbers[indices[rows], axis], numbers[bases[rows], axis]
            signs[rows] = sense * ((x > base).astype(np.int64) - (x < base))
        rows = np.flatnonzero(axes < 0)
        if rows.size:
            value = self.values(facets[rows], indices[rows])
            signs[rows] = (value > 0).astype(np.int64) - (value < 0)
        return signs

    def outside(self, facets: Ints, indices: Ints) -> Ints:
        """Return the positions of the pairs whose point is not in the plane of their facet.

        Pair k consists of ``facets[k]`` and the point ``indices[k]``.  The pairs must include the base point of each
        facet.
        """
        self.evaluations += len(facets)
        if not self._small:
            self.in_integers += len(facets)
            return np.flatnonzero(self.values(facets, indices))
        at_bases = self.values(np.arange(len(self.table)), self.bases) != 0
        return np.flatnonzero(self.exact(facets, indices).astype(np.bool_) | at_bases[facets])

    def values(self, facets: Ints, indices: Ints) -> Objects:
        """Return the value of a plane at a point for each pair of a facet and a point."""
        distinct, positions = np.unique(indices, return_inverse=True)
        plane, at = self.table[facets].T, self.points.integers(distinct)[positions].T
        return np.asarray(plane[0] * at[0] + plane[1] * at[1] + plane[2] * at[2] + plane[3])

    def signs(self, facets: Ints, indices: Ints) -> Ints:
        """Return the sign of a plane at a point for each pair of a facet and a point."""
        places = self.points.images.places
        steps = places[indices] - places[self.bases[facets]]
        approximate = np.einsum("ij,ij->i", self.normals[facets], steps)
        signs: Ints = np.sign(approximate).astype(np.int64)
        # The comparison is negated so that a NaN counts as doubtful too.
        doubtful = np.flatnonzero(~(abs(approximate) > BOUND))
        if doubtful.size:
            signs[doubtful] = self.exact(facets[doubtful], indices[doubtful])
        self.evaluations += len(facets)
        return signs

    def near(self, indices: Ints) -> Iterator[tuple[Ints, Ints, Ints]]:
        """Compare each point with all planes, and yield the pairs whose sign the filter does not prove to be -1.

        The pairs are yielded in blocks of three arrays: positions in ``indices``, planes, and the exact signs (0, 1 or
        -1) of the planes at these points.
        """
        count, whole = len(self.table), self.whole
        if whole is None:
            places = self.points.images.places
            offsets = (self.normals * places[self.bases]).sum(axis=1)
        height = max(1, _BLOCK // count)
        for start in range(0, len(indices), height):
            block = indices[start : start + height]
            if whole is not None:
                exact = self.points.numbers[block] @ whole[:, :3].T + whole[:, 3]
                rows, facets = np.nonzero(exact >= 0)
                yield rows + start, facets, np.sign(exact[rows, facets])
                continue
            approximate = places[block] @ self.normals.T - offsets
            rows, facets = np.nonzero(~(approximate < -BOUND))
            values = approximate[rows, facets]
            signs = np.sign(values).astype(np.int64)
            doubtful = np.flatnonzero(~(abs(values) > BOUND))
            if doubtful.size:
                signs[doubtful] = self.exact(facets[doubtful], block[rows[doubtful]])
            yield rows + start, facets, signs
        self.evaluations += len(indices) * count

    def largest(self, indices: Ints) -> tuple[Ints, Ints]:
        """Return, for each point, a facet whose plane has the greatest sign at the point, and this sign."""
        facets, largest = np.zeros(len(indices), np.int64), np.full(len(indices), -1)
        for rows, columns, signs in self.near(indices):
            np.maximum.at(largest, rows, signs)
            at = signs == largest[rows]
            facets[rows[at][::-1]] = columns[at][::-1]  # the first of several facets remains
        return facets, largest


def facet_planes(points: Coordinates, facets: Sequence[Facet]) -> Planes:
    """Return the planes of the given facets, each with a vertex of its facet as base point."""
    if isinstance(facets, Facets):
        return Planes(points, facets.planes, facets.corners[np.cumsum(facets.counts) - facets.counts])
    numbers = chain.from_iterable(facet.plane for facet in facets)
    table: Objects = np.fromiter(numbers, object, 4 * len(facets)).reshape(-1, 4)
    return Planes(points, table, np.array([facet.polygon[0] for facet in facets]))

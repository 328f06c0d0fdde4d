"""Evaluate every plane at every point exactly, for the certificate only, with a separately derived error bound."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from modern.exact_hull.coordinates import IntPoint, Ints, Objects
from modern.exact_hull.result import Plane

# The number of values computed at a time. So few values stay in the cache. Their matrix product is also too small for
# numpy's library to split it among threads, which would cost more than it gains while other programs are running.
_BLOCK = 1 << 16
BOUND = 2.0**-47


@dataclass(frozen=True, slots=True)
class Incidences:
    """The result of evaluating planes at points.

    ``touching`` are the pairs (plane, point) whose point lies in the plane.  ``outside`` is one pair whose point lies
    outside the plane, or None.  ``evaluations`` counts the values computed, ``in_integers`` those in Python integers.
    """

    touching: list[tuple[int, int]]
    outside: tuple[int, int] | None
    arithmetic: str
    evaluations: int
    in_integers: int


def _in_int64(planes: Sequence[Plane], points: Ints) -> Incidences:
    # Evaluate a block of planes at a time at all points, and stop at the first positive value: a point outside a plane.
    normals = np.array(planes, dtype=np.int64)
    columns = points.T
    step = max(1, _BLOCK // len(points))
    touching: list[tuple[int, int]] = []
    for start in range(0, len(planes), step):
        block = normals[start : start + step]
        values = block[:, :1] * columns[0] + block[:, 1:2] * columns[1] + block[:, 2:3] * columns[2] + block[:, 3:]
        if (values > 0).any():
            row, column = np.argwhere(values > 0)[0].tolist()
            return Incidences(touching, (start + row, column), "int64", (start + step) * len(points), 0)
        rows, matches = np.nonzero(values == 0)
        touching += zip((rows + start).tolist(), matches.tolist(), strict=True)
    return Incidences(touching, None, "int64", len(planes) * len(points), 0)


def _images(planes: Sequence[Plane], points: Sequence[IntPoint]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return planes (m, 4) and points (4, n) as float64 images, of absolute value at most 1 except for D.

    With the corner c and the side s of the bounding box of the points, the images are (x - c) / s for a point, and
    normal / w and D / (s w) for a plane, where w is the largest of |A|, |B|, |C| and D is the value at c.
    """
    corner = [min(column) for column in zip(*points, strict=True)]
    side = max(max(column) - low for column, low in zip(zip(*points, strict=True), corner, strict=True))
    point_images = np.ones((4, len(points)))
    for axis in range(3):
        point_images[axis] = [(point[axis] - corner[axis]) / side for point in points]
    plane_images = np.empty((len(planes), 4))
    for row, (a, b, c, d) in enumerate(planes):
        width = max(abs(a), abs(b), abs(c))
        at_corner = a * corner[0] + b * corner[1] + c * corner[2] + d
        plane_images[row] = (a / width, b / width, c / width, at_corner / (side * width))
    return plane_images, point_images


def _in_floats(planes: Sequence[Plane], points: Sequence[IntPoint]) -> Incidences:
    """Evaluate in float64, and in integers if float64 cannot decide the sign.

    Every plane contains a point of the box, so |D| / (s w) <= 3.  With e = 2**-54 the errors are: e in each quotient
    and 4e in that of D; 3e in a rounded product and 9e in three; 24e in three additions of partial sums below 8.  The
    sum is 37e, less than a third of the bound 2**-47 = 128e.
    """
    plane_images, point_images = _images(planes, points)
    step = max(1, _BLOCK // len(points))
    touching: list[tuple[int, int]] = []
    in_integers = 0
    for start in range(0, len(planes), step):
        # Only values that may be zero or positive need integers.
        values = plane_images[start : start + step] @ point_images
        rows, columns = np.nonzero(values > -BOUND)
        in_integers += len(rows)
        for row, column in zip((rows + start).tolist(), columns.tolist(), strict=True):
            a, b, c, d = planes[row]
            x, y, z = points[column]
            exact = a * x + b * y + c * z + d
            if exact > 0:
                return Incidences(touching, (row, column), "float64 and integers", start * len(points), in_integers)
            if exact == 0:
                touching.append((row, column))
    return Incidences(touching, None, "float64 and integers", len(planes) * len(points), in_integers)


def incidences(planes: Sequence[Plane], points: Ints | Objects) -> Incidences:
    """Evaluate every plane at every point (n, 3) exactly, until the first point outside a plane.

    For the bound on D, every plane must contain one of the points, which are not all equal.
    """
    # int64 suffices if no value can reach 2**62.
    reach = [max(1, int(column.max()), -int(column.min())) for column in points.T]
    sizes = [max(1, *(abs(number) for number in column)) for column in zip(*planes, strict=True)]
    if sum(size * most for size, most in zip(sizes, [*reach, 1], strict=True)) < 2**62:
        return _in_int64(planes, points.astype(np.int64))
    return _in_floats(planes, list(map(tuple, points.tolist())))

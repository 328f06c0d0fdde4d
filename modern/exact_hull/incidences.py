"""Every point against every plane, exactly: for the certificate only, which has its own images and its own bound."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from modern.exact_hull.coordinates import IntPoint
from modern.exact_hull.result import Plane

# Values at a time: they stay in the cache, and the product of matrices is too small for numpy's library to split
# among threads, which costs more than it gains when other programs run.
_BLOCK = 1 << 16
BOUND = 2.0**-47


@dataclass(frozen=True, slots=True)
class Incidences:
    """The pairs (plane, point) with the value 0, and the pair of a point outside a plane, if there is one."""

    touching: list[tuple[int, int]]
    outside: tuple[int, int] | None
    arithmetic: str
    evaluations: int
    in_integers: int


def _in_int64(planes: Sequence[Plane], points: Sequence[IntPoint]) -> Incidences:
    normals = np.array(planes, dtype=np.int64)
    columns = np.array(points, dtype=np.int64).T
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
    """Planes (m, 4) and points (4, n) as float64, of size at most 1 except D.

    With the corner c of the points' box and the box's side s: u = (x - c) / s, normal / w, D / (s w), where w is the
    largest of |A|, |B|, |C|, and D is the value at c.
    """
    corner = [min(column) for column in zip(*points, strict=True)]
    side = max(max(column) - low for column, low in zip(zip(*points, strict=True), corner, strict=True))
    place = np.ones((4, len(points)))
    for axis in range(3):
        place[axis] = [(point[axis] - corner[axis]) / side for point in points]
    image = np.empty((len(planes), 4))
    for row, (a, b, c, d) in enumerate(planes):
        width = max(abs(a), abs(b), abs(c))
        at_corner = a * corner[0] + b * corner[1] + c * corner[2] + d
        image[row] = (a / width, b / width, c / width, at_corner / (side * width))
    return image, place


def _in_floats(planes: Sequence[Plane], points: Sequence[IntPoint]) -> Incidences:
    """float64 first, integers where it cannot say.

    Every plane holds a point of the box, so |D| / (s w) <= 3.  With e = 2**-54 the quotients are off by at most e,
    D's by 4e; a product by 3e once rounded, three by 9e; three additions of partial sums below 8 by 24e.  Together
    37e, less than a quarter of the bound 2**-47 = 128e.
    """
    image, place = _images(planes, points)
    step = max(1, _BLOCK // len(points))
    touching: list[tuple[int, int]] = []
    in_integers = 0
    for start in range(0, len(planes), step):
        values = image[start : start + step] @ place
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


def incidences(planes: Sequence[Plane], points: Sequence[IntPoint]) -> Incidences:
    """Every point against every plane, exactly; stops at the first point outside.

    Every plane has a normal other than 0 and holds one of the points (for the bound on D), and there are at least
    two distinct points.
    """
    reach = [max(1, *(abs(number) for number in column)) for column in zip(*points, strict=True)]
    sizes = [max(1, *(abs(number) for number in column)) for column in zip(*planes, strict=True)]
    if sum(size * most for size, most in zip(sizes, [*reach, 1], strict=True)) < 2**62:
        return _in_int64(planes, points)
    return _in_floats(planes, points)

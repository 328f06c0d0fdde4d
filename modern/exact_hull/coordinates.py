"""Convert points to exact numbers, and exact numbers to integers with one common scale."""

import math
from collections.abc import Sequence
from itertools import chain
from typing import Any, TypeGuard

import numpy as np
from numpy.typing import NDArray

from modern.geometry.numbers import Exact, PointsError, real
from modern.geometry.points import Points, check_array, point_rows

ExactPoint = tuple[Exact, Exact, Exact]
IntPoint = tuple[int, int, int]


def _plain(points: Sequence[Any]) -> TypeGuard[list[IntPoint]]:
    """Return True if the points are a list of tuples or lists of three Python integers, which need no conversion."""
    return (
        isinstance(points, list)
        and set(map(type, points)) <= {tuple, list}
        and set(map(len, points)) == {3}
        and set(map(type, chain.from_iterable(points))) == {int}
    )


def _whole(points: NDArray[Any]) -> bool:
    """Return True if an array of floats holds only integers below 2**60."""
    if points.dtype.kind != "f" or points.dtype.itemsize not in (4, 8):
        return False
    with np.errstate(invalid="ignore"):
        return bool((abs(points) < 2.0**60).all() and (points == np.rint(points)).all())


def read_points(points: Points) -> list[ExactPoint]:
    """Return the exact coordinates of every point, in input order.  Raise PointsError for an invalid point."""
    if isinstance(points, np.ndarray):
        check_array(points)
        # Arrays of integers, or of floats that are integers, are converted as a whole.
        if points.shape[1] == 3 and (points.dtype.kind in "iu" or _whole(points)):
            whole = points if points.dtype.kind in "iu" else points.astype(np.int64)
            return list(zip(*whole.T.tolist(), strict=True))
        points = points.tolist()
    if isinstance(points, list) and points and _plain(points):
        return list(map(tuple, points))  # type: ignore[arg-type]
    exact: list[ExactPoint] = []
    for index, row in enumerate(point_rows(points)):
        numbers: list[Exact] = []
        for axis, value in zip("xyz", row, strict=True):
            try:
                numbers.append(real(value))
            except ValueError as error:
                raise PointsError(f"point {index}, coordinate {axis}: {error}") from None
        exact.append((numbers[0], numbers[1], numbers[2]))
    return exact


def common_scale(points: Sequence[ExactPoint]) -> int:
    """Return the least positive integer by which every coordinate becomes an integer: the lcm of the denominators."""
    return math.lcm(*{value.denominator for point in points for value in point})


def to_integers(points: Sequence[ExactPoint], scale: int) -> list[IntPoint]:
    """Return all coordinates times ``scale``, which must be a common multiple of their denominators."""
    if scale == 1:
        return [(x.numerator, y.numerator, z.numerator) for x, y, z in points]
    return [
        (
            x.numerator * (scale // x.denominator),
            y.numerator * (scale // y.denominator),
            z.numerator * (scale // z.denominator),
        )
        for x, y, z in points
    ]


def scaled_points(points: Sequence[ExactPoint]) -> tuple[int, list[IntPoint]]:
    if _plain(points):
        return 1, points
    scale = common_scale(points)
    return scale, to_integers(points, scale)


def columns_of(points: Sequence[IntPoint]) -> list[NDArray[Any]]:
    """Return the coordinates axis by axis, as int64 if all are below 2**62, otherwise as Python integers."""
    try:
        table = np.fromiter(chain.from_iterable(points), np.int64, 3 * len(points))
        if max(int(table.max()), -int(table.min())) < 2**62:
            return list(table.reshape(-1, 3).T)
    except OverflowError:
        pass
    return list(np.array(points, object).T)

"""Check and convert arguments that must be points: an array (n, 3), or a sequence with three coordinates per point.

Every public function that accepts points uses these checks, so that all raise the same errors.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Set
from decimal import Decimal
from fractions import Fraction
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from modern.geometry.numbers import PointsError

Coordinate = int | float | Fraction | Decimal | str | np.integer[Any] | np.floating[Any]
Points = Iterable[Iterable[Coordinate]] | NDArray[Any]
T = TypeVar("T")

# Types of iterables that are rejected as sequences of points or coordinates: a set, for example, has no order.
_NO_SEQUENCE = (str, bytes, bytearray, memoryview, Set, Mapping)


def check_array(points: NDArray[Any]) -> None:
    """Raise PointsError for an array that does not have the shape (n, 3) or does not hold real numbers."""
    if points.dtype.kind not in "iufOU":
        raise PointsError(f"expected an array of real numbers, found {points.dtype}")
    if not points.size:
        raise PointsError("there are no points")
    if points.ndim != 2 or (points.shape[1] != 3 and points.dtype.kind != "O"):
        raise PointsError(f"expected an array of shape (n, 3), found {points.shape}")
    if isinstance(points, np.ma.MaskedArray) and (masked := np.argwhere(np.ma.getmaskarray(points))).size:
        raise PointsError(f"point {masked[0][0]}: a coordinate is masked")


def point_rows(points: Any) -> Iterator[list[Any]]:
    """Yield the coordinates of each point, unchecked.  Raise PointsError unless each point has three coordinates."""
    if isinstance(points, np.ndarray):
        check_array(points)
        points = points.tolist()
    if isinstance(points, _NO_SEQUENCE) or not isinstance(points, Iterable):
        raise PointsError(f"expected a sequence of points, found {type(points).__name__}")
    index = -1
    for index, point in enumerate(points):
        row = point
        if type(point) is not list:
            try:
                row = [] if isinstance(point, _NO_SEQUENCE) else list(point)
            except TypeError:
                row = []
            if not row:
                raise PointsError(f"point {index}: expected 3 coordinates, found {type(point).__name__}")
        if len(row) != 3:
            raise PointsError(f"point {index}: expected 3 coordinates, found {len(row)}")
        yield row
    if index < 0:
        raise PointsError("there are no points")


def converted(points: Points, convert: Callable[[object], T]) -> list[tuple[T, T, T]]:
    """Return the points with every coordinate converted by ``convert``.

    Raise PointsError if a point does not have three coordinates, or if ``convert`` raises ValueError.
    """
    rows = []
    for index, row in enumerate(point_rows(points)):
        numbers = []
        for axis, value in zip("xyz", row, strict=True):
            try:
                numbers.append(convert(value))
            except ValueError as error:
                raise PointsError(f"point {index}, coordinate {axis}: {error}") from None
        rows.append((numbers[0], numbers[1], numbers[2]))
    return rows

"""Points as given, to exact numbers, to integers by one common scale."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from modern.geometry.numbers import Exact, PointsError, real

Coordinate = int | float | Fraction | Decimal | str | np.integer[Any] | np.floating[Any]
ExactPoint = tuple[Exact, Exact, Exact]
IntPoint = tuple[int, int, int]
Points = Iterable[Iterable[Coordinate]] | NDArray[Any]


def read_points(points: Points) -> list[ExactPoint]:
    """The exact coordinates of every point, in the order given.  Raises PointsError."""
    if isinstance(points, np.ndarray):
        if points.dtype.kind not in "iufOU":
            raise PointsError(f"an array of {points.dtype} holds no real numbers")
        if not points.size:
            raise PointsError("there are no points")
        if points.ndim != 2:
            raise PointsError(f"an array of points has the shape (n, 3), not {points.shape}")
        points = points.tolist()
    found: list[ExactPoint] = []
    for index, point in enumerate(points):
        if type(point) in (tuple, list) and len(point) == 3:  # the usual point, quickly
            x, y, z = point
            if type(x) is int and type(y) is int and type(z) is int:
                found.append((x, y, z))
                continue
        if isinstance(point, str):
            raise PointsError(f"point {index}: one text is no point; a point has three coordinates")
        try:
            row = tuple(point)
        except TypeError:
            raise PointsError(
                f"point {index}: a {type(point).__name__} is no point; a point has three coordinates"
            ) from None
        if len(row) != 3:
            raise PointsError(f"point {index}: {len(row)} coordinates; a point has three")
        numbers: list[Exact] = []
        for axis, value in zip("xyz", row, strict=True):
            try:
                numbers.append(real(value))
            except ValueError as error:
                raise PointsError(f"point {index}, coordinate {axis}: {error}") from None
        found.append((numbers[0], numbers[1], numbers[2]))
    if not found:
        raise PointsError("there are no points")
    return found


def common_scale(points: Sequence[ExactPoint]) -> int:
    """The least positive integer that makes every coordinate an integer: the lcm of the denominators."""
    return math.lcm(*{value.denominator for point in points for value in point})


def to_integers(points: Sequence[ExactPoint], scale: int) -> list[IntPoint]:
    """Every coordinate times ``scale``, a multiple of every denominator."""
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

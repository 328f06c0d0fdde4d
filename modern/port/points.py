"""Input points: read exactly, then converted to an arithmetic that is selected by its name."""

from __future__ import annotations

from collections.abc import Iterable
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from emulator.numbers.arithmetic import FAMILIES, PROFILES, profile
from modern.geometry.numbers import Exact, PointsError, real
from modern.port.arithmetic import Arithmetic, RangeError, Vector
from modern.port.binary import MAX_BITS, MIN_BITS, FloatArithmetic, MultiprecisionArithmetic
from modern.port.decimal import Arithmetic1620
from modern.port.exact import exact_arithmetic

Coordinate = int | float | Fraction | Decimal | str | np.integer[Any] | np.floating[Any]
Points = Iterable[Iterable[Coordinate]] | NDArray[Any]
# A number, and whether it is a zero with a minus sign.
Read = tuple[Exact, bool]


def read_number(value: object) -> Read:
    """Read one coordinate. Raise ValueError if it is no real number."""
    number = real(value)
    if number:
        return number, False
    return number, value.strip().startswith("-") if isinstance(value, str) else str(value).startswith("-")


def read_points(points: Points) -> list[Read]:
    """Return the coordinates of all points in one list. Raise PointsError for invalid input."""
    if isinstance(points, np.ndarray):
        _check_shape(points)
        points = points.tolist()
    numbers: list[Read] = []
    index = -1
    for index, point in enumerate(points):
        if isinstance(point, str) or not isinstance(point, Iterable):
            raise PointsError(f"point {index}: expected three coordinates, found {type(point).__name__}")
        row = list(point)
        if len(row) != 3:
            raise PointsError(f"point {index}: expected 3 coordinates, found {len(row)}")
        for axis, value in zip("xyz", row, strict=True):
            try:
                numbers.append(read_number(value))
            except ValueError as error:
                raise PointsError(f"point {index}, coordinate {axis}: {error}") from None
    if index < 0:
        raise PointsError("there are no points")
    return numbers


def first_of_equals(keys: Iterable[object]) -> tuple[list[int], tuple[tuple[int, int], ...]]:
    """Return the indices of the points that are not duplicates, and pairs (duplicate, first point equal to it)."""
    first_index: dict[object, int] = {}
    duplicates = []
    for index, key in enumerate(keys):
        first = first_index.setdefault(key, index)
        if first != index:
            duplicates.append((index, first))
    return list(first_index.values()), tuple(duplicates)


NAMES = ("exact", "float64", "float32", "mp:BITS", *PROFILES, *FAMILIES)


def fixed_arithmetic(name: str) -> Arithmetic | None:
    """Return the arithmetic with the given name, or None for ``exact``, which depends on the points."""
    if name == "exact":
        return None
    if name == "float64":
        return FloatArithmetic(np.float64)
    if name == "float32":
        return FloatArithmetic(np.float32)
    family, _, count = name.partition(":")
    if family == "mp":
        if count.isdecimal() and count.isascii() and MIN_BITS <= int(count) <= MAX_BITS:
            return MultiprecisionArithmetic(int(count))
        raise ValueError(f"{name}: mp expects a number of bits from {MIN_BITS} to {MAX_BITS}, such as mp:100")
    if family in PROFILES or f"{family}:P" in FAMILIES:
        return Arithmetic1620(profile(name))
    raise ValueError(f"no arithmetic is called {name!r}; choose one of {', '.join(NAMES)}")


def take(points: Points, name: str, wide: bool = False) -> tuple[Arithmetic, Vector]:
    """Return the named arithmetic, and the points in it as three rows; ``wide`` forbids machine words for exact
    numbers.
    """
    arithmetic = fixed_arithmetic(name)
    if isinstance(arithmetic, FloatArithmetic) and isinstance(points, np.ndarray) and points.dtype == arithmetic.dtype:
        return arithmetic, _floats(points)
    read = read_points(points)
    if arithmetic is None:
        arithmetic = exact_arithmetic([value for value, _ in read], wide)
    return arithmetic, _numbers(arithmetic, read)


def _check_shape(points: Vector) -> None:
    if points.dtype.kind not in "iufOU":
        raise PointsError(f"expected an array of real numbers, found {points.dtype}")
    if not points.size:
        raise PointsError("there are no points")
    if points.ndim != 2 or (points.shape[1] != 3 and points.dtype.kind != "O"):
        raise PointsError(f"expected an array of shape (n, 3), found {points.shape}")


def _floats(points: Vector) -> Vector:
    _check_shape(points)
    not_finite = np.flatnonzero(~np.isfinite(points).all(axis=1))
    if not_finite.size:
        raise PointsError(f"point {not_finite[0]}: a coordinate is not finite")
    return np.ascontiguousarray(points.T)


def _numbers(arithmetic: Arithmetic, read: list[Read]) -> Vector:
    numbers = []
    for k, (value, minus) in enumerate(read):
        try:
            numbers.append(arithmetic.number(value, minus))
        except RangeError as error:
            raise PointsError(f"point {k // 3}, coordinate {'xyz'[k % 3]}: {error}") from None
    vector = arithmetic.filled(numbers)
    return np.ascontiguousarray(vector.reshape(-1, 3).T)

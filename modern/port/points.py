"""Points as given, read exactly, and taken into an arithmetic asked for by name."""

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
Read = tuple[Exact, bool]
"""A number, and whether it is a zero with a minus sign."""


def read_number(value: object) -> Read:
    """One coordinate.  Raises ValueError."""
    found = real(value)
    if found:
        return found, False
    return found, value.strip().startswith("-") if isinstance(value, str) else str(value).startswith("-")


def read_points(points: Points) -> list[Read]:
    """The coordinates of all points, three a point, in one list.  Raises PointsError, counting points from 0."""
    if isinstance(points, np.ndarray):
        _check_shape(points)
        points = points.tolist()
    found: list[Read] = []
    index = -1
    for index, point in enumerate(points):
        if isinstance(point, str) or not isinstance(point, Iterable):
            raise PointsError(f"point {index}: {type(point).__name__} is not a point; a point has three coordinates")
        row = list(point)
        if len(row) != 3:
            raise PointsError(f"point {index}: {len(row)} coordinates; a point has three")
        for axis, value in zip("xyz", row, strict=True):
            try:
                found.append(read_number(value))
            except ValueError as error:
                raise PointsError(f"point {index}, coordinate {axis}: {error}") from None
    if index < 0:
        raise PointsError("there are no points")
    return found


def first_of_equals(keys: Iterable[object]) -> tuple[list[int], tuple[tuple[int, int], ...]]:
    """Points that are no duplicates, and (duplicate, the first point equal to it)."""
    seen: dict[object, int] = {}
    duplicates = []
    for index, key in enumerate(keys):
        first = seen.setdefault(key, index)
        if first != index:
            duplicates.append((index, first))
    return list(seen.values()), tuple(duplicates)


NAMES = ("exact", "float64", "float32", "mp:BITS", *PROFILES, *FAMILIES)


def fixed_arithmetic(name: str) -> Arithmetic | None:
    """The arithmetic of that name; None for ``exact``, which depends on the points.  Raises ValueError."""
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
        raise ValueError(f"{name}: mp takes a number of bits from {MIN_BITS} to {MAX_BITS}, as mp:100")
    if family in PROFILES or f"{family}:P" in FAMILIES:
        return Arithmetic1620(profile(name))
    raise ValueError(f"no arithmetic is called {name!r}; there are {', '.join(NAMES)}")


def take(points: Points, name: str, wide: bool = False) -> tuple[Arithmetic, Vector]:
    """The arithmetic of that name and the points in it, coordinates in three rows.

    ``wide``: exact numbers without the limit of a machine word.  Raises ValueError, PointsError.
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
        raise PointsError(f"an array of {points.dtype} holds no real numbers")
    if not points.size:
        raise PointsError("there are no points")
    if points.ndim != 2 or (points.shape[1] != 3 and points.dtype.kind != "O"):
        raise PointsError(f"an array of points has the shape (n, 3), not {points.shape}")


def _floats(points: Vector) -> Vector:
    _check_shape(points)
    bad = np.flatnonzero(~np.isfinite(points).all(axis=1))
    if bad.size:
        raise PointsError(f"point {bad[0]}: a coordinate is not finite")
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

"""Points as given, read exactly, and taken into an arithmetic asked for by name."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from emulator.numbers.arithmetic import FAMILIES, PROFILES, profile
from modern.geometry.numbers import PointsError
from modern.port.arithmetic import Arithmetic, Exact, RangeError, Vector
from modern.port.binary import MAX_BITS, MIN_BITS, FloatArithmetic, MultiprecisionArithmetic
from modern.port.decimal import Arithmetic1620
from modern.port.exact import exact_arithmetic

Coordinate = int | Fraction | str | float
Points = Iterable[Sequence[Coordinate]] | NDArray[Any]
Read = tuple[Exact, bool]
"""A number, and whether it is a zero with a minus sign."""

MAX_DIGITS, MAX_EXPONENT = 4000, 9999
_DECIMAL = re.compile(r"([+-]?)([0-9]*)(?:\.([0-9]*))?(?:[eE]([+-]?[0-9]{1,6}))?")


def read_decimal(text: str) -> Read:
    """``12``, ``-1.5``, ``-.25E-3``: the number, without loss.  Raises ValueError."""
    match = _DECIMAL.fullmatch(text.strip())
    if not match or not (match[2] or match[3]):
        raise ValueError(f"{text!r} is not a decimal number")
    digits, places = match[2] + (match[3] or ""), len(match[3] or "")
    exponent = int(match[4] or 0)
    if len(digits) > MAX_DIGITS or abs(exponent) > MAX_EXPONENT:
        raise ValueError(f"more than {MAX_DIGITS} digits or an exponent beyond {MAX_EXPONENT}")
    number, exponent = int(match[1] + digits), exponent - places
    value = number * 10**exponent if exponent >= 0 else Fraction(number, 10**-exponent)
    return value, match[1] == "-" and number == 0


def read_number(value: object) -> Read:
    """One coordinate.  Raises ValueError."""
    if isinstance(value, str):
        return read_decimal(value)
    if isinstance(value, (bool, np.bool_)):
        raise ValueError("a truth value is not a coordinate")
    if isinstance(value, (int, np.integer)):
        return int(value), False
    if isinstance(value, Fraction):
        return value, False
    if isinstance(value, (float, np.floating)):
        if not math.isfinite(value):
            raise ValueError(f"{value} is not finite")
        over, under = value.as_integer_ratio()
        return (over if under == 1 else Fraction(over, under)), value == 0 and math.copysign(1, value) < 0
    raise ValueError(f"{type(value).__name__}: give an int, a Fraction, a decimal string or a float")


def read_points(points: Points) -> list[Read]:
    """The coordinates of all points, three a point, in one list.  Raises PointsError, counting points from 0."""
    if isinstance(points, np.ndarray):
        points = points.tolist() if points.dtype.kind in "iufO" else list(points)
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


def _floats(points: Vector) -> Vector:
    if points.ndim != 2 or points.shape[1] != 3 or not len(points):
        raise PointsError(f"an array of points has the shape (n, 3), not {points.shape}")
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

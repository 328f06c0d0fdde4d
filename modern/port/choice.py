"""The arithmetics by name, and points as vectors of them."""

from __future__ import annotations

import numpy as np

from emulator.numbers.arithmetic import FAMILIES, PROFILES, profile
from modern.port.arithmetic import Arithmetic, PointsError, RangeError, Vector
from modern.port.binary import MAX_BITS, MIN_BITS, FloatArithmetic, MultiprecisionArithmetic
from modern.port.decimal import Arithmetic1620
from modern.port.exact import exact_arithmetic
from modern.port.points import Points, Read, read_points

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

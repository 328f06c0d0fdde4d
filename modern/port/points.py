"""Points as given, read exactly, and which of them are the same point again."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from modern.port.arithmetic import Exact, PointsError

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
        raise ValueError(f"{text!r} is no decimal number")
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
        raise ValueError("a truth value is no coordinate")
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
            raise PointsError(f"point {index}: a {type(point).__name__} is no point; a point has three coordinates")
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

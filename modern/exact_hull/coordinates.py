"""Points as given, to exact numbers, to integers by one common scale."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

Coordinate = int | Fraction | str | float
Exact = int | Fraction
ExactPoint = tuple[Exact, Exact, Exact]
IntPoint = tuple[int, int, int]
Points = Iterable[Iterable[Coordinate]] | NDArray[Any]

MAX_DIGITS = 4000
MAX_EXPONENT = 9999
_DECIMAL = re.compile(r"([+-]?)([0-9]*)(?:\.([0-9]*))?(?:[eE]([+-]?[0-9]{1,6}))?")


class PointsError(ValueError):
    """The points are not points with three exact coordinates; the message names point and coordinate, from 0."""


def decimal(text: str) -> Exact:
    """The number a decimal string stands for: ``12``, ``-1.5``, ``-.25E-3``; blanks around it are allowed.

    Raises ValueError.  At most 4000 digits and exponents to 9999, so that a slip cannot ask for all of the memory.
    """
    match = _DECIMAL.fullmatch(text.strip())
    if not match or not (match[2] or match[3]):
        raise ValueError(f"{text!r} is no decimal number")
    whole, fraction = match[2], match[3] or ""
    exponent = int(match[4] or 0)
    if len(whole) + len(fraction) > MAX_DIGITS:
        raise ValueError(f"{len(whole) + len(fraction)} digits; at most {MAX_DIGITS} are read")
    if abs(exponent) > MAX_EXPONENT:
        raise ValueError(f"the exponent of {text!r} is not within -{MAX_EXPONENT} to {MAX_EXPONENT}")
    number = int(whole + fraction)
    if match[1] == "-":
        number = -number
    exponent -= len(fraction)
    return number * 10**exponent if exponent >= 0 else Fraction(number, 10**-exponent)


def exact(value: object) -> Exact:
    """One coordinate as an exact number.

    Integers (also numpy's), fractions and decimal strings are what they say; a Python float is the binary number it
    holds.  Anything else raises ValueError: numpy floats because they are rounded already, truth values because
    they are no coordinates.
    """
    if type(value) is int:
        return value
    if isinstance(value, str):
        return decimal(value)
    if isinstance(value, Fraction):
        return value
    if type(value) is float:
        if not math.isfinite(value):
            raise ValueError(f"{value} is not finite")
        return Fraction(*value.as_integer_ratio())
    if isinstance(value, (int, np.integer)) and not isinstance(value, bool):
        return int(value)
    raise ValueError(f"a {type(value).__name__} is not read; give an int, a Fraction, a decimal string or a float")


def read_points(points: Points) -> list[ExactPoint]:
    """The exact coordinates of every point, in the order given.  Raises PointsError."""
    if isinstance(points, np.ndarray):
        if points.dtype.kind not in "iuOU":
            raise PointsError(f"an array of {points.dtype} is not exact; give integers, or lists of exact numbers")
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
                numbers.append(exact(value))
            except ValueError as error:
                raise PointsError(f"point {index}, coordinate {axis}: {error}") from None
        found.append((numbers[0], numbers[1], numbers[2]))
    if not found:
        raise PointsError("there are no points")
    return found


def common_scale(points: list[ExactPoint]) -> int:
    """The least positive integer that makes every coordinate an integer: the lcm of the denominators."""
    return math.lcm(*{value.denominator for point in points for value in point})


def to_integers(points: list[ExactPoint], scale: int) -> list[IntPoint]:
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

"""The arithmetic ``exact``: integers, in a unit small enough that every coordinate and the point C are whole.

The decisions of the procedure do not depend on the unit, only what is given out does.  Where every number of
the procedure fits 64 bits the vectors are of int64, else of Python's integers.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from modern.geometry.numbers import Exact, exact_text
from modern.port.arithmetic import Arithmetic, Scalar, Vector

_SPARE_BITS = 5
"""A plane at a point adds up 24 products of three coordinates, fewer than 2**5."""


@dataclass(frozen=True)
class ExactArithmetic(Arithmetic):
    """Integers in units of 1/``unit``; ``dtype`` is int64 or object."""

    unit: int
    dtype: Any

    @property
    def name(self) -> str:
        return "exact"

    def number(self, value: Exact, minus: bool = False) -> int:
        return int(value * self.unit)

    def tolerance(self, size: Fraction, degree: int) -> Scalar:
        return size * self.unit**degree

    def quotient(self, value: Scalar, count: int) -> Scalar:
        return value // count

    def sign(self, values: Vector) -> NDArray[np.int8]:
        return np.asarray(values > 0, dtype=np.int8) - np.asarray(values < 0, dtype=np.int8)

    def is_zero(self, value: Scalar) -> bool:
        return bool(value == 0)

    def last_largest(self, values: Vector) -> int:
        return len(values) - 1 - int(np.argmax(values[::-1]))

    def last_largest_square(self, values: Vector) -> int:
        return self.last_largest(abs(values))

    def all_squares_zero(self, values: Vector) -> bool:
        return not values.any()

    def farthest(self, o1: Vector, o2: Vector, o3: Vector) -> int:
        o1, o2, o3 = o1.astype(object), o2.astype(object), o3.astype(object)
        return self.last_largest(o1 * o1 + o2 * o2 + o3 * o3)

    def root(self, value: Scalar) -> Scalar:
        raise NotImplementedError("exact numbers have no root; see distances_add_up")

    def distances_add_up(self, first: Scalar, second: Scalar, whole: Scalar) -> bool:
        a, b, c = int(first), int(second), int(whole)
        rest = c - a - b
        return rest >= 0 and rest * rest == 4 * a * b

    def exact(self, value: Scalar, degree: int) -> Exact:
        return Fraction(int(value), self.unit**degree)

    def exacts(self, values: Vector, degree: int) -> list[Exact]:
        under = self.unit**degree
        return [Fraction(value, under) for value in values.tolist()]

    def text(self, value: Scalar, degree: int) -> str:
        return exact_text(self.exact(value, degree))


def exact_arithmetic(coordinates: Sequence[Exact], wide: bool = False) -> ExactArithmetic:
    """The arithmetic for these coordinates; ``wide`` refuses int64.

    The unit is a twelfth of what their common denominator asks for: C is a mean of three or of four points, and
    C and points moved to C are whole too.
    """
    unit = 12 * math.lcm(*{value.denominator for value in coordinates})
    largest = max(abs(value.numerator) * (unit // value.denominator) for value in coordinates)
    # Differences of coordinates, as after a move to C, take a bit more each.
    narrow = not wide and 3 * (largest.bit_length() + 1) + _SPARE_BITS < 63
    return ExactArithmetic(unit, np.int64 if narrow else object)

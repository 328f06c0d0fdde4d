"""The arithmetic ``exact``, which computes with integers in a unit that divides all coordinates.

If every number of the procedure fits in 64 bits, the vectors hold int64. Otherwise they hold Python's integers.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from modern.geometry.numbers import Exact, exact_text
from modern.port.arithmetic import Arithmetic, Scalar, Vector

# The value of a plane at a point is a sum of 24 products of three coordinates, and 24 is less than 2**5.
_SPARE_BITS = 5


@dataclass(frozen=True)
class ExactArithmetic(Arithmetic):
    """Exact arithmetic for Butler's procedure: integers in units of 1/``unit``. ``dtype`` is int64 or object."""

    unit: int
    dtype: Any

    @property
    def name(self) -> str:
        return "exact"

    def number(self, value: Exact, minus: bool = False) -> int:
        return int(value * self.unit)

    def tolerance(self, size: Fraction, degree: int) -> Scalar:
        return size * self.unit**degree

    @property
    def one(self) -> int:
        return 1

    def quotient(self, value: Scalar, count: int) -> Scalar:
        return value // count

    def last_largest_square(self, values: Vector) -> int:
        return self.last_largest(abs(values))

    def all_squares_zero(self, values: Vector) -> bool:
        return not values.any()

    def farthest(self, o1: Vector, o2: Vector, o3: Vector) -> int:
        # The squares have twice the degree of a plane's value and may exceed int64.
        o1, o2, o3 = o1.astype(object), o2.astype(object), o3.astype(object)
        return self.last_largest(o1 * o1 + o2 * o2 + o3 * o3)

    def root(self, value: Scalar) -> Scalar:
        raise NotImplementedError("exact arithmetic has no square root; use distances_add_up")

    def distances_add_up(self, first_square: Scalar, second_square: Scalar, total_square: Scalar) -> bool:
        # sqrt(a) + sqrt(b) = sqrt(c) holds if and only if c - a - b = 2 sqrt(ab), which is decided by squaring both
        # sides.
        a, b, c = int(first_square), int(second_square), int(total_square)
        twice_product = c - a - b
        return twice_product >= 0 and twice_product * twice_product == 4 * a * b

    def exact(self, value: Scalar, degree: int) -> Exact:
        return Fraction(int(value), self.unit**degree)

    def exacts(self, values: Vector, degree: int) -> list[Exact]:
        denominator = self.unit**degree
        return [Fraction(value, denominator) for value in values.tolist()]

    def text(self, value: Scalar, degree: int) -> str:
        return exact_text(self.exact(value, degree))


def exact_arithmetic(coordinates: Sequence[Exact], wide: bool = False) -> ExactArithmetic:
    """Return the exact arithmetic for these coordinates. If ``wide`` is true, it does not use int64.

    The unit is 1 / (12 d), where d is the common denominator of the coordinates. The inside point C is the mean of
    three or four points, so in this unit its coordinates, and those of the points relative to C, are integers too.
    """
    unit = 12 * math.lcm(*{value.denominator for value in coordinates})
    largest = max(abs(value.numerator) * (unit // value.denominator) for value in coordinates)
    # A difference of coordinates, as after a translation to C, needs one more bit.
    fits_int64 = not wide and 3 * (largest.bit_length() + 1) + _SPARE_BITS < 63
    return ExactArithmetic(unit, np.int64 if fits_int64 else object)

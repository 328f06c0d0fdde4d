"""Numbers of the 1620 as Python objects, which Butler's procedure can compute with in numpy arrays.

``a op b`` is the result that the machine computes if its accumulator holds a. If the machine would also type an error
code, the result is used and no error is reported. The order of the operands matters in ``ibm1962``, in which zero plus
zero keeps the sign of the accumulator, the left operand.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np

from emulator.numbers import accumulator
from emulator.numbers.arithmetic import MAX_EXPONENT, MIN_EXPONENT, MINUS_ZERO, ZERO, Profile, Rules, from_integer
from emulator.numbers.base import decimal_length
from emulator.numbers.functions import function
from modern.geometry.numbers import Exact, scaled_decimal
from modern.port.arithmetic import Arithmetic, RangeError, Vector

Operator = Callable[["Number1620", "Number1620"], "Number1620"]


def _operator(rule: Callable[[int, int, int, int, Rules], tuple[int, int, int]]) -> Operator:
    def apply(self: "Number1620", operand: "Number1620") -> "Number1620":
        if not isinstance(operand, Number1620):
            return NotImplemented  # numpy then applies the operation to each element
        m, e, _ = rule(self.m, self.e, operand.m, operand.e, self.by)
        return Number1620(m, e, self.by)

    return apply


class Number1620:
    """A number of the 1620: mantissa and exponent as in :mod:`emulator.numbers.arithmetic`, never undefined."""

    __slots__ = ("by", "e", "m")

    def __init__(self, m: int, e: int, by: Rules) -> None:
        self.m = m
        self.e = e
        self.by = by

    __add__ = _operator(accumulator.add)
    __sub__ = _operator(accumulator.subtract)
    __mul__ = _operator(accumulator.multiply)
    __truediv__ = _operator(accumulator.divide)

    def __neg__(self) -> "Number1620":
        return Number1620(*accumulator.negate(self.m, self.e), self.by)

    def __abs__(self) -> "Number1620":
        return -self if self.m < 0 else self

    def __repr__(self) -> str:
        return f"Number1620({self.m}, {self.e})"


@dataclass(frozen=True)
class Arithmetic1620(Arithmetic):
    """The decimal arithmetic of the 1620 for Butler's procedure, with the rounding rules of one profile."""

    profile: Profile

    @property
    def name(self) -> str:
        return self.profile.name

    @cached_property
    def rules(self) -> Rules:
        return self.profile.rules

    def number(self, value: Exact, minus: bool = False) -> Number1620:
        """Convert a number by truncating it to P digits, as the machine reads a card; ``minus`` marks a minus zero."""
        if value == 0:
            return Number1620(0, MINUS_ZERO if minus else ZERO, self.rules)
        digits = self.profile.digits
        size = abs(Fraction(value))
        # The digit counts of numerator and denominator give an estimate: the exponent, or one more than the exponent.
        exponent = decimal_length(size.numerator) - decimal_length(size.denominator) + 1
        if size < Fraction(10) ** (exponent - 1):
            exponent -= 1
        if not MIN_EXPONENT <= exponent <= MAX_EXPONENT:
            raise RangeError("expected a number with an exponent from -99 to 99")
        shift = digits - exponent
        mantissa = int(size * 10**shift if shift >= 0 else size / 10**-shift)
        return Number1620(-mantissa if value < 0 else mantissa, exponent, self.rules)

    def quotient(self, value: Number1620, count: int) -> Number1620:
        return value / Number1620(*from_integer(count, self.profile.rules), self.rules)

    def sign(self, values: Vector) -> Vector:
        return np.fromiter(((v.m > 0) - (v.m < 0) for v in values.flat), np.int8, values.size).reshape(values.shape)

    def keys(self, coordinates: Vector) -> Iterable[object]:
        rows = [[(v.m, v.e if v.m else 0) for v in row] for row in coordinates]
        return zip(*rows, strict=True)

    def root(self, value: Number1620) -> Number1620:
        root = function("SQRT", value.m, value.e, self.profile.rules)
        return Number1620(root.mantissa, root.exponent, self.rules)

    def exact(self, value: Number1620, degree: int) -> Fraction:
        return value.m * Fraction(10) ** (value.e - self.profile.digits)

    def text(self, value: Number1620, degree: int) -> str:
        if value.m == 0:
            return "-0" if value.e == MINUS_ZERO else "0"
        return scaled_decimal(value.m, value.e - self.profile.digits)

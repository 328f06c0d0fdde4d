"""Numbers of the 1620 as Python numbers: the profiles of :mod:`emulator.numbers.arithmetic`.

The digits come from :mod:`emulator.numbers.arithmetic`; here stands only what an accumulator machine does around
them: zeros and their signs, overflow, underflow.  In ``a op b`` the left operand is the one in the
accumulator, which matters to ``ibm1962`` where zero plus zero keeps the accumulator's sign.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np

from emulator.numbers.arithmetic import (
    MAX_EXPONENT,
    MIN_EXPONENT,
    MINUS_ZERO,
    ZERO,
    Profile,
    add,
    divide,
    from_integer,
    multiply,
    powers_of_ten,
)
from emulator.numbers.functions import function
from modern.port.arithmetic import Arithmetic, Exact, RangeError, Vector, scaled_decimal


@dataclass(frozen=True, slots=True)
class Rules1620:
    """An arithmetic's rules, with the table of powers the number functions index."""

    profile: Profile
    powers: list[int]


class Number1620:
    """One number: mantissa and exponent as :mod:`emulator.numbers.arithmetic` has them, never undefined."""

    __slots__ = ("e", "m", "rules")

    def __init__(self, m: int, e: int, rules: Rules1620) -> None:
        self.m = m
        self.e = e
        self.rules = rules

    def __add__(self, other: Number1620) -> Number1620:
        if isinstance(other, Number1620):
            return self._sum(other.m, other.e)
        return NotImplemented  # a vector takes the operation over, element by element

    def __sub__(self, other: Number1620) -> Number1620:
        if isinstance(other, Number1620):
            return self._sum(-other.m, other.e)
        return NotImplemented

    def __mul__(self, other: Number1620) -> Number1620:
        if not isinstance(other, Number1620):
            return NotImplemented
        rules = self.rules
        if self.m == 0 or other.m == 0:
            return Number1620(0, ZERO, rules)
        m, e = multiply(self.m, self.e, other.m, other.e, rules.profile.rules)
        return self._in_range(m, e, rules.profile.signed_underflow)

    def __truediv__(self, other: Number1620) -> Number1620:
        rules = self.rules
        if other.m == 0:
            return Number1620(rules.profile.rules[1] - 1, MAX_EXPONENT, rules)
        if self.m == 0:
            return Number1620(0, ZERO, rules)
        m, e = divide(self.m, self.e, other.m, other.e, rules.profile.rules)
        return self._in_range(m, e, rules.profile.signed_underflow)

    def __neg__(self) -> Number1620:
        if self.m == 0:
            return Number1620(0, MINUS_ZERO if self.e == ZERO else ZERO, self.rules)
        return Number1620(-self.m, self.e, self.rules)

    def __abs__(self) -> Number1620:
        return -self if self.m < 0 else self

    def _sum(self, m: int, e: int) -> Number1620:
        rules = self.rules
        if m == 0:
            if self.m == 0 and not rules.profile.keeps_left_zero:
                return Number1620(0, ZERO, rules)
            return self
        if self.m == 0:
            return Number1620(m, e, rules)
        m, e = add(self.m, self.e, m, e, rules.profile.rules, rules.powers)
        return self._in_range(m, e, False) if m else Number1620(0, ZERO, rules)

    def _in_range(self, m: int, e: int, signed_zero: bool) -> Number1620:
        rules = self.rules
        if e > MAX_EXPONENT:
            biggest = rules.profile.rules[1] - 1
            return Number1620(biggest if m > 0 else -biggest, MAX_EXPONENT, rules)
        if e < MIN_EXPONENT:
            return Number1620(0, MINUS_ZERO if signed_zero and m < 0 else ZERO, rules)
        return Number1620(m, e, rules)

    def __repr__(self) -> str:
        return f"Number1620({self.m}, {self.e})"


@dataclass(frozen=True)
class Arithmetic1620(Arithmetic):
    """Vectors of :class:`Number1620` under one profile."""

    profile: Profile

    @property
    def name(self) -> str:
        return self.profile.name

    @cached_property
    def rules(self) -> Rules1620:
        return Rules1620(self.profile, powers_of_ten(self.profile.rules))

    def number(self, value: Exact, minus: bool = False) -> Number1620:
        """The first P digits of a number, as a READ takes them; ``minus``: a zero with a minus sign.

        Raises RangeError where the exponent is not -99 to 99.
        """
        if value == 0:
            return Number1620(0, MINUS_ZERO if minus else ZERO, self.rules)
        digits = self.profile.digits
        size = abs(Fraction(value))
        exponent = len(str(size.numerator)) - len(str(size.denominator)) + 1
        if size < Fraction(10) ** (exponent - 1):
            exponent -= 1
        shift = digits - exponent
        mantissa = int(size * 10**shift if shift >= 0 else size / 10**-shift)
        if not MIN_EXPONENT <= exponent <= MAX_EXPONENT:
            raise RangeError("the exponent of a number of this arithmetic is -99 to 99")
        return Number1620(-mantissa if value < 0 else mantissa, exponent, self.rules)

    def whole(self, value: int) -> Number1620:
        return Number1620(*from_integer(value, self.profile.rules), self.rules)

    def quotient(self, value: Number1620, count: int) -> Number1620:
        return value / self.whole(count)

    def sign(self, values: Vector) -> Vector:
        return np.fromiter(((v.m > 0) - (v.m < 0) for v in values.flat), np.int8, values.size).reshape(values.shape)

    def keys(self, coordinates: Vector) -> Iterable[object]:
        rows = [[(v.m, v.e if v.m else 0) for v in row] for row in coordinates]
        return zip(*rows, strict=True)

    def root(self, value: Number1620) -> Number1620:
        found = function("SQRT", value.m, value.e, self.profile.rules)
        return Number1620(found.mantissa, found.exponent, self.rules)

    def exact(self, value: Number1620, degree: int) -> Fraction:
        return value.m * Fraction(10) ** (value.e - self.profile.digits)

    def text(self, value: Number1620, degree: int) -> str:
        if value.m == 0:
            return "-0" if value.e == MINUS_ZERO else "0"
        return scaled_decimal(value.m, value.e - self.profile.digits)

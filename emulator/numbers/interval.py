"""The arithmetic ``interval:P``: intervals of P-digit decimal numbers that contain the exact result.

A number is a pair (low, high) of :class:`decimal.Decimal`, and the number that exact arithmetic would hold lies between
them.  + - * / and SQRT are rounded outward by Python's decimal contexts.  The library functions and powers are computed
by mpmath's interval arithmetic and rounded outward.  Cards and constants with at most P digits are read exactly.

An IF on an interval that contains zero and another number cannot be decided.  The run then ends, and the ending names
the statement.  A printed number is the middle of its interval.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal, Overflow
from fractions import Fraction
from functools import cached_property, wraps
from typing import Any

from emulator.numbers.arithmetic import MINUS_ZERO, ZERO, wrap_integer
from emulator.numbers.base import Numbers, Undecided, binary_value, cut_decimal
from emulator.numbers.work import decimal_function

Interval = tuple[Decimal, Decimal]
MIN_DIGITS, MAX_DIGITS = 2, 1_000
# The largest decimal exponent of a number.  With far larger ones mpmath's functions would run for minutes.
_RANGE = 10**4


def _within_range(operation: Callable[..., Any]) -> Callable[..., Any]:
    """Return a function that performs the operation and raises Undecided, with the range of numbers, on overflow."""

    @wraps(operation)
    def checked(*operands: Any) -> Any:
        try:
            return operation(*operands)
        except Overflow:
            raise Undecided(f"interval arithmetic holds only numbers from 1E-{_RANGE} to 1E+{_RANGE}") from None

    return checked


@dataclass(frozen=True)
class IntervalNumbers(Numbers):
    """The arithmetic of intervals whose two ends have ``places`` digits each."""

    places: int
    is_costly = True

    @property
    def name(self) -> str:
        return f"interval:{self.places}"

    @property
    def digits(self) -> float:
        return self.places

    @cached_property
    def _down(self) -> Context:
        return Context(self.places, ROUND_FLOOR, -_RANGE, _RANGE)

    @cached_property
    def _up(self) -> Context:
        return Context(self.places, ROUND_CEILING, -_RANGE, _RANGE)

    def decimal(self, whole: int, power: int, minus: bool = False) -> Interval:
        value = Decimal((int(whole < 0 or minus), tuple(map(int, str(abs(whole)))), power))
        return self._down.plus(value) if whole else value, self._up.plus(value) if whole else value

    @_within_range
    def add(self, first: Interval, second: Interval) -> Interval:
        return self._down.add(first[0], second[0]), self._up.add(first[1], second[1])

    @_within_range
    def subtract(self, first: Interval, second: Interval) -> Interval:
        return self._down.subtract(first[0], second[1]), self._up.subtract(first[1], second[0])

    @_within_range
    def multiply(self, first: Interval, second: Interval) -> Interval:
        if first[0] == first[1] and second[0] == second[1]:
            return self._down.multiply(first[0], second[0]), self._up.multiply(first[0], second[0])
        pairs = [(a, b) for a in first for b in second]
        return min(self._down.multiply(a, b) for a, b in pairs), max(self._up.multiply(a, b) for a, b in pairs)

    @_within_range
    def divide(self, dividend: Interval, divisor: Interval) -> Interval:
        if divisor[0] <= 0 <= divisor[1]:
            if divisor[0] == divisor[1]:
                raise Undecided("interval arithmetic cannot divide by zero")
            raise Undecided(f"the divisor {self.text(divisor)} may be zero")
        pairs = [(a, b) for a in dividend for b in divisor]
        return min(self._down.divide(a, b) for a, b in pairs), max(self._up.divide(a, b) for a, b in pairs)

    def negate(self, value: Interval) -> Interval:
        return value[1].copy_negate(), value[0].copy_negate()

    def sign(self, value: Interval) -> int:
        low, high = value
        if low > 0 or high < 0:
            return 1 if low > 0 else -1
        if low == high:
            return 0
        raise Undecided(f"the sign of {self.text(value)} is unknown")

    def to_integer(self, value: Interval) -> int:
        low, high = map(int, value)
        if low != high:
            raise Undecided(f"the integer part of {self.text(value)} is unknown")
        return wrap_integer(low)

    @_within_range
    def function(self, name: str, value: Interval) -> tuple[Interval, str]:
        if name == "SQRT":
            # The machine takes the root of the absolute value.
            ends = sorted(map(Decimal.copy_abs, value))
            low = ends[0] if value[0] > 0 or value[1] < 0 else Decimal(0)
            return (self._roots(low)[0], self._roots(ends[1])[1]), ""
        if name == "LOG" and value[0] <= 0:
            raise Undecided(f"interval arithmetic cannot compute the logarithm of {self.text(value)}")
        if name == "ATAN":
            from mpmath.libmp import mpi_atan

            return self._outward(self._mpmath.make_mpf(mpi_atan(self._iv(value)._mpi_, self._mpmath.prec))), ""
        argument = self._iv(value)
        if name == "EXP":
            return self._exponential(argument), ""
        return self._outward(getattr(self._mpmath, name.lower())(argument)), ""

    def _roots(self, value: Decimal) -> tuple[Decimal, Decimal]:
        """Return the square root of ``value`` rounded down and rounded up to ``places`` digits."""
        root = self._down.sqrt(value)  # decimal rounds roots to nearest in every context
        square = Context(2 * self.places, Emin=-4 * _RANGE, Emax=4 * _RANGE).multiply(root, root)
        low = root if square <= value else self._down.next_minus(root)
        return low, root if square >= value else self._up.next_plus(root)

    @_within_range
    def power(self, base: Interval, exponent: Interval) -> tuple[Interval, str]:
        if base[0] <= 0:
            raise Undecided(f"interval arithmetic cannot compute a power of {self.text(base)}")
        iv = self._mpmath
        return self._exponential(iv.log(self._iv(base)) * self._iv(exponent)), ""

    def _exponential(self, argument: Any) -> Interval:
        if abs(argument).b > 2.3025851 * _RANGE:  # ln(10) = 2.3025851
            raise Overflow
        return self._outward(self._mpmath.exp(argument))

    def integer_power(self, base: Interval, count: int) -> tuple[Interval, str]:
        unit = Decimal(1), Decimal(1)
        power = unit
        if count % 2 == 0 and base[0] < 0:
            # An even power of an interval around zero begins at zero; chained products would lose that.
            low, high = self.negate(base)
            base = max(low, Decimal(0)), max(high, base[1])
        for _ in range(abs(count)):
            power = self.multiply(power, base)
        return (self.divide(unit, power) if count < 0 else power), ""

    @cached_property
    def _mpmath(self) -> Any:
        from mpmath import MPIntervalContext

        context = MPIntervalContext()
        context.dps = self.places + 10
        return context

    def _iv(self, value: Interval) -> Any:
        return self._mpmath.mpf([str(value[0]), str(value[1])])

    def _outward(self, value: Any) -> Interval:
        low, high = map(binary_value, value._mpi_)
        return (
            self._down.divide(Decimal(low.numerator), Decimal(low.denominator)),
            self._up.divide(Decimal(high.numerator), Decimal(high.denominator)),
        )

    def exact(self, value: Interval, digits: int) -> Fraction:
        return (Fraction(value[0]) + Fraction(value[1])) / 2

    def cut(self, value: Interval, digits: int) -> tuple[int, int]:
        middle = self._middle(value)
        if not middle:
            return 0, MINUS_ZERO if middle.is_signed() else ZERO
        _, numerals, power = middle.as_tuple()
        whole = int("".join(map(str, numerals)))
        assert isinstance(power, int)
        return cut_decimal(-whole if middle < 0 else whole, power, digits)

    def _middle(self, value: Interval) -> Decimal:
        low, high = value
        if low == high:
            return low
        wide = Context(self.places + 2 + abs(high.adjusted() - low.adjusted()), Emin=-4 * _RANGE, Emax=4 * _RANGE)
        return wide.divide(wide.add(low, high), Decimal(2))

    def text(self, value: Interval) -> str:
        low, high = value
        return super().text(value) if low == high else f"[{low.normalize(self._down)}, {high.normalize(self._up)}]"

    def work(self, operation: str, first: Any, second: Any = 0) -> int:
        if operation in ("SIN", "COS", "ATAN", "EXP", "LOG", "power"):
            return 4 * decimal_function(0)
        return 2 * abs(second) + 2 if operation == "integer_power" else 4

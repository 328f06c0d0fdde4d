"""The arithmetic ``mp:BITS``: binary floating point with any number of bits, rounded to nearest, by mpmath.

Binary exponents range from -100,000 to 100,000.  A number outside this range overflows to an infinity or underflows to
zero, with the 1620's error code.  Input and output follow the rules of the other binary numbers (:mod:`.binary`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

from mpmath import MPContext
from mpmath.libmp import from_rational, round_nearest

from emulator.numbers import accumulator, work
from emulator.numbers.arithmetic import ZERO
from emulator.numbers.base import (
    SHOWN,
    Numbers,
    Trap,
    Undecided,
    binary_value,
    cut_decimal,
    decimal_length,
    decimal_text,
)

MIN_BITS, MAX_BITS = 2, 100_000
MAX_POWER = 100_000


@dataclass(frozen=True)
class MultiprecisionNumbers(Numbers):
    """The arithmetic of binary numbers with ``bits`` bits, which are objects of a separate mpmath context."""

    bits: int
    is_costly = True

    @property
    def name(self) -> str:
        return f"mp:{self.bits}"

    @property
    def digits(self) -> float:
        return self.bits * math.log10(2)

    @cached_property
    def _context(self) -> Any:
        context = MPContext()
        context.prec = self.bits
        return context

    @cached_property
    def _infinity(self) -> Any:
        return self._context.inf

    def decimal(self, whole: int, power: int, minus: bool = False) -> Any:
        return self.nearest(whole * 10**power, 1) if power >= 0 else self.nearest(whole, 10**-power)

    def nearest(self, over: int, under: int) -> Any:
        """Return the number of this arithmetic that is nearest to the fraction ``over / under``."""
        return self._context.make_mpf(from_rational(over, under, self.bits, round_nearest))

    def add(self, first: Any, second: Any) -> Any:
        return self._in_range(first + second, accumulator.SUM_OVER, accumulator.SUM_UNDER)

    def subtract(self, first: Any, second: Any) -> Any:
        return self._in_range(first - second, accumulator.SUM_OVER, accumulator.SUM_UNDER)

    def multiply(self, first: Any, second: Any) -> Any:
        return self._in_range(first * second, accumulator.PRODUCT_OVER, accumulator.PRODUCT_UNDER)

    def divide(self, dividend: Any, divisor: Any) -> Any:
        if divisor == 0:
            sign = 0 if dividend == 0 else 1 if dividend > 0 else -1
            raise Trap(accumulator.ZERO_DIVISOR, self._context.nan if sign == 0 else sign * self._infinity)
        return self._in_range(dividend / divisor, accumulator.QUOTIENT_OVER, accumulator.QUOTIENT_UNDER)

    def _in_range(self, value: Any, over: int, under: int) -> Any:
        # mpmath's exponents are unlimited, so the range is checked here.  Infinities and NaN have mantissa 0.
        _, mantissa, exponent, bits = value._mpf_
        if mantissa and not -MAX_POWER <= exponent + bits <= MAX_POWER:
            if exponent > 0:
                raise Trap(over, self._infinity if value > 0 else -self._infinity)
            raise Trap(under, self._context.zero)
        return value

    def negate(self, value: Any) -> Any:
        return -value

    def sign(self, value: Any) -> int:
        if self._context.isnan(value):
            raise Undecided(f"{self.name} cannot determine the sign of NaN (not a number)")
        return int(value > 0) - int(value < 0)

    def to_integer(self, value: Any) -> int:
        if not self._context.isfinite(value):
            raise Undecided(f"{self.name} cannot convert {value} to an integer")
        size = int(abs(value)) % 10000
        return -size if value < 0 else size

    def function(self, name: str, value: Any) -> tuple[Any, str]:
        context = self._context
        if name == "SQRT":
            return context.sqrt(abs(value)), ""
        if name == "LOG":
            return (-self._infinity, "F2") if value == 0 else (context.log(abs(value)), "F3" if value < 0 else "")
        if name in ("SIN", "COS") and not context.isfinite(value):
            return context.nan, "F1"
        if name == "EXP":
            return self._exponential(value)
        return getattr(context, name.lower())(value), ""

    def _exponential(self, value: Any) -> tuple[Any, str]:
        """Return EXP of a number, and an error code or "".  A result far out of range becomes infinity or 0."""
        if value > MAX_POWER:
            return self._infinity, "F4"
        if value < -MAX_POWER:
            return self._context.zero, "F5"
        return self._coded(self._context.exp(value), "F4", "F5")

    def _coded(self, value: Any, over: str, under: str) -> tuple[Any, str]:
        try:
            return self._in_range(value, 0, 1), ""
        except Trap as trap:
            return trap.value, under if trap.event else over

    def power(self, base: Any, exponent: Any) -> tuple[Any, str]:
        if base == 0:
            return self.integer_power(base, self.sign(exponent))
        context, size = self._context, abs(base)
        if not context.isfinite(exponent) or not context.isfinite(size):
            return context.nan, "F4"
        # The logarithm decides overflow and underflow before the power itself is computed.
        result, code = self._exponential(context.log(size) * exponent)
        if not code:
            result, code = self._coded(context.power(size, exponent), "F4", "F5")
        return result, code or ("F6" if base < 0 else "")

    def integer_power(self, base: Any, count: int) -> tuple[Any, str]:
        context = self._context
        if base == 0 and count < 0:
            return self._infinity, "E7"
        if base == 0 or not context.isfinite(base):
            return base**count, ""
        return self._coded(base**count, "E3", "E4")

    def work(self, operation: str, first: Any, second: Any = 0) -> int:
        bits = self.bits
        if operation == "multiply":
            return 2 + work.product(bits, bits)
        if operation == "divide":
            return 4 + work.quotient(bits, bits)
        if operation == "SQRT":
            return 8 + work.quotient(bits, bits)
        if operation == "integer_power":
            least = 2 * int(abs(second)).bit_length() * (1 + work.product(bits, bits))
            return least + (work.quotient(bits, bits) if second < 0 else 0)
        if operation in ("add", "subtract", "sign", "to_integer"):
            return 3 + bits // 5000
        # Reducing an angle loses as many digits as it has before its point.  Output to a card needs all digits of a
        # large or small number.
        _, mantissa, exponent, size = first._mpf_
        reach = abs(int(exponent + size)) if mantissa else 0
        if operation == "card":
            return work.decimal(bits + reach)
        return 4 * work.series(bits) if operation == "power" else work.series(bits + reach)

    def exact(self, value: Any, digits: int) -> Fraction | int | None:
        return binary_value(value._mpf_) if self._context.isfinite(value) else None

    def cut(self, value: Any, digits: int) -> tuple[int, int]:
        exact = self.exact(value, digits)
        if exact is None:
            raise Undecided(f"{value} cannot be written on a card")
        return cut_decimal(*self._shortest(value, exact), digits) if exact else (0, ZERO)

    def text(self, value: Any) -> str:
        exact = self.exact(value, SHOWN)
        if exact:
            whole, power = self._shortest(value, exact)
            if decimal_length(whole) <= SHOWN:
                return decimal_text(whole, power)
        return super().text(value)

    def _shortest(self, value: Any, exact: Fraction | int) -> tuple[int, int]:
        """Return the shortest decimal that reads back as the same number: an integer and a power of ten."""
        # Start two digits below the precision: a decimal with more digits always reads back as the same number.
        least = max(int(self.digits) - 2, 1)
        lead = decimal_length(exact.numerator) - decimal_length(exact.denominator)
        while True:
            power = lead - least
            whole = round(exact / Fraction(10) ** power)
            if self.decimal(whole, power) == value:
                return whole, power
            least += 1

"""The arithmetics ``float64`` and ``float32``: IEEE 754 numbers, rounded to nearest.

A decimal is converted to the nearest double.  For single precision, that double is then rounded to single precision.
Overflow gives an infinity and an invalid operation gives NaN, each reported with the 1620's error code.  An IF cannot
determine the sign of NaN.  Output is the shortest decimal that reads back as the same number, truncated to the field,
so .3 is punched as .30000000E+00 although the number held is slightly smaller.  A single-precision result is the
double-precision result rounded to single precision, which for + - * / and SQRT equals the correctly rounded result.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from ctypes import c_float
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from functools import cached_property

from emulator.numbers import accumulator
from emulator.numbers.arithmetic import MINUS_ZERO, ZERO
from emulator.numbers.base import Numbers, Trap, Undecided, cut_decimal

_INFINITE = math.inf


def _single(value: float) -> float:
    return c_float(value).value


@dataclass(frozen=True)
class FloatNumbers(Numbers):
    """The arithmetic of IEEE double or single precision.  Every number is a Python float."""

    name_: str

    @property
    def name(self) -> str:
        return self.name_

    @cached_property
    def _single(self) -> bool:
        return self.name_ == "float32"

    @property
    def digits(self) -> float:
        return (24 if self._single else 53) * math.log10(2)

    def _rounded(self, value: float) -> float:
        return _single(value) if self._single else value

    def decimal(self, whole: int, power: int, minus: bool = False) -> float:
        if whole == 0:
            return -0.0 if minus else 0.0
        return self._rounded(float(f"{whole}E{power}"))

    def add(self, first: float, second: float) -> float:
        total = first + second
        if self._single:
            total = _single(total)
        # x - x is 0 only for a finite x.  So if the operands are finite and the result is not, the operation
        # overflowed.
        if total - total != 0 and first - first == second - second == 0:
            raise Trap(accumulator.SUM_OVER, total)
        return total

    def subtract(self, first: float, second: float) -> float:
        return self.add(first, -second)

    def multiply(self, first: float, second: float) -> float:
        product = first * second
        if self._single:
            product = _single(product)
        if product - product != 0:
            if first - first == second - second == 0:
                raise Trap(accumulator.PRODUCT_OVER, product)
        elif product == 0 and first != 0 and second != 0:
            raise Trap(accumulator.PRODUCT_UNDER, product)
        return product

    def divide(self, dividend: float, divisor: float) -> float:
        if divisor == 0:
            # Division by zero: the infinity has the sign of the quotient, in which zeros have signs, and 0/0 is NaN.
            negative = math.copysign(1, dividend) != math.copysign(1, divisor)
            quotient = math.nan if dividend == 0 or dividend != dividend else -_INFINITE if negative else _INFINITE
            raise Trap(accumulator.ZERO_DIVISOR, quotient)
        quotient = self._rounded(dividend / divisor)
        if quotient - quotient != 0:
            if dividend - dividend == divisor - divisor == 0:
                raise Trap(accumulator.QUOTIENT_OVER, quotient)
        elif quotient == 0 and dividend != 0 and divisor - divisor == 0:
            raise Trap(accumulator.QUOTIENT_UNDER, quotient)
        return quotient

    def negate(self, value: float) -> float:
        return -value

    def sign(self, value: float) -> int:
        if value != value:
            raise Undecided(f"{self.name} cannot determine the sign of NaN (not a number)")
        return (value > 0) - (value < 0)

    def to_integer(self, value: float) -> int:
        if value - value != 0:
            raise Undecided(f"{self.name} cannot convert {value} to an integer")
        size = int(abs(value)) % 10000
        return -size if value < 0 else size

    def function(self, name: str, value: float) -> tuple[float, str]:
        if name == "SQRT":
            return self._rounded(math.sqrt(abs(value))), ""
        if name == "LOG":
            if value == 0:
                return -_INFINITE, "F2"
            return self._rounded(math.log(abs(value))), "F3" if value < 0 else ""
        if name == "EXP":
            result = self._or_infinite(math.exp, value)
            return result, "F4" if result == _INFINITE else "F5" if result == 0 else ""
        if name in ("SIN", "COS") and value in (_INFINITE, -_INFINITE):
            return math.nan, "F1"
        compute: Callable[[float], float] = getattr(math, name.lower())
        return self._rounded(compute(value)), ""

    def power(self, base: float, exponent: float) -> tuple[float, str]:
        if base == 0:
            return self.integer_power(0.0, (exponent > 0) - (exponent < 0))
        result = self._or_infinite(math.pow, abs(base), exponent)
        code = "F4" if result == _INFINITE else "F5" if result == 0 else "F6" if base < 0 else ""
        return result, code

    def integer_power(self, base: float, count: int) -> tuple[float, str]:
        if base == 0 and count < 0:
            return _INFINITE, "E7"
        if base == 0 or base - base != 0:
            return self._rounded(float(base**count)), ""
        result = self._or_infinite(math.pow, abs(base), float(count))
        code = "E3" if result == _INFINITE else "E4" if result == 0 else ""
        return (-result if base < 0 and count % 2 else result), code

    def _or_infinite(self, compute: Callable[..., float], *arguments: float) -> float:
        try:
            return self._rounded(compute(*arguments))
        except OverflowError:
            return _INFINITE

    def exact(self, value: float, digits: int) -> Fraction | int | None:
        if value - value != 0:
            return None
        whole, under = value.as_integer_ratio()
        return whole if under == 1 else Fraction(whole, under)

    def cut(self, value: float, digits: int) -> tuple[int, int]:
        if value == 0:
            return 0, MINUS_ZERO if math.copysign(1, value) < 0 else ZERO
        if value - value != 0:
            raise Undecided(f"{value} cannot be written on a card")
        sign, decimals, power = Decimal(self._shortest(value)).as_tuple()
        assert isinstance(power, int)
        size = int("".join(map(str, decimals)))
        return cut_decimal(-size if sign else size, power, digits)

    def text(self, value: float) -> str:
        shown = self._shortest(value)
        return shown[:-2] if shown.endswith(".0") else shown

    def _shortest(self, value: float) -> str:
        """Return the shortest decimal that reads back as the same binary number."""
        if not self._single or value - value != 0:
            return repr(value)
        # The search always ends, because 17 digits are enough.
        shorter = (float(f"{value:.{k}g}") for k in range(1, 18))
        return repr(next(number for number in shorter if _single(number) == value))

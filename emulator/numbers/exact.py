"""``exact``: rational numbers, and sums of square roots of rational numbers; nothing is ever rounded.

A number is an int, a Fraction or a RootSum.  ``+ - *``, division by a number that is rational or a sum of two
roots, SQRT of a rational number, whole powers and the few values of the other functions that are rational are
exact.  Everything else cannot be held, and the run ends there.  The signs of zeros are the 1620's.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

from emulator.numbers.arithmetic import MINUS_ZERO, ZERO
from emulator.numbers.base import Numbers, Undecided, cut_decimal, decimal_length
from emulator.numbers.roots import Rational, RootSum, quotient, square_root

Exact = Rational | RootSum


class _SignedZero(int):
    """Zero with a minus sign: whatever is computed from it but a reversal of sign gives a plain number."""


_MINUS = _SignedZero(0)

MAX_BITS = 100_000
"""No number stored has a part longer than this: a program that squares in a loop would fill the memory."""

_KNOWN: dict[tuple[str, Rational], int] = {("SIN", 0): 0, ("ATAN", 0): 0, ("COS", 0): 1, ("EXP", 0): 1, ("LOG", 1): 0}


@dataclass(frozen=True)
class ExactNumbers(Numbers):
    """Rational numbers and sums of square roots."""

    @property
    def name(self) -> str:
        return "exact"

    @property
    def digits(self) -> float:
        return math.inf

    def decimal(self, whole: int, power: int, minus: bool = False) -> Rational:
        if minus and not whole:
            return _MINUS
        return whole * 10**power if power >= 0 else _lowest(Fraction(whole, 10**-power))

    def add(self, first: Exact, second: Exact) -> Exact:
        return first + second

    def subtract(self, first: Exact, second: Exact) -> Exact:
        return first - second

    def multiply(self, first: Exact, second: Exact) -> Exact:
        return first * second

    def divide(self, dividend: Exact, divisor: Exact) -> Exact:
        if not divisor:
            raise Undecided("exact arithmetic cannot divide by zero")
        if not isinstance(divisor, RootSum):
            if isinstance(dividend, RootSum):
                return dividend * (1 / Fraction(divisor))
            return _lowest(Fraction(dividend) / divisor)
        found = quotient(dividend, divisor)
        if found is None:
            raise Undecided(f"exact arithmetic cannot divide by a sum of {len(divisor.terms)} square roots")
        return found

    def negate(self, value: Exact) -> Exact:
        return -value if value else 0 if value is _MINUS else _MINUS

    def sign(self, value: Exact) -> int:
        if isinstance(value, RootSum):
            return value.sign()
        over = value.numerator
        return (over > 0) - (over < 0)

    def checked(self, value: Exact) -> Exact:
        parts = value.terms if isinstance(value, RootSum) else ((1, value),)
        for radicand, coefficient in parts:
            long = radicand.bit_length() + coefficient.numerator.bit_length() + coefficient.denominator.bit_length()
            if long > MAX_BITS:
                raise Undecided(f"exact arithmetic does not hold a number of more than {MAX_BITS} bits")
        return value

    def to_integer(self, value: Exact) -> int:
        size = _floor(self._size(value)) % 10000
        return -size if self.sign(value) < 0 else size

    def _size(self, value: Exact) -> Exact:
        return -value if self.sign(value) < 0 else value

    def function(self, name: str, value: Exact) -> tuple[Exact, str]:
        if name == "SQRT" and not isinstance(value, RootSum):
            return square_root(-value if value < 0 else value), ""
        if name == "LOG" and self.sign(value) < 0:
            return self.function("LOG", -value)[0], "F3"
        known = None if isinstance(value, RootSum) else _KNOWN.get((name, value))
        if known is None:
            raise Undecided(f"exact arithmetic cannot hold {name} of {self.text(value)}")
        return known, ""

    def power(self, base: Exact, exponent: Exact) -> tuple[Exact, str]:
        if isinstance(exponent, RootSum) or exponent.denominator != 1:
            raise Undecided(f"exact arithmetic cannot hold a power of exponent {self.text(exponent)}")
        result, _ = self.integer_power(self._size(base), exponent.numerator)
        return result, "F6" if self.sign(base) < 0 else ""

    def integer_power(self, base: Exact, count: int) -> tuple[Exact, str]:
        if base in (1, -1):
            return (base if count % 2 else 1), ""
        result: Exact = 1
        for bit in bin(abs(count))[2:] if base else ("1" if count else ""):
            result = self.checked(result * result * base if bit == "1" else result * result)
        return (self.divide(1, result) if count < 0 else result), ""

    def exact(self, value: Exact, digits: int) -> Fraction | int:
        if not isinstance(value, RootSum):
            return value
        mantissa, exponent = self.cut(value, digits)
        return Fraction(mantissa) * Fraction(10) ** (exponent - digits)

    def cut(self, value: Exact, digits: int) -> tuple[int, int]:
        if not value:
            return 0, MINUS_ZERO if value is _MINUS else ZERO
        size, scale = self._size(value), 0
        if isinstance(size, RootSum):
            while not size.floor(10**scale):
                scale = 2 * scale or digits
            whole = size.floor(10 ** (scale + digits))
            mantissa, exponent = cut_decimal(whole, -scale - digits, digits)
        else:
            # A quotient of so many digits has at least one digit more than are kept.
            scale = max(decimal_length(size.denominator) - decimal_length(size.numerator) + digits + 1, 0)
            mantissa, exponent = cut_decimal(size.numerator * 10**scale // size.denominator, -scale, digits)
        return (mantissa if self.sign(value) > 0 else -mantissa), exponent


def _floor(value: Exact) -> int:
    return value.floor() if isinstance(value, RootSum) else value.numerator // value.denominator


def _lowest(value: Fraction) -> Rational:
    """An int where the number is whole: ints are quicker."""
    return value.numerator if value.denominator == 1 else value

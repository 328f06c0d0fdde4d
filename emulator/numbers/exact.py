"""The arithmetic ``exact``: rational numbers, and sums of their square roots, without any rounding.

A number is an int, a Fraction or a RootSum.  The following operations are exact: ``+ - *``, division by a rational
number or by a sum of two roots, SQRT of a rational number, integer powers, and the other functions at the few arguments
at which their value is rational.  Any other operation raises Undecided, which ends the run.  Zeros have signs as on the
1620.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

from emulator.numbers import work
from emulator.numbers.arithmetic import MINUS_ZERO, ZERO
from emulator.numbers.base import Numbers, Undecided, cut_decimal, decimal_length
from emulator.numbers.roots import MAX_ROOTS, Rational, RootSum, quotient, square_root, terms_of

Exact = Rational | RootSum


class _SignedZero(int):
    """A zero with a minus sign.  No operation except negation has such a zero as its result."""


_MINUS = _SignedZero(0)

# The largest total number of bits of a stored number.  Without this limit, repeated squaring would fill the memory.
MAX_BITS = 100_000

_TOO_LONG = f"exact arithmetic does not hold a number of more than {MAX_BITS} bits"

_KNOWN: dict[tuple[str, Rational], int] = {("SIN", 0): 0, ("ATAN", 0): 0, ("COS", 0): 1, ("EXP", 0): 1, ("LOG", 1): 0}


@dataclass(frozen=True)
class ExactNumbers(Numbers):
    """The arithmetic of rational numbers and sums of square roots."""

    is_costly = True

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
        result = quotient(dividend, divisor)
        if result is None:
            raise Undecided(f"exact arithmetic cannot divide by a sum of {len(divisor.terms)} square roots")
        return result

    def negate(self, value: Exact) -> Exact:
        return -value if value else 0 if value is _MINUS else _MINUS

    def sign(self, value: Exact) -> int:
        if isinstance(value, RootSum):
            return value.sign()
        over = value.numerator
        return (over > 0) - (over < 0)

    def checked(self, value: Exact) -> Exact:
        if _length(value) > MAX_BITS:
            raise Undecided(_TOO_LONG)
        return value

    def work(self, operation: str, first: Exact, second: Exact = 0) -> int:
        a, b = _longest(first), _longest(second)
        if operation == "integer_power":
            assert isinstance(second, int)
            return _power_steps(first, second)
        if operation == "power":
            return _power_steps(first, second.numerator) if not isinstance(second, RootSum) else 0
        # Sums of roots have a separate estimate.  That for rational numbers depends on the longest numerator or
        # denominator.
        if isinstance(first, RootSum) or isinstance(second, RootSum):
            return _root_steps(operation, first, second)
        if operation in ("add", "subtract", "multiply", "divide"):
            if isinstance(first, int) and isinstance(second, int) and operation != "divide":
                return work.product(a, b) if operation == "multiply" else max(a, b) // 10_000
            return work.fractions(a, b)
        if operation == "SQRT":
            return 5 + work.quotient(2 * a, 2 * a)
        # Testing a number needs only its sign, which takes no extra steps.  FIX and output to a card need a division.
        return 0 if operation == "sign" else 2 + 4 * work.product(a, a) + work.quotient(a, a)

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
        result = None if isinstance(value, RootSum) else _KNOWN.get((name, value))
        if result is None:
            raise Undecided(f"exact arithmetic cannot hold {name} of {self.text(value)}")
        return result, ""

    def power(self, base: Exact, exponent: Exact) -> tuple[Exact, str]:
        if isinstance(exponent, RootSum) or exponent.denominator != 1:
            raise Undecided(f"exact arithmetic cannot hold a power with the exponent {self.text(exponent)}")
        result, _ = self.integer_power(self._size(base), exponent.numerator)
        return result, "F6" if self.sign(base) < 0 else ""

    def integer_power(self, base: Exact, count: int) -> tuple[Exact, str]:
        if base in (1, -1):
            return (base if count % 2 else 1), ""
        if _too_long(base, count):
            raise Undecided(_TOO_LONG)
        # Square and multiply, from the highest bit of the exponent down.
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
            # Find a power of ten that makes the number at least 1, so that the next digits are significant.
            while not size.floor(10**scale):
                scale = 2 * scale or digits
            whole = size.floor(10 ** (scale + digits))
            mantissa, exponent = cut_decimal(whole, -scale - digits, digits)
        else:
            # A quotient scaled by this power of ten has at least one digit more than needed.
            scale = max(decimal_length(size.denominator) - decimal_length(size.numerator) + digits + 1, 0)
            mantissa, exponent = cut_decimal(size.numerator * 10**scale // size.denominator, -scale, digits)
        return (mantissa if self.sign(value) > 0 else -mantissa), exponent


def _too_long(base: Exact, count: int) -> bool:
    return not isinstance(base, RootSum) and (_longest(base) - 1) * abs(count) > MAX_BITS


def _length(value: Exact) -> int:
    """Return the number of bits of all numerators, denominators and radicands in a number together."""
    return sum(n.bit_length() + c.numerator.bit_length() + c.denominator.bit_length() for n, c in terms_of(value))


def _longest(value: Exact) -> int:
    """Return the number of bits of the longest numerator or denominator in a number."""
    return max(max(c.numerator.bit_length(), c.denominator.bit_length()) for _, c in terms_of(value))


def _root_steps(operation: str, first: Exact, second: Exact) -> int:
    a, b, terms_first, terms_second = _longest(first), _longest(second), len(terms_of(first)), len(terms_of(second))
    radicands = [n.bit_length() for n, _ in (*terms_of(first), *terms_of(second))]
    # To find the kind of a term, one integer square root is computed for each root that the sum already contains.
    roots = 2 + work.quotient(2 * max(radicands), 2 * max(radicands))
    if operation in ("add", "subtract"):
        return (terms_first + terms_second) ** 2 * roots + terms_first * work.fractions(a, b)
    if operation in ("multiply", "divide"):
        terms, times = terms_first * terms_second, (1 if operation == "multiply" else 6)
        return times * terms * (min(terms, MAX_ROOTS) * roots + work.fractions(times * a, times * b))
    # Signs, integer parts and digits come from bounds with more than twice the length of the coefficients.
    bits = 2 * a + 2 * max(radicands) + 64
    return terms_first * (3 + work.quotient(2 * bits, bits)) * (6 if operation in ("card", "to_integer") else 1)


def _power_steps(base: Exact, count: int) -> int:
    bits = min(_longest(base) * abs(count), 2 * MAX_BITS)
    if base in (0, 1, -1) or _too_long(base, count):
        return 0
    if not isinstance(base, RootSum):
        return 2 * (work.product(bits, bits) if isinstance(base, int) and count > 0 else work.fractions(bits, bits))
    # The number of terms grows with the power until MAX_ROOTS stops it.
    terms = min(int(len(base.terms) ** min(abs(count), 5)), MAX_ROOTS)
    size = min(max(n.bit_length() for n, _ in base.terms) * abs(count), 2 * MAX_BITS)
    roots = 2 + work.quotient(2 * size, 2 * size)
    return 3 * terms * terms * (terms * roots + work.fractions(bits, bits))


def _floor(value: Exact) -> int:
    return value.floor() if isinstance(value, RootSum) else value.numerator // value.denominator


def _lowest(value: Fraction) -> Rational:
    """Return an int if the fraction is an integer, because operations on ints are faster."""
    return value.numerator if value.denominator == 1 else value

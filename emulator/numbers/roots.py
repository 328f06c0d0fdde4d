"""Exact sums of square roots: ``c1*sqrt(n1) + c2*sqrt(n2) + ...`` with rational c and integer n.

Two roots sqrt(m) and sqrt(n) are of the same kind if m * n is a square; sqrt(m) is then a rational multiple of
sqrt(n).  A sum keeps one root of each kind.  Roots of different kinds are linearly independent over the rationals (A.
Besicovitch, On the linear independence of fractional powers of integers, J. London Math. Soc. 15 (1940) 3-6), so a sum
is zero if and only if no term remains.  The sign of a sum that is not zero follows from integer bounds whose length is
doubled until both have the same sign.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from math import isqrt

from emulator.numbers.base import Undecided

Rational = int | Fraction
MAX_ROOTS = 32
_FIRST_BITS = 64


@dataclass(frozen=True, slots=True)
class RootSum:
    """An irrational sum of square roots, as pairs (radicand, coefficient).  A rational part has radicand 1."""

    terms: tuple[tuple[int, Rational], ...]

    def __add__(self, other: Rational | RootSum) -> Rational | RootSum:
        return gathered([*self.terms, *terms_of(other)])

    __radd__ = __add__

    def __neg__(self) -> RootSum:
        return RootSum(tuple((radicand, -c) for radicand, c in self.terms))

    def __sub__(self, other: Rational | RootSum) -> Rational | RootSum:
        return self + -other

    def __rsub__(self, other: Rational) -> Rational | RootSum:
        return -self + other

    def __mul__(self, other: Rational | RootSum) -> Rational | RootSum:
        return gathered(product(m, c, n, d) for m, c in self.terms for n, d in terms_of(other))

    __rmul__ = __mul__

    def sign(self) -> int:
        """Return the sign of the sum, -1 or 1.  A sum of this class is never zero."""
        bits = _FIRST_BITS
        while True:
            low = self._low(bits)
            if low > 0:
                return 1
            if low + len(self.terms) < 0:
                return -1
            bits *= 2

    def _low(self, bits: int) -> int:
        """Return an integer L that bounds the sum from below: ``L <= value * 2**bits <= L + number of terms``."""
        total = 0
        for radicand, coefficient in self.terms:
            # Each term is rounded down.  A positive term becomes its integer square root r, a negative term -r - 1.
            over, under = coefficient.numerator, coefficient.denominator
            size = isqrt((over * over * radicand << 2 * bits) // (under * under))
            total += size if over > 0 else -size - 1
        return total

    def floor(self, factor: int = 1) -> int:
        """Return the largest integer that does not exceed ``value * factor``."""
        scaled = self * factor
        assert isinstance(scaled, RootSum)
        bits = _FIRST_BITS
        while True:
            # The bounds determine the integer part as soon as they agree on it.
            low = scaled._low(bits)
            if low >> bits == (low + len(self.terms)) >> bits:
                return low >> bits
            bits *= 2


def terms_of(value: Rational | RootSum) -> tuple[tuple[int, Rational], ...]:
    return value.terms if isinstance(value, RootSum) else ((1, value),)


def product(m: int, c: Rational, n: int, d: Rational) -> tuple[int, Rational]:
    """Return the product of ``c*sqrt(m)`` and ``d*sqrt(n)`` as a pair of radicand and coefficient."""
    if m == n:
        return 1, c * d * m
    return m * n, c * d


def gathered(terms: Iterable[tuple[int, Rational]]) -> Rational | RootSum:
    """Add terms, and merge roots that are multiples of each other.  Raise Undecided if more than MAX_ROOTS are left."""
    coefficients: dict[int, Rational] = {}
    for radicand, coefficient in terms:
        if radicand in coefficients:
            coefficients[radicand] += coefficient
            continue
        for same_kind in coefficients:
            # sqrt(m) = (sqrt(m*n) / n) * sqrt(n), which is rational times sqrt(n) if m*n is a square.
            root = isqrt(radicand * same_kind)
            if root * root == radicand * same_kind:
                coefficients[same_kind] += coefficient * Fraction(root, same_kind)
                break
        else:
            # A new kind.  The root of a square belongs to the rational part.
            root = isqrt(radicand)
            if root * root == radicand:
                radicand, coefficient = 1, coefficient * root
            coefficients[radicand] = coefficients.get(radicand, 0) + coefficient
            if len(coefficients) > MAX_ROOTS and sum(bool(c) for c in coefficients.values()) > MAX_ROOTS:
                raise Undecided(f"exact arithmetic cannot hold a sum of more than {MAX_ROOTS} square roots")
    nonzero = tuple((radicand, c) for radicand, c in coefficients.items() if c)
    if not nonzero:
        return 0
    if len(nonzero) == 1 and nonzero[0][0] == 1:
        return nonzero[0][1]
    return RootSum(nonzero)


def square_root(value: Rational) -> Rational | RootSum:
    """Return the square root of a rational number that is not negative."""
    over, under = value.numerator, value.denominator
    # sqrt(p/q) = sqrt(p*q)/q
    return gathered([(over * under, Fraction(1, under))]) if over else 0


def quotient(dividend: Rational | RootSum, divisor: RootSum) -> Rational | RootSum | None:
    """Divide by a sum of one or two square roots.  Return None for a divisor with more roots."""
    if len(divisor.terms) > 2:
        return None
    # (a + b) * (a - b) is rational if a and b are terms of a sum of roots: multiply by the conjugate.
    (m, c), *rest = divisor.terms
    conjugate = gathered([(m, c), *((n, -d) for n, d in rest)])
    norm = divisor * conjugate
    assert not isinstance(norm, RootSum)
    return conjugate * (1 / Fraction(norm)) * dividend

"""Sums of square roots, exactly: ``c1*sqrt(n1) + c2*sqrt(n2) + ...`` with rational c and whole n.

Two roots belong together when the product of their radicands is a square: then sqrt(m) is a rational multiple of
sqrt(n).  A sum is kept with one root of each kind, and roots of different kinds are linearly independent over
the rationals (A. Besicovitch, On the linear independence of fractional powers of integers, J. London Math. Soc.
15 (1940) 3-6), so a sum is zero just when no term is left.  The sign of a sum that is not zero is found by bounds
in whole numbers, doubled in length until both lie on one side.
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
    """A number that is irrational: terms (radicand, coefficient), radicand 1 for the rational part, never alone."""

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

    def __abs__(self) -> RootSum:
        return -self if self.sign() < 0 else self

    def sign(self) -> int:
        """-1 or 1; a sum of roots with a term left is not zero."""
        bits = _FIRST_BITS
        while True:
            low = self._low(bits)
            if low > 0:
                return 1
            if low + len(self.terms) < 0:
                return -1
            bits *= 2

    def _low(self, bits: int) -> int:
        """A whole number L with ``L <= value * 2**bits <= L + number of terms``."""
        total = 0
        for radicand, coefficient in self.terms:
            over, under = coefficient.numerator, coefficient.denominator
            size = isqrt((over * over * radicand << 2 * bits) // (under * under))
            total += size if over > 0 else -size - 1
        return total

    def floor(self, over: int = 1, under: int = 1) -> int:
        """The largest whole number not above ``value * over / under``; exact, as the value is irrational."""
        scaled = self * Fraction(over, under)
        assert isinstance(scaled, RootSum)
        bits = _FIRST_BITS
        while True:
            low = scaled._low(bits)
            if low >> bits == (low + len(self.terms)) >> bits:
                return low >> bits
            bits *= 2


def terms_of(value: Rational | RootSum) -> tuple[tuple[int, Rational], ...]:
    return value.terms if isinstance(value, RootSum) else ((1, value),)


def product(m: int, c: Rational, n: int, d: Rational) -> tuple[int, Rational]:
    """``c*sqrt(m) * d*sqrt(n)`` as radicand and coefficient."""
    if m == n:
        return 1, c * d * m
    return m * n, c * d


def gathered(terms: Iterable[tuple[int, Rational]]) -> Rational | RootSum:
    """The sum of terms, one of each kind kept.  Raises Undecided for more than MAX_ROOTS kinds."""
    kept: dict[int, Rational] = {}
    for radicand, coefficient in terms:
        if radicand in kept:
            kept[radicand] += coefficient
            continue
        for other in kept:
            root = isqrt(radicand * other)
            if root * root == radicand * other:
                kept[other] += coefficient * Fraction(root, other)
                break
        else:
            root = isqrt(radicand)
            if root * root == radicand:
                radicand, coefficient = 1, coefficient * root
            kept[radicand] = kept.get(radicand, 0) + coefficient
            if len(kept) > MAX_ROOTS and sum(bool(c) for c in kept.values()) > MAX_ROOTS:
                raise Undecided(f"exact arithmetic cannot hold a sum of more than {MAX_ROOTS} square roots")
    left = tuple((radicand, c) for radicand, c in kept.items() if c)
    if not left:
        return 0
    if len(left) == 1 and left[0][0] == 1:
        return left[0][1]
    return RootSum(left)


def square_root(value: Rational) -> Rational | RootSum:
    """The square root of a rational number that is not negative."""
    over, under = value.numerator, value.denominator
    # sqrt(p/q) = sqrt(p*q)/q
    return gathered([(over * under, Fraction(1, under))]) if over else 0


def quotient(dividend: Rational | RootSum, divisor: RootSum) -> Rational | RootSum | None:
    """A quotient by a sum of at most two terms, by its conjugate; None for a longer one."""
    if len(divisor.terms) > 2:
        return None
    (m, c), *rest = divisor.terms
    conjugate = gathered([(m, c), *((n, -d) for n, d in rest)])
    norm = divisor * conjugate
    assert not isinstance(norm, RootSum)
    return conjugate * (1 / Fraction(norm)) * dividend

"""Exact sums of square roots: signs, quotients and integer parts."""

import math
import random
from fractions import Fraction
from math import isqrt

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import MPContext

from emulator.numbers import Undecided
from emulator.numbers.fields import FALLBACK
from emulator.numbers.roots import MAX_ROOTS, RootSum, square_root
from tests.emulator.numbers.test_number_systems import DOUBLE, EXACT, run

CONTEXT = MPContext()
CONTEXT.dps = 120


def root(value: int | Fraction) -> object:
    return EXACT.function("SQRT", value)[0]


# Square roots, exactly.


def triples(count: int) -> list[tuple[int, int, int]]:
    """Return radicands of lengths: general triples, collinear points, and sums that nearly vanish."""
    r = random.Random(1963)
    radicands = []
    for k in range(count):
        a, b = r.randint(1, 10 ** r.randint(1, 18)), r.randint(1, 10 ** r.randint(1, 18))
        if k % 3 == 0:
            n = r.choice((1, 2, 3, 5, 6, 7, 10**9 + 7))
            p, q = r.randint(1, 10**6), r.randint(1, 10**6)
            a, b, c = n * p * p, n * q * q, n * (p + q) ** 2
        elif k % 3 == 1:
            c = a + b + isqrt(4 * a * b) + r.randint(0, 1)
        else:
            c = r.randint(1, 10 ** r.randint(1, 18))
        radicands.append((a, b, c))
    return radicands


def test_signs_are_exact_where_double_precision_is_wrong() -> None:
    # Card 169 of program 2 with 6,000 triples, compared with (sqrt a + sqrt b)**2 - c in integers.
    zero = 0
    for a, b, c in triples(6_000):
        rest = c - a - b
        expected = 1 if rest < 0 else (4 * a * b > rest * rest) - (4 * a * b < rest * rest)
        assert EXACT.sign(EXACT.subtract(EXACT.add(root(a), root(b)), root(c))) == expected
        zero += expected == 0
    assert zero >= 2_000
    wrong = 0
    for a, b, c in triples(600):
        exact = EXACT.sign(EXACT.subtract(EXACT.add(root(a), root(b)), root(c)))
        wrong += exact != DOUBLE.sign(math.sqrt(a) + math.sqrt(b) - math.sqrt(c))
    assert wrong > 20


FRACTIONS = st.fractions(max_denominator=999).filter(lambda f: abs(f) < 10**6)
SUMS = st.lists(st.tuples(FRACTIONS, st.integers(0, 60)), min_size=1, max_size=5)


def summed(terms: list[tuple[Fraction, int]]) -> tuple[object, object]:
    """Return the sum of c*sqrt(n), exactly and to 120 digits."""
    exact: object = 0
    near = CONTEXT.mpf(0)
    for c, n in terms:
        exact = EXACT.add(exact, EXACT.multiply(c, root(n)))
        near += CONTEXT.mpf(c.numerator) / c.denominator * CONTEXT.sqrt(n)
    return exact, near


def close(exact: object, near: object) -> None:
    mantissa, exponent = EXACT.cut(exact, 40)
    if mantissa == 0:
        assert abs(near) < CONTEXT.mpf(10) ** -90
        return
    value = CONTEXT.mpf(mantissa) * CONTEXT.mpf(10) ** (exponent - 40)
    unit = CONTEXT.mpf(10) ** (exponent - 40)
    # The value to compare with is itself accurate to about a hundred digits only.
    assert -unit / 10**40 < (near - value) * (1 if mantissa > 0 else -1) < unit * 1.0001
    assert EXACT.sign(exact) == (1 if near > 0 else -1)


@settings(max_examples=80)
@given(SUMS, SUMS)
def test_sums_and_products_of_roots(one: list[tuple[Fraction, int]], other: list[tuple[Fraction, int]]) -> None:
    (a, x), (b, y) = summed(one), summed(other)
    close(a, x)
    close(EXACT.add(a, b), x + y)
    close(EXACT.subtract(a, b), x - y)
    close(EXACT.multiply(a, b), x * y)
    close(EXACT.negate(a), -x)


@settings(max_examples=50)
@given(SUMS, st.lists(st.tuples(FRACTIONS, st.integers(0, 60)), min_size=1, max_size=2))
def test_quotients_by_a_sum_of_two_roots(one: list[tuple[Fraction, int]], two: list[tuple[Fraction, int]]) -> None:
    (a, x), (b, y) = summed(one), summed(two)
    if EXACT.sign(b):
        close(EXACT.divide(a, b), x / y)
        assert EXACT.sign(EXACT.subtract(EXACT.multiply(EXACT.divide(a, b), b), a)) == 0


@settings(max_examples=50)
@given(SUMS)
def test_integer_part_of_a_sum_is_exact(terms: list[tuple[Fraction, int]]) -> None:
    exact, near = summed(terms)
    whole = int(CONTEXT.floor(abs(near) + CONTEXT.mpf(10) ** -60)) % 10000
    assert EXACT.to_integer(exact) == (-whole if EXACT.sign(exact) < 0 else whole)


def test_powers_of_a_sum_are_exact() -> None:
    assert EXACT.integer_power(Fraction(2, 3), 5) == (Fraction(32, 243), "")
    assert EXACT.integer_power(Fraction(2, 3), -2) == (Fraction(9, 4), "")
    assert EXACT.integer_power(root(2), 4) == (4, "")
    assert EXACT.integer_power(0, 3) == (0, "")
    assert EXACT.integer_power(0, 0) == (1, "")
    assert EXACT.integer_power(-1, 9999) == (-1, "")
    assert EXACT.power(-3, 3) == (27, "F6")
    assert EXACT.function("COS", 0) == (1, "")


def test_sum_of_too_many_roots_ends_the_run() -> None:
    lines = ["A=0.", "P=1.", "5 P=P+1.", "A=A+SQRT(P)", "GO TO 5"]
    result = run("exact", *lines)
    assert result.ending.kind == "undecided"
    assert f"a sum of more than {MAX_ROOTS} square roots, in A=A+SQRT(P)" in result.ending.message


@pytest.mark.parametrize("whole", range(10**9, 10**9 + 30))
def test_sign_of_a_sum_that_nearly_vanishes(whole: int) -> None:
    """The third derivative of the root is positive, and so is the third difference, about 1E-23 here."""
    terms = [((whole + k), (-1) ** (3 - k) * math.comb(3, k)) for k in range(4)]
    total = sum((square_root(n) * c for n, c in terms), start=RootSum(()))
    assert isinstance(total, RootSum)
    assert (total.sign(), (-total).sign()) == (1, -1)
    assert (total.floor(), (-total).floor()) == (0, -1)


def test_roots_of_the_same_kind_are_combined() -> None:
    """1 + 2 + ... + 200 times the root of 2, which then cancels completely."""
    total: object = 0
    for k in range(1, 201):
        total = EXACT.add(total, root(2 * k * k))
    assert isinstance(total, RootSum)
    assert len(total.terms) == 1
    assert EXACT.subtract(total, root(2 * 20100**2)) == 0


def test_digits_of_an_irrational_number_are_truncated_exactly() -> None:
    """However many zeros or nines follow, the digits are truncated at the right place."""
    tiny = EXACT.subtract(root(10**60 + 1), 10**30)
    assert EXACT.write(FALLBACK, tiny)[0] == " .49999999E-30"
    assert EXACT.cut(EXACT.multiply(tiny, -1), 40)[0] < 0
    with pytest.raises(Undecided, match="divide by zero"):
        EXACT.divide(1, EXACT.subtract(root(8), EXACT.multiply(2, root(2))))

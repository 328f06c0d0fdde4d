"""Laws of the decimal arithmetic for any number of digits, tested with exact fractions and :mod:`decimal`."""

from decimal import ROUND_DOWN, Context, Decimal
from fractions import Fraction
from functools import cache

import pytest
from hypothesis import given
from hypothesis import strategies as st

from emulator.numbers import accumulator
from emulator.numbers.arithmetic import (
    FAMILIES,
    IBM1962,
    MAX_DIGITS,
    MIN_DIGITS,
    TRUNCATING,
    ZERO,
    Profile,
    add,
    divide,
    from_integer,
    multiply,
    profile,
    to_integer,
    wrap_integer,
)

Number = tuple[int, int]


@cache  # hypothesis takes longer to check a new strategy than to draw from it
def mantissas(p: int) -> st.SearchStrategy[int]:
    edges = st.sampled_from([10 ** (p - 1), 10**p - 1, 5 * 10 ** (p - 1), 10 ** (p - 1) + 1])
    magnitudes = st.integers(10 ** (p - 1), 10**p - 1) | edges
    return st.tuples(magnitudes, st.booleans()).map(lambda t: -t[0] if t[1] else t[0])


@cache
def distances(p: int, spread: int) -> st.SearchStrategy[int]:
    return st.integers(-3, 3) | st.integers(-p - 3, p + 3) | st.integers(-spread, spread)


@st.composite
def profiles(draw: st.DrawFn, family: str) -> Profile:
    return profile(f"{family}:{draw(st.integers(MIN_DIGITS, MAX_DIGITS))}")


@st.composite
def operands(draw: st.DrawFn, family: str, spread: int = 40) -> tuple[Profile, Number, Number]:
    """Draw a profile and two numbers with its digits, often close, with exponents at most ``spread`` apart."""
    drawn = draw(profiles(family))
    p = drawn.digits
    near = draw(st.integers(-20, 20))
    apart = draw(distances(p, spread))
    return drawn, (draw(mantissas(p)), near), (draw(mantissas(p)), near + apart)


def value(number: Number, p: int) -> Fraction:
    return Fraction(number[0]) * Fraction(10) ** (number[1] - p)


def normalised(number: Number, p: int) -> bool:
    return number == (0, ZERO) or 10 ** (p - 1) <= abs(number[0]) < 10**p


def nearest(exact: Fraction, p: int, half: bool) -> Number:
    """Return the exact value truncated to p digits or rounded half up, computed independently."""
    if exact == 0:
        return 0, ZERO
    size, exponent = abs(exact), 0
    while size >= 10**p:
        size, exponent = size / 10, exponent + 1
    while size < 10 ** (p - 1):
        size, exponent = size * 10, exponent - 1
    whole = int(size + Fraction(1, 2)) if half else int(size)
    if whole == 10**p:
        whole, exponent = 10 ** (p - 1), exponent + 1
    return (whole if exact > 0 else -whole), exponent + p


def plus(a: Number, b: Number, drawn: Profile) -> Number:
    return add(*a, *b, drawn.rules)


@given(operands("truncating"))
def test_products_and_quotients_are_the_exact_ones_truncated(case: tuple[Profile, Number, Number]) -> None:
    drawn, a, b = case
    p = drawn.digits
    assert multiply(*a, *b, drawn.rules) == nearest(value(a, p) * value(b, p), p, half=False)
    assert divide(*a, *b, drawn.rules) == nearest(value(a, p) / value(b, p), p, half=False)


@given(operands("truncating"))
def test_sum_truncates_the_smaller_operand_first(case: tuple[Profile, Number, Number]) -> None:
    """The operand with the smaller exponent loses its digits before the addition, then the sum is truncated."""
    drawn, a, b = case
    p = drawn.digits
    if a[1] < b[1]:
        a, b = b, a
    shift = a[1] - b[1]
    kept = abs(b[0]) // 10**shift * (1 if b[0] > 0 else -1)
    exact = (Fraction(a[0]) + kept) * Fraction(10) ** (a[1] - p)
    assert plus(a, b, drawn) == nearest(exact, p, half=False)


@given(operands("guarded"))
def test_guard_digit_keeps_the_first_digit_shifted_out(case: tuple[Profile, Number, Number]) -> None:
    drawn, a, b = case
    p = drawn.digits
    if a[1] < b[1]:
        a, b = b, a
    kept = Fraction(abs(b[0]) * 10 // 10 ** (a[1] - b[1]), 10) * (1 if b[0] > 0 else -1)
    exact = (Fraction(a[0]) + kept) * Fraction(10) ** (a[1] - p)
    assert plus(a, b, drawn) == nearest(exact, p, half=False)
    assert multiply(*a, *b, drawn.rules) == nearest(value(a, p) * value(b, p), p, half=False)
    assert divide(*a, *b, drawn.rules) == nearest(value(a, p) / value(b, p), p, half=False)


@given(operands("rounding"))
def test_rounding_gives_the_exact_result_rounded(case: tuple[Profile, Number, Number]) -> None:
    drawn, a, b = case
    p = drawn.digits
    assert plus(a, b, drawn) == nearest(value(a, p) + value(b, p), p, half=True)
    assert multiply(*a, *b, drawn.rules) == nearest(value(a, p) * value(b, p), p, half=True)
    assert divide(*a, *b, drawn.rules) == nearest(value(a, p) / value(b, p), p, half=True)


@given(operands("truncating", 12))
def test_ibm1962_rounds_products_only(case: tuple[Profile, Number, Number]) -> None:
    drawn, a, b = case
    p = drawn.digits
    rules = drawn.rules._replace(round_products=1)
    assert IBM1962.rules == TRUNCATING.rules._replace(round_products=1, as_1962=1)
    assert multiply(*a, *b, rules) == nearest(value(a, p) * value(b, p), p, half=True)


families = st.sampled_from([family.partition(":")[0] for family in FAMILIES])


@given(families.flatmap(operands))
def test_commutative(case: tuple[Profile, Number, Number]) -> None:
    drawn, a, b = case
    assert plus(a, b, drawn) == plus(b, a, drawn)
    assert multiply(*a, *b, drawn.rules) == multiply(*b, *a, drawn.rules)


@given(families.flatmap(operands))
def test_symmetric_in_sign(case: tuple[Profile, Number, Number]) -> None:
    """Truncation applies to the magnitude: toward zero for both signs."""
    drawn, a, b = case
    minus_a, minus_b = (-a[0], a[1]), (-b[0], b[1])
    size, exponent = plus(a, b, drawn)
    assert plus(minus_a, minus_b, drawn) == (-size, exponent)
    size, exponent = multiply(*a, *b, drawn.rules)
    assert multiply(*minus_a, *b, drawn.rules) == multiply(*a, *minus_b, drawn.rules) == (-size, exponent)
    size, exponent = divide(*a, *b, drawn.rules)
    assert divide(*minus_a, *b, drawn.rules) == divide(*a, *minus_b, drawn.rules) == (-size, exponent)


@given(families.flatmap(operands))
def test_results_are_normalised(case: tuple[Profile, Number, Number]) -> None:
    drawn, a, b = case
    for result in (plus(a, b, drawn), multiply(*a, *b, drawn.rules), divide(*a, *b, drawn.rules)):
        assert normalised(result, drawn.digits)


@given(families.flatmap(operands))
def test_difference_of_equal_numbers_is_zero_and_one_is_neutral(case: tuple[Profile, Number, Number]) -> None:
    drawn, a, _ = case
    one = from_integer(1, drawn.rules)
    assert plus(a, (-a[0], a[1]), drawn) == (0, ZERO)
    assert multiply(*a, *one, drawn.rules) == divide(*a, *one, drawn.rules) == a
    assert divide(*a, *a, drawn.rules) == one


@given(families.flatmap(operands))
def test_adding_or_subtracting_zero_changes_nothing(case: tuple[Profile, Number, Number]) -> None:
    drawn, a, _ = case
    assert accumulator.add(*a, 0, ZERO, drawn.rules) == (*a, 0)
    assert accumulator.add(0, ZERO, *a, drawn.rules) == (*a, 0)
    assert accumulator.subtract(*a, 0, ZERO, drawn.rules) == (*a, 0)


@pytest.mark.parametrize("p", range(3, MAX_DIGITS + 1))
def test_product_below_a_power_of_ten_rounds_up_to_it(p: int) -> None:
    """(10**(p-1) + 1) * (10**p - 10) = 10**(2p-1) - 10, integers of p digits."""
    product = multiply(10 ** (p - 1) + 1, p, 10**p - 10, p, profile(f"rounding:{p}").rules)
    assert product == (10 ** (p - 1), 2 * p)


# Against the standard library's decimal arithmetic.

DOWN = Context(prec=8, rounding=ROUND_DOWN)


def decimal(number: Number) -> Decimal:
    return Decimal(number[0]).scaleb(number[1] - 8)


eights = st.tuples(st.integers(10**7, 10**8 - 1), st.booleans(), st.integers(-30, 30)).map(
    lambda t: (-t[0] if t[1] else t[0], t[2])
)


@given(eights, eights)
def test_multiply_and_divide_agree_with_decimal_rounding_down(a: Number, b: Number) -> None:
    assert decimal(multiply(*a, *b, TRUNCATING.rules)) == DOWN.multiply(decimal(a), decimal(b))
    assert decimal(divide(*a, *b, TRUNCATING.rules)) == DOWN.divide(decimal(a), decimal(b))


def test_addition_differs_from_the_decimal_module() -> None:
    """1.0-.99999999 is .1E-06 on the machine, because .99999999 becomes .9999999 before the subtraction."""
    one, nines = (10**7, 1), (99999999, 0)
    assert DOWN.subtract(decimal(one), decimal(nines)) == Decimal("1E-8")
    assert plus(one, (-nines[0], nines[1]), TRUNCATING) == (10**7, -6)
    assert decimal((10**7, -6)) == Decimal(".1E-06")


# Conversion and whole numbers.


@given(st.integers(-9999, 9999), families.flatmap(profiles))
def test_integers_convert_to_floating_point_and_back(whole: int, drawn: Profile) -> None:
    mantissa, exponent = from_integer(whole, drawn.rules)
    assert normalised((mantissa, exponent), drawn.digits)
    back = to_integer(mantissa, exponent, drawn.rules)
    unit = 10 ** max(0, len(str(abs(whole))) - drawn.digits)
    assert back == (abs(whole) // unit * unit) * (1 if whole > 0 else -1)


@given(families.flatmap(operands))
def test_to_integer_keeps_four_digits_left_of_the_point(case: tuple[Profile, Number, Number]) -> None:
    """C26-5619 p. 21."""
    drawn, a, _ = case
    exact = value(a, drawn.digits)
    expected = int(abs(exact)) % 10_000 * (1 if exact > 0 else -1)
    assert to_integer(*a, drawn.rules) == expected


@given(st.integers(-(10**9), 10**9))
def test_wrap(whole: int) -> None:
    """Modulo 10,000 with the sign kept (executed on IBM's code at 02644)."""
    assert abs(wrap_integer(whole)) == abs(whole) % 10_000
    assert wrap_integer(-whole) == -wrap_integer(whole)


# Names.


@pytest.mark.parametrize("name", ["truncating", "ibm1962", "truncating:2", "guarded:5", "rounding:28", "truncating:08"])
def test_profiles_by_name(name: str) -> None:
    assert profile(name).name == name


@pytest.mark.parametrize(
    "name",
    [
        "",
        "float",
        "truncating:",
        "truncating:1",
        "rounding:29",
        "rounding",
        "rounding:-5",
        "ibm1962:8",
        "rounding:8.",
        "rounding:" + "8" * 5000,
        "x:8",
    ],
)
def test_unknown_profile_is_rejected(name: str) -> None:
    with pytest.raises(ValueError, match=r"no arithmetic is called|the number of digits must be"):
        profile(name)


def test_truncating_8_is_truncating() -> None:
    assert profile("truncating:8").rules == profile("truncating").rules

"""Library functions and powers compared with exact integers and with a second, precise computation."""

from decimal import ROUND_DOWN, Context, Decimal
from fractions import Fraction
from math import isqrt

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from emulator.numbers.accumulator import whole_power
from emulator.numbers.arithmetic import IBM1962, TRUNCATING, TRUNCATING1962, ZERO, from_integer, multiply, profile
from emulator.numbers.functions import Value, _exact_power, decimal_chain, function, integer_power, power
from tests.support.deckwork import machine, number

RULES = TRUNCATING.rules
mantissas = st.integers(10**7, 10**8 - 1)


@given(mantissas, st.integers(-99, 99))
def test_sqrt_is_the_exact_root_truncated(mantissa: int, exponent: int) -> None:
    """Executed on FORTRAN II-D: the exact square root, truncated."""
    result = function("SQRT", mantissa, exponent, RULES)
    assert 10**7 <= result.mantissa < 10**8
    # root = result.mantissa * 10**(result.exponent - 8); compare squares as integers of a common scale.
    scale = 2 * (result.exponent - 8)
    value = mantissa * 10 ** (exponent - 8 - scale) if exponent - 8 >= scale else None
    if value is None:
        low, high = (result.mantissa**2, (result.mantissa + 1) ** 2)
        shift = 10 ** (scale - exponent + 8)
        assert low * shift <= mantissa < high * shift
    else:
        assert isqrt(value) == result.mantissa
    assert function("SQRT", -mantissa, exponent, RULES) == result


def cut(value: Decimal) -> tuple[int, int]:
    digits = Context(prec=8, rounding=ROUND_DOWN).plus(value).as_tuple()
    size = int("".join(map(str, digits.digits)).ljust(8, "0"))
    assert isinstance(digits.exponent, int)
    return (-size if digits.sign else size), len(digits.digits) + digits.exponent


@given(mantissas, st.integers(-7, 2))
def test_exp_is_the_exact_value_truncated(mantissa: int, exponent: int) -> None:
    """:mod:`decimal` computes exp and ln correctly rounded, with another method than mpmath."""
    exact = Context(prec=60).exp(Decimal(mantissa).scaleb(exponent - 8))
    assert function("EXP", mantissa, exponent, RULES) == Value(*cut(exact))


@given(mantissas, st.integers(-20, 20))
def test_log_is_the_exact_value_truncated(mantissa: int, exponent: int) -> None:
    if (mantissa, exponent) == (10**7, 1):
        return
    exact = Context(prec=60).ln(Decimal(mantissa).scaleb(exponent - 8))
    assert function("LOG", mantissa, exponent, RULES) == Value(*cut(exact))


@pytest.mark.parametrize(
    ("statement", "expected"),
    [
        ("SIN(0.)", "0"),
        ("COS(0.)", ".10000000E+01"),
        ("EXP(0.)", ".10000000E+01"),
        ("LOG(1.)", "0"),
        ("ATAN(0.)", "0"),
        ("EXP(1.)", ".27182818E+01"),
        ("LOG(10.)", ".23025850E+01"),
        ("LOGF(2.)", ".69314718E+00"),
        ("SIN(1.)", ".84147098E+00"),
        ("COSF(1.)", ".54030230E+00"),
        ("4.*ATAN(1.)", ".31415926E+01"),
        ("SIN(-1.)", "-.84147098E+00"),
        ("SIN(.00001)", ".99999999E-05"),
    ],
)
def test_known_values_are_truncated_to_eight_digits(statement: str, expected: str) -> None:
    """Tables of mathematical constants.  4 * .78539816 = 3.14159264, truncated."""
    made = machine(f"D={statement}", "END")
    assert made.run().errors == ()
    assert number(made, "D") == expected


@pytest.mark.parametrize(
    ("name", "argument", "mantissa", "exponent", "code"),
    [
        ("SIN", (10**7, 9), 99999999, 99, "F1"),
        ("COS", (10**7, 50), 99999999, 99, "F1"),
        ("LOG", (0, ZERO), -99999999, 99, "F2"),
        ("LOG", (-27182818, 1), 99999998, 0, "F3"),
        ("EXP", (24000000, 3), 99999999, 99, "F4"),
        ("EXP", (-24000000, 3), 0, ZERO, "F5"),
        ("EXP", (10**7, 99), 99999999, 99, "F4"),
        ("EXP", (-(10**7), 99), 0, ZERO, "F5"),
    ],
)
def test_invalid_arguments_give_the_error_codes(name, argument, mantissa, exponent, code) -> None:
    """GOTRAN's table F1 to F5 (C26-5594 p. 28); ln 2.7182818 = .99999998..."""
    assert function(name, *argument, RULES) == Value(mantissa, exponent, code)


@given(mantissas, st.integers(-3, 3), st.integers(1, 9), st.booleans(), st.sampled_from(["truncating", "rounding:8"]))
def test_integer_powers_are_the_exact_power_truncated(m: int, e: int, count: int, over: bool, name: str) -> None:
    """IBM FORTRAN II-D, executed (pow, pow2 of tests/data/compiler_runs).  Rounded half up if products are."""
    exact = (Fraction(m) * Fraction(10) ** (e - 8)) ** (-count if over else count)
    result = integer_power(m, e, -count if over else count, profile(name).rules)
    unit = Fraction(10) ** (result.exponent - 8)
    if name == "truncating":
        assert result.mantissa * unit <= exact < (result.mantissa + 1) * unit
    else:
        assert (result.mantissa - Fraction(1, 2)) * unit <= exact
        assert exact < (result.mantissa + Fraction(1, 2)) * unit or result.mantissa == 10**7
    assert 10**7 <= result.mantissa < 10**8


@given(st.integers(9_990_000, 10_020_000), st.integers(-9999, 9999), st.sampled_from(["truncating", "rounding:28"]))
def test_guard_digits_give_the_same_large_power_as_all_digits(size: int, count: int, name: str) -> None:
    rules = profile(name).rules
    assert _exact_power(size, -7, count, rules) == _exact_power(size, -7, count, rules, 10**9)


@given(mantissas, st.integers(-3, 3), st.integers(1, 6))
def test_ibm1962_computes_integer_powers_by_multiplication(mantissa: int, exponent: int, count: int) -> None:
    """The library of 1962 multiplies 1 by the base J times (executed), and the first product is exact."""
    rules = IBM1962.rules
    m, e = mantissa, exponent
    for _ in range(count - 1):
        m, e = multiply(m, e, mantissa, exponent, rules)
    assert integer_power(mantissa, exponent, count, rules) == Value(m, e)


@given(
    st.tuples(mantissas, st.integers(-99, 99)) | st.tuples(st.integers(10**7, 10_200_000), st.integers(0, 1)),
    st.booleans(),
    st.integers(-9999, 9999).filter(bool),
    st.sampled_from([IBM1962, TRUNCATING1962]),
)
@example((99999999, 0), False, 9999, IBM1962)
@example((97999999, 0), True, 9999, IBM1962)
@example((10300000, 1), True, 8000, TRUNCATING1962)
def test_long_chains_of_products_equal_products_of_integers(base, minus, count, arithmetic) -> None:
    mantissa, exponent = base
    case = (-mantissa if minus else mantissa, exponent, count, arithmetic.rules)
    assert decimal_chain(*case) == whole_power(*case)


@pytest.mark.parametrize(
    ("base", "count", "expected"),
    [
        ((20000000, 1), 0, Value(10000000, 1)),
        ((0, ZERO), 3, Value(0, ZERO)),
        ((0, ZERO), -1, Value(99999999, 99, "E7")),
        ((20000000, 1), -2, Value(25000000, 0)),
        ((10000000, 61), 2, Value(99999999, 99, "E3")),
        ((10000000, -59), 2, Value(0, ZERO, "E4")),
        ((-10000000, 61), 2, Value(99999999, 99, "E3")),
        ((10000000, 61), -2, Value(0, ZERO, "E4")),
    ],
)
def test_integer_powers_at_the_limits_of_the_range(base: tuple[int, int], count: int, expected: Value) -> None:
    assert integer_power(*base, count, RULES) == expected


@pytest.mark.parametrize(
    ("base", "exponent", "expected"),
    [
        ((20000000, 1), (50000000, 0), Value(14142135, 1)),
        ((40000000, 1), (50000000, 0), Value(20000000, 1)),
        ((20000000, 1), (0, ZERO), Value(10000000, 1)),
        ((0, ZERO), (20000000, 1), Value(0, ZERO)),
        ((-40000000, 1), (50000000, 0), Value(20000000, 1, "F6")),
        ((10000000, 2), (10000000, 4), Value(99999999, 99, "F4")),
        ((10000000, 2), (-10000000, 4), Value(0, ZERO, "F5")),
    ],
)
def test_floating_powers(base: tuple[int, int], exponent: tuple[int, int], expected: Value) -> None:
    """The exact power, truncated.  F6 uses |A| (C26-5594 p. 28)."""
    assert power(base, exponent, RULES) == expected


@pytest.mark.parametrize("base", range(2, 22))
def test_exact_power_is_not_truncated_to_the_number_below(base: int) -> None:
    """With a floating exponent the logarithm may give 2.9999..., with any number of digits."""
    for count in range(2, 7):
        whole, exact = from_integer(base, RULES), from_integer(base**count, RULES)
        assert power(whole, from_integer(count, RULES), RULES) == Value(*exact)
    half = (50000000, 0)
    assert power(from_integer(base * base, RULES), half, RULES) == Value(*from_integer(base, RULES))


def test_sqrt_is_rounded_if_products_are() -> None:
    """A root is truncated to the profile's digits, or rounded if products are rounded."""
    made = machine("A=SQRT(10.)", "B=EXP(1.)", "END", arithmetic="rounding:8")
    made.run()
    assert number(made, "B") == ".27182818E+01"
    assert number(made, "A") == ".31622777E+01"


@pytest.mark.parametrize("digits", [2, 5, 12, 20, 28])
def test_other_digit_counts(digits: int) -> None:
    text = "2.718281828459045235360287471352662497757"
    for family in ("truncating", "rounding"):
        result = function("EXP", *(10 ** (digits - 1), 1), profile(f"{family}:{digits}").rules)
        expected = int(text.replace(".", "")[: digits + 1])
        expected = (expected + 5) // 10 if family == "rounding" else expected // 10
        assert (result.mantissa, result.exponent) == (expected, 1)

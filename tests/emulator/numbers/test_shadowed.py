"""The error bounds of shadowed numbers, compared with exact fractions, or with mpmath for functions."""

from fractions import Fraction
from typing import Any

import mpmath
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from emulator.numbers import numbers
from emulator.numbers.base import Trap
from emulator.numbers.shadowed import Shadowed, ShadowedNumbers

ROUNDING = ("float32", "float64", "truncating", "truncating:3", "guarded:8", "ibm1962", "mp:30", "mp:100")
OPERATIONS = ("add", "subtract", "subtract_reversed", "multiply", "divide")


def shadowed(name: str) -> ShadowedNumbers:
    return ShadowedNumbers(numbers(name))


def exactly(operation: str, a: Fraction, b: Fraction) -> Fraction:
    results = {"add": a + b, "subtract": a - b, "subtract_reversed": b - a, "multiply": a * b}
    return a / b if operation == "divide" else results[operation]


DECIMALS = st.tuples(st.integers(-9999, 9999), st.integers(-4, 2))


@given(
    st.sampled_from(ROUNDING),
    st.lists(DECIMALS, min_size=2, max_size=5),
    st.lists(st.tuples(st.sampled_from(OPERATIONS), st.integers(0, 99), st.integers(0, 99)), max_size=12),
)
def test_exact_number_lies_within_the_bound(name, decimals, steps) -> None:
    """For any formula of sums, products and quotients.  A bound of zero means an exact number."""
    system = shadowed(name)
    held: list[Shadowed] = [system.decimal(*decimal) for decimal in decimals]
    truth = [Fraction(whole) * Fraction(10) ** power for whole, power in decimals]
    for operation, i, j in steps:
        first, second = i % len(held), j % len(held)
        if operation == "divide":
            assume(truth[second] and system.sign(held[second]))
        try:
            held.append(getattr(system, operation)(held[first], held[second]))
        except Trap:
            assume(False)
        truth.append(exactly(operation, truth[first], truth[second]))
    for number, true in zip(held, truth, strict=True):
        bound = system.error(number)
        assert bound is not None
        value = system.exact(number, 0)
        assert value is not None
        assert abs(Fraction(value) - true) <= bound


@pytest.mark.parametrize("name", ROUNDING)
def test_unrounded_number_has_the_bound_zero(name: str) -> None:
    """3 * 5 - 15, 7/8 and the root of 9 are exact with three or more digits.  A third is not."""
    system = shadowed(name)
    three, five, fifteen, seven, eight, nine = (system.from_integer(n) for n in (3, 5, 15, 7, 8, 9))
    zero = system.subtract(system.multiply(three, five), fifteen)
    exact = [zero, system.divide(seven, eight), system.function("SQRT", nine)[0], system.integer_power(three, 2)[0]]
    if name != "ibm1962":  # its powers are rounded products
        assert [system.error(number) for number in exact] == [0, 0, 0, 0]
    third = system.divide(system.from_integer(1), three)
    bound = system.error(third)
    assert bound is not None
    assert 0 < bound < Fraction(1, 100)
    # The result is the same when it is computed again.
    assert system.error(system.subtract(third, third)) == 0


def test_bounds_follow_decimal_input_loops_and_infinities() -> None:
    for name, off in (("float64", True), ("mp:100", True), ("truncating", False)):
        system = shadowed(name)
        tenth = system.constant(".1")
        bound = system.error(tenth)
        assert bound is not None
        assert (bound > 0) is off
        value = system.exact(tenth, 0)
        assert value is not None
        assert bound == pytest.approx(2 * float(abs(Fraction(value) - Fraction(1, 10))))
    # X = X/2 + 1/3 a thousand times: each step halves the error.
    system = shadowed("float64")
    x, half, third = system.constant(".7"), system.constant(".5"), system.divide(*map(system.from_integer, (1, 3)))
    for _ in range(1000):
        x = system.add(system.subtract(x, system.multiply(x, half)), third)
    bound = system.error(x)
    assert bound is not None
    assert 0 < bound < Fraction(1, 10**15)
    system = shadowed("float64")
    with pytest.raises(Trap) as trap:
        system.divide(system.from_integer(1), system.from_integer(0))
    assert system.error(trap.value.value) is None


@pytest.mark.parametrize("name", ["float32", "float64", "truncating", "mp:60"])
@pytest.mark.parametrize("function", ["SIN", "COS", "ATAN", "EXP", "LOG", "SQRT"])
@pytest.mark.parametrize("third", [1, 2, 7, 100])
def test_functions_of_thirds(name: str, function: str, third: int) -> None:
    system = shadowed(name)
    argument = system.divide(system.from_integer(third), system.from_integer(3))
    found, _ = system.function(function, argument)
    with mpmath.workprec(400):
        true: Any = getattr(mpmath, function.lower())(mpmath.mpf(third) / 3)
        over, under = mpmath.libmp.to_rational(true._mpf_)
    bound, value = system.error(found), system.exact(found, 0)
    assert bound is not None
    assert value is not None
    assert 0 < abs(Fraction(value) - Fraction(int(over), int(under))) <= bound

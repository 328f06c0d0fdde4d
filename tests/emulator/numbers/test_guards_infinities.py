"""Infinities in binary numbers: an operation with an infinite operand does not overflow.

IEEE 754-2008, 6.1: operations on infinite operands are exact and signal nothing, except the invalid ones (7.2), which
give NaN.  Only finite operands overflow (7.4), which is reported with the machine's code.
"""

from collections.abc import Callable
from math import inf, isnan, nan

import pytest

from emulator.numbers import Trap, numbers
from emulator.numbers.base import Numbers
from tests.support.systems import BINARY

OPERATIONS: dict[str, Callable[[Numbers, float, float], float]] = {
    "+": lambda system, x, y: system.add(x, y),
    "-": lambda system, x, y: system.subtract(x, y),
    "-r": lambda system, x, y: system.subtract_reversed(x, y),
    "*": lambda system, x, y: system.multiply(x, y),
    "/": lambda system, x, y: system.divide(x, y),
}


@pytest.mark.parametrize("name", BINARY)
@pytest.mark.parametrize(
    ("operation", "first", "second", "result"),
    [
        ("+", 1.0, inf, inf),
        ("+", 1.0, -inf, -inf),
        ("+", inf, 1.0, inf),
        ("+", inf, inf, inf),
        ("-", 1.0, inf, -inf),
        ("-", inf, 1.0, inf),
        ("-", -inf, inf, -inf),
        ("-r", 1.0, inf, inf),
        ("-r", inf, 1.0, -inf),
        ("*", 2.0, inf, inf),
        ("*", -2.0, inf, -inf),
        ("*", inf, -2.0, -inf),
        ("*", inf, inf, inf),
        ("/", inf, 2.0, inf),
        ("/", -inf, 2.0, -inf),
        ("/", 2.0, inf, 0.0),
    ],
)
def test_infinite_operand_does_not_overflow(name, operation, first, second, result) -> None:
    """A Trap would type the error code a second time for a single overflow."""
    assert OPERATIONS[operation](numbers(name), first, second) == result


@pytest.mark.parametrize("name", BINARY)
@pytest.mark.parametrize(
    ("operation", "first", "second"),
    [
        ("+", inf, -inf),
        ("-", inf, inf),
        ("*", 0.0, inf),
        ("*", inf, 0.0),
        ("/", inf, inf),
        *((operation, *pair) for operation in "+-*/" for pair in ((nan, 1.0), (1.0, nan), (nan, inf), (inf, nan))),
    ],
)
def test_invalid_operation_gives_nan_without_overflow(name: str, operation: str, first: float, second: float) -> None:
    assert isnan(OPERATIONS[operation](numbers(name), first, second))


@pytest.mark.parametrize(("name", "largest"), [("float64", 2.0**1023), ("float32", 2.0**127)])
@pytest.mark.parametrize(
    ("operation", "sign", "other"), [("+", 1, 1.0), ("-", 1, -1.0), ("*", 1, 2.0), ("*", -1, 2.0), ("/", 1, 0.5)]
)
def test_finite_operands_overflow(name: str, largest: float, operation: str, sign: int, other: float) -> None:
    """The largest power of two is doubled by each operation, with either sign."""
    second = other * largest if operation in "+-" else other
    with pytest.raises(Trap) as caught:
        OPERATIONS[operation](numbers(name), sign * largest, second)
    assert caught.value.value == sign * inf


def test_multiprecision_infinity_does_not_overflow() -> None:
    system = numbers("mp:40")
    with pytest.raises(Trap) as caught:
        system.divide(system.decimal(1, 0), system.decimal(0, 0))
    infinity, one = caught.value.value, system.decimal(1, 0)
    for result in (system.add(one, infinity), system.add(infinity, one), system.multiply(one, infinity)):
        assert result == infinity
    assert system.subtract(one, infinity) == system.negate(infinity)
    assert system.divide(one, infinity) == 0

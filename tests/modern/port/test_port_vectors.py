"""The numbers of the port (modern/port/decimal.py) checked against the published vectors."""

from collections.abc import Callable
from fractions import Fraction

import numpy as np
import pytest

from emulator.numbers.arithmetic import MINUS_ZERO, profile
from modern.port.decimal import Arithmetic1620, Number1620
from tests.support.published.lines import Vector, load

OPERATIONS: dict[str, Callable[..., Number1620]] = {
    "add": lambda a, b: a + b,
    "subtract": lambda a, b: a - b,
    "multiply": lambda a, b: a * b,
    "divide": lambda a, b: a / b,
    "negate": lambda a: -a,
}
SIGNS = {"negative": -1, "zero": 0, "positive": 1}


def number(text: str, arithmetic: Arithmetic1620) -> Number1620:
    mantissa, _, exponent = text.lstrip("-").partition("E")
    size = Fraction("0" + mantissa) * Fraction(10) ** int(exponent)
    return arithmetic.number(-size if text.startswith("-") else size, text.startswith("-"))


def text(number_1620: Number1620, vector: Vector) -> str:
    minus = number_1620.m < 0 or number_1620.e == MINUS_ZERO
    return f"{'-' if minus else ''}.{abs(number_1620.m):0{vector.digits}}E{max(number_1620.e, -99):+03}"


@pytest.mark.parametrize("operation", [*OPERATIONS, "squareroot"])
def test_operations_give_the_published_results(operation: str) -> None:
    for vector in load(operation):
        arithmetic = Arithmetic1620(profile(vector.profile))
        rule = OPERATIONS.get(operation, arithmetic.root)
        result = rule(*(number(operand, arithmetic) for operand in vector.operands))
        assert text(result, vector) == vector.result, vector


def test_signs_give_the_published_branches_of_an_if() -> None:
    for vector in load("if"):
        arithmetic = Arithmetic1620(profile(vector.profile))
        values = np.array([number(operand, arithmetic) for operand in vector.operands])
        assert arithmetic.sign(values)[0] == SIGNS[vector.result], vector

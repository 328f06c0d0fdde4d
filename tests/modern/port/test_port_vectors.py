"""The published vectors on the numbers that the port calculates with (modern/port/decimal.py)."""

from __future__ import annotations

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


def text(found: Number1620, vector: Vector) -> str:
    minus = found.m < 0 or found.e == MINUS_ZERO
    return f"{'-' if minus else ''}.{abs(found.m):0{vector.digits}}E{max(found.e, -99):+03}"


@pytest.mark.parametrize("operation", [*OPERATIONS, "squareroot"])
def test_the_ports_numbers_give_every_result(operation: str) -> None:
    for vector in load(operation):
        arithmetic = Arithmetic1620(profile(vector.profile))
        rule = OPERATIONS.get(operation, arithmetic.root)
        found = rule(*(number(operand, arithmetic) for operand in vector.operands))
        assert text(found, vector) == vector.result, vector


def test_the_ports_signs_are_those_of_an_if() -> None:
    for vector in load("if"):
        arithmetic = Arithmetic1620(profile(vector.profile))
        values = np.array([number(operand, arithmetic) for operand in vector.operands])
        assert arithmetic.sign(values)[0] == SIGNS[vector.result], vector

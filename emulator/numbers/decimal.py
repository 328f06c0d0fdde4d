"""The 1620's decimal arithmetic in the form that the interpreter needs, as a subclass of ``Numbers``.

A number is the pair (mantissa, exponent) that emulator/numbers/arithmetic.py defines.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

from emulator.numbers import accumulator, arithmetic, functions, work
from emulator.numbers.accumulator import State
from emulator.numbers.arithmetic import MINUS_ZERO, ZERO, Profile, Rules
from emulator.numbers.base import Numbers, Trap, cut_decimal
from emulator.numbers.fields import (
    FALLBACK,
    Field,
    Remark,
    parse_constant,
    read_as_1962,
    read_floating,
    write_as_1962,
    write_floating,
)

Pair = tuple[int, int]


def _operation(rule: Callable[[int, int, int, int, Rules], State]) -> Callable[..., Pair]:
    """Return a method that calls a function of ``accumulator.py``, and raises Trap if the event returned is not 0."""

    def method(self: DecimalNumbers, first: Pair, second: Pair) -> Pair:
        m, e, event = rule(first[0], first[1], second[0], second[1], self._drawn)
        if event:
            raise Trap(event, (m, e))
        return m, e

    return method


@dataclass(frozen=True)
class DecimalNumbers(Numbers):
    """The decimal arithmetic of one profile, which sets the digits and the rules of rounding."""

    profile: Profile

    @property
    def name(self) -> str:
        return self.profile.name

    @property
    def digits(self) -> float:
        return self.profile.digits

    @cached_property
    def _rules(self) -> Rules:
        return self.profile.rules

    @cached_property
    def _drawn(self) -> Rules:
        """The rules of the next operation, with its random number if rounding is random."""
        return self._rules

    def decimal(self, whole: int, power: int, minus: bool = False) -> Pair:
        if whole == 0:
            return 0, MINUS_ZERO if minus else ZERO
        return cut_decimal(whole, power, self._rules.digits)

    add = _operation(accumulator.add)
    subtract = _operation(accumulator.subtract)
    subtract_reversed = _operation(accumulator.subtract_reversed)
    multiply = _operation(accumulator.multiply)
    divide = _operation(accumulator.divide)

    def negate(self, value: Pair) -> Pair:
        return accumulator.negate(*value)

    def sign(self, value: Pair) -> int:
        return (value[0] > 0) - (value[0] < 0)

    def from_integer(self, value: int) -> Pair:
        return arithmetic.from_integer(value, self._rules)

    def to_integer(self, value: Pair) -> int:
        whole = arithmetic.to_integer(*value, self._rules)
        if whole == 0 and self.as_1962:
            # The library drops the sign only of a number below one.
            return arithmetic.signed_zero(value[0] < 0 < value[1])
        return whole

    def function(self, name: str, value: Pair) -> tuple[Pair, str]:
        return _unpacked(functions.function(name, *value, self._drawn))

    def power(self, base: Pair, exponent: Pair) -> tuple[Pair, str]:
        return _unpacked(functions.power(base, exponent, self._drawn))

    def integer_power(self, base: Pair, count: int) -> tuple[Pair, str]:
        return _unpacked(functions.integer_power(*base, count, self._drawn))

    def work(self, operation: str, first: Any, second: Any = 0) -> int:
        if operation == "integer_power":
            return functions.integer_power_steps(first[0], first[1], second, self._rules)
        if operation == "power":
            return work.decimal_power(second[1])
        return 0 if operation == "SQRT" else work.decimal_function(first[1])

    def exact(self, value: Pair, digits: int) -> Fraction | int:
        mantissa, power = value[0], value[1] - self._rules.digits
        if power >= 0:
            return mantissa * int(10**power)
        whole, rest = divmod(mantissa, 10**-power)
        return Fraction(mantissa, 10**-power) if rest else whole

    def cut(self, value: Pair, digits: int) -> Pair:
        return value if value[0] == 0 else cut_decimal(value[0], value[1] - self._rules.digits, digits)

    def traced(self, value: Pair) -> str:
        return write_floating(FALLBACK, *value, self._rules)[0].strip()

    @property
    def as_1962(self) -> bool:
        return bool(self._rules.as_1962)

    def read(self, field: Field, columns: str) -> tuple[Pair, Remark | None]:
        reader = read_as_1962 if self.as_1962 else read_floating
        field_read = reader(field, columns, self._rules)
        return (field_read.mantissa, field_read.exponent), field_read.remark

    def write(self, field: Field, value: Pair) -> tuple[str, bool]:
        writer = write_as_1962 if self.as_1962 else write_floating
        return writer(field, *value, self._rules)

    def constant(self, text: str) -> Pair:
        return parse_constant(text, self._rules)


def _unpacked(value: functions.Value) -> tuple[Pair, str]:
    return (value.mantissa, value.exponent), value.code

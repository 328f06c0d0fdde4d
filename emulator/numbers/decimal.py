"""The 1620's decimal numbers as a number system: a profile of emulator/numbers/arithmetic.py, operation by operation.

A number is the pair (mantissa, exponent) of that module.  What the engine does around the operations (zeros,
their signs, overflow) is here once more, in the form the hosted interpreter asks for; the tests hold the two
together, run by run.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from emulator.compiled import kernel as engine
from emulator.language.formats import Field
from emulator.numbers import arithmetic, functions
from emulator.numbers.arithmetic import MAX_EXPONENT, MIN_EXPONENT, MINUS_ZERO, ZERO, Profile, Rules, powers_of_ten
from emulator.numbers.base import Numbers, Trap, cut_decimal
from emulator.numbers.fields import read_floating, write_floating

Pair = tuple[int, int]


@dataclass(frozen=True)
class DecimalNumbers(Numbers):
    """The numbers of a profile."""

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
    def _powers(self) -> list[int]:
        return powers_of_ten(self.profile.rules)

    def decimal(self, whole: int, power: int, minus: bool = False) -> Pair:
        if whole == 0:
            return 0, MINUS_ZERO if minus else ZERO
        return cut_decimal(whole, power, self._rules[0])

    def add(self, first: Pair, second: Pair) -> Pair:
        if second[0] == 0:
            return self._plus_zero(first)
        if first[0] == 0:
            return second
        return self._sum(first, second)

    def subtract(self, first: Pair, second: Pair) -> Pair:
        if second[0] == 0:
            return self._plus_zero(first)
        opposite = -second[0], second[1]
        return opposite if first[0] == 0 else self._sum(first, opposite)

    def _plus_zero(self, value: Pair) -> Pair:
        return (0, ZERO) if value[0] == 0 and not self.profile.keeps_left_zero else value

    def _sum(self, first: Pair, second: Pair) -> Pair:
        mantissa, exponent = arithmetic.add(*first, *second, self._rules, self._powers)
        if exponent > MAX_EXPONENT:
            raise Trap(engine.SUM_OVER, self._largest(mantissa))
        if exponent < MIN_EXPONENT and mantissa:
            raise Trap(engine.SUM_UNDER, (0, ZERO))
        return mantissa, exponent

    def multiply(self, first: Pair, second: Pair) -> Pair:
        if first[0] == 0 or second[0] == 0:
            return 0, ZERO
        return self._in_range(
            *arithmetic.multiply(*first, *second, self._rules), engine.PRODUCT_OVER, engine.PRODUCT_UNDER
        )

    def divide(self, dividend: Pair, divisor: Pair) -> Pair:
        if divisor[0] == 0:
            raise Trap(engine.ZERO_DIVISOR, self._largest(1))
        if dividend[0] == 0:
            return 0, ZERO
        return self._in_range(
            *arithmetic.divide(*dividend, *divisor, self._rules), engine.QUOTIENT_OVER, engine.QUOTIENT_UNDER
        )

    def _in_range(self, mantissa: int, exponent: int, over: int, under: int) -> Pair:
        if exponent > MAX_EXPONENT:
            raise Trap(over, self._largest(mantissa))
        if exponent < MIN_EXPONENT:
            negative = self.profile.signed_underflow and mantissa < 0
            raise Trap(under, (0, MINUS_ZERO if negative else ZERO))
        return mantissa, exponent

    def _largest(self, sign: int) -> Pair:
        biggest = self._rules[1] - 1
        return (biggest if sign > 0 else -biggest), MAX_EXPONENT

    def negate(self, value: Pair) -> Pair:
        mantissa, exponent = value
        if mantissa == 0:
            return 0, MINUS_ZERO if exponent == ZERO else ZERO
        return -mantissa, exponent

    def sign(self, value: Pair) -> int:
        return (value[0] > 0) - (value[0] < 0)

    def from_integer(self, value: int) -> Pair:
        return arithmetic.from_integer(value, self._rules)

    def to_integer(self, value: Pair) -> int:
        return arithmetic.to_integer(*value, self._rules, self._powers)

    def function(self, name: str, value: Pair) -> tuple[Pair, str]:
        return _given(functions.function(name, *value, self._rules))

    def power(self, base: Pair, exponent: Pair) -> tuple[Pair, str]:
        return _given(functions.power(base, exponent, self._rules))

    def integer_power(self, base: Pair, count: int) -> tuple[Pair, str]:
        return _given(functions.integer_power(*base, count, self._rules))

    def exact(self, value: Pair, digits: int) -> Fraction | int:
        mantissa, power = value[0], value[1] - self._rules[0]
        if power >= 0:
            return mantissa * int(10**power)
        whole, rest = divmod(mantissa, 10**-power)
        return Fraction(mantissa, 10**-power) if rest else whole

    def cut(self, value: Pair, digits: int) -> Pair:
        return value if value[0] == 0 else cut_decimal(value[0], value[1] - self._rules[0], digits)

    def read(self, field: Field, columns: str) -> tuple[Pair, str]:
        found = read_floating(field, columns, self._rules)
        return (found.mantissa, found.exponent), found.warning

    def write(self, field: Field, value: Pair) -> tuple[str, bool]:
        return write_floating(field, *value, self._rules)


def _given(value: functions.Value) -> tuple[Pair, str]:
    return (value.mantissa, value.exponent), value.code

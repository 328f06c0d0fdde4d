"""Several stochastic runs in step: each number holds its values in all N runs, and all runs take the same branches.

The runs have different seeds and share cards and branches, as in CADNA.  By default an IF takes the branch for the sign
of the mean, or the branch for zero if the number is a computational zero (:mod:`emulator.numbers.significance`), as
CADNA's order relations do.  With ``majority`` it takes the branch for the sign that the value has in most runs.  A
conversion to an integer gives the integer that results in most runs.  A printed number is the mean, truncated to its
field.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from emulator.numbers.base import Number, Numbers, Trap, Undecided, cut_decimal, decimal_length, decimal_text
from emulator.numbers.fields import Field, Remark
from emulator.numbers.significance import Estimate, estimate
from emulator.numbers.work import COSTED

Values = tuple[Number, ...]
MAJORITY = "majority"


def _operation(name: str) -> Callable[..., Values]:
    def method(self: SampledNumbers, first: Values, second: Values) -> Values:
        return self._each(name, first, second)

    return method


@dataclass(frozen=True)
class SampledNumbers(Numbers):
    """An arithmetic whose numbers are tuples: the values in N random runs that take the same branches.

    ``choice`` is the rule for the branch of an IF: ``mean`` or ``majority``.  ``on_write`` is called with the columns
    and the values of each printed number.
    """

    name_: str
    members: Sequence[Numbers]
    choice: str = "mean"
    on_write: Callable[[str, Values], None] | None = None
    is_costly = True

    @property
    def name(self) -> str:
        return self.name_

    @property
    def digits(self) -> float:
        return self.members[0].digits

    def fresh(self) -> SampledNumbers:
        return replace(self, members=[member.fresh() for member in self.members])

    def estimate(self, value: Values) -> Estimate | None:
        """Estimate a number's significant digits from its values in the runs, or return None if one is not finite."""
        return estimate(self.values(value), self.digits)

    def values(self, value: Values) -> list[Fraction | int | None]:
        return [member.exact(v, 0) for member, v in zip(self.members, value, strict=True)]

    def _each(self, operation: str, *operands: Values) -> Values:
        """Apply an operation in every run.  Raise Trap if it ends in an error code in any run."""
        results, event = [], 0
        for member, values in zip(self.members, zip(*operands, strict=True), strict=True):
            try:
                results.append(getattr(member, operation)(*values))
            except Trap as trap:
                results.append(trap.value)
                event = event or trap.event
        if event:
            raise Trap(event, tuple(results))
        return tuple(results)

    def _coded(self, results: Sequence[tuple[Number, str]]) -> tuple[Values, str]:
        return tuple(value for value, _ in results), next((code for _, code in results if code), "")

    def decimal(self, whole: int, power: int, minus: bool = False) -> Values:
        return tuple(member.decimal(whole, power, minus) for member in self.members)

    def from_integer(self, value: int) -> Values:
        return tuple(member.from_integer(value) for member in self.members)

    def constant(self, text: str) -> Values:
        return tuple(member.constant(text) for member in self.members)

    def read(self, field: Field, columns: str) -> tuple[Values, Remark | None]:
        results = [member.read(field, columns) for member in self.members]
        return tuple(value for value, _ in results), results[0][1]

    add = _operation("add")
    subtract = _operation("subtract")
    subtract_reversed = _operation("subtract_reversed")
    multiply = _operation("multiply")
    divide = _operation("divide")

    def negate(self, value: Values) -> Values:
        return self._each("negate", value)

    def function(self, name: str, value: Values) -> tuple[Values, str]:
        return self._coded([member.function(name, v) for member, v in zip(self.members, value, strict=True)])

    def power(self, base: Values, exponent: Values) -> tuple[Values, str]:
        triples = zip(self.members, base, exponent, strict=True)
        return self._coded([member.power(b, e) for member, b, e in triples])

    def integer_power(self, base: Values, count: int) -> tuple[Values, str]:
        return self._coded([member.integer_power(b, count) for member, b in zip(self.members, base, strict=True)])

    def signs(self, value: Values) -> list[int]:
        """Return the sign of a number in each run."""
        return [member.sign(v) for member, v in zip(self.members, value, strict=True)]

    def sign(self, value: Values) -> int:
        signs = Counter(self.signs(value))
        (first, most), *others = signs.most_common(2)
        if len(set(value)) == 1 or (self.choice == MAJORITY and (not others or most > others[0][1])):
            return first
        estimated = self.estimate(value)
        if estimated is None:
            if not others:
                return first
            raise Undecided(f"{self.name} cannot determine a sign, because the number is not finite in some run")
        mean = estimated.mean
        return 0 if estimated.is_zero and self.choice != MAJORITY else (mean > 0) - (mean < 0)

    def to_integer(self, value: Values) -> int:
        integers: Counter[int] = Counter(self._each("to_integer", value))
        return integers.most_common(1)[0][0]

    def exact(self, value: Values, digits: int) -> Fraction | None:
        exacts = [v for v in self.values(value) if v is not None]
        return Fraction(sum(exacts), len(exacts)) if len(exacts) == len(value) else None

    def cut(self, value: Values, digits: int) -> tuple[int, int]:
        mean = self.exact(value, 0)
        if mean is None:
            raise Undecided("a number that is not finite in some run cannot be written on a card")
        if len(set(self.signs(value))) == 1 and not mean:
            return self.members[0].cut(value[0], digits)
        return _cut(mean, digits)

    def text(self, value: Values) -> str:
        """Return the mean with its significant digits, as ``1.234 (3.6 digits)``, or ``@.0`` if it has none."""
        estimated = self.estimate(value)
        if estimated is None:
            return "not finite in some run"
        if estimated.is_exact:
            return self.members[0].text(value[0])
        if estimated.is_zero:
            return "@.0"
        shown = max(1, round(estimated.parker))
        mantissa, exponent = _cut(abs(estimated.mean), shown + 1)
        sign, rounded = "-" if estimated.mean < 0 else "", decimal_text((mantissa + 5) // 10, exponent - shown)
        return f"{sign}{rounded} ({estimated.parker:.1f} digits)"

    def write(self, field: Field, value: Values) -> tuple[str, bool]:
        columns, overflowed = super().write(field, value)
        if self.on_write is not None:
            self.on_write(columns, value)
        return columns, overflowed

    def work(self, operation: str, first: Any, second: Any = 0) -> int:
        steps = len(self.members)
        member = self.members[0]
        if member.is_costly or operation in COSTED:
            a, b = (operand[0] if isinstance(operand, tuple) else operand for operand in (first, second))
            steps += steps * member.work(operation, a, b)
        return steps


def _cut(value: Fraction, digits: int) -> tuple[int, int]:
    """Truncate a fraction to the given number of digits.  Return mantissa and exponent."""
    if not value:
        return cut_decimal(0, 0, digits)
    power = digits + 1 - decimal_length(value.numerator) + decimal_length(value.denominator)
    size = abs(value) * Fraction(10) ** power
    whole = size.numerator // size.denominator
    return cut_decimal(whole if value > 0 else -whole, -power, digits)

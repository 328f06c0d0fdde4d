"""Numbers with a shadow: what each would be with more than twice the digits, on the same way through the program.

It tells how far rounding has taken a number x.  Beside x stands its shadow y, computed by the same operations from the
shadows of the operands in binary floating point of 2b + 64 bits, b being the bits of x.  With t for the number that
exact arithmetic would hold there,

    |x - t| <= |x - y| + |y - t|,

and where the shadow is at least twice as near to t as x is, |y - t| <= |x - y|, so that

    |x - t| <= 2 |x - y|.

This is the bound that :meth:`ShadowedNumbers.error` gives.  The condition holds unless a computation has lost more than
all b bits of x and 64 more besides, and nothing is assumed of how errors grow: what cancels in x cancels in y.  (Bounds
carried from operand to result, as in N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., 2002,
section 3.3, need no condition, but double with each step of a loop that forgets its errors.)

A number computed without rounding from numbers that were not rounded, beginning with cards and constants, has no shadow
and the bound 0.  FIX gives a whole number, compared as such.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

from emulator.numbers.base import Number, Numbers, Trap
from emulator.numbers.exact import ExactNumbers
from emulator.numbers.fields import Field, Remark
from emulator.numbers.multiprecision import MultiprecisionNumbers

_CARE = 64
"""Bits of a shadow beyond twice those of its number."""
_STEPS = 4
"""Steps of seeing whether an operation rounded."""
_LONGEST = 4_096
"""Bits up to which that is seen; a number of more is taken as rounded."""


@dataclass(frozen=True, slots=True)
class Held:
    """A number of the arithmetic and its shadow; None where nothing was rounded."""

    value: Number
    shadow: Any


@dataclass(frozen=True)
class ShadowedNumbers(Numbers):
    """The numbers of a system that rounds, each with its shadow; every result is that system's."""

    inner: Numbers

    @property
    def name(self) -> str:
        return self.inner.name

    @property
    def digits(self) -> float:
        return self.inner.digits

    @cached_property
    def _finer(self) -> MultiprecisionNumbers:
        return MultiprecisionNumbers(2 * math.ceil(self.inner.digits / math.log10(2)) + _CARE)

    @cached_property
    def _exactly(self) -> ExactNumbers:
        return ExactNumbers()

    def error(self, number: Held) -> Fraction | None:
        """How far a number is at most from the exact one; None where nothing is known, as of an infinity."""
        if number.shadow is None:
            return Fraction(0)
        x, y = self.inner.exact(number.value, 0), self._finer.exact(number.shadow, 0)
        return None if x is None or y is None else 2 * abs(Fraction(x) - y)

    # Numbers that come in.

    def decimal(self, whole: int, power: int, minus: bool = False) -> Held:
        return self._taken(self.inner.decimal(whole, power, minus), Fraction(whole) * Fraction(10) ** power)

    def from_integer(self, value: int) -> Held:
        return self._taken(self.inner.from_integer(value), Fraction(value))

    def read(self, field: Field, columns: str) -> tuple[Held, Remark | None]:
        found, remark = self.inner.read(field, columns)
        return self._taken(found, Fraction(self._exactly.read(field, columns)[0])), remark

    def constant(self, text: str) -> Held:
        return self._taken(self.inner.constant(text), Fraction(self._exactly.constant(text)))

    def _taken(self, value: Number, exact: Fraction) -> Held:
        return Held(value, None if self.inner.exact(value, 0) == exact else self._fine(exact))

    def _fine(self, value: Fraction) -> Any:
        return self._finer.nearest(value.numerator, value.denominator)

    def _shadow(self, number: Held) -> Any:
        if number.shadow is not None:
            return number.shadow
        exact = self._fraction(number.value)
        assert exact is not None, "what is not finite has a shadow"
        return self._fine(exact)

    # Operations.

    def add(self, first: Held, second: Held) -> Held:
        return self._done("add", first, second, lambda a, b: a + b)

    def subtract(self, first: Held, second: Held) -> Held:
        return self._done("subtract", first, second, lambda a, b: a - b)

    def subtract_reversed(self, first: Held, second: Held) -> Held:
        return self._done("subtract_reversed", first, second, lambda a, b: b - a)

    def multiply(self, first: Held, second: Held) -> Held:
        return self._done("multiply", first, second, lambda a, b: a * b)

    def divide(self, dividend: Held, divisor: Held) -> Held:
        return self._done("divide", dividend, divisor, lambda a, b: a / b if b else None)

    def _done(
        self, name: str, first: Held, second: Held, exactly: Callable[[Fraction, Fraction], Fraction | None]
    ) -> Held:
        """An operation of the inner system, and its shadow where it rounded or an operand was rounded."""
        trap = None
        try:
            value = getattr(self.inner, name)(first.value, second.value)
        except Trap as found:
            trap, value = found, found.value
        shadow = None
        if first.shadow is not None or second.shadow is not None or not self._held(value, first, second, exactly):
            shadow = _beside(getattr(self._finer, name), self._shadow(first), self._shadow(second))
        if trap is not None:
            raise Trap(trap.event, Held(value, shadow)) from None
        return Held(value, shadow)

    def _held(self, value: Number, first: Held, second: Held, exactly: Callable[..., Fraction | None]) -> bool:
        """Whether a result is the exact one of its operands, as far as it is looked for."""
        a, b, x = self._fraction(first.value), self._fraction(second.value), self._fraction(value)
        if a is None or b is None or x is None or max(map(_length, (a, b, x))) > _LONGEST:
            return False
        return exactly(a, b) == x

    def negate(self, value: Held) -> Held:
        return Held(self.inner.negate(value.value), None if value.shadow is None else self._finer.negate(value.shadow))

    def checked(self, value: Held) -> Held:
        return Held(self.inner.checked(value.value), value.shadow)

    def function(self, name: str, value: Held) -> tuple[Held, str]:
        found, code = self.inner.function(name, value.value)
        if value.shadow is None and name == "SQRT":
            a, x = self._fraction(value.value), self._fraction(found)
            if a is not None and x is not None and _length(x) < _LONGEST and x * x == abs(a):
                return Held(found, None), code
        return Held(found, self._finer.function(name, self._shadow(value))[0]), code

    def power(self, base: Held, exponent: Held) -> tuple[Held, str]:
        found, code = self.inner.power(base.value, exponent.value)
        return Held(found, self._finer.power(self._shadow(base), self._shadow(exponent))[0]), code

    def integer_power(self, base: Held, count: int) -> tuple[Held, str]:
        found, code = self.inner.integer_power(base.value, count)
        if base.shadow is None:
            a = self._fraction(base.value)
            small = a is not None and (a or count > 0) and _length(a) * abs(count) < _LONGEST
            if small and a is not None and a**count == self._fraction(found):
                return Held(found, None), code
        return Held(found, self._finer.integer_power(self._shadow(base), count)[0]), code

    # What only the number itself decides.

    def sign(self, value: Held) -> int:
        return self.inner.sign(value.value)

    def to_integer(self, value: Held) -> int:
        return self.inner.to_integer(value.value)

    def exact(self, value: Held, digits: int) -> Fraction | int | None:
        return self.inner.exact(value.value, digits)

    def _fraction(self, value: Number) -> Fraction | None:
        found = self.inner.exact(value, 0)
        return None if found is None else Fraction(found)

    def cut(self, value: Held, digits: int) -> tuple[int, int]:
        return self.inner.cut(value.value, digits)

    def text(self, value: Held) -> str:
        return self.inner.text(value.value)

    def traced(self, value: Held) -> str:
        return self.inner.traced(value.value)

    def write(self, field: Field, value: Held) -> tuple[str, bool]:
        return self.inner.write(field, value.value)

    @property
    def weighs(self) -> bool:
        return True

    def work(self, operation: str, first: Any, second: Any = 0) -> int:
        a, b = (one.value if isinstance(one, Held) else one for one in (first, second))
        alone = self.inner.work(operation, a, b) if self.inner.weighs or operation in _ASKED else 0
        if operation in ("sign", "to_integer", "card"):
            return alone
        x, y = (self._shadow(one) if isinstance(one, Held) else one for one in (first, second))
        return alone + self._finer.work(operation, x, y) + _STEPS

    @property
    def announces(self) -> bool:
        return self.inner.announces


_ASKED = ("SIN", "COS", "ATAN", "EXP", "LOG", "SQRT", "power", "integer_power")
"""What an arithmetic is asked the work of that does not weigh."""


def _length(value: Fraction) -> int:
    return max(value.numerator.bit_length(), value.denominator.bit_length())


def _beside(operation: Callable[[Any, Any], Any], first: Any, second: Any) -> Any:
    """A shadow's operation; out of its range it is what stands for the result."""
    try:
        return operation(first, second)
    except Trap as trap:
        return trap.value

"""Numbers with error bounds: next to each number the program keeps a more precise value, its shadow.

The shadow of a number x shows how far rounding has moved x.  It is the number y that the same operations compute from
the shadows of their operands.  They compute it in binary floating point of 2b + 64 bits, where b is the number of bits
of x.  Let t be the number that exact arithmetic would hold at the same place of the program.  Then

    |x - t| <= |x - y| + |y - t|.

If the shadow is at least twice as near to t as x is, then |y - t| <= |x - y|, and therefore

    |x - t| <= 2 |x - y|.

:meth:`ShadowedNumbers.error` returns this bound.  The condition on the shadow holds unless a computation has lost all b
bits of x and 64 bits more.  No assumption about the growth of errors is needed: a cancellation in x also occurs in y.
(Bounds that are carried from operand to result, as in N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2nd
ed., 2002, section 3.3, need no condition, but they double in each step of a loop even if its errors do not accumulate.)

A card or constant that is held exactly has no shadow, and neither has the exact result of an operation on numbers
without shadows.  The bound for the error of such a number is 0.  FIX gives an integer, which has no error bound.
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
from emulator.numbers.work import COSTED

# The number of bits that a shadow has in addition to twice the bits of its number.
_CARE = 64
# The steps of work that a test takes whether a result was rounded.
_STEPS = 4
# The length in bits up to which a result is tested for rounding.  A longer result counts as rounded.
_LONGEST = 4_096


@dataclass(frozen=True, slots=True)
class Shadowed:
    """A number with its shadow, a more precise value of it.  The shadow is None if no rounding led to the number."""

    value: Number
    shadow: Any


# An operation on fractions, which returns None if there is no result.
Exactly = Callable[[Fraction, Fraction], Fraction | None]


def _operation(name: str, exactly: Exactly) -> Callable[..., Shadowed]:
    """Return the method that applies an operation, and computes the shadow of its result if anything was rounded."""

    def method(self: ShadowedNumbers, first: Shadowed, second: Shadowed) -> Shadowed:
        trap = None
        try:
            value = getattr(self.inner, name)(first.value, second.value)
        except Trap as error:
            trap, value = error, error.value
        shadow = None
        if first.shadow is not None or second.shadow is not None or not self._is_exact(value, first, second, exactly):
            try:
                shadow = getattr(self._finer, name)(self._shadow(first), self._shadow(second))
            except Trap as error:
                shadow = error.value
        if trap is not None:
            raise Trap(trap.event, Shadowed(value, shadow)) from None
        return Shadowed(value, shadow)

    return method


@dataclass(frozen=True)
class ShadowedNumbers(Numbers):
    """An arithmetic whose numbers also have more precise values, shadows.  The numbers are those of ``inner``."""

    inner: Numbers
    is_costly = True

    @property
    def name(self) -> str:
        return self.inner.name

    @property
    def digits(self) -> float:
        return self.inner.digits

    def fresh(self) -> ShadowedNumbers:
        return ShadowedNumbers(self.inner.fresh())

    @cached_property
    def _finer(self) -> MultiprecisionNumbers:
        return MultiprecisionNumbers(2 * math.ceil(self.inner.digits / math.log10(2)) + _CARE)

    @cached_property
    def _exactly(self) -> ExactNumbers:
        return ExactNumbers()

    def error(self, number: Shadowed) -> Fraction | None:
        """Return a bound for the error of a number due to rounding, or None if it is unknown (as for infinities)."""
        if number.shadow is None:
            return Fraction(0)
        x, y = self.inner.exact(number.value, 0), self._finer.exact(number.shadow, 0)
        return None if x is None or y is None else 2 * abs(Fraction(x) - y)

    # Numbers from cards and constants.

    def decimal(self, whole: int, power: int, minus: bool = False) -> Shadowed:
        return self._taken(self.inner.decimal(whole, power, minus), Fraction(whole) * Fraction(10) ** power)

    def from_integer(self, value: int) -> Shadowed:
        return self._taken(self.inner.from_integer(value), Fraction(value))

    def read(self, field: Field, columns: str) -> tuple[Shadowed, Remark | None]:
        value, remark = self.inner.read(field, columns)
        return self._taken(value, Fraction(self._exactly.read(field, columns)[0])), remark

    def constant(self, text: str) -> Shadowed:
        return self._taken(self.inner.constant(text), Fraction(self._exactly.constant(text)))

    def _taken(self, value: Number, exact: Fraction) -> Shadowed:
        return Shadowed(value, None if self.inner.exact(value, 0) == exact else self._fine(exact))

    def _fine(self, value: Fraction) -> Any:
        return self._finer.nearest(value.numerator, value.denominator)

    def _shadow(self, number: Shadowed) -> Any:
        if number.shadow is not None:
            return number.shadow
        exact = self._fraction(number.value)
        assert exact is not None, "a number that is not finite has a shadow"
        return self._fine(exact)

    # Operations.

    add = _operation("add", lambda a, b: a + b)
    subtract = _operation("subtract", lambda a, b: a - b)
    subtract_reversed = _operation("subtract_reversed", lambda a, b: b - a)
    multiply = _operation("multiply", lambda a, b: a * b)
    divide = _operation("divide", lambda a, b: a / b if b else None)

    def _is_exact(self, value: Number, first: Shadowed, second: Shadowed, exactly: Exactly) -> bool:
        """Return True if ``value`` is the exact result.  For long numbers, which are not tested, return False."""
        a, b, x = self._fraction(first.value), self._fraction(second.value), self._fraction(value)
        if a is None or b is None or x is None or max(map(_length, (a, b, x))) > _LONGEST:
            return False
        return exactly(a, b) == x

    def negate(self, value: Shadowed) -> Shadowed:
        return Shadowed(
            self.inner.negate(value.value), None if value.shadow is None else self._finer.negate(value.shadow)
        )

    def checked(self, value: Shadowed) -> Shadowed:
        return Shadowed(self.inner.checked(value.value), value.shadow)

    def function(self, name: str, value: Shadowed) -> tuple[Shadowed, str]:
        result, code = self.inner.function(name, value.value)
        if value.shadow is None and name == "SQRT":
            a, x = self._fraction(value.value), self._fraction(result)
            if a is not None and x is not None and _length(x) < _LONGEST and x * x == abs(a):
                return Shadowed(result, None), code
        return Shadowed(result, self._finer.function(name, self._shadow(value))[0]), code

    def power(self, base: Shadowed, exponent: Shadowed) -> tuple[Shadowed, str]:
        result, code = self.inner.power(base.value, exponent.value)
        return Shadowed(result, self._finer.power(self._shadow(base), self._shadow(exponent))[0]), code

    def integer_power(self, base: Shadowed, count: int) -> tuple[Shadowed, str]:
        result, code = self.inner.integer_power(base.value, count)
        if base.shadow is None:
            a = self._fraction(base.value)
            small = a is not None and (a or count > 0) and _length(a) * abs(count) < _LONGEST
            if small and a is not None and a**count == self._fraction(result):
                return Shadowed(result, None), code
        return Shadowed(result, self._finer.integer_power(self._shadow(base), count)[0]), code

    # Decisions and output depend on the number alone, not on its shadow.

    def sign(self, value: Shadowed) -> int:
        return self.inner.sign(value.value)

    def to_integer(self, value: Shadowed) -> int:
        return self.inner.to_integer(value.value)

    def exact(self, value: Shadowed, digits: int) -> Fraction | int | None:
        return self.inner.exact(value.value, digits)

    def _fraction(self, value: Number) -> Fraction | None:
        exact = self.inner.exact(value, 0)
        return None if exact is None else Fraction(exact)

    def cut(self, value: Shadowed, digits: int) -> tuple[int, int]:
        return self.inner.cut(value.value, digits)

    def text(self, value: Shadowed) -> str:
        return self.inner.text(value.value)

    def traced(self, value: Shadowed) -> str:
        return self.inner.traced(value.value)

    def write(self, field: Field, value: Shadowed) -> tuple[str, bool]:
        return self.inner.write(field, value.value)

    def work(self, operation: str, first: Any, second: Any = 0) -> int:
        a, b = (operand.value if isinstance(operand, Shadowed) else operand for operand in (first, second))
        inner_steps = self.inner.work(operation, a, b) if self.inner.is_costly or operation in COSTED else 0
        if operation in ("sign", "to_integer", "card"):
            return inner_steps
        x, y = (self._shadow(operand) if isinstance(operand, Shadowed) else operand for operand in (first, second))
        return inner_steps + self._finer.work(operation, x, y) + _STEPS

    @property
    def as_1962(self) -> bool:
        return self.inner.as_1962


def _length(value: Fraction) -> int:
    return max(value.numerator.bit_length(), value.denominator.bit_length())

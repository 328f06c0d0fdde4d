"""Numbers of the emulator as Python objects, with which Butler's procedure can compute in numpy arrays.

These are the decimal numbers of the 1620 and the numbers that are rounded at random. ``a op b`` is the result that the
machine computes if its accumulator holds a. If the machine would also type an error code, this result is used all the
same, and no error is reported. The order of the operands matters in ``ibm1962``, in which zero plus zero keeps the sign
of the accumulator, the left operand.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from emulator.numbers import DecimalNumbers, Numbers, Trap
from emulator.numbers.arithmetic import MAX_EXPONENT, MIN_EXPONENT
from emulator.numbers.base import decimal_length
from emulator.numbers.sampled import SampledNumbers
from modern.geometry.numbers import Exact, exact_text
from modern.port.arithmetic import Arithmetic, RangeError, Vector

# The digits of an irrational number that are shown or compared exactly.
_DIGITS = 40


def _operator(operation: str) -> Callable[["HostedNumber", "HostedNumber"], "HostedNumber"]:
    def apply(self: "HostedNumber", operand: "HostedNumber") -> "HostedNumber":
        if not isinstance(operand, HostedNumber):
            return NotImplemented  # numpy then applies the operation to each element
        try:
            return HostedNumber(getattr(self.by, operation)(self.value, operand.value), self.by)
        except Trap as trap:
            return HostedNumber(trap.value, self.by)

    return apply


class HostedNumber:
    """A number of one of the emulator's number systems, with the system that computes with it."""

    __slots__ = ("by", "value")

    def __init__(self, value: Any, by: Numbers) -> None:
        self.value = value
        self.by = by

    __add__ = _operator("add")
    __sub__ = _operator("subtract")
    __mul__ = _operator("multiply")
    __truediv__ = _operator("divide")

    def __neg__(self) -> "HostedNumber":
        return HostedNumber(self.by.negate(self.value), self.by)

    def __abs__(self) -> "HostedNumber":
        return -self if self.by.sign(self.value) < 0 else self

    def __repr__(self) -> str:
        return f"HostedNumber({self.by.text(self.value)})"


def _read(system: Numbers, value: Exact, minus: bool) -> Any:
    if isinstance(system, SampledNumbers):
        return tuple(_read(member, value, minus) for member in system.members)
    if isinstance(system, DecimalNumbers):
        return _truncated(system, value) if value else system.decimal(0, 0, minus)
    from emulator.numbers.multiprecision import MultiprecisionNumbers  # not at the top, because it needs mpmath

    assert isinstance(system, MultiprecisionNumbers)
    return system.nearest(value.numerator, value.denominator)


def _truncated(system: DecimalNumbers, value: Exact) -> tuple[int, int]:
    digits, size = system.profile.digits, abs(Fraction(value))
    # The digit counts of numerator and denominator give an estimate: the exponent, or one more than the exponent.
    exponent = decimal_length(size.numerator) - decimal_length(size.denominator) + 1
    if size < Fraction(10) ** (exponent - 1):
        exponent -= 1
    if not MIN_EXPONENT <= exponent <= MAX_EXPONENT:
        raise RangeError("expected a number with an exponent from -99 to 99")
    mantissa = int(size * Fraction(10) ** (digits - exponent))
    return (-mantissa if value < 0 else mantissa), exponent


@dataclass(frozen=True)
class HostedArithmetic(Arithmetic):
    """A number system of the emulator for Butler's procedure. Its vectors hold :class:`HostedNumber`."""

    system: Numbers

    @property
    def name(self) -> str:
        return self.system.name

    def number(self, value: Exact, minus: bool = False) -> HostedNumber:
        """Convert a coordinate as the machine reads it from a card, without random rounding."""
        return HostedNumber(_read(self.system, value, minus), self.system)

    def quotient(self, value: HostedNumber, count: int) -> HostedNumber:
        return value / HostedNumber(self.system.from_integer(count), self.system)

    def sign(self, values: Vector) -> Vector:
        signs = (self.system.sign(value.value) for value in values.flat)
        return np.fromiter(signs, np.int8, values.size).reshape(values.shape)

    # The machine compares numbers by subtracting them and testing the difference, which may underflow to zero.

    def within(self, values: Vector, slack: Vector) -> NDArray[np.bool_]:
        return np.asarray(self.sign(slack - abs(values)) >= 0)

    def is_zero(self, value: HostedNumber) -> bool:
        return self.system.sign(value.value) == 0

    def last_largest(self, values: Vector) -> int:
        index, largest = 0, values[0]
        for i in range(1, len(values)):
            if self.system.sign((largest - values[i]).value) <= 0:
                index, largest = i, values[i]
        return index

    def descending(self, values: Vector) -> NDArray[np.intp]:
        remaining = list(range(len(values)))
        order = []
        while remaining:
            order.append(remaining.pop(self.last_largest(values[remaining])))
        return np.array(order, np.intp)

    def keys(self, coordinates: Vector) -> Iterable[object]:
        return zip(*([self.exact(value, 1) for value in row] for row in coordinates), strict=True)

    def root(self, value: HostedNumber) -> HostedNumber:
        return HostedNumber(self.system.function("SQRT", value.value)[0], self.system)

    def exact(self, value: HostedNumber, degree: int) -> Exact:
        exact = self.system.exact(value.value, _DIGITS)
        assert exact is not None, "an operation of the port never divides by zero"
        return exact

    def text(self, value: HostedNumber, degree: int) -> str:
        exact = self.exact(value, degree)
        return "-0" if not exact and self.system.text(value.value) == "-0" else exact_text(exact)

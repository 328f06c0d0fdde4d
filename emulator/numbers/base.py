"""What the object code asks of numbers: the operations of the accumulator, library functions, fields of cards.

A number is whatever its system says; nothing outside looks into it.  Rules that hold for every system are here:

- Input takes every digit of the columns or of the constant; output cuts the number's decimal digits to the
  field's, never rounds (C26-5619 p. 38-40).
- What the 1620's subroutines answer with an error code is answered with the same code (emulator.errors.explanations).
- What a system cannot say ends the run by :class:`Undecided`; it is never guessed.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from fractions import Fraction
from functools import lru_cache
from typing import Any

from emulator.numbers.arithmetic import MAX_EXPONENT, MIN_EXPONENT, MINUS_ZERO, ZERO, Rules, rules_of
from emulator.numbers.fields import FALLBACK, Field, Remark, read_floating, write_floating

Number = Any
"""A number of some system."""

SHOWN = 20
"""Digits of a number shown to a reader."""


class Trap(Exception):
    """An operation that has a result and an error event (emulator.compiled.kernel: SUM_OVER and so on); the run goes
    on."""

    def __init__(self, event: int, value: Number) -> None:
        super().__init__(event)
        self.event, self.value = event, value


class Undecided(Exception):
    """Something the arithmetic cannot say: a value it cannot hold, a sign it cannot tell.  ``str`` says what."""


@lru_cache(maxsize=128)
def cutting_rules(digits: int) -> Rules:
    """Rules of that many digits, for reading or writing columns without losing one."""
    return rules_of(digits)


class Numbers(ABC):
    """A number system; instances are plain data without state."""

    @property
    @abstractmethod
    def name(self) -> str:
        """The name it is asked for by."""

    @property
    @abstractmethod
    def digits(self) -> float:
        """How many decimal digits a number carries; infinite for exact numbers."""

    @abstractmethod
    def decimal(self, whole: int, power: int, minus: bool = False) -> Number:
        """The number ``whole * 10**power``; ``minus``: a zero that was written with a minus sign."""

    @abstractmethod
    def add(self, first: Number, second: Number) -> Number:
        """Raises Trap."""

    @abstractmethod
    def subtract(self, first: Number, second: Number) -> Number:
        """Raises Trap."""

    def subtract_reversed(self, first: Number, second: Number) -> Number:
        """``second - first`` as the machine did it, subtracting the other way and reversing the sign.  Raises Trap."""
        try:
            return self.negate(self.subtract(first, second))
        except Trap as trap:
            raise Trap(trap.event, self.negate(trap.value)) from None

    @abstractmethod
    def multiply(self, first: Number, second: Number) -> Number:
        """Raises Trap."""

    @abstractmethod
    def divide(self, dividend: Number, divisor: Number) -> Number:
        """Raises Trap, and Undecided where the system has no answer."""

    @abstractmethod
    def negate(self, value: Number) -> Number:
        """The number with its sign reversed, a zero's too where zeros have signs."""

    @abstractmethod
    def sign(self, value: Number) -> int:
        """-1, 0 or 1, as the three branches of an IF.  Raises Undecided."""

    def checked(self, value: Number) -> Number:
        """The number as it is stored in a field.  Raises Undecided for one too long to be held."""
        return value

    def from_integer(self, value: int) -> Number:
        """FLOAT: a fixed-point number as floating point."""
        return self.decimal(value, 0)

    @abstractmethod
    def to_integer(self, value: Number) -> int:
        """FIX: the four digits just left of the point, with the sign (C26-5619 p. 21).  Raises Undecided."""

    @abstractmethod
    def function(self, name: str, value: Number) -> tuple[Number, str]:
        """SIN, COS, ATAN, EXP, LOG or SQRT, and the error code, if any.  Raises Undecided."""

    @abstractmethod
    def power(self, base: Number, exponent: Number) -> tuple[Number, str]:
        """``A ** B``, |A| ** B and F6 for a negative base, and the error code, if any.  Raises Undecided."""

    @abstractmethod
    def integer_power(self, base: Number, count: int) -> tuple[Number, str]:
        """``A ** J``, and the error code, if any.  Raises Undecided."""

    @abstractmethod
    def exact(self, value: Number, digits: int) -> Fraction | int | None:
        """The value; of one that is irrational its first ``digits`` digits or more; None if it is not finite."""

    @abstractmethod
    def cut(self, value: Number, digits: int) -> tuple[int, int]:
        """The first ``digits`` decimal digits, as mantissa and exponent of emulator/numbers/arithmetic.py.

        Raises Undecided for what is not finite.
        """

    def text(self, value: Number) -> str:
        """The number for a reader, in decimal; dots after it where digits are left out."""
        exact = self.exact(value, SHOWN + 5)
        if exact is None:
            return str(value)
        mantissa, exponent = self.cut(value, SHOWN)
        if mantissa == 0:
            return "-0" if exponent == MINUS_ZERO else "0"
        left_out = Fraction(mantissa) * Fraction(10) ** (exponent - SHOWN) != exact
        return decimal_text(mantissa, exponent - SHOWN) + ("..." if left_out else "")

    def traced(self, value: Number) -> str:
        """The number as a trace shows it."""
        return self.text(value)

    @property
    def weighs(self) -> bool:
        """Whether an operation on FAC, a test or a card can take longer than with the decimal numbers."""
        return False

    def work(self, operation: str, first: Number, second: Number = 0) -> int:
        """Steps an operation takes beyond that of a plain one, estimated (:mod:`emulator.numbers.work`).

        ``operation`` is ``add``, ``subtract``, ``multiply``, ``divide``, ``sign``, ``to_integer``, ``card``, a library
        function's name, ``power`` or ``integer_power``; only for the last two and functions is it asked where the
        numbers do not weigh.
        """
        return 0

    @property
    def announces(self) -> bool:
        """Whether every error of the arithmetic types its code."""
        return False

    def read(self, field: Field, columns: str) -> tuple[Number, Remark | None]:
        """A number from the columns of a field, all of its digits, and a remark or none.  Raises FieldError."""
        digits = max(len(columns), 2)
        found = read_floating(field, columns, cutting_rules(digits))
        minus = found.exponent == MINUS_ZERO
        return self.decimal(found.mantissa, found.exponent - digits if found.mantissa else 0, minus), found.remark

    def constant(self, text: str) -> Number:
        """A floating constant of the source.  Raises FieldError when it is out of range."""
        return self.read(FALLBACK, text)[0]

    def write(self, field: Field, value: Number) -> tuple[str, bool]:
        """The columns of a number, cut to the field's digits, and whether it overflowed to E14.8.

        Raises Undecided for a number a card cannot hold, smaller than 1.E-100 or not smaller than 1.E+99.
        """
        digits = max(field.width, FALLBACK.width)
        mantissa, exponent = self.cut(value, digits)
        if mantissa and not MIN_EXPONENT <= exponent <= MAX_EXPONENT:
            raise Undecided(f"{self.text(value)} is out of a card's range, E-99 to E+99")
        return write_floating(field, mantissa, exponent, cutting_rules(digits))


def cut_decimal(whole: int, power: int, digits: int) -> tuple[int, int]:
    """``whole * 10**power`` cut to that many digits, as mantissa and exponent; a zero is (0, ZERO)."""
    if whole == 0:
        return 0, ZERO
    size = decimal_length(whole)
    shift = digits - size
    kept = abs(whole) * 10**shift if shift >= 0 else abs(whole) // 10**-shift
    return (kept if whole > 0 else -kept), size + power


def decimal_text(whole: int, power: int) -> str:
    """``whole * 10**power``, not zero: written out where that is short, else with an exponent."""
    sign, digits = ("-" if whole < 0 else ""), str(abs(whole)).rstrip("0")
    point = decimal_length(whole) + power
    if 0 < point <= SHOWN:
        body = digits.ljust(point, "0")
        return f"{sign}{body[:point]}" + (f".{body[point:]}" if body[point:] else "")
    if -4 < point <= 0:
        return f"{sign}0.{'0' * -point}{digits}"
    return f"{sign}{digits[0]}{f'.{digits[1:]}' if digits[1:] else ''}E{point - 1:+d}"


def decimal_length(whole: int) -> int:
    """How many decimal digits a whole number has; ``str`` refuses numbers of some thousands."""
    size = abs(whole)
    length = max(int(size.bit_length() * 0.30102999566398120) - 1, 1)
    while size >= 10**length:
        length += 1
    return length

"""The interface of an arithmetic (number system): operations of the accumulator, library functions, card fields.

Only the number system itself knows the representation of its numbers.  Three rules hold for every system:

- Input uses all digits of the columns or of the constant.  Output truncates a number to the decimal digits that its
  field holds and never rounds (C26-5619 p. 38-40).
- An error that the 1620's subroutines report with a code is reported with the same code (emulator.errors.explanations).
- A result that a system cannot represent or decide ends the run with :class:`Undecided`.  Such a result is never
  guessed.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from fractions import Fraction
from typing import Any

from emulator.numbers.arithmetic import MAX_EXPONENT, MIN_EXPONENT, MINUS_ZERO, ZERO, rules_of
from emulator.numbers.fields import FALLBACK, Field, Remark, read_floating, write_floating

# A number of some number system.
Number = Any

# The number of digits in the text of a number that is shown to a person.
SHOWN = 20


class Trap(Exception):
    """Raised for an operation for which the machine types an error code.

    ``event`` numbers the code as in emulator/numbers/accumulator.py.  The run continues with ``value``.
    """

    def __init__(self, event: int, value: Number) -> None:
        super().__init__(event)
        self.event, self.value = event, value


class Undecided(Exception):
    """Raised if an arithmetic cannot represent a value or determine a sign.  ``str`` of the exception explains why."""


class Numbers(ABC):
    """The base class of the arithmetics that can run object code.

    ``is_costly`` is True if operations can take much longer than those of the decimal arithmetics.
    """

    is_costly = False

    @property
    @abstractmethod
    def name(self) -> str:
        """The name by which a user selects this arithmetic."""

    @property
    @abstractmethod
    def digits(self) -> float:
        """The number of decimal digits that a number has in this arithmetic; infinite if it is exact."""

    def fresh(self) -> Numbers:
        """Return this arithmetic in its initial state, in which every run begins."""
        return self

    @abstractmethod
    def decimal(self, whole: int, power: int, minus: bool = False) -> Number:
        """Return the number ``whole * 10**power``. ``minus`` marks a zero that was written with a minus sign."""

    @abstractmethod
    def add(self, first: Number, second: Number) -> Number:
        """Return the sum ``first + second``, or raise Trap with an error code."""

    @abstractmethod
    def subtract(self, first: Number, second: Number) -> Number:
        """Return the difference ``first - second``, or raise Trap with an error code."""

    def subtract_reversed(self, first: Number, second: Number) -> Number:
        """Return ``second - first`` as the machine computed it, ``first - second`` with its sign reversed.

        Raise Trap with an error code.
        """
        try:
            return self.negate(self.subtract(first, second))
        except Trap as trap:
            raise Trap(trap.event, self.negate(trap.value)) from None

    @abstractmethod
    def multiply(self, first: Number, second: Number) -> Number:
        """Return the product ``first * second``, or raise Trap with an error code."""

    @abstractmethod
    def divide(self, dividend: Number, divisor: Number) -> Number:
        """Return the quotient.  Raise Trap with an error code, or Undecided if it cannot be represented."""

    @abstractmethod
    def negate(self, value: Number) -> Number:
        """Return the number with its sign reversed.  This includes zeros if the arithmetic has a minus zero."""

    @abstractmethod
    def sign(self, value: Number) -> int:
        """Return -1, 0 or 1, for the three branches of an IF.  Raise Undecided if the sign is unknown."""

    def checked(self, value: Number) -> Number:
        """Return a number in the form that is stored.  Raise Undecided if it is too long to be stored."""
        return value

    def from_integer(self, value: int) -> Number:
        """Convert an integer (fixed-point number) to floating point, as the library routine FLOAT does."""
        return self.decimal(value, 0)

    @abstractmethod
    def to_integer(self, value: Number) -> int:
        """Convert a number to an integer: its sign and the four digits left of the point.  May raise Undecided."""

    @abstractmethod
    def function(self, name: str, value: Number) -> tuple[Number, str]:
        """Return the library function ``name`` of a number, and an error code or "".  May raise Undecided."""

    @abstractmethod
    def power(self, base: Number, exponent: Number) -> tuple[Number, str]:
        """Return ``A ** B``, or ``|A| ** B`` for a negative A, and an error code or "".  May raise Undecided."""

    @abstractmethod
    def integer_power(self, base: Number, count: int) -> tuple[Number, str]:
        """Return ``A ** J`` for an integer J, and an error code or "".  May raise Undecided."""

    @abstractmethod
    def exact(self, value: Number, digits: int) -> Fraction | int | None:
        """Return the exact value of a number, or None if it is not finite.

        An irrational value is given to at least ``digits`` digits.
        """

    @abstractmethod
    def cut(self, value: Number, digits: int) -> tuple[int, int]:
        """Truncate a number to ``digits`` decimal digits.  Return a mantissa of ``digits`` digits and its exponent.

        Raise Undecided if the number is not finite.
        """

    def text(self, value: Number) -> str:
        """Return the number as decimal text for a person.  Dots follow the digits if the text omits further digits."""
        exact = self.exact(value, SHOWN + 5)
        if exact is None:
            return str(value)
        mantissa, exponent = self.cut(value, SHOWN)
        if mantissa == 0:
            return "-0" if exponent == MINUS_ZERO else "0"
        is_shortened = Fraction(mantissa) * Fraction(10) ** (exponent - SHOWN) != exact
        return decimal_text(mantissa, exponent - SHOWN) + ("..." if is_shortened else "")

    def traced(self, value: Number) -> str:
        """Return the number as text in the form that a trace shows."""
        return self.text(value)

    def work(self, operation: str, first: Number, second: Number = 0) -> int:
        """Estimate the additional steps that a slow operation takes (:mod:`emulator.numbers.work`).

        ``operation`` is ``add``, ``subtract``, ``multiply``, ``divide``, ``sign``, ``to_integer``, ``card``, the name
        of a library function, ``power`` or ``integer_power``.  In an arithmetic that is not costly, only library
        functions and powers have additional steps.
        """
        return 0

    @property
    def as_1962(self) -> bool:
        """True if input, output and error codes follow IBM's library of 1962."""
        return False

    def read(self, field: Field, columns: str) -> tuple[Number, Remark | None]:
        """Read a number from the columns of a card field, with all of its digits.

        Return the number, and a remark about its columns or None.  Raise FieldError if the columns hold no number.
        """
        digits = max(len(columns), 2)
        number = read_floating(field, columns, rules_of(digits))
        minus = number.exponent == MINUS_ZERO
        return self.decimal(number.mantissa, number.exponent - digits if number.mantissa else 0, minus), number.remark

    def constant(self, text: str) -> Number:
        """Return a floating-point constant of a program.  Raise FieldError if it is out of range."""
        return self.read(FALLBACK, text)[0]

    def write(self, field: Field, value: Number) -> tuple[str, bool]:
        """Return the columns of a number, truncated to the field, and True if it did not fit and was written as E14.8.

        Raise Undecided for a number that no card can hold: below 1.E-100, or 1.E+99 and above.
        """
        digits = max(field.width, FALLBACK.width)
        mantissa, exponent = self.cut(value, digits)
        if mantissa and not MIN_EXPONENT <= exponent <= MAX_EXPONENT:
            raise Undecided(f"{self.text(value)} is out of a card's range, E-99 to E+99")
        return write_floating(field, mantissa, exponent, rules_of(digits))


def cut_decimal(whole: int, power: int, digits: int) -> tuple[int, int]:
    """Truncate ``whole * 10**power`` to the given number of digits.

    Return the mantissa and the exponent.  The result for zero is (0, ZERO).
    """
    if whole == 0:
        return 0, ZERO
    size = decimal_length(whole)
    shift = digits - size
    mantissa = abs(whole) * 10**shift if shift >= 0 else abs(whole) // 10**-shift
    return (mantissa if whole > 0 else -mantissa), size + power


def binary_value(number: tuple[int, int, int, int]) -> Fraction | int:
    """Return the exact value of a finite mpmath number, given as its internal tuple."""
    sign, mantissa, exponent, _ = number
    whole = -int(mantissa) if sign else int(mantissa)
    return whole * 2**exponent if exponent >= 0 else Fraction(whole, 2**-exponent)


def decimal_text(whole: int, power: int) -> str:
    """Return ``whole * 10**power``, which must not be zero, as text.  Only long numbers have an exponent."""
    sign, digits = ("-" if whole < 0 else ""), str(abs(whole)).rstrip("0")
    point = decimal_length(whole) + power
    # Numbers with at most twenty digits before the point, or at most three zeros right after it, have no exponent.
    if 0 < point <= SHOWN:
        body = digits.ljust(point, "0")
        return f"{sign}{body[:point]}" + (f".{body[point:]}" if body[point:] else "")
    if -4 < point <= 0:
        return f"{sign}0.{'0' * -point}{digits}"
    return f"{sign}{digits[0]}{f'.{digits[1:]}' if digits[1:] else ''}E{point - 1:+d}"


def decimal_length(whole: int) -> int:
    """Return the number of decimal digits of an integer.  Unlike ``str`` it has no limit of some thousand digits."""
    size = abs(whole)
    # Estimate the length from the bits (log10(2) = 0.30103).  The estimate is never too large, so only increase it.
    length = max(int(size.bit_length() * 0.30102999566398120) - 1, 1)
    while size >= 10**length:
        length += 1
    return length

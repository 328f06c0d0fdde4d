"""The arithmetic of the 1620's FORTRAN according to its documents, in fractions: the source of the vectors.

Nothing of ``emulator`` is used, so that the vectors do not repeat its errors.  Sources: C26-5619 (the manual, by page),
IBM's subroutine set of 1962 and FORTRAN II-D as executed (``tests/data/compiler_runs``), and the questions that
``fortran_src/OPEN-QUESTIONS.md`` settles or chooses (OQ and number).  A case that none of these decides is Undecided.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from math import isqrt

LOWEST, HIGHEST = -99, 99
"""The bounds of the exponent of .dddddddd (p. 13)."""


@cache
def ten(power: int) -> Fraction:
    return Fraction(10) ** power


class Undecided(Exception):
    """A case whose result no document states."""


@dataclass(frozen=True)
class Number:
    """A number as sign and magnitude.  A zero has a sign too (thesis p. 109)."""

    minus: bool
    size: Fraction

    @property
    def value(self) -> Fraction:
        return -self.size if self.minus else self.size

    def reversed(self) -> Number:
        """Return the number with its sign reversed, also a zero (subroutine at 02546, executed)."""
        return Number(not self.minus, self.size)


ZERO = Number(False, Fraction(0))


@dataclass(frozen=True)
class Outcome:
    """A number and its error code, which is empty if there is no error."""

    number: Number
    code: str = ""


@dataclass(frozen=True)
class Arithmetic:
    """A set of rules.

    ``guard``: the number of digits that the smaller operand of a sum keeps beyond the last place of the larger one, or
    None for all.  ``rounded``: the operations whose results are rounded half up in magnitude instead of truncated.
    """

    name: str
    digits: int
    guard: int | None = 0
    rounded: frozenset[str] = frozenset()
    of_1962: bool = False


@cache
def arithmetic(name: str) -> Arithmetic:
    """Return the rules of ``truncating``, ``ibm1962``, ``truncating:P``, ``guarded:P`` or ``rounding:P``."""
    if name == "ibm1962":
        # Products are rounded (code at 01482 and 01622).
        return Arithmetic(name, 8, rounded=frozenset({"product"}), of_1962=True)
    family, _, count = name.partition(":")
    digits = int(count or 8)
    if family == "rounding":
        return Arithmetic(name, digits, None, frozenset({"sum", "product", "quotient", "root", "power"}))
    return Arithmetic(name, digits, {"truncating": 0, "guarded": 1}[family])


def decade(size: Fraction) -> int:
    """Return the exponent e of a nonzero magnitude written as .ddd * 10**e with the first d not zero."""
    e = len(str(size.numerator)) - len(str(size.denominator))
    while ten(e) <= size:
        e += 1
    while size < ten(e - 1):
        e -= 1
    return e


def truncated(size: Fraction, unit: Fraction) -> Fraction:
    """Return the largest multiple of ``unit`` that is not above a magnitude."""
    return size // unit * unit


def shortened(size: Fraction, digits: int, half_up: bool) -> Fraction:
    """Return a nonzero magnitude with the given number of digits."""
    unit = ten(decade(size) - digits)
    return truncated(size + unit / 2, unit) if half_up else truncated(size, unit)


def delivered(value: Fraction, kind: str, codes: tuple[str, str], by: Arithmetic) -> Outcome:
    """Return a nonzero result with the profile's digits.  Out of range it becomes nines or zero, with a code."""
    minus = value < 0
    size = shortened(abs(value), by.digits, kind in by.rounded)
    over, under = codes
    if size >= ten(HIGHEST):
        return Outcome(Number(minus, largest(by)), over)
    if size < ten(LOWEST - 1):
        # II-D and the library of 1962 keep every sign (executed).
        return Outcome(Number(minus, Fraction(0)), under)
    return Outcome(Number(minus, size))


def largest(by: Arithmetic) -> Fraction:
    """.99999999E+99, of the profile's digits."""
    return (1 - ten(-by.digits)) * ten(HIGHEST)


def add(a: Number, b: Number, by: Arithmetic) -> Outcome:
    """Return A + B with A in the accumulator (FAD, executed).  Digits beyond the larger number's are lost first."""
    if not a.size and not b.size:
        return Outcome(a if by.of_1962 else ZERO)
    if not a.size or not b.size:
        return Outcome(a if a.size else b)
    total = a.value + b.value
    if by.guard is not None:
        unit = ten(max(decade(a.size), decade(b.size)) - by.digits - by.guard)
        parts = [truncated(n.size, unit) * (-1 if n.minus else 1) for n in (a, b)]
        total = parts[0] + parts[1]
    return delivered(total, "sum", ("E1", "E2"), by) if total else Outcome(ZERO)


def subtract(a: Number, b: Number, by: Arithmetic) -> Outcome:
    """Return A - B with A in the accumulator.  For two zeros the set of 1962 keeps A (executed)."""
    return add(a, b.reversed(), by)


def subtract_from(a: Number, b: Number, by: Arithmetic) -> Outcome:
    """Return B - A with A in the accumulator: A - B, with its sign reversed at the end (executed)."""
    difference = subtract(a, b, by)
    return Outcome(difference.number.reversed(), difference.code)


def multiply(a: Number, b: Number, by: Arithmetic) -> Outcome:
    """Return A * B.  A product with a zero is a plus zero (executed)."""
    value = a.value * b.value
    return delivered(value, "product", ("E3", "E4"), by) if value else Outcome(ZERO)


def divide(a: Number, b: Number, by: Arithmetic) -> Outcome:
    """Return A / B.  A zero divisor gives nines, in II-D with A's sign, in the set of 1962 positive (executed)."""
    if not b.size:
        if not a.size and a.minus and not by.of_1962:
            raise Undecided("minus zero divided by zero")
        return Outcome(Number(a.minus and not by.of_1962, largest(by)), "E7")
    if not a.size:
        return Outcome(ZERO)
    value = a.value / b.value
    if by.of_1962 and decade(a.size) == LOWEST and decade(abs(value)) < LOWEST + 1 - decade(b.size):
        # The library subtracts one from the exponent -99 of the dividend and gets +99 (executed).
        value *= ten(199)
    return delivered(value, "quotient", ("E5", "E6"), by)


def power(a: Number, count: int, by: Arithmetic) -> Outcome:
    """Return A ** J (OQ 8): the exact power shortened once, or a chain of products as in the library of 1962."""
    if not count:
        return Outcome(Number(False, Fraction(1)))
    if not a.size:
        if a.minus and count % 2:
            raise Undecided("an odd power of minus zero")
        return Outcome(ZERO) if count > 0 else Outcome(Number(False, largest(by)), "E7")
    if not by.of_1962:
        # Far out of range a power of ten replaces the exact one, which has a million digits.
        places = abs(count) * (decade(a.size) if a.size < 1 else decade(a.size) - 1)
        if abs(places) > 300:
            far = ten(300 if (places > 0) == (count > 0) else -300)
            return delivered(-far if a.minus and count % 2 else far, "power", ("E3", "E4"), by)
        return delivered(a.value**count, "power", ("E3", "E4"), by)
    # The library multiplies 1 by A, or by 1 / A if J is negative, and stops at the first error (executed).
    one = Number(False, Fraction(1))
    product = base = divide(one, a, by) if count < 0 else Outcome(a)
    for _ in range(abs(count) - 1):
        if product.code:
            break
        product = multiply(product.number, base.number, by)
    return product


def square_root(a: Number, by: Arithmetic) -> Outcome:
    """Return the root of the magnitude, truncated (II-D, executed) or rounded in ``rounding:P`` (OQ 9)."""
    if not a.size:
        if a.minus:
            raise Undecided("the root of minus zero")
        return Outcome(ZERO)
    unit = ten(-(-decade(a.size) // 2) - by.digits)
    squared = a.size / unit**2
    count = isqrt(squared.numerator // squared.denominator)
    if "root" in by.rounded and squared >= (count + Fraction(1, 2)) ** 2:
        count += 1
    return Outcome(Number(False, count * unit))


def from_fixed(whole: int, by: Arithmetic) -> Number:
    """Convert a fixed-point number to floating point, truncated if the profile has fewer than four digits."""
    return Number(whole < 0, shortened(Fraction(abs(whole)), by.digits, False)) if whole else ZERO


def to_fixed(a: Number, by: Arithmetic) -> int:
    """Return the four digits just left of the point, with the sign, and no minus zero (p. 21, OQ 10).

    The library of 1962 has the last four digits of a mantissa whose digits are all before the point (executed).
    """
    size = a.size
    if by.of_1962 and size and decade(size) > by.digits:
        size /= ten(decade(size) - by.digits)
    size = size.numerator // size.denominator % 10_000
    return -size if a.minus else size


def branch(sign: int | Fraction) -> str:
    """Return the branch that an IF takes."""
    return "negative" if sign < 0 else "positive" if sign else "zero"


def four_digits(value: int) -> int:
    """Return a fixed-point result: its last four digits with the sign (p. 14, code at 02644)."""
    return abs(value) % 10_000 * (-1 if value < 0 else 1)


def fixed_quotient(i: int, j: int) -> tuple[int, str]:
    """Return I / J truncated to an integer (p. 21), or 9999 for a zero divisor (code at 02992; II-D for -5/0)."""
    if not j:
        return 9999, "E8"
    return abs(i) // abs(j) * (-1 if (i < 0) != (j < 0) else 1), ""


def text(number: Number, digits: int) -> str:
    """Return a number as text with all digits, as ``-.12345678E+03``.  Zero is ``.00000000E-99``."""
    e = decade(number.size) if number.size else LOWEST
    whole = number.size / ten(e - digits)
    assert whole.denominator == 1, "more digits than the profile has"
    return f"{'-' if number.minus else ''}.{whole.numerator:0{digits}}E{e:+03}"


def parsed(text: str) -> Number:
    """Return the number that :func:`text` wrote."""
    mantissa, _, e = text.lstrip("-").partition("E")
    return Number(text.startswith("-"), Fraction("0" + mantissa) * ten(int(e)))

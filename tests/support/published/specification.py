"""The arithmetic of the 1620's FORTRAN as its documents state it, in fractions: what the vectors are made from.

Nothing of ``emulator`` is used, so that the vectors do not repeat its faults.  Sources: C26-5619 (the manual, by page),
IBM's subroutine set of 1962 and FORTRAN II-D as executed (``tests/data/compiler_runs``), and the questions that
``fortran_src/OPEN-QUESTIONS.md`` settles or chooses (OQ and number).  What none of these says is Undecided.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from math import isqrt

LOWEST, HIGHEST = -99, 99
"""Bounds of the exponent of .dddddddd (p. 13)."""


@cache
def ten(power: int) -> Fraction:
    return Fraction(10) ** power


class Undecided(Exception):
    """A case of which no document says what comes out."""


@dataclass(frozen=True)
class Number:
    """Sign and magnitude; a zero has a sign too (thesis p. 109)."""

    minus: bool
    size: Fraction

    @property
    def value(self) -> Fraction:
        return -self.size if self.minus else self.size

    def reversed(self) -> Number:
        """The sign turned, a zero's too (subroutine at 02546, executed)."""
        return Number(not self.minus, self.size)


ZERO = Number(False, Fraction(0))


@dataclass(frozen=True)
class Outcome:
    """A number and the error code that goes with it, empty where there is none."""

    number: Number
    code: str = ""


@dataclass(frozen=True)
class Arithmetic:
    """A set of rules.

    ``kept``: how many digits the smaller operand of a sum keeps beyond the last place of the larger one; None: all.
    ``rounded``: whose results are rounded half up in magnitude; the others are cut.
    """

    name: str
    digits: int
    kept: int | None = 0
    rounded: frozenset[str] = frozenset()
    of_1962: bool = False


@cache
def arithmetic(name: str) -> Arithmetic:
    """``truncating``, ``ibm1962``, or ``truncating:P``, ``guarded:P``, ``rounding:P``."""
    if name == "ibm1962":
        # Products are rounded (code at 01482 and 01622); roots go with them (OQ 9).
        return Arithmetic(name, 8, rounded=frozenset({"product", "root"}), of_1962=True)
    family, _, count = name.partition(":")
    digits = int(count or 8)
    if family == "rounding":
        return Arithmetic(name, digits, None, frozenset({"sum", "product", "quotient", "root", "power"}))
    return Arithmetic(name, digits, {"truncating": 0, "guarded": 1}[family])


def decade(size: Fraction) -> int:
    """The exponent e of a magnitude not zero written as .ddd * 10**e, the first d not zero."""
    e = len(str(size.numerator)) - len(str(size.denominator))
    while ten(e) <= size:
        e += 1
    while size < ten(e - 1):
        e -= 1
    return e


def cut(size: Fraction, unit: Fraction) -> Fraction:
    """The largest multiple of ``unit`` not above a magnitude."""
    return size // unit * unit


def shortened(size: Fraction, digits: int, half_up: bool) -> Fraction:
    """A magnitude not zero with that many digits."""
    unit = ten(decade(size) - digits)
    return cut(size + unit / 2, unit) if half_up else cut(size, unit)


def delivered(value: Fraction, kind: str, codes: tuple[str, str], by: Arithmetic) -> Outcome:
    """An operation's value, not zero, with the profile's digits; beyond the range nines or zero, and a code."""
    minus = value < 0
    size = shortened(abs(value), by.digits, kind in by.rounded)
    over, under = codes
    if size >= ten(HIGHEST):
        return Outcome(Number(minus, largest(by)), over)
    if size < ten(LOWEST - 1):
        # II-D keeps every sign; the set of 1962 has a plus zero after a sum (executed).
        return Outcome(Number(minus and not (by.of_1962 and kind == "sum"), Fraction(0)), under)
    return Outcome(Number(minus, size))


def largest(by: Arithmetic) -> Fraction:
    """.99999999E+99, of the profile's digits."""
    return (1 - ten(-by.digits)) * ten(HIGHEST)


def add(a: Number, b: Number, by: Arithmetic) -> Outcome:
    """A in the accumulator, B added (FAD, executed): digits beyond A's or B's last place drop off first."""
    if not a.size and not b.size:
        return Outcome(a if by.of_1962 else ZERO)
    if not a.size or not b.size:
        return Outcome(a if a.size else b)
    total = a.value + b.value
    if by.kept is not None:
        unit = ten(max(decade(a.size), decade(b.size)) - by.digits - by.kept)
        parts = [cut(n.size, unit) * (-1 if n.minus else 1) for n in (a, b)]
        total = parts[0] + parts[1]
    return delivered(total, "sum", ("E1", "E2"), by) if total else Outcome(ZERO)


def subtract(a: Number, b: Number, by: Arithmetic) -> Outcome:
    """A in the accumulator, B subtracted.  Of two zeros the set of 1962 keeps A's (executed)."""
    return add(a, b.reversed(), by)


def subtract_from(a: Number, b: Number, by: Arithmetic) -> Outcome:
    """A, computed and in the accumulator, is subtracted from B: A - B with the sign reversed at last (executed)."""
    found = subtract(a, b, by)
    return Outcome(found.number.reversed(), found.code)


def multiply(a: Number, b: Number, by: Arithmetic) -> Outcome:
    """A product with a zero is a plus zero (executed)."""
    value = a.value * b.value
    return delivered(value, "product", ("E3", "E4"), by) if value else Outcome(ZERO)


def divide(a: Number, b: Number, by: Arithmetic) -> Outcome:
    """Nines for a zero divisor: under II-D with A's sign, under the set of 1962 plus (executed)."""
    if not b.size:
        if not a.size and a.minus and not by.of_1962:
            raise Undecided("minus zero divided by zero")
        return Outcome(Number(a.minus and not by.of_1962, largest(by)), "E7")
    return delivered(a.value / b.value, "quotient", ("E5", "E6"), by) if a.size else Outcome(ZERO)


def power(a: Number, count: int, by: Arithmetic) -> Outcome:
    """A ** J (OQ 8): the exact power, once cut or rounded; under ``ibm1962`` multiplied out, each product rounded."""
    if not count:
        return Outcome(Number(False, Fraction(1)))
    if not a.size:
        if a.minus and count % 2:
            raise Undecided("an odd power of minus zero")
        return Outcome(ZERO) if count > 0 else Outcome(Number(False, largest(by)), "E7")
    if not by.of_1962:
        # Far out of range a power of ten with the sign stands for the exact one, which has a million digits.
        places = abs(count) * (decade(a.size) if a.size < 1 else decade(a.size) - 1)
        if abs(places) > 300:
            far = ten(300 if (places > 0) == (count > 0) else -300)
            return delivered(-far if a.minus and count % 2 else far, "power", ("E3", "E4"), by)
        return delivered(a.value**count, "power", ("E3", "E4"), by)
    found = Outcome(a)
    for _ in range(abs(count) - 1):
        found = multiply(found.number, a, by)
        if found.code:
            break
    if count > 0:
        # Once out of range it stays out, with the sign of the whole power.
        return Outcome(Number(a.minus and count % 2 == 1, found.number.size), found.code)
    if found.code:
        raise Undecided("1 divided by a power out of range")
    return delivered(1 / found.number.value, "quotient", ("E3", "E4"), by)


def square_root(a: Number, by: Arithmetic) -> Outcome:
    """The root of the magnitude, cut (II-D, executed) or rounded where products are (OQ 9)."""
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
    """A fixed-point number as floating point: exact, or its first digits where the profile has fewer than four."""
    return Number(whole < 0, shortened(Fraction(abs(whole)), by.digits, False)) if whole else ZERO


def to_fixed(a: Number) -> int:
    """The four digits just left of the point, with the sign; no minus zero (p. 21, OQ 10)."""
    size = a.size.numerator // a.size.denominator % 10_000
    return -size if a.minus else size


def branch(sign: int | Fraction) -> str:
    """Which way an IF goes."""
    return "negative" if sign < 0 else "positive" if sign else "zero"


def four_digits(value: int) -> int:
    """Fixed-point results: four digits and the sign (p. 14; code at 02644)."""
    return abs(value) % 10_000 * (-1 if value < 0 else 1)


def fixed_quotient(i: int, j: int) -> tuple[int, str]:
    """Cut to a whole number (p. 21); 9999 for a zero divisor (code at 02992; II-D of -5/0)."""
    if not j:
        return 9999, "E8"
    return abs(i) // abs(j) * (-1 if (i < 0) != (j < 0) else 1), ""


def text(number: Number, digits: int) -> str:
    """A number as the vectors have it: ``-.12345678E+03`` with all digits, zero ``.00000000E-99``."""
    e = decade(number.size) if number.size else LOWEST
    whole = number.size / ten(e - digits)
    assert whole.denominator == 1, "more digits than the profile has"
    return f"{'-' if number.minus else ''}.{whole.numerator:0{digits}}E{e:+03}"


def parsed(written: str) -> Number:
    """The number :func:`text` has written."""
    mantissa, _, e = written.lstrip("-").partition("E")
    return Number(written.startswith("-"), Fraction("0" + mantissa) * ten(int(e)))

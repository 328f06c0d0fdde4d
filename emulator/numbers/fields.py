"""Numbers to columns and back: the E, F and I fields of a FORMAT.

Output (C26-5619 p. 38-40): E cuts, never rounds; a field too small for its number falls back to E14.8; an I
field loses high-order digits.  Input (p. 14, 35-38): a punched point
overrides the FORMAT's; digits beyond the profile's are cut; a minus zero keeps its sign (thesis p. 109, the
last line of example 4).  Blanks: OPEN-QUESTIONS 6.  The work is done on character codes, in
emulator/numbers/columns.py; here are texts and words.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from emulator.numbers import columns
from emulator.numbers.arithmetic import UNDEFINED, Rules

FieldKind = Literal["E", "F", "I"]


@dataclass(frozen=True, slots=True)
class Field:
    """``Iw``, ``Fw.d`` or ``Ew.d``: one number."""

    kind: FieldKind
    width: int
    decimals: int = 0

    def __str__(self) -> str:
        return f"{self.kind}{self.width}" + ("" if self.kind == "I" else f".{self.decimals}")


FALLBACK = Field("E", columns.E_COLUMNS, columns.E_DECIMALS)

_REMARKS = {
    columns.BLANK_FIELD: "a blank field is read as zero",
    columns.BLANKS_INSIDE: "blanks inside a number",
    columns.BLANKS_AS_ZEROS: "blanks after or inside a number are read as zeros",
}


@dataclass(frozen=True, slots=True)
class Remark:
    """What a user should know of a number that was read; ``status`` is one of emulator/numbers/columns.py.

    Of a number with too many digits, ``digits`` and ``kept`` count them, or ``text`` is the whole number cut to four.
    """

    status: int
    digits: int = 0
    kept: int = 0
    text: str = ""

    @property
    def words(self) -> str:
        if self.status == columns.CUT:
            return f"{self.digits} digits; those beyond {self.kept} are cut"
        if self.status == columns.FOUR_KEPT:
            return f"{self.text} has more than four digits; the last four are kept"
        return _REMARKS[self.status]


class FieldError(ValueError):
    """A field that holds no number, or one out of range."""


@dataclass(frozen=True, slots=True)
class Read:
    """A number read: mantissa and exponent (a fixed-point value and 0), and what there is to remark."""

    mantissa: int
    exponent: int
    remark: Remark | None = None


def write_floating(field: Field, mantissa: int, exponent: int, rules: Rules) -> tuple[str, bool]:
    """The columns of a number in an E or F field, and whether it overflowed to E14.8.

    Raises FieldError for an undefined number.
    """
    if exponent == UNDEFINED:
        raise FieldError("an undefined number cannot be written")
    codes = bytearray(max(field.width, FALLBACK.width))
    end, overflowed = columns.write_floating(
        codes, 0, field.kind == "E", field.width, field.decimals, mantissa, exponent, rules
    )
    return codes[:end].decode("ascii"), bool(overflowed)


def write_fixed(field: Field, value: int) -> str:
    """The columns of a fixed-point number in an I field: right-justified, a minus sign before the first digit.

    High-order digits that do not fit are lost without notice (p. 38).  Only a negative number uses up a
    position for the sign: OPEN-QUESTIONS 7.
    """
    codes = bytearray(field.width)
    columns.write_fixed(codes, 0, field.width, value)
    return codes.decode("ascii")


def read_floating(field: Field, text: str, rules: Rules) -> Read:
    """A number from the columns of an E or F field.  Raises FieldError."""
    codes = bytearray(text.encode("ascii", "replace"))
    mantissa, exponent, status = columns.read_floating(codes, len(codes), field.decimals, rules)
    if status == columns.NO_NUMBER:
        raise FieldError(f"{text.strip()!r} is not a number")
    if status == columns.OUT_OF_RANGE:
        raise FieldError(f"{text.strip()[:40]!r} is out of range: the exponent is -99 to 99")
    if status >= columns.CUT:
        return Read(mantissa, exponent, Remark(columns.CUT, status - columns.CUT, rules.digits))
    return Read(mantissa, exponent, _remark(status))


def read_fixed(text: str) -> Read:
    """A fixed-point number from the columns of an I field.  Raises FieldError."""
    codes = bytearray(text.encode("ascii", "replace"))
    value, status = columns.read_fixed(codes, len(codes))
    if status == columns.NO_NUMBER:
        raise FieldError(f"{text.strip()!r} is not a whole number")
    if status == columns.FOUR_KEPT:
        return Read(value, 0, Remark(status, text=codes.decode("ascii").rstrip(" ")))
    return Read(value, 0, _remark(status))


def _remark(status: int) -> Remark | None:
    return None if status == columns.FINE else Remark(status)


def parse_constant(text: str, rules: Rules) -> tuple[int, int]:
    """A floating constant of the source, e.g. ``-1.E-3``.  Raises FieldError when it is out of range."""
    number = read_floating(FALLBACK, text, rules)
    return number.mantissa, number.exponent

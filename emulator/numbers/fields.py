"""Numbers to columns and back: the E, F and I fields of a FORMAT.

Output (C26-5619 p. 38-40): E cuts, never rounds; a field too small for its number falls back to E14.8; an I
field loses high-order digits.  Input (p. 14, 35-38): a punched point
overrides the FORMAT's; digits beyond the profile's are cut; a minus zero keeps its sign (thesis p. 109, the
last line of example 4).  Blanks: OPEN-QUESTIONS 6.  The work is done on character codes, in
emulator/numbers/columns.py; here are texts and words.
"""

from __future__ import annotations

from dataclasses import dataclass

from emulator.language.formats import Field
from emulator.numbers import columns as conversion
from emulator.numbers.arithmetic import UNDEFINED, Rules

FALLBACK = Field("E", conversion.E_COLUMNS, conversion.E_DECIMALS)

_WARNINGS = {
    conversion.FINE: "",
    conversion.BLANK_FIELD: "a blank field is read as zero",
    conversion.BLANKS_INSIDE: "blanks inside a number",
    conversion.BLANKS_AS_ZEROS: "blanks behind or inside a number are read as zeros",
}


class FieldError(ValueError):
    """A field that is no number, or a number out of range."""


@dataclass(frozen=True, slots=True)
class Read:
    """A number read: mantissa and exponent (a fixed-point value and 0), and what there is to warn about."""

    mantissa: int
    exponent: int
    warning: str = ""


def write_floating(field: Field, mantissa: int, exponent: int, rules: Rules) -> tuple[str, bool]:
    """The columns of a number in an E or F field, and whether it overflowed to E14.8.

    Raises FieldError for an undefined number.
    """
    if exponent == UNDEFINED:
        raise FieldError("an undefined number cannot be written")
    columns = bytearray(max(field.width, FALLBACK.width))
    end, overflowed = conversion.write_floating(
        columns, 0, field.kind == "E", field.width, field.decimals, mantissa, exponent, rules
    )
    return columns[:end].decode("ascii"), bool(overflowed)


def write_fixed(field: Field, value: int) -> str:
    """The columns of a fixed-point number in an I field: right-justified, a minus sign before the first digit.

    High-order digits that do not fit are lost without notice (p. 38).  Only a negative number uses up a
    position for the sign: OPEN-QUESTIONS 7.
    """
    columns = bytearray(field.width)
    conversion.write_fixed(columns, 0, field.width, value)
    return columns.decode("ascii")


def read_floating(field: Field, columns: str, rules: Rules) -> Read:
    """A number from the columns of an E or F field.  Raises FieldError."""
    codes = bytearray(columns.encode("ascii", "replace"))
    mantissa, exponent, status = conversion.read_floating(codes, len(codes), field.decimals, rules)
    if status == conversion.NO_NUMBER:
        raise FieldError(f"{columns.strip()!r} is no number")
    if status == conversion.OUT_OF_RANGE:
        raise FieldError(f"{columns.strip()[:40]!r} is out of range: the exponent is -99 to 99")
    if status >= conversion.CUT:
        return Read(mantissa, exponent, f"{status - conversion.CUT} digits; those beyond {rules[0]} are cut")
    return Read(mantissa, exponent, _WARNINGS[status])


def read_fixed(columns: str) -> Read:
    """A fixed-point number from the columns of an I field.  Raises FieldError."""
    codes = bytearray(columns.encode("ascii", "replace"))
    value, status = conversion.read_fixed(codes, len(codes))
    if status == conversion.NO_NUMBER:
        raise FieldError(f"{columns.strip()!r} is no whole number")
    if status == conversion.FOUR_KEPT:
        text = codes.decode("ascii").rstrip(" ")
        return Read(value, 0, f"{text} has more than four digits; the last four are kept")
    return Read(value, 0, _WARNINGS[status])


def parse_constant(text: str, rules: Rules) -> tuple[int, int]:
    """A floating constant of the source, e.g. ``-1.E-3``.  Raises FieldError when it is out of range."""
    number = read_floating(FALLBACK, text, rules)
    return number.mantissa, number.exponent

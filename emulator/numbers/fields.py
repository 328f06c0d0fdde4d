"""The E, F and I fields of a FORMAT: conversion between numbers and the text of card columns.

Output (C26-5619 p. 38-40): an E field truncates and never rounds, a number too large for its field is written as E14.8,
and an I field drops the high-order digits of a number too large for it.  Input (p. 14, 35-38): a punched point
overrides that of the FORMAT, digits beyond those of the profile are truncated, and a minus zero keeps its sign (thesis
p. 109, last line of example 4).  OPEN-QUESTIONS 6 treats blanks in a number.  emulator/numbers/columns.py does the
conversion on character codes; this module adds strings and messages.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from emulator.errors import quoted
from emulator.numbers import columns, columns1962
from emulator.numbers.arithmetic import (
    FIXED_MINUS_ZERO,
    MAX_EXPONENT,
    MIN_EXPONENT,
    UNDEFINED,
    ZERO,
    Rules,
    is_negative,
    rules_of,
)

FieldKind = Literal["E", "F", "I"]


@dataclass(frozen=True, slots=True)
class Field:
    """A field of w columns for one number: ``Iw`` (integer), ``Fw.d`` (decimal) or ``Ew.d`` (with exponent)."""

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
    """A warning about a number that was read.  ``status`` is defined in emulator/numbers/columns.py.

    For a floating-point number with too many digits, ``digits`` counts its digits and ``digits_kept`` those kept.
    For an integer with too many digits, ``text`` is the integer as punched.
    """

    status: int
    digits: int = 0
    digits_kept: int = 0
    text: str = ""

    @property
    def message(self) -> str:
        if self.status == columns.CUT:
            return f"{self.digits} digits; those after the first {self.digits_kept} are dropped"
        if self.status == columns.FOUR_KEPT:
            return f"{self.text} has more than four digits; the last four are kept"
        return _REMARKS[self.status]


class FieldError(ValueError):
    """Raised if the columns of a field hold no valid number, or a number out of range."""


@dataclass(frozen=True, slots=True)
class FieldNumber:
    """A number that was read from a field, and a remark or None.  An integer is a mantissa with the exponent 0."""

    mantissa: int
    exponent: int
    remark: Remark | None = None


def write_floating(field: Field, mantissa: int, exponent: int, rules: Rules) -> tuple[str, bool]:
    """Return the columns of a number in an E or F field, and True if it was written as E14.8 instead.

    Raise FieldError for an undefined number.
    """
    if exponent == UNDEFINED:
        raise FieldError("an undefined number cannot be written")
    codes = bytearray(max(field.width, FALLBACK.width))
    end, overflowed = columns.write_floating(
        codes, 0, field.kind == "E", field.width, field.decimals, mantissa, exponent, rules
    )
    return codes[:end].decode("ascii"), bool(overflowed)


def write_fixed(field: Field, value: int) -> str:
    """Return the columns of a number in an I field, right-justified with a minus sign before its first digit.

    High-order digits that do not fit are lost without notice (p. 38).  Only a negative number needs a column for its
    sign (OPEN-QUESTIONS 7).
    """
    codes = bytearray(field.width)
    columns.write_fixed(codes, 0, field.width, value)
    return codes.decode("ascii")


def read_floating(field: Field, text: str, rules: Rules) -> FieldNumber:
    """Read a number from the columns of an E or F field.  Raise FieldError if it is invalid."""
    codes = bytearray(text.encode("ascii", "replace"))
    mantissa, exponent, status = columns.read_floating(codes, len(codes), field.decimals, rules)
    if status == columns.NO_NUMBER:
        raise FieldError(f"{quoted(text.strip())} is not a number")
    if status == columns.OUT_OF_RANGE:
        raise FieldError(f"{quoted(text.strip())} is out of range: the exponent must be -99 to 99")
    if status >= columns.CUT:
        return FieldNumber(mantissa, exponent, Remark(columns.CUT, status - columns.CUT, rules.digits))
    return FieldNumber(mantissa, exponent, _remark(status))


def read_fixed(text: str) -> FieldNumber:
    """Read a fixed-point number from the columns of an I field.  Raise FieldError if it is invalid."""
    codes = bytearray(text.encode("ascii", "replace"))
    value, status = columns.read_fixed(codes, len(codes))
    if status == columns.NO_NUMBER:
        raise FieldError(f"{quoted(text.strip())} is not an integer")
    if status == columns.FOUR_KEPT:
        return FieldNumber(value, 0, Remark(status, text=codes.decode("ascii").rstrip(" ")))
    return FieldNumber(value, 0, _remark(status))


def _remark(status: int) -> Remark | None:
    return None if status == columns.FINE else Remark(status)


def write_as_1962(field: Field, mantissa: int, exponent: int, rules: Rules) -> tuple[str, bool]:
    """Return the columns that IBM's library of 1962 writes, and True if the number did not fit and became E14.8."""
    codes = bytearray(field.width)
    end = columns1962.write_floating(
        codes, 0, field.kind == "E", field.width, field.decimals, mantissa, exponent, rules
    )
    if end < 0:
        return write_as_1962(FALLBACK, mantissa, exponent, rules)[0], True
    return codes.decode("ascii"), False


def exponent_as_1962(field: Field, mantissa: int, exponent: int) -> str:
    """Return the exponent that IBM's library of 1962 writes into an E field before it finds the field too narrow."""
    digits = 8 if field.width >= FALLBACK.width else field.width - 6
    shown = max((exponent if mantissa else ZERO) - digits + field.decimals, MIN_EXPONENT)
    return f"E{'-' if shown < 0 else '+'}{abs(shown):02}" if shown <= MAX_EXPONENT else ""


def write_fixed_as_1962(field: Field, value: int) -> str:
    """Return the columns that IBM's library of 1962 writes in an I field, which always has a column for the sign."""
    codes = bytearray(field.width)
    columns1962.write_fixed(codes, 0, field.width, abs(value), is_negative(value))
    return codes.decode("ascii")


def read_fixed_as_1962(text: str) -> FieldNumber:
    """Read an I field as IBM's library of 1962 does.  Raise FieldError if the library rejects it with ERROR F7."""
    return read_as_1962(Field("I", len(text)), text, rules_of(8))


def read_as_1962(field: Field, text: str, rules: Rules) -> FieldNumber:
    """Read an E, F or I field as IBM's library of 1962 does.  Raise FieldError if the library rejects it (ERROR F7)."""
    kind = "EFI".index(field.kind)
    codes = text.encode("ascii", "replace")
    mantissa, exponent, status = columns1962.read_number(bytearray(codes), len(codes), field.decimals, kind, rules)
    if status == columns1962.REJECTED:
        raise FieldError(f"{text.strip()!r} is not a number for the field {field}")
    if field.kind == "I" and exponent:
        return FieldNumber(FIXED_MINUS_ZERO, 0)
    return FieldNumber(mantissa, exponent)


def parse_constant(text: str, rules: Rules) -> tuple[int, int]:
    """Return mantissa and exponent of a constant such as ``-1.E-3``.  Raise FieldError if it is out of range."""
    number = read_floating(FALLBACK, text, rules)
    return number.mantissa, number.exponent

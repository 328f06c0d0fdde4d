"""Numbers to columns and back: the E, F and I fields of a FORMAT.

Output (C26-5619 p. 38-40): E cuts, never rounds; a field too small for its number falls back to E14.8; an I
field loses high-order digits.  Input (p. 14, 35-38): a punched point
overrides the FORMAT's; digits beyond the profile's are cut; a minus zero keeps its sign (thesis p. 109, the
last line of example 4).  Blanks: OPEN-QUESTIONS 6.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from emulator.arithmetic import MAX_EXPONENT, MIN_EXPONENT, MINUS_ZERO, UNDEFINED, ZERO, Rules, wrap_integer
from emulator.formats import Field

FALLBACK = Field("E", 14, 8)

_FLOATING = re.compile(r"([+-]?)(\d*)(?:(\.)(\d*))?(?:E([+-]?)(\d+)|([+-])(\d+))?")
_FIXED = re.compile(r"([+-]?)(\d+)")


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
    text = _e_form(field, mantissa, exponent, rules) if field.kind == "E" else _f_form(field, mantissa, exponent, rules)
    if text is None or len(text) > field.width:
        wide = _e_form(FALLBACK, mantissa, exponent, rules)
        assert wide is not None
        return wide.rjust(FALLBACK.width), True
    return text.rjust(field.width), False


def write_fixed(field: Field, value: int) -> str:
    """The columns of a fixed-point number in an I field: right-justified, a minus sign before the first digit.

    High-order digits that do not fit are lost without notice (p. 38).  Only a negative number uses up a
    position for the sign: OPEN-QUESTIONS 7.
    """
    room = field.width - (value < 0)
    digits = str(int(str(abs(value))[-room:])) if room else ""
    return (("-" if value < 0 else "") + digits).rjust(field.width)


def read_floating(field: Field, columns: str, rules: Rules) -> Read:
    """A number from the columns of an E or F field.  Raises FieldError."""
    text, warning = _dense(columns)
    if not text:
        return Read(0, ZERO, "a blank field is read as zero")
    match = _FLOATING.fullmatch(text)
    if not match or not (match[2] or match[4]):
        raise FieldError(f"{columns.strip()!r} is no number")
    sign, whole, point, fraction, esign1, edigits1, esign2, edigits2 = match.groups()
    digits = whole + (fraction or "")
    scale = len(fraction or "") if point else field.decimals
    power_digits = (edigits1 or edigits2 or "").lstrip("0") or "0"
    if len(power_digits) > 6:
        raise FieldError(f"{columns.strip()[:40]!r} is out of range: the exponent is -99 to 99")
    power = -int(power_digits) if "-" in (esign1, esign2) else int(power_digits)
    lead = digits.lstrip("0")
    if not lead:
        return Read(0, MINUS_ZERO if sign == "-" else ZERO, warning)
    exponent = len(lead) - scale + power
    kept = lead[: rules[0]]
    if lead[rules[0] :].strip("0"):
        warning = warning or f"{len(lead.rstrip('0'))} digits; those beyond {rules[0]} are cut"
    if not MIN_EXPONENT <= exponent <= MAX_EXPONENT:
        raise FieldError(f"{columns.strip()!r} is out of range: the exponent is -99 to 99")
    mantissa = int(kept.ljust(rules[0], "0"))
    return Read(-mantissa if sign == "-" else mantissa, exponent, warning)


def read_fixed(columns: str) -> Read:
    """A fixed-point number from the columns of an I field.  Raises FieldError."""
    text, warning = _dense(columns)
    if not text:
        return Read(0, 0, "a blank field is read as zero")
    match = _FIXED.fullmatch(text)
    if not match:
        raise FieldError(f"{columns.strip()!r} is no whole number")
    value = int(match[1] + match[2])
    if abs(value) > 9999:
        warning = f"{text} has more than four digits; the last four are kept"
    return Read(wrap_integer(value), 0, warning)


def parse_constant(text: str, rules: Rules) -> tuple[int, int]:
    """A floating constant of the source, e.g. ``-1.E-3``.  Raises FieldError when it is out of range."""
    number = read_floating(FALLBACK, text, rules)
    return number.mantissa, number.exponent


def _dense(columns: str) -> tuple[str, str]:
    """Drop leading blanks; blanks behind or among the digits count as zeros, behind an exponent as nothing."""
    text = columns.lstrip(" ")
    if " " not in text:
        return text, ""
    body = text.rstrip(" ")
    if "." in body or "E" in body:
        # Behind the point trailing zeros change nothing; behind an exponent they would multiply it by ten.
        filled = body.replace(" ", "0") if not re.search(r"[E.].* .*E|E.* ", body) else body.replace(" ", "")
        return filled, "" if body == filled else "blanks inside a number"
    return text.replace(" ", "0"), "blanks behind or inside a number are read as zeros"


def _e_form(field: Field, mantissa: int, exponent: int, rules: Rules) -> str | None:
    """Sign, digits, point, digits, E, sign, two digits; None where the field cannot hold it."""
    count = 8 if field.width >= 14 else field.width - 6
    if count < 1 or field.decimals > count:
        return None
    digits = _significant(mantissa, rules, count)
    left = count - field.decimals
    shown = max(ZERO, exponent) if mantissa == 0 else exponent - left
    if not MIN_EXPONENT <= shown <= MAX_EXPONENT:
        return None
    return f"{_minus(mantissa, exponent)}{digits[:left]}.{digits[left:]}E{'-' if shown < 0 else '+'}{abs(shown):02d}"


def _f_form(field: Field, mantissa: int, exponent: int, rules: Rules) -> str | None:
    if exponent > field.width:
        return None
    size, scale = abs(mantissa), exponent - rules[0] + field.decimals
    value = 0 if exponent + field.decimals <= 0 else size * 10**scale if scale >= 0 else size // 10**-scale
    digits = str(value).rjust(field.decimals + 1, "0")
    whole, fraction = digits[: len(digits) - field.decimals], digits[len(digits) - field.decimals :]
    return f"{_minus(mantissa, exponent)}{whole.lstrip('0')}.{fraction}"


def _significant(mantissa: int, rules: Rules, count: int) -> str:
    return str(abs(mantissa)).rjust(rules[0], "0")[:count].ljust(count, "0")


def _minus(mantissa: int, exponent: int) -> str:
    return "-" if mantissa < 0 or exponent == MINUS_ZERO else ""

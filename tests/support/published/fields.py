"""Numbers in the columns of a card as the documents state them: E, F and I fields, read and written, in fractions.

Sources and conventions are those of :mod:`tests.support.published.specification`.
"""

import re
from fractions import Fraction

from tests.support.published.specification import HIGHEST, LOWEST, Arithmetic, Number, Undecided, decade, shortened, ten

INVALID, RANGE, TOO_SMALL = "INVALID", "RANGE", "F8"
_FLOATING = re.compile(r"([+-]?)(\d*)(?:(\.)(\d*))?(?:E([+-]?\d+)|([+-]\d+))?")
_FIXED = re.compile(r"([+-]?)(\d+)")
_EXPONENT = re.compile(r"(?:E *[+-]?|(?<=[\d.])[+-])[\d ]*$")


def parts(field: str) -> tuple[str, int, int]:
    """Return letter, width and decimals of ``E14.8`` or ``I4``."""
    match = re.fullmatch(r"([EFI])(\d+)(?:\.(\d+))?", field)
    assert match, field
    return match[1], int(match[2]), int(match[3] or 0)


def read_floating(field: str, columns: str, by: Arithmetic) -> tuple[Number | None, str]:
    """Return the number in the columns of an E or F field, or the reason why they hold no number.

    A punched point overrides the field's decimals (p. 37).  An exponent may omit its E or its sign (p. 35, 38).  Digits
    beyond those of the arithmetic are dropped (p. 14, 37).  A minus zero keeps its sign (thesis p. 109).  Blanks: OQ 6.
    """
    decimals = parts(field)[2]
    squeezed = _without_blanks(columns)
    if not squeezed:
        return Number(False, Fraction(0)), ""
    match = _FLOATING.fullmatch(squeezed)
    if not match or not (match[2] or match[4]):
        return None, INVALID
    sign, before, point, after = match[1], match[2], match[3], match[4] or ""
    size = Fraction(int(before + after)) / ten(len(after) if point else decimals)
    if not size:
        return Number(sign == "-", Fraction(0)), ""
    # A field has at most 80 columns: a longer exponent than four digits is out of range whatever the digits are.
    power = int(match[5] or match[6] or 0)
    if abs(power) > 9999 or not LOWEST <= decade(size) + power <= HIGHEST:
        return None, RANGE
    return Number(sign == "-", shortened(size * ten(power), by.digits, False)), ""


def _without_blanks(columns: str) -> str:
    """Return the columns with their blanks resolved (OQ 6).  Raise Undecided if no source decides."""
    body = columns.lstrip(" ")
    end = _EXPONENT.search(body)
    if end:
        body = body[: end.start()] + end[0].replace(" ", "")
    elif "." in body:
        body = body.rstrip(" ")
    else:
        return body.replace(" ", "0")
    if " " in body:
        raise Undecided("blanks among digits with a point or an exponent")
    return body


def read_fixed(columns: str) -> tuple[int | None, str]:
    """Return the number in an I field.  Blanks after its first digit are zeros (OQ 6); four digits stay (p. 14)."""
    body = columns.lstrip(" ").replace(" ", "0")
    if not body:
        return 0, ""
    match = _FIXED.fullmatch(body)
    if not match:
        return None, INVALID
    size = int(match[2]) % 10_000
    return (-size if match[1] == "-" else size), ""


def write_floating(field: str, number: Number, by: Arithmetic) -> tuple[str, str]:
    """Return an E or F field, truncated, or E14.8 and the code F8 if the field is too small (p. 39-40)."""
    letter, width, decimals = parts(field)
    columns = (_written_e if letter == "E" else _written_f)(width, decimals, number)
    if columns is not None:
        return columns, ""
    columns = _written_e(14, 8, number)
    assert columns is not None
    return columns, TOO_SMALL


def _written_e(width: int, decimals: int, number: Number) -> str | None:
    """Return sign, digits (``decimals`` of them after the point), E, sign and two digits, or None if they do not fit.

    A field of fourteen or more columns has eight digits, a narrower one w - 6.  The exponent is adjusted to the
    position of the point (p. 39).
    """
    count = 8 if width >= 14 else width - 6
    if count < 1 or decimals > count:
        return None
    before = count - decimals
    e, digits = LOWEST, "0" * count
    if number.size:
        natural = decade(number.size)
        digits_written = shortened(number.size, count, False) / ten(natural - count)
        assert digits_written.denominator == 1
        digits, e = str(digits_written.numerator), natural - before
        if not LOWEST <= e <= HIGHEST:
            return None
        if before and not e:
            raise Undecided("the sign of an adjusted exponent of zero")
    body = f"{digits[:before]}.{digits[before:]}E{e:+03}"
    return ("-" + body if number.minus else body).rjust(width)


def _written_f(width: int, decimals: int, number: Number) -> str | None:
    """Return an F field without a zero before its point, with a column for the sign (p. 39, OQ 13), or None."""
    shown = number.size * ten(decimals) // 1
    if number.minus and not shown:
        raise Undecided("the sign of a negative number that an F field shows as zero")
    digits = str(shown).rjust(decimals, "0") if shown else "0" * decimals
    point = len(digits) - decimals
    body = f"{digits[:point]}.{digits[point:]}"
    if len(body) + 1 > width:
        return None
    return ("-" + body if number.minus else body).rjust(width)


def write_fixed(field: str, value: int) -> str:
    """Return an I field, right-justified.  High-order digits are lost (p. 38); only a minus needs a column (OQ 7)."""
    width = parts(field)[1]
    room = width - (value < 0)
    if not room:
        raise Undecided("a negative number in one column")
    size = abs(value) % 10**room
    if value < 0 and not size:
        raise Undecided("the sign of a negative number of which only zeros are shown")
    return f"{'-' if value < 0 else ''}{size}".rjust(width)

"""Numbers in the columns of a card as the documents state them: E, F and I fields, read and written, in fractions.

Sources and rules of the game as in :mod:`tests.support.published.specification`.
"""

from __future__ import annotations

import re
from fractions import Fraction

from tests.support.published.specification import HIGHEST, LOWEST, Arithmetic, Number, Undecided, decade, shortened, ten

INVALID, RANGE, TOO_SMALL = "INVALID", "RANGE", "F8"
_FLOATING = re.compile(r"([+-]?)(\d*)(?:(\.)(\d*))?(?:E([+-]?\d+)|([+-]\d+))?")
_FIXED = re.compile(r"([+-]?)(\d+)")
_EXPONENT = re.compile(r"(?:E *[+-]?|(?<=[\d.])[+-])[\d ]*$")


def parts(field: str) -> tuple[str, int, int]:
    """Letter, width and decimals of ``E14.8`` or ``I4``."""
    found = re.fullmatch(r"([EFI])(\d+)(?:\.(\d+))?", field)
    assert found, field
    return found[1], int(found[2]), int(found[3] or 0)


def read_floating(field: str, columns: str, by: Arithmetic) -> tuple[Number | None, str]:
    """The number in the columns of an E or F field, or why there is none.

    A punched point overrides the field's decimals (p. 37); an exponent may have its E or its sign only (p. 35, 38); of
    more digits the first are kept (p. 14, 37); a minus zero keeps its sign (thesis p. 109).  Blanks: OQ 6.
    """
    decimals = parts(field)[2]
    squeezed = _without_blanks(columns)
    if not squeezed:
        return Number(False, Fraction(0)), ""
    found = _FLOATING.fullmatch(squeezed)
    if not found or not (found[2] or found[4]):
        return None, INVALID
    sign, before, point, after = found[1], found[2], found[3], found[4] or ""
    size = Fraction(int(before + after)) / ten(len(after) if point else decimals)
    if not size:
        return Number(sign == "-", Fraction(0)), ""
    # A field has at most 80 columns: a longer exponent than four digits is out of range whatever the digits are.
    power = int(found[5] or found[6] or 0)
    if abs(power) > 9999 or not LOWEST <= decade(size) + power <= HIGHEST:
        return None, RANGE
    return Number(sign == "-", shortened(size * ten(power), by.digits, False)), ""


def _without_blanks(columns: str) -> str:
    """The columns with their blanks taken for what they are (OQ 6); Undecided where nothing says."""
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
    """The number in the columns of an I field: blanks are zeros but before it (OQ 6), four digits stay (p. 14)."""
    body = columns.lstrip(" ").replace(" ", "0")
    if not body:
        return 0, ""
    found = _FIXED.fullmatch(body)
    if not found:
        return None, INVALID
    size = int(found[2]) % 10_000
    return (-size if found[1] == "-" else size), ""


def write_floating(field: str, number: Number, by: Arithmetic) -> tuple[str, str]:
    """The columns of an E or F field, cut and never rounded; by E14.8 and with F8 where it is too small (p. 39-40)."""
    letter, width, decimals = parts(field)
    columns = (_written_e if letter == "E" else _written_f)(width, decimals, number)
    if columns is not None:
        return columns, ""
    columns = _written_e(14, 8, number)
    assert columns is not None
    return columns, TOO_SMALL


def _written_e(width: int, decimals: int, number: Number) -> str | None:
    """Sign, digits with ``decimals`` of them after the point, E, sign, two digits; None where it does not fit.

    Eight digits from fourteen columns on, else w - 6; the exponent is adjusted to where the point stands (p. 39).
    """
    count = 8 if width >= 14 else width - 6
    if count < 1 or decimals > count:
        return None
    before = count - decimals
    e, digits = LOWEST, "0" * count
    if number.size:
        natural = decade(number.size)
        kept = shortened(number.size, count, False) / ten(natural - count)
        assert kept.denominator == 1
        digits, e = str(kept.numerator), natural - before
        if not LOWEST <= e <= HIGHEST:
            return None
        if before and not e:
            raise Undecided("the sign of an adjusted exponent of zero")
    body = f"{digits[:before]}.{digits[before:]}E{e:+03}"
    return ("-" + body if number.minus else body).rjust(width)


def _written_f(width: int, decimals: int, number: Number) -> str | None:
    """No zero before the point, and always a column for the sign (p. 39, OQ 13); None where it does not fit."""
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
    """Right-justified; high-order digits that have no room are lost (p. 38); only a minus takes a column (OQ 7)."""
    width = parts(field)[1]
    room = width - (value < 0)
    if not room:
        raise Undecided("a negative number in one column")
    size = abs(value) % 10**room
    if value < 0 and not size:
        raise Undecided("the sign of a negative number of which only zeros are shown")
    return f"{'-' if value < 0 else ''}{size}".rjust(width)

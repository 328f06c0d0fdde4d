"""Convert numbers to card columns and back as IBM's library of 1962 does.

The rules were measured by running the library (docs/reference/ibm-library.md).  Columns are a mutable sequence of ASCII
codes.  The functions use only integers and loops, so that numba can compile them, as in emulator/numbers/columns.py.
"""

from __future__ import annotations

from collections.abc import MutableSequence

from emulator.numbers.arithmetic import MAX_EXPONENT, MIN_EXPONENT, MINUS_ZERO, ZERO, Rules
from emulator.numbers.columns import BLANK, DIGIT, FINE, LETTER_E, MINUS, PLUS, POINT, write_exponent

DOLLAR, CLOSE, STAR = 36, 41, 42

# The letters of fields.
E_FIELD, F_FIELD, I_FIELD = range(3)

# The status of a field for which the library types ERROR F7.  Any other field has the status FINE.
REJECTED = -3

# The part of a number that a scan of its characters has reached: leading zeros, the mantissa, the exponent.
LEADING, MANTISSA, EXPONENT = range(3)


def low_digit(code: int) -> int:
    """Return the digit that IBM's library reads from a character inside a number, or -1 if it rejects the character.

    The library also accepts a blank, $, ) and *, because their two-digit codes are below the code of the minus sign.
    For these four characters, the function returns the second digit of the code.
    """
    if DIGIT <= code <= DIGIT + 9:
        return code - DIGIT
    if code == BLANK:
        return 0
    if code == DOLLAR:
        return 3
    return 4 if code == CLOSE or code == STAR else -1


def read_number(
    columns: MutableSequence[int], width: int, decimals: int, kind: int, rules: Rules
) -> tuple[int, int, int]:
    """Read a number from a field as IBM's library does.  Return mantissa, exponent and status.

    Every blank inside or after a number is a zero.  Only the last two digits of an exponent count.  For an I field the
    mantissa is the integer, and the exponent is 0, or MINUS_ZERO for a minus zero.
    """
    negative, below = False, False
    # A sign that precedes the point and the first digit that is not zero is the sign of the number.
    begun, pointed = False, kind == I_FIELD
    state = LEADING
    mantissa, digits, exponent, tens, units = 0, 0, 0, 0, 0
    for k in range(width):
        c = columns[k]
        if c == POINT:
            if pointed:
                return 0, ZERO, REJECTED
            pointed = True
            begun = True
        elif c == PLUS or c == MINUS or c == LETTER_E:
            if c != LETTER_E and not begun:
                negative = negative or c == MINUS
                continue
            # An exponent follows, which only an E field may have.
            if kind != E_FIELD:
                return 0, ZERO, REJECTED
            below = below or c == MINUS
            state = EXPONENT
        else:
            digit = low_digit(c)
            if digit < 0:
                return 0, ZERO, REJECTED
            if state == EXPONENT:
                units = digit
                if k < width - 1:
                    tens = digit
            elif state == LEADING and (digit == 0 or c < DIGIT):
                # A leading zero counts only after the point.
                exponent -= 1 if pointed else 0
            else:
                state = MANTISSA
                begun = True
                if kind == I_FIELD:
                    mantissa = (10 * mantissa + digit) % 10000
                else:
                    exponent += 0 if pointed else 1
                    if digits < rules.digits:
                        mantissa = 10 * mantissa + digit
                        digits += 1
    if kind == I_FIELD:
        return (-mantissa if negative else mantissa), (MINUS_ZERO if negative and mantissa == 0 else 0), FINE
    if mantissa == 0:
        return 0, (MINUS_ZERO if negative else ZERO), FINE
    # The library adds the exponent, then the decimals, and rejects the field if either sum has three digits.
    power = 10 * tens + units
    exponent += -power if below else power
    fits = MIN_EXPONENT <= exponent <= MAX_EXPONENT
    if not pointed:
        exponent -= decimals
    if not fits or exponent < MIN_EXPONENT or exponent > MAX_EXPONENT:
        return 0, ZERO, REJECTED
    while digits < rules.digits:
        mantissa *= 10
        digits += 1
    return (-mantissa if negative else mantissa), exponent, FINE


def write_e(
    columns: MutableSequence[int], at: int, width: int, decimals: int, mantissa: int, exponent: int, rules: Rules
) -> int:
    """Write an E field from column ``at`` on.  Return the column after it, or -1 if the field cannot hold the number.

    A field of at least fourteen columns shows eight digits.  A narrower field of w columns shows w - 6 digits.
    """
    if decimals + 6 > width:
        return -1
    count = 8 if width >= 14 else width - 6
    # The library computes the exponent from minus the number of digits before the point, so that a zero exponent gets a
    # minus sign.
    before = count - decimals
    shown = (MIN_EXPONENT if mantissa == 0 else exponent) - before
    minus = shown < 0 or (shown == 0 and before >= 0 and count > 0)
    if shown > MAX_EXPONENT:
        return -1
    if shown < MIN_EXPONENT:
        shown = MIN_EXPONENT
    end = at + width
    point = end - 4 - decimals - 1
    fill(columns, at, end, mantissa, count, point, end - 4, rules)
    sign(columns, at, point, mantissa, exponent)
    write_exponent(columns, end, shown, minus)
    return end


def write_f(
    columns: MutableSequence[int], at: int, width: int, decimals: int, mantissa: int, exponent: int, rules: Rules
) -> int:
    """Write an F field from column ``at`` on.  Return the column after it, or -1 if the number does not fit."""
    exponent_stored = ZERO if mantissa == 0 else exponent
    # The library counts the columns used with two digits, and reserves one column for the sign.
    columns_used = exponent_stored + decimals + 2
    if columns_used > MAX_EXPONENT or columns_used > width or decimals + 2 > width:
        return -1
    end = at + width
    point = end - decimals - 1
    fill(columns, at, end, mantissa, exponent_stored + decimals, point, end, rules)
    sign(columns, at, point, mantissa, exponent)
    return end


def fill(
    columns: MutableSequence[int], at: int, end: int, mantissa: int, count: int, point: int, right: int, rules: Rules
) -> None:
    """Write the first ``count`` digits of a mantissa to the left of column ``right``, and a point in column ``point``.

    Zeros fill the columns between the point and the digits.  Other columns of the field become blank.
    """
    for k in range(at, end):
        columns[k] = BLANK
    size = -mantissa if mantissa < 0 else mantissa
    # Drop the digits that are not shown.  Digits beyond the last one are zeros.
    have = rules.digits
    while have > count and size:
        size = size // 10
        have -= 1
    k = right - 1
    while k >= at and (size or k >= point):
        if k == point:
            columns[k] = POINT
        elif have < count:
            columns[k] = DIGIT
            count -= 1
        else:
            columns[k] = DIGIT + size % 10
            size = size // 10
        k -= 1


def sign(columns: MutableSequence[int], at: int, point: int, mantissa: int, exponent: int) -> None:
    """Write a minus sign before the first digit or the point of a number, if it is negative."""
    if mantissa < 0 or exponent == MINUS_ZERO:
        k = point
        while k > at and columns[k - 1] != BLANK:
            k -= 1
        columns[k - 1] = MINUS


def write_floating(
    columns: MutableSequence[int],
    at: int,
    lettered: bool,
    width: int,
    decimals: int,
    mantissa: int,
    exponent: int,
    rules: Rules,
) -> int:
    """Write an E field if ``lettered``, else an F field.  Return the next column, or -1 if the number does not fit."""
    if lettered:
        return write_e(columns, at, width, decimals, mantissa, exponent, rules)
    return write_f(columns, at, width, decimals, mantissa, exponent, rules)


def write_fixed(columns: MutableSequence[int], at: int, width: int, size: int, negative: bool) -> int:
    """Write an integer into a field of w columns, the first of which is for the sign.  Return the next column.

    The field shows the last four digits of the integer, or the last w - 1 digits if w < 5.
    """
    end = at + width
    for k in range(at, end):
        columns[k] = BLANK
    room = 4 if width > 4 else width - 1
    first = end
    for k in range(end - 1, end - 1 - room, -1):
        columns[k] = DIGIT + size % 10
        if size % 10 or k == end - 1:
            first = k
        size = size // 10
    for k in range(end - room, first):
        columns[k] = BLANK
    if negative:
        columns[first - 1] = MINUS
    return end

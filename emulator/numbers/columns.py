"""Convert numbers to card columns and back by the rules of emulator/numbers/fields.py.

Columns are a mutable sequence of ASCII codes.  The functions use only integers and loops, so that numba can compile
them. The interpreter and the compiled engine share these functions.  Each status that the functions return is a number,
for which emulator/numbers/fields.py has the message.
"""

from __future__ import annotations

from collections.abc import MutableSequence

from emulator.numbers.arithmetic import MAX_EXPONENT, MIN_EXPONENT, MINUS_ZERO, ZERO, Rules

# ASCII codes of the characters of a number. DIGIT is the code of 0.
BLANK, PLUS, MINUS, POINT, DIGIT, LETTER_E = 32, 43, 45, 46, 48, 69

# The status of a field that was read: an error if it is below zero, a warning if it is above zero.  The status CUT + n
# means that the number has n digits, some of which were lost.
NO_NUMBER, OUT_OF_RANGE = -1, -2
FINE, BLANK_FIELD, BLANKS_INSIDE, BLANKS_AS_ZEROS, FOUR_KEPT, CUT = range(6)

# The field E14.8, used for a number that is too large for its own field (C26-5619 p. 39-40).
E_COLUMNS, E_DECIMALS = 14, 8


def squeeze(columns: MutableSequence[int], width: int) -> tuple[int, int]:
    """Move the characters of a number to the left end of its field and remove blanks.  Return length and status.

    Leading blanks are ignored.  In a number without point and exponent, all other blanks count as zeros.  In a number
    with a point or an exponent, trailing blanks are ignored.  The inner blanks of such a number count as zeros.  But if
    one of them may belong to an exponent, all inner blanks are dropped (OPEN-QUESTIONS 6).  A *mark* is a character
    that may begin an exponent: an E, or a sign after the first character.  A blank may belong to an exponent if it
    follows the first mark, or if it is between the point and the last mark.
    """
    first = 0
    while first < width and columns[first] == BLANK:
        first += 1
    end = width
    while end > first and columns[end - 1] == BLANK:
        end -= 1
    if first == end:
        return 0, BLANK_FIELD
    # Find the point and the first and last character that may begin an exponent.
    point, first_e, last_e, blanks = width, width, -1, 0
    for k in range(first, end):
        c = columns[k]
        if c == BLANK:
            blanks += 1
        elif c == POINT and point == width:
            point = k
        elif c == LETTER_E or (k > first and (c == PLUS or c == MINUS)):
            last_e = k
            if first_e == width:
                first_e = k
    warning = FINE
    drop = False
    if point < width or last_e >= 0:
        if blanks:
            warning = BLANKS_INSIDE
            # A blank after the first exponent mark, or between the point and the last one, may belong to the exponent.
            for k in range(first, end):
                if columns[k] == BLANK and (k > first_e or point < k < last_e):
                    drop = True
    elif blanks or end < width:
        # An integer: trailing blanks up to the field's end are zeros.
        warning = BLANKS_AS_ZEROS
        end = width
    length = 0
    for k in range(first, end):
        c = columns[k]
        if c == BLANK:
            if drop:
                continue
            c = DIGIT
        columns[length] = c
        length += 1
    for k in range(length, width):
        columns[k] = BLANK
    return length, warning


def is_digit(code: int) -> bool:
    return DIGIT <= code <= DIGIT + 9


def read_floating(columns: MutableSequence[int], width: int, decimals: int, rules: Rules) -> tuple[int, int, int]:
    """Read an E or F field.  Return mantissa, exponent and status.  :func:`squeeze` changes the columns.

    The field holds a sign, digits with or without a point, and an exponent, which may omit its E if it has a sign.
    """
    length, status = squeeze(columns, width)
    if length == 0:
        return 0, ZERO, status
    k = 0
    negative = columns[0] == MINUS
    if negative or columns[0] == PLUS:
        k = 1
    # The digits before the exponent.  ``lead`` counts the digits from the first one that is not zero, ``significant``
    # those up to the last one that is not zero, and ``scale`` the digits after the point (-1 before a point is read).
    mantissa = 0
    lead, significant, digits, scale = 0, 0, 0, -1
    while k < length:
        c = columns[k]
        if is_digit(c):
            digits += 1
            if scale >= 0:
                scale += 1
            if lead or c != DIGIT:
                lead += 1
                if c != DIGIT:
                    significant = lead
                if lead <= rules.digits:
                    mantissa = 10 * mantissa + c - DIGIT
        elif c == POINT and scale < 0:
            scale = 0
        else:
            break
        k += 1
    # A point on the card overrides the decimals of the FORMAT (C26-5619 p. 35-38).
    if scale < 0:
        scale = decimals
    # The exponent: E with or without a sign, or a sign alone.
    power, power_digits = 0, 0
    below = False
    if k < length:
        lettered = columns[k] == LETTER_E
        if lettered:
            k += 1
        if k < length and (columns[k] == PLUS or columns[k] == MINUS):
            below = columns[k] == MINUS
            k += 1
        elif not lettered:
            return 0, ZERO, NO_NUMBER
        if k == length:
            return 0, ZERO, NO_NUMBER
        while k < length:
            c = columns[k]
            if not is_digit(c):
                return 0, ZERO, NO_NUMBER
            if power or c != DIGIT:
                power_digits += 1
                if power_digits <= 6:
                    power = 10 * power + c - DIGIT
            k += 1
    if digits == 0:
        return 0, ZERO, NO_NUMBER
    if power_digits > 6:
        return 0, ZERO, OUT_OF_RANGE
    if lead == 0:
        return 0, (MINUS_ZERO if negative else ZERO), status
    # The mantissa is a fraction whose first digit stands right after the point.
    exponent = lead - scale + (-power if below else power)
    if exponent < MIN_EXPONENT or exponent > MAX_EXPONENT:
        return 0, ZERO, OUT_OF_RANGE
    if significant > rules.digits and status == FINE:
        status = CUT + significant
    while lead < rules.digits:
        mantissa *= 10
        lead += 1
    return (-mantissa if negative else mantissa), exponent, status


def read_fixed(columns: MutableSequence[int], width: int) -> tuple[int, int]:
    """Read an integer (I field).  Return its last four digits with the sign, and the status."""
    length, status = squeeze(columns, width)
    if length == 0:
        return 0, status
    k = 0
    negative = columns[0] == MINUS
    if negative or columns[0] == PLUS:
        k = 1
    if k == length:
        return 0, NO_NUMBER
    value = 0
    while k < length:
        c = columns[k]
        if not is_digit(c):
            return 0, NO_NUMBER
        value = 10 * value + c - DIGIT
        if value > 9999:
            status = FOUR_KEPT
            value = value % 10000
        k += 1
    return (-value if negative else value), status


def write_e(
    columns: MutableSequence[int], at: int, width: int, decimals: int, mantissa: int, exponent: int, rules: Rules
) -> int:
    """Write an E field from column ``at`` on.  Return the column after it, or -1 if the field cannot hold the number.

    The field holds sign, digits, point, digits, E, sign and two digits.  A field of at least fourteen columns shows
    eight digits.  A narrower field of w columns shows w - 6 digits (C26-5619 p. 39).
    """
    count = 8 if width >= E_COLUMNS else width - 6
    if count < 1 or decimals > count:
        return -1
    # Ew.d has d digits after the point, and the rest before it, so the exponent shown is smaller by that number.
    left = count - decimals
    shown = ZERO if mantissa == 0 else exponent - left
    if shown < MIN_EXPONENT or shown > MAX_EXPONENT:
        return -1
    end = at + width
    first = end - count - 5
    for k in range(at, first):
        columns[k] = BLANK
    if mantissa < 0 or exponent == MINUS_ZERO:
        columns[first - 1] = MINUS
    # Truncate to the digits shown, then write them from right to left, with zeros after the last digit available.
    size = -mantissa if mantissa < 0 else mantissa
    have = rules.digits
    while have > count:
        size = size // 10
        have -= 1
    for digit in range(count - 1, -1, -1):
        place = first + digit + (1 if digit >= left else 0)
        if digit < have:
            columns[place] = DIGIT + size % 10
            size = size // 10
        else:
            columns[place] = DIGIT
    columns[first + left] = POINT
    write_exponent(columns, end, shown, shown < 0)
    return end


def write_exponent(columns: MutableSequence[int], end: int, shown: int, minus: bool) -> None:
    """Write an exponent into the last four columns of an E field: the letter E, a sign and two digits."""
    size = -shown if shown < 0 else shown
    columns[end - 4] = LETTER_E
    columns[end - 3] = MINUS if minus else PLUS
    columns[end - 2] = DIGIT + size // 10
    columns[end - 1] = DIGIT + size % 10


def write_f(
    columns: MutableSequence[int], at: int, width: int, decimals: int, mantissa: int, exponent: int, rules: Rules
) -> int:
    """Write an F field from column ``at`` on.  Return the column after it, or -1 if the number does not fit."""
    minus = 1 if mantissa < 0 or exponent == MINUS_ZERO else 0
    integer_digits = exponent if mantissa != 0 and exponent > 0 else 0
    # One column is reserved for the sign even if the number is positive (C26-5619 p. 39).
    if 1 + integer_digits + 1 + decimals > width:
        return -1
    end = at + width
    point = end - decimals - 1
    for k in range(at, end):
        columns[k] = BLANK
    if minus:
        columns[point - integer_digits - 1] = MINUS
    for k in range(point - integer_digits, end):
        columns[k] = DIGIT
    columns[point] = POINT
    size = -mantissa if mantissa < 0 else mantissa
    # The digit with the value 10**p stands p+1 columns left of the point, or -p columns right of it if p is negative.
    # The first digit of the mantissa has the value 10**(exponent-1).  Digits beyond the decimals are not written,
    # because output truncates.
    for digit in range(rules.digits - 1, -1, -1):
        p = exponent - 1 - digit
        if -decimals <= p:
            columns[point - p - 1 if p >= 0 else point - p] = DIGIT + size % 10
        size = size // 10
    return end


def write_floating(
    columns: MutableSequence[int],
    at: int,
    lettered: bool,
    width: int,
    decimals: int,
    mantissa: int,
    exponent: int,
    rules: Rules,
) -> tuple[int, int]:
    """Write an E field if ``lettered``, else an F field.  Return the next column, and 1 if E14.8 was used, else 0."""
    if lettered:
        end = write_e(columns, at, width, decimals, mantissa, exponent, rules)
    else:
        end = write_f(columns, at, width, decimals, mantissa, exponent, rules)
    if end >= 0:
        return end, 0
    return write_e(columns, at, E_COLUMNS, E_DECIMALS, mantissa, exponent, rules), 1


def write_fixed(columns: MutableSequence[int], at: int, width: int, value: int) -> int:
    """Write an integer (I field), right-justified, with its minus sign, and return the column after the field."""
    size = -value if value < 0 else value
    # A minus sign takes one column.  High-order digits that do not fit are lost (C26-5619 p. 38).
    room = width - 1 if value < 0 else width
    end = at + width
    for k in range(at, end):
        columns[k] = BLANK
    # ``lead`` becomes the column of the first digit that is not a leading zero.
    lead = end if room == 0 else end - 1
    for k in range(end - 1, end - 1 - room, -1):
        digit = size % 10
        size = size // 10
        columns[k] = DIGIT + digit
        if digit:
            lead = k
    for k in range(end - room, lead):
        columns[k] = BLANK
    if value < 0:
        columns[lead - 1] = MINUS
    return end

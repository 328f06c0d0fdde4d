"""A square root routine for the 1620, written for this project: no known deck contains IBM's own.

The routine replaces the number in the accumulator, positions 51 to 60, by its square root truncated to eight digits.
The sign of the number is ignored, and a zero becomes +0.  If the exponent is odd, the decimal point of the mantissa is
first moved by one digit.  The exponent is then halved.

The digits come from subtraction alone.  A number ``b`` is 5 at first.  The routine subtracts ``b`` from five times the
mantissa as long as the result stays positive, and adds ten to ``b`` after each subtraction.  Then ``b`` moves one digit
to the right, with a zero inserted before its last digit, and the same steps give the next digit of the root.  At the
end, the digits of ``b`` before its last digit, the 5, are those of the root.  The routine needs the 1620's indirect
addressing.
"""

from emulator.objectdeck import digits as d

# Each line of the routine has a name or "", an operation code and the operands P and Q.  An operand is five digits, or
# the name of a line or field with an offset in digits.  A name with "@" is an indirect address.  A name with "=" stands
# for the address itself as an immediate number.
_LINES = (
    ("", d.BRANCH_ON_DIGIT, "nonzero", "00051"),
    ("", d.CLEAR_FLAG, "00058", d.NONE),
    ("", d.BRANCH_BACK, d.NONE, d.NONE),
    # Five times the mantissa is moved to ``number``, one digit further right if the exponent is odd.
    ("nonzero", d.CLEAR_FLAG, "00058", d.NONE),
    ("", d.MULTIPLY_IMMEDIATE, "00058", "000]5"),
    ("", d.SET_FLAG, "00090", d.NONE),
    ("", d.TRANSMIT_FIELD, "product+9", "00099"),
    ("", d.TRANSMIT_FIELD, "number+17", "zeros+17"),
    ("", d.MULTIPLY_IMMEDIATE, "00060", "000]5"),
    ("", d.SET_FLAG, "00096", d.NONE),
    ("", d.BRANCH_ON_DIGIT, "odd", "00099"),
    ("", d.TRANSMIT_FIELD, "number+9", "product+9"),
    ("", d.BRANCH, "exponent", d.NONE),
    ("odd", d.TRANSMIT_FIELD, "number+10", "product+9"),
    ("", d.ADD_IMMEDIATE, "00099", "000]5"),
    # Half the exponent is a tenth of five times the exponent.  A zero has no sign.
    ("exponent", d.BRANCH_NO_FLAG, "positive", "00099"),
    ("", d.SET_FLAG, "00098", d.NONE),
    ("", d.BRANCH_ON_DIGIT, "positive", "00098"),
    ("", d.BRANCH_ON_DIGIT, "positive", "00097"),
    ("", d.CLEAR_FLAG, "00098", d.NONE),
    ("positive", d.SET_FLAG, "00097", d.NONE),
    ("", d.TRANSMIT_FIELD, "00060", "00098"),
    ("", d.TRANSMIT_FIELD, "root+9", "five+9"),
    ("", d.TRANSMIT_FIELD_IMMEDIATE, "last+4", "=number+3"),
    ("", d.TRANSMIT_FIELD_IMMEDIATE, "unit+4", "=root+2"),
    ("", d.TRANSMIT_FIELD_IMMEDIATE, "ten+4", "=root+1"),
    # Subtract ``b`` while the number is not smaller than ``b``.  The digit of ``b`` before the 5 counts the
    # subtractions.
    ("compare", d.COMPARE, "@last+4", "@unit+4"),
    ("", d.BRANCH_NO_INDICATOR, "next", d.HIGH_OR_EQUAL),
    ("", d.SUBTRACT, "@last+4", "@unit+4"),
    ("", d.ADD_IMMEDIATE, "@ten+4", "000]1"),
    ("", d.BRANCH, "compare", d.NONE),
    ("next", d.TRANSMIT_DIGIT_IMMEDIATE, "@unit+4", "00000"),
    ("", d.ADD_IMMEDIATE, "unit+4", "000]1"),
    ("", d.COMPARE_IMMEDIATE, "unit+4", "=root+10"),
    ("", d.BRANCH_INDICATOR, "done", d.EQUAL),
    ("", d.TRANSMIT_DIGIT_IMMEDIATE, "@unit+4", "00005"),
    ("", d.ADD_IMMEDIATE, "ten+4", "000]1"),
    ("", d.ADD_IMMEDIATE, "last+4", "000]2"),
    ("", d.BRANCH, "compare", d.NONE),
    ("done", d.SET_FLAG, "root+1", d.NONE),
    ("", d.TRANSMIT_FIELD, "00058", "root+8"),
    ("", d.BRANCH_BACK, d.NONE, d.NONE),
)
# Storage behind the code: names and initial digits.  ``last``, ``unit`` and ``ten`` are addresses.
_FIELDS = (
    ("number", "]" + "0" * 17),
    ("zeros", "]" + "0" * 17),
    ("product", "]" + "0" * 9),
    ("root", "]" + "0" * 9),
    ("five", "]050000000"),
    ("last", "]0000"),
    ("unit", "]0000"),
    ("ten", "]0000"),
)
_INSTRUCTION = 12


def square_root(start: int) -> str:
    """Return the digits of the square root routine for core storage from ``start`` on, its entry point."""
    places = {name: start + _INSTRUCTION * index for index, (name, *_) in enumerate(_LINES)}
    at = start + _INSTRUCTION * len(_LINES)
    for name, digits in _FIELDS:
        places[name] = at
        at += len(digits)
    code = "".join(operation + _operand(p, places) + _operand(q, places) for _, operation, p, q in _LINES)
    return code + "".join(digits for _, digits in _FIELDS)


def _operand(text: str, places: dict[str, int]) -> str:
    """Return the five digits of an instruction's operand.  ``text`` is the name of a position or the digits."""
    name, _, offset = text.lstrip("@=").partition("+")
    if name[0] in d.FLAGGED + "0123456789":
        return text
    digits = f"{places[name] + int(offset or 0):05d}"
    if text[0] == "@":
        return digits[:-1] + d.FLAGGED[int(digits[-1])]
    return d.flagged(digits) if text[0] == "=" else digits

"""Digits of core storage in the code of the cards, with flags, and the instructions of the 1620 made of them.

One character stands for one position of core storage: ``0`` to ``9``, ``]`` for a zero with a flag, ``J`` to ``R`` for 1 to 9
with a flag, and ``|`` for a record mark.  An instruction has twelve digits: two of operation code, five of address P and
five of address Q.  An immediate instruction takes the digits of Q themselves as its second operand.
"""

from __future__ import annotations

FLAGGED = "]JKLMNOPQR"
RECORD_MARK = "|"

# Operation codes (reference card X26-5743-2).
ADD, SUBTRACT, MULTIPLY, COMPARE, TRANSMIT_DIGIT, TRANSMIT_FIELD = "21", "22", "23", "24", "25", "26"
ADD_IMMEDIATE, SUBTRACT_IMMEDIATE, MULTIPLY_IMMEDIATE, COMPARE_IMMEDIATE = "11", "12", "13", "14"
TRANSMIT_DIGIT_IMMEDIATE, TRANSMIT_FIELD_IMMEDIATE = "15", "16"
SET_FLAG, CLEAR_FLAG, BRANCH_BACK, BRANCH_ON_DIGIT, BRANCH_NO_FLAG = "32", "33", "42", "43", "44"
BRANCH_INDICATOR, BRANCH_NO_INDICATOR, HALT, BRANCH = "46", "47", "48", "49"
# The compiler set a flag over the first digit of these when they call the library.
CALL_IMMEDIATE, CALL = "J7", "K7"
# Indicators, as the Q address of a branch.
HIGH, EQUAL, HIGH_OR_EQUAL = "01100", "01200", "01300"
NONE = "00000"


def flagged(digits: str) -> str:
    """Return digits with a flag over the first one, which marks the high-order end of a field."""
    return FLAGGED[int(digits[0])] + digits[1:]


def address(position: int) -> str:
    """Return an address as the compiler punched it: five digits with a flag over the first."""
    return flagged(f"{position:05d}")


def immediate(value: int) -> str:
    """Return the Q part of an immediate instruction with a fixed-point number of four digits."""
    return "0" + flagged(f"{value:04d}")


def wide_immediate(value: int) -> str:
    """Return an immediate number with a second flag to its left, as in the limit of a DO and in subscripts."""
    return "]" + flagged(f"{value:04d}")


def mantissa_and_exponent(mantissa: int, exponent: int) -> str:
    """Return a floating-point number of eight digits as a field: mantissa, then exponent, each with its flags."""
    digits = flagged(f"{abs(mantissa):08d}")
    if mantissa < 0:
        digits = digits[:-1] + FLAGGED[int(digits[-1])]
    size = f"{abs(exponent):02d}"
    return digits + flagged(size[0]) + (FLAGGED[int(size[1])] if exponent < 0 else size[1])


def alphameric(text: str) -> str:
    """Return the two-digit codes of characters (X26-5743-2, page 4)."""
    return "".join(_CODES[character] for character in text)


def flagged_alphameric(text: str) -> str:
    """Return the two-digit codes of characters with a flag over the first digit of each."""
    return "".join(flagged(_CODES[character]) for character in text)


_CODES = {" ": "00", ".": "03", ")": "04", "+": "10", "$": "13", "*": "14", "-": "20", "/": "21", ",": "23", "(": "24"}
_CODES |= {"=": "33", "@": "34", "'": "34"}
_CODES |= {letter: f"4{n}" for n, letter in enumerate("ABCDEFGHI", 1)}
_CODES |= {letter: f"5{n}" for n, letter in enumerate("JKLMNOPQR", 1)}
_CODES |= {letter: f"6{n}" for n, letter in enumerate("STUVWXYZ", 2)}
_CODES |= {digit: f"7{digit}" for digit in "0123456789"}

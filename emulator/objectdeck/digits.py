"""The digits of core storage as characters on cards, instructions of the 1620, and addresses of IBM's routines.

One character stands for one position of core storage: ``0`` to ``9``, ``]`` for a zero with a flag, ``J`` to ``R`` for
1 to 9 with a flag, and ``|`` for a record mark.  An instruction has twelve digits: two of operation code, five of
address P and five of address Q.  An immediate instruction takes the digits of Q themselves as its second operand.

A call of a routine transmits the address of the operand to the position before the routine's entry.  The accumulator is
in positions 51 to 60.  A floating-point number fills all of them, and a fixed-point number the last four.
"""

from collections.abc import Iterable

from emulator.language import objectcode as op
from emulator.language.ibm1962 import ALONE, FIXED, FLAG, FROM_FAC, OPERATIONS, TO_FAC, character_code, digits

PLAIN, FLAGGED = "0123456789|", "]JKLMNOPQR"
RECORD_MARK = "|"

# Operation codes (reference card X26-5743-2).
ADD, SUBTRACT, MULTIPLY, COMPARE, TRANSMIT_FIELD = "21", "22", "23", "24", "26"
ADD_IMMEDIATE, MULTIPLY_IMMEDIATE, COMPARE_IMMEDIATE = "11", "13", "14"
TRANSMIT_DIGIT_IMMEDIATE, TRANSMIT_FIELD_IMMEDIATE = "15", "16"
SET_FLAG, CLEAR_FLAG, BRANCH_BACK, BRANCH_ON_DIGIT, BRANCH_NO_FLAG = "32", "33", "42", "43", "44"
BRANCH_INDICATOR, BRANCH_NO_INDICATOR, HALT, BRANCH = "46", "47", "48", "49"
# The operation codes 17 and 27, which call the library, with the flag that the compiler set over their first digit.
CALL_IMMEDIATE, CALL = "J7", "K7"
# Indicators, as the Q address of a branch.
HIGH, EQUAL, HIGH_OR_EQUAL = "01100", "01200", "01300"
NONE = "00000"

# The positions of the last digit of the accumulator's mantissa and of the whole accumulator.
MANTISSA, ACCUMULATOR = 58, 60
# The position of a product's last digit.  The digits begin at position 80.
PRODUCT = 99

# The library's entry point for each operation.  The compiler punched those of PLAIN_ENTRIES without a flag.  The known
# object deck shows the entry points for fixed point.  Those for floating point were found in the library's code.
PLAIN_ENTRIES = dict.fromkeys((op.TOFAC, op.TOFIX, op.SEND), TO_FAC)
PLAIN_ENTRIES |= dict.fromkeys((op.FMFAC, op.FMFIX, op.TRANSMIT), FROM_FAC)
ENTRIES = {op.NAMES.index(name): entry for name, entry in (OPERATIONS | FIXED).items()}
ENTRIES |= {op.FSBR: OPERATIONS["FSB"], op.XSBR: FIXED["XSB"]}
# Entry points that are called without an operand: reversal of sign, conversion to floating and to fixed point.
REVERSE_SIGN = ALONE["RSGN"]
CALLS = {op.RSGX: REVERSE_SIGN} | {op.NAMES.index(name): entry for name, entry in ALONE.items()}

# The last item of a list sets this field of two digits to zero.
MORE_ITEMS = 5365


def flagged(digits: str) -> str:
    """Return digits with a flag on the first one, which marks the left end of a field."""
    return FLAGGED[int(digits[0])] + digits[1:]


def address(position: int) -> str:
    """Return an address as the compiler punched it: five digits with a flag over the first."""
    return flagged(f"{position:05d}")


def immediate(value: int) -> str:
    """Return an integer as the second operand (Q) of an immediate instruction, with a flag over its first digit."""
    return "0" + flagged(f"{value:04d}")


def wide_immediate(value: int) -> str:
    """Return an integer as :func:`immediate` does, with a second flag, over the first of the five digits of Q.

    IBM's compiler punched the limit of a DO and the factor of a subscript in this form.
    """
    return "]" + flagged(f"{value:04d}")


def floating_field(mantissa: int, exponent: int) -> str:
    """Return a floating-point number of eight digits as the ten digits of a storage field."""
    number = digits(abs(mantissa), 8, negative=mantissa < 0) + digits(abs(exponent), 2, negative=exponent < 0)
    return card_text(number)


def card_text(positions: Iterable[int]) -> str:
    """Return the characters by which a card represents the given positions of core storage."""
    return "".join((FLAGGED if position & FLAG else PLAIN)[position % FLAG] for position in positions)


def alphameric(name: str) -> str:
    """Return a name as a storage field: the two-digit codes of its five characters, with a flag on the first digit."""
    return flagged("".join(f"{character_code(character):02d}" for character in f"{name:<5}"))

"""Entry points of the arithmetic in IBM's library of 1962, and the routines that this project supplies.

A call transmits the address of its operand to the position before the entry.  Arithmetic routines work with the
accumulator in positions 51 to 60: a floating-point number fills it, a fixed-point number takes its last four digits.
"""

from emulator.language import objectcode as op
from emulator.language.expressions import LIBRARY
from emulator.objectdeck.square_root import square_root

# The units positions of the accumulator's mantissa and of the whole accumulator.
MANTISSA, ACCUMULATOR = 58, 60
# The units position of a product, whose digits begin at position 80.
PRODUCT = 99

# Entries that the compiler punched without a flag.
PLAIN_ENTRIES = {op.TOFAC: 1238, op.TOFIX: 1238, op.FMFAC: 1306, op.FMFIX: 1306, op.SEND: 1238, op.TRANSMIT: 1306}
# Fixed-point entries are those of the deck.  The entries of floating point were found in the library's code.
ENTRIES = {
    op.XAD: 2644,
    op.XSB: 2700,
    op.XSBR: 2700,
    op.XMP: 2748,
    op.XDV: 2876,
    op.XDVR: 2816,
    op.FAD: 518,
    op.FSB: 408,
    op.FSBR: 408,
    op.FMP: 1378,
    op.FDV: 1862,
    op.FDVR: 1756,
    op.POWERX: 3670,
}
# Calls without an operand: reversal of sign, conversion to floating and to fixed point.
REVERSE_SIGN = 2546
CALLS = {op.RSGN: REVERSE_SIGN, op.RSGX: REVERSE_SIGN, op.FLOAT: 3222, op.FIX: 3494}

# The last item of a list sets this field of two digits to zero.
MORE_ITEMS = 5365

# Routines of this project for functions that the library lacks.  Each is given the position of its first instruction.
ROUTINES = {"SQRT": square_root}


def function_entry(name: str, core: int) -> int:
    """Return the position of the branch to a function: the first digit of the function's field above the data."""
    return core - 20 * LIBRARY.index(name) - 10

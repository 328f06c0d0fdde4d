"""Estimates of the time that slow operations take, from the lengths of their numbers, for the limit of a run.

The limit of a run is a number of units of work.  Each statement counts as one unit, and so does each pass of an indexed
list, each number read or written and each line.  An operation that takes longer than a statement counts as the number
of statements that would take the same time.  A unit is divided into STEPS steps, because a statement on one card has at
most STEPS - 1 operations.  The estimate is made before the operation, in integers, so that a run ends at the same
statement on every machine.

Times were measured in microseconds with CPython 3.11 on one core of an AMD EPYC.  A step is an operation of the
eight-digit arithmetics, which takes 0.9 to 1.5 microseconds.  The estimates assume 1.2 microseconds.  A unit of work
therefore takes 41 microseconds, and 5,000,000 units take 205 seconds.  In the table, the columns 300 to 100,000 give
the measured time of an operation on numbers of that many bits, and the last column gives the time that the formula
estimates for 100,000 bits, all in microseconds.

=====================  ====  ======  =======  ========  ======================================  ==========
bits                    300   3,000   10,000   100,000  formula, in steps                       at 100,000
=====================  ====  ======  =======  ========  ======================================  ==========
product                 0.4      16      107     4,070  n * sqrt(n) / 8,000                          4,740
quotient, gcd, root     1.5      27      227    18,300  n * n / 650,000                             18,500
EXP, LOG, SIN, ATAN      18   1,160   11,900   748,000  25 + n * n / 12,000 (mpmath)             1,000,000
conversion to decimal   130     580    3,100   265,000  90 + n * n / 40,000 (mpmath)               300,000
=====================  ====  ======  =======  ========  ======================================  ==========

SIN, COS, ATAN, EXP and LOG of a decimal number take 40 to 100 steps, and up to 420 if the argument is tiny and its last
digits decide.  ``A**B`` takes 150 to 250 steps, and up to 660.
"""

from __future__ import annotations

from math import isqrt

# Steps in a unit of work.
STEPS = 34
# The steps of an operation that ends in an error code, because the interpreter returns and is called again.
ERROR = 4
# The operations whose work is estimated even for decimal numbers.
COSTED = ("SIN", "COS", "ATAN", "EXP", "LOG", "SQRT", "power", "integer_power")
_PRODUCT, _QUOTIENT, _SERIES, _DECIMAL = 8_000, 650_000, 12_000, 40_000


def product(first: int, second: int) -> int:
    """Estimate the steps of a product of two integers with the given numbers of bits."""
    return max(first, second) * isqrt(min(first, second)) // _PRODUCT


def quotient(bits: int, divisor: int) -> int:
    """Estimate the steps of a quotient or gcd of integers with the given numbers of bits, or of a square root."""
    return bits * divisor // _QUOTIENT


def series(bits: int) -> int:
    """Estimate the steps of a library function computed to the given number of bits."""
    return 25 + bits * bits // _SERIES


def decimal(bits: int) -> int:
    """Estimate the steps of finding the shortest decimal of a binary number with the given number of bits."""
    return 90 + bits * bits // _DECIMAL


def fractions(first: int, second: int) -> int:
    """Estimate the steps of + - * / on fractions with the given numbers of bits: two gcds and four products."""
    return 3 + 2 * quotient(first, second) + 4 * product(first, second)


def decimal_function(exponent: int) -> int:
    """Estimate the steps of SIN, COS, ATAN, EXP or LOG of a decimal number.  Tiny arguments need many more digits."""
    return 60 + 5 * min(max(-exponent, 0), 60)


def decimal_power(exponent: int) -> int:
    """Estimate the steps of ``A**B`` for decimal numbers, where ``exponent`` is the decimal exponent of B."""
    return 200 + 4 * max(-exponent, 0)


def multiplied(count: int) -> int:
    """Estimate the steps of ``A**J`` computed by repeated multiplication."""
    return abs(count) // 2

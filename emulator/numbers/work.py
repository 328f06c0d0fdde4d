"""What costly operations count against the limit of work, from the sizes of their numbers.

The limit counts statements: 1 each, and 1 for each pass of an indexed list, number and line.  A statement that fills
a card has at most STEPS - 1 operations.  What takes longer than that counts for as many statements as would take its
time, in steps: STEPS steps are a unit of work.  Costs are estimated before an operation is done, in whole numbers, so
that a run ends at the same place on every machine.

Measured with CPython 3.11 on one core of an AMD EPYC, microseconds; a step is an operation of the eight-digit
arithmetics, 0.9 to 1.5, taken as 1.2 (a unit is 41, and 5,000,000 of them 205 seconds):

=====================  ====  ======  =======  ========  ======================================  ==========
bits                    300   3,000   10,000   100,000  formula, in steps                       at 100,000
=====================  ====  ======  =======  ========  ======================================  ==========
product                 0.4      16      107     4,070  n * sqrt(n) / 8,000                          4,740
quotient, gcd, root     1.5      27      227    18,300  n * n / 650,000                             18,500
EXP, LOG, SIN, ATAN      18   1,160   11,900   748,000  25 + n * n / 12,000 (mpmath)             1,000,000
to a decimal            130     580    3,100   265,000  90 + n * n / 40,000 (mpmath)               300,000
=====================  ====  ======  =======  ========  ======================================  ==========

SIN, COS, ATAN, EXP and LOG of a decimal number take 40 to 100, up to 420 where the argument is tiny and the digits
after its own decide; ``A**B`` 150 to 250, up to 660.
"""

from __future__ import annotations

from math import isqrt

STEPS = 34
"""Steps in a unit of work."""
ERROR = 4
"""Steps of an error code: the interpreter is left and entered again."""
_PRODUCT, _QUOTIENT, _SERIES, _DECIMAL = 8_000, 650_000, 12_000, 40_000


def product(first: int, second: int) -> int:
    """Steps of a product of two whole numbers of so many bits."""
    return max(first, second) * isqrt(min(first, second)) // _PRODUCT


def quotient(bits: int, divisor: int) -> int:
    """Steps of a quotient of so many bits by a divisor of so many; of a greatest common divisor, of a square root."""
    return bits * divisor // _QUOTIENT


def series(bits: int) -> int:
    """Steps of a library function computed to so many bits."""
    return 25 + bits * bits // _SERIES


def decimal(bits: int) -> int:
    """Steps of a binary number's shortest decimal."""
    return 90 + bits * bits // _DECIMAL


def fractions(first: int, second: int) -> int:
    """Steps of a sum, product or quotient of fractions whose longer parts have so many bits: two gcd, four products."""
    return 3 + 2 * quotient(first, second) + 4 * product(first, second)


def decimal_function(exponent: int) -> int:
    """Steps of SIN, COS, ATAN, EXP or LOG of a decimal number: of a tiny one many digits more are computed."""
    return 60 + 5 * min(max(-exponent, 0), 60)


def decimal_power(exponent: int) -> int:
    """Steps of ``A**B`` where B has that exponent."""
    return 200 + 4 * max(-exponent, 0)


def multiplied(count: int) -> int:
    """Steps of ``A**J`` multiplied out."""
    return abs(count) // 2

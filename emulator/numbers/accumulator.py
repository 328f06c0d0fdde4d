"""The floating accumulator FAC of a decimal profile: what its operations do with zeros, signs, overflow and underflow.

Every function takes the mantissa and exponent in FAC, then those of the other number (emulator/numbers/arithmetic.py),
and gives mantissa, exponent and event: 0, or the number of the error code ERROR E1 to E7 that goes with the result
(C26-5619 p. 60, executed on IBM's code).  This is the one place where these rules stand: the interpreter, the kernel
and the port all call it.

The functions use only what a compiler of integer loops accepts.
"""

from __future__ import annotations

from emulator.numbers.arithmetic import (
    MAX_EXPONENT,
    MIN_EXPONENT,
    MINUS_ZERO,
    ZERO,
    Rules,
)
from emulator.numbers.arithmetic import add as add_digits
from emulator.numbers.arithmetic import divide as divide_digits
from emulator.numbers.arithmetic import multiply as multiply_digits

# Events, numbered as the codes E1 to E8.
(
    SUM_OVER,
    SUM_UNDER,
    PRODUCT_OVER,
    PRODUCT_UNDER,
    QUOTIENT_OVER,
    QUOTIENT_UNDER,
    ZERO_DIVISOR,
    FIXED_ZERO_DIVISOR,
) = range(1, 9)

State = tuple[int, int, int]
"""Mantissa, exponent and event."""


def add(ma: int, ea: int, mb: int, eb: int, rules: Rules) -> State:
    """FAC + number.  A zero added changes nothing, but that two zeros give a plus zero where the profile says so."""
    if mb == 0:
        if ma == 0 and not rules.keeps_left_zero:
            return 0, ZERO, 0
        return ma, ea, 0
    if ma == 0:
        return mb, eb, 0
    m, e = add_digits(ma, ea, mb, eb, rules)
    if e > MAX_EXPONENT:
        return largest(m, rules), MAX_EXPONENT, SUM_OVER
    if e < MIN_EXPONENT and m != 0:
        return 0, (MINUS_ZERO if rules.signed_sums and m < 0 else ZERO), SUM_UNDER
    return m, e, 0


def subtract(ma: int, ea: int, mb: int, eb: int, rules: Rules) -> State:
    """FAC - number: the number is added with its sign reversed, a zero as it is."""
    return add(ma, ea, -mb, eb, rules)


def subtract_reversed(ma: int, ea: int, mb: int, eb: int, rules: Rules) -> State:
    """Number - FAC, as the subroutine FSBR does it: FAC - number, then the sign reversed."""
    m, e, event = add(ma, ea, -mb, eb, rules)
    m, e = negate(m, e)
    return m, e, event


def multiply(ma: int, ea: int, mb: int, eb: int, rules: Rules) -> State:
    """FAC * number.  A product with a zero is a plus zero."""
    if ma == 0 or mb == 0:
        return 0, ZERO, 0
    m, e = multiply_digits(ma, ea, mb, eb, rules)
    if e > MAX_EXPONENT:
        return largest(m, rules), MAX_EXPONENT, PRODUCT_OVER
    if e < MIN_EXPONENT:
        return 0, vanished(m, rules), PRODUCT_UNDER
    return m, e, 0


def divide(ma: int, ea: int, mb: int, eb: int, rules: Rules) -> State:
    """FAC / number.  Zero divided is a plus zero; division by zero gives the largest number."""
    if mb == 0:
        return largest(-1 if rules.signed_by_zero and ma < 0 else 1, rules), MAX_EXPONENT, ZERO_DIVISOR
    if ma == 0:
        return 0, ZERO, 0
    m, e = divide_digits(ma, ea, mb, eb, rules)
    if e > MAX_EXPONENT:
        return largest(m, rules), MAX_EXPONENT, QUOTIENT_OVER
    if e < MIN_EXPONENT:
        return 0, vanished(m, rules), QUOTIENT_UNDER
    return m, e, 0


def negate(m: int, e: int) -> tuple[int, int]:
    """The sign of FAC reversed, of a zero too (subroutine RSGN)."""
    if m == 0:
        return 0, (MINUS_ZERO if e == ZERO else ZERO)
    return -m, e


def largest(sign: int, rules: Rules) -> int:
    """The mantissa of the largest number, with the sign of ``sign``, which is not 0."""
    return rules.limit - 1 if sign > 0 else 1 - rules.limit


def vanished(sign: int, rules: Rules) -> int:
    """The exponent of the zero that a product or quotient becomes when it underflows."""
    return MINUS_ZERO if rules.signed_underflow and sign < 0 else ZERO


def divide_fixed(dividend: int, divisor: int) -> tuple[int, int]:
    """A fixed-point quotient cut to a whole number, and its event; 9999 for a divisor of 0."""
    if divisor == 0:
        return 9999, FIXED_ZERO_DIVISOR
    size = abs(dividend) // abs(divisor)
    return (size if (dividend < 0) == (divisor < 0) else -size), 0

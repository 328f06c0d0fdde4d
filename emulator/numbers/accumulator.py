"""The 1620's floating accumulator (FAC): zeros, signs, overflow and underflow of its decimal operations.

Every function accepts the mantissa and exponent in FAC, then those of the other operand (see
emulator/numbers/arithmetic.py), and returns mantissa, exponent and event.  The event is 0 if there was no error.  The
events 1 to 7 are the error codes E1 to E7, which the machine typed with the result (C26-5619 p. 60; confirmed by
executing IBM's code).  These rules are defined only here: the interpreter, the compiled kernel and the port all call
these functions.

The functions use only integers and loops, so that numba can compile them.
"""

from __future__ import annotations

from emulator.numbers.arithmetic import MAX_EXPONENT, MIN_EXPONENT, MINUS_ZERO, ZERO, Rules, from_integer
from emulator.numbers.arithmetic import add as add_digits
from emulator.numbers.arithmetic import divide as divide_digits
from emulator.numbers.arithmetic import multiply as multiply_digits

# Events, numbered as the error codes E1 to E8.
SUM_OVER, SUM_UNDER, PRODUCT_OVER, PRODUCT_UNDER = range(1, 5)
QUOTIENT_OVER, QUOTIENT_UNDER, ZERO_DIVISOR, FIXED_ZERO_DIVISOR = range(5, 9)

# Mantissa, exponent and event.
State = tuple[int, int, int]


def add(ma: int, ea: int, mb: int, eb: int, rules: Rules) -> State:
    """Return the sum of the accumulator (FAC) and a number.

    The sum of two zeros is +0.  With ``rules.as_1962`` it is the zero in FAC, with the sign of that zero.
    """
    # IBM's subroutine tests for zero operands first: x + 0 is x unchanged, 0 + x is x, and profiles differ in 0 + 0.
    if mb == 0:
        if ma == 0 and not rules.as_1962:
            return 0, ZERO, 0
        return ma, ea, 0
    if ma == 0:
        return mb, eb, 0
    m, e = add_digits(ma, ea, mb, eb, rules)
    return in_range(m, e, SUM_OVER, rules)


def subtract(ma: int, ea: int, mb: int, eb: int, rules: Rules) -> State:
    """Return the accumulator (FAC) minus a number: FAC plus the negated number.  A number that is 0 is not negated."""
    return add(ma, ea, -mb, eb, rules)


def subtract_reversed(ma: int, ea: int, mb: int, eb: int, rules: Rules) -> State:
    """Return a number minus the accumulator (FAC), which the subroutine FSBR computes as -(FAC - number)."""
    # If the operands cancel, the reversal turns the zero into -0.  The thesis prints such zeros
    # (emulator/language/expressions.py).
    m, e, event = add(ma, ea, -mb, eb, rules)
    m, e = negate(m, e)
    return m, e, event


def multiply(ma: int, ea: int, mb: int, eb: int, rules: Rules) -> State:
    """Return the product of the accumulator (FAC) and a number.  A product with a zero factor is +0."""
    if ma == 0 or mb == 0:
        return 0, ZERO, 0
    m, e = multiply_digits(ma, ea, mb, eb, rules)
    return in_range(m, e, PRODUCT_OVER, rules)


def divide(ma: int, ea: int, mb: int, eb: int, rules: Rules) -> State:
    """Return the accumulator (FAC) divided by a number.  0/x is +0, and x/0 is the largest number."""
    if mb == 0:
        return largest(-1 if ma < 0 and not rules.as_1962 else 1, rules), MAX_EXPONENT, ZERO_DIVISOR
    if ma == 0:
        return 0, ZERO, 0
    m, e = divide_digits(ma, ea, mb, eb, rules)
    return in_range(m, e, QUOTIENT_OVER, rules)


def whole_power(mantissa: int, exponent: int, count: int, rules: Rules) -> State:
    """Return ``A ** J`` for an integer J by repeated multiplication, as IBM's library of 1962 computes it.

    If J is negative, the result is ``(1 / A) ** -J``.  The first operation with an error ends the computation.  For J =
    -1 to 2 the result is the exact power, truncated.
    """
    m, e = from_integer(1, rules)
    if count == 0:
        return m, e, 0
    if mantissa == 0 and count > 0:
        return 0, ZERO, 0
    event = 0
    if count < 0:
        mantissa, exponent, event = divide(m, e, mantissa, exponent, rules)
        # FORTRAN II-D reports the reciprocal as a product.
        if QUOTIENT_OVER <= event <= QUOTIENT_UNDER and not rules.as_1962:
            event += PRODUCT_OVER - QUOTIENT_OVER
    m, e = mantissa, exponent
    times = 0 if event else -count if count < 0 else count
    for done in range(1, times):
        before, e_before = m, e
        m, e = multiply_digits(m, e, mantissa, exponent, rules)
        if e > MAX_EXPONENT or e < MIN_EXPONENT:
            return in_range(m, e, PRODUCT_OVER, rules)
        # From here on only the sign of the power can change.
        if e == e_before and (m == before or m == -before):
            return (before if (times - done) % 2 == 0 else m), e, 0
    return m, e, event


def negate(m: int, e: int) -> tuple[int, int]:
    """Return the accumulator (FAC) with its sign reversed, even if it holds a zero."""
    if m == 0:
        return 0, (MINUS_ZERO if e == ZERO else ZERO)
    return -m, e


def largest(sign: int, rules: Rules) -> int:
    """Return the mantissa of the largest number of the machine, with the sign of ``sign``, which must not be 0."""
    return rules.limit - 1 if sign > 0 else 1 - rules.limit


def in_range(m: int, e: int, over: int, rules: Rules) -> State:
    """Check the range of a result.  Return it and its event: 0, ``over`` if too large, or ``over + 1`` if too small.

    A number that is too large becomes the largest number, and a number that is too small becomes a zero.  Both keep
    their sign.
    """
    if e > MAX_EXPONENT:
        return largest(m, rules), MAX_EXPONENT, over
    if e < MIN_EXPONENT and m != 0:
        return 0, (MINUS_ZERO if m < 0 else ZERO), over + 1
    return m, e, 0


def divide_fixed(dividend: int, divisor: int) -> tuple[int, int]:
    """Divide two integers.  Return the truncated quotient (9999 for x/0) and an event: 0, or the number of an error."""
    if divisor == 0:
        return 9999, FIXED_ZERO_DIVISOR
    size = abs(dividend) // abs(divisor)
    return (size if (dividend < 0) == (divisor < 0) else -size), 0

"""The library functions SIN, COS, ATAN, EXP, LOG and SQRT, and powers, in decimal arithmetic.

The result is the exact value, truncated to the profile's digits, or rounded if the profile rounds products (for SQRT:
quotients) or rounds at random.  SIN, COS, ATAN, EXP, LOG and SQRT are described in C26-5619 p. 63 and 66.  Executing
IBM's code showed that SQRT truncates the exact value.  That the other functions truncate the exact value too is an
assumption (OPEN-QUESTIONS 9).  Error codes and results for invalid arguments follow GOTRAN's table F1 to F6 (C26-5594
p. 28), and IBM FORTRAN II-D for SQRT of a negative number.
"""

from __future__ import annotations

import decimal
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache, reduce
from itertools import repeat
from operator import mul
from typing import Any

from emulator.numbers.accumulator import PRODUCT_OVER, State, in_range, whole_power
from emulator.numbers.arithmetic import MAX_EXPONENT, MIN_EXPONENT, MINUS_ZERO, ZERO, Rules, from_integer, square_root
from emulator.numbers.base import cut_decimal, decimal_length
from emulator.numbers.draws import randomly
from emulator.numbers.work import multiplied

# The number of digits that intermediate products of an integer power keep beyond those of the result, and a number of
# digits so large that the products keep all digits.
GUARD, _ALL = 20, 10**9
# The digits beyond those of the result that random rounding needs.
_RANDOM = 8

# The exponent from which the module decimal computes a chain of products faster than Python's integers.
LONG = 24


@dataclass(frozen=True, slots=True)
class Value:
    """The result of a function, and the error code that the machine types (such as "F1" or "E3") or an empty string."""

    mantissa: int
    exponent: int
    code: str = ""


@lru_cache(maxsize=4096)
def function(name: str, mantissa: int, exponent: int, rules: Rules) -> Value:
    """Compute a library function, SIN, COS, ATAN, EXP, LOG or SQRT, of a number."""
    if mantissa == 0:
        return _of_zero(name, rules)
    if name == "SQRT":
        return Value(*square_root(mantissa, exponent, rules))
    if name == "LOG" and mantissa < 0:
        value = function("LOG", -mantissa, exponent, rules)
        return Value(value.mantissa, value.exponent, "F3")
    # An angle so large that it has no digits after its point cannot be reduced (GOTRAN's error code F1).
    if name in ("SIN", "COS") and exponent > rules.digits:
        return Value(rules.limit - 1, MAX_EXPONENT, "F1")
    if name == "EXP" and exponent > 3:
        return Value(rules.limit - 1, MAX_EXPONENT, "F4") if mantissa > 0 else Value(0, ZERO, "F5")
    return _transcendental(name, mantissa, exponent, rules)


@lru_cache(maxsize=4096)
def power(base: tuple[int, int], exponent: tuple[int, int], rules: Rules) -> Value:
    """Return ``A ** B`` for a floating-point B.

    For a negative A, return ``|A| ** B`` and error code F6, as IBM's GOTRAN does.  A power of zero is computed as
    ``0 ** J``, where J is the sign of B (OPEN-QUESTIONS 8).
    """
    (mb, eb), (mx, ex) = base, exponent
    if mb == 0:
        return integer_power(0, ZERO, (mx > 0) - (mx < 0), rules)
    if mx == 0:
        return Value(*from_integer(1, rules))
    value = _power(abs(mb), eb, mx, ex, rules)
    return Value(value.mantissa, value.exponent, "F6") if mb < 0 else value


@lru_cache(maxsize=4096)
def integer_power(mantissa: int, exponent: int, count: int, rules: Rules) -> Value:
    """Return ``A ** J`` for an integer J, rounded once, or by repeated products as in 1962 (OPEN-QUESTIONS 8)."""
    if mantissa == 0 or -1 <= count <= 2 or rules.as_1962:
        by = whole_power if mantissa == 0 or abs(count) < LONG else decimal_chain
        m, e, code = by(mantissa, exponent, count, rules)
        return Value(m, e, f"E{code}" if code else "")
    size, times = abs(mantissa), abs(count)
    minus = mantissa < 0 and times % 2 == 1
    # A power far out of range may have a million digits, so it is not computed.
    far = _out_of_range(size, exponent, count, rules)
    if far > 0:
        m, e = 1, MAX_EXPONENT + 1
    elif far < 0:
        m, e = 1, MIN_EXPONENT - 1
    else:
        # Remove the zeros at the end of the base.  More powers of a base with few digits then fit into the width
        # exactly.
        zeros = len(str(size)) - len(str(size).rstrip("0"))
        m, e = _exact_power(size // 10**zeros, exponent - rules.digits + zeros, count, rules)
    value = _in_range(-m if minus else m, e, rules, "E3", "E4")
    return Value(0, MINUS_ZERO, "E4") if value.code == "E4" and minus else value


def decimal_chain(mantissa: int, exponent: int, count: int, rules: Rules) -> State:
    """Return the same result as :func:`whole_power`, computed with Python's module :mod:`decimal`.

    Like :func:`whole_power`, the module computes all digits of a product before it rounds the product.  This function
    is faster than :func:`whole_power` if the power needs many products.
    """
    m, e, event = whole_power(mantissa, exponent, -1 if count < 0 else 1, rules)
    if event:
        return m, e, event
    rounding = decimal.ROUND_HALF_UP if rules.round_products else decimal.ROUND_DOWN
    traps = [decimal.Overflow, decimal.Subnormal]
    # Decimal has one digit before the point.  A product may be too small before rounding but not after it, so that the
    # least exponent is one below the machine's.
    with decimal.localcontext(decimal.Context(rules.digits, rounding, MIN_EXPONENT - 2, MAX_EXPONENT - 1, traps=traps)):
        factor = decimal.Decimal(abs(m)).scaleb(e - rules.digits)
        try:
            power = reduce(mul, repeat(factor, abs(count) - 1), factor)
            size, e = int(power.scaleb(rules.digits - 1 - power.adjusted())), power.adjusted() + 1
        except decimal.Overflow:
            size, e = 1, MAX_EXPONENT + 1
        except decimal.Subnormal:
            size, e = 1, MIN_EXPONENT - 1
    # The sign of a result out of range depends on the number of products before it.
    if m < 0 and not MIN_EXPONENT <= e <= MAX_EXPONENT:
        return whole_power(mantissa, exponent, count, rules)
    return in_range(-size if m < 0 and count % 2 else size, e, PRODUCT_OVER, rules)


def integer_power_steps(mantissa: int, exponent: int, count: int, rules: Rules) -> int:
    """Estimate the steps that :func:`integer_power` takes, which a run counts against its limit."""
    if mantissa == 0 or -1 <= count <= 2:
        return 0
    if rules.as_1962:
        return multiplied(count)
    if _out_of_range(abs(mantissa), exponent, count, rules):
        return 0
    # The power is computed by repeated squaring, with some additional digits.
    return 2 * abs(count).bit_length()


def _out_of_range(size: int, exponent: int, count: int, rules: Rules) -> int:
    """Return 1 for a power far above the largest number, -1 for one far below the smallest, else 0."""
    decades = count * (math.log10(size) + exponent - rules.digits)
    return (decades > MAX_EXPONENT + 1) - (decades < MIN_EXPONENT - 2)


def _exact_power(size: int, power_of_ten: int, count: int, rules: Rules, width: int = 0) -> tuple[int, int]:
    """Return ``(size * 10**power_of_ten) ** count``, truncated or rounded to the digits of the rules.

    Intermediate products keep ``width`` digits, by default GUARD more than the result has.  If these digits do not
    determine the result, the power is computed again with all digits.
    """
    times, width = abs(count), width or rules.digits + GUARD
    whole, scale, error = 1, 0, 0
    # Square and multiply, from the highest bit of the exponent down.
    for bit in bin(times)[2:]:
        whole, scale = whole * whole, 2 * scale
        if bit == "1":
            whole, scale = whole * size, scale + power_of_ten
        excess = decimal_length(whole) - width
        if excess > 0:
            # A truncation loses less than the factor 1 + 10**(1 - width).  The squarings that follow raise this factor
            # to powers that add up to less than 2 * times.  The number, which is below 10**width, is therefore too
            # small by less than 20 * times plus terms of the second order, which 21 covers.
            whole, scale, error = whole // 10**excess, scale + excess, 21 * times
    bounds = [whole, whole + error]
    if count < 0:
        # A reciprocal may have infinitely many digits.  Its first P + 2 digits determine the P + 1 digits that _cut
        # needs.
        digits = decimal_length(whole) + rules.digits + GUARD
        bounds, scale = [10**digits // bound for bound in bounds], -scale - digits
    first, second = (_cut(bound, scale, rules) for bound in bounds)
    return first if first == second else _exact_power(size, power_of_ten, count, rules, _ALL)


def _of_zero(name: str, rules: Rules) -> Value:
    if name in ("COS", "EXP"):
        return Value(*from_integer(1, rules))
    if name == "LOG":
        return Value(-(rules.limit - 1), MAX_EXPONENT, "F2")
    return Value(0, ZERO)


def _transcendental(name: str, mantissa: int, exponent: int, rules: Rules) -> Value:
    def compute(context: Any) -> Any:
        return getattr(context, name.lower())(context.mpf(mantissa) * context.mpf(10) ** (exponent - rules.digits))

    # Reducing a large angle loses as many digits as it has before the point.
    return _cut_value(compute, rules, max(exponent, 0) if name in ("SIN", "COS") else 0)


def _power(mb: int, eb: int, mx: int, ex: int, rules: Rules) -> Value:
    def logarithm(context: Any) -> Any:
        log = context.log(context.mpf(mb) * context.mpf(10) ** (eb - rules.digits))
        return log * context.mpf(mx) * context.mpf(10) ** (ex - rules.digits)

    # Decide overflow and underflow before the exponential is computed.
    rough = logarithm(_context(30))
    if abs(rough) > 1000:
        return Value(rules.limit - 1, MAX_EXPONENT, "F4") if rough > 0 else Value(0, ZERO, "F5")
    return _cut_value(lambda context: context.exp(logarithm(context)), rules, 10)


@lru_cache(maxsize=256)
def _context(digits: int) -> Any:
    from mpmath import MPContext  # not at the top, because most programs use none of these functions

    context = MPContext()
    context.dps = digits
    return context


def _cut_value(compute: Callable[[Any], Any], rules: Rules, more: int) -> Value:
    """Compute a value with increasing precision until its first P digits are certain (Ziv's strategy).

    ``more`` is the number of additional digits that compensate for the rounding errors of the computation.  If 200
    extra digits do not decide the rounding, the value is assumed to equal a P-digit number exactly.
    """
    from mpmath.libmp import to_digits_exp

    # These digits decide the rounding, unless all digits after them are zeros or all are nines.
    decisive = rules.digits + (_RANDOM if rules.random else 0)
    extra = 15
    while True:
        context = _context(rules.digits + extra + more)
        value = compute(context)
        if not value:
            return Value(0, ZERO)
        sign, digits, exponent = to_digits_exp(value._mpf_, context.dps)
        # The last six digits may be wrong, so they are ignored.
        tail = digits[decisive:-6]
        if tail.strip("0") and tail.strip("9"):
            size = int(digits)
            break
        if extra > 200:
            size = int(digits[:decisive]) + (digits[decisive] == "9")
            digits = digits[:decisive]
            break
        extra *= 2
    number, power_of_ten = (-size if sign else size), exponent + 1 - len(digits)
    return _in_range(*_cut(number, power_of_ten, rules), rules, "F4", "F5")


def _cut(number: int, power_of_ten: int, rules: Rules) -> tuple[int, int]:
    """Return ``number * 10**power_of_ten`` as mantissa and exponent, with P digits, rounded as products are."""
    extra = _RANDOM if rules.random else 1
    size, exponent = cut_decimal(abs(number), power_of_ten, rules.digits + extra)
    if rules.random:
        is_lost = size * 10 ** max(decimal_length(number) - rules.digits - extra, 0) < abs(number)
        mantissa = randomly(size, 10**extra, int(is_lost), rules.random, rules.draw)
    else:
        mantissa = (size + 5) // 10 if rules.round_products else size // 10
    if mantissa >= rules.limit:
        mantissa, exponent = mantissa // 10, exponent + 1
    return (mantissa if number > 0 else -mantissa), exponent


def _in_range(mantissa: int, exponent: int, rules: Rules, over: str, under: str) -> Value:
    if mantissa and exponent > MAX_EXPONENT:
        return Value(rules.limit - 1 if mantissa > 0 else -(rules.limit - 1), MAX_EXPONENT, over)
    if mantissa and exponent < MIN_EXPONENT:
        return Value(0, ZERO, under)
    return Value(mantissa, exponent)

"""Library functions and powers: the exact value, cut to the profile's digits (rounded where products are rounded).

SIN, COS, ATAN, EXP, LOG, SQRT: C26-5619 p. 63, 66.  That the result is the exact one cut is executed for
SQRT and a choice for the others (OPEN-QUESTIONS 9); what is typed and delivered for impossible arguments
follows GOTRAN's table F1 to F6 (C26-5594 p. 28) and IBM FORTRAN II-D for SQRT of a negative number.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from emulator.numbers import work
from emulator.numbers.arithmetic import (
    MAX_EXPONENT,
    MIN_EXPONENT,
    MINUS_ZERO,
    ZERO,
    Rules,
    from_integer,
    square_root,
    whole_power,
)
from emulator.numbers.base import cut_decimal, decimal_length


@dataclass(frozen=True, slots=True)
class Value:
    """A function's result and the error code typed for it, if any ("F1" to "F6", "E3", ...)."""

    mantissa: int
    exponent: int
    code: str = ""


@lru_cache(maxsize=4096)
def function(name: str, mantissa: int, exponent: int, rules: Rules) -> Value:
    """SIN, COS, ATAN, EXP, LOG or SQRT of a number."""
    if name == "SQRT":
        return _sqrt(mantissa, exponent, rules)
    if mantissa == 0:
        return _of_zero(name, rules)
    if name == "LOG" and mantissa < 0:
        value = function("LOG", -mantissa, exponent, rules)
        return Value(value.mantissa, value.exponent, "F3")
    if name in ("SIN", "COS") and exponent > rules.digits:
        return Value(rules.limit - 1, MAX_EXPONENT, "F1")
    if name == "EXP" and exponent > 3:
        return Value(rules.limit - 1, MAX_EXPONENT, "F4") if mantissa > 0 else Value(0, ZERO, "F5")
    return _transcendental(name, mantissa, exponent, rules)


@lru_cache(maxsize=4096)
def power(base: tuple[int, int], exponent: tuple[int, int], rules: Rules) -> Value:
    """``A ** B`` with a floating exponent; |A| ** B and F6 for a negative base, as GOTRAN does.

    Powers of zero are those of ``A ** J``: OPEN-QUESTIONS 8.
    """
    (mb, eb), (mx, ex) = base, exponent
    if mb == 0:
        return integer_power(0, ZERO, (mx > 0) - (mx < 0), rules)
    if mx == 0:
        return Value(*from_integer(1, rules))
    value = _power(abs(mb), eb, mx, ex, rules)
    return Value(value.mantissa, value.exponent, "F6") if mb < 0 else value


def integer_power(mantissa: int, exponent: int, count: int, rules: Rules) -> Value:
    """``A ** J``: the exact power cut, or multiplied out where the profile says so (OPEN-QUESTIONS 8)."""
    if mantissa == 0 or -1 <= count <= 2 or rules.powers_multiply:
        m, e, code = whole_power(mantissa, exponent, count, rules)
        return Value(m, e, f"E{code}" if code else "")
    size, times = abs(mantissa), abs(count)
    minus = mantissa < 0 and times % 2 == 1
    far = _far(size, exponent, count, rules)
    if far > 0:
        m, e = 1, MAX_EXPONENT + 1
    elif far < 0:
        m, e = 1, MIN_EXPONENT - 1
    else:
        m, e = _exact_power(size, exponent - rules.digits, count, rules)
    value = _in_range(-m if minus else m, e, rules, "E3", "E4")
    return Value(0, MINUS_ZERO, "E4") if value.code == "E4" and minus else value


def integer_power_steps(mantissa: int, exponent: int, count: int, rules: Rules) -> int:
    """Steps of :func:`integer_power` (:mod:`emulator.numbers.work`)."""
    if mantissa == 0 or -1 <= count <= 2:
        return 0
    if rules.powers_multiply:
        return work.multiplied(count)
    if _far(abs(mantissa), exponent, count, rules):
        return 0
    bits = mantissa.bit_length() * abs(count)
    return work.product(bits, bits)


def _far(size: int, exponent: int, count: int, rules: Rules) -> int:
    """1 for a power far beyond the largest number, -1 for one far below the least: it may have a million digits."""
    decades = count * (math.log10(size) + exponent - rules.digits)
    return (decades > MAX_EXPONENT + 1) - (decades < MIN_EXPONENT - 2)


def _exact_power(size: int, power_of_ten: int, count: int, rules: Rules) -> tuple[int, int]:
    """``(size * 10**power_of_ten) ** count`` cut to the digits of the rules, or rounded where products are."""
    whole, scale = size ** abs(count), power_of_ten * abs(count)
    if count < 0:
        # So many digits of the reciprocal that its cut is the exact one's: a quotient's further digits are lost.
        more = decimal_length(whole) + rules.digits + 1
        whole, scale = 10**more // whole, -scale - more
    kept, exponent = cut_decimal(whole, scale, rules.digits + 1)
    kept, last = divmod(kept, 10)
    if rules.round_products and last >= 5:
        kept += 1
    return (kept // 10, exponent + 1) if kept >= rules.limit else (kept, exponent)


def _sqrt(mantissa: int, exponent: int, rules: Rules) -> Value:
    return Value(*square_root(mantissa, exponent, rules)) if mantissa else Value(0, ZERO)


def _of_zero(name: str, rules: Rules) -> Value:
    if name in ("COS", "EXP"):
        return Value(*from_integer(1, rules))
    if name == "LOG":
        return Value(-(rules.limit - 1), MAX_EXPONENT, "F2")
    return Value(0, ZERO)


def _transcendental(name: str, mantissa: int, exponent: int, rules: Rules) -> Value:
    def compute(context: Any) -> Any:
        return getattr(context, name.lower())(context.mpf(mantissa) * context.mpf(10) ** (exponent - rules.digits))

    # The digits before the point are lost when an angle is reduced.
    return _cut_value(compute, rules, max(exponent, 0) if name in ("SIN", "COS") else 0)


def _power(mb: int, eb: int, mx: int, ex: int, rules: Rules) -> Value:
    def logarithm(context: Any) -> Any:
        log = context.log(context.mpf(mb) * context.mpf(10) ** (eb - rules.digits))
        return log * context.mpf(mx) * context.mpf(10) ** (ex - rules.digits)

    rough = logarithm(_context(30))
    if abs(rough) > 1000:
        return Value(rules.limit - 1, MAX_EXPONENT, "F4") if rough > 0 else Value(0, ZERO, "F5")
    return _cut_value(lambda context: context.exp(logarithm(context)), rules, 10)


@lru_cache(maxsize=256)
def _context(digits: int) -> Any:
    from mpmath import MPContext  # imported late: most programs use none of these functions

    context = MPContext()
    context.dps = digits
    return context


def _cut_value(compute: Callable[[Any], Any], rules: Rules, more: int) -> Value:
    """The value cut to P digits, computed with more and more digits until the cut is certain."""
    extra = 15
    while True:
        context = _context(rules.digits + extra + more)
        value = compute(context)
        result = _cut_exactly(context, value, rules)
        if result is None and extra > 200:
            result = _nearest(context, value, rules)
        if result is not None:
            return _in_range(*result, rules, "F4", "F5")
        extra *= 2


def _digits(value: Any, context: Any) -> tuple[int, int]:
    """An mpf as a whole number of many digits and a power of ten."""
    text = context.nstr(value, context.dps, strip_zeros=False, min_fixed=1, max_fixed=0)
    body, _, power_text = text.partition("e")
    sign = -1 if body.startswith("-") else 1
    whole, _, fraction = body.lstrip("-").partition(".")
    return sign * int(whole + fraction), int(power_text or 0) - len(fraction)


def _cut_exactly(context: Any, value: Any, rules: Rules) -> tuple[int, int] | None:
    """The value cut to P digits, or None when the digits after those are all nines or all zeros (too close to say)."""
    if not value:
        return 0, ZERO
    number, power_of_ten = _digits(value, context)
    text = str(abs(number))
    tail = text[rules.digits : -6]
    if tail.strip("0") == "" or tail.strip("9") == "":
        return None
    return _cut(number, power_of_ten, rules)


def _nearest(context: Any, value: Any, rules: Rules) -> tuple[int, int]:
    """For a value that is exactly (or within 10**-200 of) a P-digit number: that number."""
    number, power_of_ten = _digits(value, context)
    text = str(abs(number))
    exponent = power_of_ten + len(text)
    kept = int(text[: rules.digits]) + (text[rules.digits] == "9")
    if kept >= rules.limit:
        kept, exponent = kept // 10, exponent + 1
    return (kept if number > 0 else -kept), exponent


def _cut(size: int, power_of_ten: int, rules: Rules) -> tuple[int, int]:
    """A whole number of more than P digits times a power of ten: cut to P, or rounded where products are."""
    text = str(abs(size))
    kept, exponent = int(text[: rules.digits]), power_of_ten + len(text)
    if rules.round_products and text[rules.digits] >= "5":
        kept += 1
    if kept >= rules.limit:
        kept, exponent = kept // 10, exponent + 1
    return (kept if size > 0 else -kept), exponent


def _in_range(mantissa: int, exponent: int, rules: Rules, over: str, under: str) -> Value:
    if mantissa and exponent > MAX_EXPONENT:
        return Value(rules.limit - 1 if mantissa > 0 else -(rules.limit - 1), MAX_EXPONENT, over)
    if mantissa and exponent < MIN_EXPONENT:
        return Value(0, ZERO, under)
    return Value(mantissa, exponent)

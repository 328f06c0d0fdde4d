"""Decimal floating point as the 1620's subroutines computed it, in functions of integers with the rules of a profile.

A number is a pair (mantissa, exponent) with the value ``mantissa * 10**(exponent - P)``.  The mantissa has P digits,
the first of which is not zero, and the exponent is an integer from -99 to +99 (C26-5619 p. 13, 38).  The decimal point
stands before the first digit.  Zero is (0, -99), as it is printed.  Minus zero, which the machine marked with a flag,
is (0, MINUS_ZERO).  A field in which nothing was stored is (0, UNDEFINED).  A field with a fixed-point number holds its
value and the exponent FIXED_POINT.  The operations here may return an exponent out of range, which
emulator/numbers/accumulator.py then handles.

The functions use only integers and loops, so that numba can compile them, and ``rules`` is a tuple of integers for
the same reason.  The comments on :data:`PROFILES` give the source of each rule.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from emulator.errors import ArgumentError, expect, quoted
from emulator.numbers.draws import CESTAC, DRAWS, PROPORTIONAL, draw, randomly

ZERO = -99
MINUS_ZERO = -100
FIXED_POINT = 998
UNDEFINED = 999
MAX_EXPONENT = 99
MIN_EXPONENT = -99

MIN_DIGITS, MAX_DIGITS = 2, 28


class Rules(NamedTuple):
    """The rules of a decimal arithmetic.  Every field is an integer, because compiled code uses them too.

    The fields from ``sticky`` to ``as_1962`` are flags, 0 or 1.

    - ``digits``: the number of digits of a mantissa, P.
    - ``limit``: ``10**P``, one more than the largest mantissa.
    - ``least``: ``10**(P - 1)``, the smallest normalized mantissa.
    - ``guard``: the number of digits beyond P that the smaller operand of a sum keeps.
    - ``sticky``: rounding takes into account whether the smaller operand has nonzero digits beyond the guard digits.
    - ``round_sums``, ``round_products``, ``round_quotients``: round the result half up instead of truncating it.
    - ``as_1962``: signs of zeros, whole powers, conversions to fixed point, input, output and error codes follow IBM's
      library of 1962 (docs/reference/ibm-library.md) instead of FORTRAN II-D.

    - ``random``, ``key``, ``draw``: the rule of random rounding or 0, the key of the seed, and the random number of the
      current operation (:mod:`emulator.numbers.draws`).
    """

    digits: int
    limit: int
    least: int
    guard: int
    sticky: int
    round_sums: int
    round_products: int
    round_quotients: int
    as_1962: int
    random: int = 0
    key: int = 0
    draw: int = 0


def drawn(rules: Rules, count: int) -> Rules:
    """Return a copy of the rules with the random number for operation ``count`` of a run, counted from 1."""
    digits, limit, least, guard, sticky, sums, products, quotients, as_1962, random, key, _ = rules
    number = draw(key, count)
    return Rules(digits, limit, least, guard, sticky, sums, products, quotients, as_1962, random, key, number)


class MinusZero(int):
    """The fixed-point number minus zero, which only the arithmetic of IBM's library of 1962 produces."""


FIXED_MINUS_ZERO = MinusZero()


def signed_zero(negative: bool) -> int:
    """Return the fixed-point zero, or minus zero if ``negative``."""
    return FIXED_MINUS_ZERO if negative else 0


def is_negative(value: int) -> bool:
    """Return True if a fixed-point number has a minus sign."""
    return value < 0 or isinstance(value, MinusZero)


def add(ma: int, ea: int, mb: int, eb: int, rules: Rules) -> tuple[int, int]:
    """Return the sum of two numbers that are not zero.

    The operand with the smaller exponent is shifted right *before* the addition and loses all digits that are shifted
    out.  :func:`add_guarded` keeps some of them.
    """
    if rules.guard:
        return add_guarded(ma, ea, mb, eb, rules)
    if ea < eb:
        ma, ea, mb, eb = mb, eb, ma, ea
    shift = ea - eb
    # The smaller operand loses all of its digits.
    if shift >= rules.digits:
        return ma, ea
    # Truncate toward zero: // alone would round negative numbers down.
    if shift:
        mb = mb // 10**shift if mb > 0 else -(-mb // 10**shift)
    total = ma + mb
    if total == 0:
        return 0, ZERO
    # Normalize: remove the extra digit of a carry or the leading zeros of a cancellation.  Zeros fill the right end,
    # where guard digits would have kept digits of the smaller operand.
    size = total if total > 0 else -total
    if size >= rules.limit:
        size = size // 10
        ea += 1
    while size < rules.least:
        size *= 10
        ea -= 1
    return (size if total > 0 else -size), ea


def add_guarded(ma: int, ea: int, mb: int, eb: int, rules: Rules) -> tuple[int, int]:
    """Return the sum of two numbers that are not zero, computed with ``guard`` digits beyond P.

    With ``sticky``, rounding takes into account whether the dropped digits were zero, so that the sum is rounded like
    the exact sum.
    """
    digits, base, guard, sticky, rounding = rules.digits, rules.limit, rules.guard, rules.sticky, rules.round_sums
    if ea < eb:
        ma, ea, mb, eb = mb, eb, ma, ea
    shift = ea - eb
    negative = ma < 0
    same = (mb < 0) == negative
    size = (-ma if negative else ma) * 10**guard
    addend = -mb if mb < 0 else mb
    # Align the smaller operand to P + guard digits and note whether digits were lost.
    lost = 0
    if shift <= guard:
        addend = addend * 10 ** (guard - shift)
    elif shift - guard > digits:
        lost = 1
        addend = 0
    else:
        unit = 10 ** (shift - guard)
        lost = 1 if addend % unit else 0
        addend = addend // unit
    if same:
        size += addend
    else:
        # The lost digits are a positive fraction of the subtrahend, so the exact difference is smaller than this one.
        size -= addend
        if sticky and lost:
            size -= 1
    if size == 0:
        return 0, ZERO
    if size < 0:
        size = -size
        negative = not negative
    # Normalize to P + guard digits (or one more after a carry), then truncate or round half up to P digits.
    wide = base * 10**guard
    while size < wide // 10:
        size *= 10
        ea -= 1
    unit = 10**guard
    if size >= wide:
        unit *= 10
        ea += 1
    if rules.random:
        size = randomly(size, unit, lost, rules.random, rules.draw)
    else:
        size = (size + unit // 2) // unit if rounding else size // unit
    if size >= base:
        size = size // 10
        ea += 1
    return (-size if negative else size), ea


def multiply(ma: int, ea: int, mb: int, eb: int, rules: Rules) -> tuple[int, int]:
    """Return the product of two numbers that are not zero, truncated or rounded half up in magnitude."""
    base, low = rules.limit, rules.least
    product = ma * mb
    size = product if product > 0 else -product
    exponent = ea + eb
    # A product of two P-digit mantissas has 2P digits, or 2P - 1.
    if size >= base * low:
        unit = base
    else:
        unit = low
        exponent -= 1
    if rules.random:
        size = randomly(size, unit, 0, rules.random, rules.draw)
    else:
        size = (size + unit // 2) // unit if rules.round_products else size // unit
    if size >= base:
        size = size // 10
        exponent += 1
    return (size if product > 0 else -size), exponent


def divide(ma: int, ea: int, mb: int, eb: int, rules: Rules) -> tuple[int, int]:
    """Return the quotient of two numbers that are not zero, truncated or rounded half up in magnitude."""
    base, low = rules.limit, rules.least
    size = ma if ma > 0 else -ma
    by = mb if mb > 0 else -mb
    exponent = ea - eb
    # Scale the dividend so that the integer quotient has exactly P digits.
    if size >= by:
        size = size * low
        exponent += 1
    else:
        size = size * base
        # The library of 1962 subtracts one from the exponent of such a dividend, and -99 then loses its minus sign.
        if rules.as_1962 and ea == MIN_EXPONENT:
            exponent = MAX_EXPONENT + 1 - eb
    quotient = randomly(size, by, 0, rules.random, rules.draw) if rules.random else size // by
    if rules.round_quotients and 2 * (size - quotient * by) >= by:
        # Rounding cannot carry to P + 1 digits.  A quotient of all nines would need size/by above 1 - 1/base, but both
        # are integers below base.
        quotient += 1
    return (quotient if (ma > 0) == (mb > 0) else -quotient), exponent


def from_integer(value: int, rules: Rules) -> tuple[int, int]:
    """Convert an integer to floating point.  Digits beyond the first P are dropped."""
    if value == 0:
        return 0, ZERO
    size = value if value > 0 else -value
    exponent = rules.digits
    while size < rules.least:
        size *= 10
        exponent -= 1
    while size >= rules.limit:
        size = size // 10
        exponent += 1
    return (size if value > 0 else -size), exponent


def to_integer(mantissa: int, exponent: int, rules: Rules) -> int:
    """Convert a floating-point number to an integer: its sign and the four digits left of the point (p. 21)."""
    if exponent <= 0:
        return 0
    size: int = mantissa if mantissa > 0 else -mantissa
    digits = rules.digits
    # If the number is a multiple of 10**4, its four digits left of the point are zeros.
    if exponent <= digits:
        size = size // 10 ** (digits - exponent)
    elif not rules.as_1962:
        size = size * 10 ** (exponent - digits) if exponent - digits < 4 else 0
    size = size % 10000
    return size if mantissa > 0 else -size


def wrap_integer(value: int) -> int:
    """Truncate an integer to four digits and its sign, as the 1620 stores it (C26-5619 p. 14; IBM's code at 02644)."""
    return value % 10000 if value >= 0 else -(-value % 10000)


def square_root(mantissa: int, exponent: int, rules: Rules) -> tuple[int, int]:
    """Return the square root of the magnitude of a number that is not zero, truncated or rounded as quotients are."""
    size = mantissa if mantissa > 0 else -mantissa
    # Write the number as an integer of 2P-1 or 2P digits times an even power of ten, whose root has P digits.
    power = exponent - 2 * rules.digits
    if power % 2:
        power += 1
        size *= rules.least
    else:
        size *= rules.limit
    # Newton's iteration for the integer square root, from above: it decreases until it reaches the root's floor.
    root = rules.limit
    better = (root + size // root) // 2
    while better < root:
        root = better
        better = (root + size // root) // 2
    exponent = power // 2 + rules.digits
    # Round up if size > (root + 1/2)**2, that is if size - root**2 > root: equality is impossible for integers.
    rest = size - root * root
    up = rules.round_quotients and rest > root
    if rules.random and rest:
        # By the proportional rule, round up if size > (root + t)**2, where t is the draw as a fraction.
        up = (2 * rules.draw >= DRAWS) == (rules.random == CESTAC)
        if rules.random == PROPORTIONAL:
            up = rest * DRAWS - 2 * root * rules.draw > rules.draw * rules.draw // DRAWS
    if up:
        root += 1
        if root >= rules.limit:
            root = root // 10
            exponent += 1
    return root, exponent


@dataclass(frozen=True, slots=True)
class Profile:
    """A decimal arithmetic: its name, and its rules for truncation and rounding."""

    name: str
    rules: Rules

    @property
    def digits(self) -> int:
        return self.rules.digits


def rules_of(
    digits: int, guard: int = 0, sticky: int = 0, sums: int = 0, products: int = 0, quotients: int = 0, as_1962: int = 0
) -> Rules:
    """Return rules with the given number of digits.  By default, results are truncated as in FORTRAN II-D."""
    low = 10 ** (digits - 1)
    return Rules(digits, 10 * low, low, guard, sticky, sums, products, quotients, as_1962)


# Thesis p. 116: eight digits, no rounding occurs.  Signs of zeros are as the thesis prints them.  Signs of results that
# underflow or are divided by zero, and integer powers, are those of IBM FORTRAN II-D, executed in a simulator.
TRUNCATING = Profile("truncating", rules_of(8))
# IBM's library of 1962, executed digit by digit in a simulator: products are rounded half up, other results truncated.
IBM1962 = Profile("ibm1962", rules_of(8, products=1, as_1962=1))
# Thesis p. 116 (no rounding occurs), and IBM's library of 1962 for everything about which the thesis is silent.
TRUNCATING1962 = Profile("truncating1962", rules_of(8, as_1962=1))
PROFILES = {profile.name: profile for profile in (TRUNCATING, IBM1962, TRUNCATING1962)}


# The families of profiles with any number of digits P, and the rules of each as arguments of ``rules_of``.
_FAMILIES: dict[str, dict[str, int]] = {
    "truncating": {},
    # As truncating, with a guard digit in sums.
    "guarded": {"guard": 1},
    # The exact result, rounded half up.
    "rounding": {"guard": 2, "sticky": 1, "sums": 1, "products": 1, "quotients": 1},
}
FAMILIES = tuple(f"{family}:P" for family in _FAMILIES)


def size_in(name: str, count: str, least: int, most: int, unit: str) -> int:
    """Convert ``count``, the number of digits or bits in the name of an arithmetic, to an integer.

    Raise ArgumentError if it is not an integer from ``least`` to ``most``.  ``unit`` is the word for digits or bits in
    the message.
    """
    if not (count.isdecimal() and count.isascii() and len(count) < 10 and least <= int(count) <= most):
        raise ArgumentError(f"{name[:40]}: the number of {unit} must be {least} to {most}")
    return int(count)


def profile(name: str) -> Profile:
    """Return the decimal arithmetic with this name: one of PROFILES, or a family and its number of
    digits P, such as ``rounding:8``.

    ``guarded:P`` differs from ``truncating:P`` in sums only: the smaller operand keeps one more digit during the
    addition.  In ``rounding:P``, the result of + - * / is the exact result, rounded half up in magnitude.  Raise
    ArgumentError for any other name.
    """
    expect(name, str, "name")
    if name in PROFILES:
        return PROFILES[name]
    family, colon, count = name.partition(":")
    if not (colon and family in _FAMILIES and count.isdecimal() and count.isascii()):
        raise ArgumentError(
            f"no arithmetic is called {quoted(name)}; the names are {', '.join((*PROFILES, *FAMILIES))}"
        )
    digits = size_in(name, count, MIN_DIGITS, MAX_DIGITS, "digits")
    return Profile(name, rules_of(digits, **_FAMILIES[family]))

"""Decimal floating point as the 1620's subroutines did it: pure functions on integers under named profiles.

A number is a pair (mantissa, exponent) of value ``mantissa * 10**(exponent - P)``: P digits after the
point, the first not zero, exponent -99 to +99 (C26-5619 p. 13, 38).  Zero is (0, -99), as it is printed;
minus zero, which the machine kept as a flag, is (0, MINUS_ZERO); a field nothing was stored in is
(0, UNDEFINED).  A field that holds a fixed-point number has its value and the exponent FIXED_POINT.
Operations return an exponent that may lie out of range: emulator/numbers/accumulator.py decides what then.

The functions use only what a compiler of integer loops accepts; ``rules`` is a tuple of integers for that reason.
Where each rule was obtained stands with :data:`PROFILES`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

ZERO = -99
MINUS_ZERO = -100
FIXED_POINT = 998
UNDEFINED = 999
MAX_EXPONENT = 99
MIN_EXPONENT = -99

MIN_DIGITS, MAX_DIGITS = 2, 28


class Rules(NamedTuple):
    """The rules of a decimal arithmetic. Every field is an integer, because compiled code uses them too.

    The flags, 0 or 1, begin with ``sticky``.

    digits: digits of a mantissa.  limit: ``10**digits``, which every mantissa is less than.  least:
    ``10**(digits - 1)``, the least normalized mantissa.  guard: digits of the smaller operand of a sum that are kept
    beyond the last.  sticky: the digits lost beyond these still count as a fraction.  round_sums, round_products,
    round_quotients: the result is rounded half up, not truncated.  keeps_left_zero: zero plus zero keeps the sign of
    FAC's zero.  signed_underflow: a product or quotient that underflows keeps its sign; signed_sums: so does a sum.
    signed_by_zero: a number divided by zero keeps its sign.  powers_multiply: an integer power is computed by repeated
    multiplication, truncating each product; otherwise the exact power is truncated once.
    """

    digits: int
    limit: int
    least: int
    guard: int
    sticky: int
    round_sums: int
    round_products: int
    round_quotients: int
    keeps_left_zero: int
    signed_underflow: int
    signed_sums: int
    signed_by_zero: int
    powers_multiply: int


def add(ma: int, ea: int, mb: int, eb: int, rules: Rules) -> tuple[int, int]:
    """Sum of two numbers, neither zero.

    The operand of smaller exponent is moved right and its digits drop off *before* the addition, all of them or, in
    :func:`add_guarded`, those beyond some more.
    """
    if rules.guard:
        return add_guarded(ma, ea, mb, eb, rules)
    if ea < eb:
        ma, ea, mb, eb = mb, eb, ma, ea
    shift = ea - eb
    if shift >= rules.digits:
        return ma, ea
    if shift:
        mb = mb // 10**shift if mb > 0 else -(-mb // 10**shift)
    total = ma + mb
    if total == 0:
        return 0, ZERO
    size = total if total > 0 else -total
    if size >= rules.limit:
        size = size // 10
        ea += 1
    while size < rules.least:
        size *= 10
        ea -= 1
    return (size if total > 0 else -size), ea


def add_guarded(ma: int, ea: int, mb: int, eb: int, rules: Rules) -> tuple[int, int]:
    """The same where of the digits beyond P ``guard`` survive the addition (rounding a sum needs one).

    With ``sticky`` the lost part still counts as a fraction, so that the rounding which follows is that of the exact
    sum.
    """
    digits, base, guard, sticky, rounding = rules.digits, rules.limit, rules.guard, rules.sticky, rules.round_sums
    if ea < eb:
        ma, ea, mb, eb = mb, eb, ma, ea
    shift = ea - eb
    negative = ma < 0
    same = (mb < 0) == negative
    size = (-ma if negative else ma) * 10**guard
    other = -mb if mb < 0 else mb
    lost = 0
    if shift <= guard:
        other = other * 10 ** (guard - shift)
    elif shift - guard > digits:
        lost = 1
        other = 0
    else:
        unit = 10 ** (shift - guard)
        lost = 1 if other % unit else 0
        other = other // unit
    if same:
        size += other
    else:
        size -= other
        if sticky and lost:
            size -= 1
    if size == 0:
        return 0, ZERO
    if size < 0:
        size = -size
        negative = not negative
    wide = base * 10**guard
    while size < wide // 10:
        size *= 10
        ea -= 1
    unit = 10**guard
    if size >= wide:
        unit *= 10
        ea += 1
    size = (size + unit // 2) // unit if rounding else size // unit
    if size >= base:
        size = size // 10
        ea += 1
    return (-size if negative else size), ea


def multiply(ma: int, ea: int, mb: int, eb: int, rules: Rules) -> tuple[int, int]:
    """Product of two numbers, neither zero: all 2P digits, then cut or rounded half up in magnitude."""
    base, low = rules.limit, rules.least
    product = ma * mb
    size = product if product > 0 else -product
    exponent = ea + eb
    if size >= base * low:
        unit = base
    else:
        unit = low
        exponent -= 1
    if rules.round_products:
        size = (size + unit // 2) // unit
        if size >= base:
            size = size // 10
            exponent += 1
    else:
        size = size // unit
    return (size if product > 0 else -size), exponent


def divide(ma: int, ea: int, mb: int, eb: int, rules: Rules) -> tuple[int, int]:
    """Quotient of two numbers, neither zero, cut or rounded half up in magnitude."""
    base, low = rules.limit, rules.least
    size = ma if ma > 0 else -ma
    by = mb if mb > 0 else -mb
    exponent = ea - eb
    if size >= by:
        size = size * low
        exponent += 1
    else:
        size = size * base
    quotient = size // by
    if rules.round_quotients and 2 * (size - quotient * by) >= by:
        # No carry to P + 1 digits: the quotient is at most base - 1 exactly, or below base - 1 as 1 < base / by.
        quotient += 1
    return (quotient if (ma > 0) == (mb > 0) else -quotient), exponent


def from_integer(value: int, rules: Rules) -> tuple[int, int]:
    """A fixed-point number as floating point; exact when it has at most P digits, else its first P digits."""
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
    """Floating point to fixed: the four digits just left of the point, with the sign (C26-5619 p. 21)."""
    if exponent <= 0:
        return 0
    size: int = mantissa if mantissa > 0 else -mantissa
    digits = rules.digits
    if exponent <= digits:
        size = size // 10 ** (digits - exponent)
    elif exponent - digits < 4:
        size = size * 10 ** (exponent - digits)
    else:
        return 0
    size = size % 10000
    return size if mantissa > 0 else -size


def wrap_integer(value: int) -> int:
    """Fixed-point results keep four digits and their sign (C26-5619 p. 14; executed on IBM's code at 02644)."""
    return value % 10000 if value >= 0 else -(-value % 10000)


def square_root(mantissa: int, exponent: int, rules: Rules) -> tuple[int, int]:
    """Square root of a number not zero, its sign dropped, cut or rounded half up as products are."""
    size = mantissa if mantissa > 0 else -mantissa
    # As a whole number of 2P-1 or 2P digits times an even power of ten.
    power = exponent - 2 * rules.digits
    if power % 2:
        power += 1
        size *= rules.least
    else:
        size *= rules.limit
    root = rules.limit
    better = (root + size // root) // 2
    while better < root:
        root = better
        better = (root + size // root) // 2
    exponent = power // 2 + rules.digits
    # Above the half exactly when the rest is more than the root: (r+1/2)**2 is never whole.
    if rules.round_products and size - root * root > root:
        root += 1
        if root >= rules.limit:
            root = root // 10
            exponent += 1
    return root, exponent


def whole_power(mantissa: int, exponent: int, count: int, rules: Rules) -> tuple[int, int, int]:
    """``A ** J`` by repeated multiplication, each product cut as the profile cuts it: the exact power for J = -1 to 2.

    The third number is that of the error code E3 (overflow), E4 (underflow) or E7 (a negative power of zero),
    or 0; the result is in range.
    """
    one, ones = from_integer(1, rules)
    if count == 0:
        return one, ones, 0
    if mantissa == 0:
        return (0, ZERO, 0) if count > 0 else (rules.limit - 1, MAX_EXPONENT, 7)
    size = mantissa if mantissa > 0 else -mantissa
    times = count if count > 0 else -count
    m, e = size, exponent
    for _ in range(times - 1):
        m_before, e_before = m, e
        m, e = multiply(m, e, size, exponent, rules)
        if m == m_before and e == e_before:
            break
        if e > MAX_EXPONENT + 1 or e < MIN_EXPONENT - 1:
            break
    if count < 0:
        if MIN_EXPONENT - 1 <= e <= MAX_EXPONENT + 1:
            m, e = divide(one, ones, m, e, rules)
        else:
            e = -e
    if mantissa < 0 and times % 2 == 1:
        m = -m
    if e > MAX_EXPONENT:
        return (rules.limit - 1 if m > 0 else -(rules.limit - 1)), MAX_EXPONENT, 3
    if e < MIN_EXPONENT:
        return 0, (MINUS_ZERO if rules.signed_underflow and m < 0 else ZERO), 4
    return m, e, 0


@dataclass(frozen=True, slots=True)
class Profile:
    """An arithmetic: how many digits, what each operation does with the digits it cannot keep, what is typed.

    ``announces``: every error of the arithmetic types its code (emulator.errors.explanations).
    """

    name: str
    source: str
    rules: Rules
    announces: bool = False

    @property
    def digits(self) -> int:
        return self.rules.digits


def rules_of(
    digits: int,
    guard: int = 0,
    sticky: int = 0,
    sums: int = 0,
    products: int = 0,
    quotients: int = 0,
    *,
    left_zero: int = 0,
    signed_sums: int = 1,
    signed_by_zero: int = 1,
    powers_multiply: int = 0,
) -> Rules:
    """Rules of that many digits; what is not said is cut, and zeros and nines have signs as under II-D."""
    low = 10 ** (digits - 1)
    rounding = guard, sticky, sums, products, quotients
    return Rules(digits, 10 * low, low, *rounding, left_zero, 1, signed_sums, signed_by_zero, powers_multiply)


TRUNCATING = Profile(
    "truncating",
    "thesis p. 116 (eight digits, no rounding occurs); signs of zero: the thesis's prints; signs of what underflows "
    "or is divided by zero, and whole powers: IBM FORTRAN II-D executed in a simulator",
    rules_of(8),
)
IBM1962 = Profile(
    "ibm1962",
    "IBM's subroutine set of 1962, executed digit by digit in a simulator: product rounded half up, the rest cut",
    rules_of(8, products=1, left_zero=1, signed_sums=0, signed_by_zero=0, powers_multiply=1),
    announces=True,
)
PROFILES = {profile.name: profile for profile in (TRUNCATING, IBM1962)}


def _truncating(name: str, digits: int) -> Profile:
    return Profile(name, TRUNCATING.source, rules_of(digits))


def _guarded(name: str, digits: int) -> Profile:
    return Profile(name, "truncating, with a guard digit in sums", rules_of(digits, guard=1))


def _rounding(name: str, digits: int) -> Profile:
    rules = rules_of(digits, guard=2, sticky=1, sums=1, products=1, quotients=1)
    return Profile(name, "exact result, rounded half up", rules)


_FAMILIES = {"truncating": _truncating, "guarded": _guarded, "rounding": _rounding}
FAMILIES = tuple(f"{family}:P" for family in _FAMILIES)


def profile(name: str) -> Profile:
    """The profile of that name: ``truncating``, ``ibm1962``, or a family with P from 2 to 28, as ``rounding:8``.

    ``guarded:P`` is ``truncating:P`` but for sums: of the smaller operand's digits that would drop off before the
    addition, the first is kept until the sum is cut.  ``rounding:P`` gives each result of + - * / as the exact
    result rounded half up in magnitude.  Raises ValueError for any other name.
    """
    if name in PROFILES:
        return PROFILES[name]
    family, colon, count = name.partition(":")
    if not (colon and family in _FAMILIES and count.isdecimal() and count.isascii()):
        raise ValueError(f"no arithmetic is called {name!r}; there are {', '.join((*PROFILES, *FAMILIES))}")
    if len(count) > 9 or not MIN_DIGITS <= int(count) <= MAX_DIGITS:
        raise ValueError(f"{name}: the number of digits is {MIN_DIGITS} to {MAX_DIGITS}")
    return _FAMILIES[family](name, int(count))

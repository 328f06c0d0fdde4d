"""Convert decimals and fractions to exact numbers, and exact numbers to text.

``exact_text`` formats the numbers of a hull, and uses an exponent only for numbers of more than 80 digits.
``decimal_text`` and ``finite_decimal`` format numbers in files and messages, and may use an exponent for shorter ones,
such as ``1E+22``.  The module must not import numpy, because a page of the site runs it in the reader's browser, where
numpy is missing.
"""

import re
from collections.abc import Iterable, Sequence
from decimal import MAX_EMAX, MIN_EMIN, ROUND_HALF_EVEN, Context, Decimal
from fractions import Fraction
from numbers import Rational, Real

from emulator.errors import ArgumentError, quoted

Exact = int | Fraction
Point = tuple[str, str, str]

MAX_DIGITS, MAX_EXPONENT = 4000, 9999
# The number of bits of 10**13999, the largest denominator of a decimal with 4000 digits and the exponent -9999.
_MAX_BITS = 46_505
# Significant digits of an area, which is a sum of square roots.
AREA_DIGITS = 50
_DECIMAL = re.compile(r"([+-]?)([0-9]*)(?:\.([0-9]*))?(?:[eE]([+-]?[0-9]{1,6}))?")
_QUOTIENT = re.compile(r"([+-]?[0-9]+)/([0-9]+)")
_SHOWN = 40
_GUARD = 20
_LONGEST = 80
_SAFE_BITS = 10_000


class PointsError(ArgumentError):
    """Raised for an invalid point, or a point that an arithmetic cannot hold.  The message counts points from 0."""


def split_decimal(text: str) -> tuple[bool, str, str, int]:
    """Split ``-12.50E-3`` into (True, "12", "50", -3); True means negative.  Raise ValueError for other text."""
    match = _DECIMAL.fullmatch(text.strip())
    if not match or not (match[2] or match[3]):
        raise ValueError(f"{quoted(text)} is not a decimal number")
    return match[1] == "-", match[2], match[3] or "", int(match[4] or 0)


def decimal(text: str) -> Exact:
    """Return the value of a decimal string such as ``12``, ``-1.5`` or ``-.25E-3``.

    Blanks around the string are ignored.  Raise ValueError for other text, for more than 4000 digits and for an
    exponent beyond 9999.  The limits prevent a typing error from using all of the memory.
    """
    minus, whole, fraction, exponent = split_decimal(text)
    if len(whole) + len(fraction) > MAX_DIGITS:
        raise ValueError(f"{len(whole) + len(fraction)} digits; at most {MAX_DIGITS} are read")
    if abs(exponent) > MAX_EXPONENT:
        raise ValueError(f"the exponent of {quoted(text)} is not within -{MAX_EXPONENT} to {MAX_EXPONENT}")
    size = int(whole + fraction)
    value, exponent = -size if minus else size, exponent - len(fraction)
    return value * 10**exponent if exponent >= 0 else Fraction(value, 10**-exponent)


def number(text: str) -> Fraction:
    """Return the number that a text denotes: a decimal number or a fraction ``p/q``.

    Raise ValueError for any other text.
    """
    stripped = text.strip()
    quotient = _QUOTIENT.fullmatch(stripped)
    try:
        if not quotient:
            return Fraction(decimal(stripped))
        if not int(quotient[2]):
            raise ValueError(f"{quoted(stripped)} has the denominator 0")
        return Fraction(int(quotient[1]), int(quotient[2]))
    except ValueError as error:
        # The message may quote the whole text, which can have thousands of digits.
        if len(stripped) <= _SHOWN or len(str(error)) <= 2 * _SHOWN:
            raise
        raise ValueError(f"{quoted(stripped)} is not a decimal number of at most 4000 digits") from None


def real(value: object) -> Exact:
    """Return the exact value of a real number of any type.  A binary float, also of numpy, has the value it stores.

    Text may be a decimal or a fraction ``p/q``.  Raise ValueError for infinities, NaN, booleans, numbers whose
    numerator or denominator exceeds 10**13999, and all other types.
    """
    if type(value) is int and value.bit_length() <= _MAX_BITS:
        return value
    if isinstance(value, str):
        return number(value) if "/" in value else decimal(value)
    if isinstance(value, Decimal):
        if not value.is_finite():
            raise ValueError(f"{value} is not finite")
        return number(str(value))
    if isinstance(value, Rational) and not isinstance(value, bool):
        over, under = int(value.numerator), int(value.denominator)
    elif isinstance(value, Real) and not isinstance(value, bool):
        try:
            over, under = map(int, value.as_integer_ratio())  # type: ignore[attr-defined]
        except (OverflowError, ValueError):
            raise ValueError(f"{value} is not finite") from None
    else:
        kind = type(value).__name__
        raise ValueError(f"expected an int, a float, a Fraction, a Decimal or a decimal string; found {kind}")
    if max(over.bit_length(), under.bit_length()) > _MAX_BITS:
        raise ValueError(f"the numerator or the denominator exceeds 10**{MAX_DIGITS + MAX_EXPONENT}")
    return over if under == 1 else Fraction(over, under)


def read_epsilon(epsilon: object) -> tuple[Fraction, bool] | None:
    """Return the value of a tolerance e, and True if it is relative (``"rel:E"``).  Return None if ``epsilon`` is None.

    Raise ArgumentError unless e is a real number of at least 0, or the text of one.
    """
    if epsilon is None:
        return None
    relative = isinstance(epsilon, str) and epsilon.startswith("rel:")
    try:
        value = Fraction(real(epsilon.removeprefix("rel:") if isinstance(epsilon, str) else epsilon))
    except ValueError as error:
        raise ArgumentError(f"epsilon: {error}") from None
    if value < 0:
        raise ArgumentError("epsilon: expected a number that is not negative")
    return value, relative


def value_of(text: str) -> Fraction:
    """Return the value of a valid decimal or fraction ``p/q`` of any length, such as a number of a hull."""
    # The conversion goes through Decimal, which has no limit of length, whereas int() refuses more than 4300 digits.
    over, _, under = text.partition("/")
    return Fraction(Decimal(over)) / Fraction(Decimal(under)) if under else Fraction(Decimal(over))


def coordinates(point: Sequence[str]) -> tuple[Fraction, Fraction, Fraction]:
    """Return a point whose coordinates are text, decimals or fractions, as three Fractions."""
    x, y, z = map(value_of, point)
    return x, y, z


def integer_text(value: int) -> str:
    """Return all digits of an integer of any length, whereas ``str`` rejects more than 4300 digits."""
    return str(value) if value.bit_length() < _SAFE_BITS else str(Decimal(value))


def decimal_text(text: str, digits: int | None = None) -> str:
    """Return a decimal or a fraction as decimal text.

    A decimal is returned without its plus sign and otherwise unchanged.  A fraction p/q with a finite decimal expansion
    becomes that decimal.  Any other fraction is rounded to ``digits`` significant digits, or raises ValueError if
    ``digits`` is None.
    """
    stripped = text.strip()
    value = value_of(stripped)
    if "/" not in stripped:
        return stripped.removeprefix("+")
    exact = finite_decimal(value)
    if exact is not None:
        return exact
    if digits is None:
        raise ValueError(f"{quoted(stripped)} has no finite decimal; give a number of digits to which it is rounded")
    if digits < 1:
        raise ValueError(f"digits: expected at least 1, found {digits}")
    context = Context(prec=digits, rounding=ROUND_HALF_EVEN, Emin=MIN_EMIN, Emax=MAX_EMAX)
    return str(context.divide(Decimal(value.numerator), Decimal(value.denominator)))


def sum_of_roots(squares: Iterable[Fraction], digits: int) -> Decimal:
    """Return the sum of the square roots of ``squares``, rounded to ``digits`` digits."""
    work, total = Context(prec=digits + _GUARD, Emin=MIN_EMIN, Emax=MAX_EMAX), Decimal(0)
    for square in squares:
        # The quotient of two roots, unlike the root of a quotient, is exact if both roots are integers.
        root = work.divide(work.sqrt(Decimal(square.numerator)), work.sqrt(Decimal(square.denominator)))
        total = work.add(total, root)
    return Context(prec=digits, Emin=MIN_EMIN, Emax=MAX_EMAX).plus(total)


def decimal_places(denominator: int) -> int | None:
    """Return the number of decimal places of 1 / denominator, or None if its decimal expansion is infinite."""
    twos = (denominator & -denominator).bit_length() - 1
    rest, fives = denominator >> twos, 0
    while rest % 5 == 0:
        rest, fives = rest // 5, fives + 1
    return max(twos, fives) if rest == 1 else None


def finite_decimal(value: Fraction) -> str | None:
    """Return a fraction as a decimal such as ``-0.25`` or ``1E+90``, or None if its expansion does not end."""
    places = decimal_places(value.denominator)
    if places is None:
        return None
    sign, figures, _ = Decimal(value.numerator * 10**places // value.denominator).as_tuple()
    text = "".join(map(str, figures)).rstrip("0")
    exponent = len(figures) - places
    minus = "-" if sign else ""
    if not text:
        return "0"
    if not -6 < exponent <= 21:
        point = f".{text[1:]}" if len(text) > 1 else ""
        return f"{minus}{text[0]}{point}E{exponent - 1:+d}"
    if exponent <= 0:
        return f"{minus}0.{'0' * -exponent}{text}"
    whole, fraction = text[:exponent].ljust(exponent, "0"), text[exponent:]
    return f"{minus}{whole}.{fraction}" if fraction else f"{minus}{whole}"


def float_text(value: float | Exact) -> str:
    """Return the exact decimal of a finite binary float, or of another number with a finite decimal expansion."""
    text = finite_decimal(Fraction(*value.as_integer_ratio()))
    assert text is not None
    return text


def scaled_decimal(integer: int, exponent: int) -> str:
    """Return the number ``integer * 10**exponent`` as text, with an exponent if it would have more than 80 digits."""
    if integer == 0:
        return "0"
    sign, digits = ("-" if integer < 0 else ""), integer_text(abs(integer))
    bare = digits.rstrip("0")
    exponent += len(digits) - len(bare)
    if exponent >= 0 and len(bare) + exponent <= _LONGEST:
        return sign + bare + "0" * exponent
    if -_LONGEST <= exponent < 0:
        bare = bare.rjust(1 - exponent, "0")
        return f"{sign}{bare[:exponent]}.{bare[exponent:]}"
    return f"{sign}{bare}E{exponent:+d}"


def exact_text(value: Exact) -> str:
    """Return a number as text: a decimal, or a fraction ``p/q`` if the decimal expansion does not end."""
    numerator, denominator = value.numerator, value.denominator
    if denominator == 1:
        return scaled_decimal(numerator, 0) if abs(numerator) >= 10**_LONGEST else str(numerator)
    places = decimal_places(denominator)
    if places is None:
        return f"{integer_text(numerator)}/{integer_text(denominator)}"
    return scaled_decimal(numerator * 10**places // denominator, -places)

"""Fields of a FORMAT compared with other implementations of the same rules.

Reading is compared with regular expressions, and writing with Python's own conversion.  The rules are those of
C26-5619 p. 14 and 35-40, and for blanks OPEN-QUESTIONS 6.
"""

import re
from decimal import Decimal

from hypothesis import given, settings
from hypothesis import strategies as st

from emulator.numbers.arithmetic import MINUS_ZERO, ZERO, profile
from emulator.numbers.fields import Field, FieldError, read_fixed, read_floating, write_fixed, write_floating
from tests.support.systems import DECIMAL

FLOATING = re.compile(r"([+-]?)(\d*)(?:(\.)(\d*))?(?:E([+-]?)(\d+)|([+-])(\d+))?")
FIXED = re.compile(r"([+-]?)(\d+)")
RULES = st.sampled_from(DECIMAL).map(lambda name: profile(name).rules)

SCRAPS = st.text(st.sampled_from("0123456789 0 0 .E+-X"), max_size=18)
BLANKS = st.sampled_from(["", "", " ", "  "])
NUMBERS = st.builds(
    "".join,
    st.tuples(
        BLANKS,
        st.sampled_from(["", "-", "+"]),
        st.integers(0, 10**30).map(str),
        BLANKS,
        st.sampled_from([".", ".", ""]),
        st.integers(0, 999).map(str) | st.just(""),
        st.sampled_from(["", "E", "E+", "E-", "E ", "+", "-"]),
        st.integers(0, 130).map(str) | st.sampled_from(["", "0000007", "1000000"]),
        BLANKS,
    ),
)


def dense(columns: str) -> tuple[str, bool]:
    """Return the text of a field without its blanks, and whether a blank was interpreted."""
    text = columns.lstrip(" ")
    body = text.rstrip(" ")
    # A sign inside begins an exponent as an E does (p. 35, 38).
    marks = body[:1] + re.sub(r"[+-]", "E", body[1:])
    if "." in marks or "E" in marks:
        meant = not re.search(r"[E.].* .*E|E.* ", marks)
        return body.replace(" ", "0" if meant else ""), " " in body
    return text.replace(" ", "0"), " " in text


def expected(columns: str, decimals: int, digits: int) -> tuple[int, int, bool] | None:
    """Return mantissa, exponent and whether a warning is expected, or None for an error."""
    text, warned = dense(columns)
    if not text:
        return 0, ZERO, True
    match = FLOATING.fullmatch(text)
    if not match or not (match[2] or match[4]):
        return None
    sign, whole, point, fraction, esign, edigits, esign2, edigits2 = match.groups()
    power = int(edigits or edigits2 or "0") * (-1 if "-" in (esign, esign2) else 1)
    if abs(power) > 999_999:
        return None
    lead = (whole + (fraction or "")).lstrip("0")
    if not lead:
        return 0, MINUS_ZERO if sign == "-" else ZERO, warned
    exponent = len(lead) - (len(fraction or "") if point else decimals) + power
    if not -99 <= exponent <= 99:
        return None
    mantissa = int(lead[:digits].ljust(digits, "0"))
    return -mantissa if sign == "-" else mantissa, exponent, warned or bool(lead[digits:].strip("0"))


@settings(max_examples=400)
@given(SCRAPS | NUMBERS, st.integers(0, 9), RULES)
def test_floating_fields(columns: str, decimals: int, rules: tuple[int, ...]) -> None:
    want = expected(columns, decimals, rules.digits)
    try:
        number_read = read_floating(Field("E", max(1, len(columns)), decimals), columns, rules)
    except FieldError:
        assert want is None
        return
    assert want == (number_read.mantissa, number_read.exponent, bool(number_read.remark))


@settings(max_examples=300)
@given(SCRAPS | NUMBERS)
def test_fixed_fields(columns: str) -> None:
    text, warned = dense(columns)
    match = FIXED.fullmatch(text)
    try:
        number_read = read_fixed(columns)
    except FieldError:
        assert text
        assert match is None
        return
    value = int(match[1] + match[2]) if match else 0
    assert bool(match) == bool(text)
    assert number_read.mantissa == (value % 10000 if value >= 0 else -(-value % 10000))
    assert bool(number_read.remark) == (warned or not text or abs(value) > 9999)


@settings(max_examples=300)
@given(st.data(), RULES, st.integers(1, 30), st.integers(0, 12), st.sampled_from([-99, 99, *range(-10, 13)]))
def test_written_fields(data: st.DataObject, rules: tuple[int, ...], width: int, decimals: int, exponent: int) -> None:
    """An F field truncates the decimal, and an E field shows its first digits.  Larger numbers use E14.8."""
    size = data.draw(st.integers(rules.least, rules.limit - 1))
    mantissa = data.draw(st.sampled_from([size, -size]))
    minus = "-" if mantissa < 0 else ""
    value = Decimal(size).scaleb(exponent - rules.digits)
    text, overflowed = write_floating(Field("F", width, decimals), mantissa, exponent, rules)
    cut = f"{int(value.scaleb(decimals)):0{decimals + 1}d}"
    whole = cut[: len(cut) - decimals].lstrip("0")
    expected = f"{minus}{whole}.{cut[len(cut) - decimals :]}"
    # One column is always the sign's (C26-5619 p. 39).
    assert overflowed == (len(expected.lstrip("-")) + 1 > width)
    eight = str(size).ljust(8, "0")[:8]
    by_e = f"{minus}.{eight}E{exponent:+03d}".rjust(14)
    assert text == (by_e if overflowed else expected.rjust(width))
    text, overflowed = write_floating(Field("E", width, decimals), mantissa, exponent, rules)
    count = 8 if width >= 14 else width - 6
    whole_digits = count - decimals
    if count < 1 or whole_digits < 0 or exponent - whole_digits < -99:
        assert (text, overflowed) == (by_e, True)
    else:
        digits = str(size).ljust(count, "0")[:count]
        expected = f"{minus}{digits[:whole_digits]}.{digits[whole_digits:]}E{exponent - whole_digits:+03d}"
        assert (text, overflowed) == (expected.rjust(width), False)


@given(st.integers(-9999, 9999), st.integers(1, 8))
def test_written_fixed_fields(value: int, width: int) -> None:
    room = width - (value < 0)
    digits = str(abs(value) % 10**room) if room else ""
    assert write_fixed(Field("I", width), value) == (("-" if value < 0 else "") + digits).rjust(width)

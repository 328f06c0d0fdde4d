"""Fields read by emulator/numbers/columns.py beside the same rules as regular expressions, and written beside
Python's own.

The rules: C26-5619 p. 14, 35-40; blanks: OPEN-QUESTIONS 6.
"""

from __future__ import annotations

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
    """Mantissa, exponent and whether there is a warning; None for an error."""
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
        found = read_floating(Field("E", max(1, len(columns)), decimals), columns, rules)  # type: ignore[arg-type]
    except FieldError:
        assert want is None
        return
    assert want == (found.mantissa, found.exponent, bool(found.remark))


@settings(max_examples=300)
@given(SCRAPS | NUMBERS)
def test_fixed_fields(columns: str) -> None:
    text, warned = dense(columns)
    match = FIXED.fullmatch(text)
    try:
        found = read_fixed(columns)
    except FieldError:
        assert text
        assert match is None
        return
    value = int(match[1] + match[2]) if match else 0
    assert bool(match) == bool(text)
    assert found.mantissa == (value % 10000 if value >= 0 else -(-value % 10000))
    assert bool(found.remark) == (warned or not text or abs(value) > 9999)


@settings(max_examples=300)
@given(st.data(), RULES, st.integers(1, 30), st.integers(0, 12), st.sampled_from([-99, 99, *range(-10, 13)]))
def test_written_fields(data: st.DataObject, rules: tuple[int, ...], width: int, decimals: int, exponent: int) -> None:
    """F: the decimal cut; E: the first digits; either in its width, or by E14.8 where it is too large."""
    size = data.draw(st.integers(rules.least, rules.limit - 1))
    mantissa = data.draw(st.sampled_from([size, -size]))
    minus = "-" if mantissa < 0 else ""
    value = Decimal(size).scaleb(exponent - rules.digits)
    text, overflowed = write_floating(Field("F", width, decimals), mantissa, exponent, rules)  # type: ignore[arg-type]
    cut = f"{int(value.scaleb(decimals)):0{decimals + 1}d}"
    whole = cut[: len(cut) - decimals].lstrip("0")
    wanted = f"{minus}{whole}.{cut[len(cut) - decimals :]}"
    # One column is always the sign's (C26-5619 p. 39).
    assert overflowed == (len(wanted.lstrip("-")) + 1 > width)
    eight = str(size).ljust(8, "0")[:8]
    by_e = f"{minus}.{eight}E{exponent:+03d}".rjust(14)
    assert text == (by_e if overflowed else wanted.rjust(width))
    text, overflowed = write_floating(Field("E", width, decimals), mantissa, exponent, rules)  # type: ignore[arg-type]
    count = 8 if width >= 14 else width - 6
    left = count - decimals
    if count < 1 or left < 0 or exponent - left < -99:
        assert (text, overflowed) == (by_e, True)
    else:
        digits = str(size).ljust(count, "0")[:count]
        wanted = f"{minus}{digits[:left]}.{digits[left:]}E{exponent - left:+03d}"
        assert (text, overflowed) == (wanted.rjust(width), False)


@given(st.integers(-9999, 9999), st.integers(1, 8))
def test_written_fixed_fields(value: int, width: int) -> None:
    room = width - (value < 0)
    digits = str(abs(value) % 10**room) if room else ""
    assert write_fixed(Field("I", width), value) == (("-" if value < 0 else "") + digits).rjust(width)

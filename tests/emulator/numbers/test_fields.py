"""Conversion of numbers to the columns of a field and back (C26-5619 p. 14, 35-40; blanks: OPEN-QUESTIONS 6)."""

from decimal import Decimal

import pytest
from hypothesis import given
from hypothesis import strategies as st

from emulator.numbers import fields
from emulator.numbers.arithmetic import MINUS_ZERO, TRUNCATING, UNDEFINED, ZERO, profile

RULES = TRUNCATING.rules
E14 = fields.Field("E", 14, 8)

mantissas = st.integers(10**7, 10**8 - 1).flatmap(lambda m: st.sampled_from((m, -m)))
exponents = st.integers(-99, 99)
numbers = st.tuples(mantissas, exponents) | st.sampled_from(((0, ZERO), (0, MINUS_ZERO)))


def words(read: fields.FieldNumber) -> str:
    """Return the warning about a number that was read, or an empty string."""
    assert read.remark is not None
    return read.remark.message


@given(numbers)
def test_e14_8_round_trip_of_eight_digits(number: tuple[int, int]) -> None:
    columns, overflowed = fields.write_floating(E14, *number, RULES)
    assert len(columns) == 14
    assert not overflowed
    read = fields.read_floating(E14, columns, RULES)
    assert (read.mantissa, read.exponent, read.remark) == (*number, None)


@given(numbers, st.integers(14, 30), st.integers(0, 8))
def test_wide_e_fields_round_trip(number: tuple[int, int], width: int, decimals: int) -> None:
    """Eight digits for every d.  If the adjusted exponent does not fit, E14.8 is used (p. 39-40)."""
    field = fields.Field("E", width, decimals)
    columns, overflowed = fields.write_floating(field, *number, RULES)
    read = fields.read_floating(field, columns, RULES)
    assert (read.mantissa, read.exponent) == number
    fits = number[0] == 0 or number[1] - (8 - decimals) >= -99
    assert overflowed == (not fits or (width == 14 and len(columns.strip()) > 14))
    assert len(columns) == (14 if overflowed else width)


@given(mantissas, st.integers(-9, 12), st.integers(2, 20), st.integers(0, 8))
def test_f_fields_truncate(mantissa: int, exponent: int, width: int, decimals: int) -> None:
    """p. 39: the value is truncated after d decimals.  A number that is too large is written as E14.8."""
    columns, overflowed = fields.write_floating(fields.Field("F", width, decimals), mantissa, exponent, RULES)
    value = Decimal(mantissa).scaleb(exponent - 8)
    cut = Decimal(int(value.scaleb(decimals)))
    if overflowed:
        assert columns == fields.write_floating(E14, mantissa, exponent, RULES)[0]
        whole = str(abs(int(value))).lstrip("0")
        assert 1 + len(whole) + 1 + decimals > width, "one column is always the sign's (C26-5619 p. 39)"
    else:
        assert len(columns) == width
        assert Decimal(columns.strip().replace("-.", "-0.") + "0") == cut.scaleb(-decimals)
        assert columns.strip().startswith("-") == (mantissa < 0)


@given(st.integers(-9999, 9999), st.integers(5, 20))
def test_i_fields_round_trip(value: int, width: int) -> None:
    columns = fields.write_fixed(fields.Field("I", width), value)
    assert len(columns) == width
    assert columns.strip() == str(value)
    assert fields.read_fixed(columns).mantissa == value


@given(st.integers(-9999, 9999), st.integers(1, 4))
def test_small_i_fields_lose_high_digits(value: int, width: int) -> None:
    """p. 38: they are lost without notice.  A minus sign keeps its column (OPEN-QUESTIONS 7)."""
    columns = fields.write_fixed(fields.Field("I", width), value)
    assert len(columns) == width
    room = width - (value < 0)
    if room:
        assert abs(int(columns)) == abs(value) % 10**room
    assert ("-" in columns) == (value < 0)


@pytest.mark.parametrize(
    "columns", ["ABC", "1.2.3", "1E", "E5", "--1", "1-", ".", "+", "1E+", "1.E5.", "1,5", "1/2", "1E+5+3"]
)
def test_invalid_floating_field_is_rejected(columns: str) -> None:
    with pytest.raises(fields.FieldError, match="is not a number"):
        fields.read_floating(E14, columns, RULES)


@pytest.mark.parametrize("columns", ["1.5", "1E2", "A", "+-1", "-", "1 -"])
def test_invalid_fixed_field_is_rejected(columns: str) -> None:
    with pytest.raises(fields.FieldError, match="is not an integer"):
        fields.read_fixed(columns)


@pytest.mark.parametrize("columns", ["1.E99", "1.E100", ".1E-100", "-1.E+99", "1.E" + "9" * 40])
def test_exponent_out_of_range_is_rejected(columns: str) -> None:
    with pytest.raises(fields.FieldError, match="the exponent must be -99 to 99"):
        fields.read_floating(E14, columns, RULES)


def test_limits_of_the_range_and_undefined_numbers() -> None:
    assert fields.parse_constant(".99999999E99", RULES) == (99999999, 99)
    assert fields.parse_constant(".1E-99", RULES) == (10000000, -99)
    assert fields.parse_constant("0.E50", RULES) == (0, ZERO)
    assert fields.parse_constant("0.E999999", RULES) == (0, ZERO)
    with pytest.raises(fields.FieldError, match="undefined"):
        fields.write_floating(E14, 0, UNDEFINED, RULES)


@pytest.mark.parametrize(
    ("columns", "value"), [("2 ", 20), (" 2 ", 20), ("1 2", 102), ("  12", 12), ("- 5", -5), ("    ", 0)]
)
def test_blanks_in_an_i_field(columns: str, value: int) -> None:
    """OPEN-QUESTIONS 6: leading blanks are ignored, others are zeros with a warning.  A blank field warns too."""
    found = fields.read_fixed(columns)
    assert found.mantissa == value
    assert bool(found.remark) == (not columns.strip() or " " in columns.lstrip())


@pytest.mark.parametrize(
    ("columns", "expected", "warned"),
    [
        (" .2E1   ", (20000000, 1), False),
        (" .20000000E 01", (20000000, 1), True),
        ("2.   ", (20000000, 1), False),
        ("2 .5", (20500000, 2), True),
        ("12   ", (12000000, -3), True),
        ("     ", (0, ZERO), True),
        ("1.2 5E1", (12500000, 2), True),
    ],
)
def test_blanks_in_an_e_field(columns: str, expected: tuple[int, int], warned: bool) -> None:
    """OPEN-QUESTIONS 6."""
    found = fields.read_floating(E14, columns, RULES)
    assert (found.mantissa, found.exponent) == expected
    assert bool(found.remark) == warned


def test_lost_digits_give_a_warning() -> None:
    assert words(fields.read_floating(E14, ".123456789", RULES)) == "9 digits; those after the first 8 are dropped"
    assert fields.read_floating(E14, ".1234567800", RULES).remark is None
    assert words(fields.read_fixed("12345")) == "12345 has more than four digits; the last four are kept"
    assert fields.read_fixed("12345").mantissa == 2345
    assert fields.read_fixed("-12345").mantissa == -2345
    assert (fields.read_fixed("9999").mantissa, fields.read_fixed("9999").remark) == (9999, None)
    assert fields.read_fixed("10000").mantissa == 0
    assert words(fields.read_fixed("10000")) == "10000 has more than four digits; the last four are kept"


@pytest.mark.parametrize(("name", "text"), [("truncating:2", " .12000000E+01"), ("truncating:20", " .12345678E+01")])
def test_other_digit_counts_show_eight_columns(name: str, text: str) -> None:
    rules = profile(name).rules
    number = fields.parse_constant("1.2345678901234567890", rules)
    assert fields.write_floating(E14, *number, rules) == (text, False)


@given(st.text("0123456789+-.E ", min_size=1, max_size=20))
def test_any_columns_are_a_number_or_an_error(columns: str) -> None:
    try:
        found = fields.read_floating(E14, columns, RULES)
    except fields.FieldError:
        return
    assert found.exponent in (ZERO, MINUS_ZERO) if found.mantissa == 0 else 10**7 <= abs(found.mantissa) < 10**8

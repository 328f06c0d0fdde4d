"""Fields of numbers at their edges: blanks inside a number, which of two warnings is given, an I field with no room.

Each expectation is worked out by hand from C26-5619 p. 38 and fortran_src/OPEN-QUESTIONS.md 6 and 7.
"""

import pytest

from emulator.numbers.arithmetic import TRUNCATING
from emulator.numbers.fields import Field, read_fixed, read_floating
from tests.support.deckwork import punched

RULES = TRUNCATING.rules
E14 = Field("E", 14, 8)
BLANKS, AS_ZEROS = "blanks inside", "read as zeros"
"""Texts of the two warnings about blanks.  Neither contains the other."""


def floating(columns: str, words: str) -> tuple[int, int]:
    """Return mantissa and exponent of an E field, and check its warning (none if ``words`` is empty)."""
    result = read_floating(E14, columns, RULES)
    warning = result.remark.message if result.remark else ""
    assert words in warning
    assert bool(words) == bool(warning)
    return result.mantissa, result.exponent


@pytest.mark.parametrize(
    ("columns", "mantissa", "exponent"),
    [
        (".2 3E1", 23000000, 1),
        (".2 3 E-1", 23000000, -1),
        ("1.2  3E 1", 12300000, 2),
        (".5 E1", 50000000, 1),
        ("-.2 3E1", -23000000, 1),
    ],
)
def test_blanks_between_point_and_exponent_are_ignored(columns: str, mantissa: int, exponent: int) -> None:
    """Digits there may belong to an exponent: with a zero for its blank, .2 3E1 would become 2.03."""
    assert floating(columns, BLANKS) == (mantissa, exponent)


@pytest.mark.parametrize(("columns", "exponent"), [(".5E1 0", 10), (".5E 1", 1), ("5E1 2", 5), (".5E1  ", 1)])
def test_blanks_in_and_after_an_exponent_are_ignored(columns: str, exponent: int) -> None:
    """Zeros would multiply the number by powers of ten.  5 without a point is .00000005."""
    found = read_floating(E14, columns, RULES)
    assert (found.mantissa, found.exponent) == (50000000, exponent)


@pytest.mark.parametrize(
    ("columns", "mantissa", "exponent"),
    [("1. 5", 10500000, 1), (".2 3", 20300000, 0), ("-1. 5", -10500000, 1), ("1.5 +1", 15000000, 2)],
)
def test_blanks_after_the_point_are_zeros_without_an_exponent(columns: str, mantissa: int, exponent: int) -> None:
    """A blank among the digits is a zero, because no exponent follows: 1. 5 is 1.05."""
    assert floating(columns, BLANKS) == (mantissa, exponent)


def test_blanks_and_trailing_zeros_of_a_number_are_not_lost_digits() -> None:
    # 1 2E5 is 102 * 10**5, and the FORMAT puts the point eight digits from the right: .102.
    assert floating("1 2E5", BLANKS) == (10200000, 0)
    # Trailing zeros are dropped without loss, so they are not counted.
    floating(".12345678900", "9 digits")
    floating("00123456700000", "")


@pytest.mark.parametrize(
    ("columns", "words"),
    [("1 2.34567891", BLANKS), ("1.23456789 E1", BLANKS), ("123456789  ", AS_ZEROS), (".123456789", "9 digits")],
)
def test_blanks_are_reported_rather_than_lost_digits(columns: str, words: str) -> None:
    """A field gives one warning.  A blank may change the value tenfold, a ninth digit only by 1 in 10**8."""
    floating(columns, words)


@pytest.mark.parametrize(("columns", "value"), [("1234 ", 2340), ("1 234", 234), ("-1234 ", -2340)])
def test_integer_with_five_digits_after_filling_blanks_gives_a_warning(columns: str, value: int) -> None:
    """The warning shows the digits as read, with zeros for blanks."""
    found = read_fixed(columns)
    assert found.mantissa == value
    assert found.remark is not None
    assert found.remark.message.startswith(f"{columns.replace(' ', '0')} has more than four digits")


def test_blanks_and_signs_in_integers_are_reported() -> None:
    # Without point and exponent, blanks after the number count as zeros.  Those before it do not.
    for columns in ("12 ", "1 2"):
        found = read_fixed(columns)
        assert found.remark is not None
        assert AS_ZEROS in found.remark.message
        floating(columns, AS_ZEROS)
    assert read_fixed(" 12").remark is None
    floating(" 12", "")
    # The sign takes the only column, and every digit is lost (p. 38).  The field before is unchanged.
    lines = ["I=12", "J=-7", "K=3", "PUNCH 1,I,J,K", "1 FORMAT(I2,I1,I1)", "END"]
    assert punched(*lines) == ("12-3",)

"""The number systems: single precision, exact sums of roots, and the operations that each one rejects."""

import math
import random
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from emulator.language.cards import deck_from_lines
from emulator.machine.machine import Machine
from emulator.machine.result import MachineError, Options, Result
from emulator.numbers import Numbers, Trap, numbers
from emulator.numbers.fields import FALLBACK, Field
from tests.support.deckwork import program
from tests.support.systems import BINARY, SYSTEMS

EXACT, DOUBLE, SINGLE = numbers("exact"), numbers("float64"), numbers("float32")


def run(name: str, *lines: str, data: tuple[str, ...] = ()) -> Result:
    options = Options(numbers=numbers(name), limit=2_000)
    return Machine(program(*lines, "END"), deck_from_lines("d", data), options).run()


def test_names() -> None:
    for name in ("float64", "float32", "mp:2", "mp:100000", "exact", "truncating", "ibm1962", "rounding:12"):
        assert numbers(name).name == name
    assert numbers("mp:53") == numbers("mp:53")
    assert numbers("mp:53") != numbers("mp:54")


@pytest.mark.parametrize("name", ["mp", "mp:", "mp:1", "mp:100001", "mp:x", "mp:-5", "float", "Exact", "truncating:1"])
def test_unknown_names_are_rejected(name: str) -> None:
    with pytest.raises(ValueError, match=r"no arithmetic is called|the number of (bits|digits) must be"):
        numbers(name)


# Single precision, against numpy's.

SINGLES = st.floats(width=32, allow_nan=False, allow_infinity=False)


@settings(max_examples=150)
@given(SINGLES, SINGLES)
def test_single_precision_agrees_with_numpy(x: float, y: float) -> None:
    """Double precision rounded after each operation gives the correctly rounded single result."""
    a, b = np.float32(x), np.float32(y)
    with np.errstate(all="ignore"):
        expected = {"add": a + b, "subtract": a - b, "multiply": a * b, "divide": a / b if y else None}
        square = np.sqrt(np.abs(a))
    for name, value in expected.items():
        if value is not None:
            try:
                found = getattr(SINGLE, name)(x, y)
            except Trap as trap:
                found = trap.value
            assert found == float(value)
            assert math.copysign(1, found) == math.copysign(1, float(value))
    assert SINGLE.function("SQRT", x)[0] == float(square)


@settings(max_examples=100)
@given(SINGLES)
def test_shortest_decimal_of_a_single_agrees_with_numpy(x: float) -> None:
    """It has the digits that numpy prints and reads back as the same number."""
    assert float(np.float32(SINGLE.text(x))) == x
    if x and abs(x) > 1e-90:
        digits = str(np.format_float_scientific(np.float32(abs(x)), unique=True, trim="-")).partition("e")[0]
        columns = SINGLE.write(Field("E", 14, 8), x)[0]
        assert columns.strip().lstrip("-").startswith("." + digits.replace(".", "").ljust(8, "0")[:8])


@settings(max_examples=100)
@given(st.floats(allow_nan=False, allow_infinity=False, min_value=-1e80, max_value=1e80), st.integers(20, 120))
def test_multiprecision_number_reads_back_as_written(x: float, bits: int) -> None:
    system = numbers(f"mp:{bits}")
    whole, power = int(x * 2**40) % 10**6, random.Random(x).randint(-40, 40)
    if bits >= 24:
        value = system.decimal(whole, power)
        mantissa, exponent = system.cut(value, 6)
        assert Fraction(mantissa) * Fraction(10) ** (exponent - 6) == whole * Fraction(10) ** power


@pytest.mark.parametrize("name", SYSTEMS)
@pytest.mark.parametrize(("base", "count"), [(2, 1), (2, 5), (3, 4), (-2, 3), (-2, 4), (-3, 5), (2, -2), (-2, -3)])
def test_integer_power_is_exact_in_every_system(name: str, base: int, count: int) -> None:
    """The power is small enough for every system to hold it exactly."""
    system = numbers(name)
    found, code = system.integer_power(system.decimal(base, 0), count)
    assert (system.exact(found, 30), code) == (Fraction(base) ** count, "")


@pytest.mark.parametrize("name", SYSTEMS)
def test_sign_of_small_and_large_numbers(name: str) -> None:
    system = numbers(name)
    for power in (-30, -1, 0, 30):
        assert [system.sign(system.decimal(whole, power)) for whole in (-1, 0, 1)] == [-1, 0, 1]


@pytest.mark.parametrize("name", SYSTEMS)
def test_exact_value_of_zero_is_zero(name: str) -> None:
    assert numbers(name).exact(numbers(name).decimal(0, 0), 30) == 0


@pytest.mark.parametrize("name", [name for name in SYSTEMS if name not in BINARY])
def test_power_of_ten_is_shown_without_a_point(name: str) -> None:
    """All digits are shown up to twenty, and an exponent beyond."""
    system = numbers(name)
    assert system.text(system.decimal(1, 19)) == "1" + "0" * 19
    assert system.text(system.decimal(-1, 30)) == "-1E+30"
    assert system.text(system.decimal(1, -8)) == "1E-8"
    assert system.text(system.decimal(15, 29)) == "1.5E+30"


@pytest.mark.parametrize("name", ["float64", "float32"])
def test_binary_integer_is_shown_without_a_point(name: str) -> None:
    assert [numbers(name).text(value) for value in (2.0, -40.0, 0.5)] == ["2", "-40", "0.5"]


# IEEE 754 through the object code.


@pytest.mark.parametrize("system", [DOUBLE, SINGLE])
def test_signed_zeros_give_signed_quotients(system: Numbers) -> None:
    """IEEE 754 (1985) 6.3 and 7.2."""
    minus_zero = system.read(FALLBACK, "-.00000000E+00")[0]
    assert (minus_zero, math.copysign(1, minus_zero)) == (0, -1)
    assert math.copysign(1, system.read(FALLBACK, " .00000000E+00")[0]) == 1
    for dividend, divisor, expected in (
        (1.0, 0.0, math.inf),
        (-1.0, 0.0, -math.inf),
        (1.0, minus_zero, -math.inf),
        (-1.0, minus_zero, math.inf),
    ):
        with pytest.raises(Trap) as trap:
            system.divide(dividend, divisor)
        assert trap.value.value == expected


def test_growing_numbers_end_the_run_or_give_error_codes() -> None:
    result = run("float64", "A=1.E90", "B=A*A*A*A", "K=1", "IF(B)1,1,2", "1 STOP", "2 PUNCH 3,K", "3 FORMAT(I2)")
    assert result.punched == (" 1",)
    assert result.errors == (MachineError("E3", 2, 1),)
    result = run("exact", "A=3.", "5 A=A*A", "GO TO 5")
    assert result.ending.kind == "undecided"
    assert "more than 100000 bits, in 5 A=A*A" in result.ending.message
    result = run("mp:20", "A=3.", "DO 5 I=1,40", "5 A=A*A", "B=1.", "C=B/3.", "DO 6 I=1,40", "6 C=C*C")
    assert {error.code for error in result.errors} == {"E3", "E4"}


@pytest.mark.parametrize(
    ("statement", "code"),
    [
        ("B=A*A*A*A", "E3"),
        ("B=1./A/A/A/A", "E6"),
        ("B=(1./A)*(1./A)*(1./A)*(1./A)", "E4"),
        ("B=A*A*A/(1./A)", "E5"),
        ("C=A*A*A*8.E37 $B=C+C+C", "E1"),
        ("B=1./(A-A)", "E7"),
        ("B=EXP(A)", "F4"),
        ("B=EXP(-A)", "F5"),
        ("B=LOG(A-A)", "F2"),
        ("B=LOG(-A)", "F3"),
        ("B=(-A)**.5", "F6"),
        ("B=A**5", "E3"),
        ("B=A**(-5)", "E4"),
        ("B=(A-A)**(-1)", "E7"),
        ("B=A**A", "F4"),
        ("B=A**(-A)", "F5"),
    ],
)
@pytest.mark.parametrize("name", ["float64", "float32"])
def test_codes_of_binary_numbers(name: str, statement: str, code: str) -> None:
    start = "A=1.E37" if name == "float32" else "A=1.E90"
    if name == "float32":
        statement = statement.replace("A*A*A*8.E37", "A*30.").replace("A*A*A/", "A/")
    result = run(name, start, *statement.split(" $"))
    assert [error.code for error in result.errors][-1:] == [code]
    assert result.ending.kind == "end"


def test_nan_has_no_sign() -> None:
    for name in ("float64", "mp:40"):
        result = run(name, "Z=0.", "A=Z/Z", "7 IF(A)1,1,1", "1 STOP")
        assert (result.ending.kind, result.ending.message) == (
            "undecided",
            f"deck.f: card 3: {name} cannot determine the sign of NaN (not a number), in 7 IF(A)1,1,1",
        )


@settings(max_examples=100)
@given(st.fractions(), st.integers(1, 30))
def test_digits_of_a_fraction_are_truncated(value: Fraction, digits: int) -> None:
    mantissa, exponent = EXACT.cut(value, digits)
    shown = Fraction(mantissa) * Fraction(10) ** (exponent - digits)
    assert abs(shown) <= abs(value) < abs(shown) + Fraction(10) ** (exponent - digits)
    assert not mantissa or len(str(abs(mantissa))) == digits


# Operations without an exact result, each with its statement.

UNDECIDED = [
    ("A=1./(B-B)", "exact arithmetic cannot divide by zero"),
    ("A=SIN(B)", "exact arithmetic cannot hold SIN of 2"),
    ("A=EXP(1.)", "exact arithmetic cannot hold EXP of 1"),
    ("A=LOG(-B)", "exact arithmetic cannot hold LOG of 2"),
    ("A=LOG(B-B)", "exact arithmetic cannot hold LOG of 0"),
    ("A=ATAN(B/3.)", "exact arithmetic cannot hold ATAN of 0.66666666666666666666..."),
    ("A=SQRT(SQRT(B)+1.)", "exact arithmetic cannot hold SQRT of 2.4142135623730950488..."),
    ("A=B**.5", "exact arithmetic cannot hold a power with the exponent 0.5"),
    ("A=B**SQRT(B)", "exact arithmetic cannot hold a power with the exponent 1.4142135623730950488..."),
    ("A=(B-B)**(-2)", "exact arithmetic cannot divide by zero"),
    ("A=1./(SQRT(B)+SQRT(3.)+SQRT(5.))", "exact arithmetic cannot divide by a sum of 3 square roots"),
    ("A=B**9999**9999", "exact arithmetic does not hold a number of more than 100000 bits"),
    ("A=(B/3.)**9999**9", "exact arithmetic does not hold a number of more than 100000 bits"),
]


@pytest.mark.parametrize(("statement", "words"), UNDECIDED)
def test_exact_arithmetic_reports_unsupported_operations(statement: str, words: str) -> None:
    if statement.count("**") > 1:
        first, last = statement[2:].rsplit("**", 1)
        result = run("exact", "B=2.", f"C={first}", f"A=C**{last}")
        statement = f"A=C**{last}"
        card = 3
    else:
        result, card = run("exact", "B=2.", statement), 2
    assert (result.ending.kind, result.ending.message) == ("undecided", f"deck.f: card {card}: {words}, in {statement}")


def test_number_too_large_for_a_card_ends_the_run() -> None:
    for name in ("float64", "exact", "mp:100"):
        result = run(name, "A=1.E60", "B=A*A", "8 PUNCH 1,B", "1 FORMAT(E14.8)")
        assert result.ending.kind == "undecided"
        assert "is out of a card's range, E-99 to E+99, in 8 PUNCH 1,B" in result.ending.message
        small = run(name, "A=1.E-60", "B=A*A", "8 PUNCH 1,B", "1 FORMAT(E14.8)")
        assert small.ending.kind == "undecided"
    result = run("float64", "A=1.E90", "B=A*A*A*A", "PUNCH 1,B", "1 FORMAT(E14.8)")
    assert result.ending.message.endswith("inf cannot be written on a card, in PUNCH 1,B")
    assert run("mp:9", "A=0.", "B=1./A", "PUNCH 1,B", "1 FORMAT(E14.8)").ending.kind == "undecided"


@pytest.mark.parametrize("name", ["float64", "mp:60"])
def test_infinity_cannot_become_an_integer(name: str) -> None:
    result = run(name, "A=0.", "B=1./A", "K=B")
    assert result.ending.kind == "undecided"
    assert "cannot convert" in result.ending.message


@pytest.mark.parametrize(
    ("statement", "code"),
    [
        ("B=1./Z", "E7"),
        ("B=EXP(1.E9)", "F4"),
        ("B=EXP(-1.E9)", "F5"),
        ("B=LOG(Z)", "F2"),
        ("B=LOG(-2.)", "F3"),
        ("B=(-4.)**.5", "F6"),
        ("B=2.**(1.E9)", "F4"),
        ("B=Z**(-1)", "E7"),
        ("B=SIN(1./Z)", "F1"),
    ],
)
def test_codes_of_multiprecision_numbers(statement: str, code: str) -> None:
    result = run("mp:70", "Z=0.", statement)
    assert [error.code for error in result.errors][-1:] == [code]


def test_roots_and_blanks_are_treated_as_in_decimal() -> None:
    for name in ("exact", "float64", "float32", "mp:50", "truncating"):
        assert run(name, "A=SQRT(-16.)", "PUNCH 1,A", "1 FORMAT(F5.2)").punched == (" 4.00",)
    result = run("exact", "READ 1,A,B", "PUNCH 1,A,B", "1 FORMAT(2E14.8)", data=("",))
    assert result.punched == (" .00000000E-99 .00000000E-99",)
    assert any("a blank field is read as zero" in notice.message for notice in result.notices)

"""Whole programs in the style of the period. Their expected output is computed by other means, or by hand."""

from __future__ import annotations

from decimal import ROUND_DOWN, Context, Decimal
from math import isqrt

import pytest

from emulator.language.cards import deck_from_lines, read_deck
from emulator.language.compiler import translate
from emulator.machine.result import Options, Result
from emulator.numbers import numbers
from tests.support.deckwork import MakeMachine
from tests.support.paths import PROGRAMS

DOWN = Context(prec=8, rounding=ROUND_DOWN)


def job(
    engines: MakeMachine, name: str, *data: str, on: tuple[int, ...] = (), arithmetic: str = "truncating"
) -> Result:
    made, messages = translate(read_deck(str(PROGRAMS / f"{name}.f")))
    assert made is not None, messages
    assert messages == ()
    options = Options(numbers=numbers(arithmetic), switches=frozenset(on), limit=100_000)
    return engines(made, deck_from_lines("data", data), options).run()


def f_field(value: Decimal, width: int, decimals: int) -> str:
    """Return a decimal truncated to ``decimals`` places, without a zero before the point, in ``width`` columns."""
    text = f"{value.quantize(Decimal(1).scaleb(-decimals), rounding=ROUND_DOWN):f}"
    return text.replace("0.", ".", 1).rjust(width) if text.startswith(("0.", "-0.")) else text.rjust(width)


def test_a_program_tabulates_square_roots(engines: MakeMachine) -> None:
    """Roots truncated to eight digits are computed with integers.

    Newton's method is correct to one unit of the last digit.
    """
    result = job(engines, "roots")
    heading, rows = result.punched[:5], result.punched[5:]
    assert heading == ("", "TABLE OF SQUARE ROOTS", "", "    N     ROOT      NEWTON", "")
    assert len(rows) == 20
    for n, row in enumerate(rows, 1):
        root = Decimal(isqrt(n * 10**14)).scaleb(-7)
        assert row[:17] == f"{n:5d}" + f_field(root, 12, 7)
        assert abs(Decimal(row[17:29]) - root) <= Decimal("3E-7")
        assert abs(Decimal(row[31:].replace("-.", "-0.").strip())) <= Decimal("3E-6")
    assert result.ending.kind == "stop"


MATRICES = ["  2  3  2", "   1.0   2.0   3.0", "   4.0   5.0   6.0", "   1.0   0.5   0.0  -1.0", "   2.0   2.0"]


def test_a_program_multiplies_matrices(engines: MakeMachine) -> None:
    """By hand: rows (1,2,3) and (4,5,6) times columns (1,0,2) and (.5,-1,2) give 7, 4.5 and 16, 9."""
    result = job(engines, "matrix", *MATRICES)
    assert result.ending.kind == "undefined"  # PUNCH 5 writes all of C(3,2), whose third row is undefined
    assert result.punched == ("", "PRODUCT  2 BY  2", "ROW 1      7.00      4.50", "ROW 2     16.00      9.00")


def test_a_program_multiplies_matrices_of_full_size(engines: MakeMachine) -> None:
    rows_a = [[1, -2, 3, 0], [4, 5, -6, 7], [0, 1, 0, -1]]
    rows_b = [[1, 2], [3, -4], [-5, 6], [7, 8]]
    data = ["  3  4  2"]
    data += ["".join(f"{v:6.1f}" for v in row) for row in rows_a]
    flat = [v for row in rows_b for v in row]
    data += ["".join(f"{v:6.1f}" for v in flat[:4]), "".join(f"{v:6.1f}" for v in flat[4:])]
    product = [
        [sum(a * b for a, b in zip(row, column, strict=True)) for column in zip(*rows_b, strict=True)] for row in rows_a
    ]
    assert product == [[-20, 28], [98, 8], [-4, -12]]
    result = job(engines, "matrix", *data)
    expected = ["", "PRODUCT  3 BY  2"]
    expected += [
        f"ROW{i:2d}" + "".join(f"{v:10.2f}".replace(" 0.", "  .") for v in row) for i, row in enumerate(product, 1)
    ]
    expected += ["".join(f"{row[j]:10.2f}" for row in product) for j in range(2)]
    assert list(result.punched) == expected
    assert result.ending.kind == "hopper"


def test_a_program_integrates_by_two_rules(engines: MakeMachine) -> None:
    """By hand: Y at 0, .5, 1, 1.5, 2 is 1, 1.25, 2, 3.25, 5.

    The trapezoidal rule gives 4.75. Simpson's sum is 1 + 5 + 4 + 13 + 5 = 28; 28 * .5 = 14, and 14/3 is truncated to
    4.6666666.
    """
    result = job(engines, "simpson")
    assert result.punched == (
        "X=  .00  Y= 1.000",
        "X=  .50  Y= 1.250",
        "X= 1.00  Y= 2.000",
        "X= 1.50  Y= 3.250",
        "X= 2.00  Y= 5.000",
        "",
        "TRAPEZOID .47500000E+01  SIMPSON .46666666E+01",
        "",
    )
    assert result.typed == ("AREA= 4.750",)


@pytest.mark.parametrize("on", [(), (1,)])
def test_a_program_computes_compound_interest(engines: MakeMachine, on: tuple[int, ...]) -> None:
    """Each year's product is truncated to eight digits. The interest has the digits of the amount."""
    result = job(engines, "interest", "   1000.00 5.000 10", "   2500.50 3.250  2", on=on)
    expected: list[str] = []
    finals = []
    for principal, rate, years in (("1000.00", "5.000", 10), ("2500.50", "3.250", 2)):
        p, a = Decimal(principal), Decimal(principal)
        factor = 1 + Decimal(rate) / 100
        expected += ["", f"COMPOUND INTEREST ON{principal:>10} AT{rate:>6} PER CENT"]
        expected += ["", "  YEAR       AMOUNT     INTEREST"]
        for year in range(1, years + 1):
            a = DOWN.multiply(a, factor)
            expected.append(f"{year:6d}" + f_field(a, 13, 2) + f_field(a - p, 13, 2))
        finals.append("FINAL AMOUNT " + f_field(a, 10, 2))
    assert list(result.punched) == expected
    assert result.typed == (tuple(finals) if on else ())
    assert result.ending.kind == "hopper"


def test_a_program_finds_prime_numbers(engines: MakeMachine) -> None:
    primes = [n for n in range(2, 200) if all(n % d for d in range(2, n))]
    result = job(engines, "primes")
    assert result.punched[0] == " 46 PRIMES"
    assert result.ending.kind == "stop"
    assert result.punched[1] == "   2   3   5   7  11  13  17  19  23  29"
    assert [int(n) for card in result.punched[1:] for n in card.split()] == primes


def test_a_program_works_as_a_desk_calculator(engines: MakeMachine) -> None:
    """By hand: (2+7-4)*3 = 15; 15/7 = 2.1428571; the root of 2 is 1.4142135, and its square 1.9999998; 1-.99999999."""
    cards = ["1 2.0", "2 7.0", "3 4.0", "4 3.0", "6", "5 7.0", "6"]
    cards += ["1 2.0", "7", "6", "4 1.4142135", "6", "1 1.0", "3 .99999999", "6", "8"]
    result = job(engines, "desk", *cards)
    assert result.punched == (
        "TOTAL  .15000000E+02",
        "TOTAL  .21428571E+01",
        "TOTAL  .14142135E+01",
        "TOTAL  .19999998E+01",
        "TOTAL  .10000000E-06",
    )
    assert result.typed == ("END OF JOB",)
    assert result.cards_read == len(cards)

"""Intervals contain the exact results, for numbers of more digits than Python's default context too."""

from decimal import Decimal
from fractions import Fraction
from random import Random

import mpmath
import pytest

from emulator.language.cards import deck_from_lines
from emulator.language.compiler import compile_deck
from emulator.machine.devices import no_deck
from emulator.machine.machine import Machine
from emulator.machine.result import Options
from emulator.numbers import numbers
from emulator.numbers.interval import Interval, IntervalNumbers


def contains(value: Interval, exact: Fraction) -> bool:
    return Fraction(value[0]) <= exact <= Fraction(value[1])


def random_interval(system: IntervalNumbers, random: Random) -> Interval:
    low, high = sorted(random.randint(-(10 ** (2 * system.places)), 10 ** (2 * system.places)) for _ in range(2))
    power = random.randint(-2 * system.places - 3, -2 * system.places + 3)
    narrow = random.random() < 0.5
    return system.decimal(low, power)[0], system.decimal(low if narrow else high, power)[1]


@pytest.mark.parametrize("places", [8, 28, 29, 50])
def test_results_contain_the_exact_results_for_both_ends(places: int) -> None:
    system, random = IntervalNumbers(places), Random(places)
    for _ in range(200):
        first, second = random_interval(system, random), random_interval(system, random)
        for a in map(Fraction, first):
            assert contains(system.negate(first), -a)
            assert contains(system.integer_power(first, 2)[0], a**2)
            assert contains(system.integer_power(first, 3)[0], a**3)
            if not first[0] <= 0 <= first[1]:
                assert contains(system.integer_power(first, -3)[0], a**-3)
            low, high = map(Fraction, system.function("SQRT", first)[0])
            assert low**2 <= abs(a) <= high**2
            for b in map(Fraction, second):
                assert contains(system.add(first, second), a + b)
                assert contains(system.subtract(first, second), a - b)
                assert contains(system.multiply(first, second), a * b)
                if not second[0] <= 0 <= second[1]:
                    assert contains(system.divide(first, second), a / b)


@pytest.mark.parametrize("places", [8, 28, 29, 50])
@pytest.mark.parametrize("name", ["SIN", "COS", "ATAN", "EXP", "LOG", "power"])
def test_functions_contain_the_exact_values(places: int, name: str) -> None:
    system, random = IntervalNumbers(places), Random(places)
    with mpmath.workdps(3 * places):
        for _ in range(50):
            value = system.decimal(random.randint(1, 10**places), -places + 1)
            argument = mpmath.mpf(str(value[0]))
            result, _ = system.power(value, value) if name == "power" else system.function(name, value)
            low, high = (mpmath.mpf(str(end)) for end in result)
            assert low <= (argument**argument if name == "power" else getattr(mpmath, name.lower())(argument)) <= high


def test_roots_of_squares_are_exact_and_others_are_neighbours() -> None:
    for places in (8, 28, 29, 50):
        system = IntervalNumbers(places)
        root = 10**places - 7
        assert system.function("SQRT", (system.decimal(4, 0)))[0] == system.decimal(2, 0)
        low, high = system.function("SQRT", system.decimal(root, 0))[0]
        assert high == low.next_plus(system._up)
    assert system.function("SQRT", system.decimal(-4, 0))[0] == system.decimal(2, 0)


def test_difference_of_equal_squares_takes_no_branch_with_certainty() -> None:
    lines = [
        "A=7.",
        "B=A/3.",
        "C=-B",
        "N=2",
        "D=C**N-B*B",
        "IF(D)4,5,6",
        "    4 STOP 4",
        "    5 STOP 5",
        "    6 STOP 6",
    ]
    cards = [line if line.startswith("  ") else "      " + line for line in (*lines, "END")]
    program = compile_deck(deck_from_lines("program", cards))
    for places in (8, 28, 29, 50):
        ending = Machine(program, no_deck(program), Options(numbers(f"interval:{places}"))).run().ending
        assert ending.kind == "undecided"


@pytest.mark.parametrize("statement", ["B=EXP(A)", "B=EXP(-A)", "B=A**A", "B=A*A"])
def test_number_out_of_range_ends_the_run(statement: str) -> None:
    cards = ["      A=1.E30", "      DO 1 I=1,60", f"      {statement}", "    1 A=B*A", "      END"]
    program = compile_deck(deck_from_lines("program", cards))
    ending = Machine(program, no_deck(program), Options(numbers("interval:8"))).run().ending
    assert "interval arithmetic holds only numbers from 1E-10000 to 1E+10000" in ending.message


@pytest.mark.parametrize("name", ["SIN", "COS", "ATAN", "LOG"])
@pytest.mark.parametrize("power", [-9999, 9999])
def test_functions_of_numbers_near_the_limits_are_computed(name: str, power: int) -> None:
    system = IntervalNumbers(8)
    low, high = system.function(name, system.decimal(1, power))[0]
    if name == "LOG":
        assert low <= power * Decimal("2.302585092994046") <= high
    elif power < 0:
        assert low <= (Decimal(1) if name == "COS" else Decimal(f"1E{power}")) <= high
    else:
        assert low <= (Decimal("1.57079632679") if name == "ATAN" else 0) <= high <= 2


@pytest.mark.parametrize("sign", ["", "-"])
def test_exponential_is_limited_by_the_decimal_exponent_of_its_value(sign: str) -> None:
    system = IntervalNumbers(8)
    value, _ = system.function("EXP", system.decimal(int(f"{sign}23000"), 0))
    assert [end.adjusted() for end in value] == [-9989 if sign else 9988] * 2


def test_intervals_below_the_range_end_and_are_printed_with_all_digits() -> None:
    cards = ["      A=1.E-90", "      DO 1 I=1,12", "    1 A=A*A", "      B=ATAN(A)", "      END"]
    program = compile_deck(deck_from_lines("program", cards))
    assert Machine(program, no_deck(program), Options(numbers("interval:8"))).run().ending.kind != "undecided"
    system = IntervalNumbers(50)
    low, high = system.divide(system.decimal(1, 0), system.decimal(3, 0))
    assert system.text((low, high)) == f"[0.{'3' * 50}, 0.{'3' * 49}4]"

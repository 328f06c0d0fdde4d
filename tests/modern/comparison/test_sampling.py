"""Stochastic runs: significant digits, shares of decisions, independent runs, intervals, and sensitivity to cards."""

import math
from fractions import Fraction
from statistics import fmean, stdev

import pytest

from emulator.errors import ArgumentError
from emulator.language.cards import Deck, deck_from_lines
from emulator.language.compiler import compile_deck
from emulator.language.objectcode import Program
from emulator.machine.machine import Machine
from emulator.machine.result import Options
from emulator.numbers import Undecided, numbers
from emulator.numbers.sampled import SampledNumbers
from emulator.numbers.significance import estimate
from modern.comparison.sampling import in_step, independent, sampled
from modern.comparison.sensitivity import sensitivities


def made(*lines: str, data: tuple[str, ...] = ()) -> tuple[Program, Deck]:
    cards = [line if line[:5].strip().isdigit() else f"      {line}" for line in (*lines, "END")]
    return compile_deck(deck_from_lines("program", cards)), deck_from_lines("deck", data)


def runs(name: str) -> SampledNumbers:
    system = numbers(name)
    assert isinstance(system, SampledNumbers)
    return system


SAMPLE = [Fraction(text) for text in ("1.001", "1.002", "0.998", "1.0005", "0.9995", "1.003")]


def test_estimates_agree_with_published_formulas_and_the_package() -> None:
    # Student's t for 5 degrees is 2.571, chi-square's 2.5 % quantile 0.8312, and the normal quantile 1.960.
    estimated = estimate(SAMPLE, 8)
    assert estimated is not None
    ratio = stdev(map(float, SAMPLE)) / fmean(map(float, SAMPLE))
    assert estimated.parker == pytest.approx(-math.log10(ratio))
    assert estimated.cestac == pytest.approx(math.log10(math.sqrt(6) / (ratio * 2.570582)), abs=1e-6)
    expected = -math.log10(ratio) - math.log10(5 / 0.831212) / 2 - math.log10(1.959964)
    assert estimated.sohier == pytest.approx(expected, abs=1e-6)


def test_package_significantdigits_estimates_the_same_digits() -> None:
    """The package divides by N instead of N - 1.  Version 0.6.0 gave 2.107702 digits for this sample."""
    estimated = estimate(SAMPLE, 8)
    assert estimated is not None
    correction = math.log10(6 / 5) / 2
    assert estimated.sohier + correction == pytest.approx(2.1077015890, abs=1e-6)
    package = pytest.importorskip("significantdigits")
    values = list(map(float, SAMPLE))
    result = package.significant_digits(values, reference=fmean(values), basis=10)
    assert estimated.sohier + correction == pytest.approx(float(result), abs=1e-6)


def test_equal_values_zeros_and_opposite_roundings_are_recognised() -> None:
    exact, zero = estimate([Fraction(1, 3)] * 3, 8), estimate([Fraction(-1), Fraction(1), Fraction(1, 2)], 8)
    assert exact is not None
    assert zero is not None
    assert (exact.is_exact, exact.parker, exact.is_zero) == (True, 8, False)
    assert (zero.is_zero, zero.sohier) == (True, 0)
    assert estimate([Fraction(1), None], 8) is None
    system = runs("stochastic:8:1-3")
    for _ in range(20):
        _, second, third = system.divide(system.from_integer(1), system.from_integer(3))
        assert {second[0], third[0]} == {33333333, 33333334}


QUADRATIC = (
    *("    5 READ 1,A,B,C", "    1 FORMAT(3F10.0)", "D=B*B-4.*A*C", "R=SQRT(D)", "X=(-B-R)/(2.*A)", "PUNCH 2,X"),
    *("    2 FORMAT(E14.8)", "GO TO 5"),
)
CARD = ("       1.0     -99.9      0.01",)


def test_statements_that_cancel_keep_few_digits_and_intervals_around_zero_no_sign() -> None:
    program, deck = made(*QUADRATIC, data=CARD)
    sampling = in_step(program, deck, runs("stochastic:8:1-10"), Options(hopper="any"))
    digits = {row.line.text: row.worst for row in sampling.statements}
    assert digits["D=B*B-4.*A*C"] == 8
    assert 2 < digits["X=(-B-R)/(2.*A)"] < 3.5
    (number,) = sampling.printed
    assert (number.record, len(number.values)) == (1, 10)
    assert sampling.records == (number.columns.rstrip(),)
    system = numbers("interval:8")
    third = system.divide(system.from_integer(1), system.from_integer(3))
    rest = system.subtract(system.multiply(third, system.from_integer(3)), system.from_integer(1))
    with pytest.raises(Undecided, match=r"the sign of \[.*\] is unknown"):
        system.sign(rest)
    with pytest.raises(Undecided, match=r"the divisor .* may be zero"):
        system.divide(third, rest)
    program, deck = made(*UNSTABLE, *REST)
    assert Machine(program, deck, Options(numbers=system)).run().ending.kind == "undecided"


def test_values_of_a_run_in_step_are_those_of_the_run_with_its_seed() -> None:
    program, deck = made(*QUADRATIC, data=CARD)
    (number,) = in_step(program, deck, runs("stochastic:8:4-8"), Options(hopper="any")).printed
    separate = independent(
        program, deck, [numbers(f"stochastic:8:{seed}") for seed in range(4, 9)], Options(hopper="any")
    )
    assert number.values == separate.printed[0].values
    assert separate.shares == (5,)


UNSTABLE = ("A=1./3.", "B=A*3.-1.", "IF(B)10,20,30", "   10 TYPE 11", "   11 FORMAT(5HBELOW)", "STOP", "   20 TYPE 21")
REST = ("   21 FORMAT(4HZERO)", "STOP", "   30 TYPE 31", "   31 FORMAT(5HABOVE)", "STOP")


@pytest.mark.parametrize("choice", ["", ":majority"])
def test_disputed_decision_is_recorded_with_the_share_of_runs(choice: str) -> None:
    program, deck = made(*UNSTABLE, *REST)
    sampling = in_step(program, deck, runs(f"stochastic:8:1-20{choice}"))
    (decision,) = sampling.decisions
    signs = [0, 0, 0]
    for seed in range(1, 21):
        typed = Machine(program, deck, Options(numbers=numbers(f"stochastic:8:{seed}"))).run().typed[0]
        signs[("BELOW", "ZERO", "ABOVE").index(typed)] += 1
    assert (decision.times, decision.disputed, decision.shares) == (1, 1, tuple(signs))
    assert max(signs) < 20
    if choice:
        assert signs[decision.taken + 1] == max(signs)
    separate = independent(program, deck, [numbers(f"stochastic:8:{seed}") for seed in range(1, 21)])
    assert separate.shares == tuple(sorted(filter(None, signs), reverse=True))
    (decision,) = separate.decisions
    assert (decision.times, decision.disputed, decision.shares) == (1, 1, tuple(signs))
    assert signs[decision.taken + 1] == max(signs)


def test_independent_runs_compare_the_executions_of_an_if_that_they_reach() -> None:
    """Each run leaves the loop at a different execution, so fewer runs reach the later ones."""
    lines = (
        "A=0.",
        "DO 5 I=1,40",
        "A=A+1./3.",
        "IF(A-9.)5,6,6",
        "    5 CONTINUE",
        "    6 TYPE 7,I",
        "    7 FORMAT(I4)",
    )
    program, deck = made(*lines)
    members = [numbers(f"stochastic:4:{seed}:proportional") for seed in range(1, 21)]
    (decision,) = independent(program, deck, members).decisions
    ends = [int(Machine(program, deck, Options(numbers=member)).run().typed[0]) for member in members]
    assert decision.times == max(ends)
    assert decision.time == min(ends) < max(ends)
    assert sum(decision.shares[1:]) == ends.count(min(ends))
    assert sum(decision.shares) == 20


def test_if_takes_the_branch_for_zero_if_the_number_is_a_computational_zero() -> None:
    system = runs("stochastic:8:1-3")
    one, minus = ((10**7, -6), (-(10**7), -6))
    assert system.sign((one, minus, one)) == 0
    # CADNA's program rounds the estimate, here 0.2 digits, and asks for the digits also if all signs are equal.
    assert system.sign((one, one, (15_000_000, -6))) == 0
    assert system.sign((one, one, (11_000_000, -6))) == 1
    majority = runs("stochastic:8:1-3:majority")
    assert majority.sign((one, minus, one)) == majority.sign((one, one, (15_000_000, -6))) == 1
    assert system.text((one, minus, one)) == "@.0"
    assert system.text(((12345678, 1), (12345679, 1), (12345677, 1))) == "1.234568 (7.1 digits)"


@pytest.mark.parametrize(
    ("studied", "name"),
    [
        ("truncating", "stochastic:8:1-10"),
        ("float64", "stochastic:53b:1-10"),
        ("mp:100", "stochastic:100b:1-10"),
        ("exact", "stochastic:8:1-10"),
    ],
)
def test_runs_have_the_digits_of_the_arithmetic_studied(studied: str, name: str) -> None:
    assert sampled(numbers(studied)).name == name


@pytest.mark.parametrize("name", ["stochastic:8:1-1", "stochastic:8:1-2000", "stochastic:8:1:majority"])
def test_runs_in_step_need_a_range_of_seeds(name: str) -> None:
    with pytest.raises(ArgumentError, match="a range"):
        numbers(name)


def test_sensitivity_is_the_relative_change_of_the_result_for_one_unit_of_a_card() -> None:
    program, deck = made(*QUADRATIC, data=CARD)
    machine = Machine(program, deck, Options(numbers("exact"), hopper="any"))
    result = machine.run()
    rows, omitted = sensitivities(machine, result)
    assert omitted == 0
    effect = {(row.card, row.column): row for row in rows}
    assert [row.changed.strip() for row in rows] == ["1.1", "-99.8", "0.02"]
    change = effect[1, 21].change
    assert change is not None
    assert change == pytest.approx(1, abs=0.001)
    assert effect[1, 11].record == 1
    assert sensitivities(machine, result, most=2) == (rows[:2], 1)

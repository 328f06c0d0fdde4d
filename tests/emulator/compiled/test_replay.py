"""A recorded run, repeated in other arithmetics along the branch that the machine took."""

from fractions import Fraction

import pytest

from emulator.compiled.replay import compile_repetitions, enclosed, exactly, repetitions
from emulator.language.cards import deck_from_lines
from emulator.language.compiler import compile_deck
from emulator.machine.machine import Machine
from emulator.machine.result import Options
from emulator.machine.tape import ADD, DIVIDE, LEAF, MULTIPLY, NEGATE, Tape, record
from emulator.numbers import numbers
from emulator.numbers.arithmetic import Rules, profile

DIGITS = 8
EIGHT = Options(numbers("truncating"))
# A loop that adds thirds and takes one of three branches by the sign of a difference that truncation makes negative.
PROGRAM = """
      READ 1,A,B
    1 FORMAT(2F10.4)
      S=0.
      DO 5 I=1,3
    5 S=S+A/B
      IF(S-A)6,7,8
    6 C=-S*A
      GO TO 9
    7 C=S+A
      GO TO 9
    8 C=S
    9 PUNCH 2,C
    2 FORMAT(E14.8)
      END
"""


def taped(cards: tuple[str, ...] = ("    1.0000    3.0000",), source: str = PROGRAM) -> Tape:
    program = compile_deck(deck_from_lines("thirds.f", source.strip("\n").split("\n")))
    return record(program, deck_from_lines("cards", cards), EIGHT)


def rules_of(name: str) -> Rules:
    return profile(name).rules


@pytest.fixture(scope="module")
def tape() -> Tape:
    return taped()


def test_machine_takes_the_branch_for_a_negative_number_and_exact_arithmetic_that_for_zero(tape: Tape) -> None:
    (test,) = tape.tests
    exact = exactly(tape, DIGITS)
    # The sum .99999999 loses its last digit when it is aligned with 1.
    assert tape.number(test.place) == (-10_000_000, -6)
    assert exact[test.place] == 0
    assert test.taken == test.target(-1) != test.target(exact[test.place]) == test.target(0)


def test_repetition_in_the_same_arithmetic_and_with_more_digits_equals_the_run(tape: Tape) -> None:
    ((mantissas, exponents),) = repetitions(tape, DIGITS, [rules_of("truncating")])
    assert list(zip(mantissas, exponents, strict=True)) == [tape.number(test.place) for test in tape.tests]
    # The branch is the machine's, so the number that is tested is compared.
    ((mantissas, exponents),) = repetitions(tape, DIGITS, [rules_of("truncating:16")])
    assert (mantissas, exponents) == ([-(10**15)], [-14])


def test_exact_values_and_intervals_follow_the_branch_of_the_machine(tape: Tape) -> None:
    assert exactly(tape, DIGITS)[-1] == -1
    assert all(isinstance(value, Fraction) for value in exactly(tape, DIGITS))
    for (low, high), exact, k in zip(enclosed(tape, DIGITS), exactly(tape, DIGITS), range(99), strict=False):
        assert Fraction(low) <= exact <= Fraction(high)
        if tape.operations[k] == LEAF:
            assert low == high
    low, high = enclosed(tape, DIGITS)[tape.tests[0].place]
    assert low < 0 < high


def test_change_of_sign_is_exact_for_numbers_of_any_length() -> None:
    """Eight digits squared three times have 64 digits, more than Python's default context."""
    tape = Tape()
    tape.enter(LEAF, 0, 0, 12_345_679, 1)
    for k in range(3):
        tape.enter(MULTIPLY, k, k, 0, 0)
    tape.enter(NEGATE, 3, 3, 0, 0)
    tape.enter(ADD, 3, 4, 0, 0)
    exact = exactly(tape, DIGITS)
    assert exact[3] == Fraction("1.2345679") ** 8
    assert exact[5] == 0
    low, high = enclosed(tape, DIGITS)[5]
    assert low < 0 < high


def test_sums_beyond_the_range_of_intervals_are_unbounded() -> None:
    tape = Tape()
    tape.enter(LEAF, 0, 0, 10_000_000, 1)
    tape.enter(LEAF, 0, 0, 0, 0)
    tape.enter(DIVIDE, 0, 1, 0, 0)
    for k in range(2, 22):
        tape.enter(ADD, k, k, 0, 0)
    low, high = enclosed(tape, DIGITS)[-1]
    assert low == -high < -(10**9999)


@pytest.mark.parametrize("b", ["    0.0000", "    4.0000"])
def test_quotients_without_rounding_and_by_zero(b: str) -> None:
    divided = taped((f"    1.0000{b}",))
    assert not divided.is_rounded(exactly(divided, DIGITS), DIGITS) or b == "    0.0000"
    low, high = enclosed(divided, DIGITS)[divided.tests[0].place]
    assert low <= exactly(divided, DIGITS)[divided.tests[0].place] <= high


def test_samples_surround_the_exact_value_and_are_the_same_for_the_same_seed(tape: Tape) -> None:
    seeds = [rules_of_stochastic(seed) for seed in range(40)]
    drawn = [
        mantissas[0] * 10.0 ** (exponents[0] - DIGITS) for mantissas, exponents in repetitions(tape, DIGITS, seeds)
    ]
    assert min(drawn) < 0 < max(drawn)
    assert list(repetitions(tape, DIGITS, seeds[:2])) == list(repetitions(tape, DIGITS, seeds[:2]))


def test_samples_are_those_of_the_interpreter_without_numba(tape: Tape, monkeypatch) -> None:
    seeds = [rules_of_stochastic(seed) for seed in (1, 2)]
    compile_repetitions()
    compiled = list(repetitions(tape, DIGITS, seeds))
    monkeypatch.setattr("emulator.compiled.replay._compiled", lambda: None)
    assert list(repetitions(tape, DIGITS, seeds)) == compiled


def rules_of_stochastic(seed: int) -> Rules:
    rules: Rules = numbers(f"stochastic:8:{seed}").profile.rules
    return rules


def test_a_recording_is_the_run_of_the_machine_up_to_a_test() -> None:
    tape = taped()
    part = tape.until(0)
    assert part.tests == tape.tests
    assert len(part.operations) == tape.tests[0].place + 1 < len(tape.operations)
    assert tape.until(-1).tests == []
    program = compile_deck(deck_from_lines("thirds.f", PROGRAM.strip("\n").split("\n")))
    deck = deck_from_lines("cards", ["    1.0000    3.0000"])
    (card,) = Machine(program, deck, EIGHT).run().punched
    assert card.strip() == ".99999999E+00" or card.strip() == "-.99999999E+00"
    tape = record(program, deck, EIGHT)
    assert tape.number(len(tape.operations) - 1)[0] in (99_999_999, -99_999_999)


@pytest.mark.parametrize("call", ["SQRT(A)", "A**B"])
def test_functions_and_powers_end_the_recording(call: str) -> None:
    source = "\n".join(["      READ 1,A,B", "    1 FORMAT(2F10.4)", f"      C={call}", "      D=A+B", "      END"])
    assert len(taped(source=source).tests) == 0

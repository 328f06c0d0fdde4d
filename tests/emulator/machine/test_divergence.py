"""Two arithmetics compared: the first value and decision that differ, where runs join again, and digits lost."""

import random
from collections.abc import Sequence

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from emulator.errors import CardError, DeckError, EmulatorError
from emulator.language.cards import deck_from_lines
from emulator.language.compiler import translate
from emulator.language.control_flow import successors
from emulator.language.objectcode import Line, Program
from emulator.machine.divergence import Divergence, diverge
from emulator.machine.machine import Machine
from emulator.machine.postdominators import meeting, post_dominators
from emulator.machine.result import Options
from emulator.numbers import numbers
from tests.support.decks_at_random import DATA, programs
from tests.support.deckwork import program, source, within
from tests.support.systems import SYSTEMS

NAMES = st.sampled_from(SYSTEMS)


def compared(*lines: str, data: Sequence[str] = (), names: tuple[str, str] = ("truncating", "exact")) -> Divergence:
    return diverge(
        program(*lines), deck_from_lines("d", data), numbers(names[0]), numbers(names[1]), Options(limit=5_000)
    )


THIRD = ["A=1./3.", "B=A*3.", "IF(B-1.)10,20,10", "10 K=1", "C=A+1.", "GO TO 30", "20 K=2", "30 D=A*2.", "END"]


def test_a_third_times_three_differs_from_one() -> None:
    """.33333333 * 3 is .99999999, not 1 (computed by hand)."""
    divergence = compared(*THIRD)
    first = divergence.first_value
    assert first is not None
    assert (first.line.place.card, first.names) == (1, ("A", "A"))
    assert first.values == ("0.33333333", "0.33333333333333333333...")
    assert first.relative == pytest.approx(1e-8)
    decision = divergence.first_decision
    assert decision is not None
    assert (decision.line.place.card, decision.line.text) == (3, "IF(B-1.)10,20,10")
    # 1 is .10000000E+01, so that the last digit of .99999999 is lost before the subtraction.
    assert decision.values == ("-1E-7", "0")
    assert [target and target.label for target in decision.targets] == [10, 20]
    # A and B are stored before the decision, K and C after it; D is stored after the runs have joined at 30.
    assert (divergence.compared, divergence.values, divergence.values_in_step) == (3, 3, 2)
    assert (divergence.tested, divergence.decisions) == (1, 1)
    assert divergence.apart == ""
    assert divergence.digits == 8
    assert divergence.statements == (8, 6)
    assert [(loss.line.place.card, loss.times, loss.differing) for loss in divergence.losses] == [(1, 1, 1), (2, 1, 1)]
    assert [loss.worst for loss in divergence.losses] == [0.0, 0.0]
    assert divergence.endings[0] == divergence.endings[1]


def test_a_difference_of_close_numbers_loses_digits() -> None:
    """The difference consists only of ninth digits, which are truncated on input (computed by hand)."""
    lines = ["READ 1,A,B", "C=A-B", "D=C-C", "1 FORMAT(2F14.8)", "END"]
    divergence = compared(*lines, data=["1234567.8599001234567.8399000"])
    losses = {loss.line.place.card: loss for loss in divergence.losses}
    # Both are 1234567.8 in eight digits, so that the difference .02 is lost completely.
    assert losses[2].worst == 8.0
    # .0599 and .0399 of 1234567.8 are relative differences of 4.9E-8 and 3.2E-8: .7 and .5 of a digit.
    assert (losses[1].worst, losses[1].median) == (0.7, 0.6)
    assert losses[3].differing == 0
    first = divergence.first_value
    assert first is not None
    assert (first.line.place.card, first.names[0], first.values) == (1, "A", ("1234567.8", "1234567.8599"))


def test_losses_and_earlier_ends_of_loops_are_counted() -> None:
    # Three of five quotients are truncated.
    lines = ["READ 1,N", "DO 5 I=1,5", "READ 2,X", "5 Y=1./X", "1 FORMAT(I2)", "2 FORMAT(F6.0)", "END"]
    divergence = compared(*lines, data=[" 5", "1.", "2.", "9.", "11.", "3."], names=("truncating:2", "exact"))
    loss = next(loss for loss in divergence.losses if loss.line.label == 5)
    assert (loss.line.label, loss.times, loss.differing) == (5, 5, 3)
    # Relative differences: 1 % for .11 (1/9), .33 (1/3) and .090 (1/11), none for 1 and .5.
    assert (loss.worst, loss.median) == (0.0, 0.0)
    zero = compared(*lines, data=[" 5", "1.", "2.", "6.", "7.", "13."], names=("truncating:2", "exact")).losses[0]
    # Relative differences: 4 % for .16 (1/6), which is .6 of a digit, 2 % for .14 (1/7), 1.2 % for .076 (1/13).
    assert (zero.worst, zero.median) == (0.6, 0.1)
    # N is 3 in one run and 2 in the other. The DO decides differently, and the runs join after it.
    lines = ["A=1./3.", "B=A*9.", "N=B", "DO 5 I=1,N", "5 K=I", "M=7", "END"]
    divergence = compared(*lines)
    decision = divergence.first_decision
    assert decision is not None
    assert (decision.line.place.card, decision.time, decision.values) == (4, 2, ("3", "3"))
    assert [target and target.place.card for target in decision.targets] == [6, 5]
    assert (divergence.decisions, divergence.apart) == (1, "")


def test_decisions_include_joined_branches_and_computed_go_tos() -> None:
    divergence = compared("A=1./3.", "IF(A*3.-1.)10,20,10", "10 STOP", "20 K=2", "END")
    assert divergence.decisions == 1
    assert divergence.apart == "the two runs took different branches, which do not join again"
    # Each of nine thirds takes another branch than the exact one, and all join at 30.
    lines = ["A=1./3.", "DO 30 I=1,9", "IF(A*3.-1.)10,30,10", "10 K=1", "30 CONTINUE", "END"]
    divergence = compared(*lines)
    assert (divergence.decisions, divergence.apart) == (9, "")
    assert divergence.first_decision is not None
    assert divergence.first_decision.time == 1
    lines = ["A=1./3.", "J=A*3.", "K=J+1", "GO TO(5,6),K", "5 CONTINUE", "6 M=1", "END"]
    decision = compared(*lines).first_decision
    assert decision is not None
    assert (decision.line.place.card, decision.values) == (4, ("1", "2"))


def test_endings_of_exact_numbers_missing_cards_and_limits_are_reported() -> None:
    divergence = compared("A=2.", "B=SIN(A)", "C=B", "END")
    assert (divergence.decisions, divergence.values) == (0, 0)
    message = "exact ended: deck.f: card 2: exact arithmetic cannot hold SIN of 2, in B=SIN(A)"
    assert divergence.apart == f"{message}; --against mp:200 compares with 200 bits instead"
    # After the runs have diverged, a missing card is not an error of the command.
    lines = ["READ 1,N", "A=1./3.", "IF(A*3.-1.)10,20,10", "10 READ 1,N", "20 K=1", "1 FORMAT(I2)", "END"]
    divergence = compared(*lines, data=[" 1"])
    assert divergence.decisions == 1
    assert divergence.endings[0] is not None
    assert divergence.endings[0].kind == "input"
    divergence = compared("K=0", "5 K=K+1", "GO TO 5", "END")
    assert (divergence.apart, divergence.statements) == ("", (5_000, 5_000))
    assert [ending and ending.kind for ending in divergence.endings] == ["limit", "limit"]


def test_equal_values_and_copies_do_not_differ() -> None:
    divergence = compared("A=.1", "B=A", "END", names=("float64", "exact"))
    assert divergence.first_value is not None
    assert divergence.first_value.values == ("0.10000000000000000555...", "0.1")
    divergence = compared("DIMENSION X(3)", "X(1)=X(2)", "Y=1.", "END")
    assert (divergence.compared, divergence.values) == (2, 0)


@pytest.mark.parametrize("names", [("float64", "float64"), ("float32", "float64"), ("float64", "mp:80")])
def test_infinities_and_nans_are_equal(names: tuple[str, str]) -> None:
    """-2/0 is minus infinity in both arithmetics, and its difference with itself is not a number; 2/0 differs."""
    lines = ["Z=0.", "A=-2./Z", "B=A", "C=A-A", "D=C", "END"]
    divergence = compared(*lines, names=names)
    assert (divergence.compared, divergence.values, divergence.apart) == (5, 0, "")


def test_bad_cards_and_large_programs_raise_their_errors() -> None:
    with pytest.raises(CardError, match="d: card 1, column 1: 'X' is not a number"):
        compared("READ 1,A", "1 FORMAT(E14.8)", "END", data=["X"])
    with pytest.raises(DeckError, match="the hopper is empty"):
        compared("READ 1,A", "1 FORMAT(E14.8)", "END")
    with pytest.raises(DeckError, match="OVERLAP"):
        compared("DIMENSION X(3900)", "X(1)=1.", "END")


def test_comparisons_without_values_and_reads_at_the_end_are_possible() -> None:
    made, deck = program(*THIRD), deck_from_lines("d", [])
    divergence = diverge(made, deck, numbers("truncating"), numbers("exact"), values=False)
    assert divergence.first_decision == compared(*THIRD).first_decision
    assert (divergence.first_value, divergence.compared, divergence.losses) == (None, 0, ())
    made = program("1 READ 2,A", "GO TO 1", "2 FORMAT(E14.8)", "END")
    follow = successors(made)
    assert any(len(made.code) in after for after in follow)
    assert post_dominators(follow)[0]


# Laws, checked on random programs.


def divergence_or_none(
    cards: list[str], data: list[str], studied: str, reference: str, values: bool = True
) -> Divergence | None:
    with within(30):
        try:
            made, _ = translate(source(*cards))
            if made is None:
                return None
            systems, options = map(numbers, (studied, reference)), Options(limit=600)
            return diverge(made, deck_from_lines("d", data), *systems, options, values=values, rounding=False)
        except EmulatorError:
            return None


@settings(max_examples=30)
@given(programs(), DATA, NAMES)
def test_an_arithmetic_does_not_differ_from_itself(cards: list[str], data: list[str], name: str) -> None:
    divergence = divergence_or_none(cards, data, name, name)
    if divergence is not None:
        assert (divergence.first_value, divergence.first_decision, divergence.values, divergence.apart) == (
            None,
            None,
            0,
            "",
        )
        assert not any(loss.differing or loss.worst for loss in divergence.losses)


@settings(max_examples=30)
@given(programs(), DATA, NAMES, NAMES)
def test_differences_do_not_depend_on_the_choice_of_reference(cards, data, studied, reference) -> None:
    """Without values the first decision is the same."""
    divergence, exchanged = (
        divergence_or_none(cards, data, studied, reference),
        divergence_or_none(cards, data, reference, studied),
    )
    quick = divergence_or_none(cards, data, studied, reference, values=False)
    if divergence is None or exchanged is None or quick is None:
        assert (divergence is None) == (exchanged is None)
        return
    assert (divergence.compared, divergence.values, divergence.decisions) == (
        exchanged.compared,
        exchanged.values,
        exchanged.decisions,
    )
    assert (divergence.statements, divergence.endings) == (exchanged.statements[::-1], exchanged.endings[::-1])
    for studied_first, reference_first in (
        (divergence.first_decision, exchanged.first_decision),
        (divergence.first_value, exchanged.first_value),
    ):
        assert (studied_first and (studied_first.line, studied_first.time)) == (
            reference_first and (reference_first.line, reference_first.time)
        )
        assert (studied_first and studied_first.values) == (reference_first and reference_first.values[::-1])
    assert quick.first_decision == divergence.first_decision


def traced_statements(made: Program, data: list[str], name: str) -> list[Line]:
    """Return the statements that a run executes, from a tracer instead of the journal."""
    begun: list[Line] = []
    machine = Machine(made, deck_from_lines("d", data), Options(numbers=numbers(name), limit=600))
    machine.tracer = lambda line, _: begun.append(line)
    try:
        machine.run()
    except EmulatorError:
        return []
    return begun


@settings(max_examples=40)
@given(programs(), DATA, NAMES, NAMES)
def test_the_first_decision_is_where_two_traces_first_differ(cards, data, studied, reference) -> None:
    divergence = divergence_or_none(cards, data, studied, reference)
    if divergence is None:
        return
    made, _ = translate(source(*cards))
    assert made is not None
    studied_first, reference_first = traced_statements(made, data, studied), traced_statements(made, data, reference)
    split = next((k for k, (a, b) in enumerate(zip(studied_first, reference_first, strict=False)) if a is not b), -1)
    if divergence.first_decision is None:
        assert split < 0
    elif split > 0:
        assert (studied_first[split], reference_first[split]) == divergence.first_decision.targets or studied_first[
            split - 1
        ] is divergence.first_decision.line


# Post-dominators.


@settings(max_examples=100)
@given(st.integers(1, 12), st.integers(0, 10**9))
def test_post_dominators_agree_with_their_definition(size: int, seed: int) -> None:
    """d is on every path from n to the end if and only if the end cannot be reached from n without d."""
    r = random.Random(seed)
    follow = [tuple(r.randint(0, size) for _ in range(r.randint(1, 3))) for _ in range(size)]

    def reaches(start: int, without: int) -> bool:
        seen, stack = {without}, [start]
        while stack:
            at = stack.pop()
            if at == size:
                return start != without
            if at not in seen:
                seen.add(at)
                stack.extend(follow[at])
        return False

    sets = post_dominators(follow)
    every = [{d for d in range(size) if d == n or not reaches(n, d)} for n in range(size)]
    for n in range(size):
        if not reaches(n, -1):
            assert sets[n] == 0
            continue
        assert {d for d in range(size) if sets[n] >> d & 1} == every[n]
        for m in range(size):
            if reaches(m, -1):
                both = every[n] & every[m]
                assert (meeting(sets, n, m) in both) == bool(both)

"""Two arithmetics in step: first differing value and decision, where runs meet again, digits lost."""

from __future__ import annotations

import random
from collections.abc import Sequence

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from emulator.errors import CardError, DeckError, EmulatorError
from emulator.language.cards import deck_from_lines
from emulator.language.compiler import translate
from emulator.language.objectcode import Line, Program
from emulator.machine.divergence import Divergence, diverge
from emulator.machine.machine import Machine
from emulator.machine.postdominators import meeting, post_dominators, successors
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


def test_a_third_three_times() -> None:
    """.33333333 * 3 is .99999999, not 1: worked out by hand."""
    found = compared(*THIRD)
    first = found.first_value
    assert first is not None
    assert (first.line.place.card, first.names) == (1, ("A", "A"))
    assert first.values == ("0.33333333", "0.33333333333333333333...")
    assert first.relative == pytest.approx(1e-8)
    decision = found.first_decision
    assert decision is not None
    assert (decision.line.place.card, decision.line.text) == (3, "IF(B-1.)10,20,10")
    # 1 is .10000000E+01: the last digit of .99999999 drops before the subtraction.
    assert decision.values == ("-1E-7", "0")
    assert [target and target.label for target in decision.targets] == [10, 20]
    # A and B before the decision; K and C are apart; D after the runs have met at 30.
    assert (found.compared, found.values, found.values_in_step) == (3, 3, 2)
    assert (found.tested, found.decisions) == (1, 1)
    assert found.apart == ""
    assert found.digits == 8
    assert found.statements == (8, 6)
    assert [(loss.line.place.card, loss.times, loss.differing) for loss in found.losses] == [(1, 1, 1), (2, 1, 1)]
    assert [loss.worst for loss in found.losses] == [0.0, 0.0]
    assert found.endings[0] == found.endings[1]


def test_digits_lost_in_a_difference() -> None:
    """Ninth digits that are cut when read are all that a difference leaves: worked out by hand."""
    lines = ["READ 1,A,B", "C=A-B", "D=C-C", "1 FORMAT(2F14.8)", "END"]
    found = compared(*lines, data=["1234567.8599001234567.8399000"])
    losses = {loss.line.place.card: loss for loss in found.losses}
    # 1234567.8 on both: nothing is left of .02, and nothing is right of it.
    assert losses[2].worst == 8.0
    # .0599 and .0399 of 1234567.8 are relative differences of 4.9E-8 and 3.2E-8: .7 and .5 of a digit.
    assert (losses[1].worst, losses[1].median) == (0.7, 0.6)
    assert losses[3].differing == 0
    first = found.first_value
    assert first is not None
    assert (first.line.place.card, first.names[0], first.values) == (1, "A", ("1234567.8", "1234567.8599"))


def test_worst_and_median() -> None:
    """Five quotients, of which three are cut."""
    lines = ["READ 1,N", "DO 5 I=1,5", "READ 2,X", "5 Y=1./X", "1 FORMAT(I2)", "2 FORMAT(F6.0)", "END"]
    found = compared(*lines, data=[" 5", "1.", "2.", "9.", "11.", "3."], names=("truncating:2", "exact"))
    loss = next(loss for loss in found.losses if loss.line.label == 5)
    assert (loss.line.label, loss.times, loss.differing) == (5, 5, 3)
    # .11 for 1/9 and .33 for 1/3: one in a hundred; .090 for 1/11: as much; nothing for 1 and .5.
    assert (loss.worst, loss.median) == (0.0, 0.0)
    zero = compared(*lines, data=[" 5", "1.", "2.", "6.", "7.", "13."], names=("truncating:2", "exact")).losses[0]
    # .16 for 1/6: 4 in a hundred, .6 of a digit; .14 for 1/7: 2 in a hundred; .076 for 1/13: 1.2 in a hundred.
    assert (zero.worst, zero.median) == (0.6, 0.1)


def test_ways_that_do_not_meet_again() -> None:
    found = compared("A=1./3.", "IF(A*3.-1.)10,20,10", "10 STOP", "20 K=2", "END")
    assert found.decisions == 1
    assert found.apart == "the branches do not join again"


def test_runs_in_an_endless_loop_do_not_meet() -> None:
    found = compared("A=1./3.", "IF(A*3.-1.)10,20,10", "10 GO TO 10", "20 GO TO 20")
    assert found.apart == "the branches do not join again"


def test_decisions_after_the_runs_have_met() -> None:
    """Nine thirds: each of them goes another way than the exact one, and all meet at 30."""
    lines = ["A=1./3.", "DO 30 I=1,9", "IF(A*3.-1.)10,30,10", "10 K=1", "30 CONTINUE", "END"]
    found = compared(*lines)
    assert (found.decisions, found.apart) == (9, "")
    assert found.first_decision is not None
    assert found.first_decision.time == 1


def test_a_loop_that_ends_earlier_in_one_run() -> None:
    """N is 3 in one run and 2 in the other: the DO decides differently, and the runs meet after it."""
    lines = ["A=1./3.", "B=A*9.", "N=B", "DO 5 I=1,N", "5 K=I", "M=7", "END"]
    found = compared(*lines)
    decision = found.first_decision
    assert decision is not None
    assert (decision.line.place.card, decision.time, decision.values) == (4, 2, ("3", "3"))
    assert [target and target.place.card for target in decision.targets] == [6, 5]
    assert (found.decisions, found.apart) == (1, "")


def test_a_computed_go_to_is_a_decision() -> None:
    lines = ["A=1./3.", "J=A*3.", "K=J+1", "GO TO(5,6),K", "5 CONTINUE", "6 M=1", "END"]
    decision = compared(*lines).first_decision
    assert decision is not None
    assert (decision.line.place.card, decision.values) == (4, ("1", "2"))


def test_an_end_that_exact_numbers_make() -> None:
    found = compared("A=2.", "B=SIN(A)", "C=B", "END")
    assert (found.decisions, found.values) == (0, 0)
    assert found.apart == "exact ended: deck.f: card 2: exact arithmetic cannot hold SIN of 2, in B=SIN(A)"


def test_runs_that_end_otherwise_at_the_same_place() -> None:
    found = compared("A=2.", "B=SIN(A)", "END", names=("float64", "exact"))
    assert found.apart.startswith("exact ended: ")


def test_equal_texts_are_told_apart() -> None:
    found = compared("A=.1", "B=A", "END", names=("float64", "exact"))
    assert found.first_value is not None
    assert found.first_value.values == ("0.10000000000000000555...", "0.1")


def test_undefined_copies_are_the_same() -> None:
    found = compared("DIMENSION X(3)", "X(1)=X(2)", "Y=1.", "END")
    assert (found.compared, found.values) == (2, 0)


@pytest.mark.parametrize("names", [("float64", "float64"), ("float32", "float64"), ("float64", "mp:80")])
def test_infinities_and_what_is_no_number_are_the_same(names: tuple[str, str]) -> None:
    """-2/0 is minus infinity in each of them, and that less itself no number; 2/0 is another value."""
    lines = ["Z=0.", "A=-2./Z", "B=A", "C=A-A", "D=C", "END"]
    found = compared(*lines, names=names)
    assert (found.compared, found.values, found.apart) == (5, 0, "")


def test_a_bad_card_is_a_bad_card() -> None:
    with pytest.raises(CardError, match="d: card 1, column 1: 'X' is not a number"):
        compared("READ 1,A", "1 FORMAT(E14.8)", "END", data=["X"])
    with pytest.raises(DeckError, match="the hopper is empty"):
        compared("READ 1,A", "1 FORMAT(E14.8)", "END")


def test_a_program_too_large_is_refused() -> None:
    with pytest.raises(DeckError, match="OVERLAP"):
        compared("DIMENSION X(3900)", "X(1)=1.", "END")


def test_a_card_only_one_run_reads() -> None:
    """After the ways part one run wants a card that is not there: its ending, not an error of the command's."""
    lines = ["READ 1,N", "A=1./3.", "IF(A*3.-1.)10,20,10", "10 READ 1,N", "20 K=1", "1 FORMAT(I2)", "END"]
    found = compared(*lines, data=[" 1"])
    assert found.decisions == 1
    assert found.endings[0] is not None
    assert found.endings[0].kind == "input"


def test_the_limit_ends_both() -> None:
    found = compared("K=0", "5 K=K+1", "GO TO 5", "END")
    assert (found.apart, found.statements) == ("", (5_000, 5_000))
    assert [ending and ending.kind for ending in found.endings] == ["limit", "limit"]


def test_without_values_only_the_first_decision() -> None:
    made, deck = program(*THIRD), deck_from_lines("d", [])
    found = diverge(made, deck, numbers("truncating"), numbers("exact"), values=False)
    assert found.first_decision == compared(*THIRD).first_decision
    assert (found.first_value, found.compared, found.losses) == (None, 0, ())


# Laws, over random programs.


def tried(cards: list[str], data: list[str], one: str, other: str, values: bool = True) -> Divergence | None:
    with within(30):
        try:
            made, _ = translate(source(*cards))
            if made is None:
                return None
            systems, options = map(numbers, (one, other)), Options(limit=600)
            return diverge(made, deck_from_lines("d", data), *systems, options, values=values, rounding=False)
        except EmulatorError:
            return None


@settings(max_examples=30)
@given(programs(), DATA, NAMES)
def test_an_arithmetic_does_not_differ_from_itself(cards: list[str], data: list[str], name: str) -> None:
    found = tried(cards, data, name, name)
    if found is not None:
        assert (found.first_value, found.first_decision, found.values, found.apart) == (None, None, 0, "")
        assert not any(loss.differing or loss.worst for loss in found.losses)


@settings(max_examples=30)
@given(programs(), DATA, NAMES, NAMES)
def test_turned_about(cards: list[str], data: list[str], one: str, other: str) -> None:
    """What differs does not depend on which of the two is the reference; without values the decision is the same."""
    found, turned = tried(cards, data, one, other), tried(cards, data, other, one)
    quick = tried(cards, data, one, other, values=False)
    if found is None or turned is None or quick is None:
        assert (found is None) == (turned is None)
        return
    assert (found.compared, found.values, found.decisions) == (turned.compared, turned.values, turned.decisions)
    assert (found.statements, found.endings) == (turned.statements[::-1], turned.endings[::-1])
    for mine, yours in ((found.first_decision, turned.first_decision), (found.first_value, turned.first_value)):
        assert (mine and (mine.line, mine.time)) == (yours and (yours.line, yours.time))
        assert (mine and mine.values) == (yours and yours.values[::-1])
    assert quick.first_decision == found.first_decision


def statements_of(made: Program, data: list[str], name: str) -> list[Line]:
    """The statements a run begins, by a tracer: the way without a journal."""
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
def test_the_first_decision_by_tracing_both(cards: list[str], data: list[str], one: str, other: str) -> None:
    """The first decision that differs is where the statements two tracers see first differ."""
    found = tried(cards, data, one, other)
    if found is None:
        return
    made, _ = translate(source(*cards))
    assert made is not None
    mine, yours = statements_of(made, data, one), statements_of(made, data, other)
    part = next((k for k, (a, b) in enumerate(zip(mine, yours, strict=False)) if a is not b), -1)
    if found.first_decision is None:
        assert part < 0
    elif part > 0:
        assert (mine[part], yours[part]) == found.first_decision.targets or mine[part - 1] is found.first_decision.line


# Where ways meet.


@settings(max_examples=100)
@given(st.integers(1, 12), st.integers(0, 10**9))
def test_post_dominators_by_their_meaning(size: int, seed: int) -> None:
    """d is on every path from n to the end just when the end cannot be reached from n without d."""
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

    parents = post_dominators(follow)
    for n in range(size):
        if not reaches(n, -1):
            assert parents[n] == -1
            continue
        every = {d for d in range(size + 1) if d not in (n, size) and not reaches(n, d)} | {size}
        chain, at = set(), n
        while at != size:
            at = parents[at]
            chain.add(at)
        assert chain == every
        for m in range(size):
            if reaches(m, -1):
                both = (every | {n}) & ({d for d in range(size) if d != m and not reaches(m, d)} | {m})
                assert (meeting(parents, n, m) in both) == bool(both)


def test_the_end_of_a_run_is_behind_every_read() -> None:
    made = program("1 READ 2,A", "GO TO 1", "2 FORMAT(E14.8)", "END")
    follow = successors(made)
    assert any(len(made.code) in after for after in follow)
    assert post_dominators(follow)[0] >= 0

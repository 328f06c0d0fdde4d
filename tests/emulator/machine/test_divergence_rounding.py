"""References that round: differences that their own rounding may explain are not counted."""

from fractions import Fraction

import pytest
from hypothesis import given, settings

from emulator.errors import EmulatorError
from emulator.language.cards import deck_from_lines
from emulator.language.compiler import translate
from emulator.language.objectcode import FIX
from emulator.machine.divergence import Divergence, diverge
from emulator.machine.result import Options
from emulator.numbers import numbers
from tests.support.decks_at_random import DATA, programs
from tests.support.deckwork import program, source, within


def compared(*lines: str, names: tuple[str, str], rounding: bool = True, values: bool = True) -> Divergence:
    studied, reference = map(numbers, names)
    options = Options(limit=5_000)
    deck = deck_from_lines("d", [])
    return diverge(program(*lines, "END"), deck, studied, reference, options, rounding=rounding, values=values)


TENTHS = ["A=.3", "B=A-.1", "C=B-.2"]


@pytest.mark.parametrize("reference", ["float64", "float32", "mp:60", "mp:500"])
def test_tenths_in_binary_do_not_differ_from_exact_ones(reference: str) -> None:
    """The exact values are .3, .2 and 0. In binary all three have errors, the last of 100 %."""
    divergence = compared(*TENTHS, names=("exact", reference))
    assert (divergence.compared, divergence.values, divergence.first_value, divergence.within) == (3, 0, None, 3)
    assert not any(loss.worst or loss.differing for loss in divergence.losses)
    raw = compared(*TENTHS, names=("exact", reference), rounding=False)
    assert (raw.values, raw.within) == (3, 0)
    assert raw.losses[0].worst == pytest.approx(raw.digits, abs=0.05)


def test_a_difference_larger_than_the_rounding_error_is_counted() -> None:
    """.33333333 is 3.3E-9 from a third; the double is 1.85E-17 from it."""
    divergence = compared("A=1./3.", "B=A+1.", names=("truncating", "float64"))
    assert (divergence.values, divergence.within) == (2, 0)
    assert divergence.first_value is not None
    assert divergence.first_value.relative == pytest.approx(1e-8)
    assert float(divergence.first_value.bound) == pytest.approx(2 * float(Fraction(1, 3) - Fraction(1 / 3)))
    # An exact reference has no error.
    exact = compared("A=1./3.", "B=A+1.", names=("truncating", "exact"))
    assert exact.first_value is not None
    assert exact.first_value.bound == 0


def test_a_less_precise_reference_finds_no_differences() -> None:
    """A third in three digits, and the results computed from it, have errors within the bounds of three digits."""
    lines = ["A=1./3.", "B=A*A", "C=B-A"]
    assert compared(*lines, names=("exact", "truncating:3")).values == 0
    assert compared(*lines, names=("exact", "truncating:3")).within == 3
    assert compared(*lines, names=("truncating:3", "exact")).values == 3


DECISION = [*TENTHS, "IF(C)10,20,10", "10 K=1", "GO TO 30", "20 K=2", "30 M=1"]


@pytest.mark.parametrize("values", [True, False])
def test_a_decision_that_the_reference_cannot_make_ends_the_comparison(values: bool) -> None:
    """C is 0 exactly and -2.8E-17 in doubles, which must not count as a decision of exact numbers that differs."""
    divergence = compared(*DECISION, names=("exact", "float64"), values=values)
    assert (divergence.tested, divergence.decisions, divergence.first_decision) == (1, 0, None)
    assert divergence.apart == (
        "at card 4 the tested value is -2.7755575615628914e-17 in float64, and rounding may have changed it by 1E-16; "
        "compare with exact arithmetic, or with more digits"
    )
    raw = compared(*DECISION, names=("exact", "float64"), rounding=False, values=values)
    assert raw.decisions == 1


def test_a_decision_that_the_reference_can_make_is_counted() -> None:
    """.99999999 - 1 in eight digits is 0 exactly.

    With the arithmetics exchanged, it counts only if the reference is certain.
    """
    lines = ["A=3.", "B=A-3.0000001", "IF(B)10,20,10", "10 K=1", "20 M=1"]
    divergence = compared(*lines, names=("truncating:3", "truncating:12"))
    assert (divergence.decisions, divergence.apart) == (1, "")
    assert compared(*lines, names=("truncating:12", "truncating:3")).decisions == 0
    # 2 - 2 is 0 in three digits too. Nothing was rounded, so the decision is certain.
    sure = compared("A=2.", "B=A-2.", "IF(B)10,20,10", "10 K=1", "20 M=1", names=("truncating", "truncating:3"))
    assert (sure.decisions, sure.apart) == (0, "")


@settings(max_examples=30)
@given(programs(), DATA)
def test_exact_numbers_differ_from_a_reference_only_by_its_rounding(cards: list[str], data: list[str]) -> None:
    """This holds for any program without FIX, whose integers have no error bound."""
    with within(60):
        try:
            made, _ = translate(source(*cards))
            if made is None or any(instruction.operation == FIX for instruction in made.code):
                return
            divergence = diverge(
                made, deck_from_lines("d", data), numbers("exact"), numbers("mp:200"), Options(limit=600)
            )
        except EmulatorError:
            return
    assert (divergence.first_decision, divergence.first_value) == (None, None)

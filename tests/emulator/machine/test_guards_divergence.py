"""The digits lost are those of the less precise arithmetic, whichever is the reference (docs/reference/machine.md)."""

from collections.abc import Sequence
from math import log10

import pytest

from emulator.language.cards import deck_from_lines
from emulator.machine.divergence import Divergence, diverge
from emulator.machine.result import Options
from emulator.numbers import numbers
from tests.support.deckwork import program


def compared(studied: str, reference: str, lines: Sequence[str], data: Sequence[str] = ()) -> Divergence:
    deck = deck_from_lines("d", data)
    options = Options(limit=100)
    return diverge(program(*lines, "END"), deck, numbers(studied), numbers(reference), options, rounding=False)


@pytest.mark.parametrize(
    ("first", "second", "digits"),
    [
        ("truncating:3", "exact", 3),
        ("truncating:12", "truncating:3", 3),
        ("truncating", "rounding:5", 5),
        ("float32", "float64", 24 * log10(2)),
        ("mp:30", "truncating:20", 30 * log10(2)),
        ("exact", "exact", 0),
    ],
)
def test_the_digits_are_those_of_the_less_precise_arithmetic(first: str, second: str, digits: float) -> None:
    """b bits are b log10 2 digits. Two exact runs have no digits to lose."""
    for studied, reference in ((first, second), (second, first)):
        assert compared(studied, reference, ["A=1."]).digits == pytest.approx(digits)


READ = ["READ 1,A,B", "C=A-B", "1 FORMAT(2F8.5)"]


@pytest.mark.parametrize(
    ("names", "losses"),
    [
        (("truncating:3", "truncating:8"), {1: 0.3, 2: 3.0}),
        (("truncating:8", "truncating:3"), {1: 0.3, 2: 3.0}),
        (("truncating:3", "exact"), {1: 0.3, 2: 3.0}),
        (("exact", "truncating:3"), {1: 0.3, 2: 3.0}),
    ],
    ids=lambda value: "-".join(value) if isinstance(value, tuple) else "",
)
def test_the_loss_of_three_digits_does_not_depend_on_the_reference(names, losses) -> None:
    """.33369 and .33302 are .333 in three digits.

    .00069/.33369 and .00069/.333 are both 2.07E-3, whose logarithm is -2.68, so that .3 of three digits are lost. The
    difference is 0 on one side and .00067 on the other, so that all three are lost.
    """
    divergence = compared(*names, READ, [" 0.33369 0.33302"])
    assert {loss.line.place.card: loss.worst for loss in divergence.losses} == losses


def test_losses_lie_between_none_and_all_digits() -> None:
    # 9.991 is 9.99 in three digits: a relative error of 1E-4, smaller than the last digit.
    divergence = compared("truncating:3", "exact", ["A=9.991"])
    assert [(loss.differing, loss.worst) for loss in divergence.losses] == [(1, 0.0)]
    # 10.4 - 10.3951 is .0049, but .1 in three digits, an error of 19 times the value: not 4.3 digits are lost.
    divergence = compared("truncating:3", "exact", READ, ["10.4000010.39510"])
    assert {loss.line.place.card: loss.worst for loss in divergence.losses}[2] == 3.0
    # No difference is relative to zero (docs/reference/machine.md): 1 - .33333333 * 3 has lost all eight digits.
    divergence = compared("truncating", "exact", ["A=1./3.", "B=1.-A*3."])
    assert {loss.line.place.card: loss.worst for loss in divergence.losses} == {1: 0.0, 2: 8.0}
    # 1.4142135 differs from 1.41421356237... by 4.41E-8, whose logarithm is -7.36: .6 of eight digits are lost.
    divergence = compared("truncating", "exact", ["A=2.", "B=SQRT(A)"])
    assert {loss.line.place.card: loss.worst for loss in divergence.losses} == {1: 0.0, 2: 0.6}

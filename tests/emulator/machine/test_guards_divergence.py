"""Digits lost are those of the poorer of two arithmetics, whichever is the reference (docs/reference/machine.md)."""

from __future__ import annotations

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
    ("one", "other", "digits"),
    [
        ("truncating:3", "exact", 3),
        ("truncating:12", "truncating:3", 3),
        ("truncating", "rounding:5", 5),
        ("float32", "float64", 24 * log10(2)),
        ("mp:30", "truncating:20", 30 * log10(2)),
        ("exact", "exact", 0),
    ],
)
def test_the_digits_are_those_of_the_poorer_arithmetic(one: str, other: str, digits: float) -> None:
    """Of b bits b log10 2 digits; exact numbers lose none among themselves, so there are none to count."""
    for studied, reference in ((one, other), (other, one)):
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
def test_three_digits_lose_the_same_from_either_side(names: tuple[str, str], losses: dict[int, float]) -> None:
    """By hand: .33369 and .33302 are .333 in three digits.

    .00069/.33369 is 2.07E-3 and .00069/.333 is 2.07E-3, whose logarithm is -2.68: .3 of three digits are lost.  The
    difference is 0 on one side and .00067 on the other: all three are lost, whichever the reference is.
    """
    found = compared(*names, READ, [" 0.33369 0.33302"])
    assert {loss.line.place.card: loss.worst for loss in found.losses} == losses


def test_no_fewer_digits_than_none_are_lost() -> None:
    """9.991 in three digits is 9.99: off by one in ten thousand, where three digits could not do better than .9."""
    found = compared("truncating:3", "exact", ["A=9.991"])
    assert [(loss.differing, loss.worst) for loss in found.losses] == [(1, 0.0)]


def test_no_more_digits_are_lost_than_there_are() -> None:
    """10.4 - 10.3951 is .0049; in three digits 10.4 - 10.3 is .1, off by 19 times the value: three digits, not 4.3."""
    found = compared("truncating:3", "exact", READ, ["10.4000010.39510"])
    assert {loss.line.place.card: loss.worst for loss in found.losses}[2] == 3.0


def test_a_value_where_the_reference_is_zero_has_lost_every_digit() -> None:
    """No difference is relative to zero (docs/reference/machine.md): all eight of 1 - .33333333 * 3."""
    found = compared("truncating", "exact", ["A=1./3.", "B=1.-A*3."])
    assert {loss.line.place.card: loss.worst for loss in found.losses} == {1: 0.0, 2: 8.0}


def test_a_root_of_the_reference_is_compared_to_more_digits_than_the_poorer_has() -> None:
    """1.4142135 of 1.41421356237... is off by 4.41E-8, whose logarithm is -7.36: .6 of eight digits."""
    found = compared("truncating", "exact", ["A=2.", "B=SQRT(A)"])
    assert {loss.line.place.card: loss.worst for loss in found.losses} == {1: 0.0, 2: 0.6}

"""Faults of the originals that KNOWN-FAULTS.md names with points: they are there, and where they are not."""

from __future__ import annotations

from fractions import Fraction

import pytest

from emulator.language.cards import Deck
from modern.edition import programs
from modern.formats.deck import data_deck
from modern.thesis.cards import read_hull
from modern.thesis.job import run_hull

Triple = tuple[int, int, int]


def deck(points: list[Triple]) -> Deck:
    return data_deck([list(map(str, point)) for point in points], "points")


def ends(first: str, points: list[Triple]) -> set[tuple[Fraction, ...]]:
    """The endpoints (or vertices) the last program punches."""
    run = run_hull(deck(points), programs.program, first=first)
    return set(read_hull(run.final.result.punched).vertices)


@pytest.mark.parametrize(
    ("points", "wrong", "right"),
    [
        ([(0, 0, 0), (1, 1, 1), (2, 2, 2)], [0, 1], [0, 2]),
        ([(0, 0, 0), (0, 5, 5), (0, 1, 1), (0, 2, 2)], [1, 3], [0, 1]),
    ],
)
def test_12_the_state_of_the_examples_takes_wrong_ends(
    points: list[Triple], wrong: list[int], right: list[int]
) -> None:
    assert ends("program1_examples", points) == {tuple(map(Fraction, points[i])) for i in wrong}
    assert ends("program1", points) == {tuple(map(Fraction, points[i])) for i in right}

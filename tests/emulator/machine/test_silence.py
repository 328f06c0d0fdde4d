"""A run says how it ended: the empty hopper, both runs of a comparison, and what exact arithmetic cannot hold."""

import pytest

from emulator.errors import DeckError
from emulator.language.cards import deck_from_lines
from emulator.machine.devices import no_deck
from emulator.machine.divergence import Divergence, diverge
from emulator.machine.machine import Machine
from emulator.machine.result import Options
from emulator.machine.words import notes
from emulator.numbers import numbers
from tests.support.deckwork import program

READS = program("5 READ 9,K", "IF (K) 6,5,6", "6 READ 9,J", "GO TO 5", "9 FORMAT(I4)", "END")


def compared(*lines: str, against: str = "exact") -> Divergence:
    return diverge(program(*lines), deck_from_lines("d", ["   1"]), numbers("truncating"), numbers(against))


@pytest.mark.parametrize(("cards", "count"), [(["   0"], "1 card"), (["   1", "   2"], "2 cards")])
def test_a_run_that_ends_for_lack_of_cards_names_the_read_and_its_card(cards: list[str], count: str) -> None:
    result = Machine(READS, deck_from_lines("d", cards), Options(hopper="any")).run()
    place = "because the hopper was empty at the READ of statement 5 (card 1)"
    assert list(notes(READS, result)) == [f"note: deck.f: the run ended after reading {count}, {place}"]
    assert result.ending.normal


def test_comparisons_and_jobs_report_their_endings() -> None:
    # The programs of the thesis end this way, one data set after the other.
    result = Machine(READS, deck_from_lines("d", ["   0"])).run()
    assert (result.ending.kind, list(notes(READS, result))) == ("hopper", [])
    refused = compared("TYPE 9", "STOP", "9 FORMAT(8HREJECTED)", "END")
    assert refused.outcomes == ("both runs ended: STOP, after typing 'REJECTED'",)
    left = compared("A=1./3.*3.-1.", "IF (A) 1,2,1", "1 STOP", "2 X=0.", "END")
    assert left.outcomes == ("truncating ended: STOP", "exact ended: the end of the program")
    assert no_deck(program("A=1.", "END")).cards == ()
    with pytest.raises(DeckError, match=r"deck\.f: the program reads cards: a data deck is required"):
        no_deck(READS)


@pytest.mark.parametrize("statement", ["A=EXP(1.5)", "A=SQRT(SQRT(2.)+1.)"])
def test_a_function_that_exact_arithmetic_cannot_hold_names_an_arithmetic_that_can(statement: str) -> None:
    assert compared(statement, "STOP", "END").apart.endswith("; --against mp:200 compares with 200 bits instead")
    assert compared(statement, "STOP", "END", against="mp:200").apart == ""

"""Warnings of the compiler about branches, unreachable statements and columns that are easily mistaken."""

import pytest

from emulator.language.compiler import translate
from modern.edition.programs import deck
from tests.support.deckwork import diagnostics, source

LOOP = ["DO 5 I=1,3", "A=I", "IF (A-9.) 4,5,4", "4 B=A", "5 CONTINUE"]


def warnings(*lines: str) -> list[tuple[int, str]]:
    program, messages = translate(source(*lines, "END"))
    assert program is not None
    return [(message.card, message.message) for message in messages]


def test_jumps_into_a_do_are_warnings() -> None:
    jump = "this jump to statement 4 enters the loop of the DO on card 1 from outside; "
    jump += "the loop continues with the value that I has at the jump"
    assert warnings(*LOOP, "GO TO 4") == [(6, jump)]
    # KNOWN-FAULTS 8 (to 184) and 9 (to 138).  Program 3 jumps to 133, which leaves its DO at once.
    reported = [translate(deck(name, ()))[1] for name in ("program1", "program2", "program3")]
    assert [[message.card for message in messages] for messages in reported] == [[], [182, 184, 226], []]


@pytest.mark.parametrize(
    ("lines", "cards"),
    [
        (["IF (X) 1,4,1", "1 DO 5 I=1,3", *LOOP[1:]], [1]),
        (["GO TO (4,5),K", *LOOP], [1, 1]),
        (["IF (SENSE SWITCH 1) 4,1", "1 X=0.", *LOOP], [1]),
        (["DO 5 J=1,3", *LOOP[2:3], *LOOP], [2, 2]),
        ([*LOOP, "IF (X) 1,2,1", "1 STOP", "2 X=0."], []),
        (["DO 5 I=1,3", "IF (X) 4,5,4", "4 STOP", "5 CONTINUE", "GO TO 4"], []),
    ],
    ids=["IF", "computed GO TO", "sense switch", "an outer DO", "within the range", "a way out of the range"],
)
def test_a_jump_into_a_do_is_reported_if_the_end_of_the_do_can_be_reached(lines: list[str], cards: list[int]) -> None:
    assert [card for card, message in warnings(*lines) if "this jump to" in message] == cards


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        (["GO TO 2", "A=1.", "2 B=1."], (2, "this statement cannot be reached")),
        (
            ["STOP", "A=1.", "B=1."],
            (2, "this statement cannot be reached, nor can the statements after it up to card 3"),
        ),
    ],
)
def test_unreachable_statements_are_one_warning(lines: list[str], message: tuple[int, str]) -> None:
    assert warnings(*lines) == [message]


def test_a_statement_number_in_column_6_is_a_warning_and_an_end_after_a_stop_is_not() -> None:
    assert warnings("A=1.", "STOP") == []
    (message,) = diagnostics("     5 A=1.", "      GO TO 5", "      END")
    assert (message.card, message.column, message.warning) == (1, 6, True)
    assert message.message.startswith("statement number 5 begins in column 6")


@pytest.mark.parametrize(("text", "is_reported"), [("+B(I)", True), ("HULL0010", False), ("P1-0040", False)])
def test_code_beyond_column_72_is_a_warning_and_an_identification_is_not(text: str, is_reported: bool) -> None:
    reported = diagnostics("      A=1.".ljust(72) + text, "      END")
    assert [(message.column, message.warning) for message in reported] == [(73, True)] * is_reported

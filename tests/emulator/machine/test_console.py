"""The commands of the console of a halted machine, and their output."""

import pytest

from emulator.language.cards import deck_from_lines
from emulator.machine.console import COMMANDS, Cards, command
from emulator.machine.result import Options
from emulator.machine.session import Action, Session
from tests.support.deckwork import program

LINES = ["DIMENSION M(2,3),X(4)", "READ 9,A,K", "M(2,1)=K", "X(3)=A", "PUNCH 9,A,K", "7 PAUSE", "B=A"]
ENDS = ["9 FORMAT(E14.8,I5)", "END"]
CARD = " .12500000E+01   -7"


@pytest.fixture
def halted() -> tuple[Session, Cards]:
    """A machine that has halted at PAUSE, and the cards it has read and punched."""
    made = Session(program(*LINES, *ENDS), deck_from_lines("d", [CARD, "2"]), Options(switches=frozenset({3})))
    cards = Cards()
    made.advance(1_000)
    cards.see(made.take())
    return made, cards


def shown(halted: tuple[Session, Cards], text: str, width: int = 60) -> list[str]:
    output = command(*halted[:1], text, halted[1], width)
    assert isinstance(output, list), output
    assert all(len(line) <= width for line in output)
    return output


@pytest.mark.parametrize(
    ("text", "action"),
    [
        ("", Action("START")),
        ("sta", Action("START")),
        ("step", Action("STEP", 1)),
        ("STEP 12", Action("STEP", 12)),
        ("sto", Action("STOP")),
        ("switch 3", Action("SWITCH", 3, on=False)),
        ("switch 1", Action("SWITCH", 1, on=True)),
        ("sw 2 off", Action("SWITCH", 2, on=False)),
        ("break 7", Action("BREAK", 7)),
        ("b card 3", Action("BREAK", 3, card=True)),
        ("clear", Action("CLEAR")),
        ("cl card 3", Action("CLEAR", 3, card=True)),
    ],
)
def test_a_command_can_be_an_action(halted: tuple[Session, Cards], text: str, action: Action) -> None:
    assert command(halted[0], text, halted[1], 60) == action


@pytest.mark.parametrize(
    ("text", "first"),
    [
        ("s", "S is ambiguous: START, STEP, STOP, SWITCH"),
        ("jump", "JUMP is not a command: START, STEP, STOP, SWITCH, BREAK,"),
        ("break 8", "deck.f has no statement of that number or card"),
        ("clear card 8", "deck.f has no statement of that number or card"),
        ("step 0", "expected STEP, or STEP and a number"),
        ("switch 5", "expected SWITCH, 1 to 4, ON or OFF"),
        ("variables q", "deck.f has no variable Q"),
        ("core q", "Q is neither a variable nor an address of data "),
        ("core x(5)", "X(5) is neither a variable nor an address of data "),
        ("core m(1)", "M(1) is neither a variable nor an address of data "),
        ("core 100", "100 is neither a variable nor an address of data "),
        ("core 39999", "39999 is neither a variable nor an address of data "),
        ("variables a b", "VARIABLES [NAME]: show all variables,"),
        ("core", "CORE NAME or ADDRESS: show the storage around it"),
    ],
)
def test_a_wrong_command_is_answered_with_a_message(halted: tuple[Session, Cards], text: str, first: str) -> None:
    assert shown(halted, text)[0].startswith(first.rstrip())


def test_variables_shows_values_and_defined_elements(halted: tuple[Session, Cards]) -> None:
    assert shown(halted, "v") == [
        "M(2,3): 1 of 6 defined",
        "X(4): 1 of 4 defined",
        "A      .12500000E+01",
        "K      -7",
        "B      undefined",
    ]
    assert shown(halted, "v m") == ["M(2,1)    -7"]
    assert shown(halted, "v b") == ["B         undefined"]


def test_core_shows_fields_in_order_of_addresses(halted: tuple[Session, Cards]) -> None:
    """Element 1 of the first array has the highest address (C26-5619 p. 66-69)."""
    assert shown(halted, "core m(2,1)") == [
        "  39829 M(2,3)          undefined",
        "  39839 M(1,3)          undefined",
        "  39849 M(2,2)          undefined",
        "  39859 M(1,2)          undefined",
        "> 39869 M(2,1)          -7",
        "  39879 M(1,1)          undefined",
    ]
    assert shown(halted, "core 39869") == shown(halted, "core m(2,1)")
    assert shown(halted, "core 39865") == shown(halted, "core m(2,1)")


def test_cards_switches_breakpoints_and_help_are_shown(halted: tuple[Session, Cards]) -> None:
    assert shown(halted, "cards", 15) == [
        "read: 1 of 2",
        "  cards",
        "   .12500000E+0",
        "  1   -7",
        "punched: 1",
        "   .12500000E+0",
        "  1   -7",
    ]
    assert shown(halted, "switch") == ["1 OFF, 2 OFF, 3 ON, 4 OFF"]
    assert shown(halted, "break") == ["no breakpoints"]
    for action in (Action("BREAK", 7), Action("BREAK", 3, card=True)):
        halted[0].act(action)
    assert shown(halted, "break") == ["card 3, statement 7 (card 6)"]
    for asked in ("?", "help", "h"):
        assert [line.split()[0].rstrip(":") for line in shown(halted, asked, 80)] == list(COMMANDS)

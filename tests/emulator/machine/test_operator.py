"""The operator who reads a file of actions, and logs that are such files."""

import io

import pytest

from emulator.errors import DeckError, FileError, OperatorError
from emulator.machine.operator import FromFile, Logged, Operator
from emulator.machine.result import Result
from emulator.machine.session import Action
from emulator.machine.words import action_line, read_action
from tests.support.deckwork import machine

ASKING = ["5 ACCEPT 90,K", "IF(K)7,6,7", "6 PAUSE 3", "STOP", "7 TYPE 90,K", "GO TO 5", "90 FORMAT(I4)", "END"]
WAITING = ["K=0", "1 K=K+1", "IF(SENSE SWITCH 2)2,1", "2 PAUSE", "TYPE 90,K", "90 FORMAT(I4)", "END"]


def answered(lines: list[str], text: str, **setting: object) -> Result:
    return machine(*lines, **setting).run(FromFile("o.txt", text))


def logged(lines: list[str], text: str, **setting: object) -> tuple[Result, str]:
    log = io.StringIO()
    result = machine(*lines, **setting).run(Logged(FromFile("o.txt", text), log))
    return result, log.getvalue()


def test_a_file_operates_the_machine_up_to_its_last_line() -> None:
    result = answered(ASKING, "* a comment\nENTER    7\n\nENTER   -8\nENTER    0\nSTART\n")
    assert (result.typed, result.ending.kind, result.notices) == (("   7", "  -8"), "stop", ())
    result = answered(ASKING, "ENTER    0\n")
    assert [notice.kind for notice in result.notices] == ["pause"]
    with pytest.raises(DeckError, match="no typed line is left for ACCEPT in statement 5"):
        answered(ASKING, "ENTER    1\n")
    result, log = logged(ASKING, "ENTER    X\nENTER    9\nENTER    0\n")
    assert result.typed == ("   9",)
    assert "* typewriter: line 1, column 1: 'X' is not an integer; the line is typed again: ACCEPT" in log
    with pytest.raises(DeckError, match=r"^typewriter: line 1, column 1: 'X' is not an integer"):
        answered(ASKING, "ENTER    X\n")


def test_switches_at_the_head_of_a_file_are_set_before_the_run() -> None:
    assert answered(WAITING, "SWITCH 2 ON\nSTART\n").typed == ("   1",)
    assert answered(WAITING, "SWITCH 2 ON\nSWITCH 2 OFF\n", limit=500).ending.kind == "limit"
    lines = ["1 PAUSE", "IF(SENSE SWITCH 1)2,1", "2 TYPE 90", "90 FORMAT(2HON)", "END"]
    result = answered(lines, "START\nSTART\nSWITCH 1 ON\nSTART\n")
    assert (result.typed, result.statements) == (("ON",), 8)


def test_logs_contain_lines_typed_and_actions_at_their_work() -> None:
    result, log = logged(WAITING, "AT 100 SWITCH 2 ON\nSTART\n")
    assert result.typed == ("  50",)
    assert "AT 100 SWITCH 2 ON\n" in log
    log = io.StringIO()
    machine(*ASKING).run(Logged(Operator(["   5", "   0"]), log))
    assert [line for line in log.getvalue().splitlines() if line[0] not in "*L"] == ["ENTER    5", "ENTER    0"]
    operator = FromFile("o.txt", "ENTER    0\n* not this\nSTART\nSTART\n")
    machine(*ASKING).run(operator)
    assert operator.first_unused == 4


@pytest.mark.parametrize(
    "text",
    [
        "AT 0 ATTN\nSTEP\nSTEP 5\nBREAK 2\nBREAK CARD 3\nSTART\nCLEAR CARD 3\nSWITCH 2 ON\nSTART\nCLEAR\nSTART\n",
        "AT 77 ATTN\nSWITCH 2 ON\nSTART\nSTOP\n",
        "STEP 3\nSWITCH 1 ON\nSTEP\nSTOP\n",
        "AT 200 STOP\n",
        "SWITCH 2 ON\n",
    ],
)
def test_a_log_repeats_the_run_and_its_log(text: str) -> None:
    first, log = logged(WAITING, text)
    second, again = logged(WAITING, log)
    assert (second, again) == (first, log)
    if "STOP" in text:
        assert (first.ending.kind, first.ending.normal) == ("operator", False)


def test_a_log_contains_actions_and_events() -> None:
    lines = ["READ 90,I", "3 ACCEPT 90,K", "PUNCH 90,K", "90 FORMAT(I4)", "END"]
    _, log = logged(lines, "ENTER    4\n", data=["  12"])
    assert log.splitlines() == [
        "LOAD deck.f data.cards",
        "* read    12",
        "* ACCEPT waits for a line, statement 3 (card 2)",
        "ENTER    4",
        "* punch    4",
    ]


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("STRAT", "'STRAT' is not an action; the actions are ENTER, START,"),
        ("start", "'start' is not an action"),
        ("START 5", "expected START"),
        ("SWITCH 5 ON", "expected SWITCH, 1 to 4, ON or OFF"),
        ("SWITCH 1", "expected SWITCH, 1 to 4, ON or OFF"),
        ("SWITCH 1 ON 2", "expected SWITCH, 1 to 4, ON or OFF"),
        ("STEP 0", "expected STEP, or STEP and a number"),
        ("STEP X", "expected STEP, or STEP and a number"),
        ("BREAK", "expected BREAK and a statement number"),
        ("BREAK CARD", "expected BREAK and a statement number"),
        ("BREAK 4 CARD", "expected BREAK and a statement number"),
        ("ATTN", "expected AT, a number and ATTN"),
        ("AT 7", "expected AT, a number and one of STEP, STOP, ATTN,"),
        ("AT X ATTN", "expected AT, a number and one of"),
        ("AT 7 ENTER 5", "expected AT, a number and one of"),
        ("AT 7 SWITCH ON", "expected SWITCH, 1 to 4, ON or OFF"),
    ],
)
def test_an_error_in_a_line_names_file_and_line(line: str, message: str) -> None:
    with pytest.raises(FileError) as caught:
        FromFile("o.txt", f"* head\nSTART\n{line}\n")
    assert str(caught.value).startswith(f"o.txt: line 3: {message}")


@pytest.mark.parametrize(
    ("lines", "text", "message"),
    [
        (
            ASKING,
            "START\n",
            "line 1: found START, which does not fit the halt: ACCEPT waits for a line, statement 5 (card 1)",
        ),
        (
            ["3 PAUSE", "END"],
            "STEP\nENTER 5\n",
            "line 2: found ENTER 5, which does not fit the halt: stopped (step) before statement 3 (card 1): PAUSE",
        ),
        (
            ASKING,
            "AT 90 ATTN\n",
            "line 1: found AT 90 ATTN, which does not fit the halt: ACCEPT waits for a line, statement 5 (card 1)",
        ),
        (ASKING, "BREAK 8\n", "line 1: deck.f has no statement of that number or card"),
        (ASKING, "BREAK CARD 7\n", "line 1: deck.f has no statement of that number or card"),
    ],
)
def test_an_action_that_does_not_fit_names_file_and_line(lines: list[str], text: str, message: str) -> None:
    with pytest.raises(OperatorError) as caught:
        answered(lines, text)
    assert str(caught.value) == f"o.txt: {message}"


@pytest.mark.parametrize(
    "action",
    [
        Action("ENTER", text="   5  -7"),
        Action("ENTER"),
        Action("STEP", 1),
        Action("STEP", 12),
        Action("SWITCH", 4, on=True),
        Action("BREAK", 9999),
        Action("BREAK", 12, card=True),
        Action("CLEAR", 3, card=True),
        Action("CLEAR"),
        Action("STOP"),
    ],
)
def test_an_action_is_read_as_it_is_written(action: Action) -> None:
    assert read_action(action_line(action)) == (None, action)
    if action.word != "ENTER":
        assert read_action(action_line(action, 500)) == (500, action)


def test_load_begins_the_lines_for_the_next_machine() -> None:
    """Without LOAD the next machine continues with the remaining lines."""
    for text in (
        "LOAD a\nENTER    0\nSTART\nLOAD b\nAT 0 ATTN\nSTEP\nENTER    0\nSTOP\n",
        "ENTER    0\nSTART\nENTER    0\n",
    ):
        operator = FromFile("o.txt", text)
        first, second = machine(*ASKING).run(operator), machine(*ASKING).run(operator)
        assert (first.ending.kind, second.ending.kind) == ("stop", "operator" if "STOP" in text else "stop")
        assert operator.first_unused == 0
    operator = FromFile("o.txt", "LOAD a\nENTER    0\nSTART\nSTART\nLOAD b\nENTER    0\n")
    machine(*ASKING).run(operator)
    machine(*ASKING).run(operator)
    assert operator.first_unused == 4


@pytest.mark.parametrize("work", range(1, 30))
def test_a_log_repeats_actions_between_two_lines_of_a_list(work: int) -> None:
    """A session returns after each typed line, also within a statement."""
    lines = ["1 TYPE 90,(K,K=1,5)", "IF(SENSE SWITCH 3)2,1", "2 TYPE 91", "90 FORMAT(2I4)", "91 FORMAT(1HA/1HB)", "END"]
    first, log = logged(lines, f"AT {work} SWITCH 3 ON\nAT {work + 3} ATTN\nSTEP 2\nSTART\n", limit=80)
    second, again = logged(lines, log, limit=80)
    assert (second, again) == (first, log)

"""The machine: endings, limit, switches, loops, jumps and devices (references "part ..." are to tests/data/vectors)."""

import re

import pytest

from emulator.errors import CardError, DeckError
from emulator.language.cards import Deck, deck_from_lines
from emulator.machine.machine import Machine
from emulator.machine.result import Ending, MachineError, Options
from emulator.machine.session import Halt, Session
from tests.support.deckwork import errors, machine, number, program, punched, run, source, within

OUT = "PUNCH 90,K"
F = "90 FORMAT(I4)"


def test_a_run_ends_normally_by_its_statements_or_an_empty_hopper() -> None:
    assert run("X=1.", "END").ending.kind == "end"
    assert run("STOP", "END").ending.kind == "stop"
    assert run("X=1.").ending.kind == "end"
    assert run("5 READ 90,K", "GO TO 5", F, "END", data=["1", "2"]).ending.kind == "hopper"
    assert [Ending(kind).normal for kind in ("end", "stop", "hopper", "limit", "mode")] == [True] * 3 + [False] * 2
    result = run("K=1", OUT, "STOP", OUT, F, "END")
    assert result.punched == ("   1",)
    assert result.statements == 3
    with pytest.raises(DeckError, match="the hopper is empty at the first READ"):
        run("READ 90,K", F, "END")


def test_an_empty_hopper_ends_a_run_only_between_data_sets() -> None:
    # The first READ executed begins a data set, so that an empty hopper there ends the job normally.
    lines = ["1 READ 90,N", "DO 2 I=1,N", "2 READ 90,K", OUT, "GO TO 1", F, "END"]
    result = run(*lines, data=["   2", "   5", "   6", "   1", "   7"])
    assert result.ending.kind == "hopper"
    assert result.punched == ("   6", "   7")
    assert [event.what for event in result.events].count("begin") == 3
    assert result.cards_read == 5
    lines = ["1 READ 90,N", "DO 2 I=1,N", "2 READ 90,K", OUT, "GO TO 1", F, "END"]
    with pytest.raises(DeckError) as caught:
        run(*lines, data=["   2", "   5"])
    assert str(caught.value) == (
        "data.cards: card 2, column 1: the deck ends in the middle of a data set; "
        "statement 2 (card 3) of deck.f needs another card"
    )


@pytest.mark.parametrize(
    ("lines", "limit", "repeated"),
    [
        (["K=0", "10 K=K+1", "L=K", "GO TO 10", "END"], 5_000, "cards 2 to 4, statement 10"),
        (["DO 5 I=1,900", "5 K=I", "6 GO TO 6", "END"], 10_000, "card 3, statement 6"),
        (["DO 5 I=1,9999", "5 CONTINUE", "END"], 15_000, "card 2, statement 5"),
    ],
    ids=["a loop", "the last of two loops", "a DO"],
)
def test_the_message_about_the_limit_names_the_last_loop(lines: list[str], limit: int, repeated: str) -> None:
    ending = run(*lines, limit=limit).ending
    assert (ending.kind, ending.normal) == ("limit", False)
    assert ending.message == f"deck.f: stopped after {limit} statements; the last statements form a loop on {repeated}"


@pytest.mark.parametrize("limit", [2, 3, 7, 60])
def test_a_run_that_needs_exactly_the_limit_ends_normally(limit: int) -> None:
    cards = [f"{n} CONTINUE" for n in range(1, limit)]
    assert run(*cards, "END", limit=limit).ending.kind == "end"
    assert run(*cards, "X=1.", "END", limit=limit).ending.kind == "limit"


@pytest.mark.parametrize("limit", [0, 1, 2, 1_999, 4_001, 20_000])
def test_the_limit_is_exact(limit: int) -> None:
    result = run("1 GO TO 1", "END", limit=limit)
    assert (result.ending.kind, result.statements, result.counts[0]) == ("limit", limit, limit)


@pytest.mark.parametrize(("first", "items"), [("N=9999", "(K,I=1,N)"), ("N=0", "(K,I=1,2,N)"), ("N=-1", "(K,I=1,2,N)")])
def test_the_limit_ends_an_endless_list(first: str, items: str) -> None:
    """The variable of a list wraps from 9999 to 0, or its step is zero, so that the list never ends."""
    with within(0.7):
        assert run("K=1", first, f"PUNCH 90,{items}", F, "END", limit=1_000).ending.kind == "limit"


@pytest.mark.parametrize(
    "lines",
    [["1 PUNCH 5", "GO TO 1", "5 FORMAT(200(/))"], ["DIMENSION M(200)", "1 PUNCH 5,M", "GO TO 1", "5 FORMAT(I4)"]],
    ids=["slashes", "whole array"],
)
def test_the_limit_bounds_the_number_of_cards_punched(lines: list[str]) -> None:
    """With the default limit of five million these programs would fill the memory first."""
    start = ["DO 9 I=1,200", "9 M(I)=I"] if "M(200)" in lines[0] else []
    result = run(*lines[: len(start) // 2], *start, *lines[len(start) // 2 :], "END", limit=1_000)
    assert result.ending.kind == "limit"
    assert len(result.punched) <= 1_400


# Loops and jumps.


def test_loops_use_current_values() -> None:
    # Part two 5: changing N inside the loop shortens the loop at once.
    assert punched("N=9", "K=0", "DO 5 I=1,N", "K=K+1", "5 N=4", "PUNCH 90,K,I", "90 FORMAT(2I4)", "END") == (
        "   4   5",
    )
    lines = ["DO 5 I=1,9", "IF(I-4)5,6,5", "5 CONTINUE", "6 K=I", OUT, F, "END"]
    assert punched(*lines) == ("   4",)
    # Program 2 jumps to 138 within the DO of 143; the variable continues from its value (GOTRAN p. 16).
    lines = ["I=7", "K=0", "GO TO 4", "DO 5 I=1,9", "4 K=K+1", "5 CONTINUE", "PUNCH 90,K,I", "90 FORMAT(2I4)", "END"]
    assert punched(*lines) == ("   3  10",)
    lines = ["K=0", "DO 5 I=1,3", "DO 5 J=1,4", "5 K=K+1", "PUNCH 90,K,I,J", "90 FORMAT(3I4)", "END"]
    assert punched(*lines) == ("  12   4   5",)


@pytest.mark.parametrize("last", ["5 READ 90,K", "5 PUNCH 90,K", "5 PAUSE"])
def test_a_do_may_end_with_input_output_or_pause(last: str) -> None:
    """The thesis ends loops on READ and PUNCH."""
    result = run("K=8", "DO 5 I=1,3", last, "PUNCH 90,I", F, "END", data=["1", "2", "3"])
    assert result.punched[-1] == "   4"


def test_branches_and_pauses_continue_by_value() -> None:
    lines = ["READ 90,K", "GO TO (11,12,13),K", "11 K=100", "GO TO 20", "12 K=200", "GO TO 20", "13 K=300", f"20 {OUT}"]
    for index in (1, 2, 3):
        assert punched(*lines, F, "END", data=[f"   {index}"]) == (f" {index}00",)
    # OPEN-QUESTIONS 11.
    result = run("7 PAUSE", "K=5", OUT, F, "END")
    assert result.punched == ("   5",)
    assert [notice.message for notice in result.notices] == [
        "deck.f: PAUSE at statement 7 (card 1): the operator presses START"
    ]
    result = run("DO 5 I=1,3", "5 K=I", "END")
    assert result.statements == 1 + 3 + 1
    assert result.numbers == ()


@pytest.mark.parametrize("index", [0, 4, -1, 9999])
def test_a_computed_go_to_out_of_range_ends_the_run(index: int) -> None:
    """The machine would have branched to an arbitrary address (OPEN-QUESTIONS 12)."""
    result = run("READ 90,K", "GO TO (1,1,1),K", "1 STOP", "90 FORMAT(I5)", "END", data=[f"{index:5d}"])
    assert (result.ending.kind, result.ending.message) == (
        "select",
        f"deck.f: card 2: the value {index} selects no statement number, in GO TO (1,1,1),K",
    )


@pytest.mark.parametrize("on", [set(), {1}, {2}, {3}, {4}, {1, 4}])
def test_sense_switches_select_branches(on: set[int]) -> None:
    lines: list[str] = ["K=0"]
    for switch in (1, 2, 3, 4):
        lines += [f"IF(SENSE SWITCH {switch}){switch},1{switch}", f"{switch} K=K+{10 ** (4 - switch)}"]
        lines += [f"1{switch} CONTINUE"]
    result = punched(*lines, OUT, F, "END", switches=on)
    assert result == (f"{sum(10 ** (4 - s) for s in on):4d}",)


@pytest.mark.parametrize(("statement", "number"), [("PAUSE", 0), ("PAUSE 25", 25)])
def test_a_pause_halts_with_its_number(statement: str, number: int) -> None:
    session = Session(program(statement, "END"), Deck("none", ()))
    halt = session.advance(100)
    assert isinstance(halt, Halt)
    assert (halt.what, halt.number) == ("pause", number)


# Lists.


def test_lists_transfer_elements_in_order() -> None:
    # The elements are in the order A(1,1), A(2,1), A(1,2) ... (C26-5619 p. 66-69).
    lines = ["DIMENSION M(2,3)", "READ 90,M", "PUNCH 90,M(1,1),M(1,2),M(1,3)", "PUNCH 90,M", "90 FORMAT(6I3)", "END"]
    assert punched(*lines, data=["  1  2  3  4  5  6"]) == ("  1  3  5", "  1  2  3  4  5  6")
    lines = ["DIMENSION M(2,3)", "READ 90,((M(I,J),J=1,3),I=1,2)", "PUNCH 90,(M(I,2),I=1,2)", "PUNCH 90,M"]
    assert punched(*lines, "90 FORMAT(6I3)", "END", data=["  1  2  3  4  5  6"]) == ("  2  5", "  1  4  2  5  3  6")
    lines = ["N=0", "PUNCH 90,(I,I=1,N)", "PUNCH 90,(I,I=1,9,3)", "PUNCH 90,I", "90 FORMAT(9I3)", "END"]
    assert punched(*lines) == ("  1", "  1  4  7", " 10")
    lines = ["DIMENSION M(5)", "READ 90,N,(M(I),I=1,N),K,M(K)", "PUNCH 90,M(1),M(2),M(3)", "90 FORMAT(9I3)", "END"]
    assert punched(*lines, data=["  2  8  9  3  7"]) == ("  8  9  7",)


def test_undefined_fields_are_copied_and_deep_lists_rejected() -> None:
    items = "I"
    for _ in range(5):
        items = f"({items},I=1,2)"
    (message,) = errors(f"PUNCH 90,{items}", F, "END")
    assert "the parentheses of this list are nested too deep" in message.message
    # Part two 5: a copy is one transmit field. The thesis copies element N+1 in this way (OPEN-QUESTIONS 22).
    made = machine("DIMENSION X(3)", "X(1)=X(2)", "A=B", "I=J", "END")
    assert made.run().ending.kind == "end"
    assert (number(made, "A"), number(made, "I")) == ("undefined", "undefined")


# Typewriter.


def test_typed_lines_are_read_and_checked() -> None:
    result = run("ACCEPT 90,K", "K=K+1", "TYPE 90,K", F, "END", keyboard=["  41"])
    assert result.typed == ("  42",)
    assert [(e.what, e.text) for e in result.events] == [("accept", "  41"), ("type", "  42")]
    assert result.cards_read == 0
    with pytest.raises(DeckError, match=r"no typed line is left for ACCEPT in the statement on card 1"):
        run("ACCEPT 90,K", F, "END")
    with pytest.raises(CardError, match=r"^typewriter: (?!.*card 0).*column 1: 'X' is not an integer"):
        run("ACCEPT 90,K", F, "END", keyboard=["X"])


@pytest.mark.parametrize(
    ("line", "lines"),
    [
        ("\u0661.5", ["ACCEPT 1,A", "1 FORMAT(E9.2)"]),
        ("A\nB", ["ACCEPT 1", "TYPE 1", "1 FORMAT(9HSOME TEXT)"]),
        ("abc", ["ACCEPT 1", "TYPE 1", "1 FORMAT(9HSOME TEXT)"]),
    ],
    ids=["arabic digit", "line end", "small letters"],
)
def test_a_typed_line_may_only_hold_characters_of_the_card_code(line: str, lines: list[str]) -> None:
    """Otherwise an Arabic digit would be read as a number, and a line end would appear within a typed record."""
    with pytest.raises(CardError, match="not in the card code"):
        run(*lines, "END", keyboard=[line])


# Undefined storage.


@pytest.mark.parametrize(
    "statement",
    ["A=B+1.", "A=1.*B", "A=-B", "J=B", "A=L", "A=SQRT(B)", "A=B**2", "A=2.**B", "A=2.**L", "J=L+1", "J=-L"],
)
def test_an_undefined_operand_ends_the_run(statement: str) -> None:
    result = run("X=1.", statement, "END")
    assert result.ending.kind == "undefined"
    name = re.search("[BL]", statement)[0]
    assert result.ending.message == f"deck.f: card 2: {name} is undefined but is used in a calculation, in {statement}"


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        (["IF(B)1,1,1", "1 STOP"], "B is undefined"),
        (["IF(L)1,1,1", "1 STOP"], "L is undefined"),
        (["GO TO(1),L", "1 STOP"], "L is undefined"),
        (["DO 1 I=1,L", "1 CONTINUE"], "L is undefined"),
        (["DO 1 I=L,5", "1 CONTINUE"], "L is undefined"),
        (["DO 1 I=1,5,L", "1 CONTINUE"], "L is undefined"),
        (["DIMENSION X(2)", "X(L)=1."], "L is undefined"),
        (["DIMENSION X(2,2)", "X(1,L)=1."], "L is undefined"),
        (["DIMENSION X(2)", "A=X(2)+1."], "X(2) is undefined"),
        (["PUNCH 9,B", "9 FORMAT(E14.8)"], "B is undefined but is written"),
    ],
)
def test_an_undefined_value_in_any_statement_ends_the_run(lines: list[str], message: str) -> None:
    result = run(*lines, "END")
    assert result.ending.kind == "undefined"
    assert message in result.ending.message


# The machine as a whole.


def test_runs_do_not_change_programs_or_each_other() -> None:
    made = program("READ 90,K", "1 K=K+1", "IF(K-9)1,2,2", f"2 {OUT}", F, "END")
    first = Machine(made, deck_from_lines("a", ["   1"]), Options())
    two = Machine(made, deck_from_lines("b", ["  50"]), Options())
    assert two.run().punched == ("  51",)
    assert first.run().punched == ("   9",)
    made = program("K=0", "1 K=K+1", "IF(K-9)1,2,2", f"2 {OUT}", F, "END")
    results = [Machine(made, source(), Options()).run() for _ in range(2)]
    assert results[0] == results[1]


def test_only_ibm1962_types_error_codes() -> None:
    lines = ["DO 5 I=1,3", "5 A=1./0.", "B=1.E60*1.E60", "END"]
    loud, silent = run(*lines, arithmetic="ibm1962"), run(*lines)
    assert loud.typed == ("ERROR E7", "ERROR E7", "ERROR E7", "ERROR E3")
    assert silent.typed == ()
    assert loud.errors == silent.errors == (MachineError("E3", 3, 1), MachineError("E7", 2, 3))
    # The code is typed and punched with the number by E14.8 (OPEN-QUESTIONS 14).
    lines = ["A=1234567.", "PUNCH 1,A", "1 FORMAT(F7.3)", "END"]
    result = run(*lines, arithmetic="ibm1962")
    assert result.typed == ("ERROR F8",)
    assert result.punched == (f"{'ERROR F8  .12345670E+07':77}001",)
    assert run(*lines).typed == ()


HEADED = ["READ 1,N", "5 READ 1,I", "PUNCH 1,I", "GO TO 5", "1 FORMAT(I4)", "END"]


def test_an_empty_hopper_ends_a_run_at_a_later_read_but_not_within_a_list() -> None:
    # Such programs read a header card and then loop over cases.
    made, data = program(*HEADED), deck_from_lines("data", ["   3", "   7", "   8"])
    result = Machine(made, data, Options(hopper="any")).run()
    assert (result.ending.kind, result.punched) == ("hopper", ("   7", "   8"))
    with pytest.raises(DeckError, match="the deck ends in the middle of a data set"):
        Machine(made, data, Options()).run()
    made = program("READ 1,I,J", "1 FORMAT(I4)", "END")
    with pytest.raises(DeckError, match="the deck ends in the middle of a data set"):
        Machine(made, deck_from_lines("data", ["   3"]), Options(hopper="any")).run()

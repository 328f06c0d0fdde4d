"""Runs in slices: halts, actions, and the memory they use."""

import gc
from collections.abc import Sequence

import pytest

from emulator.errors import CardError
from emulator.language.cards import deck_from_lines
from emulator.machine.endings import Ending
from emulator.machine.machine import Machine, run_with_operator
from emulator.machine.operator import FromFile, Operator
from emulator.machine.result import Event, Options
from emulator.machine.session import Action, Halt, Session
from tests.support.deckwork import machine, program, run

GAME = ["5 TYPE 91", "6 ACCEPT 90,K,L", "PAUSE 17", "TYPE 90,K,L", "STOP", "90 FORMAT(2I4)", "91 FORMAT(4HMOVE)", "END"]
ENDLESS = ["K=0", "1 K=K+1", "PUNCH 90,K", "TYPE 90,K", "GO TO 1", "90 FORMAT(I5)", "END"]


def session(*lines: str, data: Sequence[str] = (), **setting: object) -> Session:
    return Session(program(*lines), deck_from_lines("data.cards", data), Options(), **setting)


def texts(events: Sequence[Event]) -> list[str]:
    return [f"{event.what} {event.text}" for event in events]


def test_a_session_halts_until_it_is_answered() -> None:
    made = session(*GAME)
    halt = made.advance(1_000)
    assert isinstance(halt, Halt)
    assert (halt.what, halt.line.name, texts(made.take())) == ("accept", "statement 6 (card 2)", ["type MOVE"])
    assert made.advance(1_000) is halt
    made.act(Action("ENTER", text="   1   2"))
    halt = made.advance(1_000)
    assert isinstance(halt, Halt)
    assert (halt.what, halt.number) == ("pause", 17)
    made.act(Action("START"))
    ending = made.advance(1_000)
    assert isinstance(ending, Ending)
    assert (ending.kind, texts(made.take())) == ("stop", ["accept    1   2", "type    1   2"])
    assert made.advance(1_000) is ending


def test_the_fields_of_the_next_line_are_known_before_it_is_typed() -> None:
    made = session("ACCEPT 90,I,A,J,K,L", "90 FORMAT(2X,I3,2H, ,F5.1/1X,I2)", "END")
    lines = ([("I3", 3, 3), ("F5.1", 8, 5)], [("I2", 2, 2)])
    for number in range(4):  # The FORMAT, which describes two lines, is used twice.
        made.advance(1_000)
        assert made.expected_fields() == lines[number % 2]
        made.act(Action("ENTER", text="    1    2.0"))


@pytest.mark.parametrize("bad", ["   1   X", "   1   x", "99991-2-", "   *"])
def test_a_bad_line_must_be_typed_again_and_has_no_effect(bad: str) -> None:
    made = session("K=7", *GAME, retypes=True)
    made.advance(1_000)
    made.act(Action("ENTER", text=bad))
    halt = made.advance(1_000)
    assert isinstance(halt, Halt)
    assert halt.what == "accept"
    assert halt.trouble.startswith("typewriter: line 1, column ")
    assert made.state.values[made.program.storage.entries[0].first] == 7
    made.act(Action("ENTER", text="   3   4"))
    assert made.advance(1_000) is made.halt
    made.act(Action("START"))
    made.advance(1_000)
    assert texts(made.take())[-2:] == ["accept    3   4", "type    3   4"]


def test_bad_lines_are_typed_again_alone_or_raise_an_error() -> None:
    lines = ["DIMENSION M(4)", "ACCEPT 90,(M(I),I=1,4)", "TYPE 91,M,I", "90 FORMAT(2I2)", "91 FORMAT(5I2)", "END"]
    made = session(*lines, retypes=True)
    for line in (" 1 2", " 3 +", " 3 4"):
        assert isinstance(made.advance(1_000), Halt)
        made.act(Action("ENTER", text=line))
    assert made.advance(1_000) == Ending("end")
    assert texts(made.take())[-1] == "type  1 2 3 4 5"
    made = session(*GAME)
    made.advance(1_000)
    made.act(Action("ENTER", text="   X"))
    with pytest.raises(CardError, match="'X' is not an integer"):
        made.advance(1_000)


def test_single_steps_and_breakpoints_halt_the_run() -> None:
    made = session("I=1", "J=2", "7 K=3", "L=4", "GO TO 7", "END")
    halts = []
    for actions in (
        [Action("ATTN")],
        [Action("STEP", 1)],
        [Action("STEP", 2)],
        [Action("BREAK", 7), Action("START")],
        [Action("STEP", 1)],
        [Action("CLEAR", 7), Action("BREAK", 5, card=True), Action("START")],
        [Action("START")],
    ):
        for action in actions:
            made.act(action)
        halt = made.advance(1_000)
        assert isinstance(halt, Halt)
        halts.append((halt.why, halt.line.place.card))
    assert halts == [
        ("attention", 1),
        ("step", 2),
        ("step", 4),
        ("breakpoint", 3),
        ("step", 4),
        ("breakpoint", 5),
        ("breakpoint", 5),
    ]
    made.act(Action("CLEAR"))
    made.act(Action("START"))
    assert made.advance(1_000) is None


def test_a_switch_can_be_flipped_during_the_run() -> None:
    made = session("1 IF(SENSE SWITCH 3)2,1", "2 PUNCH 90", "90 FORMAT(2HON)", "END")
    assert made.advance(100) is None
    assert made.state.work == 100
    made.act(Action("SWITCH", 3, on=True))
    assert made.advance(200) == Ending("end")
    assert texts(made.take()) == ["punch ON"]


def test_a_run_that_the_operator_stops_keeps_its_output() -> None:
    made = session(*ENDLESS)
    made.advance(100)
    made.act(Action("STOP"))
    ending = made.advance(1_000)
    assert isinstance(ending, Ending)
    assert not ending.normal
    assert ending.message.startswith("deck.f: card ")
    assert "stopped by the operator" in ending.message
    result = made.result(ending)
    assert (result.punched[0], len(result.punched)) == ("    1", result.cards_punched)


@pytest.mark.parametrize("stride", [1, 7, 1_000_000])
def test_slices_do_not_change_a_run(stride: int) -> None:
    lines = ["DO 5 I=1,40", "READ 90,K", "IF(K-20)5,4,5", "4 PAUSE", "5 PUNCH 90,K,I", "90 FORMAT(2I4)", "END"]
    data = [f"{k:4d}" for k in range(30)]
    whole = run(*lines, data=data)
    assert (whole.ending.kind, whole.cards_read) == ("hopper", 30)
    made = session(*lines, data=data)
    while (ending := run_with_operator(made, Operator(), made.state.work + stride)) is None:
        pass
    assert made.result(ending) == whole


@pytest.mark.parametrize("limit", [*range(1, 40), 2_500])
def test_returning_after_every_line_does_not_change_a_run(limit: int) -> None:
    lines = ["1 TYPE 90,(K,K=1,5)", "IF(SENSE SWITCH 3)2,1", "2 TYPE 91", "90 FORMAT(2I4)", "91 FORMAT(1HA/1HB)", "END"]
    for switches in ((), (3,)):
        made = machine(*lines, limit=limit, switches=switches)
        assert made.run(FromFile("o", "")) == run(*lines, limit=limit, switches=switches)


def test_the_limit_applies_to_the_whole_run() -> None:
    whole = run(*ENDLESS, limit=9_000)
    made = machine(*ENDLESS, limit=9_000)
    while (ending := run_with_operator(made, Operator(), made.state.work + 123)) is None:
        pass
    assert made.result(ending) == whole


def test_memory_does_not_grow_with_output_that_is_taken() -> None:
    """Only the events of the last slice stay in memory."""
    made = Machine(program(*ENDLESS), deck_from_lines("d", ()), Options(limit=100_000))
    events_taken, alive = 0, []
    gc.collect()
    others = {id(thing) for thing in gc.get_objects() if type(thing) is Event}

    def count(events: Sequence[Event]) -> None:
        nonlocal events_taken
        events_taken += len(events)
        alive.append(sum(type(thing) is Event and id(thing) not in others for thing in gc.get_objects()))

    result = made.run(output=count)
    assert (result.punched, result.typed, result.events) == ((), (), ())
    assert events_taken == result.cards_punched + result.characters_typed // 6 > 20_000
    assert len(alive) >= 5
    assert 0 < max(alive) < events_taken / 3


def test_an_endless_list_does_not_use_more_and_more_memory() -> None:
    lines = ["N=9999", "PUNCH 90,(K,K=1,N)", "90 FORMAT(I5)", "END"]
    made = Machine(program(*lines), deck_from_lines("d", ()), Options(limit=50_000))
    made.run(output=lambda events: None)
    assert made.devices.listed == []


def test_a_second_attention_stops_an_endless_list() -> None:
    made = session("N=9999", "5 TYPE 90,(K,K=1,N)", "90 FORMAT(I5)", "END")
    for _ in range(2):
        assert made.advance(made.state.work + 500) is None
        made.act(Action("ATTN"))
    halt = made.advance(10_000)
    assert isinstance(halt, Halt)
    assert (halt.what, halt.why, halt.line.name) == ("stop", "attention", "statement 5 (card 2)")
    made.act(Action("START"))
    assert made.advance(made.state.work + 500) is None
    typed = [int(event.text) for event in made.take()]
    assert typed == list(range(1, len(typed) + 1))

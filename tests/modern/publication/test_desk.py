"""The desk behind the emulator page gives the same cards, lines and messages as the command."""

import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from modern.publication.desk import Desk
from tests.support.commands import call
from tests.support.desks import PAIRS, Pair, operator_lines, played
from tests.support.paths import ROOT


@pytest.mark.parametrize("pair", PAIRS, ids=[pair.name for pair in PAIRS])
def test_cards_lines_and_messages_equal_those_of_the_command(
    pair: Pair, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    desk = played(Desk(), pair)
    _, out, err = call(capsys, *pair.command(tmp_path))
    assert desk.punched == out.splitlines()
    assert (
        desk.typed == (tmp_path / "typed").read_text().splitlines()
        if desk.loaded
        else not (tmp_path / "typed").exists()
    )
    assert desk.messages == err.splitlines()


def test_an_endless_loop_stops_within_a_slice() -> None:
    desk = Desk()
    assert "listing" in desk.load({"program": ["loop.f", "    1 GO TO 1\n      END\n"], "deck": ""})
    desk.run(1)
    desk.act("START")
    answer = desk.run(20)
    assert (answer["waits"], answer["ended"], answer["work"] > 0) == ("", False, True)
    desk.act("ATTN")
    answer = desk.run(20)
    assert answer["waits"] == "answer"
    assert answer["stands"].startswith("stopped (attention) before statement 1 (card 1)")
    desk.act("STOP")
    answer = desk.run(20)
    assert (answer["ended"], answer["messages"]) == (
        True,
        ["hull1620: loop.f: card 1: stopped by the operator, in 1 GO TO 1"],
    )


def test_the_pace_limits_the_speed() -> None:
    now = 0.0

    def clock() -> float:
        return now

    desk = Desk(clock=clock)
    desk.load({"program": "program1", "deck": "example4"})
    desk.run(1)
    desk.act("START")
    slow = desk.run(1000, 1.0)
    assert 1.0 <= slow["seconds"] < 3.0
    assert not slow["ended"]
    assert desk.run(1000, 1000.0)["ended"]


def test_single_steps_report_what_they_did() -> None:
    desk = Desk()
    desk.load({"program": ["one.f", "      I=2\n      J=I*I\n      STOP\n      END\n"], "deck": ""})
    desk.run(1)
    desk.act("STEP")
    assert desk.run(5)["did"] == ["I = 2"]


def test_inappropriate_commands_are_explained() -> None:
    desk = Desk()
    assert desk.act("START") == {"lines": ["nothing is running: load a program first"]}
    assert desk.run(1)["card"] == 0
    desk.load({"program": "program1", "deck": "example1"})
    desk.run(1)
    assert desk.act("ENTER 5") == {"lines": ["the program does not ask for a line"]}
    assert desk.act("NONSENSE")["lines"][0].startswith("NONSENSE is not a command: START, STEP")
    assert desk.show("CARDS")["lines"][0].startswith("read: 0 of")


@pytest.mark.parametrize(
    ("request_", "message"),
    [
        ({"program": "program9", "deck": ""}, "unknown name 'program9'"),
        ({"program": "program1", "deck": "example9"}, "unknown name 'example9'"),
        ({"program": ["x.f", ""], "deck": ""}, "x.f"),
        ({"program": ["x.f", "      STOP 1\n      END\n"], "deck": ["x", "é"]}, "x: card 1, column 1"),
        ({"program": ["x.f", "      i=1\n"], "deck": ""}, "choose “read lower case as capitals” to accept it"),
        ({"program": "program1", "deck": "", "arithmetic": "roman"}, "roman"),
        ({"program": ["x.f", "      DIMENSION A(9000)\n      A(1)=0.\n      END\n"], "deck": ""}, "OVERLAP"),
    ],
)
def test_invalid_programs_and_decks_are_rejected_with_a_message(request_: dict[str, Any], message: str) -> None:
    desk = Desk()
    desk.load({"program": "program1", "deck": "example1"})
    refused = desk.load(request_)["refused"]
    assert message in refused[0]
    assert desk.run(1)["waits"] == "answer", "the machine is as it was"


def test_lower_case_is_accepted_on_request() -> None:
    answer = Desk().load({"program": ["x.f", "      i=1\n      end\n"], "deck": "", "upcase": True})
    assert answer["listing"][0] == [1, "      I=1"]


def test_the_command_repeats_a_session_from_the_log(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    pair = next(pair for pair in PAIRS if pair.shows == "game")
    desk = Desk()
    session = played(desk, pair)
    log = tmp_path / "log"
    log.write_text(desk.log())
    again = tmp_path / "again"
    arguments = [word for word in pair.command(tmp_path) if not word.startswith("--operator")]
    _, out, _ = call(capsys, *arguments, f"--operator={log}", "--log", str(again))
    assert out.splitlines() == session.punched
    assert operator_lines(again.read_text()) == operator_lines(desk.log())


def test_the_module_imports_only_what_the_page_provides() -> None:
    own = "emulator modern hull1620 fortran_src transcripts lark mpmath __main__".split()
    code = f"""
import sys
sys.path[:0] = {sys.path!r}
from modern.publication.desk import Desk
desk = Desk()
desk.load({{"program": "program1", "deck": "example4"}})
desk.run(1)
desk.act("START")
assert desk.run(1e9)["ended"]
print(sorted({{name.partition(".")[0] for name in sys.modules}} - set({own}) - set(sys.stdlib_module_names)))
"""
    process = subprocess.run([sys.executable, "-S", "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    assert process.stdout.strip() == "[]"

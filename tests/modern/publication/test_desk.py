"""The desk behind the emulator page gives the same cards, lines and messages as the command."""

import random
import re
import subprocess
import sys
from html import unescape
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs

import pytest

from emulator.language.cards import Deck, deck_from_text
from emulator.language.compiler import compile_deck
from emulator.language.objectcode import Line
from emulator.machine.machine import run_with_operator
from emulator.machine.operator import Operator
from emulator.machine.result import Options
from emulator.machine.session import Session
from modern.edition import programs
from modern.formats.deck import data_deck
from modern.port import convex_hull
from modern.publication import panel, verdict
from modern.publication.console import packages
from modern.publication.decks import named_deck
from modern.publication.desk import Answer, Desk
from tests.support.commands import call
from tests.support.desks import PAIRS, Pair, played
from tests.support.editions import packed
from tests.support.paths import ROOT


@pytest.mark.parametrize("pair", PAIRS, ids=[pair.name for pair in PAIRS])
def test_cards_lines_and_messages_equal_those_of_the_command(pair: Pair, tmp_path: Path, monkeypatch, capsys) -> None:
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


def test_the_page_links_every_failing_deck_and_period_program_and_each_link_loads() -> None:
    queries = re.findall(r'href="console\.html\?([^"]+)"', (ROOT / "docs/console.md").read_text())
    links = [{key: values[0] for key, values in parse_qs(unescape(query)).items()} for query in queries]
    decks = {f"counterexamples/{path.stem}" for path in (ROOT / "transcripts/counterexamples").glob("*.deck")}
    programs = {path.name for path in (ROOT / "tests/data/period").glob("*.f")}
    assert {link["deck"] for link in links if link["program"] == "program1"} == decks
    assert {link["program"] for link in links} == programs | {"program1"}
    for link in links:
        # The page sends the files of the period programs with the request.
        files = [ROOT / "tests/data/period" / link[part] for part in ("program", "deck")]
        names = [
            [path.name, path.read_text()] if path.exists() else link[part]
            for path, part in zip(files, link, strict=False)
        ]
        answer = Desk().load({"program": names[0], "deck": names[1], "upcase": "upcase" in link})
        assert "listing" in answer, (link, answer)


def test_an_endless_loop_stops_within_a_slice() -> None:
    desk = Desk()
    counting = "      A=0.\n    1 A=A+1.\n      GO TO 1\n      END\n"
    assert "listing" in desk.load({"program": ["loop.f", counting], "deck": ""})
    desk.run(1)
    desk.act("START")
    answer = desk.run(20)
    assert (answer["waits"], answer["ended"], answer["statement"] > 1) == ("", False, True)
    desk.act("ATTN")
    answer = desk.run(20)
    assert answer["waits"] == "answer"
    assert answer["stands"].startswith("stopped (attention) before ")
    desk.act("STOP")
    answer = desk.run(20)
    assert answer["ended"]
    [message] = answer["messages"]
    assert message.startswith("hull1620: loop.f: card ")
    assert "stopped by the operator, in " in message


def test_the_pace_limits_the_speed() -> None:
    now = 0.0

    def clock() -> float:
        return now

    desk = Desk(clock=clock)
    desk.load({"program": "program1", "deck": "example4"})
    desk.run(1)
    desk.act("START")
    slow = desk.run(1000, 1.0)
    assert 1.0 <= float(slow["time"].split()[0]) < 3.0
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
    assert desk.act("START") == {"lines": ["nothing is loaded: choose a program and a deck, and press Load"]}
    assert desk.run(1)["card"] == 0
    desk.load({"program": "program1", "deck": "example1"})
    desk.run(1)
    assert desk.act("ENTER 5") == {"lines": ["the program does not ask for a line"]}
    assert desk.act("NONSENSE")["lines"][0].startswith("NONSENSE is not a command: START, STEP")
    assert desk.show("CARDS")["lines"][0].startswith("read: 0 of")


@pytest.mark.parametrize(
    ("request_", "message"),
    [
        ({"program": "program9", "deck": ""}, "unknown program 'program9'"),
        ({"program": "program1", "deck": "example9"}, "unknown deck 'example9'"),
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
    desk.act("START")
    assert desk.run(1)["card"] == 0, "nothing old runs"


def finished(desk: Desk) -> None:
    """Run to the end of all loads, pressing START at every halt."""
    while True:
        answer = desk.run(1e9)
        if answer["ended"] and not answer.get("queued"):
            return
        if answer["ended"]:
            desk.next_load()
        elif answer["waits"]:
            desk.act("START")


def test_a_log_of_several_loads_is_repeated_by_the_page_and_by_the_command(tmp_path: Path, monkeypatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    desk = Desk()
    sessions = [played(desk, pair) for pair in PAIRS if pair.shows == "game"]
    for program, deck in (("program1_examples", "example5"), ("program3", "PUNCHED")):
        sessions.append(played(desk, Pair(program, program, deck)))
    again = Desk()
    assert "refused" not in again.replay(desk.log())
    finished(again)
    assert [line for line in again.log().splitlines() if not line.startswith("CARD")] == [
        line for line in desk.log().splitlines() if not line.startswith("CARD")
    ]
    (tmp_path / "log").write_text(desk.log())
    _, out, _ = call(capsys, "run", "--operator=log", "--typewriter", "typed")
    assert out.splitlines() == [card for session in sessions for card in session.punched]
    assert (tmp_path / "typed").read_text().splitlines() == [line for session in sessions for line in session.typed]
    assert again.replay("START\n")["refused"][0].startswith("the log names no program")


def test_a_run_goes_back_to_any_statement() -> None:
    """The state equals that of a machine that steps forward to the statement, at ten random points of example 5."""
    back, forth = Desk(), Desk()
    for desk in (back, forth):
        desk.load({"program": "program3", "deck": "example5/punched"})
        desk.run(0)
    back.act("START")
    ended = back.run(1e9)
    now = 1
    for statement in sorted(random.Random(1).sample(range(2, ended["statement"]), 10)):
        forth.act(f"STEP {statement - now}")
        forth.run(1e9)
        now = statement
        assert back.jump(statement)["waits"] == "answer"
        assert back._session.state == forth._session.state
        assert back._session.devices.events == forth._session.devices.events
        assert back._record == forth._record
        back.act("START")
        repeated = back.run(1e9)
        assert (repeated["ended"], repeated["statement"], repeated["picture"]) == (
            True,
            ended["statement"],
            ended["picture"],
        )


def test_the_hulls_in_the_variables_are_the_stages_of_the_port() -> None:
    for seed in range(4):
        draw = random.Random(seed)
        deep = 20 * (seed % 2)
        points = sorted({tuple(draw.randint(-n, n) for n in (20, 20, deep)) for _ in range(14)})
        texts = [tuple(map(str, point)) for point in points]
        hull = convex_hull(texts, "truncating", history=True, on_refusal="return")
        desk = Desk()
        played(desk, Pair("one", "program1", "set", cards=data_deck(texts, "set").text()))
        played(desk, Pair("two", "program3" if deep else "program2", "PUNCHED"))
        stages = [stage for stage in desk.stages() if not stage.get("final")]
        pictures = [{frozenset(tuple(stage["points"][n]) for n in face) for face in stage["faces"]} for stage in stages]
        assert pictures == [{frozenset(points[n] for n in face) for face in stage.equations} for stage in hull.history]


def test_a_change_of_a_variable_halts_the_machine() -> None:
    desk = Desk()
    desk.load({"program": ["one.f", "      I=2\n      J=I*I\n      I=3\n      STOP\n      END\n"], "deck": ""})
    desk.run(0)
    assert desk.act("BREAK K")["lines"] == ["one.f has no variable K"]
    assert desk.act("BREAK I")["lines"] == ["BREAK I"]
    halts = []
    for _ in range(2):
        desk.act("START")
        halts.append(desk.run(1e9)["stands"])
    assert halts == ["stopped (I has changed) before card 2: J=I*I", "stopped (I has changed) before card 4: STOP"]


def test_the_first_decision_that_exact_arithmetic_takes_otherwise() -> None:
    desk = Desk()
    desk.load({"program": "program1", "deck": "counterexamples/silent"})
    desk.run(0)
    desk.act("START")
    desk.load({"program": desk.run(1e9)["next"], "deck": "PUNCHED"})
    desk.run(0)
    desk.act("START")
    desk.run(1e9)
    answer = desk.decide()
    assert answer["lines"][0] == "card 185: IF (EZ) 170, 167, 170"
    assert desk.jump(answer["statement"])["stands"].endswith("before card 185: IF (EZ) 170, 167, 170")
    assert len(answer["hull"]["vertices"]) == 4
    assert answer["final"]["vertices"] == [0], "the programs lose three of the four vertices"
    assert answer["hull"]["missed"] == answer["final"]["missed"] == [1, 2, 3]


@pytest.mark.parametrize(
    ("deck", "says"),
    [
        ("example4", "The hull of the points on these cards is right: the true hull has 5 vertices and 5 sides."),
        ("example5", "The hull of the points on these cards is right: the true hull has 5 vertices and 6 faces."),
        ("counterexamples/between", "Differences: 1 missing vertex, 1 extra vertex."),
        ("counterexamples/cube", "The program punched no complete hull; the true hull has 8 vertices and 6 faces."),
    ],
)
def test_the_verdict_names_the_differences_of_the_hulls(deck: str, says: str) -> None:
    desk = Desk()
    played(desk, Pair("one", "program1", deck))
    second = desk.decide()["says"]
    number = second.removeprefix("To see whether the hull is right, run program ")[0]
    played(desk, Pair("two", f"program{number}", "PUNCHED"))
    assert desk.decide()["says"].endswith(says)


def test_a_wrong_equation_and_a_missing_face_are_marked() -> None:
    points = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0], [1.0, 1.0, 1.0]]
    stage = {"points": points, "vertices": 4, "faces": [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]], "final": True}
    result = Session(compile_deck(deck_from_text("one.f", "      STOP\n      END\n")), Deck("no deck", ())).result()
    hulls, says = verdict._hulls([stage], result)
    assert says.endswith("Differences: 5 missing vertices, 3 missing faces, 1 wrong equation.")
    assert hulls["final"]["wrong"] == [3]
    assert [set(hulls["hull"]["faces"][n]) for n in hulls["hull"]["wrong"]] == [{1, 2, 4}, {1, 3, 4}, {2, 3, 4}]


def test_the_picture_never_shows_a_point_whose_coordinates_are_being_moved() -> None:
    program, deck = programs.program("program3"), named_deck("example5/punched")
    points = {tuple(map(float, re.findall(r"-?\.\d+E[+-]\d\d", card.text))) for card in deck.cards}
    record, torn = panel.Record(program), set()

    def trace(line: Line, session: Session) -> None:
        record(line, session)
        assert {tuple(point) for point in record.picture(session).get("points", ())} <= points, line.place.card
        if not {tuple(point) for point in panel.picture(session)["points"]} <= points:
            torn.add(line.place.card)

    run_with_operator(Session(program, deck, Options(hopper="any"), tracer=trace), Operator())
    assert {36, 37} <= torn


def test_core_storage_holds_the_digits_and_their_writer() -> None:
    desk = Desk()
    desk.load({"program": ["one.f", "      X=-2.5\n      STOP\n      END\n"], "deck": ""})
    desk.run(0)
    desk.act("STEP")
    desk.run(0)
    field = desk.field(39879)
    assert (field["name"], field["digits"], field["writer"]) == ("X", "K500000]]1", [1, 1])
    assert desk.field(5) == {}


def test_accept_expects_the_fields_of_its_format() -> None:
    desk = Desk()
    source = "      ACCEPT 1,I,A,J,B\n      STOP\n    1 FORMAT(I2,2X,E14.8/I3,F5.1)\n      END\n"
    desk.load({"program": ["one.f", source], "deck": ""})
    desk.run(0)
    desk.act("START")
    assert desk.run(1e9)["fields"] == [("I2", 1, 2), ("E14.8", 5, 14)]
    desk.act("ENTER 12  .10000000E+01")
    assert desk.run(1e9)["fields"] == [("I3", 1, 3), ("F5.1", 4, 5)]


def test_the_page_needs_only_the_modules_that_it_loads(tmp_path: Path) -> None:
    (tmp_path / "packages.zip").write_bytes(packages(packed(tmp_path)))
    code = f"""
import sys, zipfile
zipfile.ZipFile("packages.zip").extractall("packages")
sys.path[:] = ["packages", *(path for path in sys.path if path.startswith({sys.base_prefix!r}))]
from modern.publication.desk import Desk
from modern.publication.parting import parted
desk = Desk()
desk.load({{"program": "program1", "deck": "example4"}})
desk.run(1)
desk.act("START")
assert desk.run(1e9)["ended"]
assert desk.decide()["lines"]
assert parted("1 2 3")["says"]
"""
    subprocess.run([sys.executable, "-S", "-c", code], cwd=tmp_path, check=True)


def ended(desk: Desk, program: list[str], deck: list[str] | str = "") -> Answer:
    """Load a program, press START, and return the answer when it waits or ends."""
    desk.load({"program": program, "deck": deck})
    desk.run(1)
    desk.act("START")
    return halted(desk)


def halted(desk: Desk) -> Answer:
    """Run, and return the answer when the machine waits or the run ends."""
    return next(answer for answer in iter(lambda: desk.run(1000), None) if answer["ended"] or answer["waits"])


def test_endless_runs_are_recognised_and_their_logs_repeated() -> None:
    desk = Desk()
    answer = ended(desk, ["loop.f", "      I=1\n    1 I=I+1\n      GO TO 1\n      END\n"])
    assert (answer["repeats"], answer["stands"][:19]) == (20_000, "stopped (attention)")
    assert 1 < answer["seconds"] < 1000, "the worker needs the time on a 1620 for the speed"
    desk.act("START")
    assert desk.run(1)["repeats"] == 0, "an action of the operator may change the rest of the run"
    desk, again = Desk(), Desk()
    answer = ended(desk, ["loop.f", "   10 GO TO 10\n      END\n"])
    again.replay(desk.log())
    repeated = halted(again)
    assert (repeated["repeats"], repeated["statement"]) == (answer["repeats"], answer["statement"])
    assert again.log() == desk.log()


def test_a_switch_in_a_log_ends_a_loop_that_tests_it() -> None:
    source = "   10 IF (SENSE SWITCH 1) 20,10\n   20 DO 30 I=1,5000\n   30 CONTINUE\n      STOP\n      END\n"
    desk = Desk()
    desk.replay(
        "".join(f"CARD {card}\n" for card in source.splitlines()).join(("CARDS poll.f\n", "LOAD poll.f\n"))
        + "AT 30000 SWITCH 1 ON\n"
    )
    assert halted(desk)["ended"]
    assert "ATTN" not in desk.log()


@pytest.mark.parametrize("register", ["values", "kinds", "fac", "fixed", "last_card", "position"])
def test_states_that_differ_in_one_register_are_different(register: str) -> None:
    program = compile_deck(deck_from_text("one.f", "      I=1\n      STOP\n      END\n"))
    session = Session(program, Deck("no deck", ()))
    before = panel._determining(session)
    holder = session.devices if register == "position" else session.state
    value = getattr(holder, register)
    setattr(holder, register, [object(), *value[1:]] if isinstance(value, list) else object())
    assert panel._determining(session) != before


def test_a_run_that_reads_or_asks_does_not_count_as_endless() -> None:
    reading = "    1 READ 5,I\n      GO TO 1\n    5 FORMAT(I3)\n      END\n"
    answer = ended(Desk(), ["read.f", reading], ["many", "  1\n" * 3000])
    assert (answer["ended"], answer["repeats"]) == (True, 0)
    desk = Desk()
    desk.load({"program": ["ask.f", "    1 ACCEPT 5,I\n      GO TO 1\n    5 FORMAT(I3)\n      END\n"], "deck": ""})
    desk.run(1)
    desk.act("START")
    for _ in range(1500):
        desk.act("ENTER   1")
    assert desk.run(10_000)["repeats"] == 0

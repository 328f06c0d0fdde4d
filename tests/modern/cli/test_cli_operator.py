"""A person at a terminal runs programs, in a pseudo-terminal."""

import shutil
import signal
import subprocess
import sys
import time
from argparse import Namespace
from pathlib import Path

import pytest

from emulator.language.cards import deck_from_text
from emulator.language.compiler import compile_deck
from modern.cli.shared import operators
from tests.support.commands import call
from tests.support.paths import ROOT
from tests.support.terminals import Person

EXAMPLE4 = ROOT / "transcripts" / "chapter6" / "example4"
PERIOD = ROOT / "tests" / "data" / "period"
GAME = ["I TAKE 5", " 1 0 0", " 0 4 0", " 0 0 0", "YOUR MOVE"]
REFUSED = """-.00000000E-99-.45000000E+02-.00000000E-99 .90000000E+02
   5 2
 .61706749E+01 .66448162E+01 .20000000E+01
 .15433721E+01 .44751217E+01 .20000000E+01
 .78622131E+01 .75220111E+01 .20000000E+01
 .64349339E+01 .50709944E+01 .20000000E+01
 .73967760E+01 .58056573E+01 .20000000E+01
"""
LOOP = "      K=0\n    1 K=K+1\n      A=K\n      IF(SENSE SWITCH 2)3,1\n    3 PUNCH 9,K\n    9 FORMAT(I5)\n      END\n"
ASK = "    5 ACCEPT 90,K,L\n      TYPE 90,L,K\n      IF(K)5,6,5\n    6 STOP\n   90 FORMAT(2I4)\n      END\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Change to a folder with the game, a loop, and a program with ACCEPT."""
    for name in ("tictac.f", "tictac.deck"):
        shutil.copy(PERIOD / name, tmp_path)
    (tmp_path / "loop.f").write_text(LOOP)
    (tmp_path / "ask.f").write_text(ASK)
    (tmp_path / "one.deck").write_text("1\n")
    return tmp_path


def test_a_game_is_played_to_its_end(folder: Path) -> None:
    """The console opens without an option: the program has ACCEPT, the deck is a file, all streams are the terminal."""
    with Person(folder, "run", "tictac.f", "tictac.deck", "--punch", "cards", "--log", "log") as person:
        before = person.settings()
        person.sees("YOUR MOVE\n-- ACCEPT waits for a line, card 20\n")
        person.types(" 1\n")
        assert person.sees("-- ACCEPT waits").splitlines() == [" 1", *GAME, "-- ACCEPT waits"]
        for move, answer in (("2", "I TAKE 3"), ("7", "I TAKE 4"), ("6", "I TAKE 9")):
            person.types(f" {move}\n")
            person.sees(answer)
            person.sees("ACCEPT waits")
        person.types(" 8\n")
        person.sees("DRAW")
        person.sees("PAUSE 77 waits for START, card 86")
        person.types("switch 4 on\n")
        person.sees("SWITCH 4 ON\n")
        person.types("\n")
        assert person.ended() == 0
        assert person.settings() == before
    assert (folder / "cards").read_text() == " 1 1 4\n 4 4 1\n 1 1 4\n"
    lines = (folder / "log").read_text().splitlines()
    assert [line for line in lines if not line.startswith(("*", "LOAD"))] == [
        *("ENTER  1", "ENTER  2", "ENTER  7", "ENTER  6", "ENTER  8", "SWITCH 4 ON", "START")
    ]


def test_a_log_replays_to_the_same_bytes(folder: Path, capsys, monkeypatch) -> None:
    """A log with a switch, a breakpoint, invalid lines and STOP gives the same cards, typed lines and log."""
    with Person(folder, "run", "tictac.f", "tictac.deck", "--operator", "--punch", "cards", "--log", "log") as person:
        person.sees("stopped (attention) before card 9")
        person.types("\x1b1")
        person.sees("SWITCH 1 ON")
        person.types("break 40\n\n")
        person.sees("stopped (breakpoint) before statement 40 (card 59)")
        person.types("clear\n\n")
        for keys in ("1\n", "x\n", " 1\n", " 2\n"):
            person.sees("ACCEPT waits")
            person.types(keys)
        person.sees("PAUSE 77")
        person.types("stop\n")
        assert person.ended() == 1
        assert "hull1620: tictac.f: card 86: stopped by the operator, in PAUSE 77" in person.output
    monkeypatch.chdir(folder)
    options = ("--punch", "cards2", "--log", "log2", "--typewriter", "typed")
    code, out, err = call(capsys, "run", "tictac.f", "tictac.deck", "--operator=log", *options)
    assert (code, out) == (1, "")
    assert "stopped by the operator" in err
    assert (folder / "cards2").read_bytes() == (folder / "cards").read_bytes() != b""
    log = (folder / "log").read_text()
    assert (folder / "log2").read_text() == log
    typed = [line.removeprefix("* type").strip() for line in log.splitlines() if line.startswith("* type ")]
    assert [line.strip() for line in (folder / "typed").read_text().splitlines()] == typed
    assert [line.strip() for line in person.output.splitlines() if line.strip() in typed] == typed


def test_example_4_is_stepped_a_switch_flipped_and_resumed(folder: Path, capsys, monkeypatch) -> None:
    """Both programs halt before their first statement. Program 2 tests the switch when it rejects its data."""
    monkeypatch.chdir(folder)
    deck = str(EXAMPLE4 / "program1.deck")
    with Person(folder, "hull", deck, "--operator", "--punch", "stepped", "--log", "log") as person:
        person.sees("program1.f is loaded")
        person.sees("stopped (attention) before statement 100 (card 4)")
        person.types("\n")
        person.sees("POINTS ARE COPLANAR\n")
        person.sees("program2.f is loaded")
        person.sees("stopped (attention) before statement 100 (card 4)")
        person.types("step\nstep\n")
        person.sees("N = 8, KPROJ = 2\n-- stopped (step) before")
        person.types("step 3\n")
        person.sees("E(2) = .00000000E-99\n-- stopped (step) before statement 101")
        person.types("step 20\n")
        person.sees("stopped (step) before")
        person.types("v\n")
        person.sees("\nNV     3\n")
        person.types("\x1bOP")
        person.sees("SWITCH 1 ON")
        person.types("switch\n")
        person.sees("1 ON, 2 OFF, 3 OFF, 4 OFF")
        person.types("start\n")
        assert person.ended() == 0
        assert person.output.count("POINTS ARE COPLANAR") == 1
    assert call(capsys, "hull", deck, "--punch", "plain")[0] == 0
    assert call(capsys, "hull", deck, "--operator=log", "--punch", "again", "--log", "log2")[0] == 0
    assert (folder / "stepped").read_text() == (folder / "again").read_text() == (folder / "plain").read_text()
    assert (folder / "log2").read_text() == (folder / "log").read_text()


def test_switch_1_flipped_at_a_breakpoint_lets_program_2_continue(folder: Path, capsys, monkeypatch) -> None:
    """After DATA NOT ACCEPTABLE it stops, or continues with the same data if the switch is on (KNOWN-FAULTS 10)."""
    monkeypatch.chdir(folder)
    (folder / "refused.deck").write_text(REFUSED)
    assert call(capsys, "run", "program2", "refused.deck", "--punch", "off")[0] == 1
    call(capsys, "run", "program2", "refused.deck", "--punch", "on", "--switch", "1")
    with Person(folder, "run", "program2", "refused.deck", "--operator", "--punch", "flipped") as person:
        person.sees("stopped (attention) before")
        person.types("break 126\n\n")
        person.sees("stopped (breakpoint) before statement 126 (card 82): PRINT 8")
        person.types("\x1b1")
        person.sees("SWITCH 1 ON")
        person.types("clear 126\nstart\n")
        person.ended()
    assert (folder / "flipped").read_text() == (folder / "on").read_text() != (folder / "off").read_text()


def test_attention_stops_an_endless_loop(folder: Path) -> None:
    with Person(folder, "run", "loop.f", "one.deck", "--operator", "--log", "log", "--limit", "900000000") as person:
        person.sees("before card 1")
        person.types("\n")
        time.sleep(1.0)
        person.types("\x03")
        person.sees("stopped (attention) before")
        person.types("variables\n")
        count = int(person.sees("\nA ").split("K ")[-1].split()[0])
        person.types("core k\n")
        assert f"> 39879 K               {count}" in person.sees("1620> ") + person.sees("1620> ")
        person.types("cards\n")
        person.sees("read: 0 of 1 cards\npunched: 0\n")
        person.types("\n\x1b2")
        assert person.ended() == 0
        assert person.output.endswith("SWITCH 2 ON\n" + person.output.rpartition("\n")[0].rpartition("\n")[2] + "\n")
    log = (folder / "log").read_text().splitlines()
    done = [line.split() for line in log if line[0] != "*"]
    assert 1_000 < int(done[3][1]) < int(done[5][1])
    assert [words[0] for words in done] == ["LOAD", "AT", "START", "AT", "START", "AT"]


def test_attention_by_signals_and_at_a_slow_typewriter(folder: Path) -> None:
    """Esc A, SIGINT, and Ctrl-C while a line is typed slowly, which finishes the line at once."""
    with Person(folder, "run", "loop.f", "one.deck", "--operator") as person:
        for call_on in (lambda: person.types("\x1bA"), person.interrupts, lambda: person.types("\x1ba")):
            person.sees("1620> ")
            person.types("\n")
            time.sleep(0.3)
            call_on()
            person.sees("stopped (attention) before")
        person.sees("1620> ")
        person.interrupts()
        person.sees("1620> ")
        person.types("stop\n")
        assert person.ended() == 1
    (folder / "long.f").write_text(f"      TYPE 9\n    9 FORMAT(49H{'A' * 49})\n      X=1.\n      END\n")
    with Person(folder, "run", "long.f", "--operator", "--slow") as person:
        person.sees("1620> ")
        person.types("\n")
        person.sees("AAA")
        person.types("\x03")
        start = time.monotonic()
        person.sees("A\n-- stopped (attention) before card 3: X=1.")
        assert time.monotonic() - start < 3
        person.types("\n")
        assert person.ended() == 0


def test_an_invalid_entry_must_be_typed_again(folder: Path) -> None:
    with Person(folder, "run", "ask.f", "--operator", "--typewriter", "typed") as person:
        person.sees("before statement 5")
        person.types("\n")
        person.sees("ACCEPT waits for a line, statement 5 (card 1)\n")
        person.types("   1  2x\n")
        said = person.sees("ACCEPT waits").replace("\n--   ", " ")
        assert "typewriter: line 1, column 5: '2X' is not an integer; the line is typed again" in said
        person.types("   15\b\x7f\x7f  12   3\x15   1   2\n")
        person.sees("   2   1\n")
        person.types("   0   0\n")
        assert person.ended() == 0
    assert (folder / "typed").read_text() == "   2   1\n   0   0\n"


@pytest.mark.parametrize("term", ["dumb", "xterm"])
def test_output_fits_60_columns_with_and_without_terminal_control(folder: Path, term: str) -> None:
    """No line is wider than the terminal, and the output has only text, line ends and backspaces."""
    with Person(folder, "run", "tictac.f", "tictac.deck", "--operator", columns=60, term=term) as person:
        person.sees("before card 9")
        for words in (
            "help",
            "v",
            "v m",
            "core m(3)",
            "core 1",
            "core x",
            "cards",
            "break 77",
            "jump",
            "s",
            "switch 7",
        ):
            person.types(f"{words}\n")
            person.sees("1620> ")
        person.types("break 15\nstart\n")
        person.sees("ACCEPT waits")
        person.types(" 9\n")
        person.sees("stopped (breakpoint) before statement 15")
        person.types("step\nstep\ncards\nv l\nstop\n")
        assert person.ended() == 1
        lines = person.output.splitlines()
        assert max(len(line) for line in lines if "hull1620:" not in line) <= 60
        assert not [c for c in person.output if not (c.isprintable() or c in "\n\b")]
        assert "M(9) = 1" in lines
        assert lines.count("  HELP") == 0


def test_lines_appear_at_the_typewriters_speed(folder: Path) -> None:
    with Person(folder, "run", "tictac.f", "tictac.deck", "--operator", "--slow") as person:
        person.sees("before card 9")
        person.types("\n")
        person.sees("TIC-")
        start = time.monotonic()
        person.sees("TAC-TOE\n")
        assert time.monotonic() - start > 0.5
        person.sees("ACCEPT waits")
        person.types("\x04")
        assert person.ended() == 1


def test_attention_at_accept_goes_to_the_console_and_back(folder: Path) -> None:
    with Person(folder, "run", "ask.f", "one.deck") as person:
        person.sees("ACCEPT waits")
        person.types("   1\x03")
        person.sees("Enter: back to the line")
        person.types("step\n")
        person.sees("ACCEPT waits")
        person.types("start\n   1   7\n")
        person.sees("stopped (step) before card 2: TYPE 90,L,K")
        person.types("\n")
        person.sees("   7   1\n")
        person.types("\x03")
        person.types("stop\n")
        assert person.ended() == 1


def test_a_closed_terminal_stops_the_run_and_keeps_its_output(folder: Path) -> None:
    options = ("--typewriter", "typed", "--log", "log")
    with Person(folder, "run", "tictac.f", "tictac.deck", "--operator", *options) as person:
        person.sees("before card 9")
        person.types("\n")
        person.sees("ACCEPT waits")
        person.leaves()
        assert person.ended() != 0
    assert (folder / "typed").read_text() == "TIC-TAC-TOE\nYOUR MOVE\n"
    assert (folder / "log").read_text().splitlines()[-1] == "STOP"


def test_results_go_to_their_streams(folder: Path) -> None:
    """If standard output and error are files, the terminal still shows the typed lines and asks."""
    with (
        (folder / "out").open("w") as out,
        (folder / "err").open("w") as err,
        Person(folder, "run", "ask.f", "--operator", elsewhere={"stdout": out, "stderr": err}) as person,
    ):
        person.sees("before statement 5")
        person.types("\n")
        person.sees("ACCEPT waits")
        person.types("   0   5\n")
        person.sees("   5   0\n")
        assert person.ended() == 0
    assert ((folder / "out").read_text(), (folder / "err").read_text()) == ("", "   5   0\n")


@pytest.mark.parametrize("stream", ["stdin", "stdout", "stderr"])
def test_the_operator_is_asked_only_if_all_streams_are_one_terminal(folder: Path, stream: str) -> None:
    with (folder / "lines").open("w+") as file:
        if stream == "stdin":
            file.write("   0   5\n")
            file.seek(0)
        with Person(folder, "run", "ask.f", "one.deck", elsewhere={stream: file}) as person:
            assert person.ended() == (0 if stream == "stdin" else 2)
            assert "waits" not in person.output


@pytest.mark.parametrize("more", [["--operator=none"], []])
def test_the_operator_is_not_asked_without_a_deck_or_on_request(folder: Path, more: list[str]) -> None:
    with Person(folder, "run", "ask.f", *(["one.deck", *more] if more else [])) as person:
        assert person.ended() == 2
        assert "no typed line is left for ACCEPT" in person.output


def test_the_option_without_a_terminal_is_an_error(capsys, folder: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "modern.cli.main", "run", str(folder / "ask.f"), "--operator"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        start_new_session=True,
        check=False,
    )
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("hull1620: --operator: no terminal (/dev/tty: ")
    assert done.stderr.count("\n") == 1


def test_an_invalid_operator_file_is_reported_in_one_line(folder: Path, capsys, monkeypatch) -> None:
    monkeypatch.chdir(folder)
    (folder / "bad").write_text("ENTER  1\n\nSWITCH ONE ON\n")
    arguments = ("run", "tictac.f", "tictac.deck")
    code, out, err = call(capsys, *arguments, "--operator=bad", "--punch", "cards", "--log", "log")
    assert (code, out, err) == (2, "", "hull1620: bad: line 3: expected SWITCH, 1 to 4, ON or OFF\n")
    assert not (folder / "cards").exists()
    assert not (folder / "log").exists()
    (folder / "bad").write_text("START\n")
    code, out, err = call(capsys, *arguments, "--operator=bad")
    assert (code, out) == (2, "")
    assert (
        err.splitlines()[-1]
        == "hull1620: bad: line 1: found START, which does not fit the halt: ACCEPT waits for a line, card 20"
    )
    assert call(capsys, *arguments, "--operator=none.txt")[2] == "hull1620: none.txt: no such file or directory\n"


def test_unused_lines_are_noted(folder: Path, capsys, monkeypatch) -> None:
    monkeypatch.chdir(folder)
    (folder / "more").write_text("ENTER    0   1\nSTART\n")
    code, _, err = call(capsys, "run", "ask.f", "--operator=more")
    assert (code, err) == (0, "   1   0\nnote: more: the run did not use line 2 and later lines\n")


def test_slow_needs_a_terminal(folder: Path, capsys) -> None:
    code, out, err = call(capsys, "run", str(folder / "loop.f"), "--slow", "--operator=none")
    assert (code, out) == (2, "")
    assert err == "hull1620: --slow needs an operator at the terminal; add --operator\n"


def test_cards_appear_as_they_are_punched_and_files_only_complete(folder: Path) -> None:
    (folder / "endless.f").write_text("    1 PUNCH 9\n      TYPE 9\n      GO TO 1\n    9 FORMAT(5HAGAIN)\n      END\n")
    command = [sys.executable, "-m", "modern.cli.main", "run", str(folder / "endless.f"), "--limit", "900000000"]
    for more in ([], ["--punch", str(folder / "cards")], ["--typewriter", str(folder / "typed")]):
        pipe = subprocess.Popen([*command, *more], cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        with pipe:
            stream = pipe.stderr if "--punch" in more else pipe.stdout
            assert stream is not None
            assert [stream.readline() for _ in range(3)] == ["AGAIN\n"] * 3
            pipe.send_signal(signal.SIGINT)
            assert pipe.stdout is not None
            assert pipe.stderr is not None
            pipe.stdout.close()
            pipe.stderr.close()
        assert pipe.returncode != 1
    assert sorted(path.name for path in folder.iterdir() if path.suffix not in (".f", ".deck")) == []


@pytest.mark.parametrize(("source", "asks"), [(ASK, True), (LOOP, False), ("      PAUSE\n      END\n", True)])
def test_only_a_program_with_accept_or_pause_has_questions(source: str, asks: bool, folder: Path, monkeypatch) -> None:
    monkeypatch.setattr(operators, "is_terminal", lambda stream: True)
    arguments = Namespace(deck=str(folder / "ask.f"))
    assert operators._has_questions(arguments, compile_deck(deck_from_text("p.f", source))) is asks

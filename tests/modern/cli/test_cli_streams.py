"""The outputs of commands: files and devices, closed and full streams, and output before an error."""

import io
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.commands import DECK, call


def test_files_replace_the_standard_streams(room: Path, capsys) -> None:
    code, out, err = call(capsys, "hull", "good.deck", "--punch", "c", "--typewriter", "t", "--trace", "l")
    assert (code, out, err) == (0, "", "")
    assert Path("t").read_text(encoding="utf-8") == "POINTS ARE NOT COPLANAR\n"
    assert Path("c").read_text(encoding="utf-8").endswith("DETERMINED\n\n\n\n")
    trace = Path("l").read_text(encoding="utf-8")
    assert "* program1.f" in trace
    assert "* program3.f" in trace
    assert "X(2) = .10000000E+01" in trace


def test_a_deck_from_standard_input(room: Path, capsys, monkeypatch) -> None:
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(DECK.encode()), encoding="utf-8"))
    assert call(capsys, "hull", "-")[0] == 0


def test_a_closed_pipe_is_no_error() -> None:
    command = f"{sys.executable} -m modern.cli.main compile program3 | head -n 1"
    done = subprocess.run(["bash", "-c", f"set -o pipefail; {command}"], capture_output=True, text=True, check=False)
    assert done.stderr == ""
    assert done.stdout.count("\n") == 1


# The outputs and their destinations.


def test_a_device_is_written_and_not_replaced(room: Path, capsys) -> None:
    os.mkfifo("pipe")
    reader = subprocess.Popen(["cat", "pipe"], stdout=subprocess.PIPE, text=True)
    assert call(capsys, "hull", "good.deck", "--trace", "pipe")[0] == 0
    assert "* program3.f" in reader.communicate(timeout=10)[0]
    assert Path("pipe").is_fifo()


def test_an_existing_file_keeps_its_mode_and_a_link_is_followed(room: Path, capsys) -> None:
    Path("cards").write_text("old", encoding="utf-8")
    Path("cards").chmod(0o600)
    Path("link").symlink_to("cards")
    assert call(capsys, "hull", "good.deck", "--punch", "link")[0] == 0
    assert Path("link").is_symlink()
    assert Path("cards").stat().st_mode & 0o777 == 0o600
    assert "CONVEX HULL" in Path("cards").read_text(encoding="utf-8")


def test_output_before_an_invalid_card_is_kept_and_blank_cards_are_ignored(room: Path, capsys) -> None:
    Path("bad.deck").write_text("2.\nABC\n", encoding="utf-8")
    code, out, err = call(capsys, "run", "good.f", "bad.deck", "--trace", "log")
    assert (code, out) == (2, " .20000000E+01\n")
    assert err.count("\n") == 1
    assert "READ 2,X" in Path("log").read_text(encoding="utf-8")
    Path("b.deck").write_text(DECK + "\n\n", encoding="utf-8")
    code, _, err = call(capsys, "hull", "b.deck")
    assert code == 0
    assert "warning: b.deck: card 6, column 1: the programs do not read the blank cards" in err
    cards = "9.E+98        1.E+98        0.\n-9.E+98       2.E+98        0.            JUNK\n"
    Path("big.deck").write_text(" 2\n" + cards, encoding="utf-8")
    code, _, err = call(capsys, "hull", "big.deck")
    assert code == 0
    assert "the programs do not read the columns after z" in err
    assert "note: program1.f: E3 on card 40: a product overflows" in err


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["hull", "good.deck", "--punch", ""], "a file without a name"),
        (["hull", "good.deck", "--punch", "a", "--typewriter", "a"], "a: two outputs have this file name"),
        (["reproduce", "3", "--json", "nosuch/file"], "nosuch/file: no such file or directory"),
        (["run", "a\nb.f"], "a\\nb.f: no such file"),
    ],
)
def test_outputs_are_checked_before_the_run(room: Path, capsys, arguments: list[str], words: str) -> None:
    code, out, err = call(capsys, *arguments)
    assert (code, out) == (2, "")
    assert words in err
    assert err.count("\n") == 1


@pytest.mark.parametrize(
    ("words", "message"),
    [("diff - <&-", "standard input is closed"), ("hull good.deck >&-", "standard output is closed")],
)
def test_streams_that_the_shell_closed_are_reported(room: Path, words: str, message: str) -> None:
    command = ["bash", "-c", f"{sys.executable} -m modern.cli.main {words}"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, "Traceback" in done.stderr) == (2, "", False)
    assert done.stderr.splitlines()[-1].startswith(f"hull1620: {message}")

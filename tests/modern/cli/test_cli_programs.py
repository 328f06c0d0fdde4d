"""A program of one's own, as its owner brings it: small letters."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.commands import call

SOURCE = "      READ 6,I\n      J=I*I\n      PUNCH 6,J\n      STOP\n    6 FORMAT(I3)\n      END\n"


@pytest.fixture(autouse=True)
def room(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("large.f").write_text(SOURCE)
    Path("small.f").write_text("C  Squares\n" + SOURCE.lower())
    Path("one.deck").write_text(" 12\n")


CALLS = {
    "check": (),
    "compile": (),
    "map": (),
    "run": ("one.deck",),
    "diverge": ("one.deck",),
}
"""Every command that reads a program of one's own, and the rest of its call."""


@pytest.mark.parametrize("command", CALLS)
def test_small_letters_are_named_once_with_the_option_that_reads_them(
    command: str, capsys: pytest.CaptureFixture[str]
) -> None:
    code, out, err = call(capsys, command, "small.f", *CALLS[command])
    assert (code, out) == (2, "")
    assert err == (
        "hull1620: small.f: card 2, column 7: 'r' is not in the card code: letters are capitals; "
        "--upcase reads the whole program so\n"
    )


@pytest.mark.parametrize("command", CALLS)
def test_upcase_makes_it_the_program_in_capitals(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    """All that is put out is the same, the number of the cards apart: the comment is one card more."""
    Path("large.f").write_text("C\n" + SOURCE)
    expected = call(capsys, command, "large.f", *CALLS[command])
    assert expected[0] == 0
    code, out, err = call(capsys, command, "small.f", *CALLS[command], "--upcase")
    assert (code, out.replace("small.f", "large.f"), err) == expected


def test_a_deck_of_data_is_never_read_as_capitals(capsys: pytest.CaptureFixture[str]) -> None:
    Path("one.deck").write_text("1.e0\n")
    code, out, err = call(capsys, "run", "small.f", "one.deck", "--upcase")
    assert (code, out) == (2, "")
    assert err == "hull1620: one.deck: card 1, column 3: 'e' is not in the card code: letters are capitals\n"

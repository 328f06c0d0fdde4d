"""Every command that cannot read a file reports it in one line and exits with 2."""

import io
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.commands import call
from tests.support.paths import ROOT

READERS = {
    "appel-will": (),
    "cards": (),
    "check": (),
    "compile": (),
    "diff": (),
    "diverge": ("good.deck",),
    "draw": (),
    "export": ("--format", "off"),
    "export-job": ("--for", "pdq", "--out", "job"),
    "hidden-line": (),
    "hull": (),
    "map": (),
    "octree-hull": (),
    "run": ("good.deck",),
    "voxel-hull": (),
}
"""The commands whose first argument is a file, with the rest of a call."""
SOURCE_DECKS = {"check", "compile", "diverge", "export-job", "hull", "map", "run"}


@pytest.fixture(autouse=True)
def room(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("good.deck").write_text(" 1\n", encoding="utf-8")
    Path("folder").mkdir()


@pytest.fixture(params=READERS)
def reader(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def refused(capsys, command: str, path: str) -> str:
    """Return the single line in which a command rejects a file."""
    code, out, err = call(capsys, command, path, *READERS[command])
    assert (code, out, err.count("\n")) == (2, "", 1), err
    assert err.startswith("hull1620: ")
    return err.removeprefix("hull1620: ").removesuffix("\n")


class Folder(io.RawIOBase):
    """The standard input of a command with ``< folder``."""

    def readable(self) -> bool:
        return True

    def readinto(self, buffer: object) -> int:
        raise IsADirectoryError(21, "Is a directory")


def test_closed_standard_input_is_reported(capsys, monkeypatch, reader: str) -> None:
    monkeypatch.setattr("sys.stdin", None)
    assert refused(capsys, reader, "-") == "standard input is closed"


def test_unreadable_standard_input_is_reported(capsys, monkeypatch, reader: str) -> None:
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BufferedReader(Folder()), encoding="utf-8"))
    assert refused(capsys, reader, "-") == "standard input: is a directory"


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("missing", "missing: no such file or directory"),
        ("folder", "folder: is a directory"),
        ("", "a file without a name cannot be read"),
        ("a\0b", "'a\\x00b': not a valid file name"),
    ],
)
def test_unreadable_files_are_reported(capsys, reader: str, path: str, message: str) -> None:
    if path == "folder" and reader in ("octree-hull", "voxel-hull"):
        message += " without a DICOM file; expected a file, or a folder with a DICOM series"
    assert refused(capsys, reader, path) == message


def test_bytes_that_are_not_text_are_reported(capsys, reader: str) -> None:
    Path("bytes").write_bytes(b"1,2,3\n4,\xff\n")
    message = refused(capsys, reader, "bytes")
    if reader in SOURCE_DECKS:
        assert message == "bytes: card 2, column 3: '\u00ff' is not in the card code"
    elif reader in ("octree-hull", "voxel-hull"):
        assert message == "bytes: not NPY, NRRD or UTF-8 text; raw data need --shape NX,NY,NZ"
    else:
        assert message == "bytes: line 2, column 3: not a text file in UTF-8"


@pytest.mark.parametrize("path", ["missing.toml", "folder.toml", "bytes.toml"])
@pytest.mark.parametrize("command", ["study", "hidden-line"])
def test_invalid_plans_and_scenes_are_reported(capsys, command: str, path: str) -> None:
    Path("folder.toml").mkdir()
    Path("bytes.toml").write_bytes(b"a\n\xff")
    code, out, err = call(capsys, command, path)
    assert (code, out) == (2, "")
    reasons = {
        "missing": "no such file or directory",
        "folder": "is a directory",
        "bytes": "line 2, column 1: not a text file in UTF-8",
    }
    assert err == f"hull1620: {path}: {reasons[path.removesuffix('.toml')]}\n"


def test_points_beyond_doubles_are_one_line_in_diff(tmp_path: Path, monkeypatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    Path("far.csv").write_text("0,0,0\n1e400,0,0\n0,1e400,0\n0,0,1e400\n", encoding="utf-8")
    code, _, err = call(capsys, "diff", "far.csv")
    assert (code, err.count("\n")) == (2, 1)
    assert "too large for float64" in err


def test_a_name_that_the_terminal_cannot_show_is_escaped(tmp_path: Path) -> None:
    (tmp_path / "\u00e9.f").write_text("      END\n")
    command = [sys.executable, "-m", "modern.cli.main", "check", "\u00e9.f"]
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "PYTHONIOENCODING": "ascii"}
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, check=False)
    assert (done.returncode, b"Traceback" in done.stderr) == (0, False)
    assert b"\\xe9.f" in done.stdout + done.stderr

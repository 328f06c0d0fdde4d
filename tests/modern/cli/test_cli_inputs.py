"""The arguments of commands: examples by name, wrong kinds of file, names of outputs, and the help."""

import argparse
import re
from pathlib import Path

import numpy as np
import pytest

from modern.cli.arguments import COMMANDS
from modern.cli.main import build_parser
from modern.edition import programs
from tests.support.commands import call
from tests.support.paths import ROOT

CSV = "x,y,z\n0,0,0\n4,0,0\n0,4,0\n0,0,4\n1,1,1\n"
CHAPTER6 = ROOT / "transcripts" / "chapter6"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch) -> Path:
    (tmp_path / "points.csv").write_text(CSV, encoding="ascii")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("number", range(1, 7))
def test_an_example_can_be_named_wherever_a_deck_is_accepted(number: int, folder: Path, capsys) -> None:
    path = str(CHAPTER6 / f"example{number}" / "program1.deck")
    for words in (["run", "program1"], ["hull", "--programs", "examples"], ["diverge", "program1"], ["diff"]):
        by_path, by_name = call(capsys, *words, path), call(capsys, *words, f"example{number}")
        assert by_name[0] == by_path[0]
        # The length of the name or of the path determines where lines are folded.
        name_less, path_less = by_name[1].replace(f"example{number}", ""), by_path[1].replace(path, "")
        assert name_less.split() == path_less.split()


def test_examples_are_also_points(folder: Path, capsys) -> None:
    code, out, _ = call(capsys, "export", "example5", "--format", "off")
    assert (code, out.splitlines()[0]) == (0, "OFF")
    for words in (["draw", "-o", "a.svg"], ["hidden-line", "-o", "b.svg"], ["appel-will", "-o", "c.off"]):
        assert call(capsys, words[0], "example6", *words[1:])[0] == 0
    assert call(capsys, "cards", "example5", "-o", "again.deck")[0] == 0
    assert (
        call(capsys, "diff", "again.deck")[1].splitlines()[1:] == call(capsys, "diff", "example5")[1].splitlines()[1:]
    )


def test_a_figure_and_a_set_of_a_study_have_names(folder: Path, capsys) -> None:
    code, out, _ = call(capsys, "appel-will", "appel-will/fig18", "--inside-corners", "concave")
    assert (code, out.splitlines()[0]) == (0, "appel-will/fig18: 12 points, 8 surfaces")
    assert call(capsys, "hull", "appel-will/fig18", "--layers", "corrected", "--core", "60000")[0] == 0
    first, again, other = (call(capsys, "cards", name)[1] for name in ("seventy/17", "seventy/0/17", "seventy/18"))
    assert first == again != other
    assert call(capsys, "hull", "seventy/17")[0] in (0, 1)
    code, _, err = call(capsys, "draw", "seventy/9999/0")
    assert code == 2
    assert re.fullmatch(r"hull1620: seventy/9999/0: study seventy has cells 0 to \d+\n", err)
    code, _, err = call(capsys, "draw", "seventy/999999999")
    assert code == 2
    assert re.fullmatch(r"hull1620: seventy/0/999999999: study seventy has cells 0 to \d+, samples 0 to \d+\n", err)


@pytest.mark.parametrize("name", ["example7", "example", "appel-will/fig99", "sixty/1", "seventy"])
def test_an_unknown_example_is_reported_as_a_missing_file(name: str, folder: Path, capsys) -> None:
    code, _, err = call(capsys, "draw", name, "-o", "a.svg")
    assert (code, err) == (2, f"hull1620: {name}: no such file or directory\n")


def test_examples_are_named_like_files_but_files_take_precedence(folder: Path, capsys) -> None:
    (folder / "example5").write_text(CSV, encoding="ascii")
    assert call(capsys, "diff", "example5")[1].startswith("example5: 5 points\n")
    code, out, err = call(capsys, "punched", "example1")
    assert (code, err) == (0, "")
    assert "<title>example1: 4 cards</title>" in out


@pytest.mark.parametrize("command", [["hull"], ["diverge", "program1"], ["diverge", "program1_examples"]])
def test_points_instead_of_a_deck_name_the_command_that_makes_one(command: list[str], folder: Path, capsys) -> None:
    np.save(folder / "points.npy", np.eye(3))
    for name, kind in (("points.csv", "a list"), ("points.npy", "NPY")):
        code, _, err = call(capsys, *command, name)
        assert (code, err.count("\n")) == (2, 1)
        assert err.startswith(f"hull1620: {name}: expected a data deck, found {kind}")
        assert f"hull1620 cards {name} -o points.deck makes a deck of it" in err


def test_the_message_about_too_many_digits_names_a_valid_remedy(folder: Path, capsys) -> None:
    (folder / "long.csv").write_text("0.123456789,0,0\n1,0,0\n0,1,0\n0,0,1\n", encoding="ascii")
    assert "hull1620 cards --truncate" in call(capsys, "diff", "long.csv")[1]
    code, _, err = call(capsys, "cards", "long.csv", "-o", "long.deck")
    assert (code, err) == (
        2,
        "hull1620: long.csv: line 1, field 1: 9 significant digits; a card holds 8 (--truncate drops the others)\n",
    )
    assert call(capsys, "cards", "--truncate", "long.csv", "-o", "long.deck")[0] == 0
    assert "not run" not in call(capsys, "diff", "long.deck")[1]


def test_remedies_for_an_overlap_and_a_raw_volume_are_named(folder: Path, capsys) -> None:
    code, _, err = call(capsys, "hull", "example5", "--layers", "corrected")
    assert code == 2
    assert "OVERLAP" in err
    assert err.endswith("; --core 60000 is large enough\n")
    (folder / "a.raw").write_bytes(bytes(100) + b"\x01" * 25)
    for command in ("voxel-hull", "octree-hull"):
        code, _, err = call(capsys, command, "a.raw")
        assert code == 2
        assert "raw data need --shape NX,NY,NZ" in err
    assert call(capsys, "voxel-hull", "a.raw", "--shape", "5,5,5")[0] == 0


@pytest.mark.parametrize("diameter", ["1290", "100000", "999999999"])
def test_the_message_about_a_large_ball_names_the_limit(diameter: str, capsys) -> None:
    code, _, err = call(capsys, "voxel-hull", f"ball:{diameter}")
    assert (code, "expected a diameter of at most 1289" in err) == (2, True)


@pytest.mark.parametrize(
    ("words", "endings"),
    [
        (["draw", "points.csv", "-o", "a.jpg"], ".svg or .pdf or .png"),
        (["appel-will", "points.csv", "-o", "a.stl"], ".off"),
        (["hidden-line", "house", "-o", "a.pdf"], ".svg or .hpgl or .plt"),
        (["export", "points.csv", "-o", "a.3ds"], ".off, .obj, .ply, .stl, .json"),
        (["voxel-hull", "ball:3", "-o", "a.json"], ".off, .obj, .ply, .stl"),
        (["octree-hull", "ball:3", "-o", "a.svg"], ".nrrd or .npy or .off or .obj or .ply or .stl"),
    ],
)
def test_an_unsupported_extension_of_an_output_is_rejected(words, endings, folder, capsys) -> None:
    code, _, err = call(capsys, *words)
    assert (code, err.count("\n")) == (2, 1)
    assert (
        f"a name that ends with {endings}" in err
        or f"must end with one of {endings}" in err
        or f"one of {endings}" in err
    )
    assert [path.name for path in folder.iterdir()] == ["points.csv"]


def options(command: str) -> list[argparse.Action]:
    parser = build_parser([command])
    found = next(a for a in parser._actions if isinstance(a, argparse._SubParsersAction))
    return [action for action in found.choices[command]._actions if action.dest != "help"]


@pytest.mark.parametrize("command", sorted(COMMANDS))
def test_every_argument_has_a_help_that_states_its_default(command: str) -> None:
    for action in options(command):
        name = "/".join(action.option_strings) or action.dest
        assert action.help or action.metavar == "PROGRAM.f", f"{command} {name} has no help"
        if action.option_strings and action.default not in (None, False):
            assert "default" in str(action.help), f"{command} {name}: {action.help}"


def test_the_layers_are_listed() -> None:
    (layers,) = (action for action in options("hull") if action.dest == "layers")
    base = {"ocr", "print", "lacuna", "cosmetic"}
    every = {row.layer for name in programs.TEXTS for row in programs.text(name).rows} - base
    assert [layer for layer in every if layer not in str(layers.help)] == []


@pytest.mark.parametrize("command", [["run"], ["diverge"], ["listing"]])
def test_a_list_of_points_instead_of_a_deck_is_rejected_with_a_remedy(command, tmp_path, monkeypatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    Path("mine.csv").write_text("76,-18,-21\n1,2,3\n4,5,7\n", encoding="utf-8")
    code, out, err = call(capsys, *command, "program1", "mine.csv")
    assert (code, out) == (2, "")
    assert "expected a data deck, found a list of points (x,y,z on each line, or " in err
    assert "; hull1620 cards mine.csv -o points.deck makes a deck of it" in err
    assert err.count("\n") == 1
    # A user-defined program may read any data, whatever its name is.
    Path("program1.f").write_text(
        "      READ 1,I\n      TYPE 1,I\n      STOP\n    1 FORMAT(I2)\n      END\n", encoding="utf-8"
    )
    assert call(capsys, *command, "program1.f", "mine.csv")[0] == 0


@pytest.mark.parametrize("command", [["flowchart", "program1"], ["punched", "program1"]])
def test_a_picture_needs_the_extension_of_a_picture(command: list[str], tmp_path: Path, monkeypatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    code, out, err = call(capsys, *command, "-o", "x.txt")
    assert (code, out) == (2, "")
    assert err == f"hull1620: x.txt: {command[0]} expects a name that ends with .svg\n"
    assert not list(tmp_path.iterdir())
    assert call(capsys, *command, "-o", "x.SVG")[0] == 0
    assert call(capsys, "flowchart", "program1", "--table", "-o", "x.txt")[0] == 0

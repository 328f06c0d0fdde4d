"""Tests of the command ``hull1620 hidden-line``: its inputs, viewpoints, tables and error messages."""

import shutil
from importlib.resources import files
from pathlib import Path
from xml.etree import ElementTree

import pytest

from modern.cli.main import main
from tests.modern.papers.test_nakamae_scenes import HEAD
from tests.support.solids import CUBE, CUBE_FACES


def run(*arguments: str) -> int:
    return main(["hidden-line", *arguments])


@pytest.fixture
def folder(tmp_path: Path, monkeypatch) -> Path:
    monkeypatch.chdir(tmp_path)
    rows = [" ".join(map(str, row)) for row in (*CUBE, *((len(face), *face) for face in CUBE_FACES))]
    (tmp_path / "cube.off").write_text("\n".join(["OFF", "8 6 12", *rows, ""]))
    (tmp_path / "points.csv").write_text("0,0,0\n1,0,0\n0,1,0\n0,0,1\n")
    shutil.copy(str(files("modern.papers.nakamae_nishita").joinpath("scenes", "house.toml")), tmp_path / "mine.toml")
    return tmp_path


@pytest.mark.parametrize("source", ["cube.off", "points.csv", "mine.toml", "columns"])
def test_every_kind_of_input_is_drawn(folder: Path, source: str, capsys) -> None:
    assert run(source, "-o", "a.svg") == 0
    assert run(source, "-o", "a.hpgl", "--hidden") == 0
    ElementTree.parse(folder / "a.svg")
    assert (folder / "a.hpgl").read_text().startswith("IN;")
    output = capsys.readouterr()
    assert output.out == ""
    assert output.err.splitlines()[0].split() == "polyhedra vertices faces points I II III (seconds)".split()
    assert run(source) == 0
    assert capsys.readouterr().out == (folder / "a.svg").read_text()


def test_the_viewpoint_and_the_refinements_change_the_picture(folder: Path, capsys) -> None:
    pictures = []
    for options in ((), ("--eye=-1,2,3",), ("--perspective", "--eye", "60,-60,30"), ("--without", "ghosts,ends")):
        assert run("mine.toml", *options) == 0
        pictures.append(capsys.readouterr().out)
    assert len(set(pictures)) == 4
    assert run("mine.toml", "--perspective", "--eye", "60,-60,30", "--towards", "5,5,5") == 0
    assert capsys.readouterr().out not in pictures


def test_the_tables_show_relations_and_passages(folder: Path, capsys) -> None:
    (folder / "two.toml").write_text(
        HEAD
        + "'cuboid'\nsize = [2, 2, 2]\n"
        + HEAD
        + "'cuboid'\nsize = [2, 2, 2]\nat = [1, 3, 0]\n[view]\neye = [2, -3, 1]\n"
    )
    assert run("two.toml", "--tables") == 0
    tables = capsys.readouterr().out
    assert "V = 1, V' = 2: V = 1 is nearer, by (4)" in tables
    assert tables.count("-4") == 2
    assert "2: 1-2 (contour), order 1\n  behind 1: -1 at 1/6\n" in tables
    assert "<svg" not in tables


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("none.toml",), "none.toml: no such file or directory"),
        ((".",), "is a directory"),
        (("cube.off", "-o", "no/a.svg"), "no/a.svg: no such file or directory"),
        (("cube.off", "--eye", "0,0,0"), "expected a direction of view other than 0,0,0"),
        (("cube.off", "--eye", "1,2"), "the direction of view: expected 3 numbers X,Y,Z, found 2"),
        (("cube.off", "--perspective"), "--perspective needs the eye point: add --eye X,Y,Z"),
        (("cube.off", "--perspective", "--eye", "0.5,0.5,0.5"), "point other than the point looked at"),
        (("cube.off", "--perspective", "--eye", "0.5,0.5,0.6"), "not entirely in front of the observation point"),
        (("cube.off", "--towards", "1,2,3"), "--towards needs --perspective"),
        (("cube.off", "--without", "all"), "'all' is not one of the names enclosed, touching, ends, ghosts"),
        (("cube.off", "--width", "5"), "a picture cannot be 5 pixels wide"),
        (("flat.csv",), "flat.csv: a segment is not a polyhedron; expected points not on one line"),
    ],
)
def test_invalid_requests_are_rejected(folder: Path, arguments: tuple[str, ...], message: str, capsys) -> None:
    (folder / "flat.csv").write_text("0,0,0\n1,0,0\n")
    assert run(*arguments) == 2
    output = capsys.readouterr()
    assert message in output.err
    assert output.err.count("\n") == 1
    assert output.out == ""
    assert not list(folder.glob("*.svg"))

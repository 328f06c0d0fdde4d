"""The program as one file, on a bare Python: an empty environment, an empty folder and no installed packages."""

from __future__ import annotations

import json
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from modern.publication import building, pyz
from modern.publication.tei import tei
from tests.support.commands import call
from tests.support.editions import packed


@pytest.fixture(scope="module")
def program(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("pyz")
    path = folder / pyz.NAME
    path.write_bytes(pyz.pyz(packed(folder)))
    return path


@pytest.fixture
def empty(tmp_path: Path, monkeypatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def run(program: Path, *words: str) -> tuple[int, str, str]:
    """Run the file as ``env -i python3 -I -S hull1620.pyz``, so that Python finds nothing but its own library."""
    command = ["env", "-i", sys.executable, "-I", "-S", str(program), *words]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, done.stderr


def test_the_one_file_reproduces_chapter_6_and_reads_an_operator_file(program: Path, empty: Path) -> None:
    code, out, err = run(program, "reproduce", "1", "2", "3", "4", "5", "6")
    text = " ".join(out.split())
    assert (code, err) == (0, "")
    assert "312 of 312 cards" in text
    assert text.endswith("Every printed result is reproduced.")
    assert list(empty.iterdir()) == []
    Path("a.f").write_text(
        "      ACCEPT 1,I\n      PUNCH 1,I\n      STOP\n    1 FORMAT (I5)\n      END\n", encoding="utf-8"
    )
    Path("answers").write_text("ENTER    77\n", encoding="utf-8")
    assert run(program, "run", "a.f", "--operator=answers")[:2] == (0, "   77\n")


@pytest.mark.parametrize(
    "words",
    [
        "hull example5 --arithmetic mp:100 --uncut",
        "diverge program1 example2",
        "tei --read chapter4.xml",
        "flowchart program1 --table",
    ],
)
def test_the_one_file_prints_what_the_installed_program_prints(words, program, empty, capsys, monkeypatch) -> None:
    monkeypatch.setenv("COLUMNS", "100")  # the width without a terminal, whatever an earlier test has set
    Path("chapter4.xml").write_text(tei("chapter4", "0.1.0"), encoding="utf-8")
    assert run(program, *words.split()) == call(capsys, *words.split())


def test_reproduce_without_numpy_names_what_it_leaves_out(program: Path, empty: Path) -> None:
    code, out, err = run(program, "reproduce", "--json", "all.json")
    assert (code, err) == (0, "")
    lines = " ".join(out.split())
    left_out = "Left out, because numpy is not installed: theorems, appel-will, kovalevsky-schulz, statements."
    assert f"{left_out} Every other printed result is reproduced" in lines
    document = json.loads(Path("all.json").read_text(encoding="utf-8"))
    assert document["left_out"] == ["theorems", "appel-will", "kovalevsky-schulz", "statements"]
    assert (document["reproduced"], document["statements"]) == (True, [])
    assert {finding["paper"] for finding in document["papers"]} == {"nakamae-nishita"}


@pytest.mark.parametrize("words", ["diff example1", "reproduce yau-srihari.1"])
def test_a_command_that_needs_numpy_says_so_in_one_line(words: str, program: Path, empty: Path) -> None:
    message = f"hull1620 {words.split()[0]}: this needs numpy, which is not installed (pip install numpy)\n"
    assert run(program, *words.split()) == (2, "", message)
    assert list(empty.iterdir()) == []


def test_the_one_file_is_small_and_holds_the_licences_of_its_packages(program: Path) -> None:
    assert program.stat().st_size < 4e6
    names = zipfile.ZipFile(program).namelist()
    for package in ("lark", "mpmath"):
        assert any(re.match(rf"{package}-.*licen[cs]e", name, re.IGNORECASE) for name in names)
    assert program.read_bytes().startswith(b"#!/usr/bin/env python3\n")


def test_an_older_python_is_named_in_one_line(program: Path, monkeypatch) -> None:
    source = zipfile.ZipFile(program).read("__main__.py").decode()
    monkeypatch.setattr(sys, "version_info", (3, 10, 13))
    with pytest.raises(SystemExit, match=r"expected Python 3\.11 or later, found 3"):
        exec(source, {"__name__": "__main__"})


def test_the_build_needs_a_wheel(tmp_path: Path, monkeypatch, capsys) -> None:
    monkeypatch.setattr(building, "DIST", tmp_path)
    assert pyz.main([str(tmp_path)]) == 2
    assert "no wheel; make wheel builds it" in capsys.readouterr().err
    (tmp_path / "hull1620-0.1.0-py3-none-any.whl").write_bytes(packed(tmp_path).read_bytes())
    assert pyz.main([str(tmp_path)]) == 0
    assert run(tmp_path / pyz.NAME, "--version")[0] == 0

"""``hull1620 diverge``, and ``run`` and ``hull`` with other arithmetics."""

import json
import os
from pathlib import Path

import pytest

from modern.cli.main import main
from tests.support.commands import call

SIDE = ((-6, -9), (-1, -2), (-6, 8), (-6, -6.875))
"""Three vertices and a point between the first and the third (docs/reference/machine.md)."""


def card(x: float, y: float, z: float) -> str:
    return f"{x:14.5f}{y:14.5f}{z:14.5f}\n"


@pytest.fixture
def room(tmp_path: Path, monkeypatch) -> Path:
    """Change to a folder that holds only data decks for program 1 and for program 2."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "100")
    Path("side.deck").write_text(" 4\n" + "".join(card(x, y, 1) for x, y in SIDE), encoding="utf-8")
    points = [(0.12345, 0.2, 0.3), (1.1, 0.21234, 0.3), (0.1, 1.27654, 0.31), (0.1, 0.26543, 1.39876)]
    Path("four.deck").write_text(" 4\n" + "".join(card(*p) for p in points), encoding="utf-8")
    assert main(["run", "program1", "side.deck", "--punch", "side.cards", "--typewriter", "typed"]) == 0
    Path("sum.f").write_text("      A=1.\n      B=A+A\n      END\n", encoding="utf-8")
    Path("sine.f").write_text("      A=1.\n    7 B=SIN(A)\n      END\n", encoding="utf-8")
    Path("any.deck").write_text(" 1\n", encoding="utf-8")
    return tmp_path


def test_a_square_of_nine_digits_changes_a_decision(room: Path, capsys) -> None:
    """14.875 squared has nine digits. Truncated to eight, its root is too small, and a wrong vertex is chosen."""
    code, out, err = call(capsys, "diverge", "program2", "side.cards")
    assert (code, err) == (1, "")
    lines = out.splitlines()
    assert lines[0] == "program2.f, side.cards: truncating against exact"
    assert "first decision that differs: card 174, 157 IF (AL+CL-BL) 1157, 2157, 1157" in lines
    assert "  exact: 0, goes to statement 2157 (card 177)" in lines
    assert "digits lost, of 8.0, up to that decision" in lines


def test_other_arithmetics_and_layers_decide_correctly(room: Path, capsys) -> None:
    code, out, _ = call(capsys, "diverge", "program2", "side.cards", "--arithmetic", "float64")
    assert code == 0
    assert "none differs" in out
    assert "digits lost, of 16.0\n" in out
    # The corrected cards do not use the roots.
    code, out, _ = call(capsys, "diverge", "program2", "side.cards", "--layers", "corrected")
    assert code == 0
    assert "none differs" in out
    code, out, _ = call(capsys, "diverge", "sum.f", "any.deck")
    assert code == 0
    assert "values: 2 compared, none differs" in out
    code, out, _ = call(capsys, "diverge", "program2", "side.cards", "--arithmetic", "exact")
    assert code == 0
    assert "digits lost" not in out


def test_decisions_are_limited_by_options(room: Path, capsys) -> None:
    code, out, _ = call(capsys, "diverge", "program2", "side.cards", "--first")
    assert code == 1
    assert "compared, 1 differs" in out
    assert "values:" not in out
    assert "digits lost" not in out
    code, out, _ = call(capsys, "diverge", "program2", "side.cards", "--limit", "10")
    assert code == 1
    assert "decisions: 1 compared, none differs" in out
    assert "comparison ended: both runs were stopped after 10 statements" in out


def test_the_comparison_is_written_as_json(room: Path, capsys) -> None:
    assert call(capsys, "diverge", "program2", "side.cards", "--json", "d.json")[0] == 1
    found = json.loads(Path("d.json").read_text(encoding="utf-8"))
    first = found["decisions"]["first"]
    assert (first["card"], first["statement"], first["values"][1]) == (174, 157, "0")
    assert [target["statement"] for target in first["targets"]] == [1157, 2157]
    assert found["values"]["differing_in_step"] <= found["values"]["differing"] <= found["values"]["compared"]
    assert sum(loss["differing"] for loss in found["losses"]) == found["values"]["differing_in_step"]
    assert [ending["kind"] for ending in found["endings"]] == ["hopper", "hopper"]


def test_the_comparison_fits_a_narrow_terminal(room: Path, capsys, monkeypatch) -> None:
    monkeypatch.setenv("COLUMNS", "40")
    _, out, _ = call(capsys, "diverge", "program2", "side.cards")
    assert all(len(line) <= 40 for line in out.splitlines())
    assert "card 174," in out


def test_values_that_exact_numbers_cannot_hold_are_reported(room: Path, capsys) -> None:
    words = "sine.f: card 2: exact arithmetic cannot hold SIN of 1, in 7 B=SIN(A)"
    code, out, err = call(capsys, "diverge", "sine.f", "any.deck")
    assert code == 1
    assert f"comparison ended: exact ended: {words}" in " ".join(out.split())
    assert err == ""
    code, out, err = call(capsys, "run", "sine.f", "any.deck", "--arithmetic", "exact")
    assert (code, out, err) == (1, "", f"hull1620: {words}\n")


MISUSE = [
    (["diverge", "program1"], "the program reads cards: a data deck is required"),
    (["diverge", "nosuch.f", "side.deck"], "nosuch.f: no such file"),
    (["diverge", "program1", "nosuch"], "nosuch: no such file"),
    (["diverge", ".", "side.deck"], ".: is a directory"),
    (["diverge", "program1", "."], ".: is a directory"),
    (["diverge", "-", "-"], "cannot both come from standard input"),
    (["diverge", "program1", "side.deck", "--against", "decimal"], "--against: no arithmetic is called 'decimal'"),
    (
        ["diverge", "program1", "side.deck", "--against", "mp:1"],
        "--against: mp:1: the number of bits must be 2 to 100000",
    ),
    (["diverge", "program1", "side.deck", "--arithmetic", "float"], "--arithmetic: no arithmetic is called 'float'"),
    (["diverge", "program1", "side.deck", "--limit", "0"], "--limit: expected at least 1 statement, found 0"),
    (["diverge", "program1", "side.deck", "--json", "no/file"], "no/file: no such file or directory"),
    (["diverge", "program1", "side.deck", "--layers", "nosuch"], "has no layer 'nosuch'"),
    (["diverge", "program1", "side.deck", "--core", "20000"], "OVERLAP"),
    (["diverge", "sum.f", "side.deck", "--layers", "corrected"], "--layers is for the built-in programs"),
    (["diverge", "program3", "side.deck"], "side.deck: card"),
    (["run", "sum.f", "any.deck", "--arithmetic", "mp:0"], "--arithmetic: mp:0: the number of bits"),
    (["hull", "side.deck", "--arithmetic", "Exact"], "--arithmetic: no arithmetic is called 'Exact'"),
]


@pytest.mark.parametrize(("arguments", "words"), MISUSE, ids=[" ".join(m[0]) for m in MISUSE])
def test_misuse(room: Path, capsys, arguments: list[str], words: str) -> None:
    before = sorted(os.listdir())
    code, out, err = call(capsys, *arguments)
    assert (code, out) == (2, "")
    assert err.count("\n") == 1
    assert words in err
    assert sorted(os.listdir()) == before


@pytest.mark.parametrize("name", ["float64", "float32", "mp:90", "exact"])
def test_run_and_hull_accept_other_arithmetics(room: Path, capsys, name: str) -> None:
    code, out, err = call(capsys, "hull", "side.deck", "--arithmetic", name, "--trace", "t", "--profile")
    assert code == 0
    assert "CONVEX HULL HAS BEEN DETERMINED" in out
    vertices = out.partition("VERTICES")[2].partition("EQUATIONS")[0]
    assert "-.60000000E+01  -.90000000E+01" in vertices
    assert "-.68750000E+01" not in vertices
    assert "time on a 1620" in err
    assert "X(1) = -6" in Path("t").read_text(encoding="utf-8")


def test_uncut_numbers_accompany_the_cards_between_the_programs(room: Path, capsys) -> None:
    """Planes of more than eight digits are rejected if the cards truncate them, and accepted otherwise."""
    code, _, err = call(capsys, "hull", "four.deck", "--arithmetic", "exact")
    assert code == 1
    assert "ERROR IN PROGRAM" in err
    code, out, err = call(capsys, "hull", "four.deck", "--arithmetic", "exact", "--uncut")
    assert code == 0
    assert "CONVEX HULL HAS BEEN DETERMINED" in out
    assert err == "POINTS ARE NOT COPLANAR\n"


def test_all_digits_of_a_field_are_read(room: Path, capsys) -> None:
    Path("long.deck").write_text(" 1\n" + ".1234567890123" + card(0, 1, 2)[14:], encoding="utf-8")
    assert "after the first 8 are dropped" in call(capsys, "hull", "long.deck")[2]
    code, _, err = call(capsys, "hull", "long.deck", "--arithmetic", "float64")
    assert (code, err) == (0, "CONVEX HULL\n")

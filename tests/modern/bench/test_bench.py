"""The bench: agreement of cards, and the table, with a compiler if one is installed."""

import json
import os
import shutil
import sys
from pathlib import Path

import pytest

from emulator.compiled import runner
from modern.bench import native
from modern.bench.agreement import compare, plain
from modern.bench.measure import (
    COLD,
    COMPILED,
    LAYERS,
    NATIVE,
    PLAIN,
    PORT,
    PROGRAM,
    WARM,
    Bench,
    Row,
    document,
    lines,
    measure,
)
from modern.bench.timing import Figure, side_by_side
from modern.cli.main import main
from modern.edition import programs

GFORTRAN = shutil.which("gfortran")
needs_compiler = pytest.mark.skipif(GFORTRAN is None, reason="no gfortran")


def test_missing_compilers_are_reported(monkeypatch) -> None:
    monkeypatch.setenv("PATH", os.devnull)
    monkeypatch.delenv("FC", raising=False)
    with pytest.raises(native.NoCompiler, match="expected a Fortran compiler"):
        native.compiler()
    monkeypatch.setenv("FC", "nothere -O")
    with pytest.raises(native.NoCompiler, match="that FC names, nothere, is not installed"):
        native.compiler()


ONE = ["", "CONVEX HULL", "N=   4", "  1    .20000000E+01  -.30000000E+00"]


def test_cards_agree_if_only_zeros_are_printed_differently() -> None:
    ours, theirs = [*ONE, "  2   -.00000000E-99"], [*ONE, "  2    .00000000E-99"]
    assert compare([ours], [theirs]).line() == "1 decks the same, 0 with different digits, 0 with another hull"
    assert plain("-.10000000E-99") != plain(" .10000000E-99")


@pytest.mark.parametrize(
    ("card", "kind"),
    [
        ("  1    .20000001E+01  -.30000000E+00", "digits"),
        ("  1    .20000100E+01  -.30000000E+00", "other"),
        ("  1    .20000000E+02  -.30000000E+00", "other"),
        ("  1    .20000000E+01   .30000000E+00", "other"),
        ("  2    .20000000E+01  -.30000000E+00", "other"),
        ("  1    .20000000E+01", "other"),
    ],
)
def test_differences_are_classified(card: str, kind: str) -> None:
    agreement = compare([ONE, ONE], [ONE, [*ONE[:3], card]])
    assert (agreement.same, agreement.digits, agreement.different) == (1, int(kind == "digits"), int(kind == "other"))
    assert agreement.first.startswith("deck 2 has '1 ")


def test_works_are_timed_in_turn(monkeypatch) -> None:
    monkeypatch.setattr("modern.bench.timing.RUNS", 2)
    order: list[str] = []
    figures = side_by_side({name: lambda name=name: order.append(name) for name in "ab"})
    assert order == ["a", "b"] * 3
    assert [(figure.what, len(figure.seconds)) for figure in figures] == [("a", 2), ("b", 2)]


def row_of(what: str, seconds: float, count: int) -> Row:
    return Row(Figure(what, (seconds,) * 5), count)


def test_table_has_times_and_ratios() -> None:
    rows = (row_of(COMPILED, 2.0, 1000), row_of(NATIVE, 0.25, 1000), row_of(PLAIN, 2.0, 20))
    bench = Bench(rows, (Figure(COLD, (9.0,)), Figure(WARM, (0.5,))), None, "GNU Fortran 12", ("a remark",))
    table = lines(bench)
    assert table[1].split() == ["compiled", "engine", "1000", "2.000", "500", "1.00", "8.00"]
    assert table[3].split() == ["plain", "engine", "20", "100.000", "10", "50.00", "400.00"]
    assert table[-1] == "a remark"
    assert max(map(len, table[:4])) <= 78
    assert json.loads(json.dumps(document(bench)))["engines"][1]["seconds_a_deck"] == 0.00025


def test_command_measures_without_compiler_and_numba(tmp_path: Path, capsys, monkeypatch) -> None:
    """The remaining engines are measured, and one line each reports what is missing."""
    monkeypatch.setenv("PATH", os.devnull)
    monkeypatch.delenv("FC", raising=False)
    monkeypatch.setitem(sys.modules, "numba", None)
    monkeypatch.setattr(runner, "run_decks", runner.run_decks.__wrapped__)
    monkeypatch.setattr("modern.bench.timing.RUNS", 1)
    place = tmp_path / "bench.json"
    assert main(["bench", "--decks", "1", "--json", str(place)]) == 0
    out, err = capsys.readouterr()
    assert "expected a Fortran compiler" in out
    assert "needs numba: pip install 'hull1620[fast]'" in out
    assert err.startswith("generating 1 decks")
    found = json.loads(place.read_text())
    assert [engine["what"] for engine in found["engines"]] == [PLAIN, PORT]
    assert found["compiler"] is None
    assert found["agreement"] is None


@pytest.mark.parametrize(
    ("command", "message"),
    [
        ('gfortran "', "expected a command in the environment variable FC"),
        ("true", "true is not a Fortran compiler: it produced no program"),
        ("false", "^false.* cannot compile the translated program: no reason given"),
    ],
)
def test_commands_that_are_not_compilers_are_reported(command: str, message: str, tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setenv("FC", command)
    with pytest.raises(native.NoCompiler, match=message) as caught:
        native.built(programs.deck(PROGRAM, LAYERS), native.compiler(), tmp_path)
    assert "\n" not in str(caught.value)


@needs_compiler
def test_all_engines_are_measured(tmp_path: Path, monkeypatch) -> None:
    pytest.importorskip("numba")
    monkeypatch.setattr("modern.bench.measure._starts", lambda text, folder, say: ())
    bench = measure(3)
    assert [row.figure.what for row in bench.rows] == [COMPILED, NATIVE, PLAIN, PORT]
    assert bench.agreement is not None
    assert bench.agreement.same == 3
    assert bench.remarks == ()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--decks", "0"], "--decks: expected at least 1 deck, found 0"),
        (["--json", "/nothere/x.json"], "no such file or directory"),
        (["--json", "."], "is a directory"),
    ],
)
def test_invalid_arguments_are_reported_in_one_line(arguments: list[str], message: str, capsys) -> None:
    assert main(["bench", *arguments]) == 2
    err = capsys.readouterr().err
    assert message in err
    assert err.count("\n") == 1

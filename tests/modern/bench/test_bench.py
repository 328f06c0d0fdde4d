"""The bench: translation to modern Fortran, agreement of cards, and the table, with a compiler if one is installed."""

import json
import os
import shutil
import sys
from pathlib import Path

import pytest

from emulator.compiled import runner
from emulator.errors import DeckError
from emulator.language.cards import deck_from_lines
from emulator.language.compiler import compile_deck
from emulator.machine.machine import Machine
from modern.bench import native
from modern.bench.agreement import compare, data_sets, plain
from modern.bench.decks import LAYERS, OPTIONS, PROGRAM, middle_texts, random_points
from modern.bench.measure import COLD, COMPILED, NATIVE, PLAIN, PORT, WARM, Bench, Row, document, lines, measure
from modern.bench.timing import Figure, side_by_side
from modern.bench.translate import translated
from modern.cli.main import main
from modern.edition import programs

GFORTRAN = shutil.which("gfortran")
needs_compiler = pytest.mark.skipif(GFORTRAN is None, reason="no gfortran")


def fortran(*cards: str) -> list[str]:
    """Return the statements of a translation without its first and last lines."""
    text = translated(deck_from_lines("deck.f", cards))
    statements = text.splitlines()
    return [
        line for line in statements if not line.startswith(("program", "implicit", "logical", "open", "90000", "end"))
    ]


def test_statements_are_printed_in_free_form() -> None:
    assert fortran("DIMENSION X(3),L(2,2)", "  10 X (I) = -1.5E-3*SQRTF(A)/(-2.)", "GO TO(10,10),M", "END") == [
        "dimension X(3),L(2,2)",
        "10 X(I) = -(1.5d-3*SQRT(A)/(-2.d0))",
        "go to (10,10), M",
    ]


def test_a_do_becomes_explicit_jumps() -> None:
    """A loop runs at least once and reads its limit at each pass. Two loops that end together end inner first."""
    assert fortran("DO 5 I=1,N", "DO 5 J=I,9,2", "5 K=K+1", "END") == [
        "I = 1",
        "90002 continue",
        "J = I",
        "90003 continue",
        "5 K = K+1",
        "J = J + 2",
        "if (J <= 9) go to 90003",
        "I = I + 1",
        "if (I <= N) go to 90002",
    ]


def test_input_and_output_statements_are_translated() -> None:
    formats = "1 FORMAT(2HAB,F5.1)", "2 FORMAT(2X,3HA'B/)"
    assert fortran("READ 1,A,(X(I),I=1,N)", "PUNCH 2", "TYPE 1,A", *formats, "END") == [
        "read (*,1,end=90000) A,(X(I),I=1,max(1,N))",
        "write (*,2)",
        "write (8,1) A",
        "1 format (2x,F5.1)",
        "2 format (2x,'A''B',/)",
    ]


def test_switches_and_stops_are_translated() -> None:
    assert fortran("5 IF (SENSE SWITCH 2) 5,6", "6 PAUSE", "IF(A-B)5,6,6", "STOP", "END") == [
        "5 go to (5,6), merge(1, 2, switch_2)",
        "6 continue",
        "if (A-B) 5,6,6",
        "go to 90000",
    ]
    text = translated(deck_from_lines("deck.f", ["STOP", "END"]), {3})
    assert "switch_3 = .true." in text
    assert "switch_2 = .false." in text


def test_accept_and_invalid_decks_are_refused() -> None:
    with pytest.raises(DeckError, match=r"deck\.f: card 1: ACCEPT has no counterpart"):
        fortran("ACCEPT 1,A", "1 FORMAT(F5.1)", "END")
    with pytest.raises(DeckError, match=r"deck\.f: card 1"):
        fortran("A=+*B", "END")


LOOPS = ["K=0", "DO 5 I=8,5", "5 K=K+1", "DO 6 I=1,10,4", "6 K=K+1", "PUNCH 9,K,I", "9 FORMAT(2I4)", "END"]
COPY = ["1 READ 9,A,I", "B=A**2/4.-SQRT(A)", "PUNCH 9,B,I", "GO TO 1", "9 FORMAT(E14.8,I4)", "END"]
TEXTS = ["READ 8,A", "PUNCH 7", "IF(SENSE SWITCH 1)4,5", "4 STOP", "5 PUNCH 6,A,A", "6 FORMAT(2HA=,F7.2/)"]
TEXTS += ["7 FORMAT(/5HNO. 1/)", "8 FORMAT(3HABC,F4.1)", "END"]


@needs_compiler
@pytest.mark.parametrize(
    ("cards", "data"), [(LOOPS, []), (COPY, ["4.               3", "9.              12"]), (TEXTS, ["XYZ12.5"])]
)
def test_native_programs_punch_the_emulated_cards(cards: list[str], data: list[str], tmp_path: Path) -> None:
    deck = deck_from_lines("deck.f", cards)
    cards_file, punched_file = tmp_path / "cards", tmp_path / "punched"
    cards_file.write_text("".join(f"{card:80}\n" for card in data))
    native.run(native.built(deck, native.compiler(), tmp_path), cards_file, punched_file)
    expected = Machine(compile_deck(deck), deck_from_lines("data", data)).run().punched
    assert [plain(line) for line in punched_file.read_text().splitlines()] == [plain(card) for card in expected]


@needs_compiler
def test_native_program_3_agrees_with_the_emulated_one(tmp_path: Path) -> None:
    """Thirty sets in one process give the same cards, except for the printing of zeros."""
    texts = middle_texts([random_points(4 + n, n) for n in range(30)])
    cards_file, punched_file = tmp_path / "cards", tmp_path / "punched"
    cards_file.write_text("".join(texts))
    native.run(native.built(programs.deck(PROGRAM, LAYERS), native.compiler(), tmp_path), cards_file, punched_file)
    program = programs.program(PROGRAM, LAYERS)
    ours = [Machine(program, deck_from_lines("d", text.splitlines()), OPTIONS).run().punched for text in texts]
    agreement = compare(ours, data_sets(punched_file.read_text().splitlines()))
    assert (agreement.same, agreement.digits, agreement.different) == (30, 0, 0)


def test_missing_compilers_are_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", os.devnull)
    monkeypatch.delenv("FC", raising=False)
    with pytest.raises(native.NoCompiler, match="no Fortran compiler is installed"):
        native.compiler()
    monkeypatch.setenv("FC", "nothere -O")
    with pytest.raises(native.NoCompiler, match="that FC names, nothere, is not installed"):
        native.compiler()


ONE = ["", "CONVEX HULL", "N=   4", "  1    .20000000E+01  -.30000000E+00"]


def test_cards_agree_if_only_zeros_are_printed_differently() -> None:
    theirs = ["", "CONVEX HULL", "N=   4", "  1   0.20000000E+01  -.30000000E+00"]
    assert compare([ONE], [theirs]).line() == "1 decks the same, 0 with different digits, 0 with another hull"
    for ours, native_card in ((" .00000000E-99", "0.00000000E+00"), ("-.00000000E-99", "0.00000000E+00")):
        assert plain(ours) == plain(native_card)
    assert plain("-.10000000E-99") != plain("0.10000000E-99")


@pytest.mark.parametrize(
    ("card", "kind"),
    [
        ("  1   0.20000001E+01  -.30000000E+00", "digits"),
        ("  1   0.20000100E+01  -.30000000E+00", "other"),
        ("  1   0.20000000E+02  -.30000000E+00", "other"),
        ("  1   0.20000000E+01  0.30000000E+00", "other"),
        ("  2   0.20000000E+01  -.30000000E+00", "other"),
        ("  1   0.20000000E+01", "other"),
    ],
)
def test_differences_are_classified(card: str, kind: str) -> None:
    agreement = compare([ONE, ONE], [ONE, [*ONE[:3], card]])
    assert (agreement.same, agreement.digits, agreement.different) == (1, int(kind == "digits"), int(kind == "other"))
    assert agreement.first.startswith("deck 2 has '1 ")


def test_works_are_timed_in_turn(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("modern.bench.timing.RUNS", 2)
    order: list[str] = []
    figures = side_by_side({name: lambda name=name: order.append(name) for name in "ab"})  # type: ignore[misc]
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


def test_command_measures_without_compiler_and_numba(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The remaining engines are measured, and one line each reports what is missing."""
    monkeypatch.setenv("PATH", os.devnull)
    monkeypatch.delenv("FC", raising=False)
    monkeypatch.setitem(sys.modules, "numba", None)
    monkeypatch.setattr(runner, "run_decks", runner.run_decks.__wrapped__)
    monkeypatch.setattr("modern.bench.timing.RUNS", 1)
    place = tmp_path / "bench.json"
    assert main(["bench", "--decks", "1", "--json", str(place)]) == 0
    out, err = capsys.readouterr()
    assert "no Fortran compiler is installed" in out
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
def test_commands_that_are_not_compilers_are_reported(
    command: str, message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("FC", command)
    with pytest.raises(native.NoCompiler, match=message) as caught:
        native.built(programs.deck(PROGRAM, LAYERS), native.compiler(), tmp_path)
    assert "\n" not in str(caught.value)


@needs_compiler
def test_all_engines_are_measured(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
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
def test_invalid_arguments_are_reported_in_one_line(
    arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["bench", *arguments]) == 2
    err = capsys.readouterr().err
    assert message in err
    assert err.count("\n") == 1

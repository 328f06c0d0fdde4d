"""``hull1620 digits``, ``listing --digits`` and ``run --trace`` with stochastic arithmetic."""

import csv
from pathlib import Path

import numpy as np
import pytest

from modern.cli.main import main

SOURCE = """C     ROOTS OF A QUADRATIC EQUATION
    5 READ 1,A,B,C
    1 FORMAT(3F10.0)
      D=B*B-4.*A*C
      IF(D)10,20,20
   10 TYPE 11
   11 FORMAT(8HNO ROOTS)
      GO TO 5
   20 R=SQRT(D)
      X=(-B-R)/(2.*A)
      Y=(-B+R)/(2.*A)
      TYPE 21,X,Y
   21 FORMAT(6HROOTS ,E14.8,1X,E14.8)
      GO TO 5
      END
"""
CARDS = "       1.0     -99.9      0.01\n"


@pytest.fixture
def program(tmp_path: Path, monkeypatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("my.f").write_text(SOURCE, encoding="utf-8")
    Path("my.deck").write_text(CARDS, encoding="utf-8")
    return tmp_path


def test_report_says_which_digits_to_believe_and_which_statement_loses_them(program: Path, capsys) -> None:
    assert main(["digits", "my.f", "my.deck", "--csv", "out.csv", "--html", "out.html", "--samples", "out.npy"]) == 0
    report = capsys.readouterr().out
    rows = {tuple(line.split()[:2]): line for line in report.splitlines() if line.strip()}
    assert rows["1", ".10050000E-03"].endswith("believe 2 digits")
    assert rows["1", ".99899895E+02"].endswith("believe 7 digits")
    assert rows["10", "X=(-B-R)/(2.*A)"].split()[3:6] == ["5.6", "5.6", "2.6"]
    words = " ".join(report.split())
    assert "random rounding: 1 decision on floating-point numbers; the runs disagree on 0 (disputed)" in words
    assert "intervals of 8 digits: every decision is certain" in words
    table = list(csv.DictReader(Path("out.csv").read_text(encoding="utf-8").splitlines()))
    assert {row["part"] for row in table} == {"Printed numbers", "Statements", "Input cards"}
    page = Path("out.html").read_text(encoding="utf-8")
    assert all(f"<h2>{part}</h2>" in page for part in ("Printed numbers", "Decisions", "Statements", "Input cards"))
    assert "<td class=number>" in page
    assert np.load("out.npy").shape == (10, 2)


def test_unknown_and_disputed_decisions_are_reported(program: Path, capsys) -> None:
    lines = [
        "A=1./3.",
        "B=A*3.-1.",
        "IF(B)10,20,20",
        "   10 TYPE 11",
        "   11 FORMAT(5HBELOW)",
        "STOP",
        "   20 STOP",
        "END",
    ]
    text = "".join((line if line.startswith("   ") else "      " + line) + "\n" for line in lines)
    Path("third.f").write_text(text, encoding="utf-8")
    assert main(["digits", "third.f", "--runs", "20", "--independent"]) == 1
    report = " ".join(capsys.readouterr().out.split())
    decision = "card 3, IF(B)10,20,20, execution 1: -1E-7 instead of 0"
    assert f"first decision that exact takes differently: {decision}" in report
    assert "random rounding: 1 decision on floating-point numbers; the runs disagree on 1 (disputed)" in report
    assert "intervals of 8 digits: third.f: card 3: the sign of [-1E-8, 1E-7] is unknown" in report


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--runs", "1"], "--runs: expected 2 to 1000 runs, found 1"),
        (["--seed", "-1"], "--seed: expected 0 to 4294967286 for 10 runs, found -1"),
        (["--seed", "4294967287"], "--seed: expected 0 to 4294967286 for 10 runs, found 4294967287"),
        (
            ["--arithmetic", "stochastic:8:1-3", "--runs", "5"],
            "stochastic:8:1-3 already states the number of runs and their seeds",
        ),
        (["--csv", "-", "--html", "-"], "only one of --csv, --html and --samples can be standard output"),
        (["--arithmetic", "none"], "no arithmetic is called 'none'"),
    ],
)
def test_wrong_options_are_explained_in_one_line(program: Path, capsys, arguments: list[str], message: str) -> None:
    assert main(["digits", "my.f", "my.deck", *arguments]) == 2
    assert message in capsys.readouterr().err


def deck_of(name: str, *lines: str) -> str:
    text = "".join((line if line[:5].strip().isdigit() else "      " + line) + "\n" for line in (*lines, "END"))
    Path(name).write_text(text, encoding="utf-8")
    return name


def test_listed_digits_follow_the_runs_of_the_arithmetic(program: Path, capsys) -> None:
    # The runs store .96666666 and .96666667; the estimate is limited to eight digits.
    name = deck_of("one.f", "A=2.9/3.", "TYPE 1,A", "    1 FORMAT(E14.8)", "STOP")
    main(["digits", name])
    assert "A=2.9/3." in capsys.readouterr().out
    main(["digits", "my.f", "my.deck", "--arithmetic", "stochastic:8:1-3"])
    heading = "3 runs with random rounding (stochastic:8:1-3)"
    assert heading in " ".join(capsys.readouterr().out.split())
    assert main(["listing", "my.f", "my.deck", "--digits"]) == 0
    listing = capsys.readouterr().out
    assert next(line for line in listing.splitlines() if "X=(-B-R)" in line).split()[3:5] == ["5.6", "2.6"]
    assert main(["run", "my.f", "my.deck", "--arithmetic", "stochastic:8:1-10", "--trace", "out.txt"]) == 0
    assert "X = 0.0001 (2.6 digits)" in Path("out.txt").read_text(encoding="utf-8")


@pytest.mark.parametrize("arithmetic", ["truncating", "exact", "float64", "interval:8"])
def test_no_estimate_exceeds_the_printed_digits(program: Path, capsys, arithmetic: str) -> None:
    name = deck_of("short.f", "A=1./3.", "TYPE 1,A", "    1 FORMAT(F8.5)", "STOP")
    main(["digits", name, "--arithmetic", arithmetic])
    (row,) = (line.split() for line in capsys.readouterr().out.splitlines() if " .33333 " in line)
    assert row[2:5] == ["5.0", "5.0", "5.0"]
    assert row[5:] == ["believe", "5", "digits"]


def test_narrow_report_wraps_statements_and_verdicts(program: Path, capsys, monkeypatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    main(["digits", "my.f", "my.deck"])
    report = capsys.readouterr().out
    assert max(map(len, report.splitlines())) <= 80
    (head,) = (line for line in report.splitlines() if "estimated  median" in line)
    assert head.split() == "card statement count lost median estimated median at @.0".split()
    assert "    10  X=(-B-R)/(2.*A)" in report


@pytest.mark.parametrize(
    ("option", "start"), [("--html", b"<!DOCTYPE html>"), ("--csv", b"part,row,"), ("--samples", b"\x93NUMPY")]
)
def test_data_go_to_standard_output_without_the_report(program: Path, capsysbinary, option: str, start: bytes) -> None:
    main(["digits", "my.f", "my.deck", option, "-"])
    output = capsysbinary.readouterr()
    assert output.out.startswith(start)
    assert b"Printed numbers\n" in output.err


@pytest.mark.parametrize("verb", ["READ", "ACCEPT"])
def test_listing_with_digits_requires_a_deck_for_a_program_with_input(program: Path, capsys, verb: str) -> None:
    Path("input.f").write_text(f"      {verb} 1,A\n    1 FORMAT(F10.4)\n      END\n", encoding="utf-8")
    assert main(["listing", "input.f", "--digits"]) == 2
    assert "the program has READ or ACCEPT statements; name a data deck" in capsys.readouterr().err

"""User-defined programs: lower case, and explanations of error numbers."""

import re
from pathlib import Path

import pytest

from emulator.errors import explanations
from emulator.language.cards import Deck, deck_from_lines
from emulator.language.compiler import translate
from emulator.machine.machine import Machine
from emulator.machine.result import Options
from emulator.numbers import numbers
from modern.cli.arguments import COMMANDS
from tests.support.commands import call
from tests.support.paths import DATA, ROOT

PERIOD = DATA / "period"
SOURCE = "      READ 6,I\n      J=I*I\n      PUNCH 6,J\n      STOP\n    6 FORMAT(I3)\n      END\n"


@pytest.fixture(autouse=True)
def room(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("large.f").write_text(SOURCE, encoding="utf-8")
    Path("small.f").write_text("C  Squares\n" + SOURCE.lower(), encoding="utf-8")
    Path("one.deck").write_text(" 12\n", encoding="utf-8")


CALLS = {
    "check": (),
    "compile": (),
    "export-job": ("one.deck", "--for", "pdq", "--out", "job"),
    "flowchart": (),
    "listing": ("one.deck",),
    "map": (),
    "run": ("one.deck",),
    "translate": ("--to", "c"),
    "diverge": ("one.deck",),
    "digits": ("one.deck",),
}
"""Every command that reads a user-defined program, and its other arguments."""


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_that_accepts_a_program_is_listed(command: str, capsys) -> None:
    assert ("PROGRAM.f" in call(capsys, command, "--help")[1].split("options:")[0]) == (command in CALLS)


@pytest.mark.parametrize("command", CALLS)
def test_lower_case_is_reported_once_with_the_option_that_reads_it(command: str, capsys) -> None:
    code, out, err = call(capsys, command, "small.f", *CALLS[command])
    assert (code, out) == (2, "")
    assert err == (
        "hull1620: small.f: card 2, column 7: 'r' is not in the card code, which has only capital letters; "
        "--upcase reads small letters of the program as capitals\n"
    )


@pytest.mark.parametrize("command", CALLS)
def test_upcase_converts_a_program_to_capitals(command: str, capsys) -> None:
    """The output is the same, except that the comment may be in lower case."""
    Path("large.f").write_text("C  Squares\n" + SOURCE, encoding="utf-8")
    expected = call(capsys, command, "large.f", *CALLS[command])
    assert expected[0] == 0
    code, out, err = call(capsys, command, "small.f", *CALLS[command], "--upcase")
    assert (code, out.replace("small.f", "large.f"), err) == expected


def test_period_programs_run_in_lower_case_and_with_an_operator_file(capsys) -> None:
    code, out, err = call(capsys, "run", str(PERIOD / "pi.f"), str(PERIOD / "pi.deck"), "--upcase")
    assert (code, err.count("\n")) == (0, 1)
    assert "the run ended after reading 2 cards, because the hopper was empty" in err
    assert [line[-9:] for line in out.splitlines()] == ["3.1405970", "3.1415928"]
    operator = f"--operator={PERIOD / 'job.operator'}"
    code, out, err = call(capsys, "run", str(PERIOD / "job.f"), str(PERIOD / "job.deck"), operator)
    assert (code, len(out.splitlines())) == (0, 2)
    assert err.splitlines()[2:4] == ["ROOT    2.0945515     4 STEPS", "   1   .20588235E+01  -.39080030E+00"]
    assert "PAUSE" not in err


def test_a_deck_of_data_is_never_read_as_capitals(capsys) -> None:
    Path("one.deck").write_text("1.e0\n", encoding="utf-8")
    code, out, err = call(capsys, "run", "small.f", "one.deck", "--upcase")
    assert (code, out) == (2, "")
    assert err == "hull1620: one.deck: card 1, column 3: 'e' is not in the card code, which has only capital letters\n"


@pytest.mark.parametrize("number", explanations())
def test_the_example_of_an_error_gives_that_number(number: str) -> None:
    """Compile the example, or run it with the arithmetic that types every code."""
    if not explanations()[number].example:
        assert number in ("F7", "F9")  # They need cards, and occur only under ibm1962.
        return
    deck = deck_from_lines("example.f", explanations()[number].example)
    program, messages = translate(deck)
    if number.isdecimal():
        assert [message.number for message in messages] == [int(number)]
        return
    assert program is not None
    assert messages == ()
    for arithmetic in ("truncating", "ibm1962"):
        result = Machine(program, Deck("no deck", ()), Options(numbers=numbers(arithmetic))).run()
        assert [error.code for error in result.errors] == [number]
    assert result.typed == (f"ERROR {number}",)


def test_every_error_number_is_explained() -> None:
    """The sources of the compiler contain the numbers, those of the arithmetic the codes."""
    language = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "emulator" / "language").glob("*.py"))
    # A Diagnostic begins with a card and a column, which are no error numbers.
    call = r"(?:Refused\(|_refused\(|_error\(|Diagnostic\([^,]+, [^,]+, )"
    given = set(re.findall(call + r"(?:[^()]|\([^()]*\))*?, (\d+)[,)]", language))
    given |= set(re.findall(r'"(?:if_switch|do|dimension|input_output)": (\d+)', language))
    numbers_there = {n for n in explanations() if n.isdecimal()}
    assert given - {"0", "1"} <= numbers_there
    rooms = [path for room in ("numbers", "machine") for path in (ROOT / "emulator" / room).glob("*.py")]
    codes = {code for path in rooms for code in re.findall(r'"([EF]\d)"', path.read_text(encoding="utf-8"))}
    assert codes <= set(explanations())


@pytest.mark.parametrize("number", explanations())
def test_an_error_is_explained_in_eighty_columns(number: str, capsys) -> None:
    code, out, err = call(capsys, "check", "--explain", number.lower())
    assert (code, err) == (0, "")
    found = explanations()[number]
    assert all(card in out for card in found.example)
    assert max(map(len, out.splitlines())) <= 80
    words = " ".join(out.split())
    assert words.startswith(f"error {number}: {found.title} ")
    assert all(" ".join(text.split()) in words for text in (found.meaning, found.remedy, found.source))


def test_all_errors_are_explained_at_once(capsys) -> None:
    code, out, _ = call(capsys, "check", "--explain", "all")
    assert code == 0
    assert re.findall(r"^error (\w+):", out, re.M) == list(explanations())


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--explain", "3"), "--explain: unknown error 3; expected all, or one of 5, 6, 7,"),
        (("--explain", ""), "--explain: unknown error ; expected all, or one of 5, 6, 7,"),
        (("--explain", "5", "large.f"), "--explain: expected only an error number, found also a program"),
        ((), "check: expected a program, or --explain with an error number"),
    ],
)
def test_an_unknown_error_number_is_rejected(arguments: tuple[str, ...], words: str, capsys) -> None:
    code, out, err = call(capsys, "check", *arguments)
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert err.startswith(f"hull1620: {words}")


LARGE = "      DIMENSION X(3900)\n      X(1)=1.\n      STOP\n      END\n"


def test_check_and_map_report_a_program_that_does_not_fit_and_a_sufficient_core(capsys) -> None:
    """The data take 3,900 fields of ten positions. The subroutines take 8,300 of 40,000, the functions' names 120."""
    Path("wide.f").write_text(LARGE, encoding="utf-8")
    code, out, err = call(capsys, "check", "wide.f")
    assert (code, err) == (2, "")
    words = (
        r"OVERLAP: program and data need about 390\d\d positions; a machine of 40000 has 31580 for them; "
        r"--core 60000 is large enough\n"
    )
    assert re.fullmatch(f"wide.f: {words}", out)
    code, out, err = call(capsys, "map", "wide.f")
    assert (code, err) == (0, "")
    assert re.search(f"too many\n  {words}", out)
    assert "free between" not in out
    for command in ("check", "map"):
        code, out, err = call(capsys, command, "wide.f", "--core", "60000")
        assert (code, err) == (0, "")
        assert "OVERLAP" not in out
    # If no machine is large enough, there is no remedy to name.
    Path("wide.f").write_text(LARGE.replace("3900", "5900"), encoding="utf-8")
    assert call(capsys, "check", "wide.f")[1].endswith("has 31580 for them\n")


def test_check_rejects_what_run_rejects(capsys) -> None:
    Path("wide.f").write_text(LARGE, encoding="utf-8")
    _, out, _ = call(capsys, "check", "wide.f")
    code, _, err = call(capsys, "run", "wide.f", "one.deck")
    assert code == 2
    assert err == f"hull1620: {out}"


def test_export_job_writes_a_folder_and_names_the_changes(capsys) -> None:
    job = Path("job")
    code, out, _ = call(
        capsys, "export-job", "program2", "example4/punched", "--for", "pdq", "--out", "job", "--switch", "1"
    )
    assert (code, out) == (
        0,
        "job: 282 cards of the program, 10 of data, 2 changes for the old compiler; "
        "README.txt says how to run the job\n",
    )
    names = ["README.txt", "check.py", "data.cards", "expected.cards", "job.ini", "program.cards"]
    assert sorted(path.name for path in job.iterdir()) == names
    readme = job.joinpath("README.txt").read_text(encoding="ascii")
    assert "- card 226: PDQ's compiler stops" in readme
    assert "IF (E(I))112,191,180" in readme
    script = job.joinpath("job.ini").read_text(encoding="ascii").split("join run.cards")
    assert ["deposit sw1 0" in script[0], "deposit sw1 1" in script[1]] == [True, True]
    assert len(job.joinpath("expected.cards").read_text(encoding="ascii").splitlines()) == 58


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("program1", "example4"), "the following arguments are required: --for, --out"),
        (("program1", "example4", "--for", "pdq", "--out", "taken/job"), "taken/job: not a directory"),
        (("program1", "missing", "--for", "pdq", "--out", "job"), "missing: no such file or directory"),
    ],
)
def test_export_job_rejects_its_arguments_in_one_line(capsys, words: tuple[str, ...], message: str) -> None:
    Path("taken").write_text("", encoding="ascii")
    code, _, err = call(capsys, "export-job", *words)
    assert (code, err.count("\n"), message in err) == (2, 1, True), err
    assert not Path("job").exists()

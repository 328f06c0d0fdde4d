"""Refusals: the reasons and remedies that ``hull`` and ``diff`` report for a run without a hull."""

import random
import re
import shlex
from pathlib import Path

import pytest

from tests.support.commands import call
from tests.support.paths import ROOT

GROUNDS = ROOT / "fortran_src" / "grounds"


@pytest.fixture
def own(tmp_path: Path, monkeypatch, capsys) -> Path:
    """Change to a folder with thirty points of three decimals, as points.csv and points.deck."""
    draw = random.Random(1963)
    rows = (",".join(f"{draw.uniform(-5, 5):.3f}" for _ in range(3)) for _ in range(30))
    (tmp_path / "points.csv").write_text("\n".join(rows) + "\n", encoding="ascii")
    monkeypatch.chdir(tmp_path)
    assert call(capsys, "cards", "points.csv", "-o", "points.deck")[0] == 0
    return tmp_path


def tried(err: str) -> list[list[str]]:
    """Return the proposed commands, each as a list of arguments."""
    lines = [line.removeprefix("  try:").strip() for line in err.splitlines()]
    commands = [part.strip() for line in lines if line.startswith("hull1620 ") for part in line.split("&&")]
    return [shlex.split(command)[1:] for command in commands if not command.startswith("hull1620: ")]


def test_points_with_three_decimals_are_refused_with_the_reason(own: Path, capsys) -> None:
    code, _, err = call(capsys, "hull", "points.deck")
    assert code == 1
    words = " ".join(err.split())
    assert "no hull: program 3, decided by card 51, IF(E(J))119,117,119 for the point" in words
    assert re.search(r"equation \d+, but its value there is -?\.\d{8}E[+-]\d\d instead of 0", words)
    assert "eight digits do not hold the products of its coordinates (known fault 6)" in words
    assert "for details add --explain" in words
    code, _, longer = call(capsys, "hull", "points.deck", "--explain")
    assert code == 1
    assert "Chapter 7 of the thesis proposes" in " ".join(longer.split())
    assert "See fault 6 in fortran_src/KNOWN-FAULTS.md" in longer
    assert "--explain" not in longer


def test_every_proposed_command_runs_and_some_give_the_hull(own: Path, capsys) -> None:
    commands = tried(call(capsys, "hull", "points.deck")[2])
    assert [words[0] for words in commands] == ["hull", "hull", "run", "diverge", "export"]
    codes = {" ".join(words): call(capsys, *words)[0] for words in commands}
    assert all(code in (0, 1) for code in codes.values()), codes
    exact = next(code for words, code in codes.items() if "--uncut" in words)
    assert (exact, codes["export points.deck -o hull.off"]) == (0, 0)
    assert (own / "hull.off").read_text(encoding="ascii").startswith("OFF\n")


def test_explanations_name_the_deck_and_each_data_set_once(own: Path, capsys) -> None:
    code, out, err = call(capsys, "diff", "points.csv")
    assert code == 1
    assert err.count("known fault 6") <= 1 < out.count("DATA NOT ACCEPTABLE")
    assert tried(err)[0] == ["cards", "points.csv", "-o", "points.deck"]
    text = Path("points.deck").read_text(encoding="ascii")
    Path("two.deck").write_text(text + " 1\n.1E+01        .1E+01        .1E+01\n" + text, encoding="ascii")
    err = call(capsys, "hull", "two.deck")[2]
    assert [line for line in err.splitlines() if line.startswith("data set")] == ["data set 1:", "data set 3:"]


@pytest.mark.parametrize(("name", "fault"), [("lastpair", 1), ("throughc", 3)])
def test_a_fault_of_the_original_is_named_and_its_correction_works(name, fault, tmp_path, capsys) -> None:
    deck = str(GROUNDS / f"{name}.deck")
    code, _, err = call(capsys, "hull", deck, "--explain")
    assert code == 1
    assert f"(known fault {fault})" in " ".join(err.split())
    assert f"row P3-0{24 + fault} of layer corrected corrects it" in " ".join(err.split())
    assert call(capsys, *tried(err)[0])[0] == 0


def test_a_known_fault_has_its_number_in_the_list() -> None:
    numbers = re.findall(r"^(\d+)\. ", (GROUNDS.parent / "KNOWN-FAULTS.md").read_text(encoding="utf-8"), re.MULTILINE)
    assert {"1", "2", "3", "4", "5", "6", "16"} <= set(numbers)


def test_epsilon_is_punched_and_read(own: Path, capsys) -> None:
    assert call(capsys, "cards", "points.csv", "--epsilon", ".01", "-o", "e.deck")[0] == 0
    assert (own / "e.deck").read_text(encoding="ascii").splitlines()[0] == "30+.10000000E-01"
    by_card = call(capsys, "hull", "e.deck", "--layers", "corrected,epsilon", "--core", "60000")
    by_option = call(capsys, "hull", "points.deck", "--layers", "corrected", "--epsilon", ".01", "--core", "60000")
    replaced = call(capsys, "hull", "e.deck", "--layers", "corrected", "--epsilon", ".001", "--core", "60000")
    assert by_card[:2] == by_option[:2]
    assert (by_card[0], replaced[0]) == (0, 0)
    for words in (["hull", "points.deck"], ["cards", "points.csv"]):
        for bad in ("x", ".123456789", "rel:1"):
            code, _, err = call(capsys, *words, "--epsilon", bad)
            assert (code, err.count("\n")) == (2, 1)
            assert err.startswith("hull1620")
            assert "--epsilon: " in err


@pytest.mark.parametrize("epsilon", ["-1", "", "rel:x", "rel:-1", "nan"])
@pytest.mark.parametrize("command", ["hull", "diff", "cards"])
def test_an_invalid_epsilon_is_rejected_in_one_line(command: str, epsilon: str, capsys) -> None:
    code, out, err = call(capsys, command, "example1", f"--epsilon={epsilon}")
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert err.startswith(f"hull1620 {command}: argument --epsilon: ")

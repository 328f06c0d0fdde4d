"""The tool behind ``make mutants``: what it draws, and that it tells a change that matters from one that does not."""

from __future__ import annotations

import ast
import csv
import shutil
import subprocess
from pathlib import Path

import pytest

pytest.importorskip("cosmic_ray")

from tests.mutants.__main__ import main
from tests.mutants.areas import HERE, Area, TableError, read_areas, read_equivalents
from tests.mutants.sample import difference, mutants, mutated, sample
from tests.mutants.trial import KILLED, SURVIVED, TIMEOUT, Unmutated, copy_tree, trial

SOURCES = {name: (HERE / name).read_text(encoding="utf-8") for name in ("report.py",)}


def test_the_sample_is_drawn_by_the_seed() -> None:
    drawn = sample(SOURCES, 12, 1963)
    assert drawn == sample(SOURCES, 12, 1963)
    assert len({mutant.place for mutant in drawn}) == 12
    assert set(sample(SOURCES, 5, 1963)) < set(drawn)
    assert sample(SOURCES, 12, 1964) != drawn


def test_a_change_elsewhere_leaves_the_sample_as_it_was() -> None:
    later = {name: "import os\n" + source for name, source in SOURCES.items()}
    assert [(m.file, m.line + 1, m.column, m.operator) for m in sample(SOURCES, 12, 7)] == [
        (m.file, m.line, m.column, m.operator) for m in sample(later, 12, 7)
    ]


def test_each_mutant_is_another_program_and_its_diff_one_change() -> None:
    for mutant in sample(SOURCES, 12, 5):
        source = SOURCES[mutant.file]
        changed = mutated(source, mutant)
        assert ast.dump(ast.parse(changed)) != ast.dump(ast.parse(source))
        assert difference(mutant.file, source, changed).count("\n@@") == 1


def test_annotations_and_marks_of_parameters_are_left_alone() -> None:
    lines = [
        "from __future__ import annotations",
        "def f(a: int | None, *, b: int | str = 3) -> int | None:",
        "    pass",
    ]
    found = {(mutant.line, lines[mutant.line - 1][mutant.column]) for mutant in mutants("f.py", "\n".join(lines))}
    assert found == {(2, "3")}


def test_operators_left_out() -> None:
    source = "def f(a):\n    return a == 1\n"
    names = {mutant.operator for mutant in mutants("f.py", source, ["core/*_[!I]*_Is*"])}
    assert names == {"core/NumberReplacer"} | {
        f"core/ReplaceComparisonOperator_Eq_{other}" for other in ("NotEq", "Lt", "LtE", "Gt", "GtE")
    }


def test_the_tables() -> None:
    """Every file and test of the areas is there, every equivalent mutant has a reason."""
    areas, _ = read_areas()
    assert [area.name for area in areas] == [
        "arithmetic",
        "conversion",
        "formats",
        "compiler",
        "exact_hull",
        "statistics",
        "apparatus",
    ]
    assert read_equivalents()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('files = ["none.py"]\ntests = []', "area a: no file is none.py"),
        ('files = ["toy.py"]\ntests = ["tests/none.py::test_it"]', "area a: there is no tests/none.py::test_it"),
        ('files = ["toy.py"]', "area a: 'tests'"),
    ],
)
def test_a_table_that_names_nothing(toy: Path, text: str, message: str) -> None:
    path = toy / "areas.toml"
    path.write_text(f"[area.a]\n{text}\n", encoding="utf-8")
    with pytest.raises(TableError, match=message):
        read_areas(path, toy)


TOY = """\
def six():
    return 6


def unneeded():
    return 7


def ends():
    while True:
        break
"""
TOY_TEST = """\
import toy


def test_six():
    assert toy.six() == 6
    toy.ends()
"""
TABLE = """\
[area.toy]
files = ["toy.py"]
tests = ["tests/test_toy.py"]

[[left_out]]
name = "core/*Break*"
reason = "takes its time"

[[left_out]]
name = "core/*True*"
reason = "it is the loop's"

[[left_out]]
name = "core/AddNot"
reason = "it is the loop's"
"""


@pytest.fixture
def toy(tmp_path: Path) -> Path:
    """A tree of one module and one test."""
    subprocess.run(["git", "init", "-q", tmp_path], check=True)
    shutil.copytree(HERE, tmp_path / "tests" / "mutants")
    (tmp_path / "toy.py").write_text(TOY, encoding="utf-8")
    (tmp_path / "tests" / "test_toy.py").write_text(TOY_TEST, encoding="utf-8")
    (tmp_path / ".gitignore").write_text("build/\n__pycache__/\n", encoding="utf-8")
    (tmp_path / "tests" / "mutants" / "areas.toml").write_text(TABLE, encoding="utf-8")
    (tmp_path / "tests" / "mutants" / "equivalent.toml").write_text("equivalent = []\n", encoding="utf-8")
    return tmp_path


def run(toy: Path) -> int:
    return main(["--sample", "9", "--jobs", "1"], toy, toy / "tests" / "mutants")


def outcomes(toy: Path) -> list[tuple[str, str]]:
    with (toy / "build" / "mutants" / "toy.csv").open(encoding="utf-8", newline="") as file:
        return [(row["line"], row["outcome"]) for row in csv.DictReader(file)]


def test_what_matters_is_killed_and_what_does_not_survives(toy: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(toy) == 0
    assert outcomes(toy) == [("2", KILLED), ("6", SURVIVED)]
    assert capsys.readouterr().out == "toy: 1 of 2 mutants killed (50%), 0 of them by time; 1 survived, 0 equivalent\n"
    (diff,) = (toy / "build" / "mutants" / "toy").iterdir()
    assert "\n-    return 7\n" in diff.read_text(encoding="utf-8")
    assert (toy / "toy.py").read_text(encoding="utf-8") == TOY

    # What is recorded as equivalent counts no more, and nothing is run again.
    entry = (
        '[[equivalent]]\nfile = "toy.py"\nline = "return 7"\noperator = "core/NumberReplacer"\nreason = "unneeded"\n'
    )
    (toy / "tests" / "mutants" / "equivalent.toml").write_text(entry, encoding="utf-8")
    assert run(toy) == 0
    out, err = capsys.readouterr()
    assert out == "toy: 1 of 1 mutants killed (100%), 0 of them by time; 0 survived, 1 equivalent\n"
    assert err == ""


def test_tests_that_fail_without_a_mutant_judge_nothing(toy: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (toy / "toy.py").write_text(TOY.replace("6", "8"), encoding="utf-8")
    assert run(toy) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("toy: the tests fail without any mutant\n")


def test_tests_that_load_no_file_of_the_area_judge_nothing(toy: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (toy / "tests" / "test_toy.py").write_text("def test_nothing():\n    assert True\n", encoding="utf-8")
    assert run(toy) == 2
    assert capsys.readouterr().err == "toy: its tests never load toy.py\n"


def test_a_loop_without_end_is_stopped(toy: Path, tmp_path_factory: pytest.TempPathFactory) -> None:
    copy = copy_tree(toy, tmp_path_factory.mktemp("copy"))
    (copy / "order.json").write_text('{"seconds": {}}', encoding="utf-8")
    (mutant,) = (m for m in mutants("toy.py", TOY) if m.operator == "core/ReplaceBreakWithContinue")
    area = Area("toy", ("toy.py",), ("tests/test_toy.py",))
    assert trial(copy, area, mutant, Unmutated(1, 0.1, 1.0, copy / "order.json")).outcome == TIMEOUT
    assert (copy / "toy.py").read_text(encoding="utf-8") == TOY

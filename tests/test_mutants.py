"""The tool behind ``make mutants``: its sample, its tables, and its verdicts on a small tree."""

import csv
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("cosmic_ray")

from tests.mutants.__main__ import main
from tests.mutants.areas import HERE, ROOT, Area, TableError, read_areas, read_equivalents
from tests.mutants.sample import difference, mutants, mutated, sample
from tests.mutants.trial import KILLED, SURVIVED, TIMEOUT, Unmutated, copy_tree, trial

SOURCES = {"report.py": (HERE / "report.py").read_text(encoding="utf-8")}


def test_the_seed_and_the_text_of_the_lines_determine_the_sample() -> None:
    drawn = sample(SOURCES, 12, 1963)
    assert drawn == sample(SOURCES, 12, 1963) != sample(SOURCES, 12, 1964)
    assert len({mutant.place for mutant in drawn}) == 12
    assert set(sample(SOURCES, 5, 1963)) < set(drawn)
    later = {name: "import os\n" + source for name, source in SOURCES.items()}
    assert [(m.line + 1, m.column, m.operator) for m in drawn] == [
        (m.line, m.column, m.operator) for m in sample(later, 12, 1963)
    ]
    for mutant in drawn:
        source = SOURCES[mutant.file]
        assert difference(mutant.file, source, mutated(source, mutant)).count("\n@@") == 1


def test_mutants_leave_out_annotations_and_tables_name_existing_files() -> None:
    lines = ["def f(a: int | None, *, b: int | str = 3) -> int | None:", "    pass"]
    places = {(mutant.line, lines[mutant.line - 1][mutant.column]) for mutant in mutants("f.py", "\n".join(lines))}
    assert places == {(1, "3")}
    names = {mutant.operator for mutant in mutants("f.py", "def f(a):\n    return a == 1\n", ["core/*_[!I]*_Is*"])}
    comparisons = {f"core/ReplaceComparisonOperator_Eq_{name}" for name in ("NotEq", "Lt", "LtE", "Gt", "GtE")}
    assert names == {"core/NumberReplacer"} | comparisons
    areas, _ = read_areas()
    assert {"arithmetic", "conversion", "formats", "compiler", "exact_hull"} <= {area.name for area in areas}
    assert read_equivalents()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('files = ["none.py"]\ntests = []', "area a: no file matches none.py"),
        ('files = ["toy.py"]\ntests = ["tests/none.py::test_it"]', "area a: tests/none.py::test_it does not exist"),
        ('files = ["toy.py"]', "area a: 'tests'"),
    ],
)
def test_a_table_that_names_a_missing_file_is_rejected(toy: Path, text: str, message: str) -> None:
    path = toy / "areas.toml"
    path.write_text(f"[area.a]\n{text}\n", encoding="utf-8")
    with pytest.raises(TableError, match=message):
        read_areas(path, toy)


TOY = "def six():\n    return 6\n\n\ndef unneeded():\n    return 7\n\n\ndef ends():\n    while True:\n        break\n"
TOY_TEST = "import toy\n\n\ndef test_six():\n    assert toy.six() == 6\n    toy.ends()\n"
TABLE = '[area.toy]\nfiles = ["toy.py"]\ntests = ["tests/test_toy.py"]\n' + "".join(
    f'[[left_out]]\nname = "{name}"\nreason = "an endless loop"\n'
    for name in ("core/*Break*", "core/*True*", "core/AddNot")
)


@pytest.fixture
def toy(tmp_path: Path) -> Path:
    """Return a tree of one module and one test."""
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


def test_a_change_that_matters_is_killed_and_one_that_does_not_survives(toy: Path, capsys) -> None:
    assert run(toy) == 0
    with (toy / "build" / "mutants" / "toy.csv").open(encoding="utf-8", newline="") as file:
        assert [(row["line"], row["outcome"]) for row in csv.DictReader(file)] == [("2", KILLED), ("6", SURVIVED)]
    assert capsys.readouterr().out == "toy: 1 of 2 mutants killed (50%), 0 of them by time; 1 survived, 0 equivalent\n"
    (diff,) = (toy / "build" / "mutants" / "toy").iterdir()
    assert "\n-    return 7\n" in diff.read_text(encoding="utf-8")
    assert (toy / "toy.py").read_text(encoding="utf-8") == TOY

    # A mutant recorded as equivalent does not count, and nothing runs again.
    fields = {"file": "toy.py", "line": "return 7", "operator": "core/NumberReplacer", "reason": "unneeded"}
    entry = "[[equivalent]]\n" + "".join(f'{key} = "{value}"\n' for key, value in fields.items())
    (toy / "tests" / "mutants" / "equivalent.toml").write_text(entry, encoding="utf-8")
    assert run(toy) == 0
    out, err = capsys.readouterr()
    assert out == "toy: 1 of 1 mutants killed (100%), 0 of them by time; 0 survived, 1 equivalent\n"
    assert err == ""


@pytest.mark.parametrize(
    ("file", "text", "message"),
    [
        ("toy.py", TOY.replace("6", "8"), "toy: the tests fail without any mutant\n"),
        ("tests/test_toy.py", "def test_nothing():\n    assert True\n", "toy: its tests never load toy.py\n"),
    ],
)
def test_tests_that_fail_or_do_not_load_the_area_judge_nothing(toy, file, text, message, capsys) -> None:
    (toy / file).write_text(text, encoding="utf-8")
    assert run(toy) == 2
    assert capsys.readouterr().err.startswith(message)


def test_an_endless_loop_is_stopped(toy: Path, tmp_path_factory) -> None:
    copy = copy_tree(toy, tmp_path_factory.mktemp("copy"))
    (copy / "order.json").write_text('{"seconds": {}}', encoding="utf-8")
    (mutant,) = (m for m in mutants("toy.py", TOY) if m.operator == "core/ReplaceBreakWithContinue")
    area = Area("toy", ("toy.py",), ("tests/test_toy.py",))
    assert trial(copy, area, mutant, Unmutated(1, 0.1, 1.0, copy / "order.json")).outcome == TIMEOUT
    assert (copy / "toy.py").read_text(encoding="utf-8") == TOY


def test_the_fixtures_of_all_tests_need_no_plugin() -> None:
    """The tests that judge mutants run without the plugins that pytest loads by default."""
    one = f"{Path(__file__).parent / 'test_locks.py'}::test_unsatisfied_requirements_and_other_build_tools_are_reported"
    process = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", one],
        cwd=ROOT,
        env={**os.environ, "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert process.returncode == 0, process.stdout

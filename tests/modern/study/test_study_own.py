"""User-defined families and measures, and arithmetics with more digits than a card."""

import sys
from pathlib import Path

import pytest

from modern.cli.main import main
from modern.study import PlanError, Programs, run_study
from modern.study.run import cut_lines
from modern.study.tomlplan import read_plan

PLAN = """
name = "own"
samples = 3

[[route]]
name = "listed"
limit = 20000
measures = ["{module}:spread"]

[[cell]]
family = "{module}:line"
parameters = {{ n = 3 }}
chunk = 1
"""
MODULE = """\
from modern.study.families.draws import Drawn


def line(draw, n):
    return Drawn(tuple((str(k), str(draw.whole(0, 9)), "1") for k in range(n)))


def spread(sample, run):
    return {"spread": 5}
"""


@pytest.fixture
def module(tmp_path: Path, monkeypatch) -> str:
    """Write a plan and a module next to it in an empty folder; return the unique name of the module."""
    name = "own_" + tmp_path.name
    (tmp_path / "plans").mkdir()
    (tmp_path / "plans" / f"{name}.py").write_text(MODULE)
    (tmp_path / "plans" / "own.toml").write_text(PLAN.format(module=name))
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", list(sys.path))
    return name


def test_module_next_to_the_plan_is_found(module: str, capsys) -> None:
    assert main(["study", "plans/own.toml", "--workers", "1", "--quiet"]) == 0
    text = next(Path("own/rows").iterdir()).read_text()
    assert '"spread":5' in text
    assert capsys.readouterr().err == ""


def test_worker_processes_find_the_module(module: str) -> None:
    assert main(["study", "plans/own.toml", "--samples", "2", "--workers", "2", "--quiet"]) == 0


@pytest.mark.parametrize(
    ("was", "now", "words"),
    [
        ("    return Drawn(", "    n / 0\n    return Drawn(", "line 5: ZeroDivisionError: division by zero"),
        ("def spread", "def spread(\ndef x", "line 8: '(' was never closed"),
        ("def spread", "import nothing_there\ndef spread", "ModuleNotFoundError: No module named 'nothing_there'"),
        ("def spread", "def other", "has no function 'spread'"),
        ('{"spread": 5}', '{"spread": 5 / sample.nothing}', "line 9: AttributeError: 'Sample' object has no"),
        ('{"spread": 5}', '{"spread": 0.5}', "the figure spread is not an integer or text"),
        ("    return Drawn(tuple(", "    return list(tuple(", "expected Drawn, found list"),
        ("def line(draw, n)", "def line(draw)", "unexpected keyword argument 'n'"),
    ],
)
def test_error_in_the_module_gives_one_line_with_file_and_line_number(was, now, words, module, capsys) -> None:
    path = Path("plans") / f"{module}.py"
    path.write_text(MODULE.replace(was, now))
    assert main(["study", "plans/own.toml", "--workers", "1", "--quiet"]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert words in err
    if "line " in words:
        assert f"{module}.py, line" in err


def test_missing_module_is_named(module: str, capsys) -> None:
    (Path("plans") / f"{module}.py").unlink()
    assert main(["study", "plans/own.toml", "--workers", "1", "--quiet"]) == 2
    assert f"no module is called '{module}' next to the plan or on Python's module path" in capsys.readouterr().err


def test_study_is_not_resumed_after_its_module_has_changed(module: str) -> None:
    plan = read_plan("plans/own.toml")
    run_study(plan, "own", workers=1, quiet=True)
    run_study(plan, "own", workers=1, quiet=True, resume=True)
    path = Path("plans") / f"{module}.py"
    path.write_text(path.read_text() + "\n")
    with pytest.raises(PlanError, match=f"cannot resume: the module {module} has changed"):
        run_study(plan, "own", workers=1, quiet=True, resume=True)


DIGITS = """
name = "twelve"
samples = 6

[[route]]
name = "cut"
layers = ["corrected"]
arithmetic = "truncating:12"
core = 60000

[[route]]
name = "whole"
layers = ["corrected"]
arithmetic = "truncating:12"
core = 60000
uncut = true

[[cell]]
family = "integers"
parameters = { digits = 3, n = 12 }
"""


def test_digits_beyond_the_cards_are_kept_with_uncut_and_otherwise_lost_with_a_note(
    tmp_path, monkeypatch, capsys
) -> None:
    """Twelve digits are enough for coordinates of three digits; the eight of the cards between the programs are not."""
    monkeypatch.chdir(tmp_path)
    Path("digits.toml").write_text(DIGITS, encoding="utf-8")
    assert main(["study", "digits.toml", "--workers", "1"]) == 0
    err = capsys.readouterr().err
    note = "route cut: the cards between the programs hold 8 digits of a number; uncut = true keeps all digits"
    assert err.count(note) == 1
    assert "route whole: the cards" not in err
    lines = Path("twelve/table.csv").read_text(encoding="utf-8").splitlines()
    found = {row.split(",")[1]: row.split(",")[2:4] for row in lines[1:]}
    assert found["whole"] == ["6", "6"], lines
    assert found["cut"] != ["6", "6"], lines


def test_no_note_if_the_cards_hold_all_digits() -> None:
    plan = read_plan_of(Programs("eight"), Programs("four", arithmetic="truncating:4"))
    assert cut_lines(plan) == ()
    assert len(cut_lines(read_plan_of(Programs("doubles", arithmetic="float64")))) == 1


def read_plan_of(*routes: Programs):
    from modern.study import Cell, Plan

    return Plan("p", "", "", (Cell({"n": 4}, "integers", {"digits": 1, "n": 4}, routes, 1),))

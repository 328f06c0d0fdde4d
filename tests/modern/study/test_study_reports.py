"""Tables, charts, the report of the study seventy, plan files and the command line."""

import csv
import json
import re
import sys
from collections import Counter
from pathlib import Path

import pytest

from emulator.errors import EmulatorError
from modern.cli.main import main
from modern.geometry.hull import NOT_ACCEPTABLE
from modern.study import Plan, PlanError, Port, Programs, refusals, run_study
from modern.study.builtin import names, seventy, study
from modern.study.families import FAMILIES
from modern.study.measures import MEASURES
from modern.study.outcomes import DETERMINED, OUTCOMES
from modern.study.report import Table, percent, unbroken, with_interval
from modern.study.run import check_plan
from modern.study.statistics import Interval, exact, mean
from modern.study.tomlplan import read_plan

PLAN_FILE = """
name = "three"
title = "Three digits"
question = "How often?"
samples = 6

[[route]]
name = "listed"
limit = 20000

[[route]]
name = "float64"
kind = "port"
arithmetic = "float64"

[[cell]]
key = { n = 5 }
family = "integers"
parameters = { digits = 2, n = 5 }

[[cell]]
family = "file"
samples = 2
routes = ["float64"]
parameters = { path = "mine.csv", shuffle = true }
"""


@pytest.fixture
def plan_file(tmp_path: Path, monkeypatch) -> Path:
    (tmp_path / "mine.csv").write_text("0,0,0\n1,0,0\n0,1,0\n0,0,1\n1,1,.5\n")
    path = tmp_path / "three.toml"
    path.write_text(PLAN_FILE)
    monkeypatch.chdir(tmp_path)
    return path


def read(path: Path) -> list[dict[str, str]]:
    """Return the rows of a CSV table."""
    return list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))


def test_tables_have_equal_contents_as_text_csv_and_markdown() -> None:
    table = Table("table", "T", ("what", "n|m"), (("a, b", "1"), ("c|d", "23")), ("note",))
    assert table.text() == "T\nwhat  n|m\na, b    1\nc|d    23\nnote\n"
    assert list(csv.reader(table.csv().splitlines())) == [["what", "n|m"], ["a, b", "1"], ["c|d", "23"]]
    markdown = table.markdown().splitlines()
    assert markdown[2:6] == ["| what | n\\|m |", "| :-- | --: |", "| a, b | 1 |", "| c\\|d | 23 |"]
    assert percent(Interval(0.5, 0.25, 0.75)) == "50.0 (25.0 to 75.0) %"
    assert percent(Interval(0, 0, 0.0049)) == "0.000 (0.000 to 0.490) %"
    assert with_interval(Interval(1.5, 1, 2)) == "1.50 (1.00 to 2.00)"
    assert with_interval(mean([3.0])) == "3.00"


def test_study_finishes_without_matplotlib(plan_file: Path, tmp_path: Path, monkeypatch, capsys) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    run_study(read_plan(str(plan_file)), tmp_path / "out", workers=1)
    assert "hull1620[plot]" in capsys.readouterr().err
    assert not list((tmp_path / "out").glob("*.svg"))
    assert "](outcomes.svg)" not in (tmp_path / "out/report.md").read_text()


def test_seventy_report_agrees_with_its_rows(tmp_path: Path) -> None:
    folder = tmp_path / "seventy"
    report = run_study(seventy.plan(140, 11), folder, seventy.report, workers=1, quiet=True)
    rows = [json.loads(line) for path in sorted(folder.glob("rows/*")) for line in path.read_text().splitlines()]
    sheets, rows = [row for row in rows if row["cell"]], [row for row in rows if not row["cell"]]
    assert len(rows) == 140
    assert len(sheets) == 2 * (2 * len(refusals.SHARES) - 1)
    refused = Counter(row["cell"] for row in sheets if row["runs"]["as listed"]["outcome"] == NOT_ACCEPTABLE)
    assert [row["refused"] for row in read(folder / "decimals.csv")] == [
        percent(exact(refused[cell], 2)) for cell in range(1, 2 * len(refusals.SHARES))
    ]
    table = {row["program"]: row for row in read(folder / "table.csv")}
    for route in ("as listed", "last pair mended"):
        groups = [0] * 2
        for row in rows:
            groups[row["index"] // 70] += row["runs"][route]["outcome"] not in DETERMINED
        assert table[route]["failed"] == str(sum(groups))
        assert table[route]["failures in 70"].startswith(f"{sum(groups) / 2:.2f} ")
        assert table[route]["of all sets"] == percent(exact(sum(groups), 140))
        spread = read(folder / "distribution.csv")
        assert {int(r["failures"]): int(r[f"70s, {route}"]) for r in spread if r[f"70s, {route}"] != "0"} == Counter(
            groups
        )
    kinds = Counter(row["tags"]["kind"] for row in rows)
    assert {r["kind"]: int(r["sets"]) for r in read(folder / "kinds.csv")} == kinds
    causes = read(folder / "causes.csv")
    assert sum(int(r["as listed"]) for r in causes) == int(table["as listed"]["failed"])
    text = (folder / "report.md").read_text()
    assert all(unbroken(conclusion) in text for conclusion in report.conclusions)
    manifest = json.loads((folder / "manifest.json").read_text())
    assert "Chapter 6 prints six" in manifest["plan"]["notes"][0]
    assert len(manifest["decks_sha256"]) == 64


def test_shares_that_make_two_rejections_likely_are_interpolated() -> None:
    """Two is the most probable number of 70 from 2/71 to 3/71 (the mode of a binomial distribution)."""
    low, high = refusals.TWO_LIKELIEST
    assert (low * 71, high * 71) == pytest.approx((2, 3))
    assert refusals.likely_shares(((0, 0.0), (71, 1.0))) == pytest.approx((2, 3))
    assert refusals.likely_shares(((0, 0.0), (10, low), (20, high), (30, 1.0))) == pytest.approx((10, 20))
    assert refusals.likely_shares(((0, 0.0), (10, 0.03))) is None
    assert refusals.likely_shares(((0, 0.0), (10, 0.0))) is None
    sheets = refusals.Sheets(333, "alone", 100, 71, 0)
    assert refusals.needed(sheets) == "2.8 to 4.2"
    assert refusals.needed(refusals.Sheets(2, "alone", 100, 2, 0)) == "-"


@pytest.mark.parametrize("samples", [0, 69, 71])
def test_seventy_requires_a_multiple_of_70_samples(samples: int) -> None:
    with pytest.raises(PlanError, match="must be a multiple of 70"):
        seventy.plan(samples, 1)


def test_every_built_in_study_has_a_plan_of_its_name() -> None:
    assert "seventy" in names()
    for name in names():
        module = study(name)
        plan = module.plan(module.SAMPLES, 1)
        check_plan(plan)
        assert plan.name == name, "the name of a plan is that of its file with - for _"
        assert plan.seed == 1
        assert len({cell.name for cell in plan.cells}) == len(plan.cells)
        assert plan.document() == module.plan(module.SAMPLES, 1).document() == json.loads(json.dumps(plan.document()))
        assert plan.document() != module.plan(module.SAMPLES, 2).document()
    with pytest.raises(KeyError):
        study("nothing")


def test_plan_file_is_read(plan_file: Path) -> None:
    plan = read_plan(str(plan_file))
    assert isinstance(plan, Plan)
    assert [route.name for route in plan.cells[0].routes] == ["listed", "float64"]
    assert plan.cells[0].routes == (Programs("listed", limit=20000), Port("float64", "float64"))
    assert plan.cells[1].family == "points"
    assert plan.cells[1].parameters["points"][4] == ["1", "1", ".5"]
    assert [cell.samples for cell in plan.cells] == [6, 2]
    assert [cell.samples for cell in read_plan(str(plan_file), 9, 4).cells] == [9, 9]
    assert read_plan(str(plan_file), 9, 4).seed == 4


ROUTE = "[[route]]\nname = 'a'\n"
CELL = f"{ROUTE}[[cell]]\n"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("name = ", "Invalid value"),
        ("name = 'x'", "expected at least one section [[route]], found none"),
        ("[[route]]\nlimit = 3", "bad.toml: line 1: route 1: the key 'name' is missing"),
        (f"{ROUTE}limit = '3'", "line 3: route 1: limit: expected an integer, found '3'"),
        (f"{ROUTE}limit = true", "limit: expected an integer, found True"),
        ("x = " + "[" * 3000 + "]" * 3000, "nested too deeply"),
        (f"{ROUTE}kind = 'train'", "expected kind programs or port"),
        (ROUTE * 2, "two routes"),
        (f"{CELL}routes = ['b']\nfamily = 'thesis'", "line 4: cell 1: there is no route 'b'; the routes are a"),
        (f"{CELL}n = 3", "line 4: cell 1: unknown name 'n'; expected key, family, parameters, routes, samples"),
        (f"{CELL}samples = 3", "line 3: cell 1: the key 'family' is missing"),
        (f"{CELL}family = 'file'", "the family 'file' needs the parameter 'path'"),
        (f"{CELL}family = 'file'\nparameters = {{path = 'no'}}", "no such file"),
        (f"{CELL}family = 'thesis'\nsamples = '3'", "line 5: cell 1: samples: expected an integer of at"),
        (f"notes = ['''\nsamples = 1\n''']\nsamples = 0\n{ROUTE}", "bad.toml: line 4: samples: expected"),
        (f"{CELL}family = 'cone'", "line 4: cell 1: no family is called 'cone'; expected thesis, int"),
        (
            f"{CELL}family = 'box'\nparameters = {{n = 3, most = 9, least = 1}}",
            "line 5: family box: got an unexpected keyword argument 'least'; its parameters are most, n, centre",
        ),
        (
            f"{CELL}family = 'box'\nparameters = {{n = 99, most = 9}}",
            "line 3: cell family=box n=99 most=9: family box: n is 99; the programs accept 1 to 51 points",
        ),
        (
            f"{ROUTE}\n[[route]]\nname = 'b'\nkind = 'port'\nmeasures = ['operations']",
            "line 4: route b: the measure operations does not exist for the port, which has plane_table",
        ),
        (f"{ROUTE}arithmetic = 'roman'", "line 1: route a: no arithmetic is called 'roman'"),
        (f"\nname = 'seventy'\n{ROUTE}", "line 2: 'seventy' is the name of a built-in study"),
        (f"seed = true\n{ROUTE}", "line 1: seed: expected an integer, found True"),
        ("route = 3", "expected route to be [[route]], found 3"),
        ("route = [3]", "a value has the wrong type"),
        (f"{CELL}family = 3", "cell 1: expected family to be text, found 3"),
        (f"{CELL}family = 'thesis'\nroutes = 3", "expected routes to be a list of names, found 3"),
        (f"{CELL}family = 'thesis'\nparameters = 3", "expected parameters to be { name = value }"),
        (f"{CELL}family = 'thesis'\nkey = {{a = [1]}}", "the values in the table key must be text or integers"),
    ],
)
def test_invalid_plan_file_gives_a_one_line_error(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "bad.toml"
    path.write_text(text)
    with pytest.raises(EmulatorError) as rejection:
        read_plan(str(path))
    assert message in str(rejection.value)
    assert "\n" not in str(rejection.value)


@pytest.mark.parametrize("epsilon", ["'.001'", "'0.001'", "0.001", ".001", "1e-3"])
@pytest.mark.parametrize("kind", ["kind = 'port'", "layers = ['epsilon']"])
def test_epsilon_of_a_plan_may_be_a_number_or_text(tmp_path: Path, epsilon: str, kind: str) -> None:
    plan_text = "[[route]]\nname = 'a'\n{}\nepsilon = {}\n[[cell]]\nfamily = 'box'\nparameters = {{n = 4, most = 9}}"
    (tmp_path / "plan.toml").write_text(plan_text.format(kind, epsilon))
    plan = read_plan(str(tmp_path / "plan.toml"))
    assert plan.cells[0].routes[0].epsilon == "0.001"


def test_command_line_runs_resumes_and_lists_studies(plan_file: Path, capsys) -> None:
    assert main(["study", "--list"]) == 0
    assert "seventy" in capsys.readouterr().out
    assert main(["study", "three.toml", "--workers", "1", "--quiet"]) == 0
    out, err = capsys.readouterr()
    assert out.startswith("Three digits\n")
    assert err == ""
    folder = Path("three")
    files = {"manifest.json", "index.sqlite", "rows", "table.md", "table.csv", "report.md"}
    assert files <= {path.name for path in folder.iterdir()}
    head = (folder / "table.csv").read_text().splitlines()[0].split(",")
    assert set(head) - {"cell", "route", "sets", "hull found"} <= set(OUTCOMES)
    assert main(["study", "three.toml", "--workers", "1"]) == 2
    assert "--resume" in capsys.readouterr().err
    assert main(["study", "three.toml", "--workers", "1", "--resume"]) == 0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "expected a study or a plan file"),
        (["nothing"], "unknown study 'nothing'"),
        (["no.toml"], "no.toml: no such file"),
        (["seventy", "--samples", "0"], "--samples: expected at least 1, found 0"),
        (["seventy", "--samples", "71"], "must be a multiple of 70"),
        (["seventy", "--workers", "-1"], "--workers: expected at least 1, found -1"),
        (["seventy", "--out", ""], "--out: expected a value, found an empty string"),
        (["seventy", "--dask", ""], "--dask: expected a value, found an empty string"),
        (["seventy", "--samples", "70000000000"], "418,333,334 files; expected at most"),
        (["seventy", "--workers", "1", "--dask", "tcp://h:1"], "--workers and --dask cannot be combined"),
        (["seventy", "--samples", "70", "--out", "three.toml"], "three.toml: not a directory"),
        (["seventy", "--samples", "70", "--out", "three.toml/in"], "not a directory"),
    ],
)
def test_invalid_input_gives_a_one_line_error(arguments: list[str], message: str, plan_file: Path, capsys) -> None:
    assert main(["study", *arguments]) == 2
    out, err = capsys.readouterr()
    assert message in err
    assert (out, err.count("\n")) == ("", 1)


def test_families_and_measures_are_listed_with_parameters(capsys) -> None:
    assert main(["study", "--families", "--measures"]) == 0
    out = capsys.readouterr().out
    for name in (*FAMILIES, "file", *MEASURES):
        assert re.search(rf"^{name}\b", out, re.M), name
    assert re.search(
        r"^box +most, n, centre = 0\n +Points whose coordinates are random integers from centre", out, re.M
    )

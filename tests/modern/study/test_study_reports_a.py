"""Reports of the studies rounding, epsilon and translation: true to their rows, and different where rows are."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from modern.study.builtin import epsilon, rounding, translation
from modern.study.outcomes import DETERMINED, OUTCOMES
from modern.study.plan import Chunk, Plan
from modern.study.report import Bars, Report, Table, listed, powers, share_of
from modern.study.run import check_plan
from modern.study.store import Store
from modern.study.summary import cells, summary
from modern.study.workers import chunk_text

STUDIES = {module.__name__.rpartition(".")[2]: module for module in (epsilon, rounding, translation)}
SLIPS = re.compile(r"  | [.,;:](?!\d)|[.,;:][.,;:]|None|nan|inf\b")
Outcome = Callable[[int, str, int], tuple[str, str]]
"""The outcome and detail of a cell's sample on a route."""


@contextmanager
def stored(plan: Plan, folder: Path, text: Callable[[Chunk], str]) -> Iterator[Store]:
    folder.mkdir()
    with closing(Store.open(folder, plan)) as store:
        for chunk in plan.chunks():
            store.add(chunk, text(chunk))
        yield store


def made_up(plan: Plan, outcome: Outcome) -> Callable[[Chunk], str]:
    """Rows no program ran for: every figure of the translation's is that of the outcome alone."""

    def text(chunk: Chunk) -> str:
        cell = plan.cells[chunk.cell]
        rows = []
        for index in range(chunk.start, chunk.stop):
            runs: dict[str, Any] = {}
            for route in cell.routes:
                filed, detail = outcome(chunk.cell, route.name, index)
                runs[route.name] = {"outcome": filed, "detail": detail, "figures": figures(route.name)}
            judge = {"n": 10, "dimension": 3, "vertices": 8, "planes": 12, "boundary": 0, "inside": 2}
            rows.append({"cell": chunk.cell, "index": index, "deck": [], "judge": judge, "runs": runs})
        return "".join(json.dumps(row) + "\n" for row in rows)

    return text


def figures(route: str) -> dict[str, int | str]:
    moved = route == translation.MOVED
    seconds = {"processor": "90" if moved else "100", "reader": "10", "punch": "20", "typewriter": "5"}
    counts = {"additions": 110 if moved else 100, "products": 80, "quotients": 2}
    return {**counts, **{f"seconds_{name}": value for name, value in seconds.items()}}


def all_right(*_: object) -> tuple[str, str]:
    return "right", ""


def report_of(name: str, plan: Plan, folder: Path, outcome: Outcome) -> Report:
    with stored(plan, folder, made_up(plan, outcome)) as store:
        return STUDIES[name].report(plan, store)


def table_of(report: Report, name: str) -> Table:
    return next(table for table in report.tables if table.name == name)


def check_form(report: Report) -> None:
    """Names are files' names, charts have values in their intervals, words are sentences without slips."""
    names = [table.name for table in report.tables]
    assert names[0] == "table"
    assert len(set(names)) == len(names)
    assert all(len(row) == len(table.head) for table in report.tables for row in table.rows)
    assert len({chart.name for chart in report.charts}) == len(report.charts) in (2, 3)
    for chart in report.charts:
        assert chart.y
        assert "95 % intervals" in chart.note
        for one in chart.series:
            assert one.points
            assert all(e.low <= e.value <= e.high for _, e in one.points)
            assert isinstance(chart, Bars) == isinstance(one.points[0][0], str)
    for paragraph in report.conclusions:
        assert paragraph.endswith(".")
        assert not SLIPS.search(paragraph), SLIPS.search(paragraph)


@pytest.mark.parametrize("name", STUDIES)
def test_plans_are_sound_and_always_the_same(name: str) -> None:
    module = STUDIES[name]
    plan = module.plan(module.SAMPLES, 1963)
    check_plan(plan)
    assert plan.name == name
    assert len({cell.name for cell in plan.cells}) == len(plan.cells)
    assert all(len({route.name for route in cell.routes}) == len(cell.routes) for cell in plan.cells)
    assert plan.document() == module.plan(module.SAMPLES, 1963).document() != module.plan(module.SAMPLES, 1).document()
    assert module.plan(3, 1963).samples * module.SAMPLES == plan.samples * 3
    assert plan.notes


def small(name: str) -> Plan:
    """A plan that runs in a second: a sample of each cell, of the translation's those of few points."""
    plan: Plan = STUDIES[name].plan(1, 1963)
    if name != "translation":
        return plan
    return replace(
        plan, cells=tuple(replace(cell, samples=1) for cell in plan.cells if cell.key.get("n", 0) in (0, 10))
    )


@pytest.mark.parametrize("name", STUDIES)
def test_reports_of_small_runs_are_true_to_the_rows(name: str, tmp_path: Path) -> None:
    plan = small(name)
    with stored(plan, tmp_path / "rows", lambda c: chunk_text(plan.cells[c.cell], plan.seed, c)) as store:
        report, found = STUDIES[name].report(plan, store), summary(store)
        assert set(found.outcomes()) <= set(OUTCOMES)
        for number, cell in enumerate(plan.cells):
            assert all(found.of(number, route.name) == cell.samples for route in cell.routes)
        # That a sum, and not a share, is shown: the counts of a row of the table add up to its sets.
        if name == "epsilon":
            for row in [row for table in report.tables[1:3] for row in table.rows]:
                assert int(row[3]) + int(row[4]) + int(row[6]) == int(row[2])
                assert int(row[5]) <= int(row[4])
        if name == "rounding":
            tested = [number for number, _ in cells(plan, test="exact")]
            for row in report.tables[0].rows:
                assert int(row[2]) == len(tested)
                assert int(row[3]) == sum(found.failed(number, row[0]) for number in tested)
        if name == "translation":
            both = [n for n, cell in cells(plan, asked="time") if not any(found.failed(n, r.name) for r in cell.routes)]
            assert [int(row[2]) for row in report.tables[0].rows] == [1] * len(both)
            assert sum(int(row[1]) for row in report.tables[1].rows) == len(both)
    check_form(report)


@pytest.mark.parametrize("name", STUDIES)
@pytest.mark.parametrize("outcome", ["right", "DATA NOT ACCEPTABLE", "wrong hull", "endless"])
def test_reports_of_rows_that_are_all_alike(name: str, outcome: str, tmp_path: Path) -> None:
    plan = STUDIES[name].plan(2, 1963)
    detail = "vertex missed" if outcome == "wrong hull" else ""
    check_form(report_of(name, plan, tmp_path / "rows", lambda *_: (outcome, detail)))


def test_rounding_tells_a_way_that_is_better(tmp_path: Path) -> None:
    plan = rounding.plan(10, 1963)

    def outcome(cell: int, route: str, index: int) -> tuple[str, str]:
        good = route.startswith("guard digit") or index % 2
        return ("right", "") if good else ("wrong hull", "plane missed")

    report = report_of("rounding", plan, tmp_path / "a", outcome)
    tested = 10 * len(cells(plan, test="exact"))
    pairs = {(row[0], row[1]): row[2:] for row in table_of(report, "pairs").rows}
    assert pairs["guard digit", "exact"] == (str(tested // 2), "0", "better")
    assert pairs["float64", "exact"] == ("0", "0", "no difference")
    assert pairs["guard digit", "interval"] == (str(10 * 4 // 2), "0", "better")
    largest = {row[0]: row[1] for row in report.tables[0].rows}
    assert largest["guard digit"] == "9999"
    assert largest["truncating"] == "-"
    lost = (len(rounding.WAYS) - 1) * tested // 2
    assert (
        f"all ways together: {lost:,}. Of these ended in a wrong hull that looks right: {lost:,};"
        in report.conclusions[0]
    )
    assert {row[1:] for row in table_of(report, "widths").rows} == {("none", "none", "10^-6 to 10^-1", *["none"] * 3)}
    fair = report_of("rounding", plan, tmp_path / "b", all_right)
    assert fair.conclusions[0].startswith("Failures with the exact test, all ways together: 0.")
    assert {row[4] for row in table_of(fair, "pairs").rows} == {"no difference"}


def test_rounding_says_what_decimals_need(tmp_path: Path) -> None:
    plan = rounding.plan(20, 1963)
    ((tenths, _),) = cells(plan, sets=rounding.TENTHS)

    def outcome(cell: int, route: str, index: int) -> tuple[str, str]:
        return ("DATA NOT ACCEPTABLE", "") if cell == tenths and route == "float64" else ("right", "")

    words = report_of("rounding", plan, tmp_path / "a", outcome).conclusions[1]
    assert "by truncation to eight digits 100.0 (83.2 to 100.0) %; by float64" in words
    assert words.endswith("cannot hold a tenth, 0.0 (0.0 to 16.8) %.")


def test_epsilon_tells_an_e_that_does_for_all(tmp_path: Path) -> None:
    plan = epsilon.plan(4, 1963)
    good = {epsilon.taken(2), epsilon.ported(2), epsilon.scaled(-1)}

    def outcome(cell: int, route: str, index: int) -> tuple[str, str]:
        if route in good:
            return "right", ""
        # A vertex missed at the least e too: that is no beginning, as greater ones lose none.
        lost = any(route == epsilon.taken(k) for k in (epsilon.ABSOLUTE[0], *range(3, 10)))
        return ("wrong hull", "vertex missed") if lost else ("DATA NOT ACCEPTABLE", "program1 1")

    report = report_of("epsilon", plan, tmp_path / "a", outcome)
    assert [row[:3] for row in table_of(report, "best").rows] == [
        ("as it is", "10^2", "10^2"),
        ("scaled", "10^-1", "10^-1"),
    ]
    assert all(row[3:] == ("10^2", "10^3", "10^-1", "-") for row in report.tables[0].rows)
    sets = 4 * len(plan.cells)
    price = table_of(report, "price").rows
    assert [row[:3] for row in price] == [("smaller", f"{sets}", f"{sets}"), ("greater", f"{sets}", f"{sets}")]
    assert price[1][3].startswith("100.0 ")


def test_epsilon_tells_where_no_e_does(tmp_path: Path) -> None:
    plan = epsilon.plan(2, 1963)

    def outcome(cell: int, route: str, index: int) -> tuple[str, str]:
        fails = cell == 8 or (cell == 0 and route == epsilon.taken(5))
        return ("wrong hull", "plane missed") if fails else ("right", "")

    report = report_of("epsilon", plan, tmp_path / "a", outcome)
    absolute = table_of(report, "best").rows[0]
    assert absolute[1] == "none"
    assert absolute[4:] == ("gap of .001", "gap of .001")
    assert all(row[4] == "-" for row in report.tables[0].rows)


def test_translation_tells_whether_it_saves(tmp_path: Path) -> None:
    plan = translation.plan(3, 1963)
    report = report_of("translation", plan, tmp_path / "a", all_right)
    assert "saves time (1 to 1.5)" in report.conclusions[0]
    assert "on the mean. Moving the origin" in report.conclusions[0]
    assert (
        "loses hulls of: none; gains hulls of: none; makes no difference that can be told for: numbers to 9;"
        in (report.conclusions[1])
    )
    # The whole time goes from 135 to 125 seconds; additions from 100 to 110.
    assert all(row[4].startswith("-10.0") and row[8].startswith("7.4") for row in report.tables[0].rows)

    def refused(cell: int, route: str, index: int) -> tuple[str, str]:
        return ("ERROR IN PROGRAM", "program3 119") if route.startswith(translation.MOVED) else ("right", "")

    lost = report_of("translation", plan, tmp_path / "b", refused)
    assert lost.conclusions[0] == "No set was determined both ways, so no time can be compared."
    assert "from some P on with it kept: numbers to 9; numbers to 9 about 100;" in lost.conclusions[1]
    assert lost.conclusions[1].endswith("gains hulls of: none; makes no difference that can be told for: none.")
    assert all(row[3] == "-" for row in lost.tables[2].rows)


def test_lists_and_shares_as_text() -> None:
    assert (listed([]), listed([1]), listed("abc")) == ("none", "1", "a; b; c")
    assert powers([-3, -2, 1]) == "10^-3 to 10^-2, 10^1"
    assert powers([]) == "none"
    assert share_of(0, 0) == "0 of 0"
    assert share_of(3, 1200) == "3 of 1,200, 0.250 (0.052 to 0.729) %"
    assert share_of(0, 300) == "0 of 300, 0.00 (0.00 to 1.22) %"


def test_outcomes_that_give_the_hull_count_as_found(tmp_path: Path) -> None:
    plan = rounding.plan(3, 1963)
    reports = [
        report_of("rounding", plan, tmp_path / f"{k}", lambda *_, one=one: (one, ""))
        for k, one in enumerate(DETERMINED)
    ]
    assert reports[0] == reports[1] == reports[2]

"""The reports of the studies rounding, epsilon and translation agree with their rows."""

import json
import re
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

import pytest

from modern.study.builtin import epsilon, rounding, translation
from modern.study.outcomes import DETERMINED
from modern.study.plan import Chunk, Plan
from modern.study.report import Bars, Report, Table, listed, powers, share_of
from modern.study.store import Store
from modern.study.summary import cells

STUDIES = {module.__name__.rpartition(".")[2]: module for module in (epsilon, rounding, translation)}
MISTAKES = re.compile(r"  | [.,;:](?!\d)|[.,;:][.,;:]|None|nan|inf\b")
Outcome = Callable[[int, str, int], tuple[str, str]]
"""A function of cell, route and sample that returns outcome and detail."""


@contextmanager
def stored(plan: Plan, folder: Path, text: Callable[[Chunk], str]) -> Iterator[Store]:
    folder.mkdir()
    with closing(Store.open(folder, plan)) as store:
        for chunk in plan.chunks():
            store.add(chunk, text(chunk))
        yield store


def made_up(plan: Plan, outcome: Outcome) -> Callable[[Chunk], str]:
    """Return a function that invents the rows of a chunk, with figures that depend on the route only."""

    def text(chunk: Chunk) -> str:
        cell = plan.cells[chunk.cell]
        rows = []
        for index in range(chunk.start, chunk.stop):
            runs: dict[str, Any] = {}
            for route in cell.routes:
                name, detail = outcome(chunk.cell, route.name, index)
                runs[route.name] = {"outcome": name, "detail": detail, "figures": figures(route.name)}
            judge = {"n": 10, "dimension": 3, "vertices": 8, "planes": 12, "boundary": 0, "inside": 2}
            rows.append({"cell": chunk.cell, "index": index, "deck": [], "judge": judge, "runs": runs})
        return "".join(json.dumps(row) + "\n" for row in rows)

    return text


def figures(route: str) -> dict[str, int | str]:
    moved = route == translation.MOVED
    seconds = {"processor": "90" if moved else "100", "reader": "10", "punch": "20", "typewriter": "5"}
    counts = {
        "additions": 110 if moved else 100,
        "products": 80,
        "quotients": 2,
        "model_low": "130",
        "model_high": "145",
    }
    return {**counts, **{f"seconds_{name}": value for name, value in seconds.items()}}


def all_right(*_: object) -> tuple[str, str]:
    return "right", ""


def report_of(name: str, plan: Plan, folder: Path, outcome: Outcome) -> Report:
    with stored(plan, folder, made_up(plan, outcome)) as store:
        return STUDIES[name].report(plan, store)


def table_of(report: Report, name: str) -> Table:
    return next(table for table in report.tables if table.name == name)


def check_form(report: Report) -> None:
    """Check that names are valid, values lie in their intervals, and conclusions are complete sentences."""
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
        assert not MISTAKES.search(paragraph), MISTAKES.search(paragraph)


@pytest.mark.parametrize("name", STUDIES)
@pytest.mark.parametrize("outcome", ["right", "DATA NOT ACCEPTABLE", "wrong hull", "endless"])
def test_report_of_equal_outcomes_is_well_formed(name: str, outcome: str, tmp_path: Path) -> None:
    plan = STUDIES[name].plan(2, 1963)
    detail = "vertex missed" if outcome == "wrong hull" else ""
    check_form(report_of(name, plan, tmp_path / "rows", lambda *_: (outcome, detail)))


def test_rounding_names_the_better_arithmetic(tmp_path: Path) -> None:
    plan = rounding.plan(10, 1963)

    def outcome(cell: int, route: str, index: int) -> tuple[str, str]:
        is_right = route.startswith("guard digit") or index % 2
        return ("right", "") if is_right else ("wrong hull", "plane missed")

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
    assert f"failed {lost:,} times. Of these failures, {lost:,} are plausible but" in report.conclusions[1]
    assert {row[1:] for row in table_of(report, "widths").rows} == {("none", "none", "10^-6 to 10^-1", *["none"] * 3)}
    fair = report_of("rounding", plan, tmp_path / "b", all_right)
    assert fair.conclusions[1].startswith("With the exact test, all arithmetics together failed 0 times.")
    assert {row[4] for row in table_of(fair, "pairs").rows} == {"no difference"}


def test_rounding_reports_the_hulls_of_decimal_sets(tmp_path: Path) -> None:
    plan = rounding.plan(20, 1963)
    ((tenths, _),) = cells(plan, sets=rounding.TENTHS)

    def outcome(cell: int, route: str, index: int) -> tuple[str, str]:
        return ("DATA NOT ACCEPTABLE", "") if cell == tenths and route == "float64" else ("right", "")

    conclusion = report_of("rounding", plan, tmp_path / "a", outcome).conclusions[2]
    assert "truncation to eight digits finds 100.0 (83.2 to 100.0) % of the hulls" in conclusion
    assert conclusion.endswith("finds 0.0 (0.0 to 16.8) %.")


def test_epsilon_finds_an_e_that_works_for_all_sets(tmp_path: Path) -> None:
    plan = epsilon.plan(4, 1963)
    working = {epsilon.taken(2), epsilon.ported(2), epsilon.scaled(-1)}

    def outcome(cell: int, route: str, index: int) -> tuple[str, str]:
        if route in working:
            return "right", ""
        # A vertex missed at the least e does not count as swallowed, because some greater e misses none.
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


def test_epsilon_names_the_kinds_for_which_no_e_works(tmp_path: Path) -> None:
    plan = epsilon.plan(2, 1963)

    def outcome(cell: int, route: str, index: int) -> tuple[str, str]:
        fails = cell == 8 or (cell == 0 and route == epsilon.taken(5))
        return ("wrong hull", "plane missed") if fails else ("right", "")

    report = report_of("epsilon", plan, tmp_path / "a", outcome)
    absolute = table_of(report, "best").rows[0]
    assert absolute[1] == "none"
    assert absolute[4:] == ("gap of .001", "gap of .001")
    assert all(row[4] == "-" for row in report.tables[0].rows)


def test_translation_reports_whether_it_saves_time(tmp_path: Path) -> None:
    plan = translation.plan(3, 1963)
    report = report_of("translation", plan, tmp_path / "a", all_right)
    assert "saves time (1 to 1.5)" in report.conclusions[0]
    assert "the move has these effects" in report.conclusions[0]
    assert (
        "They find more hulls for these kinds: none. The difference is not significant for these kinds: numbers"
        in report.conclusions[1]
    )
    # The total time goes from 135 to 125 seconds, of which devices take 35; additions from 100 to 110.
    assert report.tables[0].rows[0][7] == "95 to 110"
    assert all(row[4].startswith("-10.0") and row[9].startswith("7.4") for row in report.tables[0].rows)

    def rejected(cell: int, route: str, index: int) -> tuple[str, str]:
        return ("ERROR IN PROGRAM", "program3 119") if route.startswith(translation.MOVED) else ("right", "")

    lost = report_of("translation", plan, tmp_path / "b", rejected)
    assert lost.conclusions[0] == "No set gave a hull both ways, so no times can be compared."
    assert (
        "none fails with 16 digits if the origin is kept: numbers to 9; numbers to 9 about 100;" in lost.conclusions[1]
    )
    assert lost.conclusions[1].endswith("these kinds: none. The difference is not significant for these kinds: none.")
    assert all(row[3] == "-" for row in lost.tables[2].rows)


def test_lists_powers_and_shares_are_formatted() -> None:
    assert (listed([]), listed([1]), listed("abc")) == ("none", "1", "a; b; c")
    assert powers([-3, -2, 1]) == "10^-3 to 10^-2, 10^1"
    assert powers([]) == "none"
    assert share_of(0, 0) == "0 of 0"
    assert share_of(3, 1200) == "3 of 1,200, 0.250 (0.052 to 0.729) %"
    assert share_of(0, 300) == "0 of 300, 0.00 (0.00 to 1.22) %"


def test_all_outcomes_with_the_right_hull_count_equally(tmp_path: Path) -> None:
    plan = rounding.plan(3, 1963)
    reports = [
        report_of("rounding", plan, tmp_path / f"{k}", lambda *_, one=one: (one, ""))
        for k, one in enumerate(DETERMINED)
    ]
    assert reports[0] == reports[1] == reports[2]

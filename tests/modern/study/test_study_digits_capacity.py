"""The studies digits, capacity, machine-time and divergence, and the agreement of their reports with the rows."""

import random
import re
from contextlib import closing
from pathlib import Path

import pytest

from emulator.language.objectcode import Program
from emulator.machine.machine import Machine
from emulator.numbers.arithmetic import UNDEFINED
from modern.edition import programs
from modern.exact_hull import exact_hull
from modern.port import convex_hull
from modern.study.builtin import capacity, digits, divergence, machine_time
from modern.study.families import draw_sample
from modern.study.measures import divergence as divergence_of
from modern.study.measures import plane_table
from modern.study.plan import Cell, Plan
from modern.study.report import Lines, Report
from modern.study.run import run_study
from modern.study.sample import Sample, judge
from modern.study.store import Store
from modern.study.summary import cells, summary, values
from modern.thesis.job import HullRun, run_hull
from tests.support.judged import OPTIONS


def _sample(family: str, index: int, **parameters: int) -> Sample:
    return judge(draw_sample(Cell({"sets": family}, family, parameters, (), 9), 1963, index), "sample")


def _finished(plan: Plan, folder: Path, module: object) -> Report:
    return run_study(plan, folder, module.report, workers=1, quiet=True)


def _table_places(machine: Machine) -> int:
    """Return the greatest index of program 3's array A to which a value was assigned."""
    storage = machine.program.storage
    names = [storage.name_of(a) for a in range(storage.fields) if machine.state.kinds[a] != UNDEFINED]
    return max(int(name[2:-1]) for name in names if re.fullmatch(r"A\(\d+\)", name))


@pytest.mark.parametrize("family", ["ball", "sphere", "cube", "prism"])
def test_port_and_corrected_program_use_the_same_number_of_table_entries(family: str) -> None:
    for index in range(3):
        sample = _sample(family, index, digits=2, n=14)
        machines: list[Machine] = []

        def watch(_: Program, machine: Machine, started: list[Machine] = machines) -> None:
            started.append(machine)

        run = run_hull(sample.deck, lambda name: programs.with_layers(name, ("corrected",)), OPTIONS, watch=watch)
        assert run.final.name == "program3"
        hull = convex_hull(sample.drawn.points, "exact", history=True)
        assert plane_table(sample, hull) == {"planes_at_once": _table_places(machines[-1])}


def test_cells_and_plane_tables_are_selected() -> None:
    sample = _sample("ball", 0, digits=2, n=8)
    assert plane_table(sample, convex_hull(sample.drawn.points)) == {}
    flat = [["0", "0", "0"], ["5", "0", "0"], ["0", "5", "0"], ["5", "5", "0"]]
    assert plane_table(sample, convex_hull(flat, history=True)) == {}
    # docs/explanation/eight-digits.md: with 3d + 1 digits every test for zero is exact for integers of d digits.
    size = 10**3 - 1
    assert 8 * size**3 < 10 ** digits.exact_zeros(3)
    assert 4 * (16 * size**3) < 10 ** digits.enough(3)
    plan = capacity.plan(1, 1)
    assert values(plan, "sets") == ("ball", "cube, solid", "cube, surface", "prism", "sphere")
    assert [cell.key["n"] for _, cell in cells(plan, sets="prism")] == [n for n in capacity.POINTS if n % 2 == 0]
    assert cells(plan, sets="nothing") == ()


def _run(sample: Sample) -> HullRun:
    return run_hull(sample.deck, programs.program)


def test_divergence_depends_on_the_digits_of_the_points() -> None:
    for index in range(3):
        small = _sample("integers", index, digits=2, n=10)
        assert divergence_of(small, _run(small)) == {"diverges": ""}
        large = _sample("integers", index, digits=3, n=10)
        assert divergence_of(large, _run(large))["diverges"] != ""
    # The D of a plane of three-digit points can have nine digits, of which program 1 punches eight.
    samples = [_sample("integers", index, digits=3, n=10) for index in range(8)]
    places = {str(divergence_of(sample, _run(sample))["diverges"]) for sample in samples}
    assert "cards to program3" in places


@pytest.fixture(scope="module")
def digits_study(tmp_path_factory) -> tuple[Plan, Path, Report]:
    whole = digits.plan(2, 7)
    plan = Plan(whole.name, whole.title, whole.question, whole.cells[:3], whole.seed, whole.notes)
    folder = tmp_path_factory.mktemp("digits") / "out"
    return plan, folder, _finished(plan, folder, digits)


def test_digits_counts_every_set_and_finds_3d_plus_1(digits_study: tuple[Plan, Path, Report]) -> None:
    _, _, report = digits_study
    assert [row[4] for row in report.tables[0].rows] == ["4", "7", "10"]
    assert report.tables[0].rows[0][5] == "4"
    plan, _, report = digits_study
    for row in report.tables[2].rows:
        assert sum(map(int, row[2:])) == plan.cells[0].samples


def test_digits_report_follows_changed_rows(digits_study: tuple[Plan, Path, Report]) -> None:
    plan, folder, before = digits_study
    with closing(Store.open(folder, plan)) as store:
        store.query("UPDATE runs SET outcome = 'wrong hull' WHERE cell = 1 AND route = 'P=20'")
        after = digits.report(plan, store)
        assert digits.least(summary(store), 1) == 21
    assert after.tables[0].rows[1][4] == "21"
    assert "For 3 of the 3 values of d that were tried, the smallest P" in before.conclusions[2]
    assert "For 2 of the 3 values of d that were tried, the smallest P" in after.conclusions[2]


def test_capacity_reports_the_greatest_number_of_entries_of_its_rows(tmp_path: Path) -> None:
    whole = capacity.plan(2, 3)
    selected = [cell for cell in whole.cells if cell.key["sets"] in ("ball", "sphere") and cell.key["n"] in (8, 51)]
    plan = Plan(whole.name, whole.title, whole.question, tuple(selected), whole.seed)
    report = _finished(plan, tmp_path / "out", capacity)
    with closing(Store.open(tmp_path / "out", plan)) as store:
        rows = [row for row in store.rows() if row["judge"]["n"] == 51]
        figures = [row["runs"][capacity.EXACT]["figures"]["planes_at_once"] for row in rows]
        again = capacity.report(plan, store)
    assert again == report
    assert max(int(row[4]) for row in report.tables[0].rows) == max(figures) > capacity.PLACES
    assert [row[1] for row in report.tables[0].rows] == ["-", "51"]
    assert f" sets: up to {max(figures)} entries were in use at once" in report.conclusions[0]
    assert report.conclusions[0].endswith("no set needed more than 98 entries is 8.")
    assert report.conclusions[1].startswith("None of the 4 sets of 8 points needed ")
    assert report.tables[2].rows[0][1:] == ("98", str(capacity.positions(98)), "40000")


def test_machine_time_is_the_sum_of_its_parts(tmp_path: Path) -> None:
    whole = machine_time.plan(2, 3)
    selected = [cell for cell in whole.cells if cell.key["n"] in (4, 12)]
    plan = Plan(whole.name, whole.title, whole.question, tuple(selected), whole.seed)
    report = _finished(plan, tmp_path / "out", machine_time)
    with closing(Store.open(tmp_path / "out", plan)) as store:
        longest = dict.fromkeys(range(len(plan.cells)), 0.0)
        for row in store.rows():
            figures = next(iter(row["runs"].values()))["figures"]
            seconds = sum(float(figures[f"seconds_{part}"]) for part in machine_time.PARTS)
            longest[row["cell"]] = max(longest[row["cell"]], seconds)
    _, sizes, parts = report.tables
    assert [row[5].split()[0] for row in sizes.rows] == [f"{seconds / 60:.2f}" for seconds in longest.values()]
    for row in sizes.rows:
        low, high = map(float, row[4].split(" to "))
        assert low < float(row[3].split()[0]) < high
    totals = {(row[0], row[1]): float(row[3].split()[0]) for row in sizes.rows}
    for name, n, processor, model, *devices in parts.rows:
        seconds = [float(cell.split()[0]) for cell in (processor, *devices)]
        assert totals[name, n] == pytest.approx(sum(seconds), abs=0.021)
        low, high = map(float, model.split(" to "))
        assert low < seconds[0] < high
    chart = report.charts[0]
    assert isinstance(chart, Lines)
    assert [place for place, _ in chart.series[0].points] == [4.0, 12.0]


def test_machine_time_counts_only_sets_with_the_right_hull(tmp_path: Path) -> None:
    whole = machine_time.plan(2, 3)
    plan = Plan(whole.name, whole.title, whole.question, whole.cells[:1], whole.seed)
    _finished(plan, tmp_path / "out", machine_time)
    with closing(Store.open(tmp_path / "out", plan)) as store:
        store.query("UPDATE runs SET outcome = 'wrong hull' WHERE place = 0")
        assert machine_time.report(plan, store).tables[1].rows[0][2] == "1"
        store.query("UPDATE runs SET outcome = 'wrong hull'")
        assert machine_time.report(plan, store).conclusions == ("No run gave a hull, so nothing was timed.",)


def test_divergence_report_follows_changed_rows(tmp_path: Path) -> None:
    whole = divergence.plan(3, 3)
    selected = [cell for cell in whole.cells if cell.key["sets"] in ("whole, 2 digits", "whole, 6 digits")]
    plan = Plan(whole.name, whole.title, whole.question, tuple(selected), whole.seed)
    report = _finished(plan, tmp_path / "out", divergence)
    assert sum(int(row[1]) for row in report.tables[0].rows) == 6
    assert report.conclusions[0].endswith("All decisions agreed for all sets of these families: whole, 2 digits.")
    with closing(Store.open(tmp_path / "out", plan)) as store:
        store.query("UPDATE runs SET outcome = 'right'")
        assert "all decisions agree, 0 of 3," in divergence.report(plan, store).conclusions[1]
        store.query("UPDATE runs SET outcome = 'endless' WHERE place = 0")
        once = divergence.report(plan, store).conclusions[1]
        assert once.startswith("Of the sets with a different decision, 2 of 3,")
        assert "all decisions agree, 1 of 3," in once
        store.query("UPDATE runs SET figures = json_set(figures, '$.diverges', 'program3 116')")
        after = divergence.report(plan, store)
    assert after.tables[0].rows[0][:2] == ("program3 116", "6")
    assert after.conclusions[0].endswith("All decisions agreed for all sets of these families: none.")
    assert after.conclusions[1].endswith("all decisions agree, 0 of 0, fail because of faults of the programs.")


@pytest.mark.parametrize("d", [1, 2, 3])
def test_3d_plus_4_digits_are_enough_for_nearly_flat_sets(d: int) -> None:
    """Sets a unit off a plane have the least values at C that integers can have (docs/explanation/eight-digits.md)."""
    source = random.Random(d)
    size = 10**d - 1
    for _ in range(40):
        a, b = source.choice((-1, 0, 1)), source.choice((-1, 0, 1))
        drawn: set[tuple[int, int, int]] = set()
        while len(drawn) < 8:
            x, y = source.randint(-size, size), source.randint(-size, size)
            z = a * x + b * y + source.randint(-1, 1)
            if abs(z) <= size:
                drawn.add((x, y, z))
        points = [[str(c) for c in point] for point in sorted(drawn)]
        judged, hull = exact_hull(points), convex_hull(points, f"truncating:{digits.enough(d)}")
        assert hull.determined
        assert set(hull.vertices) == set(judged.vertices)
        assert len(hull.faces) == len(judged.facets) or judged.dimension < 3

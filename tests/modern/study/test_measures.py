"""Every measure returns the figures of a run."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

from modern.study import PlanError, Port, Programs, run_study
from modern.study.measures import MEASURES
from tests.support.studied import PLAN

LISTED = Programs("listed", limit=20_000)


MEASURED: dict[str, tuple[Programs | Port, set[str]]] = {
    "machine_time": (LISTED, {f"seconds_{name}" for name in ("processor", "reader", "punch", "typewriter")}),
    "operations": (LISTED, {"additions", "products", "quotients"}),
    "plane_table": (Port("exact", history=True), {"planes_at_once"}),
    "divergence": (LISTED, {"diverges"}),
}
"""A route for each measure, and the figures it returns."""


def test_every_measure_has_a_case() -> None:
    assert MEASURED.keys() == MEASURES.keys()


@pytest.mark.parametrize("name", sorted(MEASURED))
def test_measure_returns_its_figures(name: str, tmp_path: Path) -> None:
    route, keys = MEASURED[name]
    routes = (replace(route, name="measured", measures=(name,)),)
    plan = replace(PLAN, cells=(replace(PLAN.cells[0], routes=routes, samples=1),))
    run_study(plan, tmp_path / "m", workers=1, quiet=True)
    for line in (tmp_path / "m/rows/0000-000000000.jsonl").read_text().splitlines():
        assert keys <= json.loads(line)["runs"]["measured"]["figures"].keys()


def test_measures_become_figures_of_the_row(tmp_path: Path) -> None:
    route = Programs("listed", measures=("machine_time", "operations", "modern.study.measures:operations"))
    plan = replace(PLAN, cells=(replace(PLAN.cells[0], routes=(route,), samples=2),))
    run_study(plan, tmp_path / "m", workers=1, quiet=True)
    figures = json.loads((tmp_path / "m/rows/0000-000000000.jsonl").read_text().splitlines()[0])["runs"]["listed"]
    assert {"seconds_processor", "seconds_reader", "additions", "products"} <= figures["figures"].keys()


def test_failing_measure_gives_a_one_line_error(tmp_path: Path) -> None:
    route = Programs("listed", measures=("os:getpid",))
    plan = replace(PLAN, cells=(replace(PLAN.cells[0], routes=(route,), samples=1),))
    with pytest.raises(PlanError, match=r"route listed: measure os:getpid: .* takes no arguments"):
        run_study(plan, tmp_path / "m", workers=1, quiet=True)

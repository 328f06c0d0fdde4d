"""Measures of a run: each is tried, and its figures are those of the run."""

from __future__ import annotations

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
"""Every measure: a route whose run it takes, and the figures it gives."""


def test_every_measure_is_tried() -> None:
    assert MEASURED.keys() == MEASURES.keys()


@pytest.mark.parametrize("name", sorted(MEASURED))
def test_a_measure_gives_its_figures(name: str, tmp_path: Path) -> None:
    """Of a run it takes; of one of the other kind none."""
    route, keys = MEASURED[name]
    other = Port("exact") if isinstance(route, Programs) else LISTED
    routes = replace(route, name="taken", measures=(name,)), replace(other, name="other", measures=(name,))
    plan = replace(PLAN, cells=(replace(PLAN.cells[0], routes=routes, samples=1),))
    run_study(plan, tmp_path / "m", workers=1, quiet=True)
    for line in (tmp_path / "m/rows/0000-000000000.jsonl").read_text().splitlines():
        runs = json.loads(line)["runs"]
        assert keys <= runs["taken"]["figures"].keys()
        assert not keys & runs["other"]["figures"].keys()


def test_measures_become_figures(tmp_path: Path) -> None:
    route = Programs("listed", measures=("machine_time", "operations", "modern.study.measures:operations"))
    plan = replace(PLAN, cells=(replace(PLAN.cells[0], routes=(route,), samples=2),))
    run_study(plan, tmp_path / "m", workers=1, quiet=True)
    figures = json.loads((tmp_path / "m/rows/0000-000000000.jsonl").read_text().splitlines()[0])["runs"]["listed"]
    assert {"seconds_processor", "seconds_reader", "additions", "products"} <= figures["figures"].keys()


def test_a_measure_that_cannot_take_a_run_is_one_line(tmp_path: Path) -> None:
    route = Programs("listed", measures=("os:getpid",))
    plan = replace(PLAN, cells=(replace(PLAN.cells[0], routes=(route,), samples=1),))
    with pytest.raises(PlanError, match=r"route listed: measure os:getpid: .* takes no arguments"):
        run_study(plan, tmp_path / "m", workers=1, quiet=True)

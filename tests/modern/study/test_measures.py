"""Every measure returns the figures of a run."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

from modern.study import PlanError, Programs, run_study
from tests.support.studied import PLAN


def test_measures_become_figures_or_a_one_line_error(tmp_path: Path) -> None:
    route = Programs("listed", measures=("machine_time", "operations", "modern.study.measures:operations"))
    plan = replace(PLAN, cells=(replace(PLAN.cells[0], routes=(route,), samples=2),))
    run_study(plan, tmp_path / "m", workers=1, quiet=True)
    figures = json.loads((tmp_path / "m/rows/0000-000000000.jsonl").read_text().splitlines()[0])["runs"]["listed"]
    assert {"seconds_processor", "seconds_reader", "additions", "products"} <= figures["figures"].keys()
    route = Programs("listed", measures=("os:getpid",))
    plan = replace(PLAN, cells=(replace(PLAN.cells[0], routes=(route,), samples=1),))
    with pytest.raises(PlanError, match=r"route listed: measure os:getpid: .* takes no arguments"):
        run_study(plan, tmp_path / "n", workers=1, quiet=True)

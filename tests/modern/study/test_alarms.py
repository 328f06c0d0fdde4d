"""The measure ``alarms``, and the report of the study on rows made for the test."""

import json
from collections.abc import Iterator
from typing import Any

import pytest

from modern.study.alarms import ESTIMATING, METHODS, alarms
from modern.study.builtin import alarms as study
from modern.study.families import draw_sample
from modern.study.measures import divergence
from modern.study.plan import Cell, Programs
from modern.study.routes import options_of, programs_of
from modern.study.sample import Sample, judge
from modern.thesis.batch import run_hulls
from modern.thesis.job import HullRun

ROUTE = Programs("corrected", layers=("corrected",), core=60_000, limit=20_000)


def runs(digits: int, number: int) -> Iterator[tuple[Sample, HullRun]]:
    cell = Cell({"digits": digits}, "integers", {"digits": digits, "n": 5}, (ROUTE,), number)
    samples = [judge(draw_sample(cell, 1963, index), "set") for index in range(number)]
    first, load = programs_of(ROUTE)
    results = run_hulls([sample.deck for sample in samples], load, options_of(ROUTE), first)
    for sample, run in zip(samples, results, strict=True):
        assert isinstance(run, HullRun)
        yield sample, run


def test_exact_computations_raise_no_alarm() -> None:
    for sample, run in runs(1, 2):
        figures = alarms(sample, run)
        assert figures["first"] == ""
        assert not any(figures[f"{name}_false"] for name in METHODS)


def test_first_wrong_decision_is_the_first_divergence_and_intervals_notice_it() -> None:
    """The measure divergence runs the programs twice; this one repeats the operations of one run."""
    wrong = 0
    for sample, run in runs(4, 5):
        figures, diverges = alarms(sample, run), divergence(sample, run)["diverges"]
        if figures["first"] and not str(diverges).startswith("cards"):
            wrong += 1
            assert figures["first"] == diverges
        if figures["first"]:
            assert figures["interval_caught"] == figures["double_repaired"] == 1
            assert figures["interval_repaired"] == 0
        assert alarms(sample, run) == figures
    assert wrong > 1


def figures(first: str = "", **changed: Any) -> dict[str, Any]:
    made = {f"{name}_{what}": 0 for name in METHODS for what in ("false", "spoils")}
    made |= {f"{name}_{what}": int(bool(first)) for name in METHODS for what in ("caught", "repaired")} if first else {}
    made |= {f"{name}_digits_7": "2 7.5 0" for name in ESTIMATING}
    counted = {"tests": 10, "first": first, "e_right": "3:2", "additions": 5, "products": 4, "quotients": 1}
    return {**made, **counted, **({"e_first": 2, "e_repaired": 1} if first else {}), **changed}


class Rows:
    """A store with one run of each kind."""

    def __init__(self, **changed: int) -> None:
        self.changed = changed

    def query(self, sql: str) -> Iterator[tuple[int, str]]:
        wrong = figures("program1 196+2", cadna10_caught=0, **self.changed)
        for made in (wrong, {**wrong, "e_first": 999}, figures(), figures(interval_false=3)):
            yield 0, json.dumps(made)


def test_report_counts_noticed_decisions_and_false_alarms() -> None:
    report = study.report(study.plan(), Rows())
    rows = {row[0]: row for row in report.tables[0].rows}
    assert [rows["CADNA, N = 10"][k].split(" ")[0] for k in (1, 2, 5, 6)] == ["2", "0.0", "2", "0.0"]
    assert rows["intervals"][6].startswith("50.0 ")
    # 10^2 notices the one decision that e can change and none of the right ones, which need 10^3.
    assert rows["e = 10^2"][2].startswith("50.0 ")
    assert rows["e = 10^2"][6].startswith("0.0 ")
    assert "Of 2 runs" in report.conclusions[0]
    assert "branches on a single number, not on their mean" in report.conclusions[0]
    assert "a proof shows that 3d + 4 digits are enough" in report.conclusions[0]
    cost = dict(report.tables[-1].rows)
    assert float(cost["sixteen digits"]) == pytest.approx(3.6, abs=0.3)


def test_report_says_that_sixteen_digits_missed_a_wrong_decision() -> None:
    (conclusion, *_) = study.report(study.plan(), Rows(double_caught=0)).conclusions
    assert "Sixteen digits noticed 0.0 (" in conclusion
    assert "proved" not in conclusion

"""What a study ends in: tables, charts, a paragraph of plain words; and the files they are written to."""

from __future__ import annotations

import textwrap
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from modern.study.charts import Bars, Chart, Place, Series
from modern.study.files import put
from modern.study.filing import DETERMINED, OUTCOMES
from modern.study.plan import Plan
from modern.study.statistics import Interval, wilson
from modern.study.store import Store
from modern.study.tables import Table, percent


@dataclass(frozen=True, slots=True)
class Report:
    """The result of a study.

    tables: the first is the main one and is named ``table``.  charts: drawn by :mod:`modern.study.plots`.  words: a
    paragraph or more in plain words, with intervals, every number computed from the rows.
    """

    tables: tuple[Table, ...]
    charts: tuple[Chart, ...]
    words: tuple[str, ...]


def outcome_report(plan: Plan, store: Store) -> Report:
    """The report of a study that brings none of its own: how often each outcome, by cell and route."""
    counts = store.counts("cell", "route", "outcome")
    totals: Counter[tuple[int, str]] = Counter()
    for (cell, route, _), n in counts.items():
        totals[cell, route] += n
    seen = [outcome for outcome in OUTCOMES if any(key[2] == outcome for key in counts)]
    rows: list[tuple[str, ...]] = []
    series: dict[str, list[tuple[Place, Interval]]] = {}
    words: list[str] = []
    for number, cell in enumerate(plan.cells):
        for route in cell.routes:
            of = totals[number, route.name]
            found = sum(counts.get((number, route.name, outcome), 0) for outcome in DETERMINED)
            share = wilson(found, of)
            each = [str(counts.get((number, route.name, outcome), 0)) for outcome in seen]
            rows.append((cell.name, route.name, str(of), *each, percent(share)))
            series.setdefault(route.name, []).append((cell.name or "all", share))
            where = f"{cell.name}, " if cell.name else ""
            words.append(f"{where}{route.name}: the hull was found for {found} of {of} sets, {percent(share)}.")
    table = Table("table", plan.title, ("cell", "route", "sets", *seen, "hull found"), tuple(rows), INTERVALS)
    chart = Bars(
        "outcomes",
        plan.title,
        "",
        "hull found, of all sets",
        tuple(Series(name, tuple(points)) for name, points in series.items()),
        percent=True,
    )
    return Report((table,), (chart,), (" ".join(words),))


INTERVALS = ("In brackets: 95 % intervals, of proportions by Wilson's formula.",)


def write_report(folder: Path, plan: Plan, report: Report, plotted: bool) -> None:
    """Tables (``table.md``, ``NAME.csv``) and ``report.md`` to a study's folder.  Raises StudyFileError."""
    put(folder / "table.md", "\n".join(table.markdown() for table in report.tables))
    for table in report.tables:
        put(folder / f"{table.name}.csv", table.csv())
    parts = [f"# {plan.title}", plan.question, *report.words]
    if plotted:
        parts += [f"![{chart.title}]({chart.name}.svg)" for chart in report.charts]
    parts += [table.markdown().rstrip("\n") for table in report.tables]
    put(folder / "report.md", "\n\n".join(parts) + "\n")


def spoken(report: Report) -> str:
    """The main table and the words, for a terminal."""
    words = [textwrap.fill(paragraph, 100) for paragraph in report.words]
    return "\n".join([report.tables[0].text(), *(f"{paragraph}\n" for paragraph in words)])

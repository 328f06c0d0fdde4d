"""What a study ends in: tables, charts and a few sentences, as data; the texts and files they become."""

from __future__ import annotations

import csv
import io
import textwrap
from collections.abc import Iterable
from dataclasses import dataclass, field
from math import isinf
from pathlib import Path

from modern.study.plan import Plan
from modern.study.statistics import Interval, exact
from modern.study.store import Store, put
from modern.study.summary import summary

_NUMERIC = frozenset("0123456789.+-%eE to(),")
INTERVALS = ("In brackets: exact 95 % intervals of proportions (Clopper and Pearson).",)


@dataclass(frozen=True, slots=True)
class Table:
    """Named columns and rows of text; ``name`` is its file's (``table`` for the main one), ``notes`` stand below."""

    name: str
    title: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    notes: tuple[str, ...] = ()

    def text(self) -> str:
        """Aligned columns, numbers to the right."""
        widths = [max(len(row[k]) for row in (self.head, *self.rows)) for k in range(len(self.head))]
        right = self._right()
        lines = [
            "  ".join(
                cell.rjust(width) if aside else cell.ljust(width)
                for cell, width, aside in zip(row, widths, right, strict=True)
            ).rstrip()
            for row in (self.head, *self.rows)
        ]
        return "\n".join([self.title, *lines, *self.notes]) + "\n"

    def csv(self) -> str:
        """The rows under their heads; no title, no notes."""
        file = io.StringIO()
        csv.writer(file, lineterminator="\n").writerows([self.head, *self.rows])
        return file.getvalue()

    def markdown(self) -> str:
        """A table of Markdown under its title in bold."""
        rule = ["--:" if aside else ":--" for aside in self._right()]
        lines = ["| " + " | ".join(c.replace("|", "\\|") for c in row) + " |" for row in (self.head, rule, *self.rows)]
        return "\n".join([f"**{self.title}**", "", *lines, *(f"\n{note}" for note in self.notes)]) + "\n"

    def _right(self) -> list[bool]:
        return [
            any(row[k] for row in self.rows) and all(set(row[k]) <= _NUMERIC for row in self.rows)
            for k in range(len(self.head))
        ]


def percent(share: Interval) -> str:
    """A proportion with its interval, in percent: ``2.9 (0.8 to 9.8) %``."""
    digits = 1 if share.high >= 0.1 else 2 if share.high >= 0.01 else 3
    return f"{100 * share.value:.{digits}f} ({100 * share.low:.{digits}f} to {100 * share.high:.{digits}f}) %"


def with_interval(estimate: Interval, digits: int = 2) -> str:
    """An estimate with its interval: ``1.43 (1.38 to 1.48)``; of one value alone, which has none, the value."""
    if isinf(estimate.high):
        return f"{estimate.value:.{digits}f}"
    return f"{estimate.value:.{digits}f} ({estimate.low:.{digits}f} to {estimate.high:.{digits}f})"


Place = str | float


def share_of(hits: int, of: int) -> str:
    """A count of a total, with the proportion: ``3 of 40, 7.5 (2.6 to 19.9) %``; of none, ``0 of 0``."""
    return f"{hits:,} of {of:,}" + (f", {percent(exact(hits, of))}" if of else "")


def listed(items: Iterable[object]) -> str:
    """``a; b; c``; ``none`` where there are no items."""
    return "; ".join(map(str, items)) or "none"


def powers(exponents: Iterable[int]) -> str:
    """Powers of ten by their exponents, which rise: ``10^-6 to 10^-3, 10^1``; ``none`` where there are none."""
    runs: list[tuple[int, int]] = []
    for number in exponents:
        if runs and runs[-1][1] + 1 == number:
            runs[-1] = runs[-1][0], number
        else:
            runs.append((number, number))
    return ", ".join(f"10^{a}" if a == b else f"10^{a} to 10^{b}" for a, b in runs) or "none"


@dataclass(frozen=True, slots=True)
class Series:
    """Values with intervals over places: names of bars, or numbers on the axis of x."""

    name: str
    points: tuple[tuple[Place, Interval], ...]


@dataclass(frozen=True, slots=True)
class Mark:
    """A value to compare with: a line across the chart at x (``upright``) or at y, with its words in the legend."""

    at: float
    words: str
    upright: bool = False


@dataclass(frozen=True, slots=True)
class Chart:
    """What bars and lines have in common.

    name: the file's.  x and y: the axes' words, with units.  percent: values are proportions, shown in percent.
    marks: values to compare with.
    """

    name: str
    title: str
    x: str
    y: str
    series: tuple[Series, ...]
    percent: bool = False
    marks: tuple[Mark, ...] = field(default=())
    note: str = ""


@dataclass(frozen=True, slots=True)
class Bars(Chart):
    """Bars side by side over named places; ``at`` of an upright mark counts the places from 0."""


@dataclass(frozen=True, slots=True)
class Lines(Chart):
    """Values over numbers, joined by lines, intervals as bars; either axis may be logarithmic.

    powers: the numbers on the axis of x are exponents of ten.
    """

    log_x: bool = False
    log_y: bool = False
    powers: bool = False


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
    found = summary(store)
    seen = found.seen()
    rows: list[tuple[str, ...]] = []
    series: dict[str, list[tuple[Place, Interval]]] = {}
    for number, cell in enumerate(plan.cells):
        for route in cell.routes:
            share = found.share(number, route.name)
            each = [str(found.hits(number, route.name, (outcome,))) for outcome in seen]
            rows.append((cell.name, route.name, str(found.of(number, route.name)), *each, percent(share)))
            series.setdefault(route.name, []).append((cell.name or "all", share))
    table = Table("table", plan.title, ("cell", "route", "sets", *seen, "hull found"), tuple(rows), INTERVALS)
    chart = Bars(
        "outcomes",
        plan.title,
        "",
        "hull found, of all sets",
        tuple(Series(name, tuple(points)) for name, points in series.items()),
        percent=True,
    )
    return Report((table,), (chart,), ())


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

"""Reports of studies: tables, charts and sentences as data, and the texts and files made from them."""

import re
import textwrap
from collections.abc import Iterable
from dataclasses import dataclass
from math import isinf
from pathlib import Path

from modern.formats.columns import aligned, csv_text
from modern.study.plan import Plan
from modern.study.statistics import Interval, exact
from modern.study.store import Store, put
from modern.study.summary import summary

_RAISED = str.maketrans("0123456789-+dk", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺ᵈᵏ")
_NUMBER = r"[\N{MINUS SIGN}\d.,]+"
# Matches an estimate with its interval, an interval alone, each with or without a percent sign, or a percentage.
_TOGETHER = re.compile(rf"(?:{_NUMBER} )?\({_NUMBER} to {_NUMBER}\)(?: %| s\b)?|{_NUMBER} %")
_NUMERIC = frozenset("0123456789.+-%eE to(),")
INTERVALS = ("The numbers in parentheses are exact 95 % intervals of proportions (Clopper and Pearson).",)


@dataclass(frozen=True, slots=True)
class Table:
    """A table with notes printed below. ``name`` is the name of its file.  The main table is called ``table``."""

    name: str
    title: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    notes: tuple[str, ...] = ()

    def text(self) -> str:
        """Return the table with aligned columns, numbers to the right."""
        lines = aligned((self.head, *self.rows), self._numeric())
        return "\n".join([self.title, *lines, *self.notes]) + "\n"

    def csv(self) -> str:
        return csv_text([self.head, *self.rows])

    def markdown(self) -> str:
        rule = ["--:" if is_numeric else ":--" for is_numeric in self._numeric()]
        head, *rows = ([unbroken(cell).replace("|", "\\|") for cell in row] for row in (self.head, *self.rows))
        lines = ["| " + " | ".join(row) + " |" for row in (head, rule, *rows)]
        notes = [f"\n{unbroken(note)}" for note in self.notes]
        return "\n".join([f"**{unbroken(self.title)}**", "", *lines, *notes]) + "\n"

    def _numeric(self) -> list[bool]:
        return [
            any(row[k] for row in self.rows) and all(set(row[k]) <= _NUMERIC for row in self.rows)
            for k in range(len(self.head))
        ]


def percent(share: Interval) -> str:
    """Format a proportion and its interval in percent: ``2.9 (0.8 to 9.8) %``."""
    digits = 1 if share.high >= 0.1 else 2 if share.high >= 0.01 else 3
    return f"{100 * share.value:.{digits}f} ({100 * share.low:.{digits}f} to {100 * share.high:.{digits}f}) %"


def row(*cells: object) -> tuple[str, ...]:
    """Return the cells of a row as texts. None becomes a dash, and an interval becomes a percentage with its bounds."""
    return tuple("-" if cell is None else percent(cell) if isinstance(cell, Interval) else str(cell) for cell in cells)


def with_interval(estimate: Interval, digits: int = 2) -> str:
    """Format an estimate and its interval: ``1.43 (1.38 to 1.48)``.

    If the interval is infinite, format the estimate alone.
    """
    if isinf(estimate.high):
        return f"{estimate.value:.{digits}f}"
    return f"{estimate.value:.{digits}f} ({estimate.low:.{digits}f} to {estimate.high:.{digits}f})"


Place = str | float


def typeset(text: str) -> str:
    """Return text with typographic characters: 10⁻³ for ``10^-3`` or ``1E-3``, and a minus sign before a number."""
    text = re.sub(r"(?<![\w.])(\d+\.?\d*)E([+-]?\d+)\b", _power, text)
    return re.sub(r"(?<![\w.)-])-(?=\.?\d)", "\N{MINUS SIGN}", raised(text))


def raised(text: str) -> str:
    """Return text with powers as superscripts: n² for ``n^2``."""
    return re.sub(r"(?<=\w)\^([+-]?\d+|[dk]\b)", lambda match: match[1].translate(_RAISED), text)


def _power(match: re.Match[str]) -> str:
    factor = "" if match[1] == "1" else f"{match[1]} \N{MULTIPLICATION SIGN} "
    return f"{factor}10^{match[2]}"


def unbroken(text: str) -> str:
    """Return a typeset text in which no line break can occur inside an interval."""
    return joined(typeset(text))


def joined(text: str) -> str:
    """Return a text with no-break spaces inside an estimate with its interval, and before a percent sign."""
    return _TOGETHER.sub(lambda match: match[0].replace(" ", "\N{NO-BREAK SPACE}"), text)


def share_of(hits: int, of: int) -> str:
    """Format a count, its total and the proportion: ``3 of 40, 7.5 (2.6 to 19.9) %``.

    If the total is 0, return ``0 of 0``.
    """
    return f"{hits:,} of {of:,}" + (f", {percent(exact(hits, of))}" if of else "")


def listed(items: Iterable[object]) -> str:
    """Return the items as one text, such as ``a; b; c``.  If there are no items, the text is ``none``."""
    return "; ".join(map(str, items)) or "none"


def powers(exponents: Iterable[int]) -> str:
    """Format powers of ten with ascending exponents: ``10^-6 to 10^-3, 10^1``, or ``none`` without exponents."""
    runs: list[tuple[int, int]] = []
    for number in exponents:
        if runs and runs[-1][1] + 1 == number:
            runs[-1] = runs[-1][0], number
        else:
            runs.append((number, number))
    return ", ".join(f"10^{a}" if a == b else f"10^{a} to 10^{b}" for a, b in runs) or "none"


@dataclass(frozen=True, slots=True)
class Series:
    """A series of a chart: its name, and its points.  A point is a pair: the name of a bar or a number x, and an
    interval.
    """

    name: str
    points: tuple[tuple[Place, Interval], ...]


@dataclass(frozen=True, slots=True)
class Mark:
    """A reference line: a vertical line at x = ``at`` if ``upright`` is true, otherwise a horizontal one at y = ``at``.

    label: the text that explains the line.
    """

    at: float
    label: str
    upright: bool = False


@dataclass(frozen=True, slots=True)
class Chart:
    """A chart, drawn as :class:`Bars` or :class:`Lines`.

    name: the name of its files without the ending.  x, y: the labels of the axes, with units.  percent: True if the
    values are proportions, which are shown in percent.  marks: reference lines.
    """

    name: str
    title: str
    x: str
    y: str
    series: tuple[Series, ...]
    percent: bool = False
    marks: tuple[Mark, ...] = ()
    note: str = ""


@dataclass(frozen=True, slots=True)
class Bars(Chart):
    """A chart of groups of bars.  An upright mark stands at the index of a group, counted from 0."""


@dataclass(frozen=True, slots=True)
class Lines(Chart):
    """A chart of values joined by lines, with error bars.

    log_x, log_y: True if the axis is logarithmic.  powers: True if the x values are exponents of ten.
    """

    log_x: bool = False
    log_y: bool = False
    powers: bool = False


@dataclass(frozen=True, slots=True)
class Report:
    """The tables (the main one first), the charts and the conclusions of a study, computed from its rows."""

    tables: tuple[Table, ...]
    charts: tuple[Chart, ...]
    conclusions: tuple[str, ...]


def outcome_report(plan: Plan, store: Store) -> Report:
    """Return the default report: the number of each outcome, by cell and route."""
    counts = summary(store)
    outcomes = counts.outcomes()
    rows: list[tuple[str, ...]] = []
    series: dict[str, list[tuple[Place, Interval]]] = {}
    for number, cell in enumerate(plan.cells):
        for route in cell.routes:
            share = counts.share(number, route.name)
            numbers = [counts.hits(number, route.name, (outcome,)) for outcome in outcomes]
            rows.append(row(cell.name, route.name, counts.of(number, route.name), *numbers, share))
            series.setdefault(route.name, []).append((cell.name or "all", share))
    table = Table("table", plan.title, ("cell", "route", "sets", *outcomes, "hull found"), tuple(rows), INTERVALS)
    chart = Bars(
        "outcomes",
        plan.title,
        "",
        "share of sets with the right hull",
        tuple(Series(name, tuple(points)) for name, points in series.items()),
        percent=True,
    )
    return Report((table,), (chart,), ())


def write_report(folder: Path, plan: Plan, report: Report, plotted: bool) -> None:
    """Write ``table.md``, a CSV file for each table, and ``report.md``.  Raise StudyFileError if that fails."""
    put(folder / "table.md", "\n".join(table.markdown() for table in report.tables))
    for table in report.tables:
        put(folder / f"{table.name}.csv", table.csv())
    put(folder / "report.md", markdown(plan.title, plan.question, report, plotted))


def markdown(title: str, question: str, report: Report, plotted: bool) -> str:
    """Return a report: the main conclusion, the question, the other conclusions, the plots and the tables."""
    finding, others = report.conclusions[:1], report.conclusions[1:]
    parts = [*map(unbroken, (*finding, f"**The question.** {question}", *others))]
    if plotted:
        parts += [f"![{chart.title}]({chart.name}.svg)" for chart in report.charts]
    parts += [table.markdown().rstrip("\n") for table in report.tables]
    return "\n\n".join([f"# {title}", *parts]) + "\n"


def terminal_text(report: Report) -> str:
    """Return the main table and the conclusions as text for a terminal."""
    paragraphs = [textwrap.fill(paragraph, 100) for paragraph in report.conclusions]
    return "\n".join([report.tables[0].text(), *(f"{paragraph}\n" for paragraph in paragraphs)])

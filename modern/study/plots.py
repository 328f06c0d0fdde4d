"""Charts drawn with matplotlib, as SVG and PNG, in one style that can be read in grey.

Series differ in grey, hatching, line and mark, never in colour alone.  The same chart gives the same file: no date,
no random identifiers.
"""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

from modern.study.plan import PlanError
from modern.study.report import Bars, Chart, Lines, Series
from modern.study.store import put

GREYS = ("0.5", "0.8", "0.95", "0.65", "0.88", "0.35")
"""Of bars: light enough that the interval shows on them."""
DARKS = ("0.1", "0.45", "0.3", "0.6")
HATCHES = ("", "", "", "///", "...", "xxx")
LINES = ("-", "--", ":", "-.", (0, (5, 1, 1, 1, 1, 1)), (0, (1, 3)))
_MANY_DECADES = 1e4
MARKERS = ("o", "s", "^", "D", "v", "x")
_CROWD = 4
"""Lines that still leave room for their legend."""
_WIDE = 20
"""Characters of a name of which four still stand beside each other."""
_STYLE: Any = {
    "font.size": 10,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.grid.axis": "y",
    "axes.axisbelow": True,
    "grid.color": "0.85",
    "grid.linewidth": 0.6,
    "legend.frameon": False,
    "svg.hashsalt": "hull1620",
    "svg.fonttype": "path",
    "figure.dpi": 100,
    "savefig.dpi": 160,
}
_PAPER = {"boxstyle": "square,pad=0.1", "facecolor": "white", "edgecolor": "none", "alpha": 0.8}
_NO_MATPLOTLIB = "plots need matplotlib: pip install 'hull1620[plot]'"


def can_plot() -> str:
    """Empty where plots can be drawn, else what is missing, in a line."""
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        return _NO_MATPLOTLIB
    return ""


def draw(chart: Chart, folder: Path) -> None:
    """Write ``NAME.svg`` and ``NAME.png``.  Raises StudyFileError, and PlanError without matplotlib."""
    try:
        import matplotlib
        from matplotlib.figure import Figure
    except ImportError:
        raise PlanError(_NO_MATPLOTLIB) from None
    with matplotlib.rc_context(_STYLE):
        figure = Figure(figsize=(7.5, 4.5), layout="constrained")
        axes = figure.add_subplot()
        if isinstance(chart, Lines):
            _lines(axes, chart)
        else:
            _bars(axes, chart)
        _frame(figure, axes, chart)
        for kind, metadata in (("svg", {"Date": None}), ("png", {"Software": None})):
            file = io.BytesIO()
            figure.savefig(file, format=kind, metadata=metadata)
            put(folder / f"{chart.name}.{kind}", file.getvalue())


def _frame(figure: Any, axes: Any, chart: Chart) -> None:
    from matplotlib.ticker import PercentFormatter

    axes.set_title(chart.title, loc="left", fontsize=11)
    axes.set_xlabel(chart.x)
    axes.set_ylabel(chart.y)
    if chart.percent:
        axes.yaxis.set_major_formatter(PercentFormatter(1.0, decimals=None))
    for mark in chart.marks:
        line = axes.axvline if mark.upright else axes.axhline
        line(mark.at, color="0.2", linewidth=1, linestyle=(0, (4, 2)))
        if mark.upright:
            where = {"xy": (mark.at, 1), "xycoords": ("data", "axes fraction"), "xytext": (4, -4), "va": "top"}
        else:
            side, end = (4, "left") if mark.left else (-4, "right")
            place = (0 if mark.left else 1, mark.at)
            where = {"xy": place, "xycoords": ("axes fraction", "data"), "xytext": (side, 3), "ha": end}
        axes.annotate(mark.words, textcoords="offset points", fontsize=9, bbox=_PAPER, **where)
    if len(chart.series) > 1 and (isinstance(chart, Bars) or len(chart.series) > _CROWD):
        # Bars, and many lines, leave no room for a legend among them.
        wide = max(len(series.name) for series in chart.series) > _WIDE
        figure.legend(loc="outside upper left", ncols=min(3 if wide else 4, len(chart.series)))
    elif len(chart.series) > 1:
        axes.legend(loc="best")
    if chart.note:
        figure.supxlabel(chart.note, x=0.01, ha="left", fontsize=8, color="0.3")


def _errors(series: Series) -> list[list[float]]:
    low = [max(0.0, estimate.value - estimate.low) for _, estimate in series.points]
    return [low, [max(0.0, estimate.high - estimate.value) for _, estimate in series.points]]


def _bars(axes: Any, chart: Chart) -> None:
    names = list(dict.fromkeys(place for series in chart.series for place, _ in series.points))
    width = 0.8 / len(chart.series)
    for k, series in enumerate(chart.series):
        middle = [names.index(place) - 0.4 + (k + 0.5) * width for place, _ in series.points]
        values = [estimate.value for _, estimate in series.points]
        axes.bar(
            middle,
            values,
            width,
            color=GREYS[k % len(GREYS)],
            edgecolor="0.1",
            linewidth=0.6,
            hatch=HATCHES[k % len(HATCHES)],
            label=series.name,
        )
        axes.errorbar(middle, values, _errors(series), fmt="none", ecolor="0.0", elinewidth=0.9, capsize=2.5)
    turned = max(map(len, map(str, names))) * len(names) > 70
    axes.set_xticks(range(len(names)), [str(name) for name in names], **_turn(turned))
    axes.set_ylim(bottom=0)


def _turn(turned: bool) -> dict[str, Any]:
    return {"rotation": 30, "ha": "right", "rotation_mode": "anchor"} if turned else {}


def _lines(axes: Any, chart: Lines) -> None:
    for k, series in enumerate(chart.series):
        axes.errorbar(
            [place for place, _ in series.points],
            [estimate.value for _, estimate in series.points],
            _errors(series),
            color=DARKS[k % len(DARKS)],
            linestyle=LINES[k % len(LINES)],
            marker=MARKERS[k % len(MARKERS)],
            markersize=4.5,
            linewidth=1.3,
            elinewidth=0.9,
            capsize=2.5,
            label=series.name,
        )
    if chart.log_x:
        axes.set_xscale("log")
        _plain_numbers(axes.xaxis)
    if chart.log_y:
        axes.set_yscale("log")
        _plain_numbers(axes.yaxis)


def _plain_numbers(axis: Any) -> None:
    """1, 2, 5, 10, 20 ... on a logarithmic axis of few decades, powers of ten only on a long one."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    low, high = axis.get_view_interval()
    few = low > 0 and high / low < _MANY_DECADES
    axis.set_major_locator(LogLocator(subs=(1, 2, 5) if few else (1,)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())

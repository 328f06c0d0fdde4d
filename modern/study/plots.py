"""Charts drawn with matplotlib, as SVG and PNG, in one style that can be read in colour and in grey.

Series differ in lightness, mark, line and hatching, never in hue alone, and none hides another
(:mod:`modern.study.layout`).  Names stand below the axes, never among the curves.  The same chart gives the same file:
no date, no random identifiers.
"""

from __future__ import annotations

import io
import textwrap
from math import ceil, isfinite
from pathlib import Path
from typing import Any

from modern.study.layout import WIDTH, names, number, panels, steps, typeset, values
from modern.study.plan import PlanError
from modern.study.report import Bars, Chart, Lines, Series
from modern.study.store import put

COLOURS = ("#16164d", "#e8862e", "#1f6e43", "#8fbfe8", "#8c1c2b", "#4a7fc1")
"""Of lines; no two of one lightness, and each far from the one before it."""
MARKERS = ("o", "s", "^", "D", "v", "X")
LINES = ("-", "--", "-.", (0, (5, 1, 1, 1, 1, 1)), (0, (1, 1.5)), (0, (8, 2)))
FILLS = ("#6f8fc9", "#f6cf9a", "#ffffff", "#b9d8c2", "#dfe6f3", "#d98f86")
"""Of bars: light enough that the interval shows on them."""
HATCHES = ("", "", "", "///", "...", "xxx")
_PALE = "0.8"
_MARK: Any = {"color": "0.2", "linewidth": 1, "linestyle": (0, (4, 2)), "zorder": 1.5}
_MANY_DECADES = 1e4
_ROW = 0.17
"""Inches of a bar that lies."""
_NOTE = 0.22
"""Inches at the foot for the note."""
_WRAPPED = 14
"""Characters of a line below a bar, where names are longer."""
_STYLE: Any = {
    "font.size": 10,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.grid.axis": "y",
    "axes.axisbelow": True,
    "grid.color": "0.88",
    "grid.linewidth": 0.6,
    "legend.frameon": False,
    "hatch.linewidth": 0.6,
    "svg.hashsalt": "hull1620",
    "svg.fonttype": "path",
    "figure.dpi": 100,
    "savefig.dpi": 160,
}
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
    except ImportError:
        raise PlanError(_NO_MATPLOTLIB) from None
    with matplotlib.rc_context(_STYLE):
        figure = drawn(chart)
        for kind, metadata in (("svg", {"Date": None}), ("png", {"Software": None})):
            file = io.BytesIO()
            figure.savefig(file, format=kind, metadata=metadata)
            put(folder / f"{chart.name}.{kind}", file.getvalue())


def drawn(chart: Chart) -> Any:
    """The chart as a figure of matplotlib, which must be there."""
    from matplotlib.figure import Figure
    from matplotlib.layout_engine import ConstrainedLayoutEngine

    engine = ConstrainedLayoutEngine()
    figure: Any = Figure(figsize=(7.5, 4.7), layout=engine)
    figure.suptitle(typeset(chart.title), x=0.01, ha="left", fontsize=11)
    if panels(chart):
        _panels(figure, chart)
    else:
        _together(figure.add_subplot(), chart)
    note = chart.note
    if isinstance(chart, Lines) and any(steps(chart)) and not panels(chart):
        note = "; ".join(filter(None, (note, "marks stand side by side about their place")))
    below = _NOTE / figure.get_figheight() if note else 0.0
    handles, labels = figure.axes[0].get_legend_handles_labels()
    marks = len(chart.marks)
    told = len(chart.series) == 1 or panels(chart)  # the title of the axes, or of the chart, says which series it is
    if marks or not told:
        handles, labels = ((p[:marks] if told else p[marks:] + p[:marks]) for p in (handles, labels))
        wide = max(map(len, labels)) > 20
        # The foot is the note's; a legend below the axes keeps above it.
        foot = 0.5 + below * figure.get_figheight() * 72 / 10
        columns = min(3 if wide else 4, len(labels))
        figure.legend(handles, labels, loc="outside lower center", ncols=columns, borderaxespad=foot)
    if note:
        engine.set(rect=(0, below, 1, 1 - below))
        figure.text(0.01, below / 3, typeset(note), fontsize=8, color="0.3")
    return figure


def _together(axes: Any, chart: Chart) -> None:
    """All series on one pair of axes."""
    _marks(axes, chart)
    if isinstance(chart, Lines):
        beside = steps(chart)
        for k, points in enumerate(beside):
            _line(axes, chart, k, points)
        _scales(axes, chart, max(beside, default=0.0) / WIDTH)
    else:
        _standing(axes, chart)
    axes.set_xlabel(typeset(chart.x))
    axes.set_ylabel(typeset(chart.y))


def _panels(figure: Any, chart: Chart) -> None:
    """A pair of axes for each series, all with the same scales; lines with the others pale behind."""
    across = 3 if len(chart.series) > 4 else 2
    down = ceil(len(chart.series) / across)
    high = max(1.7, _ROW * len(names(chart))) if isinstance(chart, Bars) else 1.7
    figure.set_size_inches(7.5, 1.2 + high * down)
    grid = figure.subplots(down, across, sharex=True, sharey=True, squeeze=False)
    for k, axes in enumerate(grid.flat):
        if k >= len(chart.series):
            axes.set_axis_off()
            continue
        _marks(axes, chart, turned=isinstance(chart, Bars))
        axes.set_title(typeset(chart.series[k].name), loc="left", fontsize=9)
        if isinstance(chart, Lines):
            for series in (one for one in chart.series if one is not chart.series[k]):
                _pale(axes, series)
            _line(axes, chart, k, 0.0)
            _scales(axes, chart)
        else:
            _lying(axes, chart, k)
        below = k + across >= len(chart.series)
        axes.tick_params(labelbottom=below)
        words = (chart.y, chart.x) if isinstance(chart, Bars) else (chart.x, chart.y)
        if below and (k % across == across // 2 or k == len(chart.series) - 1 < across // 2):
            axes.set_xlabel(typeset(words[0]))
    figure.supylabel(typeset(chart.x if isinstance(chart, Bars) else chart.y), fontsize=10)


def _marks(axes: Any, chart: Chart, turned: bool = False) -> None:
    for mark in chart.marks:
        line = axes.axvline if mark.upright != turned else axes.axhline
        line(mark.at, label=typeset(mark.words), **_MARK)


def _errors(series: Series) -> list[list[float]]:
    low = [max(0.0, e.value - e.low) if isfinite(e.low) else 0.0 for _, e in series.points]
    return [low, [max(0.0, e.high - e.value) if isfinite(e.high) else 0.0 for _, e in series.points]]


def _line(axes: Any, chart: Lines, k: int, beside: float) -> None:
    """A series' line, marks and intervals, ``beside`` points of print to the right of their places."""
    from matplotlib.transforms import ScaledTranslation

    series, colour = chart.series[k], COLOURS[k % len(COLOURS)]
    where = axes.transData + ScaledTranslation(beside / 72, 0, axes.figure.dpi_scale_trans)
    axes.errorbar(
        [place for place, _ in series.points],
        [estimate.value for _, estimate in series.points],
        _errors(series),
        color=colour,
        linestyle=LINES[k % len(LINES)],
        marker=MARKERS[k % len(MARKERS)],
        markersize=4.8,
        markeredgecolor="0.1",
        markeredgewidth=0.6,
        linewidth=1.4,
        elinewidth=0.9,
        capsize=2,
        label=typeset(series.name),
        transform=where,
    )


def _pale(axes: Any, series: Series) -> None:
    places = [place for place, _ in series.points]
    axes.plot(places, [e.value for _, e in series.points], color=_PALE, linewidth=1, zorder=1.2)


def _scales(axes: Any, chart: Lines, more: float = 0.0) -> None:
    """Both axes from the values themselves; ``more`` is the part of the width that marks beside their places need."""
    places = [float(place) for series in chart.series for place, _ in series.points]
    places += [mark.at for mark in chart.marks if mark.upright]
    if found := _range(places, chart.log_x, more):
        axes.set_xscale("log" if chart.log_x else "linear")
        axes.set_xlim(*found)
        whole = all(value == int(value) for value in places)
        _numbers(axes.xaxis, found, chart.log_x, chart.powers, False, whole)
    if found := _range(values(chart), chart.log_y):
        axes.set_yscale("log" if chart.log_y else "linear")
        axes.set_ylim(*found)
        _numbers(axes.yaxis, found, chart.log_y, False, chart.percent, False)


def _range(numbers: list[float], logarithmic: bool, more: float = 0.0) -> tuple[float, float] | None:
    """From the least to the greatest with a margin; None where there is none."""
    finite = [value for value in numbers if isfinite(value) and (value > 0 or not logarithmic)]
    if not finite:
        return None
    low, high = min(finite), max(finite)
    if logarithmic:
        part = (high / low) ** (0.04 + more) if high > low else 2.0
        return low / part, high * part
    part = (0.04 + more) * (high - low) or 0.5
    return low - part, high + part


def _numbers(axis: Any, ends: tuple[float, float], logarithmic: bool, powers: bool, percent: bool, whole: bool) -> None:
    """1, 2, 5, 10, 20 ... on a logarithmic axis of few decades, powers of ten only on a long one."""
    from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter

    if logarithmic:
        few = ends[1] / ends[0] < _MANY_DECADES
        axis.set_major_locator(LogLocator(subs=(1, 2, 5) if few else (1,)))
        axis.set_minor_formatter(NullFormatter())
    else:
        axis.set_major_locator(MaxNLocator("auto", integer=whole, steps=[1, 2, 5, 10]))
    axis.set_major_formatter(FuncFormatter(lambda value, _: number(value, percent, powers)))


def _standing(axes: Any, chart: Chart) -> None:
    """Bars side by side at each place."""
    from matplotlib.ticker import FuncFormatter

    found = names(chart)
    width = 0.8 / len(chart.series)
    for k, series in enumerate(chart.series):
        middle = [found.index(str(place)) - 0.4 + (k + 0.5) * width for place, _ in series.points]
        heights = [estimate.value for _, estimate in series.points]
        axes.bar(middle, heights, width, label=typeset(series.name), **_fill(k))
        axes.errorbar(middle, heights, _errors(series), **_WHISKERS)
    shown = [typeset(name) for name in found]
    if sum(map(len, shown)) > 70:
        shown = [textwrap.fill(name, _WRAPPED) for name in shown]
    axes.set_xticks(range(len(found)), shown)
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: number(value, chart.percent)))
    axes.set_ylim(bottom=0)


def _lying(axes: Any, chart: Chart, k: int) -> None:
    """One series' bars, one below another."""
    from matplotlib.ticker import FuncFormatter, MaxNLocator

    found, series = names(chart), chart.series[k]
    middle = [found.index(str(place)) for place, _ in series.points]
    lengths = [estimate.value for _, estimate in series.points]
    axes.barh(middle, lengths, 0.7, label=typeset(series.name), **_fill(k))
    axes.errorbar(lengths, middle, xerr=_errors(series), **_WHISKERS)
    axes.set_yticks(range(len(found)), [typeset(name) for name in found], fontsize=8)
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: number(value, chart.percent)))
    axes.xaxis.set_major_locator(MaxNLocator(2))
    axes.tick_params(axis="x", labelsize=8)
    axes.set_ylim(len(found) - 0.4, -0.6)
    axes.set_xlim(left=0)
    axes.grid(visible=False, axis="y")
    axes.grid(visible=True, axis="x")


_WHISKERS: Any = {"fmt": "none", "ecolor": "0.0", "elinewidth": 0.9, "capsize": 2}


def _fill(k: int) -> dict[str, Any]:
    return {
        "color": FILLS[k % len(FILLS)],
        "edgecolor": "0.1",
        "linewidth": 0.6,
        "hatch": HATCHES[k % len(HATCHES)],
    }

"""Draw charts with matplotlib as SVG and PNG, in one style that is legible in colour and in grey.

Series differ in lightness, marker, line style and hatching, never in hue alone, and none hides another
(:mod:`modern.study.layout`).  The legend is below the axes, never among the curves.  Equal charts give equal files,
which contain no date and no random identifiers.
"""

import io
import textwrap
from math import ceil, isfinite
from pathlib import Path
from typing import Any

from modern.study.layout import WIDTH, names, number, panels, steps, typeset, values
from modern.study.plan import PlanError
from modern.study.report import Bars, Chart, Lines, Series
from modern.study.store import put

# The colours of lines; each differs in lightness from all others, and most from its predecessor.
COLOURS = ("#16164d", "#e8862e", "#1f6e43", "#8fbfe8", "#8c1c2b", "#4a7fc1")
MARKERS = ("o", "s", "^", "D", "v", "X")
LINES = ("-", "--", "-.", (0, (5, 1, 1, 1, 1, 1)), (0, (1, 1.5)), (0, (8, 2)))
# The colours of bars, light enough to show the error bars on them.
FILLS = ("#6f8fc9", "#f6cf9a", "#ffffff", "#b9d8c2", "#dfe6f3", "#d98f86")
HATCHES = ("", "", "", "///", "...", "xxx")
_PALE = "0.8"
_MARK: Any = {"color": "0.2", "linewidth": 1, "linestyle": (0, (4, 2)), "zorder": 1.5}
_MANY_DECADES = 1e4
# The height of a horizontal bar, in inches.
_ROW = 0.17
# The height of the note at the bottom, in inches.
_NOTE = 0.22
# If the names below bars must be wrapped, their lines have at most this number of characters.
_WRAPPED = 14
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
    """Return an empty text if plots can be drawn, otherwise a line that says which package is missing."""
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        return _NO_MATPLOTLIB
    return ""


def draw(chart: Chart, folder: Path) -> None:
    """Write ``NAME.svg`` and ``NAME.png``.  Raise StudyFileError if that fails, PlanError without matplotlib."""
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
    """Return the chart as a figure of matplotlib, which must be installed."""
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
        note = "; ".join(filter(None, (note, "markers at the same x are shifted sideways")))
    below = _NOTE / figure.get_figheight() if note else 0.0
    handles, labels = figure.axes[0].get_legend_handles_labels()
    marks = len(chart.marks)
    # A single series is named by the title of the chart, a series in a panel by the title of the panel.
    titled = len(chart.series) == 1 or panels(chart)
    if marks or not titled:
        # matplotlib lists marks before series; the legend shows them after series.
        handles, labels = ((p[:marks] if titled else p[marks:] + p[:marks]) for p in (handles, labels))
        has_long_labels = max(map(len, labels)) > 20
        # The legend is placed above the note.
        padding = 0.5 + below * figure.get_figheight() * 72 / 10
        columns = min(3 if has_long_labels else 4, len(labels))
        figure.legend(handles, labels, loc="outside lower center", ncols=columns, borderaxespad=padding)
    if note:
        engine.set(rect=(0, below, 1, 1 - below))
        figure.text(0.01, below / 3, typeset(note), fontsize=8, color="0.3")
    return figure


def _together(axes: Any, chart: Chart) -> None:
    _marks(axes, chart)
    if isinstance(chart, Lines):
        shifts = steps(chart)
        for k, shift in enumerate(shifts):
            _line(axes, chart, k, shift)
        _scales(axes, chart, max(shifts, default=0.0) / WIDTH)
    else:
        _standing(axes, chart)
    axes.set_xlabel(typeset(chart.x))
    axes.set_ylabel(typeset(chart.y))


def _panels(figure: Any, chart: Chart) -> None:
    """Draw each series on separate axes with the same scales.  In a line chart the others appear in grey behind it."""
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
            for series in chart.series[:k] + chart.series[k + 1 :]:
                _pale(axes, series)
            _line(axes, chart, k, 0.0)
            _scales(axes, chart)
        else:
            _lying(axes, chart, k)
        below = k + across >= len(chart.series)
        axes.tick_params(labelbottom=below)
        # The x label is written once, below the middle panel of the lowest row.
        if below and (k % across == across // 2 or k == len(chart.series) - 1 < across // 2):
            axes.set_xlabel(typeset(chart.y if isinstance(chart, Bars) else chart.x))
    figure.supylabel(typeset(chart.x if isinstance(chart, Bars) else chart.y), fontsize=10)


def _marks(axes: Any, chart: Chart, turned: bool = False) -> None:
    for mark in chart.marks:
        line = axes.axvline if mark.upright != turned else axes.axhline
        line(mark.at, label=typeset(mark.label), **_MARK)


def _errors(series: Series) -> list[list[float]]:
    low = [max(0.0, e.value - e.low) if isfinite(e.low) else 0.0 for _, e in series.points]
    return [low, [max(0.0, e.high - e.value) if isfinite(e.high) else 0.0 for _, e in series.points]]


def _line(axes: Any, chart: Lines, k: int, shift: float) -> None:
    """Draw the line, markers and error bars of a series, shifted by that many points to the right."""
    from matplotlib.transforms import ScaledTranslation

    series, colour = chart.series[k], COLOURS[k % len(COLOURS)]
    shifted = axes.transData + ScaledTranslation(shift / 72, 0, axes.figure.dpi_scale_trans)
    axes.errorbar(
        [x for x, _ in series.points],
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
        transform=shifted,
    )


def _pale(axes: Any, series: Series) -> None:
    axes.plot([x for x, _ in series.points], [e.value for _, e in series.points], color=_PALE, linewidth=1, zorder=1.2)


def _scales(axes: Any, chart: Lines, margin: float = 0.0) -> None:
    positions = [float(x) for series in chart.series for x, _ in series.points]
    positions += [mark.at for mark in chart.marks if mark.upright]
    if limits := _range(positions, chart.log_x, margin):
        axes.set_xscale("log" if chart.log_x else "linear")
        axes.set_xlim(*limits)
        only_integers = all(x == int(x) for x in positions)
        _numbers(axes.xaxis, limits, chart.log_x, chart.powers, False, only_integers)
    if limits := _range(values(chart), chart.log_y):
        axes.set_yscale("log" if chart.log_y else "linear")
        axes.set_ylim(*limits)
        _numbers(axes.yaxis, limits, chart.log_y, False, chart.percent, False)


def _range(numbers: list[float], logarithmic: bool, margin: float = 0.0) -> tuple[float, float] | None:
    """Return the limits of an axis that shows these numbers with a margin; None if the axis can show none of them."""
    finite = [value for value in numbers if isfinite(value) and (value > 0 or not logarithmic)]
    if not finite:
        return None
    low, high = min(finite), max(finite)
    if logarithmic:
        factor = (high / low) ** (0.04 + margin) if high > low else 2.0
        return low / factor, high * factor
    extra = (0.04 + margin) * (high - low) or 0.5
    return low - extra, high + extra


def _numbers(
    axis: Any, limits: tuple[float, float], logarithmic: bool, powers: bool, percent: bool, only_integers: bool
) -> None:
    """Set the tick labels of an axis.  A logarithmic axis has 1, 2, 5, 10, 20 and so on, or powers of ten if long."""
    from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter

    if logarithmic:
        is_short = limits[1] / limits[0] < _MANY_DECADES
        axis.set_major_locator(LogLocator(subs=(1, 2, 5) if is_short else (1,)))
        axis.set_minor_formatter(NullFormatter())
    else:
        axis.set_major_locator(MaxNLocator("auto", integer=only_integers, steps=[1, 2, 5, 10]))
    axis.set_major_formatter(FuncFormatter(lambda value, _: number(value, percent, powers)))


def _standing(axes: Any, chart: Chart) -> None:
    from matplotlib.ticker import FuncFormatter

    groups = names(chart)
    width = 0.8 / len(chart.series)
    for k, series in enumerate(chart.series):
        middle = [groups.index(str(name)) - 0.4 + (k + 0.5) * width for name, _ in series.points]
        heights = [estimate.value for _, estimate in series.points]
        axes.bar(middle, heights, width, label=typeset(series.name), **_fill(k))
        axes.errorbar(middle, heights, _errors(series), **_WHISKERS)
    labels = [typeset(name) for name in groups]
    if sum(map(len, labels)) > 70:
        labels = [textwrap.fill(label, _WRAPPED) for label in labels]
    axes.set_xticks(range(len(groups)), labels)
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: number(value, chart.percent)))
    axes.set_ylim(bottom=0)


def _lying(axes: Any, chart: Chart, k: int) -> None:
    from matplotlib.ticker import FuncFormatter, MaxNLocator

    groups, series = names(chart), chart.series[k]
    middle = [groups.index(str(name)) for name, _ in series.points]
    lengths = [estimate.value for _, estimate in series.points]
    axes.barh(middle, lengths, 0.7, label=typeset(series.name), **_fill(k))
    axes.errorbar(lengths, middle, xerr=_errors(series), **_WHISKERS)
    axes.set_yticks(range(len(groups)), [typeset(name) for name in groups], fontsize=8)
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: number(value, chart.percent)))
    axes.xaxis.set_major_locator(MaxNLocator(2))
    axes.tick_params(axis="x", labelsize=8)
    axes.set_ylim(len(groups) - 0.4, -0.6)
    axes.set_xlim(left=0)
    axes.grid(visible=False, axis="y")
    axes.grid(visible=True, axis="x")


_WHISKERS: Any = {"fmt": "none", "ecolor": "0.0", "elinewidth": 0.9, "capsize": 2}


def _fill(k: int) -> dict[str, Any]:
    return {"color": FILLS[k % len(FILLS)], "edgecolor": "0.1", "linewidth": 0.6, "hatch": HATCHES[k % len(HATCHES)]}

"""Draw charts with matplotlib as SVG and PNG, in the type and the colours of the edition.

Series differ in lightness, marker, line style and hatching, never in hue alone, and none hides another
(:mod:`modern.study.layout`).  Every series and mark is labelled where it is drawn, so that no legend is needed.  In a
dark theme an SVG has dark colours.  Equal charts give equal files, which contain no date and no random identifiers.
"""

import io
import textwrap
from collections.abc import Sequence
from importlib.resources import as_file, files
from importlib.util import find_spec
from math import ceil, isfinite
from pathlib import Path
from typing import Any

from modern.study.layout import WIDTH, names, number, panels, steps, values
from modern.study.plan import PlanError
from modern.study.report import Bars, Chart, Lines, Series, typeset
from modern.study.store import put

INK, QUIET, PAPER, RULE = "#211e19", "#5d564b", "#fdfcf8", "#d8d1c1"
# The colours of lines; each differs in lightness from all others.
COLOURS = (INK, "#c4553a", "#b9a982", "#5f4f8f", "#8fa85f", "#7d7567")
# The dark theme's replacements for colours that would not be legible on its background.
DARK = {
    INK: "#e8e3d8",
    QUIET: "#b3ab9c",
    PAPER: "#17181a",
    RULE: "#3f3c35",
    "#5f4f8f": "#a493d6",
    "#c4553a": "#ff9d80",
    "#7d7567": "#9b9384",
    "#cbc3b2": "#544b37",
    # Fills of bars: dark enough that hatching and error bars, which become light, are seen on them.
    "#bbab85": "#75694e",
    "#f7d8cd": "#7a3d2c",
    "#dbe7c8": "#46592f",
    "#e4dcf0": "#4f4273",
    "#d9cba8": "#544b37",
}
MARKERS = ("o", "s", "^", "D", "v", "X")
LINES = ("-", "--", "-.", (0, (5, 1, 1, 1, 1, 1)), (0, (1, 1.5)), (0, (8, 2)))
# The colours of bars, which the site uses for cards and readings too.  They are light enough to show error bars.
FILLS = ("#bbab85", "#f7d8cd", "#fdfcf8", "#dbe7c8", "#e4dcf0", "#d9cba8")
HATCHES = ("", "", "", "///", "...", "xxx")
_PALE = "#cbc3b2"
_MARK: Any = {"color": QUIET, "linewidth": 1, "linestyle": (0, (4, 2)), "zorder": 1.5}
_MANY_DECADES = 1e4
# The height of a horizontal bar, in inches.
_ROW = 0.17
# The height of the note at the bottom, in inches.
_NOTE = 0.22
# The number of characters that fit side by side below bars. If the names of groups are longer, they are wrapped.
_ACROSS = 84
# For the labels of series: the most characters in a line, and the height of a line as a share of that of the axes.
_LABEL, _LINE_HEIGHT = 20, 0.052
# For upright names of series: the width of a letter as a share of the height of the axes.
_LETTER = 0.021
_STYLE: Any = {
    "font.family": ["IBM Plex Sans", "DejaVu Sans"],
    "font.size": 10,
    **dict.fromkeys(("text.color", "axes.labelcolor", "axes.edgecolor", "xtick.color", "ytick.color"), INK),
    "figure.facecolor": PAPER,
    "savefig.facecolor": PAPER,
    "axes.facecolor": "none",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.grid.axis": "y",
    "axes.axisbelow": True,
    "grid.color": RULE,
    "grid.linewidth": 0.6,
    "hatch.linewidth": 0.6,
    "svg.hashsalt": "hull1620",
    "svg.fonttype": "path",
    "figure.dpi": 100,
    "savefig.dpi": 160,
}


def can_plot() -> str:
    """Return an empty text if plots can be drawn, otherwise a line that says which package is missing."""
    return "" if find_spec("matplotlib") else "plots need matplotlib: pip install 'hull1620[plot]'"


def draw(chart: Chart, folder: Path, kinds: Sequence[str] = ("svg", "png")) -> None:
    """Write ``NAME.svg`` and ``NAME.png``.  Raise StudyFileError if that fails, PlanError without matplotlib."""
    if problem := can_plot():
        raise PlanError(problem)
    import matplotlib

    with matplotlib.rc_context(_STYLE):
        figure = drawn(chart)
        for kind in kinds:
            file = io.BytesIO()
            metadata = {"Date": None} if kind == "svg" else {"Software": None}
            # An SVG has no background, so the colour of the page shows through: white if the page is printed.
            figure.savefig(file, format=kind, metadata=metadata, facecolor="none" if kind == "svg" else PAPER)
            put(folder / f"{chart.name}.{kind}", _themed(file.getvalue()) if kind == "svg" else file.getvalue())


def _themed(svg: bytes) -> bytes:
    rules = "".join(
        # The ground of a hatched bar has its colour in an attribute.
        f'[style*="{kind}: {light}"],[{kind}="{light}"]{{{kind}:{dark}!important}}'
        for light, dark in DARK.items()
        for kind in ("fill", "stroke")
    )
    rules = f":root{{color-scheme: light dark}}@media (prefers-color-scheme: dark){{{rules}}}"
    return svg.replace(b"</defs>", f' <style type="text/css">{rules}</style>\n </defs>'.encode(), 1)


def drawn(chart: Chart) -> Any:
    """Return the chart as a figure of matplotlib, which must be installed."""
    from matplotlib.figure import Figure
    from matplotlib.font_manager import fontManager
    from matplotlib.layout_engine import ConstrainedLayoutEngine

    if _STYLE["font.family"][0] not in fontManager.get_font_names():
        with as_file(files("modern").joinpath("study", "fonts", "ibm-plex-sans-400.ttf")) as font:
            fontManager.addfont(str(font))
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
    if panels(chart):
        note = "; ".join(filter(None, (note, *(f"dashed line: {mark.label}" for mark in chart.marks))))
    below = _NOTE / figure.get_figheight() if note else 0.0
    if note:
        engine.set(rect=(0, below, 1, 1 - below))
        figure.text(0.01, below / 3, typeset(note), fontsize=8, color=QUIET)
    return figure


def _together(axes: Any, chart: Chart) -> None:
    _marks(axes, chart)
    if isinstance(chart, Lines):
        shifts = steps(chart)
        for k, shift in enumerate(shifts):
            _line(axes, chart, k, shift)
        _scales(axes, chart, max(shifts, default=0.0) / WIDTH)
        _name_lines(axes, chart)
    else:
        _standing(axes, chart)
    axes.set_xlabel(typeset(chart.x))
    axes.set_ylabel(typeset(chart.y))


def _panels(figure: Any, chart: Chart) -> None:
    """Draw each series on its own axes, with equal scales.  In a line chart the other series are behind it in grey."""
    across = 3 if len(chart.series) > 4 else 2
    down = ceil(len(chart.series) / across)
    high = max(1.7, _ROW * len(names(chart))) if isinstance(chart, Bars) else 1.7
    figure.set_size_inches(7.5, 1.2 + high * down)
    grid = figure.subplots(down, across, sharex=True, sharey=True, squeeze=False)
    for k, axes in enumerate(grid.flat):
        if k >= len(chart.series):
            axes.set_axis_off()
            continue
        _marks(axes, chart, turned=isinstance(chart, Bars), named=False)
        axes.set_title(typeset(chart.series[k].name), loc="left", fontsize=9)
        if isinstance(chart, Lines):
            for series in chart.series[:k] + chart.series[k + 1 :]:
                xs, ys = [x for x, _ in series.points], [e.value for _, e in series.points]
                axes.plot(xs, ys, color=_PALE, linewidth=1, zorder=1.2)
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


def _marks(axes: Any, chart: Chart, turned: bool = False, named: bool = True) -> None:
    for mark in chart.marks:
        upright = mark.upright != turned
        (axes.axvline if upright else axes.axhline)(mark.at, **_MARK)
        if not named:
            continue
        where: Any = (
            ((mark.at, 0.5), ("data", "axes fraction")) if upright else ((0.0, mark.at), ("axes fraction", "data"))
        )
        shift: Any = (
            {"xytext": (-3, 0), "ha": "right", "va": "center"} if upright else {"xytext": (4, 3), "va": "bottom"}
        )
        axes.annotate(
            typeset(mark.label),
            where[0],
            xycoords=where[1],
            textcoords="offset points",
            rotation=90 if upright else 0,
            **shift,
            **_SMALL,
        )


def _name_lines(axes: Any, chart: Lines) -> None:
    """Write the name of each series to the right of its last point.  Names that would overlap are moved apart."""
    if len(chart.series) < 2:
        return
    to_axes = axes.transData + axes.transAxes.inverted()
    ends = []
    for k, series in enumerate(chart.series):
        if series.points:
            x, estimate = series.points[-1]
            ends.append((float(to_axes.transform((x, estimate.value))[1]), k))
    names_of = [textwrap.fill(typeset(series.name), _LABEL) for series in chart.series]
    heights = [(names_of[k].count("\n") + 1) * _LINE_HEIGHT for _, k in sorted(ends)]
    places = _apart([height for height, _ in sorted(ends)], heights)
    for (_, k), place in zip(sorted(ends), places, strict=True):
        colour, marker = COLOURS[k % len(COLOURS)], MARKERS[k % len(MARKERS)]
        sign = {"color": colour, "marker": marker, "edgecolors": INK, "linewidths": 0.6, "s": 24}
        axes.scatter([1.035], [place], transform=axes.transAxes, clip_on=False, **sign)
        axes.text(1.06, place, names_of[k], transform=axes.transAxes, va="center", fontsize=9)


def _apart(preferred: Sequence[float], heights: Sequence[float]) -> list[float]:
    """Return ascending positions near the preferred ones at which labels of these heights do not overlap."""
    places: list[float] = []
    for k, place in enumerate(preferred):
        least = places[-1] + (heights[k - 1] + heights[k]) / 2 if places else 0.0
        places.append(max(place, least))
    most = 1.0
    for k in reversed(range(len(places))):
        places[k] = min(places[k], most)
        most = places[k] - (heights[k] + heights[k - 1]) / 2
    return places


def _errors(series: Series) -> list[list[float]]:
    low = [max(0.0, e.value - e.low) if isfinite(e.low) else 0.0 for _, e in series.points]
    return [low, [max(0.0, e.high - e.value) if isfinite(e.high) else 0.0 for _, e in series.points]]


def _line(axes: Any, chart: Lines, k: int, shift: float) -> None:
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
        markeredgecolor=INK,
        markeredgewidth=0.6,
        linewidth=1.4,
        elinewidth=0.9,
        capsize=2,
        transform=shifted,
    )


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
    """Return the limits of an axis with a margin around the numbers, or None if the axis can show no number."""
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
    """Set the tick labels of an axis.

    The labels of a logarithmic axis are 1, 2, 5, 10, 20 and so on, or only powers of ten if the axis is very long.
    """
    from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter

    if logarithmic:
        # Labels of more than five digits would touch each other.
        is_short = limits[1] / limits[0] < _MANY_DECADES and limits[1] < _MANY_DECADES * 10
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
        axes.bar(middle, heights, width, **_fill(k))
        axes.errorbar(middle, heights, _errors(series), **_WHISKERS)
    labels = [typeset(name) for name in groups]
    if sum(map(len, labels)) > 70:
        labels = [textwrap.fill(label, max(8, _ACROSS // len(groups)), break_long_words=False) for label in labels]
    axes.set_xticks(range(len(groups)), labels)
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: number(value, chart.percent)))
    top = max((e.high for series in chart.series for _, e in series.points), default=1.0)
    axes.set_ylim(0, top)
    if len(chart.series) > 1:
        _name_bars(axes, chart, width, top)


def _name_bars(axes: Any, chart: Chart, width: float, top: float) -> None:
    """Write the names of the series, rotated by 90 degrees, over the bars of the highest group, above all bars."""
    heights = {name: sum(e.value for s in chart.series for at, e in s.points if at == name) for name in names(chart)}
    left = list(heights).index(max(heights, key=lambda name: heights[name])) - 0.4
    axes.set_yticks([tick for tick in axes.get_yticks() if tick <= top])
    lines = [textwrap.fill(typeset(series.name), _LABEL) for series in chart.series]
    longest = max(len(line) for name in lines for line in name.split("\n"))
    axes.set_ylim(0, top / (1 - _LETTER * (longest + 2)))
    axes.spines["left"].set_bounds(0, top)
    above: Any = {"xytext": (0, 4), "textcoords": "offset points", "ha": "center", "va": "bottom"}
    for k, name in enumerate(lines):
        axes.annotate(name, (left + (k + 0.5) * width, top), rotation=90, **above, **_SMALL | {"bbox": None})


def _lying(axes: Any, chart: Chart, k: int) -> None:
    from matplotlib.ticker import FuncFormatter, MaxNLocator

    groups, series = names(chart), chart.series[k]
    middle = [groups.index(str(name)) for name, _ in series.points]
    lengths = [estimate.value for _, estimate in series.points]
    axes.barh(middle, lengths, 0.7, **_fill(k))
    axes.errorbar(lengths, middle, xerr=_errors(series), **_WHISKERS)
    axes.set_yticks(range(len(groups)), [typeset(name) for name in groups], fontsize=8)
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: number(value, chart.percent)))
    axes.xaxis.set_major_locator(MaxNLocator(2, steps=[1, 5, 10]))
    axes.tick_params(axis="x", labelsize=8)
    axes.set_ylim(len(groups) - 0.4, -0.6)
    axes.set_xlim(left=0)
    axes.grid(visible=False, axis="y")
    axes.grid(visible=True, axis="x")


_SMALL: Any = {
    "fontsize": 8.5,
    "color": INK,
    "bbox": {"facecolor": PAPER, "edgecolor": "none", "pad": 0.6},
    "zorder": 3,
}
_WHISKERS: Any = {"fmt": "none", "ecolor": INK, "elinewidth": 0.9, "capsize": 2}


def _fill(k: int) -> dict[str, Any]:
    return {"color": FILLS[k % len(FILLS)], "edgecolor": INK, "linewidth": 0.6, "hatch": HATCHES[k % len(HATCHES)]}

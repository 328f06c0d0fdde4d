"""Compute the layout of a chart before it is drawn, so that no series hides another.

Series with equal values are drawn side by side, shifted by a few typographic points.  If their x values are too close
for that, each series is drawn in a separate panel.
"""

from collections.abc import Sequence
from itertools import combinations, pairwise
from math import log

from modern.study.report import Bars, Chart, Lines, typeset

# The approximate size of the axes of a chart without panels, in typographic points.
WIDTH, HEIGHT = 430.0, 220.0
# The least distance, in points, at which two markers can be distinguished.
APART = 3.4
# At the same x, each series is shifted from the one before it by at most this number of points.
_WIDEST = 5.5
# The share of the distance between two x values that the markers at one of them may occupy.
_FILLED = 0.8
# A series counts as hidden if other series cover more than this share of its markers.
_HIDDEN = 1 / 3
# The greatest number of bars side by side in one chart.
_MANY_BARS = 40


def number(value: float, percent: bool = False, power: bool = False) -> str:
    """Format a number for the label of an axis, such as ``−1.5``.

    With ``percent``, .35 becomes ``35 %``.  With ``power``, -3 becomes 10⁻³.
    """
    text = f"10^{value:.10g}" if power else f"{100 * value:.10g} %" if percent else f"{value:.10g}"
    return typeset(text)


def names(chart: Chart) -> list[str]:
    return [str(name) for name in dict.fromkeys(name for series in chart.series for name, _ in series.points)]


def panels(chart: Chart) -> bool:
    """Return True if each series of the chart needs its own axes because series would hide each other."""
    if isinstance(chart, Bars):
        return len(chart.series) * len(names(chart)) > _MANY_BARS
    return isinstance(chart, Lines) and any(part > _HIDDEN for part in hidden(chart))


def steps(chart: Lines) -> tuple[float, ...]:
    """Return how far each series must be moved to the right so that no series hides another.

    The shifts are in typographic points, and as large as the gaps between the x values allow.
    """
    count = len(chart.series)
    positions = sorted({float(x) for series in chart.series for x, _ in series.points})
    gap = min((b - a for a, b in pairwise(_scaled(positions, WIDTH, chart.log_x))), default=WIDTH)
    step = min(_WIDEST, _FILLED * gap / count) if count and _nearest(chart) < APART else 0.0
    return tuple((k - (count - 1) / 2) * step for k in range(count))


def hidden(chart: Lines) -> tuple[float, ...]:
    """Return, for each series, the share of its markers that other series hide if all are drawn in one panel."""
    shifts = steps(chart)
    heights = _heights(chart)
    shares = []
    for k, own in enumerate(heights):
        covered = [
            any(
                x in others and ((shifts[k] - shifts[j]) ** 2 + (own[x] - others[x]) ** 2) ** 0.5 < APART
                for j, others in enumerate(heights)
                if j != k
            )
            for x in own
        ]
        shares.append(sum(covered) / len(covered) if covered else 0.0)
    return tuple(shares)


def values(chart: Chart) -> list[float]:
    """Return every value that the y axis has to show, including horizontal marks and the limits of intervals."""
    points = [e for series in chart.series for _, e in series.points]
    level = [mark.at for mark in chart.marks if not mark.upright]
    return [*level, *(value for e in points for value in (e.low, e.value, e.high))]


def _nearest(chart: Lines) -> float:
    pairs = combinations(_heights(chart), 2)
    return min((abs(a[x] - b[x]) for a, b in pairs for x in a.keys() & b.keys()), default=HEIGHT)


def _heights(chart: Lines) -> list[dict[float, float]]:
    """Return for each series the heights of its markers, in points, by x value."""
    ascending = sorted(set(values(chart)))
    height_of = dict(zip(ascending, _scaled(ascending, HEIGHT, chart.log_y), strict=True))
    return [{float(x): height_of[e.value] for x, e in series.points} for series in chart.series]


def _scaled(ascending: Sequence[float], size: float, logarithmic: bool) -> list[float]:
    scaled = list(ascending)
    if logarithmic:
        least = min((value for value in ascending if value > 0), default=1.0)
        scaled = [log(max(value, least)) for value in ascending]
    span = scaled[-1] - scaled[0] if scaled else 0.0
    return [(value - scaled[0]) / span * size if span else 0.0 for value in scaled]

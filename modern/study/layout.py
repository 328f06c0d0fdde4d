"""How a chart is laid out, before anything draws it: how far series stand apart, and whether each needs a panel.

Series with the same values would hide each other.  They are drawn side by side, some points of print beside their
place, or, where places lie too close for that, each in a panel of its own.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from itertools import combinations, pairwise
from math import log

from modern.study.report import Bars, Chart, Lines

WIDTH, HEIGHT = 430.0, 220.0
"""The axes of a chart without panels, in points of print, about."""
APART = 3.4
"""Points of print that the middles of two marks lie apart where both can be told."""
_WIDEST = 5.5
"""Points of print from one series to the next at one place, at most."""
_FILLED = 0.8
"""The part of the room between two places that the marks at one of them may take."""
_HIDDEN = 1 / 3
"""A series is hidden where more than this part of its marks is."""
_MANY_BARS = 48
"""Bars that a chart has room for side by side."""
_RAISED = str.maketrans("0123456789-+k", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺ᵏ")


def typeset(text: str) -> str:
    """Text with the signs of print: ``10^-3`` and ``1E-3`` become 10⁻³, and a minus sign (U+2212) a hyphen before a
    number."""
    text = re.sub(r"(?<![\w.])(\d+\.?\d*)E([+-]?\d+)\b", _power, text)
    text = re.sub(r"(?<=\d)\^([+-]?\d+|k\b)", lambda found: found[1].translate(_RAISED), text)
    return re.sub(r"(?<![\w.)-])-(?=\.?\d)", "\N{MINUS SIGN}", text)


def _power(found: re.Match[str]) -> str:
    factor = "" if found[1] == "1" else f"{found[1]} \N{MULTIPLICATION SIGN} "
    return f"{factor}10^{found[2]}"


def number(value: float, percent: bool = False, power: bool = False) -> str:
    """A number at an axis: ``−1.5``, ``35 %`` of .35, with ``power`` 10⁻³ of -3; no digits but those it needs."""
    text = f"10^{value:.10g}" if power else f"{100 * value:.10g} %" if percent else f"{value:.10g}"
    return typeset(text)


def names(chart: Chart) -> list[str]:
    """The places of bars, in their order."""
    return [str(place) for place in dict.fromkeys(place for series in chart.series for place, _ in series.points)]


def panels(chart: Chart) -> bool:
    """Whether each series needs axes of its own."""
    if isinstance(chart, Bars):
        return len(chart.series) * len(names(chart)) > _MANY_BARS
    return isinstance(chart, Lines) and any(part > _HIDDEN for part in hidden(chart))


def steps(chart: Lines) -> tuple[float, ...]:
    """How far beside its place each series is drawn, in points of print: as far apart as there is room for."""
    count = len(chart.series)
    places = sorted({float(place) for series in chart.series for place, _ in series.points})
    room = min((b - a for a, b in pairwise(_scaled(places, WIDTH, chart.log_x))), default=WIDTH)
    step = min(_WIDEST, _FILLED * room / count) if count and _nearest(chart) < APART else 0.0
    return tuple((k - (count - 1) / 2) * step for k in range(count))


def hidden(chart: Lines) -> tuple[float, ...]:
    """The part of each series' marks that those of another would hide, side by side as they are drawn."""
    beside = steps(chart)
    heights = _heights(chart)
    found = []
    for k, one in enumerate(heights):
        covered = [
            any(
                place in other and ((beside[k] - beside[j]) ** 2 + (one[place] - other[place]) ** 2) ** 0.5 < APART
                for j, other in enumerate(heights)
                if j != k
            )
            for place in one
        ]
        found.append(sum(covered) / len(covered) if covered else 0.0)
    return tuple(found)


def values(chart: Chart) -> list[float]:
    """Every value that the axis of y has to hold, marks' and intervals' limits with them."""
    points = [e for series in chart.series for _, e in series.points]
    level = [mark.at for mark in chart.marks if not mark.upright]
    return [*level, *(value for e in points for value in (e.low, e.value, e.high))]


def _nearest(chart: Lines) -> float:
    """How near two marks at one place come, in points of print."""
    pairs = combinations(_heights(chart), 2)
    return min((abs(a[place] - b[place]) for a, b in pairs for place in a.keys() & b.keys()), default=HEIGHT)


def _heights(chart: Lines) -> list[dict[float, float]]:
    """Of each series, how high its marks stand at their places, in points of print."""
    everything = sorted(set(values(chart)))
    high = dict(zip(everything, _scaled(everything, HEIGHT, chart.log_y), strict=True))
    return [{float(place): high[e.value] for place, e in series.points} for series in chart.series]


def _scaled(rising: Sequence[float], size: float, logarithmic: bool) -> list[float]:
    """Rising numbers along an axis of that size."""
    along = _logarithms(rising) if logarithmic else list(rising)
    span = along[-1] - along[0] if along else 0.0
    return [(value - along[0]) / span * size if span else 0.0 for value in along]


def _logarithms(rising: Iterable[float]) -> list[float]:
    numbers = list(rising)
    least = min((value for value in numbers if value > 0), default=1.0)
    return [log(max(value, least)) for value in numbers]

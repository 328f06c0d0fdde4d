"""Charts as data: what is drawn, before anything draws it."""

from __future__ import annotations

from dataclasses import dataclass, field

from modern.study.statistics import Interval

Place = str | float


@dataclass(frozen=True, slots=True)
class Series:
    """Values with intervals over places: names of bars, or numbers on the axis of x."""

    name: str
    points: tuple[tuple[Place, Interval], ...]


@dataclass(frozen=True, slots=True)
class Mark:
    """A value to compare with: a line across the chart at x (``upright``) or at y, with its words.

    The words of a level line stand at its right end, or with ``left`` at the other, where nothing is drawn.
    """

    at: float
    words: str
    upright: bool = False
    left: bool = False


@dataclass(frozen=True, slots=True)
class Bars:
    """Bars side by side over named places.

    name: the file's.  x and y: the axes' words, with units.  percent: values are proportions, shown in percent.
    marks: values to compare with; ``at`` of an upright one counts the places from 0.
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
class Lines:
    """Values over numbers, joined by lines, intervals as bars; either axis may be logarithmic."""

    name: str
    title: str
    x: str
    y: str
    series: tuple[Series, ...]
    percent: bool = False
    log_x: bool = False
    log_y: bool = False
    marks: tuple[Mark, ...] = field(default=())
    note: str = ""


Chart = Bars | Lines

"""Measure times, as medians of five runs after a run that fills caches, and plot their growth."""

import math
import statistics
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from modern.study.plots import draw
from modern.study.report import Lines, Series
from modern.study.statistics import Interval

RUNS = 5
Clock = Callable[[], float]


@dataclass(frozen=True, slots=True)
class Figure:
    """A measured time: the seconds of each run, and a note with a value for comparison."""

    what: str
    seconds: tuple[float, ...]
    note: str = ""

    @property
    def median(self) -> float:
        return statistics.median(self.seconds)

    def line(self) -> str:
        least, most = min(self.seconds), max(self.seconds)
        return f"{self.what:<58} {self.median:8.3f} s  ({least:.3f} to {most:.3f})  {self.note}".rstrip()


def timed_once(what: str, work: Callable[[], object]) -> Figure:
    """Time ``work`` once, because it cannot be repeated or takes too long for five runs."""
    return Figure(what, (_seconds(work),))


def timed(what: str, work: Callable[[], object], note: str = "") -> Figure:
    """Time ``work`` five times, after an untimed run that fills caches."""
    return side_by_side({what: work}, note)[0]


def side_by_side(
    works: Mapping[str, Callable[[], object]], note: str = "", clock: Clock = time.perf_counter, runs: int | None = None
) -> list[Figure]:
    """Time several functions in turn, in five rounds or in the given number of them.

    Other activity on the machine then affects all functions equally.
    """
    for work in works.values():
        work()
    rounds = [[_seconds(work, clock) for work in works.values()] for _ in range(runs or RUNS)]
    return [Figure(what, tuple(seconds), note) for what, seconds in zip(works, zip(*rounds, strict=True), strict=True)]


class Measured(float):
    """The seconds that a function measured itself, for example in a process that first has to read its points."""


def _seconds(work: Callable[[], object], clock: Clock = time.perf_counter) -> float:
    start = clock()
    result = work()
    return float(result) if isinstance(result, Measured) else clock() - start


@dataclass(frozen=True, slots=True)
class Curve:
    """Measured seconds by size of the problem, for one method."""

    name: str
    points: Sequence[tuple[int, float]]

    def slope(self, least: int = 0) -> float | None:
        """Return the exponent with which seconds grow with size, by least squares, for sizes from ``least`` on."""
        logs = [(math.log(count), math.log(seconds)) for count, seconds in self.points if count >= least]
        if len(logs) < 2:
            return None
        return statistics.linear_regression(*zip(*logs, strict=True)).slope


def plot(curves: Sequence[Curve], path: str, what: str) -> None:
    """Write curves on logarithmic axes as SVG, in the style of the studies.  ``what`` labels the first axis."""
    file = Path(path)
    series = (
        Series(curve.name, tuple((n, Interval(t, t, t)) for n, t in curve.points)) for curve in curves if curve.points
    )
    draw(Lines(file.stem, "", what, "median seconds", tuple(series), log_x=True, log_y=True), file.parent, ("svg",))


def plotted(curves: Sequence[Curve], path: str, what: str, least: int = 0) -> Iterator[str]:
    """Yield the figures of each curve as a line of text, then plot the curves with their slopes in the legend."""
    shown = []
    for curve in curves:
        slope = curve.slope(least)
        label = "" if slope is None else f"slope {slope:.2f}"
        figures = ", ".join(f"{count:,}: {seconds:.4f} s" for count, seconds in curve.points)
        yield f"{curve.name} {figures} {label}".rstrip()
        shown.append(replace(curve, name=f"{curve.name}: {label}" if label else curve.name))
    plot(shown, path, what)

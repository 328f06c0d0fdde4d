"""Time functions, as medians of five runs after a run that fills caches, and plot how the times grow."""

import math
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from modern.study.plots import draw
from modern.study.report import Lines, Series
from modern.study.statistics import Interval

RUNS = 5
Clock = Callable[[], float]


@dataclass(frozen=True, slots=True)
class Figure:
    """The measured seconds of each run of a function, with a name (``what``) and a note, such as a required time."""

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
    """Time ``work`` once. Use this for work that cannot be repeated or takes too long for five runs."""
    return Figure(what, (_seconds(work),))


def timed(what: str, work: Callable[[], object], note: str = "") -> Figure:
    """Time ``work`` five times, after an untimed run that fills caches."""
    return side_by_side({what: work}, note)[0]


def side_by_side(
    works: Mapping[str, Callable[[], object]], note: str = "", clock: Clock = time.perf_counter, runs: int | None = None
) -> list[Figure]:
    """Time several functions in turn, in five rounds or in ``runs`` rounds, after one untimed run of each.

    Other activity on the machine then affects all functions equally.
    """
    for work in works.values():
        work()
    rounds = [[_seconds(work, clock) for work in works.values()] for _ in range(runs or RUNS)]
    return [Figure(what, tuple(seconds), note) for what, seconds in zip(works, zip(*rounds, strict=True), strict=True)]


def command(*arguments: str) -> Callable[[], object]:
    """Return a function that runs ``hull1620`` with these arguments in a new process and discards the output."""
    words = [sys.executable, "-m", "modern.cli.main", *arguments]
    return lambda: subprocess.run(words, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


class Measured(float):
    """A number of seconds, returned by a function that measures its own run because it starts another program."""


def _seconds(work: Callable[[], object], clock: Clock = time.perf_counter) -> float:
    start = clock()
    result = work()
    return float(result) if isinstance(result, Measured) else clock() - start


@dataclass(frozen=True, slots=True)
class Curve:
    """The measured times of one method, as pairs of the size of the problem and the seconds."""

    name: str
    points: Sequence[tuple[int, float]]

    def slope(self, least: int = 0) -> float | None:
        """Return the slope of the curve on logarithmic axes, for sizes of at least ``least``, by least squares.

        The seconds grow like a power of the size, and the slope is the exponent of this power.  Return None for fewer
        than two points.
        """
        logs = [(math.log(count), math.log(seconds)) for count, seconds in self.points if count >= least]
        if len(logs) < 2:
            return None
        return statistics.linear_regression(*zip(*logs, strict=True)).slope


def plotted(curves: Sequence[Curve], path: str, what: str, least: int = 0) -> Iterator[str]:
    """Yield the points and the slope of each curve as a line of text, then write a plot of all curves as SVG.

    Both axes are logarithmic, ``what`` labels the first axis, and the legend has the slopes for sizes from ``least``.
    """
    series = []
    for curve in curves:
        slope = curve.slope(least)
        label = "" if slope is None else f"slope {slope:.2f}"
        points = ", ".join(f"{count:,}: {seconds:.4f} s" for count, seconds in curve.points)
        yield f"{curve.name} {points} {label}".rstrip()
        name = f"{curve.name}: {label}" if label else curve.name
        series.append(Series(name, tuple((count, Interval(t, t, t)) for count, t in curve.points)))
    file = Path(path)
    draw(Lines(file.stem, "", what, "median seconds", tuple(series), log_x=True, log_y=True), file.parent, ("svg",))

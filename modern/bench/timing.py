"""Timing: medians of five runs after one that fills caches, and plots of growth."""

import math
import statistics
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

RUNS = 5
Clock = Callable[[], float]


@dataclass(frozen=True, slots=True)
class Figure:
    """A measured figure: the seconds of each run, and a note with a value to compare them with."""

    what: str
    seconds: tuple[float, ...]
    note: str = ""

    @property
    def median(self) -> float:
        return statistics.median(self.seconds)

    def line(self) -> str:
        least, most = min(self.seconds), max(self.seconds)
        return f"{self.what:<58} {self.median:8.3f} s  ({least:.3f} to {most:.3f})  {self.note}".rstrip()


def timed_once(what: str, work: Callable[[], object], note: str = "") -> Figure:
    """Time ``work`` once. Use this function for work that cannot be repeated or takes too long for five runs."""
    return Figure(what, (_seconds(work),), note)


def timed(what: str, work: Callable[[], object], note: str = "") -> Figure:
    """Time ``work`` five times, after an untimed run that fills caches."""
    return side_by_side({what: work}, note)[0]


def side_by_side(
    works: Mapping[str, Callable[[], object]], note: str = "", clock: Clock = time.perf_counter, runs: int | None = None
) -> list[Figure]:
    """Time several works in turn, in five rounds or the given number of them.

    Other activity on the machine then affects all works equally.
    """
    for work in works.values():
        work()
    rounds = [[_seconds(work, clock) for work in works.values()] for _ in range(runs or RUNS)]
    return [Figure(what, tuple(seconds), note) for what, seconds in zip(works, zip(*rounds, strict=True), strict=True)]


class Measured(float):
    """The seconds that a work measured itself, for example a process that must first read its points."""


def _seconds(work: Callable[[], object], clock: Clock = time.perf_counter) -> float:
    start = clock()
    result = work()
    return float(result) if isinstance(result, Measured) else clock() - start


@dataclass(frozen=True, slots=True)
class Curve:
    """The seconds by size, and the style in which matplotlib draws them as a curve; curves differ in grey."""

    name: str
    points: Sequence[tuple[int, float]]
    style: Mapping[str, Any]

    def slope(self, least: int = 0) -> float | None:
        """Return the exponent of growth by least squares of the logarithms, for sizes of at least ``least``."""
        logs = [(math.log(count), math.log(seconds)) for count, seconds in self.points if count >= least]
        if len(logs) < 2:
            return None
        return statistics.linear_regression(*zip(*logs, strict=True)).slope


def plot(curves: Sequence[Curve], path: str, what: str) -> None:
    """Write curves on logarithmic axes as SVG. ``what`` labels the first axis (extra ``plot``)."""
    import matplotlib

    matplotlib.use("svg")
    matplotlib.rcParams["svg.hashsalt"] = "hull1620"
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(7, 4.5))
    for curve in curves:
        if curve.points:
            axes.loglog(*zip(*curve.points, strict=True), label=curve.name, **curve.style)
    axes.set_xlabel(what)
    axes.set_ylabel("median seconds")
    axes.grid(True, which="major", color="0.9")
    axes.legend()
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})


def plotted(curves: Sequence[Curve], path: str, what: str, least: int = 0) -> Iterator[str]:
    """Yield a line of figures for each curve, then plot the curves with their slopes in the legend."""
    shown = []
    for curve in curves:
        slope = curve.slope(least)
        label = "" if slope is None else f"slope {slope:.2f}"
        figures = ", ".join(f"{count:,}: {seconds:.4f} s" for count, seconds in curve.points)
        yield f"{curve.name} {figures} {label}".rstrip()
        shown.append(replace(curve, name=f"{curve.name}: {label}" if label else curve.name))
    plot(shown, path, what)

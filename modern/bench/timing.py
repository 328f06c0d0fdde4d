"""Timing: medians of five runs after one that fills caches; and plots of how times grow."""

from __future__ import annotations

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
    """One measured figure: seconds of each run and what to compare them with."""

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
    """Time ``work`` once: what cannot be done a second time, or takes too long for five."""
    return Figure(what, (_seconds(work),), note)


def timed(what: str, work: Callable[[], object], note: str = "") -> Figure:
    """Time ``work`` five times; the first, untimed, fills caches."""
    return side_by_side({what: work}, note)[0]


def side_by_side(
    works: Mapping[str, Callable[[], object]], note: str = "", clock: Clock = time.perf_counter
) -> list[Figure]:
    """Time several works in turn, five rounds of them, so that what else the machine does falls on all of them."""
    for work in works.values():
        work()
    rounds = [[_seconds(work, clock) for work in works.values()] for _ in range(RUNS)]
    return [Figure(what, tuple(seconds), note) for what, seconds in zip(works, zip(*rounds, strict=True), strict=True)]


class Measured(float):
    """Seconds that a work measured itself, as a process does that has to read its points first."""


def _seconds(work: Callable[[], object], clock: Clock = time.perf_counter) -> float:
    start = clock()
    found = work()
    return float(found) if isinstance(found, Measured) else clock() - start


@dataclass(frozen=True, slots=True)
class Curve:
    """Seconds by number, and how matplotlib draws them; lines are told apart in grey."""

    name: str
    points: Sequence[tuple[int, float]]
    style: Mapping[str, Any]

    def slope(self, least: int = 0) -> float | None:
        """The exponent of growth: of the line nearest to the logarithms (least squares), from ``least`` points on."""
        logs = [(math.log(count), math.log(seconds)) for count, seconds in self.points if count >= least]
        if len(logs) < 2:
            return None
        return statistics.linear_regression(*zip(*logs, strict=True)).slope


def plot(curves: Sequence[Curve], path: str, what: str) -> None:
    """Write curves on logarithmic axes as SVG; ``what`` is numbered along the first (extra ``plot``)."""
    import matplotlib

    matplotlib.use("svg")
    matplotlib.rcParams["svg.hashsalt"] = "hull1620"
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(7, 4.5))
    for curve in curves:
        if curve.points:
            axes.loglog(*zip(*curve.points, strict=True), label=curve.name, **curve.style)
    axes.set_xlabel(what)
    axes.set_ylabel("seconds, median of five")
    axes.grid(True, which="major", color="0.9")
    axes.legend()
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})


def plotted(curves: Sequence[Curve], path: str, what: str, least: int = 0) -> Iterator[str]:
    """A line of figures for each curve; then they are plotted, each with its slope from ``least`` on in its name."""
    shown = []
    for curve in curves:
        slope = curve.slope(least)
        words = "" if slope is None else f"slope {slope:.2f}"
        figures = ", ".join(f"{count:,}: {seconds:.4f} s" for count, seconds in curve.points)
        yield f"{curve.name} {figures} {words}".rstrip()
        shown.append(replace(curve, name=f"{curve.name}: {words}" if words else curve.name))
    plot(shown, path, what)

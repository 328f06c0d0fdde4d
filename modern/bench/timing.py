"""Timing: medians of five runs behind one that fills caches."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass

RUNS = 5


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


def timed(what: str, work: Callable[[], object], note: str = "", runs: int = RUNS) -> Figure:
    """Time ``work`` five times; the first, untimed, fills caches."""
    return side_by_side({what: work}, note, runs)[0]


def side_by_side(works: Mapping[str, Callable[[], object]], note: str = "", runs: int = RUNS) -> list[Figure]:
    """Time several works in turn, five rounds of them, so that what else the machine does falls on all of them."""
    for work in works.values():
        work()
    rounds = [[_seconds(work) for work in works.values()] for _ in range(runs)]
    return [Figure(what, tuple(seconds), note) for what, seconds in zip(works, zip(*rounds, strict=True), strict=True)]


def _seconds(work: Callable[[], object]) -> float:
    start = time.perf_counter()
    work()
    return time.perf_counter() - start

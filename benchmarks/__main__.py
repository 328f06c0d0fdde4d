"""Run the benchmarks and print a table: what, median, least, most, and what it was measured against."""

from __future__ import annotations

import random
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass

from emulator.cards import Deck, deck_from_lines
from emulator.machine import Machine
from emulator.result import Options
from modern.edition import decks
from modern.points import e_field, parse_decimal

RUNS = 5


@dataclass(frozen=True, slots=True)
class Figure:
    """One measured figure: seconds of each run and what to compare them with."""

    what: str
    seconds: tuple[float, ...]
    note: str = ""

    def line(self) -> str:
        median, least, most = statistics.median(self.seconds), min(self.seconds), max(self.seconds)
        return f"{self.what:<58} {median:8.3f} s  ({least:.3f} to {most:.3f})  {self.note}".rstrip()


def timed(what: str, work: Callable[[], object], note: str = "") -> Figure:
    """Time ``work`` five times; the first, untimed, fills caches."""
    work()
    seconds = []
    for _ in range(RUNS):
        start = time.perf_counter()
        work()
        seconds.append(time.perf_counter() - start)
    return Figure(what, tuple(seconds), note)


def process(*arguments: str) -> Callable[[], object]:
    """A whole process of the command, its output thrown away."""
    command = [sys.executable, "-m", "modern.cli.main", *arguments]
    return lambda: subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def random_deck(points: int, seed: int) -> Deck:
    """A data deck of distinct uniform integer points in [-99, 99]."""
    source = random.Random(seed)
    found: set[tuple[int, int, int]] = set()
    while len(found) < points:
        found.add((source.randint(-99, 99), source.randint(-99, 99), source.randint(-99, 99)))
    cards = ["".join(e_field(parse_decimal(str(x)), False) for x in point) for point in sorted(found)]
    source.shuffle(cards)
    return deck_from_lines("random deck", [f"{points:2d}", *cards])


def main() -> None:
    """Print every figure."""
    print(f"medians of {RUNS}")
    print(timed("an empty Python process", lambda: subprocess.run([sys.executable, "-c", "pass"], check=True)).line())
    print(timed("hull1620 --help", process("--help"), "bar 0.15 s").line())
    print(timed("hull1620 reproduce 5, process start included", process("reproduce", "5"), "bar 0.5 s").line())
    print(timed("hull1620 reproduce, all six", process("reproduce")).line())
    deck = random_deck(51, 1)
    middle = deck_from_lines("middle", Machine(decks.program("program1"), deck).run().punched)
    program = decks.program("program3")
    result = Machine(program, middle).run()
    name = f"program 3, 51 points, {result.statements} statements, plain engine"
    figure = timed(name, lambda: Machine(program, middle, Options()).run(), "bar 1.5 s")
    print(figure.line())
    print(f"  {result.statements / statistics.median(figure.seconds):,.0f} statements a second")


if __name__ == "__main__":
    main()

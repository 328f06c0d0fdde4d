"""Run the benchmarks and print a table: what, median, least, most, and what it was measured against."""

from __future__ import annotations

import random
import subprocess
import sys
from collections.abc import Callable

from benchmarks.hulls import figures
from benchmarks.timing import RUNS, timed
from emulator.cards import Deck, deck_from_lines
from emulator.machine import Machine
from emulator.result import Options
from modern.edition import decks
from modern.points import e_field, parse_decimal


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
    print(f"  {result.statements / figure.median:,.0f} statements a second")
    for hull in figures():
        print(hull.line())


if __name__ == "__main__":
    main()

"""The input of the benchmarks: decks of 51 points that program 1 punches for program 3.

Program 3 runs with the layer ``corrected``, which removes the known faults. ``python -m modern.bench.decks`` reads one
deck from standard input and runs it on the compiled engine.
"""

import random
import sys
from collections.abc import Sequence

from emulator.compiled.batch import punched, run_batch
from emulator.language.cards import Deck
from emulator.machine.result import Options
from modern.edition import programs
from modern.formats import deck

PROGRAM, LAYERS = "program3", ("corrected",)
OPTIONS = Options(core=60_000)
POINTS, LARGEST, SEED = 51, 99, 1963

Point = tuple[int, int, int]


def random_points(count: int, seed: int) -> list[Point]:
    """Return distinct points in random order, whose coordinates are uniformly distributed integers in [-99, 99]."""
    source = random.Random(seed)
    distinct: set[Point] = set()
    while len(distinct) < count:
        x, y, z = (source.randint(-LARGEST, LARGEST) for _ in range(3))
        distinct.add((x, y, z))
    points = sorted(distinct)
    source.shuffle(points)
    return points


def data_deck(points: Sequence[Point]) -> Deck:
    """Return the input deck of program 1 for these points: a card with N, then one card for each point."""
    return deck.data_deck([list(map(str, point)) for point in points], "random deck")


def middle_texts(sets: Sequence[Sequence[Point]]) -> list[str]:
    """Return, as texts, the decks for program 3 that program 1 punches for these point sets."""
    results = run_batch(programs.program("program1"), [data_deck(points) for points in sets])
    return ["".join(card + "\n" for card in result.punched) for result in results]


def main() -> None:
    sys.stdout.writelines(punched(programs.program(PROGRAM, LAYERS), [sys.stdin.read()], OPTIONS))


if __name__ == "__main__":
    main()

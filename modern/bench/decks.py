"""The input of the benchmarks: decks of 51 points for program 3, in the version without the listing's known faults.

The decks are those that program 1 punches. ``python -m modern.bench.decks`` runs one deck, read from standard input, on
the compiled engine.
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
    """Return distinct points with uniform integers in [-99, 99], in random order."""
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
    """Return the decks that program 1 punches for these point sets as input for program 3, as texts."""
    results = run_batch(programs.program("program1"), [data_deck(points) for points in sets])
    return ["".join(card + "\n" for card in result.punched) for result in results]


def main() -> None:
    sys.stdout.writelines(punched(programs.program(PROGRAM, LAYERS), [sys.stdin.read()], OPTIONS))


if __name__ == "__main__":
    main()

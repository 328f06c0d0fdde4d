"""What is measured of every card: executions and machine time in a printed example, and the weight of its evidence.

Times are those of :mod:`emulator.machine.timing`: processor seconds of a 1620 Model 1, known to about 10 %.  The weight
of evidence is that of ``docs/weight/cards.csv`` (:mod:`modern.edition.weight`), which is there in a checkout only.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from emulator.machine.result import Options
from emulator.machine.timing import Row, measure, shares
from modern.edition import programs
from modern.edition.chapter6 import EXAMPLES, input_deck
from modern.thesis.job import run_hull

LIMIT = 200_000
TABLE = Path(__file__).parents[2] / "docs" / "weight" / "cards.csv"
NOTICED = ("compiler", "print", "machine", "equation", "sibling", "nothing")
"""What notices a reading first; the columns of the table."""


@dataclass(frozen=True, slots=True)
class Run:
    """One example through one program: executions and processor seconds by card, those never executed left out.

    ``seconds`` is the processor's, ``total`` with reader, punch and typewriter one after the other; ``statements``
    counts the statements executed; ``rows`` say what the time is made of, the processor's causes and then the devices.
    """

    example: int
    program: str
    executions: dict[int, int]
    times: dict[int, float]
    statements: int
    seconds: float
    total: float
    rows: tuple[Row, ...]


@cache
def runs(program: str) -> tuple[Run, ...]:
    """The runs of the printed examples that come to a built-in program, by example.

    Program 1 as listed and in the state of the examples each reads the six decks; programs 2 and 3 read what the
    state of the examples punches.
    """
    first = program if program.startswith("program1") else "program1_examples"
    found = []
    for example in EXAMPLES:
        for step in _job(example, first):
            if step.program == program:
                found.append(step)
    return tuple(found)


@cache
def _job(example: int, first: str) -> tuple[Run, ...]:
    steps = run_hull(input_deck(example), programs.program, Options(limit=LIMIT), first).steps
    found = []
    for step in steps:
        timing = measure(step.program, step.result)
        counts, seconds = dict(timing.statements), shares(step.program, step.result)
        cards = {line.place.card: line.index for line in step.program.statements}
        found.append(
            Run(
                example,
                step.name,
                {card: counts[index] for card, index in cards.items() if counts.get(index)},
                {card: seconds[index] for card, index in cards.items() if counts.get(index)},
                step.result.statements,
                timing.processor_seconds,
                timing.seconds,
                (*timing.processor, *timing.devices),
            )
        )
    return tuple(found)


@dataclass(frozen=True, slots=True)
class Weight:
    """Of the readings of a card how many each of :data:`NOTICED` notices first; those that change nothing left out."""

    noticed: tuple[int, ...]
    formula: str

    @property
    def readings(self) -> int:
        return sum(self.noticed)

    @property
    def silent(self) -> int:
        """How many nothing notices."""
        return self.noticed[-1]


@cache
def weights(program: str, table: Path = TABLE) -> dict[int, Weight]:
    """The weight of each card of a listing, by its number; empty for a program that was not weighed."""
    with table.open(encoding="utf-8", newline="") as file:
        return {
            int(row["card"]): Weight(tuple(int(row[what]) for what in NOTICED), row["formula"])
            for row in csv.DictReader(file)
            if row["program"] == program
        }

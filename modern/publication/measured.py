"""Measurements of every card: its executions and machine time in the printed examples, and its weight of evidence.

Times are those of a 1620 Model 1 (:mod:`emulator.machine.timing`). The weight of evidence of a card is, for each check,
the number of altered readings of the card that the check detects. The weights are read from ``docs/weight/cards.csv``,
which exists only in a checkout.
"""

import csv
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from emulator.machine.result import Options
from emulator.machine.timing import Row, Time, measure, shares
from modern.edition import programs
from modern.edition.chapter6 import EXAMPLES, input_deck
from modern.thesis.job import run_hull

# The largest number of statements that a run may execute.
LIMIT = 200_000
TABLE = Path(__file__).parents[2] / "docs" / "weight" / "cards.csv"
# The checks in the order in which they are applied, which are also the names of columns of the table.
DETECTED_BY = ("compiler", "print", "machine", "equation", "sibling", "nothing")


@dataclass(frozen=True, slots=True)
class Run:
    """A run of one program in an example of the thesis.

    ``executions`` has the number of executions of each executed card, and ``times`` has its processor time. The keys
    are the numbers of the cards. ``statements`` is the number of executed statements. ``processor`` is the processor
    time of the run. ``total`` is this time plus the times of reader, punch and typewriter. ``rows`` divide the total
    time by cause: first the causes in the processor, then the devices.
    """

    example: int
    program: str
    executions: dict[int, int]
    times: dict[int, Time]
    statements: int
    processor: Time
    total: Time
    rows: tuple[Row, ...]


@cache
def runs(program: str) -> tuple[Run, ...]:
    """Return the runs of a built-in program on the input decks of the printed examples.

    Programs 2 and 3 read the cards that ``program1_examples`` (program 1 in the state that produced the printed
    examples) punches.
    """
    first = program if program.startswith("program1") else "program1_examples"
    return tuple(run for example in EXAMPLES for run in _job(example, first) if run.program == program)


@cache
def _job(example: int, first: str) -> tuple[Run, ...]:
    steps = run_hull(input_deck(example), programs.program, Options(limit=LIMIT), first).steps
    job_runs = []
    for step in steps:
        timing = measure(step.program, step.result)
        counts, shared = dict(timing.statements), shares(step.program, step.result)
        cards = {line.place.card: line.index for line in step.program.statements if counts.get(line.index)}
        executions = {card: counts[index] for card, index in cards.items()}
        times = {card: shared[index] for card, index in cards.items()}
        totals = (step.result.statements, timing.processor_time, timing.time)
        job_runs.append(Run(example, step.name, executions, times, *totals, (*timing.processor, *timing.devices)))
    return tuple(job_runs)


@dataclass(frozen=True, slots=True)
class Weight:
    """The number of variants of a card that each check detects.

    A variant is the card with one token altered, as an OCR program or a typist might alter it. ``detected`` has one
    count for each check in :data:`DETECTED_BY`. A variant counts only for the first check that detects it, and not at
    all if the object code stays the same. ``formula`` names the formula of chapter 3 that the card computes.
    """

    detected: tuple[int, ...]
    formula: str


@cache
def weights(program: str) -> dict[int, Weight]:
    """Return the weights of a program's cards by card number.

    The result is empty for a program that was not measured.
    """
    with TABLE.open(encoding="utf-8", newline="") as file:
        return {
            int(row["card"]): Weight(tuple(int(row[check]) for check in DETECTED_BY), row["formula"])
            for row in csv.DictReader(file)
            if row["program"] == program
        }

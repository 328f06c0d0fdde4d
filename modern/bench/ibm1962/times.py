"""Measure the simulated time of runs on IBM's library of 1962, and compare it with the emulator's model of time.

A simulator with ``instruction_times.patch`` adds up the published times of the executed instructions.  The results are
kept in ``docs/ibm1962/times.csv``.  :data:`emulator.machine.timing.MODEL` is the range of the ratios of measured to
modelled times.
"""

from collections.abc import Iterator, Sequence

from emulator.language.cards import Deck
from emulator.language.objectcode import Program
from emulator.machine.machine import Machine
from emulator.machine.timing import measure
from emulator.objectdeck.cards import object_cards, with_library
from modern.bench.ibm1962 import objectdecks
from modern.bench.ibm1962.objectdecks import CORE, OPTIONS, SECONDS, library
from modern.bench.ibm1962.simulator import run
from modern.edition import programs
from modern.edition.chapter6 import EXAMPLES, input_deck
from modern.formats.columns import csv_text
from modern.formats.deck import data_deck
from modern.study.families import draw_sample
from modern.study.plan import SEED, Cell, Port
from modern.thesis.job import run_hull

FILE = "docs/ibm1962/times.csv"
HEAD = ("deck", "program", "library", "model", "ratio")
# Programs that call functions that the library lacks.
LACKING = ("l1.f", "pow.f", "pow2.f")
# Random sets of the study of machine time: a family and a number of points.
SETS = tuple((family, n) for family in ("ball", "integers", "cube", "sphere") for n in (6, 12, 20, 30))


def subjects(sets: Sequence[tuple[str, int]] = SETS) -> Iterator[tuple[str, str, Program, Deck, float]]:
    """Yield the runs to measure: the names of deck and program, the program, the deck, and the modelled seconds."""
    decks = [(f"example {example}", "program1_examples", input_deck(example)) for example in EXAMPLES]
    for family, n in sets:
        cell = Cell({"sets": family, "n": n}, family, {"digits": 2, "n": n}, (Port("port"),), 1)
        decks.append((f"{family}, {n} points", "program1", data_deck(draw_sample(cell, SEED, 0).points, family)))
    for name, first, deck in decks:
        for step in run_hull(deck, programs.program, OPTIONS, first).steps:
            seconds = measure(step.program, step.result).processor_time.seconds
            if step.result.ending.kind != "limit":
                yield name, step.name, step.program, step.deck, seconds
    for title, program, deck, operator in objectdecks.subjects():
        if title.endswith(".f") and not operator and not program.uses("ACCEPT") and title not in LACKING:
            result = Machine(program, deck, OPTIONS).run()
            yield deck.source, title, program, deck, measure(program, result).processor_time.seconds


def table() -> str:
    """Run every subject on IBM's library in the simulator, and return the text of ``docs/ibm1962/times.csv``.

    A row has the processor seconds of a run as measured on the library and as computed by the emulator's model, and
    their ratio.  Raise Unavailable if the simulator does not count the time.
    """
    rows: list[tuple[str, ...]] = [HEAD]
    for name, title, program, deck, model in subjects():
        object_deck = with_library(object_cards(program, CORE), library(), "OBJECT_DECK")
        cards = [card.text for card in deck.cards]
        milliseconds = run(object_deck, core=CORE, cards=cards, seconds=SECONDS, timed=True).milliseconds
        assert milliseconds is not None
        measured = milliseconds / 1000
        rows.append((name, title, f"{measured:.1f}", f"{model:.1f}", f"{measured / model:.3f}"))
    return csv_text(rows)

"""The engines: one run over one deck, and ``hull1620 bench`` (modern/bench) over a thousand."""

from __future__ import annotations

from collections.abc import Iterator

from emulator.language.cards import deck_from_lines
from emulator.machine.machine import Machine
from modern.bench.clock import timed
from modern.bench.decks import POINTS, data_deck, random_points
from modern.bench.measure import lines, measure
from modern.edition import programs

DECKS = 1_000


def figures(count: int = DECKS) -> Iterator[str]:
    """Every figure, as lines of text."""
    deck = data_deck(random_points(POINTS, 1))
    middle = deck_from_lines("middle", Machine(programs.program("program1"), deck).run().punched)
    program = programs.program("program3")
    result = Machine(program, middle).run()
    name = f"program 3, {POINTS} points, {result.statements} statements, plain engine"
    figure = timed(name, lambda: Machine(program, middle).run(), "bar 1.5 s")
    yield figure.line()
    yield f"  {result.statements / figure.median:,.0f} statements a second"
    yield from lines(measure(count))

"""Many decks through one program."""

from __future__ import annotations

from collections.abc import Sequence

from emulator.cards import Deck
from emulator.machine import Machine
from emulator.objectcode import Program
from emulator.result import Options, Result


def run_batch(program: Program, decks: Sequence[Deck], options: Options | None = None) -> tuple[Result, ...]:
    """The result of each deck, as :meth:`emulator.machine.Machine.run` gives it.  Raises what that raises."""
    return tuple(Machine(program, deck, options or Options()).run() for deck in decks)

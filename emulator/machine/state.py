"""A run as plain data: storage and registers between two calls of the interpreter, and the journal of what was done.

A field's number is in ``values`` and what it is in ``kinds``: FIXED_POINT, UNDEFINED, or FLOATING for a number of
the system.  What two runs are compared by goes into a :class:`Journal`: every decision, and with ``stores`` every
statement begun and every field changed, so that a run need not be stopped for it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from emulator.language.objectcode import BEGIN, FMFAC, FMFIX, ITEM, SUBSCRIPT, TRANSMIT, Flat, Program
from emulator.numbers.arithmetic import UNDEFINED, ZERO
from emulator.numbers.base import Number
from emulator.numbers.work import STEPS

FLOATING = ZERO
"""The kind of a field that holds a number of the system."""

Entry = tuple[int, int, Number]
"""(instruction, field changed or instruction gone to, value stored or tested); at a COUNT (instruction, 0, None)."""


@dataclass
class Journal:
    """What a run did, in order.

    ``stores``: fields changed and statements begun are entered too, not only decisions; a field that is only
    copied while undefined is entered with the value None.
    """

    stores: bool
    entries: list[Entry] = field(default_factory=list)


def entered(program: Program) -> list[bool]:
    """For each instruction whether a journal enters it: stores into fields with a name, and numbers read."""
    found = []
    reading = False
    variables = [e for e in program.storage.entries if e.kind in ("variable", "array")]
    named = {address for e in variables for address in range(e.first, e.first + e.size)}
    for instruction in program.code:
        operation = instruction.operation
        if operation == BEGIN:
            reading = program.verbs[instruction.address] in ("READ", "ACCEPT")
        if operation == ITEM:
            found.append(reading)
        else:
            stores = operation in (FMFAC, FMFIX, TRANSMIT)
            found.append(stores and (instruction.subscript >= 0 or instruction.address in named))
    return found


@dataclass
class State:
    """A run between two calls of :func:`emulator.machine.interpreter.run`: storage, counts, and the registers.

    ``pc`` is the next instruction, ``at`` the one a reason to return arose in, ``address`` the field it is about and
    ``index`` its subscripts; ``fac`` and ``fixed`` are the accumulators, ``sent`` and ``sent_kind`` a field on its way,
    ``stored`` the field last stored into.  ``element`` is how many elements of an array have gone through its ITEM,
    which is then the next instruction again; ``listed`` says that a number has of which the journal does not know yet.
    ``work`` is what counts against the limit, ``costly`` how much of it is for operations that take longer than plain
    ones, ``owed`` the steps of these that do not make a unit yet (emulator/numbers/work.py).  ``event`` is the number
    of an error code, and ``decision`` the last IF or computed GO TO, its instruction counted from 1.
    """

    values: list[Number]
    kinds: list[int]
    counts: list[int]
    fac: Number
    pc: int = 0
    at: int = 0
    fixed: int = 0
    sent: Number = 0
    sent_kind: int = UNDEFINED
    stored: int = 0
    element: int = 0
    address: int = 0
    index: tuple[int, ...] = ()
    listed: bool = False
    event: int = 0
    decision: int = 0
    work: int = 0
    costly: int = 0
    owed: int = 0

    def owe(self, steps: int) -> int:
        """The units of work that fall due with so many steps more."""
        due, self.owed = divmod(self.owed + steps, STEPS)
        self.costly += due
        return due


Table = dict[int, Sequence[int]]


def subscript_table(code: Flat) -> Table:
    """The subscripts of a program by their place in :attr:`Flat.table`."""
    return {k: code.table[k : k + SUBSCRIPT] for k in range(0, len(code.table), SUBSCRIPT)}

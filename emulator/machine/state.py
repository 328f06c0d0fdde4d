"""The state of a run as plain data, and the journal by which two runs are compared.

For each field of core storage, ``values`` holds a number, and ``kinds`` holds the kind of this number: FIXED_POINT,
UNDEFINED, or FLOATING for a number of the arithmetic.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

from emulator.errors import DeckError
from emulator.language.objectcode import BEGIN, FMFAC, FMFIX, ITEM, SUBSCRIPT, TRANSMIT, Flat, Program
from emulator.numbers.arithmetic import FIXED_POINT, UNDEFINED, ZERO
from emulator.numbers.base import Number, Numbers
from emulator.numbers.work import STEPS
from emulator.objectdeck.extent import extent

# The kind of a field that holds a floating-point number, in any arithmetic.
FLOATING = ZERO

# An entry of a journal.  For a store it holds the instruction, the field and the value, for a decision the instruction,
# the next instruction and the tested value, and for a COUNT the instruction, 0 and None.
Entry = tuple[int, int, Number]


@dataclass
class Journal:
    """The decisions of a run, in order.

    With ``stores`` the journal also records every statement that begins and every field that changes.  If a statement
    copies an undefined field, the value recorded for the copy is None.
    """

    stores: bool
    entries: list[Entry] = field(default_factory=list)


def recorded_instructions(program: Program) -> list[bool]:
    """Return for each instruction True if a journal records it, because it changes a variable or array element."""
    recorded = []
    reading = False
    variables = [e for e in program.storage.entries if e.kind in ("variable", "array")]
    named = {address for e in variables for address in range(e.first, e.first + e.size)}
    for instruction in program.code:
        operation = instruction.operation
        # The numbers of an output list change no field.
        if operation == BEGIN:
            reading = program.verbs[instruction.address] in ("READ", "ACCEPT")
        if operation == ITEM:
            recorded.append(reading)
        else:
            # A subscripted instruction changes an array element.  Fields without a name hold intermediate results.
            stores = operation in (FMFAC, FMFIX, TRANSMIT)
            recorded.append(stores and (instruction.subscript >= 0 or instruction.address in named))
    return recorded


@dataclass
class State:
    """A run between two calls of :func:`emulator.machine.interpreter.run`: storage, counts and registers.

    values, kinds: core storage.  counts: the executions of each counter.  fac, fixed: the accumulators.

    pc: the next instruction.  at: the instruction at which the interpreter returned.  address, index: the field that
    this instruction uses, and its subscripts.  sent, sent_kind: the value and kind of a field that is being copied.
    stored: the field last stored into.

    element: the number of elements of an array that its ITEM has transferred so far.  ITEM is executed again for each
    further element.  listed: True if an element has been transferred but not yet recorded in the journal.

    work: the work counted against the limit.  costly: the part of ``work`` for operations that take longer than a
    statement.  owed: the steps of such operations that do not yet add up to a unit (emulator/numbers/work.py).

    last_card: True if the last card has been read and no statement has tested this since (SENSE SWITCH 9).

    event: the number of an error code.  decision: the instruction of the last IF or computed GO TO, counted from 1.
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
    last_card: bool = False
    work: int = 0
    costly: int = 0
    owed: int = 0

    def owe(self, steps: int) -> int:
        """Add the steps of a slow operation, and return the whole units of work that they complete."""
        units, self.owed = divmod(self.owed + steps, STEPS)
        self.costly += units
        return units


Table = dict[int, Sequence[int]]


def subscript_table(code: Flat) -> Table:
    """Return the subscripts of a program in a table, keyed by their index in :attr:`Flat.table`."""
    return {k: code.table[k : k + SUBSCRIPT] for k in range(0, len(code.table), SUBSCRIPT)}


def refuse_overlap(program: Program, core: int) -> None:
    """Raise DeckError if a program and its data are too large for a machine with ``core`` positions of storage."""
    size = extent(program)
    if size.is_certain(core):
        raise DeckError(f"{program.source}: {size.overlap(core)}")


def loaded(program: Program, numbers: Numbers) -> tuple[list[Number], list[int]]:
    """Return the values and kinds of all storage fields before a run.  Only constants have a value then."""
    values: list[Number] = [0] * program.storage.length
    kinds = [UNDEFINED] * program.storage.length
    for address, text in program.storage.constants + program.storage.immediates:
        # A constant with a decimal point is floating point.
        if "." in text:
            values[address], kinds[address] = numbers.constant(text), FLOATING
        else:
            values[address], kinds[address] = int(text), FIXED_POINT
    return values, kinds

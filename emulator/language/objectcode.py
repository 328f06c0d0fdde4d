"""Object code for an accumulator machine with the 1620's floating accumulator FAC.

Operations have the names of IBM's subroutine set (C26-5619 p. 60-69).  An instruction is four integers: operation,
address or table index, subscript (an index into :attr:`Program.subscripts`, or -1), and second operand.  An address is
the number of a field of the storage map (emulator/language/storage.py), counted from 0 downward from the top of core.
The second operand of an ITEM is the number of fields that it transfers, beginning at its address: one field or a whole
array.  The number is negative if the fields hold fixed-point numbers.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from emulator.language.formats import FormatSpec
from emulator.language.storage import Storage
from emulator.language.tree import Place
from emulator.numbers.work import STEPS

# Every operation and its meaning.  An operation is the index of its name; the names below have the same order.
MEANINGS = {
    "TOFAC": "field to FAC",
    "FMFAC": "FAC to field",
    "FAD": "FAC + field",
    "FSB": "FAC - field",
    "FSBR": "field - FAC: subtract, then reverse the sign",
    "FMP": "FAC * field",
    "FDV": "FAC / field",
    "FDVR": "field / FAC",
    "TOFIX": "field to fixed accumulator",
    "FMFIX": "fixed accumulator to field",
    "XAD": "fixed add",
    "XSB": "fixed subtract",
    "XSBR": "fixed subtract, reversed",
    "XMP": "fixed multiply",
    "XDV": "fixed divide",
    "XDVR": "fixed divide, reversed",
    "SEND": "field to be transmitted unchanged",
    "TRANSMIT": "transmit field",
    "ITEM": "one number of an input or output list",
    "COUNT": "a statement begins",
    "BRANCH": "go to",
    "IF": "branch on FAC negative, zero, positive",
    "IFX": "branch on the fixed accumulator",
    "RSGN": "reverse the sign of FAC, of a zero too",
    "RSGX": "reverse the sign, fixed",
    "DOTEST": "add the step to the variable of a DO, and branch back if it does not exceed the limit",
    "SELECT": "computed go to",
    "SWITCH": "branch on a sense switch, or with 9 on the last card",
    "FLOAT": "fixed to floating",
    "FIX": "floating to fixed",
    "FUNCTION": "library function of FAC",
    "POWER": "field ** FAC",
    "POWERX": "FAC ** fixed field",
    "BEGIN": "input or output begins",
    "FINISH": "the list ends",
    "PAUSE": "halt until START",
    "STOP": "end of the run",
}

NAMES = tuple(MEANINGS)

TOFAC, FMFAC, FAD, FSB, FSBR, FMP, FDV, FDVR = range(8)
TOFIX, FMFIX, XAD, XSB, XSBR, XMP, XDV, XDVR = range(8, 16)
SEND, TRANSMIT, ITEM, COUNT, BRANCH, IF, IFX, RSGN, RSGX, DOTEST = range(16, 26)
SELECT, SWITCH, FLOAT, FIX, FUNCTION, POWER, POWERX, BEGIN, FINISH, PAUSE, STOP = range(26, len(NAMES))


@dataclass(frozen=True, slots=True)
class Instruction:
    """An instruction of object code: operation, address, subscript and second operand, all integers."""

    operation: int
    address: int
    subscript: int
    second: int


@dataclass(frozen=True, slots=True)
class Subscript:
    """A variable subscript: element ``(c1*v1 + o1, c2*v2 + o2)`` of an array of ``rows`` by ``columns``.

    ``v1`` and ``v2`` are the addresses of fixed-point variables, or -1 for a constant.  ``columns`` is 0 for an array
    of one dimension.
    """

    array: int
    v1: int
    c1: int
    o1: int
    rows: int
    v2: int = -1
    c2: int = 0
    o2: int = 1
    columns: int = 0


def repeats(instruction: Instruction) -> int:
    """Return how many times in a row an instruction is executed: an ITEM once for each field, others once."""
    return abs(instruction.second) if instruction.operation == ITEM else 1


def element_after(element: int, second: int) -> int:
    """Return the number of the array element that a list transfers after ``element``, or 0 after the last one.

    ``second`` is the second operand of the ITEM instruction: the number of elements, negative for fixed point.
    """
    return element + 1 if element + 1 < abs(second) else 0


# The names of a COUNT in the body of an indexed list, and of a COUNT after the list.  Each pass through the body counts
# as a statement for the limit.
LIST_PASS, LIST_REST = "pass of the list", "rest of the list"


@dataclass(frozen=True, slots=True)
class Counter:
    """The data of a COUNT instruction, which counts the executions of a statement or of a part of a statement.

    ``statement`` is an index into :attr:`Program.statements`.  ``begins`` is True at the beginning of the statement,
    and False for the closing of a DO or the body of an indexed list.
    """

    statement: int
    begins: bool
    what: str


@dataclass(frozen=True, slots=True)
class Line:
    """A statement as messages and traces show it.

    ``effect`` is the kind of result that a trace shows: ``store``, ``test``, ``test fixed``, ``list`` (the numbers of
    an input or output list) or empty.  ``index`` is the position in :attr:`Program.statements`.
    """

    label: int
    place: Place
    text: str
    effect: str = ""
    index: int = 0

    @property
    def name(self) -> str:
        """The name of a statement in messages: its card, and its statement number if it has one."""
        card = f"card {self.place.card}"
        return f"statement {self.label} ({card})" if self.label else f"the statement on {card}"


@dataclass(frozen=True)
class Program:
    """A compiled program: everything the engine needs, as plain data.

    ``format_lines`` holds for each FORMAT the number of statements that precede it.
    """

    source: str
    code: tuple[Instruction, ...]
    subscripts: tuple[Subscript, ...]
    branches: tuple[tuple[int, ...], ...]
    loops: tuple[tuple[int, int, int, int], ...]
    counters: tuple[Counter, ...]
    formats: tuple[tuple[int, FormatSpec], ...]
    format_lines: tuple[int, ...]
    storage: Storage
    statements: tuple[Line, ...]
    verbs: tuple[str, ...]
    functions: tuple[str, ...]

    def __hash__(self) -> int:
        # Caches use programs as keys; the hash of all instructions would take milliseconds.
        return hash((self.source, len(self.code)))

    @cached_property
    def flat(self) -> Flat:
        """The object code as flat sequences of integers; see :class:`Flat`."""
        return flatten(self)

    def uses(self, *verbs: str) -> bool:
        """Return True if the program has an input or output statement with one of these verbs, such as READ."""
        return any(i.operation == BEGIN and self.verbs[i.address] in verbs for i in self.code)

    def line_at(self, pc: int) -> Line:
        """Return the FORTRAN statement to which the instruction at index ``pc`` belongs."""
        return self.statements[self.statement_numbers[min(pc, len(self.code) - 1)]]

    @cached_property
    def statement_numbers(self) -> tuple[int, ...]:
        """The index of the FORTRAN statement to which each instruction belongs."""
        numbers: list[int] = []
        statement = 0
        for instruction in self.code:
            if instruction.operation == COUNT:
                statement = self.counters[instruction.address].statement
            numbers.append(statement)
        return tuple(numbers)


# The number of the indicator that the reader turns on when it reads the last card.  A test turns the indicator off, as
# we found by executing PDQ FORTRAN.
LAST_CARD = 9

# The number of entries of :attr:`Flat.table` per subscript.
SUBSCRIPT = 8


class Flat(NamedTuple):
    """Object code as flat sequences of integers, the form that both engines execute.

    The first four sequences have one entry per instruction: operation, address, index into ``table`` (-1 without a
    subscript), and second operand.  ``table`` holds the eight integers of the first :class:`Subscript`, then those of
    the second, and so on.  ``targets`` holds the branch tables, each preceded by its length.  ``loops`` holds four
    numbers per loop: variable, step, limit, and first instruction.  ``begins`` holds 1 for a counter at which a
    statement begins, 2 for one at which a pass of an indexed list begins, and 0 for any other counter.  ``charges``
    holds what each counter adds to the work of the run: 1 if ``begins`` is not 0, and 1 more for every STEPS operations
    up to the next counter (emulator/numbers/work.py).  ``fields`` is the number of fields that a subscript may reach.
    """

    operations: Sequence[int]
    addresses: Sequence[int]
    subscripts: Sequence[int]
    seconds: Sequence[int]
    table: Sequence[int]
    targets: Sequence[int]
    loops: Sequence[int]
    begins: Sequence[int]
    charges: Sequence[int]
    fields: int


def flatten(program: Program) -> Flat:
    """Return the object code of a program as flat sequences of integers."""
    targets: list[int] = []
    starts: list[int] = []
    # A branch table is flattened to its length and its targets, and instructions refer to its start.
    for branch in program.branches:
        targets.append(len(branch))
        starts.append(len(targets))
        targets.extend(branch)
    operations, addresses, subscripts, seconds = [], [], [], []
    for instruction in program.code:
        address, second = instruction.address, instruction.second
        if instruction.operation in (BRANCH, IF, IFX, SWITCH):
            address = starts[address]
        elif instruction.operation == SELECT:
            second = starts[second]
        # Each loop takes four entries of ``loops``.
        elif instruction.operation == DOTEST:
            address *= 4
        operations.append(instruction.operation)
        addresses.append(address)
        subscripts.append(SUBSCRIPT * instruction.subscript if instruction.subscript >= 0 else -1)
        seconds.append(second)
    table = [n for s in program.subscripts for n in (s.v1, s.c1, s.o1, s.rows, s.v2, s.c2, s.o2, s.columns)]
    loops = [n for loop in program.loops for n in loop]
    begins = [1 if c.begins else 2 if c.what == LIST_PASS else 0 for c in program.counters]
    # The work of a section depends on the number of its operations.  List items are counted when they are transferred.
    lengths = [0] * len(program.counters)
    counter = 0
    for instruction in program.code:
        if instruction.operation == COUNT:
            counter = instruction.address
        elif instruction.operation != ITEM:
            lengths[counter] += 1
    charges = [int(begun > 0) + length // STEPS for begun, length in zip(begins, lengths, strict=True)]
    fields = program.storage.fields
    return Flat(operations, addresses, subscripts, seconds, table, targets, loops, begins, charges, fields)

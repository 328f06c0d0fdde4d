"""The time a run would take on a 1620 Model 1: the count of each operation multiplied by its time.

The times of floating-point operations are those of IBM's subroutines, computed from traces of their instructions with
the formulas of the reference card X26-5743-2 (plus or minus 10 %).  The times of single instructions are those of the
card.  No source gives the times of subscripts, number conversion and library functions, which are marked as estimates.
The reader reads 250 cards a minute, the punch punches 125, and the typewriter types 10 characters a second (X26-5743-2
p. 1 and 3).
"""

from __future__ import annotations

from collections import Counter as Tally
from dataclasses import dataclass

from emulator.errors import expect
from emulator.language import objectcode as op
from emulator.language.objectcode import Program
from emulator.machine.result import Result

READER_SECONDS = 60 / 250
PUNCH_SECONDS = 60 / 125
TYPEWRITER_SECONDS = 1 / 10


@dataclass(frozen=True, slots=True)
class Cost:
    """The milliseconds that an operation takes, its row in the time table, and whether the time is an estimate."""

    milliseconds: float
    cause: str
    estimated: bool = False


ARITHMETIC, FIXED, CONTROL = "floating point", "fixed point", "control"
SUBSCRIPTS, CONVERSION = "subscripts", "number conversion"


def _costs(cause: str, estimated: bool = False, **milliseconds: float) -> dict[str, Cost]:
    return {operation: Cost(time, cause, estimated) for operation, time in milliseconds.items()}


# The cost of each operation of the object code.
COSTS = {
    **_costs(ARITHMETIC, TOFAC=2, FMFAC=2, FAD=9.5, FSB=12.4, FSBR=12.9, FMP=18.3, FDV=54, FDVR=56, RSGN=0.5),
    **_costs(ARITHMETIC, estimated=True, FUNCTION=150, POWER=300, POWERX=60, FLOAT=3, FIX=3),
    **_costs(FIXED, TOFIX=0.36, FMFIX=0.36, XAD=0.48, XSB=0.48, XSBR=0.7, XMP=3.4, XDV=11.4, XDVR=12, RSGX=0.2),
    **_costs(CONTROL, SEND=0.56, TRANSMIT=0, COUNT=0, BRANCH=0.2, IF=1.2, IFX=0.9, DOTEST=1.2, SELECT=1.5),
    **_costs(CONTROL, SWITCH=0.3, PAUSE=0.16, STOP=0.16),
    **_costs(CONVERSION, BEGIN=3.4, ITEM=0),
    **_costs(CONVERSION, estimated=True, FINISH=2),
}
# COUNT does not exist on the machine and costs nothing.  SEND and TRANSMIT are a single transmit field instruction,
# whose time is assigned to SEND.  The time of an ITEM is that of its conversion, FIELD_COSTS.

SUBSCRIPT = Cost(2.0, SUBSCRIPTS, True)
SUBSCRIPT_2 = Cost(7.0, SUBSCRIPTS, True)
# The cost of a number read (<) or written (>), fitted to runs of examples 1 and 2 as PDQ FORTRAN compiles them.
FIELD_COSTS = {
    **dict.fromkeys(("E<", "F<"), Cost(100, CONVERSION, True)),
    **dict.fromkeys(("E>", "F>"), Cost(180, CONVERSION, True)),
    "I<": Cost(20, CONVERSION, True),
    "I>": Cost(30, CONVERSION, True),
}


@dataclass(frozen=True, slots=True)
class Row:
    """A row of the time table: cause, count, seconds, and whether the seconds include an estimate."""

    cause: str
    count: int
    seconds: float
    estimated: bool = False


@dataclass(frozen=True, slots=True)
class Timing:
    """The time table of a run: rows of the processor and of the devices, counts of operations and of statements."""

    processor: tuple[Row, ...]
    devices: tuple[Row, ...]
    operations: tuple[tuple[str, int], ...]
    statements: tuple[tuple[int, int], ...]

    @property
    def processor_seconds(self) -> float:
        return sum(row.seconds for row in self.processor)

    @property
    def seconds(self) -> float:
        """The sum of all rows, an upper bound: the buffered reader and punch can overlap with the processor."""
        return self.processor_seconds + sum(row.seconds for row in self.devices)


def measure(program: Program, result: Result) -> Timing:
    """Return the time table of a run.  Its ``statements`` pair an index into ``program.statements`` with a count."""
    expect(program, Program, "program")
    expect(result, Result, "result")
    operations: Tally[str] = Tally()
    subscripts: Tally[int] = Tally()
    times = 0
    # All instructions up to the next COUNT run equally often.  After a run that ends within a statement, the table
    # includes the rest of that statement.
    for instruction in program.code:
        if instruction.operation == op.COUNT:
            times = result.counts[instruction.address]
        operations[op.NAMES[instruction.operation]] += times * op.repeats(instruction)
        if instruction.subscript >= 0:
            subscripts[2 if program.subscripts[instruction.subscript].columns else 1] += times
    # A row of the table is the sum of all operations with one cause.
    operations.pop("COUNT")
    causes: dict[str, list[tuple[int, Cost]]] = {}
    for name, count in operations.items():
        causes.setdefault(COSTS[name].cause, []).append((count, COSTS[name]))
    causes.setdefault(SUBSCRIPTS, []).extend([(subscripts[1], SUBSCRIPT), (subscripts[2], SUBSCRIPT_2)])
    for kind, count in result.numbers:
        causes.setdefault(CONVERSION, []).append((count, FIELD_COSTS[kind]))
    processor = tuple(
        _row(cause, causes.get(cause, [])) for cause in (ARITHMETIC, FIXED, SUBSCRIPTS, CONTROL, CONVERSION)
    )
    punched, typed = result.cards_punched, result.characters_typed
    devices = (
        Row("card reader", result.cards_read, result.cards_read * READER_SECONDS),
        Row("card punch", punched, punched * PUNCH_SECONDS),
        Row("typewriter", typed, typed * TYPEWRITER_SECONDS),
    )
    statements: Tally[int] = Tally()
    for counter, count in zip(program.counters, result.counts, strict=True):
        if counter.begins:
            statements[counter.statement] += count
    return Timing(
        processor,
        devices,
        tuple(sorted((n, c) for n, c in operations.items() if c)),
        tuple(sorted((n, c) for n, c in statements.items() if c)),
    )


def shares(program: Program, result: Result) -> tuple[float, ...]:
    """Return the processor seconds of each statement of ``program.statements``; their sum is that of :func:`measure`.

    The conversion of numbers is not counted for each statement.  The total time for each kind of field is divided among
    the statements in proportion to the numbers in their lists.
    """
    seconds = [0.0] * len(program.statements)
    lists: dict[str, Tally[int]] = {}
    times, direction = 0, ""
    for instruction, statement in zip(program.code, program.statement_numbers, strict=True):
        milliseconds = COSTS[op.NAMES[instruction.operation]].milliseconds
        if instruction.operation == op.COUNT:
            times = result.counts[instruction.address]
        elif instruction.operation == op.BEGIN:
            direction = "<" if program.verbs[instruction.address] in ("READ", "ACCEPT") else ">"
        elif instruction.operation == op.ITEM:
            mode = "I" if instruction.second < 0 else "E"
            lists.setdefault(mode + direction, Tally())[statement] += times * op.repeats(instruction)
        if instruction.subscript >= 0:
            two = program.subscripts[instruction.subscript].columns
            milliseconds += (SUBSCRIPT_2 if two else SUBSCRIPT).milliseconds
        seconds[statement] += times * milliseconds / 1000
    # An instruction distinguishes only fixed from floating point, so F fields are counted as E fields, which cost the
    # same.
    conversion: dict[str, float] = {}
    for kind, count in result.numbers:
        mode = kind.replace("F", "E")
        conversion[mode] = conversion.get(mode, 0.0) + count * FIELD_COSTS[kind].milliseconds / 1000
    for kind, listed in lists.items():
        for statement, count in listed.items():
            seconds[statement] += conversion.get(kind, 0.0) * count / (listed.total() or 1)
    return tuple(seconds)


def _row(cause: str, costs: list[tuple[int, Cost]]) -> Row:
    # An ITEM costs nothing and is not counted here, because its conversion is counted by kind of field.
    used = [(count, cost) for count, cost in costs if count]
    count = sum(count for count, cost in used if cost.milliseconds or cause != CONVERSION)
    seconds = sum(count * cost.milliseconds for count, cost in used) / 1000
    return Row(cause, count, seconds, any(cost.estimated for _, cost in used))

"""Machine time on a 1620 Model 1: what the object code did, times what it took.

Floating-point times are those of IBM's own subroutines, computed from executed instruction traces and the
formulas of the reference card X26-5743-2 (plus or minus 10 %); instruction times are the card's; what no
source gives (subscripts, number conversion, library functions) is an estimate and marked as one.  Reader 250
and punch 125 cards a minute, typewriter 10 characters a second (X26-5743-2 p. 1 and 3).
"""

from __future__ import annotations

from collections import Counter as Tally
from dataclasses import dataclass

from emulator.language import objectcode as op
from emulator.language.objectcode import Program
from emulator.machine.result import Result

READER_SECONDS = 60 / 250
PUNCH_SECONDS = 60 / 125
TYPEWRITER_SECONDS = 1 / 10


@dataclass(frozen=True, slots=True)
class Cost:
    """Milliseconds of an operation, the cause it is booked under, and whether the figure is an estimate."""

    milliseconds: float
    cause: str
    estimated: bool = False


ARITHMETIC, FIXED, CONTROL, SUBSCRIPTS, CONVERSION = (
    "floating point",
    "fixed point",
    "control",
    "subscripts",
    "number conversion",
)

COSTS: dict[str, Cost] = {
    "TOFAC": Cost(2.0, ARITHMETIC),
    "FMFAC": Cost(2.0, ARITHMETIC),
    "FAD": Cost(9.5, ARITHMETIC),
    "FSB": Cost(12.4, ARITHMETIC),
    "FSBR": Cost(12.9, ARITHMETIC),
    "FMP": Cost(18.3, ARITHMETIC),
    "FDV": Cost(54.0, ARITHMETIC),
    "FDVR": Cost(56.0, ARITHMETIC),
    "RSGN": Cost(0.5, ARITHMETIC),
    "FUNCTION": Cost(150.0, ARITHMETIC, True),
    "POWER": Cost(300.0, ARITHMETIC, True),
    "POWERX": Cost(60.0, ARITHMETIC, True),
    "FLOAT": Cost(3.0, ARITHMETIC, True),
    "FIX": Cost(3.0, ARITHMETIC, True),
    "SEND": Cost(0.56, CONTROL),
    "TRANSMIT": Cost(0.0, CONTROL),
    "TOFIX": Cost(0.36, FIXED),
    "FMFIX": Cost(0.36, FIXED),
    "XAD": Cost(0.48, FIXED),
    "XSB": Cost(0.48, FIXED),
    "XSBR": Cost(0.7, FIXED),
    "XMP": Cost(3.4, FIXED),
    "XDV": Cost(11.4, FIXED),
    "XDVR": Cost(12.0, FIXED),
    "RSGX": Cost(0.2, FIXED),
    "COUNT": Cost(0.0, CONTROL),
    "BRANCH": Cost(0.2, CONTROL),
    "IF": Cost(1.2, CONTROL),
    "IFX": Cost(0.9, CONTROL),
    "DOTEST": Cost(1.2, CONTROL),
    "SELECT": Cost(1.5, CONTROL),
    "SWITCH": Cost(0.3, CONTROL),
    "BEGIN": Cost(3.4, CONVERSION),
    "ITEM": Cost(0.0, CONVERSION),
    "FINISH": Cost(2.0, CONVERSION, True),
    "PAUSE": Cost(0.16, CONTROL),
    "STOP": Cost(0.16, CONTROL),
}
"""Cost of each operation of the object code."""

SUBSCRIPT = Cost(2.0, SUBSCRIPTS, True)
SUBSCRIPT_2 = Cost(7.0, SUBSCRIPTS, True)
FIELD_COSTS = {
    "E<": Cost(100.0, CONVERSION, True),
    "F<": Cost(100.0, CONVERSION, True),
    "I<": Cost(20.0, CONVERSION, True),
    "E>": Cost(180.0, CONVERSION, True),
    "F>": Cost(180.0, CONVERSION, True),
    "I>": Cost(30.0, CONVERSION, True),
}
"""Cost of a number read (<) or written (>), fitted to runs of examples 1 and 2 compiled by PDQ FORTRAN."""


@dataclass(frozen=True, slots=True)
class Row:
    """One row of the time table: a cause, how often, seconds, and whether an estimate went into it."""

    cause: str
    count: int
    seconds: float
    estimated: bool = False


@dataclass(frozen=True, slots=True)
class Timing:
    """A run's time table: processor rows, device rows, and counts of operations and of statements."""

    processor: tuple[Row, ...]
    devices: tuple[Row, ...]
    operations: tuple[tuple[str, int], ...]
    statements: tuple[tuple[int, int], ...]

    @property
    def processor_seconds(self) -> float:
        return sum(row.seconds for row in self.processor)

    @property
    def seconds(self) -> float:
        """All rows added: reader and punch are buffered and may in part run beside the processor, so at most this."""
        return self.processor_seconds + sum(row.seconds for row in self.devices)


def measure(program: Program, result: Result) -> Timing:
    """The time table of a run.  ``statements`` pairs an index into ``program.statements`` with its count."""
    operations: Tally[str] = Tally()
    subscripts: Tally[int] = Tally()
    times = 0
    for instruction in program.code:
        if instruction.operation == op.COUNT:
            times = result.counts[instruction.address]
        operations[op.NAMES[instruction.operation]] += times * op.repeats(instruction)
        if instruction.subscript >= 0:
            subscripts[2 if program.subscripts[instruction.subscript].columns else 1] += times
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
    """Processor seconds of each statement of ``program.statements``; together those of :func:`measure`.

    A number of a list is booked where the list stands.  A statement the run ended in may have done less than its count
    says: the time of all numbers of a kind is shared out by how often their lists began.
    """
    seconds = [0.0] * len(program.statements)
    lists: dict[str, Tally[int]] = {}
    times, way = 0, ""
    for instruction, statement in zip(program.code, program.statement_numbers, strict=True):
        milliseconds = COSTS[op.NAMES[instruction.operation]].milliseconds
        if instruction.operation == op.COUNT:
            times = result.counts[instruction.address]
        elif instruction.operation == op.BEGIN:
            way = "<" if program.verbs[instruction.address] in ("READ", "ACCEPT") else ">"
        elif instruction.operation == op.ITEM:
            mode = "I" if instruction.second < 0 else "E"
            lists.setdefault(mode + way, Tally())[statement] += times * op.repeats(instruction)
        if instruction.subscript >= 0:
            two = program.subscripts[instruction.subscript].columns
            milliseconds += (SUBSCRIPT_2 if two else SUBSCRIPT).milliseconds
        seconds[statement] += times * milliseconds / 1000
    took: dict[str, float] = {}
    for kind, count in result.numbers:
        mode = kind.replace("F", "E")
        took[mode] = took.get(mode, 0.0) + count * FIELD_COSTS[kind].milliseconds / 1000
    for kind, begun in lists.items():
        for statement, count in begun.items():
            seconds[statement] += took.get(kind, 0.0) * count / (begun.total() or 1)
    return tuple(seconds)


def _row(cause: str, costs: list[tuple[int, Cost]]) -> Row:
    used = [(count, cost) for count, cost in costs if count]
    count = sum(count for count, cost in used if cost.milliseconds or cause != CONVERSION)
    seconds = sum(count * cost.milliseconds for count, cost in used) / 1000
    return Row(cause, count, seconds, any(cost.estimated for _, cost in used))

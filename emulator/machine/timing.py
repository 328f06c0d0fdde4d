"""The time a run would take on a 1620 Model 1: the count of each operation multiplied by its time.

The times were measured by running small programs with IBM's library of 1962 in a simulator that adds the published time
of each instruction (A26-5706-3, X26-5743-2; ``python -m modern.bench.ibm1962 times``).  The model's object code and
library are those of the only known deck that IBM's own compiler punched.  :data:`MODEL` bounds the systematic error.
Only the times of library functions and of powers A**B with a floating-point B, which do not occur in that deck, are
estimates.

The reader reads 250 cards a minute, the punch punches 125, and the typewriter types 10 characters a second (X26-5743-2
p. 1 and 3).
"""

from __future__ import annotations

from collections import Counter as Tally
from collections.abc import Iterator
from dataclasses import dataclass
from math import inf

from emulator.errors import expect
from emulator.language import objectcode as op
from emulator.language.objectcode import Instruction, Program
from emulator.machine.result import Result

READER_SECONDS = 60 / 250
PUNCH_SECONDS = 60 / 125
TYPEWRITER_SECONDS = 1 / 10


@dataclass(frozen=True, slots=True)
class Cost:
    """The milliseconds that an operation takes, its row in a :class:`Timing`, and True if the time is an estimate."""

    milliseconds: float
    cause: str
    estimated: bool = False


ARITHMETIC, FIXED, CONTROL = "floating point", "fixed point", "control"
SUBSCRIPTS, CONVERSION = "subscripts", "number conversion"


def _costs(cause: str, estimated: bool = False, **milliseconds: float) -> dict[str, Cost]:
    return {operation: Cost(time, cause, estimated) for operation, time in milliseconds.items()}


# The cost of each operation of the object code.  Copying a field loads and stores it by two calls of the library.
COSTS = {
    **_costs(ARITHMETIC, TOFAC=2.6, FMFAC=2.6, FAD=9.5, FSB=12.4, FSBR=14, FMP=18.3, FDV=54, FDVR=56, RSGN=1.6),
    **_costs(ARITHMETIC, POWERX=82, FLOAT=21.8, FIX=13),
    **_costs(ARITHMETIC, estimated=True, FUNCTION=150, POWER=300),
    **_costs(FIXED, TOFIX=2.4, FMFIX=2.4, XAD=1.9, XSB=2.4, XSBR=4, XMP=5.2, XDV=14.8, XDVR=16, RSGX=1.6),
    **_costs(CONTROL, SEND=5, TRANSMIT=0, COUNT=0, BRANCH=0.2, IF=1.4, IFX=1, DOTEST=1.2, SELECT=4.2),
    **_costs(CONTROL, SWITCH=0.3, PAUSE=0.16, STOP=0.16),
    **_costs(CONVERSION, BEGIN=0, ITEM=0, FINISH=0),
}
# COUNT does not exist on the machine and costs nothing.  An ITEM takes the time of converting its number (FIELD_COSTS).
# The time of BEGIN and FINISH is counted for each record (RECORD_COSTS), because a list can use several records.

SUBSCRIPT = Cost(1.2, SUBSCRIPTS)
SUBSCRIPT_2 = Cost(4.7, SUBSCRIPTS)
# The cost of a number read (<) or written (>), at the usual widths E14.8, F10.4 and I3.
_FIELD_TIMES = {"E<": 150, "F<": 107, "I<": 41, "E>": 80, "F>": 54, "I>": 32}
FIELD_COSTS = {kind: Cost(time, CONVERSION) for kind, time in _FIELD_TIMES.items()}
# The cost of a card read (<), or of a card or line written (>).  The library prepares each column of a record.
RECORD_COSTS = {"<": Cost(22, CONVERSION), ">": Cost(319, CONVERSION)}

# The systematic error: the least and the greatest ratio of the processor time with IBM's library to that of this model.
# The bounds that follow from these ratios hold for all runs of docs/ibm1962/times.csv.  The conversion of numbers takes
# less time if many of them are zero.
MODEL = (0.97, 1.03)
CONVERSION_MODEL = (0.65, 1.1)


@dataclass(frozen=True, slots=True)
class Time:
    """Seconds on a 1620, with the bounds of the model's systematic error."""

    seconds: float = 0.0
    low: float = 0.0
    high: float = 0.0

    def __add__(self, other: Time) -> Time:
        return Time(self.seconds + other.seconds, self.low + other.low, self.high + other.high)

    def times(self, factor: float) -> Time:
        """Return the time multiplied by a factor, such as 1 / 60 for minutes."""
        return Time(factor * self.seconds, factor * self.low, factor * self.high)

    @property
    def interval(self) -> str:
        """The bounds as text, or ``nominal`` for the times of reader, punch and typewriter, which the manual states."""
        return "nominal" if self.low == self.high else f"{self.low:.1f} to {self.high:.1f}"

    def __str__(self) -> str:
        """Return the time and its bounds in milliseconds, seconds or minutes: ``76.8 (67.0 to 80.1) s``."""
        limits = ((0.1, 1000, "ms"), (120.0, 1, "s"), (inf, 1 / 60, "min"))
        factor, unit = next((factor, unit) for limit, factor, unit in limits if self.seconds < limit)
        time = self.times(factor)
        return f"{time.seconds:.1f} ({time.interval}) {unit}" if self.seconds else "0 s"


def modelled(seconds: float, cause: str = "") -> Time:
    """Return a processor time with the limits that follow from the model's systematic error.

    ``cause`` is the cause of a :class:`Row`. The conversion of numbers has its own limits.
    """
    low, high = CONVERSION_MODEL if cause == CONVERSION else MODEL
    return Time(seconds, low * seconds, high * seconds)


def nominal(seconds: float) -> Time:
    """Return a time that the manual states, for the reader, punch or typewriter, without a systematic error."""
    return Time(seconds, seconds, seconds)


@dataclass(frozen=True, slots=True)
class Row:
    """A row of a :class:`Timing`: what takes the time, how often, the time, and if it includes an estimate."""

    cause: str
    count: int
    time: Time
    estimated: bool = False


@dataclass(frozen=True, slots=True)
class Timing:
    """The times of a run: rows of the processor and of the devices, counts of operations and of statements."""

    processor: tuple[Row, ...]
    devices: tuple[Row, ...]
    operations: tuple[tuple[str, int], ...]
    statements: tuple[tuple[int, int], ...]

    @property
    def processor_time(self) -> Time:
        return sum((row.time for row in self.processor), Time())

    @property
    def time(self) -> Time:
        """The total time: an upper bound, because the buffered reader and punch can overlap with the processor."""
        return sum((row.time for row in self.devices), self.processor_time)


def measure(program: Program, result: Result) -> Timing:
    """Return the time table of a run.

    The attribute ``statements`` of the table has pairs of an index into ``program.statements`` and the number of times
    that the statement was executed.
    """
    expect(program, Program, "program")
    expect(result, Result, "result")
    operations: Tally[str] = Tally()
    subscripts: Tally[int] = Tally()
    for instruction, times in _executions(program, result):
        operations[op.NAMES[instruction.operation]] += times * op.repeats(instruction)
        if instruction.subscript >= 0:
            subscripts[2 if program.subscripts[instruction.subscript].columns else 1] += times
    # A row of the table is the sum of all operations with one cause.
    operations.pop("COUNT")
    causes: dict[str, list[tuple[int, Cost]]] = {}
    for name, count in operations.items():
        causes.setdefault(COSTS[name].cause, []).append((count, COSTS[name]))
    causes.setdefault(SUBSCRIPTS, []).extend([(subscripts[1], SUBSCRIPT), (subscripts[2], SUBSCRIPT_2)])
    records = _records(program, result)
    conversions = [(count, FIELD_COSTS[kind]) for kind, count in result.numbers]
    causes.setdefault(CONVERSION, []).extend([*conversions, *((n, RECORD_COSTS[way]) for way, n in records.items())])
    processor = tuple(
        _row(cause, causes.get(cause, [])) for cause in (ARITHMETIC, FIXED, SUBSCRIPTS, CONTROL, CONVERSION)
    )
    punched, typed = result.cards_punched, result.characters_typed
    devices = (
        Row("card reader", result.cards_read, nominal(result.cards_read * READER_SECONDS)),
        Row("card punch", punched, nominal(punched * PUNCH_SECONDS)),
        Row("typewriter", typed, nominal(typed * TYPEWRITER_SECONDS)),
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


def shares(program: Program, result: Result) -> tuple[Time, ...]:
    """Return the processor time of each statement of ``program.statements``.

    The sum of these times is the processor time that :func:`measure` gives.  Records and conversions of numbers are not
    counted for each statement.  The total time for each kind of field is divided among the statements in proportion to
    the numbers in their lists.  The total time for records is divided in proportion to the executions of the
    statements.
    """
    times_of = [Time()] * len(program.statements)
    lists: dict[str, Tally[int]] = {}
    direction = ""
    for (instruction, times), statement in zip(_executions(program, result), program.statement_numbers, strict=True):
        milliseconds = COSTS[op.NAMES[instruction.operation]].milliseconds
        if instruction.operation == op.BEGIN:
            verb = program.verbs[instruction.address]
            direction = "<" if verb in ("READ", "ACCEPT") else ">"
            if verb != "ACCEPT":
                lists.setdefault(direction, Tally())[statement] += times
        elif instruction.operation == op.ITEM:
            mode = "I" if instruction.second < 0 else "E"
            lists.setdefault(mode + direction, Tally())[statement] += times * op.repeats(instruction)
        if instruction.subscript >= 0:
            two = program.subscripts[instruction.subscript].columns
            milliseconds += (SUBSCRIPT_2 if two else SUBSCRIPT).milliseconds
        times_of[statement] += modelled(times * milliseconds / 1000)
    # An ITEM instruction distinguishes only fixed from floating point, so the times of E and F fields are added.
    conversion = {way: n * RECORD_COSTS[way].milliseconds / 1000 for way, n in _records(program, result).items()}
    for kind, count in result.numbers:
        mode = kind.replace("F", "E")
        conversion[mode] = conversion.get(mode, 0.0) + count * FIELD_COSTS[kind].milliseconds / 1000
    for kind, listed in lists.items():
        for statement, count in listed.items():
            times_of[statement] += modelled(conversion.get(kind, 0.0) * count / (listed.total() or 1), CONVERSION)
    return tuple(times_of)


def _records(program: Program, result: Result) -> dict[str, int]:
    """Return the number of cards read, as ``<``, and the number of cards and lines written, as ``>``.

    Each execution of a statement that types counts as one line.
    """
    begins = [pair for pair in _executions(program, result) if pair[0].operation == op.BEGIN]
    typed = sum(times for begin, times in begins if program.verbs[begin.address] in ("TYPE", "PRINT"))
    return {"<": result.cards_read, ">": result.cards_punched + typed}


def _executions(program: Program, result: Result) -> Iterator[tuple[Instruction, int]]:
    # All instructions up to the next COUNT run equally often.  After a run that ends within a statement, the rest of
    # that statement is counted too.
    times = 0
    for instruction in program.code:
        if instruction.operation == op.COUNT:
            times = result.counts[instruction.address]
        yield instruction, times


def _row(cause: str, costs: list[tuple[int, Cost]]) -> Row:
    # An ITEM costs nothing and is not counted here, because its conversion is counted by kind of field.
    used = [(count, cost) for count, cost in costs if count]
    count = sum(count for count, cost in used if cost.milliseconds or cause != CONVERSION)
    seconds = sum(count * cost.milliseconds for count, cost in used) / 1000
    return Row(cause, count, modelled(seconds, cause), any(cost.estimated for _, cost in used))

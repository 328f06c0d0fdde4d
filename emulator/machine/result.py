"""The options and the result of a run, as plain data."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from emulator.language.objectcode import Line, Program
from emulator.machine.endings import Ending, Notice
from emulator.numbers import Number, Numbers, numbers

DEFAULT_LIMIT = 5_000_000
DEFAULT_CORE = 40_000

# If a run reaches its limit, the last LOOP_WINDOW units of its work are examined for a loop.
LOOP_WINDOW = 2_000
PUNCH_COLUMNS = 72
TYPEWRITER_COLUMNS = 87

TRUNCATING = numbers("truncating")


@dataclass(frozen=True, slots=True)
class Options:
    """The options of a run.

    Parameters
    ----------
    numbers
        The arithmetic.
    switches
        The sense switches (1 to 4) that are on.
    core
        Positions of core storage.
    bounds
        With ``strict`` a subscript outside its array ends the run.  With ``core`` such a subscript reaches a
        neighbouring field, as on the machine.
    limit
        The work after which a run ends.  Each statement, pass of an indexed list, number read or written, and record is
        one unit; an operation that takes longer than a statement is several (:mod:`emulator.numbers.work`).
    uncut
        Keep the numbers on the punched cards as they were before the fields truncated them (:attr:`Result.uncut`).
    hopper
        With ``first`` an empty hopper is a normal end at the first READ of the program, which begins a data set.  With
        ``any`` it is a normal end at every READ.
    """

    numbers: Numbers = TRUNCATING
    switches: frozenset[int] = frozenset()
    core: int = DEFAULT_CORE
    bounds: Literal["strict", "core"] = "strict"
    limit: int = DEFAULT_LIMIT
    uncut: bool = False
    hopper: Literal["first", "any"] = "first"


# A punched number: its first column, its number of columns, and its value.
Uncut = tuple[int, int, Number]


@dataclass(frozen=True, slots=True)
class MachineError:
    """An error code of a run, the card of the statement that caused it, and the number of times this happened.

    :func:`emulator.errors.explanations` explains the codes.
    """

    code: str
    card: int
    times: int


@dataclass(frozen=True, slots=True)
class Event:
    """An operation of a device: a card read or punched, or a line typed.

    ``begin`` marks a READ that begins a data set.  For a typed line, ``line`` is the statement that typed it and
    ``decision`` is the last IF or computed GO TO before it.
    """

    what: Literal["begin", "read", "accept", "punch", "type"]
    text: str = ""
    line: Line | None = None
    decision: Line | None = None


@dataclass(frozen=True, slots=True)
class Result:
    """The result of a run.

    Attributes
    ----------
    punched, typed, events
        Cards and lines without trailing blanks, and the events in order.  They are empty if the events went to an
        output function and were not kept.
    statements
        The number of statements executed.
    counts
        The number of executions of each counter of the program.
    characters_typed
        The characters typed, counting the end of a line as one.
    numbers
        The counts of the numbers read and written, as pairs of a text and a count.  The text is the letter of the kind
        of field, followed by ``<`` for numbers read or ``>`` for numbers written.  For example, ``("E<", 5)`` means
        that 5 numbers were read from E fields.
    uncut
        With the option ``uncut``, the floating-point numbers of each punched card with all their digits.
    """

    punched: tuple[str, ...]
    typed: tuple[str, ...]
    ending: Ending
    events: tuple[Event, ...]
    notices: tuple[Notice, ...]
    statements: int
    counts: tuple[int, ...]
    cards_read: int
    cards_punched: int
    characters_typed: int
    numbers: tuple[tuple[str, int], ...]
    errors: tuple[MachineError, ...]
    uncut: tuple[tuple[Uncut, ...], ...] = ()


def statements_begun(program: Program, counts: Sequence[int]) -> int:
    """Return the number of statements that a run began.

    ``counts`` holds the number of executions of each COUNT instruction.
    """
    return sum(n for counter, n in zip(program.counters, counts, strict=True) if counter.begins)


def machine_errors(occurrences: Mapping[tuple[str, int], int]) -> tuple[MachineError, ...]:
    """Return the error codes of a run in order of code and card.

    ``occurrences`` maps each pair of a code and a card to its number of occurrences.
    """
    return tuple(MachineError(code, card, times) for (code, card), times in sorted(occurrences.items()))

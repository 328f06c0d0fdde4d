"""How a run is set up, and what comes out of it: plain data."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from emulator.language.objectcode import Line, Program
from emulator.machine.endings import Ending, Notice
from emulator.numbers import Number, Numbers, numbers

DEFAULT_LIMIT = 5_000_000
DEFAULT_CORE = 40_000

LOOP_WINDOW = 2_000
"""How many statements before the limit a message about a loop looks at."""
PUNCH_COLUMNS = 72
TYPEWRITER_COLUMNS = 87

TRUNCATING = numbers("truncating")


@dataclass(frozen=True, slots=True)
class Options:
    """How a run is set up.  ``switches`` are the sense switches that are on.

    ``hopper``: where an empty hopper is the normal end of a run: at the first card of any READ, or only of the READ
    that a data set begins with, the first of the run.

    ``bounds``: strict stops at a subscript outside its array, core does as the machine did.  ``limit``: how much work a
    run may do: statements begun, passes of indexed lists, numbers read or put out, lines, and for costly operations as
    many as would take their time (:mod:`emulator.numbers.work`).  ``uncut``: the numbers
    punched are kept as they were before the card's field cut them (:attr:`Result.uncut`).
    """

    numbers: Numbers = TRUNCATING
    switches: frozenset[int] = frozenset()
    core: int = DEFAULT_CORE
    bounds: Literal["strict", "core"] = "strict"
    limit: int = DEFAULT_LIMIT
    uncut: bool = False
    hopper: Literal["first", "any"] = "first"


Uncut = tuple[int, int, Number]
"""A number punched: its first column, how many columns it takes, and the number."""


@dataclass(frozen=True, slots=True)
class MachineError:
    """An error code of the arithmetic, the card of the statement it arose in, and how often.

    What a code means: :func:`emulator.errors.explanations`.
    """

    code: str
    card: int
    times: int


@dataclass(frozen=True, slots=True)
class Event:
    """What a device did, in order: ``begin`` (of a data set by READ), ``read``, ``accept``, ``punch``, ``type``.

    Of a line typed, ``line`` is the statement that typed it and ``decision`` the last IF or computed GO TO before it.
    """

    what: Literal["begin", "read", "accept", "punch", "type"]
    text: str = ""
    line: Line | None = None
    decision: Line | None = None


@dataclass(frozen=True, slots=True)
class Result:
    """A finished run: what the devices got, how it ended, and what was counted.

    ``uncut``, where it was asked for, holds for each punched card its floating-point numbers.  ``punched`` and
    ``typed`` are lines without trailing blanks; they and ``events`` hold nothing where events were handed out and not
    kept.  ``characters_typed`` counts the end of a line as one; ``statements`` how many statements began; ``counts``
    how often each counter of the program ran; ``numbers`` how many numbers each kind of field read (``E<``) and put
    out (``E>``).
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


def begun(program: Program, counts: Sequence[int]) -> int:
    """How many statements began, from the counts."""
    return sum(n for counter, n in zip(program.counters, counts, strict=True) if counter.begins)


def machine_errors(found: Mapping[tuple[str, int], int]) -> tuple[MachineError, ...]:
    """Error codes from how often each arose on each card."""
    return tuple(MachineError(code, card, times) for (code, card), times in sorted(found.items()))

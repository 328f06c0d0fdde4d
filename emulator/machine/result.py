"""How a run is set up, and what comes out of it: plain data."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from emulator.numbers.arithmetic import TRUNCATING, Profile
from emulator.numbers.base import Numbers

DEFAULT_LIMIT = 5_000_000
DEFAULT_CORE = 40_000

LOOP_WINDOW = 2_000
"""How many statements before the limit a message about a loop looks at."""
PUNCH_COLUMNS = 72
TYPEWRITER_COLUMNS = 87

NORMAL = ("hopper", "stop", "end")


@dataclass(frozen=True, slots=True)
class Options:
    """How a run is set up.  ``switches`` are the sense switches that are on; ``bounds`` is strict or core.

    ``numbers``, where it is given, takes the place of the profile's decimal numbers.  ``uncut``: the numbers punched
    are kept as they were before the card's field cut them (:attr:`Result.uncut`).
    """

    profile: Profile = TRUNCATING
    switches: frozenset[int] = frozenset()
    core: int = DEFAULT_CORE
    bounds: str = "strict"
    limit: int = DEFAULT_LIMIT
    numbers: Numbers | None = None
    uncut: bool = False


Uncut = tuple[int, int, tuple[Any, int]]
"""A number punched: its first column, how many columns it takes, and the field of storage it comes from."""

ERRORS = {
    "E1": "a sum overflows",
    "E2": "a sum underflows",
    "E3": "a product overflows",
    "E4": "a product underflows",
    "E5": "a quotient overflows",
    "E6": "a quotient underflows",
    "E7": "division by zero",
    "E8": "fixed-point division by zero",
    "F1": "an angle too large for SIN or COS",
    "F2": "LOG of zero, or a power of zero",
    "F3": "LOG of a negative number",
    "F4": "EXP or a power overflows",
    "F5": "EXP or a power underflows",
    "F6": "a power of a negative number",
    "F8": "a number too large for its field",
}
"""The error codes of the subroutines: E1 to E8 executed, F1 to F6 after GOTRAN (C26-5594 p. 28), F8 chosen."""


@dataclass(frozen=True, slots=True)
class Event:
    """What a device did, in order: ``begin`` (of a data set by READ), ``read``, ``accept``, ``punch``, ``type``."""

    what: str
    text: str = ""


@dataclass(frozen=True, slots=True)
class Ending:
    """Why a run ended.

    ``kind``: hopper, stop, end (all normal), limit, bounds, undefined, outside, select, mode, undecided.  ``message``
    is one line for a user, empty for a normal end.
    """

    kind: str
    message: str = ""

    @property
    def normal(self) -> bool:
        return self.kind in NORMAL


@dataclass(frozen=True, slots=True)
class Result:
    """A finished run: what the devices got, how it ended, and what was counted.

    ``uncut``, where it was asked for, holds for each punched card its floating-point numbers.  ``punched`` and
    ``typed`` are lines without trailing blanks; ``counts`` how often each counter of the
    program ran; ``errors`` the arithmetic's error codes with the statement each arose in, and how often.
    """

    punched: tuple[str, ...]
    typed: tuple[str, ...]
    ending: Ending
    events: tuple[Event, ...]
    warnings: tuple[str, ...]
    statements: int
    counts: tuple[int, ...]
    cards_read: int
    numbers: tuple[tuple[str, int], ...]
    errors: tuple[tuple[str, int], ...]
    uncut: tuple[tuple[Uncut, ...], ...] = ()

"""How core is used: the storage of a built-in program from address 0 up, region by region.

What lies where is IBM's order (C26-5619 p. 66-69, :mod:`emulator.language.storage`); the length of the object
program is an estimate (:func:`emulator.language.objectcode.code_positions`), so what is free is one too.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby

from emulator.language.objectcode import code_positions
from emulator.language.storage import CORES, FIELD, FUNCTION_NAMES, OBJECT_PROGRAM, Entry, core_address
from modern.edition import programs
from modern.thesis.capacity import array_lengths, largest

CORE = 40_000
"""Positions of the machine of 1963."""
SYSTEM, PROGRAM, FREE, ARRAY, SINGLE, NAMES = (
    "subroutines and tables",
    "object program",
    "free",
    "array",
    "single fields",
    "names of functions",
)
"""The kinds of regions."""


@dataclass(frozen=True, slots=True)
class Region:
    """Positions from ``low`` to ``high``, both counted in.

    ``name`` is an array's, ``X(51)``; ``fields`` its fields of ten digits, or how many single fields of each kind lie
    there (``variable``, ``constant``, ``temporary``, ``statement number``).  ``estimated``: the length is not known
    exactly.
    """

    kind: str
    low: int
    high: int
    name: str = ""
    fields: tuple[tuple[str, int], ...] = ()
    estimated: bool = False

    @property
    def positions(self) -> int:
        return self.high - self.low + 1


@dataclass(frozen=True, slots=True)
class CoreMap:
    """A program's storage, from address 0 up without a gap.

    ``points``: how many points would fit each size of core, 0 where the program does not; ``lengths``: those of the
    arrays as formulas of the number of points.
    """

    program: str
    regions: tuple[Region, ...]
    points: tuple[tuple[int, int], ...]
    lengths: tuple[str, ...]

    def positions(self, kind: str) -> int:
        """The positions of all regions of a kind."""
        return sum(region.positions for region in self.regions if region.kind == kind)


def core_map(name: str) -> CoreMap:
    """The storage of a built-in program in 40,000 positions.  Raises KeyError."""
    program = programs.program(name)
    code = code_positions(program)
    lowest = core_address(program.storage.fields, CORE) + 1
    regions = (
        Region(SYSTEM, 0, OBJECT_PROGRAM - 1),
        Region(PROGRAM, OBJECT_PROGRAM, OBJECT_PROGRAM + code - 1, estimated=True),
        Region(FREE, OBJECT_PROGRAM + code, lowest - 1, estimated=True),
        *_data(program.storage.entries),
        Region(NAMES, CORE - FUNCTION_NAMES, CORE - 1),
    )
    points = tuple((core, largest(program, core)) for core in CORES)
    return CoreMap(name, regions, points, array_lengths(program))


def _data(entries: tuple[Entry, ...]) -> Iterator[Region]:
    """The regions of the data, lowest first: every array, and single fields that lie side by side as one."""
    for single, group in groupby(reversed(entries), key=lambda entry: not entry.shape):
        if single:
            yield _single(tuple(group))
            continue
        for entry in group:
            name = f"{entry.name}({','.join(map(str, entry.shape))})"
            yield Region(ARRAY, *_ends(entry, entry), name, (("field", entry.size),))


def _single(entries: tuple[Entry, ...]) -> Region:
    return Region(SINGLE, *_ends(entries[0], entries[-1]), "", tuple(Counter(entry.kind for entry in entries).items()))


def _ends(lowest: Entry, highest: Entry) -> tuple[int, int]:
    return core_address(lowest.first + lowest.size - 1, CORE) - FIELD + 1, core_address(highest.first, CORE)

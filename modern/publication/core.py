"""Storage maps: the regions of core storage that a built-in program uses, from address 0 up.

The order of the regions is IBM's (form C26-5619, p. 66-69; :mod:`emulator.language.storage`). The length of the object
program, and therefore the size of the free region, is partly inferred (:mod:`emulator.objectdeck.extent`).
"""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby

from emulator.language.storage import CORES, FIELD, FUNCTION_NAMES, OBJECT_PROGRAM, Entry, core_address
from emulator.objectdeck.extent import code_positions
from modern.edition import programs
from modern.thesis.capacity import largest

# The positions of core storage in the machine of 1963.
CORE = 40_000
SYSTEM, PROGRAM, FREE = "subroutines and tables", "object program", "free"
ARRAY, SINGLE, NAMES = "array", "single fields", "names of functions"
KINDS = (SYSTEM, PROGRAM, FREE, ARRAY, SINGLE, NAMES)


@dataclass(frozen=True, slots=True)
class Region:
    """A region of core storage from address ``low`` to address ``high``, both included.

    ``name`` is the name of an array with its dimensions, such as ``X(51)``. ``fields`` counts the fields of ten digits
    by kind: ``field`` for those of an array, or ``variable``, ``constant``, ``temporary`` and ``statement number``.
    ``estimated`` is True if the length is not known exactly.
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
    """The storage of a program from address 0 up.

    ``points`` pairs each size of core storage with the largest number of points for which the program fits into it, or
    with 0 if the program never fits.
    """

    program: str
    regions: tuple[Region, ...]
    points: tuple[tuple[int, int], ...]

    def positions(self, kind: str) -> int:
        """Return the number of positions in all regions of a kind."""
        return sum(region.positions for region in self.regions if region.kind == kind)


def core_map(name: str) -> CoreMap:
    """Return the storage map of a program on a machine with 40,000 positions. Raise KeyError for an unknown program."""
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
    return CoreMap(name, regions, points)


def _data(entries: tuple[Entry, ...]) -> Iterator[Region]:
    """Return the regions of the data from the lowest address: each array, and each group of adjacent single fields."""
    for single, group in groupby(reversed(entries), key=lambda entry: not entry.shape):
        group_entries = tuple(group)
        if single:
            kinds = Counter(entry.kind for entry in group_entries)
            yield Region(SINGLE, *_ends(group_entries[0], group_entries[-1]), "", tuple(kinds.items()))
            continue
        for entry in group_entries:
            name = f"{entry.name}({','.join(map(str, entry.shape))})"
            yield Region(ARRAY, *_ends(entry, entry), name, (("field", entry.size),))


def _ends(lowest: Entry, highest: Entry) -> tuple[int, int]:
    return core_address(lowest.first + lowest.size - 1, CORE) - FIELD + 1, core_address(highest.first, CORE)

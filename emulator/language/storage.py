"""Where a program's data lie: one ten-digit field for every variable, constant, temporary and statement number.

Fields are assigned downward from the top of core in order of first appearance; an array takes one field an
element, element 1 highest, the arrays of a DIMENSION one after the other without a gap (C26-5619 p. 66-69;
subscripts, and that nothing checks them: executed on IBM's code).  The 120 positions at the top hold the
names of the library functions; the object program begins at 08300 (p. 67).
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass, field
from operator import attrgetter

FIELD = 10
FUNCTION_NAMES = 120
OBJECT_PROGRAM = 8300
CORES = (20000, 40000, 60000)


@dataclass(frozen=True, slots=True)
class Entry:
    """A name's place: first field, number of fields, and its dimensions (empty for a single field)."""

    name: str
    kind: str
    first: int
    size: int
    shape: tuple[int, ...] = ()

    def element(self, index: int) -> str:
        """The name of the field ``index`` fields after the first: ``X(3)``, ``A(2,1)``, or the name itself."""
        if not self.shape:
            return self.name
        if len(self.shape) == 1:
            return f"{self.name}({index + 1})"
        return f"{self.name}({index % self.shape[0] + 1},{index // self.shape[0] + 1})"


@dataclass(frozen=True, slots=True)
class Storage:
    """The storage map: entries in order of address, and the values of the constants by field.

    ``constants`` pairs a field with the constant as written.
    """

    entries: tuple[Entry, ...]
    fields: int
    constants: tuple[tuple[int, str], ...]

    def arrays(self) -> Iterator[Entry]:
        return (entry for entry in self.entries if entry.shape)

    def entry_of(self, address: int) -> Entry:
        """The entry that holds a field.  Raises KeyError for an address outside the data."""
        if not 0 <= address < self.fields:
            raise KeyError(address)
        return self.entries[bisect_right(self.entries, address, key=attrgetter("first")) - 1]

    def name_of(self, address: int) -> str:
        """What a field is called: ``NE``, ``X(3)``, ``constant 4.``."""
        try:
            entry = self.entry_of(address)
        except KeyError:
            return f"field {address}, outside the data"
        return entry.element(address - entry.first)


def core_address(index: int, core: int) -> int:
    """The address of a field's rightmost digit in a machine of ``core`` positions."""
    return core - 1 - FUNCTION_NAMES - FIELD * index


@dataclass
class Allocator:
    """Assigns fields in order of first appearance while a program compiles."""

    entries: dict[tuple[str, str], Entry] = field(default_factory=dict)
    used: int = 0

    def place(self, kind: str, name: str, shape: tuple[int, ...] = ()) -> Entry:
        """The entry of a name of that kind, made at its first appearance."""
        key = (kind, name)
        if key not in self.entries:
            size = 1
            for dimension in shape:
                size *= dimension
            self.entries[key] = Entry(name, kind, self.used, size, shape)
            self.used += size
        return self.entries[key]

    def storage(self) -> Storage:
        entries = tuple(self.entries.values())
        constants = tuple((e.first, e.name.removeprefix("constant ")) for e in entries if e.kind == "constant")
        return Storage(entries, self.used, constants)

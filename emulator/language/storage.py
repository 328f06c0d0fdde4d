"""The storage map: the ten-digit field of every variable, constant, temporary and statement number.

Fields are assigned downward from the top of core in order of first appearance.  An array takes one field per element,
with element 1 at the highest address, and the arrays of one DIMENSION follow each other without a gap (C26-5619
p. 66-69).  The 120 positions at the top hold the names of the library functions.  The object program begins at 08300
(p. 67).  The symbol table of an object deck that IBM's compiler punched in 1962 (docs/reference/object-decks.md) shows
three more rules: a FORMAT takes two fields, the constants of a DO take none, and every product and quotient reserves a
temporary field.
"""

import math
import re
from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass, field
from operator import attrgetter

FIELD = 10
FUNCTION_NAMES = 120
OBJECT_PROGRAM = 8300
CORES = (20000, 40000, 60000)
_PROVISIONAL = 10**9


@dataclass(frozen=True, slots=True)
class Entry:
    """The storage of a variable or array: its first field, number of fields, and dimensions (empty for a variable)."""

    name: str
    kind: str
    first: int
    size: int
    shape: tuple[int, ...] = ()

    def element(self, index: int) -> str:
        """Return the name, such as ``X(3)``, of the array element stored ``index`` fields after the first one."""
        # Arrays of two dimensions are stored column by column: the first subscript varies fastest.
        if not self.shape:
            return self.name
        if len(self.shape) == 1:
            return f"{self.name}({index + 1})"
        return f"{self.name}({index % self.shape[0] + 1},{index // self.shape[0] + 1})"


@dataclass(frozen=True, slots=True)
class Storage:
    """A storage map: the entries in order of address, and the constants.

    ``constants`` pairs the field of each constant with its text in the source.  ``immediates`` has such pairs for the
    constants of DO statements, which have no field on the 1620, because they are parts of instructions.  The emulator
    keeps these constants in additional fields after the last field of the map, which no subscript reaches.  ``fields``
    is the number of fields of the map.
    """

    entries: tuple[Entry, ...]
    fields: int
    constants: tuple[tuple[int, str], ...]
    immediates: tuple[tuple[int, str], ...] = ()

    @property
    def length(self) -> int:
        """The number of storage fields that the emulator keeps, including those for the constants of DO statements."""
        return self.fields + len(self.immediates)

    def arrays(self) -> Iterator[Entry]:
        return (entry for entry in self.entries if entry.shape)

    def entry_of(self, address: int) -> Entry:
        """Return the entry of the map to which a storage field belongs."""
        return self.entries[bisect_right(self.entries, address, key=attrgetter("first")) - 1]

    def fields_of(self, text: str) -> range:
        """Return the fields of a variable, array or element such as ``A(2,1)``: an empty range for an unknown name."""
        parts = re.fullmatch(r"([A-Z][A-Z0-9]*)(?:\((\d{1,4})(?:,(\d{1,4}))?\))?", text)
        named = (e for e in self.entries if parts and e.name == parts[1] and e.kind in ("variable", "array"))
        entry = next(named, None)
        if parts is None or entry is None:
            return range(0)
        subscripts = [int(number) for number in parts.groups()[1:] if number]
        if not subscripts:
            return range(entry.first, entry.first + entry.size)
        if len(subscripts) != len(entry.shape) or any(
            not 1 <= n <= most for n, most in zip(subscripts, entry.shape, strict=True)
        ):
            return range(0)
        # Arrays are stored column by column.
        field = entry.first + subscripts[0] - 1 + (entry.shape[0] * (subscripts[1] - 1) if len(subscripts) > 1 else 0)
        return range(field, field + 1)

    def name_of(self, address: int) -> str:
        """Return the name of the variable, element or constant in a field: ``NE``, ``X(3)`` or ``constant 4.``."""
        if address >= self.fields:
            return f"constant {self.immediates[address - self.fields][1]}"
        entry = self.entry_of(address)
        return entry.element(address - entry.first)


def core_address(index: int, core: int) -> int:
    """Return the address of the rightmost digit of a field in a machine with ``core`` positions."""
    return core - 1 - FUNCTION_NAMES - FIELD * index


@dataclass
class Allocator:
    """The storage map of a program that is being compiled: each name receives a field when it first appears."""

    entries: dict[tuple[str, str], Entry] = field(default_factory=dict)
    used: int = 0
    immediates: dict[str, int] = field(default_factory=dict)

    def immediate(self, text: str) -> int:
        """Return a provisional address for the constant of a DO statement, which :meth:`final` converts."""
        return self.immediates.setdefault(text, _PROVISIONAL + len(self.immediates))

    def final(self, address: int) -> int:
        """Return the final address of a field or DO constant.  Call this after the whole program is translated."""
        return address if address < _PROVISIONAL else address - _PROVISIONAL + self.used

    def place(self, kind: str, name: str, shape: tuple[int, ...] = ()) -> Entry:
        """Return the entry of a name of the given kind, such as ``variable``.  Make the entry if the name is new."""
        key = (kind, name)
        if key not in self.entries:
            size = math.prod(shape)
            self.entries[key] = Entry(name, kind, self.used, size, shape)
            self.used += size
        return self.entries[key]

    def storage(self) -> Storage:
        entries = tuple(self.entries.values())
        constants = tuple((e.first, e.name.removeprefix("constant ")) for e in entries if e.kind == "constant")
        immediates = tuple((self.final(address), text) for text, address in self.immediates.items())
        return Storage(entries, self.used, constants, immediates)

"""The core storage that a program and its data need if IBM's compiler of 1962 compiles the program.

The lengths are those of :mod:`emulator.objectdeck.generator`.  The known object deck does not show every construct, and
the lengths of IBM's function routines are unknown.  :attr:`Extent.inferred` counts the positions that this module
assumes to be needed, without evidence.  A program is rejected only if it does not fit even without these positions.
"""

from dataclasses import dataclass
from functools import lru_cache

from emulator.language import objectcode as op
from emulator.language.objectcode import Program
from emulator.language.storage import CORES, FIELD, FUNCTION_NAMES, OBJECT_PROGRAM
from emulator.objectdeck.generator import generate

# The inferred positions of an instruction's code, in addition to the twelve that are certain.
_INFERRED = {op.IF: 32, op.STOP: 8}


@dataclass(frozen=True, slots=True)
class Extent:
    """The numbers of core positions that data and object program need.

    ``inferred`` is the number of positions in ``code`` that no document confirms.
    """

    data: int
    code: int
    inferred: int

    def excess(self, core: int) -> int:
        """Return by how many positions program and data exceed a machine's core, or a negative number if they fit."""
        return self.data + self.code - _room(core)

    def overlap(self, core: int) -> str:
        """Return the compiler's error message if program and data do not fit a machine, else an empty string."""
        excess, need = self.excess(core), self.data + self.code
        if excess <= 0:
            return ""
        large_enough = next((size for size in CORES if need <= _room(size)), 0)
        advice = f"; --core {large_enough} is large enough" if large_enough else ""
        if self.is_certain(core):
            about = "about " if self.inferred else ""
            room = f"a machine of {core} has {_room(core)} for them"
            return f"OVERLAP: program and data need {about}{need} positions; {room}{advice}"
        return (
            f"OVERLAP is possible: program and data need about {need} positions, {excess} more than a machine of "
            f"{core} has, but {self.inferred} of them are estimated{advice}"
        )

    def is_certain(self, core: int) -> bool:
        """Return True if program and data do not fit a machine even without the positions that are only inferred."""
        return self.excess(core) > self.inferred


def _room(core: int) -> int:
    """Return the number of positions that are free for program and data in a machine with ``core`` positions."""
    return core - OBJECT_PROGRAM - FUNCTION_NAMES


def code_positions(program: Program) -> int:
    """Return the length of the object program in positions, FORMATs included."""
    return extent(program).code


@lru_cache(maxsize=256)
def extent(program: Program) -> Extent:
    """Return how much core storage a program needs."""
    code = generate(program)
    temporaries = sum(entry.kind == "temporary" for entry in program.storage.entries)
    inferred = sum(_INFERRED.get(instruction.operation, 0) for instruction in program.code)
    # This project's function routines stand at the end of the code.
    routines = code.end - min(code.functions.values(), default=code.end)
    inferred += FIELD * temporaries + routines
    return Extent(program.storage.fields * FIELD, code.end - OBJECT_PROGRAM, inferred)

"""Compute for how many points the hull programs fit into the core storage of a 1620.

The programs have arrays with one entry for each of N points, of length 51.  Other arrays have one entry for each plane.
Their length is 98 = 2 x 51 - 4, because a hull of N points in space has at most 2N-4 planes.  With the modern
corrections to the listings (layer ``corrected``) the lengths are N+1 = 52 and 4N-11 = 193 for N = 51.
:mod:`emulator.objectdeck.extent` gives the length of the object program.
"""

from collections.abc import Callable

from emulator.language.objectcode import Program
from emulator.language.storage import FIELD, FUNCTION_NAMES, OBJECT_PROGRAM
from emulator.objectdeck.extent import code_positions

# The array lengths that occur in the hull programs, for 51 points, each with its formula in the number of points N.
_SIZES: dict[int, tuple[str, Callable[[int], int]]] = {
    51: ("N", lambda n: n),
    52: ("N+1", lambda n: n + 1),
    98: ("2N-4", lambda n: max(2 * n - 4, 4)),
    193: ("4N-11", lambda n: max(4 * n - 11, 5)),
}


def data_positions(program: Program, points: int) -> int:
    """Return the number of core positions for a program's data if its arrays have room for this number of points."""
    fields = program.storage.fields
    for entry in program.storage.arrays():
        if entry.size in _SIZES:
            fields += _SIZES[entry.size][1](points) - entry.size
    return fields * FIELD


def largest(program: Program, core: int) -> int:
    """Return the largest number of points for which program and arrays fit into core, or 0 if fewer than 4 fit."""
    available = core - OBJECT_PROGRAM - FUNCTION_NAMES - code_positions(program)
    points = 0
    for candidate in range(4, 1000):
        if data_positions(program, candidate) > available:
            break
        points = candidate
    return points


def array_lengths(program: Program) -> tuple[str, ...]:
    """Return the lengths of a program's arrays as formulas in N, the number of points."""
    lengths = {entry.size for entry in program.storage.arrays()}
    return tuple(_SIZES[length][0] for length in sorted(lengths & _SIZES.keys()))

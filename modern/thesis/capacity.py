"""What number of points fits a machine: the hull programs' arrays against the positions of core.

The arrays of 51 hold a number a point, those of 98 a number a plane: 2N-4 for N points in space.  The layer
``corrected`` has 52 and 193 instead, N+1 and 4N-11 (rows P2-023, P3-028).  The length of the object program is
the estimate of :func:`emulator.language.length.code_positions`.
"""

from __future__ import annotations

from collections.abc import Callable

from emulator.language.objectcode import Program, code_positions
from emulator.language.storage import FIELD, FUNCTION_NAMES, OBJECT_PROGRAM

_SIZES: dict[int, Callable[[int], int]] = {
    51: lambda n: n,
    52: lambda n: n + 1,
    98: lambda n: max(2 * n - 4, 4),
    193: lambda n: max(4 * n - 11, 5),
}
"""Array lengths of the hull programs, at 51 points, as functions of the number of points."""
_FORMULAS = {51: "N", 52: "N+1", 98: "2N-4", 193: "4N-11"}


def data_positions(program: Program, points: int) -> int:
    """The positions a program's data take when its arrays are dimensioned for ``points`` points."""
    fields = program.storage.fields
    for entry in program.storage.arrays():
        size = _SIZES.get(entry.size)
        if size is not None:
            fields += size(points) - entry.size
    return fields * FIELD


def largest(program: Program, core: int) -> int:
    """The largest number of points whose arrays fit beside the program; 0 if not even 4 do."""
    room = core - OBJECT_PROGRAM - FUNCTION_NAMES - code_positions(program)
    points = 0
    for candidate in range(4, 1000):
        if data_positions(program, candidate) > room:
            break
        points = candidate
    return points


def array_lengths(program: Program) -> tuple[str, ...]:
    """The lengths of a program's arrays as the formulas they were dimensioned by, N being the number of points."""
    lengths = {entry.size for entry in program.storage.arrays()}
    return tuple(_FORMULAS[length] for length in sorted(lengths & _FORMULAS.keys()))

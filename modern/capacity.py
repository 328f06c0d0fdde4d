"""What number of points fits a machine: the hull programs' arrays against the positions of core.

The arrays of 51 hold a number a point, those of 98 a number a plane: 2N-4 for N points in space (thesis
p. 3, and OPEN-QUESTIONS on NE).  The length of the object program is the estimate of
:func:`emulator.length.code_positions`.
"""

from __future__ import annotations

from collections.abc import Iterator

from emulator.length import code_positions
from emulator.objectcode import Program
from emulator.storage import FIELD, FUNCTION_NAMES, OBJECT_PROGRAM

POINTS, PLANES = 51, 98


def data_positions(program: Program, points: int) -> int:
    """The positions a program's data take when its arrays are dimensioned for ``points`` points."""
    fields = program.storage.fields
    for entry in program.storage.arrays():
        if entry.shape == (POINTS,):
            fields += points - POINTS
        elif entry.shape == (PLANES,):
            fields += max(2 * points - 4, 4) - PLANES
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


def capacity_lines(program: Program, core: int) -> Iterator[str]:
    """What fits, in words."""
    points = largest(program, core)
    planes = any(entry.shape == (PLANES,) for entry in program.storage.arrays())
    arrays = "arrays of N and of 2N-4 fields" if planes else "arrays of N fields"
    if points:
        yield f"  with {arrays} about {points} points would fit; the thesis's N is {POINTS}"
    else:
        yield f"  with {arrays} the program does not fit"

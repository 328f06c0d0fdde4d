"""What number of points fits a machine: the hull programs' arrays against the positions of core.

The arrays of 51 hold a number a point, those of 98 a number a plane: 2N-4 for N points in space (thesis
p. 3, and OPEN-QUESTIONS on NE).  The length of the object program is an estimate: twelve digits an
instruction, thirty a subscript, two a character of FORMAT.  The thirty is fitted: with it the three programs
differ in length as they do when PDQ FORTRAN compiles them (26136, 21566, 24996), to within 450 positions.
"""

from __future__ import annotations

from collections.abc import Iterator

from emulator import objectcode as op
from emulator.formats import Literal
from emulator.objectcode import Program
from emulator.storage import FIELD, FUNCTION_NAMES, OBJECT_PROGRAM

POINTS, PLANES = 51, 98
_INSTRUCTION = 12
_SUBSCRIPT = 30
_LENGTHS = {
    op.COUNT: 0,
    op.IF: 3,
    op.IFX: 3,
    op.DOTEST: 3,
    op.SELECT: 4,
    op.SWITCH: 2,
    op.TRANSMIT: 0,
    op.SEND: 1,
    op.FSBR: 2,
}


def code_positions(program: Program) -> int:
    """The estimated length of the object program, formats included, in positions."""
    length = 0
    for instruction in program.code:
        length += _INSTRUCTION * _LENGTHS.get(instruction.operation, 1)
        if instruction.operation == op.SELECT:
            length += 5 * len(program.branches[instruction.second])
        if instruction.subscript >= 0:
            length += _SUBSCRIPT * (2 if program.subscripts[instruction.subscript].columns else 1)
    for _, spec in program.formats:
        for part in spec.specs:
            length += 2 * len(part.text) + 4 if isinstance(part, Literal) and not part.skip else 6
    return length


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

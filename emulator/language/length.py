"""How long an object program is, by estimate: no object deck of these programs exists.

Twelve digits an instruction, thirty a subscript, two a character of FORMAT.  The thirty is fitted: with it the
three hull programs differ in length as they do when PDQ FORTRAN compiles them (their code ends at 26136, 21566
and 24996), to within 450 positions.
"""

from __future__ import annotations

from emulator.language import objectcode as op
from emulator.language.formats import Literal
from emulator.language.objectcode import Program

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

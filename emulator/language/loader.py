"""Object code as the engine takes it: flat sequences of integers."""

from __future__ import annotations

from emulator.language import objectcode as op
from emulator.language.objectcode import Program

Flat = tuple[list[int], list[int], list[int], list[int], list[int], list[int], list[int], list[int]]

SUBSCRIPT = 8
"""Numbers in the table for one subscript."""


def flatten(program: Program) -> Flat:
    """(operations, addresses, subscripts, seconds, subscript table, branch targets, loops, begins): see engine.run."""
    targets: list[int] = []
    starts: list[int] = []
    for branch in program.branches:
        targets.append(len(branch))
        starts.append(len(targets))
        targets.extend(branch)
    operations, addresses, subscripts, seconds = [], [], [], []
    for instruction in program.code:
        address, second = instruction.address, instruction.second
        if instruction.operation in (op.BRANCH, op.IF, op.IFX, op.SWITCH):
            address = starts[address]
        elif instruction.operation == op.SELECT:
            second = starts[second]
        elif instruction.operation == op.DOTEST:
            address *= 4
        operations.append(instruction.operation)
        addresses.append(address)
        subscripts.append(SUBSCRIPT * instruction.subscript if instruction.subscript >= 0 else -1)
        seconds.append(second)
    table = [n for s in program.subscripts for n in (s.v1, s.c1, s.o1, s.rows, s.v2, s.c2, s.o2, s.columns)]
    loops = [n for loop in program.loops for n in loop]
    begins = [1 if c.begins else 2 if c.what == op.LIST_PASS else 0 for c in program.counters]
    return operations, addresses, subscripts, seconds, table, targets, loops, begins

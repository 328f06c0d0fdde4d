"""The engine over numbers of Python: the same object code, registers and reasons to return as
emulator/compiled/kernel.py.

A field's number is in ``values`` and what it is in ``kinds``: FIXED_POINT, UNDEFINED, or FLOATING for a number of
the system.  What the run is asked for goes into a :class:`Journal`: every decision, and with ``stores`` every
statement begun and every field changed, so that two runs can be compared without stopping them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from emulator.compiled.kernel import (
    ADDRESS,
    AT,
    AT_BEGIN,
    AT_BOUNDS,
    AT_EVENT,
    AT_FINISH,
    AT_FUNCTION,
    AT_ITEM,
    AT_LIMIT,
    AT_OUTSIDE,
    AT_PAUSE,
    AT_POWER,
    AT_POWERX,
    AT_SELECT,
    AT_STATEMENT,
    AT_STOP,
    AT_UNDEFINED,
    EVENT,
    FAC,
    FIXED,
    INDEX,
    INDEX2,
    PC,
    SENT,
    SENT_EXPONENT,
    STATEMENTS,
    STORED,
)
from emulator.language import objectcode as op
from emulator.language.loader import SUBSCRIPT, Flat
from emulator.language.objectcode import Program
from emulator.numbers.accumulator import divide_fixed
from emulator.numbers.arithmetic import FIXED_POINT, UNDEFINED, ZERO, wrap_integer
from emulator.numbers.base import Number, Numbers, Trap

FLOATING = ZERO
"""The kind of a field that holds a number of the system."""

Entry = tuple[int, int, Number]
"""(instruction, field changed or instruction gone to, value stored or tested); at a COUNT (instruction, 0, None)."""

_SERVED = {
    op.ITEM: AT_ITEM,
    op.BEGIN: AT_BEGIN,
    op.FINISH: AT_FINISH,
    op.FUNCTION: AT_FUNCTION,
    op.POWER: AT_POWER,
    op.POWERX: AT_POWERX,
    op.PAUSE: AT_PAUSE,
}
"""What the machine sees to, not this loop: operation and reason to return."""


@dataclass
class Journal:
    """What a run did, in order.

    ``stores``: fields changed and statements begun are entered too, not only decisions; a field that is only
    copied while undefined is entered with the value None.
    """

    stores: bool
    entries: list[Entry] = field(default_factory=list)


def entered(program: Program) -> list[bool]:
    """For each instruction whether a journal enters it: stores into fields with a name, and numbers read."""
    found = []
    reading = False
    variables = [e for e in program.storage.entries if e.kind in ("variable", "array")]
    named = {address for e in variables for address in range(e.first, e.first + e.size)}
    for instruction in program.code:
        operation = instruction.operation
        if operation == op.BEGIN:
            reading = program.verbs[instruction.address] in ("READ", "ACCEPT")
        if operation == op.ITEM:
            found.append(reading)
        else:
            stores = operation in (op.FMFAC, op.FMFIX, op.TRANSMIT)
            found.append(stores and (instruction.subscript >= 0 or instruction.address in named))
    return found


def run(
    code: Flat,
    values: list[Number],
    kinds: list[int],
    counts: list[int],
    registers: list[Number],
    switches: Sequence[int],
    numbers: Numbers,
    options: tuple[int, int, int],
    journal: Journal | None = None,
    enters: Sequence[bool] = (),
) -> int:
    """Run until a reason to return, as emulator.compiled.kernel.run does; ``options`` are the first three of its.

    ``registers[FAC]`` and ``registers[SENT]`` hold numbers of the system.  Raises Undecided where the system cannot
    say; the registers then tell where.
    """
    operations, addresses, subscripts, seconds, table, targets, loops, begins = code
    limit, strict, tracing = options
    size = len(values)
    pc: int = registers[PC]
    fac, fixed = registers[FAC], registers[FIXED]
    done, stored = registers[STATEMENTS], registers[STORED]
    sent, sent_kind = registers[SENT], registers[SENT_EXPONENT]
    event = 0
    a = 0
    reason = AT_EVENT
    add, subtract, multiply, sign, checked = (
        numbers.add,
        numbers.subtract,
        numbers.multiply,
        numbers.sign,
        numbers.checked,
    )
    decide = journal.entries.append if journal else None
    enter = journal.entries.append if journal and journal.stores else None
    if enter and pc and operations[pc - 1] == op.ITEM and enters[pc - 1]:
        enter((pc - 1, registers[ADDRESS], values[registers[ADDRESS]]))
    try:
        while True:
            o = operations[pc]
            a = addresses[pc]
            s = subscripts[pc]
            if s >= 0:
                row = table[s : s + SUBSCRIPT]
                v = row[0]
                i = row[2]
                if v >= 0:
                    if kinds[v] != FIXED_POINT:
                        a = v
                        reason = AT_UNDEFINED
                        break
                    i += row[1] * values[v]
                if row[7] == 0:
                    if strict and (i < 1 or i > row[3]):
                        if o == op.SEND and i == row[3] + 1:
                            sent, sent_kind = 0, UNDEFINED
                            pc += 1
                            continue
                        registers[INDEX], registers[INDEX2] = i, 0
                        reason = AT_BOUNDS
                        break
                    a += i - 1
                else:
                    j = row[6]
                    v = row[4]
                    if v >= 0:
                        if kinds[v] != FIXED_POINT:
                            a = v
                            reason = AT_UNDEFINED
                            break
                        j += row[5] * values[v]
                    if strict and (i < 1 or i > row[3] or j < 1 or j > row[7]):
                        registers[INDEX], registers[INDEX2] = i, j
                        reason = AT_BOUNDS
                        break
                    a += i - 1 + row[3] * (j - 1)
                if a < 0 or a >= size:
                    reason = AT_OUTSIDE
                    break
            if o <= op.FDVR:
                if o == op.FMFAC:
                    values[a] = checked(fac)
                    kinds[a] = FLOATING
                    stored = a
                    if enter and enters[pc]:
                        enter((pc, a, fac))
                    pc += 1
                    continue
                if kinds[a] >= FIXED_POINT:
                    reason = AT_UNDEFINED
                    break
                value = values[a]
                pc += 1
                if o == op.TOFAC:
                    fac = value
                elif o == op.FMP:
                    fac = multiply(fac, value)
                elif o == op.FAD:
                    fac = add(fac, value)
                elif o == op.FSB:
                    fac = subtract(fac, value)
                elif o == op.FSBR:
                    fac = numbers.subtract_reversed(fac, value)
                elif o == op.FDV:
                    fac = numbers.divide(fac, value)
                else:
                    fac = numbers.divide(value, fac)
            elif o == op.COUNT:
                if begins[a]:
                    if done >= limit:
                        reason = AT_LIMIT
                        break
                    done += 1
                    counts[a] += 1
                    if enter:
                        enter((pc, 0, None))
                    pc += 1
                    if tracing and begins[a] == 1:
                        reason = AT_STATEMENT
                        break
                else:
                    counts[a] += 1
                    if enter:
                        enter((pc, 0, None))
                    pc += 1
            elif o == op.IF:
                target = targets[a + 1 + sign(fac)]
                if decide:
                    decide((pc, target, fac))
                pc = target
            elif o == op.DOTEST:
                v = loops[a]
                unset = [f for f in (v, loops[a + 1], loops[a + 2]) if kinds[f] != FIXED_POINT]
                if unset:
                    a = unset[0]
                    reason = AT_UNDEFINED
                    break
                value = wrap_integer(values[v] + values[loops[a + 1]])
                values[v] = value
                target = loops[a + 3] if value <= values[loops[a + 2]] else pc + 1
                if decide:
                    decide((pc, target, value))
                pc = target
            elif o == op.SEND:
                sent, sent_kind = values[a], kinds[a]
                pc += 1
            elif o == op.TRANSMIT:
                values[a], kinds[a] = sent, sent_kind
                stored = a
                if enter and enters[pc]:
                    enter((pc, a, None if sent_kind == UNDEFINED else sent))
                pc += 1
            elif o == op.BRANCH:
                pc = targets[a]
            elif o <= op.XDVR:
                if o == op.FMFIX:
                    values[a], kinds[a] = fixed, FIXED_POINT
                    stored = a
                    if enter and enters[pc]:
                        enter((pc, a, fixed))
                    pc += 1
                    continue
                if kinds[a] != FIXED_POINT:
                    reason = AT_UNDEFINED
                    break
                value = values[a]
                pc += 1
                if o == op.TOFIX:
                    fixed = value
                elif o == op.XAD:
                    fixed = wrap_integer(fixed + value)
                elif o == op.XSB:
                    fixed = wrap_integer(fixed - value)
                elif o == op.XSBR:
                    fixed = wrap_integer(value - fixed)
                elif o == op.XMP:
                    fixed = wrap_integer(fixed * value)
                else:
                    if o == op.XDVR:
                        fixed, value = value, fixed
                    fixed, event = divide_fixed(fixed, value)
                    if event:
                        reason = AT_EVENT
                        break
            elif o == op.IFX:
                target = targets[a + 1 + (fixed > 0) - (fixed < 0)]
                if decide:
                    decide((pc, target, fixed))
                pc = target
            elif o == op.RSGN:
                fac = numbers.negate(fac)
                pc += 1
            elif o == op.RSGX:
                fixed = -fixed
                pc += 1
            elif o == op.FLOAT:
                fac = numbers.from_integer(fixed)
                pc += 1
            elif o == op.FIX:
                fixed = numbers.to_integer(fac)
                pc += 1
            elif o == op.SELECT:
                if kinds[a] != FIXED_POINT:
                    reason = AT_UNDEFINED
                    break
                value = values[a]
                s = seconds[pc]
                if value < 1 or value > targets[s - 1]:
                    registers[INDEX] = value
                    reason = AT_SELECT
                    break
                target = targets[s + value - 1]
                if decide:
                    decide((pc, target, value))
                pc = target
            elif o == op.SWITCH:
                pc = targets[a] if switches[seconds[pc] - 1] else targets[a + 1]
            elif o in _SERVED:
                if o in (op.POWER, op.POWERX) and (
                    kinds[a] == UNDEFINED or (kinds[a] == FIXED_POINT) != (o == op.POWERX)
                ):
                    reason = AT_UNDEFINED
                    break
                pc += 1
                reason = _SERVED[o]
                break
            else:
                reason = AT_STOP
                break
    except Trap as trap:
        fac, event, reason = trap.value, trap.event, AT_EVENT
    finally:
        stays = reason in (AT_UNDEFINED, AT_BOUNDS, AT_OUTSIDE, AT_SELECT, AT_LIMIT, AT_STOP)
        registers[AT] = pc if stays else pc - 1
        registers[PC] = pc
        registers[FAC], registers[FIXED] = fac, fixed
        registers[STATEMENTS], registers[STORED] = done, stored
        registers[SENT], registers[SENT_EXPONENT] = sent, sent_kind
        registers[EVENT], registers[ADDRESS] = event, a
    return reason

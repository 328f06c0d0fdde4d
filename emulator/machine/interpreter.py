"""The interpreter: one loop over object code and storage, with the numbers of any arithmetic.

A field's number is in ``values`` and what it is in ``kinds``: FIXED_POINT, UNDEFINED, or FLOATING for a number of
the system.  The loop runs until something outside the arithmetic is needed (input, output, a library function, a
message, the end) and returns a reason; the machine (emulator/machine/machine.py) sees to that and calls it again.
What two runs are compared by goes into a :class:`Journal`: every decision, and with ``stores`` every statement begun
and every field changed, so that a run need not be stopped for it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from emulator.language.objectcode import (
    BEGIN,
    BRANCH,
    COUNT,
    DOTEST,
    FAD,
    FDV,
    FDVR,
    FINISH,
    FIX,
    FLOAT,
    FMFAC,
    FMFIX,
    FMP,
    FSB,
    FSBR,
    FUNCTION,
    IF,
    IFX,
    ITEM,
    PAUSE,
    POWER,
    POWERX,
    RSGN,
    RSGX,
    SELECT,
    SEND,
    SUBSCRIPT,
    SWITCH,
    TOFAC,
    TOFIX,
    TRANSMIT,
    XAD,
    XDVR,
    XMP,
    XSB,
    XSBR,
    Flat,
    Program,
)
from emulator.numbers.accumulator import divide_fixed
from emulator.numbers.arithmetic import FIXED_POINT, UNDEFINED, ZERO, wrap_integer
from emulator.numbers.base import Number, Numbers, Trap

# Reasons to return.
(
    AT_LIMIT,
    AT_STATEMENT,
    AT_BEGIN,
    AT_ITEM,
    AT_FINISH,
    AT_FUNCTION,
    AT_POWER,
    AT_POWERX,
    AT_PAUSE,
    AT_STOP,
    AT_EVENT,
    AT_UNDEFINED,
    AT_BOUNDS,
    AT_OUTSIDE,
    AT_SELECT,
) = range(15)

FLOATING = ZERO
"""The kind of a field that holds a number of the system."""

Entry = tuple[int, int, Number]
"""(instruction, field changed or instruction gone to, value stored or tested); at a COUNT (instruction, 0, None)."""

_SERVED = {
    ITEM: AT_ITEM,
    BEGIN: AT_BEGIN,
    FINISH: AT_FINISH,
    FUNCTION: AT_FUNCTION,
    POWER: AT_POWER,
    POWERX: AT_POWERX,
    PAUSE: AT_PAUSE,
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
        if operation == BEGIN:
            reading = program.verbs[instruction.address] in ("READ", "ACCEPT")
        if operation == ITEM:
            found.append(reading)
        else:
            stores = operation in (FMFAC, FMFIX, TRANSMIT)
            found.append(stores and (instruction.subscript >= 0 or instruction.address in named))
    return found


@dataclass
class State:
    """A run between two calls of :func:`run`: storage, counts, and the registers.

    ``pc`` is the next instruction, ``at`` the one a reason to return arose in, ``address`` the field it is about and
    ``index`` its subscripts; ``fac`` and ``fixed`` are the accumulators, ``sent`` and ``sent_kind`` a field on its way,
    ``stored`` the field last stored into.  ``work`` is what counts against the limit, ``event`` the number of an error
    code, and ``decision`` the last IF or computed GO TO, its instruction counted from 1.
    """

    values: list[Number]
    kinds: list[int]
    counts: list[int]
    fac: Number
    pc: int = 0
    at: int = 0
    fixed: int = 0
    sent: Number = 0
    sent_kind: int = UNDEFINED
    stored: int = 0
    address: int = 0
    index: tuple[int, ...] = ()
    event: int = 0
    decision: int = 0
    work: int = 0


Table = dict[int, Sequence[int]]


def subscript_table(code: Flat) -> Table:
    """The subscripts of a program by their place in :attr:`Flat.table`."""
    return {k: code.table[k : k + SUBSCRIPT] for k in range(0, len(code.table), SUBSCRIPT)}


def run(
    code: Flat,
    table: Table,
    state: State,
    switches: Sequence[int],
    numbers: Numbers,
    limit: int,
    strict: bool,
    traced: bool,
    journal: Journal | None = None,
    enters: Sequence[bool] = (),
) -> int:
    """Run until a reason to return; the state is changed in place.

    ``table`` is that of :func:`subscript_table`.  ``strict`` stops at a subscript outside its array, ``traced`` at each
    statement.  ``enters`` says which instructions a journal enters.  Raises Undecided where the numbers cannot say; the
    state then tells where.
    """
    operations, addresses, subscripts, seconds, _, targets, loops, begins = code
    values, kinds, counts = state.values, state.kinds, state.counts
    size = len(values)
    pc, fac, fixed, work, stored, decision = state.pc, state.fac, state.fixed, state.work, state.stored, state.decision
    sent, sent_kind = state.sent, state.sent_kind
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
    if enter and pc and operations[pc - 1] == ITEM and enters[pc - 1]:
        enter((pc - 1, state.address, values[state.address]))
    try:
        while True:
            o = operations[pc]
            a = addresses[pc]
            s = subscripts[pc]
            if s >= 0:
                v, c, i, rows, w, d, j, columns = table[s]
                if v >= 0:
                    if kinds[v] != FIXED_POINT:
                        a = v
                        reason = AT_UNDEFINED
                        break
                    i += c * values[v]
                if columns == 0:
                    if strict and not 1 <= i <= rows:
                        if o == SEND and i == rows + 1:
                            sent, sent_kind = 0, UNDEFINED
                            pc += 1
                            continue
                        state.index = (i,)
                        reason = AT_BOUNDS
                        break
                    a += i - 1
                else:
                    if w >= 0:
                        if kinds[w] != FIXED_POINT:
                            a = w
                            reason = AT_UNDEFINED
                            break
                        j += d * values[w]
                    if strict and not (1 <= i <= rows and 1 <= j <= columns):
                        state.index = (i, j)
                        reason = AT_BOUNDS
                        break
                    a += i - 1 + rows * (j - 1)
                if a < 0 or a >= size:
                    reason = AT_OUTSIDE
                    break
            if o <= FDVR:
                if o == FMFAC:
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
                if o == TOFAC:
                    fac = value
                elif o == FMP:
                    fac = multiply(fac, value)
                elif o == FAD:
                    fac = add(fac, value)
                elif o == FSB:
                    fac = subtract(fac, value)
                elif o == FSBR:
                    fac = numbers.subtract_reversed(fac, value)
                elif o == FDV:
                    fac = numbers.divide(fac, value)
                else:
                    fac = numbers.divide(value, fac)
            elif o == COUNT:
                if begins[a]:
                    if work >= limit:
                        reason = AT_LIMIT
                        break
                    work += 1
                    counts[a] += 1
                    if enter:
                        enter((pc, 0, None))
                    pc += 1
                    if traced and begins[a] == 1:
                        reason = AT_STATEMENT
                        break
                else:
                    counts[a] += 1
                    if enter:
                        enter((pc, 0, None))
                    pc += 1
            elif o == IF:
                target = targets[a + 1 + sign(fac)]
                decision = pc + 1
                if decide:
                    decide((pc, target, fac))
                pc = target
            elif o == DOTEST:
                v = loops[a]
                step, last = loops[a + 1], loops[a + 2]
                if not kinds[v] == kinds[step] == kinds[last] == FIXED_POINT:
                    a = next(f for f in (v, step, last) if kinds[f] != FIXED_POINT)
                    reason = AT_UNDEFINED
                    break
                value = wrap_integer(values[v] + values[step])
                values[v] = value
                target = loops[a + 3] if value <= values[last] else pc + 1
                if decide:
                    decide((pc, target, value))
                pc = target
            elif o == SEND:
                sent, sent_kind = values[a], kinds[a]
                pc += 1
            elif o == TRANSMIT:
                values[a], kinds[a] = sent, sent_kind
                stored = a
                if enter and enters[pc]:
                    enter((pc, a, None if sent_kind == UNDEFINED else sent))
                pc += 1
            elif o == BRANCH:
                pc = targets[a]
            elif o <= XDVR:
                if o == FMFIX:
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
                if o == TOFIX:
                    fixed = value
                elif o == XAD:
                    fixed = wrap_integer(fixed + value)
                elif o == XSB:
                    fixed = wrap_integer(fixed - value)
                elif o == XSBR:
                    fixed = wrap_integer(value - fixed)
                elif o == XMP:
                    fixed = wrap_integer(fixed * value)
                else:
                    if o == XDVR:
                        fixed, value = value, fixed
                    fixed, event = divide_fixed(fixed, value)
                    if event:
                        reason = AT_EVENT
                        break
            elif o == IFX:
                target = targets[a + 1 + (fixed > 0) - (fixed < 0)]
                decision = pc + 1
                if decide:
                    decide((pc, target, fixed))
                pc = target
            elif o == RSGN:
                fac = numbers.negate(fac)
                pc += 1
            elif o == RSGX:
                fixed = -fixed
                pc += 1
            elif o == FLOAT:
                fac = numbers.from_integer(fixed)
                pc += 1
            elif o == FIX:
                fixed = numbers.to_integer(fac)
                pc += 1
            elif o == SELECT:
                if kinds[a] != FIXED_POINT:
                    reason = AT_UNDEFINED
                    break
                value = values[a]
                s = seconds[pc]
                if value < 1 or value > targets[s - 1]:
                    state.index = (value,)
                    reason = AT_SELECT
                    break
                target = targets[s + value - 1]
                decision = pc + 1
                if decide:
                    decide((pc, target, value))
                pc = target
            elif o == SWITCH:
                pc = targets[a] if switches[seconds[pc] - 1] else targets[a + 1]
            elif o in _SERVED:
                if o in (POWER, POWERX) and (kinds[a] == UNDEFINED or (kinds[a] == FIXED_POINT) != (o == POWERX)):
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
        state.at = pc if stays else pc - 1
        state.pc, state.fac, state.fixed, state.work, state.stored = pc, fac, fixed, work, stored
        state.sent, state.sent_kind, state.event, state.address, state.decision = sent, sent_kind, event, a, decision
    return reason

"""The interpreter: one loop over object code and storage, with the numbers of any arithmetic.

The loop runs over a :class:`emulator.machine.state.State` until something outside the arithmetic is needed (input,
output, a library function, a message, the end) and returns a reason; the session (emulator/machine/session.py) sees to
that and calls it again.
"""

from __future__ import annotations

from collections.abc import Sequence

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
    element_after,
)
from emulator.machine.state import FLOATING, Journal, State, Table
from emulator.numbers.accumulator import divide_fixed
from emulator.numbers.arithmetic import FIXED_POINT, UNDEFINED, wrap_integer
from emulator.numbers.base import Numbers, Trap

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
    AT_COSTLY,
) = range(16)

SLACK = 6_000
"""How much work a statement may do beyond the limit, which is looked at where one begins; the list of any array may."""

_WORDS = {
    FAD: "add",
    FSB: "subtract",
    FSBR: "subtract",
    FMP: "multiply",
    FDV: "divide",
    FDVR: "divide",
}
"""Operations of two numbers, as :meth:`emulator.numbers.base.Numbers.work` calls them."""

_SERVED = {
    BEGIN: AT_BEGIN,
    FINISH: AT_FINISH,
    FUNCTION: AT_FUNCTION,
    POWER: AT_POWER,
    POWERX: AT_POWERX,
    PAUSE: AT_PAUSE,
}
"""What the machine sees to, not this loop: operation and reason to return."""


def run(
    code: Flat,
    table: Table,
    state: State,
    switches: Sequence[int],
    numbers: Numbers,
    limit: int,
    most: int,
    strict: bool,
    traced: bool,
    journal: Journal | None = None,
    enters: Sequence[bool] = (),
) -> int:
    """Run until a reason to return; the state is changed in place.

    ``table`` is that of :func:`emulator.machine.state.subscript_table`.  A statement is not begun once the work has
    come to ``limit``; an operation that would take it SLACK beyond ``most``, the run's limit, is not done.  ``strict``
    stops at a subscript outside its array, ``traced`` at each statement.  ``enters`` says which instructions a journal
    enters.  Raises Undecided where the numbers cannot say; the state then tells where.
    """
    operations, addresses, subscripts, seconds, _, targets, loops, begins, charges = code
    values, kinds, counts = state.values, state.kinds, state.counts
    size = len(values)
    pc, fac, fixed, work, stored, decision = state.pc, state.fac, state.fixed, state.work, state.stored, state.decision
    sent, sent_kind = state.sent, state.sent_kind
    element = state.element
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
    weigh = numbers.work if numbers.is_costly else None
    decide = journal.entries.append if journal else None
    enter = journal.entries.append if journal and journal.stores else None
    if enter and state.listed:
        if enters[state.at]:
            enter((state.at, state.address, values[state.address]))
        state.listed = False
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
                if o == TOFAC:
                    fac = value
                    pc += 1
                    continue
                if weigh:
                    work += state.owe(weigh(_WORDS[o], fac, value))
                    if work > most + SLACK:
                        reason = AT_COSTLY
                        break
                pc += 1
                if o == FMP:
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
                charge = charges[a]
                if charge:
                    if work >= limit:
                        reason = AT_LIMIT
                        break
                    work += charge
                counts[a] += 1
                if enter:
                    enter((pc, 0, None))
                pc += 1
                if traced and begins[a] == 1:
                    reason = AT_STATEMENT
                    break
            elif o == IF:
                if weigh and (work := work + state.owe(weigh("sign", fac))) > most + SLACK:
                    reason = AT_COSTLY
                    break
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
                if weigh and (work := work + state.owe(weigh("to_integer", fac))) > most + SLACK:
                    reason = AT_COSTLY
                    break
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
            elif o == ITEM:
                if work > most + SLACK:
                    reason = AT_COSTLY
                    break
                a += element
                element = element_after(element, seconds[pc])
                pc += element == 0
                state.listed = True
                reason = AT_ITEM
                break
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
        stays = reason in (AT_UNDEFINED, AT_BOUNDS, AT_OUTSIDE, AT_SELECT, AT_LIMIT, AT_STOP, AT_COSTLY)
        state.at = pc if stays or element else pc - 1
        state.pc, state.fac, state.fixed, state.work, state.stored = pc, fac, fixed, work, stored
        state.sent, state.sent_kind, state.event, state.address, state.decision = sent, sent_kind, event, a, decision
        state.element = element
    return reason

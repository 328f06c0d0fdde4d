"""The kernel: one loop over object code and storage, on integers only, for runs without an operator or a trace.

Storage is two sequences, mantissas and exponents (emulator/numbers/arithmetic.py); a fixed-point number is its value
with the exponent FIXED_POINT.  The loop runs until something outside the arithmetic is needed (input, output, a
library function, a message, the end) and returns a reason, as the interpreter does; emulator/compiled/deck.py sees to
that and calls it again.  The subset of the language used here is that of a compiler of integer loops.
"""

from __future__ import annotations

from collections.abc import MutableSequence
from typing import NamedTuple

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
from emulator.machine.interpreter import (
    AT_BEGIN,
    AT_BOUNDS,
    AT_COSTLY,
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
    AT_STOP,
    AT_UNDEFINED,
    SLACK,
)
from emulator.numbers.accumulator import add, divide, divide_fixed, multiply, negate, subtract, subtract_reversed
from emulator.numbers.arithmetic import FIXED_POINT, UNDEFINED, Rules, from_integer, to_integer, wrap_integer
from emulator.numbers.work import STEPS

# Registers kept between calls.  DECISION is the last IF or computed GO TO, its instruction counted from 1; ELEMENT is
# how many elements of an array have gone through the ITEM that comes next; COSTLY and OWED are as of
# emulator.machine.state.State.
PC, FAC, CHARACTERISTIC, FIXED, WORK, SENT, SENT_EXPONENT, EVENT, ADDRESS, INDEX, INDEX2 = range(11)
AT, DECISION, ELEMENT, COSTLY, OWED = range(11, 16)
REGISTERS = 16

Row = MutableSequence[int]


class Core(NamedTuple):
    """What a run works on: storage and the sense switches."""

    mantissas: Row
    exponents: Row
    switches: Row


def owe(registers: Row, steps: int) -> None:
    """Count steps that an operation takes beyond a plain one's, as units of work when they make one."""
    steps += registers[OWED]
    registers[OWED] = steps % STEPS
    registers[COSTLY] += steps // STEPS
    registers[WORK] += steps // STEPS


def run(code: Flat, core: Core, counts: Row, registers: Row, rules: Rules, limit: int, most: int, strict: int) -> int:
    """Run until a reason to return; registers and storage are changed in place.

    ``limit``, ``most`` and ``strict`` are those of :func:`emulator.machine.interpreter.run`.
    """
    operations, addresses, subscripts, seconds, table, targets, loops, _, charges = code
    mantissas, exponents = core.mantissas, core.exponents
    size = len(mantissas)
    pc = registers[PC]
    fm, fe, fixed = registers[FAC], registers[CHARACTERISTIC], registers[FIXED]
    work, decision = registers[WORK], registers[DECISION]
    sm, se = registers[SENT], registers[SENT_EXPONENT]
    element = registers[ELEMENT]
    event = 0
    a = 0
    while True:
        o = operations[pc]
        a = addresses[pc]
        s = subscripts[pc]
        if s >= 0:
            v = table[s]
            i = table[s + 2]
            rows = table[s + 3]
            columns = table[s + 7]
            if v >= 0:
                if exponents[v] != FIXED_POINT:
                    a = v
                    reason = AT_UNDEFINED
                    break
                i += table[s + 1] * mantissas[v]
            if columns == 0:
                if strict and (i < 1 or i > rows):
                    if o == SEND and i == rows + 1:
                        sm = 0
                        se = UNDEFINED
                        pc += 1
                        continue
                    registers[INDEX] = i
                    registers[INDEX2] = 0
                    reason = AT_BOUNDS
                    break
                a += i - 1
            else:
                j = table[s + 6]
                v = table[s + 4]
                if v >= 0:
                    if exponents[v] != FIXED_POINT:
                        a = v
                        reason = AT_UNDEFINED
                        break
                    j += table[s + 5] * mantissas[v]
                if strict and (i < 1 or i > rows or j < 1 or j > columns):
                    registers[INDEX] = i
                    registers[INDEX2] = j
                    reason = AT_BOUNDS
                    break
                a += i - 1 + rows * (j - 1)
            if a < 0 or a >= size:
                reason = AT_OUTSIDE
                break
        if o <= FDVR:
            if o == FMFAC:
                mantissas[a] = fm
                exponents[a] = fe
                pc += 1
                continue
            m = mantissas[a]
            e = exponents[a]
            if e >= FIXED_POINT:
                reason = AT_UNDEFINED
                break
            pc += 1
            if o == TOFAC:
                fm = m
                fe = e
                continue
            if o == FMP:
                fm, fe, event = multiply(fm, fe, m, e, rules)
            elif o == FAD:
                fm, fe, event = add(fm, fe, m, e, rules)
            elif o == FSB:
                fm, fe, event = subtract(fm, fe, m, e, rules)
            elif o == FSBR:
                fm, fe, event = subtract_reversed(fm, fe, m, e, rules)
            elif o == FDV:
                fm, fe, event = divide(fm, fe, m, e, rules)
            else:
                fm, fe, event = divide(m, e, fm, fe, rules)
            if event:
                reason = AT_EVENT
                break
        elif o == COUNT:
            if charges[a] > 0:
                if work >= limit:
                    reason = AT_LIMIT
                    break
                work += charges[a]
            counts[a] += 1
            pc += 1
        elif o == IF:
            decision = pc + 1
            pc = targets[a] if fm < 0 else targets[a + 1] if fm == 0 else targets[a + 2]
        elif o == DOTEST:
            v = loops[a]
            for k in range(a, a + 3):
                if exponents[loops[k]] != FIXED_POINT:
                    v = -1
                    a = loops[k]
                    break
            if v < 0:
                reason = AT_UNDEFINED
                break
            m = wrap_integer(mantissas[v] + mantissas[loops[a + 1]])
            mantissas[v] = m
            pc = loops[a + 3] if m <= mantissas[loops[a + 2]] else pc + 1
        elif o == SEND:
            sm = mantissas[a]
            se = exponents[a]
            pc += 1
        elif o == TRANSMIT:
            mantissas[a] = sm
            exponents[a] = se
            pc += 1
        elif o == BRANCH:
            pc = targets[a]
        elif o <= XDVR:
            if o == FMFIX:
                mantissas[a] = fixed
                exponents[a] = FIXED_POINT
                pc += 1
                continue
            if exponents[a] != FIXED_POINT:
                reason = AT_UNDEFINED
                break
            m = mantissas[a]
            pc += 1
            if o == TOFIX:
                fixed = m
            elif o == XAD:
                fixed = wrap_integer(fixed + m)
            elif o == XSB:
                fixed = wrap_integer(fixed - m)
            elif o == XSBR:
                fixed = wrap_integer(m - fixed)
            elif o == XMP:
                fixed = wrap_integer(fixed * m)
            else:
                if o == XDVR:
                    fixed, m = m, fixed
                fixed, event = divide_fixed(fixed, m)
                if event:
                    reason = AT_EVENT
                    break
        elif o == IFX:
            decision = pc + 1
            pc = targets[a] if fixed < 0 else targets[a + 1] if fixed == 0 else targets[a + 2]
        elif o == RSGN:
            fm, fe = negate(fm, fe)
            pc += 1
        elif o == RSGX:
            fixed = -fixed
            pc += 1
        elif o == FLOAT:
            fm, fe = from_integer(fixed, rules)
            pc += 1
        elif o == FIX:
            fixed = to_integer(fm, fe, rules)
            pc += 1
        elif o == SELECT:
            if exponents[a] != FIXED_POINT:
                reason = AT_UNDEFINED
                break
            v = mantissas[a]
            s = seconds[pc]
            if v < 1 or v > targets[s - 1]:
                registers[INDEX] = v
                reason = AT_SELECT
                break
            decision = pc + 1
            pc = targets[s + v - 1]
        elif o == SWITCH:
            pc = targets[a] if core.switches[seconds[pc] - 1] else targets[a + 1]
        elif o == ITEM:
            if work > most + SLACK:
                reason = AT_COSTLY
                break
            a += element
            element = element_after(element, seconds[pc])
            pc += element == 0
            reason = AT_ITEM
            break
        elif o == BEGIN:
            pc += 1
            reason = AT_BEGIN
            break
        elif o == FINISH:
            pc += 1
            reason = AT_FINISH
            break
        elif o == FUNCTION:
            pc += 1
            reason = AT_FUNCTION
            break
        elif o == POWER or o == POWERX:
            if exponents[a] == UNDEFINED or (exponents[a] == FIXED_POINT) != (o == POWERX):
                reason = AT_UNDEFINED
                break
            pc += 1
            reason = AT_POWER if o == POWER else AT_POWERX
            break
        elif o == PAUSE:
            pc += 1
            reason = AT_PAUSE
            break
        else:
            reason = AT_STOP
            break
    stays = reason in (AT_UNDEFINED, AT_BOUNDS, AT_OUTSIDE, AT_SELECT, AT_LIMIT, AT_STOP, AT_COSTLY)
    registers[AT] = pc if stays or element > 0 else pc - 1
    registers[ELEMENT] = element
    registers[PC] = pc
    registers[FAC] = fm
    registers[CHARACTERISTIC] = fe
    registers[FIXED] = fixed
    registers[WORK] = work
    registers[DECISION] = decision
    registers[SENT] = sm
    registers[SENT_EXPONENT] = se
    registers[EVENT] = event
    registers[ADDRESS] = a
    return reason

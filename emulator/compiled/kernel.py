"""The kernel: one loop over object code and storage, on integers only, for runs without an operator or a trace.

Core storage is represented by two sequences, the mantissas and the exponents of all fields
(emulator/numbers/arithmetic.py).  A fixed-point number is stored as its value with the exponent FIXED_POINT.  Like the
interpreter, the loop returns a reason whenever it needs something outside the arithmetic: input, output, a library
function, a message or the end of the run.  emulator/compiled/deck.py performs the service and calls the loop again.
The code uses only the part of Python that numba compiles.
"""

from collections.abc import MutableSequence
from typing import NamedTuple

from emulator.language import objectcode as op
from emulator.language.objectcode import Flat, element_after
from emulator.machine import interpreter
from emulator.machine.interpreter import is_minus_zero
from emulator.numbers.accumulator import add, divide, divide_fixed, multiply, negate, subtract, subtract_reversed
from emulator.numbers.arithmetic import FIXED_POINT, UNDEFINED, Rules, drawn, from_integer, to_integer, wrap_integer
from emulator.numbers.work import STEPS

# The registers that are kept between calls.  Most have the meaning of a field of emulator.machine.state.State.  FAC and
# CHARACTERISTIC are the mantissa and exponent of the accumulator, SENT and SENT_EXPONENT those of a field being copied.
PC, FAC, CHARACTERISTIC, FIXED, WORK, SENT, SENT_EXPONENT, EVENT, ADDRESS, INDEX, INDEX2 = range(11)
# HOPPER_EMPTY is State.last_card.  DRAWS counts the operations that took a random number.
AT, DECISION, ELEMENT, COSTLY, OWED, HOPPER_EMPTY, DRAWS = range(11, 18)
REGISTERS = 18

# The reason to return if a result would be a fixed-point minus zero, which only the interpreter can hold.
AT_MINUS_ZERO = 16

Row = MutableSequence[int]


class Core(NamedTuple):
    """The state that a program changes or tests: core storage, and the sense switches on the console."""

    mantissas: Row
    exponents: Row
    switches: Row


def owe(registers: Row, steps: int) -> None:
    """Count the extra steps of a slow operation as work of the run: every STEPS steps are one unit of work."""
    steps += registers[OWED]
    registers[OWED] = steps % STEPS
    registers[COSTLY] += steps // STEPS
    registers[WORK] += steps // STEPS


def run(code: Flat, core: Core, counts: Row, registers: Row, rules: Rules, limit: int, most: int, strict: int) -> int:
    """Execute instructions until one needs a service of the caller or the run ends, and return the reason.

    ``limit``, ``most``, ``strict`` and the operations are the same as in :func:`emulator.machine.interpreter.run`,
    which cites the source of each operation.
    """
    operations, addresses, subscripts, seconds, table, targets, loops, _, charges, size = code
    mantissas, exponents = core.mantissas, core.exponents
    # Local variables, not array elements, so that the compiler can keep them in processor registers.
    pc = registers[PC]
    fac, fac_exponent, fixed = registers[FAC], registers[CHARACTERISTIC], registers[FIXED]
    work, decision = registers[WORK], registers[DECISION]
    sent, sent_exponent = registers[SENT], registers[SENT_EXPONENT]
    element, draws = registers[ELEMENT], registers[DRAWS]
    event = 0
    address = 0
    while True:
        operation = operations[pc]
        address = addresses[pc]
        subscript = subscripts[pc]
        if subscript >= 0:
            # A subscript has eight numbers: variable, factor, constant and size of the first dimension, and then of the
            # second one.  An array of one dimension has the size 0 and the constant 1 in the second.
            row, rows = table[subscript + 2], table[subscript + 3]
            column, columns = table[subscript + 6], table[subscript + 7]
            variable = table[subscript]
            if variable >= 0:
                if exponents[variable] != FIXED_POINT:
                    address = variable
                    reason = interpreter.AT_UNDEFINED
                    break
                row += table[subscript + 1] * mantissas[variable]
            variable = table[subscript + 4]
            if variable >= 0:
                if exponents[variable] != FIXED_POINT:
                    address = variable
                    reason = interpreter.AT_UNDEFINED
                    break
                column += table[subscript + 5] * mantissas[variable]
            if strict and (row < 1 or row > rows or (columns > 0 and (column < 1 or column > columns))):
                # The copy of element N+1 of an array is undefined, which is harmless unless a statement computes with
                # the copy.
                if operation == op.SEND and row == rows + 1 and columns == 0:
                    sent = 0
                    sent_exponent = UNDEFINED
                    pc += 1
                    continue
                registers[INDEX] = row
                registers[INDEX2] = column
                reason = interpreter.AT_BOUNDS
                break
            # Arrays are stored column by column.
            address += row - 1 + rows * (column - 1)
            if address < 0 or address >= size:
                reason = interpreter.AT_OUTSIDE
                break
        # As in the interpreter, frequent operations are tried first.
        if operation <= op.FDVR:
            if operation == op.FMFAC:
                mantissas[address] = fac
                exponents[address] = fac_exponent
                pc += 1
                continue
            mantissa = mantissas[address]
            exponent = exponents[address]
            if exponent >= FIXED_POINT:
                reason = interpreter.AT_UNDEFINED
                break
            pc += 1
            if operation == op.TOFAC:
                fac = mantissa
                fac_exponent = exponent
                continue
            if rules.random:
                draws += 1
                rules = drawn(rules, draws)
            if operation == op.FMP:
                fac, fac_exponent, event = multiply(fac, fac_exponent, mantissa, exponent, rules)
            elif operation == op.FAD:
                fac, fac_exponent, event = add(fac, fac_exponent, mantissa, exponent, rules)
            elif operation == op.FSB:
                fac, fac_exponent, event = subtract(fac, fac_exponent, mantissa, exponent, rules)
            elif operation == op.FSBR:
                fac, fac_exponent, event = subtract_reversed(fac, fac_exponent, mantissa, exponent, rules)
            elif operation == op.FDV:
                fac, fac_exponent, event = divide(fac, fac_exponent, mantissa, exponent, rules)
            else:
                fac, fac_exponent, event = divide(mantissa, exponent, fac, fac_exponent, rules)
            # ``event`` is the number of an error code, E1 to E8; the caller types it, and the run continues.
            if event:
                reason = interpreter.AT_EVENT
                break
        elif operation == op.COUNT:
            # A statement begins: the only place where the limit stops a run.
            if charges[address] > 0:
                if work >= limit:
                    reason = interpreter.AT_LIMIT
                    break
                work += charges[address]
            counts[address] += 1
            pc += 1
        elif operation == op.IF:
            decision = pc + 1
            pc = targets[address] if fac < 0 else targets[address + 1] if fac == 0 else targets[address + 2]
        elif operation == op.DOTEST:
            # The end of a DO.  ``loops`` holds its variable, step, limit and first instruction.
            variable = loops[address]
            for k in range(address, address + 3):
                if exponents[loops[k]] != FIXED_POINT:
                    variable = -1
                    address = loops[k]
                    break
            if variable < 0:
                reason = interpreter.AT_UNDEFINED
                break
            mantissa = wrap_integer(mantissas[variable] + mantissas[loops[address + 1]])
            if rules.as_1962 and mantissa == 0 and mantissas[variable] < 0:
                reason = AT_MINUS_ZERO
                break
            mantissas[variable] = mantissa
            pc = loops[address + 3] if mantissa <= mantissas[loops[address + 2]] else pc + 1
        elif operation == op.SEND:
            sent = mantissas[address]
            sent_exponent = exponents[address]
            pc += 1
        elif operation == op.TRANSMIT:
            mantissas[address] = sent
            exponents[address] = sent_exponent
            pc += 1
        elif operation == op.BRANCH:
            pc = targets[address]
        elif operation <= op.XDVR:
            # The fixed-point accumulator, four digits and a sign.
            if operation == op.FMFIX:
                mantissas[address] = fixed
                exponents[address] = FIXED_POINT
                pc += 1
                continue
            if exponents[address] != FIXED_POINT:
                reason = interpreter.AT_UNDEFINED
                break
            mantissa = mantissas[address]
            pc += 1
            before = fixed
            if operation == op.TOFIX:
                fixed = mantissa
            elif operation == op.XAD:
                fixed = wrap_integer(fixed + mantissa)
            elif operation == op.XSB:
                fixed = wrap_integer(fixed - mantissa)
            elif operation == op.XSBR:
                fixed = wrap_integer(mantissa - fixed)
            elif operation == op.XMP:
                fixed = wrap_integer(fixed * mantissa)
            else:
                if operation == op.XDVR:
                    fixed, mantissa = mantissa, fixed
                fixed, event = divide_fixed(fixed, mantissa)
                if event:
                    reason = interpreter.AT_EVENT
                    break
            is_result = operation != op.TOFIX and fixed == 0
            if rules.as_1962 and is_result and is_minus_zero(operation, before < 0, mantissas[address] < 0):
                reason = AT_MINUS_ZERO
                break
        elif operation == op.IFX:
            decision = pc + 1
            pc = targets[address] if fixed < 0 else targets[address + 1] if fixed == 0 else targets[address + 2]
        elif operation == op.RSGN:
            fac, fac_exponent = negate(fac, fac_exponent)
            pc += 1
        elif operation == op.RSGX:
            fixed = -fixed
            pc += 1
            if rules.as_1962 and fixed == 0:
                reason = AT_MINUS_ZERO
                break
        elif operation == op.FLOAT:
            fac, fac_exponent = from_integer(fixed, rules)
            pc += 1
        elif operation == op.FIX:
            fixed = to_integer(fac, fac_exponent, rules)
            pc += 1
            if rules.as_1962 and fixed == 0 and fac < 0 and fac_exponent > 0:
                reason = AT_MINUS_ZERO
                break
        elif operation == op.SELECT:
            if exponents[address] != FIXED_POINT:
                reason = interpreter.AT_UNDEFINED
                break
            # A computed GO TO.  The number before the first target is their count.
            choice = mantissas[address]
            first = seconds[pc]
            if choice < 1 or choice > targets[first - 1]:
                registers[INDEX] = choice
                reason = interpreter.AT_SELECT
                break
            decision = pc + 1
            pc = targets[first + choice - 1]
        elif operation == op.SWITCH:
            if seconds[pc] == op.LAST_CARD:
                switch = registers[HOPPER_EMPTY]
                registers[HOPPER_EMPTY] = 0
            else:
                switch = core.switches[seconds[pc] - 1]
            pc = targets[address] if switch else targets[address + 1]
        elif operation == op.ITEM:
            # One number of a list.  The instruction is repeated for each element of a whole array.
            if work > most + interpreter.SLACK:
                reason = interpreter.AT_COSTLY
                break
            address += element
            element = element_after(element, seconds[pc])
            pc += element == 0
            reason = interpreter.AT_ITEM
            break
        elif operation == op.BEGIN:
            pc += 1
            reason = interpreter.AT_BEGIN
            break
        elif operation == op.FINISH:
            pc += 1
            reason = interpreter.AT_FINISH
            break
        elif operation == op.FUNCTION:
            pc += 1
            reason = interpreter.AT_FUNCTION
            break
        elif operation == op.POWER or operation == op.POWERX:
            if exponents[address] == UNDEFINED or (exponents[address] == FIXED_POINT) != (operation == op.POWERX):
                reason = interpreter.AT_UNDEFINED
                break
            pc += 1
            reason = interpreter.AT_POWER if operation == op.POWER else interpreter.AT_POWERX
            break
        elif operation == op.PAUSE:
            pc += 1
            reason = interpreter.AT_PAUSE
            break
        else:
            reason = interpreter.AT_STOP
            break
    # AT is the instruction that caused the return.  PC still points to it after an error, and beyond it after a request
    # for a service.
    registers[AT] = pc if reason >= interpreter.AT_LIMIT or element > 0 else pc - 1
    registers[ELEMENT] = element
    registers[PC] = pc
    registers[FAC] = fac
    registers[CHARACTERISTIC] = fac_exponent
    registers[FIXED] = fixed
    registers[WORK] = work
    registers[DECISION] = decision
    registers[SENT] = sent
    registers[SENT_EXPONENT] = sent_exponent
    registers[EVENT] = event
    registers[DRAWS] = draws
    registers[ADDRESS] = address
    return reason

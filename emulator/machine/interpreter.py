"""The interpreter: one loop over object code and storage, for numbers of any arithmetic.

The loop works on a :class:`emulator.machine.state.State`.  It returns a reason whenever it needs something outside the
arithmetic: input, output, a library function, a message or the end of the run.  The session
(emulator/machine/session.py) performs that service and calls the loop again.

To add an operation of the object code:

1. Name it in emulator/language/objectcode.py and let emulator/language generate it.
2. Add a branch here, and the same branch to emulator/compiled/kernel.py (integers only).
3. If it needs a service, add a reason ``AT_...`` here, and perform the service in ``Session._serve`` and in
   emulator/compiled/deck.py.
4. Give it a time in ``COSTS`` of emulator/machine/timing.py.
"""

from collections.abc import Sequence

from emulator.language import objectcode as op
from emulator.language.objectcode import Flat, element_after
from emulator.machine.state import FLOATING, Journal, State, Table
from emulator.numbers.accumulator import divide_fixed
from emulator.numbers.arithmetic import FIXED_POINT, UNDEFINED, is_negative, signed_zero, wrap_integer
from emulator.numbers.base import Numbers, Trap

# The frequent operations are globals of this module, because looking them up in ``op`` makes a run a fifth longer.
TOFAC, FMFAC, FAD, FSB, FSBR, FMP, FDV, FDVR = range(op.TOFAC, op.FDVR + 1)
SEND, TRANSMIT, COUNT, BRANCH, IF, DOTEST = op.SEND, op.TRANSMIT, op.COUNT, op.BRANCH, op.IF, op.DOTEST

# The reasons to return to the session: first those after which the run continues with the next instruction.
AT_STATEMENT, AT_BEGIN, AT_ITEM, AT_FINISH, AT_FUNCTION, AT_POWER, AT_POWERX, AT_PAUSE, AT_EVENT = range(9)
AT_LIMIT, AT_STOP, AT_UNDEFINED, AT_BOUNDS, AT_OUTSIDE, AT_SELECT, AT_COSTLY = range(9, 16)

# The units of work by which a statement may exceed the limit of the run, because the limit is checked only when a
# statement begins.  SLACK allows a list with the largest possible array to finish.
SLACK = 6_000

# The names of the two-operand operations in :meth:`emulator.numbers.base.Numbers.work`.
_WORK_NAMES = {FAD: "add", FSB: "subtract", FSBR: "subtract", FMP: "multiply", FDV: "divide", FDVR: "divide"}

# The operations that the session performs, with the reason to return for each.
_REASONS = {op.BEGIN: AT_BEGIN, op.FINISH: AT_FINISH, op.FUNCTION: AT_FUNCTION, op.PAUSE: AT_PAUSE}
_REASONS |= {op.POWER: AT_POWER, op.POWERX: AT_POWERX}


def is_minus_zero(operation: int, first: bool, second: bool) -> bool:
    """Return True if IBM's library of 1962 would give a fixed-point result of zero a minus sign.

    A zero sum has the sign of the accumulator.  A zero product or quotient is negative if the signs of its operands
    differ.  ``first`` is True if the accumulator is negative, ``second`` if the operand is negative.
    """
    if operation <= op.XSBR:
        return first != (operation == op.XSBR)
    return first != second


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
    """Execute instructions, changing ``state``, until the caller must act or the run ends.  Return the reason.

    Parameters
    ----------
    table
        The subscripts, from :func:`emulator.machine.state.subscript_table`.
    limit
        Return AT_LIMIT before the first statement that begins after this amount of work.
    most
        The limit of the whole run.  Return AT_COSTLY before an operation that would exceed it by more than SLACK.
    strict
        Return AT_BOUNDS for a subscript outside its array.
    traced
        Return AT_STATEMENT at the beginning of each statement.
    enters
        A flag for each instruction, True if the journal records it.

    Raises
    ------
    Undecided
        If the arithmetic cannot represent the result of an operation, or cannot determine the sign that an IF tests.
        ``state.at`` is then an instruction of the statement at fault.
    """
    operations, addresses, subscripts, seconds, _, targets, loops, begins, charges, size = code
    # While the loop runs the registers are local variables, which are faster than attributes of the state.
    values, kinds, counts = state.values, state.kinds, state.counts
    pc, fac, fixed, work, stored, decision = state.pc, state.fac, state.fixed, state.work, state.stored, state.decision
    sent, sent_kind = state.sent, state.sent_kind
    element = state.element
    event = 0
    address = 0
    reason = AT_EVENT
    add, subtract, multiply = numbers.add, numbers.subtract, numbers.multiply
    sign, checked = numbers.sign, numbers.checked
    weigh = numbers.work if numbers.is_costly else None
    as_1962 = numbers.as_1962
    # If the run is compared with another one, ``decide`` records its decisions and ``enter`` its stores.
    decide = journal.entries.append if journal else None
    enter = journal.entries.append if journal and journal.stores else None
    if enter and state.listed:
        # Before this call the session transferred an element of a list, which has yet to be recorded.
        if enters[state.at]:
            enter((state.at, state.address, values[state.address]))
        state.listed = False
    try:
        while True:
            operation = operations[pc]
            address = addresses[pc]
            subscript = subscripts[pc]
            if subscript >= 0:
                # A subscript is factor * variable + constant (C26-5619 p. 18).  ``row`` and ``column`` begin with the
                # constants; a negative address means that there is no variable.
                variable, factor, row, rows, variable_2, factor_2, column, columns = table[subscript]
                if variable >= 0:
                    if kinds[variable] != FIXED_POINT:
                        address = variable
                        reason = AT_UNDEFINED
                        break
                    row += factor * values[variable]
                if variable_2 >= 0:
                    if kinds[variable_2] != FIXED_POINT:
                        address = variable_2
                        reason = AT_UNDEFINED
                        break
                    column += factor_2 * values[variable_2]
                # An array of one dimension has 0 columns, and its column is 1.
                if strict and not (1 <= row <= rows and 1 <= column <= (columns or 1)):
                    # The hull programs copy element N+1 when they delete the last entry of a full table (KNOWN-FAULTS).
                    # No statement computes with the copy, so the copy is only marked as undefined.
                    if operation == SEND and row == rows + 1 and columns == 0:
                        sent, sent_kind = 0, UNDEFINED
                        pc += 1
                        continue
                    state.index = (row, column)
                    reason = AT_BOUNDS
                    break
                # Arrays are stored column by column.
                address += row - 1 + rows * (column - 1)
                if address < 0 or address >= size:
                    reason = AT_OUTSIDE
                    break
            # Frequent operations are tried first.
            if operation <= FDVR:
                # The floating accumulator FAC (C26-5619 p. 60-69).
                if operation == FMFAC:
                    values[address] = checked(fac)
                    kinds[address] = FLOATING
                    stored = address
                    if enter and enters[pc]:
                        enter((pc, address, fac))
                    pc += 1
                    continue
                # A field that is undefined or holds a fixed-point number cannot be computed with.
                if kinds[address] >= FIXED_POINT:
                    reason = AT_UNDEFINED
                    break
                value = values[address]
                if operation == TOFAC:
                    fac = value
                    pc += 1
                    continue
                # The work of an operation is counted before the operation begins, so that one that is far too long
                # never begins.
                if weigh:
                    work += state.owe(weigh(_WORK_NAMES[operation], fac, value))
                    if work > most + SLACK:
                        reason = AT_COSTLY
                        break
                # The run continues after the operation even if it ends in an error code (Trap).
                pc += 1
                if operation == FMP:
                    fac = multiply(fac, value)
                elif operation == FAD:
                    fac = add(fac, value)
                elif operation == FSB:
                    fac = subtract(fac, value)
                elif operation == FSBR:
                    fac = numbers.subtract_reversed(fac, value)
                elif operation == FDV:
                    fac = numbers.divide(fac, value)
                else:
                    fac = numbers.divide(value, fac)
            elif operation == COUNT:
                # A statement begins, or a part of one that is counted separately.  Only here may the limit stop a run.
                charge = charges[address]
                if charge:
                    if work >= limit:
                        reason = AT_LIMIT
                        break
                    work += charge
                counts[address] += 1
                if enter:
                    enter((pc, 0, None))
                pc += 1
                if traced and begins[address] == 1:
                    reason = AT_STATEMENT
                    break
            elif operation == IF:
                if weigh and (work := work + state.owe(weigh("sign", fac))) > most + SLACK:
                    reason = AT_COSTLY
                    break
                # The three targets of an IF are those for negative, zero and positive, in this order.
                target = targets[address + 1 + sign(fac)]
                decision = pc + 1
                if decide:
                    decide((pc, target, fac))
                pc = target
            elif operation == DOTEST:
                # The end of a DO: add the step to the variable, and repeat the range unless it exceeds the limit.
                variable = loops[address]
                step, last = loops[address + 1], loops[address + 2]
                if not kinds[variable] == kinds[step] == kinds[last] == FIXED_POINT:
                    address = next(f for f in (variable, step, last) if kinds[f] != FIXED_POINT)
                    reason = AT_UNDEFINED
                    break
                value = wrap_integer(values[variable] + values[step])
                if as_1962 and value == 0:
                    value = signed_zero(is_negative(values[variable]))
                values[variable] = value
                target = loops[address + 3] if value <= values[last] else pc + 1
                if decide:
                    decide((pc, target, value))
                pc = target
            elif operation == SEND:
                # SEND and TRANSMIT copy a field even if it is undefined.
                sent, sent_kind = values[address], kinds[address]
                pc += 1
            elif operation == TRANSMIT:
                values[address], kinds[address] = sent, sent_kind
                stored = address
                if enter and enters[pc]:
                    enter((pc, address, None if sent_kind == UNDEFINED else sent))
                pc += 1
            elif operation == BRANCH:
                pc = targets[address]
            elif operation <= op.XDVR:
                # The fixed-point accumulator: four digits and a sign (C26-5619 p. 14).
                if operation == op.FMFIX:
                    values[address], kinds[address] = fixed, FIXED_POINT
                    stored = address
                    if enter and enters[pc]:
                        enter((pc, address, fixed))
                    pc += 1
                    continue
                if kinds[address] != FIXED_POINT:
                    reason = AT_UNDEFINED
                    break
                value = values[address]
                pc += 1
                before = fixed
                if operation == op.TOFIX:
                    fixed = value
                elif operation == op.XAD:
                    fixed = wrap_integer(fixed + value)
                elif operation == op.XSB:
                    fixed = wrap_integer(fixed - value)
                elif operation == op.XSBR:
                    fixed = wrap_integer(value - fixed)
                elif operation == op.XMP:
                    fixed = wrap_integer(fixed * value)
                else:
                    if operation == op.XDVR:
                        fixed, value = value, fixed
                    fixed, event = divide_fixed(fixed, value)
                    if event:
                        reason = AT_EVENT
                        break
                if as_1962 and fixed == 0 and operation != op.TOFIX:
                    fixed = signed_zero(is_minus_zero(operation, is_negative(before), is_negative(values[address])))
            elif operation == op.IFX:
                target = targets[address + 1 + (fixed > 0) - (fixed < 0)]
                decision = pc + 1
                if decide:
                    decide((pc, target, fixed))
                pc = target
            elif operation == op.RSGN:
                fac = numbers.negate(fac)
                pc += 1
            elif operation == op.RSGX:
                fixed = signed_zero(not is_negative(fixed)) if as_1962 and fixed == 0 else -fixed
                pc += 1
            elif operation == op.FLOAT:
                fac = numbers.from_integer(fixed)
                pc += 1
            elif operation == op.FIX:
                if weigh and (work := work + state.owe(weigh("to_integer", fac))) > most + SLACK:
                    reason = AT_COSTLY
                    break
                fixed = numbers.to_integer(fac)
                pc += 1
            elif operation == op.SELECT:
                # A computed GO TO.  The number before the targets in the table is their count.
                if kinds[address] != FIXED_POINT:
                    reason = AT_UNDEFINED
                    break
                value = values[address]
                first = seconds[pc]
                if value < 1 or value > targets[first - 1]:
                    state.index = (value,)
                    reason = AT_SELECT
                    break
                target = targets[first + value - 1]
                decision = pc + 1
                if decide:
                    decide((pc, target, value))
                pc = target
            elif operation == op.SWITCH:
                if seconds[pc] == op.LAST_CARD:
                    is_on, state.last_card = state.last_card, False
                else:
                    is_on = bool(switches[seconds[pc] - 1])
                pc = targets[address] if is_on else targets[address + 1]
            elif operation == op.ITEM:
                # One number of a list.  For a whole array the instruction is repeated until the last element.
                if work > most + SLACK:
                    reason = AT_COSTLY
                    break
                address += element
                element = element_after(element, seconds[pc])
                pc += element == 0
                state.listed = True
                reason = AT_ITEM
                break
            elif operation in _REASONS:
                # POWER needs a floating-point field, POWERX a fixed-point one.
                if operation in (op.POWER, op.POWERX) and (
                    kinds[address] == UNDEFINED or (kinds[address] == FIXED_POINT) != (operation == op.POWERX)
                ):
                    reason = AT_UNDEFINED
                    break
                pc += 1
                reason = _REASONS[operation]
                break
            else:
                reason = AT_STOP
                break
    except Trap as trap:
        # An error code of the arithmetic, E1 to E8: FAC holds the value that the machine continues with.
        fac, event, reason = trap.value, trap.event, AT_EVENT
    finally:
        # ``at`` is the instruction that caused the return.  ``pc`` is already beyond an instruction that requests a
        # service.  After an error that ends the run, and between two elements of an array, ``pc`` still points to it.
        state.at = pc if reason >= AT_LIMIT or element else pc - 1
        state.pc, state.fac, state.fixed, state.work, state.stored = pc, fac, fixed, work, stored
        state.sent, state.sent_kind, state.event, state.address = sent, sent_kind, event, address
        state.element, state.decision = element, decision
    return reason

"""Run a program on a whole deck in compiled code, with the kernel (the loop over object code) and the devices.

The engine supports READ, PUNCH, PRINT and TYPE with any FORMAT, SQRT, integer powers, error codes, PAUSE and the normal
endings.  If a run needs anything else, it ends with NOT_HERE, and the caller runs the deck again on a
:class:`emulator.machine.machine.Machine`.  A run ends with NOT_HERE at a library function other than SQRT, an ACCEPT, a
card field without a number, a number that needs a warning, a record that is too long, a list that does not fit its
FORMAT, or the end of a deck within a data set.

The functions use only the part of Python that numba compiles.
"""

from typing import NamedTuple

from emulator.compiled import devices as dev
from emulator.compiled.devices import Cards, Code, Desk, Forms, Report, Tools, begin, error, finish, item
from emulator.compiled.kernel import (
    ADDRESS,
    AT,
    AT_MINUS_ZERO,
    CHARACTERISTIC,
    DRAWS,
    EVENT,
    FAC,
    WORK,
    Core,
    Row,
    owe,
    run,
)
from emulator.machine import interpreter
from emulator.machine.result import LOOP_WINDOW
from emulator.numbers.accumulator import whole_power
from emulator.numbers.arithmetic import ZERO, Rules, drawn, square_root
from emulator.numbers.work import multiplied


class Start(NamedTuple):
    """The contents of core storage before a run: mantissa and exponent of each field."""

    mantissas: Row
    exponents: Row


# The limit of the run, 1 for strict bounds, and 1 if an empty hopper is a normal end at any READ.
Setting = tuple[int, int, int]


def run_decks(
    code: Code,
    forms: Forms,
    start: Start,
    cards: Cards,
    core: Core,
    tools: Tools,
    report: Report,
    rules: Rules,
    setting: Setting,
) -> int:
    """Run the program on the decks, in order, until the devices' log is full.  Return the number of completed decks.

    The caller must call the function again, with an empty log, for the remaining decks.
    """
    used = 0
    for d in range(len(cards.first) - 1):
        devices, ends = tools.devices, report.ends[d]
        registers, numbers, errors = report.registers[d], report.numbers[d], report.errors[d]
        desk = Desk(tools.texts, devices, tools.line, tools.field, registers, numbers, errors, report.log)
        load(forms, start, core, desk)
        clear(report.counts[d])
        clear(report.pauses[d])
        devices[dev.USED] = used
        devices[dev.NEXT] = cards.first[d]
        devices[dev.FIRST_CARD] = cards.first[d]
        devices[dev.LAST_CARD] = cards.first[d + 1]
        counts, before, pauses = report.counts[d], report.before[d], report.pauses[d]
        reason = run_deck(code, forms, cards, core, desk, counts, before, pauses, rules, setting)
        if reason == dev.LOG_FULL:
            return d
        ends[dev.REASON] = reason
        ends[dev.CARDS_READ] = devices[dev.NEXT] - devices[dev.FIRST_CARD]
        ends[dev.LOG_FROM] = used
        used = devices[dev.USED]
        ends[dev.LOG_TO] = used
        # Save the kind of the last field used, for a message about it, before the next deck overwrites the field.
        address = registers[ADDRESS]
        ends[dev.HELD] = core.exponents[address] if 0 <= address < len(core.exponents) else 0
    return len(cards.first) - 1


def load(forms: Forms, start: Start, core: Core, desk: Desk) -> None:
    """Reset core storage, the FORMAT texts and the registers to their state before a run."""
    copy(start.mantissas, core.mantissas)
    copy(start.exponents, core.exponents)
    copy(forms.texts, desk.texts)
    clear(desk.devices)
    desk.devices[dev.FIRST_READ] = -1
    clear(desk.registers)
    clear(desk.numbers)
    clear(desk.errors)
    desk.registers[CHARACTERISTIC] = ZERO


def copy(source: Row, target: Row) -> None:
    for k in range(len(source)):
        target[k] = source[k]


def clear(row: Row) -> None:
    for k in range(len(row)):
        row[k] = 0


def run_deck(
    code: Code,
    forms: Forms,
    cards: Cards,
    core: Core,
    desk: Desk,
    counts: Row,
    before: Row,
    pauses: Row,
    rules: Rules,
    setting: Setting,
) -> int:
    """Run the program on one deck and return the reason for the end of the run.

    The entries FIRST_CARD, LAST_CARD and NEXT of ``desk.devices`` must already be set for the deck.
    """
    limit, strict, any_read = setting
    marks, devices, registers = code.marks, desk.devices, desk.registers
    devices[dev.ANY_READ] = any_read
    devices[dev.AS_1962] = rules.as_1962
    # As in Session.advance, the counts are saved shortly before the limit, for the message about a loop.
    goal = limit - min(LOOP_WINDOW, limit // 2)
    saved = False
    while True:
        reason = run(code.flat, core, counts, registers, rules, goal, limit, strict)
        pc = registers[AT]
        address = registers[ADDRESS]
        status = dev.GO_ON
        # A root or a power takes a random number, as an operation of the kernel does.
        if rules.random and (reason == interpreter.AT_FUNCTION or reason == interpreter.AT_POWERX):
            registers[DRAWS] += 1
            rules = drawn(rules, registers[DRAWS])
        if reason == interpreter.AT_ITEM:
            status = item(marks, forms, cards, core, desk, rules)
        elif reason == interpreter.AT_BEGIN:
            status = begin(marks, forms, cards, desk)
        elif reason == interpreter.AT_FINISH:
            status = finish(marks, forms, cards, desk)
        elif reason == interpreter.AT_EVENT:
            status = error(registers[EVENT], marks, desk)
        # Without ``as_1962`` the exact power is truncated once.  For exponents from -1 to 2 repeated
        # multiplication gives the same result.  Other exponents would need more than 64 bits.
        elif reason == interpreter.AT_POWERX and (rules.as_1962 or -1 <= core.mantissas[address] <= 2):
            if registers[FAC] != 0 and not -1 <= core.mantissas[address] <= 2:
                owe(registers, multiplied(core.mantissas[address]))
                if registers[WORK] > limit + interpreter.SLACK:
                    return interpreter.AT_COSTLY
            m, e, event = whole_power(registers[FAC], registers[CHARACTERISTIC], core.mantissas[address], rules)
            registers[FAC] = m
            registers[CHARACTERISTIC] = e
            if event:
                status = error(event, marks, desk)
        elif reason == interpreter.AT_FUNCTION:
            # SQRT is the only library function that integers can compute.
            if code.roots[address] == 0:
                return dev.NOT_HERE
            m, e = registers[FAC], ZERO
            if m != 0:
                m, e = square_root(m, registers[CHARACTERISTIC], rules)
            registers[FAC] = m
            registers[CHARACTERISTIC] = e
        elif reason == interpreter.AT_PAUSE:
            # The run continues as if START were pressed.  ``pauses`` numbers the PAUSE statements in the order of their
            # first execution.
            if pauses[marks.statements[pc]] == 0:
                devices[dev.PAUSES] += 1
                pauses[marks.statements[pc]] = devices[dev.PAUSES]
        elif reason == interpreter.AT_LIMIT and not saved:
            copy(counts, before)
            goal = limit
            saved = True
        elif reason == interpreter.AT_POWER or reason == interpreter.AT_POWERX or reason == AT_MINUS_ZERO:
            return dev.NOT_HERE
        else:
            return reason
        if status != dev.GO_ON:
            return status

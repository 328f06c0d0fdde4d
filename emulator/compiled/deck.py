"""A deck run from its first card to its ending in integers alone: the engine with the devices it needs.

Most runs need READ, PUNCH, PRINT and TYPE by any FORMAT, SQRT, whole powers, error codes, PAUSE and the endings.  A
deck that needs anything else (another function, ACCEPT, a field that holds no number or calls for a remark, a
record too long, a list its FORMAT does not fit, a hopper empty too early) ends with NOT_HERE, and whoever asked
runs it on a :class:`emulator.machine.machine.Machine` from the start.

The functions use only what a compiler of integer loops accepts.
"""

from __future__ import annotations

from typing import NamedTuple

from emulator.compiled.devices import (
    ANY_READ,
    CARDS_READ,
    DEVICES,
    FIRST_CARD,
    FIRST_READ,
    GO_ON,
    HELD,
    LAST_CARD,
    LOG_FROM,
    LOG_FULL,
    LOG_TO,
    NEXT,
    NOT_HERE,
    PAUSES,
    READ,
    REASON,
    USED,
    VERB,
    Cards,
    Code,
    Desk,
    Forms,
    Report,
    Tools,
    begin,
    end_record,
    error,
    item,
    to_field,
)
from emulator.compiled.kernel import ADDRESS, AT, CHARACTERISTIC, EVENT, FAC, WORK, Core, Row, owe, run
from emulator.machine.interpreter import (
    AT_BEGIN,
    AT_COSTLY,
    AT_EVENT,
    AT_FINISH,
    AT_FUNCTION,
    AT_ITEM,
    AT_LIMIT,
    AT_PAUSE,
    AT_POWER,
    AT_POWERX,
    SLACK,
)
from emulator.machine.result import LOOP_WINDOW
from emulator.numbers.arithmetic import ZERO, Rules, square_root, whole_power
from emulator.numbers.work import multiplied


class Start(NamedTuple):
    """Core storage as it is loaded."""

    mantissas: Row
    exponents: Row


Setting = tuple[int, int, int, int]
"""(limit, strict bounds, errors typed, an empty hopper ends the run at any READ)."""


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
    """Run one deck after the other; how many were run.

    It is fewer than there are where the log is full: the next deck is then to be run again, with an empty log.
    """
    used = 0
    for d in range(len(cards.first) - 1):
        devices, ends = tools.devices, report.ends[d]
        registers, numbers, errors = report.registers[d], report.numbers[d], report.errors[d]
        desk = Desk(tools.texts, devices, tools.line, tools.field, registers, numbers, errors, report.log)
        load(forms, start, core, desk)
        clear(report.counts[d])
        clear(report.pauses[d])
        devices[USED] = used
        devices[NEXT] = cards.first[d]
        devices[FIRST_CARD] = cards.first[d]
        devices[LAST_CARD] = cards.first[d + 1]
        counts, before, pauses = report.counts[d], report.before[d], report.pauses[d]
        reason = run_deck(code, forms, cards, core, desk, counts, before, pauses, rules, setting)
        if reason == LOG_FULL:
            return d
        ends[REASON] = reason
        ends[CARDS_READ] = devices[NEXT] - devices[FIRST_CARD]
        ends[LOG_FROM] = used
        used = devices[USED]
        ends[LOG_TO] = used
        address = registers[ADDRESS]
        ends[HELD] = core.exponents[address] if 0 <= address < len(core.exponents) else 0
    return len(cards.first) - 1


def load(forms: Forms, start: Start, core: Core, desk: Desk) -> None:
    """Core and desk as they are before a run."""
    for k in range(len(start.mantissas)):
        core.mantissas[k] = start.mantissas[k]
        core.exponents[k] = start.exponents[k]
    for k in range(len(forms.texts)):
        desk.texts[k] = forms.texts[k]
    for k in range(DEVICES):
        desk.devices[k] = 0
    desk.devices[FIRST_READ] = -1
    clear(desk.registers)
    clear(desk.numbers)
    clear(desk.errors)
    desk.registers[CHARACTERISTIC] = ZERO


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
    """Run the deck the devices are set to; how it ended."""
    limit, strict, types_errors, any_read = setting
    marks, devices, registers = code.marks, desk.devices, desk.registers
    devices[ANY_READ] = any_read
    now = limit - min(LOOP_WINDOW, limit // 2)
    last = False
    while True:
        reason = run(code.flat, core, counts, registers, rules, now, limit, strict)
        pc = registers[AT]
        address = registers[ADDRESS]
        status = GO_ON
        if reason == AT_ITEM:
            status = item(marks, forms, cards, core, desk, rules, types_errors)
        elif reason == AT_BEGIN:
            status = begin(marks, forms, cards, desk)
        elif reason == AT_FINISH:
            status = to_field(marks, forms, cards, desk, False)
            if status == GO_ON and devices[VERB] != READ:
                status = end_record(marks, cards, desk)
        elif reason == AT_EVENT:
            status = error(registers[EVENT], marks, desk, types_errors)
        elif reason == AT_POWERX and (rules.powers_multiply or -1 <= core.mantissas[address] <= 2):
            if registers[FAC] != 0 and not -1 <= core.mantissas[address] <= 2:
                owe(registers, multiplied(core.mantissas[address]))
                if registers[WORK] > limit + SLACK:
                    return AT_COSTLY
            m, e, event = whole_power(registers[FAC], registers[CHARACTERISTIC], core.mantissas[address], rules)
            registers[FAC] = m
            registers[CHARACTERISTIC] = e
            if event:
                status = error(event, marks, desk, types_errors)
        elif reason == AT_FUNCTION:
            if code.roots[address] == 0:
                return NOT_HERE
            m, e = registers[FAC], ZERO
            if m != 0:
                m, e = square_root(m, registers[CHARACTERISTIC], rules)
            registers[FAC] = m
            registers[CHARACTERISTIC] = e
        elif reason == AT_PAUSE:
            if pauses[marks.statements[pc]] == 0:
                devices[PAUSES] += 1
                pauses[marks.statements[pc]] = devices[PAUSES]
        elif reason == AT_LIMIT and not last:
            for k in range(len(counts)):
                before[k] = counts[k]
            now = limit
            last = True
        elif reason == AT_POWER or reason == AT_POWERX:
            return NOT_HERE
        else:
            return reason
        if status != GO_ON:
            return status

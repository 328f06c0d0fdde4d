"""Reader, punch and typewriter in integers alone: FORMAT at work on character codes.

What emulator/machine/forms.py and :class:`emulator.machine.machine.Machine` do in texts and objects, for runs that
nobody watches
(emulator/compiled/deck.py).  The functions use only what a compiler of integer loops accepts; every sequence in the
tuples is flat, of whole numbers or of ASCII codes.  What a device did is written to a log: a letter (BEGUN, TAKEN,
PUNCHED, TYPED), the text of the line without trailing blanks, an end of line.  A function answers GO_ON, or how the
run ends.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from emulator.compiled.kernel import ADDRESS, AT, DECISION, WORK, Core, Row, owe
from emulator.language.cards import COLUMNS
from emulator.language.objectcode import Flat
from emulator.machine.result import PUNCH_COLUMNS, TYPEWRITER_COLUMNS
from emulator.numbers.arithmetic import FIXED_POINT, UNDEFINED, Rules
from emulator.numbers.columns import BLANK, DIGIT, FINE, read_fixed, read_floating, write_fixed, write_floating
from emulator.numbers.work import ERROR

# Endings besides the kernel's reasons to return; GO_ON says that the run goes on.
GO_ON, AT_HOPPER, NOT_HERE, LOG_FULL = -1, 100, 101, 102

# What stands in a FORMAT.
E_FIELD, F_FIELD, I_FIELD, TEXT, SLASH = range(5)

# Verbs.
READ, PUNCH, TYPE, ACCEPT = range(4)

# Registers of the devices: the FORMAT, place in it and its bounds, verb, column on the card or of the line, card read,
# next card, bounds of the deck, the READ a data set begins with, length of the log, number of PAUSEs met, 1 where the
# run may end at any READ.
FORMAT, SPEC, LAST_SPEC, VERB, COLUMN, CARD, NEXT, FIRST_CARD, LAST_CARD, FIRST_READ, USED, PAUSES, ANY_READ = range(13)
DEVICES = 13

# What a row of Report.ends holds: how the run ended, cards read, bounds in the log, and what the engine's ADDRESS held.
REASON, CARDS_READ, LOG_FROM, LOG_TO, HELD = range(5)
ENDS = 5

BEGUN, TAKEN, PUNCHED, TYPED, LINE_END = b"BRPT\n"
F8 = 9
"""The error code F8 among the others, E1 to E8."""
CODES = 10
LINE_ROOM = 4096
"""Columns of the longest line that is kept; of none so long does a device have a record."""
ERROR_WORDS = b"ERROR E0"
STAMP = 6
"""Digits of a number in the log."""


class Code(NamedTuple):
    """Object code, the statement of each instruction, 1 for each function that is SQRT, and the verbs."""

    flat: Flat
    statements: Row
    roots: Row
    verbs: Row


class Forms(NamedTuple):
    """All FORMATs, one after the other: of each its bounds, where a longer list goes on, whether it has fields, and
    what going through it once counts as; of each specification what it is.

    ``places`` is where the text of an H or X begins in ``texts``, ``widths`` its length.
    """

    first: Row
    last: Row
    again: Row
    fields: Row
    charges: Row
    kinds: Row
    widths: Row
    decimals: Row
    places: Row
    texts: Row


class Cards(NamedTuple):
    """Decks one after the other: 80 codes a card, and the first card of each deck."""

    columns: Row
    first: Row


class Report(NamedTuple):
    """What is found out, a row a deck, and the log."""

    ends: Sequence[Row]
    registers: Sequence[Row]
    counts: Sequence[Row]
    before: Sequence[Row]
    numbers: Sequence[Row]
    errors: Sequence[Row]
    pauses: Sequence[Row]
    log: Row


def begin(code: Code, forms: Forms, cards: Cards, core: Core, report: Report, d: int) -> int:
    """An input or output statement begins."""
    devices, pc = core.devices, report.registers[d][AT]
    verb = code.verbs[report.registers[d][ADDRESS]]
    number = code.flat.seconds[pc]
    devices[VERB] = verb
    devices[FORMAT] = number
    devices[SPEC] = forms.first[number]
    devices[LAST_SPEC] = forms.last[number]
    devices[COLUMN] = 0
    report.registers[d][WORK] += forms.charges[number]
    if verb == ACCEPT:
        return NOT_HERE
    if verb != READ:
        return GO_ON
    empty = devices[NEXT] == devices[LAST_CARD] and devices[NEXT] > devices[FIRST_CARD]
    if devices[FIRST_READ] < 0 or devices[FIRST_READ] == pc:
        devices[FIRST_READ] = pc
        status = put(BEGUN, core.field, 0, core, report)
        if status != GO_ON:
            return status
        if empty:
            return AT_HOPPER
    elif empty and devices[ANY_READ]:
        return AT_HOPPER
    return end_record(code, cards, core, report, d)


def to_field(code: Code, forms: Forms, cards: Cards, core: Core, report: Report, d: int, wanted: bool) -> int:
    """Go on to the next field of the FORMAT; if one is wanted, beyond its end to its start and a new record."""
    devices = core.devices
    while True:
        spec = devices[SPEC]
        status = GO_ON
        if spec == devices[LAST_SPEC]:
            if not wanted:
                return GO_ON
            if forms.fields[devices[FORMAT]] == 0:
                return NOT_HERE
            status = end_record(code, cards, core, report, d)
            devices[SPEC] = forms.again[devices[FORMAT]]
            report.registers[d][WORK] += forms.charges[devices[FORMAT]]
        elif forms.kinds[spec] == SLASH:
            status = end_record(code, cards, core, report, d)
            devices[SPEC] = spec + 1
        elif forms.kinds[spec] == TEXT:
            status = text(forms.places[spec], forms.widths[spec], cards, core)
            devices[SPEC] = spec + 1
        else:
            return GO_ON
        if status != GO_ON:
            return status


def text(place: int, width: int, cards: Cards, core: Core) -> int:
    """An H or X field: put out, or changed to what the card has."""
    devices = core.devices
    column = devices[COLUMN]
    devices[COLUMN] += width
    if devices[VERB] == READ:
        for k in range(width):
            core.texts[place + k] = column_of(cards, devices[CARD], column + k)
        return GO_ON
    if column + width > LINE_ROOM:
        return NOT_HERE
    for k in range(width):
        core.line[column + k] = core.texts[place + k]
    return GO_ON


def column_of(cards: Cards, card: int, column: int) -> int:
    """A column of a card, from 0; blank beyond its end."""
    return cards.columns[card * COLUMNS + column] if column < COLUMNS else BLANK


def end_record(code: Code, cards: Cards, core: Core, report: Report, d: int) -> int:
    """The next card is taken, or the line goes out."""
    devices = core.devices
    length = devices[COLUMN]
    devices[COLUMN] = 0
    if devices[VERB] == READ:
        if devices[NEXT] == devices[LAST_CARD]:
            return NOT_HERE
        devices[CARD] = devices[NEXT]
        devices[NEXT] += 1
        return put(TAKEN, core.field, 0, core, report)
    line = core.line
    while length > 0 and line[length - 1] == BLANK:
        length -= 1
    if length > (PUNCH_COLUMNS if devices[VERB] == PUNCH else TYPEWRITER_COLUMNS):
        return NOT_HERE
    report.registers[d][WORK] += 1
    if devices[VERB] == PUNCH:
        return put(PUNCHED, line, length, core, report)
    return put_typed(line, length, code, core, report, d)


def put(letter: int, line: Row, length: int, core: Core, report: Report) -> int:
    """Write to the log."""
    log, used = report.log, core.devices[USED]
    if used + length + 2 > len(log):
        return LOG_FULL
    log[used] = letter
    for k in range(length):
        log[used + 1 + k] = line[k]
    log[used + 1 + length] = LINE_END
    core.devices[USED] = used + length + 2
    return GO_ON


def put_typed(line: Row, length: int, code: Code, core: Core, report: Report, d: int) -> int:
    """Write a line typed to the log: before its text the statement that types it, and the last decision."""
    registers, log, used = report.registers[d], report.log, core.devices[USED]
    if used + length + 2 + 2 * STAMP > len(log):
        return LOG_FULL
    status = put(TYPED, line, 0, core, report)
    core.devices[USED] = used + 1
    stamp(code.statements[registers[AT]], core, report)
    stamp(registers[DECISION], core, report)
    used = core.devices[USED]
    for k in range(length):
        log[used + k] = line[k]
    log[used + length] = LINE_END
    core.devices[USED] = used + length + 1
    return status


def stamp(number: int, core: Core, report: Report) -> None:
    """Write a number of STAMP digits to the log."""
    used = core.devices[USED]
    for k in range(STAMP):
        report.log[used + STAMP - 1 - k] = DIGIT + number % 10
        number = number // 10
    core.devices[USED] = used + STAMP


def error(number: int, code: Code, core: Core, report: Report, d: int, announces: int) -> int:
    """Count an error code and, if the profile does, type it."""
    registers = report.registers[d]
    report.errors[d][CODES * code.statements[registers[AT]] + number] += 1
    owe(registers, ERROR)
    if not announces:
        return GO_ON
    field = core.field
    for k in range(len(ERROR_WORDS)):
        field[k] = ERROR_WORDS[k]
    last = len(ERROR_WORDS) - 1
    if number == F8:
        field[last - 1] += 1
        field[last] = DIGIT + 8
    else:
        field[last] = DIGIT + number
    registers[WORK] += 1
    return put_typed(field, last + 1, code, core, report, d)


def item(
    code: Code, forms: Forms, cards: Cards, core: Core, report: Report, d: int, rules: Rules, announces: int
) -> int:
    """One number of a list, read or put out."""
    devices, field, registers = core.devices, core.field, report.registers[d]
    registers[WORK] += 1
    status = to_field(code, forms, cards, core, report, d, True)
    if status != GO_ON:
        return status
    spec, address = devices[SPEC], registers[ADDRESS]
    devices[SPEC] += 1
    kind, width, decimals = forms.kinds[spec], forms.widths[spec], forms.decimals[spec]
    fixed = code.flat.seconds[registers[AT]] < 0
    column = devices[COLUMN]
    if (kind == I_FIELD) != fixed:
        return NOT_HERE
    if devices[VERB] == READ:
        report.numbers[d][2 * kind] += 1
        devices[COLUMN] += width
        for k in range(width):
            field[k] = column_of(cards, devices[CARD], column + k)
        if fixed:
            m, status = read_fixed(field, width)
            e = FIXED_POINT
        else:
            m, e, status = read_floating(field, width, decimals, rules)
        if status != FINE:
            return NOT_HERE
        core.mantissas[address] = m
        core.exponents[address] = e
        return GO_ON
    report.numbers[d][2 * kind + 1] += 1
    m, e = core.mantissas[address], core.exponents[address]
    if e == UNDEFINED or (e == FIXED_POINT) != fixed or column + width + 14 > LINE_ROOM:
        return NOT_HERE
    if fixed:
        devices[COLUMN] = write_fixed(core.line, column, width, m)
        return GO_ON
    end, overflowed = write_floating(core.line, column, kind == E_FIELD, width, decimals, m, e, rules)
    devices[COLUMN] = end
    return error(F8, code, core, report, d, announces) if overflowed else GO_ON

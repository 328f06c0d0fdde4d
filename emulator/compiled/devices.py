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

# Numbers of a FORMAT and of a specification.
FIRST, LAST, AGAIN, FIELDS, CHARGE = range(5)
FORM = 5
KIND, WIDTH, DECIMALS, PLACE = range(4)
PART = 4

BEGUN, TAKEN, PUNCHED, TYPED, LINE_END = b"BRPT\n"
F8 = 9
"""The error code F8 among the others, E1 to E8."""
CODES = 10
LINE_ROOM = 4096
"""Columns of the longest line that is kept; of none so long does a device have a record."""
ERROR_WORDS = b"ERROR E0"
STAMP = 6
"""Digits of a number in the log."""


# The functions below are given few sequences: numba hands each over as seven numbers and more, in every call.
class Marks(NamedTuple):
    """What devices need of object code: the second number and the statement of each instruction, and the verbs."""

    seconds: Row
    statements: Row
    verbs: Row


class Code(NamedTuple):
    """Object code, what devices need of it, and 1 for each function that is SQRT."""

    flat: Flat
    marks: Marks
    roots: Row


class Forms(NamedTuple):
    """All FORMATs, one after the other, FORM numbers each: its bounds, where a longer list goes on, whether it has
    fields, and what going through it once counts as; of each specification PART numbers: what it is.

    PLACE is where the text of an H or X begins in ``texts``, WIDTH its length.
    """

    formats: Row
    specs: Row
    texts: Row


class Cards(NamedTuple):
    """Decks one after the other: 80 codes a card, and the first card of each deck."""

    columns: Row
    first: Row


class Tools(NamedTuple):
    """What the devices use, deck after deck: texts of the FORMATs, which reading changes, registers, line, a field."""

    texts: Row
    devices: Row
    line: Row
    field: Row


class Desk(NamedTuple):
    """What the devices of one deck work on: the tools, and of the report its rows and the log."""

    texts: Row
    devices: Row
    line: Row
    field: Row
    registers: Row
    numbers: Row
    errors: Row
    log: Row


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


def begin(marks: Marks, forms: Forms, cards: Cards, desk: Desk) -> int:
    """An input or output statement begins."""
    devices, pc = desk.devices, desk.registers[AT]
    verb = marks.verbs[desk.registers[ADDRESS]]
    number = marks.seconds[pc]
    devices[VERB] = verb
    devices[FORMAT] = number
    devices[SPEC] = forms.formats[FORM * number + FIRST]
    devices[LAST_SPEC] = forms.formats[FORM * number + LAST]
    devices[COLUMN] = 0
    desk.registers[WORK] += forms.formats[FORM * number + CHARGE]
    if verb == ACCEPT:
        return NOT_HERE
    if verb != READ:
        return GO_ON
    empty = devices[NEXT] == devices[LAST_CARD] and devices[NEXT] > devices[FIRST_CARD]
    if devices[FIRST_READ] < 0 or devices[FIRST_READ] == pc:
        devices[FIRST_READ] = pc
        status = put(BEGUN, desk.field, 0, desk)
        if status != GO_ON:
            return status
        if empty:
            return AT_HOPPER
    elif empty and devices[ANY_READ]:
        return AT_HOPPER
    return end_record(marks, cards, desk)


def to_field(marks: Marks, forms: Forms, cards: Cards, desk: Desk, wanted: bool) -> int:
    """Go on to the next field of the FORMAT; if one is wanted, beyond its end to its start and a new record."""
    devices = desk.devices
    while True:
        spec = devices[SPEC]
        status = GO_ON
        if spec == devices[LAST_SPEC]:
            if not wanted:
                return GO_ON
            if forms.formats[FORM * devices[FORMAT] + FIELDS] == 0:
                return NOT_HERE
            status = end_record(marks, cards, desk)
            devices[SPEC] = forms.formats[FORM * devices[FORMAT] + AGAIN]
            desk.registers[WORK] += forms.formats[FORM * devices[FORMAT] + CHARGE]
        elif forms.specs[PART * spec + KIND] == SLASH:
            status = end_record(marks, cards, desk)
            devices[SPEC] = spec + 1
        elif forms.specs[PART * spec + KIND] == TEXT:
            status = text(forms.specs[PART * spec + PLACE], forms.specs[PART * spec + WIDTH], cards, desk)
            devices[SPEC] = spec + 1
        else:
            return GO_ON
        if status != GO_ON:
            return status


def text(place: int, width: int, cards: Cards, desk: Desk) -> int:
    """An H or X field: put out, or changed to what the card has."""
    devices = desk.devices
    column = devices[COLUMN]
    devices[COLUMN] += width
    if devices[VERB] == READ:
        for k in range(width):
            desk.texts[place + k] = column_of(cards, devices[CARD], column + k)
        return GO_ON
    if column + width > LINE_ROOM:
        return NOT_HERE
    for k in range(width):
        desk.line[column + k] = desk.texts[place + k]
    return GO_ON


def column_of(cards: Cards, card: int, column: int) -> int:
    """A column of a card, from 0; blank beyond its end."""
    return cards.columns[card * COLUMNS + column] if column < COLUMNS else BLANK


def end_record(marks: Marks, cards: Cards, desk: Desk) -> int:
    """The next card is taken, or the line goes out."""
    devices = desk.devices
    length = devices[COLUMN]
    devices[COLUMN] = 0
    if devices[VERB] == READ:
        if devices[NEXT] == devices[LAST_CARD]:
            return NOT_HERE
        devices[CARD] = devices[NEXT]
        devices[NEXT] += 1
        return put(TAKEN, desk.field, 0, desk)
    line = desk.line
    while length > 0 and line[length - 1] == BLANK:
        length -= 1
    if length > (PUNCH_COLUMNS if devices[VERB] == PUNCH else TYPEWRITER_COLUMNS):
        return NOT_HERE
    desk.registers[WORK] += 1
    if devices[VERB] == PUNCH:
        return put(PUNCHED, line, length, desk)
    return put_typed(line, length, marks, desk)


def put(letter: int, line: Row, length: int, desk: Desk) -> int:
    """Write to the log."""
    log, used = desk.log, desk.devices[USED]
    if used + length + 2 > len(log):
        return LOG_FULL
    log[used] = letter
    for k in range(length):
        log[used + 1 + k] = line[k]
    log[used + 1 + length] = LINE_END
    desk.devices[USED] = used + length + 2
    return GO_ON


def put_typed(line: Row, length: int, marks: Marks, desk: Desk) -> int:
    """Write a line typed to the log: before its text the statement that types it, and the last decision."""
    registers, log, used = desk.registers, desk.log, desk.devices[USED]
    if used + length + 2 + 2 * STAMP > len(log):
        return LOG_FULL
    status = put(TYPED, line, 0, desk)
    desk.devices[USED] = used + 1
    stamp(marks.statements[registers[AT]], desk)
    stamp(registers[DECISION], desk)
    used = desk.devices[USED]
    for k in range(length):
        log[used + k] = line[k]
    log[used + length] = LINE_END
    desk.devices[USED] = used + length + 1
    return status


def stamp(number: int, desk: Desk) -> None:
    """Write a number of STAMP digits to the log."""
    used = desk.devices[USED]
    for k in range(STAMP):
        desk.log[used + STAMP - 1 - k] = DIGIT + number % 10
        number = number // 10
    desk.devices[USED] = used + STAMP


def error(number: int, marks: Marks, desk: Desk, types_errors: int) -> int:
    """Count an error code and, if the profile does, type it."""
    registers = desk.registers
    desk.errors[CODES * marks.statements[registers[AT]] + number] += 1
    owe(registers, ERROR)
    if not types_errors:
        return GO_ON
    field = desk.field
    for k in range(len(ERROR_WORDS)):
        field[k] = ERROR_WORDS[k]
    last = len(ERROR_WORDS) - 1
    if number == F8:
        field[last - 1] += 1
        field[last] = DIGIT + 8
    else:
        field[last] = DIGIT + number
    registers[WORK] += 1
    return put_typed(field, last + 1, marks, desk)


def item(marks: Marks, forms: Forms, cards: Cards, core: Core, desk: Desk, rules: Rules, types_errors: int) -> int:
    """One number of a list, read or put out."""
    devices, field, registers = desk.devices, desk.field, desk.registers
    registers[WORK] += 1
    status = to_field(marks, forms, cards, desk, True)
    if status != GO_ON:
        return status
    spec, address = devices[SPEC], registers[ADDRESS]
    devices[SPEC] += 1
    part = PART * spec
    kind, width, decimals = forms.specs[part + KIND], forms.specs[part + WIDTH], forms.specs[part + DECIMALS]
    fixed = marks.seconds[registers[AT]] < 0
    column = devices[COLUMN]
    if (kind == I_FIELD) != fixed:
        return NOT_HERE
    if devices[VERB] == READ:
        desk.numbers[2 * kind] += 1
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
    desk.numbers[2 * kind + 1] += 1
    m, e = core.mantissas[address], core.exponents[address]
    if e == UNDEFINED or (e == FIXED_POINT) != fixed or column + width + 14 > LINE_ROOM:
        return NOT_HERE
    if fixed:
        devices[COLUMN] = write_fixed(desk.line, column, width, m)
        return GO_ON
    end, overflowed = write_floating(desk.line, column, kind == E_FIELD, width, decimals, m, e, rules)
    devices[COLUMN] = end
    return error(F8, marks, desk, types_errors) if overflowed else GO_ON

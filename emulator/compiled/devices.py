"""Card reader, card punch and typewriter on integers only: input and output by FORMAT with character codes.

These functions do the same as emulator/machine/devices.py and emulator/machine/forms.py, for runs without an operator.
They use only the part of Python that numba compiles.  Their arguments are named tuples of flat arrays of integers or
ASCII codes.  The devices write a log with one line for each operation: a letter (BEGUN, TAKEN, PUNCHED or TYPED) and
the text without trailing blanks.  A function returns GO_ON, or the reason why the run ends.
"""

from collections.abc import Sequence
from typing import NamedTuple

from emulator.compiled.kernel import ADDRESS, AT, DECISION, HOPPER_EMPTY, WORK, Core, Row, owe
from emulator.language.cards import COLUMNS
from emulator.language.objectcode import Flat
from emulator.machine.result import PUNCH_COLUMNS, TYPEWRITER_COLUMNS
from emulator.numbers.arithmetic import FIXED_POINT, UNDEFINED, Rules
from emulator.numbers.columns import BLANK, DIGIT, FINE, read_fixed, read_floating, write_fixed, write_floating
from emulator.numbers.columns1962 import read_number
from emulator.numbers.columns1962 import write_fixed as write_fixed_1962
from emulator.numbers.columns1962 import write_floating as write_floating_1962
from emulator.numbers.work import ERROR

# GO_ON means that the run continues.  The other numbers are reasons for its end, in addition to those of the kernel.
GO_ON, AT_HOPPER, NOT_HERE, LOG_FULL = -1, 100, 101, 102

# The kinds of specifications of a FORMAT, and the verbs.
E_FIELD, F_FIELD, I_FIELD, TEXT, SLASH = range(5)
READ, PUNCH, TYPE, ACCEPT = range(4)

# The registers of the devices.  An input or output statement sets FORMAT (the number of its FORMAT), SPEC (the current
# specification), LAST_SPEC (the end of the specifications), VERB, and HAS_LIST (1 after the first number of its list).
# COLUMN is the current column of the card or line.  CARD is the current card, and NEXT the next one.  The deck begins
# with FIRST_CARD and ends before LAST_CARD.  FIRST_READ is the READ that begins a data set.  USED is the length of the
# log, PAUSES the number of different PAUSE statements executed, and SEQUENCE the number of cards punched.  ANY_READ is
# 1 if an empty hopper ends the run at any READ.  AS_1962 is 1 if input and output follow IBM's library of 1962.
FORMAT, SPEC, LAST_SPEC, VERB, COLUMN, CARD, NEXT, FIRST_CARD, LAST_CARD, FIRST_READ, USED, PAUSES, ANY_READ = range(13)
AS_1962, HAS_LIST, SEQUENCE = range(13, 16)
DEVICES = 16

# The entries of a row of Report.ends: the reason for the end, the number of cards read, the beginning and the end of
# the deck's lines in the log, and the kind of the field at ADDRESS.
REASON, CARDS_READ, LOG_FROM, LOG_TO, HELD = range(5)
ENDS = 5

# The numbers that describe a FORMAT: the bounds of its specifications, the specification at which a longer list
# continues, 1 if it has fields, and the work of processing it once.
FIRST, LAST, AGAIN, FIELDS, CHARGE = range(5)
FORM = 5
# The numbers that describe a specification.  For a text (an H or X field), PLACE is its position in Forms.texts, and
# WIDTH is its length.
KIND, WIDTH, DECIMALS, PLACE = range(4)
PART = 4

BEGUN, TAKEN, PUNCHED, TYPED, LINE_END = b"BRPT\n"
# The number of the error code F8.  The codes E1 to E8 have the numbers 1 to 8.
F8 = 9
CODES = 10
# The number of columns of the line buffer.  No record of any device is longer.
LINE_ROOM = 4096
ERROR_WORDS = b"ERROR E"
# The number of digits of each number in the log.
STAMP = 6


# The tuples below group the arrays so that each function receives only the arrays that it needs: numba passes an array
# as seven or more numbers in every call.
class Marks(NamedTuple):
    """The parts of the object code that devices use: verbs, second operands, and the statement of each instruction."""

    seconds: Row
    statements: Row
    verbs: Row


class Code(NamedTuple):
    """The object code, the parts of it that devices use, and a number for each library function: 1 for SQRT, else 0."""

    flat: Flat
    marks: Marks
    roots: Row


class Forms(NamedTuple):
    """The FORMAT statements (FORM integers for each), their specifications (PART integers for each) and texts."""

    formats: Row
    specs: Row
    texts: Row


class Cards(NamedTuple):
    """The cards of all decks, each as 80 character codes, and the index of the first card of each deck."""

    columns: Row
    first: Row


class Tools(NamedTuple):
    """The buffers reused for every deck: FORMAT texts (a READ can change them), registers, one record and one field."""

    texts: Row
    devices: Row
    line: Row
    field: Row


class Desk(NamedTuple):
    """The arrays for the current deck: those of :class:`Tools`, the deck's rows of :class:`Report`, and the log."""

    texts: Row
    devices: Row
    line: Row
    field: Row
    registers: Row
    numbers: Row
    errors: Row
    log: Row


class Report(NamedTuple):
    """The results of a block of decks: rows of numbers, one for each deck, and a log of the devices' operations."""

    ends: Sequence[Row]
    registers: Sequence[Row]
    counts: Sequence[Row]
    before: Sequence[Row]
    numbers: Sequence[Row]
    errors: Sequence[Row]
    pauses: Sequence[Row]
    log: Row


def begin(marks: Marks, forms: Forms, cards: Cards, desk: Desk) -> int:
    """Begin an input or output statement: find its FORMAT, and for a READ take the next card from the hopper."""
    devices, pc = desk.devices, desk.registers[AT]
    verb = marks.verbs[desk.registers[ADDRESS]]
    number = marks.seconds[pc]
    devices[VERB] = verb
    devices[FORMAT] = number
    devices[SPEC] = forms.formats[FORM * number + FIRST]
    devices[LAST_SPEC] = forms.formats[FORM * number + LAST]
    devices[COLUMN] = 0
    devices[HAS_LIST] = 0
    desk.registers[WORK] += forms.formats[FORM * number + CHARGE]
    if verb == ACCEPT:
        return NOT_HERE
    if verb != READ:
        return GO_ON
    # An empty hopper is a normal end at the READ that the program executed first (with ANY_READ at any READ), but only
    # after at least one card of the deck has been read.
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


def to_field(marks: Marks, forms: Forms, cards: Cards, desk: Desk, repeat: bool) -> int:
    """Advance to the next field for a number.  At the end of the FORMAT, start it again if ``repeat``, else stop."""
    devices = desk.devices
    while True:
        spec = devices[SPEC]
        status = GO_ON
        if spec == devices[LAST_SPEC]:
            if not repeat:
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
    """On output, write the text of an H or X field.  On input, store card columns as this text (C26-5619 p. 37)."""
    devices = desk.devices
    column = devices[COLUMN]
    devices[COLUMN] += width
    if too_long(devices) or (devices[VERB] != READ and column + width > LINE_ROOM):
        return NOT_HERE
    if devices[VERB] == READ:
        for k in range(width):
            desk.texts[place + k] = column_of(cards, devices[CARD], column + k)
        return GO_ON
    for k in range(width):
        desk.line[column + k] = desk.texts[place + k]
    return GO_ON


def too_long(devices: Row) -> bool:
    """Return True if the record is now longer than IBM's library of 1962 accepts."""
    return devices[AS_1962] != 0 and devices[COLUMN] > (TYPEWRITER_COLUMNS if devices[VERB] == TYPE else PUNCH_COLUMNS)


def finish(marks: Marks, forms: Forms, cards: Cards, desk: Desk) -> int:
    """End an input or output statement: process the rest of its FORMAT and write the last record.

    If a field of the FORMAT is unused, IBM's library of 1962 does not write the last record if it is empty or if the
    statement has no list.
    """
    devices = desk.devices
    is_input = devices[VERB] == READ
    if devices[AS_1962] and is_input and devices[HAS_LIST]:
        return finish_list(marks, forms, cards, desk)
    status = to_field(marks, forms, cards, desk, False)
    if status != GO_ON or is_input:
        return status
    unused = devices[SPEC] < devices[LAST_SPEC]
    if devices[AS_1962] and unused and (devices[HAS_LIST] == 0 or devices[COLUMN] == 0):
        return GO_ON
    return end_record(marks, cards, desk)


def finish_list(marks: Marks, forms: Forms, cards: Cards, desk: Desk) -> int:
    """End a READ with a list as IBM's library of 1962 does: a slash just before an unused field reads no card."""
    devices, specs = desk.devices, forms.specs
    status = GO_ON
    while status == GO_ON and devices[SPEC] < devices[LAST_SPEC]:
        at = PART * devices[SPEC]
        kind = specs[at + KIND]
        follows = devices[SPEC] + 1 < devices[LAST_SPEC] and specs[at + PART + KIND] < TEXT
        if kind < TEXT or (kind == SLASH and follows):
            return GO_ON
        if kind == SLASH:
            status = end_record(marks, cards, desk)
        else:
            status = text(specs[at + PLACE], specs[at + WIDTH], cards, desk)
        devices[SPEC] += 1
    return status


def column_of(cards: Cards, card: int, column: int) -> int:
    """Return the character code in a column of a card, counted from 0, or a blank beyond the last column."""
    return cards.columns[card * COLUMNS + column] if column < COLUMNS else BLANK


def end_record(marks: Marks, cards: Cards, desk: Desk) -> int:
    """End a record: on input take the next card, on output write the record without trailing blanks to the log."""
    devices = desk.devices
    length = devices[COLUMN]
    devices[COLUMN] = 0
    if devices[VERB] == READ:
        if devices[NEXT] == devices[LAST_CARD]:
            return NOT_HERE
        devices[CARD] = devices[NEXT]
        devices[NEXT] += 1
        desk.registers[HOPPER_EMPTY] = 1 if devices[NEXT] == devices[LAST_CARD] else 0
        return put(TAKEN, desk.field, 0, desk)
    line = desk.line
    while length > 0 and line[length - 1] == BLANK:
        length -= 1
    if length > (PUNCH_COLUMNS if devices[VERB] == PUNCH else TYPEWRITER_COLUMNS):
        return NOT_HERE
    desk.registers[WORK] += 1
    if devices[VERB] == PUNCH:
        if devices[AS_1962]:
            # A sequence number of three digits fills the last columns of each card.
            devices[SEQUENCE] = (devices[SEQUENCE] + 1) % 1000
            for k in range(length, COLUMNS):
                line[k] = BLANK
            number = devices[SEQUENCE]
            for k in range(COLUMNS - 1, COLUMNS - 4, -1):
                line[k] = DIGIT + number % 10
                number = number // 10
            length = COLUMNS
        return put(PUNCHED, line, length, desk)
    return put_typed(line, length, marks, desk)


def put(letter: int, line: Row, length: int, desk: Desk) -> int:
    """Write a line to the log, preceded by a letter that names the operation, such as PUNCHED or TYPED."""
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
    """Write a typed line to the log: the numbers of its statement and of the last decision, and the text."""
    registers, log, used = desk.registers, desk.log, desk.devices[USED]
    if used + length + 2 + 2 * STAMP > len(log):
        return LOG_FULL
    # ``put`` writes the letter and an end of line, which the numbers then overwrite.
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
    """Append a number to the log as STAMP (six) digits: the number of a statement or of a decision."""
    used = desk.devices[USED]
    for k in range(STAMP):
        desk.log[used + STAMP - 1 - k] = DIGIT + number % 10
        number = number // 10
    desk.devices[USED] = used + STAMP


def error(number: int, marks: Marks, desk: Desk) -> int:
    """Count an error code, and type it if the run imitates IBM's library of 1962."""
    registers = desk.registers
    desk.errors[CODES * marks.statements[registers[AT]] + number] += 1
    owe(registers, ERROR)
    if not desk.devices[AS_1962]:
        return GO_ON
    field = desk.field
    for k in range(len(ERROR_WORDS)):
        field[k] = ERROR_WORDS[k]
    field[len(ERROR_WORDS)] = DIGIT + number
    registers[WORK] += 1
    return put_typed(field, len(ERROR_WORDS) + 1, marks, desk)


def item(marks: Marks, forms: Forms, cards: Cards, core: Core, desk: Desk, rules: Rules) -> int:
    """Read or write one number of an input or output list."""
    devices, field, registers = desk.devices, desk.field, desk.registers
    registers[WORK] += 1
    status = to_field(marks, forms, cards, desk, True)
    if status != GO_ON:
        return status
    spec, address = devices[SPEC], registers[ADDRESS]
    devices[SPEC] += 1
    devices[HAS_LIST] = 1
    part = PART * spec
    kind, width, decimals = forms.specs[part + KIND], forms.specs[part + WIDTH], forms.specs[part + DECIMALS]
    fixed = marks.seconds[registers[AT]] < 0
    column = devices[COLUMN]
    # The interpreter handles every case with a message: a field of the wrong mode, an invalid number or a remark.
    if (kind == I_FIELD) != fixed:
        return NOT_HERE
    if devices[VERB] == READ:
        desk.numbers[2 * kind] += 1
        devices[COLUMN] += width
        for k in range(width):
            field[k] = column_of(cards, devices[CARD], column + k)
        if too_long(devices):
            return NOT_HERE
        if devices[AS_1962]:
            m, e, status = read_number(field, width, decimals, kind, rules)
        elif fixed:
            m, status = read_fixed(field, width)
            e = 0
        else:
            m, e, status = read_floating(field, width, decimals, rules)
        # Only the interpreter has a fixed-point minus zero.
        if status != FINE or (fixed and e != 0):
            return NOT_HERE
        core.mantissas[address] = m
        core.exponents[address] = FIXED_POINT if fixed else e
        return GO_ON
    desk.numbers[2 * kind + 1] += 1
    # A field that is too narrow is replaced by E14.8: the line needs 14 columns more.
    m, e = core.mantissas[address], core.exponents[address]
    if e == UNDEFINED or (e == FIXED_POINT) != fixed or column + width + 14 > LINE_ROOM:
        return NOT_HERE
    if devices[AS_1962]:
        devices[COLUMN] += width
        if too_long(devices):
            return NOT_HERE
        if fixed:
            end = write_fixed_1962(desk.line, column, width, abs(m), m < 0)
        else:
            end = write_floating_1962(desk.line, column, kind == E_FIELD, width, decimals, m, e, rules)
        return NOT_HERE if end < 0 else GO_ON
    if fixed:
        devices[COLUMN] = write_fixed(desk.line, column, width, m)
        return GO_ON
    end, overflowed = write_floating(desk.line, column, kind == E_FIELD, width, decimals, m, e, rules)
    devices[COLUMN] = end
    return error(F8, marks, desk) if overflowed else GO_ON

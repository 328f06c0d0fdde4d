"""The card reader, card punch and typewriter, which read and write lists of numbers by FORMAT.

:class:`emulator.machine.session.Session` drives the devices.  The devices record each operation as an event.  They
raise :class:`LineNeeded` if the operator must first type a line.  The session then repeats the call.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

from emulator.errors import CardError, DeckError
from emulator.language.cards import COLUMNS, RECORD_MARK, Card, Deck, check_characters, read_line
from emulator.language.objectcode import Line, Program
from emulator.machine.endings import Ending, Kind, Mode, Notice, decided, stopped
from emulator.machine.forms import Input, Input1962, Layout, NoField, Output, Output1962, TooLong
from emulator.machine.result import PUNCH_COLUMNS, TYPEWRITER_COLUMNS, Event, Options, Uncut
from emulator.machine.state import FLOATING, State
from emulator.numbers.arithmetic import FIXED_POINT, UNDEFINED
from emulator.numbers.base import Number
from emulator.numbers.fields import (
    FALLBACK,
    Field,
    FieldError,
    Remark,
    exponent_as_1962,
    read_fixed,
    read_fixed_as_1962,
    write_fixed,
    write_fixed_as_1962,
)
from emulator.numbers.work import ERROR

ERROR_F8 = "ERROR F8"

# The field in which the library of 1962 writes a fixed-point number after ERROR F8.
_FIXED = Field("I", 5)


class Ended(Exception):
    """Raised to end the run.  It carries the ending, which holds the reason."""

    def __init__(self, ending: Ending) -> None:
        super().__init__(ending.kind)
        self.ending = ending


class LineNeeded(Exception):
    """Raised if the operator must type a line before an ACCEPT statement can continue."""


def no_deck(program: Program) -> Deck:
    """Return an empty deck, for a program that reads no cards.  Raise DeckError if the program has a READ statement."""
    if program.uses("READ"):
        raise DeckError(f"{program.source}: the program reads cards: a data deck is required")
    return Deck("no deck", ())


@dataclass
class Devices:
    """The devices of one machine.

    state: the state of the run, changed in place.  typed_line: a line that the operator has typed but no statement has
    read.  listed: the addresses in the list of the last input or output statement, if ``lists`` is set.  punched: the
    number of cards punched.  characters: the number of characters typed, counting the end of a line as one.  fields:
    the count of numbers read ("E<") and written ("E>") for each kind of field.  cut: for each punched card, the numbers
    written on it, as they were before the fields of the card truncated them.
    """

    program: Program
    deck: Deck
    options: Options
    state: State
    uncut: Sequence[Sequence[Uncut]]
    lists: bool = False
    listed: list[int] = field(default_factory=list)
    events: list[Event] = field(default_factory=list)
    notices: dict[Notice, None] = field(default_factory=dict)
    fields: dict[str, int] = field(default_factory=dict)
    errors: dict[tuple[str, int], int] = field(default_factory=dict)
    cut: list[tuple[Uncut, ...]] = field(default_factory=list)
    position: int = 0
    punched: int = 0
    characters: int = 0
    transfer: Input | Output | None = None
    typed_line: str | None = None
    verb: str = ""

    def __post_init__(self) -> None:
        self.layouts = [Layout(spec) for _, spec in self.program.formats]
        self._whole = {
            (card.number, column, width): value
            for card, beside in zip(self.deck.cards, self.uncut, strict=False)
            for column, width, value in beside
        }
        # The numbers of the current record, with full digits (option ``uncut``).
        self._beside: list[Uncut] = []
        # Card, column and width of each field of the deck that was read as a floating-point number.
        self.fields_read: list[tuple[int, int, int]] = []
        self._charges = [spec.charge for _, spec in self.program.formats]
        self._charge = 0
        self._first_read = -1
        self._lines = 0
        self._format = 0

    def begin(self, address: int) -> None:
        """Begin an input or output statement.  ``address`` is the index of its verb (READ, PUNCH, ...).

        Raise Ended, LineNeeded or DeckError.
        """
        here = self.program.line_at(self.state.at)
        verb = self.program.verbs[address]
        number = self.program.code[self.state.at].second
        self.verb, self._format = verb, self.program.formats[number][0]
        layout = self.layouts[number]
        self._charge = self._charges[number]
        self.listed = []
        if verb == "READ":
            # The READ that the program executes first begins each data set.  An empty hopper ends the run normally at
            # this READ, and with ``--hopper any`` at any READ.
            begins = self._first_read in (-1, self.state.at)
            if begins:
                self._first_read = self.state.at
                self.events.append(Event("begin"))
            card = self._take_card(here, begins or self.options.hopper == "any")
            self.transfer = self._input(layout, lambda: self._take_card(here, False), card, PUNCH_COLUMNS)
        elif verb == "ACCEPT":
            self.transfer = self._input(layout, self._take_line, self._take_line(), TYPEWRITER_COLUMNS)
        elif self.options.numbers.as_1962:
            room = PUNCH_COLUMNS if verb == "PUNCH" else TYPEWRITER_COLUMNS
            self.transfer = Output1962(layout, self._punch if verb == "PUNCH" else self.type, room=room)
        else:
            self.transfer = Output(layout, self._punch if verb == "PUNCH" else self.type)
        self.state.work += self._charge

    def _input(self, layout: Layout, fetch: Callable[[], Card], card: Card, room: int) -> Input:
        if self.options.numbers.as_1962:
            return Input1962(layout, fetch, card, room=room)
        return Input(layout, fetch, card)

    def item(self, address: int) -> None:
        """Read or write one number of the statement's list.

        Raise Ended, LineNeeded, DeckError, or CardError for an invalid number.
        """
        fixed = self.program.code[self.state.at].second < 0
        transfer = self.transfer
        assert transfer is not None
        try:
            if isinstance(transfer, Output):
                spec = transfer.next_field()
                self._count_item(address)
                self._write(transfer, spec, address, fixed)
            else:
                place = transfer.next_field()
                self._count_item(address)
                self._read(*place, address, fixed)
        except NoField:
            raise Ended(replace(self.ending("mode"), format=self._format)) from None
        except TooLong:
            raise self._too_long() from None

    def finish(self) -> None:
        """End an input or output statement after its last number.

        Raise Ended, LineNeeded or DeckError if the rest of the FORMAT needs another record.
        """
        assert self.transfer is not None
        try:
            self.transfer.finish()
        except TooLong:
            raise self._too_long() from None

    def _too_long(self) -> Ended:
        # After this error the library continues at a wrong position of the FORMAT. Its further output is meaningless,
        # so the run ends.
        self.error("F9")
        return Ended(replace(self.ending("record"), format=self._format))

    def _count_item(self, address: int) -> None:
        # The work is one unit for the number, the cost of each repetition of the FORMAT, and that of converting a long
        # number.
        transfer, numbers = self.transfer, self.options.numbers
        assert transfer is not None
        self.state.work += 1 + self._charge * transfer.again
        transfer.again = 0
        if numbers.is_costly and self.state.kinds[address] == FLOATING:
            self.state.work += self.state.owe(numbers.work("card", self.state.values[address]))
        if self.lists:
            self.listed.append(address)

    def _take_card(self, here: Line, begins: bool) -> Card:
        if self.position >= len(self.deck.cards):
            if begins and self.position:
                raise Ended(Ending("hopper", self.program.source, here, any_read=self.options.hopper == "any"))
            if not self.deck.cards:
                raise DeckError(
                    f"{self.deck.source}: the hopper is empty at the first READ ({self.program.source}, {here.name})"
                )
            last = self.deck.cards[-1].number
            raise DeckError(
                f"{self.deck.source}: card {last}, column 1: the deck ends in the middle of a data set; "
                f"{here.name} of {self.program.source} needs another card"
            )
        card = self.deck.cards[self.position]
        if card.text.startswith("C"):
            # A comment card of a program may hold any character, but no card of data may.
            check_characters(self.deck.source, card.number, card.text)
        self.position += 1
        self.state.last_card = self.position == len(self.deck.cards)
        self.events.append(Event("read", card.text))
        return card

    def _take_line(self) -> Card:
        line, self.typed_line = self.typed_line, None
        if line is None:
            raise LineNeeded
        self.events.append(Event("accept", line))
        self._lines += 1
        return read_line("typewriter", self._lines, line.rstrip("\r\n")[:COLUMNS], "line")

    def expected_fields(self, begins: bool) -> list[tuple[str, int, int]]:
        """Return the FORMAT code, first column and width of each field of the next line that the operator must type.

        ``begins`` is True if the statement has not read any line yet.
        """
        if begins or self.transfer is None:
            return self.layouts[self.program.code[self.state.at].second].record_fields(0)
        # The list continues on another line, either after a slash or because the FORMAT is repeated.
        layout, at = self.transfer.layout, self.transfer.at
        return layout.record_fields(at + 1 if at < len(layout.spec.specs) else layout.spec.again)

    def _check_mode(self, spec: Field, fixed: bool, address: int) -> None:
        # Fixed-point variables need I fields, floating-point variables E or F fields (C26-5619 p. 43).
        key = spec.kind + ("<" if isinstance(self.transfer, Input) else ">")
        self.fields[key] = self.fields.get(key, 0) + 1
        # The library of 1962 writes an error code for a field of the wrong mode.
        if (spec.kind == "I") != fixed and not isinstance(self.transfer, Output1962):
            ending = replace(self.ending("mode"), name=self.program.storage.name_of(address))
            mode: Mode = "fixed" if fixed else "floating"
            raise Ended(replace(ending, mode=mode, format=self._format, field=spec))

    def _write(self, transfer: Output, spec: Field, address: int, fixed: bool) -> None:
        self._check_mode(spec, fixed, address)
        value, kind = self.state.values[address], self.state.kinds[address]
        if kind == UNDEFINED or (kind == FIXED_POINT) != fixed:
            name = self.program.storage.name_of(address)
            ending = self.ending("undefined" if kind == UNDEFINED else "mode")
            raise Ended(replace(ending, name=name, put_out=True))
        fits = (spec.kind == "I") == fixed
        if fixed:
            # An I field that is too narrow prints the low-order digits, without a message.
            write = write_fixed_as_1962 if self.options.numbers.as_1962 else write_fixed
            columns, overflowed = write(spec if fits else _FIXED, value), not fits
        else:
            # An E or F field that is too narrow is replaced by E14.8 (C26-5619 p. 39-40): error code F8.
            columns, overflowed = self.options.numbers.write(spec if fits else FALLBACK, value)
            overflowed = overflowed or not fits
        if overflowed and isinstance(transfer, Output1962):
            # The library leaves the field blank and writes another record with the error code and the number.
            is_narrow = fits and spec.decimals + 6 > spec.width and spec.kind == "E"
            blank = transfer.end_before(spec.width, exponent_as_1962(spec, *value) if is_narrow else "")
            blank = blank.ljust(len(ERROR_F8) + 1)
            self._count_error("F8")
            if self.verb == "PUNCH":
                self.type(ERROR_F8)
            first = f"{ERROR_F8}{blank[len(ERROR_F8)]}{columns}"
            # A typed line ends one column after the number.
            transfer.emit(first + blank[len(first) : None if self.verb == "PUNCH" else len(first) + 1])
            return
        if fixed:
            transfer.write(columns)
            return
        self._beside.append((transfer.width + 1, len(columns), value))
        transfer.write(columns)
        if overflowed:
            self.error("F8")

    def _read(self, spec: Field, card: Card, column: int, address: int, fixed: bool) -> None:
        self._check_mode(spec, fixed, address)
        columns = card.columns(column, column + spec.width - 1).ljust(spec.width)
        typed = self.verb != "READ"
        source = "typewriter" if typed else self.deck.source
        value: Number
        remark: Remark | None = None
        try:
            if fixed:
                read = (read_fixed_as_1962 if self.options.numbers.as_1962 else read_fixed)(columns)
                value, remark = read.mantissa, read.remark
            # If another program punched this field with the option ``uncut``, its number with all digits replaces the
            # columns.
            elif not typed and (card.number, column, spec.width) in self._whole:
                value = self._whole[card.number, column, spec.width]
            else:
                value, remark = self.options.numbers.read(spec, columns)
                if not typed:
                    self.fields_read.append((card.number, column, spec.width))
        except FieldError as error:
            if self.options.numbers.as_1962:
                # The number keeps its former value.
                self.error("F7")
                return
            raise CardError(source, card.number, column, str(error), "line" if typed else "card") from None
        self.state.values[address], self.state.kinds[address] = value, FIXED_POINT if fixed else FLOATING
        if remark is not None:
            self.note(Notice("field", source, card=card.number, column=column, typed=typed, remark=remark))

    def _punch(self, line: str) -> None:
        if self.options.uncut:
            self.cut.append(tuple(self._beside))
        text = self._record(line, PUNCH_COLUMNS)
        self.punched += 1
        if self.options.numbers.as_1962:
            # The library punches a sequence number of three digits in columns 78 to 80.
            text = f"{text:77}{self.punched % 1000:03}"
        self.events.append(Event("punch", text))

    def type(self, line: str) -> None:
        """Type a line on the typewriter, and record it as an event."""
        # The typewriter stops at a record mark.
        text = self._record(RECORD_MARK.split(line)[0], TYPEWRITER_COLUMNS)
        self.characters += len(text) + 1
        # A typed line is often a message; the last decision shows why the program typed it.
        last = decided(self.program, self.state.decision)
        self.events.append(Event("type", text, self.program.line_at(self.state.at), last))

    def _record(self, line: str, room: int) -> str:
        """Return a card or line truncated to the columns of its device, and add its cost to the work of the run."""
        if len(line.rstrip()) > room:
            self.note(Notice("record", self.program.source, format=self._format, width=len(line), columns=room))
        self._beside.clear()
        self.state.work += 1
        return line[:room].rstrip()

    def error(self, code: str) -> None:
        """Count an error at the current statement, and type its code as IBM's library of 1962 does."""
        self._count_error(code)
        if self.options.numbers.as_1962:
            self.type(f"ERROR {code}")

    def _count_error(self, code: str) -> None:
        card = self.program.line_at(self.state.at).place.card
        self.errors[code, card] = self.errors.get((code, card), 0) + 1
        self.state.work += self.state.owe(ERROR)

    def note(self, notice: Notice) -> None:
        """Record a warning about the run, unless the same warning was recorded before."""
        self.notices[notice] = None

    def ending(self, kind: Kind) -> Ending:
        """Return the data of an ending of the given kind, for a run that ends at the current statement."""
        return stopped(self.program, kind, self.state.at, self.state.decision)

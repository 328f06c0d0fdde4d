"""A 1620 with its devices: card reader, punch, typewriter, four sense switches, and core storage.

A :class:`Machine` holds everything a run needs; any number of them exist side by side.  It drives the interpreter
and does what the interpreter returns for: input, output, library functions, messages, endings.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field

from emulator.errors import CardError, DeckError
from emulator.language.cards import COLUMNS, Card, Deck, read_line, refuse_strange
from emulator.language.objectcode import Line, Program, code_positions, flatten
from emulator.language.storage import FIELD, FUNCTION_NAMES, OBJECT_PROGRAM
from emulator.machine import interpreter
from emulator.machine.endings import Ending, Kind, Mode, Notice, decided, looped, out_of_bounds, stopped, unfit
from emulator.machine.forms import Input, Layout, NoField, Output
from emulator.machine.interpreter import FLOATING, Journal, State
from emulator.machine.result import (
    LOOP_WINDOW,
    PUNCH_COLUMNS,
    TYPEWRITER_COLUMNS,
    Event,
    Options,
    Result,
    Uncut,
    begun,
    machine_errors,
)
from emulator.numbers.arithmetic import FIXED_POINT, UNDEFINED
from emulator.numbers.base import Number, Numbers, Undecided
from emulator.numbers.fields import Field, FieldError, Remark, read_fixed, write_fixed

BAD_INPUT = Ending("input", trouble="bad input")


class _Ended(Exception):
    def __init__(self, ending: Ending) -> None:
        super().__init__(ending.kind)
        self.ending = ending


Tracer = Callable[[Line, "Machine"], None]


@dataclass
class Machine:
    """One machine with one program in core and one deck in the hopper.

    ``keyboard`` are the lines an operator types when the program asks by ACCEPT; ``listed`` the fields of the
    last input or output statement.  ``uncut`` holds numbers that go with the deck's cards, in their order
    (:attr:`emulator.machine.result.Result.uncut`), and are read in place of the columns.  ``journal`` is where a run
    over ``options.numbers`` is written down.  Raises DeckError when the program does not fit the machine's core.
    """

    program: Program
    deck: Deck
    options: Options = field(default_factory=Options)
    keyboard: Iterable[str] = ()
    tracer: Tracer | None = None
    journal: Journal | None = None
    uncut: Sequence[Sequence[Uncut]] = ()

    def __post_init__(self) -> None:
        program = self.program
        refuse_overlap(program, self.options.core)
        values, kinds = loaded(program, self.options.numbers)
        self.state = State(values, kinds, [0] * len(program.counters), self.options.numbers.from_integer(0))
        self._code = flatten(program)
        self._table = interpreter.subscript_table(self._code)
        self._statement_of = program.statement_numbers()
        self._switches = [int(n in self.options.switches) for n in (1, 2, 3, 4)]
        self._enters = interpreter.entered(program) if self.journal else []
        self._layouts = [Layout(spec) for _, spec in program.formats]
        self._whole = {
            (card.number, column, width): value
            for card, beside in zip(self.deck.cards, self.uncut, strict=False)
            for column, width, value in beside
        }
        self._beside: list[Uncut] = []
        self._uncut: list[tuple[Uncut, ...]] = []
        self._position = 0
        self._keys = iter(self.keyboard)
        self._first_read = -1
        self._typed_in = 0
        self._transfer: Input | Output | None = None
        self.listed: list[int] = []
        self._verb = ""
        self._format = 0
        self._punched: list[str] = []
        self._typed: list[str] = []
        self._events: list[Event] = []
        self._notices: dict[Notice, None] = {}
        self._fields: dict[str, int] = {}
        self._errors: dict[tuple[str, int], int] = {}

    def run(self) -> Result:
        """Run to an ending.

        Raises CardError for a card whose field is not a number, DeckError for a hopper empty in the middle of a
        data set or from the start.
        """
        limit = self.options.limit
        ending = self.advance(limit - min(LOOP_WINDOW, limit // 2))
        if ending is None:
            before = list(self.state.counts)
            ending = self.advance(limit)
            ending = ending or looped(self.program, limit, before, self.state.counts, self.state.decision)
        return self.result(ending)

    def advance(self, limit: int) -> Ending | None:
        """Run on until ``limit`` is done in all (:class:`emulator.machine.result.Options`); how the run ended, or None.

        Raises what :meth:`run` does.
        """
        try:
            while (reason := self._interpret(limit)) != interpreter.AT_LIMIT:
                self._serve(reason)
        except _Ended as ended:
            return ended.ending
        except Undecided as error:
            return self._ending("undecided", trouble=str(error))
        return None

    def _interpret(self, limit: int) -> int:
        return interpreter.run(
            self._code,
            self._table,
            self.state,
            self._switches,
            self.options.numbers,
            limit,
            self.options.bounds == "strict",
            self.tracer is not None,
            self.journal,
            self._enters,
        )

    def _line_at(self, pc: int) -> Line:
        return self.program.statements[self._statement_of[pc]]

    def _serve(self, reason: int) -> None:
        state, numbers = self.state, self.options.numbers
        here = self._line_at(state.at)
        address = state.address
        if reason == interpreter.AT_ITEM:
            self._item(address)
        elif reason == interpreter.AT_BEGIN:
            self._begin(address, here)
        elif reason == interpreter.AT_FINISH:
            assert self._transfer is not None
            self._transfer.finish()
        elif reason == interpreter.AT_STATEMENT:
            assert self.tracer is not None
            self.tracer(here, self)
        elif reason == interpreter.AT_FUNCTION:
            self._to_fac(*numbers.function(self.program.functions[address], state.fac))
        elif reason == interpreter.AT_POWER:
            self._to_fac(*numbers.power(state.values[address], state.fac))
        elif reason == interpreter.AT_POWERX:
            self._to_fac(*numbers.integer_power(state.fac, state.values[address]))
        elif reason == interpreter.AT_EVENT:
            self._error(f"E{state.event}")
        elif reason == interpreter.AT_PAUSE:
            self._note(Notice("pause", self.program.source, here))
        else:
            raise _Ended(self._stopped(reason, address))

    def _stopped(self, reason: int, address: int) -> Ending:
        """The ending for a reason the run does not go on from."""
        state = self.state
        if reason == interpreter.AT_STOP:
            return Ending("stop" if self.program.code[state.pc].second == 0 else "end")
        if reason == interpreter.AT_UNDEFINED:
            return unfit(self.program, state.at, state.decision, address, state.kinds[address])
        if reason == interpreter.AT_BOUNDS:
            return out_of_bounds(self.program, state.at, state.decision, address, state.index)
        if reason == interpreter.AT_OUTSIDE:
            return stopped(self.program, "outside", state.at, state.decision)
        return stopped(self.program, "select", state.at, state.decision, state.index)

    def _to_fac(self, value: Number, code: str) -> None:
        self.state.fac = value
        if code:
            self._error(code)

    def _error(self, code: str) -> None:
        card = self._line_at(self.state.at).place.card
        self._errors[code, card] = self._errors.get((code, card), 0) + 1
        if self.options.numbers.announces:
            self._type(f"ERROR {code}")

    def _begin(self, address: int, here: Line) -> None:
        verb = self.program.verbs[address]
        number = self.program.code[self.state.at].second
        self._verb, self._format = verb, self.program.formats[number][0]
        layout = self._layouts[number]
        self.listed = []
        if verb == "READ":
            begins = self._first_read in (-1, self.state.at)
            if begins:
                self._first_read = self.state.at
                self._events.append(Event("begin"))
            card = self._take_card(here, begins or self.options.hopper == "any")
            self._transfer = Input(layout, lambda: self._take_card(here, False), card)
        elif verb == "ACCEPT":
            self._transfer = Input(layout, lambda: self._take_line(here), self._take_line(here))
        else:
            self._transfer = Output(layout, self._punch if verb == "PUNCH" else self._type)

    def _take_card(self, here: Line, begins: bool) -> Card:
        if self._position >= len(self.deck.cards):
            if begins and self._position:
                raise _Ended(Ending("hopper"))
            if not self.deck.cards:
                raise DeckError(
                    f"{self.deck.source}: the hopper is empty at the first READ ({self.program.source}, {here.name})"
                )
            last = self.deck.cards[-1].number
            raise DeckError(
                f"{self.deck.source}: card {last}, column 1: the deck ends in the middle of a data set; "
                f"another card is read by {here.name} of {self.program.source}"
            )
        card = self.deck.cards[self._position]
        if card.text.startswith("C"):
            # What a comment of a source deck may hold is no data.
            refuse_strange(self.deck.source, card.number, card.text)
        self._position += 1
        self._events.append(Event("read", card.text))
        return card

    def _take_line(self, here: Line) -> Card:
        line = next(self._keys, None)
        if line is None:
            raise DeckError(f"{self.program.source}: nothing is typed for ACCEPT in {here.name}")
        self._events.append(Event("accept", line))
        self._typed_in += 1
        return read_line("typewriter", self._typed_in, line.rstrip("\r\n")[:COLUMNS], "line")

    def _item(self, address: int) -> None:
        fixed = self.program.code[self.state.at].second == 1
        transfer = self._transfer
        assert transfer is not None
        self.listed.append(address)
        self.state.work += 1
        try:
            if isinstance(transfer, Output):
                self._write(transfer, transfer.next_field(), address, fixed)
            else:
                self._read(transfer, *transfer.next_field(), address, fixed)
        except NoField:
            raise _Ended(self._ending("mode", format=self._format)) from None

    def _check_mode(self, spec: Field, fixed: bool, address: int) -> None:
        key = spec.kind + ("<" if isinstance(self._transfer, Input) else ">")
        self._fields[key] = self._fields.get(key, 0) + 1
        if (spec.kind == "I") != fixed:
            mode: Mode = "fixed" if fixed else "floating"
            name = self.program.storage.name_of(address)
            raise _Ended(self._ending("mode", name=name, mode=mode, format=self._format, field=spec))

    def _write(self, transfer: Output, spec: Field, address: int, fixed: bool) -> None:
        self._check_mode(spec, fixed, address)
        value, kind = self.state.values[address], self.state.kinds[address]
        if kind == UNDEFINED or (kind == FIXED_POINT) != fixed:
            name = self.program.storage.name_of(address)
            raise _Ended(self._ending("undefined" if kind == UNDEFINED else "mode", name=name, put_out=True))
        if fixed:
            transfer.write(write_fixed(spec, value))
            return
        columns, overflowed = self.options.numbers.write(spec, value)
        self._beside.append((len(transfer.line) + 1, len(columns), value))
        transfer.write(columns)
        if overflowed:
            self._error("F8")

    def _read(self, transfer: Input, spec: Field, card: Card, column: int, address: int, fixed: bool) -> None:
        self._check_mode(spec, fixed, address)
        columns = card.columns(column, column + spec.width - 1).ljust(spec.width)
        typed = self._verb != "READ"
        source = "typewriter" if typed else self.deck.source
        value: Number
        remark: Remark | None = None
        try:
            if fixed:
                read = read_fixed(columns)
                value, remark = read.mantissa, read.remark
            elif not typed and (card.number, column, spec.width) in self._whole:
                value = self._whole[card.number, column, spec.width]
            else:
                value, remark = self.options.numbers.read(spec, columns)
        except FieldError as error:
            raise CardError(source, card.number, column, str(error), "line" if typed else "card") from None
        self.state.values[address], self.state.kinds[address] = value, FIXED_POINT if fixed else FLOATING
        if remark is not None:
            self._note(Notice("field", source, card=card.number, column=column, typed=typed, remark=remark))

    def _punch(self, line: str) -> None:
        if self.options.uncut:
            self._uncut.append(tuple(self._beside))
        text = self._cut(line, PUNCH_COLUMNS)
        self._punched.append(text)
        self._events.append(Event("punch", text))

    def _type(self, line: str) -> None:
        text = self._cut(line, TYPEWRITER_COLUMNS)
        self._typed.append(text)
        decision = decided(self.program, self.state.decision)
        self._events.append(Event("type", text, self._line_at(self.state.at), decision))

    def _cut(self, line: str, room: int) -> str:
        """A record as its device has it; it counts as work."""
        if len(line.rstrip()) > room:
            self._note(Notice("record", self.program.source, format=self._format, width=len(line), kept=room))
        self._beside.clear()
        self.state.work += 1
        return line[:room].rstrip()

    def _note(self, notice: Notice) -> None:
        self._notices[notice] = None

    def _ending(
        self,
        kind: Kind,
        *,
        name: str = "",
        mode: Mode | None = None,
        format: int = 0,
        field: Field | None = None,
        put_out: bool = False,
        trouble: str = "",
    ) -> Ending:
        """An ending at the present statement."""
        return Ending(
            kind,
            self.program.source,
            self._line_at(self.state.at),
            decided(self.program, self.state.decision),
            name=name,
            mode=mode,
            format=format,
            field=field,
            put_out=put_out,
            trouble=trouble,
        )

    def result(self, ending: Ending = BAD_INPUT) -> Result:
        """What the devices have so far; of use after :meth:`run` raised an error for a bad card."""
        return Result(
            punched=tuple(self._punched),
            typed=tuple(self._typed),
            ending=ending,
            events=tuple(self._events),
            notices=tuple(self._notices),
            statements=begun(self.program, self.state.counts),
            counts=tuple(self.state.counts),
            cards_read=self._position,
            numbers=tuple(sorted(self._fields.items())),
            errors=machine_errors(self._errors),
            uncut=tuple(self._uncut),
        )


def refuse_overlap(program: Program, core: int) -> None:
    """Raise DeckError when a program and its data do not fit a machine of ``core`` positions."""
    need = program.storage.fields * FIELD + code_positions(program)
    room = core - OBJECT_PROGRAM - FUNCTION_NAMES
    if need > room:
        raise DeckError(
            f"{program.source}: OVERLAP: program and data need about {need} positions; "
            f"a machine of {core} has {room} for them"
        )


def loaded(program: Program, numbers: Numbers) -> tuple[list[Number], list[int]]:
    """Core as a program finds it: values and kinds of the fields, all but the constants undefined."""
    values: list[Number] = [0] * program.storage.fields
    kinds = [UNDEFINED] * program.storage.fields
    for address, text in program.storage.constants:
        if "." in text:
            values[address], kinds[address] = numbers.constant(text), FLOATING
        else:
            values[address], kinds[address] = int(text), FIXED_POINT
    return values, kinds

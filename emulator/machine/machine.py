"""A 1620 with its devices: card reader, punch, typewriter, four sense switches, and core storage.

A :class:`Machine` holds everything a run needs; any number of them exist side by side.  It drives the engine
and does what the engine returns for: input, output, library functions, messages, endings.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

from emulator.compiled import kernel as engine
from emulator.errors import CardError, DeckError
from emulator.language.cards import COLUMNS, Card, Deck, read_line
from emulator.language.formats import Field
from emulator.language.length import code_positions
from emulator.language.loader import flatten
from emulator.language.objectcode import Line, Program
from emulator.language.storage import FIELD, FUNCTION_NAMES, OBJECT_PROGRAM
from emulator.machine import interpreter as hosted
from emulator.machine.endings import begun, error_counts, looped, pausing, stopped, undecided
from emulator.machine.forms import Input, Layout, NoField, Output
from emulator.machine.result import (
    LOOP_WINDOW,
    PUNCH_COLUMNS,
    TYPEWRITER_COLUMNS,
    Ending,
    Event,
    Options,
    Result,
    Uncut,
)
from emulator.machine.unit import DecimalUnit, HostedUnit, Stored, Unit
from emulator.numbers.arithmetic import FIXED_POINT, UNDEFINED, ZERO, powers_of_ten
from emulator.numbers.base import Undecided
from emulator.numbers.fields import FieldError, read_fixed, write_fixed

BAD_INPUT = Ending("input", "bad input")


class _Ended(Exception):
    def __init__(self, kind: str, message: str = "") -> None:
        super().__init__(message)
        self.ending = Ending(kind, message)


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
    journal: hosted.Journal | None = None
    uncut: Sequence[Sequence[Uncut]] = ()

    def __post_init__(self) -> None:
        program, rules, numbers = self.program, self.options.profile.rules, self.options.numbers
        need = program.storage.fields * FIELD + code_positions(program)
        room = self.options.core - OBJECT_PROGRAM - FUNCTION_NAMES
        if need > room:
            raise DeckError(
                f"{program.source}: OVERLAP: program and data need about {need} positions; "
                f"a machine of {self.options.core} has {room} for them"
            )
        self.unit: Unit = DecimalUnit(rules) if numbers is None else HostedUnit(numbers)
        self.mantissas: list[Any] = [0] * program.storage.fields
        self.exponents = [UNDEFINED] * program.storage.fields
        for address, text in program.storage.constants:
            if "." in text:
                self.mantissas[address], self.exponents[address] = self.unit.constant(text)
            else:
                self.mantissas[address], self.exponents[address] = int(text), FIXED_POINT
        self.registers: list[Any] = [0] * engine.REGISTERS
        self.registers[engine.CHARACTERISTIC] = ZERO
        self.counts = [0] * len(program.counters)
        self._code = flatten(program)
        self._statement_of = program.statement_numbers()
        self._powers = powers_of_ten(rules)
        self._enters = hosted.entered(program) if self.journal else []
        self._layouts = [Layout(spec) for _, spec in program.formats]
        self._whole = {
            (card.number, column, width): stored
            for card, beside in zip(self.deck.cards, self.uncut, strict=False)
            for column, width, stored in beside
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
        self._warnings: dict[str, None] = {}
        self._numbers: dict[str, int] = {}
        self._errors: dict[tuple[str, int], int] = {}

    def run(self) -> Result:
        """Run to an ending.

        Raises CardError for a card whose field is no number, DeckError for a hopper empty in the middle of a
        data set or from the start.
        """
        window = min(LOOP_WINDOW, self.options.limit // 2)
        ending = self.advance(self.options.limit - window)
        if ending is None:
            before = list(self.counts)
            ending = self.advance(self.options.limit)
            ending = ending or looped(self.program, self.options.limit, before, self.counts)
        return self.result(ending)

    def advance(self, limit: int) -> Ending | None:
        """Run on until ``limit`` statements are done in all; how the run ended, or None where it did not.

        Raises what :meth:`run` does.
        """
        try:
            while (reason := self._engine(limit)) != engine.AT_LIMIT:
                self._serve(reason)
        except _Ended as ended:
            return ended.ending
        except Undecided as error:
            return undecided(self.program, self.registers[engine.AT], str(error))
        return None

    def _engine(self, limit: int) -> int:
        operations, addresses, subscripts, seconds, table, targets, loops, begins = self._code
        profile = self.options.profile
        switches = [int(n in self.options.switches) for n in (1, 2, 3, 4)]
        strict = int(self.options.bounds == "strict")
        if self.options.numbers is not None:
            return hosted.run(
                self._code,
                self.mantissas,
                self.exponents,
                self.counts,
                self.registers,
                switches,
                self.options.numbers,
                (limit, strict, int(self.tracer is not None)),
                self.journal,
                self._enters,
            )
        flags = (limit, strict, int(self.tracer is not None))
        return engine.run(
            operations,
            addresses,
            subscripts,
            seconds,
            table,
            targets,
            loops,
            begins,
            self.mantissas,
            self.exponents,
            self.counts,
            self.registers,
            switches,
            profile.rules,
            self._powers,
            flags,
        )

    def _line_at(self, pc: int) -> Line:
        return self.program.statements[self._statement_of[pc]]

    def _serve(self, reason: int) -> None:
        registers = self.registers
        here = self._line_at(registers[engine.AT])
        address = registers[engine.ADDRESS]
        if reason == engine.AT_ITEM:
            self._item(address, here)
        elif reason == engine.AT_BEGIN:
            self._begin(address, here)
        elif reason == engine.AT_FINISH:
            assert self._transfer is not None
            self._transfer.finish()
        elif reason == engine.AT_STATEMENT:
            assert self.tracer is not None
            self.tracer(here, self)
        elif reason == engine.AT_FUNCTION:
            self._to_fac(*self.unit.function(self.program.functions[address], self._fac()))
        elif reason == engine.AT_POWER:
            self._to_fac(*self.unit.power((self.mantissas[address], self.exponents[address]), self._fac()))
        elif reason == engine.AT_POWERX:
            self._to_fac(*self.unit.integer_power(self._fac(), self.mantissas[address]))
        elif reason == engine.AT_EVENT:
            self._error(f"E{registers[engine.EVENT]}")
        elif reason == engine.AT_PAUSE:
            self._warn(pausing(self.program, self._statement_of[registers[engine.AT]]))
        else:
            held = self.exponents[address] if reason == engine.AT_UNDEFINED else ZERO
            ending = stopped(self.program, reason, registers, held)
            raise _Ended(ending.kind, ending.message)

    def _fac(self) -> Stored:
        return self.registers[engine.FAC], self.registers[engine.CHARACTERISTIC]

    def _to_fac(self, value: Stored, code: str) -> None:
        self.registers[engine.FAC], self.registers[engine.CHARACTERISTIC] = value
        if code:
            self._error(code)

    def _error(self, code: str) -> None:
        card = self._line_at(self.registers[engine.AT]).place.card
        self._errors[code, card] = self._errors.get((code, card), 0) + 1
        if self.options.profile.announces:
            self._type(f"ERROR {code}")

    def _begin(self, address: int, here: Line) -> None:
        verb = self.program.verbs[address]
        number = self.program.code[self.registers[engine.AT]].second
        self._verb, self._format = verb, self.program.formats[number][0]
        layout = self._layouts[number]
        self.listed = []
        if verb == "READ":
            begins = self._first_read in (-1, self.registers[engine.AT])
            if begins:
                self._first_read = self.registers[engine.AT]
                self._events.append(Event("begin"))
            card = self._take_card(here, begins)
            self._transfer = Input(layout, lambda: self._take_card(here, False), card)
        elif verb == "ACCEPT":
            self._transfer = Input(layout, lambda: self._take_line(here), self._take_line(here))
        else:
            self._transfer = Output(layout, self._punch if verb == "PUNCH" else self._type)

    def _take_card(self, here: Line, begins: bool) -> Card:
        if self._position >= len(self.deck.cards):
            if begins and self._position:
                raise _Ended("hopper")
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

    def _item(self, address: int, here: Line) -> None:
        fixed = self.program.code[self.registers[engine.AT]].second == 1
        transfer = self._transfer
        assert transfer is not None
        self.listed.append(address)
        self.registers[engine.STATEMENTS] += 1
        try:
            if isinstance(transfer, Output):
                self._write(transfer, transfer.next_field(), address, fixed, here)
            else:
                self._read(transfer, *transfer.next_field(), address, fixed, here)
        except NoField:
            raise _Ended(
                "mode",
                f"{self.program.source}: card {here.place.card}: FORMAT {self._format} has no field for the list",
            ) from None

    def _check_mode(self, spec: Field, fixed: bool, address: int, here: Line) -> None:
        key = spec.kind + ("<" if isinstance(self._transfer, Input) else ">")
        self._numbers[key] = self._numbers.get(key, 0) + 1
        if (spec.kind == "I") != fixed:
            mode = "fixed" if fixed else "floating"
            raise _Ended(
                "mode",
                f"{self.program.source}: card {here.place.card}: {self.program.storage.name_of(address)} "
                f"is {mode} point, its field in FORMAT {self._format} is {spec}",
            )

    def _write(self, transfer: Output, spec: Field, address: int, fixed: bool, here: Line) -> None:
        self._check_mode(spec, fixed, address, here)
        mantissa, exponent = self.mantissas[address], self.exponents[address]
        if exponent == UNDEFINED:
            name = self.program.storage.name_of(address)
            raise _Ended(
                "undefined",
                f"{self.program.source}: card {here.place.card}: {name} is undefined where it is put out, "
                f"in {here.text}",
            )
        if (exponent == FIXED_POINT) != fixed:
            name = self.program.storage.name_of(address)
            raise _Ended(
                "mode", f"{self.program.source}: card {here.place.card}: {name} holds a number of the other mode"
            )
        if fixed:
            transfer.write(write_fixed(spec, mantissa))
            return
        columns, overflowed = self.unit.write(spec, (mantissa, exponent))
        self._beside.append((len(transfer.line) + 1, len(columns), (mantissa, exponent)))
        transfer.write(columns)
        if overflowed:
            self._error("F8")

    def _read(
        self, transfer: Input, spec: Field, card: Card, column: int, address: int, fixed: bool, here: Line
    ) -> None:
        self._check_mode(spec, fixed, address, here)
        columns = card.columns(column, column + spec.width - 1).ljust(spec.width)
        source, unit = (self.deck.source, "card") if self._verb == "READ" else ("typewriter", "line")
        try:
            if fixed:
                read = read_fixed(columns)
                stored, warning = (read.mantissa, FIXED_POINT), read.warning
            elif self._verb == "READ" and (card.number, column, spec.width) in self._whole:
                stored, warning = self._whole[card.number, column, spec.width], ""
            else:
                stored, warning = self.unit.read(spec, columns)
        except FieldError as error:
            raise CardError(source, card.number, column, str(error), unit) from None
        self.mantissas[address], self.exponents[address] = stored
        if warning:
            self._warn(f"{source}: {unit} {card.number}, column {column}: {warning}")

    def _punch(self, line: str) -> None:
        if self.options.uncut:
            self._uncut.append(tuple(self._beside))
        self._out("punch", self._punched, line, PUNCH_COLUMNS)

    def _type(self, line: str) -> None:
        self._out("type", self._typed, line, TYPEWRITER_COLUMNS)

    def _out(self, what: str, lines: list[str], line: str, columns: int) -> None:
        if len(line.rstrip()) > columns:
            self._warn(
                f"{self.program.source}: FORMAT {self._format}: a record of {len(line)} characters, cut at {columns}"
            )
        text = line[:columns].rstrip()
        lines.append(text)
        self._beside.clear()
        self.registers[engine.STATEMENTS] += 1
        self._events.append(Event(what, text))

    def _warn(self, message: str) -> None:
        self._warnings[message] = None

    def result(self, ending: Ending = BAD_INPUT) -> Result:
        """What the devices have so far; of use after :meth:`run` raised an error for a bad card."""
        return Result(
            punched=tuple(self._punched),
            typed=tuple(self._typed),
            ending=ending,
            events=tuple(self._events),
            warnings=tuple(self._warnings),
            statements=begun(self.program, self.counts),
            counts=tuple(self.counts),
            cards_read=self._position,
            numbers=tuple(sorted(self._numbers.items())),
            errors=error_counts(self._errors),
            uncut=tuple(self._uncut),
        )

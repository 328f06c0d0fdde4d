"""A run in slices: it goes on as far as it is told, and says as plain data why it stands.

A :class:`Session` holds everything a run needs and drives the interpreter and the devices.  Nothing here waits, or
touches a terminal, a file or a thread: whoever drives a session calls :meth:`Session.advance`, takes the events, and
answers a :class:`Halt` with an :class:`Action`, when it likes and from where it likes.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from copy import copy
from dataclasses import dataclass, field, fields, replace
from typing import Literal

from emulator.errors import CardError, DeckError
from emulator.language.cards import Deck
from emulator.language.objectcode import Line, Program, code_positions, flatten
from emulator.language.storage import CORES, FIELD, FUNCTION_NAMES, OBJECT_PROGRAM
from emulator.machine import interpreter
from emulator.machine.devices import Devices, Ended, Wanted
from emulator.machine.endings import Ending, Notice, looped, out_of_bounds, stopped, too_costly, unfit
from emulator.machine.result import LOOP_WINDOW, Event, Options, Result, Uncut, begun, machine_errors
from emulator.machine.state import FLOATING, Journal, State, entered, subscript_table
from emulator.numbers.arithmetic import FIXED_POINT, UNDEFINED
from emulator.numbers.base import Number, Numbers, Undecided

BAD_INPUT = Ending("input", trouble="bad input")


@dataclass(frozen=True, slots=True)
class Halt:
    """The machine stands and waits for its operator.

    - accept: ``line`` wants a line typed; ``trouble`` is what was wrong with the one before, which has no effect.
    - pause: ``line`` is a PAUSE, with ``number``.
    - stop: ``line`` has not been done; ``why`` it stands there.
    """

    what: Literal["accept", "pause", "stop"]
    line: Line
    number: int = 0
    why: Literal["", "attention", "step", "breakpoint"] = ""
    trouble: str = ""


@dataclass(frozen=True, slots=True)
class Action:
    """What an operator does.

    - ENTER: types ``text`` for ACCEPT.
    - START: lets the machine go on; ``unasked`` where it is pressed because nobody is there, which a PAUSE has noted.
    - STEP: lets it do ``number`` statements.
    - STOP: ends the run; what was done is kept.
    - ATTN: has a running machine stand before the next statement; a second time, where it is, in a list.
    - SWITCH: sets sense switch ``number`` as ``on`` says.
    - BREAK, CLEAR: sets or takes away a breakpoint at statement ``number``, or at what begins on that ``card``.
    """

    word: Literal["ENTER", "START", "STEP", "STOP", "ATTN", "SWITCH", "BREAK", "CLEAR"]
    number: int = 0
    text: str = ""
    on: bool = False
    card: bool = False
    unasked: bool = False


Tracer = Callable[[Line, "Session"], None]


@dataclass
class Session:
    """One machine with one program in core and one deck in the hopper.

    ``uncut`` holds numbers that go with the deck's cards, in their order
    (:attr:`emulator.machine.result.Result.uncut`), and are read in place of the columns.  ``journal`` is where a run
    over ``options.numbers`` is written down.  ``keep``: events stay for the result after they were taken.
    ``last`` is the statement done last, where one after the other was watched.  ``retypes``: a bad line typed is asked
    for again; else it is an error.  ``by_lines``: the session comes back after every line it types.  Raises DeckError
    when the program does not fit the machine's core.
    """

    program: Program
    deck: Deck
    options: Options = field(default_factory=Options)
    tracer: Tracer | None = field(default=None, kw_only=True)
    journal: Journal | None = field(default=None, kw_only=True)
    uncut: Sequence[Sequence[Uncut]] = field(default=(), kw_only=True)
    keep: bool = field(default=True, kw_only=True)
    retypes: bool = field(default=False, kw_only=True)
    by_lines: bool = field(default=False, kw_only=True)

    def __post_init__(self) -> None:
        program = self.program
        refuse_overlap(program, self.options.core)
        values, kinds = loaded(program, self.options.numbers)
        self.state = State(values, kinds, [0] * len(program.counters), self.options.numbers.from_integer(0))
        self.devices = Devices(program, self.deck, self.options, self.state, self.uncut)
        self.switches = [int(n in self.options.switches) for n in (1, 2, 3, 4)]
        self.breakpoints: dict[int, Action] = {}
        self.halt: Halt | None = None
        self.last: Line | None = None
        self._begun: Line | None = None
        self._code = flatten(program)
        self._table = subscript_table(self._code)
        self._enters = entered(program) if self.journal else []
        self._ending: Ending | None = None
        self._before: list[int] | None = None
        self._taken = 0
        self._steps = 0
        self._called = self._came_back = False
        self._again = interpreter.AT_LIMIT
        self._checkpoint: _Checkpoint | None = None

    @property
    def listed(self) -> list[int]:
        """The fields of the last input or output statement, where a tracer watches."""
        return self.devices.listed

    @property
    def here(self) -> Line:
        """The statement the machine stands at or before."""
        return self.halt.line if self.halt else self.devices.line_at(min(self.state.pc, len(self.program.code) - 1))

    def advance(self, goal: int) -> Halt | Ending | None:
        """Run on until ``goal`` is done in all, or the limit (:class:`emulator.machine.result.Options`).

        Returns why the machine stands, how the run ended, or None where it can go on.  Raises CardError for a card
        whose field is not a number, DeckError for a hopper empty in the middle of a data set or from the start.
        """
        limit = self.options.limit
        window = limit - min(LOOP_WINDOW, limit // 2)
        if self._before is None:
            found = self._advance(min(goal, window))
            if found is not None or goal < window or self._came_back:
                return found
            self._before = list(self.state.counts)
        found = self._advance(min(goal, limit))
        if found is None and goal >= limit and not self._came_back:
            state = self.state
            self._ending = looped(self.program, limit, self._before, state.counts, state.decision, state.costly)
        return found or self._ending

    def take(self) -> list[Event]:
        """What the devices did since events were last taken, in order."""
        events = self.devices.events
        if self.keep:
            first, self._taken = self._taken, len(events)
            return events[first:]
        self.devices.events = []
        return events

    def act(self, action: Action) -> None:
        """Do what the operator does; what does not fit the moment has no effect."""
        match action.word:
            case "ENTER":
                if self.halt and self.halt.what == "accept":
                    self.devices.typed_line, self.halt = action.text, None
            case "STEP" | "START":
                self._steps, self._called = action.number, False
                if action.unasked and self.halt and self.halt.what == "pause":
                    self.devices.note(Notice("pause", self.program.source, self.halt.line))
                if self.halt and self.halt.what != "accept":
                    self.halt = None
            case "ATTN" if self._called and self._steps and not self.halt:
                # No statement has begun since: an endless list.
                self.halt = Halt("stop", self.here, why="attention")
            case "ATTN":
                self._steps, self._called = 1, True
            case "SWITCH":
                self.switches[action.number - 1] = int(action.on)
            case "BREAK":
                self.breakpoints.update((index, action) for index in self.places(action))
            case "CLEAR":
                for index in self.places(action) if action.number else list(self.breakpoints):
                    self.breakpoints.pop(index, None)
            case "STOP":
                self._ending = Ending("operator", self.program.source, self.here, trouble="stopped by the operator")

    def places(self, action: Action) -> list[int]:
        """Where a BREAK or CLEAR is: indices into :attr:`emulator.language.objectcode.Program.statements`."""
        return [
            line.index
            for line in self.program.statements
            if (line.place.card if action.card else line.label) == action.number
        ]

    def result(self, ending: Ending = BAD_INPUT) -> Result:
        """What the devices have so far; of use after :meth:`advance` raised an error for a bad card."""
        devices, counts = self.devices, self.state.counts
        events = tuple(devices.events)
        return Result(
            punched=tuple(event.text for event in events if event.what == "punch"),
            typed=tuple(event.text for event in events if event.what == "type"),
            ending=ending,
            events=events,
            notices=tuple(devices.notices),
            statements=begun(self.program, counts),
            counts=tuple(counts),
            cards_read=devices.position,
            cards_punched=devices.punched,
            characters_typed=devices.characters,
            numbers=tuple(sorted(devices.fields.items())),
            errors=machine_errors(devices.errors),
            uncut=tuple(devices.cut),
        )

    def _advance(self, goal: int) -> Halt | Ending | None:
        """As :meth:`advance`, at a goal that is not beyond the limit."""
        if self._ending or self.halt:
            return self._ending or self.halt
        reason, self._came_back = self._again, False
        watched = self.tracer is not None or self._steps > 0
        self.devices.lists = watched
        if not watched:
            self.last = self._begun = None
        try:
            while True:
                if reason != interpreter.AT_LIMIT:
                    self._again, typed = reason, self.devices.characters
                    self._serve(reason)
                    self._again = interpreter.AT_LIMIT
                    if self.halt:
                        return self.halt
                    self._came_back = self.by_lines and self.devices.characters != typed
                    if self._came_back:
                        return None
                reason = self._interpret(goal)
                if reason == interpreter.AT_LIMIT:
                    return None
        except Wanted:
            self._want("")
        except CardError as error:
            if self._checkpoint is None or self.devices.verb != "ACCEPT":
                raise
            self._checkpoint.restore(self)
            self._want(str(error))
        except Ended as ended:
            self._ending = ended.ending
        except Undecided as error:
            self._ending = self.devices.ending("undecided", trouble=str(error))
        return self._ending or self.halt

    def _want(self, trouble: str) -> None:
        """A line is to be typed; the statement goes on from here once more, whatever comes of the line."""
        self._checkpoint = _Checkpoint(self) if self.retypes else None
        self.halt = Halt("accept", self.devices.line_at(self.state.at), trouble=trouble)

    def _interpret(self, goal: int) -> int:
        return interpreter.run(
            self._code,
            self._table,
            self.state,
            self.switches,
            self.options.numbers,
            goal,
            self.options.limit,
            self.options.bounds == "strict",
            self.tracer is not None or self._steps > 0 or bool(self.breakpoints),
            self.journal,
            self._enters,
        )

    def _serve(self, reason: int) -> None:
        state, numbers = self.state, self.options.numbers
        address = state.address
        if reason == interpreter.AT_ITEM:
            self.devices.item(address)
        elif reason == interpreter.AT_BEGIN:
            self.devices.begin(address)
        elif reason == interpreter.AT_FINISH:
            self.devices.finish()
        elif reason == interpreter.AT_STATEMENT:
            self._watch(self.devices.line_at(state.at))
        elif reason == interpreter.AT_FUNCTION:
            name = self.program.functions[address]
            self._pay(name, state.fac)
            self._to_fac(*numbers.function(name, state.fac))
        elif reason == interpreter.AT_POWER:
            self._pay("power", state.values[address], state.fac)
            self._to_fac(*numbers.power(state.values[address], state.fac))
        elif reason == interpreter.AT_POWERX:
            self._pay("integer_power", state.fac, state.values[address])
            self._to_fac(*numbers.integer_power(state.fac, state.values[address]))
        elif reason == interpreter.AT_EVENT:
            self.devices.error(f"E{state.event}")
        elif reason == interpreter.AT_PAUSE:
            self.halt = Halt("pause", self.devices.line_at(state.at), self.program.code[state.at].second)
        else:
            raise Ended(self._stopped(reason, address))

    def _watch(self, line: Line) -> None:
        """A statement begins that a tracer, single steps or breakpoints wait for."""
        self.last, self._begun = self._begun, line
        if self.tracer is not None:
            self.tracer(line, self)
        stepped = self._steps == 1
        self._steps -= self._steps > 0
        if stepped:
            self.halt = Halt("stop", line, why="attention" if self._called else "step")
        elif line.index in self.breakpoints:
            self.halt = Halt("stop", line, why="breakpoint")

    def _stopped(self, reason: int, address: int) -> Ending:
        """The ending for a reason the run does not go on from."""
        state = self.state
        if reason == interpreter.AT_STOP:
            return Ending("stop" if self.program.code[state.pc].second == 0 else "end")
        if reason == interpreter.AT_COSTLY:
            return too_costly(self.program, self.options.limit, state.at, state.decision, state.costly)
        if reason == interpreter.AT_UNDEFINED:
            return unfit(self.program, state.at, state.decision, address, state.kinds[address])
        if reason == interpreter.AT_BOUNDS:
            return out_of_bounds(self.program, state.at, state.decision, address, state.index)
        if reason == interpreter.AT_OUTSIDE:
            return stopped(self.program, "outside", state.at, state.decision)
        return stopped(self.program, "select", state.at, state.decision, state.index)

    def _pay(self, operation: str, first: Number, second: Number = 0) -> None:
        """Count what an operation costs, before it is done.  Raises Ended where that is far beyond the limit."""
        state = self.state
        state.work += state.owe(self.options.numbers.work(operation, first, second))
        if state.work > self.options.limit + interpreter.SLACK:
            raise Ended(self._stopped(interpreter.AT_COSTLY, state.address))

    def _to_fac(self, value: Number, code: str) -> None:
        self.state.fac = value
        if code:
            self.devices.error(code)


class _Checkpoint:
    """A session as it was when a line was wanted, so that a bad line can be forgotten."""

    def __init__(self, session: Session) -> None:
        devices = session.devices
        state, transfer = session.state, devices.transfer
        self._again = session._again
        self._state = replace(state, values=list(state.values), kinds=list(state.kinds), counts=list(state.counts))
        self._transfer = copy(transfer)
        self._literals = [list(layout.literals) for layout in devices.layouts]
        self._listed, self._fields, self._notices = list(devices.listed), dict(devices.fields), dict(devices.notices)

    def restore(self, session: Session) -> None:
        """Bring the session back; what the devices did stays done."""
        devices = session.devices
        session._again = self._again
        for part in fields(State):
            value = getattr(self._state, part.name)
            if isinstance(value, list):
                getattr(session.state, part.name)[:] = value
            else:
                setattr(session.state, part.name, value)
        devices.transfer = copy(self._transfer)
        for layout, literals in zip(devices.layouts, self._literals, strict=True):
            layout.literals[:] = literals
        devices.listed[:], devices.fields, devices.notices = self._listed, dict(self._fields), dict(self._notices)


def refuse_overlap(program: Program, core: int) -> None:
    """Raise DeckError when a program and its data do not fit a machine of ``core`` positions."""
    words = overlap(program, core)
    if words:
        raise DeckError(f"{program.source}: {words}")


def overlap(program: Program, core: int) -> str:
    """What a program and its data lack of a machine of ``core`` positions, and what has it; empty where they fit."""
    need = program.storage.fields * FIELD + code_positions(program)
    room = core - OBJECT_PROGRAM - FUNCTION_NAMES
    if need <= room:
        return ""
    words = f"OVERLAP: program and data need about {need} positions; a machine of {core} has {room} for them"
    return words + _larger(need)


def _larger(need: int) -> str:
    core = next((core for core in CORES if core - OBJECT_PROGRAM - FUNCTION_NAMES >= need), 0)
    return f"; --core {core} has room" if core else ""


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

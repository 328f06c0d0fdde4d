"""A run of a program that can be stopped and continued at any time, for example by a debugger or a web page.

A :class:`Session` drives the interpreter and the devices.  It never waits and uses no terminal, file or thread.  The
caller repeats three steps: it calls :meth:`Session.advance`, takes the events with :meth:`Session.take`, and answers a
:class:`Halt` with an :class:`Action`.
"""

from collections.abc import Callable, Sequence
from copy import copy
from dataclasses import dataclass, field, fields, replace
from typing import Literal

from emulator.errors import CardError
from emulator.language.cards import Deck
from emulator.language.objectcode import Line, Program
from emulator.machine import interpreter
from emulator.machine.devices import Devices, Ended, LineNeeded
from emulator.machine.endings import Ending, Notice, ended_by, looped
from emulator.machine.result import LOOP_WINDOW, Event, Options, Result, Uncut, machine_errors, statements_begun
from emulator.machine.state import Journal, State, loaded, recorded_instructions, refuse_overlap, subscript_table
from emulator.numbers.arithmetic import UNDEFINED
from emulator.numbers.base import Number, Undecided

BAD_INPUT = Ending("input", trouble="bad input")


@dataclass(frozen=True, slots=True)
class Halt:
    """A machine that has stopped and waits for its operator.

    - accept: the ACCEPT statement ``line`` needs a typed line.  ``trouble`` says why the previous line was rejected.
    - pause: ``line`` is a PAUSE with ``number``.
    - stop: the machine has stopped before ``line`` for the reason ``why``: ``attention``, ``step``, ``breakpoint``, or
      the change of a variable, such as ``NE has changed``.
    """

    what: Literal["accept", "pause", "stop"]
    line: Line
    number: int = 0
    why: str = ""
    trouble: str = ""


@dataclass(frozen=True, slots=True)
class Action:
    """An action of the operator.

    - ENTER: type ``text`` for ACCEPT.
    - START: continue.  If ``unasked`` is True, START was pressed automatically.  At a PAUSE, a notice then reports
      this.
    - STEP: execute ``number`` statements.
    - STOP: end the run and keep its results.
    - ATTN: stop a running machine before its next statement.  A second ATTN stops it at once, even within a list of an
      input or output statement.
    - SWITCH: turn sense switch ``number`` on if ``on`` is True, otherwise off.
    - BREAK, CLEAR: set or remove a breakpoint.  The breakpoint is at statement ``number``, at the statements on card
      ``number`` if ``card`` is True, or at the first statement after the variable or element ``name`` has changed.
    """

    word: Literal["ENTER", "START", "STEP", "STOP", "ATTN", "SWITCH", "BREAK", "CLEAR"]
    number: int = 0
    text: str = ""
    on: bool = False
    card: bool = False
    name: str = ""
    unasked: bool = False


Tracer = Callable[[Line, "Session"], None]


@dataclass
class Session:
    """A machine with a program in core storage and a deck in the card reader's hopper.

    tracer: a function that is called when a statement begins.  journal: the record of decisions and stores, if the run
    is compared with another.  uncut: for each card of the deck, the numbers to read instead of its columns
    (:attr:`emulator.machine.result.Result.uncut`).  keep: True to keep events for the result after :meth:`take` has
    returned them.  retypes: True to ask again for a typed line that cannot be read, instead of raising an error.
    by_lines: True to return from :meth:`advance` after every typed line.

    ``last`` is the last statement executed, if statements are traced or stepped.  Raise DeckError if the program does
    not fit the machine's core storage.
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
        self.options = replace(self.options, numbers=self.options.numbers.fresh())
        refuse_overlap(program, self.options.core)
        values, kinds = loaded(program, self.options.numbers)
        self.state = State(values, kinds, [0] * len(program.counters), self.options.numbers.from_integer(0))
        self.devices = Devices(program, self.deck, self.options, self.state, self.uncut)
        self.switches = [int(n in self.options.switches) for n in (1, 2, 3, 4)]
        self.breakpoints: dict[int, Action] = {}
        # The variables whose changes halt the machine, each with its contents at the last statement.
        self.watched: dict[str, list[tuple[Number, int]]] = {}
        self.halt: Halt | None = None
        self.last: Line | None = None
        self._begun: Line | None = None
        self._code = program.flat
        self._table = subscript_table(self._code)
        self._enters = recorded_instructions(program) if self.journal and self.journal.stores else []
        self._ending: Ending | None = None
        self._before: list[int] | None = None
        self._taken = 0
        self._steps = 0
        self._attention = self._line_was_typed = False
        self._pending = interpreter.AT_LIMIT
        self._checkpoint: _Checkpoint | None = None

    @property
    def here(self) -> Line:
        """The statement at which, or before which, the machine has stopped."""
        return self.halt.line if self.halt else self.program.line_at(self.state.pc)

    def advance(self, goal: int) -> Halt | Ending | None:
        """Run until the work done reaches ``goal`` or the limit (:class:`emulator.machine.result.Options`).

        Return the halt or the ending, or None if the run can continue.  Raise CardError if a field of a card does not
        hold a number, and DeckError if the hopper is empty at the first READ or in the middle of a data set.
        """
        limit = self.options.limit
        # The counts are saved shortly before the limit.  The loop consists of the statements whose counts then grow.
        window = limit - min(LOOP_WINDOW, limit // 2)
        if self._before is None:
            outcome = self._advance(min(goal, window))
            if outcome is not None or goal < window or self._line_was_typed:
                return outcome
            self._before = list(self.state.counts)
        outcome = self._advance(min(goal, limit))
        if outcome is None and goal >= limit and not self._line_was_typed:
            state = self.state
            self._ending = looped(self.program, limit, self._before, state.counts, state.decision, state.costly)
        return outcome or self._ending

    def take(self) -> list[Event]:
        """Return the events (cards read or punched, lines typed) since the last call of this method, in order."""
        events = self.devices.events
        if self.keep:
            first, self._taken = self._taken, len(events)
            return events[first:]
        self.devices.events = []
        return events

    def act(self, action: Action) -> None:
        """Perform an action of the operator.  An action that does not fit the state of the machine has no effect."""
        match action.word:
            case "ENTER":
                if self.halt and self.halt.what == "accept":
                    self.devices.typed_line, self.halt = action.text, None
            case "STEP" | "START":
                # ``_steps`` counts the statements before the next halt; 0 means that the machine runs freely.
                self._steps, self._attention = action.number, False
                if action.unasked and self.halt and self.halt.what == "pause":
                    self.devices.note(Notice("pause", self.program.source, self.halt.line))
                if self.halt and self.halt.what != "accept":
                    self.halt = None
            case "ATTN" if self._attention and self._steps and not self.halt:
                # No statement has begun since the first ATTN: the machine is in an endless list.
                self.halt = Halt("stop", self.here, why="attention")
            case "ATTN":
                # Stop before the next statement, as after a single step.
                self._steps, self._attention = 1, True
            case "SWITCH":
                self.switches[action.number - 1] = int(action.on)
            case "BREAK" if action.name:
                self.watched[action.name] = self.held(action.name)
            case "CLEAR" if action.name:
                self.watched.pop(action.name, None)
            case "BREAK":
                self.breakpoints.update((index, action) for index in self.places(action))
            case "CLEAR":
                for index in self.places(action) if action.number else list(self.breakpoints):
                    self.breakpoints.pop(index, None)
                if not action.number:
                    self.watched.clear()
            case "STOP":
                self._ending = Ending("operator", self.program.source, self.here, trouble="stopped by the operator")

    def places(self, action: Action) -> list[int]:
        """Return the indices of the statements to which a BREAK or CLEAR refers."""
        return [
            line.index
            for line in self.program.statements
            if (line.place.card if action.card else line.label) == action.number
        ]

    def misfit(self, action: Action) -> str:
        """Return a message if BREAK or CLEAR names a variable, statement or card that does not exist, otherwise ""."""
        if action.word in ("BREAK", "CLEAR") and action.name and not self.program.storage.fields_of(action.name):
            return f"{self.program.source} has no variable {action.name}"
        if action.word in ("BREAK", "CLEAR") and action.number and not self.places(action):
            return f"{self.program.source} has no statement of that number or card"
        return ""

    def held(self, name: str) -> list[tuple[Number, int]]:
        """Return value and kind (fixed, floating or undefined) of each field of a variable or array element."""
        return [(self.state.values[field], self.state.kinds[field]) for field in self.program.storage.fields_of(name)]

    def expected_fields(self) -> list[tuple[str, int, int]]:
        """Return FORMAT code, first column and width of each field of the line for which an ACCEPT waits."""
        return self.devices.expected_fields(self._pending == interpreter.AT_BEGIN)

    def result(self, ending: Ending = BAD_INPUT) -> Result:
        """Return the result of the run up to now, also after :meth:`advance` raised an error for a bad card."""
        devices, counts = self.devices, self.state.counts
        events = tuple(devices.events)
        return Result(
            punched=tuple(event.text for event in events if event.what == "punch"),
            typed=tuple(event.text for event in events if event.what == "type"),
            ending=ending,
            events=events,
            notices=tuple(devices.notices),
            statements=statements_begun(self.program, counts),
            counts=tuple(counts),
            cards_read=devices.position,
            cards_punched=devices.punched,
            characters_typed=devices.characters,
            numbers=tuple(sorted(devices.fields.items())),
            errors=machine_errors(devices.errors),
            uncut=tuple(devices.cut),
        )

    def _advance(self, goal: int) -> Halt | Ending | None:
        """Run until the work reaches ``goal``, which must not exceed the limit.  See :meth:`advance`."""
        if self._ending or self.halt:
            return self._ending or self.halt
        # A halt in the middle of a service leaves its reason in ``_pending``; the service is then done again.
        reason, self._line_was_typed = self._pending, False
        watched = self.tracer is not None or self._steps > 0
        self.devices.lists = watched
        if not watched:
            self.last = self._begun = None
        try:
            while True:
                # First perform the service that the interpreter requested or that a halt interrupted.
                if reason != interpreter.AT_LIMIT:
                    self._pending, typed = reason, self.devices.characters
                    self._serve(reason)
                    self._pending = interpreter.AT_LIMIT
                    if self.halt:
                        return self.halt
                    self._line_was_typed = self.by_lines and self.devices.characters != typed
                    if self._line_was_typed:
                        return None
                reason = self._interpret(goal)
                if reason == interpreter.AT_LIMIT:
                    return None
        except LineNeeded:
            self._wait_for_line("")
        except CardError as error:
            # A person may type a bad line again, so the effects of the statement are undone.
            if self._checkpoint is None or self.devices.verb != "ACCEPT":
                raise
            self._checkpoint.restore(self)
            self._wait_for_line(str(error))
        except Ended as ended:
            self._ending = ended.ending
        except Undecided as error:
            self._ending = replace(self.devices.ending("undecided"), trouble=str(error))
        return self._ending or self.halt

    def _wait_for_line(self, trouble: str) -> None:
        """Halt until the operator types a line.  ``trouble`` says why the previous line was invalid, or is empty."""
        self._checkpoint = _Checkpoint(self) if self.retypes else None
        self.halt = Halt("accept", self.program.line_at(self.state.at), trouble=trouble)

    def _interpret(self, goal: int) -> int:
        traced = self.tracer is not None or self._steps > 0 or bool(self.breakpoints or self.watched)
        machine = self._code, self._table, self.state, self.switches, self.options.numbers
        strict = self.options.bounds == "strict"
        return interpreter.run(*machine, goal, self.options.limit, strict, traced, self.journal, self._enters)

    def _serve(self, reason: int) -> None:
        """Perform the service that the interpreter requests, such as input.  Raise Ended if the run ends instead."""
        state, numbers = self.state, self.options.numbers
        address = state.address
        if reason == interpreter.AT_ITEM:
            self.devices.item(address)
        elif reason == interpreter.AT_BEGIN:
            self.devices.begin(address)
        elif reason == interpreter.AT_FINISH:
            self.devices.finish()
        elif reason == interpreter.AT_STATEMENT:
            self._watch(self.program.line_at(state.at))
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
            self.halt = Halt("pause", self.program.line_at(state.at), self.program.code[state.at].second)
        else:
            raise self._ended_by(reason)

    def _watch(self, line: Line) -> None:
        """Tell the tracer which statement begins, and halt after a step or at a breakpoint."""
        self.last, self._begun = self._begun, line
        if self.tracer is not None:
            self.tracer(line, self)
        # A step ends when the next statement begins.
        stepped = self._steps == 1
        self._steps -= self._steps > 0
        if stepped:
            self.halt = Halt("stop", line, why="attention" if self._attention else "step")
        elif line.index in self.breakpoints:
            self.halt = Halt("stop", line, why="breakpoint")
        for name, before in self.watched.items():
            self.watched[name] = self.held(name)
            if self.watched[name] != before and self.halt is None:
                self.halt = Halt("stop", line, why=f"{name} has changed")

    def _ended_by(self, reason: int) -> Ended:
        state, address = self.state, self.state.address
        kind = state.kinds[address] if reason == interpreter.AT_UNDEFINED else UNDEFINED
        limit, at, decision, costly = self.options.limit, state.at, state.decision, state.costly
        return Ended(ended_by(reason, self.program, limit, at, decision, address, kind, state.index, costly))

    def _pay(self, operation: str, first: Number, second: Number = 0) -> None:
        """Add the cost of a slow operation to the work of the run.  Raise Ended if the work is far above the limit."""
        state = self.state
        state.work += state.owe(self.options.numbers.work(operation, first, second))
        if state.work > self.options.limit + interpreter.SLACK:
            raise self._ended_by(interpreter.AT_COSTLY)

    def _to_fac(self, value: Number, code: str) -> None:
        self.state.fac = value
        if code:
            self.devices.error(code)


class _Checkpoint:
    """A copy of a session before a line is typed.  It restores the session if the line is invalid."""

    def __init__(self, session: Session) -> None:
        devices = session.devices
        state, transfer = session.state, devices.transfer
        self._pending = session._pending
        self._state = replace(state, values=list(state.values), kinds=list(state.kinds), counts=list(state.counts))
        self._transfer = copy(transfer)
        self._literals = [list(layout.literals) for layout in devices.layouts]
        self._listed, self._fields, self._notices = list(devices.listed), dict(devices.fields), dict(devices.notices)

    def restore(self, session: Session) -> None:
        """Restore the session to the saved state.  Cards already punched and lines already typed remain."""
        devices = session.devices
        session._pending = self._pending
        # The interpreter and the devices hold references to these lists, so the lists are changed in place.
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

"""The interface between the emulator and the page that controls it: load a program and a deck, run, and operate.

Requests and answers are plain data that JSON can represent. The page is ``docs/console``. The machine runs in slices of
some milliseconds. The machine asks the operator the same questions, and the operator has the same commands and the same
log as on the command line (:mod:`emulator.machine.operator`). Python in the browser cannot wait for the visitor: if the
machine halts and the visitor has not answered, the slice ends, and the next slice continues from the halt. To go back,
a new session repeats the log up to an earlier statement.
"""

import io
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

from emulator.errors import EmulatorError, LowerCaseError
from emulator.language.cards import Deck, deck_from_text
from emulator.language.compiler import compile_deck
from emulator.language.objectcode import Program
from emulator.language.statements import capitals
from emulator.machine.console import Cards, command, done
from emulator.machine.machine import run_with_operator
from emulator.machine.operator import PUNCHED, FromFile, Load, Logged, Operator
from emulator.machine.result import DEFAULT_CORE, DEFAULT_LIMIT, Event, Options
from emulator.machine.session import Action, Halt, Session
from emulator.machine.timing import measure
from emulator.machine.words import action_line, halt_line, notes
from emulator.numbers import numbers
from modern.edition import programs
from modern.publication import panel
from modern.publication.decks import named_deck, offered
from modern.thesis.job import second_program

# A request or an answer: plain values by name. The docstring of each method describes them.
Answer = dict[str, Any]

_WIDTH = 72
_WHILE_RUNNING = ("ATTN", "SWITCH", "BREAK", "CLEAR", "STOP", "STEP")
_EMPTY = "nothing is loaded: choose a program and a deck, and press Load"
_ENDED = "the run has ended: press Load to load the deck again"


class _Unanswered(Exception):
    """Raised if the machine waits for the operator and the page has not sent an action yet."""


class _Visitor(FromFile):
    """An operator that first repeats the actions in a log and then performs those of the visitor of the page."""

    def __init__(self, record: panel.Record, log: str = "") -> None:
        super().__init__("log", log)
        self.actions: deque[Action] = deque()
        self._record = record

    def forget(self) -> bool:
        """Drop the lines of the log that have not been repeated. Return True if there were any."""
        has_lines, self._lines = bool(self._lines), deque()
        return has_lines

    @property
    def is_idle(self) -> bool:
        return not self._lines and not self.actions

    def attend(self, session: Session) -> Iterator[Action]:
        yield from super().attend(session)
        while not self._lines and self.actions and self.actions[0].word in _WHILE_RUNNING:
            yield self.actions.popleft()

    def answer(self, session: Session, halt: Halt) -> Action:
        if self.is_idle:
            raise _Unanswered
        self._record.forget()
        return super().answer(session, halt) if self._lines else self.actions.popleft()


@dataclass(frozen=True, slots=True)
class _Loaded:
    """A program and a deck in the machine. ``deck_name`` is the name of the deck in the log."""

    program: Program
    deck: Deck
    deck_name: str
    options: Options


@dataclass
class Desk:
    """A machine with program, decks and operator.

    ``clock`` returns the time in seconds. During a run, the clock is read after each ``small`` units of work, or more
    often if the run is slowed down to a pace.
    """

    clock: Callable[[], float] = time.monotonic
    small: int = 2_000
    _loaded: _Loaded | None = None
    _session: Session | None = None
    _visitor: _Visitor = field(default_factory=lambda: _Visitor(panel.Record()))
    _logged: Operator = field(default_factory=Operator)
    # The log of the earlier loads, which also has the visitor's decks, and the log of the present load.
    _earlier: str = ""
    _log: io.StringIO = field(default_factory=io.StringIO)
    _cards: Cards = field(default_factory=Cards)
    _ending: bool = False
    _stacker: list[str] = field(default_factory=list)
    _happened: list[Event] = field(default_factory=list)
    # The loads of a repeated log that are still to come, and the texts of programs and decks that the visitor provided.
    _queue: deque[Load] = field(default_factory=deque)
    _texts: dict[str, str] = field(default_factory=dict)
    _record: panel.Record = field(default_factory=panel.Record)

    offers = staticmethod(offered)
    check = staticmethod(panel.compile_messages)

    def load(self, request: Answer) -> Answer:
        """Compile a program and load a deck. The machine then waits for START.

        In the request, ``program`` and ``deck`` are each a built-in name or a pair of name and text. The deck ``""`` is
        empty, and the deck ``"PUNCHED"`` has the cards that the last run punched. ``switches`` lists the sense switches
        that are on. ``arithmetic``, ``core``, ``limit`` and ``upcase`` have the meaning of the options of ``hull1620
        run``.

        The answer has ``program``, ``listing`` (number and text of each card), ``deck``, ``switches``, and ``core``,
        ``touched`` and ``formats`` as :mod:`modern.publication.panel` returns them. If the request is invalid, the
        answer has only ``refused``, a list of messages, and the machine is empty.
        """
        if "log" not in request:  # a new load ends the repetition of a log
            self._queue.clear()
        self._earlier += self._log.getvalue()
        self._log, self._session, self._loaded = io.StringIO(), None, None
        try:
            source = self._source(request["program"], bool(request.get("upcase")))
            program = compile_deck(source)
            deck = self._deck(name := request.get("deck", ""))
            options = Options(
                numbers(str(request.get("arithmetic", "truncating"))),
                frozenset(int(n) for n in request.get("switches", ())),
                int(request.get("core", DEFAULT_CORE)),
                limit=int(request.get("limit", DEFAULT_LIMIT)),
                hopper="any",
            )
            self._loaded = _Loaded(program, deck, name if isinstance(name, str) else str(name[0]), options)
            self._begin(self._loaded, str(request.get("log", "")))
        except (EmulatorError, ValueError) as error:
            hint = "; choose “read lower case as capitals” to accept it" if isinstance(error, LowerCaseError) else ""
            return self._refused(f"{error}{hint}")
        if "log" not in request:
            self._visitor.actions.append(Action("ATTN"))
        return {
            "program": program.source,
            "listing": [[card.number, card.text] for card in source.cards],
            "deck": [card.text for card in deck.cards],
            "switches": [n in options.switches for n in (1, 2, 3, 4)],
            "core": panel.core(program, options.core),
            "touched": panel.touched(program),
            "formats": panel.formats(program),
        }

    def replay(self, text: str) -> Answer:
        """Begin to repeat a log, which may have several loads. Return the answer of :meth:`load` for the first load."""
        try:
            log = FromFile("log", text)
        except EmulatorError as error:
            return self._refused(str(error))
        for name, cards in log.decks.items():
            self._keep(name, cards)
        self._queue = deque(load for load in log.loads if load.program)
        if not self._queue:
            return self._refused("the log names no program: expected a line such as LOAD program1 example1")
        return self.next_load()

    def next_load(self) -> Answer:
        """Load the next program and deck of the log that is being repeated."""
        load = self._queue.popleft()
        lines = "".join(f"{action_line(line.action, line.at)}\n" for line in load.lines)
        return self.load({"program": load.program.removesuffix(".f"), "deck": load.deck, "log": lines})

    def run(self, milliseconds: float, pace: float = 0.0) -> Answer:
        """Run for about the given time, or until the machine waits or the run ends.

        ``pace`` is the largest speed as a multiple of the speed of a 1620, or 0 for full speed. The answer has these
        values:

        ``events`` lists the events of this part of the run, each as kind and text. ``card`` is the card that is
        executed next, ``statement`` is the number of its statement in the run, and ``read`` is the number of cards
        read. ``time`` is the time on a 1620 with the bounds of its error, as text, and ``seconds`` is this time as a
        number. ``stands`` is the reason why the machine waits, or empty. ``waits`` is ``typed`` if the machine waits
        for a typed line (``fields`` lists its fields), ``answer`` if it waits for an action, or empty. ``registers``
        has the floating-point and the fixed-point accumulator. ``picture``, ``stages`` (the number of hulls so far) and
        ``wrote`` (the fields written) come from :mod:`modern.publication.panel`. A run that returns to an earlier state
        would never end and is stopped. ``repeats`` is then the number of statements that it repeats.

        At the end of the run ``ended`` is true, ``messages`` has the messages that ``hull1620 run`` would print,
        ``next`` names the program that reads the punched cards, and ``queued`` is true if a log has further loads.
        """
        if (session := self._session) is None or self._ending:
            return self._answer()
        end_of_slice = self.clock() + milliseconds / 1000
        furthest = self._seconds(session) + pace * milliseconds / 1000
        ending, failure = None, ""
        while True:
            # The clock is read only between parts of a slice, each with a given number of operations.
            goal = session.state.work + (self.small if not pace else max(1, self.small // 200))
            try:
                ending = run_with_operator(session, self._logged, goal, self._see)
            except _Unanswered:
                break
            except EmulatorError as error:
                failure = str(error)
                break
            if self._record.repeats and session.halt is None and self._visitor.is_idle:
                self._visitor.actions.append(Action("ATTN"))
            if ending is not None or self.clock() >= end_of_slice or (pace and self._seconds(session) >= furthest):
                break
        if ending is None and not failure:
            return self._answer()
        self._ending = True
        result = session.result() if ending is None else session.result(ending)
        messages = [] if failure else list(notes(session.program, result))
        if failure or (ending is not None and not ending.normal):
            messages.append(f"hull1620: {failure or result.ending.message}")
        second = None if failure else second_program(result)
        answer = {"messages": messages, "next": f"program{second}" if second else "", "queued": bool(self._queue)}
        return self._answer() | answer

    def act(self, line: str) -> Answer:
        """Carry out a command of the operator, or ``ENTER`` and a line for ACCEPT."""
        session = self._session
        if session is None or self._ending:
            return {"lines": [_ENDED if session else _EMPTY]}
        if line.startswith("ENTER"):
            if not (session.halt and session.halt.what == "accept"):
                return {"lines": ["the program does not ask for a line"]}
            action = Action("ENTER", text=line[6:].upper().rstrip())
        elif line == "ATTN":
            action = Action("ATTN")
        # A command either changes the machine, or shows something.
        elif isinstance(action_or_lines := command(session, line, self._cards, _WIDTH), list):
            return {"lines": action_or_lines}
        else:
            action = action_or_lines
        if action.word == ("START" if session.halt is None else "ATTN"):
            return {"lines": []}
        if session.halt and session.halt.what == "accept" and action.word in ("START", "STEP"):
            return {"lines": [halt_line(session.halt)]}
        self._visitor.actions.append(action)
        lines = [action_line(action)] if action.word in ("SWITCH", "BREAK", "CLEAR") else []
        if self._visitor.forget():
            self._queue.clear()
            lines.append("the rest of the log is not repeated")
        return {"lines": lines}

    def jump(self, statement: int) -> Answer:
        """Go to the beginning of a statement of this run, counted from 1, and return an answer as :meth:`run` does.

        To go back, the machine repeats the run and stops before the statement, and everything after it is undone. The
        answer then also has ``undone``, the numbers of ``typed`` lines and ``punched`` cards that remain. To go
        forward, the machine steps.
        """
        if statement > len(self._record.times):
            self.act(f"STEP {statement - len(self._record.times)}")
        if self._loaded is None or not 1 <= statement <= len(self._record.times):
            return self._answer()
        self._queue.clear()
        work, log, self._log = self._record.times[statement - 1] - 1, self._log.getvalue(), io.StringIO()
        session = self._begin(self._loaded, log)
        # The log stops the machine at some statements; _Unanswered ends the repetition if it waited at the last one.
        with suppress(_Unanswered):
            run_with_operator(session, self._logged, work, self._see)
        self._visitor.forget()
        if session.halt is None:
            self._visitor.actions.append(Action("ATTN"))
        answer = self.run(0)
        return answer | {"events": [], "undone": {"typed": len(session.result().typed), "punched": len(self._stacker)}}

    def decide(self) -> Answer:
        """Compare the loaded run with exact arithmetic, as :func:`modern.publication.verdict.verdict` describes."""
        from modern.publication.verdict import verdict  # not at the top: mpmath would delay the page

        if (loaded := self._loaded) is None:
            return {"lines": [_EMPTY]}
        return verdict(loaded.program, loaded.deck, loaded.options)

    def field(self, address: int) -> Answer:
        """Return the field at an address of core storage, as :func:`modern.publication.panel.field_at` describes."""
        return panel.field_at(self._session, address, self._record.writers) if self._session else {}

    def stages(self) -> list[Answer]:
        """Return the successive hulls of the run, each as :func:`modern.publication.panel.picture` describes it."""
        return self._record.stages

    def show(self, line: str) -> Answer:
        """Carry out a command that only shows something, such as ``VARIABLES``."""
        lines = command(self._session, line, self._cards, _WIDTH) if self._session else []
        return {"lines": lines if isinstance(lines, list) else []}

    def log(self) -> str:
        """Return a log of all loads and actions since the page was opened. The log can be repeated."""
        return self._earlier + self._log.getvalue()

    def _begin(self, loaded: _Loaded, log: str) -> Session:
        """Return a new machine with the loaded program and deck. Its operator first repeats the actions in ``log``."""
        self._record = panel.Record(loaded.program)
        self._session = session = Session(loaded.program, loaded.deck, loaded.options, tracer=self._record)
        self._visitor, self._cards, self._ending = _Visitor(self._record, log), Cards(), False
        self._logged = Logged(self._visitor, self._log, loaded.deck_name)
        self._happened, self._stacker = [], []
        return session

    def _refused(self, message: str) -> Answer:
        self._session = self._loaded = None
        return {"refused": message.splitlines()}

    def _source(self, program: Any, upcase: bool) -> Deck:
        if isinstance(program, str):
            if program in programs.NAMES:
                return programs.committed(program)
            name = next((name for name in (program, f"{program}.f") if name in self._texts), "")
            if not name:
                raise ValueError(f"unknown program {program!r}")
            return deck_from_text(name, self._texts[name])
        text = capitals(str(program[1])) if upcase else str(program[1])
        source = deck_from_text(str(program[0]), text)
        self._keep(str(program[0]), text)
        return source

    def _deck(self, deck: Any) -> Deck:
        if deck == "":
            return Deck("no deck", ())
        if deck == PUNCHED:
            return deck_from_text("the cards punched", "".join(card + "\n" for card in self._stacker))
        if isinstance(deck, str):
            return deck_from_text(deck, self._texts[deck]) if deck in self._texts else named_deck(deck)
        self._keep(str(deck[0]), str(deck[1]))
        return deck_from_text(str(deck[0]), str(deck[1]))

    def _keep(self, name: str, text: str) -> None:
        """Record in the log the cards of a program or deck that the visitor has typed."""
        if self._texts.get(name) != text:
            self._texts[name] = text
            self._earlier += f"CARDS {name}\n" + "".join(f"CARD {card}\n" for card in text.splitlines())

    def _see(self, events: Sequence[Event]) -> None:
        self._happened += events
        self._cards.see(events)
        self._stacker += [event.text for event in events if event.what == "punch"]

    def _seconds(self, session: Session) -> float:
        return measure(session.program, session.result()).time.seconds

    def _answer(self) -> Answer:
        session, events, self._happened = self._session, self._happened, []
        if session is None:
            return {"events": [], "card": 0, "time": "0 s", "stands": "", "waits": "", "ended": False}
        halt = None if self._ending else session.halt
        accepts = halt is not None and halt.what == "accept"
        timing = measure(session.program, session.result())
        return {
            "events": [[event.what, event.text] for event in events if event.what != "begin"],
            "card": session.here.place.card,
            "statement": len(self._record.times),
            "read": session.devices.position,
            "time": str(timing.time),
            "seconds": timing.time.seconds,
            "switches": [bool(on) for on in session.switches],
            "breaks": [session.program.statements[index].place.card for index in session.breakpoints],
            "did": done(session, session.last, _WIDTH) if halt and halt.why == "step" and session.last else [],
            "stands": halt_line(halt) if halt else "",
            "waits": "typed" if accepts else "answer" if halt else "",
            "fields": session.expected_fields() if accepts else [],
            "picture": self._record.picture(session),
            "stages": len(self._record.stages),
            "wrote": self._record.take(),
            "repeats": self._record.repeats,
            "registers": [session.options.numbers.traced(session.state.fac), str(session.state.fixed)],
            "ended": self._ending,
            "messages": [],
        }

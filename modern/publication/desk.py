"""The interface between the emulator and the page that controls it: load a program and a deck, run, and operate.

Requests and answers are plain data that JSON can represent; the page is ``docs/console``.  The machine runs in slices
of some milliseconds.  The operator has the same questions, commands and log as on the command line
(:mod:`emulator.machine.operator`, :mod:`emulator.machine.console`).  Python in the browser cannot wait for an answer.
If the machine halts and the page has sent no answer, the slice ends, and the next slice continues there.  The module
imports only the standard library, lark and mpmath, which are available in the browser, but not numpy.
"""

import io
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

from emulator.errors import EmulatorError, LowerCaseError
from emulator.language.cards import Deck, deck_from_text
from emulator.language.compiler import compile_deck
from emulator.language.statements import capitals
from emulator.machine.console import Cards, command, done
from emulator.machine.machine import run_with_operator
from emulator.machine.operator import Logged, Operator
from emulator.machine.result import DEFAULT_CORE, DEFAULT_LIMIT, Event, Options
from emulator.machine.session import Action, Halt, Session
from emulator.machine.timing import measure
from emulator.machine.words import action_line, halt_line, notes
from emulator.numbers import numbers
from modern.edition import programs
from modern.edition.chapter6 import EXAMPLES, input_deck

# The answer to a request: keys and plain values, which the docstring of each method describes.
Answer = dict[str, Any]

_WIDTH = 72
_WHILE_RUNNING = ("ATTN", "SWITCH", "BREAK", "CLEAR", "STOP", "STEP")


class _Unanswered(Exception):
    """The machine waits for the operator, and the page has not sent an action."""


class _Visitor(Operator):
    """An operator whose actions come from the page."""

    present = True

    def __init__(self) -> None:
        super().__init__()
        self.actions: deque[Action] = deque()

    def attend(self, session: Session) -> Iterator[Action]:
        while self.actions and self.actions[0].word in _WHILE_RUNNING:
            yield self.actions.popleft()

    def answer(self, session: Session, halt: Halt) -> Action:
        if not self.actions:
            raise _Unanswered
        return self.actions.popleft()


@dataclass
class Desk:
    """A machine with program, decks and operator.

    ``clock`` decides when a slice ends; it is read after each ``small`` operations.
    """

    clock: Callable[[], float] = time.monotonic
    small: int = 2_000
    _session: Session | None = None
    _visitor: _Visitor = field(default_factory=_Visitor)
    _log: io.StringIO = field(default_factory=io.StringIO)
    _logged: Operator | None = None
    _cards: Cards = field(default_factory=Cards)
    _ending: bool = False
    _stacker: list[str] = field(default_factory=list)
    _happened: list[Event] = field(default_factory=list)

    def offers(self) -> Answer:
        """Return the built-in ``programs`` and ``decks`` as pairs of name and title."""
        return {
            "programs": [[b.name, b.title] for b in programs.BUILT_INS],
            "decks": [[f"example{n}", f"example {n} of chapter 6"] for n in EXAMPLES],
        }

    def load(self, request: Answer) -> Answer:
        """Compile a program and load a deck; the machine then waits for START.

        In the request, ``program`` and ``deck`` are each a built-in name or a pair of name and text.  The deck ``""``
        is empty, and ``"stacker"`` has the cards that were punched last.  ``switches`` lists the sense switches that
        are on.  ``arithmetic``, ``core``, ``limit`` and ``upcase`` are those of the command line.

        The answer has ``program``, ``listing`` (number and text of each card), ``deck`` and ``switches``.  If the
        request is invalid, it has ``refused``, a list of messages, and the machine is unchanged.
        """
        try:
            source = self._source(request["program"], bool(request.get("upcase")))
            program = (
                programs.program(request["program"]) if isinstance(request["program"], str) else compile_deck(source)
            )
            deck = self._deck(request.get("deck", ""))
            options = Options(
                numbers(str(request.get("arithmetic", "truncating"))),
                frozenset(int(n) for n in request.get("switches", ())),
                int(request.get("core", DEFAULT_CORE)),
                limit=int(request.get("limit", DEFAULT_LIMIT)),
                hopper="any",
            )
            session = Session(program, deck, options)
        except LowerCaseError as error:
            return {"refused": [f"{error}; choose “read lower case as capitals” to accept it"]}
        except (EmulatorError, ValueError) as error:
            return {"refused": str(error).splitlines()}
        self._session, self._ending = session, False
        self._visitor, self._cards, self._stacker = _Visitor(), Cards(), []
        self._logged = Logged(self._visitor, self._log)
        self._visitor.actions.append(Action("ATTN"))
        return {
            "program": program.source,
            "listing": [[card.number, card.text] for card in source.cards],
            "deck": [card.text for card in deck.cards],
            "switches": [bool(on) for on in session.switches],
        }

    def run(self, milliseconds: float, pace: float = 0.0) -> Answer:
        """Run for about the given time, or until the machine waits or the run ends.

        ``pace`` is the largest speed relative to the 1620, or 0 for full speed.  The answer has ``events`` (kind and
        text), ``card`` (the card that is executed next), ``work``, ``seconds`` on a 1620, ``stands`` (why the machine
        waits, or empty), ``waits`` (``typed`` for a line, ``answer`` for an action, or empty), ``ended`` and
        ``messages``.
        """
        session = self._session
        if session is None or self._logged is None or self._ending:
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
            if ending is not None or self.clock() >= end_of_slice or (pace and self._seconds(session) >= furthest):
                break
        messages: list[str] = []
        if ending is not None or failure:
            self._ending = True
            result = session.result() if ending is None else session.result(ending)
            if not failure:
                messages = list(notes(session.program, result))
            if failure or (ending is not None and not ending.normal):
                messages.append(f"hull1620: {failure or result.ending.message}")
        return self._answer(messages)

    def act(self, line: str) -> Answer:
        """Process a command of the operator, or ``ENTER`` and a line for ACCEPT. The answer has ``lines`` to show."""
        session = self._session
        if session is None or self._ending:
            return {"lines": ["nothing is running: load a program first"]}
        if line.startswith("ENTER"):
            if not (session.halt and session.halt.what == "accept"):
                return {"lines": ["the program does not ask for a line"]}
            action = Action("ENTER", text=line[6:].upper().rstrip())
        elif line == "ATTN":
            action = Action("ATTN")
        else:
            # A command either changes the machine, or shows something.
            action_or_lines = command(session, line, self._cards, _WIDTH)
            if isinstance(action_or_lines, list):
                return {"lines": action_or_lines}
            action = action_or_lines
        if action.word == ("START" if session.halt is None else "ATTN"):
            return {"lines": []}
        if session.halt and session.halt.what == "accept" and action.word in ("START", "STEP"):
            return {"lines": [halt_line(session.halt)]}
        self._visitor.actions.append(action)
        return {"lines": [action_line(action)] if action.word in ("SWITCH", "BREAK", "CLEAR", "STEP") else []}

    def show(self, line: str) -> Answer:
        """Execute a command that only shows something, such as ``VARIABLES``; the answer has ``lines``."""
        session = self._session
        lines = [] if session is None else command(session, line, self._cards, _WIDTH)
        return {"lines": lines if isinstance(lines, list) else []}

    def log(self) -> str:
        """Return the operator's actions since the page was opened, as a log that ``--operator=FILE`` accepts."""
        return self._log.getvalue()

    def _source(self, program: Any, upcase: bool) -> Deck:
        if isinstance(program, str):
            return programs.committed(program) if program in programs.NAMES else _unknown(program)
        text = str(program[1])
        return deck_from_text(str(program[0]), capitals(text) if upcase else text)

    def _deck(self, deck: Any) -> Deck:
        if deck == "":
            return Deck("no deck", ())
        if deck == "stacker":
            return deck_from_text("the cards punched", "".join(card + "\n" for card in self._stacker))
        if isinstance(deck, str):
            return next((input_deck(n) for n in EXAMPLES if deck == f"example{n}"), None) or _unknown(deck)
        return deck_from_text(str(deck[0]), str(deck[1]))

    def _see(self, events: Sequence[Event]) -> None:
        self._happened += events
        self._cards.see(events)
        self._stacker += [event.text for event in events if event.what == "punch"]

    def _seconds(self, session: Session) -> float:
        return measure(session.program, session.result()).seconds

    def _answer(self, messages: Sequence[str] = ()) -> Answer:
        session, events = self._session, self._happened
        self._happened = []
        if session is None:
            return {"events": [], "card": 0, "work": 0, "seconds": 0.0, "stands": "", "waits": "", "ended": False}
        halt = None if self._ending else session.halt
        did = done(session, session.last, _WIDTH) if halt and halt.why == "step" and session.last else []
        return {
            "events": [[event.what, event.text] for event in events if event.what != "begin"],
            "card": session.here.place.card,
            "work": session.state.work,
            "read": session.devices.position,
            "seconds": round(self._seconds(session), 1),
            "switches": [bool(on) for on in session.switches],
            "did": did,
            "stands": halt_line(halt) if halt else "",
            "waits": "" if halt is None else "typed" if halt.what == "accept" else "answer",
            "ended": self._ending,
            "messages": list(messages),
        }


def _unknown(name: str) -> Any:
    raise ValueError(f"unknown name {name!r}")

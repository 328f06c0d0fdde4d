"""The console's desk without a face: a program and a deck are laid in, and the machine is run in slices.

What goes in and what comes out is plain data that JSON can hold, so that any face can be put on it; the page of the
site has one (``docs/console``).  The operator is that of the command line with the same questions, words and log
(:mod:`emulator.machine.operator`, :mod:`emulator.machine.console`); he has no terminal, so a halt that nobody has
answered yet ends the slice, and the next one begins there.  Nothing here waits, and nothing is imported that a page
has not: the standard library, lark, mpmath, and no numpy.
"""

from __future__ import annotations

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

Answer = dict[str, Any]
"""What the desk says: keys and plain values, as each method states."""

_WIDTH = 72
_RUNNING = ("ATTN", "SWITCH", "BREAK", "CLEAR", "STOP", "STEP")


class _Unanswered(Exception):
    """The machine stands, and nobody has said yet what is to be done."""


class _Visitor(Operator):
    """Does what was asked for, and does not answer before."""

    present = True

    def __init__(self) -> None:
        super().__init__()
        self.asked: deque[Action] = deque()

    def attend(self, session: Session) -> Iterator[Action]:
        while self.asked and self.asked[0].word in _RUNNING:
            yield self.asked.popleft()

    def answer(self, session: Session, halt: Halt) -> Action:
        if not self.asked:
            raise _Unanswered
        return self.asked.popleft()


@dataclass
class Desk:
    """One machine and what lies around it.

    ``clock`` gives seconds, and says when a slice is over.  ``small``: how much work is done between two looks at it.
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
        """What can be chosen by name: ``programs`` and ``decks``, pairs of name and title."""
        return {
            "programs": [[b.name, b.title] for b in programs.BUILT_INS],
            "decks": [[f"example{n}", f"example {n} of chapter 6"] for n in EXAMPLES],
        }

    def load(self, request: Answer) -> Answer:
        """Compile a program and lay in a deck; the machine waits for START.

        ``program`` and ``deck`` are each a name that is offered, or a pair of name and text; of a deck ``""`` is none
        and ``"stacker"`` the cards punched last.  ``switches`` are those that are on; ``arithmetic``, ``core``,
        ``limit``, ``upcase`` as of the command.  Answers with ``program``, ``listing`` (number and text of each
        card), ``deck`` and ``switches``; or with ``refused``, lines of what is wrong, and the machine as it was.
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
            return {"refused": [f"{error}; it can be read with capitals"]}
        except (EmulatorError, ValueError) as error:
            return {"refused": str(error).splitlines()}
        self._session, self._ending = session, False
        self._visitor, self._cards, self._stacker = _Visitor(), Cards(), []
        self._logged = Logged(self._visitor, self._log)
        self._visitor.asked.append(Action("ATTN"))
        return {
            "program": program.source,
            "listing": [[card.number, card.text] for card in source.cards],
            "deck": [card.text for card in deck.cards],
            "switches": [bool(on) for on in session.switches],
        }

    def run(self, milliseconds: float, pace: float = 0.0) -> Answer:
        """Run on for about that long, or until the machine stands or has ended.

        ``pace``: at most that many times the speed of the 1620, 0 for as fast as can be.  Answers with ``events``
        (what and text), ``card`` (that the machine is at), ``work``, ``seconds`` of a 1620, ``stands`` (a line, empty
        where it runs on), ``waits`` for a line to be ``typed`` or for an ``answer``, ``ended`` (a line) and
        ``messages``.
        """
        session = self._session
        if session is None or self._ending:
            return self._answer()
        until = self.clock() + milliseconds / 1000
        far = self._seconds(session) + pace * milliseconds / 1000
        ending, wrong = None, ""
        while True:
            goal = session.state.work + (self.small if not pace else max(1, self.small // 200))
            try:
                ending = run_with_operator(session, self._operator(), goal, self._see)
            except _Unanswered:
                break
            except EmulatorError as error:
                wrong = str(error)
                break
            if ending is not None or self.clock() >= until or (pace and self._seconds(session) >= far):
                break
        messages: list[str] = []
        if ending is not None or wrong:
            self._ending = True
            result = session.result() if ending is None else session.result(ending)
            if not wrong:
                messages = list(notes(session.program, result))
            if wrong or (ending is not None and not ending.normal):
                messages.append(f"hull1620: {wrong or result.ending.message}")
        return self._answer(messages)

    def act(self, words: str) -> Answer:
        """What the operator types at the console, or a line for ACCEPT (``ENTER`` and the line).

        Answers with ``lines`` to be shown; an action is done in the next slice.
        """
        session = self._session
        if session is None or self._ending:
            return {"lines": ["nothing runs: load a program"]}
        if words.startswith("ENTER"):
            if not (session.halt and session.halt.what == "accept"):
                return {"lines": ["nothing is asked for"]}
            action = Action("ENTER", text=words[6:].upper().rstrip())
        elif words == "ATTN":
            action = Action("ATTN")
        else:
            found = command(session, words, self._cards, _WIDTH)
            if isinstance(found, list):
                return {"lines": found}
            action = found
        if session.halt is not None and action.word == "ATTN":
            return {"lines": []}
        if session.halt is None and action.word == "START":
            return {"lines": []}
        if session.halt and session.halt.what == "accept" and action.word in ("START", "STEP"):
            return {"lines": [halt_line(session.halt)]}
        self._visitor.asked.append(action)
        return {"lines": [action_line(action)] if action.word in ("SWITCH", "BREAK", "CLEAR", "STEP") else []}

    def show(self, words: str) -> Answer:
        """``VARIABLES``, ``CORE`` and the like, while it runs too: ``lines``."""
        session = self._session
        found = [] if session is None else command(session, words, self._cards, _WIDTH)
        return {"lines": found if isinstance(found, list) else []}

    def log(self) -> str:
        """Everything since the page was opened, as a file of the operator."""
        return self._log.getvalue()

    def _source(self, asked: Any, upcase: bool) -> Deck:
        if isinstance(asked, str):
            return programs.committed(asked) if asked in programs.NAMES else _strange(asked)
        text = str(asked[1])
        return deck_from_text(str(asked[0]), capitals(text) if upcase else text)

    def _deck(self, asked: Any) -> Deck:
        if asked == "":
            return Deck("no deck", ())
        if asked == "stacker":
            return deck_from_text("the cards punched", "".join(card + "\n" for card in self._stacker))
        if isinstance(asked, str):
            return next((input_deck(n) for n in EXAMPLES if asked == f"example{n}"), None) or _strange(asked)
        return deck_from_text(str(asked[0]), str(asked[1]))

    def _operator(self) -> Operator:
        assert self._logged is not None, "a machine has its operator"
        return self._logged

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


def _strange(name: str) -> Any:
    raise ValueError(f"there is no {name!r} to choose")

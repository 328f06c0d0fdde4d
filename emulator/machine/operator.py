"""The operator of a run, who sees the events of the devices and answers every halt.

:class:`Operator` only presses START and types prepared lines.  :class:`FromFile` reads the actions from a file.  The
operator in modern/cli/shared/terminal.py is a person at a terminal.  :class:`Logged` records the actions of any
operator in a file that :class:`FromFile` can read.  emulator/machine/words.py defines the lines of such a file.
"""

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TextIO

from emulator.errors import DeckError, FileError, OperatorError
from emulator.machine.result import Event
from emulator.machine.session import Action, Halt, Session
from emulator.machine.words import action_line, halt_line, read_action

_SETTING = ("SWITCH", "BREAK", "CLEAR", "STEP")

# The units of work between two calls of the operator.  A run does them in a few hundredths of a second.
SLICE = 20_000

# A function that receives events in order.
Output = Callable[[Sequence[Event]], None]


@dataclass(frozen=True, slots=True)
class _Line:
    """A line of an operator's file: its number, the action, and the amount of work after which to perform it."""

    number: int
    at: int | None
    action: Action


class Operator:
    """An operator who presses START at every halt and types the lines of ``keyboard``.

    A subclass sets ``present`` to True if its operator can type another line in place of an invalid one, and must see
    each line of the typewriter at once (see ``retypes`` and ``by_lines`` of :class:`emulator.machine.session.Session`).
    """

    present = False

    def __init__(self, keyboard: Iterable[str] = ()) -> None:
        self._keyboard = iter(keyboard)

    def happened(self, events: Sequence[Event]) -> None:
        """Tell the operator what the devices did, as a sequence of events in order."""

    def attend(self, session: Session) -> Iterator[Action]:
        """Yield the operator's actions while the machine runs.

        The machine calls this method at the start and after each slice of the run.
        """
        return iter(())

    def goal(self, session: Session) -> int:
        """Return the amount of work (as counted by ``--limit``) after which :meth:`attend` is to be called again."""
        return session.state.work + SLICE

    def answer(self, session: Session, halt: Halt) -> Action:
        """Return the operator's next action for a halted machine.  The caller repeats the call until the machine runs.

        Raise DeckError if an ACCEPT needs a typed line and no line of ``keyboard`` is left.
        """
        if halt.what == "accept":
            line = next(self._keyboard, None)
            if line is None:
                raise DeckError(f"{session.program.source}: no typed line is left for ACCEPT in {halt.line.name}")
            return Action("ENTER", text=line)
        return Action("START", unasked=True)


@dataclass(frozen=True, slots=True)
class Load:
    """The lines of an operator's file for one machine, with the names of its program and deck if they are stated."""

    program: str
    deck: str
    lines: deque[_Line]


# As the deck of a LOAD, this word stands for the cards that the previous machine punched.
PUNCHED = "PUNCHED"


def read_loads(name: str, text: str) -> tuple[list[Load], dict[str, str]]:
    """Return the parts of an operator's file, one for each machine, and the file's decks as a dict from name to text.

    ``LOAD`` with the names of a program and a deck begins the lines of a machine.  ``CARDS`` with a name begins a deck,
    and each ``CARD`` line holds one of its cards.  Raise FileError if the file is invalid.
    """
    loads = [Load("", "", deque())]
    decks: dict[str, str] = {}
    source = ""
    for number, line in enumerate(text.splitlines(), 1):
        word, _, rest = line.partition(" ")
        if word == "LOAD":
            program, _, deck = rest.strip().partition(" ")
            if loads == [Load("", "", deque())]:
                loads.clear()
            loads.append(Load(program, deck.strip(), deque()))
        elif word == "CARDS" and rest.strip():
            source = rest.strip()
            decks[source] = ""
        elif word == "CARD" and source:
            decks[source] += rest + "\n"
        elif line.strip() and not line.startswith("*"):
            try:
                loads[-1].lines.append(_Line(number, *read_action(line)))
            except ValueError as error:
                raise FileError(f"{name}: line {number}: {error}") from None
    return loads, decks


class FromFile(Operator):
    """An operator whose actions are the lines of a file, which :func:`read_loads` describes.

    After the last line, and at a PAUSE for which the file has no START, START is pressed automatically.  During the
    run, raise OperatorError for an action that does not fit the state of the machine, with file and line.
    """

    present = True

    def __init__(self, name: str, text: str) -> None:
        super().__init__()
        self.name = name
        self.loads, self.decks = read_loads(name, text)
        self._parts = [load.lines for load in self.loads]
        self._lines = self._parts.pop(0)
        self._heading = True
        self._session: Session | None = None
        self._passed = 0

    @property
    def first_unused(self) -> int:
        """The number of the first line of the file that was not used, or 0 if all were."""
        return self._passed or next((part[0].number for part in (self._lines, *self._parts) if part), 0)

    def attend(self, session: Session) -> Iterator[Action]:
        """Yield the actions of the file that are due now.  Before the run, these are the settings at the file's top."""
        if session is not self._session:
            # The next machine: continue with the lines after the next LOAD.
            if self._session is not None and self._parts:
                self._passed = self._passed or (self._lines[0].number if self._lines else 0)
                self._lines, self._heading = self._parts.pop(0), True
            self._session = session
        # A line without AT waits for the next halt, and a line with AT for its amount of work.
        while self._lines:
            at, action = self._lines[0].at, self._lines[0].action
            self._heading = self._heading and at is None and action.word in _SETTING
            if not self._heading and (at is None or at > session.state.work):
                return
            yield self._next_action(session)

    def goal(self, session: Session) -> int:
        at = self._lines[0].at if self._lines else None
        return super().goal(session) if at is None else min(at, super().goal(session))

    def answer(self, session: Session, halt: Halt) -> Action:
        if not self._lines:
            if halt.trouble:
                raise DeckError(halt.trouble)
            return super().answer(session, halt)
        line = self._lines[0]
        # If the next line belongs to a later moment or to an ACCEPT, it cannot answer a PAUSE: START is pressed
        # automatically.
        if halt.what == "pause" and (line.at is not None or line.action.word == "ENTER"):
            return super().answer(session, halt)
        wrong = ("START", "ATTN") if halt.what == "accept" else ("ENTER", "ATTN")
        if line.at is not None or line.action.word in wrong:
            action_text = action_line(line.action, line.at)
            raise OperatorError(
                f"{self.name}: line {line.number}: found {action_text}, which does not fit the halt: {halt_line(halt)}"
            )
        return self._next_action(session)

    def _next_action(self, session: Session) -> Action:
        line = self._lines.popleft()
        if misfit := session.misfit(line.action):
            raise OperatorError(f"{self.name}: line {line.number}: {misfit}")
        return line.action


class Logged(Operator):
    """An operator whose actions are logged to a file, with the events of the machine as comments.

    With the same program and deck, :class:`FromFile` repeats the run from the log and produces the same log.
    ``deck_name`` is by default the session's name of the deck.  The LOAD line contains this name, unless there is a
    blank in the name.
    """

    def __init__(self, operator: Operator, file: TextIO, deck_name: str | None = None) -> None:
        super().__init__()
        self.present = operator.present
        self._operator, self._file, self._deck_name = operator, file, deck_name
        self._session: Session | None = None
        self._halt: Halt | None = None

    def happened(self, events: Sequence[Event]) -> None:
        for event in events:
            if event.what in ("read", "punch", "type"):
                self._write(f"* {event.what:<6}{event.text}")
        self._operator.happened(events)

    def attend(self, session: Session) -> Iterator[Action]:
        if session is not self._session:
            self._session = session
            name = session.deck.source if self._deck_name is None else self._deck_name
            self._write(f"LOAD {session.program.source} {name if session.deck.cards and ' ' not in name else ''}")
        for action in self._operator.attend(session):
            self._write(action_line(action, session.state.work))
            yield action

    def goal(self, session: Session) -> int:
        return self._operator.goal(session)

    def answer(self, session: Session, halt: Halt) -> Action:
        # A halt may need several actions, for example SWITCH and then START, but it is logged once.
        if halt is not self._halt:
            self._halt = halt
            self._write(f"* {halt_line(halt)}")
        action = self._operator.answer(session, halt)
        self._write(action_line(action))
        return action

    def _write(self, line: str) -> None:
        self._file.write(line.rstrip() + "\n")

"""The operator of a run: one object with the same questions for everybody.

Whoever it is sees what the devices do and answers every halt: :class:`Operator` is nobody, who presses START and types
the lines that lie ready; :class:`FromFile` takes his answers from a file; a person sits at a terminal
(modern/cli/shared/terminal.py).  :class:`Logged` writes down what any of them does, as a file that can be read again.
The words of such a file are in emulator/machine/words.py.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TextIO

from emulator.errors import DeckError, FileError, OperatorError
from emulator.machine.result import Event
from emulator.machine.session import Action, Halt, Session
from emulator.machine.words import read_action, standing, words_of

_SETTING = ("SWITCH", "BREAK", "CLEAR", "STEP")

SLICE = 20_000
"""How much work is done before the operator sees what happened: some hundredths of a second."""

Output = Callable[[Sequence[Event]], None]
"""Takes what the devices did, in order."""


@dataclass(frozen=True, slots=True)
class _Line:
    """A line of an operator's file: its number, the work before it, and the action."""

    number: int
    at: int | None
    action: Action


class Operator:
    """Presses START and types the lines of ``keyboard``; a line that is missing is an error.

    ``present``: somebody sits there, who can type a bad line again and sees each line as it is typed
    (:class:`emulator.machine.session.Session`).
    """

    present = False

    def __init__(self, keyboard: Iterable[str] = ()) -> None:
        self._keyboard = iter(keyboard)

    def happened(self, events: Sequence[Event]) -> None:
        """See what the devices did, in order."""

    def attend(self, session: Session) -> Iterator[Action]:
        """What is done to a machine that runs, before its first slice and after each."""
        return iter(())

    def goal(self, session: Session) -> int:
        """How much work may be done before the operator is asked again."""
        return session.state.work + SLICE

    def answer(self, session: Session, halt: Halt) -> Action:
        """What is done about a halt; asked again while the machine stands.  Raises DeckError for a missing line."""
        if halt.what == "accept":
            line = next(self._keyboard, None)
            if line is None:
                raise DeckError(f"{session.program.source}: nothing is typed for ACCEPT in {halt.line.name}")
            return Action("ENTER", text=line)
        return Action("START", unasked=True)


class FromFile(Operator):
    """Answers from the lines of a file; after its last line he is nobody, and at a PAUSE for which it has no START.

    ``LOAD`` begins the lines for the next machine, where several run one after the other.  Raises FileError for wrong
    words, and during the run OperatorError for an action that does not fit; both name file and line.
    """

    present = True

    def __init__(self, name: str, text: str) -> None:
        super().__init__()
        self.name = name
        self._parts: list[deque[_Line]] = [deque()]
        for number, line in enumerate(text.splitlines(), 1):
            if line.split(maxsplit=1)[:1] == ["LOAD"]:
                if self._parts != [deque()]:
                    self._parts.append(deque())
            elif line.strip() and not line.startswith("*"):
                try:
                    self._parts[-1].append(_Line(number, *read_action(line)))
                except ValueError as error:
                    raise FileError(f"{name}: line {number}: {error}") from None
        self._lines = self._parts.pop(0)
        self._heading = True
        self._session: Session | None = None
        self._passed = 0

    @property
    def left(self) -> int:
        """The number of the first line that was not used, 0 where all were."""
        return self._passed or next((part[0].number for part in (self._lines, *self._parts) if part), 0)

    def attend(self, session: Session) -> Iterator[Action]:
        """What the file says to do now; lines at its head that set the machine are done before the run."""
        if session is not self._session:
            if self._session is not None and self._parts:
                self._passed = self._passed or (self._lines[0].number if self._lines else 0)
                self._lines, self._heading = self._parts.pop(0), True
            self._session = session
        while self._lines:
            at, action = self._lines[0].at, self._lines[0].action
            self._heading = self._heading and at is None and action.word in _SETTING
            if not self._heading and (at is None or at > session.state.work):
                return
            yield self._took(session)

    def goal(self, session: Session) -> int:
        at = self._lines[0].at if self._lines else None
        return super().goal(session) if at is None else min(at, super().goal(session))

    def answer(self, session: Session, halt: Halt) -> Action:
        if not self._lines:
            if halt.trouble:
                raise DeckError(halt.trouble)
            return super().answer(session, halt)
        line = self._lines[0]
        if halt.what == "pause" and (line.at is not None or line.action.word == "ENTER"):
            return super().answer(session, halt)
        wrong = ("START", "ATTN") if halt.what == "accept" else ("ENTER", "ATTN")
        if line.at is not None or line.action.word in wrong:
            said = words_of(line.action, line.at)
            raise OperatorError(f"{self.name}: line {line.number}: {said}, but {standing(halt)}")
        return self._took(session)

    def _took(self, session: Session) -> Action:
        line = self._lines.popleft()
        if line.action.word in ("BREAK", "CLEAR") and line.action.number and not session.places(line.action):
            raise OperatorError(f"{self.name}: line {line.number}: {session.program.source} has nothing to run there")
        return line.action


class Logged(Operator):
    """Another operator, and a file that gets a line for everything he does; what the machine does are comments.

    Read again by :class:`FromFile` with the same program and deck, the log gives the same run and the same log.
    """

    def __init__(self, operator: Operator, file: TextIO) -> None:
        super().__init__()
        self.present = operator.present
        self._operator, self._file = operator, file
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
            self._write(f"LOAD {session.program.source}")
        for action in self._operator.attend(session):
            self._write(words_of(action, session.state.work))
            yield action

    def goal(self, session: Session) -> int:
        return self._operator.goal(session)

    def answer(self, session: Session, halt: Halt) -> Action:
        if halt is not self._halt:
            self._halt = halt
            self._write(f"* {standing(halt)}")
        action = self._operator.answer(session, halt)
        self._write(words_of(action))
        return action

    def _write(self, line: str) -> None:
        self._file.write(line.rstrip() + "\n")

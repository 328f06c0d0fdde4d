"""The operator of a run: one object with the same questions for everybody.

Whoever it is (nobody, a file, a person at a terminal) sees what the devices do and answers every halt.  The one here is
nobody: he presses START and types the lines that lie ready.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence

from emulator.errors import DeckError
from emulator.machine.endings import Ending, Notice
from emulator.machine.result import Event
from emulator.machine.session import Action, Halt, Session

SLICE = 20_000
"""How much work is done before the operator sees what happened: some hundredths of a second."""

Output = Callable[[Sequence[Event]], None]
"""Takes what the devices did, in order."""


class Operator:
    """Presses START and types the lines of ``keyboard``; a line that is missing is an error.

    ``retypes`` is as of :class:`emulator.machine.session.Session`.
    """

    retypes = False

    def __init__(self, keyboard: Iterable[str] = ()) -> None:
        self._keys = iter(keyboard)

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
            line = next(self._keys, None)
            if line is None:
                raise DeckError(f"{session.program.source}: nothing is typed for ACCEPT in {halt.line.name}")
            return Action("ENTER", text=line)
        if halt.what == "pause":
            session.devices.note(Notice("pause", session.program.source, halt.line))
        return Action("START")


def operated(
    session: Session, operator: Operator, goal: int | None = None, output: Output | None = None
) -> Ending | None:
    """Run a session on until ``goal`` (None: to its end) with an operator; how it ended, None where it has not.

    ``output`` is handed every event before the operator sees it.  Raises what
    :meth:`emulator.machine.session.Session.advance` and the operator raise; what was done until then is handed out.
    """
    goal = session.options.limit if goal is None else goal
    session.retypes = operator.retypes
    while True:
        for action in operator.attend(session):
            session.act(action)
        try:
            found = session.advance(min(goal, operator.goal(session)))
        finally:
            events = session.take()
            if output is not None:
                output(events)
            operator.happened(events)
        if isinstance(found, Halt):
            session.act(operator.answer(session, found))
        elif found is not None or session.state.work >= goal:
            return found

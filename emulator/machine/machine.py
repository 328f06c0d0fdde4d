"""A 1620 with its operator: a session run to its end.

Any number of machines exist side by side; each holds everything its run needs.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from emulator.machine.endings import Ending
from emulator.machine.operator import Operator, Output
from emulator.machine.result import Result
from emulator.machine.session import Halt, Session


@dataclass
class Machine(Session):
    """One machine with one program in core, one deck in the hopper, and somebody at its console.

    ``keyboard`` are the lines typed when the program asks by ACCEPT, by the operator who does nothing else than press
    START.  Raises DeckError when the program does not fit the machine's core.
    """

    keyboard: Iterable[str] = ()

    def run(self, operator: Operator | None = None, output: Output | None = None, keep: bool = False) -> Result:
        """Run to an ending, with the operator of ``keyboard`` or another.

        With ``output`` events are handed there as they come, and the result does not hold them but with ``keep``: a
        run then takes no more memory the more it puts out.  Raises CardError for a card whose field is not a number,
        DeckError for a hopper empty in the middle of a data set or from the start, and what the operator raises.
        """
        self.keep = keep or output is None
        ending = operated(self, operator or Operator(self.keyboard), output=output)
        assert ending is not None, "a run has an end"
        return self.result(ending)


def operated(
    session: Session, operator: Operator, goal: int | None = None, output: Output | None = None
) -> Ending | None:
    """Run a session on until ``goal`` (None: to its end) with an operator; how it ended, None where it has not.

    ``output`` is handed every event before the operator sees it.  Raises what
    :meth:`emulator.machine.session.Session.advance` and the operator raise; what was done until then is handed out.
    """
    last = session.options.limit if goal is None else goal
    session.retypes = session.by_lines = operator.present
    while True:
        if session.halt is None:
            for action in operator.attend(session):
                session.act(action)
        try:
            found = session.advance(min(last, operator.goal(session)))
        finally:
            events = session.take()
            if output is not None:
                output(events)
            operator.happened(events)
        if isinstance(found, Halt):
            session.act(operator.answer(session, found))
        elif found is not None or (goal is not None and session.state.work >= goal):
            return found

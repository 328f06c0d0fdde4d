"""Run a program on a 1620 with its operator, from the first statement to the end.

Machines share no state, so any number of them can exist at the same time.
"""

from collections.abc import Iterable
from dataclasses import dataclass

from emulator.machine.endings import Ending
from emulator.machine.operator import Operator, Output
from emulator.machine.result import Result
from emulator.machine.session import Halt, Session


@dataclass
class Machine(Session):
    """A machine with a program in core storage, a deck in the card reader's hopper, and an operator.

    If nobody sits at the console, ``keyboard`` supplies the lines for ACCEPT, and START is pressed at every other halt.
    Raise DeckError if the program does not fit the machine's core storage.
    """

    keyboard: Iterable[str] = ()

    def run(self, operator: Operator | None = None, output: Output | None = None, keep: bool = False) -> Result:
        """Run the program to its end.

        Parameters
        ----------
        operator
            The operator; by default one who types the lines of ``keyboard``.
        output
            A function that receives the events as they occur.  The result then holds events only if ``keep`` is set,
            so that memory does not grow with the output.

        Raises
        ------
        CardError
            If a field of a card does not hold a number.
        DeckError
            If the hopper is empty at the first READ or in the middle of a data set.
        OperatorError
            If an action of the operator does not fit the state of the machine.
        """
        self.keep = keep or output is None
        ending = run_with_operator(self, operator or Operator(self.keyboard), output=output)
        assert ending is not None, "a run without a goal ends"
        return self.result(ending)


def run_with_operator(
    session: Session, operator: Operator, goal: int | None = None, output: Output | None = None
) -> Ending | None:
    """Run a session with an operator until ``goal`` units of work are done, or to its end if ``goal`` is None.

    Return the ending, or None if the run has not ended.  ``output`` receives every event before the operator does.
    Raise the errors of :meth:`emulator.machine.session.Session.advance` and of the operator.  ``output`` has received
    all events that precede the error.
    """
    last = session.options.limit if goal is None else goal
    session.retypes = session.by_lines = operator.present
    while True:
        # The operator may act on a running machine between two slices; a halted machine waits for an answer.
        if session.halt is None:
            for action in operator.attend(session):
                session.act(action)
        try:
            outcome = session.advance(min(last, operator.goal(session)))
        finally:
            events = session.take()
            if output is not None:
                output(events)
            operator.happened(events)
        if isinstance(outcome, Halt):
            session.act(operator.answer(session, outcome))
        elif outcome is not None or (goal is not None and session.state.work >= goal):
            return outcome

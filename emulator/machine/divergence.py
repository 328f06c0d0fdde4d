"""Compare runs of a program in two arithmetics: find the first value and the first decision that differ.

Both runs read the same deck.  As long as every decision (IF, computed GO TO, the end of a DO) has the same outcome in
both runs, the runs execute the same statements, and the values that they store can be compared.  After a decision with
different outcomes the runs have diverged.  The comparison continues at the first statement that lies on every path from
either branch (emulator/machine/postdominators.py).  The comparison ends if there is no such statement, or if one of the
runs ends before reaching it.

Lost digits are counted only up to the first decision that differs.  After that decision a value may differ because the
program chose another point, although no digit was lost.  A value with the relative difference r from the reference has
lost ``P + log10(r)`` digits, at least 0 and at most P, where P is the number of digits of the less precise arithmetic.

A reference that rounds is itself inexact.  Its run computes an error bound for every number, which
emulator/numbers/shadowed.py derives.  A difference within the bound is counted as ``within`` and not as a difference.
If an IF has different outcomes, the comparison looks at the value that the IF tests in the reference run.  If this
value is no farther from zero than its error bound, the reference cannot tell which outcome is right, and the comparison
ends at this IF.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

from emulator.errors import EmulatorError, expect
from emulator.language.cards import Deck
from emulator.language.control_flow import successors
from emulator.language.objectcode import Program
from emulator.machine.comparison import Comparison, Decision, Difference, Loss
from emulator.machine.endings import Ending
from emulator.machine.machine import run_with_operator
from emulator.machine.operator import Operator
from emulator.machine.postdominators import meeting, post_dominators
from emulator.machine.result import Event, Options, Uncut, statements_begun
from emulator.machine.session import Session
from emulator.machine.state import Entry, Journal
from emulator.numbers import Numbers
from emulator.numbers.shadowed import ShadowedNumbers

# The units of work after which the comparison switches from one run to the other.
_STRIDE = 1_000


@dataclass(frozen=True, slots=True)
class Divergence:
    """The comparison of two runs.

    In each pair, the first element belongs to the studied arithmetic and the second to the reference.

    Attributes
    ----------
    digits
        The number of digits of the less precise arithmetic.
    compared, tested
        The numbers of values and decisions compared.
    values, decisions
        The numbers of values and decisions that differ.
    values_in_step
        The number of values that differ before the first decision that differs.
    within
        The number of values whose difference is no larger than the reference's own rounding error.
    apart
        The reason why the comparison ended early, or "" if both runs were compared to their ends.
    endings
        The ending of each run, or None for a run that the comparison stopped before its end.
    typed
        The last line that each run typed, or "".
    """

    program: str
    deck: str
    arithmetics: tuple[str, str]
    digits: float
    first_value: Difference | None
    first_decision: Decision | None
    compared: int
    tested: int
    values: int
    values_in_step: int
    within: int
    decisions: int
    statements: tuple[int, int]
    apart: str
    endings: tuple[Ending | None, Ending | None]
    typed: tuple[str, str]
    losses: tuple[Loss, ...]

    @property
    def outcomes(self) -> tuple[str, ...]:
        """One line that says how both runs ended, or one line for each run if they ended differently.

        An ending whose message is part of ``apart`` is omitted.
        """
        first, second = (
            ending
            and not (ending.message and ending.message in self.apart)
            and ending.outcome + (f", after typing {line!r}" if line else "")
            for ending, line in zip(self.endings, self.typed, strict=True)
        )
        if first and first == second:
            return (f"both runs ended: {first}",)
        pairs = zip(self.arithmetics, (first, second), strict=True)
        return tuple(f"{name} ended: {outcome}" for name, outcome in pairs if outcome)


def diverge(
    program: Program,
    deck: Deck,
    studied: Numbers,
    reference: Numbers,
    options: Options | None = None,
    *,
    values: bool = True,
    rounding: bool = True,
    operator: Callable[[], Operator] = Operator,
    reference_deck: Deck | None = None,
    uncut: tuple[Sequence[Sequence[Uncut]], Sequence[Sequence[Uncut]]] = ((), ()),
) -> Divergence:
    """Run a program in two arithmetics and compare the runs.

    Parameters
    ----------
    options
        The options of both runs.  Their arithmetic is not used: ``studied`` and ``reference`` replace it.
    values
        Compare values as well as decisions.  If False, the comparison ends at the first decision that differs, which is
        fast enough for studies of many decks.
    rounding
        Do not count differences that the reference's own rounding may explain.
    operator
        A function that returns an operator for each run.
    reference_deck
        The deck of the reference run, if it differs from that of the studied run.
    uncut
        For each run, the numbers that it reads instead of columns of its cards (see :class:`Session`).

    Raises
    ------
    CardError, DeckError
        If both runs find the same error in the deck, or if the program does not fit the machine.
    """
    for value, kind, name in (
        (program, Program, "program"),
        (deck, Deck, "deck"),
        (studied, Numbers, "studied"),
        (reference, Numbers, "reference"),
        (options, (Options, type(None)), "options"),
    ):
        expect(value, kind, name)
    options = options or Options()
    # An exact reference has no rounding errors.  Any other reference computes bounds of its errors during the run.
    if rounding and math.isfinite(reference.digits):
        reference = ShadowedNumbers(reference)
    sides = zip((studied, reference), (deck, reference_deck or deck), uncut, strict=True)
    runs = [
        JournaledRun(program, cards, replace(options, numbers=n), values, operator(), more) for n, cards, more in sides
    ]
    comparison = Comparison(program, studied, reference)
    apart = ""
    first, second = iter(runs[0].entries()), iter(runs[1].entries())
    dominators: list[int] = []
    while True:
        entry, reference_entry = next(first, None), next(second, None)
        if entry is None or reference_entry is None:
            # If both runs found the same error in the deck, there is nothing to compare.
            if entry is reference_entry and not comparison.decisions and runs[0].error and runs[1].error:
                raise runs[0].error
            apart = _ended(runs, entry, reference_entry)
            break
        assert entry[0] == reference_entry[0], "runs in step are at the same instruction"
        if not comparison.differs(entry, reference_entry):
            continue
        if comparison.uncertain:
            apart = comparison.uncertain
            break
        # If values are not compared, only the first decision that differs is of interest.
        if not values:
            break
        # The decision differs: skip both runs to the instruction where their branches join.
        dominators = dominators or post_dominators(successors(program))
        junction = meeting(dominators, entry[1], reference_entry[1])
        if junction < 0 or not (_reached(first, junction) and _reached(second, junction)):
            apart = "the two runs took different branches, which do not join again"
            break
    return Divergence(
        program=program.source,
        deck=deck.source,
        arithmetics=(studied.name, reference.name),
        digits=comparison.digits,
        first_value=comparison.first_value,
        first_decision=comparison.first_decision,
        compared=comparison.compared,
        tested=comparison.tested,
        values=comparison.values,
        values_in_step=comparison.values_in_step,
        within=comparison.within,
        decisions=comparison.decisions,
        statements=(runs[0].statements, runs[1].statements),
        apart=apart,
        endings=(runs[0].ending, runs[1].ending),
        typed=(runs[0].typed, runs[1].typed),
        losses=comparison.losses(),
    )


class JournaledRun:
    """A run with a journal of its decisions and of the values that it stores."""

    def __init__(
        self,
        program: Program,
        deck: Deck,
        options: Options,
        values: bool,
        operator: Operator,
        uncut: Sequence[Sequence[Uncut]],
    ) -> None:
        self.name = options.numbers.name
        self._journal = Journal(values)
        self.session = Session(program, deck, options, journal=self._journal, uncut=uncut, keep=False)
        self._operator = operator
        self._program, self._limit = program, options.limit
        self.typed = ""
        # The records printed so far, except those of events that the session still holds.
        self._records: list[str] = []
        self.ending: Ending | None = None
        self.error: EmulatorError | None = None

    @property
    def statements(self) -> int:
        return statements_begun(self._program, self.session.state.counts)

    @property
    def records(self) -> list[str]:
        """The cards punched and lines typed so far, in order."""
        return self._records + _printed(self.session.devices.events)

    @property
    def record(self) -> int:
        """The number, from 1, of the next card or line that the run will print."""
        return len(self._records) + len(_printed(self.session.devices.events)) + 1

    def entries(self) -> Iterator[Entry]:
        """Advance the run, and yield the entries of its journal (decisions and stores) as they are recorded."""
        goal = 0
        while self.ending is None:
            goal = min(goal + _STRIDE, self._limit)
            try:
                self.ending = run_with_operator(self.session, self._operator, goal, self._watch)
            except EmulatorError as error:
                self.error, self.ending = error, Ending("input", trouble=str(error))
            if self.ending is not None and self.ending.kind == "limit":
                # The statements of the last loop are removed, so that the endings of two runs at the limit are equal.
                self.ending = Ending("limit", count=self._limit)
            yield from self._journal.entries
            self._journal.entries.clear()

    def _watch(self, events: Sequence[Event]) -> None:
        self._records += _printed(events)
        self.typed = next((event.text for event in reversed(events) if event.what == "type"), self.typed)


def _printed(events: Sequence[Event]) -> list[str]:
    return [event.text for event in events if event.what in ("punch", "type")]


def _reached(entries: Iterator[Entry], junction: int) -> bool:
    """Advance a run to the instruction ``junction``.  Return False if the run ends before this instruction."""
    return any(entry[0] == junction for entry in entries)


def _ended(runs: list[JournaledRun], entry: Entry | None, reference_entry: Entry | None) -> str:
    """Describe the endings of the runs whose journals have no further entry, or return "" if both endings are equal."""
    if entry is None and reference_entry is None and runs[0].ending == runs[1].ending:
        return ""
    stopped = [run for run, last in zip(runs, (entry, reference_entry), strict=True) if last is None]
    texts = [f"{run.name} ended: {run.ending.message or run.ending.kind}" for run in stopped if run.ending]
    # Exact arithmetic cannot hold a number such as EXP(1.), but long binary numbers approximate it closely.
    if any(run.name == "exact" and run.ending and run.ending.kind == "undecided" for run in stopped):
        texts.append("--against mp:200 compares with 200 bits instead")
    return "; ".join(texts)

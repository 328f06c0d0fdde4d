"""Two arithmetics in step through one program: where the first value differs, and where the first decision does.

Both runs read the same deck.  While every decision (IF, computed GO TO, the end of a DO) goes the same way in
both, statement meets statement and what they store can be compared.  After a decision that goes two ways the
runs are apart until both come to the first statement that every path from either way must come to
(emulator/machine/postdominators.py); from there they are compared again.  Where there is no such statement, or one
run ends before it, the comparison ends.

Digits lost are counted up to the first differing decision only: after it a value may differ because another
point was taken, and no digit was lost.  A value that agrees with the reference to a relative difference r
has lost ``P + log10(r)`` of the P digits the poorer of the two arithmetics carries, at least 0 and at most P.

A reference that rounds is itself some way from the exact number.  How far it is at most its run tells beside every
number (emulator/numbers/shadowed.py, where the bound is derived).  A value that differs by no more is counted as
``within``, not as one that differs.  Where an IF goes two ways and the reference's value is no farther from zero than
its bound, the reference does not tell which way is right, and the comparison ends there.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from fractions import Fraction

from emulator.errors import EmulatorError
from emulator.language import objectcode as op
from emulator.language.cards import Deck
from emulator.language.objectcode import Line, Program
from emulator.machine.endings import Ending
from emulator.machine.machine import operated
from emulator.machine.operator import Operator
from emulator.machine.postdominators import meeting, post_dominators, successors
from emulator.machine.result import Options, begun
from emulator.machine.session import Session
from emulator.machine.state import Entry, Journal
from emulator.numbers import Numbers
from emulator.numbers.base import Number
from emulator.numbers.exact import ExactNumbers
from emulator.numbers.shadowed import Shadowed, ShadowedNumbers

_STRIDE = 1_000
"""Statements one run does before the other takes its turn."""

_DECISIONS = (op.IF, op.IFX, op.SELECT, op.DOTEST)


@dataclass(frozen=True, slots=True)
class Difference:
    """A value that differs: the statement, which time it was run, the variable in each run, both values as text.

    ``relative`` is the difference divided by the reference's value, None where that is zero or not a number.
    ``bound`` is how far the reference's value may be from the exact one, 0 where nothing was rounded.
    """

    line: Line
    time: int
    names: tuple[str, str]
    values: tuple[str, str]
    relative: float | None
    bound: Fraction = Fraction(0)


@dataclass(frozen=True, slots=True)
class Decision:
    """A decision that differs: the statement, which time it was run, both values, and where each run goes."""

    line: Line
    time: int
    values: tuple[str, str]
    targets: tuple[Line | None, Line | None]


@dataclass(frozen=True, slots=True)
class Loss:
    """What one statement stored, up to the first differing decision.

    ``times`` values were compared, of which ``differing`` differ; ``worst`` and ``median`` are decimal digits lost.
    """

    line: Line
    times: int
    differing: int
    worst: float
    median: float


@dataclass(frozen=True, slots=True)
class Divergence:
    """Two runs compared.  The first of each pair is the arithmetic studied, the second the reference.

    ``compared`` and ``tested`` count the values and decisions compared, ``values`` and ``decisions`` those that
    differ, ``values_in_step`` those of them before the first differing decision, ``within`` the values besides that
    differ by no more than the reference's own rounding.  ``apart`` says why the
    comparison ended early, and is empty where both runs were compared to their endings.  Without values asked
    for, everything about them is empty and the runs stop at the first differing decision; ``endings`` are None
    for a run that was not run to its end.
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
    losses: tuple[Loss, ...]


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
) -> Divergence:
    """Run a program over two arithmetics in step; ``options`` without their profile and numbers.

    Without ``values`` only decisions are compared, and only up to the first that differs: the way for studies of
    many decks.  ``rounding``: what the reference's own rounding may explain is no difference; without it every
    difference counts, whichever of the two is the reference.  ``operator`` gives each run its own.  Raises CardError
    and DeckError where both runs find the same fault in the deck, DeckError where the program does not fit the machine.
    """
    options = options or Options()
    if rounding and math.isfinite(reference.digits):
        reference = ShadowedNumbers(reference)
    runs = [_Run(program, deck, replace(options, numbers=n), values, operator()) for n in (studied, reference)]
    comparison = _Comparison(program, studied, reference)
    apart = ""
    first, second = iter(runs[0].entries()), iter(runs[1].entries())
    parents: list[int] = []
    while True:
        mine, other = next(first, None), next(second, None)
        if mine is None or other is None:
            if mine is None and other is None and not comparison.decisions:
                _refuse(runs)
            apart = _ended(runs, mine, other)
            break
        assert mine[0] == other[0], "runs in step are at the same instruction"
        if not comparison.differs(mine, other):
            continue
        if comparison.untold:
            apart = comparison.untold
            break
        if not values:
            break
        parents = parents or post_dominators(successors(program))
        place = meeting(parents, mine[1], other[1])
        if place < 0 or not (_reached(first, place) and _reached(second, place)):
            apart = "the ways do not meet again"
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
        losses=comparison.losses(),
    )


class _Run:
    """One of the two runs, some statements at a time."""

    def __init__(self, program: Program, deck: Deck, options: Options, values: bool, operator: Operator) -> None:
        self.name = options.numbers.name
        self._journal = Journal(values)
        self._session = Session(program, deck, options, journal=self._journal, keep=False)
        self._operator = operator
        self._program, self._limit = program, options.limit
        self.ending: Ending | None = None
        self.error: EmulatorError | None = None

    @property
    def statements(self) -> int:
        return begun(self._program, self._session.state.counts)

    def entries(self) -> Iterator[Entry]:
        """The journal's entries, as the run goes on."""
        goal = 0
        while self.ending is None:
            goal = min(goal + _STRIDE, self._limit)
            try:
                self.ending = operated(self._session, self._operator, goal)
            except EmulatorError as error:
                self.error, self.ending = error, Ending("input", trouble=str(error))
            if self.ending is not None and self.ending.kind == "limit":
                # Where each was in its loop is no difference.
                self.ending = Ending("limit", count=self._limit)
            yield from self._journal.entries
            self._journal.entries.clear()


def _reached(entries: Iterator[Entry], place: int) -> bool:
    """Go on to the statement at ``place``; whether the run comes there."""
    return any(entry[0] == place for entry in entries)


def _refuse(runs: list[_Run]) -> None:
    """Raise what both runs, in step, have found wrong with the deck."""
    first, second = (run.error for run in runs)
    if first is not None and second is not None:
        raise first


def _ended(runs: list[_Run], mine: Entry | None, other: Entry | None) -> str:
    """Why a comparison ended that one run or both did not go on with; empty where both ended alike."""
    if mine is None and other is None and runs[0].ending == runs[1].ending:
        return ""
    stopped = [run for run, entry in zip(runs, (mine, other), strict=True) if entry is None]
    return "; ".join(f"{run.name} ended: {run.ending.message or run.ending.kind}" for run in stopped if run.ending)


@dataclass
class _Tally:
    """What one statement stored: how often, and how often with how many tenths of a digit lost."""

    times: int = 0
    differing: int = 0
    tenths: Counter[int] = field(default_factory=Counter)


class _Comparison:
    """What was found so far."""

    def __init__(self, program: Program, studied: Numbers, reference: Numbers) -> None:
        self._program, self._studied, self._reference = program, studied, reference
        self._statement_of = program.statement_numbers
        self._decides = [i.operation in _DECISIONS for i in program.code]
        self._counts = [i.operation == op.COUNT for i in program.code]
        self._times: Counter[tuple[int, int]] = Counter()
        self._whole = [op.repeats(i) > 1 for i in program.code]
        self._tallies: dict[int, _Tally] = {}
        poorer = min(studied.digits, reference.digits)
        self.digits = poorer if math.isfinite(poorer) else 0.0
        self._exactly = 2 * int(self.digits) + 20
        self.first_value: Difference | None = None
        self.first_decision: Decision | None = None
        self.compared = self.tested = self.values = self.values_in_step = self.within = self.decisions = 0
        self.untold = ""

    def differs(self, mine: Entry, other: Entry) -> bool:
        """Enter what both did; whether it is a decision that differs."""
        pc = mine[0]
        if self._counts[pc]:
            return False
        # Each element of an array that is read whole is counted by itself.
        place = pc, mine[1] if self._whole[pc] else 0
        self._times[place] += 1
        if not self._decides[pc]:
            self._store(mine, other, self._times[place])
            return False
        self.tested += 1
        if mine[1] == other[1]:
            return False
        bound, value = self._bound(other[2]), self._value(self._reference, other[2])
        if bound is None or (bound and (value is None or abs(Fraction(value)) <= bound)):
            self.untold = self._untold(pc, other[2], bound)
            return True
        self.decisions += 1
        if self.first_decision is None:
            self.first_decision = Decision(
                self._line(pc),
                self._times[place],
                self._texts(mine[2], other[2], tested=True),
                (self._target(mine[1]), self._target(other[1])),
            )
        return True

    def _store(self, mine: Entry, other: Entry, time: int) -> None:
        pc = mine[0]
        self.compared += 1
        lost, relative, within = self._lost(mine, other)
        self.within += within
        if lost is not None:
            self.values += 1
            if self.first_value is None:
                name = self._program.storage.name_of
                self.first_value = Difference(
                    self._line(pc),
                    time,
                    (name(mine[1]), name(other[1])),
                    self._texts(mine[2], other[2]),
                    relative,
                    self._bound(other[2]) or Fraction(0),
                )
        if self.decisions:
            return
        tally = self._tallies.setdefault(self._statement_of[pc], _Tally())
        tally.times += 1
        if lost is not None:
            self.values_in_step += 1
            tally.differing += 1
        tally.tenths[round(10 * (lost or 0.0))] += 1

    def _bound(self, value: Number) -> Fraction | None:
        """How far the reference's value may be from the exact one; None where nothing is known, 0 of a whole number."""
        if not isinstance(value, Shadowed) or not isinstance(self._reference, ShadowedNumbers):
            return Fraction(0)
        return self._reference.error(value)

    def _untold(self, pc: int, value: Number, bound: Fraction | None) -> str:
        """Why the comparison ends at a decision that the reference does not tell."""
        card, name, text = self._line(pc).place.card, self._reference.name, self._reference.text(value)
        size = "any number" if bound is None else f"1E{math.ceil(_logarithm(bound)):+03d}"
        remedy = "a reference of more digits, or exact, tells which way is right"
        return f"at card {card} {name} has {text}, which its own rounding may have moved by {size}; {remedy}"

    def _lost(self, mine: Entry, other: Entry) -> tuple[float | None, float | None, bool]:
        """Digits lost and the relative difference, None where they are the same; and whether rounding makes them so."""
        if mine[1] == other[1]:
            x, y = self._value(self._studied, mine[2]), self._value(self._reference, other[2])
            if x is None and y is None:
                # Copies of what is undefined, infinities, no numbers: the same where they are called the same.
                if _text(self._studied, mine[2], None) == _text(self._reference, other[2], None):
                    return None, None, False
            elif x == y:
                return None, None, False
            elif x is not None and y is not None:
                bound = self._bound(other[2])
                if bound is None or abs(Fraction(x) - y) <= bound:
                    return None, None, True
            if x is not None and y:
                logarithm = _logarithm(abs(Fraction(x) - y)) - _logarithm(abs(Fraction(y)))
                relative = 10**logarithm if abs(logarithm) < 300 else None
                return min(max(self.digits + logarithm, 0.0), self.digits), relative, False
        return self.digits, None, False

    def _value(self, numbers: Numbers, value: Number) -> Fraction | int | None:
        return value if value is None or type(value) is int else numbers.exact(value, self._exactly)

    def _texts(self, mine: Number, other: Number, tested: bool = False) -> tuple[str, str]:
        """Both values for a reader, with digits enough to tell them apart; a test does not see the sign of a zero."""
        found = []
        for wide in (False, True):
            found = [
                _text(numbers, value, self._value(numbers, value) if wide else None)
                for numbers, value in ((self._studied, mine), (self._reference, other))
            ]
            if found[0] != found[1]:
                break
        first, second = ("0" if tested and text == "-0" else text for text in found)
        return first, second

    def _line(self, pc: int) -> Line:
        return self._program.statements[self._statement_of[pc]]

    def _target(self, pc: int) -> Line | None:
        """The statement gone to; None for the end of the program."""
        return self._line(pc) if pc < len(self._statement_of) else None

    def losses(self) -> tuple[Loss, ...]:
        """What each statement lost, the worst first, then in order of cards."""
        lines = self._program.statements
        found = [_loss(lines[statement], tally) for statement, tally in self._tallies.items()]
        return tuple(sorted(found, key=lambda loss: (-loss.worst, -loss.median, loss.line.place.card)))


def _loss(line: Line, tally: _Tally) -> Loss:
    lost = sorted(tally.tenths.elements())
    middle = (lost[(len(lost) - 1) // 2] + lost[len(lost) // 2]) / 2
    return Loss(line, tally.times, tally.differing, lost[-1] / 10, middle / 10)


def _logarithm(value: Fraction) -> float:
    """To base ten, of a number that a float might not hold."""
    return math.log10(value.numerator) - math.log10(value.denominator)


def _text(numbers: Numbers, value: Number, exact: Fraction | int | None) -> str:
    """A value as its arithmetic shows it, or exactly; a fixed-point value is a whole number in every arithmetic."""
    if value is None:
        return "undefined"
    if type(value) is int:
        return str(value)
    return numbers.text(value) if exact is None else ExactNumbers().text(exact)

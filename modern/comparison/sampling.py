"""Estimate significant digits of a program's values, and the stability of its decisions, from random runs.

:func:`in_step` executes N stochastic runs on one common branch (:mod:`emulator.numbers.sampled`).  It records the
estimated digits of every stored value.  At every IF, it records the number of runs that would have taken each branch.
:func:`independent` executes the runs one after the other (Monte Carlo), each with its own branches.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import zip_longest
from statistics import median

from emulator.language import objectcode as op
from emulator.language.cards import Deck
from emulator.language.objectcode import Line, Program
from emulator.machine.divergence import JournaledRun
from emulator.machine.endings import Ending
from emulator.machine.operator import Operator
from emulator.machine.result import Options
from emulator.numbers import DecimalNumbers, Numbers
from emulator.numbers.sampled import SampledNumbers, Values
from emulator.numbers.significance import Estimate, estimate
from emulator.numbers.stochastic import stochastic
from modern.comparison.sensitivity import NUMBER, shape_of


@dataclass(frozen=True, slots=True)
class StatementDigits:
    """The estimated numbers of significant digits of the values that one statement stored in the random runs.

    ``worst`` is the least number of digits of a value by Stott Parker's estimate, which counts the digits common to the
    runs, and ``median`` is the median of these numbers.  ``sure`` is the least number by Sohier's estimate, which
    counts the digits of a run that are right with probability 95 %.  ``times`` is the number of values.  ``inexact`` is
    the number of values that differ between the runs, and ``zeros`` is the number of computational zeros among these.
    """

    line: Line
    times: int
    worst: float
    median: float
    sure: float
    inexact: int
    zeros: int


@dataclass(frozen=True, slots=True)
class DecisionShares:
    """The decisions of an IF on floating-point numbers in the random runs.

    ``times`` is the number of its executions, and ``disputed`` is the number of executions at which the runs disagreed.
    ``time`` is the number of the first disputed execution, counted from 1.  ``shares`` has the numbers of runs in which
    the tested value was negative, zero and positive at this execution, and ``taken`` is the sign whose branch was
    taken.
    """

    line: Line
    times: int
    disputed: int
    time: int
    shares: tuple[int, int, int]
    taken: int


@dataclass(frozen=True, slots=True)
class Printed:
    """A printed number: the number of its card or typed line, from 1, its values in the runs, and their digits."""

    record: int
    columns: str
    values: tuple[Fraction | None, ...]
    estimate: Estimate | None


@dataclass(frozen=True, slots=True)
class Sampling:
    """The result of N random runs on common branches: statements, decisions, printed numbers, and their ending."""

    numbers: SampledNumbers
    statements: tuple[StatementDigits, ...]
    decisions: tuple[DecisionShares, ...]
    printed: tuple[Printed, ...]
    records: tuple[str, ...]
    ending: Ending | None


@dataclass
class _Votes:
    times: int = 0
    disputed: int = 0
    time: int = 0
    signs: Counter[int] = field(default_factory=Counter)
    taken: int = 0


def sampled(studied: Numbers, runs: int = 10, seed: int = 1, rules: str = "") -> SampledNumbers:
    """Return an arithmetic for several random runs in step.

    Its precision is that of ``studied``, or eight digits if ``studied`` is exact.

    ``rules`` is the end of the arithmetic's name: ``:proportional``, ``:majority``, both in this order, or nothing.
    Raise ArgumentError if a seed is out of range.
    """
    width = "8"
    if isinstance(studied, SampledNumbers):
        return studied
    if isinstance(studied, DecimalNumbers):
        width = str(studied.profile.digits)
    elif math.isfinite(studied.digits):
        width = f"{round(studied.digits / math.log10(2))}b"
    system = stochastic(f"stochastic:{width}:{seed}-{seed + runs - 1}{rules}")
    assert isinstance(system, SampledNumbers)
    return system


def in_step(
    program: Program,
    deck: Deck,
    numbers: SampledNumbers,
    options: Options | None = None,
    operator: Callable[[], Operator] = Operator,
) -> Sampling:
    """Run a program N times at once with random rounding.  At every IF, all runs take the same branch.

    Raise CardError or DeckError for an invalid deck.
    """
    written: list[tuple[int, str, Values]] = []
    sampled = replace(numbers, on_write=lambda columns, values: written.append((run.record, columns, values)))
    run = JournaledRun(program, deck, replace(options or Options(), numbers=sampled), True, operator(), ())
    estimates: dict[int, list[Estimate]] = {}
    votes: dict[int, _Votes] = {}
    for pc, _, value in run.entries():
        if not isinstance(value, tuple):
            continue
        if program.code[pc].operation == op.IF:
            branch = program.branches[program.code[pc].address]
            _vote(votes.setdefault(pc, _Votes()), numbers.signs(value), branch, numbers.sign(value))
        elif (estimated := numbers.estimate(value)) is not None:
            estimates.setdefault(program.statement_numbers[pc], []).append(estimated)
    if run.error is not None:
        raise run.error
    printed = [
        Printed(record, columns, tuple(map(_fraction, numbers.values(values))), numbers.estimate(values))
        for record, columns, values in written
    ]
    lines = program.statements
    statements = [_statement(lines[number], estimated) for number, estimated in estimates.items()]
    decisions = [_decision(program.line_at(pc), vote) for pc, vote in votes.items()]
    return Sampling(
        numbers=numbers,
        statements=tuple(sorted(statements, key=lambda row: row.line.place.card)),
        decisions=tuple(sorted(decisions, key=lambda row: row.line.place.card)),
        printed=tuple(printed),
        records=tuple(run.records),
        ending=run.ending,
    )


def _fraction(value: Fraction | int | None) -> Fraction | None:
    return None if value is None else Fraction(value)


def _vote(votes: _Votes, signs: Sequence[int], branch: Sequence[int], taken: int) -> None:
    """Count an execution of an IF. The execution is disputed if the sign in some run would select another branch."""
    votes.times += 1
    if {branch[1 + sign] for sign in signs} != {branch[1 + taken]}:
        votes.disputed += 1
        if votes.disputed == 1:
            votes.time, votes.signs, votes.taken = votes.times, Counter(signs), taken


def _statement(line: Line, estimates: Sequence[Estimate]) -> StatementDigits:
    parker, sure = [each.parker for each in estimates], min(each.sohier for each in estimates)
    inexact = [each for each in estimates if not each.is_exact]
    zeros = sum(each.is_zero for each in inexact)
    return StatementDigits(line, len(parker), min(parker), median(parker), sure, len(inexact), zeros)


def _decision(line: Line, votes: _Votes) -> DecisionShares:
    negative, zero, positive = (votes.signs[sign] for sign in (-1, 0, 1))
    return DecisionShares(line, votes.times, votes.disputed, votes.time, (negative, zero, positive), votes.taken)


@dataclass(frozen=True, slots=True)
class Independent:
    """The result of N random runs that were executed separately, each with its own branches.

    ``shares`` counts the runs that print each sequence of records, the most frequent first.  Sequences that differ only
    in the digits of printed numbers count as the same.  ``printed`` holds the numbers that the runs with the most
    frequent sequence print.  ``decisions`` compares the nth execution of an IF in all runs that reach it.
    """

    shares: tuple[int, ...]
    records: tuple[str, ...]
    printed: tuple[Printed, ...]
    decisions: tuple[DecisionShares, ...]


def independent(
    program: Program, deck: Deck, members: Sequence[Numbers], options: Options | None = None
) -> Independent:
    """Run a program once in each of several arithmetics.  Raise CardError or DeckError for an invalid deck."""
    base, runs = options or Options(), []
    signs: dict[int, list[list[int]]] = {}
    for k, member in enumerate(members):
        run = JournaledRun(program, deck, replace(base, numbers=member), False, Operator(), ())
        for pc, _, value in run.entries():
            if program.code[pc].operation == op.IF and not isinstance(value, int):
                signs.setdefault(pc, [[] for _ in members])[k].append(member.sign(value))
        if run.error is not None:
            raise run.error
        runs.append(run.records)
    shapes = [tuple(shape_of(records)) for records in runs]
    frequent = Counter(shapes).most_common()
    same = [records for records, shape in zip(runs, shapes, strict=True) if shape == frequent[0][0]]
    printed = []
    for record, texts in enumerate(zip(*same, strict=True), 1):
        for columns in zip(*(NUMBER.findall(text) for text in texts), strict=True):
            values = tuple(Fraction(column) for column in columns)
            printed.append(Printed(record, columns[0], values, estimate(values, members[0].digits)))
    return Independent(
        shares=tuple(count for _, count in frequent),
        records=tuple(same[0]),
        printed=tuple(printed),
        decisions=tuple(_compared(program, pc, signs[pc]) for pc in sorted(signs)),
    )


def _compared(program: Program, pc: int, signs: Sequence[Sequence[int]]) -> DecisionShares:
    """Compare the signs that the runs find at each execution of an IF.  The most frequent sign becomes ``taken``."""
    votes = _Votes()
    for execution in zip_longest(*signs):
        reached = [sign for sign in execution if sign is not None]
        taken = Counter(reached).most_common(1)[0][0]
        _vote(votes, reached, program.branches[program.code[pc].address], taken)
    return _decision(program.line_at(pc), votes)

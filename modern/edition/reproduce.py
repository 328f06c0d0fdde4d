"""Run the examples of chapter 6 and give a verdict on every printed result.

Each example runs twice: through program 1 in the state that produced the examples, and through program 1 as
listed, which chapter 5 prints and which chooses its first points in another way.  Programs 2 and 3 follow on
the cards just punched.

What the print proves - numbers, signs, order, words - is kept apart from what it cannot: blank cards and
columns, which the OCR lost and the FORMATs supply.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from importlib.resources.abc import Traversable
from typing import Final, Literal

from emulator.errors import EmulatorError
from emulator.machine.endings import Ending
from emulator.machine.result import Options
from modern.edition import programs
from modern.edition.chapter6 import EXAMPLES, Output, Print, input_deck, prints
from modern.thesis.cards import planes_hold, read_hull, read_intermediate, same_hull
from modern.thesis.job import Load, Step, run_hull

State = Literal["examples", "listing"]
STATES: dict[State, str] = {"examples": "program1_examples", "listing": "program1"}
"""The built-in that plays program 1 in each of its two states."""

EXACT: Final = "exact"
SPACING: Final = "exact but for spacing"
ORDER: Final = "exact in another order"
DIFFERENT: Final = "different"
Kind = Literal["exact", "exact but for spacing", "exact in another order", "different"]

Part = Literal["points", "inside", "boundary", "vertices", "equations"]
"""What can agree in another order: the points of an intermediate deck, or the parts of a hull."""

_NUMBER = re.compile(r"[+-]?\.\d+E[+-]\d\d|(?<![A-Z0-9.])\d+")


@dataclass(frozen=True, slots=True)
class Verdict:
    """A verdict on one device.

    ``numbers`` and ``words`` are how many of each the print shows, ``cards`` how many cards carry print,
    ``blank`` how many are blank; ``differences`` are (card, printed, produced), with an empty string where one side
    has no such card; ``same`` counts what agrees where the order differs.
    """

    kind: Kind
    numbers: int
    words: int
    cards: int
    blank: int
    same: tuple[tuple[Part, int], ...] = ()
    differences: tuple[tuple[int, str, str], ...] = ()

    @property
    def holds(self) -> bool:
        """Whether what the print proves came out, in whatever order."""
        return self.kind != DIFFERENT


@dataclass(frozen=True, slots=True)
class Report:
    """The verdict on one device of one example, for one state of program 1.

    ``ending`` is how the program ended, the error that ended the job, or None where the program was not reached.
    """

    example: int
    state: State
    deck: str
    program: int
    device: Output
    printed: tuple[str, ...]
    produced: tuple[str, ...]
    verdict: Verdict
    ending: Ending | EmulatorError | None

    @property
    def stated(self) -> bool:
        """Whether these are typewriter lines, which chapter 6 does not print: chapter 5 states them."""
        return self.device == "typewriter"


def reproduce(
    examples: Iterable[int] = EXAMPLES,
    load: Load = programs.program,
    folder: Traversable | None = None,
    states: Iterable[State] = STATES,
) -> Iterator[Report]:
    """Run examples and judge them, one report a device.

    ``load`` gives the programs compiled and ``folder`` the corrected print, by default the committed ones.
    """
    states = tuple(states)
    for example in examples:
        expected = tuple(prints(example, folder))
        for state in states:
            yield from _one(example, state, expected, load, folder)


def summary(reports: Iterable[Report]) -> tuple[bool, int, int, int]:
    """(whether everything printed came out, exact results, results in another order, different ones).

    In the examples' state only exact counts as come out.
    """
    kinds = [(report.state, report.verdict.kind) for report in reports]
    exact = sum(kind == EXACT for _, kind in kinds)
    order = sum(kind == ORDER for _, kind in kinds)
    good = all(kind == EXACT or (state == "listing" and kind == ORDER) for state, kind in kinds)
    return good, exact, order, len(kinds) - exact - order


def _one(
    example: int, state: State, expected: tuple[Print, ...], load: Load, folder: Traversable | None
) -> Iterator[Report]:
    trouble: EmulatorError | None = None
    steps: tuple[Step, ...] = ()
    try:
        steps = run_hull(input_deck(example, folder), load, Options(limit=200_000), STATES[state]).steps
    except EmulatorError as error:
        trouble = error
    last = max(p.program for p in expected)
    produced = {step.number: step for step in steps}
    for printed in expected:
        step = produced.get(printed.program)
        lines = () if step is None else step.result.punched if printed.device == "punch" else step.result.typed
        final = printed.program == last
        verdict = compare(printed.lines, lines, final, oriented=printed.program > 1)
        ending = trouble if step is None else step.result.ending
        if not (isinstance(ending, Ending) and ending.normal) and verdict.kind != DIFFERENT:
            verdict = replace(verdict, kind=DIFFERENT, same=(), differences=())
        name = STATES[state] if printed.program == 1 else f"program{printed.program}"
        yield Report(
            example, state, f"{name}.f", printed.program, printed.device, printed.lines, lines, verdict, ending
        )


def compare(printed: Sequence[str], produced: Sequence[str], final: bool, oriented: bool) -> Verdict:
    """The verdict on a device's lines.

    ``final`` cards are a hull's, others an intermediate deck; ``oriented``: see
    :func:`modern.thesis.cards.same_hull`.
    """
    tokens = [token for line in printed for token in line.split()]
    numbers = sum(len(_NUMBER.findall(line)) for line in printed)
    words = sum(any(c.isalpha() for c in token) and not _NUMBER.search(token) for token in tokens)
    blank = sum(not line.strip() for line in printed)
    base = (numbers, words, len(printed) - blank, blank)
    if list(printed) == list(produced):
        return Verdict(EXACT, *base)
    differences = _differences(printed, produced)
    if _dense(printed) == _dense(produced):
        return Verdict(SPACING, *base, differences=differences)
    same = _same_results(printed, produced, oriented) if final else _same_deck(printed, produced)
    if same:
        return Verdict(ORDER, *base, same=_agreement(printed, final), differences=differences)
    return Verdict(DIFFERENT, *base, differences=differences)


def _agreement(printed: Sequence[str], final: bool) -> tuple[tuple[Part, int], ...]:
    """What two results in different order have in common, counted."""
    if not final:
        middle = read_intermediate(printed)
        return (("points", len(middle.points)),) if middle else ()
    hull = read_hull(printed)
    counts: tuple[tuple[Part, int], ...] = (
        ("inside", len(hull.inside)),
        ("boundary", len(hull.boundary)),
        ("vertices", len(hull.vertices)),
        ("equations", len(hull.equations)),
    )
    return tuple((part, count) for part, count in counts if count)


def _dense(lines: Sequence[str]) -> list[str]:
    return [dense for line in lines if (dense := "".join(line.split()))]


def _words(lines: Sequence[str]) -> Counter[str]:
    """The lines without numbers: headings."""
    return Counter(text for line in lines if (text := " ".join(_NUMBER.sub("", line).replace(",", " ").split())))


def _same_results(printed: Sequence[str], produced: Sequence[str], oriented: bool) -> bool:
    """The same hull under the same headings, and an order that does differ: a lost sign of a zero is no order."""
    one, other = read_hull(printed), read_hull(produced)
    return _words(printed) == _words(produced) and one != other and same_hull(one, other, oriented)


def _same_deck(printed: Sequence[str], produced: Sequence[str]) -> bool:
    """The same points under the same N in another order, with planes that fit that order."""
    one, other = read_intermediate(printed), read_intermediate(produced)
    if one is None or other is None or one.points == other.points:
        return False
    return one.count == other.count and Counter(one.points) == Counter(other.points) and planes_hold(other)


def _differences(printed: Sequence[str], produced: Sequence[str]) -> tuple[tuple[int, str, str], ...]:
    longest = max(len(printed), len(produced))
    pairs = (
        (i, printed[i] if i < len(printed) else "", produced[i] if i < len(produced) else "") for i in range(longest)
    )
    return tuple((i + 1, a, b) for i, a, b in pairs if a != b)

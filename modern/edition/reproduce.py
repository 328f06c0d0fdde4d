"""Run the examples of chapter 6 and give a verdict on every printed result.

Each example is run with two states of program 1.  The first state produced the printed examples and was reconstructed
from them.  The second state is the listing of chapter 5, which chooses its first points differently.  Programs 2 and 3
then read the punched cards.  The printed text proves numbers, signs, order and words.  It does not prove blank cards
and columns, which the OCR lost and the FORMATs supply.  A verdict therefore counts blank cards separately.
"""

import re
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import zip_longest
from typing import Final, Literal

from emulator.errors import EmulatorError
from emulator.machine.endings import Ending
from emulator.machine.result import Options
from modern.edition import programs
from modern.edition.chapter6 import EXAMPLES, Output, Print, input_deck, prints
from modern.thesis.cards import planes_hold, read_hull, read_intermediate, same_hull
from modern.thesis.job import Load, Step, run_hull

State = Literal["examples", "listing"]
# The built-in program for each of the two states of program 1.
STATES: dict[State, str] = {"examples": "program1_examples", "listing": "program1"}

EXACT: Final = "exact"
SPACING: Final = "exact except for spacing"
ORDER: Final = "exact in another order"
DIFFERENT: Final = "different"
Kind = Literal["exact", "exact except for spacing", "exact in another order", "different"]

# The parts of an output that may be the same but in another order: the points of an intermediate deck, or the parts of
# a hull.
Part = Literal["points", "inside", "boundary", "vertices", "equations"]

_NUMBER = re.compile(r"[+-]?\.\d+E[+-]\d\d|(?<![A-Z0-9.])\d+")


@dataclass(frozen=True, slots=True)
class Verdict:
    """A verdict on the output of one device.

    ``numbers``, ``words``, ``cards`` and ``blank`` count the printed numbers, words, cards with text and blank cards.

    ``differences`` has a triple for each card that differs: its number, the printed and the produced card.  A missing
    card is an empty string.  If the output differs only in its order, ``same`` has the numbers of points of each kind
    and of equations, all of which agree; otherwise it is empty.
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
        """True if the output agrees with the print, possibly in another order."""
        return self.kind != DIFFERENT


@dataclass(frozen=True, slots=True)
class Report:
    """The verdict on the output of one program on one device, in one example with one state of program 1.

    ``ending`` says how the run of the program ended.  It is the error if the job failed with an error, and None if the
    program did not run.
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
        """True for typed lines, which chapter 5 describes and chapter 6 does not print."""
        return self.device == "typewriter"


def reproduce(
    examples: Iterable[int] = EXAMPLES,
    load: Load = programs.program,
    states: Collection[State] = STATES.keys(),
) -> Iterator[Report]:
    """Run examples with the given states of program 1, and judge the output of each device.

    ``load`` returns the compiled program of a name.
    """
    for example in examples:
        expected = tuple(prints(example))
        for state in states:
            yield from _reports(example, state, expected, load)


def summary(reports: Iterable[Report]) -> tuple[bool, int, int, int]:
    """Return True if all results are reproduced, and the numbers of exact, of reordered and of other results.

    With the state of the examples, a result is reproduced if it is exact.  With the listing, its order may differ.
    """
    kinds = [(report.state, report.verdict.kind) for report in reports]
    exact = sum(kind == EXACT for _, kind in kinds)
    order = sum(kind == ORDER for _, kind in kinds)
    all_reproduced = all(kind == EXACT or (state == "listing" and kind == ORDER) for state, kind in kinds)
    return all_reproduced, exact, order, len(kinds) - exact - order


def _reports(example: int, state: State, expected: tuple[Print, ...], load: Load) -> Iterator[Report]:
    job_error: EmulatorError | None = None
    steps: tuple[Step, ...] = ()
    try:
        steps = run_hull(input_deck(example), load, Options(limit=200_000), STATES[state]).steps
    except EmulatorError as error:
        job_error = error
    last = max(p.program for p in expected)
    produced = {step.number: step for step in steps}
    for printed in expected:
        step = produced.get(printed.program)
        lines = () if step is None else step.result.punched if printed.device == "punch" else step.result.typed
        final = printed.program == last
        verdict = compare(printed.lines, lines, final, oriented=printed.program > 1)
        ending = job_error if step is None else step.result.ending
        if not (isinstance(ending, Ending) and ending.normal) and verdict.kind != DIFFERENT:
            verdict = replace(verdict, kind=DIFFERENT, same=(), differences=())
        name = STATES[state] if printed.program == 1 else f"program{printed.program}"
        yield Report(
            example, state, f"{name}.f", printed.program, printed.device, printed.lines, lines, verdict, ending
        )


def compare(printed: Sequence[str], produced: Sequence[str], final: bool, oriented: bool) -> Verdict:
    """Return the verdict on the lines that a program wrote on a device.

    ``final`` is True if the lines hold a hull, and False if they are a deck for the next program.  ``oriented`` is True
    if also the signs of the hull's equations must agree.
    """
    tokens = [token for line in printed for token in line.split()]
    numbers = sum(len(_NUMBER.findall(line)) for line in printed)
    word_count = sum(any(c.isalpha() for c in token) and not _NUMBER.search(token) for token in tokens)
    blank = sum(not line.strip() for line in printed)
    base = (numbers, word_count, len(printed) - blank, blank)
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


def _headings(lines: Sequence[str]) -> Counter[str]:
    return Counter(text for line in lines if (text := " ".join(_NUMBER.sub("", line).replace(",", " ").split())))


def _same_results(printed: Sequence[str], produced: Sequence[str], oriented: bool) -> bool:
    """Return True if two outputs have equal headings, and hulls that differ only in order or in the scale of equations.

    Return False if the hulls are equal, because the outputs then differ in something other than the order.
    """
    printed_hull, produced_hull = read_hull(printed), read_hull(produced)
    in_other_order = printed_hull != produced_hull and same_hull(printed_hull, produced_hull, oriented)
    return in_other_order and _headings(printed) == _headings(produced)


def _same_deck(printed: Sequence[str], produced: Sequence[str]) -> bool:
    """Return True if a deck has the printed points in another order, and equations that are zero at their points."""
    expected, actual = read_intermediate(printed), read_intermediate(produced)
    if expected is None or actual is None or expected.points == actual.points:
        return False
    same_points = expected.count == actual.count and Counter(expected.points) == Counter(actual.points)
    return same_points and planes_hold(actual)


def _differences(printed: Sequence[str], produced: Sequence[str]) -> tuple[tuple[int, str, str], ...]:
    pairs = zip_longest(printed, produced, fillvalue="")
    return tuple((number, a, b) for number, (a, b) in enumerate(pairs, 1) if a != b)

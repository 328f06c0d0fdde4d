"""Run the examples of chapter 6 and give a verdict on every printed result.

Each example runs twice: through program 1 in the state that produced the examples, and through program 1 as
listed, which chapter 5 prints and which chooses its first points in another way.  Programs 2 and 3 follow on
the cards just punched.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from importlib.resources.abc import Traversable

from emulator.errors import EmulatorError
from emulator.machine.result import Options
from modern.edition import decks
from modern.edition.printed import EXAMPLES, Print, input_deck, prints
from modern.edition.verdicts import DIFFERENT, EXACT, ORDER, Verdict, compare
from modern.thesis.job import Load, run_hull

STATES = (("examples", "program1_examples"), ("listing", "program1"))

WHY_ORDER = (
    "the listing swaps the extreme points into places 1 and 2 and looks for the farthest third; the examples were "
    "printed by an earlier state of program 1, which put the six extremes in front"
)


@dataclass(frozen=True, slots=True)
class Report:
    """The verdict on one device of one example, for one state of program 1.

    ``stated`` marks typewriter lines, which chapter 6 does not print: chapter 5 states them.
    """

    example: int
    state: str
    deck: str
    program: int
    device: str
    stated: bool
    printed: tuple[str, ...]
    produced: tuple[str, ...]
    verdict: Verdict
    ending: str


def reproduce(
    examples: Iterable[int] = EXAMPLES,
    load: Load = decks.program,
    folder: Traversable | None = None,
    states: Iterable[tuple[str, str]] = STATES,
) -> Iterator[Report]:
    """Run examples and judge them, one report a device.

    ``load`` gives the programs compiled and ``folder`` the corrected print, by default the committed ones.
    """
    states = tuple(states)
    for example in examples:
        expected = tuple(prints(example, folder))
        for state, first in states:
            yield from _one(example, state, first, expected, load, folder)


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
    example: int, state: str, first: str, expected: tuple[Print, ...], load: Load, folder: Traversable | None
) -> Iterator[Report]:
    trouble = ""
    try:
        steps = run_hull(input_deck(example, folder), load, Options(limit=200_000), first).steps
    except EmulatorError as error:
        steps, trouble = (), str(error)
    last = max(p.program for p in expected)
    produced = {int(step.name[7]): step for step in steps}
    for printed in expected:
        step = produced.get(printed.program)
        lines = () if step is None else step.result.punched if printed.device == "punch" else step.result.typed
        final = printed.program == last
        verdict = compare(printed.lines, lines, final, oriented=printed.program > 1, reason=WHY_ORDER)
        ending = trouble or ("the program was not reached" if step is None else step.result.ending.message)
        if ending and verdict.kind != DIFFERENT:
            verdict = Verdict(DIFFERENT, verdict.numbers, verdict.words, verdict.cards, verdict.blank)
        name = f"{first if printed.program == 1 else f'program{printed.program}'}.f"
        yield Report(
            example,
            state,
            name,
            printed.program,
            printed.device,
            printed.device == "typewriter",
            printed.lines,
            lines,
            verdict,
            ending,
        )

"""Compare the results of a restored program with the printed results of the original."""

from dataclasses import dataclass
from functools import lru_cache

from emulator.errors import EmulatorError
from emulator.language.cards import deck_from_lines
from emulator.language.compiler import compile_deck
from emulator.language.objectcode import Program
from emulator.machine.machine import Machine
from emulator.machine.operator import FromFile
from emulator.machine.result import Options
from modern.edition.reproduce import EXACT, SPACING, compare

# The greatest number of statements of a run.  The run with the longest printed result executes 15,000.
LIMIT = 30_000


@dataclass(frozen=True, slots=True)
class Trial:
    """The data cards of a run, and the lines punched by this run as the document prints them.

    ``switches`` are the sense switches that are on, and ``operator`` is the text of a file of the operator's actions.
    ``final`` is True if the lines hold a hull, and False if they are a deck for the next program. ``in_order`` is False
    if the points and equations may be in another order than in the print.
    """

    cards: tuple[str, ...]
    printed: tuple[str, ...]
    switches: tuple[int, ...] = ()
    operator: str = ""
    final: bool = True
    in_order: bool = True


@dataclass(frozen=True, slots=True)
class Job:
    """A damaged program, and the printed results of the undamaged program."""

    cards: tuple[str, ...]
    trials: tuple[Trial, ...] = ()


def score(lines: tuple[str, ...], trials: tuple[Trial, ...]) -> int:
    """Return the number of printed lines that a program reproduces, plus 1000 for each completely reproduced result.

    Return -1 if the program does not compile.
    """
    return sum(max(score_of(lines, trial), 0) for trial in trials) if _compiled(lines) else -1


@lru_cache(256)
def _compiled(lines: tuple[str, ...]) -> Program | None:
    try:
        return compile_deck(deck_from_lines("damaged", lines))
    except EmulatorError:
        return None


@lru_cache(8192)
def score_of(lines: tuple[str, ...], trial: Trial) -> int:
    """Return the score (:func:`score`) of a program for one printed result."""
    program = _compiled(lines)
    if program is None:
        return -1
    options = Options(limit=LIMIT, switches=frozenset(trial.switches), hopper="any", core=60_000)
    try:
        machine = Machine(program, deck_from_lines("data", trial.cards), options)
        result = machine.run(FromFile("operator", trial.operator)) if trial.operator else machine.run()
    except EmulatorError:
        return 0
    verdict = compare(trial.printed, result.punched, trial.final, oriented=trial.in_order)
    if verdict.kind in (EXACT, SPACING) or (verdict.holds and not trial.in_order):
        return 1000 + len(trial.printed)
    return sum(a.split() == b.split() for a, b in zip(trial.printed, result.punched, strict=False))

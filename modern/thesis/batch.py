"""Many hulls at once: program 1 over all decks, then program 2 and program 3 over the cards it punched."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from emulator.compiled.batch import run_batch
from emulator.errors import EmulatorError
from emulator.language.cards import Deck
from emulator.language.objectcode import Program
from emulator.machine.result import Options, Result
from modern.thesis.job import HullRun, Load, Step, punched_deck, second_program


@dataclass
class Runs:
    """Runs already made: the same program with the same options over the same deck is run once.

    Routes of a cell often share program 1 or 2.  The programs are kept, so that no other can take the identity of one.
    """

    done: dict[tuple[int, Options, Deck], Result | EmulatorError] = field(default_factory=dict)
    programs: dict[int, Program] = field(default_factory=dict)

    def results(self, program: Program, decks: Sequence[Deck], options: Options) -> list[Result | EmulatorError]:
        """The result of each deck, or the error it raised: a card of numbers no program can read."""
        self.programs[id(program)] = program
        fresh = [deck for deck in dict.fromkeys(decks) if (id(program), options, deck) not in self.done]
        for deck, result in zip(fresh, _results(program, fresh, options), strict=True):
            self.done[id(program), options, deck] = result
        return [self.done[id(program), options, deck] for deck in decks]


def _results(program: Program, decks: Sequence[Deck], options: Options) -> Sequence[Result | EmulatorError]:
    try:
        return run_batch(program, decks, options)
    except EmulatorError as error:
        if len(decks) == 1:
            return [error]
    # One deck stops a batch: halves are tried, so that the others' results are kept.
    half = len(decks) // 2
    halves = decks[:half], decks[half:]
    return [result for some in halves for result in _results(program, some, options)]


def run_hulls(
    decks: Sequence[Deck],
    load: Load,
    options: Options | None = None,
    first: str = "program1",
    runs: Runs | None = None,
) -> list[HullRun | EmulatorError]:
    """Each deck's hull run, equal to :func:`modern.thesis.job.run_hull`'s, or the error that would raise.

    A deck holds one data set; ``runs`` carries runs over from one call to the next.
    """
    options, runs = options or Options(), runs or Runs()
    program = load(first)
    found: list[HullRun | EmulatorError] = []
    waiting: dict[int, list[tuple[int, Step]]] = {}
    for place, (deck, result) in enumerate(zip(decks, runs.results(program, decks, options), strict=True)):
        if isinstance(result, EmulatorError):
            found.append(result)
            continue
        step = Step(first, 1, program, deck, result)
        found.append(HullRun((step,)))
        second = second_program(result)
        if second is not None:
            waiting.setdefault(second, []).append((place, step))
    for number, ready in waiting.items():
        name = f"program{number}"
        following = load(name)
        middle = [punched_deck(step) for _, step in ready]
        results = runs.results(following, middle, options)
        for (place, step), deck, result in zip(ready, middle, results, strict=True):
            if isinstance(result, EmulatorError):
                found[place] = result
            else:
                found[place] = HullRun((step, Step(name, number, following, deck, result)))
    return found

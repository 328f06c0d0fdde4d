"""Run Butler's programs on many decks: program 1 on all of them, then program 2 or 3 on the cards that it punched."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from emulator.compiled.batch import run_batch
from emulator.errors import EmulatorError
from emulator.language.cards import Deck
from emulator.language.objectcode import Program
from emulator.machine.machine import Machine
from emulator.machine.result import Options, Result
from modern.thesis.job import HullRun, Load, Step, punched_deck, second_program


@dataclass
class Runs:
    """A cache of finished runs, because several batches often need the same run of program 1 or 2.

    If ``interpreted`` is true, the interpreter runs the programs instead of the compiled engine.
    """

    interpreted: bool = False
    done: dict[tuple[int, Options, Deck], Result | EmulatorError] = field(default_factory=dict)
    programs: dict[int, Program] = field(default_factory=dict)

    def results(self, program: Program, decks: Sequence[Deck], options: Options) -> list[Result | EmulatorError]:
        """Return for each deck the result of its run, or the error if the program cannot read the deck."""
        self.programs[id(program)] = program
        fresh = [deck for deck in dict.fromkeys(decks) if (id(program), options, deck) not in self.done]
        results = (_interpreted if self.interpreted else _results)(program, fresh, options)
        for deck, result in zip(fresh, results, strict=True):
            self.done[id(program), options, deck] = result
        return [self.done[id(program), options, deck] for deck in decks]


def _interpreted(program: Program, decks: Sequence[Deck], options: Options) -> Sequence[Result | EmulatorError]:
    results: list[Result | EmulatorError] = []
    for deck in decks:
        try:
            results.append(Machine(program, deck, options).run())
        except EmulatorError as error:
            results.append(error)
    return results


def _results(program: Program, decks: Sequence[Deck], options: Options) -> Sequence[Result | EmulatorError]:
    try:
        return run_batch(program, decks, options)
    except EmulatorError as error:
        if len(decks) == 1:
            return [error]
    # One invalid deck stops a batch.  Bisection finds it and preserves the results of the other decks.
    half = len(decks) // 2
    halves = decks[:half], decks[half:]
    return [result for part in halves for result in _results(program, part, options)]


def run_hulls(
    decks: Sequence[Deck], load: Load, options: Options | None = None, first: str = "program1", runs: Runs | None = None
) -> list[HullRun | EmulatorError]:
    """Run program 1 on each deck, and then program 2 or 3 on the cards that program 1 punched.

    Return for each deck its run, as :func:`modern.thesis.job.run_hull` does for one deck, or the error that made the
    deck unreadable.  Calls that pass the same ``runs`` do not repeat a run.
    """
    options, runs = options or Options(), runs or Runs()
    program = load(first)
    hull_runs: list[HullRun | EmulatorError] = []
    waiting: dict[int, list[tuple[int, Step]]] = {}
    for place, (deck, result) in enumerate(zip(decks, runs.results(program, decks, options), strict=True)):
        if isinstance(result, EmulatorError):
            hull_runs.append(result)
            continue
        step = Step(first, 1, program, deck, result)
        hull_runs.append(HullRun((step,)))
        second = second_program(result)
        if second is not None:
            waiting.setdefault(second, []).append((place, step))
    # Run one of the programs 2 and 3 on all decks for it, then the other program on the decks for it.
    for number, ready in waiting.items():
        name = f"program{number}"
        following = load(name)
        middle = [punched_deck(step) for _, step in ready]
        results = runs.results(following, middle, options)
        for (place, step), deck, result in zip(ready, middle, results, strict=True):
            if isinstance(result, EmulatorError):
                hull_runs[place] = result
            else:
                hull_runs[place] = HullRun((step, Step(name, number, following, deck, result)))
    return hull_runs

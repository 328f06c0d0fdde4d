"""Run the benchmarks of the project.  Print the median, minimum and maximum of each, and the required time if any."""

import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence

from emulator.language.cards import deck_from_lines
from emulator.machine.machine import Machine
from modern.bench.measure import POINTS, data_deck, lines, measure, random_points
from modern.bench.suite import digital, hulls, papers
from modern.bench.timing import RUNS, command, timed
from modern.edition import programs

DECKS = 1_000


def command_lines() -> Iterator[str]:
    """Time commands in new processes.  Yield the results as lines."""
    yield timed("an empty Python process", lambda: subprocess.run([sys.executable, "-c", "pass"], check=True)).line()
    yield timed("hull1620 --help", command("--help"), "required: 0.15 s").line()
    yield timed("hull1620 reproduce 5, process start included", command("reproduce", "5"), "required: 0.5 s").line()
    yield timed("hull1620 reproduce, everything", command("reproduce")).line()


def engine_lines() -> Iterator[str]:
    """Time the interpreter on one deck, and all engines on a thousand decks as ``hull1620 bench`` does."""
    deck = data_deck(random_points(POINTS, 1))
    middle = deck_from_lines("middle", Machine(programs.program("program1"), deck).run().punched)
    program = programs.program("program3")
    result = Machine(program, middle).run()
    name = f"program 3, {POINTS} points, {result.statements} statements, plain engine"
    figure = timed(name, lambda: Machine(program, middle).run(), "required: 1.5 s")
    yield figure.line()
    yield f"  {result.statements / figure.median:,.0f} statements a second"
    yield from lines(measure(DECKS))


GROUPS: Mapping[str, Callable[[], Iterator[str]]] = {
    "commands": command_lines,
    "engine": engine_lines,
    "hulls": hulls.lines,
    "papers": lambda: (figure.line() for figure in papers.figures()),
    "digital": digital.lines,
}


def main(names: Sequence[str]) -> int:
    """Run the named groups of benchmarks, or all groups.  Return 2 if a name is unknown."""
    unknown = [name for name in names if name not in GROUPS]
    if unknown:
        print(f"bench: unknown group {unknown[0]!r}; expected some of {', '.join(GROUPS)}", file=sys.stderr)
        return 2
    print(f"times: the median of {RUNS} runs, and in parentheses the shortest and the longest")
    for name in names or GROUPS:
        for line in GROUPS[name]():
            print(line, flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""Run the benchmarks: what, median, least, most, and what it was measured against.

``python -m modern.bench`` runs every group, ``python -m modern.bench digital papers`` those named.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence

from modern.bench import appel_will as papers_appel
from modern.bench import digital, engine, hulls
from modern.bench import hidden_line as papers_hidden_line
from modern.bench import voxels as papers_voxels
from modern.bench.clock import RUNS, timed


def process(*arguments: str) -> Callable[[], object]:
    """A whole process of the command, its output thrown away."""
    command = [sys.executable, "-m", "modern.cli.main", *arguments]
    return lambda: subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def command_lines() -> Iterator[str]:
    """Whole processes, process start included."""
    yield timed("an empty Python process", lambda: subprocess.run([sys.executable, "-c", "pass"], check=True)).line()
    yield timed("hull1620 --help", process("--help"), "bar 0.15 s").line()
    yield timed("hull1620 reproduce 5, process start included", process("reproduce", "5"), "bar 0.5 s").line()
    yield timed("hull1620 reproduce, everything", process("reproduce")).line()


def paper_lines() -> Iterator[str]:
    """The later papers."""
    for module in (papers_appel, papers_hidden_line, papers_voxels):
        yield from (figure.line() for figure in module.figures())


GROUPS: Mapping[str, Callable[[], Iterator[str]]] = {
    "commands": command_lines,
    "engine": engine.figures,
    "hulls": lambda: (figure.line() for figure in hulls.figures()),
    "papers": paper_lines,
    "digital": lambda: (figure.line() for figure in digital.figures()),
}


def main(names: Sequence[str]) -> int:
    """Print every figure of the groups named, or of all."""
    unknown = [name for name in names if name not in GROUPS]
    if unknown:
        print(f"bench: there is no group {unknown[0]!r}; there are {', '.join(GROUPS)}", file=sys.stderr)
        return 2
    print(f"medians of {RUNS}")
    for name in names or GROUPS:
        for line in GROUPS[name]():
            print(line, flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""Compare compiled translations of the programs with the emulator, decision by decision (IF, computed GO TO, DO).

``python -m modern.bench.decisions 2000 FOLDER`` translates programs 1 to 3, compiles them in FOLDER with every C and
Fortran compiler of :data:`COMPILERS`, and runs 2,000 decks from the families of the study ``divergence``.
"""

from __future__ import annotations

import subprocess
import sys
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from emulator.errors import EmulatorError
from emulator.language import objectcode as op
from emulator.language.cards import Deck
from emulator.language.objectcode import Program
from emulator.machine.endings import Ending
from emulator.machine.machine import Machine
from emulator.machine.result import Options, Result
from emulator.machine.state import Journal
from emulator.numbers import Number, Numbers, numbers
from emulator.translation.writers import translated
from modern.edition import programs
from modern.formats.deck import data_deck
from modern.study.builtin import divergence
from modern.study.families import draw_sample
from modern.thesis.job import Step, punched_deck, second_program

PROGRAMS = ("program1", "program2", "program3")
COMPILERS: Mapping[str, tuple[str, str]] = {
    "gcc -O2 -ffp-contract=off": ("c", "c"),
    "gcc -O2 -march=native": ("c", "c"),
    "gfortran -O2 -ffp-contract=off": ("fortran", "f90"),
    "gfortran -O2 -march=native": ("fortran", "f90"),
}

_LIMIT = 200_000
_PATIENCE = 2


@dataclass(frozen=True, slots=True)
class Decision:
    """One decision of a run: its card, the branch taken, and the number that decided it.

    The outcome of an IF is -1, 0 or 1, and that of a computed GO TO is the number of the label.  The outcome at the end
    of a DO is 1 if the loop is repeated and 0 if it ends.
    """

    card: int
    kind: str
    outcome: int
    value: Number


def run_with_decisions(program: Program, deck: Deck, arithmetic: Numbers) -> tuple[Result, list[Decision]]:
    """Run a program, and return its result and its decisions.

    If the deck is invalid, the ending of the result has the kind ``input``.
    """
    machine = Machine(program, deck, Options(arithmetic, limit=_LIMIT), journal=Journal(False))
    assert machine.journal is not None
    try:
        result = machine.run()
    except EmulatorError as error:
        result = machine.result(Ending("input", trouble=str(error)))
    decisions = []
    for pc, target, value in machine.journal.entries:
        kind, outcome = "computed GO TO", value
        if program.code[pc].operation in (op.IF, op.IFX):
            kind = "IF" if program.code[pc].operation == op.IF else "fixed-point IF"
            outcome = arithmetic.sign(value) if program.code[pc].operation == op.IF else (value > 0) - (value < 0)
        elif program.code[pc].operation == op.DOTEST:
            kind, outcome = "DO", int(target == program.loops[program.code[pc].address][3])
        decisions.append(Decision(program.line_at(pc).place.card, kind, outcome, value))
    return result, decisions


@dataclass
class Counts:
    """The number of differences of each kind between compiled programs and the emulator.

    ``first`` describes the place of the first difference of each kind.
    """

    counts: Counter[str] = field(default_factory=Counter)
    first: dict[str, str] = field(default_factory=dict)

    def add(self, what: str, number: int = 1, where: str = "") -> None:
        self.counts[what] += number
        if number and where:
            self.first.setdefault(what, where)

    def lines(self) -> Iterator[str]:
        for what, number in self.counts.items():
            yield f"  {number:>10,} {what}" + (f" (first: {self.first[what]})" if what in self.first else "")


def compare_step(program: Path, step: Step, decisions: Sequence[Decision], counts: Counts) -> None:
    """Run a compiled program on a deck that the emulator has run, and count the differences between the two runs."""
    log = program.with_suffix(".decisions")
    command = [str(program), "-d", str(log)]
    where = f"{step.name}, {step.deck.source}"
    is_endless = step.result.ending.kind == "limit"
    try:
        process = subprocess.run(
            command, input=step.deck.text(), capture_output=True, text=True, timeout=_PATIENCE, check=False
        )
    except subprocess.TimeoutExpired:
        counts.add("runs that do not end, as in the emulator" if is_endless else "runs with another end", where=where)
        return
    typed = [line for line in process.stderr.splitlines() if not line.startswith(step.program.source)]
    result = step.result
    logged = [line.split() for line in log.read_text(encoding="ascii").splitlines()]
    branches = [(int(card), int(outcome)) for card, outcome, _ in logged]
    expected = [(decision.card, decision.outcome) for decision in decisions]
    counts.add("runs that end")
    counts.add("runs that the emulator refuses", result.ending.kind in ("input", "undefined", "undecided", "bounds"))
    counts.add("decisions", len(expected))
    counts.add("runs with another end", (process.returncode == 0) != result.ending.normal, where)
    counts.add("runs with other cards", process.stdout.splitlines() != list(result.punched), where)
    counts.add("runs with other typed lines", typed != list(result.typed), where)
    counts.add("runs with other decisions", branches != expected, where)
    pairs = zip(logged, decisions, strict=False)
    counts.add("tested values that differ", sum(float(a[2]) != float(b.value) for a, b in pairs), where)


def samples(count: int) -> Iterator[Deck]:
    """Yield random decks for program 1, taken in turn from the families of the study ``divergence``."""
    cells = divergence.plan().cells
    for n in range(count):
        cell, index = cells[n % len(cells)], n // len(cells)
        points = draw_sample(cell, 1963, index).points
        yield data_deck(points, f"{cell.name}, sample {index}")


def steps_of(deck: Deck, arithmetic: Numbers) -> Iterator[tuple[Step, list[Decision]]]:
    """Run program 1 on a deck, then program 2 or 3.  Yield both runs with their decisions."""
    number: int | None = 1
    while number is not None:
        program = programs.program(f"program{number}")
        result, decisions = run_with_decisions(program, deck, arithmetic)
        step = Step(f"program{number}", number, program, deck, result)
        yield step, decisions
        number = second_program(result) if number == 1 else None
        deck = punched_deck(step)


def compiled(folder: Path, command: str) -> dict[str, Path]:
    """Translate and compile programs 1 to 3 with the given compiler command.  Return the executable files."""
    language, ending = COMPILERS[command]
    executables = {}
    for name in PROGRAMS:
        source, executable = folder / f"{name}.{ending}", folder / f"{name}-{list(COMPILERS).index(command)}"
        source.write_text(translated(programs.deck(name), language, every_read_ends=False), encoding="ascii")
        subprocess.run([*command.split(), "-o", str(executable), str(source), "-lm"], check=True, cwd=folder)
        executables[name] = executable
    return executables


def compare(count: int, folder: Path, commands: Sequence[str] = tuple(COMPILERS)) -> dict[str, Counts]:
    """Run ``count`` decks on compiled programs and on the emulator, all in doubles, and count the differences.

    Return the counts for each command of a compiler.
    """
    executables = {command: compiled(folder, command) for command in commands}
    totals = {command: Counts() for command in commands}
    for deck in samples(count):
        for step, decisions in steps_of(deck, numbers("float64")):
            for command in commands:
                compare_step(executables[command][step.name], step, decisions, totals[command])
    return totals


def main(arguments: Sequence[str]) -> None:
    for command, counts in compare(int(arguments[0]), Path(arguments[1]).resolve()).items():
        print(command, *counts.lines(), sep="\n")


if __name__ == "__main__":
    main(sys.argv[1:])

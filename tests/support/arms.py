"""The branches of IF, SENSE SWITCH and computed GO TO that runs take, counted by an added COUNT on every branch."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from emulator.language import objectcode as op
from emulator.language.cards import Deck
from emulator.language.objectcode import Counter, Instruction, Program
from emulator.machine.result import Options
from modern.thesis.job import Load, run_hull

Arm = tuple[int, str, str]
"""The number of a program, the label (``146+1``) and text of a statement, and those of its target.

Signs with the same target are one arm, and so are the common arms of both states of program 1.
"""

LARGE = Options(limit=200_000, core=60_000)
"""The counters make a program longer, but do not count as statements."""


def with_arms(program: Program) -> tuple[Program, dict[int, tuple[str, str]]]:
    """Return the program with a COUNT on every branch, and for each counter its statement and target."""
    code, branches, counters = list(program.code), list(program.branches), list(program.counters)
    statements, places, counted = program.statement_numbers, _places(program), {}
    for at, instruction in enumerate(program.code):
        if instruction.operation in (op.IF, op.IFX, op.SWITCH):
            table = instruction.address
        elif instruction.operation == op.SELECT:
            table = instruction.second
        else:
            continue
        ways = []
        for target in program.branches[table]:
            ways.append(len(code))
            counted[len(counters)] = (places[statements[at]], places[statements[target]])
            code.append(Instruction(op.COUNT, len(counters), -1, 0))
            counters.append(Counter(statements[at], False, "way out"))
            code.append(Instruction(op.BRANCH, len(branches), -1, 0))
            branches.append((target,))
        branches[table] = tuple(ways)
    return replace(program, code=tuple(code), branches=tuple(branches), counters=tuple(counters)), counted


def _places(program: Program) -> list[str]:
    """Return each statement's text after its number, or after the last number and the distance from it."""
    places, label, steps = [], 0, 0
    for line in program.statements:
        label, steps = (line.label, 0) if line.label else (label, steps + 1)
        places.append(f"{label}+{steps} {''.join(line.text.split())}")
    return places


def arms(names: Iterable[str], load: Load) -> set[Arm]:
    """Return all branches of the programs."""
    return {(int(name[7]), *arm) for name in names for arm in with_arms(load(name))[1].values()}


def taken(decks: Iterable[Deck], load: Load, first: str) -> set[Arm]:
    """Return the branches that decks take, with ``first`` as program 1."""
    made = {name: with_arms(load(name)) for name in (first, "program2", "program3")}
    arms_taken: set[Arm] = set()
    for deck in decks:
        for step in run_hull(deck, lambda name: made[name][0], LARGE, first).steps:
            for counter, arm in made[step.name][1].items():
                if step.result.counts[counter]:
                    arms_taken.add((step.number, *arm))
    return arms_taken

"""Where in a program a run came to grief: the statement that decided it, the loop, the array.

A place is named as the apparatus names cards: by a statement's number, ``147``, or by the number before it and how
many statements behind that it stands, ``132+3``.
"""

from __future__ import annotations

import re
from dataclasses import replace

from emulator.language.cards import deck_from_lines
from emulator.language.formats import Literal
from emulator.language.objectcode import LIST_PASS, Program
from emulator.machine.result import Options, Result
from modern.thesis.batch import Runs
from modern.thesis.job import Step

_CARDS = re.compile(r"; it (?:loops|was) on cards? (\d+)(?: to (\d+))?")
_BOUNDS = re.compile(r": (\w+)\((-?\d+)\) is outside \w+\((\d+)\)")
_CARD = re.compile(r": card (\d+): ")
PLANE_TABLE = frozenset({"A", "B", "C", "D", "E", "MM", "NN", "KK"})
"""The arrays of program 3 that hold a number a plane (thesis p. 88)."""


def place(program: Program, statement: int) -> str:
    """A statement's place, ``147`` or ``132+3``; before the first number, ``+3``."""
    for behind, line in enumerate(reversed(program.statements[: statement + 1])):
        if line.label:
            return f"{line.label}+{behind}" if behind else str(line.label)
    return f"+{statement}"


def typing_statement(program: Program, result: Result, message: str) -> int:
    """The statement, by index, that typed a message last; -1 where none can have."""
    formats = {number for number, spec in program.formats if Literal(message) in spec.specs}
    found = -1
    for counter, count in zip(program.counters, result.counts, strict=True):
        text = program.statements[counter.statement].text.split()
        if counter.begins and count and text[0] in ("PRINT", "TYPE") and text[-1].isdecimal():
            found = counter.statement if int(text[-1]) in formats else found
    return found


def refused_at(step: Step, message: str, options: Options, runs: Runs) -> str:
    """Where a program was that typed DATA NOT ACCEPTABLE or ERROR IN PROGRAM: ``program3 119``.

    All errors of a program are typed by one statement; named is the one that branched to it.  The run is repeated up
    to there, and what it did more the first time is what it did last.
    """
    program, result = step.program, step.result
    typing = typing_statement(program, result, message)
    if message != "ERROR IN PROGRAM" or typing < 0:
        return f"{step.name} {place(program, typing)}" if typing >= 0 else step.name
    limit = _begun(program, result) - _after(program, typing) - 1
    deck = deck_from_lines(step.name, [event.text for event in result.events if event.what == "read"])
    (before,) = runs.results(program, [deck], replace(options, limit=limit))
    last = []
    if isinstance(before, Result):
        last = [
            counter.statement
            for counter, once, twice in zip(program.counters, before.counts, result.counts, strict=True)
            if counter.begins and twice > once and program.statements[counter.statement].text.startswith("IF")
        ]
    return f"{step.name} {place(program, last[0] if len(last) == 1 else typing)}"


def looping_at(step: Step) -> str:
    """The span of numbered statements an endless run was in: ``program3 142-160``."""
    cards = _CARDS.search(step.result.ending.message)
    if cards is None:
        return step.name
    first, last = int(cards[1]), int(cards[2] or cards[1])
    within = [i for i, line in enumerate(step.program.statements) if first <= line.place.card <= last]
    labels = [step.program.statements[i].label for i in within if step.program.statements[i].label]
    start = place(step.program, within[0]) if within else ""
    return f"{step.name} {start}-{labels[-1]}" if labels and within else f"{step.name} {start}"


def out_of_bounds(step: Step) -> tuple[bool, str]:
    """Whether it was the table of planes that was full, and what was reached for: ``program3 A(99)``."""
    found = _BOUNDS.search(step.result.ending.message)
    if found is None:
        return False, stopped_at(step)
    array, subscript, size = found.groups()
    full = step.name == "program3" and array in PLANE_TABLE and int(subscript) > int(size)
    return full, f"{step.name} {array}({subscript})"


def stopped_at(step: Step) -> str:
    """Where a run stopped that reached for an undefined value, or for another reason."""
    card = _CARD.search(step.result.ending.message)
    if card is None:
        return step.name
    index = next((i for i, line in enumerate(step.program.statements) if line.place.card == int(card[1])), 0)
    return f"{step.name} {place(step.program, index)}"


def _after(program: Program, typing: int) -> int:
    """What counts against the limit from a refusal to the empty hopper: it types a line, and goes back to READ."""
    words = program.statements[min(typing + 1, len(program.statements) - 1)].text.split()
    back = next((i for i, line in enumerate(program.statements) if line.label and str(line.label) == words[-1]), 0)
    read = next(i for i, line in enumerate(program.statements) if i >= back and line.text.startswith("READ"))
    return 3 + read - back + 1


def _begun(program: Program, result: Result) -> int:
    """What counted against the limit: statements, passes of lists, numbers read or written, lines."""
    passes = sum(n for c, n in zip(program.counters, result.counts, strict=True) if c.what == LIST_PASS)
    numbers = sum(n for _, n in result.numbers)
    return result.statements + passes + numbers + len(result.punched) + len(result.typed)

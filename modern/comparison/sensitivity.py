"""Measure how much a program's printed numbers change if a number on its input cards changes.

Each floating-point number of the deck is changed in turn by one unit in its last digit, and the program runs again in
an arithmetic that makes no rounding errors or much smaller ones.  The changes of the printed numbers are then due to
the change of the card alone.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from emulator.errors import EmulatorError
from emulator.language.cards import Deck, deck_from_lines
from emulator.language.objectcode import Program
from emulator.machine.machine import Machine
from emulator.machine.result import Options, Result

NUMBER = re.compile(r"-?(?:\d+\.\d*|\.\d+)(?:E[+-]?\d+)?")
# The last digit of a number, before its exponent.
_LAST = re.compile(r"(\d)(\.?\s*(?:E\s*[+-]?\s*\d*|[+-]\s*\d+)?\s*)$")


@dataclass(frozen=True, slots=True)
class Sensitivity:
    """The effect on a program's output of changing one number on a card by one unit in its last digit.

    ``change`` is the largest relative change of a printed number, and ``record`` is the number of its record, from 1.
    Both are None if nothing changes.  ``branches`` is True if the changed number makes the run print records of another
    form or end in another way.
    """

    card: int
    column: int
    columns: str
    changed: str
    change: float | None
    record: int | None
    branches: bool


def records_of(result: Result) -> list[str]:
    """Return the records of a run, its punched cards and typed lines, in order."""
    return [event.text for event in result.events if event.what in ("punch", "type")]


def shape_of(texts: Sequence[str]) -> list[str]:
    """Return cards and lines without blanks and with # in place of each number, to compare their form."""
    return ["".join(NUMBER.sub("#", text).split()) for text in texts]


def sensitivities(machine: Machine, result: Result, most: int = 200) -> tuple[list[Sensitivity], int]:
    """Return the effect of changing each of a deck's first ``most`` numbers, and the number of further numbers.

    Only floating-point numbers that the program has read are counted and changed.

    ``machine`` has already run the program on the deck in the reference arithmetic, and ``result`` is the result of
    that run.
    """
    program, deck, base = machine.program, machine.deck, machine.options
    rows = []
    fields = list(dict.fromkeys(machine.devices.fields_read))
    for card, column, width in fields[:most]:
        text = deck.cards[card - 1].text.ljust(column - 1 + width)
        columns = text[column - 1 : column - 1 + width]
        changed = _nudged(columns)
        if changed is None:
            continue
        lines = [other.text for other in deck.cards]
        lines[card - 1] = text[: column - 1] + changed + text[column - 1 + width :]
        nudged = deck_from_lines(deck.source, lines)
        rows.append(_compared(program, nudged, base, result, (card, column, columns, changed)))
    return rows, len(fields[most:])


def _nudged(columns: str) -> str | None:
    """Return a number, given as columns of a card, with its last digit changed by one, or None if there is no digit."""
    match = _LAST.search(columns)
    if match is None:
        return None
    digit = int(match[1])
    return f"{columns[: match.start()]}{digit + 1 if digit < 9 else digit - 1}{match[2]}"


def _compared(
    program: Program, deck: Deck, options: Options, result: Result, place: tuple[int, int, str, str]
) -> Sensitivity:
    try:
        other = Machine(program, deck, options).run()
    except EmulatorError:
        return Sensitivity(*place, None, None, True)
    first, second = records_of(result), records_of(other)
    branches = shape_of(first) != shape_of(second) or result.ending.kind != other.ending.kind
    pairs = [] if branches else zip(first, second, strict=True)
    changes = [(change, record) for record, pair in enumerate(pairs, 1) for change in _changes(*pair)]
    change, record = max(changes) if changes else (None, None)
    return Sensitivity(*place, change, record, branches)


def _changes(first: str, second: str) -> Sequence[float]:
    """Return the relative changes of those numbers of a card or line that differ between two runs."""
    pairs = zip(map(float, NUMBER.findall(first)), map(float, NUMBER.findall(second)), strict=True)
    return [abs(b - a) / abs(a) if a else 1.0 for a, b in pairs if a != b]

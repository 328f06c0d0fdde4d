"""Make the object code of single input and output statements, and execute them on IBM's library of 1962."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from emulator.language.formats import FormatSpec, parse_format
from emulator.language.ibm1962 import (
    ITEM,
    LAST_ITEM,
    VERBS,
    call,
    digits,
    field_text,
    fixed_field,
    floating_field,
    format_positions,
)
from emulator.language.tree import Format, Place
from modern.bench.ibm1962.simulator import Job, Run, run_jobs

# The parts of the object program: the calls, the FORMAT, the field of its label, and the first number of the list.
CALLS, WORDS, LABEL, NUMBERS = 9000, 10000, 15186, 14700
HALT = [4, 8, *[0] * 10]

# The value of an integer (I) and of a floating-point number (E) before a statement reads it.  No data card has it.
BEFORE = {"I": "5555", "E": ".55555555E+55"}


@dataclass(frozen=True, slots=True)
class Statement:
    """An input or output statement: a verb such as READ, a FORMAT, and the values of its list as text."""

    verb: str
    text: str
    values: Sequence[str] = ()

    @property
    def spec(self) -> FormatSpec:
        """The statement's FORMAT in parsed form."""
        places = tuple(Place(1, min(column, 80)) for column in range(1, len(self.text) + 1))
        return parse_format(Format(self.text, places))[0]


@dataclass(frozen=True, slots=True)
class Outcome:
    """The effects of a statement: the typed lines, the punched cards, and the numbers of its list afterwards.

    ``trouble`` is the message of an abnormal end, or empty.
    """

    typed: tuple[str, ...]
    punched: tuple[str, ...]
    numbers: tuple[str, ...]
    trouble: str = ""


def execute(cases: Sequence[tuple[Statement, Sequence[str]]], deck: Sequence[str]) -> list[Outcome]:
    """Execute statements on the library in ``deck``.

    Each case is a statement with its data cards or, for ACCEPT, the lines to be typed.
    """
    keys = [line for statement, cards in cases if statement.verb == "ACCEPT" for line in cards]
    outputs = run_jobs(deck, [_job(statement, cards) for statement, cards in cases], keys)
    return [_outcome(statement, output) for (statement, _), output in zip(cases, outputs, strict=True)]


def _job(statement: Statement, cards: Sequence[str]) -> Job:
    values, addresses = statement.values, _addresses(statement)
    calls = call(VERBS[statement.verb], LABEL)
    for address in addresses:
        calls += call(LAST_ITEM if address == addresses[-1] else ITEM, address)
    stored = {CALLS: [*calls, *HALT], LABEL - 4: digits(WORDS, 5), WORDS + 1: format_positions(statement.spec)}
    for address, value in zip(addresses, values, strict=True):
        stored[address - 9] = floating_field(value) if "." in value else fixed_field(value)
    return Job(CALLS, stored, cards, [(addresses[-1] - 9, NUMBERS)] if addresses else [])


def _addresses(statement: Statement) -> list[int]:
    return [NUMBERS - 10 * k for k in range(len(statement.values))]


def _outcome(statement: Statement, output: Run) -> Outcome:
    numbers = tuple(
        field_text(output.field(address), "E" if "." in value else "I")
        for address, value in zip(_addresses(statement), statement.values, strict=True)
    )
    return Outcome(output.typed, output.punched, numbers, output.trouble)

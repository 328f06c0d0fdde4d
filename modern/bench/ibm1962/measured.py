"""Recorded input and output statements, with the results that IBM's library of 1962 gave in the simulator.

``tests/data/vectors/ibm1962.tsv`` has a line for each statement, with seven columns: the verb, the FORMAT, the numbers
of the list before the execution, the data cards, the typed lines, the punched cards without sequence numbers, and the
numbers of the list after the execution.  In the last five columns, a vertical bar follows each number, card and line.
The file contains no code by IBM.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, cycle, islice
from pathlib import Path

from emulator.language.formats import Literal, Slash
from emulator.numbers.fields import Field
from modern.bench.ibm1962.statements import BEFORE, Outcome, Statement, execute

FILE = Path(__file__).parents[3] / "tests" / "data" / "vectors" / "ibm1962.tsv"
SEQUENCE = 77


@dataclass(frozen=True, slots=True)
class Measured:
    """A recorded statement with its data cards and the result of IBM's library."""

    statement: Statement
    cards: tuple[str, ...]
    outcome: Outcome

    def line(self) -> str:
        """Return the statement and its result as a line of the file of recorded statements."""
        statement, outcome = self.statement, self.outcome
        punched = [card[:SEQUENCE].rstrip() for card in outcome.punched]
        typed = [line.rstrip() for line in outcome.typed]
        columns = (statement.values, self.cards, typed, punched, outcome.numbers)
        return "\t".join(
            (statement.verb, statement.text, *("".join(f"{entry}|" for entry in column) for column in columns))
        )


def measure(cases: Sequence[tuple[Statement, tuple[str, ...]]], deck: Sequence[str]) -> list[Measured]:
    """Execute statements with the library in ``deck``, and return them with the results.

    Raise Unavailable if the simulator is missing, or Failed if a run fails.
    """
    outcomes = execute(cases, deck)
    return [Measured(*case, outcome) for case, outcome in zip(cases, outcomes, strict=True)]


def load() -> list[Measured]:
    """Return all recorded statements with their results, from the file in the tests' data."""
    return [_parsed(line) for line in FILE.read_text(encoding="ascii").splitlines()]


def _parsed(line: str) -> Measured:
    verb, text, *columns = line.split("\t")
    values, cards, typed, punched, numbers = (tuple(column.split("|")[:-1]) for column in columns)
    return Measured(Statement(verb, text, values), cards, Outcome(typed, punched, numbers))


def same(first: Outcome, second: Outcome) -> bool:
    """Return True if two outcomes agree, apart from insignificant differences.

    Blank typed lines are ignored, because the library returns the carriage before each line.  The sign of an exponent
    of zero is ignored, because it has no effect.
    """
    return _comparable(first) == _comparable(second)


def _comparable(outcome: Outcome) -> tuple[object, ...]:
    typed = [line.rstrip() for line in outcome.typed if line.strip()]
    numbers = [n.replace("E-00", "E+00") for n in outcome.numbers]
    return typed, [card[:SEQUENCE].rstrip() for card in outcome.punched], numbers


def fields_at_random(seed: int) -> Iterator[tuple[Statement, tuple[str, ...]]]:
    """Yield endlessly many random statements, each of which writes one number with a FORMAT of one field."""
    r = random.Random(seed)
    while True:
        kind = r.choice("EEFFI")
        # An E field of fewer columns stores its exponent in the text of the error codes.
        width = r.randint(4 if kind == "E" else 1, 7 if kind == "I" else r.choice([16, 30]))
        field = f"{kind}{width}" + ("" if kind == "I" else f".{r.randint(0, width)}")
        yield Statement(r.choice(["TYPE", "PUNCH"]), f"({field})", [_number(r, kind)]), ()


def at_random(seed: int) -> Iterator[tuple[Statement, tuple[str, ...]]]:
    """Yield endlessly many random statements with their data cards.

    The statements contain fields, literals, skips, slashes, groups and errors.
    """
    r = random.Random(seed)
    while True:
        items = [_group(r) if r.random() < 0.2 else _spec(r) for _ in range(r.randint(1, 6))]
        text = f"({','.join(items)})".replace(",/,", "/")
        verb = r.choice(["TYPE", "PUNCH", "READ", "READ"])
        spec = Statement(verb, text).spec
        fields = [item for item in spec.specs if isinstance(item, Field)]
        repeated = [item for item in spec.specs[spec.again :] if isinstance(item, Field)]
        # A longer record causes ERROR F9, after which the library continues at a wrong position of the FORMAT.
        if max(spec.widths()) > 72 or not any(isinstance(item, Field | Literal | Slash) for item in spec.specs):
            continue
        count = min(r.randint(0, 2 * len(fields)), 8)
        kinds = ["I" if item.kind == "I" else "E" for item in islice(chain(fields, cycle(repeated)), count)]
        if verb == "READ":
            slashes = sum(isinstance(item, Slash) for item in spec.specs)
            cards = tuple(_card(r) for _ in range((count + 2) * (1 + slashes)))
            yield Statement(verb, text, [BEFORE[kind] for kind in kinds]), cards
        else:
            # Now and then a number has the wrong mode for its field.
            kinds = [kind if r.random() < 0.95 else r.choice("IE") for kind in kinds]
            yield Statement(verb, text, [_number(r, kind) for kind in kinds]), ()


def _group(r: random.Random) -> str:
    return f"{r.choice(['', '2', '3'])}({','.join(_spec(r) for _ in range(r.randint(1, 3)))})".replace(",/,", "/")


def _spec(r: random.Random) -> str:
    kind = r.choice("EEFFIIIHX/")
    if kind == "H":
        literal = "".join(r.choice("ABC XYZ=*0123.") for _ in range(r.randint(1, 5)))
        return f"{len(literal)}H{literal}"
    if kind == "X":
        return f"{r.randint(1, 4)}X"
    if kind == "/":
        return kind
    repeat = r.choice(["", "", "2"])
    if kind == "I":
        return f"{repeat}I{r.randint(1, 7)}"
    width = r.randint(5, 16)
    return f"{repeat}{kind}{width}.{r.randint(0, min(9, width - (4 if kind == 'F' else 3)))}"


def _number(r: random.Random, kind: str) -> str:
    if kind == "I":
        return str(r.choice([r.randint(-9999, 9999), r.randint(-99, 99), 0]))
    mantissa = r.choice(["00000000", f"{r.randint(10**7, 10**8 - 1)}", f"{r.randint(1, 9)}0000000"])
    exponent = -99 if mantissa == "00000000" else r.choice([r.randint(-3, 6), r.randint(-3, 6), r.randint(-99, 99)])
    return f"{r.choice(['', '', '-'])}.{mantissa}E{'-' if exponent < 0 else '+'}{abs(exponent):02}"


def _card(r: random.Random) -> str:
    pieces: Sequence[str] = [str(r.randint(0, 99)), f"{r.uniform(-99, 99):.3f}", " ", "   ", ".5E+01", "-7", "1.2E1 "]
    card = ""
    while len(card) < 72:
        card += r.choice([*pieces, str(r.randint(0, 9))])
    return card[:72].rstrip()

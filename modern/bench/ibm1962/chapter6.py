"""Run the examples of chapter 6 of the thesis on IBM's library of 1962, and compare every punched card with the print.

The programs are those that produced the examples.  Programs 2 and 3 read the cards that program 1 has punched on the
library.  The verdicts are in ``docs/ibm1962``, together with the hashes with which they can be verified.
"""

import hashlib
import subprocess
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import zip_longest

from emulator.errors import EmulatorError
from emulator.language.compiler import compile_deck
from emulator.language.objectcode import Program
from emulator.objectdeck.cards import object_cards
from modern.bench.ibm1962.objectdecks import CORE, execute, library, punched
from modern.bench.ibm1962.simulator import Failed, simulator
from modern.edition import programs
from modern.edition.chapter6 import EXAMPLES, Print, input_deck, prints
from modern.formats.columns import csv_text

FOLDER = "docs/ibm1962"
NAMES = ("program1_examples", "program2", "program3")
SAME, DIFFERENT = "same", "different"


@dataclass(frozen=True, slots=True)
class CardVerdict:
    """The verdict on one punched card.  ``card`` is the number of the card in the output of its run, from 1."""

    example: int
    program: int
    card: int
    verdict: str


def verdicts(examples: Sequence[int] = EXAMPLES) -> Iterator[CardVerdict]:
    """Run examples on the library, and yield the verdict on each printed card."""
    for example in examples:
        for printed in prints(example):
            if printed.device == "punch":
                cards = _cards(example, NAMES[printed.program - 1])
                yield from _judged(example, printed, cards)


def _judged(example: int, printed: Print, cards: Sequence[str]) -> Iterator[CardVerdict]:
    """Yield the verdict on each printed card, and on each punched card after the last printed card."""
    for number, (line, card) in enumerate(zip_longest(printed.lines, cards), 1):
        same = line is not None and card is not None and line.rstrip() == card.rstrip()
        yield CardVerdict(example, printed.program, number, SAME if same else DIFFERENT)


@cache
def _cards(example: int, name: str) -> tuple[str, ...]:
    """Return the cards that a program punches on the library.  Programs 2 and 3 read the cards of program 1."""
    return punched(execute(programs.program(name), _input(example, name)))


def _input(example: int, name: str) -> Sequence[str]:
    first = NAMES[0]
    return [card.text for card in input_deck(example).cards] if name == first else _cards(example, first)


def results() -> dict[str, str]:
    """Run all examples with all emendations and without each one, and return the result files as texts by name."""
    cards = [(row.example, row.program, row.card, row.verdict) for row in verdicts()]
    rows = [(name, *answer) for name in NAMES for answer in confirmed(name)]
    return {
        "chapter6.csv": csv_text((("example", "program", "card", "verdict"), *cards)),
        "apparatus.csv": csv_text((("program", "row", "answer"), *rows)),
        "means.toml": _means(),
    }


def digest(cards: Sequence[str]) -> str:
    """Return the SHA-256 of the cards, each without trailing blanks and followed by a line feed."""
    return hashlib.sha256("".join(f"{card.rstrip()}\n" for card in cards).encode("latin1")).hexdigest()


def _means() -> str:
    """Return TOML text that identifies the library and the programs by hashes, and the simulator by its version."""
    version = subprocess.run([simulator()], input=b"quit\n", capture_output=True, check=False).stdout.decode("latin1")
    title = next((line.strip() for line in version.splitlines() if "1620" in line), "unknown")
    lines = [f'library = "{digest(library())}"', f'simulator = "{" ".join(title.split())}"', "", "[programs]"]
    lines += [f'{name} = "{program_digest(name)}"' for name in NAMES]
    return "\n".join(lines) + "\n"


def program_digest(name: str) -> str:
    """Return the :func:`digest` of the object cards of a built-in program."""
    return digest(object_cards(programs.program(name), CORE))


def confirmed(name: str) -> Iterator[tuple[str, str]]:
    """Remove each emendation of a program in turn, and yield its identifier and the check that notices the removal.

    The check is ``compiler`` if the deck does not compile, and ``library`` if the cards punched on the library differ
    from the print or the run does not end.  If no check notices the removal, the second value is ``no change`` if the
    object program is the same, and ``nothing`` if it has changed but still punches the printed cards.
    """
    entry = programs.built_in(name)
    base = object_cards(programs.program(name), CORE)
    for row in programs.text(entry.text).rows:
        if row.layer not in entry.layers:
            continue
        try:
            program = compile_deck(programs.built(name, without=(row.id,)))
            cards = object_cards(program, CORE)
        except (EmulatorError, ValueError):
            yield row.id, "compiler"
            continue
        if cards == base:
            yield row.id, "no change"
            continue
        yield row.id, "library" if _differs(name, program) else "nothing"


def _differs(name: str, program: Program) -> bool:
    """Return True if a program does not end on IBM's library, or punches a card that differs from the print."""
    for example in EXAMPLES:
        for printed in prints(example):
            if printed.device != "punch" or NAMES[printed.program - 1] != name:
                continue
            try:
                cards = punched(execute(program, _input(example, name)))
            except Failed:
                return True
            if any(row.verdict == DIFFERENT for row in _judged(example, printed, cards)):
                return True
    return False

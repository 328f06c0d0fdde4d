"""The programs of tests/data/compiler_runs: the cards of two compilers of the time, and those of the emulator."""

import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from emulator.language.cards import deck_from_lines, read_deck
from emulator.language.compiler import compile_deck
from emulator.machine.machine import Machine
from emulator.machine.result import Options
from tests.support.paths import DATA

RUNS = DATA / "compiler_runs"
PROGRAMS = sorted(RUNS.glob("*.f"))
TOO_SMALL = re.compile(r"ER F8 *(?P<value>[-.0-9E+]+)\| *\|")


@dataclass(frozen=True)
class Punched:
    """A card of FORTRAN II-D, and the numbers that were too large for its fields."""

    text: str
    refused: tuple[str, ...] = ()


@cache
def punched(program: Path) -> tuple[str, ...]:
    """Return the cards that the emulator punches."""
    deck = deck_from_lines("data", data(program))
    result = Machine(compile_deck(read_deck(str(program))), deck, Options(hopper="any")).run()
    assert result.ending.normal
    return result.punched


def data(program: Path) -> list[str]:
    """Return the data cards of a program, or an empty list."""
    path = program.with_suffix(".deck")
    return path.read_text(encoding="ascii").splitlines() if path.exists() else []


def of_the_compiler(program: Path) -> list[Punched]:
    """Return the cards that FORTRAN II-D punched."""
    cards: list[Punched] = []
    refused: list[str] = []
    for line in program.with_suffix(".iid").read_text(encoding="ascii").splitlines():
        too_small = TOO_SMALL.fullmatch(line)
        if too_small:
            refused.append(too_small["value"])
            continue
        cards.append(Punched(line, tuple(refused)))
        refused = []
    return cards


def of_pdq(program: Path) -> list[str]:
    """Return the cards that PDQ FORTRAN punched, with exponents in the notation of II-D."""
    text = program.with_suffix(".pdq").read_text(encoding="ascii")
    return re.sub(r"E (?=\d\d)", "E+", text).replace("E-50", "E-99").splitlines()

"""What IBM's FORTRAN II-D punched for 23 programs (tests/data/compiler_runs), field by field beside the emulator.

Fields differ only in the classes below, each with its reason; which class may occur in which program is stated.
"""

from __future__ import annotations

import re
from collections import Counter
from decimal import ROUND_DOWN, Decimal
from pathlib import Path

import pytest

from emulator.language.cards import deck_from_lines, read_deck
from emulator.language.compiler import compile_deck
from emulator.machine.machine import Machine
from emulator.machine.result import Options
from tests.support.paths import DATA

RUNS = DATA / "compiler_runs"
PROGRAMS = sorted(RUNS.glob("*.f"))
NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d*)(?:E[+-]\d\d)?")
TOO_SMALL = re.compile(r"ER F8 *(?P<value>[-.0-9E+]+)\| *\|")

CLASSES = {
    "too small": "II-D types ER F8 and leaves the field blank; C26-5619 prints E14.8 (p. 39), low digits in I (p. 38)",
    "zeros": "II-D prints eight digits and blanks after them, and a zero before the point where there is room",
    "zero exponent": "the sign of an exponent of zero that an E field adjusted: II-D prints E-00",
    "sign of zero": "II-D's zeros have no minus sign but after an underflow",
    "series": "SIN, EXP, LOG, ATAN and powers to a floating exponent have the errors of II-D's series",
    "five digits": "a fixed-point number of five digits read by I6: II-D makes it 0, C26-5619 p. 14 keeps four",
    "blank exponent": "blanks in or after an exponent, of which the manual says nothing (OPEN-QUESTIONS 6)",
}
ALLOWED = {
    "e": {"too small": 7, "zero exponent": 3, "sign of zero": 0},
    "expr_101_07": {"sign of zero": 1},
    "f": {"too small": 36},
    "i": {"too small": 18, "five digits": 16},
    "l1": {"series": 9},
    "pow": {"series": 8},
    "pow2": {"series": 8},
    "r1": {"blank exponent": 4},
    "z1": {"sign of zero": 1},
}


def punched(program: Path) -> tuple[str, ...]:
    data = program.with_suffix(".deck")
    deck = (
        read_deck(str(data))
        if data.exists() and data.read_text(encoding="ascii").strip()
        else deck_from_lines("no data", [])
    )
    result = Machine(compile_deck(read_deck(str(program))), deck, Options(hopper="any")).run()
    assert result.ending.normal
    return result.punched


def of_the_compiler(program: Path) -> list[tuple[str, list[str]]]:
    """Each card II-D punched, and the numbers that were too large for their fields on it."""
    cards: list[tuple[str, list[str]]] = []
    refused: list[str] = []
    for line in program.with_suffix(".iid").read_text(encoding="ascii").splitlines():
        found = TOO_SMALL.fullmatch(line)
        if found:
            refused.append(found["value"])
            continue
        cards.append((line, refused))
        refused = []
    return cards


def differences(program: Path) -> Counter[str]:
    """How many fields of a program's cards differ, by class; a field that differs otherwise fails the test."""
    found: Counter[str] = Counter()
    ours, theirs = punched(program), of_the_compiler(program)
    assert len(ours) == len(theirs)
    for mine, (other, refused) in zip(ours, theirs, strict=True):
        if refused:
            for value in refused:
                assert holds(mine, value), (mine, value)
            found["too small"] += len(refused)
            continue
        if mine == other:
            continue
        if program.stem == "i" and {"0"} == set(NUMBER.findall(other)):
            # 12345 and -12345, in fields that cut the four digits kept in their turn.
            found["five digits"] += len(NUMBER.findall(other))
            continue
        assert NUMBER.sub("", mine).replace(" ", "") == NUMBER.sub("", other).replace(" ", ""), (mine, other)
        pairs = zip(NUMBER.findall(mine), NUMBER.findall(other), strict=True)
        found.update(kind for a, b in pairs if (kind := difference(program.stem, a, b)))
    return +found


def holds(card: str, value: str) -> bool:
    """Whether a card shows a number too large for its field: by E14.8, a whole one by its low-order digits."""
    if "E" in value:
        return value in card
    digits = NUMBER.findall(card[1:])
    return not digits or value.lstrip("-").endswith(digits[0].lstrip("-0") or "0")


def value(text: str) -> Decimal:
    """The number printed; a point alone is what an F field without decimals shows of a fraction."""
    return Decimal(text) if any(c.isdigit() for c in text) else Decimal(0)


def difference(program: str, mine: str, other: str) -> str:
    """The class of a difference between two numbers, empty where there is none."""
    a, b = value(mine), value(other)
    if mine == other:
        return ""
    if a == b == 0 and mine.lstrip("-") == other.lstrip("-"):
        return "sign of zero"
    if program == "r1":
        return "blank exponent"
    if program in ("l1", "pow", "pow2") and abs(a - b) <= Decimal("1E-5") * max(abs(b), Decimal("1E-2")):
        return "series"
    # An F field of II-D has no more decimals than digits of the number.
    if "E" not in other:
        a = a.quantize(b, ROUND_DOWN)
    assert a == b, (program, mine, other)
    return "zero exponent" if "E+00" in mine and "E-00" in other else "zeros"


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda program: program.stem)
def test_cards_are_those_of_fortran_ii_d(program: Path) -> None:
    found = differences(program)
    assert set(found) <= set(CLASSES)
    found.pop("zeros", None)
    assert found == +Counter(ALLOWED.get(program.stem, {}))


def test_all_programs_are_there() -> None:
    assert len(PROGRAMS) == 23


@pytest.mark.parametrize(
    ("mine", "other"), [(".2E+01", ".3E+01"), (".20000000E+01", "-.20000000E+01"), ("-.00000000E-99", ".10000000E-98")]
)
def test_a_number_that_differs_is_noticed(mine: str, other: str) -> None:
    with pytest.raises(AssertionError):
        difference("dz", mine, other)

"""Signs of zero: II-D follows its own rule, PDQ and the thesis that of the emulator (OPEN-QUESTIONS 16)."""

from __future__ import annotations

import re
from fractions import Fraction
from pathlib import Path

import pytest

from tests.support.compiler_runs import PROGRAMS, RUNS, of_pdq, of_the_compiler, punched
from tests.support.deckwork import run


class Signed:
    """An exact number with a signed zero, under II-D's rule: every operation sets the sign at once."""

    def __init__(self, value: Fraction, minus: bool = False) -> None:
        self.value, self.minus = value, minus and value == 0

    def __add__(self, other: Signed) -> Signed:
        return Signed(self.value + other.value)

    def __sub__(self, other: Signed) -> Signed:
        return Signed(self.value - other.value)

    def __mul__(self, other: Signed) -> Signed:
        return Signed(self.value * other.value)

    def __truediv__(self, other: Signed) -> Signed:
        return Signed(self.value / other.value)

    def __pow__(self, power: int) -> Signed:
        return Signed(self.value**power)

    def __neg__(self) -> Signed:
        return Signed(-self.value, not self.minus)


def zeros_of(program: Path) -> list[tuple[str, str, str]]:
    """Return the expressions for which II-D prints zero: text, sign by II-D's rule, and sign printed."""
    data = program.with_suffix(".deck").read_text(encoding="ascii").splitlines()
    names: dict[str, Signed] = {}
    found = []
    cards = (card.text for card in of_the_compiler(program))
    numbers = (Fraction(field.strip()) for card in data for field in re.findall(".{14}", card))
    for line in program.read_text(encoding="ascii").splitlines():
        text = line.strip()
        if text.startswith("READ 1,"):
            names |= {name: Signed(next(numbers)) for name in text.split(",")[1:]}
        elif text.startswith("R="):
            card = next(cards)
            if not re.search("[1-9]", card.partition("E")[0]):
                written = re.sub(r"(?<![\w.])(\d+\.\d*|\.\d+)(E-?\d+)?", r"Signed(Fraction('\g<0>'))", text[2:])
                result = eval(written, {"Signed": Signed, "Fraction": Fraction}, names)
                assert result.value == 0, text
                found.append((text, "-" if result.minus else " ", card[0]))
        elif text.startswith("N="):
            next(cards)
    return found


def test_fortran_ii_d_applies_each_unary_minus_in_place() -> None:
    """One rule explains the zeros of z1 and of 450 random expressions: only a final unary minus gives -0."""
    found = {program.stem: zeros_of(program) for program in PROGRAMS if program.stem.startswith(("z1", "expr"))}
    assert all(rule == printed for zeros in found.values() for _, rule, printed in zeros)
    assert [len(found[name]) for name in ("z1", "expr_101_07")] == [15, 1]
    assert [text for text, rule, _ in found["z1"] if rule == "-"] == ["R=-0.", "R=-D"]


def test_pdq_has_the_zero_signs_of_the_emulator() -> None:
    """In all of z1 a unary minus of a factor is applied last.  Only -(C)**2 loses its minus in PDQ."""
    program = RUNS / "z1.f"
    theirs = of_pdq(program)
    lines = [line.strip() for line in program.read_text(encoding="ascii").splitlines() if "=" in line]
    differ = [
        (line, mine, other) for line, mine, other in zip(lines, punched(program), theirs, strict=True) if mine != other
    ]
    assert differ == [("R=-(C)**2", "-.10000000E+01", " .10000000E+01")]


@pytest.mark.parametrize(
    ("expression", "rule", "thesis"),
    [("(Y)*(B)*(-Y)", " ", "-"), ("((-C))-((-C))", " ", "-"), ("A-B*C", " ", "-"), ("-D", "-", "-")],
)
def test_no_single_rule_gives_the_zeros_of_both(expression: str, rule: str, thesis: str) -> None:
    """The thesis prints -.00000000E-99 for a sum that ends in minus a product, and so does the emulator."""
    names = {
        name: Signed(Fraction(n)) for name, n in zip("ABCDY", (2, 0 if "Y" in expression else 1, 2, 0, 1), strict=True)
    }
    assert (" ", "-")[eval(expression, {}, names).minus] == rule
    lines = [f"{name}={number.value}." for name, number in names.items()]
    (card,) = run(*lines, f"R={expression}", "PUNCH 1,R", "1 FORMAT(E14.8)", "END").punched
    assert card == f"{thesis}.00000000E-99"

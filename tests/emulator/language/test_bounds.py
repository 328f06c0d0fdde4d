"""Sources of any shape are answered in time and memory in proportion to their cards.

Shapes at full size (9,999 cards) run in a process of their own, whose processor time and memory are limits of the
operating system; all others are compiled at two sizes and the calls of functions counted, which are the same on every
machine.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from types import FrameType

import pytest

from emulator.language import parser, statements
from emulator.language.cards import deck_from_lines
from emulator.language.compiler import translate
from emulator.language.objectcode import code_positions, repeats
from tests.support.deckwork import errors, program

CARDS = 9_999
SECONDS, MEGABYTES = 5, 300


def continued(first: str, more: str, cards: int) -> list[str]:
    """One statement on so many cards."""
    return ["      " + first, *["     1" + more] * (cards - 2)]


SHAPES: dict[str, Callable[[int], list[str]]] = {
    "GO TO a number there is not": lambda n: [f"GO TO {k % 9999 + 1}" for k in range(n)],
    "IF to numbers there are not": lambda n: [f"IF(A){k + 1},{k + 2},{9999 - k}" for k in range(n)],
    "computed GO TO": lambda n: [f"GO TO({','.join(str(1000 + k * j) for j in range(12))}),I" for k in range(n)],
    "DO without an end": lambda n: [f"DO {k % 9998 + 1} I=1,2" for k in range(n)],
    "DO to one end": lambda n: [*(f"DO 9999 I{k}=1,2" for k in range(n - 1)), "9999 CONTINUE"],
    "DO in DO": lambda n: [
        *(f"DO {9999 - k} I=1,2" for k in range(n // 2)),
        *(f"{k} CONTINUE" for k in range(9999 - n // 2 + 1, 10_000)),
    ],
    "DO across DO": lambda n: [
        *(f"DO {k + 1} I=1,2" for k in range(n // 2)),
        *(f"{k + 1} CONTINUE" for k in range(n // 2)),
    ],
    "numbers in a DO": lambda n: [*["DO 9999 I=1,2"] * (n // 2), *(f"{k + 1} A=1." for k in range(n // 2))],
    "DO to a number before": lambda n: [
        *(f"{k + 1} CONTINUE" for k in range(n // 2)),
        *(f"DO {k + 1} I=1,2" for k in range(n // 2)),
    ],
    "a number twice": lambda n: [f"{k % 50 + 1} A=1." for k in range(n)],
    "FORMATs": lambda n: [
        *(f"{k + 1} FORMAT(I5)" for k in range(n // 2)),
        *(f"PUNCH {k + 1},I" for k in range(n // 2)),
    ],
    "FORMATs there are not": lambda n: [f"PUNCH {k % 9999 + 1},A" for k in range(n)],
    "FORMATs of many fields": lambda n: [f"{k + 1} FORMAT(2000I{k % 80 + 1})" for k in range(n)],
    "FORMATs of wide fields": lambda n: [f"{k + 1} FORMAT(9999X,{9999 - k}X,9000X)" for k in range(n)],
    "FORMATs of too many fields": lambda n: [f"{k + 1} FORMAT(9999(1999(I2)))" for k in range(n)],
    "FORMATs with a wrong width": lambda n: [f"{k + 1} FORMAT(9HA,3HB,I5)" for k in range(n)],
    "a chain of IFs": lambda n: [*(f"{k + 1} IF(A-B){k + 1},{k + 2},1" for k in range(n)), f"{n + 1} STOP"],
    "arrays": lambda n: [f"DIMENSION A{k % 26}{k // 26}(9)" for k in range(n)],
    "an array twice": lambda n: ["DIMENSION X(9),X(9),X(9),X(9),X(9)" for _ in range(n)],
    "subscripts": lambda n: ["DIMENSION X(9,9)", *(f"X({k}*I+1,J+{k})=X(I+{k},J-3)" for k in range(1, n))],
    "array names in a list": lambda n: ["DIMENSION X(5000)", "1 FORMAT(I5)", *["PUNCH 1" + ",X" * 30] * n],
    "indexed lists": lambda n: ["1 FORMAT(I5)", *(f"PUNCH 1,((I,I=1,2),J=1,{k})" for k in range(1, n))],
    "names": lambda n: [f"A{k}=B{k}+C{k}*D{k}" for k in range(n)],
    "names too long": lambda n: [f"ABCDEF{k}=1." for k in range(n)],
    "constants": lambda n: [f"A={k}.{k}+{k}.5*3.{k}" for k in range(n)],
    "functions there are not": lambda n: [f"A=F{k % 999}(B)+G{k % 999}(C)" for k in range(n)],
    "no statement": lambda n: ["A=B+*C", "XYZZY", "GO TO", "SUBROUTINE X", "END"] * (n // 5),
    "mixed modes": lambda n: ["A=I+B"] * n,
    "cards after END": lambda n: ["END", *["A=1."] * n],
    "comments like statements": lambda n: ["CONTINU", "C=A+"] * (n // 2),
    "a long sum": lambda n: continued("A=B", "+C" * 33, n),
    "a long product": lambda n: continued("A=B", "+C*(D)*(-E*F)" * 5, n),
    "a sum in parentheses": lambda n: [*continued("A=" + "(" * 40 + "B", "+(((((C)))))" * 5, n // 4)[:-1], "     1)"],
    "parentheses": lambda n: continued("A=B", "+" + "(" * 60, n),
    "a longer statement": lambda n: continued("A=B", "+C" * 33, 4 * n),
    "a longer FORMAT": lambda n: continued("1 FORMAT(I5", ",I1" * 22, 4 * n),
    "a long list": lambda n: ["1 FORMAT(I5)", *continued("PUNCH 1", ",I" * 33, n)],
}


def calls(cards: list[str]) -> int:
    """How many functions a compilation calls, built-in ones too."""
    deck = deck_from_lines("shape.f", [*cards, "END"])
    for remembered in (parser._short_tree, parser.parse_statement, statements._source):
        remembered.cache_clear()
    count = 0

    def called(_frame: FrameType, event: str, _: object) -> None:
        nonlocal count
        count += event in ("call", "c_call")

    sys.setprofile(called)
    try:
        translate(deck)
    finally:
        sys.setprofile(None)
    return count


@pytest.mark.parametrize("name", SHAPES)
def test_work_grows_linearly_with_the_cards(name: str) -> None:
    """Work in proportion to the square would be four times as much."""
    shape = SHAPES[name]
    calls(shape(20))  # what is done once
    assert calls(shape(120)) < 2.5 * calls(shape(60))


FULL = ("GO TO a number there is not", "numbers in a DO", "FORMATs of wide fields")


@pytest.mark.parametrize("name", FULL)
def test_9999_cards_compile_within_time_and_memory(name: str) -> None:
    """In the processor time and with the memory the operating system allows.

    The most memory a process had counts, where it can be told, from its own start: not what its parent had.
    """
    source = "\n".join([*SHAPES[name](CARDS - 1), "END", ""])
    script = (
        "import pathlib, re, resource, sys\n"
        f"resource.setrlimit(resource.RLIMIT_CPU, ({2 * SECONDS}, {2 * SECONDS}))\n"
        "from emulator.language.cards import deck_from_text\n"
        "from emulator.language.compiler import translate\n"
        "translate(deck_from_text('shape.f', sys.stdin.read()))\n"
        "used = resource.getrusage(resource.RUSAGE_SELF)\n"
        "status = pathlib.Path('/proc/self/status')\n"
        "own = re.search(r'VmHWM:\\s+(\\d+)', status.read_text()) if status.exists() else None\n"
        "print(used.ru_utime + used.ru_stime, own[1] if own else used.ru_maxrss)\n"
    )
    run = subprocess.run([sys.executable, "-c", script], input=source, text=True, capture_output=True, check=True)
    seconds, kilobytes = map(float, run.stdout.split())
    assert seconds < SECONDS
    assert kilobytes < MEGABYTES * 1024


def test_array_in_a_list_is_a_single_instruction() -> None:
    """With its length in core as of one for each element, as before."""
    lines = ["DIMENSION X(7),M(2,3)", "PUNCH 1,X,M,A", "1 FORMAT(7E14.8,6I2,E14.8)", "END"]
    items = [instruction for instruction in program(*lines).code if repeats(instruction) > 1]
    assert [(i.address, i.second, repeats(i)) for i in items] == [(0, 7, 7), (7, -6, 6)]
    elements = [f"X({k})" for k in range(1, 8)] + [f"M({i},{j})" for j in (1, 2, 3) for i in (1, 2)]
    single = lines[0], f"PUNCH 1,{','.join(elements[:7])}", f"     1,{','.join(elements[7:])},A", *lines[2:]
    assert code_positions(program(*lines)) == code_positions(program(*single))


def test_statement_beyond_the_largest_machine_is_rejected() -> None:
    """And not longer: what follows is not parsed."""
    assert errors(*continued("A=B", "+C" * 33, 290), "END") == ()
    (message,) = errors(*continued("A=B", "+C" * 33, 400), "END")
    assert (message.card, message.message) == (1, "a statement of more than 20000 characters")


def test_formats_beyond_the_largest_machine_give_one_message() -> None:
    """One message, at the first beyond, in place of as many as there are."""
    found = errors(*(f"{k} FORMAT(2000I5)" for k in range(1, 100)), "END")
    assert [(m.card, m.message[:7]) for m in found] == [(7, "OVERLAP")]

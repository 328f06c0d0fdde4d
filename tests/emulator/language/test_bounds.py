"""The compiler needs time and memory in proportion to the cards of a source, whatever its shape.

Every shape is compiled at two sizes and its function calls are counted, which do not depend on the machine.  Two
shapes are also compiled at full size (9,999 cards) in a separate process with limited processor time.
"""

import subprocess
import sys
from collections.abc import Callable
from types import FrameType

import pytest

from emulator.language import parser, statements
from emulator.language.cards import deck_from_lines
from emulator.language.compiler import translate
from emulator.language.objectcode import repeats
from emulator.objectdeck.extent import code_positions
from tests.support.deckwork import errors, program

CARDS = 9_999
SECONDS, MEGABYTES = 5, 300


def continued(first: str, more: str, cards: int) -> list[str]:
    """Return a single statement on the given number of cards."""
    return ["      " + first, *["     1" + more] * (cards - 2)]


SHAPES: dict[str, Callable[[int], list[str]]] = {
    "GO TO a number that does not exist": lambda n: [f"GO TO {k % 9999 + 1}" for k in range(n)],
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
    "a number twice": lambda n: [f"{k % 50 + 1} A=1." for k in range(n)],
    "FORMATs": lambda n: [
        *(f"{k + 1} FORMAT(I5)" for k in range(n // 2)),
        *(f"PUNCH {k + 1},I" for k in range(n // 2)),
    ],
    "FORMATs that do not exist": lambda n: [f"PUNCH {k % 9999 + 1},A" for k in range(n)],
    "FORMATs of wide fields": lambda n: [f"{k + 1} FORMAT(9999X,{9999 - k}X,9000X)" for k in range(n)],
    "FORMATs with a wrong width": lambda n: [f"{k + 1} FORMAT(9HA,3HB,I5)" for k in range(n)],
    "a chain of IFs": lambda n: [*(f"{k + 1} IF(A-B){k + 1},{k + 2},1" for k in range(n)), f"{n + 1} STOP"],
    "arrays": lambda n: [f"DIMENSION A{k % 26}{k // 26}(9)" for k in range(n)],
    "subscripts": lambda n: ["DIMENSION X(9,9)", *(f"X({k}*I+1,J+{k})=X(I+{k},J-3)" for k in range(1, n))],
    "array names in a list": lambda n: ["DIMENSION X(5000)", "1 FORMAT(I5)", *["PUNCH 1" + ",X" * 30] * n],
    "indexed lists": lambda n: ["1 FORMAT(I5)", *(f"PUNCH 1,((I,I=1,2),J=1,{k})" for k in range(1, n))],
    "names": lambda n: [f"A{k}=B{k}+C{k}*D{k}" for k in range(n)],
    "constants": lambda n: [f"A={k}.{k}+{k}.5*3.{k}" for k in range(n)],
    "functions that do not exist": lambda n: [f"A=F{k % 999}(B)+G{k % 999}(C)" for k in range(n)],
    "no statement": lambda n: ["A=B+*C", "XYZZY", "GO TO", "SUBROUTINE X", "END"] * (n // 5),
    "mixed modes": lambda n: ["A=I+B"] * n,
    "cards after END": lambda n: ["END", *["A=1."] * n],
    "a long product": lambda n: continued("A=B", "+C*(D)*(-E*F)" * 5, n),
    "a sum in parentheses": lambda n: [*continued("A=" + "(" * 40 + "B", "+(((((C)))))" * 5, n // 4)[:-1], "     1)"],
    "parentheses": lambda n: continued("A=B", "+" + "(" * 60, n),
    "a longer FORMAT": lambda n: continued("1 FORMAT(I5", ",I1" * 22, 4 * n),
    "a long list": lambda n: ["1 FORMAT(I5)", *continued("PUNCH 1", ",I" * 33, n)],
}


def calls(cards: list[str]) -> int:
    """Return the number of function calls of a compilation, with those of built-in functions."""
    deck = deck_from_lines("shape.f", [*cards, "END"])
    for cached_function in (parser._tree, parser.parse_statement, statements._source):
        cached_function.cache_clear()
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
    """Quadratic work would grow by a factor of four."""
    shape = SHAPES[name]
    calls(shape(20))  # fill the caches and load the grammar
    assert calls(shape(80)) < 2.5 * calls(shape(40))


FULL = ("numbers in a DO", "FORMATs of wide fields")


@pytest.mark.parametrize("name", FULL)
def test_9999_cards_compile_within_time_and_memory(name: str) -> None:
    """The peak memory is that of the process alone, if the system reports it, and otherwise includes its parent's."""
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
    """Its length in core is that of one instruction per element."""
    lines = ["DIMENSION X(7),M(2,3)", "PUNCH 1,X,M,A", "1 FORMAT(7E14.8,6I2,E14.8)", "END"]
    items = [instruction for instruction in program(*lines).code if repeats(instruction) > 1]
    assert [(i.address, i.second, repeats(i)) for i in items] == [(0, 7, 7), (7, -6, 6)]
    elements = [f"X({k})" for k in range(1, 8)] + [f"M({i},{j})" for j in (1, 2, 3) for i in (1, 2)]
    single = lines[0], f"PUNCH 1,{','.join(elements[:7])}", f"     1,{','.join(elements[7:])},A", *lines[2:]
    assert code_positions(program(*lines)) == code_positions(program(*single))


def test_code_beyond_the_largest_machine_gives_one_message() -> None:
    # Characters beyond the limit are not parsed.
    assert errors(*continued("A=B", "+C" * 33, 290), "END") == ()
    (message,) = errors(*continued("A=B", "+C" * 33, 400), "END")
    assert (message.card, message.message) == (1, "the statement has more than 20000 characters")
    # There is one message, at the first FORMAT beyond the limit.
    messages = errors(*(f"{k} FORMAT(2000I5)" for k in range(1, 100)), "END")
    assert [(m.card, m.message[:7]) for m in messages] == [(7, "OVERLAP")]

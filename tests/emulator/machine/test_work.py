"""Work counted against the limit: a unit for a plain statement, more for operations that take longer."""

import subprocess
import sys
import time
from collections.abc import Sequence
from fractions import Fraction

import pytest

from emulator.language.cards import deck_from_lines
from emulator.machine.machine import Machine
from emulator.machine.result import Options
from emulator.numbers import numbers
from emulator.numbers.exact import Exact
from emulator.numbers.multiprecision import MultiprecisionNumbers
from emulator.numbers.roots import square_root
from tests.support.deckwork import agreed, machine, program

DEFAULTS = ("truncating", "ibm1962", "truncating:28", "rounding:28", "float64", "float32")
SHORT_POWERS = "B=A**3*A**(-1)*A**J"
PLAIN: dict[str, tuple[list[str], int]] = {
    "statements": (["A=1.", "B=A", "IF(A)1,1,2", "1 STOP", "2 CONTINUE"], 5),
    "a loop": (["DO 1 I=1,10", "1 A=I"], 12),
    "a card full of operations": (["B=1.", "A=" + "+".join("B" * 32)], 3),
    "roots": (["A=2.", "DO 1 I=1,9", "1 B=SQRT(A)+SQRT(A)"], 12),
    "small powers": (["A=2.", "J=4", SHORT_POWERS], 4),
    "a list": (["A=1.", "PUNCH 1,(A,I=1,3),A", "1 FORMAT(2E14.8)"], 3 + 3 + 4 + 2),
    "an array": (["DIMENSION M(4)", "DO 2 I=1,4", "2 M(I)=I", "PUNCH 1,M", "1 FORMAT(I5)"], 7 + 4 + 4),
    "an error": (["Z=0.", "A=1./Z"], 3),
}


def finished(lines: Sequence[str], arithmetic: str, limit: int = 10_000_000) -> Machine:
    """Return a machine after its run."""
    costly_machine = machine(*lines, "END", arithmetic=arithmetic, limit=limit)
    costly_machine.run()
    return costly_machine


@pytest.mark.parametrize("name", PLAIN)
@pytest.mark.parametrize("arithmetic", DEFAULTS)
def test_plain_programs_count_statements_passes_numbers_and_lines(arithmetic: str, name: str) -> None:
    """An arithmetic that types its error codes also counts these lines."""
    lines, count = PLAIN[name]
    announced = arithmetic == "ibm1962" and name == "an error"
    state = finished(lines, arithmetic).state
    assert (state.work, state.costly) == (count + announced, 0)


COSTLY = [
    ("truncating", "B=SIN(A)", 1, 4),
    ("truncating", "B=A**.3", 5, 8),
    ("truncating", "B=A**9999", 0, 0),
    ("truncating:28", "B=A**9999", 0, 0),
    ("ibm1962", "B=A**9999", 140, 160),
    ("truncating", "B=A" + "*A" * 199, 4, 6),
    ("float64", "B=A**9999", 0, 0),
    ("mp:53", "B=A*A", 0, 0),
    ("mp:10000", "B=A*A", 3, 4),
    ("mp:100000", "B=A*A", 110, 130),
    ("mp:100000", "B=A/3.", 400, 500),
    ("mp:100000", "B=EXP(A)", 20_000, 30_000),
    ("mp:20000", "B=A**.3", 3_500, 4_500),
    ("mp:100000", "B=A**9999", 3_000, 4_500),
    ("exact", "B=A*A", 0, 0),
    ("exact", "B=A**999", 20, 300),
]


@pytest.mark.parametrize(("arithmetic", "statement", "least", "most"), COSTLY)
def test_costly_operations_count_in_proportion_to_their_time(arithmetic, statement, least, most) -> None:
    """The count excludes the plain unit of each statement. It is an estimate, made before the operation is done."""
    lines = ["A=1.0000123", *[statement[k : k + 66] for k in range(0, len(statement), 66)]]
    lines[2:] = ["     1" + line for line in lines[2:]]
    state = finished(lines, arithmetic).state
    assert least <= state.work - 3 <= most


LONG, LONGER = 3**1900, 7**10_700  # 3,012 and 30,039 bits
THIRDS, SUM = Fraction(LONG, LONG + 2), square_root(2) * Fraction(3**630, 7**356) + square_root(3)
# An operation of exact arithmetic, its operands, the steps of 1.2 microseconds that it took when measured, and the
# largest permitted estimate.
STEPS_OF_EXACT: list[tuple[str, Exact, Exact, int, int]] = [
    ("add", LONG, LONG, 0, 1),
    ("add", LONGER, LONG, 1, 5),
    ("multiply", LONG, LONG, 3, 25),
    ("divide", LONG, LONG + 2, 2, 130),
    ("add", THIRDS, Fraction(1, LONG), 13, 130),
    ("multiply", THIRDS, LONG, 8, 130),
    ("SQRT", THIRDS, 0, 27, 75),
    ("card", THIRDS, 0, 12, 120),
    ("to_integer", LONGER, 0, 9, 5_000),
    ("sign", THIRDS, 0, 0, 0),
    ("add", SUM, SUM, 9, 80),
    ("add", SUM, 1, 3, 30),
    ("multiply", SUM, SUM, 25, 120),
    ("divide", LONG, SUM, 81, 15_000),
    ("sign", SUM, 0, 3, 40),
    ("card", SUM, 0, 22, 240),
    ("to_integer", SUM, 0, 14, 240),
    ("integer_power", 3**63, 99, 15, 300),
    ("integer_power", Fraction(1, 3**63), 99, 23, 2_000),
    ("power", Fraction(3**63, 2), Fraction(-99), 32, 2_000),
    ("power", SUM, SUM, 0, 0),
    ("integer_power", -1, 9_999, 0, 0),
    ("integer_power", LONG, 9_999, 0, 0),
    ("integer_power", square_root(2) * THIRDS, 9, 530, 16_000),
]


@pytest.mark.parametrize(
    ("operation", "first", "second", "measured", "most"),
    STEPS_OF_EXACT,
    ids=[f"{row[0]}{n}" for n, row in enumerate(STEPS_OF_EXACT)],
)
def test_estimates_of_exact_operations_are_not_below_their_time(operation, first, second, measured, most) -> None:
    """Operations that are refused before they begin cost nothing."""
    assert measured <= numbers("exact").work(operation, first, second) <= most


@pytest.mark.parametrize("statement", ["B=EXP(A)", "B=A**A"])
def test_an_operation_far_beyond_the_limit_is_not_done(statement: str, monkeypatch) -> None:
    """The message names the statement and a remedy."""
    for name in ("function", "power"):
        monkeypatch.setattr(MultiprecisionNumbers, name, None)
    costly_machine = machine("A=1.0000123", f"7 {statement}", "GO TO 7", "END", arithmetic="mp:100000", limit=50)
    ending = costly_machine.run().ending
    assert (ending.kind, ending.line and ending.line.label, ending.normal) == ("limit", 7, False)
    assert ending.message == (
        f"deck.f: card 2: one operation would exceed the limit (the work of 50 statements), in 7 {statement}; "
        "use a larger --limit or numbers of fewer digits"
    )


def test_the_message_about_a_costly_loop_gives_the_work() -> None:
    ending = machine("A=.5", "1 B=EXP(A)", "GO TO 1", "END", limit=1_000).run().ending
    assert ending.message == (
        "deck.f: stopped after the work of 1000 statements, of which costly operations account for 469; "
        "the last statements form a loop on cards 2 to 3, statement 1"
    )


ENDLESS = [
    ["A=1.0000123", "J=9999", "1 B=A**J", "GO TO 1"],
    ["A=.5", "1 A=EXP(A)-A", "GO TO 1"],
    ["A=0.", "B=1.", "1 A=A+1./B", "B=B+1.", "GO TO 1"],
    ["A=1.1", "1 A=A*1.01-.1", "GO TO 1"],
    ["A=2.", "S=0.", "1 S=S+SQRT(A)", "A=A+1.", "IF(S)2,1,1", "2 STOP"],
    ["A=1.", "Z=0.", "1 B=A" + "/Z" * 30, "GO TO 1"],
    ["A=1.", "3 A=A/3.", "1 PUNCH 2,A,A,A", "2 FORMAT(3E14.8)", "IF(A)3,1,1"],
    ["DIMENSION X(999)", "DO 3 I=1,999", "3 X(I)=1.", "1 PUNCH 2,X", "2 FORMAT(200(9X),E14.8)", "GO TO 1"],
]


@pytest.mark.parametrize("arithmetic", [*DEFAULTS, "mp:53", "mp:1000", "mp:20000", "mp:100000", "exact"])
def test_a_unit_of_work_takes_about_the_same_time_everywhere(arithmetic: str) -> None:
    """5,000,000 units may take five minutes; the test allows twice that, because other processes may be running."""
    for lines in ENDLESS:
        costly_machine = machine(*lines, "END", arithmetic=arithmetic, limit=1_500)
        begun = time.process_time()
        costly_machine.run(output=lambda _: None)
        seconds = time.process_time() - begun
        assert seconds < 0.2 + 2 * 60e-6 * max(costly_machine.state.work, 1_500), (lines, costly_machine.state.work)


GROWING = [
    ["A=1.5", "1 A=A*A", "GO TO 1"],
    ["A=SQRT(2.)+1.", "1 A=A*A", "GO TO 1"],
    ["A=1./3.", "B=SQRT(A)", "1 B=B+B*A+SQRT(A)", "A=A/7.", "GO TO 1"],
    ["A=1.5", "1 A=A**97", "GO TO 1"],
]


@pytest.mark.parametrize("lines", GROWING)
def test_growing_exact_numbers_reach_the_limit_before_they_fill_the_memory(lines: list[str]) -> None:
    """The process has half a gigabyte of address space."""
    script = (
        "import resource, sys\n"
        "resource.setrlimit(resource.RLIMIT_AS, (1 << 29, 1 << 29))\n"
        "from emulator.language.cards import deck_from_lines\n"
        "from emulator.language.compiler import compile_deck\n"
        "from emulator.machine.machine import Machine\n"
        "from emulator.machine.result import Options\n"
        "from emulator.numbers import numbers\n"
        "program = compile_deck(deck_from_lines('deck.f', sys.stdin.read().split('\\n')))\n"
        "options = Options(numbers=numbers('exact'), limit=100_000)\n"
        "print(Machine(program, deck_from_lines('d', []), options).run().ending.kind)\n"
    )
    text = "\n".join([*lines, "END"])
    run = subprocess.run([sys.executable, "-c", script], input=text, text=True, capture_output=True, check=False)
    assert (run.stdout.strip() in ("limit", "undecided"), run.stderr) == (True, "")


@pytest.mark.parametrize("arithmetic", ["truncating", "ibm1962", "rounding:9"])
@pytest.mark.parametrize("limit", [1, 7, 100, 101, 102, 103, 5_000, 12_345])
def test_both_engines_count_the_same_work(arithmetic: str, limit: int) -> None:
    """Long statements, errors, multiplied powers, long FORMATs and arrays: both runs end at the same statement."""
    lines = ["DIMENSION X(60)", "A=1.0001", "J=999", "Z=0.", "DO 1 I=1,60", "1 X(I)=A"]
    lines += [
        "5 B=A" + "*A" * 33,
        "     1" + "*A" * 30,
        "C=A/Z/Z/Z",
        f"D={'A**J' if arithmetic == 'ibm1962' else 'A**2'}",
    ]
    lines += ["PUNCH 3,X,A", "PUNCH 4", "A=A+.0001", "GO TO 5", "3 FORMAT(40(1X),2F5.2)", "4 FORMAT(35(1X),1HA)", "END"]
    options = Options(numbers=numbers(arithmetic), limit=limit)
    assert agreed(program(*lines), [deck_from_lines("deck", ["1"])], options) == 1

"""The published vectors (``tests/data/vectors/published``) as FORTRAN, on the interpreter and on the compiled engine.

Every line is a run: the program reads the operands from a card and performs the operation in one statement, and the
test compares the result in core or on the punched card.
"""

from collections.abc import Iterator
from functools import cache

import pytest

from emulator.compiled import devices
from emulator.compiled.runner import MAX_DIGITS, Runner, packed
from emulator.errors import EmulatorError
from emulator.language.cards import Deck, deck_from_lines
from emulator.language.objectcode import Program
from emulator.machine.machine import Machine
from emulator.machine.result import Options
from emulator.numbers import numbers
from emulator.numbers.arithmetic import FIXED_POINT, MINUS_ZERO
from tests.support.deckwork import pair, program
from tests.support.published.lines import Vector, load, names

Outcome = tuple[str, str]
"""Result and error code."""

STATEMENTS = {
    "add": "D=A+B",
    "subtract": "D=A-B",
    "subtractfrom": "D=-A+B",
    "multiply": "D=A*B",
    "divide": "D=A/B",
    "power": "D=A**J",
    "squareroot": "D=SQRT(A)",
    "negate": "D=-A",
    "fix": "M=A",
    "float": "D=I",
    "fixadd": "M=I+J",
    "fixsubtract": "M=I-J",
    "fixmultiply": "M=I*J",
    "fixdivide": "M=I/J",
}
BRANCHES = {"if": "A", "compare": "A-B", "fixcompare": "I-J"}
WAYS = ("", "negative", "zero", "positive")
DEFERRED = {"power", "read", "readfixed", "fix"}
"""Operations with cases that the compiled engine leaves to the interpreter: some powers, remarks, and -0."""
FLOATING, FIXED = "E36.0", "I5"
"""The fields that read the operands, wide enough for 28 digits."""


@cache
def compiled(operation: str, field: str) -> Program:
    """Return the program of an operation.  ``field`` is empty except for operations that read or write a field."""
    if operation.startswith("read"):
        name = "M" if operation == "readfixed" else "D"
        return program(f"READ 1,{name}", f"1 FORMAT({field})", "END")
    if operation.startswith("write"):
        name, operand_field = ("I", FIXED) if operation == "writefixed" else ("A", FLOATING)
        return program(f"READ 1,{name}", f"PUNCH 2,{name}", f"1 FORMAT({operand_field})", f"2 FORMAT({field})", "END")
    if operation in BRANCHES:
        work = [
            f"IF({BRANCHES[operation]})11,12,13",
            "11 M=1",
            "GO TO 20",
            "12 M=2",
            "GO TO 20",
            "13 M=3",
            "20 CONTINUE",
        ]
        uses = BRANCHES[operation]
    else:
        work, uses = [STATEMENTS[operation]], STATEMENTS[operation].replace("SQRT", "").partition("=")[2]
    names_read = [name for name in "ABIJ" if name in uses]
    fields = ",".join(FIXED if name in "IJ" else FLOATING for name in names_read)
    return program(f"READ 1,{','.join(names_read)}", f"1 FORMAT({fields})", *work, "END")


def card(vector: Vector) -> Deck:
    """Return the card with the operands of a vector."""
    if vector.operation.startswith("read"):
        return deck_from_lines("data", [vector.operands[1]])
    operands = vector.operands[1:] if vector.operation.startswith("write") else vector.operands
    return deck_from_lines("data", ["".join(word.rjust(36 if "." in word else 5) for word in operands)])


def address(made: Program) -> int | None:
    """Return the address of the result, or None for a program that punches it."""
    addresses = [entry.first for entry in made.storage.entries if entry.kind == "variable" and entry.name in ("D", "M")]
    return addresses[0] if addresses else None


def written(mantissa: int, exponent: int, vector: Vector) -> str:
    """Return a field of core in the notation of the vectors."""
    if exponent == FIXED_POINT:
        return WAYS[mantissa] if vector.operation in BRANCHES else str(mantissa)
    minus = mantissa < 0 or exponent == MINUS_ZERO
    return f"{'-' if minus else ''}.{abs(mantissa):0{vector.digits}}E{max(exponent, -99):+03}"


def interpreted(made: Program, vector: Vector, options: Options) -> Outcome:
    machine = Machine(made, card(vector), options)
    try:
        result = machine.run()
    except EmulatorError as error:
        return "?", "RANGE" if "out of range" in str(error) else "INVALID"
    assert result.ending.kind == "end"
    at = address(made)
    shown = result.punched[0] if at is None else written(*pair(machine, at), vector)
    return shown, " ".join(error.code for error in result.errors)


def on_the_kernel(runner: Runner, made: Program, vector: Vector) -> Outcome | None:
    """Return the outcome on the compiled engine, or None if it leaves the deck to the interpreter."""
    (run,) = runner.runs([packed(card(vector))])
    if run is None:
        return None
    codes = [number for at, times in run.errors for number in times * [at % devices.CODES]]
    code = " ".join("F8" if number == devices.F8 else f"E{number}" for number in codes)
    at, core = address(made), runner.core
    if at is None:
        return next(line[1:] for line in run.lines() if line.startswith("P")), code
    return written(int(core.mantissas[at]), int(core.exponents[at]), vector), code


def runs(operation: str) -> Iterator[tuple[Program, Vector, Options]]:
    """Yield every vector with its program and options, grouped by program and profile."""
    for vector in sorted(load(operation), key=lambda vector: (vector.profile, vector.operands[0])):
        field = vector.operands[0] if operation.startswith(("read", "write")) else ""
        system = numbers("truncating" if vector.profile == "any" else vector.profile)
        yield compiled(operation, field), vector, Options(numbers=system, limit=20_000)


@pytest.mark.parametrize("operation", names())
def test_interpreter_gives_every_published_result(operation: str) -> None:
    wrong = [
        (vector, outcome)
        for made, vector, options in runs(operation)
        if (outcome := interpreted(made, vector, options)) != (vector.result, vector.code)
    ]
    assert not wrong, f"{len(wrong)} lines: {wrong[:5]}"


@pytest.mark.parametrize("operation", names())
def test_compiled_engine_gives_every_published_result_or_defers(operation: str) -> None:
    pytest.importorskip("numba")
    wrong, deferred = [], 0
    runner, loaded = None, None
    for made, vector, options in runs(operation):
        if vector.digits > MAX_DIGITS:
            continue
        if runner is None or loaded != (made, vector.profile):
            runner, loaded = Runner(made, options), (made, vector.profile)
        outcome = on_the_kernel(runner, made, vector)
        deferred += outcome is None
        if outcome not in (None, (vector.result, vector.code)):
            wrong.append((vector, outcome))
    assert not wrong, f"{len(wrong)} lines: {wrong[:5]}"
    assert (deferred > 0) == (operation in DEFERRED), f"{deferred} lines were left to the interpreter"

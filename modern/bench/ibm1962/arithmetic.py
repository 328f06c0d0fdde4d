"""Compare arithmetic operations of IBM's library of 1962 with those of the emulated arithmetic ``ibm1962``."""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from functools import cache

from emulator.language.cards import deck_from_lines
from emulator.language.compiler import compile_deck
from emulator.language.ibm1962 import (
    ALONE,
    FIXED,
    FROM_FAC,
    OPERATIONS,
    TO_FAC,
    call,
    field_text,
    fixed_field,
    floating_field,
)
from emulator.language.objectcode import Program
from emulator.machine.machine import Machine
from emulator.numbers import accumulator, arithmetic
from emulator.numbers.arithmetic import IBM1962, MINUS_ZERO, ZERO
from modern.bench.ibm1962.emulated import OPTIONS, floating_text
from modern.bench.ibm1962.simulator import Job, run_jobs

# The object program begins at CODE; its two operands and its result are below TOP.
CODE, TOP = 9000, 15000
HALT = [4, 8, *[0] * 10]

# The address at which the library stores a flag after a negative fixed-point product.  With this flag, the library
# gives the result of a division by zero a minus sign.
PRODUCT = 99

_EMULATED = {
    "FAD": accumulator.add,
    "FSB": accumulator.subtract,
    "FMP": accumulator.multiply,
    "FDV": accumulator.divide,
}

# The fixed-point operations as expressions of the accumulator I and the operand J.
_EXPRESSIONS = {"XAD": "I+J", "XSB": "I-J", "XMP": "I*J", "XDV": "I/J", "XDVR": "J/I", "FIX": "A"}

# The operations from which :func:`at_random` chooses; addition and subtraction are the most frequent.
_DRAWN = ("FAD", "FAD", "FSB", "FSB", "FMP", "FDV", "FDVR", "RSGN", "FIX", "FLOAT", *FIXED, "POWERX", "POWERX")

# The name of an operation, the number in the accumulator FAC, and the other number, which is empty if the operation has
# only one operand.  The numbers have the form ``.25000000E+01`` or ``-12``.
Case = tuple[str, str, str]


def executed(cases: Sequence[Case], deck: Sequence[str]) -> list[tuple[str, str]]:
    """Return, for each operation, the result of IBM's library and the error codes that it types."""
    results = []
    for case, output in zip(cases, run_jobs(deck, [_job(case) for case in cases]), strict=True):
        kind = "I" if case[0] in FIXED or case[0] == "FIX" else "E"
        codes = [line.split()[1] for line in output.typed if line.startswith("ERROR")]
        results.append((field_text(output.field(TOP - 20), kind).replace("E-00", "E+00"), " ".join(codes)))
    return results


def _job(case: Case) -> Job:
    operation, first, second = case
    entry = call(ALONE[operation]) if operation in ALONE else call((OPERATIONS | FIXED)[operation], TOP - 10)
    code = [*call(TO_FAC, TOP), *entry, *call(FROM_FAC, TOP - 20), *HALT]
    stored = {CODE: code, TOP - 9: _field(first), TOP - 19: _field(second), PRODUCT: [0]}
    return Job(CODE, stored, examine=[(TOP - 29, TOP)])


def _field(number: str) -> list[int]:
    return floating_field(number) if "." in number else fixed_field(number or "0")


def emulated(case: Case) -> tuple[str, str]:
    """Return the result of an operation on the emulator and its error code."""
    operation, first, second = case
    rules = IBM1962.rules
    event = 0
    if operation in _EXPRESSIONS:
        card = f"{first:>14}" if operation == "FIX" else f"{'':14}{first:>5}{second:>5}"
        result = Machine(_program(_EXPRESSIONS[operation]), deck_from_lines("deck", [card]), OPTIONS).run()
        value = result.punched[0][:5].strip()
        return value.lstrip("-").zfill(4).rjust(4 + value.count("-"), "-"), "".join(result.typed).removeprefix("ERROR ")
    if operation == "FLOAT":
        m, e = arithmetic.from_integer(int(first), rules)
    elif operation == "RSGN":
        m, e = accumulator.negate(*pair(first))
    elif operation == "FDVR":
        m, e, event = accumulator.divide(*pair(second), *pair(first), rules)
    elif operation == "POWERX":
        m, e, event = accumulator.whole_power(*pair(first), int(second), rules)
    else:
        m, e, event = _EMULATED[operation](*pair(first), *pair(second), rules)
    return floating_text(m, e), f"E{event}" if event else ""


@cache
def _program(expression: str) -> Program:
    statements = ["READ 1,A,I,J", f"K={expression}", "PUNCH 2,K", "STOP"]
    formats = ["    1 FORMAT(E14.8,2I5)", "    2 FORMAT(I5)"]
    return compile_deck(deck_from_lines("operation", [*(f"      {s}" for s in statements), *formats, "      END"]))


def pair(number: str) -> tuple[int, int]:
    """Return the mantissa and the exponent of a number that is written like ``-.25000000E+01``."""
    size, negative = int(number[-12:-4]), number.startswith("-")
    if size == 0:
        return 0, MINUS_ZERO if negative else ZERO
    return (-size if negative else size), int(number[-3:])


def at_random(seed: int, count: int) -> list[Case]:
    """Return random operations with difficult operands: equal or opposite numbers, signed zeros, extreme exponents."""
    r = random.Random(seed)
    cases = []
    for _ in range(count):
        operation = r.choice(_DRAWN)
        near = r.choice([r.randint(-5, 5), r.randint(-5, 5), r.randint(-5, 5), r.randint(-99, 99), -98, 98])
        first = _number(r, near)
        second = r.choice([_number(r, near), first, floating_text(*accumulator.negate(*pair(first)))])
        if operation == "FLOAT" or operation in FIXED:
            first = _integer(r)
        if operation == "POWERX" or operation in FIXED:
            second = _integer(r).replace("-0", "0" if operation == "POWERX" else "-0")
        cases.append((operation, first, "" if operation in ALONE else second))
    return cases


def _integer(r: random.Random) -> str:
    return str(r.choice([r.randint(-9999, 9999), r.randint(-20, 20), r.randint(-3, 3), "-0"]))


def _number(r: random.Random, near: int) -> str:
    if r.random() < 0.05:
        return r.choice(["", "-"]) + ".00000000E-99"
    size = r.choice([r.randint(10**7, 10**8 - 1), r.randint(1, 9) * 10**7, 10**7 + r.randint(0, 99), 10**8 - 1])
    return floating_text(r.choice([1, -1]) * size, max(-99, min(99, near + r.randint(-2, 2))))


def different(cases: Sequence[Case], deck: Sequence[str]) -> Iterator[tuple[Case, tuple[str, str], tuple[str, str]]]:
    """Yield the operations whose results differ, each with the result of IBM's library and that of the emulator."""
    for case, result in zip(cases, executed(cases, deck), strict=True):
        if result != emulated(case):
            yield case, result, emulated(case)

"""Floating-point operations of the library, many in one run, compared with those of the profile ``ibm1962``."""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence

from emulator.language.ibm1962 import ALONE, FROM_FAC, OPERATIONS, TO_FAC, call, field_text, fixed_field, floating_field
from emulator.numbers import accumulator, arithmetic
from emulator.numbers.arithmetic import IBM1962, MINUS_ZERO, ZERO
from modern.bench.ibm1962.simulator import run

# The calls begin here and the fields end below here, in a machine of 40,000 positions.
CODE, TOP, CORE = 9000, 39900, 40000
HALT = [4, 8, *[0] * 10]

# The number of operations that one run executes.
BATCH = 250

_EMULATED = {
    "FAD": accumulator.add,
    "FSB": accumulator.subtract,
    "FMP": accumulator.multiply,
    "FDV": accumulator.divide,
}

# The operations of :func:`at_random`; sums are the most frequent.
_DRAWN = ("FAD", "FAD", "FSB", "FSB", "FMP", "FDV", "FDVR", "RSGN", "FIX", "FLOAT")

# An operation with its operands: FAC and the other number, such as ``.25000000E+01``, or one number.
Case = tuple[str, str, str]


def executed(cases: Sequence[Case], deck: Sequence[str]) -> list[tuple[str, str]]:
    """Return the result and the error code of each case, as the library computes them."""
    results: list[tuple[str, str]] = []
    for k in range(0, len(cases), BATCH):
        results += _batch(cases[k : k + BATCH], deck)
    return results


def _batch(cases: Sequence[Case], deck: Sequence[str]) -> list[tuple[str, str]]:
    code: list[int] = []
    stored: dict[int, Sequence[int]] = {}
    for k, (operation, first, second) in enumerate(cases):
        at = TOP - 30 * k
        stored[at - 9] = fixed_field(first) if operation == "FLOAT" else floating_field(first)
        stored[at - 19] = floating_field(second) if second else [0] * 10
        code += call(TO_FAC, at)
        code += call(ALONE[operation]) if operation in ALONE else call(OPERATIONS[operation], at - 10)
        code += call(FROM_FAC, at - 20)
    last = TOP - 30 * (len(cases) - 1) - 29
    output = run(deck, start=CODE, core=CORE, stored=stored | {CODE: [*code, *HALT]}, examine=[(last, TOP)])
    # A code has no place in core: the typed codes are assigned by running the emulator's errors in the same order.
    codes = iter([line.split()[1] for line in output.typed if line.startswith("ERROR")])
    results = []
    for k, case in enumerate(cases):
        kind = "I" if case[0] == "FIX" else "E"
        error = next(codes, "?") if emulated(case)[1] else ""
        results.append((field_text(output.field(TOP - 30 * k - 20), kind).replace("E-00", "E+00"), error))
    # A code that the emulator did not expect is added to the last result, so that the comparison fails.
    unassigned = " ".join(codes)
    if unassigned:
        results[-1] = (results[-1][0], f"{results[-1][1]} and {unassigned}")
    return results


def emulated(case: Case) -> tuple[str, str]:
    """Return the result and the error code that the emulator computes."""
    operation, first, second = case
    rules = IBM1962.rules
    event = 0
    if operation == "FLOAT":
        m, e = arithmetic.from_integer(int(first), rules)
    elif operation == "FIX":
        value = arithmetic.to_integer(*pair(first), rules)
        return f"{'-' if value < 0 else ''}{abs(value):04}", ""
    elif operation == "RSGN":
        m, e = accumulator.negate(*pair(first))
    elif operation == "FDVR":
        m, e, event = accumulator.divide(*pair(second), *pair(first), rules)
    else:
        m, e, event = _EMULATED[operation](*pair(first), *pair(second), rules)
    return number_text(m, e), f"E{event}" if event else ""


def pair(number: str) -> tuple[int, int]:
    """Return mantissa and exponent of a number such as ``-.25000000E+01``."""
    size, negative = int(number[-12:-4]), number.startswith("-")
    if size == 0:
        return 0, MINUS_ZERO if negative else ZERO
    return (-size if negative else size), int(number[-3:])


def number_text(mantissa: int, exponent: int) -> str:
    """Return a number as its field in core holds it, such as ``-.25000000E+01``."""
    minus = "-" if mantissa < 0 or exponent == MINUS_ZERO else ""
    exponent = ZERO if mantissa == 0 else exponent
    return f"{minus}.{abs(mantissa):08}E{'-' if exponent < 0 else '+'}{abs(exponent):02}"


def at_random(seed: int, count: int) -> list[Case]:
    """Return random operations: equal and opposite operands, zeros of both signs, and exponents at both limits."""
    r = random.Random(seed)
    cases = []
    for _ in range(count):
        operation = r.choice(_DRAWN)
        # The library divides wrongly if the dividend has the smallest exponent (docs/reference/ibm-library.md).
        low = -98 if operation.startswith("FDV") else -99
        near = r.choice([r.randint(-5, 5), r.randint(-5, 5), r.randint(-5, 5), r.randint(-99, 99), -98, 98])
        first = _number(r, near, low)
        second = r.choice([_number(r, near, low), first, number_text(*accumulator.negate(*pair(first)))])
        if operation == "FLOAT":
            first = str(r.randint(-9999, 9999))
        cases.append((operation, first, second if operation in OPERATIONS else ""))
    return cases


def _number(r: random.Random, near: int, low: int) -> str:
    if r.random() < 0.05:
        return r.choice(["", "-"]) + ".00000000E-99"
    size = r.choice([r.randint(10**7, 10**8 - 1), r.randint(1, 9) * 10**7, 10**7 + r.randint(0, 99), 10**8 - 1])
    return number_text(r.choice([1, -1]) * size, max(low, min(99, near + r.randint(-2, 2))))


def different(cases: Sequence[Case], deck: Sequence[str]) -> Iterator[tuple[Case, tuple[str, str], tuple[str, str]]]:
    """Yield the cases whose results differ, with the result of the library and that of the emulator."""
    for case, result in zip(cases, executed(cases, deck), strict=True):
        expected = emulated(case)
        if result != expected:
            # In a batch an error code may belong to another case.
            (alone,) = executed([case], deck)
            if alone != expected:
                yield case, alone, expected

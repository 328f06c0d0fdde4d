"""The published vectors, a file an operation: the boundaries of each class, then as many other cases as are wanted.

``python -m tests.support.published FOLDER`` writes the files; no test does.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any

from tests.support.published import columns, operands, rows
from tests.support.published import specification as spec
from tests.support.published.rows import Case, Row
from tests.support.published.specification import Arithmetic, Undecided

PROFILES = (
    *("truncating", "ibm1962", "guarded:8", "rounding:8", "truncating:2", "rounding:2", "truncating:4", "guarded:4"),
    *("rounding:4", "truncating:9", "rounding:9", "truncating:12", "rounding:12", "truncating:28", "rounding:28"),
)
ANY = "any"
"""The profile of what is the same under every one."""
MANY, FEW = 8, 4
"""Cases of a class under a profile of the time and under the others, boundaries not counted."""
IDLE = 400
"""The search ends after so many operands of which no class had need."""

Rows = Callable[[Arithmetic], Iterable[Row]]
Operands = Callable[[Arithmetic], Iterable[tuple[Any, ...]]]


def nothing(by: Arithmetic) -> Iterable[Any]:
    return ()


@dataclass(frozen=True)
class Operation:
    """What a file is made of: its classes, the cases that are all kept, and those that fill up a class."""

    name: str
    what: str
    classes: tuple[str, ...]
    bounds: Rows
    others: Rows = nothing
    profiles: tuple[str, ...] = PROFILES

    def cases(self, profile: str) -> dict[str, list[Case]]:
        """The cases of each class."""
        by = spec.arithmetic("truncating" if profile == ANY else profile)
        found: dict[str, list[Case]] = {kind: [] for kind in self.classes}
        seen: set[Case] = set()
        for kind, case in self.bounds(by):
            if case not in seen:
                seen.add(case)
                found[kind].append(case)
        most = MANY if profile in (ANY, "truncating", "ibm1962") else FEW
        idle = 0
        for kind, case in self.others(by):
            idle += 1
            if len(found[kind]) < most and case not in seen:
                seen.add(case)
                found[kind].append(case)
                idle = 0
            if idle > IDLE:
                break
        return found

    def file(self) -> str:
        """The text of the operation's file."""
        lines = [f"-- {self.what}", "-- Made from the rules: see README.md. CC0 1.0.", "version: 1"]
        count = 0
        for profile in self.profiles:
            digits = ANY if profile == ANY else spec.arithmetic(profile).digits
            lines += ["", f"profile: {profile}", f"digits: {digits}"]
            for kind, cases in self.cases(profile).items():
                lines += [f"class: {kind}"] if cases else []
                for *given, result, code in cases:
                    count += 1
                    written = (f"{self.name}{count:04}", self.name, *given, "->", result, code)
                    lines.append(" ".join(written).rstrip())
        return "\n".join(lines) + "\n"


def _rows(make: Callable[..., Row], given: Operands, by: Arithmetic) -> Iterator[Row]:
    """The rows of operands, but for those that no document decides."""
    for operand in given(by):
        try:
            yield make(*operand, by)
        except Undecided:
            continue


def _of(make: Callable[..., Row], given: Operands) -> Rows:
    return partial(_rows, make, given)


def _alone(given: Callable[[Arithmetic], Iterable[Any]]) -> Operands:
    return lambda by: ((one,) for one in given(by))


def _wholes(by: Arithmetic) -> Iterable[tuple[int, int]]:
    return operands.wholes()


def _whole(by: Arithmetic) -> Iterable[tuple[int]]:
    return ((i,) for i in (0, 1, -1, 2, 12, -34, 129, -999, 1299, -4321, 9999, -9999, 1000, 5005))


def _sum(name: str, what: str) -> Operation:
    row = partial(rows.sum_row, name)
    return Operation(name, what, rows.SUMS, _of(row, operands.sum_bounds), _of(row, operands.sums))


def _fixed(name: str, what: str, classes: tuple[str, ...], row: Callable[..., Row]) -> Operation:
    return Operation(name, what, classes, nothing, _of(row, _wholes), (ANY,))


OPERATIONS = (
    _sum("add", "A + B: A in the accumulator, B added."),
    _sum("subtract", "A - B: A in the accumulator, B subtracted."),
    _sum("subtractfrom", "B - A: A in the accumulator, B subtracted, the sign reversed."),
    Operation(
        *("multiply", "A * B.", rows.PRODUCTS),
        _of(rows.product_row, operands.product_bounds),
        _of(rows.product_row, operands.products),
    ),
    Operation(
        *("divide", "A / B.", rows.QUOTIENTS),
        _of(rows.quotient_row, operands.quotient_bounds),
        _of(rows.quotient_row, operands.quotients),
    ),
    Operation(
        *("power", "A ** J, J a whole number.", rows.POWERS),
        _of(rows.power_row, operands.power_bounds),
        _of(rows.power_row, operands.powers),
    ),
    Operation("squareroot", "SQRT of A.", rows.ROOTS, nothing, _of(rows.root_row, _alone(operands.radicands))),
    Operation(
        "negate", "A with its sign reversed.", rows.SIGNS, nothing, _of(rows.negate_row, _alone(operands.singles))
    ),
    Operation("if", "The branch of IF (A).", rows.SIGNS, nothing, _of(rows.sign_row, _alone(operands.singles))),
    Operation(
        *("compare", "The branch of IF (A-B), and the code of A-B.", rows.COMPARISONS, nothing),
        _of(rows.compare_row, operands.comparisons),
    ),
    Operation("fix", "A as a fixed-point number.", rows.FIXES, nothing, _of(rows.fix_row, _alone(operands.singles))),
    Operation("float", "I as a floating-point number.", rows.FLOATS, _of(rows.float_row, _whole)),
    _fixed("fixadd", "I + J.", rows.FIXED_SUMS, partial(rows.fixed_row, "fixadd")),
    _fixed("fixsubtract", "I - J.", rows.FIXED_SUMS, partial(rows.fixed_row, "fixsubtract")),
    _fixed("fixmultiply", "I * J.", rows.FIXED_PRODUCTS, partial(rows.fixed_row, "fixmultiply")),
    _fixed("fixdivide", "I / J.", rows.FIXED_QUOTIENTS, rows.fixed_quotient_row),
    _fixed("fixcompare", "The branch of IF (I-J).", rows.FIXED_COMPARISONS, rows.fixed_sign_row),
    Operation("read", "Columns of an E or F field as a number.", columns.READ, columns.read_bounds),
    Operation(
        *("readfixed", "Columns of an I field as a number.", columns.READ_FIXED, columns.read_fixed_bounds),
        profiles=(ANY,),
    ),
    Operation("writee", "A in an E field.", columns.WRITE_E, nothing, columns.write_e),
    Operation("writef", "A in an F field.", columns.WRITE_F, nothing, columns.write_f),
    Operation(*("writefixed", "I in an I field.", columns.WRITE_FIXED, columns.write_fixed), profiles=(ANY,)),
)


def counts() -> str:
    """A table of how many cases there are: a line for each class of an operation, a column for each profile."""
    columns = (*PROFILES, ANY)
    lines = ["\t".join(("operation", "class", *columns))]
    for operation in OPERATIONS:
        cases = {profile: operation.cases(profile) for profile in operation.profiles}
        for kind in operation.classes:
            found = (str(len(cases[profile][kind])) if profile in cases else "0" for profile in columns)
            lines.append("\t".join((operation.name, kind, *found)))
    return "\n".join(lines) + "\n"

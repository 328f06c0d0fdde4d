"""The published vectors, one file per operation: the boundary cases of each class, then further cases.

``python -m tests.support.published FOLDER`` writes the files.  No test does.
"""

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
# The fields of IBM's library of 1962 were measured: tests/data/vectors/ibm1962.tsv.
BY_THE_MANUAL = tuple(name for name in PROFILES if name != "ibm1962")
ANY = "any"
"""The profile of the operations whose results are the same under every profile."""
MANY, FEW = 8, 4
"""The number of further cases of a class, for the profiles of the time and for the others."""
IDLE = 400
"""The search for further cases ends after this number of operands that no class needed."""

Rows = Callable[[Arithmetic], Iterable[Row]]
Operands = Callable[[Arithmetic], Iterable[tuple[Any, ...]]]


def nothing(by: Arithmetic) -> Iterable[Any]:
    return ()


@dataclass(frozen=True)
class Operation:
    """The contents of a file: classes, boundary cases (all are included), and further cases that fill up the classes.

    ``row`` computes a case from its operands.  It is None for operations on the columns of a card.
    """

    name: str
    description: str
    classes: tuple[str, ...]
    bounds: Rows = nothing
    others: Rows = nothing
    profiles: tuple[str, ...] = PROFILES
    row: Callable[..., Row] | None = None

    def cases(self, profile: str) -> dict[str, list[Case]]:
        """Return the cases of each class."""
        by = spec.arithmetic("truncating" if profile == ANY else profile)
        cases: dict[str, list[Case]] = {kind: [] for kind in self.classes}
        included: set[Case] = set()
        for kind, case in self.bounds(by):
            if case not in included:
                included.add(case)
                cases[kind].append(case)
        most = MANY if profile in (ANY, "truncating", "ibm1962") else FEW
        idle = 0
        for kind, case in self.others(by):
            idle += 1
            if len(cases[kind]) < most and case not in included:
                included.add(case)
                cases[kind].append(case)
                idle = 0
            if idle > IDLE:
                break
        return cases

    def file(self) -> str:
        """Return the text of the operation's file."""
        lines = [f"-- {self.description}", "-- Made from the rules: see README.md. CC0 1.0.", "version: 1"]
        count = 0
        for profile in self.profiles:
            digits = ANY if profile == ANY else spec.arithmetic(profile).digits
            lines += ["", f"profile: {profile}", f"digits: {digits}"]
            for kind, cases in self.cases(profile).items():
                lines += [f"class: {kind}"] if cases else []
                for *values, result, code in cases:
                    count += 1
                    line = (f"{self.name}{count:04}", self.name, *values, "->", result, code)
                    lines.append(" ".join(line).rstrip())
        return "\n".join(lines) + "\n"


def _rows(row: Callable[..., Row], make_operands: Operands, by: Arithmetic) -> Iterator[Row]:
    """Yield the rows of operands, without the cases that no document decides."""
    for operand in make_operands(by):
        try:
            yield row(*operand, by)
        except Undecided:
            continue


def _calculation(
    name: str,
    description: str,
    classes: tuple[str, ...],
    row: Callable[..., Row],
    bounds: Operands = nothing,
    others: Operands = nothing,
    profiles: tuple[str, ...] = PROFILES,
) -> Operation:
    """Return an operation on numbers, whose cases ``row`` computes from operands."""
    return Operation(
        name, description, classes, partial(_rows, row, bounds), partial(_rows, row, others), profiles, row
    )


def _alone(make_operands: Callable[[Arithmetic], Iterable[Any]]) -> Operands:
    return lambda by: ((operand,) for operand in make_operands(by))


def _integer_pairs(by: Arithmetic) -> Iterable[tuple[int, int]]:
    return operands.integer_pairs()


def _integers(by: Arithmetic) -> Iterable[tuple[int]]:
    return ((i,) for i in (0, 1, -1, 2, 12, -34, 129, -999, 1299, -4321, 9999, -9999, 1000, 5005))


def _sum(name: str, description: str) -> Operation:
    row = partial(rows.sum_row, name)
    return _calculation(name, description, rows.SUMS, row, operands.sum_bounds, operands.sums)


def _fixed(name: str, description: str, classes: tuple[str, ...], row: Callable[..., Row]) -> Operation:
    return _calculation(name, description, classes, row, others=_integer_pairs, profiles=(ANY,))


_SINGLES = _alone(operands.singles)

OPERATIONS = (
    _sum("add", "A + B: A in the accumulator, B added."),
    _sum("subtract", "A - B: A in the accumulator, B subtracted."),
    _sum("subtractfrom", "B - A: A in the accumulator, B subtracted, the sign reversed."),
    _calculation("multiply", "A * B.", rows.PRODUCTS, rows.product_row, operands.product_bounds, operands.products),
    _calculation("divide", "A / B.", rows.QUOTIENTS, rows.quotient_row, operands.quotient_bounds, operands.quotients),
    _calculation(
        "power", "A ** J, J a whole number.", rows.POWERS, rows.power_row, operands.power_bounds, operands.powers
    ),
    _calculation("squareroot", "SQRT of A.", rows.ROOTS, rows.root_row, others=_alone(operands.radicands)),
    _calculation("negate", "A with its sign reversed.", rows.SIGNS, rows.negate_row, others=_SINGLES),
    _calculation("if", "The branch of IF (A).", rows.SIGNS, rows.sign_row, others=_SINGLES),
    _calculation(
        *("compare", "The branch of IF (A-B), and the code of A-B.", rows.COMPARISONS, rows.compare_row),
        others=operands.comparisons,
    ),
    _calculation("fix", "A as a fixed-point number.", rows.FIXES, rows.fix_row, others=_SINGLES),
    _calculation("float", "I as a floating-point number.", rows.FLOATS, rows.float_row, _integers),
    _fixed("fixadd", "I + J.", rows.FIXED_SUMS, partial(rows.fixed_row, "fixadd")),
    _fixed("fixsubtract", "I - J.", rows.FIXED_SUMS, partial(rows.fixed_row, "fixsubtract")),
    _fixed("fixmultiply", "I * J.", rows.FIXED_PRODUCTS, partial(rows.fixed_row, "fixmultiply")),
    _fixed("fixdivide", "I / J.", rows.FIXED_QUOTIENTS, rows.fixed_quotient_row),
    _fixed("fixcompare", "The branch of IF (I-J).", rows.FIXED_COMPARISONS, rows.fixed_sign_row),
    Operation(
        *("read", "Columns of an E or F field as a number.", columns.READ, columns.read_bounds),
        profiles=BY_THE_MANUAL,
    ),
    Operation(
        *("readfixed", "Columns of an I field as a number.", columns.READ_FIXED, columns.read_fixed_bounds),
        profiles=(ANY,),
    ),
    Operation("writee", "A in an E field.", columns.WRITE_E, others=columns.write_e, profiles=BY_THE_MANUAL),
    Operation("writef", "A in an F field.", columns.WRITE_F, others=columns.write_f, profiles=BY_THE_MANUAL),
    Operation(*("writefixed", "I in an I field.", columns.WRITE_FIXED, columns.write_fixed), profiles=(ANY,)),
)


def counts() -> str:
    """Return a table of the numbers of cases: a line per class of an operation, a column per profile."""
    columns = (*PROFILES, ANY)
    lines = ["\t".join(("operation", "class", *columns))]
    for operation in OPERATIONS:
        cases = {profile: operation.cases(profile) for profile in operation.profiles}
        for kind in operation.classes:
            numbers = (str(len(cases[profile][kind])) if profile in cases else "0" for profile in columns)
            lines.append("\t".join((operation.name, kind, *numbers)))
    return "\n".join(lines) + "\n"

"""Lines of the published vectors for operations on numbers: the result by the rules, and the class of the case.

The class depends on the exact result, not on the way in which the operands were chosen.
"""

from collections.abc import Iterable
from fractions import Fraction

from tests.support.published import specification as spec
from tests.support.published.specification import Arithmetic, Number, Outcome, decade, ten, text

Case = tuple[str, ...]
"""The operands, the result and the code as text."""
Row = tuple[str, Case]
"""A class and a case."""


def row(kind: str, values: Iterable[Number | int | str], outcome: Outcome | tuple[object, str], by: Arithmetic) -> Row:
    """Return a class and a case with operands and result as text."""

    def written(value: object) -> str:
        return text(value, by.digits) if isinstance(value, Number) else str(value)

    result, code = (outcome.number, outcome.code) if isinstance(outcome, Outcome) else outcome
    return kind, (*map(written, values), written(result), code)


def rest_of(value: Fraction, by: Arithmetic) -> Fraction:
    """Return the fraction of the last place that an exact result, not zero, has beyond the profile's digits."""
    scaled = abs(value) / ten(decade(abs(value)) - by.digits)
    return scaled - scaled // 1


def at_the_ends(outcome: Outcome) -> str:
    """Return the class of a result out of range or at the ends of the range, or an empty string."""
    if outcome.code:
        return {"1": "overflow", "3": "overflow", "5": "overflow", "7": "zero divisor"}.get(
            outcome.code[1], "underflow"
        )
    e = decade(outcome.number.size) if outcome.number.size else 0
    return {spec.HIGHEST: "top", spec.LOWEST: "bottom"}.get(e, "")


def of_the_last_place(value: Fraction, by: Arithmetic) -> str:
    """Return the class of an exact result that rounding treats specially (a tie, next to one, nines), or nothing."""
    rounded = spec.shortened(abs(value), by.digits, True)
    if decade(rounded) > decade(abs(value)):
        return "nines"
    rest = rest_of(value, by)
    if rest == Fraction(1, 2):
        return "tie"
    return "beside a tie" if abs(rest - Fraction(1, 2)) <= Fraction(1, 100) else ""


SUMS = (
    *("zeros", "to zero", "plain", "carry", "cancellation", "lost digits", "one digit left", "far apart"),
    *("tie", "beside a tie", "nines", "overflow", "underflow", "top", "bottom"),
)


def sum_row(operation: str, a: Number, b: Number, by: Arithmetic) -> Row:
    rule = {"add": spec.add, "subtract": spec.subtract, "subtractfrom": spec.subtract_from}[operation]
    outcome = rule(a, b, by)
    value = a.value + b.value if operation == "add" else a.value - b.value
    kind = "zeros" if not (a.size and b.size) else at_the_ends(outcome) or ("to zero" if not value else "")
    if not kind:
        lead, shift = max(decade(a.size), decade(b.size)), abs(decade(a.size) - decade(b.size))
        kind = of_the_last_place(value, by)
        if not kind and shift >= by.digits - 1 > 0:
            kind = "one digit left" if shift == by.digits - 1 else "far apart"
        if not kind and decade(abs(value)) != lead:
            kind = "carry" if decade(abs(value)) > lead else "cancellation"
        kind = kind or ("lost digits" if shift and rest_of(value, by) else "plain")
    return row(kind, (a, b), outcome, by)


PRODUCTS = (
    *("zeros", "exact", "all digits", "a digit less", "tie", "beside a tie", "nearly whole", "nines"),
    *("overflow", "underflow", "top", "bottom"),
)


def product_row(a: Number, b: Number, by: Arithmetic) -> Row:
    outcome = spec.multiply(a, b, by)
    value = a.value * b.value
    kind = at_the_ends(outcome) or ("" if value else "zeros")
    if not kind:
        kind = of_the_last_place(value, by) or ("" if rest_of(value, by) else "exact")
    if not kind and min(rest_of(value, by), 1 - rest_of(value, by)) <= ten(-by.digits):
        kind = "nearly whole"
    if not kind:
        kind = "all digits" if decade(abs(value)) == decade(a.size) + decade(b.size) else "a digit less"
    return row(kind, (a, b), outcome, by)


QUOTIENTS = (
    *("zeros", "zero divisor", "exact", "of a larger", "of a smaller", "tie", "beside a tie", "nearly whole"),
    *("overflow", "underflow", "top", "bottom"),
)


def quotient_row(a: Number, b: Number, by: Arithmetic) -> Row:
    outcome = spec.divide(a, b, by)
    kind = at_the_ends(outcome) or ("" if a.size else "zeros")
    if not kind:
        value = a.value / b.value
        kind = of_the_last_place(value, by) or ("" if rest_of(value, by) else "exact")
        if not kind and min(rest_of(value, by), 1 - rest_of(value, by)) <= ten(1 - by.digits):
            kind = "nearly whole"
        kind = kind or ("of a larger" if decade(abs(value)) > decade(a.size) - decade(b.size) else "of a smaller")
    return row(kind, (a, b), outcome, by)


POWERS = (
    *("to zero", "to one", "square", "cube and more", "reciprocal", "negative", "zero base", "zero divisor"),
    *("overflow", "underflow", "top", "bottom"),
)


def power_row(a: Number, count: int, by: Arithmetic) -> Row:
    outcome = spec.power(a, count, by)
    kind = {0: "to zero"}.get(count) or ("zero base" if not a.size and count > 0 else "") or at_the_ends(outcome)
    kind = kind or {1: "to one", 2: "square", -1: "reciprocal"}.get(count) or ("negative" if count < 0 else "")
    return row(kind or "cube and more", (a, count), outcome, by)


ROOTS = (
    "zero",
    "exact",
    "odd exponent",
    "even exponent",
    "negative",
    "above a square",
    "below a square",
    "top",
    "bottom",
)


def root_row(a: Number, by: Arithmetic) -> Row:
    outcome = spec.square_root(a, by)
    if not a.size:
        return row("zero", (a,), outcome, by)
    e, unit = decade(a.size), ten(decade(a.size) - by.digits)
    kind = "negative" if a.minus else {99: "top", -99: "bottom"}.get(e, "")
    if not kind and outcome.number.size**2 == a.size:
        kind = "exact"
    for neighbour, side in ((a.size - unit, "above a square"), (a.size + unit, "below a square")):
        if not kind and neighbour and spec.square_root(Number(False, neighbour), by).number.size ** 2 == neighbour:
            kind = side
    return row(kind or ("odd exponent" if e % 2 else "even exponent"), (a,), outcome, by)


SIGNS = ("number", "minus number", "zero", "minus zero", "bottom")


def kind_of_sign(a: Number) -> str:
    if a.size and decade(a.size) == spec.LOWEST:
        return "bottom"
    return ("minus " if a.minus else "") + ("number" if a.size else "zero")


def sign_row(a: Number, by: Arithmetic) -> Row:
    return row(kind_of_sign(a), (a,), (spec.branch(a.value), ""), by)


COMPARISONS = ("less", "equal", "greater", "beside", "zeros", "underflow", "overflow")


def compare_row(a: Number, b: Number, by: Arithmetic) -> Row:
    """Return the row of IF (A-B), which is computed by a subtraction whose underflow is zero."""
    outcome = spec.subtract(a, b, by)
    kind = at_the_ends(outcome) if outcome.code else ""
    if not kind and not (a.size and b.size):
        kind = "zeros"
    value = a.value - b.value
    kind = kind or ("equal" if not value else "beside" if abs(value) <= ten(decade(a.size) - by.digits + 1) else "")
    return row(
        kind or ("less" if value < 0 else "greater"), (a, b), (spec.branch(outcome.number.value), outcome.code), by
    )


def negate_row(a: Number, by: Arithmetic) -> Row:
    return row(kind_of_sign(a), (a,), (a.reversed(), ""), by)


FIXES = ("whole", "cut", "below one", "more than four digits", "zeros only", "zero")


def fix_row(a: Number, by: Arithmetic) -> Row:
    if not a.size:
        kind = "zero"
    elif decade(a.size) <= 0:
        kind = "below one"
    elif a.size >= 10_000:
        kind = "more than four digits" if decade(a.size) < by.digits + 4 else "zeros only"
    else:
        kind = "whole" if a.size.denominator == 1 else "cut"
    return row(kind, (a,), (spec.to_fixed(a, by), ""), by)


FLOATS = ("plain", "minus", "bounds", "zero")


def float_row(i: int, by: Arithmetic) -> Row:
    kind = "zero" if not i else "minus" if i < 0 else "bounds" if i in (1, 9999) else "plain"
    return row(kind, (i,), (spec.from_fixed(i, by), ""), by)


FIXED_SUMS = ("plain", "minus", "zeros", "to zero", "bounds", "four digits kept")
FIXED_PRODUCTS = ("plain", "minus", "zeros", "bounds", "four digits kept")
FIXED = {"fixadd": lambda i, j: i + j, "fixsubtract": lambda i, j: i - j, "fixmultiply": lambda i, j: i * j}


def fixed_row(operation: str, i: int, j: int, by: Arithmetic) -> Row:
    value = FIXED[operation](i, j)
    kind = (
        "zeros"
        if not (i and j)
        else "four digits kept"
        if abs(value) > 9999
        else "bounds"
        if abs(value) == 9999
        else ""
    )
    kind = kind or ("to zero" if not value and operation != "fixmultiply" else "minus" if value < 0 else "plain")
    return row(kind, (i, j), (spec.four_digits(value), ""), by)


FIXED_QUOTIENTS = ("exact", "cut", "below one", "zero", "zero divisor")


def fixed_quotient_row(i: int, j: int, by: Arithmetic) -> Row:
    kind = "zero divisor" if not j else "zero" if not i else "exact" if not i % j else "cut"
    kind = "below one" if j and 0 < abs(i) < abs(j) else kind
    return row(kind, (i, j), spec.fixed_quotient(i, j), by)


FIXED_COMPARISONS = ("less", "equal", "greater", "four digits kept")


def fixed_sign_row(i: int, j: int, by: Arithmetic) -> Row:
    """Return the row of IF (I-J).  A difference of five digits keeps four."""
    value = i - j
    kind = "four digits kept" if abs(value) > 9999 else "equal" if not value else "less" if value < 0 else "greater"
    return row(kind, (i, j), (spec.branch(spec.four_digits(value)), ""), by)

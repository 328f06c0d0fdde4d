"""The result of a published vector by the rules, from the texts of its operands."""

from collections.abc import Callable, Sequence
from functools import partial

from tests.support.published import fields
from tests.support.published import specification as spec
from tests.support.published.specification import Arithmetic, Number, Outcome, parsed, text

Result = tuple[str, str]
"""The result and the code as text."""
Rule = Callable[[Sequence[str], Arithmetic], Result]


def _shown(outcome: Outcome, by: Arithmetic) -> Result:
    return text(outcome.number, by.digits), outcome.code


def _floating(rule: Callable[..., Outcome], operands: Sequence[str], by: Arithmetic) -> Result:
    return _shown(rule(*map(parsed, operands), by), by)


def _power(operands: Sequence[str], by: Arithmetic) -> Result:
    return _shown(spec.power(parsed(operands[0]), int(operands[1]), by), by)


def _compare(operands: Sequence[str], by: Arithmetic) -> Result:
    """Return the branch of IF (A-B), which is computed by a subtraction whose underflow is zero."""
    outcome = spec.subtract(parsed(operands[0]), parsed(operands[1]), by)
    return spec.branch(outcome.number.value), outcome.code


def _fixed(rule: Callable[[int, int], object], operands: Sequence[str], by: Arithmetic) -> Result:
    return str(rule(int(operands[0]), int(operands[1]))), ""


def _fixed_quotient(operands: Sequence[str], by: Arithmetic) -> Result:
    value, code = spec.fixed_quotient(int(operands[0]), int(operands[1]))
    return str(value), code


def _read(operands: Sequence[str], by: Arithmetic) -> Result:
    number, code = fields.read_floating(operands[0], operands[1], by)
    return ("?" if number is None else text(number, by.digits)), code


def _read_fixed(operands: Sequence[str], by: Arithmetic) -> Result:
    number, code = fields.read_fixed(operands[1])
    return ("?" if number is None else str(number)), code


def _write(operands: Sequence[str], by: Arithmetic) -> Result:
    return fields.write_floating(operands[0], parsed(operands[1]), by)


RULES: dict[str, Rule] = {
    "add": partial(_floating, spec.add),
    "subtract": partial(_floating, spec.subtract),
    "subtractfrom": partial(_floating, spec.subtract_from),
    "multiply": partial(_floating, spec.multiply),
    "divide": partial(_floating, spec.divide),
    "power": _power,
    "squareroot": partial(_floating, spec.square_root),
    "negate": partial(_floating, lambda a, by: Outcome(Number.reversed(a))),
    "if": lambda operands, by: (spec.branch(parsed(operands[0]).value), ""),
    "compare": _compare,
    "fix": lambda operands, by: (str(spec.to_fixed(parsed(operands[0]), by)), ""),
    "float": lambda operands, by: (text(spec.from_fixed(int(operands[0]), by), by.digits), ""),
    "fixadd": partial(_fixed, lambda i, j: spec.four_digits(i + j)),
    "fixsubtract": partial(_fixed, lambda i, j: spec.four_digits(i - j)),
    "fixmultiply": partial(_fixed, lambda i, j: spec.four_digits(i * j)),
    "fixdivide": _fixed_quotient,
    "fixcompare": partial(_fixed, lambda i, j: spec.branch(spec.four_digits(i - j))),
    "read": _read,
    "readfixed": _read_fixed,
    "writee": _write,
    "writef": _write,
    "writefixed": lambda operands, by: (fields.write_fixed(operands[0], int(operands[1])), ""),
}

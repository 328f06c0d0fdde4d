"""Repeat the recorded operations of a run (a tape, emulator/machine/tape.py) in another arithmetic.

The other arithmetic may have more digits, round at random, compute intervals or be exact.  The other arithmetic holds
the input numbers of the run exactly.  After an overflow the repetition continues with the largest number, as the
machine does.
"""

import decimal
import operator as o
from collections.abc import Callable, Iterable, Iterator, Sequence
from fractions import Fraction
from functools import cache, partial
from typing import Any

import numpy as np

from emulator.jit.functions import Compiled, NotInstalled
from emulator.machine.tape import ADD, DIVIDE, LEAF, MULTIPLY, NEGATE, SUBTRACT, Tape
from emulator.numbers.accumulator import add, divide, multiply, negate, subtract
from emulator.numbers.arithmetic import Rules, drawn, profile
from emulator.numbers.base import Number, Undecided
from emulator.numbers.interval import Interval, IntervalNumbers

# The digits of exact decimal numbers: enough for every sum and product of a program without powers.  A longer result is
# an error and is never rounded.
_LONG = 20_000
# Numbers of the compiled code have at most this number of digits, because products must fit into 64 bits.
_COMPILED_DIGITS = 9
_ENDLESS = decimal.Decimal("9E+9999")
_Operation = Callable[[Any, Any], Any]


def repeat(
    operations: Sequence[int],
    firsts: Sequence[int],
    seconds: Sequence[int],
    mantissas: Any,
    exponents: Any,
    rules: Rules,
) -> None:
    """Repeat the operations of a tape in a decimal arithmetic.

    ``mantissas`` and ``exponents`` already hold the input numbers of the tape and receive the results.  With random
    rounding, the operation with index k, counted from 0, uses the random number k + 1 of the seed in ``rules``.  numba
    compiles this function.
    """
    for k in range(len(operations)):
        operation = operations[k]
        if operation == LEAF:
            continue
        if rules.random:
            rules = drawn(rules, k + 1)
        m, e = mantissas[firsts[k]], exponents[firsts[k]]
        m2, e2 = mantissas[seconds[k]], exponents[seconds[k]]
        _event = 0
        if operation == ADD:
            m, e, _event = add(m, e, m2, e2, rules)
        elif operation == SUBTRACT:
            m, e, _event = subtract(m, e, m2, e2, rules)
        elif operation == MULTIPLY:
            m, e, _event = multiply(m, e, m2, e2, rules)
        elif operation == DIVIDE:
            m, e, _event = divide(m, e, m2, e2, rules)
        else:
            m, e = negate(m, e)
        mantissas[k] = m
        exponents[k] = e


@cache
def _compiled() -> Compiled | None:
    try:
        return Compiled(repeat, error_model="numpy")
    except NotInstalled:
        return None


def must_compile_repetitions() -> bool:
    """Return True if the repetition of tapes can be compiled but has not been compiled yet."""
    compiled = _compiled()
    return bool(compiled and compiled.must_compile)


def compile_repetitions() -> None:
    """Compile the repetition of tapes, or load it from numba's cache.  Do nothing if numba cannot be used."""
    if compiled := _compiled():
        compiled.ready(*[np.zeros(0, np.int64)] * 5, profile("truncating").rules)


def repetitions(tape: Tape, digits: int, rules_of_runs: Iterable[Rules]) -> Iterator[tuple[list[int], list[int]]]:
    """Repeat a tape with each of the given rules.  Yield the mantissas and the exponents of the tested numbers.

    The tape was recorded with ``digits`` digits.  Each of the rules must have at least this number of digits.  The
    numbers are those that the IFs tested, in the order of ``tape.tests``.
    """
    compiled = None if must_compile_repetitions() else _compiled()
    code = tape.operations, tape.firsts, tape.seconds
    places = [test.place for test in tape.tests]
    arrays = tuple(np.array(row, np.int64) for row in (*code, tape.mantissas, tape.exponents)) if compiled else ()
    function = None  # finding the machine code for the types of the arguments takes as long as a repetition
    for rules in rules_of_runs:
        scale = 10 ** (rules.digits - digits)
        if compiled and rules.digits <= _COMPILED_DIGITS:
            arguments = (*arrays[:3], scale * arrays[3], arrays[4].copy(), rules)
            function = function or compiled.ready(*arguments)
            function(*arguments)
            yield arguments[3][places].tolist(), arguments[4][places].tolist()
        else:
            mantissas, exponents = [scale * m for m in tape.mantissas], list(tape.exponents)
            repeat(*code, mantissas, exponents, rules)
            yield [mantissas[k] for k in places], [exponents[k] for k in places]


def _leaves(tape: Tape, digits: int) -> list[decimal.Decimal]:
    context = decimal.Context(prec=_LONG)
    make = decimal.Decimal
    return [
        make(m).scaleb(e - digits, context) if m and operation == LEAF else make(0)
        for operation, m, e in zip(tape.operations, tape.mantissas, tape.exponents, strict=True)
    ]


def exactly(tape: Tape, digits: int) -> list[Number]:
    """Return every number of a tape in exact arithmetic.

    All numbers are Decimals, or all are Fractions if a quotient has no finite decimal expansion.  A division by zero
    gives the largest number of the machine, which has ``digits`` digits.
    """
    exact = decimal.Context(prec=_LONG, Emax=decimal.MAX_EMAX, Emin=decimal.MIN_EMIN, traps=[decimal.Inexact])
    values: list[Any] = list(_leaves(tape, digits))
    largest = decimal.Decimal(10**digits - 1).scaleb(99 - digits)
    try:
        _follow(tape, values, (exact.add, exact.subtract, exact.multiply, _or(largest, exact.divide)), exact.minus)
    except decimal.Inexact:
        values = [Fraction(value) for value in _leaves(tape, digits)]
        _follow(tape, values, (o.add, o.sub, o.mul, _or(Fraction(largest), o.truediv)), o.neg)
    return values


def _or(largest: Number, divide: _Operation) -> _Operation:
    return lambda dividend, divisor: divide(dividend, divisor) if divisor else largest


def _follow(tape: Tape, values: list[Any], functions: Sequence[_Operation], negate: Callable[[Any], Any]) -> None:
    """Repeat the operations of a tape on ``values``, which holds the input numbers and receives the results.

    ``functions`` has one function for each of ADD, SUBTRACT, MULTIPLY and DIVIDE, and ``negate`` is that for NEGATE.
    """
    named = dict(zip((ADD, SUBTRACT, MULTIPLY, DIVIDE), functions, strict=True))
    for k, (operation, i, j) in enumerate(zip(tape.operations, tape.firsts, tape.seconds, strict=True)):
        if operation == NEGATE:
            values[k] = negate(values[i])
        elif operation != LEAF:
            values[k] = named[operation](values[i], values[j])


def enclosed(tape: Tape, digits: int) -> list[Interval]:
    """Return for each number on a tape an interval that contains its exact value.

    The tape was recorded with ``digits`` digits.

    The bounds have ``digits`` digits and are rounded outwards.  A quotient is unbounded if the divisor's interval
    contains 0.  A result that is out of range is unbounded too.
    """
    system = IntervalNumbers(digits)

    def bounded(operation: Callable[..., Interval], first: Interval, second: Interval) -> Interval:
        try:
            return operation(first, second)
        except Undecided:
            return -_ENDLESS, _ENDLESS

    values: list[Any] = [(leaf, leaf) for leaf in _leaves(tape, digits)]
    operations = system.add, system.subtract, system.multiply, system.divide
    _follow(tape, values, [partial(bounded, operation) for operation in operations], system.negate)
    return values

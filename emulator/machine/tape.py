"""A tape: the floating-point operations and decisions of a run, as a program without branches that can be repeated.

A run is recorded once in the machine's own arithmetic.  If the operations are repeated in another arithmetic, they
follow the branches that the machine took, even if the other arithmetic would decide differently.  So each decision can
be judged separately: the value that it tests is known in every arithmetic, after the same operations (synchronous
execution; J. Vignes, A stochastic arithmetic for reliable scientific computation, Math. Comput. Simulation 35 (1993)
233-261).

The tape holds sums, differences, products, quotients and changes of sign.  Numbers read from cards, constants and
converted integers are its leaves: every arithmetic begins with the values that they have in the machine.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from decimal import Decimal
from fractions import Fraction

from emulator.language.cards import Deck
from emulator.language.objectcode import IF, Program
from emulator.machine.machine import run_with_operator
from emulator.machine.operator import Operator
from emulator.machine.result import Options
from emulator.machine.session import Session
from emulator.machine.state import Journal
from emulator.numbers.accumulator import add, divide, multiply, subtract
from emulator.numbers.base import Number, Numbers, Trap, Undecided
from emulator.numbers.decimal import DecimalNumbers
from emulator.numbers.fields import Field, Remark

LEAF, ADD, SUBTRACT, MULTIPLY, DIVIDE, NEGATE = range(6)

# Mantissa and exponent of a number of the machine, and its place on the tape.
Taped = tuple[int, int, int]


@dataclass(frozen=True, slots=True)
class Test:
    """An IF on the tape: its instruction, the index of the number that it tests, and its targets.

    The targets are the instructions for a negative number, zero and a positive number.  The machine branched to
    ``taken``.
    """

    instruction: int
    place: int
    targets: tuple[int, int, int]
    taken: int

    def target(self, number: Number) -> int:
        """Return the instruction to which the IF branches for a number, which may come from another arithmetic."""
        return self.targets[1 + (number > 0) - (number < 0)]


@dataclass(slots=True)
class Tape:
    """A recorded run: its operations, the indices of their operands, and the results in the machine's arithmetic."""

    operations: list[int] = field(default_factory=list)
    firsts: list[int] = field(default_factory=list)
    seconds: list[int] = field(default_factory=list)
    mantissas: list[int] = field(default_factory=list)
    exponents: list[int] = field(default_factory=list)
    tests: list[Test] = field(default_factory=list)

    def enter(self, operation: int, first: int, second: int, mantissa: int, exponent: int) -> Taped:
        self.operations.append(operation)
        self.firsts.append(first)
        self.seconds.append(second)
        self.mantissas.append(mantissa)
        self.exponents.append(exponent)
        return mantissa, exponent, len(self.operations) - 1

    def number(self, place: int) -> tuple[int, int]:
        """Return the number at an index of the tape as the machine computed it: mantissa and exponent."""
        return self.mantissas[place], self.exponents[place]

    def until(self, last: int) -> Tape:
        """Return the tape up to the test with index ``last``, without later tests and operations."""
        tests = self.tests[: last + 1]
        end = max((test.place for test in tests), default=-1) + 1
        code = self.operations[:end], self.firsts[:end], self.seconds[:end]
        return Tape(*code, self.mantissas[:end], self.exponents[:end], tests)

    def is_rounded(self, exact: Sequence[Number], digits: int) -> bool:
        """Return True if rounding changed any number on the tape: if one differs from its exact value."""
        for operation, m, e, value in zip(self.operations, self.mantissas, self.exponents, exact, strict=False):
            if operation != LEAF and (value != Decimal(m).scaleb(e - digits) if m else value):
                return True
        return False


@dataclass(frozen=True)
class TapeNumbers(Numbers):
    """The numbers of a decimal arithmetic, each with its index on a tape that records every operation."""

    inner: DecimalNumbers
    tape: Tape

    @property
    def name(self) -> str:
        return self.inner.name

    @property
    def digits(self) -> float:
        return self.inner.digits

    @property
    def as_1962(self) -> bool:
        return self.inner.as_1962

    def _leaf(self, pair: tuple[int, int]) -> Taped:
        return self.tape.enter(LEAF, 0, 0, *pair)

    def _operate(
        self, operation: int, function: Callable[..., tuple[int, int, int]], first: Taped, second: Taped
    ) -> Taped:
        mantissa, exponent, event = function(*first[:2], *second[:2], self.inner.profile.rules)
        value = self.tape.enter(operation, first[2], second[2], mantissa, exponent)
        if event:
            raise Trap(event, value)
        return value

    def decimal(self, whole: int, power: int, minus: bool = False) -> Taped:
        return self._leaf(self.inner.decimal(whole, power, minus))

    def from_integer(self, value: int) -> Taped:
        return self._leaf(self.inner.from_integer(value))

    def constant(self, text: str) -> Taped:
        return self._leaf(self.inner.constant(text))

    def read(self, field: Field, columns: str) -> tuple[Taped, Remark | None]:
        pair, remark = self.inner.read(field, columns)
        return self._leaf(pair), remark

    def add(self, first: Taped, second: Taped) -> Taped:
        return self._operate(ADD, add, first, second)

    def subtract(self, first: Taped, second: Taped) -> Taped:
        return self._operate(SUBTRACT, subtract, first, second)

    def multiply(self, first: Taped, second: Taped) -> Taped:
        return self._operate(MULTIPLY, multiply, first, second)

    def divide(self, dividend: Taped, divisor: Taped) -> Taped:
        return self._operate(DIVIDE, divide, dividend, divisor)

    def negate(self, value: Taped) -> Taped:
        return self.tape.enter(NEGATE, value[2], value[2], *self.inner.negate(value[:2]))

    def sign(self, value: Taped) -> int:
        return (value[0] > 0) - (value[0] < 0)

    def to_integer(self, value: Taped) -> int:
        return self.inner.to_integer(value[:2])

    def exact(self, value: Taped, digits: int) -> Fraction | int:
        return self.inner.exact(value[:2], digits)

    def cut(self, value: Taped, digits: int) -> tuple[int, int]:
        return self.inner.cut(value[:2], digits)

    def write(self, field: Field, value: Taped) -> tuple[str, bool]:
        return self.inner.write(field, value[:2])

    def function(self, name: str, value: Number) -> tuple[Number, str]:
        raise Undecided(f"the function {name} cannot be repeated in other arithmetics")

    def power(self, base: Number, exponent: Number) -> tuple[Number, str]:
        raise Undecided("a power cannot be repeated in other arithmetics")

    def integer_power(self, base: Number, count: int) -> tuple[Number, str]:
        raise Undecided("a power cannot be repeated in other arithmetics")


def record(program: Program, deck: Deck, options: Options) -> Tape:
    """Run a program on a deck in a decimal arithmetic, and return the tape of its operations.

    Recording stops at the first library function or power.  Raise what :meth:`emulator.machine.machine.Machine.run`
    raises.
    """
    assert isinstance(options.numbers, DecimalNumbers)
    tape, journal = Tape(), Journal(False)
    session = Session(
        program, deck, replace(options, numbers=TapeNumbers(options.numbers, tape)), journal=journal, keep=False
    )
    run_with_operator(session, Operator(), output=lambda events: None)
    code = program.flat
    for instruction, taken, value in journal.entries:
        if code.operations[instruction] == IF:
            first = code.addresses[instruction]
            negative, zero, positive = code.targets[first : first + 3]
            tape.tests.append(Test(instruction, value[2], (negative, zero, positive), taken))
    return tape

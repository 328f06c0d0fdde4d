"""Convert object code to steps (assignments, decisions, input and output) from which C or Fortran is written.

The instructions of a statement are executed with expressions in place of numbers in the accumulator.  So every
expression has the operations of the object code in the order of the object code, and the signs of zeros agree with
those of the emulator.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Literal

from emulator.language import objectcode as op
from emulator.language.objectcode import Instruction, Line, Program


@dataclass(frozen=True, slots=True)
class Constant:
    """A constant of the program, as its text in the source."""

    text: str


@dataclass(frozen=True, slots=True)
class Index:
    """A subscript ``factor * variable + addend``, which is a constant if it has no variable."""

    variable: str
    factor: int
    addend: int


@dataclass(frozen=True, slots=True)
class Field:
    """A variable, or an array element with its subscripts, as an operand.

    ``is_copied`` is True if the statement only copies the field.  The field may then be the undefined element N+1 of
    an array of N elements.
    """

    name: str
    indices: tuple[Index, ...] = ()
    is_copied: bool = False


@dataclass(frozen=True, slots=True)
class Operation:
    """An operation on operands.

    The operator is ``+``, ``-``, ``*``, ``/``, ``negate``, ``square``, a library function such as ``sqrt``, ``power``
    (with a floating-point exponent), ``integer_power``, or the conversion ``fixed`` or ``float``.  ``is_fixed`` is True
    if the result is fixed point.
    """

    operator: str
    operands: tuple[Expression, ...]
    is_fixed: bool = False


Expression = Constant | Field | Operation


@dataclass(frozen=True, slots=True)
class Begin:
    """The beginning of a statement.  ``label`` is its statement number, or 0 if no branch leads to the statement."""

    line: Line
    label: int


@dataclass(frozen=True, slots=True)
class Assign:
    """An assignment of an expression to a variable or array element."""

    target: Field
    value: Expression
    is_fixed: bool


@dataclass(frozen=True, slots=True)
class Test:
    """An IF with its expression and its three labels."""

    value: Expression
    labels: tuple[int, ...]
    is_fixed: bool


@dataclass(frozen=True, slots=True)
class Select:
    """A computed GO TO, with the variable that selects one of its labels."""

    selector: Expression
    labels: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Switch:
    """A test of a sense switch (a console switch), with the labels for on and off."""

    number: int
    labels: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class GoTo:
    """A branch to a label."""

    label: int


@dataclass(frozen=True, slots=True)
class Top:
    """The first statement of a DO loop, to which the end of the loop branches."""

    label: int


@dataclass(frozen=True, slots=True)
class Repeat:
    """The end of a DO loop: add the step to the variable, and branch back if it does not exceed the limit."""

    card: int
    variable: Field
    step: Expression
    last: Expression
    label: int


@dataclass(frozen=True, slots=True)
class List:
    """The beginning of a list of an input or output statement, with its verb, such as READ, and FORMAT number."""

    verb: str
    format: int


@dataclass(frozen=True, slots=True)
class Item:
    """A number in an input or output list, or a whole array of ``count`` elements."""

    target: Field
    is_input: bool
    is_fixed: bool
    count: int


@dataclass(frozen=True, slots=True)
class Simple:
    """A step that uses no variables: the end of a list, PAUSE with its number, or STOP, which also stands for END."""

    kind: Literal["end of list", "PAUSE", "STOP"]
    number: int = 0


Step = Begin | Assign | Test | Select | Switch | GoTo | Top | Repeat | List | Item | Simple

# The first label of the loops.  Statement numbers have four digits.
LOOPS = 90000

_FLOATING = {op.FAD: "+", op.FSB: "-", op.FSBR: "-", op.FMP: "*", op.FDV: "/", op.FDVR: "/"}
_FIXED = {op.XAD: "+", op.XSB: "-", op.XSBR: "-", op.XMP: "*", op.XDV: "/", op.XDVR: "/"}


@dataclass
class _Walk:
    """The expressions in the accumulators and temporary fields, while the instructions are executed symbolically.

    ``pc`` is the index of the last COUNT.
    """

    program: Program
    floating: Expression = field(default_factory=lambda: Constant("0."))
    fixed: Expression = field(default_factory=lambda: Constant("0"))
    sent: Expression = field(default_factory=lambda: Constant("0"))
    temporaries: dict[int, Expression] = field(default_factory=dict)
    is_input: bool = False
    pc: int = 0

    def __post_init__(self) -> None:
        self.tops = {pc: LOOPS + n for n, (*_, pc) in enumerate(self.program.loops, 1)}
        self.targets = {pc for branch in self.program.branches for pc in branch}
        self.immediates = dict(self.program.storage.immediates)

    def steps(self) -> Iterator[Step]:
        for pc, instruction in enumerate(self.program.code):
            if pc in self.tops:
                yield Top(self.tops[pc])
            if instruction.operation == op.COUNT:
                self.pc = pc
                counter = self.program.counters[instruction.address]
                if counter.begins:
                    line = self.program.statements[counter.statement]
                    yield Begin(line, line.label if pc in self.targets else 0)
                continue
            yield from self._step(instruction)

    def _step(self, instruction: Instruction) -> Iterator[Step]:
        operation, address = instruction.operation, instruction.address
        if operation in (op.FMFAC, op.FMFIX, op.TRANSMIT):
            is_fixed = operation == op.FMFIX
            value = self.sent if operation == op.TRANSMIT else self.fixed if is_fixed else self.floating
            if instruction.subscript < 0 and self.program.storage.entry_of(address).kind == "temporary":
                self.temporaries[address] = value
            else:
                target = self._operand(instruction)
                assert isinstance(target, Field), "only fields are stored into"
                yield Assign(target, value, is_fixed or (operation == op.TRANSMIT and target.name[0] in "IJKLMN"))
        elif operation == op.SEND:
            operand = self._operand(instruction)
            self.sent = Field(operand.name, operand.indices, True) if isinstance(operand, Field) else operand
        elif operation == op.TOFAC:
            self.floating = self._operand(instruction)
        elif operation == op.TOFIX:
            self.fixed = self._operand(instruction)
        elif operation in _FLOATING:
            self.floating = self._combined(self.floating, instruction, False)
        elif operation in _FIXED:
            self.fixed = self._combined(self.fixed, instruction, True)
        elif operation == op.RSGN:
            self.floating = Operation("negate", (self.floating,))
        elif operation == op.RSGX:
            self.fixed = Operation("negate", (self.fixed,), True)
        elif operation == op.FLOAT:
            self.floating = Operation("float", (self.fixed,))
        elif operation == op.FIX:
            self.fixed = Operation("fixed", (self.floating,), True)
        elif operation == op.FUNCTION:
            self.floating = Operation(self.program.functions[address].lower(), (self.floating,))
        elif operation == op.POWER:
            self.floating = Operation("power", (self._operand(instruction), self.floating))
        elif operation == op.POWERX:
            self.floating = Operation("integer_power", (self.floating, self._operand(instruction)))
        else:
            yield self._control(instruction)

    def _control(self, instruction: Instruction) -> Step:
        operation, address, second = instruction.operation, instruction.address, instruction.second
        if operation in (op.IF, op.IFX):
            value = self.fixed if operation == op.IFX else self.floating
            return Test(value, self._labels(address), operation == op.IFX)
        if operation == op.SELECT:
            return Select(self._operand(instruction), self._labels(second))
        if operation == op.SWITCH:
            return Switch(second, self._labels(address))
        if operation == op.BRANCH:
            return GoTo(self._labels(address)[0])
        if operation == op.DOTEST:
            variable, step, last, pc = self.program.loops[address]
            name = self._field(variable)
            assert isinstance(name, Field), "the variable of a DO is a variable"
            return Repeat(
                self.program.line_at(self.pc).place.card, name, self._field(step), self._field(last), self.tops[pc]
            )
        if operation == op.BEGIN:
            verb = self.program.verbs[address]
            self.is_input = verb in ("READ", "ACCEPT")
            return List(verb, self.program.formats[second][0])
        if operation == op.ITEM:
            target = self._operand(instruction)
            assert isinstance(target, Field), "the items of a list are fields"
            if op.repeats(instruction) > 1:
                target = Field(target.name)
            return Item(target, self.is_input, second < 0, op.repeats(instruction))
        if operation == op.FINISH:
            return Simple("end of list")
        return Simple("PAUSE", second) if operation == op.PAUSE else Simple("STOP")

    def _combined(self, accumulator: Expression, instruction: Instruction, is_fixed: bool) -> Expression:
        operation, operand = instruction.operation, self._operand(instruction)
        operator = (_FIXED if is_fixed else _FLOATING)[operation]
        if operator == "*" and operand == accumulator and not is_fixed:
            return Operation("square", (accumulator,))
        if operation in (op.FDVR, op.XDVR):
            return Operation(operator, (operand, accumulator), is_fixed)
        combined = Operation(operator, (accumulator, operand), is_fixed)
        # FSBR subtracts the field from the accumulator, and reverses the sign.
        return Operation("negate", (combined,), is_fixed) if operation in (op.FSBR, op.XSBR) else combined

    def _labels(self, branch: int) -> tuple[int, ...]:
        return tuple(self.program.line_at(pc).label for pc in self.program.branches[branch])

    def _operand(self, instruction: Instruction) -> Expression:
        if instruction.subscript < 0:
            return self._field(instruction.address)
        subscript = self.program.subscripts[instruction.subscript]
        parts = [(subscript.v1, subscript.c1, subscript.o1), (subscript.v2, subscript.c2, subscript.o2)]
        name = self.program.storage.name_of
        indices = (Index(name(v) if v >= 0 else "", c, o) for v, c, o in parts[: 2 if subscript.columns else 1])
        return Field(self.program.storage.entry_of(subscript.array).name, tuple(indices))

    def _field(self, address: int) -> Expression:
        if address in self.immediates:
            return Constant(self.immediates[address])
        entry = self.program.storage.entry_of(address)
        if entry.kind == "temporary":
            return self.temporaries[address]
        if entry.kind == "constant":
            return Constant(entry.name.removeprefix("constant "))
        offset = address - entry.first
        if len(entry.shape) == 2:
            column, row = divmod(offset, entry.shape[0])
            return Field(entry.name, (Index("", 0, row + 1), Index("", 0, column + 1)))
        return Field(entry.name, (Index("", 0, offset + 1),) if entry.shape else ())


def steps(program: Program) -> Iterator[Step]:
    """Convert a program to steps, and yield them in the order of its object code."""
    return _Walk(program).steps()

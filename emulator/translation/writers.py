"""Write a program as C or Fortran source text, which begins with a runtime for devices and FORMATs.

Both languages keep the statement numbers as labels.  The written program truncates each fixed-point result to four
digits, checks each subscript, and calls a function of the runtime for each decision.  This function can write the
decision to a file.  The files ``runtime.c`` and ``runtime.f90`` next to this module implement the devices and FORMATs.
"""

import re
from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from importlib.resources import files

from emulator.language import objectcode as op
from emulator.language.cards import Deck
from emulator.language.compiler import compile_deck
from emulator.language.expressions import is_fixed_name
from emulator.language.formats import FormatSpec, Literal, Slash
from emulator.language.objectcode import Program
from emulator.language.storage import Entry
from emulator.translation import steps
from emulator.translation.steps import Constant, Expression, Field, Index, Step

# The length of a line of Fortran after which a statement continues on the next line.
_LINE = 100

# The names of variables that the headers of C define as macros.
_C_MACROS = ("BUFSIZ", "EOF", "NAN", "NULL")

_UNITS = {"READ": "read_cards", "ACCEPT": "accept_lines", "PUNCH": "punch_cards"}
_CALLS = {name: f"{name}_of" for name in ("sqrt", "sin", "cos", "atan", "exp", "log", "power", "integer_power")}
_CONVERSIONS = {"fixed": "fixed_of", "float": "float_of"}

_ZERO_CONSTANT = re.compile(r"(?<![0-9])0*\.0*(d[+-]?\d+)?(?![0-9])")

# Precedences of expressions: a sum or a negated expression, a product, and an operand without operators.
_SUM, _PRODUCT, _OPERAND = range(3)


def layout(spec: FormatSpec, is_read: bool) -> tuple[str, int]:
    """Return a FORMAT as one text, and the index in this text at which a list longer than the FORMAT continues.

    The index is -1 if the FORMAT has no field for a number.  If a READ or ACCEPT uses the FORMAT, its X fields become H
    fields, because reading stores the skipped columns in them.
    """
    tokens = []
    for part in spec.specs:
        if isinstance(part, Literal):
            is_text = is_read or not part.skip
            tokens.append(f"{len(part.text)}H{part.text}" if is_text else f"{len(part.text)}X")
        else:
            tokens.append("/" if isinstance(part, Slash) else str(part))
    return ",".join(tokens), len(",".join(tokens[: spec.again])) if spec.has_fields else -1


@dataclass
class Writer(ABC):
    """The base class of the writers.

    If ``every_read_ends`` is True, the written program ends normally at any READ that finds the hopper empty.
    """

    program: Program
    every_read_ends: bool
    card: int = field(init=False, default=0)

    def __post_init__(self) -> None:
        used = {(i.address, i.second) for i in self.program.code if i.operation == op.BEGIN}
        inputs = {number for verb, number in used if self.program.verbs[verb] in ("READ", "ACCEPT")}
        numbered = enumerate(self.program.formats)
        self.layouts = {
            label: layout(spec, n in inputs) for n, (label, spec) in numbered if n in {number for _, number in used}
        }
        self.format = 0
        entries = self.program.storage.entries
        self.scalars = [entry.name for entry in entries if entry.kind == "variable"]
        self.arrays: dict[str, Entry] = {entry.name: entry for entry in entries if entry.kind == "array"}

    def text(self) -> str:
        """Return the source text of the whole program."""
        return "\n".join([*self.head(), *self.body(), *self.tail()]) + "\n"

    def body(self) -> Iterator[str]:
        for step in steps.steps(self.program):
            if isinstance(step, steps.Begin):
                self.card = step.line.place.card
            elif isinstance(step, steps.List):
                self.format = step.format
            yield from self.step(step)

    @abstractmethod
    def head(self) -> Iterator[str]: ...

    @abstractmethod
    def step(self, step: Step) -> Iterator[str]: ...

    @abstractmethod
    def tail(self) -> Iterator[str]: ...

    @abstractmethod
    def constant(self, text: str) -> str: ...

    @abstractmethod
    def name(self, field: Field) -> str: ...

    @abstractmethod
    def call(self, function: str, operands: Sequence[str]) -> str: ...

    def expression(self, node: Expression, at_least: int = _SUM) -> str:
        """Return an expression as source text, in parentheses if its precedence is below ``at_least``."""
        match node:
            case Constant(text):
                return self.constant(text)
            case Field():
                return self.name(node)
        operands, operator = node.operands, node.operator
        precedence = _OPERAND
        if operator in _CALLS:
            return self.call(_CALLS[operator], [self.expression(operand) for operand in operands])
        if operator in _CONVERSIONS or (operator == "/" and node.is_fixed):
            function = _CONVERSIONS.get(operator, "quotient")
            return self.call(function, [str(self.card), *(self.expression(operand) for operand in operands)])
        if operator == "square":
            text = self.square(operands[0])
        elif operator == "negate":
            text, precedence = "-" + self.expression(operands[0], _PRODUCT), _SUM
        else:
            precedence = _PRODUCT if operator in "*/" else _SUM
            first, second = self.expression(operands[0], precedence), self.expression(operands[1], precedence + 1)
            if operator == "/":
                second = self.divisor(second)
            text = f"{first} {operator} {second}" if precedence == _SUM else f"{first}{operator}{second}"
        if node.is_fixed and operator != "negate":
            return self.call("four_digits", [str(self.card), text])
        return f"({text})" if precedence < at_least else text

    def divisor(self, text: str) -> str:
        """Return the source text of a divisor in a form that compilers accept, even for the constant zero."""
        return text

    @abstractmethod
    def square(self, operand: Expression) -> str: ...

    def subscript(self, index: Index) -> str:
        if not index.variable:
            return str(index.addend)
        variable = self.name(Field(index.variable))
        product = variable if index.factor == 1 else f"{index.factor}*{variable}"
        return product + (f" {'+' if index.addend > 0 else '-'} {abs(index.addend)}" if index.addend else "")


class CWriter(Writer):
    """The writer of C11 source text, which C++ compilers also accept."""

    def head(self) -> Iterator[str]:
        program = self.program
        yield f"/* {program.source}, translated from 1620 FORTRAN by hull1620. */"
        yield f'static const char *source_name = "{program.source}";'
        yield f"enum {{ every_read_ends = {int(self.every_read_ends)} }};"
        yield ""
        yield from _runtime("runtime.c")
        yield ""
        for label, (text, _) in self.layouts.items():
            yield f'static char format_{label}[] = "{text}";'
        for name, entry in self.arrays.items():
            spare = 1 if len(entry.shape) == 1 else 0
            yield f"static {self.type(name)} {name}_[{entry.size + spare}];"
            i = f"index_of(__LINE__, i, {entry.shape[0]})"
            if spare:
                yield f"#define {name}(i) {name}_[{i}]"
                yield f"#define {name}_copied(i) {name}_[copied_of(__LINE__, i, {entry.shape[0]})]"
            else:
                j = f"index_of(__LINE__, j, {entry.shape[1]})"
                yield f"#define {name}(i, j) {name}_[{i} + {entry.shape[0]} * {j}]"
        yield ""
        yield "int main(int count, char **arguments) {"
        for name in self.scalars:
            yield f"    {self.type(name)} {self.name(Field(name))} = {self.undefined(name)};"
        yield "    start(count, arguments);"
        for name in self.arrays:
            yield f"    undefine({name}_, {self.undefined(name)});"

    def tail(self) -> Iterator[str]:
        yield "    finish_run();"
        yield "}"

    def step(self, step: Step) -> Iterator[str]:
        match step:
            case steps.Begin(line, label):
                yield f'#line {line.place.card} "{self.program.source}" /* {line.text.replace("*/", "* /")} */'
                if label:
                    yield f"L{label}:;"
            case steps.Top(label):
                yield f"L{label}:;"
            case steps.Assign(target, value, _):
                yield f"    {self.name(target)} = {self.expression(value)};"
            case steps.Test(value, labels, is_fixed):
                function = "integer_sign_of" if is_fixed else "sign_of"
                yield self.switch(f"{function}({self.card}, {self.expression(value)})", labels, -1)
            case steps.Select(selector, labels):
                yield self.switch(f"choice_of({self.card}, {self.expression(selector)}, {len(labels)})", labels, 1)
            case steps.Switch(number, (on, off)):
                yield f"    if (switch_is_on({number})) goto L{on}; else goto L{off};"
            case steps.GoTo(label):
                yield f"    goto L{label};"
            case steps.Repeat(card, variable, size, last, label):
                bounds = f"&{self.name(variable)}, {self.expression(size)}, {self.expression(last)}"
                yield f"    if (is_repeated({card}, {bounds})) goto L{label};"
            case steps.List(verb, number):
                unit = _UNITS.get(verb, "type_lines").upper()
                yield f"    begin_list({self.card}, {unit}, format_{number}, {self.layouts[number][1]});"
            case steps.Item(target, is_input, is_fixed, count):
                function = f"{'get' if is_input else 'put'}_{'integer' if is_fixed else 'real'}"
                whole = count > 1
                element = f"{target.name}_[item]" if whole else self.name(target)
                loop = f"for (int item = 0; item < {count}; item++) " if whole else ""
                yield f"    {loop}{function}({'&' if is_input else ''}{element});"
            case steps.Simple("end of list"):
                yield "    end_list();"
            case steps.Simple("PAUSE", number):
                yield f"    pause_at({self.card}, {number});"
            case steps.Simple():
                yield "    finish_run();"

    def switch(self, value: str, labels: Sequence[int], first: int) -> str:
        cases = "".join(f"case {first + n}: goto L{label}; " for n, label in enumerate(labels[:-1]))
        return f"    switch ({value}) {{ {cases}default: goto L{labels[-1]}; }}"

    def constant(self, text: str) -> str:
        return text if "." in text else str(int(text))

    def name(self, field: Field) -> str:
        if not field.indices:
            return f"{field.name}_" if field.name in _C_MACROS else field.name
        copied = "_copied" if field.is_copied and len(field.indices) == 1 else ""
        return f"{field.name}{copied}({', '.join(map(self.subscript, field.indices))})"

    def call(self, function: str, operands: Sequence[str]) -> str:
        return f"{function}({', '.join(operands)})"

    def square(self, operand: Expression) -> str:
        return f"squared({self.expression(operand)})"

    def type(self, name: str) -> str:
        return "integer" if is_fixed_name(name) else "real"

    def undefined(self, name: str) -> str:
        return f"undefined_{self.type(name)}"


class FortranWriter(Writer):
    """The writer of source text in free-form Fortran 2018."""

    def head(self) -> Iterator[str]:
        yield f"! {self.program.source}, translated from 1620 FORTRAN by hull1620."
        yield from _runtime("runtime.f90")
        yield ""
        yield "program deck_"
        yield "  use ibm_1620"
        yield "  implicit none"
        for label, (text, _) in self.layouts.items():
            quoted = text.replace("'", "''")
            yield from _wrapped(f"  character(len={len(text)}) :: format_{label} = '{quoted}'")
        for name in self.scalars:
            yield f"  {self.type(name)} :: {name} = {self.undefined(name)}"
        for name, entry in self.arrays.items():
            sizes = [entry.size + 1] if len(entry.shape) == 1 else entry.shape
            yield f"  {self.type(name)} :: {name}({','.join(map(str, sizes))})"
        yield "  integer :: outcome_"
        yield f"  call start_('{self.program.source}', .{str(self.every_read_ends).lower()}.)"
        for name in (*self.scalars, *self.arrays):
            if not is_fixed_name(name) or name in self.arrays:
                yield f"  {name} = {'undefined_integer' if is_fixed_name(name) else 'undefined_()'}"

    def tail(self) -> Iterator[str]:
        yield "  call finish_()"
        yield "end program"

    def step(self, step: Step) -> Iterator[str]:
        for line in self.lines(step):
            yield from _wrapped(f"  {line}" if not line[0].isdigit() else line)

    def lines(self, step: Step) -> Iterator[str]:
        match step:
            case steps.Begin(line, label):
                yield f"! card {line.place.card}: {line.text}"[:_LINE]
                if label:
                    yield f"{label} continue"
            case steps.Top(label):
                yield f"{label} continue"
            case steps.Assign(target, value, _):
                yield f"{self.name(target)} = {self.expression(value)}"
            case steps.Test(value, labels, is_fixed):
                function = "integer_sign_of_" if is_fixed else "sign_of_"
                yield from self.branches(f"{function}({self.card}, {self.expression(value)})", labels, -1)
            case steps.Select(selector, labels):
                value_text = f"choice_of_({self.card}, {self.expression(selector)}, {len(labels)})"
                yield from self.branches(value_text, labels, 1)
            case steps.Switch(number, (on, off)):
                yield f"if (switch_is_on_({number})) go to {on}"
                yield f"go to {off}"
            case steps.GoTo(label):
                yield f"go to {label}"
            case steps.Repeat(card, variable, size, last, label):
                bounds = f"{self.name(variable)}, {self.expression(size)}, {self.expression(last)}"
                yield f"if (is_repeated_({card}, {bounds})) go to {label}"
            case steps.List(verb, number):
                again = self.layouts[number][1]
                yield f"call begin_list_({self.card}, {_UNITS.get(verb, 'type_lines')}, format_{number}, {again})"
            case steps.Item(target, is_input, is_fixed, count):
                function = f"{'get' if is_input else 'put'}_{'integer' if is_fixed else 'real'}_"
                yield from self.items(function, target, count)
            case steps.Simple("end of list"):
                yield f"call end_list_(format_{self.format})"
            case steps.Simple("PAUSE", number):
                yield f"call pause_({self.card}, {number})"
            case steps.Simple():
                yield "call finish_()"

    def items(self, function: str, target: Field, count: int) -> Iterator[str]:
        if count == 1:
            yield f"call {function}({self.name(target)})"
            return
        # Arrays are transferred column by column.
        shape = self.arrays[target.name].shape
        for n in range(count):
            indices = [n + 1] if len(shape) == 1 else [n % shape[0] + 1, n // shape[0] + 1]
            yield f"call {function}({target.name}({','.join(map(str, indices))}))"

    def branches(self, value: str, labels: Sequence[int], first: int) -> Iterator[str]:
        yield f"outcome_ = {value}"
        for n, label in enumerate(labels[:-1]):
            yield f"if (outcome_ == {first + n}) go to {label}"
        yield f"go to {labels[-1]}"

    def constant(self, text: str) -> str:
        if "." not in text:
            return f"{int(text)}_int_64"
        return text.replace("E", "d") + ("" if "E" in text else "d0")

    def name(self, field: Field) -> str:
        if not field.indices:
            return field.name
        shape = self.arrays[field.name].shape
        function = "copied_" if field.is_copied and len(shape) == 1 else "at_"
        parts = [
            f"{function}({self.card}, {self.subscript(index)}, {size})" if index.variable else str(index.addend)
            for index, size in zip(field.indices, shape, strict=True)
        ]
        return f"{field.name}({', '.join(parts)})"

    def divisor(self, text: str) -> str:
        # gfortran rejects a division by a constant zero.
        return _ZERO_CONSTANT.sub("zero_", text)

    def call(self, function: str, operands: Sequence[str]) -> str:
        return f"{function}_({', '.join(operands)})"

    def square(self, operand: Expression) -> str:
        return f"{self.expression(operand, _OPERAND)}**2"

    def type(self, name: str) -> str:
        return "integer(int_64)" if is_fixed_name(name) else "real(real_64)"

    def undefined(self, name: str) -> str:
        return "undefined_integer" if is_fixed_name(name) else "0"


def _runtime(name: str) -> list[str]:
    return files("emulator.translation").joinpath(name).read_text(encoding="ascii").splitlines()


def _wrapped(text: str) -> Iterator[str]:
    """Yield the lines of a Fortran statement.  A long line is divided, even within a quoted text."""
    lines = [text[at : at + _LINE] for at in range(0, len(text), _LINE)]
    for n, line in enumerate(lines):
        yield ("&" if n else "") + line + ("&" if n < len(lines) - 1 else "")


WRITERS: dict[str, type[Writer]] = {"c": CWriter, "fortran": FortranWriter}


def translated(deck: Deck, language: str, every_read_ends: bool = True) -> str:
    """Translate a FORTRAN deck of the 1620 to C or Fortran, and return the source text.

    The translated program ends normally if the READ that begins a data set finds the hopper empty.  If
    ``every_read_ends`` is True, this holds for every READ.  Raise CompileError, with card and column, for a deck that
    does not compile.
    """
    return WRITERS[language](compile_deck(deck), every_read_ends).text()

"""Formulas and programs in FPCore 2.0, the format of floating-point benchmarks (https://fpbench.org).

A formula is a Python function of numbers.  Called with :class:`Symbol` objects, the function records its operations, so
that the FPCore has the operations of the code in their order.  The precision is always binary64, because FPCore cannot
express numbers of eight decimal digits.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from emulator.language.objectcode import Program
from emulator.translation.steps import Assign, Begin, Constant, Expression, Field, Operation, Test, steps


@dataclass(frozen=True, slots=True)
class Symbol:
    """An FPCore expression, held as text; arithmetic on symbols builds longer expressions."""

    text: str

    def __add__(self, addend: Symbol) -> Symbol:
        return Symbol(f"(+ {self.text} {addend.text})")

    def __sub__(self, subtrahend: Symbol) -> Symbol:
        return Symbol(f"(- {self.text} {subtrahend.text})")

    def __mul__(self, factor: Symbol) -> Symbol:
        return Symbol(f"(* {self.text} {factor.text})")

    def __truediv__(self, divisor: Symbol) -> Symbol:
        return Symbol(f"(/ {self.text} {divisor.text})")

    def __neg__(self) -> Symbol:
        return Symbol(f"(- {self.text})")


# A function of numbers: Symbol objects, floats or Fractions.
Computation = Callable[..., Any]


@dataclass(frozen=True, slots=True)
class Formula:
    """A formula with its source.

    Attributes
    ----------
    name, cite, description
        The name, the key of the source and a sentence about the formula.
    arguments
        The names of the arguments.
    computed
        The function that computes the formula, with the operations in their original order.
    spec
        A function with the same value in real arithmetic, which computes it in a simpler or independent way.  If there
        is no such way, ``spec`` is the function ``computed``.
    most
        The largest absolute value of an argument on the input cards.
    condition
        A further precondition, as FPCore text.
    """

    name: str
    cite: str
    description: str
    arguments: tuple[str, ...]
    computed: Computation
    spec: Computation
    most: int = 1000
    condition: str = ""

    def text(self) -> str:
        """Return the formula as FPCore text."""
        symbols = [Symbol(name) for name in self.arguments]
        ranges = " ".join(f"(<= -{self.most} {name} {self.most})" for name in self.arguments)
        ranges += f" {self.condition}" if self.condition else ""
        return (
            f"(FPCore ({' '.join(self.arguments)})\n"
            f'  :name "{self.name}"\n  :cite ({self.cite})\n  :description "{self.description}"\n'
            f"  :precision binary64\n  :pre (and {ranges})\n  :spec {self.spec(*symbols).text}\n"
            f"  {self.computed(*symbols).text})\n"
        )


def document(formulas: Sequence[Formula], heading: str) -> str:
    """Return the text of an FPCore file with these formulas, after ``heading`` as a comment."""
    comment = "".join(f"; {line}\n" for line in heading.splitlines())
    return comment + "".join("\n" + formula.text() for formula in formulas)


_FUNCTIONS = {"sqrt": "(sqrt (fabs {0}))", "log": "(log (fabs {0}))", "power": "(pow (fabs {0}) {1})"}
_FUNCTIONS |= {name: f"({name} {{0}})" for name in ("sin", "cos", "atan", "exp")}
_FUNCTIONS |= {"square": "(* {0} {0})", "negate": "(- {0})", "integer_power": "(pow {0} {1})", "float": "{0}"}


def _written(node: Expression) -> str:
    match node:
        case Constant(text):
            return text.replace("E", "e").rstrip(".") if "." in text else text
        case Field():
            return _symbol(node)
    operands = [_written(operand) for operand in node.operands]
    if node.operator in _FUNCTIONS:
        return _FUNCTIONS[node.operator].format(*operands)
    return f"({node.operator} {' '.join(operands)})"


def _symbol(field: Field) -> str:
    parts = [
        (f"{index.factor}*" if index.factor != 1 else "")
        + index.variable
        + (f"{index.addend:+d}" if index.addend else "")
        if index.variable
        else str(index.addend)
        for index in field.indices
    ]
    return field.name + "".join(f"_{part.replace('*', 'x').replace('+', 'p').replace('-', 'm')}" for part in parts)


def _parts(node: Expression) -> Iterator[Expression]:
    yield node
    if isinstance(node, Operation):
        for operand in node.operands:
            yield from _parts(operand)


def statements(program: Program) -> str:
    """Translate the floating-point expressions of a program's assignments and IFs to FPCore.

    Subscripts become parts of names: ``X(2*I+1)`` is ``X_2xIp1``.  A statement with fixed-point arithmetic, which
    FPCore lacks, is omitted, and a comment names the statement.
    """
    written, line = [], program.statements[0]
    for step in steps(program):
        if isinstance(step, Begin):
            line = step.line
        if not isinstance(step, Assign | Test) or not isinstance(step.value, Operation):
            continue
        parts = list(_parts(step.value))
        title = f"{program.source}, card {line.place.card}: {line.text}"
        if any(isinstance(part, Operation) and part.is_fixed for part in parts):
            written.append(f"; {title}: fixed-point arithmetic has no counterpart\n")
            continue
        names = dict.fromkeys(_symbol(part) for part in parts if isinstance(part, Field))
        text = f'(FPCore ({" ".join(names)})\n  :name "{title}"\n  :precision binary64\n  {_written(step.value)})\n'
        written.append(text)
    return "\n".join(written)

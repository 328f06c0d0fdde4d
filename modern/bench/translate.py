"""Translation of a source deck of 1620 FORTRAN to free-form Fortran for a modern compiler, computing in doubles.

The differences of the two languages are translated as follows:

- A statement may begin in any column and contain blanks anywhere. It is printed again from the syntax tree.
- PUNCH writes to standard output, PRINT and TYPE write to a second file, and READ reads standard input. An empty
  hopper ends the run (C26-5619 p. 32-43).
- A DO runs at least once and reads its limit again at each pass (p. 25-28). Step, test and jump are written after its
  last statement, so that jumps into its range work as on the machine.
- IF (SENSE SWITCH n) tests a logical constant.
- Hollerith texts of a FORMAT become quoted texts, and blanks on input.
- Floating-point constants become double precision, names keep their implicit type, and SQRTF becomes SQRT.

Integers are those of the compiler, not four digits modulo 10000. An ACCEPT statement raises DeckError, because a
program without a typewriter has no counterpart of it.
"""

from collections.abc import Collection, Iterator
from typing import assert_never

from emulator.errors import DeckError
from emulator.language import tree
from emulator.language.cards import Deck
from emulator.language.formats import Literal, parse_format
from emulator.language.parser import parse
from emulator.numbers.fields import Field

LIBRARY = {name + end: name for name in ("SQRT", "SIN", "COS", "ATAN", "EXP", "LOG") for end in ("", "F")}
# The label of the end of the run. Statement numbers of the 1620 have four digits (C26-5619 p. 12).
EMPTY = 90000
TOPS = 90001
# The length after which a statement continues on the next line.
LINE = 100
# The unit for typed lines.
TYPED = 8


def translated(deck: Deck, switches: Collection[int] = ()) -> str:
    """Return the program as one free-form source text. Raise DeckError if the deck does not parse or has an ACCEPT."""
    parsed = parse(deck)
    if parsed.diagnostics:
        raise DeckError(parsed.diagnostics[0].line(deck.source))
    return "\n".join(_Writer(deck.source, parsed.statements).lines(switches)) + "\n"


class _Writer:
    def __init__(self, source: str, statements: tuple[tree.Statement, ...]) -> None:
        self.source, self.statements = source, statements
        bodies = [s.body for s in statements]
        self.arrays = {name for body in bodies if isinstance(body, tree.Dimension) for name, _, _ in body.arrays}
        self.inputs = {body.format for body in bodies if isinstance(body, tree.InputOutput) and body.verb == "READ"}
        self.open: list[tuple[tree.Do, int]] = []
        self.top = TOPS

    def lines(self, switches: Collection[int]) -> Iterator[str]:
        yield "program deck"
        yield "implicit double precision (a-h,o-z), integer (i-n)"
        for number in (1, 2, 3, 4):
            yield f"logical, parameter :: switch_{number} = .{'true' if number in switches else 'false'}."
        for statement in self.statements:
            if isinstance(statement.body, tree.Dimension):
                yield from _wrapped("dimension " + ",".join(map(_array, statement.body.arrays)))
        yield f"open({TYPED}, file='typewriter')"
        for statement in self.statements:
            yield from self.statement(statement)
        yield f"{EMPTY} continue"
        yield "end program"

    def statement(self, statement: tree.Statement) -> Iterator[str]:
        body = statement.body
        if isinstance(body, tree.Dimension | tree.End):
            return
        label = f"{statement.label} " if statement.label else ""
        if isinstance(body, tree.Do):
            self.top += 1
            yield f"{label}{body.variable.name} = {self.text(body.first)}"
            yield f"{self.top} continue"
            self.open.append((body, self.top))
            return
        yield from _wrapped(label + self.translated_line(body, statement))
        # If several loops end at this statement, the innermost ends first.
        while self.open and statement.label and self.open[-1][0].label == statement.label:
            loop, top = self.open.pop()
            name, step = loop.variable.name, self.text(loop.step) if loop.step else "1"
            yield f"{name} = {name} + {step}"
            yield f"if ({name} <= {self.text(loop.last)}) go to {top}"

    def translated_line(self, body: tree.Body, statement: tree.Statement) -> str:
        match body:
            case tree.Assignment(target, value):
                return f"{self.text(target)} = {self.text(value)}"
            case tree.GoTo(label):
                return f"go to {label}"
            case tree.ComputedGoTo(labels, selector):
                return f"go to ({_commas(labels)}), {self.text(selector)}"
            case tree.If(value, labels):
                return f"if ({self.text(value)}) {_commas(labels)}"
            case tree.IfSwitch(number, (on, off)):
                return f"go to ({on},{off}), merge(1, 2, switch_{number})"
            case tree.Stop():
                return f"go to {EMPTY}"
            case tree.InputOutput():
                return self.transfer(body, statement)
            case tree.Format():
                return self.format(statement, body)
            case tree.Continue() | tree.Pause():
                return "continue"
            case tree.Do() | tree.Dimension() | tree.End():
                raise AssertionError(f"{type(body).__name__} is not one line")
        assert_never(body)

    def transfer(self, body: tree.InputOutput, statement: tree.Statement) -> str:
        if body.verb == "ACCEPT":
            raise DeckError(f"{self.source}: card {statement.place.card}: ACCEPT has no counterpart in a file")
        if body.verb == "READ":
            verb = f"read (*,{body.format},end={EMPTY})"
        else:
            verb = f"write ({'*' if body.verb == 'PUNCH' else TYPED},{body.format})"
        return f"{verb} {_commas(map(self.item, body.items))}".rstrip()

    def item(self, item: tree.Item) -> str:
        if isinstance(item, tree.Reference):
            return self.text(item)
        first, last = self.text(item.first), self.text(item.last)
        bounds = f"{item.variable.name}={first},max({first},{last})"
        step = f",{self.text(item.step)}" if item.step else ""
        return f"({_commas(map(self.item, item.items))},{bounds}{step})"

    def format(self, statement: tree.Statement, body: tree.Format) -> str:
        reads = statement.label in self.inputs
        specs = []
        for spec in parse_format(body)[0].specs:
            if isinstance(spec, Field):
                specs.append(str(spec))
            elif isinstance(spec, Literal):
                blank = spec.skip or reads
                specs.append(f"{len(spec.text)}x" if blank else "'" + spec.text.replace("'", "''") + "'")
            else:
                specs.append("/")
        return f"format ({_commas(specs)})"

    def text(self, node: tree.Expression) -> str:
        match node:
            case tree.Number(digits):
                return (digits.replace("E", "d") + ("" if "E" in digits else "d0")) if node.floating else digits
            case tree.Reference(name, arguments):
                called = LIBRARY.get(name, name) if arguments and name not in self.arrays else name
                return called + (f"({_commas(map(self.text, arguments))})" if arguments else "")
            case tree.Power(base, exponent):
                return f"{self.factor(base)}**{self.factor(exponent)}"
            case tree.Product(first, rest):
                return self.factor(first) + "".join(sign + self.factor(operand) for sign, operand in rest)
            case tree.Sum(minus, first, rest):
                head = ("-" if minus else "") + self.factor(first)
                return head + "".join(sign + self.factor(operand) for sign, operand in rest)

    def factor(self, node: tree.Expression) -> str:
        """Return an operand as text, in parentheses if it is an expression, so that the order is preserved."""
        simple = isinstance(node, tree.Reference) or (isinstance(node, tree.Number) and node.text[0] not in "+-")
        return self.text(node) if simple else f"({self.text(node)})"


def _array(array: tuple[str, tuple[int, ...], tree.Place]) -> str:
    return f"{array[0]}({_commas(array[1])})"


def _commas(parts: object) -> str:
    return ",".join(map(str, parts))  # type: ignore[call-overload]


def _wrapped(text: str) -> Iterator[str]:
    """Yield the lines of a statement, with at most LINE columns. A quoted text may continue too."""
    lines = [text[at : at + LINE] for at in range(0, len(text), LINE)]
    for n, line in enumerate(lines):
        yield ("&" if n else "") + line + ("&" if n < len(lines) - 1 else "")

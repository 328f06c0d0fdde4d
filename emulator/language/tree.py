"""The syntax tree of 1620 FORTRAN as frozen dataclasses.  Every node keeps the card and column it was read from.

The docstring of each statement quotes its form and gives the page of IBM 1620 FORTRAN (with FORMAT), C26-5619.
"""

from __future__ import annotations

from dataclasses import dataclass

from emulator.errors import Place as Place


@dataclass(frozen=True, slots=True)
class Number:
    """A constant as the statement writes it.  A constant without a decimal point is fixed point (p. 14)."""

    text: str
    place: Place

    @property
    def floating(self) -> bool:
        return "." in self.text


@dataclass(frozen=True, slots=True)
class Reference:
    """A variable, an array element or a call of a library function (p. 16, 18, 63)."""

    name: str
    arguments: tuple[Expression, ...]
    place: Place


@dataclass(frozen=True, slots=True)
class Power:
    """The power ``base ** exponent`` (p. 19, rule 2)."""

    base: Expression
    exponent: Expression
    place: Place


@dataclass(frozen=True, slots=True)
class Product:
    """A product or quotient: a first factor, and each further factor with the ``*`` or ``/`` before it (p. 19)."""

    first: Expression
    rest: tuple[tuple[str, Expression], ...]
    place: Place


@dataclass(frozen=True, slots=True)
class Sum:
    """A sum or difference: a first term, negated if ``minus`` is set, and each further term with its ``+`` or ``-``."""

    minus: bool
    first: Expression
    rest: tuple[tuple[str, Expression], ...]
    place: Place


Expression = Number | Reference | Power | Product | Sum


@dataclass(frozen=True, slots=True)
class Assignment:
    """The statement ``variable = expression``.  The value is converted to the type of the variable (p. 21)."""

    target: Reference
    value: Expression


@dataclass(frozen=True, slots=True)
class GoTo:
    """The statement ``GO TO n``, which branches to statement number n."""

    label: int


@dataclass(frozen=True, slots=True)
class ComputedGoTo:
    """The statement ``GO TO (n1, n2, ...), i``, which branches to the i-th statement number."""

    labels: tuple[int, ...]
    selector: Reference


@dataclass(frozen=True, slots=True)
class If:
    """The statement ``IF (expression) negative, zero, positive``, which branches by the sign of the expression."""

    value: Expression
    labels: tuple[int, int, int]


@dataclass(frozen=True, slots=True)
class IfSwitch:
    """The statement ``IF (SENSE SWITCH n) on, off`` (p. 56, item 7).  Switch 9 is on after the last card was read."""

    switch: int
    labels: tuple[int, int]


Jump = GoTo | ComputedGoTo | If | IfSwitch


@dataclass(frozen=True, slots=True)
class Do:
    """The statement ``DO label variable = first, last, step``. The test is at the bottom: a loop runs at least once."""

    label: int
    variable: Reference
    first: Expression
    last: Expression
    step: Expression | None


@dataclass(frozen=True, slots=True)
class Continue:
    """The statement ``CONTINUE``, which has no effect."""


@dataclass(frozen=True, slots=True)
class Pause:
    """The statement ``PAUSE``, with or without a number, which halts the machine until the operator presses START."""

    number: str


@dataclass(frozen=True, slots=True)
class Stop:
    """The statement ``STOP``, with or without a number, which ends the run."""

    number: str


@dataclass(frozen=True, slots=True)
class End:
    """The statement ``END``, the last card of a source deck."""


@dataclass(frozen=True, slots=True)
class Dimension:
    """The statement ``DIMENSION name(rows), name(rows, columns)``, which declares arrays (p. 18; p. 56, item 9)."""

    arrays: tuple[tuple[str, tuple[int, ...], Place], ...]


@dataclass(frozen=True, slots=True)
class Loop:
    """An indexed list in an input or output statement: ``(items, variable = first, last, step)``."""

    items: tuple[Item, ...]
    variable: Reference
    first: Expression
    last: Expression
    step: Expression | None


Item = Reference | Loop


@dataclass(frozen=True, slots=True)
class InputOutput:
    """An input or output statement: ``READ | ACCEPT | PUNCH | PRINT | TYPE  format, list`` (p. 32-43)."""

    verb: str
    format: int
    items: tuple[Item, ...]


@dataclass(frozen=True, slots=True)
class Format:
    """The statement ``FORMAT (specification)``.

    ``text`` is the specification as punched, with its blanks.  ``places`` has one place per character.
    """

    text: str
    places: tuple[Place, ...]


Body = Assignment | Jump | Do | Continue | Pause | Stop | End | Dimension | InputOutput | Format


@dataclass(frozen=True, slots=True)
class Statement:
    """A statement: its number (0 if it has none), its place, the text of its cards, and its content."""

    label: int
    place: Place
    text: str
    body: Body

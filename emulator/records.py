"""FORMAT at work: a list of numbers laid out on cards, or read from them.

Sources: C26-5619 p. 35-43.  n slashes at either end of a FORMAT give n blank records, n+1 between two fields
give n.  A list longer than the FORMAT takes it again from the start on a new record; a shorter one stops at
the first field it does not use, and what is written before that field stands.  On input H takes the card's
columns in place of its text, and X remembers the columns it skips, for the next use of the same FORMAT (p. 37,
41).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from emulator.cards import Card
from emulator.formats import Field, FormatSpec, Literal, Slash


class NoField(Exception):
    """The FORMAT has no field for a number of the list."""


@dataclass
class Layout:
    """A FORMAT as the object program holds it: its literals can be changed by reading."""

    spec: FormatSpec
    literals: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.literals = [s.text if isinstance(s, Literal) else "" for s in self.spec.specs]


@dataclass
class Output:
    """One output statement in progress; ``emit`` takes each finished record."""

    layout: Layout
    emit: Callable[[str], None]
    at: int = 0
    line: str = ""

    def next_field(self) -> Field:
        """Write literals and end records up to the next field, and return it.  Raises NoField."""
        while True:
            found = self._advance()
            if found is not None:
                self.at += 1
                return found
            if not self.layout.spec.has_fields:
                raise NoField
            self._end_record()
            self.at = 0

    def write(self, columns: str) -> None:
        self.line += columns

    def finish(self) -> None:
        self._advance()
        self._end_record()

    def _advance(self) -> Field | None:
        specs = self.layout.spec.specs
        while self.at < len(specs):
            spec = specs[self.at]
            if isinstance(spec, Field):
                return spec
            if isinstance(spec, Slash):
                self._end_record()
            else:
                self.line += self.layout.literals[self.at]
            self.at += 1
        return None

    def _end_record(self) -> None:
        self.emit(self.line)
        self.line = ""


@dataclass
class Input:
    """One input statement in progress; ``fetch`` delivers the next card."""

    layout: Layout
    fetch: Callable[[], Card]
    card: Card
    at: int = 0
    column: int = 1

    def next_field(self) -> tuple[Field, Card, int]:
        """The next field, with its card and first column.  Raises NoField."""
        while True:
            found = self._advance()
            if found is not None:
                card, column = self.card, self.column
                self.at += 1
                self.column += found.width
                return found, card, column
            if not self.layout.spec.has_fields:
                raise NoField
            self._next_card()
            self.at = 0

    def finish(self) -> None:
        self._advance()

    def _advance(self) -> Field | None:
        specs = self.layout.spec.specs
        while self.at < len(specs):
            spec = specs[self.at]
            if isinstance(spec, Field):
                return spec
            if isinstance(spec, Slash):
                self._next_card()
            else:
                width = len(spec.text)
                self.layout.literals[self.at] = self.card.columns(self.column, self.column + width - 1).ljust(width)
                self.column += width
            self.at += 1
        return None

    def _next_card(self) -> None:
        self.card = self.fetch()
        self.column = 1

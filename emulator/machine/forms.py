"""FORMAT at work: a list of numbers laid out on cards, or read from them.

Sources: C26-5619 p. 35-43.  n slashes at either end of a FORMAT give n blank records, n+1 between two fields
give n.  A list longer than the FORMAT takes it again from the start on a new record; a shorter one stops at
the first field it does not use, and what is written before that field stands.  On input H takes the card's
columns in place of its text, and X remembers the columns it skips, for the next use of the same FORMAT (p. 37,
41).
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, field

from emulator.language.cards import Card
from emulator.language.formats import FormatSpec, Literal, Slash
from emulator.numbers.fields import Field


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
class _Walk(ABC):
    """A FORMAT walked from field to field; what happens between fields is input's or output's own affair."""

    layout: Layout
    at: int = field(default=0, init=False)
    again: int = field(default=0, init=False)
    """How often the FORMAT was taken again, since somebody counted."""

    def _to_field(self) -> Field:
        """Go on to the next field and past it, taking the FORMAT again where it ends.  Raises NoField."""
        found = self._advance()
        while found is None:
            if not self.layout.spec.has_fields:
                raise NoField
            self._end_record()
            self.at = self.layout.spec.again
            self.again += 1
            found = self._advance()
        self.at += 1
        return found

    def finish(self) -> None:
        """The list has ended: go on to the first field it does not use."""
        self._advance()

    def _advance(self) -> Field | None:
        specs = self.layout.spec.specs
        while self.at < len(specs):
            spec = specs[self.at]
            if isinstance(spec, Field):
                return spec
            if isinstance(spec, Slash):
                self._end_record()
            else:
                self._literal(len(spec.text))
            self.at += 1
        return None

    @abstractmethod
    def _literal(self, width: int) -> None: ...

    @abstractmethod
    def _end_record(self) -> None: ...


@dataclass
class Output(_Walk):
    """One output statement in progress; ``emit`` takes each finished record."""

    emit: Callable[[str], None]
    width: int = 0
    _parts: list[str] = field(default_factory=list)

    def next_field(self) -> Field:
        """Write literals and end records up to the next field, and return it.  Raises NoField."""
        return self._to_field()

    def write(self, columns: str) -> None:
        self._parts.append(columns)
        self.width += len(columns)

    def finish(self) -> None:
        super().finish()
        self._end_record()

    def _literal(self, width: int) -> None:
        self.write(self.layout.literals[self.at])

    def _end_record(self) -> None:
        line = "".join(self._parts)
        self._parts.clear()
        self.width = 0
        self.emit(line)


@dataclass
class Input(_Walk):
    """One input statement in progress; ``fetch`` delivers the next card."""

    fetch: Callable[[], Card]
    card: Card
    column: int = 1

    def next_field(self) -> tuple[Field, Card, int]:
        """The next field, with its card and first column.  Raises NoField."""
        found = self._to_field()
        column = self.column
        self.column += found.width
        return found, self.card, column

    def _literal(self, width: int) -> None:
        self.layout.literals[self.at] = self.card.columns(self.column, self.column + width - 1).ljust(width)
        self.column += width

    def _end_record(self) -> None:
        self.card = self.fetch()
        self.column = 1

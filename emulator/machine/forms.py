"""Input and output by FORMAT: the layout of the numbers of a list on records (cards and typed lines).

The rules are those of C26-5619 p. 35-43.  At the beginning or end of a FORMAT, n slashes produce n blank records.
Between two fields, n+1 slashes produce n blank records.  If a list is longer than the FORMAT, the FORMAT is used again
on a new record.  If a list is shorter, the statement ends at the first unused field, and the text before this field is
still written.  On input an H field stores the card's columns as its new text, and an X field stores the columns that
it skips (p. 37, 41).  The next output statement with the same FORMAT writes the stored columns.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import takewhile

from emulator.language.cards import Card
from emulator.language.formats import FormatSpec, Literal, Slash
from emulator.machine.result import PUNCH_COLUMNS
from emulator.numbers.fields import Field


class NoField(Exception):
    """Raised if a list has a number left but its FORMAT has no field for numbers at all."""


class TooLong(Exception):
    """Raised if a record is longer than the columns of its device, for which IBM's library of 1962 types ERROR F9."""


@dataclass
class Layout:
    """The specifications of a FORMAT in core storage.  A READ or ACCEPT changes the texts of its H and X fields."""

    spec: FormatSpec
    literals: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.literals = [s.text if isinstance(s, Literal) else "" for s in self.spec.specs]

    def record_fields(self, first: int) -> list[tuple[str, int, int]]:
        """Return code, first column and width of the number fields from specification ``first`` to the next slash."""
        column, record = 1, []
        for spec in takewhile(lambda spec: not isinstance(spec, Slash), self.spec.specs[first:]):
            if isinstance(spec, Field):
                record.append((str(spec), column, spec.width))
            column += spec.width if isinstance(spec, Field) else len(spec.text) if isinstance(spec, Literal) else 0
        return record


@dataclass
class _Walk(ABC):
    """The progress of an input or output statement through its FORMAT."""

    layout: Layout
    at: int = field(default=0, init=False)
    # Repetitions of the FORMAT that :class:`emulator.machine.devices.Devices` has not counted yet.
    again: int = field(default=0, init=False)

    def _to_field(self) -> Field:
        """Return the next number field.

        At the end of the FORMAT, continue with its repetition.  Raise NoField if the FORMAT has no number field.
        """
        spec = self._advance()
        while spec is None:
            if not self.layout.spec.has_fields:
                raise NoField
            # The repetition starts a new record, at the last group in parentheses if there is one.
            self._end_record()
            self.at = self.layout.spec.again
            self.again += 1
            spec = self._advance()
        self.at += 1
        return spec

    def finish(self) -> None:
        """End the list: process text fields and slashes up to the first unused number field."""
        self._advance()

    def _advance(self) -> Field | None:
        """Process text fields and slashes, and return the next number field, or None at the end of the FORMAT."""
        specs = self.layout.spec.specs
        while self.at < len(specs):
            spec = specs[self.at]
            if isinstance(spec, Field):
                return spec
            self._pass_spec()
        return None

    def _pass_spec(self) -> None:
        spec = self.layout.spec.specs[self.at]
        if isinstance(spec, Literal):
            self._literal(len(spec.text))
        else:
            self._end_record()
        self.at += 1

    @abstractmethod
    def _literal(self, width: int) -> None: ...

    @abstractmethod
    def _end_record(self) -> None: ...


@dataclass
class Output(_Walk):
    """The execution of an output statement, field by field.  ``emit`` is a function that receives finished records."""

    emit: Callable[[str], None]
    width: int = 0
    _parts: list[str] = field(default_factory=list)

    def next_field(self) -> Field:
        """Write text and complete records up to the next number field.  Return this field, or raise NoField."""
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
    """The execution of an input statement, field by field.  ``fetch`` is a function that returns the next card."""

    fetch: Callable[[], Card]
    card: Card
    column: int = 1

    def next_field(self) -> tuple[Field, Card, int]:
        """Return the next number field, its card and its first column.  Raise NoField if the FORMAT has none."""
        spec = self._to_field()
        column = self.column
        self.column += spec.width
        return spec, self.card, column

    def _literal(self, width: int) -> None:
        # The columns of the card become the new text, padded with blanks beyond the end of the card.
        self.layout.literals[self.at] = self.card.columns(self.column, self.column + width - 1).ljust(width)
        self.column += width

    def _end_record(self) -> None:
        self.card = self.fetch()
        self.column = 1


@dataclass
class Output1962(Output):
    """The execution of an output statement as by IBM's library of 1962 (docs/reference/ibm-library.md).

    ``room`` is the number of columns of the device.  ``_blank`` is True while the record has received no columns.
    ``_after_error`` is True after the record of an error code, until columns are written.  ``_has_list`` is True after
    the first number.
    """

    room: int = field(kw_only=True)
    _blank: bool = True
    _after_error: bool = False
    _has_list: bool = False

    def next_field(self) -> Field:
        self._has_list = True
        spec = super().next_field()
        if self.width + spec.width > self.room:
            raise TooLong
        return spec

    def write(self, columns: str) -> None:
        if self.width + len(columns) > self.room:
            raise TooLong
        super().write(columns)
        self._blank = self._after_error = False

    def end_before(self, width: int, exponent: str) -> str:
        """End the record at a number that is in error, and return the columns that precede the error code.

        A blank record is not written.  The next record begins with blanks up to the end of the number's field.
        ``exponent`` is the text that the library has already stored at the end of a too narrow E field.  This text
        remains in a punched record, but a typed line ends before it.
        """
        column = self.width + width
        text = f"{''.join(self._parts):{column}}"
        text = text[: column - len(exponent)] + exponent if exponent else text.rstrip()
        if not self._blank:
            self._parts[:] = [text if self.room == PUNCH_COLUMNS else text[: self.width + 1]]
            super()._end_record()
            text = ""
        self._parts[:], self.width = [" " * column], column
        self._blank = self._after_error = True
        return text

    def finish(self) -> None:
        # At the end of the FORMAT the record is always written.  At an unused field it is written only if it has
        # received columns.
        unused = self._advance()
        if unused is None or (self._has_list and not self._blank):
            self._end_record()

    def _end_record(self) -> None:
        if self._after_error:
            self._parts.clear()
            self.width = 0
        else:
            super()._end_record()
        self._blank, self._after_error = True, False


@dataclass
class Input1962(Input):
    """The execution of an input statement that ends as in IBM's library of 1962.

    A slash just before an unused field then reads no record.  ``room`` is the number of columns of the device.
    """

    room: int = field(kw_only=True)
    _has_list: bool = False

    def next_field(self) -> tuple[Field, Card, int]:
        self._has_list = True
        spec, card, column = super().next_field()
        if self.column > self.room + 1:
            raise TooLong
        return spec, card, column

    def finish(self) -> None:
        # A slash after the last number reads a record only if no field follows the slash.
        specs = self.layout.spec.specs
        while self._has_list and self.at < len(specs) and not isinstance(specs[self.at], Field):
            is_last = isinstance(specs[self.at], Slash) and isinstance(specs[min(self.at + 1, len(specs) - 1)], Field)
            if is_last:
                return
            self._pass_spec()
        super().finish()

    def _literal(self, width: int) -> None:
        if self.column + width > self.room + 1:
            raise TooLong
        super()._literal(width)

"""The reader of FORMAT statements.  It works column by column, because Hollerith fields keep their blanks.

Sources: C26-5619 p. 35 to 43 (I, F, E, X, H, slash, repeat counts, records, the width of X and H, no comma after X) and
p. 56 (error types 10 to 12).  OPEN-QUESTIONS 5 treats groups in parentheses.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from emulator.errors import Diagnostic, Refused
from emulator.language.foreign import FOREIGN_FIELDS
from emulator.language.tree import Format, Place
from emulator.numbers.fields import Field, FieldKind
from emulator.numbers.work import STEPS

MAX_LITERAL = 49
MAX_RECORD = 87
_ENDS = {",": "comma", "/": "slash", ")": "parenthesis"}
_SWALLOWED = re.compile(r",\s*\d*$")
_TRIES = 3
_COLUMNS_A_UNIT = 40_000
_KINDS: dict[str, FieldKind] = {"E": "E", "F": "F", "I": "I"}


@dataclass(frozen=True, slots=True)
class Literal:
    """Text in a FORMAT: w characters for ``wH``, or w blanks for ``wX``.  ``skip`` is True for ``wX``."""

    text: str
    skip: bool = False


@dataclass(frozen=True, slots=True)
class Slash:
    """A slash in a FORMAT, which ends a card or a typed line (a record)."""


Spec = Literal | Field | Slash


@dataclass(frozen=True, slots=True)
class FormatSpec:
    """A FORMAT as a flat sequence of specifications, with repeat counts and groups expanded.

    If a list has more items than the FORMAT has fields, the FORMAT is used again from the specification with the index
    ``again``, as in IBM FORTRAN II-D.  ``again`` is the start of the last group that contains a field, in its first
    repetition, or 0 if there is no such group.
    """

    specs: tuple[Spec, ...]
    again: int = 0

    @property
    def has_fields(self) -> bool:
        return any(isinstance(spec, Field) for spec in self.specs)

    @property
    def charge(self) -> int:
        """The work of one pass through this FORMAT, in units that :mod:`emulator.numbers.work` defines.

        It is 0 unless the FORMAT is very long.
        """
        columns = sum(len(spec.text) for spec in self.specs if isinstance(spec, Literal))
        return len(self.specs) // STEPS + columns // _COLUMNS_A_UNIT

    @property
    def positions(self) -> int:
        """The approximate length of the FORMAT in core: two positions per character of text and six per field."""
        texts = (2 * len(s.text) + 4 for s in self.specs if isinstance(s, Literal) and not s.skip)
        return sum(texts) + 6 * sum(not isinstance(s, Literal) or s.skip for s in self.specs)

    def widths(self) -> Iterator[int]:
        """Yield the number of columns of each card or line that the FORMAT describes."""
        width = 0
        for spec in self.specs:
            if isinstance(spec, Slash):
                yield width
                width = 0
            else:
                width += len(spec.text) if isinstance(spec, Literal) else spec.width
        yield width


def _refused(place: Place, message: str) -> Refused:
    """Return an error of type 11, IBM's number for an invalid specification of a FORMAT (C26-5619 p. 56)."""
    return Refused(place, message, 11)


def parse_format(statement: Format) -> tuple[FormatSpec, tuple[Diagnostic, ...]]:
    """Parse a FORMAT statement.  Return its specification and warnings.

    Raise Refused if the FORMAT does not parse.  If it would parse with another width of the last Hollerith field, the
    message suggests that width.
    """
    reader = _Reader(statement)
    try:
        spec = reader.specification()
    except Refused as failure:
        raise _suggest_width(reader) or failure from None
    warnings = list(reader.warnings)
    widest = max(spec.widths())
    # Error type 12 is only a warning here, because the deck still runs (p. 56).
    if widest > MAX_RECORD:
        place = statement.places[0]
        lost = f"a card holds only the first 72, and a typed line the first {MAX_RECORD}"
        message = f"a record of this FORMAT has {widest} characters; {lost}"
        warnings.append(Diagnostic(place.card, place.column, message, 12, warning=True))
    return spec, tuple(warnings)


def _suggest_width(failed: _Reader) -> Refused | None:
    """Return an error that suggests another width for the last Hollerith field, or None if no width helps.

    A field that is too wide includes the delimiter after its text.  If a field is too narrow, the reader fails at the
    rest of its text.
    """
    if failed.hollerith is None:
        return None
    begun, start, width = failed.hollerith
    text, end = failed.text, start + width
    # Try the delimiters inside the field, the last one first.  If reading failed at the Hollerith field or right after
    # it, try delimiters after the field too.
    widths = [at - start for at in range(min(end, len(text)) - 1, start, -1) if text[at] in _ENDS]
    if failed.begun == begun or (failed.begun >= end and not text[end : failed.begun].strip()):
        widths[_TRIES:] = [at - start for at in range(end, len(text)) if text[at] in _ENDS]
    for fit in widths[: 2 * _TRIES]:
        try:
            _Reader(failed.statement, (start, fit)).specification()
        except Refused:
            continue
        fault = f"includes the {_ENDS[text[start + fit]]} after its text" if fit < width else "ends within its text"
        return _refused(failed.places[begun], f"{width}H {fault}; {fit}H would fit")
    return None


class _Reader:
    """A reader that passes once over the columns of a FORMAT.

    ``instead`` gives one Hollerith field another width: the index at which the field's text starts, and the new width.
    ``begun`` is the index at which the last specification began.  ``hollerith`` holds the index of the last Hollerith
    field, the index of its text, and its width.
    """

    MAX_FIELDS = 2000

    def __init__(self, statement: Format, instead: tuple[int, int] | None = None) -> None:
        self.statement, self.instead = statement, instead
        self.text, self.places = statement.text, statement.places
        self.begun = 0
        self.hollerith: tuple[int, int, int] | None = None
        self.at = 0
        self.count = 0
        self.again = 0
        self.warnings: list[Diagnostic] = []

    def place(self) -> Place:
        return self.places[min(self.at, len(self.places) - 1)]

    def peek(self) -> str:
        while self.at < len(self.text) and self.text[self.at] == " ":
            self.at += 1
        return self.text[self.at] if self.at < len(self.text) else ""

    def specification(self) -> FormatSpec:
        """Read the whole FORMAT, from its opening parenthesis to its closing one."""
        if self.peek() != "(":
            raise _refused(self.place(), "expected a parenthesis at the beginning of the FORMAT's specification")
        specs = self.group()
        if self.peek():
            raise _refused(
                self.place(), f"expected nothing after the FORMAT's closing parenthesis, found {self.peek()!r}"
            )
        return FormatSpec(tuple(specs), self.again)

    def number(self) -> str:
        digits = ""
        while self.peek().isdigit():
            digits += self.text[self.at]
            self.at += 1
        if len(digits) > 4:
            raise _refused(self.place(), f"the number {digits} in a FORMAT is too large")
        return digits

    def group(self, depth: int = 0) -> list[Spec]:
        """Read the specifications of a parenthesised group, up to its closing parenthesis."""
        if depth > 2:
            raise _refused(self.place(), "groups in a FORMAT may be nested at most two deep, found three")
        self.at += 1
        specs: list[Spec] = []
        need_comma = False
        while True:
            char = self.peek()
            if char == "":
                raise _refused(self.place(), "expected a closing parenthesis at the end of the FORMAT")
            if char == ")":
                self.at += 1
                return specs
            if char in "/,":
                # A slash separates fields as a comma does, and an extra comma is accepted.
                self.at += 1
                if char == "/":
                    specs.append(Slash())
                need_comma = False
                continue
            if need_comma:
                raise _refused(self.place(), f"a comma is missing before {char!r}")
            begun = self.at
            new, need_comma = self.one(depth)
            # A list longer than the FORMAT continues at the last group of the outermost level that has a field.
            if depth == 0 and self.text[begun : self.at].lstrip("0123456789 ").startswith("("):
                self.again = len(specs) if any(isinstance(spec, Field) for spec in new) else self.again
            specs.extend(new)
            self.count += len(new)
            if self.count > self.MAX_FIELDS:
                raise _refused(self.place(), f"a FORMAT has more than {self.MAX_FIELDS} fields")

    def one(self, depth: int) -> tuple[list[Spec], bool]:
        """Read one specification with its repeat count.  Return its fields, and True if a comma must follow."""
        self.peek()
        self.begun, start = self.at, self.place()
        count = self.number()
        letter = self.peek()
        if letter == "(":
            specs, times = self.group(depth + 1), self.repeat(count, start)
            if len(specs) * times > self.MAX_FIELDS:
                raise _refused(self.place(), f"a FORMAT has more than {self.MAX_FIELDS} fields")
            return specs * times, False
        # X and H take their width before the letter, so they cannot have a repeat count (p. 41, 42).
        if letter in ("X", "H"):
            if not count:
                raise _refused(start, f"{letter} needs a width before it")
            return [self.literal(letter, int(count), start)], False
        if letter in FOREIGN_FIELDS:
            raise Refused(self.place(), FOREIGN_FIELDS[letter], 11, about=f"{letter} field")
        if letter not in ("I", "E", "F"):
            raise _refused(
                self.place(), f"{letter or 'the end'!r} is not a specification; the codes are I, E, F, X, H and /"
            )
        self.at += 1
        width = self.number()
        if not width or int(width) == 0:
            raise _refused(self.place(), f"{letter} needs a width after it")
        decimals = ""
        if letter in ("E", "F"):
            if self.peek() != ".":
                message = f"{letter}{width} lacks a decimal point and a number of decimals, as in {letter}{width}.4"
                raise _refused(self.place(), message)
            self.at += 1
            # A blank between the point and the decimals is error type 11 (p. 56).
            if self.text[self.at : self.at + 1] == " ":
                raise _refused(self.place(), f"expected a number of decimals after {letter}{width}., found a blank")
            decimals = self.number()
            if not decimals:
                raise _refused(self.place(), f"{letter}{width}. needs a number of decimals after the point")
        # No record is longer than a line of the typewriter (p. 43).
        if int(width) > MAX_RECORD:
            raise _refused(start, f"a field has at most {MAX_RECORD} columns, found {width}")
        return [Field(_KINDS[letter], int(width), int(decimals or 0))] * self.repeat(count, start), True

    def repeat(self, count: str, start: Place) -> int:
        if count and int(count) == 0:
            raise _refused(start, "a repeat count must be at least 1, found 0")
        return int(count or 1)

    def literal(self, letter: str, width: int, start: Place) -> Literal:
        begun, self.at = self.begun, self.at + 1
        if width == 0:
            raise _refused(start, f"the width before {letter} must be at least 1, found 0")
        if width > MAX_LITERAL:
            message = f"{width}{letter}: the width of X and H is at most {MAX_LITERAL}; use two in a row"
            self.warnings.append(Diagnostic(start.card, start.column, message, 11, warning=True))
        if letter == "X":
            return Literal(" " * width, skip=True)
        # _suggest_width tries another width for the Hollerith field at this place.
        if self.instead and self.instead[0] == self.at:
            width = self.instead[1]
        self.hollerith = begun, self.at, width
        text = self.text[self.at : self.at + width]
        if len(text) < width:
            raise _refused(start, f"{width}H runs past the end of the card")
        self.at += width
        # A text that ends with a comma, and a specification right after it, suggest that w was counted too large.
        swallowed = _SWALLOWED.search(text)
        if swallowed and swallowed.start() and self.peek() and self.peek() not in _ENDS:
            instead = f"write {swallowed.start()}H if the comma is a separator"
            message = f"{width}H includes a comma, and no comma follows it; {instead}"
            self.warnings.append(Diagnostic(start.card, start.column, message, 11, warning=True))
        return Literal(text)

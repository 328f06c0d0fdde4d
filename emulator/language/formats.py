"""FORMAT statements: the specification, read column by column so that Hollerith fields keep their blanks.

Sources: C26-5619 p. 35 to 43 (I, F, E, X, H, slash, repeat counts; no comma needed after X; widths of X and H;
records), p. 56 (error types 10 to 12).  Parenthesised groups: OPEN-QUESTIONS 5.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from emulator.errors import Diagnostic, Refused
from emulator.language.foreign import FIELDS
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
    """``wH`` text, or ``wX`` (blanks; ``skip`` set): what stands on the card without a number."""

    text: str
    skip: bool = False


@dataclass(frozen=True, slots=True)
class Slash:
    """``/``: the record ends here."""


Spec = Literal | Field | Slash


@dataclass(frozen=True, slots=True)
class FormatSpec:
    """A FORMAT as a flat sequence, repeat counts and groups written out.

    ``again`` is where a list that is longer goes on: with the last group that holds a field, its repeat count included,
    or with the first specification (IBM FORTRAN II-D, executed).
    """

    specs: tuple[Spec, ...]
    again: int = 0

    @property
    def has_fields(self) -> bool:
        return any(isinstance(spec, Field) for spec in self.specs)

    @property
    def charge(self) -> int:
        """What going through it once counts as against the limit: nothing but where it is very long."""
        columns = sum(len(spec.text) for spec in self.specs if isinstance(spec, Literal))
        return len(self.specs) // STEPS + columns // _COLUMNS_A_UNIT

    @property
    def positions(self) -> int:
        """What it takes of core, about: two positions a character of text, six a field."""
        texts = (2 * len(s.text) + 4 for s in self.specs if isinstance(s, Literal) and not s.skip)
        return sum(texts) + 6 * sum(not isinstance(s, Literal) or s.skip for s in self.specs)

    def widths(self) -> Iterator[int]:
        """The width of each record the specification describes, in columns."""
        width = 0
        for spec in self.specs:
            if isinstance(spec, Slash):
                yield width
                width = 0
            else:
                width += len(spec.text) if isinstance(spec, Literal) else spec.width
        yield width


def _refused(place: Place, message: str, number: int = 11) -> Refused:
    """A specification that does not parse is error type 11, where nothing else is said (C26-5619 p. 56)."""
    return Refused(place, message, number)


def parse_format(statement: Format) -> tuple[FormatSpec, tuple[Diagnostic, ...]]:
    """The specification of a FORMAT statement and the compiler's warnings.  Raises Refused.

    Where a FORMAT does not parse, and would with another width of the last Hollerith field read, that width is named.
    """
    reader = _Reader(statement)
    try:
        spec = reader.specification()
    except Refused as refused:
        raise _miscounted(reader) or refused from None
    warnings = list(reader.warnings)
    widest = max(spec.widths())
    if widest > MAX_RECORD:
        place = statement.places[0]
        message = f"a record of {widest} characters; beyond {MAX_RECORD} typed or 72 punched they are lost"
        warnings.append(Diagnostic(place.card, place.column, message, 12, warning=True))
    return spec, tuple(warnings)


def _miscounted(failed: _Reader) -> Refused | None:
    """What is wrong with the width of the last Hollerith field, if there is a width with which the FORMAT parses.

    Too wide, the field took in what ends its text; too narrow, it left some of its text, where the reading failed.
    """
    if failed.hollerith is None:
        return None
    begun, start, width = failed.hollerith
    text, end = failed.text, start + width
    widths = [at - start for at in range(min(end, len(text)) - 1, start, -1) if text[at] in _ENDS]
    if failed.begun == begun or (failed.begun >= end and not text[end : failed.begun].strip()):
        widths[_TRIES:] = [at - start for at in range(end, len(text)) if text[at] in _ENDS]
    for fit in widths[: 2 * _TRIES]:
        try:
            _Reader(failed.statement, (start, fit)).specification()
        except Refused:
            continue
        what = f"takes in the {_ENDS[text[start + fit]]} after its text" if fit < width else "ends within its text"
        return _refused(failed.places[begun], f"{width}H {what}; {fit}H would fit")
    return None


class _Reader:
    """One pass over the columns; ``group`` calls itself for a parenthesised group.

    ``instead``: where the text of a Hollerith field starts, and the width to give it.  ``begun`` is where the last
    specification began; ``hollerith`` where the last Hollerith field and its text began, and its width.
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
        """The whole FORMAT, from its parenthesis on."""
        if self.peek() != "(":
            raise _refused(self.place(), "a FORMAT's specification begins with a parenthesis")
        specs = self.group()
        if self.peek():
            raise _refused(self.place(), f"{self.peek()!r} after the end of the FORMAT")
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
        """What stands between the parenthesis that comes next and the one that closes it."""
        if depth > 2:
            raise _refused(self.place(), "groups are nested too deep in a FORMAT")
        self.at += 1
        specs: list[Spec] = []
        need_comma = False
        while True:
            char = self.peek()
            if char == "":
                raise _refused(self.place(), "the FORMAT does not end with a parenthesis")
            if char == ")":
                self.at += 1
                return specs
            if char in "/,":
                self.at += 1
                if char == "/":
                    specs.append(Slash())
                need_comma = False
                continue
            if need_comma:
                raise _refused(self.place(), f"a comma is missing before {char!r}")
            grouped = self.at
            new, need_comma = self.one(depth)
            if depth == 0 and self.text[grouped : self.at].lstrip("0123456789 ").startswith("("):
                self.again = len(specs) if any(isinstance(spec, Field) for spec in new) else self.again
            specs.extend(new)
            self.count += len(new)
            if self.count > self.MAX_FIELDS:
                raise _refused(self.place(), f"a FORMAT of more than {self.MAX_FIELDS} fields")

    def one(self, depth: int) -> tuple[list[Spec], bool]:
        """One specification with its repeat count; also whether a comma must follow it."""
        self.peek()
        self.begun, start = self.at, self.place()
        count = self.number()
        letter = self.peek()
        if letter == "(":
            specs, times = self.group(depth + 1), self.repeat(count, start)
            if len(specs) * times > self.MAX_FIELDS:
                raise _refused(self.place(), f"a FORMAT of more than {self.MAX_FIELDS} fields")
            return specs * times, False
        if letter in ("X", "H"):
            if not count:
                raise _refused(start, f"{letter} needs its width before it")
            return [self.literal(letter, int(count), start)], False
        if letter in FIELDS:
            raise Refused(self.place(), FIELDS[letter], 11, about=f"{letter} field")
        if letter not in ("I", "E", "F"):
            raise _refused(
                self.place(), f"{letter or 'the end'!r} is not a specification; there are I, E, F, X, H and /"
            )
        self.at += 1
        width = self.number()
        if not width or int(width) == 0:
            raise _refused(self.place(), f"{letter} needs a width")
        decimals = ""
        if letter in ("E", "F"):
            if self.peek() != ".":
                raise _refused(self.place(), f"{letter}{width} lacks its point and decimals")
            self.at += 1
            if self.text[self.at : self.at + 1] == " ":
                raise _refused(self.place(), f"a blank after the point of {letter}{width}.")
            decimals = self.number()
            if not decimals:
                raise _refused(self.place(), f"{letter}{width}. lacks its decimals")
        if int(width) > MAX_RECORD:
            raise _refused(start, f"a field of {width} columns")
        return [Field(_KINDS[letter], int(width), int(decimals or 0))] * self.repeat(count, start), True

    def repeat(self, count: str, start: Place) -> int:
        if count and int(count) == 0:
            raise _refused(start, "a repeat count of zero")
        return int(count or 1)

    def literal(self, letter: str, width: int, start: Place) -> Literal:
        begun, self.at = self.begun, self.at + 1
        if width == 0:
            raise _refused(start, f"0{letter} has no width")
        if width > MAX_LITERAL:
            message = f"{width}{letter}: the width of X and H is at most {MAX_LITERAL}; use two in a row"
            self.warnings.append(Diagnostic(start.card, start.column, message, 11, warning=True))
        if letter == "X":
            return Literal(" " * width, skip=True)
        if self.instead and self.instead[0] == self.at:
            width = self.instead[1]
        self.hollerith = begun, self.at, width
        text = self.text[self.at : self.at + width]
        if len(text) < width:
            raise _refused(start, f"{width}H runs past the end of the card")
        self.at += width
        swallowed = _SWALLOWED.search(text)
        if swallowed and swallowed.start() and self.peek() and self.peek() not in _ENDS:
            message = f"{width}H takes in a comma, and none follows; {swallowed.start()}H if it is not of the text"
            self.warnings.append(Diagnostic(start.card, start.column, message, 11, warning=True))
        return Literal(text)

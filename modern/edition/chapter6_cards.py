"""The printed examples of chapter 6 as cards, with the printed line from which each number or word comes.

A device file is the corrected text of an example (:mod:`modern.edition.apparatus`) set into the columns of
``layout.toml``.  The text supplies all nonblank characters and their order.  The layout supplies the columns and blank
cards.  The output of our own runs is not used.
"""

import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from emulator.files import write_text
from modern.edition.apparatus import Line, Text, build, built_without, load
from modern.edition.chapter6 import CardShape, Device, DeviceLayout, Field, Layout, Role, chapter6_folder, load_layout

E14 = re.compile(r"[+-]?\.\d{8}E[+-]\d\d")
_INTEGER = re.compile(r"\d+")
_BLANK = " \t"


class TranscriptError(ValueError):
    """Raised if the corrected text does not fit the layout.  The message names the file, card, line and columns."""


@dataclass(frozen=True, slots=True)
class Token:
    """A printed number or word on a card: its text, its first and last column, and the id of its printed line.

    Columns are counted from 1.
    """

    text: str
    first: int
    last: int
    line: str


@dataclass(frozen=True, slots=True)
class Card:
    """A card of a device file, or a typed line, which has no tokens.

    ``number`` counts the cards of the file, including blank cards, from 1.  ``image`` is the text of the card without
    trailing blanks, and ``shape`` is the id of its :class:`~modern.edition.chapter6.CardShape`.
    """

    example: int
    program: int
    device: Device
    number: int
    shape: str
    role: Role
    image: str
    tokens: tuple[Token, ...]


@dataclass(frozen=True, slots=True)
class Chapter:
    """Chapter 6: the text with its apparatus, the corrected text (``print``) built from it, and the layout.

    ``without`` has the ids of the rows that were not applied.
    """

    text: Text
    print: tuple[Line, ...]
    layout: Layout
    without: frozenset[str]


@cache
def load_chapter() -> Chapter:
    """Return chapter 6 with all rows of its apparatus."""
    folder = chapter6_folder()
    return rebuilt(load(folder, "chapter6"), load_layout(folder))


def rebuilt(text: Text, layout: Layout, without: Collection[str] = ()) -> Chapter:
    """Return chapter 6 built from a text and a layout, without the rows whose ids are in ``without``."""
    return Chapter(text, build(text, None, without), layout, frozenset(without))


def without_row(chapter: Chapter, row_id: str) -> Chapter:
    """Return the chapter without a row and without the rows that depend on this row."""
    gone, lines = built_without(chapter.text, row_id)
    return Chapter(chapter.text, lines, chapter.layout, gone)


def device_files(chapter: Chapter) -> tuple[tuple[int, int, Device, str], ...]:
    """Return (example, program, device, file name) of every device file in the order of the chapter."""
    return tuple((d.example, d.program, d.device, d.file) for d in chapter.layout.devices)


def device_layout(chapter: Chapter, example: int, program: int, device: Device) -> DeviceLayout:
    for entry in chapter.layout.devices:
        if (entry.example, entry.program, entry.device) == (example, program, device):
            return entry
    raise TranscriptError(f"chapter 6 has no {device} for example {example}, program {program}")


def printed_lines(chapter: Chapter, entry: DeviceLayout) -> tuple[Line, ...]:
    """Return the lines of the corrected text that a device file consists of.  A file of typed lines has none."""
    if entry.span is None:
        return ()
    ids = [line.id for line in chapter.print]
    for end in entry.span:
        if end not in ids:
            raise TranscriptError(f"{entry.file}: the corrected print has no line {end}")
    return chapter.print[ids.index(entry.span[0]) : ids.index(entry.span[1]) + 1]


def cards(chapter: Chapter, example: int, program: int, device: Device) -> tuple[Card, ...]:
    """Return the cards or typed lines of a device file. Raise TranscriptError if the corrected text does not fit."""
    entry = device_layout(chapter, example, program, device)
    if entry.layer == "stated":
        return tuple(Card(example, program, device, i, "", "", t, ()) for i, t in enumerate(entry.typed, start=1))
    lines = printed_lines(chapter, entry)
    reader = _Reader(entry.file, lines)
    result = []
    for number, (shape, role) in enumerate(entry.cards, start=1):
        tokens = tuple(reader.take(field, number, shape) for field in shape.fields)
        result.append(Card(example, program, device, number, shape.id, role, _image(tokens), tokens))
    reader.finish()
    return tuple(result)


def card_images(chapter: Chapter, example: int, program: int, device: Device) -> tuple[str, ...]:
    """Return the card images of one device file without trailing blanks; a blank card is an empty string."""
    return tuple(card.image for card in cards(chapter, example, program, device))


def built_files(chapter: Chapter) -> Iterator[tuple[str, str]]:
    """Yield (file name, contents) of every device file, one card on each line."""
    for example, program, device, name in device_files(chapter):
        images = card_images(chapter, example, program, device)
        yield name, "".join(image + "\n" for image in images)


def write_files(chapter: Chapter, folder: Path) -> tuple[str, ...]:
    """Write the device files to ``folder`` and return their names.  If one cannot be built, none is written."""
    built = tuple(built_files(chapter))
    for name, contents in built:
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        write_text(str(path), contents)
    return tuple(name for name, _ in built)


class _Reader:
    """A reader that takes the contents of fields, one after another, from printed lines.  It ignores blanks."""

    def __init__(self, name: str, lines: Sequence[Line]) -> None:
        self._name = name
        self._lines = lines
        self._line = 0
        self._at = 0

    def take(self, field: Field, number: int, shape: CardShape) -> Token:
        place = f"{self._name}: card {number} ({shape.id}), columns {field.first} to {field.last}"
        if not self._seek():
            raise TranscriptError(f"{place}: the printed lines end before this field")
        line = self._lines[self._line]
        token = self._word(field.width) if field.word else self._number(field.width)
        if token is None:
            expected = f"{field.width} characters of words" if field.word else f"a number of {field.width} columns"
            rest = line.text[self._at :].strip()
            raise TranscriptError(f"{place}: line {line.id}: expected {expected}, found {rest!r}")
        if len(token) > field.width:
            raise TranscriptError(f"{place}: line {line.id}: {token} is wider than its field")
        first = field.first if field.word else field.last - len(token) + 1
        return Token(token, first, first + len(token) - 1, line.id)

    def finish(self) -> None:
        if self._seek():
            line = self._lines[self._line]
            rest = line.text[self._at :].strip()
            raise TranscriptError(f"{self._name}: line {line.id}: {rest!r} remains after the last field")

    def _seek(self) -> bool:
        while self._line < len(self._lines):
            text = self._lines[self._line].text
            while self._at < len(text) and text[self._at] in _BLANK:
                self._at += 1
            if self._at < len(text):
                return True
            self._line, self._at = self._line + 1, 0
        return False

    def _number(self, width: int) -> str | None:
        pattern = E14 if width == 14 else _INTEGER
        match = pattern.match(self._lines[self._line].text, self._at)
        if not match:
            return None
        self._at = match.end()
        return match[0]

    def _word(self, width: int) -> str | None:
        text, at, taken = self._lines[self._line].text, self._at, ""
        while len(taken) < width and at < len(text):
            taken += text[at] if text[at] not in _BLANK else ""
            at += 1
        if len(taken) < width:
            return None
        self._at = at
        return taken


def _image(tokens: Sequence[Token]) -> str:
    image = ""
    for token in tokens:
        image = image.ljust(token.first - 1) + token.text
    return image

"""The printed examples of chapter 6 as card images, each character tied to the page.

A device file (an input deck, the cards a program punches, the lines it types) is the corrected print
(witness + apparatus, :mod:`modern.edition.apparatus`) set into the columns of ``layout.toml``.  The print
gives every non-blank character and their order; the layout gives only blanks and blank cards.  Typewriter
lines are of the layer ``stated``: chapter 6 prints none.

``python -m modern.edition --write`` writes the device files from witness, apparatus and layout; nothing here
reads a run.  ``python -m modern.edition --check`` runs every check of :mod:`modern.edition.chapter6_checks`.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from emulator.files import write_text
from modern.edition.apparatus import Line, Text, build, built_without, load
from modern.edition.chapter6 import CardShape, Device, DeviceLayout, Field, Layout, Role, chapter6_folder, load_layout

E14 = re.compile(r"[+-]?\.\d{8}E[+-]\d\d")
_INTEGER = re.compile(r"\d+")
_BLANK = " \t"


class TranscriptError(ValueError):
    """The corrected print does not fit its cards; one line naming device file, card, line and columns."""


@dataclass(frozen=True, slots=True)
class Token:
    """A printed number or word on a card: its text, its columns (from 1, inclusive) and its printed line."""

    text: str
    first: int
    last: int
    line: str


@dataclass(frozen=True, slots=True)
class Card:
    """A card of a device file; ``number`` counts from 1 with blank cards, ``image`` has no trailing blanks.

    A typed line has no tokens: nothing of it is printed.
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
    """Chapter 6: the text with its apparatus, the corrected print built from it, and the layout."""

    text: Text
    print: tuple[Line, ...]
    layout: Layout
    layers: tuple[str, ...]
    without: frozenset[str]
    places: Mapping[str, int] = field(default_factory=dict, compare=False)
    """Each line's place in the print."""
    read: dict[tuple[str, ...], tuple[Card, ...]] = field(default_factory=dict, compare=False)
    """Cards already read, by device file and lines; a chapter and what is made of it share them."""
    last: dict[str, Chapter] = field(default_factory=dict, compare=False)
    """The chapter without a row, for the row asked for last: more than one check of a row asks for it."""


def load_chapter(layers: Iterable[str] | None = None, without: Collection[str] = ()) -> Chapter:
    """Chapter 6 with the rows of ``layers`` (default: all), leaving out the rows ``without``.

    Raises ApparatusError where rows do not fit, LayoutError for a layout that cannot be read.
    """
    folder = chapter6_folder()
    return rebuilt(load(folder, "chapter6"), load_layout(folder), layers, without)


def rebuilt(text: Text, layout: Layout, layers: Iterable[str] | None = None, without: Collection[str] = ()) -> Chapter:
    """A chapter from a text and a layout already read; used to see what the print is without some rows."""
    wanted = tuple(text.default if layers is None else layers)
    return _chapter(text, build(text, wanted, without), layout, wanted, frozenset(without), {})


def without_row(chapter: Chapter, row_id: str) -> Chapter:
    """The chapter without a row and those that cannot stand without it, in all layers."""
    if row_id not in chapter.last:
        gone, lines = built_without(chapter.text, row_id)
        chapter.last.clear()
        chapter.last[row_id] = _chapter(chapter.text, lines, chapter.layout, chapter.text.layers, gone, chapter.read)
    return chapter.last[row_id]


def _chapter(
    text: Text,
    lines: tuple[Line, ...],
    layout: Layout,
    layers: tuple[str, ...],
    without: frozenset[str],
    read: dict[tuple[str, ...], tuple[Card, ...]],
) -> Chapter:
    return Chapter(text, lines, layout, layers, without, {line.id: i for i, line in enumerate(lines)}, read)


def device_files(chapter: Chapter | None = None) -> tuple[tuple[int, int, Device, str], ...]:
    """(example, program, device, file name) of every device file, in the order of the chapter."""
    layout = chapter.layout if chapter else load_layout(chapter6_folder())
    return tuple((d.example, d.program, d.device, d.file) for d in layout.devices)


def device_layout(chapter: Chapter, example: int, program: int, device: Device) -> DeviceLayout:
    for entry in chapter.layout.devices:
        if (entry.example, entry.program, entry.device) == (example, program, device):
            return entry
    raise TranscriptError(f"chapter 6 has no {device} for example {example}, program {program}")


def printed_lines(chapter: Chapter, entry: DeviceLayout) -> tuple[Line, ...]:
    """The lines of the corrected print a device file covers; none for a typewriter."""
    if entry.span is None:
        return ()
    places = chapter.places
    for end in entry.span:
        if end not in places:
            raise TranscriptError(f"{entry.file}: there is no line {end} in the corrected print")
    return chapter.print[places[entry.span[0]] : places[entry.span[1]] + 1]


def cards(chapter: Chapter, example: int, program: int, device: Device) -> tuple[Card, ...]:
    """The cards (or typed lines) of one device file, in order.

    Raises TranscriptError when the printed numbers and words do not fill the fields of the cards exactly.
    """
    entry = device_layout(chapter, example, program, device)
    if entry.layer == "stated":
        return tuple(Card(example, program, device, i, "", "", t, ()) for i, t in enumerate(entry.typed, start=1))
    lines = printed_lines(chapter, entry)
    key = (entry.file, *(text for line in lines for text in (line.id, line.text)))
    if key in chapter.read:
        return chapter.read[key]
    reader = _Reader(entry.file, lines)
    result = []
    for number, (shape, role) in enumerate(entry.cards, start=1):
        tokens = tuple(reader.take(field, number, shape) for field in shape.fields)
        result.append(Card(example, program, device, number, shape.id, role, _image(tokens), tokens))
    reader.finish()
    chapter.read[key] = tuple(result)
    return chapter.read[key]


def card_images(chapter: Chapter, example: int, program: int, device: Device) -> tuple[str, ...]:
    """The card images of one device file, without trailing blanks; a blank card is an empty string."""
    return tuple(card.image for card in cards(chapter, example, program, device))


def built_files(chapter: Chapter) -> Iterator[tuple[str, str]]:
    """(file name, contents) of every device file: one card a line, each line ended."""
    for example, program, device, name in device_files(chapter):
        images = card_images(chapter, example, program, device)
        yield name, "".join(image + "\n" for image in images)


def write_files(chapter: Chapter, folder: Path) -> tuple[str, ...]:
    """Write the device files under ``folder`` and return their names.

    Everything is built before anything is written, so that an error leaves the folder as it was.
    """
    built = tuple(built_files(chapter))
    for name, contents in built:
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        write_text(str(path), contents)
    return tuple(name for name, _ in built)


class _Reader:
    """Takes the fields of cards one after the other from printed lines whose spacing means nothing."""

    def __init__(self, name: str, lines: Sequence[Line]) -> None:
        self._name = name
        self._lines = lines
        self._line = 0
        self._at = 0

    def take(self, field: Field, number: int, shape: CardShape) -> Token:
        place = f"{self._name}: card {number} ({shape.id}), columns {field.first} to {field.last}"
        if not self._seek():
            raise TranscriptError(f"{place}: the printed lines end before it")
        line = self._lines[self._line]
        found = self._word(field.width) if field.word else self._number(field.width)
        if found is None:
            wanted = f"{field.width} characters of words" if field.word else f"a number of {field.width} columns"
            rest = line.text[self._at :].strip()
            raise TranscriptError(f"{place}: line {line.id} should have {wanted}, it has {rest!r}")
        if len(found) > field.width:
            raise TranscriptError(f"{place}: line {line.id}: {found} is wider than its field")
        first = field.first if field.word else field.last - len(found) + 1
        return Token(found, first, first + len(found) - 1, line.id)

    def finish(self) -> None:
        if self._seek():
            line = self._lines[self._line]
            raise TranscriptError(f"{self._name}: line {line.id}: {line.text[self._at :].strip()!r} is left over")

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
        found = pattern.match(self._lines[self._line].text, self._at)
        if not found:
            return None
        self._at = found.end()
        return found[0]

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

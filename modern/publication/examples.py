"""A printed example as data: witness, corrected print and run side by side, card by card.

The corrected print and its tie to the lines of the witness come from :mod:`modern.edition.chapter6_cards`, what the
programs give from :mod:`modern.edition.reproduce`, which judges it.  Nothing here knows how it is shown.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher
from functools import cache

from modern.edition.apparatus import Row
from modern.edition.chapter6 import EXAMPLES, Device, DeviceLayout
from modern.edition.chapter6_cards import Card, Chapter, cards, load_chapter, printed_lines
from modern.edition.reproduce import Report, reproduce
from modern.edition.segments import Place, Segments, reading, segments
from modern.edition.sources import sources

_ALL = ("ocr", "typist")
Spans = tuple[tuple[int, int], ...]
TITLES = {"deck": "cards read", "punch": "cards punched", "typewriter": "lines typed"}


@dataclass(frozen=True, slots=True)
class Source:
    """A line of the witness: its number, the line of the document's text, its words, and where rows change them."""

    line: str
    page: str
    at: int
    text: str
    changed: Spans


@dataclass(frozen=True, slots=True)
class Shown:
    """A card: ``print`` as corrected, ``run`` what came out (None where nothing is to come out, as of an input deck).

    ``sources`` are the lines of the witness whose first words are on this card, ``again`` further lines that cards
    before it have begun.  ``differs`` are columns of ``run`` that are not those of the print.
    """

    number: int
    print: str
    sources: tuple[Source, ...]
    again: tuple[str, ...]
    run: str | None
    differs: Spans


@dataclass(frozen=True, slots=True)
class Part:
    """A device of an example: its cards, the verdict on each state of program 1 that was run, and the rows in it."""

    example: int
    program: int
    device: Device
    file: str
    stated: bool
    cards: tuple[Shown, ...]
    reports: tuple[Report, ...]
    rows: tuple[Row, ...]

    @property
    def id(self) -> str:
        """Its address: ``program1-punch``."""
        return f"program{self.program}-{self.device}"


@cache
def example(number: int) -> tuple[Part, ...]:
    """Every device of an example of chapter 6, in the order of the print."""
    chapter = load_chapter()
    reports = tuple(reproduce((number,)))
    lines = _origins(segments(chapter.text))
    return tuple(_part(chapter, entry, lines, reports) for entry in chapter.layout.devices if entry.example == number)


@cache
def homes() -> dict[str, tuple[int, str]]:
    """Each row that an example shows, and the first example and device that do: a row may touch two."""
    found: dict[str, tuple[int, str]] = {}
    for number in EXAMPLES:
        for part in example(number):
            for row in part.rows:
                found.setdefault(row.id, (number, part.id))
    return found


def rest() -> tuple[Row, ...]:
    """Rows of chapter 6 that touch no card: what they drop stands between the cards, as a page's number does."""
    return tuple(row for row in load_chapter().text.rows if row.id not in homes())


def _origins(lines: Sequence[Segments]) -> dict[str, list[Segments]]:
    """Each line of the corrected print with the line of the witness it is of, and the lines that rows made of that."""
    found: dict[str, list[Segments]] = {}
    family: list[Segments] = []
    for line in lines:
        family = [*family, line] if line.inserted else [line]
        for one in family:
            found[one.id] = family
    return found


def _part(chapter: Chapter, entry: DeviceLayout, lines: dict[str, list[Segments]], reports: Sequence[Report]) -> Part:
    mine = tuple(r for r in reports if (r.program, r.device) == (entry.program, entry.device))
    produced = next((r.produced for r in mine if r.state == "examples"), None)
    found: list[Shown] = []
    seen: set[str] = set()
    made = cards(chapter, entry.example, entry.program, entry.device)
    longest = max(len(made), len(produced or ()))
    for n in range(longest):
        card = made[n] if n < len(made) else None
        run = None if produced is None else produced[n] if n < len(produced) else ""
        found.append(_shown(n + 1, card, run, lines, seen))
    touched = {row for line in printed_lines(chapter, entry) for row in line.rows}
    rows = tuple(row for row in chapter.text.rows if row.id in touched)
    return Part(
        entry.example, entry.program, entry.device, entry.file, entry.layer == "stated", tuple(found), mine, rows
    )


def _shown(number: int, card: Card | None, run: str | None, lines: dict[str, list[Segments]], seen: set[str]) -> Shown:
    named = tuple(dict.fromkeys(lines[token.line][0].id for token in card.tokens)) if card else ()
    new = tuple(name for name in named if name not in seen)
    seen |= set(new)
    image = card.image if card else ""
    return Shown(
        number,
        image,
        tuple(_source(lines[name]) for name in new),
        tuple(name for name in named if name not in new),
        run,
        () if run is None else differing(image, run),
    )


def _source(family: Sequence[Segments]) -> Source:
    """A line of the witness, with the stretches that a row reads otherwise; a break of the line is none."""
    line, *after = family
    words, spans = "", []
    for piece in line.pieces:
        if isinstance(piece, Place):
            old = reading((piece,), ())
            rest = [one for one in after if one.id.startswith(f"{piece.row.id}.")]
            new = " ".join(reading(pieces, _ALL) for pieces in ((piece,), *(one.pieces for one in rest)))
            spans += [(len(words) + first, len(words) + last) for first, last in differing(new, old) if old]
            words += old
        else:
            words += piece
    return Source(line.id, line.page, sources().excerpt("chapter6").line(int(line.id)) or 0, words, tuple(spans))


def differing(one: str, other: str) -> Spans:
    """The stretches of the second text that are not the first's; all of it where the first has more and all of this."""
    if one == other:
        return ()
    codes = SequenceMatcher(None, one, other, autojunk=False).get_opcodes()
    found = tuple((first, last) for kind, _, _, first, last in codes if kind != "equal" and first < last)
    return found or ((0, len(other)),)

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
from modern.edition.chapter6 import Device, DeviceLayout
from modern.edition.chapter6_cards import Card, Chapter, cards, load_chapter, printed_lines
from modern.edition.reproduce import Report, reproduce
from modern.edition.segments import Place, Segments, reading, segments
from modern.edition.sources import sources

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
    lines = {line.id: line for line in segments(chapter.text)}
    return tuple(_part(chapter, entry, lines, reports) for entry in chapter.layout.devices if entry.example == number)


def _part(chapter: Chapter, entry: DeviceLayout, lines: dict[str, Segments], reports: Sequence[Report]) -> Part:
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


def _shown(number: int, card: Card | None, run: str | None, lines: dict[str, Segments], seen: set[str]) -> Shown:
    named = tuple(dict.fromkeys(token.line for token in card.tokens)) if card else ()
    new = tuple(name for name in named if name not in seen and name.isdigit())
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


def _source(line: Segments) -> Source:
    """A line of the witness, with the stretches that a row reads otherwise."""
    words, spans = "", []
    for piece in line.pieces:
        if isinstance(piece, Place):
            old = reading((piece,), ())
            new = reading((piece,), (piece.row.layer,))
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

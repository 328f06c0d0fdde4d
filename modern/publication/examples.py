"""The printed examples of chapter 6 as data: OCR text, corrected text and our run, card by card.

:mod:`modern.edition.chapter6_cards` relates the corrected text to the OCR text. :mod:`modern.edition.reproduce` runs
the programs and compares the result with the corrected text.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher
from functools import cache

from modern.edition.apparatus import Row
from modern.edition.chapter6 import EXAMPLES, Device, DeviceLayout
from modern.edition.chapter6_cards import Card, Chapter, cards, load_chapter, printed_lines
from modern.edition.reproduce import EXACT, ORDER, Report, reproduce
from modern.edition.segments import Place, Segments, reading, segments
from modern.edition.sources import sources

_LAYERS = ("ocr", "typist")
Spans = tuple[tuple[int, int], ...]
TITLES = {"deck": "cards read", "punch": "cards punched", "typewriter": "lines typed"}
VERDICTS = {EXACT: "identical", ORDER: "the same hull in another order"}


@dataclass(frozen=True, slots=True)
class Source:
    """A line of the OCR text.

    ``line`` is its number in the file of the witness, and ``at`` is its number in the whole document, or 0 if unknown.
    ``changed`` has the spans of characters that rows of the apparatus change.
    """

    line: str
    page: str
    at: int
    text: str
    changed: Spans


@dataclass(frozen=True, slots=True)
class Shown:
    """A card as printed and as our run punches it.

    ``print`` is the card in the corrected text. ``run`` is the card of the run, or None for an input deck. ``sources``
    are the lines of the witness that begin on this card, and ``continued`` has the numbers of lines that began on an
    earlier card. ``differs`` has the spans of ``run`` that differ from ``print``.
    """

    number: int
    print: str
    sources: tuple[Source, ...]
    continued: tuple[str, ...]
    run: str | None
    differs: Spans


@dataclass(frozen=True, slots=True)
class Part:
    """The cards or typed lines of one device in a run of one program.

    ``stated`` is True for lines that the thesis describes but does not print. ``reports`` has the verdicts for both
    states of program 1, and ``rows`` has the emendations of these cards.
    """

    example: int
    program: int
    device: Device
    stated: bool
    cards: tuple[Shown, ...]
    reports: tuple[Report, ...]
    rows: tuple[Row, ...]

    @property
    def id(self) -> str:
        """The id on the page, such as ``program1-punch``."""
        return f"program{self.program}-{self.device}"

    @property
    def title(self) -> str:
        return f"Program {self.program}: {TITLES[self.device]}"


@cache
def example(number: int) -> tuple[Part, ...]:
    """Return the parts of an example of chapter 6, in the order in which the thesis prints them."""
    chapter = load_chapter()
    reports = tuple(reproduce((number,)))
    lines = _origins(segments(chapter.text))
    return tuple(_part(chapter, entry, lines, reports) for entry in chapter.layout.devices if entry.example == number)


@cache
def homes() -> dict[str, tuple[int, str]]:
    """Return, for each emendation, the first example that shows it, and the id of the part in which it is shown."""
    first_shown: dict[str, tuple[int, str]] = {}
    for number in EXAMPLES:
        for part in example(number):
            for row in part.rows:
                first_shown.setdefault(row.id, (number, part.id))
    return first_shown


def rest() -> tuple[Row, ...]:
    """Return the emendations that change no card of chapter 6, but text between cards, such as page numbers."""
    return tuple(row for row in load_chapter().text.rows if row.id not in homes())


def _origins(lines: Sequence[Segments]) -> dict[str, list[Segments]]:
    """Map the id of each line to a list that contains it: a witness line and the lines inserted after that line."""
    families: dict[str, list[Segments]] = {}
    family: list[Segments] = []
    for line in lines:
        family = [*family, line] if line.inserted else [line]
        for member in family:
            families[member.id] = family
    return families


def _part(chapter: Chapter, entry: DeviceLayout, lines: dict[str, list[Segments]], reports: Sequence[Report]) -> Part:
    of_part = (r for r in reports if (r.program, r.device) == (entry.program, entry.device))
    reports_of_part = tuple(sorted(of_part, key=lambda report: report.state))
    produced = next((r.produced for r in reports_of_part if r.state == "examples"), None)
    shown_cards: list[Shown] = []
    shown_lines: set[str] = set()
    printed = cards(chapter, entry.example, entry.program, entry.device)
    # The run may have more or fewer cards than the print.
    for n in range(max(len(printed), len(produced or ()))):
        card = printed[n] if n < len(printed) else None
        run = None if produced is None else produced[n] if n < len(produced) else ""
        shown_cards.append(_shown(n + 1, card, run, lines, shown_lines))
    rows_used = {row for line in printed_lines(chapter, entry) for row in line.rows}
    rows = tuple(row for row in chapter.text.rows if row.id in rows_used)
    stated = entry.layer == "stated"
    return Part(entry.example, entry.program, entry.device, stated, tuple(shown_cards), reports_of_part, rows)


def _shown(
    number: int, card: Card | None, run: str | None, lines: dict[str, list[Segments]], shown_lines: set[str]
) -> Shown:
    """Compare a printed card with the run.

    Add the lines of the witness that begin on this card to ``shown_lines``.
    """
    line_ids = tuple(dict.fromkeys(lines[token.line][0].id for token in card.tokens)) if card else ()
    new = tuple(line for line in line_ids if line not in shown_lines)
    shown_lines |= set(new)
    image = card.image if card else ""
    sources_of_card = tuple(_source(lines[line]) for line in new)
    continued = tuple(line for line in line_ids if line not in new)
    return Shown(number, image, sources_of_card, continued, run, () if run is None else differing(image, run))


def _source(family: Sequence[Segments]) -> Source:
    """Return a line of the witness with the spans that rows change.  Inserted line breaks do not count as changes."""
    line, *inserted = family
    text = ""
    spans: list[tuple[int, int]] = []
    for piece in line.pieces:
        if isinstance(piece, Place):
            # Compare the witness with our reading, which may continue on lines that the row inserts.
            old = reading((piece,), ())
            continuation = [part.pieces for part in inserted if part.id.startswith(f"{piece.row.id}.")]
            new = " ".join(reading(pieces, _LAYERS) for pieces in ((piece,), *continuation))
            for first, last in differing(new, old) if old else ():
                # A change may consist of neighbouring places, for instance of a word and of blanks.
                start = spans.pop()[0] if spans and spans[-1][1] == len(text) + first else len(text) + first
                spans.append((start, len(text) + last))
            text += old
        else:
            text += piece
    return Source(line.id, line.page, sources().excerpt("chapter6").line(int(line.id)) or 0, text, tuple(spans))


def differing(expected: str, actual: str) -> Spans:
    """Return the spans of ``actual`` that differ from ``expected``.

    If ``actual`` only lacks characters of ``expected``, return one span of all of ``actual``.
    """
    if expected == actual:
        return ()
    codes = SequenceMatcher(None, expected, actual, autojunk=False).get_opcodes()
    spans = tuple((first, last) for kind, _, _, first, last in codes if kind != "equal" and first < last)
    return spans or ((0, len(actual)),)

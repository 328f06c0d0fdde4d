"""The facing text of a listing: the OCR text (witness) of each card next to the card, with the rows that change it.

The module collects only facts. The site and the book present them.

Every card has a *place*, a name that is counted from the programmer's statement numbers and therefore stays valid when
the numbering of the deck changes. ``147+2`` is the second statement after statement 147. ``0+1`` is the first statement
of a deck that does not begin with a numbered statement. ``before-106`` is the comment before statement 106, and
``title`` is the first comment. Counting may continue past the next numbered statement: if 148 is the statement after
147, ``147+2`` is also ``148+1``, and the card has both names.
"""

import re
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from difflib import SequenceMatcher
from functools import cache
from typing import Literal

from modern.edition import programs
from modern.edition.apparatus import Line, Row, Text, build
from modern.edition.sources import sources

Kind = Literal["title", "comment", "statement", "format"]
# The largest number of statements by which a place is counted past the next statement number.
FURTHER = 3
# A range of characters: the index of its first character, and the index of the first character after it.
Span = tuple[int, int]


@dataclass(frozen=True, slots=True)
class Piece:
    """A line of the witness, or the part of a line, from which a card was made.

    ``line`` is the number of the line in the witness, counted from 1 without page marks. ``source`` is its number in
    the whole OCR text of the document, or 0 if it is unknown. ``changed`` has the ranges of characters that the card
    lacks.
    """

    page: str
    line: int
    source: int
    text: str
    changed: tuple[Span, ...] = ()


@dataclass(frozen=True, slots=True)
class Variant:
    """The cards that replace a card if a further layer is applied. The layer removes the card if ``cards`` is empty."""

    layer: str
    rows: tuple[str, ...]
    cards: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Card:
    """A card of a deck with the witness from which it was made.

    ``number`` is the number of the card in the deck, counted from 1. ``label`` is its statement number or 0, and
    ``page`` is the page of the thesis. ``also`` has further names of the card in the same form as ``place``.
    ``witness`` is empty for a card that the witness lacks. ``changed`` has the ranges of characters that differ from
    the witness. ``rows`` are the ids of the rows that changed the card, except those that changed most cards of the
    deck. ``layers`` are the layers of these rows. ``variants`` has the card as optional layers would change it.
    """

    number: int
    place: str
    kind: Kind
    label: int
    page: str
    text: str
    witness: tuple[Piece, ...]
    changed: tuple[Span, ...]
    rows: tuple[str, ...]
    layers: tuple[str, ...]
    variants: tuple[Variant, ...] = ()
    also: tuple[str, ...] = ()

    @property
    def applicable_rows(self) -> tuple[str, ...]:
        """The ids of the emendations that change this card, now or with further layers applied."""
        return tuple(dict.fromkeys([*self.rows, *(row for variant in self.variants for row in variant.rows)]))


@dataclass(frozen=True)
class Facing:
    """The facing text of a built-in program.

    ``everywhere`` has the rows that change most cards. ``dropped`` pairs the id of a row with the lines of the witness
    that the row removes from this deck.
    """

    program: str
    title: str
    text: Text
    cards: tuple[Card, ...]
    everywhere: tuple[Row, ...]
    dropped: tuple[tuple[str, tuple[Piece, ...]], ...]

    def rows(self) -> tuple[Row, ...]:
        """Return the rows of all layers that change this deck, in the order of the apparatus."""
        ids = {row for card in self.cards for row in card.applicable_rows}
        ids |= {row.id for row in self.everywhere} | {row for row, _ in self.dropped}
        return tuple(row for row in self.text.rows if row.id in ids)

    def cards_of(self, row: str) -> tuple[Card, ...]:
        """Return the cards that a row changes, or would change if its layer were applied."""
        return tuple(card for card in self.cards if row in card.applicable_rows)

    def pages(self) -> Iterator[tuple[str, tuple[Card, ...]]]:
        """Return the pages of the thesis in order, each with its cards."""
        for page in dict.fromkeys(card.page for card in self.cards):
            yield page, tuple(card for card in self.cards if card.page == page)


@cache
def facing(name: str) -> Facing:
    """Return a built-in program with the OCR text of each card. Raise KeyError for an unknown name."""
    entry = programs.built_in(name)
    text = programs.text(entry.text)
    lines = build(text, entry.layers)
    everywhere = _everywhere(lines)
    places = _places(lines)
    pieces, dropped = _pieces(text, lines, entry.layers, everywhere)
    variants = _variants(text, lines, entry.layers)
    further_places = _further_places(places)
    layer_of = {row.id: row.layer for row in text.rows}
    cards = []
    for number, (line, (place, kind, label)) in enumerate(zip(lines, places, strict=True), 1):
        rows = tuple(name for name in line.rows if name not in everywhere)
        witness, changed = _compared(pieces.get(line.id, ()), line.text)
        of_layers = tuple(dict.fromkeys(layer_of[name] for name in rows))
        card = Card(number, place, kind, label, line.page, line.text, witness, changed, rows, of_layers)
        cards.append(replace(card, variants=variants.get(line.id, ()), also=further_places.get(place, ())))
    rows_everywhere = tuple(row for row in text.rows if row.id in everywhere)
    return Facing(name, entry.title, text, tuple(cards), rows_everywhere, dropped)


def page_of(row: Row) -> str:
    """Return the built-in program whose page of the site shows a row of a listing.

    The page of program1_examples shows only the rows that the listing of program 1 does not use.
    """
    return row.text if row in facing(row.text).rows() else f"{row.text}_examples"


def _everywhere(lines: Sequence[Line]) -> frozenset[str]:
    counts = Counter(row for line in lines for row in set(line.rows))
    return frozenset(row for row, count in counts.items() if 2 * count > len(lines))


def _places(lines: Iterable[Line]) -> list[tuple[str, Kind, int]]:
    comments: list[int] = []  # indices of comments whose following statement has not come yet
    places: list[tuple[str, Kind, int]] = []
    number, steps = 0, 0  # the last statement number, and the statements since then
    for index, line in enumerate(lines):
        if line.text.startswith("C  "):
            comments.append(index)
            places.append(("", "comment", 0))
            continue
        match = re.match(r"\s*(\d+)\s*(FORMAT)?", line.text)
        label = int(match[1]) if match else 0
        number, steps = (label, 0) if match else (number, steps + 1)
        place = f"{number}+{steps}" if steps else str(number)
        for k, comment in enumerate(comments):
            if comment == 0:
                places[0] = ("title", "title", 0)
            else:
                # Further comments before the same statement get a letter: before-106, before-106b.
                places[comment] = (f"before-{place}{'' if k == 0 else chr(ord('a') + k)}", "comment", 0)
        comments = []
        places.append((place, "format" if match and match[2] else "statement", label))
    return places


def _further_places(places: Sequence[tuple[str, Kind, int]]) -> Mapping[str, tuple[str, ...]]:
    known = {place for place, _, _ in places}
    further: dict[str, list[str]] = {}
    counted: list[tuple[int, int]] = []  # earlier statement numbers with the statements since then
    for place, kind, label in places:
        if kind in ("comment", "title"):
            continue
        counted = [(number, steps + 1) for number, steps in counted]
        for number, steps in counted:
            name = f"{number}+{steps}"
            if steps <= FURTHER and name not in known:
                further.setdefault(place, []).append(name)
        if label:
            counted = [(number, steps) for number, steps in counted if steps < FURTHER] + [(label, 0)]
    return {place: tuple(names) for place, names in further.items()}


def _pieces(
    text: Text, lines: Sequence[Line], layers: Sequence[str], everywhere: Collection[str]
) -> tuple[dict[str, tuple[Piece, ...]], tuple[tuple[str, tuple[Piece, ...]], ...]]:
    """Return the pieces of the witness for each card, and the lines that each row drops from the deck.

    A witness line from which several cards were made is divided among them.
    """
    witness = {line.id: line for line in text.witness}
    order = {name: index for index, name in enumerate(witness)}
    bases = {line.id: _base(text, line.id) for line in lines}
    cards_of_base: dict[str, list[str]] = {}
    for line in lines:
        if bases[line.id]:
            cards_of_base.setdefault(bases[line.id], []).append(line.id)
    # If a witness line has no card, the last row that changed it joined it to a nearby card, or dropped it.
    joined: dict[str, list[str]] = {}
    dropped: dict[str, list[Piece]] = {}
    for name in witness:
        if name in cards_of_base:
            continue
        row = _emptying_row(text, name, layers, everywhere)
        candidates = [line for line in lines if row in line.rows and bases[line.id]]
        if candidates:
            nearest = min(candidates, key=lambda line: abs(order[bases[line.id]] - order[name]))
            joined.setdefault(bases[nearest.id], []).append(name)
        else:
            dropped.setdefault(row, []).append(_piece(text, witness[name], witness[name].text))
    pieces_of: dict[str, tuple[Piece, ...]] = {}
    texts = {line.id: line.text for line in lines}
    for base, cards in cards_of_base.items():
        parts = _divided(witness[base].text, [texts[card] for card in cards])
        for card, part in zip(cards, parts, strict=True):
            pieces = [_piece(text, witness[base], part)]
            if card == cards[0]:
                pieces += [_piece(text, witness[name], witness[name].text) for name in joined.get(base, ())]
            pieces_of[card] = tuple(sorted(pieces, key=lambda piece: piece.line))
    return pieces_of, tuple((row, tuple(pieces)) for row, pieces in dropped.items())


def _base(text: Text, line: str) -> str:
    """Return the witness line from which a card was made, or an empty string for a card that an emendation inserts.

    The id of a card made by a row is the row's id and a count: ``P1-012.2``.
    """
    while not line.isdigit():
        row_id, _, count = line.rpartition(".")
        made = 0  # lines that the changes of the row so far have made
        for change in text.row(row_id).changes:
            if change.through or change.dense:
                continue
            made += change.lemma.count("\n") + change.after
            if made >= int(count):
                if change.after:
                    return ""
                line = change.line
                break
        else:
            return ""
    return line


def _emptying_row(text: Text, line: str, layers: Collection[str], everywhere: Collection[str]) -> str:
    """Return, for a witness line from which no card was made, the last row of the deck's layers that changes it."""
    for row in reversed([row for row in text.rows if row.layer in layers and row.id not in everywhere]):
        for change in row.changes:
            span = range(int(change.line), int(change.through) + 1) if change.through else ()
            if change.line == line or int(line) in span:
                return row.id
    return ""


def _piece(text: Text, line: Line, content: str) -> Piece:
    source = sources().excerpt(text.id).line(int(line.id)) or 0
    return Piece(line.page, int(line.id), source, content)


def _divided(line: str, cards: Sequence[str]) -> list[str]:
    if len(cards) == 1:
        return [line]
    all_cards = "".join(cards)
    in_line = {b: a for a, b in _pairs(line, all_cards)}
    starts, end = [0], 0
    for card in cards[:-1]:
        end += len(card)
        # The next part begins with the first character of the line that a later card still has.
        later = [in_line[index] for index in range(end, len(all_cards)) if index in in_line]
        starts.append(max(later[0] if later else len(line), starts[-1]))
    return [line[first:last] for first, last in zip(starts, (*starts[1:], len(line)), strict=True)]


def _compared(pieces: Sequence[Piece], card: str) -> tuple[tuple[Piece, ...], tuple[Span, ...]]:
    """Compare the witness of a card with the card, without blanks.

    Return the pieces, with the ranges of characters that the card lacks, and the ranges that only the card has.
    """
    if not pieces:
        return (), ((0, len(card)),)
    joined = "\n".join(piece.text for piece in pieces)
    pairs = _pairs(joined, card)
    in_witness, in_card = {a for a, _ in pairs}, {b for _, b in pairs}
    compared, start = [], 0
    for piece in pieces:
        lost = {index for index in range(len(piece.text)) if start + index not in in_witness}
        compared.append(replace(piece, changed=tuple(_spans(piece.text, lost))))
        start += len(piece.text) + 1
    return tuple(compared), tuple(_spans(card, set(range(len(card))) - in_card))


def _pairs(line: str, card: str) -> list[tuple[int, int]]:
    """Return pairs of indices of the characters that two texts have in common, in order and without blanks."""
    first, second = ([n for n, char in enumerate(text) if not char.isspace()] for text in (line, card))
    matcher = SequenceMatcher(None, [line[n] for n in first], [card[n] for n in second], autojunk=False)
    return [
        (first[block.a + k], second[block.b + k]) for block in matcher.get_matching_blocks() for k in range(block.size)
    ]


def _spans(text: str, indices: Collection[int]) -> Iterator[Span]:
    """Join neighbouring character indices to spans, also across blanks. No span begins or ends with a blank."""
    remaining = [index for index in sorted(indices) if not text[index].isspace()]
    while remaining:
        first = last = remaining.pop(0)
        while remaining and not text[last + 1 : remaining[0]].strip():
            last = remaining.pop(0)
        yield first, last + 1


def _variants(text: Text, lines: Sequence[Line], layers: Sequence[str]) -> Mapping[str, tuple[Variant, ...]]:
    variants: dict[str, list[Variant]] = {}
    own = {line.id: line for line in lines}
    for layer in text.layers:
        rows = {row.id for row in text.rows if row.layer == layer}
        if layer in layers or not rows or layer == "examples":
            continue
        # A line that the layer inserts belongs to the card of this deck before it.
        replacements: dict[str, list[Line]] = {}
        card_id = ""
        for line in build(text, (*layers, layer)):
            card_id = line.id if line.id in own else card_id
            replacements.setdefault(card_id, []).append(line)
        for name, line in own.items():
            cards = replacements.get(name, [])
            if [card.text for card in cards] == [line.text]:
                continue
            changed_by = tuple(dict.fromkeys(r for card in cards for r in card.rows if r in rows))
            if not changed_by:  # the layer removes the card
                changed_by = tuple(r.id for r in text.rows if r.id in rows and any(c.line == name for c in r.changes))
            variants.setdefault(name, []).append(Variant(layer, changed_by, tuple(card.text for card in cards)))
    return {name: tuple(of_card) for name, of_card in variants.items()}

"""A listing card by card: what the witness has, what the deck has, and which rows of the apparatus stand between.

The facts of a facing text, without a word of presentation: the site, the book and whatever comes later say them in
their own way.  Every card has a place that outlives changes of the deck's numbering, because it is counted from the
numbers the programmer gave: ``147+2`` is the second statement after statement 147, ``0+1`` the first statement of a
deck whose first number has not come yet, ``before-106`` the comment before statement 106, ``title`` the first comment.
A count may go on past the next number, so that 147+2 is 148+1 as well; such places are the card's too.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher
from functools import cache
from typing import Literal

from modern.edition import programs
from modern.edition.apparatus import Line, Row, Text, build
from modern.edition.sources import sources

Kind = Literal["title", "comment", "statement", "format"]
FURTHER = 3
"""How many statements a count goes on past the next number."""
Span = tuple[int, int]
"""Characters of a text: the first, counted from 0, and the one after the last."""


@dataclass(frozen=True, slots=True)
class Piece:
    """A line of the witness, or the part of one, that a card was made from.

    ``line`` counts the witness's lines from 1, page marks left out; ``source`` is the line of the document's whole OCR
    text, 0 where it is not known.  ``changed`` are the characters that the deck has not.  ``part``: the line makes
    other cards too.
    """

    page: str
    line: int
    source: int
    text: str
    changed: tuple[Span, ...] = ()
    part: bool = False


@dataclass(frozen=True, slots=True)
class Otherwise:
    """What stands in the place of a card when a further layer is on: its cards, none where the card falls away."""

    layer: str
    rows: tuple[str, ...]
    cards: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Card:
    """A card of a deck with what faces it.

    ``number`` counts the deck's cards from 1; ``also`` are further places of it; ``label`` is the statement's number, 0
    without one.  ``witness`` is empty
    for a card of ours.  ``changed`` are characters the witness has otherwise, or not at all; ``rows`` the rows that
    touched this card, but for those that touched most cards of the deck.  ``page`` is the thesis's.
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
    otherwise: tuple[Otherwise, ...] = ()
    also: tuple[str, ...] = ()


@dataclass(frozen=True)
class Facing:
    """A built-in program's facing text.

    ``everywhere`` are the rows that touch most cards (the columns of the coding form); ``dropped`` the lines of the
    witness that this deck leaves out, by the row that replaces them.
    """

    program: str
    title: str
    text: Text
    cards: tuple[Card, ...]
    everywhere: tuple[Row, ...]
    dropped: tuple[tuple[str, tuple[Piece, ...]], ...]

    def rows(self) -> tuple[Row, ...]:
        """The rows of every layer that touch this deck, or would with their layer on, in the order of the apparatus."""
        named = {name for card in self.cards for name in card.rows}
        named |= {name for card in self.cards for other in card.otherwise for name in other.rows}
        named |= {row.id for row in self.everywhere} | {name for name, _ in self.dropped}
        return tuple(row for row in self.text.rows if row.id in named)

    def cards_of(self, row: str) -> tuple[Card, ...]:
        """The cards that a row touched, or would with its layer on."""
        return tuple(
            card for card in self.cards if row in card.rows or any(row in other.rows for other in card.otherwise)
        )

    def pages(self) -> Iterator[tuple[str, tuple[Card, ...]]]:
        """The cards by the page of the thesis they stand on, in order."""
        for page in dict.fromkeys(card.page for card in self.cards):
            yield page, tuple(card for card in self.cards if card.page == page)


@cache
def facing(name: str) -> Facing:
    """The facing text of a built-in program.  Raises KeyError for another name."""
    entry = programs.built_in(name)
    text = programs.text(entry.text)
    lines = build(text, entry.layers)
    everywhere = _everywhere(lines)
    places = tuple(_places(lines))
    pieces, dropped = _pieces(text, lines, entry.layers, everywhere)
    others = _others(text, lines, entry.layers)
    further = _further(places)
    layer_of = {row.id: row.layer for row in text.rows}
    cards = []
    for number, (line, (place, kind, label)) in enumerate(zip(lines, places, strict=True), 1):
        rows = tuple(name for name in line.rows if name not in everywhere)
        made, changed = _marked(pieces.get(line.id, ()), line.text)
        cards.append(
            Card(
                number,
                place,
                kind,
                label,
                line.page,
                line.text,
                made,
                changed,
                rows,
                tuple(dict.fromkeys(layer_of[name] for name in rows)),
                others.get(line.id, ()),
                further.get(place, ()),
            )
        )
    return Facing(
        name, entry.title, text, tuple(cards), tuple(row for row in text.rows if row.id in everywhere), dropped
    )


def _everywhere(lines: Sequence[Line]) -> frozenset[str]:
    """The rows that touch more than half of all cards."""
    touched = Counter(name for line in lines for name in set(line.rows))
    return frozenset(name for name, count in touched.items() if 2 * count > len(lines))


def _places(lines: Iterable[Line]) -> Iterator[tuple[str, Kind, int]]:
    """The place, the kind and the number of each card."""
    comments: list[int] = []
    found: list[tuple[str, Kind, int]] = []
    number, steps = 0, 0
    for at, line in enumerate(lines):
        if line.text.startswith("C  "):
            comments.append(at)
            found.append(("", "comment", 0))
            continue
        match = re.match(r"\s*(\d+)\s*(FORMAT)?", line.text)
        label = int(match[1]) if match else 0
        number, steps = (label, 0) if match else (number, steps + 1)
        place = f"{number}+{steps}" if steps else str(number)
        for k, comment in enumerate(comments):
            if comment == 0:
                found[0] = ("title", "title", 0)
            else:
                # Several comments before one statement are told apart by a letter: before-106, before-106b.
                found[comment] = (f"before-{place}{'' if k == 0 else chr(ord('a') + k)}", "comment", 0)
        comments = []
        found.append((place, "format" if match and match[2] else "statement", label))
    yield from found


def _further(places: Sequence[tuple[str, Kind, int]]) -> Mapping[str, tuple[str, ...]]:
    """The places of a card that are counted from the numbers before its own."""
    known = {place for place, _, _ in places}
    found: dict[str, list[str]] = {}
    counted: list[tuple[int, int]] = []
    for place, kind, label in places:
        if kind in ("comment", "title"):
            continue
        counted = [(number, steps + 1) for number, steps in counted]
        for number, steps in counted:
            name = f"{number}+{steps}"
            if steps <= FURTHER and name not in known:
                found.setdefault(place, []).append(name)
        if label:
            counted = [(number, steps) for number, steps in counted if steps < FURTHER] + [(label, 0)]
    return {place: tuple(names) for place, names in found.items()}


def _pieces(
    text: Text, lines: Sequence[Line], layers: Sequence[str], everywhere: Collection[str]
) -> tuple[dict[str, tuple[Piece, ...]], tuple[tuple[str, tuple[Piece, ...]], ...]]:
    """The witness lines of each card by its id, those cut up that make several; and the lines a row drops, by row."""
    witness = {line.id: line for line in text.witness}
    order = {name: at for at, name in enumerate(witness)}
    bases = {line.id: _base(text, line.id) for line in lines}
    made: dict[str, list[str]] = {}
    for line in lines:
        if bases[line.id]:
            made.setdefault(bases[line.id], []).append(line.id)
    more: dict[str, list[str]] = {}
    dropped: dict[str, list[Piece]] = {}
    for name in witness:
        if name in made:
            continue
        row = _emptier(text, name, layers, everywhere)
        near = [line for line in lines if row in line.rows and bases[line.id]]
        if near:
            nearest = min(near, key=lambda line: abs(order[bases[line.id]] - order[name]))
            more.setdefault(bases[nearest.id], []).append(name)
        else:
            dropped.setdefault(row, []).append(_piece(text, witness[name], witness[name].text))
    found: dict[str, tuple[Piece, ...]] = {}
    texts = {line.id: line.text for line in lines}
    for base, cards in made.items():
        cut = _cut(witness[base].text, [texts[card] for card in cards])
        for card, part in zip(cards, cut, strict=True):
            own = [_piece(text, witness[base], part, len(cards) > 1)]
            own += [_piece(text, witness[name], witness[name].text) for name in more.get(base, ()) if card == cards[0]]
            found[card] = tuple(sorted(own, key=lambda piece: piece.line))
    return found, tuple((row, tuple(pieces)) for row, pieces in dropped.items())


def _base(text: Text, line: str) -> str:
    """The witness line a card was made from; empty for one that a row puts in."""
    while not line.isdigit():
        row_id, _, count = line.rpartition(".")
        made = 0
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


def _emptier(text: Text, line: str, layers: Collection[str], everywhere: Collection[str]) -> str:
    """The last row of the deck's layers that leaves nothing of a witness line."""
    for row in reversed([row for row in text.rows if row.layer in layers and row.id not in everywhere]):
        for change in row.changes:
            span = range(int(change.line), int(change.through) + 1) if change.through else ()
            if change.line == line or int(line) in span:
                return row.id
    return ""


def _piece(text: Text, line: Line, words: str, part: bool = False) -> Piece:
    source = sources().excerpt(text.id).line(int(line.id)) or 0
    return Piece(line.page, int(line.id), source, words, (), part)


def _cut(line: str, cards: Sequence[str]) -> list[str]:
    """The parts of a line that several cards were made from, in order; together they are the line."""
    if len(cards) == 1:
        return [line]
    whole = "".join(cards)
    paired = {b: a for a, b in _pairs(line, whole)}
    cuts, begun = [0], 0
    for card in cards[:-1]:
        begun += len(card)
        ahead = [paired[at] for at in range(begun, len(whole)) if at in paired]
        cuts.append(max(ahead[0] if ahead else len(line), cuts[-1]))
    return [line[first:last] for first, last in zip(cuts, (*cuts[1:], len(line)), strict=True)]


def _marked(pieces: Sequence[Piece], card: str) -> tuple[tuple[Piece, ...], tuple[Span, ...]]:
    """Pieces and card with the characters marked in which they differ; blanks are not compared."""
    if not pieces:
        return (), ((0, len(card)),)
    joined = "\n".join(piece.text for piece in pieces)
    pairs = _pairs(joined, card)
    kept, taken = {a for a, _ in pairs}, {b for _, b in pairs}
    marked, begun = [], 0
    for piece in pieces:
        lost = {at - begun for at in range(begun, begun + len(piece.text)) if at not in kept}
        marked.append(
            Piece(piece.page, piece.line, piece.source, piece.text, tuple(_spans(piece.text, lost)), piece.part)
        )
        begun += len(piece.text) + 1
    return tuple(marked), tuple(_spans(card, {at for at in range(len(card)) if at not in taken}))


def _pairs(one: str, other: str) -> list[tuple[int, int]]:
    """The characters two texts have in common, in order, by their places; blanks and line ends are passed over."""
    first, second = ([at for at, char in enumerate(text) if not char.isspace()] for text in (one, other))
    matcher = SequenceMatcher(None, [one[at] for at in first], [other[at] for at in second], autojunk=False)
    return [
        (first[block.a + k], second[block.b + k]) for block in matcher.get_matching_blocks() for k in range(block.size)
    ]


def _spans(text: str, marked: Collection[int]) -> Iterator[Span]:
    """Runs of marked characters that are not blank; a blank between two of them does not part them."""
    found = [at for at in sorted(marked) if not text[at].isspace()]
    while found:
        first = last = found.pop(0)
        while found and not text[last + 1 : found[0]].strip():
            last = found.pop(0)
        yield first, last + 1


def _others(text: Text, lines: Sequence[Line], layers: Sequence[str]) -> Mapping[str, tuple[Otherwise, ...]]:
    """What each layer the deck is built without would put in the place of a card, by the card's id."""
    found: dict[str, list[Otherwise]] = {}
    own = {line.id: line for line in lines}
    for layer in text.layers:
        rows = {row.id for row in text.rows if row.layer == layer}
        if layer in layers or not rows or layer == "examples":
            continue
        now: dict[str, list[Line]] = {}
        at = ""
        for line in build(text, (*layers, layer)):
            at = line.id if line.id in own else at
            now.setdefault(at, []).append(line)
        for name, line in own.items():
            cards = now.get(name, [])
            if [card.text for card in cards] == [line.text]:
                continue
            touched = tuple(dict.fromkeys(r for card in cards for r in card.rows if r in rows))
            touched = touched or tuple(row.id for row in text.rows if row.id in rows and name in _lines(row))
            found.setdefault(name, []).append(Otherwise(layer, touched, tuple(card.text for card in cards)))
    return {name: tuple(others) for name, others in found.items()}


def _lines(row: Row) -> set[str]:
    return {change.line for change in row.changes}

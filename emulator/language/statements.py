"""From cards to statements: which cards are comments, which continue, where a statement's number and text are.

Sources: C26-5619 p. 12 (the columns of the form are only guides: a statement may start in any of columns
1 to 72; a statement that begins with C and two blanks is a comment; columns 73 to 80 are identification).
Continuation cards and blank cards: OPEN-QUESTIONS 1 and 2.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from string import ascii_lowercase, ascii_uppercase

from emulator.language.cards import Card, Deck
from emulator.language.tree import Place

LAST_COLUMN = 72
_FIRST = 7
"""Where a continuation card's text begins."""
_CAPITALS = str.maketrans(ascii_lowercase, ascii_uppercase)

_VERB = re.compile(r"READ|ACCEPT|PUNCH|PRINT|TYPE")
_BEFORE = re.compile(r"[ 0-9]*")
_FORMAT = re.compile(r"\s*F\s*O\s*R\s*M\s*A\s*T\s*\(")
_DO = re.compile(r"DO\d+,?[A-Z][A-Z0-9]*=")
_PREFIXES = (
    ("GOTO(", "computed_go_to"),
    ("GOTO", "go_to"),
    ("IF(SENSESWITCH", "if_switch"),
    ("IF(", "if"),
    ("CONTINUE", "continue"),
    ("PAUSE", "pause"),
    ("STOP", "stop"),
    ("DIMENSION", "dimension"),
)


@dataclass(frozen=True, slots=True)
class Columns:
    """Where the characters of a statement stand, each place made when it is asked for.

    ``kept`` counts the characters of the statement's cards: all of the first, of each other from column 7 on.
    """

    cards: tuple[Card, ...]
    kept: Sequence[int]

    def __len__(self) -> int:
        return len(self.kept)

    def __getitem__(self, index: int) -> Place:
        return _place(self.cards, self.kept[index])


@dataclass(frozen=True, slots=True)
class Source:
    """A statement before parsing.

    ``text`` is the statement without number and without blanks, ``places`` the place of each of its
    characters; for a FORMAT both hold every column from its parenthesis on.  ``kind`` names the grammar's
    start rule, ``format`` for a FORMAT, ``unknown`` where no form fits.
    """

    label: str
    kind: str
    text: str
    places: Columns = field(hash=False)
    place: Place = field(hash=False)
    cards: tuple[Card, ...]


def is_comment(card: Card) -> bool:
    """A comment: C in column 1 and no form of a statement, or a card with no statement punched.

    The manual (p. 12) asks for two blanks after the C; IBM's FORTRAN II-D and PDQ FORTRAN take ``C-----`` and
    ``C TEXT`` as well (executed).  What has the form of a statement and does not parse: :func:`may_be_comment`.
    """
    if not card.columns(1, LAST_COLUMN).strip() or card.text.ljust(3).startswith("C  "):
        return True
    return card.text.startswith("C") and _source((card,)).kind == "unknown"


def capitals(text: str) -> str:
    """A source's text with capitals for small letters, in Hollerith fields too; a comment keeps its own after the C."""
    lines = []
    for number, line in enumerate(text.split("\n"), 1):
        upper = line.translate(_CAPITALS)
        if upper.startswith("C") and is_comment(Card(number, upper.rstrip(" \r"))):
            upper = "C" + line[1:]
        lines.append(upper)
    return "\n".join(lines)


def may_be_comment(source: Source) -> bool:
    """Whether a statement that does not parse can be taken as a comment: one card with C in column 1."""
    return len(source.cards) == 1 and source.place.column == 1 and source.cards[0].text.startswith("C")


def resembles_statement(card: Card) -> bool:
    """Whether a comment looks as if a statement had been meant: it begins as a word of the language does."""
    text = card.columns(1, LAST_COLUMN).replace(" ", "")
    return not card.text.ljust(3).startswith("C  ") and text.startswith(("CONTIN", "COMMON", "CALL"))


def sources(deck: Deck) -> Iterator[Source]:
    """The statements of a deck in order, comments left out."""
    group: list[Card] = []
    for card in deck.cards:
        if is_comment(card):
            continue
        if group and _continues(card):
            group.append(card)
            continue
        if group:
            yield _source(tuple(group))
        group = [card]
    if group:
        yield _source(tuple(group))


def classify(text: str) -> str:
    """The kind of a statement from its text without number and blanks; a grammar start rule, or ``unknown``."""
    equals = _top_level(text, "=")
    if equals >= 0:
        if _DO.match(text) and _top_level(text[equals:], ",") >= 0:
            return "do"
        return "assignment"
    if text == "END":
        return "end"
    for prefix, kind in _PREFIXES:
        if text.startswith(prefix):
            return kind
    return "input_output" if _VERB.match(text) else "unknown"


def _continues(card: Card) -> bool:
    """A punch other than 0 in column 6, columns 1 to 5 blank, and no statement if read by itself."""
    if card.columns(1, 5).strip() or card.columns(6, 6) in (" ", "0"):
        return False
    source = _source((card,))
    if source.kind == "format":
        return False
    if source.kind == "unknown" or source.text.count("(") != source.text.count(")"):
        return True
    return source.kind == "assignment" and _top_level(source.text, ",") >= 0


@lru_cache(2048)
def _source(cards: tuple[Card, ...]) -> Source:
    raw = cards[0].columns(1, LAST_COLUMN) + "".join(card.columns(_FIRST, LAST_COLUMN) for card in cards[1:])
    before = _BEFORE.match(raw)
    start = before.end() if before else 0
    label = raw[:start].replace(" ", "")
    place = _place(cards, start if start < len(raw) else raw.index(label[0]))
    match = _FORMAT.match(raw, start)
    if match:
        kept = range(match.end() - 1, len(raw))
        return Source(label, "format", raw[kept.start :], Columns(cards, kept), place, cards)
    text = raw[start:].replace(" ", "")
    dense = [i for i, char in enumerate(raw) if char != " " and i >= start]
    return Source(label, classify(text), text, Columns(cards, dense), place, cards)


def _place(cards: tuple[Card, ...], index: int) -> Place:
    """Where a character of a statement stands: all of its first card, of each other from the seventh column on."""
    if index < LAST_COLUMN:
        return Place(cards[0].number, index + 1)
    card, column = divmod(index - LAST_COLUMN, LAST_COLUMN - _FIRST + 1)
    return Place(cards[card + 1].number, column + _FIRST)


def _top_level(text: str, wanted: str) -> int:
    """Index of the first ``wanted`` outside parentheses, or -1."""
    depth = 0
    for i, char in enumerate(text):
        if char == "(":
            depth += 1
        elif char == ")":
            depth -= 1
        elif char == wanted and depth == 0:
            return i
    return -1

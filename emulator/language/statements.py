"""Group the cards of a deck into statements: comments, continuation cards, statement numbers and statement kinds.

Source: C26-5619 p. 12.  The columns printed on the coding form are only guides: a statement may start in any of columns
1 to 72.  A card that begins with C and two blanks is a comment.  Columns 73 to 80 identify the card and are not
compiled.  The manual leaves the rules for continuation cards and blank cards open (OPEN-QUESTIONS 1 and 2).
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import lru_cache
from string import ascii_lowercase, ascii_uppercase

from emulator.language.cards import RECORD_MARK, Card, Deck
from emulator.language.tree import Place

LAST_COLUMN = 72
# The column in which the text of a continuation card begins.
_FIRST = 7
_CAPITALS = str.maketrans(ascii_lowercase, ascii_uppercase)

_VERB = re.compile(r"READ|ACCEPT|PUNCH|PRINT|TYPE")
_NUMBER = re.compile(r"[ 0-9]*")
_FORMAT = re.compile(r"\s*F\s*O\s*R\s*M\s*A\s*T\s*\(")
_DO = re.compile(r"DO\d+,?[A-Z][A-Z0-9]*=")
# The first prefix that matches determines the kind, so a longer prefix precedes a shorter one with which it begins.
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
class Source:
    """A statement before parsing.

    ``text`` is the statement without its number (``label``) and without blanks, and ``places`` holds the card and
    column of each character of ``text``.  The text of a FORMAT has every column from the opening parenthesis on, also
    the blank ones.  ``kind`` is the rule of the grammar by which the statement is parsed, ``format`` for a FORMAT, or
    ``unknown`` if no statement form matches.
    """

    label: str
    kind: str
    text: str
    places: tuple[Place, ...] = field(hash=False)
    place: Place = field(hash=False)
    cards: tuple[Card, ...]


def is_control_card(card: Card) -> bool:
    """Return True for a control card of an operating system (a monitor), which begins with two record marks."""
    return len(RECORD_MARK.findall(card.text[:2])) == 2


def statement_columns(card: Card, first: int = 1) -> str:
    """Return columns ``first`` to 72 of a card, with blanks in place of a record mark and the columns after it."""
    text = card.columns(first, LAST_COLUMN)
    mark = None if is_control_card(card) else RECORD_MARK.search(text)
    return text[: mark.start()].ljust(len(text)) if mark else text


def is_comment(card: Card) -> bool:
    """Return True for a card that is a comment: blank, or with C in column 1 and not in the form of a statement.

    A card with C and two blanks is always a comment, as the manual (p. 12) requires.  ``C-----`` and ``C TEXT`` are
    comments too, as in IBM's FORTRAN II-D and PDQ FORTRAN, which we executed.  A card with C in column 1 may have the
    form of a statement but not parse: see :func:`may_be_comment`.
    """
    if not statement_columns(card).strip() or card.text.ljust(3).startswith("C  "):
        return True
    return card.text.startswith("C") and _source((card,)).kind == "unknown"


def capitals(text: str) -> str:
    """Convert a source text to capitals, Hollerith fields included.  Comments stay unchanged after their C."""
    lines = []
    for number, line in enumerate(text.split("\n"), 1):
        upper = line.translate(_CAPITALS)
        if upper.startswith("C") and is_comment(Card(number, upper.rstrip(" \r"))):
            upper = "C" + line[1:]
        lines.append(upper)
    return "\n".join(lines)


def may_be_comment(source: Source) -> bool:
    """Return True if a statement that does not parse may be a comment, because it is one card with C in column 1."""
    return len(source.cards) == 1 and source.place.column == 1 and source.cards[0].text.startswith("C")


def resembles_statement(card: Card) -> bool:
    """Return True if a comment begins like CONTINUE, COMMON or CALL: it may be a statement punched from column 1 on."""
    text = card.columns(1, LAST_COLUMN).replace(" ", "")
    return not card.text.ljust(3).startswith("C  ") and text.startswith(("CONTIN", "COMMON", "CALL"))


def sources(deck: Deck) -> Iterator[Source]:
    """Yield the statements of a deck in order, without comments."""
    group: list[Card] = []
    for card in deck.cards:
        if is_comment(card):
            continue
        # The cards after END may be data of any form, so they never continue END.  END takes at most three cards, so
        # longer groups of cards are not checked for END.
        if group and _continues(card) and (len(group) > len("END") or _source(tuple(group)).kind != "end"):
            group.append(card)
            continue
        if group:
            yield _source(tuple(group))
        group = [card]
    if group:
        yield _source(tuple(group))


def classify(text: str) -> str:
    """Return the kind of a statement, given without number and blanks: the rule that parses it, or ``unknown``."""
    # FORTRAN has no reserved words: an equals sign outside parentheses makes an assignment or a DO, whatever the
    # statement begins with.  DO needs a comma after the equals sign as well.
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
    """Return True for a continuation card: columns 1 to 5 blank, and in column 6 a character other than 0.

    A statement may start in column 6 too, so a card that has the form of a complete statement is not a continuation.
    """
    if card.columns(1, 5).strip() or card.columns(6, 6) in (" ", "0"):
        return False
    # The card has no such form if its text is of no kind, begins with an equals sign, has unbalanced parentheses, or is
    # an assignment with a comma outside parentheses.
    source = _source((card,))
    if source.kind == "format":
        return False
    if source.kind == "unknown" or source.text[0] == "=" or source.text.count("(") != source.text.count(")"):
        return True
    return source.kind == "assignment" and _top_level(source.text, ",") >= 0


@lru_cache(2048)
def _source(cards: tuple[Card, ...]) -> Source:
    # The statement's columns in one sequence: 1 to 72 of the first card, then 7 to 72 of each continuation card.
    raw = statement_columns(cards[0]) + "".join(statement_columns(card, _FIRST) for card in cards[1:])
    places = [Place(cards[0].number, column) for column in range(1, LAST_COLUMN + 1)]
    places += [Place(card.number, column) for card in cards[1:] for column in range(_FIRST, LAST_COLUMN + 1)]
    number = _NUMBER.match(raw)
    start = number.end() if number else 0
    label = raw[:start].replace(" ", "")
    # If a card has a statement number but no statement, the error message refers to the place of the number.
    place = places[start if start < len(raw) else raw.index(label[0])]
    # A FORMAT keeps its blanks, because they count in Hollerith fields.
    match = _FORMAT.match(raw, start)
    if match:
        begun = match.end() - 1
        return Source(label, "format", raw[begun:], tuple(places[begun:]), place, cards)
    text = raw[start:].replace(" ", "")
    not_blank = tuple(places[i] for i in range(start, len(raw)) if raw[i] != " ")
    return Source(label, classify(text), text, not_blank, place, cards)


def _top_level(text: str, mark: str) -> int:
    """Return the index of the first character ``mark`` outside parentheses, or -1 if there is none."""
    depth = 0
    for i, char in enumerate(text):
        if char == "(":
            depth += 1
        elif char == ")":
            depth -= 1
        elif char == mark and depth == 0:
            return i
    return -1

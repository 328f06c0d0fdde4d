"""Functions that the restorer applies to single cards: the form of a card, its first error, possible corrections.

The functions receive cards without blanks, except comments and FORMATs.
"""

import re
from collections.abc import Iterator
from functools import lru_cache

from emulator.errors import EmulatorError, Refused
from emulator.language import tree
from emulator.language.cards import deck_from_lines
from emulator.language.formats import parse_format
from emulator.language.parser import parse_statement
from emulator.language.statements import sources
from modern.edition.readings import Pair, solid, table
from modern.edition.variants import LABELS

# Patterns of characters that no statement has, of a word of prose, and of the first words of statements.
_BAD = re.compile(r"[a-z#_'\":;<>\[\]{}\\~!?&%^|`]|[^\x00-\x7f]")
_WORD = re.compile(r"\b[A-Z][A-Z']{2,}\b")
_KEYWORD = re.compile(r"[ \d]*(?:GO ?TO|PUNCH|READ|PRINT|TYPE|ACCEPT|FORMAT|DIMENSION|COMMON|CALL|PAUSE|STOP|DO )")
_NAME = re.compile(r"[A-Z][A-Z0-9]*")


def is_prose(card: str) -> bool:
    """Return True if a card has three words or one long word and cannot be a statement: a comment that lost its C."""
    if "=" in card or "(" in card or _KEYWORD.match(card):
        return False
    return len(_WORD.findall(card)) >= 3 or re.fullmatch(r" *[A-Z-]{15,}", card) is not None


@lru_cache(1 << 18)
def statement(card: str) -> tuple[tree.Statement | None, int]:
    """Return the statement of a card, or None, and the column of the card's first error, or 0.

    The statement is None if the card has an error, and also if the card is a comment.
    """
    is_comment = card.startswith("C  ")
    bad = None if is_comment else _BAD.search(card)
    if bad:
        return None, bad.start() + 1
    # A statement that begins with C in column 1 would be a comment if it does not parse.
    line = card if is_comment or not card.startswith("C") else " " + card
    try:
        deck = deck_from_lines("card", [line])
        for source in sources(deck):
            statement = parse_statement(source)
            if isinstance(statement.body, tree.Format):
                parse_format(statement.body)
            return statement, 0
    except Refused as refused:
        return None, refused.diagnostic.column or len(card)
    except EmulatorError:
        return None, len(card)
    return None, 0


def fault(card: str) -> int | None:
    """Return the column of the first error of a card, or None if it is a statement or a comment."""
    return statement(card)[1] or None


def progress(card: str) -> int:
    """Return a score of a card with an error; it is higher if the error is farther to the right.

    The score is the column of the first error, minus 100 for each character that cannot occur in a statement.
    """
    return (fault(card) or 0) - 100 * len(_BAD.findall(card))


def exchanges(card: str) -> Iterator[tuple[str, Pair]]:
    """Yield each text that a card may have had before one misreading listed in the table of confusables.

    Each text is yielded with the pair of misread and correct characters.  If the card has characters that no statement
    can have, only replacements of the first of them are tried.
    """
    bad = None if card.startswith("C  ") else _BAD.search(card)
    for pair in table():
        if pair.cls == "comment":
            continue
        at = card.find(pair.witness)
        while 0 <= at < len(card):
            text = card[:at] + pair.lemma + card[at + len(pair.witness) :]
            near_zero = "0" in (card[at - 1 : at], card[at : at + 1])
            if (pair.cls != "zero" or near_zero) and (not bad or at <= bad.start() < at + len(pair.witness)):
                yield text, pair
            at = card.find(pair.witness, at + 1)


@lru_cache(1 << 16)
def labels(card: str) -> tuple[str, tuple[str, ...]]:
    """Return the statement number of a card, and the numbers of other statements to which its statement refers.

    The number of a FORMAT begins with F, which distinguishes it from the same number of another statement.
    """
    match = re.match(r"\s*(\d*)(.*)", card)
    assert match is not None
    number = ("F" if match[2].strip().startswith("FORMAT") else "") + match[1] if match[1] else ""
    for kind, pattern in LABELS.items():
        spans = pattern.search(match[2])
        if spans:
            mark = "F" if kind == "input_output" else ""
            return number, tuple(mark + reference for reference in re.findall(r"\d+", spans[1]))
    return number, ()


@lru_cache(1 << 16)
def names(card: str) -> frozenset[str]:
    """Return the names of variables and functions on a card."""
    text = re.sub(r"^\d*(?:GOTO|DO\d+|(?:READ|PUNCH|PRINT|TYPE|ACCEPT)\d*|IF\(SENSESWITCH\d|IF)?", "", card)
    return frozenset() if "FORMAT" in card or card.startswith("C  ") else frozenset(_NAME.findall(text))


@lru_cache(1 << 18)
def form(card: str) -> str:
    """Return a statement without its number, with each name replaced by the rank of its first occurrence.

    ``X(K)=Y(K)`` becomes ``<0>(<1>)=<2>(<1>)``.
    """
    order: dict[str, str] = {}
    text = re.sub(r"^\d+", "", solid(card))
    return _NAME.sub(lambda m: order.setdefault(m[0], f"<{len(order)}>"), text)

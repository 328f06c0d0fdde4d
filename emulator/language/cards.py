"""Punched cards: 80 columns, the character set of the IBM 026 card punch, and decks read from files.

The card code is that of the 1620 reference card, form X26-5743-2, page 4.  A deck file holds one card per line, without
the blank columns at the end of the card.
"""

import os
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from emulator.errors import CardError, DeckError, LowerCaseError, expect
from emulator.files import read_bytes, source_name

COLUMNS = 80
MAX_CARDS = 100_000

# The characters that stand for the record mark (punched 0-2-8) in decks: of simulators, of the 1960s, and of the 1620.
RECORD_MARKS = "|?\u2021"
RECORD_MARK = re.compile(f"[{RECORD_MARKS}]")


def _punches() -> dict[str, str]:
    # A letter is a zone punch (12, 11 or 0) with a digit punch.
    code = {" ": "", "+": "12", "-": "11", "/": "0-1"}
    code.update({str(d): str(d) for d in range(10)})
    code.update({c: f"12-{i}" for i, c in enumerate("ABCDEFGHI", 1)})
    code.update({c: f"11-{i}" for i, c in enumerate("JKLMNOPQR", 1)})
    code.update({c: f"0-{i}" for i, c in enumerate("STUVWXYZ", 2)})
    # A special character has an 8 punch with a 2, 3 or 4 punch, and in most cases a zone punch.
    code.update({".": "12-3-8", ")": "12-4-8", "$": "11-3-8", "*": "11-4-8"})
    code.update({",": "0-3-8", "(": "0-4-8", "=": "3-8", "@": "4-8", "'": "4-8"})
    code.update(dict.fromkeys(RECORD_MARKS, "0-2-8"))
    return code


# The punches of each character, e.g. ``{"A": "12-1", "=": "3-8"}``, in the scientific (H) arrangement of the 026.
PUNCHES: dict[str, str] = _punches()

CHARACTERS = frozenset(PUNCHES)

# Characters of the commercial (A) arrangement of the 026, each with the scientific character of the same punches.  A
# deck with a commercial character is rejected with an explanation.
COMMERCIAL = {"#": "=", "%": "(", "&": "+", "\u2311": ")", "\u00a4": ")"}


@dataclass(frozen=True, slots=True)
class Card:
    """A card: its number in the deck, counted from 1, and its text without trailing blanks."""

    number: int
    text: str

    def columns(self, first: int, last: int) -> str:
        """Return columns ``first`` to ``last``, counted from 1 and both included, padded with blanks."""
        return self.text.ljust(COLUMNS)[first - 1 : last]


@dataclass(frozen=True, slots=True)
class Deck:
    """A deck of cards, and the name that messages use for it (a file name or the name of a built-in deck)."""

    source: str
    cards: tuple[Card, ...]

    def text(self) -> str:
        """Return the text of the deck's file, one card per line."""
        return "".join(card.text + "\n" for card in self.cards)


def deck_from_lines(source: str, lines: Iterable[str]) -> Deck:
    """Make a deck from lines without line ends.  Raise CardError for an invalid character or a line over 80 columns."""
    expect(lines, Iterable, "lines")
    return Deck(source, tuple(read_line(source, number, line) for number, line in enumerate(lines, 1)))


def deck_from_text(source: str, text: str) -> Deck:
    """Make a deck from the text of a file with LF or CRLF line ends.  The last line need not be terminated."""
    expect(text, str, "text")
    # A line end after the last card does not start another card.
    lines = text.replace("\r\n", "\n").split("\n")
    if lines and lines[-1] == "":
        lines.pop()
    if len(lines) > MAX_CARDS:
        raise DeckError(f"{source}: expected at most {MAX_CARDS} cards, found {len(lines)}")
    return deck_from_lines(source, lines)


def read_deck(path: str | os.PathLike[str], change: Callable[[str], str] | None = None) -> Deck:
    """Read a deck file, or standard input if ``path`` is ``-``.

    The function ``change`` is applied to the text of the file before the text is divided into cards.  Raise FileError
    if the file cannot be read, DeckError if it holds no punched card, and CardError for an invalid card.
    """
    expect(path, (str, os.PathLike), "path")
    path = os.fspath(path)
    return deck_from_bytes(source_name(path), read_bytes(path), change)


def deck_from_bytes(name: str, data: bytes, change: Callable[[str], str] | None = None) -> Deck:
    """Make a deck from the bytes of a deck file.  For ``change`` and the errors raised, see :func:`read_deck`."""
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError:
        text = data.decode("latin-1")  # one character per byte, so that the error message names the right column
    deck = deck_from_text(name, change(text) if change else text)
    if not any(card.text for card in deck.cards):
        raise DeckError(f"{name}: the deck is empty" if not deck.cards else f"{name}: the deck has only blank cards")
    return deck


def read_line(source: str, number: int, line: str, unit: str = "card") -> Card:
    """Make a card from a line without its end.  Raise CardError for an invalid character or a line over 80 columns.

    A card with C in column 1 is not checked, because it may be a comment, and a comment may contain any character.
    """
    if not line.startswith("C"):
        check_characters(source, number, line, unit)
    text = line.rstrip(" ")
    if len(text) > COLUMNS:
        raise CardError(source, number, COLUMNS + 1, f"a card has {COLUMNS} columns; this line has {len(text)}")
    return Card(number, text)


def check_characters(source: str, number: int, line: str, unit: str = "card") -> None:
    """Raise CardError for the first character of a line that no card can hold."""
    if CHARACTERS.issuperset(line):
        return
    for column, char in enumerate(line, 1):
        if char not in CHARACTERS:
            kind = LowerCaseError if char.upper() in CHARACTERS else CardError
            raise kind(source, number, column, _explain_character(char), unit)


def _explain_character(char: str) -> str:
    if char in COMMERCIAL:
        return f"write {COMMERCIAL[char]!r} for {char!r}, the character of a commercial card punch with the same holes"
    if char.upper() in CHARACTERS:
        return f"{char!r} is not in the card code, which has only capital letters"
    return f"{repr(char) if char.isprintable() else f'character {ord(char):#04x}'} is not in the card code"

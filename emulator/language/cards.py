"""Punched cards: 80 columns, the character set of the IBM 026 punch, decks read from files.

Card code: 1620 reference card X26-5743-2, page 4.  A deck file holds one card a line; a line's trailing
blanks are the card's blank columns.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from emulator.errors import CardError, DeckError, LowerCaseError
from emulator.files import read_bytes, source_name

COLUMNS = 80
MAX_CARDS = 100_000

_ZONES = {"": "0123456789", "12": "ABCDEFGHI", "11": "JKLMNOPQR"}


def _punches() -> dict[str, str]:
    code = {" ": "", "+": "12", "-": "11", "/": "0-1"}
    code.update({str(d): str(d) for d in range(10)})
    code.update({c: f"12-{i}" for i, c in enumerate(_ZONES["12"], 1)})
    code.update({c: f"11-{i}" for i, c in enumerate(_ZONES["11"], 1)})
    code.update({c: f"0-{i}" for i, c in enumerate("STUVWXYZ", 2)})
    code.update({".": "12-3-8", ")": "12-4-8", "$": "11-3-8", "*": "11-4-8"})
    code.update({",": "0-3-8", "(": "0-4-8", "=": "3-8", "@": "4-8", "'": "4-8"})
    return code


PUNCHES: dict[str, str] = _punches()
"""Character to punches, e.g. ``{"A": "12-1", "=": "3-8"}``; the scientific (H) graphics of the 026."""

CHARACTERS = frozenset(PUNCHES)

COMMERCIAL = {"#": "=", "%": "(", "&": "+", "\u2311": ")", "\u00a4": ")"}
"""Graphics of the commercial (A) arrangement over the same holes; not accepted, only explained."""


@dataclass(frozen=True, slots=True)
class Card:
    """One card: its number in the deck counting from 1, and its columns without trailing blanks."""

    number: int
    text: str

    def columns(self, first: int, last: int) -> str:
        """Columns ``first`` to ``last`` (from 1, inclusive), blank where nothing is punched."""
        return self.text.ljust(COLUMNS)[first - 1 : last]


@dataclass(frozen=True, slots=True)
class Deck:
    """A deck and the name messages use for it (a file name, or a built-in's)."""

    source: str
    cards: tuple[Card, ...]

    def text(self) -> str:
        """The deck as a file's text, one card a line."""
        return "".join(card.text + "\n" for card in self.cards)


def deck_from_lines(source: str, lines: Iterable[str]) -> Deck:
    """A deck from lines without line ends.  Raises CardError for a strange character or an 81st column."""
    return Deck(source, tuple(read_line(source, number, line) for number, line in enumerate(lines, 1)))


def deck_from_text(source: str, text: str) -> Deck:
    """A deck from a file's text: LF or CRLF, the last line with or without an end."""
    lines = text.replace("\r\n", "\n").split("\n")
    if lines and lines[-1] == "":
        lines.pop()
    if len(lines) > MAX_CARDS:
        raise DeckError(f"{source}: {len(lines)} cards; a deck of more than {MAX_CARDS} is not read")
    return deck_from_lines(source, lines)


def read_deck(path: str, change: Callable[[str], str] | None = None) -> Deck:
    """Read a deck file, or standard input for ``-``; ``change`` is done to its text before it is taken for cards.

    Raises FileError when it cannot be read, DeckError when it is empty, CardError for a bad card.
    """
    return deck_from_bytes(source_name(path), read_bytes(path), change)


def deck_from_bytes(name: str, data: bytes, change: Callable[[str], str] | None = None) -> Deck:
    """A deck from the bytes of its file; as ``read_deck``, but for FileError."""
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError:
        text = data.decode("latin-1")  # a card names the column of a strange character, whatever its code
    deck = deck_from_text(name, change(text) if change else text)
    if not any(card.text for card in deck.cards):
        raise DeckError(f"{name}: the deck is empty" if not deck.cards else f"{name}: the deck has only blank cards")
    return deck


def read_line(source: str, number: int, line: str, unit: str = "card") -> Card:
    """A card from a line without its end.  Raises CardError for a strange character or an 81st column.

    A card with C in column 1 may be a comment of a source deck, which holds what its writer liked.
    """
    if not line.startswith("C"):
        refuse_strange(source, number, line, unit)
    text = line.rstrip(" ")
    if len(text) > COLUMNS:
        raise CardError(source, number, COLUMNS + 1, f"a card has {COLUMNS} columns; this one would need {len(text)}")
    return Card(number, text)


def refuse_strange(source: str, number: int, line: str, unit: str = "card") -> None:
    """Raise CardError for the first character that is not in the card code."""
    if CHARACTERS.issuperset(line):
        return
    for column, char in enumerate(line, 1):
        if char not in CHARACTERS:
            kind = LowerCaseError if char.upper() in CHARACTERS else CardError
            raise kind(source, number, column, _strange(char), unit)


def _strange(char: str) -> str:
    if char in COMMERCIAL:
        return f"{char!r} is the commercial graphic of the punch that FORTRAN prints as {COMMERCIAL[char]!r}"
    if char.upper() in CHARACTERS:
        return f"{char!r} is not in the card code: letters are capitals"
    return (
        f"{char!r} is not in the card code"
        if char.isprintable()
        else f"character {ord(char):#04x} is not in the card code"
    )

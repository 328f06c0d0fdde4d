"""Data decks of the hull programs: what a card must hold, checked before the machine sees it.

A data set is a card with N in columns 1-2, then N cards with x, y, z in columns 1-14, 15-28, 29-42 (thesis
p. 58-59; its data sheet gives z the columns 29 to 52, the FORMAT takes 29 to 42).  A deck may hold several.
With the layer ``epsilon`` the card with N holds e in columns 3-16 (OPEN-QUESTIONS 28).
"""

from __future__ import annotations

from dataclasses import dataclass

from emulator.errors import CardError, DeckError
from emulator.language.cards import Card, Deck
from emulator.language.formats import Field
from emulator.numbers.arithmetic import TRUNCATING, Rules
from emulator.numbers.fields import FieldError, Read, read_fixed, read_floating

MAX_POINTS = 51
COORDINATE = Field("E", 14, 8)
_LAST_COLUMN = 42
_E_FIRST, _E_LAST = 3, 16


@dataclass(frozen=True, slots=True)
class DataSet:
    """One data set: N, and the cards it takes up in the deck (the card with N first)."""

    n: int
    cards: tuple[Card, ...]


@dataclass(frozen=True, slots=True)
class CheckedDeck:
    """A deck that was checked: its data sets and what there is to warn about, a line each."""

    source: str
    sets: tuple[DataSet, ...]
    warnings: tuple[str, ...]

    def deck(self, index: int) -> Deck:
        """One data set as a deck of its own; the cards keep their numbers."""
        return Deck(self.source, self.sets[index].cards)


def check(deck: Deck, rules: Rules = TRUNCATING.rules, epsilon: bool = False) -> CheckedDeck:
    """Check every data set of a deck; ``epsilon`` says that the programs read e behind N.

    Raises CardError for an N that is no number or not 1 to 51, for a coordinate that is no number and for an e
    that is none or negative, DeckError where the deck ends before N points are there.
    """
    sets: list[DataSet] = []
    warnings: list[str] = []
    at = 0
    cards = deck.cards
    while at < len(cards):
        if sets and not any(card.text for card in cards[at:]):
            warnings.append(
                f"{deck.source}: card {cards[at].number}, column 1: blank cards behind the last data set are not read"
            )
            break
        n = _count(deck, cards[at], warnings, _E_LAST if epsilon else _E_FIRST - 1)
        if epsilon:
            _interval(deck, cards[at], rules, warnings)
        points = cards[at + 1 : at + 1 + n]
        if len(points) < n:
            raise DeckError(
                f"{deck.source}: card {cards[-1].number}, column 1: the deck ends after {len(points)} of {n} points "
                f"(N is on card {cards[at].number})"
            )
        seen: dict[tuple[tuple[int, int], ...], int] = {}
        for card in points:
            numbers = _point(deck, card, rules, warnings)
            first = seen.setdefault(numbers, card.number)
            if first != card.number:
                warnings.append(
                    f"{deck.source}: card {card.number}, column 1: the point of card {first} again; "
                    "the thesis takes distinct points"
                )
        sets.append(DataSet(n, (cards[at], *points)))
        at += 1 + n
    if not sets:
        raise DeckError(f"{deck.source}: the deck is empty")
    return CheckedDeck(deck.source, tuple(sets), tuple(warnings))


def _count(deck: Deck, card: Card, warnings: list[str], last: int) -> int:
    columns = card.columns(1, 2)
    try:
        number = read_fixed(columns)
    except FieldError:
        raise CardError(deck.source, card.number, 1, f"N, in columns 1-2, is {columns!r}: no number") from None
    if not columns.strip():
        raise CardError(deck.source, card.number, 1, "N, in columns 1-2, is blank")
    n = number.mantissa
    if not 1 <= n <= MAX_POINTS:
        raise CardError(deck.source, card.number, 1, f"N is {n}; the programs take 1 to {MAX_POINTS} points")
    if number.warning:
        warnings.append(f"{deck.source}: card {card.number}, column 1: {number.warning}: N is {n}")
    if card.text[last:].strip():
        words = f"what stands behind {'N' if last < _E_FIRST else 'e'} is not read"
        warnings.append(f"{deck.source}: card {card.number}, column {last + 1}: {words}")
    return n


def _interval(deck: Deck, card: Card, rules: Rules, warnings: list[str]) -> None:
    """Check e, columns 3 to 16; blank is zero."""
    columns = card.columns(_E_FIRST, _E_LAST)
    if not columns.strip():
        return
    try:
        number = read_floating(COORDINATE, columns, rules)
    except FieldError as error:
        raise CardError(deck.source, card.number, _E_FIRST, f"e: {error}") from None
    if number.mantissa < 0:
        raise CardError(deck.source, card.number, _E_FIRST, "e is negative: no value lies from -e to +e")
    if number.warning:
        warnings.append(f"{deck.source}: card {card.number}, column {_E_FIRST}: e: {number.warning}")


def _point(deck: Deck, card: Card, rules: Rules, warnings: list[str]) -> tuple[tuple[int, int], ...]:
    """The three numbers of a card, minus zero as zero."""
    numbers = []
    for k, axis in enumerate("xyz"):
        first = 1 + 14 * k
        try:
            number: Read = read_floating(COORDINATE, card.columns(first, first + 13), rules)
        except FieldError as error:
            raise CardError(deck.source, card.number, first, f"{axis}: {error}") from None
        numbers.append((number.mantissa, number.exponent if number.mantissa else 0))
        if number.warning:
            warnings.append(f"{deck.source}: card {card.number}, column {first}: {axis}: {number.warning}")
    if card.text[_LAST_COLUMN:].strip():
        column = _LAST_COLUMN + 1
        warnings.append(f"{deck.source}: card {card.number}, column {column}: what stands behind z is not read")
    return tuple(numbers)

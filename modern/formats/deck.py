"""Data decks of the hull programs: made from points, checked before the machine sees them, read as exact points.

A data set is a card with N in columns 1-2, then N cards with x, y, z in columns 1-14, 15-28, 29-42 (thesis
p. 58-59; its data sheet gives z the columns 29 to 52, the FORMAT takes 29 to 42).  A deck may hold several.
With the layer ``epsilon`` the card with N holds e in columns 3-16 (OPEN-QUESTIONS 28).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction

from emulator.errors import CardError, DeckError
from emulator.language.cards import Card, Deck, deck_from_lines
from emulator.numbers.arithmetic import TRUNCATING, Rules, profile
from emulator.numbers.fields import Field, FieldError, Read, Remark, read_fixed, read_floating
from modern.geometry.numbers import Point, finite_decimal, split_decimal

MAX_POINTS = 51
"""As many points as the programs' arrays take."""
MAX_N = 99
"""As many as the two columns of N can say."""
COORDINATE = Field("E", 14, 8)
_LAST_COLUMN = 42
_E_FIRST, _E_LAST = 3, 16
_DIGITS = 14
_RULES = profile(f"truncating:{_DIGITS}").rules
"""A field of 14 columns holds no more digits than these rules keep."""


@dataclass(frozen=True, slots=True)
class DataSet:
    """One data set: N, and the cards it takes up in the deck (the card with N first)."""

    n: int
    cards: tuple[Card, ...]


@dataclass(frozen=True, slots=True)
class DeckWarning:
    """What a user should know of a card: the place, and either ``words`` or a remark on the number called ``name``."""

    source: str
    card: int
    column: int
    words: str = ""
    name: str = ""
    remark: Remark | None = None

    @property
    def message(self) -> str:
        """One line for a user."""
        said = self.words
        if self.remark is not None:
            said = f"{self.name}: {self.remark.words}" if self.name else f"{self.remark.words}: {self.words}"
        return f"{self.source}: card {self.card}, column {self.column}: {said}"


@dataclass(frozen=True, slots=True)
class CheckedDeck:
    """A deck that was checked: its data sets and what there is to warn about."""

    source: str
    sets: tuple[DataSet, ...]
    warnings: tuple[DeckWarning, ...]

    def deck(self, index: int) -> Deck:
        """One data set as a deck of its own; the cards keep their numbers."""
        return Deck(self.source, self.sets[index].cards)


class TooLong(ValueError):
    """A number of more digits than a card's field holds."""


def coordinate_field(text: str, truncate: bool = False) -> str:
    """A decimal number in the 14 columns of E14.8, as the thesis's data sheet punches it: ``+.20000000E+01``.

    truncate: cut the digits beyond the eighth.  Raises ValueError for a ninth significant digit otherwise, for an
    exponent that is not within -99 to 99 and for what is not a decimal number.
    """
    minus, whole, fraction, exponent = split_decimal(text.strip())
    digits = (whole + fraction).lstrip("0")
    exponent = exponent + len(digits) - len(fraction) if digits else 0
    digits = digits.rstrip("0")
    if len(digits) > COORDINATE.decimals and not truncate:
        raise TooLong(f"{len(digits)} significant digits; a card holds 8")
    if not -99 <= exponent <= 99:
        raise ValueError("out of range: the exponent of a card is -99 to 99")
    power = f"{'-' if exponent < 0 else '+'}{abs(exponent):02d}"
    return f"{'-' if minus else '+'}.{digits[:8].ljust(8, '0')}E{power}"


class UnfitPoint(ValueError):
    """A coordinate that no card holds: point and field counted from 1, why, and whether for its ``digits`` only."""

    def __init__(self, point: int, field: int, why: str, digits: bool) -> None:
        super().__init__(f"point {point}, field {field}: {why}")
        self.point, self.field, self.why, self.digits = point, field, why, digits


def data_deck(points: Sequence[Sequence[str]], source: str, truncate: bool = False) -> Deck:
    """One data set: a card with N, then a card a point.  ``source``: the name of the deck.

    There is one point at least.  truncate: as of ``coordinate_field``.  Raises UnfitPoint, and ValueError for more
    points than N can say.
    """
    if len(points) > MAX_N:
        raise ValueError(f"{len(points)} points; N has two columns, so a deck holds at most {MAX_N}")
    cards = [f"{len(points):2d}"]
    for order, point in enumerate(points, 1):
        fields = []
        for k, text in enumerate(point, 1):
            try:
                fields.append(coordinate_field(text, truncate))
            except ValueError as error:
                raise UnfitPoint(order, k, str(error), isinstance(error, TooLong)) from None
        cards.append("".join(fields))
    return deck_from_lines(source, cards)


def with_epsilon(deck: Deck, epsilon: str) -> Deck:
    """The deck of one data set with e punched after N, as the layer ``epsilon`` reads it.  Raises ValueError."""
    first, *rest = (card.text for card in deck.cards)
    return deck_from_lines(deck.source, [first[: _E_FIRST - 1].ljust(_E_FIRST - 1) + coordinate_field(epsilon), *rest])


def read_coordinates(card: Card, rules: Rules) -> tuple[Read, Read, Read]:
    """x, y and z of a card that was checked, as a machine of these rules reads them."""
    x, y, z = (read_floating(COORDINATE, columns, rules) for _, columns in _fields(card))
    return x, y, z


def exact_points(deck: Deck) -> tuple[dict[int, Point], tuple[str, ...]]:
    """The points of a deck's first data set by the numbers of their cards, and what there is to warn about.

    All digits of a field are taken, where the programs on the machine would cut the ninth.  Raises as ``check``.
    """
    every = check(deck, _RULES)
    notes = []
    if len(every.sets) > 1:
        notes.append(f"{deck.source}: {len(every.sets)} data sets; the first is taken")
    first = check(every.deck(0), _RULES)
    points: dict[int, Point] = {}
    for card in first.sets[0].cards[1:]:
        x, y, z = (_decimal(read) for read in read_coordinates(card, _RULES))
        points[card.number] = (x, y, z)
    return points, (*notes, *(warning.message for warning in first.warnings))


def _decimal(read: Read) -> str:
    if not read.mantissa:
        return "0"
    text = finite_decimal(Fraction(Decimal(read.mantissa).scaleb(read.exponent - _DIGITS)))
    assert text is not None
    return text


def check(deck: Deck, rules: Rules = TRUNCATING.rules, epsilon: bool = False) -> CheckedDeck:
    """Check every data set of a deck; ``epsilon`` says that the programs read e after N.

    Raises CardError for an N that is not a number or not 1 to 51, for a coordinate that is not a number and for an e
    that is not a number or negative, DeckError where the deck ends before N points are there.
    """
    sets: list[DataSet] = []
    warnings: list[DeckWarning] = []
    at = 0
    cards = deck.cards
    while at < len(cards):
        if sets and not any(card.text for card in cards[at:]):
            words = "blank cards after the last data set are not read"
            warnings.append(DeckWarning(deck.source, cards[at].number, 1, words))
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
                words = f"the point of card {first} again; the thesis takes distinct points"
                warnings.append(DeckWarning(deck.source, card.number, 1, words))
        sets.append(DataSet(n, (cards[at], *points)))
        at += 1 + n
    if not sets:
        raise DeckError(f"{deck.source}: the deck is empty")
    return CheckedDeck(deck.source, tuple(sets), tuple(warnings))


def _count(deck: Deck, card: Card, warnings: list[DeckWarning], last: int) -> int:
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
    if number.remark:
        warnings.append(DeckWarning(deck.source, card.number, 1, f"N is {n}", remark=number.remark))
    if card.text[last:].strip():
        words = f"what stands after {'N' if last < _E_FIRST else 'e'} is not read"
        warnings.append(DeckWarning(deck.source, card.number, last + 1, words))
    return n


def _interval(deck: Deck, card: Card, rules: Rules, warnings: list[DeckWarning]) -> None:
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
    if number.remark:
        warnings.append(DeckWarning(deck.source, card.number, _E_FIRST, name="e", remark=number.remark))


def _point(deck: Deck, card: Card, rules: Rules, warnings: list[DeckWarning]) -> tuple[tuple[int, int], ...]:
    """The three numbers of a card, minus zero as zero."""
    numbers = []
    for axis, (first, columns) in zip("xyz", _fields(card), strict=True):
        try:
            number: Read = read_floating(COORDINATE, columns, rules)
        except FieldError as error:
            raise CardError(deck.source, card.number, first, f"{axis}: {error}") from None
        numbers.append((number.mantissa, number.exponent if number.mantissa else 0))
        if number.remark:
            warnings.append(DeckWarning(deck.source, card.number, first, name=axis, remark=number.remark))
    if card.text[_LAST_COLUMN:].strip():
        warnings.append(DeckWarning(deck.source, card.number, _LAST_COLUMN + 1, "what stands after z is not read"))
    return tuple(numbers)


def _fields(card: Card) -> Iterable[tuple[int, str]]:
    """First column and columns of x, y and z."""
    return ((first, card.columns(first, first + 13)) for first in (1, 15, 29))

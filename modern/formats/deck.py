"""Decks of cards with points, the input of Butler's hull programs: write them, check them, and read their points.

A data set is a card with N, the number of points, in columns 1-2, followed by N cards with x, y, z in columns 1-14,
15-28, 29-42 (thesis p. 58-59).  The data sheet of the thesis gives columns 29 to 52 to z, but the FORMAT reads columns
29 to 42.  A deck may hold several data sets.  In a deck for programs that were changed to use a tolerance e (the layer
``epsilon`` of the edition), the first card also holds e in columns 3-16 (OPEN-QUESTIONS 28).
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction

from emulator.errors import ArgumentError, CardError, DeckError
from emulator.language.cards import Card, Deck, deck_from_lines
from emulator.numbers.arithmetic import TRUNCATING, Rules, profile
from emulator.numbers.fields import Field, FieldError, FieldNumber, read_fixed, read_floating
from modern.geometry.numbers import Point, exact_text, finite_decimal, read_epsilon, split_decimal

# The largest number of points for which the arrays of the hull programs have room.
MAX_POINTS = 51
# The largest number that the two columns of N can hold.
MAX_N = 99
COORDINATE = Field("E", 14, 8)
_LAST_COLUMN = 42
_E_FIRST, _E_LAST = 3, 16
_DIGITS = 14
# Arithmetic rules that keep all digits of a field of 14 columns.
_RULES = profile(f"truncating:{_DIGITS}").rules


@dataclass(frozen=True, slots=True)
class DataSet:
    """One point set in a deck: the number of points N, and its cards, of which the first is the card with N."""

    n: int
    cards: tuple[Card, ...]


@dataclass(frozen=True, slots=True)
class DeckWarning:
    """A warning about a card, with the name of the deck and the place."""

    source: str
    card: int
    column: int
    text: str

    @property
    def message(self) -> str:
        """The warning as one line for the user."""
        return f"{self.source}: card {self.card}, column {self.column}: {self.text}"


@dataclass(frozen=True, slots=True)
class CheckedDeck:
    """The result of a check: the data sets of a valid deck, and warnings about its cards."""

    source: str
    sets: tuple[DataSet, ...]
    warnings: tuple[DeckWarning, ...]

    def deck(self, index: int) -> Deck:
        """Return the data set with this index as a deck.

        The cards keep the numbers that they have in the whole deck.
        """
        return Deck(self.source, self.sets[index].cards)


class TooManyDigits(ArgumentError):
    """Raised for a number with more digits than the field of a card holds."""


def coordinate_field(text: str, truncate: bool = False) -> str:
    """Return a decimal number as the 14 columns of a field E14.8, such as ``+.20000000E+01``.

    If ``truncate`` is true, digits after the eighth significant digit are dropped.  If it is false, such digits raise
    TooManyDigits.  Raise ValueError if the text is not a decimal number, or if its exponent is outside -99 to 99.
    """
    minus, whole, fraction, exponent = split_decimal(text.strip())
    digits = (whole + fraction).lstrip("0")
    # On the card, the decimal point is before the first significant digit.
    exponent = exponent + len(digits) - len(fraction) if digits else 0
    digits = digits.rstrip("0")
    if len(digits) > COORDINATE.decimals and not truncate:
        raise TooManyDigits(f"{len(digits)} significant digits; a card holds 8")
    if not -99 <= exponent <= 99:
        raise ArgumentError("out of range: a card's exponent, as in .5E+01, must be -99 to 99")
    power = f"{'-' if exponent < 0 else '+'}{abs(exponent):02d}"
    return f"{'-' if minus else '+'}.{digits[:8].ljust(8, '0')}E{power}"


class UnfitPoint(ArgumentError):
    """Raised for a coordinate that no card can hold.

    ``point`` and ``field`` are the numbers of the point and of the coordinate, from 1, and ``why`` is the reason.
    ``digits`` is True if the only reason is that the number has too many digits.
    """

    def __init__(self, point: int, field: int, why: str, digits: bool) -> None:
        super().__init__(f"point {point}, field {field}: {why}")
        self.point, self.field, self.why, self.digits = point, field, why, digits


def data_deck(points: Sequence[Sequence[str]], source: str, truncate: bool = False) -> Deck:
    """Return a deck of one data set for at least one point.  ``source`` becomes the name of the deck.

    Raise UnfitPoint for a coordinate that no card holds, and ArgumentError for more than 99 points.
    """
    if len(points) > MAX_N:
        raise ArgumentError(
            f"{len(points)} points; the number of points has two columns on its card, so a deck holds at most {MAX_N}"
        )
    cards = [f"{len(points):2d}"]
    for point_number, point in enumerate(points, 1):
        fields = []
        for field_number, text in enumerate(point, 1):
            try:
                fields.append(coordinate_field(text, truncate))
            except ValueError as error:
                raise UnfitPoint(point_number, field_number, str(error), isinstance(error, TooManyDigits)) from None
        cards.append("".join(fields))
    return deck_from_lines(source, cards)


def with_epsilon(deck: Deck, epsilon: object) -> Deck:
    """Return the deck with the tolerance e punched after N, for programs changed to use it (layer ``epsilon``).

    Raise ArgumentError if e does not fit into its columns.
    """
    size = read_epsilon(epsilon)
    if size is None or size[1]:
        raise ArgumentError("epsilon: a card can hold a number e, but not a scaled tolerance rel:E")
    try:
        field = coordinate_field(epsilon if isinstance(epsilon, str) else exact_text(size[0]))
    except ValueError as error:
        raise ArgumentError(f"epsilon: {error}") from None
    first, *rest = (card.text for card in deck.cards)
    return deck_from_lines(deck.source, [first[: _E_FIRST - 1].ljust(_E_FIRST - 1) + field, *rest])


def read_coordinates(card: Card, rules: Rules) -> tuple[FieldNumber, FieldNumber, FieldNumber]:
    """Return x, y and z of a valid card as a machine with these arithmetic rules would read them."""
    x, y, z = (read_floating(COORDINATE, columns, rules) for _, columns in _fields(card))
    return x, y, z


def exact_points(deck: Deck) -> tuple[dict[int, Point], tuple[str, ...]]:
    """Return the points of a deck's first data set, keyed by card number, and warnings.

    All digits of a field are read, whereas the programs would drop those after the eighth digit.
    """
    every = check(deck, _RULES)
    notes = []
    if len(every.sets) > 1:
        notes.append(f"{deck.source}: {len(every.sets)} data sets; only the first one is read")
    first = check(every.deck(0), _RULES)
    points: dict[int, Point] = {}
    for card in first.sets[0].cards[1:]:
        x, y, z = (_decimal(number) for number in read_coordinates(card, _RULES))
        points[card.number] = (x, y, z)
    return points, (*notes, *(warning.message for warning in first.warnings))


def _decimal(number: FieldNumber) -> str:
    if not number.mantissa:
        return "0"
    text = finite_decimal(Fraction(Decimal(number.mantissa).scaleb(number.exponent - _DIGITS)))
    assert text is not None
    return text


def check(deck: Deck, rules: Rules = TRUNCATING.rules, epsilon: bool = False) -> CheckedDeck:
    """Check every data set of a deck.  If ``epsilon`` is true, the card with N may also hold the tolerance e.

    Raise CardError for an invalid coordinate or e, or if N is not from 1 to 51.  Raise DeckError if the deck has fewer
    than N points.
    """
    sets: list[DataSet] = []
    warnings: list[DeckWarning] = []
    at = 0
    cards = deck.cards
    while at < len(cards):
        if sets and not any(card.text for card in cards[at:]):
            message = "the programs do not read the blank cards after the last data set"
            warnings.append(DeckWarning(deck.source, cards[at].number, 1, message))
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
        first_cards: dict[tuple[tuple[int, int], ...], int] = {}
        for card in points:
            first = first_cards.setdefault(_point(deck, card, rules, warnings), card.number)
            if first != card.number:
                message = f"the same point as on card {first}; the thesis requires distinct points"
                warnings.append(DeckWarning(deck.source, card.number, 1, message))
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
        raise CardError(
            deck.source, card.number, 1, f"the number of points, in columns 1-2, is {columns!r}, which is not a number"
        ) from None
    if not columns.strip():
        raise CardError(deck.source, card.number, 1, "the number of points, in columns 1-2, is blank")
    n = number.mantissa
    if not 1 <= n <= MAX_POINTS:
        raise CardError(deck.source, card.number, 1, f"N is {n}; the programs accept 1 to {MAX_POINTS} points")
    if number.remark:
        warnings.append(DeckWarning(deck.source, card.number, 1, f"{number.remark.message}: N is {n}"))
    if card.text[last:].strip():
        message = f"the programs do not read the columns after {'N' if last < _E_FIRST else 'e'}"
        warnings.append(DeckWarning(deck.source, card.number, last + 1, message))
    return n


def _interval(deck: Deck, card: Card, rules: Rules, warnings: list[DeckWarning]) -> None:
    columns = card.columns(_E_FIRST, _E_LAST)
    if not columns.strip():
        return
    try:
        number = read_floating(COORDINATE, columns, rules)
    except FieldError as error:
        raise CardError(deck.source, card.number, _E_FIRST, f"e: {error}") from None
    if number.mantissa < 0:
        message = "the tolerance e is negative, so that no value lies from -e to +e"
        raise CardError(deck.source, card.number, _E_FIRST, message)
    if number.remark:
        warnings.append(DeckWarning(deck.source, card.number, _E_FIRST, f"e: {number.remark.message}"))


def _point(deck: Deck, card: Card, rules: Rules, warnings: list[DeckWarning]) -> tuple[tuple[int, int], ...]:
    """Check the card of a point.  Return mantissa and exponent of its three numbers.  The exponent of a zero is 0."""
    numbers = []
    for axis, (first, columns) in zip("xyz", _fields(card), strict=True):
        try:
            number = read_floating(COORDINATE, columns, rules)
        except FieldError as error:
            raise CardError(deck.source, card.number, first, f"{axis}: {error}") from None
        numbers.append((number.mantissa, number.exponent if number.mantissa else 0))
        if number.remark:
            warnings.append(DeckWarning(deck.source, card.number, first, f"{axis}: {number.remark.message}"))
    if card.text[_LAST_COLUMN:].strip():
        message = "the programs do not read the columns after z"
        warnings.append(DeckWarning(deck.source, card.number, _LAST_COLUMN + 1, message))
    return tuple(numbers)


def _fields(card: Card) -> Iterable[tuple[int, str]]:
    return ((first, card.columns(first, first + 13)) for first in (1, 15, 29))

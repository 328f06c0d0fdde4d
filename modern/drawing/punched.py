"""Draw punched cards: the form, the holes, and the characters that the IBM 026 card punch prints along the top edge.

The scale is 96 pixels to the inch. A card is 7 3/8 by 3 1/4 inches. Holes are .055 by .125 inches, columns are .087
inches apart, and rows .25 inches apart. The first column is .251 inches from the left edge and the first row .250
inches from the top edge (ANSI X3.21-1967, rectangular holes in twelve-row punched cards).
:data:`emulator.language.cards.PUNCHES` holds the codes of the characters: those of the 026 with code plate H (part
362277 of the parts catalog of IBM's 24 and 26 card punches). The printed form is that of IBM's card 5081: each digit is
printed in its row, and the column numbers below the row of nines.
"""

from collections.abc import Iterator

from emulator.errors import DeckError
from emulator.language.cards import COLUMNS, PUNCHES, Card, Deck, check_characters
from modern.drawing import svg
from modern.drawing.layout import Pixel

# The largest number of cards in one picture: the cards of a full box.
MOST_CARDS = 2000

# The rows of holes from the top edge.
ROWS = ("12", "11", *map(str, range(10)))

# An inch in hundredths of a pixel.
_INCH = 9600
# The size of a card in pixels.
WIDTH, HEIGHT = 708, 312
_MARGIN = 12
_HOLE = (528, 1200)
# The cut of the upper left corner: a quarter of an inch along the edge, at 60 degrees to it.
_CUT = Pixel(24_00, 41_57)

_CARD = 'fill="#f2f2f2" stroke="#666" stroke-width="1"'
_HOLES = 'fill="#222"'
_PRINT = 'font-family="Courier New, Courier, monospace" font-size="11" font-weight="bold" fill="#000"'
_FORM = (
    'font-family="Helvetica, Arial, sans-serif" font-size="8" fill="#9a9a9a" text-anchor="middle" aria-hidden="true" '
    'style="user-select:none;-webkit-user-select:none"'
)


def column_centre(column: int) -> int:
    """Return the distance of the centre of a column (1 to 80) from the left edge, in hundredths of a pixel."""
    return (251 + 87 * (column - 1)) * _INCH // 1000


def row_centre(row: str) -> int:
    """Return the distance of a row of holes, given by its name, from the top edge in hundredths of a pixel."""
    return _INCH // 4 * (ROWS.index(row) + 1)


def punches(card: Card) -> list[tuple[int, str]]:
    """Return the holes of a card as pairs of column, counted from 1, and row."""
    codes = ((column, PUNCHES[char]) for column, char in enumerate(card.text, 1))
    return [(column, row) for column, code in codes if code for row in code.split("-")]


def check_punched(deck: Deck) -> None:
    """Raise CardError, with card and column, for the first character that the 026 cannot punch."""
    for card in deck.cards:
        check_characters(deck.source, card.number, card.text)


def cards_svg(deck: Deck, across: int = 1, title: str = "") -> str:
    """Return the cards of a deck as the text of an SVG file, in rows of ``across`` cards from the upper left.

    Raise CardError for a character without a punch and DeckError for more than MOST_CARDS cards.
    """
    if len(deck.cards) > MOST_CARDS:
        raise DeckError(f"{deck.source}: expected at most {MOST_CARDS} cards for one picture, found {len(deck.cards)}")
    check_punched(deck)
    rows = -(-len(deck.cards) // across)
    width = _MARGIN + min(across, len(deck.cards)) * (WIDTH + _MARGIN)
    count = f"{len(deck.cards)} card{'s' * (len(deck.cards) != 1)}"
    description = (
        f"{count} of 80 columns punched in the code of the IBM 026, with the text of each card along its top edge."
    )
    items = ["<defs>", *_form(), "</defs>"]
    for place, card in enumerate(deck.cards):
        x, y = (_MARGIN + place % across * (WIDTH + _MARGIN), _MARGIN + place // across * (HEIGHT + _MARGIN))
        items += _card(card, x, y)
    return svg.page(width, _MARGIN + rows * (HEIGHT + _MARGIN), title or f"{deck.source}: {count}", items, description)


def _form() -> Iterator[str]:
    corner = Pixel(WIDTH * 100, HEIGHT * 100)
    corners = (Pixel(_CUT.x, 0), Pixel(corner.x, 0), corner, Pixel(0, corner.y), Pixel(0, _CUT.y))
    yield f'<g id="form" {_FORM}>'
    yield svg.polygon(corners, _CARD)
    columns = range(1, COLUMNS + 1)
    places = " ".join(svg.number(column_centre(column)) for column in columns)
    for digit in ROWS[2:]:
        yield f'<text x="{places}" y="{svg.number(row_centre(digit) + 290)}">{digit * COLUMNS}</text>'
    for column in (1, *range(5, COLUMNS + 1, 5)):
        yield svg.text(Pixel(column_centre(column), 308_00), str(column), 'font-size="6"')
    yield "</g>"


def _card(card: Card, x: int, y: int) -> Iterator[str]:
    yield f'<g class="card" transform="translate({x} {y})">'
    yield f"<title>card {card.number}</title>"
    yield '<use href="#form"/>'
    wide, high = _HOLE
    holes = "".join(
        f"M{svg.number(column_centre(column) - wide // 2)} {svg.number(row_centre(row) - high // 2)}"
        f"h{svg.number(wide)}v{svg.number(high)}h-{svg.number(wide)}z"
        for column, row in punches(card)
    )
    if holes:
        yield f'<path class="holes" d="{holes}" {_HOLES}/>'
        yield _printed(card.text)
    yield "</g>"


def _printed(text: str) -> str:
    """Return the characters printed on a card, each above its column, as one SVG text."""
    # Each character has the position of its left edge, also a blank. 330 is half the width of a character of this font.
    places = " ".join(svg.number(column_centre(column) - 330) for column in range(1, len(text) + 1))
    return f'<text class="words" xml:space="preserve" x="{places}" y="15" {_PRINT}>{svg.escape(text)}</text>'

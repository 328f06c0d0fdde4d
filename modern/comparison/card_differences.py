"""The differences between punched cards and the exact hull, by point and by face, for a drawing of both."""

from dataclasses import dataclass
from fractions import Fraction

from emulator.errors import EmulatorError
from modern.comparison.difference import disagreement
from modern.comparison.outcome import from_card_hull, from_hull
from modern.geometry.hull import Hull
from modern.thesis.cards import CardHull


class UnrelatedCards(EmulatorError):
    """Cards that do not hold a hull, or that hold the hull of other points; the message is one line."""


@dataclass(frozen=True, slots=True)
class CardDifferences:
    """The vertices that punched cards miss or add, the exact faces that they lack (``not_found``), and false faces.

    ``polygons`` has the vertices that the cards list on each false face. ``others`` counts the false faces with fewer
    than two vertices.
    """

    missed: tuple[int, ...] = ()
    added: tuple[int, ...] = ()
    not_found: tuple[int, ...] = ()
    polygons: tuple[tuple[int, ...], ...] = ()
    others: int = 0


def card_differences(cards: CardHull, hull: Hull, source: str) -> CardDifferences:
    """Return how the cards of the file ``source`` differ from the exact hull. Raise UnrelatedCards for other points."""
    if not cards.vertices:
        raise UnrelatedCards(f"{source}: these cards have no vertices; 'hull1620 hull' punches cards that have them")
    points = [tuple(Fraction(number) for number in point) for point in hull.points]
    outcome = from_card_hull("cards", _program(cards), cards, points)
    if outcome.strange:
        raise UnrelatedCards(
            f"{source}: {outcome.strange} of the points on these cards are not among the points of the file"
        )
    differences = disagreement(outcome, from_hull("exact", hull), points)
    # Reversed, so that the first of several equal points remains.
    indices = {point: index for index, point in reversed(list(enumerate(points)))}
    satisfied = {equation: numbers for numbers, equation in cards.satisfied}
    polygons = []
    for equation_number, match in enumerate(differences.places, 1):
        if match < 0:
            numbers = [n for n in satisfied.get(equation_number, ()) if 1 <= n <= len(cards.vertices)]
            polygons.append(tuple(indices[cards.vertices[n - 1]] for n in numbers))
    drawable = tuple(polygon for polygon in polygons if len(polygon) > 1)
    unmatched = set(range(len(hull.faces))) - set(differences.places)
    return CardDifferences(
        missed=tuple(sorted(differences.missed)),
        added=tuple(sorted(differences.added)),
        not_found=tuple(sorted(unmatched)) if differences.planes_missing else (),
        polygons=drawable,
        others=len(polygons) - len(drawable),
    )


def _program(cards: CardHull) -> str:
    """Return the program that punched the cards: 2 punches a plane and lines, 3 planes, and 1 neither."""
    if not cards.satisfied or not cards.equations:
        return "program1"
    return "program2" if cards.plane else "program3"

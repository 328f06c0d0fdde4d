"""What a punched result says of a hull that is not so, by point and by face: what a picture of both shows."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from emulator.errors import EmulatorError
from modern.comparison.difference import disagreement
from modern.comparison.outcome import from_card_hull, from_hull
from modern.geometry.hull import Hull
from modern.thesis.cards import CardHull


class UnrelatedCards(EmulatorError):
    """Cards that are of no hull, or of the hull of other points; one line."""


@dataclass(frozen=True, slots=True)
class CardDifferences:
    """What differs; points by place in the input, faces that were not found by place in ``Hull.faces``.

    ``polygons`` are the vertices said to be on each face that the hull does not have, of two and more; ``others``
    counts the faces with fewer.
    """

    missed: tuple[int, ...] = ()
    added: tuple[int, ...] = ()
    not_found: tuple[int, ...] = ()
    polygons: tuple[tuple[int, ...], ...] = ()
    others: int = 0


def card_differences(seen: CardHull, hull: Hull, source: str) -> CardDifferences:
    """What the cards of ``source`` say differently from the exact hull of the points.

    Raises UnrelatedCards where they hold no result, or points that are not among those of the hull.
    """
    if not seen.vertices:
        raise UnrelatedCards(f"{source}: there are no vertices on these cards; hull1620 hull punches them")
    points = [tuple(Fraction(number) for number in point) for point in hull.points]
    said = from_card_hull("cards", _program(seen), seen, points)
    if said.strange:
        raise UnrelatedCards(
            f"{source}: {said.strange} of the points on these cards are not among the points of the file"
        )
    found = disagreement(said, from_hull("exact", hull), points)
    where = {point: index for index, point in reversed(list(enumerate(points)))}
    satisfied = {equation: numbers for numbers, equation in seen.satisfied}
    polygons = []
    for k, place in enumerate(found.places, 1):
        if place < 0:
            numbers = [number for number in satisfied.get(k, ()) if 1 <= number <= len(seen.vertices)]
            polygons.append(tuple(where[seen.vertices[number - 1]] for number in numbers))
    known = tuple(polygon for polygon in polygons if len(polygon) > 1)
    not_found = tuple(sorted(set(range(len(hull.faces))) - set(found.places))) if found.planes_missing else ()
    return CardDifferences(
        tuple(sorted(found.missed)), tuple(sorted(found.added)), not_found, known, len(polygons) - len(known)
    )


def _program(seen: CardHull) -> str:
    """The program that punched these cards: 2 gives a plane and lines, 3 planes, 1 what needs neither."""
    if not seen.satisfied or not seen.equations:
        return "program1"
    return "program2" if seen.plane else "program3"

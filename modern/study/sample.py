"""A sample: its points, the deck that holds them, and the exact hull of the points on the cards."""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from emulator.language.cards import Deck
from emulator.numbers.arithmetic import Rules
from modern.comparison.outcome import Outcome, Vector, from_judge
from modern.exact_hull import ExactHull, exact_hull
from modern.formats.deck import data_deck, read_coordinates
from modern.study.families.draws import Drawn

# A number on a card has this number of significant digits.
CARD_DIGITS = 8


@dataclass(frozen=True, slots=True)
class Sample:
    """A sample: its deck, its exact points, and its exact hull.

    outcome: the exact hull in the form used for comparisons.  on: for each plane of the hull, the set of the vertices
    on this plane.
    """

    drawn: Drawn
    deck: Deck
    points: tuple[Vector, ...]
    hull: ExactHull
    outcome: Outcome
    on: tuple[frozenset[int], ...]

    def figures(self) -> dict[str, int]:
        hull = self.hull
        return {
            "n": len(self.points),
            "dimension": hull.dimension,
            "vertices": len(hull.vertices),
            "planes": len(self.outcome.equations),
            "boundary": len(hull.boundary),
            "inside": len(hull.inside),
        }

    def points_read(self, rules: Rules) -> Sequence[Vector]:
        """Return the points as an arithmetic reads them from the cards, truncated to its number of digits."""
        if rules.digits >= CARD_DIGITS:
            return self.points
        points = []
        for card in self.deck.cards[1:]:
            reads = read_coordinates(card, rules)
            points.append(tuple(read.mantissa * Fraction(10) ** (read.exponent - rules.digits) for read in reads))
        return points


def judge(drawn: Drawn, name: str) -> Sample:
    """Return the sample of a point set with its exact hull. Raise ValueError if the points do not fit on cards."""
    deck = data_deck(drawn.points, name)
    points = tuple(tuple(map(Fraction, point)) for point in drawn.points)
    hull = exact_hull(drawn.points)
    outcome = from_judge(hull, points)
    return Sample(drawn, deck, points, hull, outcome, _on(hull))


def _on(hull: ExactHull) -> tuple[frozenset[int], ...]:
    if hull.dimension == 3:
        return tuple(frozenset(facet.polygon) for facet in hull.facets)
    ring = hull.polygon
    return tuple(frozenset(pair) for pair in zip(ring, ring[1:] + ring[:1], strict=True)) if hull.dimension == 2 else ()

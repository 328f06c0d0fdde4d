"""A sample with what the judge says of it: the deck, its numbers as the cards hold them, and the exact hull."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from emulator.language.cards import Deck, deck_from_lines
from emulator.numbers.arithmetic import Rules
from emulator.numbers.fields import read_floating
from modern.comparison.outcome import Outcome, Vector, from_judge
from modern.exact_hull import ExactHull, exact_hull
from modern.formats.csv import deck_lines, e_field, parse_decimal
from modern.study.families.drawing import Drawn
from modern.thesis.deck import COORDINATE

_CARD_DIGITS = 8


@dataclass(frozen=True, slots=True)
class Judged:
    """A sample and the judge's hull of it.

    ``points`` are the exact coordinates (x, y, z) that stand on ``deck``'s cards; ``on`` holds, for each equation of
    the judge's outcome, its vertices.
    """

    drawn: Drawn
    deck: Deck
    points: tuple[Vector, ...]
    hull: ExactHull
    outcome: Outcome
    on: tuple[frozenset[int], ...]

    def figures(self) -> dict[str, int]:
        """The size of the set and of its hull."""
        hull = self.hull
        return {
            "n": len(self.points),
            "dimension": hull.dimension,
            "vertices": len(hull.vertices),
            "planes": len(self.outcome.equations),
            "boundary": len(hull.boundary),
            "inside": len(hull.inside),
        }


def judge(drawn: Drawn, name: str) -> Judged:
    """The deck of a sample, and its exact hull.  Raises DeckError where the points do not fit a deck."""
    deck = deck_from_lines(name, deck_lines(((i, list(p)) for i, p in enumerate(drawn.points, 1)), name))
    points = tuple(tuple(map(Fraction, point)) for point in drawn.points)
    hull = exact_hull(drawn.points)
    outcome = from_judge(hull, points)
    return Judged(drawn, deck, points, hull, outcome, _on(hull))


def with_epsilon(deck: Deck, epsilon: str) -> Deck:
    """The deck with e punched behind N, as the layer ``epsilon`` reads it.  Raises ValueError."""
    first, *rest = (card.text for card in deck.cards)
    return deck_from_lines(deck.source, [first.ljust(2) + e_field(parse_decimal(epsilon), False), *rest])


def held(judged: Judged, rules: Rules) -> Sequence[Vector]:
    """The points as an arithmetic of these rules reads them from the cards: with fewer than eight digits it cuts."""
    if rules[0] >= _CARD_DIGITS:
        return judged.points
    points = []
    for card in judged.deck.cards[1:]:
        reads = (read_floating(COORDINATE, card.columns(first, first + 13), rules) for first in (1, 15, 29))
        points.append(tuple(read.mantissa * Fraction(10) ** (read.exponent - rules[0]) for read in reads))
    return points


def _on(hull: ExactHull) -> tuple[frozenset[int], ...]:
    """The vertices on each equation, in the order :func:`modern.comparison.outcome.from_judge` gives them."""
    if hull.dimension == 3:
        return tuple(frozenset(facet.polygon) for facet in hull.facets)
    ring = hull.polygon
    return tuple(frozenset(pair) for pair in zip(ring, ring[1:] + ring[:1], strict=True)) if hull.dimension == 2 else ()

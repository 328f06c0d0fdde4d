"""Read the cards that the hull programs punch, and compare hulls regardless of order and scale.

Program 1, which runs first, punches an intermediate deck.  Program 2 or 3 reads it and punches the hull.  The cards
follow the FORMATs of the three programs (thesis p. 73-74, 87, 102).  Numbers are exact.
"""

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from emulator.errors import expect
from emulator.machine.result import PUNCH_COLUMNS

Point = tuple[Fraction, ...]

_FLOAT = re.compile(r"-?\.\d+E[+-]\d\d")
_HEADINGS = (
    ("INSIDE POINTS", "inside"),
    ("BOUNDARY POINTS", "boundary"),
    ("ENDPOINTS", "vertices"),
    ("COEFFICIENTS OF AN EQUATION", "plane"),
    ("EQUATIONS OF", "equations"),
)
SECTIONS = ("inside", "boundary", "vertices", "equations", "plane")


@dataclass(frozen=True, slots=True)
class CardHull:
    """A hull read from punched cards.

    ``satisfied`` has pairs: the numbers of some vertices, and the number of an equation that is zero at these vertices.
    All numbers are counted from 1.  ``plane`` has the equation of the plane of a polygon.
    """

    inside: tuple[Point, ...]
    boundary: tuple[Point, ...]
    vertices: tuple[Point, ...]
    equations: tuple[Point, ...]
    satisfied: tuple[tuple[tuple[int, ...], int], ...]
    plane: tuple[Point, ...]


def floats(card: str) -> Point:
    """Return the exact values of the numbers in the E fields of a card.  Minus zero becomes zero."""
    return tuple(map(Fraction, _FLOAT.findall(card)))


@dataclass(frozen=True, slots=True)
class Sections:
    """The numbers on the cards of a hull as text, grouped into sections and rows as the programs punch them."""

    points: Mapping[str, tuple[tuple[str, ...], ...]]
    satisfied: tuple[tuple[int, ...], ...]


def sections(cards: Sequence[str]) -> Sections:
    """Read the cards that the last program of a run punched.  Cards that do not belong to a hull are ignored."""
    rows: dict[str, list[tuple[str, ...]]] = {name: [] for name in SECTIONS}
    satisfied: list[tuple[int, ...]] = []
    section = "vertices"
    # IBM's library of 1962 punches a sequence number behind the columns of the FORMAT, and E-00.
    for card in (card[:PUNCH_COLUMNS].replace("E-00", "E+00") for card in cards):
        text = card.strip()
        heading = next((kind for start, kind in _HEADINGS if text.startswith(start)), "")
        if heading:
            section = heading
        elif text.startswith("VERTICES"):
            section = "satisfied" if "SATISFY" in text else "vertices"
        elif section == "satisfied" and re.fullmatch(r"[\d, ]+", text):
            satisfied.append(tuple(int(n) for n in re.findall(r"\d+", text)))
        elif section in rows and (numbers := _FLOAT.findall(card)):
            rows[section].append(tuple(numbers))
    return Sections({name: tuple(section_rows) for name, section_rows in rows.items()}, tuple(satisfied))


def read_hull(cards: Sequence[str]) -> CardHull:
    """Read the hull on the cards that the last program of a run punched, as exact numbers."""
    expect(cards, (tuple, list), "cards")
    for card in cards:
        expect(card, str, "a card")
    texts = sections(cards)
    inside, boundary, vertices, equations, plane = (
        tuple(tuple(map(Fraction, row)) for row in texts.points[name]) for name in SECTIONS
    )
    satisfied = tuple((numbers[:-1], numbers[-1]) for numbers in texts.satisfied)
    return CardHull(inside, boundary, vertices, equations, satisfied, plane)


def same_hull(first: CardHull, second: CardHull, oriented: bool) -> bool:
    """Return True if two hulls differ only in the order of points and equations and in the scale of equations.

    If ``oriented`` is true, the scale must be positive.
    """
    return _canonical(first, oriented) == _canonical(second, oriented)


def _canonical(hull: CardHull, oriented: bool) -> tuple[object, ...]:
    equations = [scaled(equation, oriented) for equation in hull.equations]
    joins = Counter(
        (
            frozenset(hull.vertices[v - 1] for v in numbers if 0 < v <= len(hull.vertices)),
            equations[e - 1] if 0 < e <= len(equations) else None,
        )
        for numbers, e in hull.satisfied
    )
    return (
        Counter(hull.inside),
        Counter(hull.boundary),
        Counter(hull.vertices),
        Counter(equations),
        joins,
        Counter(scaled(p, False) for p in hull.plane),
    )


def scaled(equation: Point, oriented: bool) -> Point:
    """Divide an equation by its first nonzero coefficient or, if ``oriented``, by the coefficient's absolute value."""
    lead = next((c for c in equation if c), Fraction(1))
    return tuple(c / (abs(lead) if oriented else lead) for c in equation)


@dataclass(frozen=True, slots=True)
class IntermediateDeck:
    """The cards that program 1 punches as input for program 2 or 3.

    ``planes`` has equations, each with the numbers of the points that define it.  ``count`` has N and, for coplanar
    points, KPROJ, the number of the coordinate that the projection drops.
    """

    planes: tuple[tuple[Point, tuple[int, ...]], ...]
    count: tuple[str, ...]
    points: tuple[Point, ...]


def read_intermediate(cards: Sequence[str]) -> IntermediateDeck | None:
    """Read the cards that program 1 punched for program 2 or 3.  Return None if there is no card with N."""
    cards = [card[:PUNCH_COLUMNS] for card in cards]
    for i, card in enumerate(cards):
        if card.strip() and not floats(card):
            planes = tuple((floats(c), tuple(map(int, c[56:].split()))) for c in cards[:i] if len(floats(c)) == 4)
            return IntermediateDeck(planes, tuple(card.split()), tuple(floats(c) for c in cards[i + 1 :]))
    return None


def planes_hold(deck: IntermediateDeck) -> bool:
    """Return True if each plane's equation is zero at the points that its card names, or at all if it names none."""
    unprojected = _unprojected(deck)
    for plane, named in deck.planes:
        points = [unprojected[k - 1] for k in named if 1 <= k <= len(unprojected)] if named else unprojected
        if any(sum(c * x for c, x in zip(plane, (*point, Fraction(1)), strict=True)) for point in points):
            return False
    return True


def _unprojected(deck: IntermediateDeck) -> list[Point]:
    orders = {"1": (2, 0, 1), "2": (0, 2, 1), "3": (0, 1, 2)}
    order = orders.get(deck.count[1], (0, 1, 2)) if len(deck.count) > 1 else (0, 1, 2)
    return [tuple(point[k] for k in order) for point in deck.points if len(point) == 3]

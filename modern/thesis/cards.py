"""Punched results read back, so that two of them can be compared whatever order they are in.

A last program punches a hull; program 1 before it the intermediate deck, which the next one reads.  The cards are
those of the FORMATs of the three programs (thesis p. 73-74, 87, 102).  Numbers are exact.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

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
    """A result as it stands on the cards: points in order, equations in order, and which points satisfy which.

    ``satisfied`` pairs vertex numbers with an equation's number.
    """

    inside: tuple[Point, ...]
    boundary: tuple[Point, ...]
    vertices: tuple[Point, ...]
    equations: tuple[Point, ...]
    satisfied: tuple[tuple[tuple[int, ...], int], ...]
    plane: tuple[Point, ...]


def number(text: str) -> Fraction:
    """The exact value of an E field's text; minus zero is zero."""
    return Fraction(text)


def floats(card: str) -> Point:
    """The floating-point numbers on a card, in order."""
    return tuple(number(text) for text in _FLOAT.findall(card))


@dataclass(frozen=True, slots=True)
class Sections:
    """The numbers of a result as text, section by section; ``satisfied`` are the whole numbers on a card."""

    points: Mapping[str, tuple[tuple[str, ...], ...]]
    satisfied: tuple[tuple[int, ...], ...]


def sections(cards: Sequence[str]) -> Sections:
    """Read the cards a last program punched.  Cards that are none of a hull's are passed over."""
    found: dict[str, list[tuple[str, ...]]] = {name: [] for name in SECTIONS}
    satisfied: list[tuple[int, ...]] = []
    section = "vertices"
    for card in cards:
        words = card.strip()
        heading = next((kind for start, kind in _HEADINGS if words.startswith(start)), "")
        if heading:
            section = heading
        elif words.startswith("VERTICES"):
            section = "satisfied" if "SATISFY" in words else "vertices"
        elif section == "satisfied" and re.fullmatch(r"[\d, ]+", words):
            satisfied.append(tuple(int(n) for n in re.findall(r"\d+", words)))
        elif section in found and (numbers := _FLOAT.findall(card)):
            found[section].append(tuple(numbers))
    return Sections({name: tuple(rows) for name, rows in found.items()}, tuple(satisfied))


def read_hull(cards: Sequence[str]) -> CardHull:
    """The cards of :func:`sections` as exact numbers."""
    read = sections(cards)
    inside, boundary, vertices, equations, plane = (
        tuple(tuple(map(number, row)) for row in read.points[name]) for name in SECTIONS
    )
    satisfied = tuple((numbers[:-1], numbers[-1]) for numbers in read.satisfied)
    return CardHull(inside, boundary, vertices, equations, satisfied, plane)


def same_hull(one: CardHull, other: CardHull, oriented: bool) -> bool:
    """Whether two results say the same in whatever order and scale.

    Points are compared as sets, equations up to a factor (a positive one where ``oriented``: planes and
    lines that program 2 or 3 turned outward), satisfied equations by what they join.
    """
    return _canonical(one, oriented) == _canonical(other, oriented)


def _canonical(hull: CardHull, oriented: bool) -> tuple[object, ...]:
    equations = [scaled(equation, oriented) for equation in hull.equations]
    joins = Counter(
        (
            frozenset(hull.vertices[v - 1] for v in numbers if v <= len(hull.vertices)),
            equations[e - 1] if e <= len(equations) else None,
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
    """An equation divided by its first coefficient that is not zero, or by that coefficient's size."""
    lead = next((c for c in equation if c), Fraction(1))
    return tuple(c / (abs(lead) if oriented else lead) for c in equation)


@dataclass(frozen=True, slots=True)
class IntermediateDeck:
    """What program 1 punches for the next: planes, N's card, and the points after it.

    ``planes`` pairs A, B, C, D with the numbers of the points the card names; ``count`` holds N and, of coplanar
    points, KPROJ.
    """

    planes: tuple[tuple[Point, tuple[int, ...]], ...]
    count: tuple[str, ...]
    points: tuple[Point, ...]


def read_intermediate(cards: Sequence[str]) -> IntermediateDeck | None:
    """The cards program 1 punched for the next; None where no card holds N."""
    for i, card in enumerate(cards):
        if card.strip() and not floats(card):
            planes = tuple((floats(c), tuple(map(int, c[56:].split()))) for c in cards[:i] if len(floats(c)) == 4)
            return IntermediateDeck(planes, tuple(card.split()), tuple(floats(c) for c in cards[i + 1 :]))
    return None


def planes_hold(deck: IntermediateDeck) -> bool:
    """Whether every plane vanishes exactly at the points it names, or at all points where it names none."""
    unprojected = _unprojected(deck)
    for plane, named in deck.planes:
        points = [unprojected[k - 1] for k in named if 1 <= k <= len(unprojected)] if named else unprojected
        if any(sum(c * x for c, x in zip(plane, (*point, Fraction(1)), strict=True)) for point in points):
            return False
    return True


def _unprojected(deck: IntermediateDeck) -> list[Point]:
    """The points as x, y, z: program 1 punches coplanar points with the coordinate KPROJ drops at the end."""
    orders = {"1": (2, 0, 1), "2": (0, 2, 1), "3": (0, 1, 2)}
    order = orders.get(deck.count[1], (0, 1, 2)) if len(deck.count) > 1 else (0, 1, 2)
    return [tuple(point[k] for k in order) for point in deck.points if len(point) == 3]

"""Printed cards against produced cards: a verdict for every device of every example.

What the print proves - numbers, signs, order, words - is kept apart from what it cannot: blank cards and
columns, which the OCR lost and the FORMATs supply.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from modern.thesis.cards import floats, read_hull, same_hull

EXACT, SPACING, ORDER, DIFFERENT = "exact", "exact but for spacing", "exact in another order", "different"

_NUMBER = re.compile(r"[+-]?\.\d+E[+-]\d\d|(?<![A-Z0-9.])\d+")


@dataclass(frozen=True, slots=True)
class Verdict:
    """A verdict on one device.

    ``numbers`` and ``words`` are how many of each the print shows, ``cards`` how many cards carry print,
    ``blank`` how many are blank; ``differences`` are (card, printed, produced), with an empty string where one side
    has no such card; ``same`` says what agrees where the order differs, ``reason`` why it does.
    """

    kind: str
    numbers: int
    words: int
    cards: int
    blank: int
    same: str = ""
    reason: str = ""
    differences: tuple[tuple[int, str, str], ...] = ()

    @property
    def holds(self) -> bool:
        """Whether what the print proves came out, in whatever order."""
        return self.kind != DIFFERENT


def compare(printed: Sequence[str], produced: Sequence[str], final: bool, oriented: bool, reason: str) -> Verdict:
    """The verdict on a device's lines.

    ``final`` cards are a hull's, others an intermediate deck; ``oriented``: see
    :func:`modern.thesis.cards.same_hull`; ``reason`` is given where the order differs.
    """
    tokens = [token for line in printed for token in line.split()]
    numbers = sum(len(_NUMBER.findall(line)) for line in printed)
    words = sum(any(c.isalpha() for c in token) and not _NUMBER.search(token) for token in tokens)
    blank = sum(not line.strip() for line in printed)
    base = (numbers, words, len(printed) - blank, blank)
    if list(printed) == list(produced):
        return Verdict(EXACT, *base)
    differences = _differences(printed, produced)
    if _dense(printed) == _dense(produced):
        return Verdict(SPACING, *base, differences=differences)
    same = _same_results(printed, produced, oriented) if final else _same_deck(printed, produced)
    if same:
        return Verdict(ORDER, *base, same=_agreement(printed, final), reason=reason, differences=differences)
    return Verdict(DIFFERENT, *base, differences=differences)


def _agreement(printed: Sequence[str], final: bool) -> str:
    """What two results in different order have in common, counted."""
    if not final:
        middle = _middle(printed)
        return f"the same {len(middle.points)} points" if middle else ""
    hull = read_hull(printed)
    counts = (
        (len(hull.inside), "inside points"),
        (len(hull.boundary), "boundary points"),
        (len(hull.vertices), "vertices"),
        (len(hull.equations), "equations, up to a factor"),
    )
    return "the same " + ", ".join(f"{n} {what}" for n, what in counts if n)


def _dense(lines: Sequence[str]) -> list[str]:
    return [dense for line in lines if (dense := "".join(line.split()))]


def _words(lines: Sequence[str]) -> Counter[str]:
    """The lines without numbers: headings."""
    return Counter(text for line in lines if (text := " ".join(_NUMBER.sub("", line).replace(",", " ").split())))


def _same_results(printed: Sequence[str], produced: Sequence[str], oriented: bool) -> bool:
    """The same hull under the same headings, and an order that does differ: a lost sign of a zero is no order."""
    one, other = read_hull(printed), read_hull(produced)
    return _words(printed) == _words(produced) and one != other and same_hull(one, other, oriented)


@dataclass(frozen=True, slots=True)
class _Middle:
    """An intermediate deck: the cards before N, N's card, and the points behind it."""

    before: tuple[tuple[tuple[Fraction, ...], tuple[int, ...]], ...]
    count: str
    points: tuple[tuple[Fraction, ...], ...]


def _same_deck(printed: Sequence[str], produced: Sequence[str]) -> bool:
    """The same points under the same N in another order, with planes that fit that order."""
    one, other = _middle(printed), _middle(produced)
    if one is None or other is None or one.points == other.points:
        return False
    return one.count == other.count and Counter(one.points) == Counter(other.points) and _planes_fit(other)


def planes_hold(cards: Sequence[str]) -> bool:
    """Whether every plane of an intermediate deck vanishes exactly at the points it names; true of other decks."""
    middle = _middle(cards)
    return middle is None or _planes_fit(middle)


def _middle(cards: Sequence[str]) -> _Middle | None:
    for i, card in enumerate(cards):
        if card.strip() and not floats(card):
            before = tuple((floats(c), tuple(map(int, c[56:].split()))) for c in cards[:i])
            return _Middle(before, " ".join(card.split()), tuple(floats(c) for c in cards[i + 1 :]))
    return None


def _unprojected(deck: _Middle) -> list[tuple[Fraction, ...]]:
    """The points as x, y, z: program 1 punches coplanar points with the coordinate KPROJ drops at the end."""
    words = deck.count.split()
    orders = {"1": (2, 0, 1), "2": (0, 2, 1), "3": (0, 1, 2)}
    order = orders.get(words[1], (0, 1, 2)) if len(words) > 1 else (0, 1, 2)
    return [tuple(point[k] for k in order) for point in deck.points if len(point) == 3]


def _planes_fit(deck: _Middle) -> bool:
    """Every plane before N vanishes at the points it names, or at all points where it names none."""
    unprojected = _unprojected(deck)
    for plane, named in deck.before:
        if len(plane) != 4:
            continue
        points = [unprojected[k - 1] for k in named if 1 <= k <= len(unprojected)] if named else unprojected
        if any(sum(c * x for c, x in zip(plane, (*point, Fraction(1)), strict=True)) for point in points):
            return False
    return True


def _differences(printed: Sequence[str], produced: Sequence[str]) -> tuple[tuple[int, str, str], ...]:
    longest = max(len(printed), len(produced))
    pairs = (
        (i, printed[i] if i < len(printed) else "", produced[i] if i < len(produced) else "") for i in range(longest)
    )
    return tuple((i + 1, a, b) for i, a, b in pairs if a != b)

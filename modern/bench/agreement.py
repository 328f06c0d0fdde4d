"""The native program's cards beside the emulated ones, deck by deck.

Two decks of cards are *the same* where they are equal but for how a number is printed: a zero before its point, and
the sign and exponent of a number that is zero.  They have *other digits* where, besides, numbers differ by no more
than TOLERANCE of the larger one (doubles round where the 1620 cut eight digits).  Everything else is *another hull*:
another number of points or planes, another order, a refusal.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal
from itertools import pairwise

TOLERANCE = Decimal("1E-6")
HEADING = "CONVEX HULL"
"""The second card of each data set of programs 2 and 3; the first is blank."""

_NUMBER = re.compile(r"[ 0-]\.\d{8}E[+-]\d\d")
_ZERO = " .00000000E-99"


@dataclass(frozen=True, slots=True)
class Agreement:
    """How many decks are the same, have other digits, are another hull; and the first card that differs."""

    same: int
    digits: int
    other: int
    first: str = ""

    def line(self) -> str:
        found = f"{self.same} decks the same, {self.digits} with other last digits, {self.other} another hull"
        return found + (f"; the first: {self.first}" if self.first else "")


def data_sets(cards: Sequence[str]) -> list[list[str]]:
    """What a run over many data sets punched, one list a set."""
    bounds = [*(n - 1 for n, card in enumerate(cards) if card == HEADING and n), len(cards)]
    return [list(cards[a:b]) for a, b in pairwise(bounds)]


def compared(emulated: Sequence[Sequence[str]], native: Sequence[Sequence[str]]) -> Agreement:
    """Judge deck by deck; a deck that one side lacks is another hull."""
    same = digits = other = 0
    first = ""
    for n in range(max(len(emulated), len(native))):
        if n >= min(len(emulated), len(native)):
            other += 1
            first = first or f"deck {n + 1} is missing"
            continue
        ours, theirs = list(map(plain, emulated[n])), list(map(plain, native[n]))
        if ours == theirs:
            same += 1
            continue
        close = len(ours) == len(theirs) and all(map(_close, ours, theirs))
        digits, other = digits + close, other + (not close)
        if not first:
            pairs = [(a, b) for a, b in zip(ours, theirs, strict=False) if a != b]
            a, b = pairs[0] if pairs else (f"{len(ours)} cards", f"{len(theirs)} cards")
            first = f"deck {n + 1} has {a.strip()!r} emulated, {b.strip()!r} native"
    return Agreement(same, digits, other, first)


def plain(card: str) -> str:
    """A card with its numbers printed one way."""
    return _NUMBER.sub(lambda match: _printed(match[0]), card).rstrip()


def _printed(number: str) -> str:
    return _ZERO if number[2:10] == "00000000" else number.replace("0.", " .", 1) if number[0] == "0" else number


def _close(one: str, other: str) -> bool:
    if _NUMBER.sub("#", one) != _NUMBER.sub("#", other):
        return False
    for a, b in zip(_NUMBER.findall(one), _NUMBER.findall(other), strict=True):
        x, y = Decimal(a.strip()), Decimal(b.strip())
        if abs(x - y) > TOLERANCE * max(abs(x), abs(y)):
            return False
    return True

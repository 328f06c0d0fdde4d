"""Compare, deck by deck, the cards that a natively compiled program punches with those of the emulator.

Two results are *the same* if they are equal or differ only in how zeros are written. They have *different digits* if
numbers also differ, but by at most TOLERANCE times the larger number: doubles round, and the 1620 truncates to eight
digits. All other results are *another hull*: the number or the order of points or planes differs, or only one of the
programs rejects the points.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal
from itertools import pairwise, zip_longest

TOLERANCE = Decimal("1E-6")
# The second card of each data set of programs 2 and 3. The first card is blank.
HEADING = "CONVEX HULL"

_NUMBER = re.compile(r"[ -]\.\d{8}E[+-]\d\d")
_ZERO = re.compile(r"[ -]\.00000000E[+-]\d\d")


@dataclass(frozen=True, slots=True)
class Agreement:
    """The numbers of decks with the same result, with different digits and with another hull.

    ``first`` describes the first difference between two results, and is empty if there is none.
    """

    same: int
    digits: int
    different: int
    first: str = ""

    def line(self) -> str:
        summary = f"{self.same} decks the same, {self.digits} with different digits, {self.different} with another hull"
        return summary + (f"; first difference: {self.first}" if self.first else "")


def data_sets(cards: Sequence[str]) -> list[list[str]]:
    """Divide the cards that a run of program 2 or 3 punched into one list for each data set."""
    bounds = [*(n - 1 for n, card in enumerate(cards) if card == HEADING and n), len(cards)]
    return [list(cards[a:b]) for a, b in pairwise(bounds)]


def compare(emulated: Sequence[Sequence[str]], native: Sequence[Sequence[str]]) -> Agreement:
    """Compare the emulator's cards with those of the native program, deck by deck.

    A deck for which the emulator or the native program punched nothing counts as another hull.
    """
    same = digits = different = 0
    first = ""
    for number, (emulated_deck, native_deck) in enumerate(zip_longest(emulated, native), 1):
        if emulated_deck is None or native_deck is None:
            different += 1
            first = first or f"deck {number} is missing"
            continue
        ours, theirs = list(map(plain, emulated_deck)), list(map(plain, native_deck))
        if ours == theirs:
            same += 1
            continue
        close = len(ours) == len(theirs) and all(map(_close, ours, theirs))
        digits, different = digits + close, different + (not close)
        if not first:
            pairs = [(a, b) for a, b in zip(ours, theirs, strict=False) if a != b]
            a, b = pairs[0] if pairs else (f"{len(ours)} cards", f"{len(theirs)} cards")
            first = f"deck {number} has {a.strip()!r} emulated, {b.strip()!r} native"
    return Agreement(same, digits, different, first)


def plain(card: str) -> str:
    """Return a card in which every zero is written in the same way, so that cards can be compared as text."""
    return _ZERO.sub(" .00000000E-99", card).rstrip()


def _close(emulated: str, native: str) -> bool:
    if _NUMBER.sub("#", emulated) != _NUMBER.sub("#", native):
        return False
    for a, b in zip(_NUMBER.findall(emulated), _NUMBER.findall(native), strict=True):
        x, y = Decimal(a.strip()), Decimal(b.strip())
        if abs(x - y) > TOLERANCE * max(abs(x), abs(y)):
            return False
    return True

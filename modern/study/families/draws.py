"""Random numbers for the families: a generator, distinct points, and decimals made from integers."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from random import Random
from typing import TypeVar

from emulator.errors import EmulatorError, quoted
from modern.geometry.numbers import scaled_decimal

T = TypeVar("T")
Point = tuple[str, str, str]
Whole = tuple[int, int, int]
# The number of points of a set, or a pair (least, greatest) between which it is drawn.
Count = int | Sequence[int]

DIGITS = 8
MOST = 51
_TRIES = 200


class FamilyError(EmulatorError):
    """Raised if a family cannot draw points with its parameters, or if points do not fit on a card."""


@dataclass(frozen=True, slots=True)
class Draw:
    """The random generator of a sample, and the index of the sample in its cell."""

    random: Random
    index: int = 0

    def whole(self, low: int, high: int) -> int:
        """Return a random integer from low to high, both included."""
        return self.random.randint(low, high)

    def count(self, n: Count) -> int:
        """Return ``n``, or a random integer from the range ``n``.  Raise FamilyError unless ``n`` is within 1 to 51."""
        low, high = whole_range(n, "n")
        if not 1 <= low <= high <= MOST:
            raise FamilyError(
                f"n is {low}{'' if low == high else f' to {high}'}; the programs accept 1 to {MOST} points"
            )
        return self.whole(low, high)

    def distinct(self, count: int, point: Callable[[], T]) -> list[T]:
        """Return ``count`` distinct points.  Raise FamilyError if too many draws repeat earlier points."""
        points: dict[T, None] = {}
        for _ in range(_TRIES * count):
            if len(points) == count:
                break
            points[point()] = None
        if len(points) < count:
            raise FamilyError(
                f"{_TRIES * count} draws gave only {len(points)} of {count} distinct points; change the parameters"
            )
        return list(points)


@dataclass(frozen=True, slots=True)
class Drawn:
    """A drawn set: its points as decimal text, and tags by which tables can group sets, such as ``kind``."""

    points: tuple[Point, ...]
    tags: Mapping[str, str | int] = field(default_factory=dict)


def drawn(points: Sequence[Whole], places: int = 0, **tags: str | int) -> Drawn:
    """Return a set of points whose coordinates are integers times 10**-places."""
    texts = ([scaled_decimal(coordinate, -places) for coordinate in point] for point in points)
    return Drawn(tuple((x, y, z) for x, y, z in texts), tags)


def whole_range(value: Count, name: str) -> tuple[int, int]:
    """Return the least and the greatest integer of the parameter ``name``, which is one integer or a pair.

    Raise FamilyError for any other value.
    """
    ends = (value, value) if isinstance(value, int) else value
    if not isinstance(ends, list | tuple) or len(ends) != 2 or not all(isinstance(end, int) for end in ends):
        raise FamilyError(
            f"{name}: expected an integer, or a range of two integers such as [4, 20], found {quoted(value)}"
        )
    return ends[0], ends[1]


def size_of(digits: int) -> int:
    """Return the largest integer of the given number of digits.  Raise FamilyError if a card has no room for it."""
    if not isinstance(digits, int) or not 1 <= digits <= DIGITS:
        raise FamilyError(f"digits: expected 1 to {DIGITS}, as many as a card holds, found {digits}")
    return int(10**digits - 1)

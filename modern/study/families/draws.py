"""What every family draws its random numbers with: a generator, distinct points, decimals from whole numbers."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from random import Random
from typing import TypeVar

from emulator.errors import EmulatorError
from modern.geometry.numbers import scaled_decimal

T = TypeVar("T")
Point = tuple[str, str, str]
Whole = tuple[int, int, int]
Count = int | Sequence[int]
"""A number of points, or the least and the greatest between which it is drawn."""

DIGITS = 8
MOST = 51
_TRIES = 200


class FamilyError(EmulatorError):
    """Parameters that give no such points, or points no card holds; one line."""


@dataclass(frozen=True, slots=True)
class Draw:
    """What a sample is drawn with: its generator, and its index within the cell."""

    random: Random
    index: int = 0

    def whole(self, low: int, high: int) -> int:
        """A whole number from low to high, both included."""
        return self.random.randint(low, high)

    def count(self, n: Count) -> int:
        """A number of points.  Raises FamilyError where it is not within 1 to 51."""
        low, high = whole_range(n, "n")
        if not 1 <= low <= high <= MOST:
            raise FamilyError(f"n is {low}{'' if low == high else f' to {high}'}; the programs take 1 to {MOST} points")
        return self.whole(low, high)

    def distinct(self, count: int, point: Callable[[], T]) -> list[T]:
        """``count`` distinct points.  Raises FamilyError where so many are hardly to be found."""
        found: dict[T, None] = {}
        for _ in range(_TRIES * count):
            if len(found) == count:
                break
            found[point()] = None
        if len(found) < count:
            raise FamilyError(f"{count} distinct points were not found in {_TRIES * count} tries")
        return list(found)


@dataclass(frozen=True, slots=True)
class Drawn:
    """A drawn set: points as decimal text, and what a table may group by (``kind``)."""

    points: tuple[Point, ...]
    tags: Mapping[str, str | int] = field(default_factory=dict)


def drawn(points: Sequence[Whole], places: int = 0, **tags: str | int) -> Drawn:
    """Whole numbers times 10**-places, as decimals."""
    return Drawn(tuple((_text(x, places), _text(y, places), _text(z, places)) for x, y, z in points), tags)


def _text(number: int, places: int) -> str:
    return scaled_decimal(number, -places) if places else str(number)


def whole_range(value: Count, name: str) -> tuple[int, int]:
    """A parameter that is a whole number, or the least and the greatest.  Raises FamilyError."""
    ends = (value, value) if isinstance(value, int) else value
    if not isinstance(ends, list | tuple) or len(ends) != 2 or not all(isinstance(end, int) for end in ends):
        raise FamilyError(f"{name} is {value!r}; it is a whole number, or the least and the greatest as [4, 20]")
    return ends[0], ends[1]


def size_of(digits: int) -> int:
    """The largest whole number of so many digits.  Raises FamilyError."""
    if not isinstance(digits, int) or not 1 <= digits <= DIGITS:
        raise FamilyError(f"digits is {digits}; a card holds 1 to {DIGITS}")
    return int(10**digits - 1)

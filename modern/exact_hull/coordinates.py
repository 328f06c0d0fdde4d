"""Read points exactly.  Arrays remain arrays, and floats are scaled to integers only when the integers are accessed.

:class:`Coordinates` also provides the float64 images of the points, with which the filters of the proof compute.
"""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain
from typing import Any, TypeGuard

import numpy as np
from numpy.typing import NDArray

from modern.geometry.hull import LazyMembers, PointTexts
from modern.geometry.numbers import Exact, PointsError, real
from modern.geometry.points import Points, check_array, converted

ExactPoint = tuple[Exact, Exact, Exact]
IntPoint = tuple[int, int, int]
Ints = NDArray[np.int64]
Floats = NDArray[np.float64]
Objects = NDArray[np.object_]

# Three odd numbers.  Equal rows have equal sums of products with them modulo 2**64.
_HASH = np.array([0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9], np.uint64)
# Floats of at least 2**_HUGE are halved _HALVINGS times before their difference is computed.
_HUGE, _HALVINGS = 1000, 64
# These expressions match decimals without an exponent, one on each line, and the digits after their points.  Powers of
# ten up to 10**18 are exact in float64 and in int64.
_DECIMALS = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:\n[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+))*")
_FRACTIONS, _EXACT_POWER = re.compile(r"\.([0-9]*)"), 18
# The largest sum of the numbers of bits of the three sides of the bounding box of small points.
_SMALL_BITS = 48


@dataclass(frozen=True, slots=True)
class Images:
    """The points moved and scaled into a unit box and rounded to float64, for quick tests with proved error bounds.

    A point x has the image u with x = c + s u: ``places`` holds u, ``low`` holds c, and ``shifts`` holds the exponents
    of s.  On each axis, c is the least coordinate, and s is a power of two greater than the difference between the
    largest and the least coordinate.  u is from 0 to 1 and has an error of at most 2**-54, because only the difference
    x - c is rounded.
    """

    low: tuple[int, ...]
    shifts: tuple[int, ...]
    places: Floats

    @property
    def are_small(self) -> bool:
        """True if the scaled points and all values of planes at points are integers below 2**52, exact in float64."""
        return sum(self.shifts) <= _SMALL_BITS

    def exactly(self, place: Floats) -> tuple[IntPoint, int]:
        """Return the exact point that has the image ``place``, as three numerators and their common denominator."""
        pairs = [number.as_integer_ratio() for number in place.tolist()]
        weight = max(under for _, under in pairs)  # powers of two
        x, y, z = (
            low * weight + (over * (weight // under) << shift)
            for (over, under), low, shift in zip(pairs, self.low, self.shifts, strict=True)
        )
        return (x, y, z), weight


class Coordinates(LazyMembers[IntPoint]):
    """Points as integers divided by a common ``scale``.  An instance equals the tuple of its points as integers.

    ``numbers`` (n, 3) holds the integers as int64 or, if they do not fit, as Python integers.  If the input is floats
    whose scaled integers do not fit in int64, ``numbers`` holds the floats, and the integers are computed when they are
    accessed.
    """

    def __init__(self, points: Sequence[IntPoint] | NDArray[Any], scale: int = 1) -> None:
        self.scale = scale
        if isinstance(points, np.ndarray):
            super().__init__(len(points), lambda index: tuple(_integers(points[index], scale).tolist()))
            self.numbers: NDArray[Any] = points
        else:
            super().__init__(len(points), points.__getitem__)
            self._made, self._make = tuple(points), None

    def all(self) -> tuple[IntPoint, ...]:
        if self._make is not None:
            self._made, self._make = tuple(map(tuple, self.integers().tolist())), None
        return self._made

    @cached_property
    def numbers(self) -> NDArray[Any]:
        points = self.all()
        try:
            table = np.fromiter(chain.from_iterable(points), np.int64, 3 * len(points)).reshape(-1, 3)
            if max(int(table.max()), -int(table.min())) < 2**62:
                return table
        except OverflowError:
            pass
        return np.array(points, object)

    @property
    def kind(self) -> str:
        """The type of the numbers: ``i`` for int64, ``O`` for Python integers, ``f`` for floats not yet scaled."""
        return self.numbers.dtype.kind

    def integers(self, indices: Any = slice(None)) -> Objects:
        """Return the points with these indices as Python integers, shape (k, 3)."""
        return _integers(self.numbers[indices], self.scale)

    def floats(self) -> Floats:
        """Return an array (n, 3) of the doubles nearest to the coordinates.

        A coordinate beyond the largest double becomes infinite.
        """
        if self.kind == "f":
            return np.array(self.numbers)
        if self.kind == "i" and self.scale & (self.scale - 1) == 0 and self.scale < 2**_HUGE:
            return np.ldexp(self.numbers.astype(np.float64), 1 - self.scale.bit_length())
        return np.array([[nearest(n, self.scale) for n in row] for row in self.numbers.tolist()])

    def __eq__(self, other: object) -> bool:
        if isinstance(other, Coordinates):
            if self is other:
                return True
            if self.kind == other.kind and (self.kind != "f" or self.scale == other.scale):
                return bool(np.array_equal(self.numbers, other.numbers))
        return super().__eq__(other)

    __hash__ = LazyMembers.__hash__

    @cached_property
    def duplicates(self) -> tuple[tuple[int, int], ...]:
        """Pairs of indices, sorted: a point, and the first point equal to it."""
        if self._make is None or self.kind == "O":
            suspects, rows = list(range(len(self))), list(self.all())
            if len(set(rows)) == len(rows):
                return ()
        else:
            # Points can be equal only if their hashes are.  Most sets have no equal hashes.
            hashes = (self.numbers.view(np.uint64) * _HASH).sum(axis=1, dtype=np.uint64)
            ordered = np.sort(hashes)
            repeated = ordered[1:][ordered[1:] == ordered[:-1]]
            if not repeated.size:
                return ()
            chosen = np.flatnonzero(np.isin(hashes, repeated))
            suspects, rows = chosen.tolist(), list(map(tuple, self.numbers[chosen].tolist()))
        first: dict[Any, int] = {}
        pairs = [(index, first.setdefault(row, index)) for index, row in zip(suspects, rows, strict=True)]
        return tuple(pair for pair in pairs if pair[0] != pair[1])

    def is_least_scale(self) -> bool:
        """Return True if no smaller ``scale`` would make every coordinate an integer."""
        if self.scale == 1:
            return True
        if self.kind == "f":
            half = _shifted(self.numbers, self.scale.bit_length() - 2)
            return bool((half != np.rint(half)).any())
        return math.gcd(int(np.gcd.reduce(self.numbers, axis=None)), self.scale) == 1

    @cached_property
    def images(self) -> Images:
        """The points scaled into a unit box, in float64 (see :class:`Images`)."""
        places = np.empty((len(self), 3))
        lows, shifts = [], []
        for axis, column in enumerate(self.numbers.T):
            power, at_low, at_high = 1 - self.scale.bit_length(), int(column.argmin()), int(column.argmax())
            if self.kind == "f" and abs(column).max() >= 2.0**_HUGE:
                # Different numbers of this size differ so much that the lost bits are below the error bound.
                column, power = np.ldexp(column, -_HALVINGS), power - _HALVINGS
            (low,), (high,) = self.integers(([at_low], axis)).tolist(), self.integers(([at_high], axis)).tolist()
            shift = (high - low).bit_length()
            # Division by a power of two is exact, so only the difference is rounded.
            if self.kind == "i":
                difference = column.view(np.uint64) - column[at_low : at_low + 1].view(np.uint64)
                places[:, axis] = np.ldexp(difference.astype(np.float64), -shift)
            elif self.kind == "f":
                places[:, axis] = np.ldexp(column - column[at_low], -shift - power)
            else:
                places[:, axis] = (column - low) / (1 << shift)
            lows.append(low)
            shifts.append(shift)
        return Images(tuple(lows), tuple(shifts), places)


def _integers(rows: NDArray[Any], scale: int) -> Objects:
    if rows.dtype.kind != "f":
        return np.asarray(rows.astype(object))
    scaled = _shifted(rows, scale.bit_length() - 1)
    if np.isfinite(scaled).all():
        made = list(map(int, scaled.ravel().tolist()))
    else:
        made = [over * (scale // under) for over, under in map(float.as_integer_ratio, rows.ravel().tolist())]
    return np.array(made, object).reshape(rows.shape)


def _shifted(floats: Floats, exponent: int) -> Floats:
    """Return the floats multiplied by 2**exponent.  A number that overflows becomes an infinity."""
    with np.errstate(over="ignore"):
        return np.ldexp(floats, exponent)


def nearest(over: int, under: int) -> float:
    """Return the double nearest to ``over / under``, or an infinity beyond the largest double."""
    try:
        return over / under
    except OverflowError:
        return -math.inf if over < 0 else math.inf


def _plain(points: Any, kind: type) -> TypeGuard[Sequence[Any]]:
    """Return True if the points are a list of tuples or lists of three numbers of the type ``kind``."""
    return (
        isinstance(points, list | tuple)
        and set(map(type, points)) <= {tuple, list}
        and set(map(len, points)) == {3}
        and set(map(type, chain.from_iterable(points))) == {kind}
    )


def read_points(points: Points) -> Coordinates:
    """Return the exact coordinates of every point, in input order.  Raise PointsError for an invalid point."""
    if isinstance(points, Coordinates):
        return points
    if isinstance(points, PointTexts) and points.numbers is not None:
        points = points.numbers
    if isinstance(points, np.ndarray):
        check_array(points)
        kind = points.dtype.kind
        if points.shape[1] == 3 and kind in "iu":
            fits = points.dtype != np.uint64 or int(points.max()) < 2**63
            return Coordinates(np.array(points, np.int64) if fits else points.astype(object))
        if points.shape[1] == 3 and kind == "f" and points.dtype.itemsize <= 8:
            return _from_floats(np.asarray(points, np.float64))
        points = points.tolist()
    if _plain(points, int):
        return Coordinates(tuple(map(tuple, points)))
    if _plain(points, float):
        return _from_floats(np.array(points))
    if _plain(points, str) and (short := _from_short_decimals(points)):
        return short
    exact = read_exact(points)
    scale = math.lcm(*{value.denominator for point in exact for value in point})
    integers = tuple(
        (
            x.numerator * (scale // x.denominator),
            y.numerator * (scale // y.denominator),
            z.numerator * (scale // z.denominator),
        )
        for x, y, z in exact
    )
    return Coordinates(integers, scale)


def _from_short_decimals(points: Sequence[Sequence[str]]) -> Coordinates | None:
    """Return points of decimal strings such as ``"-.25"``, or None for other strings and numbers of many digits."""
    texts = [text for point in points for text in point]
    joined = "\n".join(texts)
    if not _DECIMALS.fullmatch(joined) or joined.count("\n") != len(texts) - 1:
        return None
    places = max(map(len, _FRACTIONS.findall(joined)), default=0)
    numbers = np.array(texts, np.float64) * float(10 ** min(places, _EXACT_POWER))
    # The nearest double and its product with an exact power of ten have a relative error of at most 2**-52, which is
    # less than 1/4 for integers below 10**15.
    if places > _EXACT_POWER or abs(numbers).max() >= 1e15:
        return None
    integers = np.rint(numbers).astype(np.int64)
    divisor = math.gcd(int(np.gcd.reduce(integers)), 10**places)
    return Coordinates((integers // divisor).reshape(-1, 3), 10**places // divisor)


def _from_floats(floats: Floats) -> Coordinates:
    if not np.isfinite(floats).all():
        index, axis = np.argwhere(~np.isfinite(floats))[0].tolist()
        raise PointsError(f"point {index}, coordinate {'xyz'[axis]}: {floats[index, axis]} is not finite")
    exponent = 0
    fractions = floats[floats != np.rint(floats)]
    while fractions.size:
        # Scale the smallest number to an integer.  A larger number has bits below it only within its mantissa, so there
        # are few rounds.
        _, under = fractions[abs(fractions).argmin()].as_integer_ratio()
        exponent = under.bit_length() - 1
        scaled = _shifted(fractions, exponent)
        fractions = fractions[scaled != np.rint(scaled)]
    if abs(floats).max() < np.ldexp(1.0, 62 - exponent):
        return Coordinates(np.ldexp(floats, exponent).astype(np.int64), 1 << exponent)
    return Coordinates(floats + 0.0, 1 << exponent)  # the sum is a copy, in which -0.0 becomes 0.0


def read_exact(points: Points) -> list[ExactPoint]:
    """Return the exact coordinates of every point as integers and fractions.  Raise PointsError for invalid points."""
    return converted(points, real)

"""Read input points exactly, and convert them to the arithmetic that the caller names."""

from collections.abc import Iterable
from itertools import chain

import numpy as np

from emulator.errors import ArgumentError, expect, quoted
from emulator.numbers import RANDOM, numbers
from emulator.numbers.arithmetic import FAMILIES, PROFILES
from modern.geometry.numbers import Exact, PointsError, real
from modern.geometry.points import Points, check_array, converted
from modern.port.arithmetic import Arithmetic, RangeError, Vector
from modern.port.binary import FloatArithmetic, MultiprecisionArithmetic
from modern.port.exact import exact_arithmetic
from modern.port.hosted import HostedArithmetic

# A number, and True if it is a zero with a minus sign.
Read = tuple[Exact, bool]


def read_number(value: object) -> Read:
    """Return the exact value of a coordinate, and True if it is a minus zero.  Raise ValueError if it is no number."""
    number = real(value)
    if number:
        return number, False
    return number, value.strip().startswith("-") if isinstance(value, str) else str(value).startswith("-")


def first_of_equals(keys: Iterable[object]) -> tuple[list[int], tuple[tuple[int, int], ...]]:
    """Return the indices of distinct points, and for each repeated point its index and that of its first occurrence."""
    first_index: dict[object, int] = {}
    duplicates = []
    for index, key in enumerate(keys):
        first = first_index.setdefault(key, index)
        if first != index:
            duplicates.append((index, first))
    return list(first_index.values()), tuple(duplicates)


NAMES = ("exact", "float64", "float32", "mp:BITS", *PROFILES, *FAMILIES, *RANDOM)


def fixed_arithmetic(name: str) -> Arithmetic | None:
    """Return the arithmetic with the given name, or None for ``exact``, which depends on the points."""
    expect(name, str, "arithmetic")
    if name == "exact":
        return None
    if name == "float64":
        return FloatArithmetic(np.float64)
    if name == "float32":
        return FloatArithmetic(np.float32)
    family = name.partition(":")[0]
    if family not in {known.partition(":")[0] for known in NAMES}:
        raise ArgumentError(f"no arithmetic is called {quoted(name)}; choose one of {', '.join(NAMES)}")
    system = numbers(name)
    return MultiprecisionArithmetic(system) if family == "mp" else HostedArithmetic(system)  # type: ignore[arg-type]


def take(points: Points, name: str, wide: bool = False) -> tuple[Arithmetic, Vector]:
    """Return the named arithmetic, and the points as an array of its numbers with the rows x, y and z.

    If ``wide`` is true, exact arithmetic does not use int64.
    """
    arithmetic = fixed_arithmetic(name)
    if isinstance(arithmetic, FloatArithmetic) and isinstance(points, np.ndarray) and points.dtype == arithmetic.dtype:
        return arithmetic, _floats(points)
    read = list(chain.from_iterable(converted(points, read_number)))
    if arithmetic is None:
        arithmetic = exact_arithmetic([value for value, _ in read], wide)
    return arithmetic, _numbers(arithmetic, read)


def _floats(points: Vector) -> Vector:
    check_array(points)
    not_finite = np.flatnonzero(~np.isfinite(points).all(axis=1))
    if not_finite.size:
        raise PointsError(f"point {not_finite[0]}: a coordinate is not finite")
    return np.ascontiguousarray(points.T)


def _numbers(arithmetic: Arithmetic, read: list[Read]) -> Vector:
    numbers = []
    for k, (value, minus) in enumerate(read):
        try:
            numbers.append(arithmetic.number(value, minus))
        except RangeError as error:
            raise PointsError(f"point {k // 3}, coordinate {'xyz'[k % 3]}: {error}") from None
    vector = arithmetic.filled(numbers)
    return np.ascontiguousarray(vector.reshape(-1, 3).T)

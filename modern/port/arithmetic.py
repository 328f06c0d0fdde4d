"""What the procedure asks of an arithmetic: vectors of numbers with + - *, signs, a root, and exact text.

A vector is a numpy array, of floats or of Python objects; the formulas (:mod:`modern.port.formulas`) use its
operators, so that one text of the procedure serves every arithmetic.  A quantity has a *degree*: coordinates
1, coefficients A, B, C of a plane 2 and D 3, since an arithmetic may hold coordinates in a unit of its own.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Sequence
from fractions import Fraction
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from emulator.errors import EmulatorError
from modern.geometry.numbers import Exact

Vector = NDArray[Any]
Scalar = Any
"""One element of a vector."""


class RangeError(EmulatorError, ValueError):
    """A number beyond the range of an arithmetic."""


class Arithmetic(ABC):
    """One way to calculate."""

    dtype: Any = object

    @property
    @abstractmethod
    def name(self) -> str:
        """The name it is asked for by."""

    @abstractmethod
    def number(self, value: Exact, minus: bool = False) -> Scalar:
        """A coordinate as a number of this arithmetic; ``minus``: a zero with a minus sign.  Raises RangeError."""

    def tolerance(self, size: Fraction, degree: int) -> Scalar:
        """A number of that degree to compare values with.  Raises RangeError."""
        return self.number(size)

    @cached_property
    def one(self) -> Scalar:
        return self.tolerance(Fraction(1), 0)

    @abstractmethod
    def quotient(self, value: Scalar, count: int) -> Scalar:
        """A sum of ``count`` coordinates divided by ``count``."""

    @abstractmethod
    def sign(self, values: Vector) -> NDArray[np.int8]:
        """-1, 0 or 1 each, as the three branches of an IF."""

    def within(self, values: Vector, slack: Vector) -> NDArray[np.bool_]:
        """Whether each value lies from -slack to +slack, both included."""
        return np.asarray(self.sign(slack - abs(values)) >= 0)

    @abstractmethod
    def root(self, value: Scalar) -> Scalar:
        """The square root of a number that is not negative."""

    @abstractmethod
    def exact(self, value: Scalar, degree: int) -> Exact:
        """The value, of that degree in the coordinates."""

    @abstractmethod
    def text(self, value: Scalar, degree: int) -> str:
        """The value as exact text; minus zero, where the arithmetic has one, is ``-0``."""

    def exacts(self, values: Vector, degree: int) -> list[Exact]:
        """:meth:`exact` of each."""
        return [self.exact(value, degree) for value in values]

    def texts(self, values: Vector, degree: int) -> list[str]:
        """:meth:`text` of each."""
        return [self.text(value, degree) for value in values]

    def keys(self, coordinates: Vector) -> Iterable[object]:
        """Something for each point that is equal for equal points."""
        return zip(*coordinates.tolist(), strict=True)

    def surely_distinct(self, coordinates: Vector) -> bool:
        """Whether it is plain without looking at the keys that no two points are equal."""
        return False

    def filled(self, values: Sequence[Scalar]) -> Vector:
        """A vector of the numbers given."""
        vector = np.empty(len(values), dtype=self.dtype)
        vector[:] = values
        return vector

    def is_zero(self, value: Scalar) -> bool:
        return not self.sign(self.filled([value]))[0]

    def last_largest(self, values: Vector) -> int:
        """The place of the largest, the last of equals, found by the signs of differences."""
        place, best = 0, values[0]
        for i in range(1, len(values)):
            if self.sign(self.filled([best - values[i]]))[0] <= 0:
                place, best = i, values[i]
        return place

    def descending(self, values: Vector) -> NDArray[np.intp]:
        """Places from the largest to the smallest, of equals the last first."""
        left = list(range(len(values)))
        order = []
        while left:
            order.append(left.pop(self.last_largest(values[left])))
        return np.array(order, np.intp)

    def last_largest_square(self, values: Vector) -> int:
        """The place of the largest square, the last of equals."""
        return self.last_largest(values * values)

    def all_squares_zero(self, values: Vector) -> bool:
        """Whether the sum of the squares is zero."""
        return not self.sign(values * values).any()

    def distances_add_up(self, first: Scalar, second: Scalar, whole: Scalar) -> bool:
        """Whether two distances add up to a third; all three are given as squares."""
        return self.is_zero(self.root(first) + self.root(second) - self.root(whole))

    def farthest(self, o1: Vector, o2: Vector, o3: Vector) -> int:
        """The place of the largest O1**2 + O2**2 + O3**2, the last of equals (thesis p. 15)."""
        return self.last_largest(o1 * o1 + o2 * o2 + o3 * o3)

"""The operations that the procedure requires of an arithmetic: vectors with + - *, signs, a root and exact text.

A vector is a numpy array of floats or of Python objects. The formulas (:mod:`modern.port.formulas`) use its
operators, so that the same code of the procedure serves every arithmetic. A quantity has a *degree*: 1 for
coordinates, 2 for the coefficients A, B, C of a plane and 3 for D. An arithmetic that stores numbers in a scaled unit
needs the degree to convert them.
"""

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
# One element of a vector.
Scalar = Any


class RangeError(EmulatorError, ValueError):
    """A number beyond the range of an arithmetic."""


class Arithmetic(ABC):
    """A number system in which the procedure can run."""

    dtype: Any = object

    @property
    @abstractmethod
    def name(self) -> str:
        """The name that selects this arithmetic."""

    @abstractmethod
    def number(self, value: Exact, minus: bool = False) -> Scalar:
        """Convert a coordinate; ``minus`` marks a zero with a minus sign. Raise RangeError if it does not fit."""

    def tolerance(self, size: Fraction, degree: int) -> Scalar:
        """Convert a tolerance for values of the given degree. Raise RangeError if it does not fit."""
        return self.number(size)

    @cached_property
    def one(self) -> Scalar:
        return self.tolerance(Fraction(1), 0)

    @abstractmethod
    def quotient(self, value: Scalar, count: int) -> Scalar:
        """Divide the sum of ``count`` coordinates by ``count``."""

    @abstractmethod
    def sign(self, values: Vector) -> NDArray[np.int8]:
        """Return -1, 0 or 1 for each value: the three branches of a FORTRAN IF."""

    def within(self, values: Vector, slack: Vector) -> NDArray[np.bool_]:
        """Return True for each value in the closed interval from -slack to +slack."""
        return np.asarray(self.sign(slack - abs(values)) >= 0)

    @abstractmethod
    def root(self, value: Scalar) -> Scalar:
        """Return the square root of a number that is not negative."""

    @abstractmethod
    def exact(self, value: Scalar, degree: int) -> Exact:
        """Return the exact value of a number of the given degree."""

    @abstractmethod
    def text(self, value: Scalar, degree: int) -> str:
        """Return the value as exact text. An arithmetic with a minus zero writes it ``-0``."""

    def exacts(self, values: Vector, degree: int) -> list[Exact]:
        return [self.exact(value, degree) for value in values]

    def texts(self, values: Vector, degree: int) -> list[str]:
        return [self.text(value, degree) for value in values]

    def keys(self, coordinates: Vector) -> Iterable[object]:
        """Yield for each point a hashable key; equal points have equal keys."""
        return zip(*coordinates.tolist(), strict=True)

    def surely_distinct(self, coordinates: Vector) -> bool:
        """Return True only if a quick test proves that no two points are equal."""
        return False

    def filled(self, values: Sequence[Scalar]) -> Vector:
        vector = np.empty(len(values), dtype=self.dtype)
        vector[:] = values
        return vector

    def is_zero(self, value: Scalar) -> bool:
        return not self.sign(self.filled([value]))[0]

    def last_largest(self, values: Vector) -> int:
        """Return the index of the last largest value. Values are compared by the signs of their differences."""
        # The listing's search replaces its candidate when the difference is zero or negative (program 1, 135 and 185;
        # program 3, 122), so the last of equal values wins.
        index, largest = 0, values[0]
        for i in range(1, len(values)):
            if self.sign(self.filled([largest - values[i]]))[0] <= 0:
                index, largest = i, values[i]
        return index

    def descending(self, values: Vector) -> NDArray[np.intp]:
        """Return the indices from the largest value to the smallest; among equals the last comes first."""
        remaining = list(range(len(values)))
        order = []
        while remaining:
            order.append(remaining.pop(self.last_largest(values[remaining])))
        return np.array(order, np.intp)

    def last_largest_square(self, values: Vector) -> int:
        """Return the index of the value with the largest square. Of equal squares, choose the last."""
        return self.last_largest(values * values)

    def all_squares_zero(self, values: Vector) -> bool:
        return not self.sign(values * values).any()

    def distances_add_up(self, first_square: Scalar, second_square: Scalar, total_square: Scalar) -> bool:
        """Return True if the first two distances add up to the third. All three are given as squares."""
        return self.is_zero(self.root(first_square) + self.root(second_square) - self.root(total_square))

    def farthest(self, o1: Vector, o2: Vector, o3: Vector) -> int:
        """Return the index of the last largest O1**2 + O2**2 + O3**2 (thesis p. 15)."""
        return self.last_largest(o1 * o1 + o2 * o2 + o3 * o3)

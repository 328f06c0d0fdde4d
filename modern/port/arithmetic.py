"""The operations that Butler's procedure needs from an arithmetic, such as + - * of vectors, signs and square roots.

A vector is a numpy array of floats or of Python objects. The formulas below use the operators of vectors, so that the
same code of the procedure serves every arithmetic. A quantity is a sum of products of coordinates. Its *degree* is the
number of coordinates in each product: 1 for coordinates, 2 for the coefficients A, B, C of a plane and 3 for D. An
arithmetic that stores numbers in a scaled unit needs the degree to convert them.
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
    """Raised for a number that is too large or too small for an arithmetic."""


class Arithmetic(ABC):
    """The base class of the arithmetics in which Butler's procedure can run."""

    dtype: Any = object

    @property
    @abstractmethod
    def name(self) -> str:
        """The name by which a user selects this arithmetic, for example ``float64``."""

    @abstractmethod
    def number(self, value: Exact, minus: bool = False) -> Scalar:
        """Convert a coordinate to this arithmetic.

        ``minus`` is True for minus zero.  Raise RangeError if the coordinate is too large.
        """

    def tolerance(self, size: Fraction, degree: int) -> Scalar:
        """Convert the tolerance ``size`` to a number that can be compared with quantities of degree ``degree``.

        The degree of a quantity is the number of coordinates that are multiplied in it.  Raise RangeError if the
        tolerance is too large.
        """
        return self.number(size)

    @cached_property
    def one(self) -> Scalar:
        return self.tolerance(Fraction(1), 0)

    @abstractmethod
    def quotient(self, value: Scalar, count: int) -> Scalar:
        """Divide ``value``, a sum of ``count`` coordinates, by ``count``."""

    def sign(self, values: Vector) -> NDArray[np.int8]:
        """Return -1, 0 or 1 for each value: the three branches of a FORTRAN IF."""
        return np.asarray(values > 0, dtype=np.int8) - np.asarray(values < 0, dtype=np.int8)

    def within(self, values: Vector, slack: Vector) -> NDArray[np.bool_]:
        """Return, for each value, True if it lies in the closed interval from -slack to +slack."""
        return np.asarray(abs(values) <= slack, dtype=np.bool_)

    @abstractmethod
    def root(self, value: Scalar) -> Scalar:
        """Return the square root of a number that is not negative."""

    @abstractmethod
    def exact(self, value: Scalar, degree: int) -> Exact:
        """Return the exact value of a number of this arithmetic.

        ``degree`` is the number of coordinates that are multiplied in ``value``.
        """

    @abstractmethod
    def text(self, value: Scalar, degree: int) -> str:
        """Return the exact value of a number as text, or ``-0`` for minus zero.

        ``degree`` is the number of coordinates that are multiplied in ``value``.
        """

    def exacts(self, values: Vector, degree: int) -> list[Exact]:
        return [self.exact(value, degree) for value in values]

    def texts(self, values: Vector, degree: int) -> list[str]:
        return [self.text(value, degree) for value in values]

    def keys(self, coordinates: Vector) -> Iterable[object]:
        """Yield a hashable key for each point, such that equal points have equal keys."""
        return zip(*coordinates.tolist(), strict=True)

    def surely_distinct(self, coordinates: Vector) -> bool:
        """Return True if a quick test proves that all points differ.  False proves nothing."""
        return False

    def filled(self, values: Sequence[Scalar]) -> Vector:
        vector = np.empty(len(values), dtype=self.dtype)
        vector[:] = values
        return vector

    def is_zero(self, value: Scalar) -> bool:
        return bool(value == 0)

    def last_largest(self, values: Vector) -> int:
        """Return the index of the largest value, or the last such index if several are equal."""
        # The listing's search replaces its candidate when the difference is zero or negative (program 1, 135 and 185;
        # program 3, 122), so the last of equal values wins.
        return len(values) - 1 - int(np.argmax(values[::-1]))

    def descending(self, values: Vector) -> NDArray[np.intp]:
        """Return the indices that sort the values from largest to smallest.  Of equal values the last comes first."""
        return np.argsort(values, kind="stable")[::-1]

    def last_largest_square(self, values: Vector) -> int:
        """Return the index of the value whose square is largest, or the last of several such indices."""
        return self.last_largest(values * values)

    def all_squares_zero(self, values: Vector) -> bool:
        return not self.sign(values * values).any()

    def distances_add_up(self, first_square: Scalar, second_square: Scalar, total_square: Scalar) -> bool:
        """Return True if the first two distances add up to the third.  The arguments are their squares."""
        return self.is_zero(self.root(first_square) + self.root(second_square) - self.root(total_square))

    def farthest(self, o1: Vector, o2: Vector, o3: Vector) -> int:
        """Return the index of the largest O1**2 + O2**2 + O3**2 (see :func:`moments`), or the last such index."""
        return self.last_largest(o1 * o1 + o2 * o2 + o3 * o3)


# ``Number`` stands for a number or a vector of an arithmetic.  The functions below are formulas of chapter 3, in the
# listing's order of operations.
#
# In ``a op b`` the left operand is the accumulator.  The compiler computes a product in the accumulator and then adds
# the sum t to it, so ``t + a*b`` of the listing is written ``a*b + t`` here.  It computes ``t - a*b`` as the product
# less t with the sign reversed (``less``).  Therefore such a difference is minus zero if the operands cancel
# (emulator/language/expressions.py).
Number = Any
Point = tuple[Number, Number, Number]


def less(total: Number, product: Number) -> Number:
    """Return ``total - product`` as the 1620's compiler computes it, as ``-(product - total)``."""
    return -(product - total)


def plane(p: Point, q: Point, r: Point) -> tuple[Number, Number, Number, Number]:
    """Return the coefficients A, B, C, D of the plane through three points: equations (3.4), thesis p. 16."""
    (xi, yi, zi), (xj, yj, zj), (xk, yk, zk) = p, q, r
    # Each coefficient is a sum of six products. The listing adds the three positive products first (AA, BB, CC and DD
    # after statement 130 of program 3) and then subtracts the three negative ones one by one.
    a = less(less(less(zi * yk + (yj * zk + yi * zj), yk * zj), yi * zk), yj * zi)
    b = less(less(less(xj * zi + (xi * zk + xk * zj), xi * zj), xj * zk), xk * zi)
    c = less(less(less(yi * xk + (xj * yk + xi * yj), yj * xk), xi * yk), xj * yi)
    d = xj * yi * zk + (yk * zj * xi + xk * yj * zi)
    d = less(less(less(d, xi * yj * zk), xj * yk * zi), yi * zj * xk)
    return a, b, c, d


def line(u1: Number, v1: Number, u2: Number, v2: Number, cu: Number, cv: Number) -> tuple[Number, Number, Number]:
    """Return A, B, C of the line A u + B v + C = 0 through two points (thesis equations 3.1 to 3.5).

    The constant C is computed from the point (cu, cv), which is one of the two.
    """
    return v2 - v1, u1 - u2, (v1 - v2) * cu + (u2 - u1) * cv


def at(equation: tuple[Number, ...], point: tuple[Number, ...]) -> Number:
    """Return the value of a plane's or line's equation at a point: A x + B y + C z + D, or A x + B y + C."""
    # The listing adds from left to right, the constant term last.
    total = equation[0] * point[0]
    for k in range(1, len(point)):
        total = equation[k] * point[k] + total
    return total + equation[-1]


def moments(points: Point, p: Point, q: Point) -> tuple[Number, Number, Number]:
    """Return O1, O2, O3, the sum of whose squares grows with the distance of a point from a line (thesis p. 15).

    The line goes through ``p`` and ``q``, the points P1 and P2 of the thesis.
    """
    (x, y, z), (x1, y1, z1), (x2, y2, z2) = points, p, q
    # Statements 125 to 226 of program 1: the components of the cross product of P2 - P and P2 - P1.
    o1 = less((y2 - y) * (z2 - z1), (z2 - z) * (y2 - y1))
    o2 = less((z2 - z) * (x2 - x1), (x2 - x) * (z2 - z1))
    o3 = less((x2 - x) * (y2 - y1), (y2 - y) * (x2 - x1))
    return o1, o2, o3


def distance_squared(u1: Number, v1: Number, u2: Number, v2: Number) -> Number:
    """Return the squared distance of two points in the plane, (u1 - u2)**2 + (v1 - v2)**2 (thesis p. 27)."""
    u, v = u1 - u2, v1 - v2
    return v * v + u * u

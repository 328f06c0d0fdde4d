"""The data of Butler's procedure: a table of points in their current order, and a table of plane or line equations."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from modern.port.arithmetic import Arithmetic, Scalar, Vector, at


@dataclass
class PointTable:
    """The points in the current order of the procedure: their coordinates, shape (3, n), and their input indices."""

    coordinates: Vector
    input_index: NDArray[np.int64]

    def __len__(self) -> int:
        return int(self.coordinates.shape[1])

    @property
    def rows(self) -> tuple[Vector, Vector, Vector]:
        return self.coordinates[0], self.coordinates[1], self.coordinates[2]

    def at(self, index: int) -> tuple[Scalar, Scalar, Scalar]:
        return self.coordinates[0, index], self.coordinates[1, index], self.coordinates[2, index]

    def several(self, indices: NDArray[np.int64]) -> tuple[Vector, Vector, Vector]:
        selected = self.coordinates[:, indices]
        return selected[0], selected[1], selected[2]

    def swap(self, first: int, second: int) -> None:
        if first != second:
            self.coordinates[:, [first, second]] = self.coordinates[:, [second, first]]
            self.input_index[[first, second]] = self.input_index[[second, first]]

    def keep(self, mask: NDArray[np.bool_]) -> list[int]:
        """Remove the points for which ``mask`` is False.  Return their input indices in the order of this table."""
        removed: list[int] = self.input_index[~mask].tolist()
        self.coordinates = self.coordinates[:, mask]
        self.input_index = self.input_index[mask]
        return removed

    def input_indices(self, positions: slice | Sequence[int] | NDArray[np.int64]) -> tuple[int, ...]:
        """Return the indices that the points at the given positions of this table have in the input."""
        selection = positions if isinstance(positions, slice) else np.asarray(positions, np.int64)
        return tuple(self.input_index[selection].tolist())


# The number of values of equations at points that are computed at a time.
_BLOCK = 1 << 16


@dataclass(frozen=True)
class Slack:
    """The tolerance e of the thesis's chapter 7: values from -e to +e count as zero (p. 117).

    ``size`` is e. If ``relative`` is true, e is multiplied by the largest coefficient A, B or C of the equation.
    """

    arithmetic: Arithmetic
    size: Fraction
    relative: bool

    def of(self, coefficients: tuple[Vector, ...]) -> Vector:
        """Return the tolerance e of each plane equation. ``coefficients`` has the rows A, B, C and constant term."""
        arithmetic = self.arithmetic
        degree = 1 if self.relative else len(coefficients) - 1
        e = arithmetic.filled([arithmetic.tolerance(self.size, degree)] * len(coefficients[0]))
        if not self.relative:
            return e
        # The constant term is excluded: the scale of an equation is that of its normal vector.
        largest: Vector = abs(coefficients[0])
        for coefficient in coefficients[1:-1]:
            size: Vector = abs(coefficient)
            largest = np.where(arithmetic.sign(size - largest) > 0, size, largest)
        product: Vector = e * largest
        return product


def snapped(arithmetic: Arithmetic, values: Vector, slack: Vector | None) -> Vector:
    """Return the values, with each value from -slack to +slack replaced by zero."""
    if slack is None:
        return values
    return np.where(arithmetic.within(values, slack), arithmetic.filled([arithmetic.number(0)])[0], values)


@dataclass
class Equations:
    """The equations of planes or lines, one in each column, in the order of the procedure.

    ``coefficients`` has the rows A, B, C (for lines A, B) and the constant term. ``defining`` has the points that
    define each equation, called MM, NN and KK in the listing. ``serial`` has the serial number of each equation, which
    never changes, and ``made`` is the number of equations made so far.
    """

    arithmetic: Arithmetic
    slack: Slack | None
    coefficients: Vector
    defining: NDArray[np.int64]
    serial: NDArray[np.int64] = field(init=False)
    tolerances: Vector | None = field(init=False)
    made: int = field(init=False)

    def __post_init__(self) -> None:
        self.made = len(self)
        self.serial = np.arange(self.made)
        self.tolerances = self.slack.of(tuple(self.coefficients)) if self.slack else None

    def __len__(self) -> int:
        return int(self.coefficients.shape[1])

    def replace(
        self,
        retained: NDArray[np.bool_],
        coefficients: Vector,
        defining: NDArray[np.int64],
        selected: NDArray[np.bool_],
    ) -> None:
        """Keep the equations for which ``retained`` is True, and append the new equations that ``selected`` marks."""
        # The listing closes up a deleted equation at once (statements 157 and 158 of program 3).
        fresh = coefficients[:, selected]
        if self.slack and self.tolerances is not None:
            self.tolerances = np.concatenate([self.tolerances[retained], self.slack.of(tuple(fresh))])
        count = fresh.shape[1]
        columns = np.flatnonzero(retained)
        self.coefficients = np.concatenate([self.coefficients.take(columns, axis=1), fresh], axis=1)
        self.defining = np.concatenate([self.defining.take(columns, axis=1), defining[:, selected]], axis=1)
        self.serial = np.concatenate([self.serial.take(columns), np.arange(self.made, self.made + count)])
        self.made += count

    def keep(self, mask: NDArray[np.bool_]) -> None:
        self.coefficients = self.coefficients[:, mask]
        self.defining = self.defining[:, mask]
        self.serial = self.serial[mask]
        if self.tolerances is not None:
            self.tolerances = self.tolerances[mask]

    def one_at(self, equation: int, points: tuple[Vector, ...]) -> Vector:
        values = at(tuple(self.coefficients[:, equation]), points)
        slack = None if self.tolerances is None else self.tolerances[equation]
        return snapped(self.arithmetic, values, slack)

    def all_at(self, point: tuple[Scalar, ...]) -> Vector:
        return snapped(self.arithmetic, at(tuple(self.coefficients), point), self.tolerances)

    def values(self, coefficients: Vector, point: tuple[Scalar, ...]) -> Vector:
        """Return the values of the given equations at one point."""
        slack = self.slack.of(tuple(coefficients)) if self.slack else None
        return snapped(self.arithmetic, at(tuple(coefficients), point), slack)

    def signs(self, points: Vector, first: int = 0) -> NDArray[np.int8]:
        """Return the signs of the equations from index ``first`` on (rows) at the given points (columns)."""
        table = self.coefficients[:, first:, None]
        count = len(table) - 1
        slack = None if self.tolerances is None else self.tolerances[first:, None]
        parts = [
            self.arithmetic.sign(snapped(self.arithmetic, at(tuple(table), tuple(block[:count, None])), slack))
            for block in self._blocks(points, table.shape[1])
        ]
        return np.concatenate(parts, axis=1) if parts else np.empty((table.shape[1], 0), np.int8)

    def satisfied(self, points: Vector) -> list[NDArray[np.int64]]:
        """Return, for each equation, the indices of the points (columns of ``points``) that satisfy it, in order."""
        incidences = []
        start = 0
        for block in self._blocks(points, len(self)):
            # The blocks are visited in the order of the points, so a stable sort by equation keeps that order.
            equation, point = np.nonzero(self.signs(block) == 0)
            incidences.append((equation, point + start))
            start += block.shape[1]
        equations = np.concatenate([equation for equation, _ in incidences])
        order = np.argsort(equations, kind="stable")
        satisfying = np.concatenate([point for _, point in incidences])[order]
        return np.split(satisfying, np.cumsum(np.bincount(equations, minlength=len(self)))[:-1])

    @staticmethod
    def _blocks(points: Vector, equations: int) -> Iterator[Vector]:
        # The values are computed in blocks, so that memory stays bounded whatever the number of equations and points.
        width = max(1, _BLOCK // max(1, equations))
        for start in range(0, points.shape[1], width):
            yield points[:, start : start + width]


def turned(
    arithmetic: Arithmetic, coefficients: Vector, centre: tuple[Scalar, ...] | None
) -> tuple[Vector, NDArray[np.bool_]]:
    """Return the equations. Those whose value at the inside point C is positive are multiplied by -1.

    Also return a mask of the equations whose value at C is zero. ``centre`` is None if the origin was moved to C. The
    constant term is then the value at C (thesis p. 118).
    """
    values = coefficients[-1] if centre is None else at(tuple(coefficients), centre)
    signs = arithmetic.sign(values)
    # The listing multiplies by -1., which the machine computes as the product with 1. and a reversed sign, so that a
    # zero becomes minus zero (program 1, 205; program 3, 134; program 2 likewise for lines).
    negated = -(coefficients[:, signs > 0] * arithmetic.one)
    result = coefficients.copy()
    result[:, signs > 0] = negated
    return result, signs == 0

"""What the construction works on: the points in their places, and the table of equations of planes or lines."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from modern.port.arithmetic import Arithmetic, Scalar, Vector
from modern.port.formulas import at


@dataclass
class Places:
    """Coordinates by place, from 0, in three rows; ``who`` names the point of the input in each place."""

    coordinates: Vector
    who: NDArray[np.int64]

    def __len__(self) -> int:
        return int(self.coordinates.shape[1])

    @property
    def rows(self) -> tuple[Vector, Vector, Vector]:
        return self.coordinates[0], self.coordinates[1], self.coordinates[2]

    def at(self, place: int) -> tuple[Scalar, Scalar, Scalar]:
        """The coordinates of one point."""
        return self.coordinates[0, place], self.coordinates[1, place], self.coordinates[2, place]

    def several(self, places: NDArray[np.int64]) -> tuple[Vector, Vector, Vector]:
        """The coordinates of several points, in vectors."""
        found = self.coordinates[:, places]
        return found[0], found[1], found[2]

    def swap(self, one: int, other: int) -> None:
        if one != other:
            self.coordinates[:, [one, other]] = self.coordinates[:, [other, one]]
            self.who[[one, other]] = self.who[[other, one]]

    def keep(self, wanted: NDArray[np.bool_]) -> list[int]:
        """Leave out the points not wanted, the rest closing up; returns who they were, in order of place."""
        gone: list[int] = self.who[~wanted].tolist()
        self.coordinates = self.coordinates[:, wanted]
        self.who = self.who[wanted]
        return gone

    def names(self, places: slice | Sequence[int] | NDArray[np.int64]) -> tuple[int, ...]:
        """Who stands in the places given."""
        chosen = places if isinstance(places, slice) else np.asarray(places, np.int64)
        return tuple(self.who[chosen].tolist())


_BLOCK = 1 << 16
"""Numbers of a matrix, equations by points, worked on at a time."""


@dataclass(frozen=True)
class Slack:
    """Chapter 7's interval from -e to +e (thesis p. 117).

    ``size`` is e itself, or, where ``relative``, the e of an equation whose largest coefficient A, B or C is 1: then
    a point is within e (times at most the square root of 3) of the plane.
    """

    arithmetic: Arithmetic
    size: Fraction
    relative: bool

    def of(self, coefficients: tuple[Vector, ...]) -> Vector:
        """The e of each equation; ``coefficients`` are A, B (, C) and the constant, vectors."""
        arithmetic = self.arithmetic
        degree = 1 if self.relative else len(coefficients) - 1
        e = arithmetic.filled([arithmetic.tolerance(self.size, degree)] * len(coefficients[0]))
        if not self.relative:
            return e
        largest: Vector = abs(coefficients[0])
        for coefficient in coefficients[1:-1]:
            other: Vector = abs(coefficient)
            largest = np.where(arithmetic.sign(other - largest) > 0, other, largest)
        product: Vector = e * largest
        return product


def snapped(arithmetic: Arithmetic, values: Vector, slack: Vector | None) -> Vector:
    """The values with those within the slack replaced by zero."""
    if slack is None:
        return values
    return np.where(arithmetic.within(values, slack), arithmetic.filled([arithmetic.number(0)])[0], values)


@dataclass
class Equations:
    """The table: a column an equation, in the order the procedure keeps them.

    ``coefficients``: the rows A, B (, C) and the constant; ``defining``: the places MM, NN (, KK); ``serial``: a
    number that stays with an equation when others are struck.
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
        self, kept: NDArray[np.bool_], coefficients: Vector, defining: NDArray[np.int64], wanted: NDArray[np.bool_]
    ) -> None:
        """Strike the equations not kept, the rest closing up, and put those wanted of the new ones at the end."""
        fresh = coefficients[:, wanted]
        if self.slack and self.tolerances is not None:
            self.tolerances = np.concatenate([self.tolerances[kept], self.slack.of(tuple(fresh))])
        count = fresh.shape[1]
        places = np.flatnonzero(kept)
        self.coefficients = np.concatenate([self.coefficients.take(places, axis=1), fresh], axis=1)
        self.defining = np.concatenate([self.defining.take(places, axis=1), defining[:, wanted]], axis=1)
        self.serial = np.concatenate([self.serial.take(places), np.arange(self.made, self.made + count)])
        self.made += count

    def keep(self, wanted: NDArray[np.bool_]) -> None:
        """Strike the equations not wanted, the rest closing up."""
        self.coefficients = self.coefficients[:, wanted]
        self.defining = self.defining[:, wanted]
        self.serial = self.serial[wanted]
        if self.tolerances is not None:
            self.tolerances = self.tolerances[wanted]

    def one_at(self, equation: int, points: tuple[Vector, ...]) -> Vector:
        """The values of one equation at points."""
        found = at(tuple(self.coefficients[:, equation]), points)
        slack = None if self.tolerances is None else self.tolerances[equation]
        return snapped(self.arithmetic, found, slack)

    def all_at(self, point: tuple[Scalar, ...]) -> Vector:
        """The values of all equations at one point."""
        return snapped(self.arithmetic, at(tuple(self.coefficients), point), self.tolerances)

    def values(self, coefficients: Vector, point: tuple[Scalar, ...]) -> Vector:
        """The values at one point of equations not in the table."""
        slack = self.slack.of(tuple(coefficients)) if self.slack else None
        return snapped(self.arithmetic, at(tuple(coefficients), point), slack)

    def signs(self, points: Vector, first: int = 0) -> NDArray[np.int8]:
        """Signs of the equations from ``first`` on (rows) at points (columns; their coordinates are rows)."""
        table = self.coefficients[:, first:, None]
        count = len(table) - 1
        slack = None if self.tolerances is None else self.tolerances[first:, None]
        parts = [
            self.arithmetic.sign(snapped(self.arithmetic, at(tuple(table), tuple(block[:count, None])), slack))
            for block in self._blocks(points, table.shape[1])
        ]
        return np.concatenate(parts, axis=1) if parts else np.empty((table.shape[1], 0), np.int8)

    def satisfied(self, points: Vector) -> list[NDArray[np.int64]]:
        """For each equation the points (columns) that satisfy it, in order."""
        pairs = []
        start = 0
        for block in self._blocks(points, len(self)):
            equation, point = np.nonzero(self.signs(block) == 0)
            pairs.append((equation, point + start))
            start += block.shape[1]
        equations = np.concatenate([equation for equation, _ in pairs])
        order = np.argsort(equations, kind="stable")
        found = np.concatenate([point for _, point in pairs])[order]
        return np.split(found, np.cumsum(np.bincount(equations, minlength=len(self)))[:-1])

    @staticmethod
    def _blocks(points: Vector, equations: int) -> Iterator[Vector]:
        width = max(1, _BLOCK // max(1, equations))
        for start in range(0, points.shape[1], width):
            yield points[:, start : start + width]


def turned(
    arithmetic: Arithmetic, coefficients: Vector, centre: tuple[Scalar, ...] | None
) -> tuple[Vector, NDArray[np.bool_]]:
    """The equations (columns) turned, and which of them have the value zero at C.

    ``centre`` is None where the origin was moved to C: then the constant term tells (thesis p. 118).  No epsilon
    applies: C is not a given point.
    """
    values = coefficients[-1] if centre is None else at(tuple(coefficients), centre)
    signs = arithmetic.sign(values)
    # The listing multiplies by -1.: the product with 1., its sign reversed, so that a zero comes out as minus zero.
    reversed_ = -(coefficients[:, signs > 0] * arithmetic.one)
    result = coefficients.copy()
    result[:, signs > 0] = reversed_
    return result, signs == 0

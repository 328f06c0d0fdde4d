"""The hull of coplanar points, program 2 (thesis p. 17-28, listing p. 79-87).

Comments give statement labels.  Places count from 0 here, from 1 in the listing.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from modern.geometry.hull import NOT_ACCEPTABLE
from modern.port.arithmetic import Arithmetic, Scalar, Vector
from modern.port.equations import Equations, Slack
from modern.port.formulas import line
from modern.port.growth import grow
from modern.port.inside import Remaining
from modern.port.places import Places
from modern.port.progress import TABLE_OF_LINES, Progress, Stopped, Watcher
from modern.port.turning import turned

_LISTED_LINES = 51
_FIRST = np.array([(0, 1), (2, 1), (0, 2)]).T
"""MM and NN of the first three lines (102+9 to 103)."""
_FROM, _TO, _CONSTANT = np.array([0, 1, 2]), np.array([1, 2, 0]), np.array([0, 1, 0])


def projection(arithmetic: Arithmetic, plane: tuple[Scalar, ...]) -> int:
    """KPROJ: 1 onto the y-z plane, 2 onto the x-z plane, 3 onto the x-y plane (209 to 217)."""
    a, b = (arithmetic.is_zero(c) for c in plane[:2])
    return 1 if not a else 2 if not b else 3


def lines(places: Places, first: NDArray[np.int64], second: NDArray[np.int64], by: NDArray[np.int64]) -> Vector:
    """Equations (3.5) of lines through two points each, in vectors; C is written with the point ``by``."""
    (u1, v1, _), (u2, v2, _), (cu, cv, _) = (places.several(p) for p in (first, second, by))
    return np.stack(line(u1, v1, u2, v2, cu, cv))


@dataclass
class Polygon:
    """The state of program 2: places (the coordinate projected away is the third) and table are changed in place."""

    arithmetic: Arithmetic
    places: Places
    slack: Slack | None
    centre: tuple[Scalar, ...] | None
    progress: Progress
    watch: Watcher | None = None
    vertices: int = 3
    to_check: int = 0
    remaining: Remaining = field(default_factory=Remaining)
    table: Equations = field(init=False)

    def __post_init__(self) -> None:
        self.table = Equations(self.arithmetic, self.slack, self.turn(_FROM, _TO, _CONSTANT), _FIRST.copy())

    def run(self) -> None:
        """Expand H_1 to the hull of all points (103 to 135).  Raises Stopped."""
        grow(self)

    def turn(self, first: NDArray[np.int64], second: NDArray[np.int64], by: NDArray[np.int64]) -> Vector:
        return turned(self.arithmetic, lines(self.places, first, second, by), self.centre)[0]

    def outside_point(self) -> int | None:
        """The place of the next vertex: farthest outside the first line that is not supporting (124 to 132)."""
        while self.to_check < len(self.table):
            u, v, _ = self.places.rows
            values = self.table.one_at(self.to_check, (u, v))
            if self.arithmetic.sign(values[self.table.defining[:, self.to_check]]).any():
                raise Stopped(NOT_ACCEPTABLE, "program2 126")
            if len(self.places) == self.vertices:
                return None
            values = values[self.vertices :]
            place = self.arithmetic.last_largest(values)
            if self.arithmetic.sign(values[place : place + 1])[0] > 0:
                return self.vertices + place
            self.to_check += 1
        return None

    def expand(self, place: int) -> int:
        """Make the point in ``place`` a vertex: two lines instead of the one it is outside of (133 to 135)."""
        new = self.vertices
        self.vertices += 1
        self.places.swap(place, new)
        self.remaining.swapped(place - new)
        ends = self.table.defining[:, self.to_check].copy()
        both = np.array([new, new])
        kept = np.ones(len(self.table), np.bool_)
        kept[self.to_check] = False
        self.table.replace(kept, self.turn(both, ends, both), np.stack([ends, both]), np.ones(2, np.bool_))
        if len(self.table) + 1 > _LISTED_LINES:
            self.progress.mend(TABLE_OF_LINES)
        return 1

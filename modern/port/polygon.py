"""The hull of coplanar points, program 2 (thesis p. 17-28, listing p. 79-87).

Comments give statement labels.  Places count from 0 here, from 1 in the listing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from modern.geometry.hull import ERROR, NOT_ACCEPTABLE
from modern.port.arithmetic import Arithmetic, Scalar, Vector
from modern.port.formulas import distance_squared, line
from modern.port.growth import BETWEEN, NUMBERING, TABLE_OF_LINES, Progress, Remaining, Stopped, Watcher, grow
from modern.port.table import Equations, Places, Slack, turned

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
            self.progress.correct(TABLE_OF_LINES)
        return 1


def strike_between(
    arithmetic: Arithmetic, table: Equations, places: Places, progress: Progress
) -> tuple[NDArray[np.int64], list[int]]:
    """Points between two others of their line are no vertices, and a line has one equation (144 to 169).

    Returns for each equation that stays the two places it ends at, and the places that are no vertices, in the
    order they are found.  Raises Stopped.
    """
    ends = table.defining.copy()
    gone: list[int] = []
    u, v, _ = places.rows
    k = 0
    while k < len(table):
        on = np.flatnonzero(arithmetic.sign(table.one_at(k, (u, v))) == 0).tolist()
        third = next((i for i in on if i not in ends[:, k]), None)
        if third is not None:
            mm, nn = ends[:, k].tolist()
            between = middle(arithmetic, places, (mm, nn, third), progress)
            ends[:, k] = [third if end == between else end for end in (mm, nn)]
            gone.append(between)
            progress.boundary.append(int(places.who[between]))
            wanted = other_lines(arithmetic, table, places, ends[:, k], k)
            table.keep(wanted)
            ends = ends[:, wanted]
            if len(table) <= k:
                raise Stopped(ERROR, "program2 112")
        k += 1
    if listed_numbers(ends, gone) != lowered(ends, gone):
        progress.correct(NUMBERING)
    return ends, gone


def other_lines(
    arithmetic: Arithmetic, table: Equations, places: Places, ends: NDArray[np.int64], keep: int
) -> NDArray[np.bool_]:
    """Which equations stay when those that both ends satisfy are struck, but for the one ``keep`` (161 to 167).

    As in the listing KK stays a place in the table while the equations before it are struck; exactly there are
    no such equations, since a line has two and the first of them comes first.  Raises Stopped.
    """
    first, second = (places.at(int(i))[:2] for i in ends)
    both = (arithmetic.sign(table.all_at(first)) == 0) & (arithmetic.sign(table.all_at(second)) == 0)
    left = list(range(len(table)))
    i = 0
    while i < len(left):
        if not both[left[i]]:
            i += 1
        elif i != keep:
            del left[i]
        elif i == len(left) - 1:
            raise Stopped(ERROR, "program2 162")  # the listing looks beyond the table
        else:
            i += 1
    wanted = np.zeros(len(table), np.bool_)
    wanted[left] = True
    return wanted


def middle(arithmetic: Arithmetic, places: Places, three: tuple[int, int, int], progress: Progress) -> int:
    """Which of three points of a line lies between the others: before it is the longest side (155 to 157)."""
    (u1, v1, _), (u2, v2, _), (u3, v3, _) = (places.at(i) for i in three)
    a = distance_squared(u1, v1, u2, v2)
    b = distance_squared(u1, v1, u3, v3)
    c = distance_squared(u2, v2, u3, v3)
    signs = arithmetic.sign(arithmetic.filled([a + b - c, a + c - b])) < 0
    found = 0 if signs[0] else 1 if signs[1] else 2
    # The listing compares the distances themselves, which are roots and need not add up.
    listed = 0 if arithmetic.distances_add_up(a, b, c) else 1 if arithmetic.distances_add_up(a, c, b) else 2
    if found != listed:
        progress.correct(BETWEEN)
    return three[found]


def lowered(ends: NDArray[np.int64], gone: Sequence[int]) -> list[int]:
    """Numbers of the vertices once the places before them that are no vertices are left out."""
    return [end - sum(g < end for g in set(gone)) for end in ends.ravel().tolist()]


def listed_numbers(ends: NDArray[np.int64], gone: Sequence[int]) -> list[int]:
    """The same as the listing counts, from the first point on (179+2 to 191)."""
    numbers = []
    for number in ends.ravel().tolist():
        for g in sorted(set(gone)):
            if number >= g:
                number -= 1
        numbers.append(number)
    return numbers

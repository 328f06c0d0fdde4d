"""Program 2: the hull of points in a plane (thesis p. 17-28, listing p. 79-87).

Numbers in parentheses are statement numbers of the FORTRAN listing. Points are counted from 0 here, from 1 in the
listing.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from modern.geometry.hull import ERROR, NOT_ACCEPTABLE
from modern.port.arithmetic import Arithmetic, Scalar, Vector, distance_squared, line
from modern.port.growth import BETWEEN, NUMBERING, TABLE_OF_LINES, Progress, Remaining, Stopped
from modern.port.table import Equations, PointTable, Slack, turned

# The number of lines that the listing's table holds.
_LISTED_LINES = 51
# The end points MM and NN of the first three lines (statements 102+9 to 103).
_FIRST = np.array([(0, 1), (2, 1), (0, 2)]).T
_FROM, _TO, _CONSTANT = np.array([0, 1, 2]), np.array([1, 2, 0]), np.array([0, 1, 0])


def projection(arithmetic: Arithmetic, plane: tuple[Scalar, ...]) -> int:
    """Return the axis along which the points are projected: 1 for x, 2 for y, 3 for z (statements 209 to 217)."""
    a_is_zero, b_is_zero = (arithmetic.is_zero(c) for c in plane[:2])
    return 1 if not a_is_zero else 2 if not b_is_zero else 3


def lines(points: PointTable, first: NDArray[np.int64], second: NDArray[np.int64], by: NDArray[np.int64]) -> Vector:
    """Return the equations (3.5) of lines, each through two points.  The point ``by`` determines the constant term."""
    (u1, v1, _), (u2, v2, _), (cu, cv, _) = (points.several(p) for p in (first, second, by))
    return np.stack(line(u1, v1, u2, v2, cu, cv))


@dataclass
class Polygon:
    """The state of program 2, which begins with the triangle H_1 (statements 103 to 135 add the other vertices).

    The third coordinate of each point is the coordinate that the projection drops.
    """

    arithmetic: Arithmetic
    points: PointTable
    slack: Slack | None
    centre: tuple[Scalar, ...] | None
    progress: Progress
    vertices: int = 3
    to_check: int = 0
    remaining: Remaining = field(default_factory=Remaining)
    table: Equations = field(init=False)

    def __post_init__(self) -> None:
        self.table = Equations(self.arithmetic, self.slack, self.turn(_FROM, _TO, _CONSTANT), _FIRST.copy())

    def turn(self, first: NDArray[np.int64], second: NDArray[np.int64], by: NDArray[np.int64]) -> Vector:
        return turned(self.arithmetic, lines(self.points, first, second, by), self.centre)[0]

    def outside_point(self) -> int | None:
        """Return the point farthest outside the first line that has points outside, or None (statements 124 to 132)."""
        while self.to_check < len(self.table):
            u, v, _ = self.points.rows
            # The line's end points must satisfy its equation exactly, or the data are not acceptable (statement 126).
            values = self.table.one_at(self.to_check, (u, v))
            if self.arithmetic.sign(values[self.table.defining[:, self.to_check]]).any():
                raise Stopped(NOT_ACCEPTABLE, "program2 126")
            if len(self.points) == self.vertices:
                return None
            # The listing compares only the points that are not vertices yet (statements 128 to 131).
            values = values[self.vertices :]
            index = self.arithmetic.last_largest(values)
            if self.arithmetic.sign(values[index : index + 1])[0] > 0:
                return self.vertices + index
            self.to_check += 1
        return None

    def expand(self, index: int) -> int:
        """Make the point at ``index`` a vertex, and replace the line that it is outside of by two (statement 133)."""
        new = self.vertices
        self.vertices += 1
        self.points.swap(index, new)
        self.remaining.swapped(index - new)
        ends = self.table.defining[:, self.to_check].copy()
        # The new lines run from the new vertex to the two ends of the deleted line (statement 133).
        both = np.array([new, new])
        retained = np.ones(len(self.table), np.bool_)
        retained[self.to_check] = False
        self.table.replace(retained, self.turn(both, ends, both), np.stack([ends, both]), np.ones(2, np.bool_))
        if len(self.table) + 1 > _LISTED_LINES:
            self.progress.correct(TABLE_OF_LINES)
        return 1


def strike_between(
    arithmetic: Arithmetic, table: Equations, points: PointTable, progress: Progress
) -> tuple[NDArray[np.int64], list[int]]:
    """Remove points between two others on a side of the polygon, and repeated equations (statements 144 to 169).

    Return the end points of each remaining equation, and the deleted points in the order of their discovery. Raise
    Stopped if the procedure cannot continue.
    """
    ends = table.defining.copy()
    not_vertices: list[int] = []
    u, v, _ = points.rows
    k = 0
    while k < len(table):
        on = np.flatnonzero(arithmetic.sign(table.one_at(k, (u, v))) == 0).tolist()
        # A third point is on the line: one of the three lies between the others and is not a vertex (147 to 155).
        third = next((i for i in on if i not in ends[:, k]), None)
        if third is not None:
            mm, nn = ends[:, k].tolist()
            middle_point = middle(arithmetic, points, (mm, nn, third), progress)
            ends[:, k] = [third if end == middle_point else end for end in (mm, nn)]
            not_vertices.append(middle_point)
            progress.boundary.append(int(points.input_index[middle_point]))
            retained = other_lines(arithmetic, table, points, ends[:, k], k)
            table.keep(retained)
            ends = ends[:, retained]
            if len(table) <= k:
                raise Stopped(ERROR, "program2 112")
        k += 1
    # Row P2-025 of the layer ``corrected``: the listing's numbering can be wrong.
    if listed_numbers(ends, not_vertices) != lowered(ends, not_vertices):
        progress.correct(NUMBERING)
    return ends, not_vertices


def other_lines(
    arithmetic: Arithmetic, table: Equations, points: PointTable, ends: NDArray[np.int64], keep: int
) -> NDArray[np.bool_]:
    """Return a mask that is False for further equations of the line through ``ends`` (statements 161 to 167).

    ``keep`` (KK in the listing) is the index of the equation that remains. As in the listing, it is not adjusted after
    earlier equations are deleted. Raise Stopped if the listing would read beyond the end of its table.
    """
    first, second = (points.at(int(i))[:2] for i in ends)
    both = (arithmetic.sign(table.all_at(first)) == 0) & (arithmetic.sign(table.all_at(second)) == 0)
    remaining = list(range(len(table)))
    i = 0
    while i < len(remaining):
        if not both[remaining[i]]:
            i += 1
        elif i != keep:
            del remaining[i]
        elif i == len(remaining) - 1:
            raise Stopped(ERROR, "program2 162")  # the listing reads beyond the end of its table
        else:
            i += 1
    retained = np.zeros(len(table), np.bool_)
    retained[remaining] = True
    return retained


def middle(arithmetic: Arithmetic, points: PointTable, three: tuple[int, int, int], progress: Progress) -> int:
    """Return which of three points on a line lies between the other two (statements 155 to 157)."""
    (u1, v1, _), (u2, v2, _), (u3, v3, _) = (points.at(i) for i in three)
    a = distance_squared(u1, v1, u2, v2)
    b = distance_squared(u1, v1, u3, v3)
    c = distance_squared(u2, v2, u3, v3)
    signs = arithmetic.sign(arithmetic.filled([a + b - c, a + c - b])) < 0
    exact_choice = 0 if signs[0] else 1 if signs[1] else 2
    # The listing compares the distances themselves (statements 155 to 157). Rounded square roots need not add up.
    listed_choice = 0 if arithmetic.distances_add_up(a, b, c) else 1 if arithmetic.distances_add_up(a, c, b) else 2
    if exact_choice != listed_choice:
        progress.correct(BETWEEN)
    return three[exact_choice]


def lowered(ends: NDArray[np.int64], not_vertices: Sequence[int]) -> list[int]:
    """Return the number of the vertex at each end of each line. The numbering skips points that are not vertices."""
    return [end - sum(g < end for g in set(not_vertices)) for end in ends.ravel().tolist()]


def listed_numbers(ends: NDArray[np.int64], not_vertices: Sequence[int]) -> list[int]:
    """Return the vertex numbers of the ends of the lines as the listing computes them from statement 179+2 on.

    A number can be too high, because the listing compares numbers that it has already lowered.
    """
    numbers = []
    for number in ends.ravel().tolist():
        # The listing compares with the number already lowered, so it can skip a point that is no vertex.
        for g in sorted(set(not_vertices)):
            if number >= g:
                number -= 1
        numbers.append(number)
    return numbers

"""Program 1: find three points that are not on a line, then a fourth point outside their plane.

Thesis p. 11-17 and 29, FORTRAN listing p. 64-74. Numbers in parentheses are statement numbers of the listing. Points
are counted from 0 here, from 1 in the listing.
"""

from dataclasses import dataclass
from functools import reduce
from operator import add

import numpy as np

from modern.port.arithmetic import Arithmetic, Point, Scalar, Vector, at, line, moments, plane
from modern.port.table import Equations, PointTable, Slack, snapped

Four = tuple[Scalar, Scalar, Scalar, Scalar]
# For each value of KPERP, the number of an axis on which the points of a line differ, the coordinates in the two
# equations by which the listing describes the line: (3.1) and (3.2), (3.1) and (3.3), or (3.2) and (3.3).
_PAIRS = {1: ((0, 1), (0, 2)), 2: ((0, 1), (1, 2)), 3: ((0, 2), (1, 2))}


# The label that a result reports if the fourth point, chosen as in the text of the thesis, lies in the plane of the
# first three.
NO_FOURTH = "chapter 3, p. 29"


@dataclass(frozen=True)
class Opening:
    """The result of program 1: the kind of point set, and the planes or lines with which programs 2 and 3 begin.

    ``kind`` is ``point``, ``segment``, ``triangle``, ``coplanar``, ``solid`` or ``error``, and ``label`` is the number
    of the statement that decided the kind. ``lines`` has two equations for each line. ``plane`` is None unless all
    points lie in one plane but not on one line. ``centre``, the inside point C, is None unless the points span space.
    """

    kind: str
    label: str
    lines: tuple[Four, ...] = ()
    plane: Four | None = None
    centre: Point | None = None


def direction(arithmetic: Arithmetic, p: Point, q: Point) -> int:
    """Return the first axis on which two points differ: 1 for x, 2 for y, 3 for z (statements 108 to 112)."""
    if not arithmetic.is_zero(p[0] - q[0]):
        return 1
    return 3 if arithmetic.is_zero(p[1] - q[1]) else 2


def line_equations(p: Point, q: Point, perpendicular: int, zero: Scalar) -> tuple[Four, Four]:
    """Return two planes A x + B y + C z + D = 0 that intersect in the line through two points (statements from 113)."""
    equations = []
    for i, j in _PAIRS[perpendicular]:
        a, b, c = line(p[i], p[j], q[i], q[j], p[i], p[j])
        # The listing punches zero as coefficient of the coordinate that an equation lacks (statements 116 to 123).
        row = [zero, zero, zero, c]
        row[i], row[j] = a, b
        equations.append((row[0], row[1], row[2], row[3]))
    return equations[0], equations[1]


def extremes(arithmetic: Arithmetic, points: PointTable) -> tuple[int, int, int]:
    """Return the two extreme points on the first axis on which points differ, and that axis (statements 134 to 152)."""
    axis = 0
    while True:
        # The first axis on which the points differ gives the two extremes and KPERP.
        values = points.coordinates[axis]
        large, small = arithmetic.last_largest(values), arithmetic.last_largest(-values)
        axis += 1
        if axis == 3 or not arithmetic.is_zero(values[large] - values[small]):
            return large, small, axis


def bring_to_front(points: PointTable, first: int, second: int) -> None:
    """Exchange the two extreme points with the points at positions 0 and 1 (statements 155 to 158)."""
    points.swap(first, 0)
    # The first exchange moved point 0. If that is the second extreme, it is now where the first one was (157).
    points.swap(first if second == 0 else second, 1)


def on_the_line(arithmetic: Arithmetic, points: PointTable, perpendicular: int, slack: Slack | None) -> bool:
    """Return True if all points satisfy both equations of the line through the first two (statements 181 to 192)."""
    p, q = points.at(0), points.at(1)
    for i, j in _PAIRS[perpendicular]:
        equation = line(p[i], p[j], q[i], q[j], p[i], p[j])
        values = at(equation, (points.coordinates[i], points.coordinates[j]))
        if slack is None:
            # The listing finds the largest square and compares that value with zero (statements 184 to 187).
            if not arithmetic.is_zero(values[arithmetic.last_largest_square(values)]):
                return False
        elif not all_within(arithmetic, equation, values, slack):
            return False
    return True


def all_within(arithmetic: Arithmetic, equation: tuple[Scalar, ...], values: Vector, slack: Slack) -> bool:
    """Return True if all values of a plane's or line's equation lie from -e to +e, where e is its tolerance."""
    e = slack.of(tuple(arithmetic.filled([c]) for c in equation))
    return not arithmetic.sign(snapped(arithmetic, values, e)).any()


def open_hull(arithmetic: Arithmetic, points: PointTable, slack: Slack | None, text: bool = False) -> Opening:
    """Run program 1 on distinct points, and reorder them so that the points of the first hull come first.

    The fourth point is the one at which the equation of the plane through the first three has the value farthest from
    zero (with the largest square), as in the listing. If ``text`` is true, the fourth point is the one at which the
    value is largest, as in the text of the thesis (p. 29).
    """
    count = len(points)
    zero = arithmetic.number(0)
    if count == 1:
        return Opening("point", "102")
    if count == 2:
        p, q = points.at(0), points.at(1)
        return Opening("segment", "219", line_equations(p, q, direction(arithmetic, p, q), zero))
    first, second, perpendicular = extremes(arithmetic, points)
    bring_to_front(points, first, second)
    p, q = points.at(0), points.at(1)
    if on_the_line(arithmetic, points, perpendicular, slack):
        return Opening("segment", "219", line_equations(p, q, perpendicular, zero))
    if count == 3:
        r = points.at(2)
        lines = [
            row for a, b in ((p, q), (r, q), (r, p)) for row in line_equations(a, b, direction(arithmetic, a, b), zero)
        ]
        return Opening("triangle", "131", tuple(lines), plane(p, q, r))
    # The point farthest from the line becomes the third (statements 125 to 228).
    points.swap(arithmetic.farthest(*moments(points.rows, p, q)), 2)
    base_plane = plane(p, q, points.at(2))
    values = at(base_plane, points.rows)
    if all_within(arithmetic, base_plane, values, slack) if slack else arithmetic.all_squares_zero(values):
        return Opening("coplanar", "209", plane=base_plane)
    # The point farthest from the plane becomes the fourth (statements 196 to 198).
    fourth = arithmetic.last_largest(values) if text else arithmetic.last_largest_square(values)
    if text and arithmetic.is_zero(values[fourth]):
        return Opening("error", NO_FOURTH)
    points.swap(fourth, 3)
    return Opening("solid", "199", centre=mean(arithmetic, points, 4))


def mean(arithmetic: Arithmetic, points: PointTable, count: int) -> Point:
    """Return C, a point inside the hull: the mean of the first ``count`` points (statement 199)."""
    x, y, z = (arithmetic.quotient(reduce(add, row[:count]), count) for row in points.rows)
    return x, y, z


def tetrahedron(arithmetic: Arithmetic, points: PointTable, slack: Slack | None) -> Equations:
    """Return the planes of the first hull H_1, a tetrahedron, not yet oriented (statements 200 to 203)."""
    corners = np.array([(0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3)]).T
    p, q, r = (points.several(row) for row in corners)
    coefficients = np.stack(plane(p, q, r))
    return Equations(arithmetic, slack, coefficients, corners[[1, 0, 2]])

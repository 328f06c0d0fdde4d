"""The beginning of the procedure, program 1: three points that are not collinear, a fourth not in their plane.

Thesis p. 11-17 and 29, listing p. 64-74.  Comments give statement labels.  Places count from 0 here, from 1
in the listing.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from modern.port.arithmetic import Arithmetic, Scalar, Vector
from modern.port.formulas import Point, at, line, moments, plane
from modern.port.table import Equations, Places, Slack, snapped

Four = tuple[Scalar, Scalar, Scalar, Scalar]
_PAIRS = {1: ((0, 1), (0, 2)), 2: ((0, 1), (1, 2)), 3: ((0, 2), (1, 2))}
"""The two coordinates of each of a line's equations by KPERP: (3.1) and (3.2), (3.1) and (3.3), (3.2) and (3.3)."""


NO_FOURTH = "chapter 3, p. 29"
"""What decides where the text's fourth point lies in the plane of the first three."""


@dataclass(frozen=True)
class Opening:
    """What program 1 finds.  ``kind``: ``point``, ``segment``, ``triangle``, ``coplanar``, ``solid`` or ``error``.

    ``lines``: two equations a line; ``plane``: of three points or more in a plane; ``centre``: the point C;
    ``label``: the statement that decided.
    """

    kind: str
    label: str
    lines: tuple[Four, ...] = ()
    plane: Four | None = None
    centre: Point | None = None


def direction(arithmetic: Arithmetic, p: Point, q: Point) -> int:
    """KPERP: 1 where x differs, else 2 where y does, else 3 (108 to 112; 146+1, 151)."""
    if not arithmetic.is_zero(p[0] - q[0]):
        return 1
    return 3 if arithmetic.is_zero(p[1] - q[1]) else 2


def line_equations(p: Point, q: Point, perpendicular: int, zero: Scalar) -> tuple[Four, Four]:
    """Two equations of the line through two points in the form A x + B y + C z + D = 0 (113 to 123)."""
    found = []
    for i, j in _PAIRS[perpendicular]:
        a, b, c = line(p[i], p[j], q[i], q[j], p[i], p[j])
        row = [zero, zero, zero, c]
        row[i], row[j] = a, b
        found.append((row[0], row[1], row[2], row[3]))
    return found[0], found[1]


def extremes(arithmetic: Arithmetic, places: Places) -> tuple[int, int, int]:
    """The largest and the smallest point and KPERP; of equals the last (134 to 152)."""
    axis = 0
    while True:
        values = places.coordinates[axis]
        large, small = arithmetic.last_largest(values), arithmetic.last_largest(-values)
        axis += 1
        if axis == 3 or not arithmetic.is_zero(values[large] - values[small]):
            return large, small, axis


def bring_to_front(places: Places, first: int, second: int) -> None:
    """The two extremes change places with the first and the second point (155 to 158)."""
    places.swap(first, 0)
    places.swap(first if second == 0 else second, 1)


def on_the_line(arithmetic: Arithmetic, places: Places, perpendicular: int, slack: Slack | None) -> bool:
    """Whether all points satisfy both equations of the line through the first two (181 to 192)."""
    p, q = places.at(0), places.at(1)
    for i, j in _PAIRS[perpendicular]:
        equation = line(p[i], p[j], q[i], q[j], p[i], p[j])
        values = at(equation, (places.coordinates[i], places.coordinates[j]))
        if slack is None:
            if not arithmetic.is_zero(values[arithmetic.last_largest_square(values)]):
                return False
        elif not all_within(arithmetic, equation, values, slack):
            return False
    return True


def all_within(arithmetic: Arithmetic, equation: tuple[Scalar, ...], values: Vector, slack: Slack) -> bool:
    """Whether each of the values at given points lies between -e and +e of the equation."""
    e = slack.of(tuple(arithmetic.filled([c]) for c in equation))
    return not arithmetic.sign(snapped(arithmetic, values, e)).any()


def open_hull(arithmetic: Arithmetic, places: Places, slack: Slack | None, text: bool = False) -> Opening:
    """Program 1 on distinct points, which are reordered.

    text: the fourth point is that of the largest value, as the text has it (p. 29), not of the largest square; where
    that value is 0 it lies in the plane and there is no tetrahedron (``error``).
    """
    count = len(places)
    zero = arithmetic.number(0)
    if count == 1:
        return Opening("point", "102")
    if count == 2:
        p, q = places.at(0), places.at(1)
        return Opening("segment", "219", line_equations(p, q, direction(arithmetic, p, q), zero))
    first, second, perpendicular = extremes(arithmetic, places)
    bring_to_front(places, first, second)
    p, q = places.at(0), places.at(1)
    if on_the_line(arithmetic, places, perpendicular, slack):
        return Opening("segment", "219", line_equations(p, q, perpendicular, zero))
    if count == 3:
        r = places.at(2)
        lines = [
            row for a, b in ((p, q), (r, q), (r, p)) for row in line_equations(a, b, direction(arithmetic, a, b), zero)
        ]
        return Opening("triangle", "131", tuple(lines), plane(p, q, r))
    # The point farthest from the line becomes the third (125 to 228).
    places.swap(arithmetic.farthest(*moments(places.rows, p, q)), 2)
    found = plane(p, q, places.at(2))
    values = at(found, places.rows)
    if all_within(arithmetic, found, values, slack) if slack else arithmetic.all_squares_zero(values):
        return Opening("coplanar", "209", plane=found)
    # The point farthest from the plane becomes the fourth (196 to 198).
    fourth = arithmetic.last_largest(values) if text else arithmetic.last_largest_square(values)
    if text and arithmetic.is_zero(values[fourth]):
        return Opening("error", NO_FOURTH)
    places.swap(fourth, 3)
    return Opening("solid", "199", centre=mean(arithmetic, places, 4))


def mean(arithmetic: Arithmetic, places: Places, count: int) -> Point:
    """The point C: the mean of the first points (199+1; program 2, 102+7)."""
    x, y, z = (row[:count] for row in places.rows)

    def added(row: Vector) -> Scalar:
        total = row[0]
        for value in row[1:]:
            total = total + value
        return arithmetic.quotient(total, count)

    return added(x), added(y), added(z)


def tetrahedron(arithmetic: Arithmetic, places: Places, slack: Slack | None) -> Equations:
    """The four planes of H_1, not yet turned (200 to 203).

    Program 3 reads the first of the three numbers on a card as NN and the second as MM (100+7 of program 3).
    """
    corners = np.array([(0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3)]).T
    p, q, r = (places.several(row) for row in corners)
    coefficients = np.stack(plane(p, q, r))
    return Equations(arithmetic, slack, coefficients, corners[[1, 0, 2]])

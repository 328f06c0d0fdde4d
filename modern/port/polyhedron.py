"""Program 3: the hull of points in space (thesis p. 29-33, listing p. 93-102).

Numbers in parentheses are statement numbers of the FORTRAN listing. Indices start from 0 here, from 1 in the listing.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from modern.geometry.hull import ERROR, NOT_ACCEPTABLE, TABLE_FULL
from modern.port import growth
from modern.port.arithmetic import Arithmetic, Scalar, Vector, plane
from modern.port.table import Equations, PointTable, turned

# The numbers of planes that the table holds in the listing and in the layer ``corrected`` (4N-11 for N = 51).
LISTED_PLANES, PLANES = 98, 193


@dataclass(frozen=True)
class Fresh:
    """The planes through a new vertex.

    ``through`` is True if one of them contains the inside point C.  ``degenerate`` is True if the coefficients A, B and
    C of one of them are all zero.
    """

    coefficients: Vector
    defining: NDArray[np.int64]
    through: bool
    degenerate: bool


@dataclass
class Polyhedron:
    """The state of program 3, which begins with the tetrahedron H_1 (statements 103 to 160 add the other vertices).

    The table of points and the table of planes change in place.
    """

    arithmetic: Arithmetic
    points: PointTable
    table: Equations
    centre: tuple[Scalar, ...] | None
    progress: growth.Progress
    vertices: int = 4
    to_check: int = 0
    remaining: growth.Remaining = field(default_factory=growth.Remaining)
    # True to replace the planes after the first in the order of their numbers, as the text of the thesis does (p. 32).
    text: bool = False

    def outside_point(self) -> int | None:
        """Return the point farthest outside the first plane with points outside, or None (statements 115 to 125)."""
        while self.to_check < len(self.table):
            # Statements 116 to 119: the three defining points must satisfy the equation exactly.
            values = self.table.one_at(self.to_check, self.points.rows)
            if self.arithmetic.sign(values[self.table.defining[:, self.to_check]]).any():
                raise growth.Stopped(NOT_ACCEPTABLE, "program3 119")
            index = self.arithmetic.last_largest(values)
            if self.arithmetic.sign(values[index : index + 1])[0] > 0:
                return index
            self.to_check += 1
        return None

    def expand(self, index: int) -> int:
        """Make the point at ``index`` a vertex, and return how many planes it was outside of (statements 125 to 160).

        Three planes replace each of these planes. The plane that is being checked is replaced first, then the others in
        the order of decreasing value at the point, or, if ``text`` is true, in the order of their numbers. Raise
        Stopped if the procedure cannot continue.
        """
        new = self.vertices
        if new == len(self.points):
            raise growth.Stopped(ERROR, "program3 103")  # by rounding a vertex can lie outside the hull
        self.vertices += 1
        self.points.swap(index, new)
        self.remaining.swapped(index - new)
        point = self.points.at(new)
        values = self.table.all_at(point)
        # Statements 135 to 140 find one plane after the other, each time the largest value of all. A replaced plane
        # does not return, and the point is not outside of the new planes, so the order can be computed at once.
        above = np.flatnonzero(self.arithmetic.sign(values) > 0)
        others = above[above != self.to_check]
        further = others if self.text else others[self.arithmetic.descending(values[others])]
        order = [self.to_check, *further.tolist()]
        fresh = self.three_planes(self.table.defining[:, order], new)
        # The table is largest while the last plane is being replaced: each replacement first adds three planes, then
        # deletes one.
        peak = len(self.table) + 2 * len(order) + 1
        values_there = self.table.values(fresh.coefficients, point)
        if fresh.degenerate or peak > self.limit or (self.arithmetic.sign(values_there) > 0).any():
            self.stop(order[0], dict(zip(above.tolist(), values[above], strict=True)), new)
        self.note(fresh, peak)
        retained = np.ones(len(self.table), np.bool_)
        retained[order] = False
        self.table.replace(retained, fresh.coefficients, fresh.defining, self.single(fresh.defining))
        return len(order)

    @property
    def limit(self) -> int:
        return max(PLANES, 4 * len(self.points) - 11)

    def three_planes(self, replaced: NDArray[np.int64], new: int) -> Fresh:
        """Return, for each replaced plane, three planes through the new vertex and two of its defining points.

        ``replaced`` has the defining points of each replaced plane in a column (statement 126 on).
        """
        defining = np.repeat(replaced, 3, axis=1)
        columns = np.arange(defining.shape[1])
        # I123 of the listing: the new vertex takes the place of MM, then NN, then KK (statements 127 to 129).
        defining[columns % 3, columns] = new
        p, q, r = (self.points.several(row) for row in defining)
        coefficients, through = turned(self.arithmetic, np.stack(plane(p, q, r)), self.centre)
        degenerate = any(self.arithmetic.all_squares_zero(coefficients[:3, k]) for k in np.flatnonzero(through))
        return Fresh(coefficients, defining, bool(through.any()), degenerate)

    def note(self, fresh: Fresh, size: int) -> None:
        """Record each correction without which Butler's listing would stop at this step.

        The listing stops if a new plane contains the inside point C, or if the step needs more entries (``size``) than
        the listing's table of planes has.
        """
        if fresh.through:
            self.progress.correct(growth.THROUGH_CENTRE)
        if size > LISTED_PLANES:
            self.progress.correct(growth.TABLE_OF_PLANES)

    def single(self, defining: NDArray[np.int64]) -> NDArray[np.bool_]:
        """Return a mask of the new planes that is False for every pair of equal planes (statements 141 to 160).

        The planes of such a pair pass through the interior of the new hull.  No older plane contains the new vertex, so
        only new planes are compared.
        """
        retained = np.ones(defining.shape[1], np.bool_)
        if len(retained) == 3:
            return retained
        # Statements 141 to 160 compare every two planes. A dictionary of unpaired planes finds the same pairs.
        waiting: dict[tuple[int, ...], int] = {}
        pairs: list[tuple[int, int]] = []
        for k, key in enumerate(map(tuple, np.sort(defining, axis=0).T.tolist())):
            if key in waiting:
                pairs.append((waiting.pop(key), k))
            else:
                waiting[key] = k
        for first, second in sorted(pairs):
            retained[[first, second]] = False
            # The listing continues at the position of the deleted plane and reads the planes after it (142, 154).
            if retained[first:].sum() <= 1:
                self.progress.correct(growth.LAST_PAIR)
        return retained

    def stop(self, first_equation: int, above: dict[int, Scalar], new: int) -> None:
        """Repeat the failing stage plane by plane, as the listing does, and raise Stopped at the statement that fails.

        The listing reports an error if the coefficients A, B and C of a plane are zero. If rounding puts the new point
        outside a plane through it, the listing replaces that plane by a copy of itself and two other planes, again and
        again until its table is full.
        """
        point = self.points.at(new)
        defining = {k: self.table.defining[:, k] for k in above}
        size, equation, replaced = len(self.table), first_equation, set[tuple[int, ...]]()
        while True:
            corners = tuple(defining[equation].tolist())
            if size + 3 > self.limit or corners in replaced:
                raise growth.Stopped(TABLE_FULL, "program3 130")
            replaced.add(corners)
            above.pop(equation)
            fresh = self.three_planes(defining[equation][:, None], new)
            if fresh.degenerate:
                raise growth.Stopped(ERROR, "program3 133")
            self.note(fresh, size + 3)
            # Three planes were added and one was deleted (statements 131 and 157).
            size += 2
            values = self.table.values(fresh.coefficients, point)
            for k in np.flatnonzero(self.arithmetic.sign(values) > 0).tolist():
                serial = len(self.table) + 3 * len(replaced) + k
                above[serial], defining[serial] = values[k], fresh.defining[:, k]
            serials: Sequence[int] = sorted(above)
            equation = serials[self.arithmetic.last_largest(self.arithmetic.filled([above[k] for k in serials]))]


On = list[NDArray[np.int64]]


def strike_repeats(table: Equations, on: On, count: int, progress: growth.Progress) -> On:
    """Delete repeated equations of a plane, and return the points on each plane (statements 164 to 174)."""
    mm, nn, kk = table.defining
    struck_by = np.full(len(table), -1)
    member = np.zeros(count, np.bool_)
    # A plane that contains no points except its three defining points repeats no other plane.
    for k in _not_triangular(on, table.defining):
        # The first earlier equation whose three defining points satisfy equation k deletes it (statements 166 to 169).
        member[on[k]] = True
        earlier = np.flatnonzero(member[mm[:k]] & member[nn[:k]] & member[kk[:k]] & (struck_by[:k] < 0))
        member[on[k]] = False
        if earlier.size:
            struck_by[k] = earlier[0]
    retained = struck_by < 0
    # The listing reads beyond its table if an equation deletes the last of those after it (statements 169 to 172).
    last = np.flatnonzero(retained)[-1]
    if (struck_by == last).any():
        progress.correct(growth.LAST_REPEAT)
    table.keep(retained)
    return [satisfying for k, satisfying in enumerate(on) if retained[k]]


def _not_triangular(on: On, defining: NDArray[np.int64]) -> list[int]:
    """Return the indices of the equations, except the first, that hold at points besides their three defining ones."""
    three = np.flatnonzero(np.fromiter(map(len, on), np.int64, len(on)) == 3)
    only_defining = np.zeros(len(on), np.bool_)
    if three.size:
        triples = np.sort(np.concatenate([on[k] for k in three.tolist()]).reshape(-1, 3))
        only_defining[three] = (triples == np.sort(defining[:, three].T)).all(axis=1)
    return [k for k in np.flatnonzero(~only_defining).tolist() if k]


def are_vertices(on: On, count: int, point_count: int) -> NDArray[np.bool_]:
    """Return a mask of the vertices: those points that lie on at least three planes (statements 174 to 182)."""
    planes_satisfied = np.bincount(np.concatenate(on), minlength=point_count)
    return np.asarray((planes_satisfied >= 3) & (np.arange(point_count) < count), dtype=np.bool_)

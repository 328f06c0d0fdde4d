"""The hull of points that are not coplanar, program 3 (thesis p. 29-33, listing p. 93-102).

Comments give statement labels.  Places and planes count from 0 here, from 1 in the listing.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from modern.geometry.hull import ERROR, NOT_ACCEPTABLE, TABLE_FULL
from modern.port.arithmetic import Arithmetic, Scalar, Vector
from modern.port.formulas import plane
from modern.port.growth import (
    LAST_PAIR,
    LAST_REPEAT,
    TABLE_OF_PLANES,
    THROUGH_CENTRE,
    Grown,
    Progress,
    Remaining,
    Stopped,
    Watcher,
    grow,
    stage,
)
from modern.port.table import Equations, Places, turned

LISTED_PLANES, PLANES = 98, 193
"""Places for planes in the listing, and in the layer ``corrected``: 4N-11 for N = 51."""


@dataclass(frozen=True)
class Fresh:
    """Planes just made: columns as in the table; which of them are through C, and zero altogether."""

    coefficients: Vector
    defining: NDArray[np.int64]
    through: bool
    nothing: bool


@dataclass
class Polyhedron:
    """The state of program 3: places and table are changed in place."""

    arithmetic: Arithmetic
    places: Places
    table: Equations
    centre: tuple[Scalar, ...] | None
    progress: Progress
    watch: Watcher | None = None
    vertices: int = 4
    to_check: int = 0
    remaining: Remaining = field(default_factory=Remaining)
    text: bool = False
    """Further planes are replaced in the order of their numbers, as the text has it (p. 32)."""

    def run(self, grown: Callable[[Polyhedron, bool], Grown | None] = stage) -> None:
        """Expand H_1 to the hull of all points (103 to 160), stage by stage as ``grown`` does it.  Raises Stopped."""
        grow(self, grown)

    def outside_point(self) -> int | None:
        """The place of the next vertex: farthest outside the first plane that is not supporting (115 to 125)."""
        while self.to_check < len(self.table):
            values = self.table.one_at(self.to_check, self.places.rows)
            if self.arithmetic.sign(values[self.table.defining[:, self.to_check]]).any():
                raise Stopped(NOT_ACCEPTABLE, "program3 119")
            place = self.arithmetic.last_largest(values)
            if self.arithmetic.sign(values[place : place + 1])[0] > 0:
                return place
            self.to_check += 1
        return None

    def expand(self, place: int) -> int:
        """Make the point in ``place`` a vertex: three planes for each one it is outside of (125 to 160).

        The plane being checked is replaced first, then the one it is farthest outside of, of equals the last; or the
        others in order (``text``).
        Returns how many they were.  Raises Stopped.
        """
        new = self.vertices
        if new == len(self.places):
            raise Stopped(ERROR, "program3 103")  # a vertex of its own hull, as rounded numbers may have it
        self.vertices += 1
        self.places.swap(place, new)
        self.remaining.swapped(place - new)
        point = self.places.at(new)
        values = self.table.all_at(point)
        above = np.flatnonzero(self.arithmetic.sign(values) > 0)
        others = above[above != self.to_check]
        further = others if self.text else others[self.arithmetic.descending(values[others])]
        order = [self.to_check, *further.tolist()]
        fresh = self.three_planes(self.table.defining[:, order], new)
        peak = len(self.table) + 2 * len(order) + 1
        if fresh.nothing or peak > self.limit or (self.signs(fresh, point) > 0).any():
            self.stop(order[0], dict(zip(above.tolist(), values[above], strict=True)), new)
        self.note(fresh, peak)
        kept = np.ones(len(self.table), np.bool_)
        kept[order] = False
        self.table.replace(kept, fresh.coefficients, fresh.defining, self.single(fresh.defining))
        return len(order)

    @property
    def limit(self) -> int:
        return max(PLANES, 4 * len(self.places) - 11)

    def three_planes(self, replaced: NDArray[np.int64], new: int) -> Fresh:
        """Planes through the new vertex and two of the three points of each plane replaced (126 to 135)."""
        defining = np.repeat(replaced, 3, axis=1)
        columns = np.arange(defining.shape[1])
        defining[columns % 3, columns] = new
        p, q, r = (self.places.several(row) for row in defining)
        coefficients, through = turned(self.arithmetic, np.stack(plane(p, q, r)), self.centre)
        nothing = any(self.arithmetic.all_squares_zero(coefficients[:3, k]) for k in np.flatnonzero(through))
        return Fresh(coefficients, defining, bool(through.any()), nothing)

    def note(self, fresh: Fresh, size: int) -> None:
        """What the listing would have stopped at: planes through C, more planes than it has places for."""
        if fresh.through:
            self.progress.correct(THROUGH_CENTRE)
        if size > LISTED_PLANES:
            self.progress.correct(TABLE_OF_PLANES)

    def signs(self, fresh: Fresh, point: tuple[Scalar, ...]) -> NDArray[np.int8]:
        return self.arithmetic.sign(self.table.values(fresh.coefficients, point))

    def single(self, defining: NDArray[np.int64]) -> NDArray[np.bool_]:
        """Which of the fresh planes stay when two with the same three points strike each other (141 to 160).

        No older plane has the new vertex among its points, so these are struck by each other only.
        """
        wanted = np.ones(defining.shape[1], np.bool_)
        if len(wanted) == 3:
            return wanted
        waiting: dict[tuple[int, ...], int] = {}
        pairs: list[tuple[int, int]] = []
        for k, key in enumerate(map(tuple, np.sort(defining, axis=0).T.tolist())):
            if key in waiting:
                pairs.append((waiting.pop(key), k))
            else:
                waiting[key] = k
        for one, other in sorted(pairs):
            wanted[[one, other]] = False
            # The listing goes on with the plane in the struck one's place and looks at those after it.
            if wanted[one:].sum() <= 1:
                self.progress.correct(LAST_PAIR)
        return wanted

    def stop(self, first: int, above: dict[int, Scalar], new: int) -> None:
        """Go on plane by plane to where the arithmetic fails: it always does.  Raises Stopped.

        A plane of zeros is an error.  A plane through the new point that has it outside is replaced by itself
        and two others without end, until the table is full; so no plane need be replaced twice.
        """
        point = self.places.at(new)
        defining = {k: self.table.defining[:, k] for k in above}
        size, equation, replaced = len(self.table), first, set[tuple[int, ...]]()
        while True:
            corners = tuple(defining[equation].tolist())
            if size + 3 > self.limit or corners in replaced:
                raise Stopped(TABLE_FULL, "program3 130")
            replaced.add(corners)
            above.pop(equation)
            fresh = self.three_planes(defining[equation][:, None], new)
            if fresh.nothing:
                raise Stopped(ERROR, "program3 133")
            self.note(fresh, size + 3)
            size += 2
            values = self.table.values(fresh.coefficients, point)
            for k in np.flatnonzero(self.arithmetic.sign(values) > 0).tolist():
                name = len(self.table) + 3 * len(replaced) + k
                above[name], defining[name] = values[k], fresh.defining[:, k]
            names: Sequence[int] = sorted(above)
            equation = names[self.arithmetic.last_largest(self.arithmetic.filled([above[k] for k in names]))]


On = list[NDArray[np.int64]]


def strike_repeats(table: Equations, on: On, places: int, progress: Progress) -> On:
    """One equation of each plane stays, the first (164 to 174); of the places that satisfy each, what stays of them.

    An equation is struck when the three points of an earlier one satisfy it.
    """
    mm, nn, kk = table.defining
    struck_by = np.full(len(table), -1)
    member = np.zeros(places, np.bool_)
    for k in _with_others(on, table.defining):
        member[on[k]] = True
        earlier = np.flatnonzero(member[mm[:k]] & member[nn[:k]] & member[kk[:k]] & (struck_by[:k] < 0))
        member[on[k]] = False
        if earlier.size:
            struck_by[k] = earlier[0]
    wanted = struck_by < 0
    # The listing looks beyond the table when an equation has struck the last of those after it.
    last = np.flatnonzero(wanted)[-1]
    if (struck_by == last).any():
        progress.correct(LAST_REPEAT)
    table.keep(wanted)
    return [points for k, points in enumerate(on) if wanted[k]]


def _with_others(on: On, defining: NDArray[np.int64]) -> list[int]:
    """The equations, but the first, that others than their three points satisfy, or not all of these."""
    three = np.flatnonzero(np.fromiter(map(len, on), np.int64, len(on)) == 3)
    alone = np.zeros(len(on), np.bool_)
    if three.size:
        found = np.sort(np.concatenate([on[k] for k in three.tolist()]).reshape(-1, 3))
        alone[three] = (found == np.sort(defining[:, three].T)).all(axis=1)
    return [k for k in np.flatnonzero(~alone).tolist() if k]


def are_vertices(on: On, count: int, places: int) -> NDArray[np.bool_]:
    """Which of the places are vertices: of the first ``count`` those that satisfy three equations (174 to 182)."""
    planes = np.bincount(np.concatenate(on), minlength=places)
    return np.asarray((planes >= 3) & (np.arange(places) < count), dtype=np.bool_)

"""The loop that adds vertices one by one to the first hull H_1, a triangle or tetrahedron (thesis p. 20-33)."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from modern.port.table import Equations, PointTable


class Remaining:
    """The points that may still become vertices.

    Each point has a *keeper*: an equation of the hull that is not negative at the point, so that the point is not
    inside the hull.
    """

    def __init__(self) -> None:
        # For each point, the serial number of an equation whose value there is not negative, or -1 if it is unknown.
        self.keeper: NDArray[np.int64] = np.empty(0, np.int64)
        # The equations before this serial number existed when the points were last tested.
        self.tried = 0
        # True if that test eliminated a point.
        self.eliminated_any = False

    def begin(self, count: int) -> None:
        self.keeper = np.full(count, -1, np.int64)
        self.tried = 0

    def swapped(self, index: int) -> None:
        """Update the keepers after the remaining point at ``index`` became a vertex and the first took its index.

        The index is negative if the point was a vertex before: in rounded arithmetic a vertex can lie outside the hull.
        """
        if index > 0:
            self.keeper[index] = self.keeper[0]
        self.keeper = self.keeper[1:]

    def strike_inside(self, points: PointTable, vertices: int, table: Equations) -> list[int]:
        """Remove the points on the inner side of all planes or lines.  Return their input indices, in order."""
        self.eliminated_any = False
        if len(points) <= vertices:
            return []
        alive = np.zeros(table.made + 1, np.bool_)
        alive[table.serial] = True
        # Statements 103 to 113: a point is inside if every equation is negative at it. A point whose keeper (the
        # equation recorded for it) is still in the table cannot be inside, so only the other points are tested.
        doubtful = np.flatnonzero(~alive[self.keeper])
        fresh = int(np.searchsorted(table.serial, self.tried))
        # Test the new equations first: for most points one of them becomes the keeper in place of the deleted one. The
        # older equations are needed only for points that are inside all the new ones.
        for first in (fresh, 0) if 0 < fresh < len(table) else (0,):
            if not doubtful.size:
                break
            signs = table.signs(points.coordinates[:, vertices + doubtful], first)
            outer = signs >= 0
            retained = outer.any(axis=0)
            self.keeper[doubtful[retained]] = table.serial[first + outer.argmax(axis=0)[retained]]
            doubtful = doubtful[~retained]
        self.tried = table.made
        if not doubtful.size:
            return []
        self.eliminated_any = True
        mask = np.ones(len(points), np.bool_)
        mask[vertices + doubtful] = False
        self.keeper = self.keeper[mask[vertices:]]
        return points.keep(mask)


LAST_PAIR, LAST_REPEAT, THROUGH_CENTRE, TABLE_OF_PLANES = "P3-025", "P3-026", "P3-027", "P3-028"
TABLE_OF_LINES, BETWEEN, NUMBERING = "P2-023", "P2-024", "P2-025"


class Stopped(Exception):
    """Raised if Butler's procedure ends without a hull.  ``status`` is the message that her program types.

    ``label`` gives the program and the number of the statement at which the procedure ends, such as ``program3 133``.
    """

    def __init__(self, status: str, label: str) -> None:
        super().__init__(status, label)
        self.status, self.label = status, label


@dataclass(frozen=True, slots=True)
class Grown:
    """The effect of adding a vertex: the points added and eliminated, and data about the equations involved.

    ``checked`` is the number, counted from 1, of the equation that the vertex was found to be outside of.  ``outside``
    is how many equations the vertex was outside of.
    """

    added: tuple[int, ...]
    checked: int
    outside: int
    eliminated: list[int]


@dataclass
class Progress:
    """The points found so far to be inside or on the boundary, and the modern corrections that changed a step.

    ``history`` has an entry for each approximation H_j (the hull after step j): the step that led to H_j, and an array
    with one column for each equation of H_j.  A column has the input indices of the points that define the equation.
    ``history`` is None if the caller did not request the history.
    """

    history: list[tuple[Grown, NDArray[np.int64]]] | None = None
    inside: list[int] = field(default_factory=list)
    boundary: list[int] = field(default_factory=list)
    corrected: dict[str, None] = field(default_factory=dict)

    def correct(self, name: str) -> None:
        self.corrected[name] = None


class Growing(Protocol):
    """The state of program 2 or 3: a hull under construction, a polygon or a polyhedron."""

    points: PointTable
    remaining: Remaining
    table: Equations
    progress: Progress
    vertices: int
    to_check: int

    def outside_point(self) -> int | None:
        """Return the index of the point that becomes the next vertex, or None if no point is outside the hull."""

    def expand(self, index: int) -> int:
        """Make the point at ``index`` a vertex, and return the number of planes (or lines) that it was outside of."""


Hull = TypeVar("Hull", bound=Growing)


def stage(hull: Growing, first: bool) -> Grown | None:
    """Add the next vertex to the hull and remove the points that it puts inside.  Return None if none is outside."""
    if first:
        added, checked, outside = hull.points.input_indices(slice(0, hull.vertices)), 0, 0
    else:
        # The listing first looks for inside points and then checks if the equations support the hull. It ends here if
        # no point is left that is not a vertex (program 3, 103; program 2, 128).
        if len(hull.points) == hull.vertices and not hull.remaining.eliminated_any:
            return None
        index = hull.outside_point()
        if index is None:
            return None
        checked = hull.to_check + 1
        added = hull.points.input_indices(slice(index, index + 1))
        outside = hull.expand(index)
    return Grown(added, checked, outside, hull.remaining.strike_inside(hull.points, hull.vertices, hull.table))


def grow(hull: Hull, grow_stage: Callable[[Hull, bool], Grown | None] = stage) -> None:
    """Run ``grow_stage``, which adds one or more vertices, until no point is outside the hull."""
    hull.remaining.begin(len(hull.points) - hull.vertices)
    growth = grow_stage(hull, True)
    while growth:
        hull.progress.inside += growth.eliminated
        if hull.progress.history is not None:
            hull.progress.history.append((growth, hull.points.input_index[hull.table.defining]))
        growth = grow_stage(hull, False)

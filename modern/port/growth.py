"""The loop that expands H_1 to the hull of all points, the same in the plane and in space (thesis p. 20-33)."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from modern.port.table import Equations, PointTable


class Remaining:
    """The points that remain and are not vertices. Each has an equation that prevents its elimination."""

    def __init__(self) -> None:
        # The serial number of an equation whose value at the point is not negative; -1 if unknown.
        self.keeper: NDArray[np.int64] = np.empty(0, np.int64)
        # The equations before this serial number existed when the points were last tested.
        self.tried = 0
        # True if that test eliminated a point.
        self.eliminated_any = False

    def begin(self, count: int) -> None:
        self.keeper = np.full(count, -1, np.int64)
        self.tried = 0

    def swapped(self, index: int) -> None:
        """Record that the first point became a vertex and that the point now at ``index`` took its position.

        If the index is negative, the new vertex was already a vertex: rounded arithmetic can report one as outside.
        """
        if index > 0:
            self.keeper[index] = self.keeper[0]
        self.keeper = self.keeper[1:]

    def strike_inside(self, points: PointTable, vertices: int, table: Equations) -> list[int]:
        """Eliminate the points inside all equations. Return their input indices, in their order in ``points``."""
        self.eliminated_any = False
        if len(points) <= vertices:
            return []
        alive = np.zeros(table.made + 1, np.bool_)
        alive[table.serial] = True
        # Statements 103 to 113: a point is inside if every equation is negative at it. A point with a recorded equation
        # that is still in the table cannot be inside, so only the other points are tested.
        doubtful = np.flatnonzero(~alive[self.keeper])
        fresh = int(np.searchsorted(table.serial, self.tried))
        # Test the new equations first: at most points one of them replaces the deleted one. The older equations are
        # needed only for points that are inside all the new ones.
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
    """The procedure ended without a hull. Holds the typed message and the label of the deciding statement."""

    def __init__(self, status: str, label: str) -> None:
        super().__init__(status, label)
        self.status, self.label = status, label


@dataclass
class Progress:
    """The result so far: the points eliminated as inside or boundary points, and the corrections that mattered."""

    inside: list[int] = field(default_factory=list)
    boundary: list[int] = field(default_factory=list)
    corrected: dict[str, None] = field(default_factory=dict)

    def correct(self, name: str) -> None:
        self.corrected[name] = None


# A function called at each H_j with its table and the fields of :class:`Grown`.
Watcher = Callable[[Equations, tuple[int, ...], int, int, list[int]], None]


class Growing(Protocol):
    """A hull under construction: the state of program 2 or 3."""

    points: PointTable
    remaining: Remaining
    table: Equations
    progress: Progress
    watch: Watcher | None
    vertices: int
    to_check: int

    def outside_point(self) -> int | None:
        """Return the index of the next vertex, or None if no equation has a point outside."""

    def expand(self, index: int) -> int:
        """Make the point at ``index`` a vertex, and return how many equations had the point outside."""


Hull = TypeVar("Hull", bound=Growing)


@dataclass(frozen=True, slots=True)
class Grown:
    """The points that a stage added and eliminated, by input index, and the numbers of checked and replaced ones."""

    added: tuple[int, ...]
    checked: int
    outside: int
    eliminated: list[int]


def stage(hull: Growing, first: bool) -> Grown | None:
    """Add the next vertex and eliminate the points inside. Return None if no point is outside."""
    if first:
        added, checked, outside = hull.points.input_indices(slice(0, hull.vertices)), 0, 0
    else:
        # The listing checks for supporting planes only after it has looked for inside points, and it ends here
        # if that left no points (program 3, 103; program 2, 128).
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
    """Run ``grow_stage`` until no point lies outside. It may run several stages at once if no caller watches them."""
    hull.remaining.begin(len(hull.points) - hull.vertices)
    growth = grow_stage(hull, True)
    while growth:
        hull.progress.inside += growth.eliminated
        if hull.watch:
            hull.watch(hull.table, growth.added, growth.checked, growth.outside, growth.eliminated)
        growth = grow_stage(hull, False)

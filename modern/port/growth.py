"""From H_1 to the hull of all points, the same in the plane and in space (thesis p. 20-33)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from modern.port.table import Equations, Places


class Remaining:
    """The points after the first ``vertices`` places, each with an equation it is not inside of."""

    def __init__(self) -> None:
        self.keeper: NDArray[np.int64] = np.empty(0, np.int64)
        """Serial number of an equation whose value is not negative; -1: none known."""
        self.tried = 0
        """Equations made before this serial number were there when the points were last looked at."""
        self.struck = False
        """Whether that eliminated any."""

    def begin(self, count: int) -> None:
        self.keeper = np.full(count, -1, np.int64)
        self.tried = 0

    def swapped(self, place: int) -> None:
        """The first of the points became a vertex, and the point in its place went to ``place``.

        A negative place is a vertex's; rounded numbers may find one outside.
        """
        if place > 0:
            self.keeper[place] = self.keeper[0]
        self.keeper = self.keeper[1:]

    def strike_inside(self, places: Places, vertices: int, table: Equations) -> list[int]:
        """Eliminate the inside points; returns which of the input they are, in order of place."""
        self.struck = False
        if len(places) <= vertices:
            return []
        alive = np.zeros(table.made + 1, np.bool_)
        alive[table.serial] = True
        doubtful = np.flatnonzero(~alive[self.keeper])
        fresh = int(np.searchsorted(table.serial, self.tried))
        for first in (fresh, 0) if 0 < fresh < len(table) else (0,):
            if not doubtful.size:
                break
            signs = table.signs(places.coordinates[:, vertices + doubtful], first)
            outer = signs >= 0
            kept = outer.any(axis=0)
            self.keeper[doubtful[kept]] = table.serial[first + outer.argmax(axis=0)[kept]]
            doubtful = doubtful[~kept]
        self.tried = table.made
        if not doubtful.size:
            return []
        self.struck = True
        wanted = np.ones(len(places), np.bool_)
        wanted[vertices + doubtful] = False
        self.keeper = self.keeper[wanted[vertices:]]
        return places.keep(wanted)


LAST_PAIR, LAST_REPEAT, THROUGH_CENTRE, TABLE_OF_PLANES = "P3-025", "P3-026", "P3-027", "P3-028"
TABLE_OF_LINES, BETWEEN, NUMBERING = "P2-023", "P2-024", "P2-025"
"""Rows of the layer ``corrected`` in the apparatus of programs 3 and 2 that can change what is punched."""


class Stopped(Exception):
    """The procedure ends without a hull: the message typed, and the label that decided."""

    def __init__(self, status: str, label: str) -> None:
        super().__init__(status, label)
        self.status, self.label = status, label


@dataclass
class Progress:
    """What is known so far: points struck as inside or as boundary points, and corrections that mattered."""

    inside: list[int] = field(default_factory=list)
    boundary: list[int] = field(default_factory=list)
    corrected: dict[str, None] = field(default_factory=dict)

    def correct(self, name: str) -> None:
        self.corrected[name] = None


Watcher = Callable[[Equations, tuple[int, ...], int, int, list[int]], None]
"""Called at each H_j: its table, the points added, NETC, how many equations they lay outside of, the points struck."""


class Growing(Protocol):
    """A hull in the making: the state of program 2 or 3."""

    places: Places
    remaining: Remaining
    table: Equations
    progress: Progress
    watch: Watcher | None
    vertices: int
    to_check: int

    def outside_point(self) -> int | None:
        """The place of the next vertex, None when every equation supports."""

    def expand(self, place: int) -> int:
        """Make the point there a vertex; how many equations it lay outside of."""


Hull = TypeVar("Hull", bound=Growing)


@dataclass(frozen=True, slots=True)
class Grown:
    """News of a stage: the points added, NETC, how many equations they lay outside of, the points struck."""

    added: tuple[int, ...]
    checked: int
    outside: int
    struck: list[int]


def stage(hull: Growing, first: bool) -> Grown | None:
    """Take in the next point and strike what lies inside; None when no point lies outside.

    ``first``: the stage is H_1 itself, which is there.  Raises Stopped.
    """
    if first:
        added, checked, outside = hull.places.names(slice(0, hull.vertices)), 0, 0
    else:
        if len(hull.places) == hull.vertices and not hull.remaining.struck:
            return None
        place = hull.outside_point()
        if place is None:
            return None
        checked = hull.to_check + 1
        added = hull.places.names(slice(place, place + 1))
        outside = hull.expand(place)
    return Grown(added, checked, outside, hull.remaining.strike_inside(hull.places, hull.vertices, hull.table))


def grow(hull: Hull, grown: Callable[[Hull, bool], Grown | None] = stage) -> None:
    """Stage after stage until no point lies outside.  Raises Stopped.

    ``grown`` is :func:`stage` or a faster form of it, which may take several stages at once if none watches.
    """
    hull.remaining.begin(len(hull.places) - hull.vertices)
    news = grown(hull, True)
    while news:
        hull.progress.inside += news.struck
        if hull.watch:
            hull.watch(hull.table, news.added, news.checked, news.outside, news.struck)
        news = grown(hull, False)

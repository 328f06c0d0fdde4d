"""From H_1 to the hull of all points, the same in the plane and in space (thesis p. 20-33)."""

from __future__ import annotations

from typing import Protocol

from modern.port.equations import Equations
from modern.port.inside import Remaining
from modern.port.places import Places
from modern.port.progress import Progress, Watcher


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


def grow(hull: Growing) -> None:
    """Strike what lies inside and take in the next point until none lies outside.  Raises Stopped."""
    hull.remaining.begin(len(hull.places) - hull.vertices)
    added: tuple[int, ...] = hull.places.names(slice(0, hull.vertices))
    checked, outside = 0, 0
    while True:
        struck = hull.remaining.strike_inside(hull.places, hull.vertices, hull.table)
        hull.progress.inside += struck
        if hull.watch:
            hull.watch(hull.table, added, checked, outside, struck)
        if len(hull.places) == hull.vertices and not struck:
            return
        place = hull.outside_point()
        if place is None:
            return
        checked = hull.to_check + 1
        added = hull.places.names(slice(place, place + 1))
        outside = hull.expand(place)

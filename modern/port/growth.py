"""From H_1 to the hull of all points, the same in the plane and in space (thesis p. 20-33)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol, TypeVar

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

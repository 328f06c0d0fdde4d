"""Which of the points still to be considered lie inside the hull so far (thesis p. 22-23, 29; programs 2 and 3).

The programs put every point into every equation at every stage.  A point stays where some equation's value is
not negative; so each point keeps one such equation, and is put into others only when that one is struck.
What is decided is the same.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from modern.port.equations import Equations
from modern.port.places import Places


class Remaining:
    """The points behind the first ``vertices`` places, each with an equation it is not inside of."""

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

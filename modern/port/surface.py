"""What the final planes say of the points, the end of program 3 (thesis p. 33, listing p. 97-102).

Comments give statement labels.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from modern.port.equations import Equations
from modern.port.progress import LAST_REPEAT, Progress

On = list[NDArray[np.int64]]


def strike_repeats(table: Equations, on: On, places: int, progress: Progress) -> On:
    """One equation of each plane stays, the first (164 to 174); of the places that satisfy each, what stays of them.

    An equation is struck when the three points of an earlier one satisfy it.
    """
    mm, nn, kk = table.defining
    struck_by = np.full(len(table), -1)
    member = np.zeros(places, np.bool_)
    for k, points in enumerate(on):
        if k and not (len(points) == 3 and set(points.tolist()) == {mm[k], nn[k], kk[k]}):
            member[points] = True
            earlier = np.flatnonzero(member[mm[:k]] & member[nn[:k]] & member[kk[:k]] & (struck_by[:k] < 0))
            member[points] = False
            if earlier.size:
                struck_by[k] = earlier[0]
    wanted = struck_by < 0
    # The listing looks beyond the table when an equation has struck the last of those behind it.
    last = np.flatnonzero(wanted)[-1]
    if (struck_by == last).any():
        progress.mend(LAST_REPEAT)
    table.keep(wanted)
    return [points for k, points in enumerate(on) if wanted[k]]


def vertices(on: On, count: int, places: int) -> NDArray[np.bool_]:
    """Which of the places are vertices: of the first ``count`` those that satisfy three equations (174 to 182)."""
    planes = np.bincount(np.concatenate(on), minlength=places)
    return np.asarray((planes >= 3) & (np.arange(places) < count), dtype=np.bool_)

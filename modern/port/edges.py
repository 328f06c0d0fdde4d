"""What the final lines say of the points, the end of program 2 (thesis p. 26-28, listing p. 82-86).

Comments give statement labels.  Places and equations count from 0.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from modern.geometry.hull import ERROR
from modern.port.arithmetic import Arithmetic
from modern.port.equations import Equations
from modern.port.formulas import distance_squared
from modern.port.places import Places
from modern.port.progress import BETWEEN, NUMBERING, Progress, Stopped


def strike_between(
    arithmetic: Arithmetic, table: Equations, places: Places, progress: Progress
) -> tuple[NDArray[np.int64], list[int]]:
    """Points between two others of their line are no vertices, and a line has one equation (144 to 169).

    Returns for each equation that stays the two places it ends at, and the places that are no vertices, in the
    order they are found.  Raises Stopped.
    """
    ends = table.defining.copy()
    gone: list[int] = []
    u, v, _ = places.rows
    k = 0
    while k < len(table):
        on = np.flatnonzero(arithmetic.sign(table.one_at(k, (u, v))) == 0).tolist()
        third = next((i for i in on if i not in ends[:, k]), None)
        if third is not None:
            mm, nn = ends[:, k].tolist()
            between = middle(arithmetic, places, (mm, nn, third), progress)
            ends[:, k] = [third if end == between else end for end in (mm, nn)]
            gone.append(between)
            progress.boundary.append(int(places.who[between]))
            wanted = other_lines(arithmetic, table, places, ends[:, k], k)
            table.keep(wanted)
            ends = ends[:, wanted]
            if len(table) <= k:
                raise Stopped(ERROR, "program2 112")
        k += 1
    if listed_numbers(ends, gone) != lowered(ends, gone):
        progress.mend(NUMBERING)
    return ends, gone


def other_lines(
    arithmetic: Arithmetic, table: Equations, places: Places, ends: NDArray[np.int64], keep: int
) -> NDArray[np.bool_]:
    """Which equations stay when those that both ends satisfy are struck, but for the one ``keep`` (161 to 167).

    As in the listing KK stays a place in the table while the equations before it are struck; exactly there are
    none, since a line has two equations and the first of them comes first.  Raises Stopped.
    """
    first, second = (places.at(int(i))[:2] for i in ends)
    both = (arithmetic.sign(table.all_at(first)) == 0) & (arithmetic.sign(table.all_at(second)) == 0)
    left = list(range(len(table)))
    i = 0
    while i < len(left):
        if not both[left[i]]:
            i += 1
        elif i != keep:
            del left[i]
        elif i == len(left) - 1:
            raise Stopped(ERROR, "program2 162")  # the listing looks beyond the table
        else:
            i += 1
    wanted = np.zeros(len(table), np.bool_)
    wanted[left] = True
    return wanted


def middle(arithmetic: Arithmetic, places: Places, three: tuple[int, int, int], progress: Progress) -> int:
    """Which of three points of a line lies between the others: before it is the longest side (155 to 157)."""
    (u1, v1, _), (u2, v2, _), (u3, v3, _) = (places.at(i) for i in three)
    a = distance_squared(u1, v1, u2, v2)
    b = distance_squared(u1, v1, u3, v3)
    c = distance_squared(u2, v2, u3, v3)
    signs = arithmetic.sign(arithmetic.filled([a + b - c, a + c - b])) < 0
    found = 0 if signs[0] else 1 if signs[1] else 2
    # The listing compares the distances themselves, which are roots and need not add up.
    listed = 0 if arithmetic.distances_add_up(a, b, c) else 1 if arithmetic.distances_add_up(a, c, b) else 2
    if found != listed:
        progress.mend(BETWEEN)
    return three[found]


def lowered(ends: NDArray[np.int64], gone: Sequence[int]) -> list[int]:
    """Numbers of the vertices once those before them that are none are left out."""
    return [end - sum(g < end for g in set(gone)) for end in ends.ravel().tolist()]


def listed_numbers(ends: NDArray[np.int64], gone: Sequence[int]) -> list[int]:
    """The same as the listing counts, from the first point on (179+2 to 191)."""
    numbers = []
    for number in ends.ravel().tolist():
        for g in sorted(set(gone)):
            if number >= g:
                number -= 1
        numbers.append(number)
    return numbers

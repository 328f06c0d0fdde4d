"""Pairs of contour lines: which may overlap, and the PL and LP tables of those that do (section 3.2).

Pairs whose bounding boxes overlap are found on a grid of cells.  Boxes are in floating point, widened by more than its
rounding, so that no pair is lost; a pair too many costs a table.

The tables are those of formulas (2) and (3), with properties 1 to 4.  V has the vertices P_i, V' the vertices P_j, both
clockwise.  ``PL[j][i]`` is the side of the segment from P_i to P_(i+1) on which P_j lies, ``LP[j][i]`` that of the
segment from P_j to P_(j+1) on which P_i lies; 1 is the inner side.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from modern.papers.nakamae_nishita.projection import Homogeneous

Box = tuple[float, float, float, float]

_ROOM = 2.0**-50
_CELLS = 1 << 12


def boxes(contours: Sequence[Sequence[Homogeneous]]) -> list[Box | None]:
    """The box of each contour, left, right, low, high, within -1 to 1; None of an empty one.

    All images are divided by one power of two that brings them within -1 to 1.  Integers divided by integers are
    rounded correctly at any length, so an end is off by 2**-54 at the most, and is moved outward by 2**-50.
    """
    shift = max(
        (max(abs(x), abs(y)).bit_length() - w.bit_length() + 1 for contour in contours for x, y, _, w in contour),
        default=0,
    )
    up, down = max(shift, 0), max(-shift, 0)
    found: list[Box | None] = []
    for contour in contours:
        if not contour:
            found.append(None)
            continue
        xs = [(x << down) / (w << up) for x, _, _, w in contour]
        ys = [(y << down) / (w << up) for _, y, _, w in contour]
        found.append((min(xs) - _ROOM, max(xs) + _ROOM, min(ys) - _ROOM, max(ys) + _ROOM))
    return found


def overlapping(found: Sequence[Box | None]) -> Iterator[tuple[int, int]]:
    """The pairs of places, the smaller first, sorted, whose boxes overlap.

    The grid has about one cell for each box, so that boxes of like size which lie apart cost a fixed time each.
    """
    kept = [(place, box) for place, box in enumerate(found) if box is not None]
    if len(kept) < 2:
        return
    left, right = min(box[0] for _, box in kept), max(box[1] for _, box in kept)
    low, high = min(box[2] for _, box in kept), max(box[3] for _, box in kept)
    many = min(math.isqrt(len(kept)) + 1, _CELLS)
    across, upward = many / (right - left), many / (high - low)
    cells: dict[tuple[int, int], list[tuple[int, Box, int, int]]] = defaultdict(list)
    for place, box in kept:
        first, lowest = int((box[0] - left) * across), int((box[2] - low) * upward)
        for column in range(first, int((box[1] - left) * across) + 1):
            for row in range(lowest, int((box[3] - low) * upward) + 1):
                cells[column, row].append((place, box, first, lowest))
    pairs = []
    for (column, row), group in cells.items():
        for order, (place, a, first, lowest) in enumerate(group):
            for other, b, second, second_low in group[:order]:
                # Two boxes share several cells; the pair is taken in the first of them.
                if (
                    max(first, second) == column
                    and max(lowest, second_low) == row
                    and a[0] <= b[1]
                    and b[0] <= a[1]
                    and a[2] <= b[3]
                    and b[2] <= a[3]
                ):
                    pairs.append((other, place))
    yield from sorted(pairs)


Row = tuple[int, ...]
Line = tuple[int, int, int]
Values = list[list[int]]

CROSSING = -4
"""The number d of formula (3) where two segments intersect."""


def values(lines: Sequence[Line], points: Sequence[tuple[int, int, int, int]]) -> Values | None:
    """Formula (1) of every point for every line, a list for each line; None where a line has no point on its right.

    That is property 1: a column of PL, or a row of LP, without a 1, and the contours do not overlap.
    """
    found = []
    for a, b, c in lines:
        column = [a * x + b * y + c * w for x, y, _, w in points]
        if max(column) <= 0:
            return None
        found.append(column)
    return found


@dataclass(frozen=True, slots=True)
class Tables:
    """The two tables, rows for the vertices of V' and columns for those of V, as the paper sets them out."""

    pl: tuple[Row, ...]
    lp: tuple[Row, ...]

    def crossing_number(self, i: int, j: int) -> int:
        """d of formula (3): -4 the segments intersect, -2 a vertex lies on a segment, -1 on a vertex, 0 neither.

        Segments that overlap in a line have 0 as well.
        """
        after_i, after_j = (i + 1) % len(self.pl[0]), (j + 1) % len(self.pl)
        return (self.lp[j][after_i] - self.lp[j][i]) * (self.pl[after_j][i] - self.pl[j][i])

    def crossings(self) -> Iterator[tuple[int, int]]:
        """The pairs i, j of segments that intersect."""
        pl, lp = self.pl, self.lp
        nexts = range(1, len(pl[0]))
        for j, (row, after) in enumerate(zip(pl, (*pl[1:], pl[0]), strict=True)):
            sides = lp[j]
            for i, k in enumerate((*nexts, 0)):
                # A product of -4: both differences are 2, of either sign.
                if (sides[k] - sides[i]) * (after[i] - row[i]) == CROSSING:
                    yield i, j

    @property
    def encloses(self) -> bool:
        """Property 2: V encloses V'."""
        return not any(-1 in row for row in self.pl)

    @property
    def enclosed(self) -> bool:
        """Property 2 of LP: V' encloses V."""
        return not any(-1 in row for row in self.lp)


def tables(of_near: Values, of_far: Values) -> Tables:
    """The tables from the values of V's segments at the P_j, and of those of V' at the P_i."""
    signs = [[(f > 0) - (f < 0) for f in column] for column in of_near]
    return Tables(tuple(zip(*signs, strict=True)), tuple(tuple((f > 0) - (f < 0) for f in row) for row in of_far))

"""The PL and LP tables of two contour lines and what they show (section 3.2: formulas (2) and (3), properties 1 to 4).

V has the vertices P_i, V' the vertices P_j, both clockwise.  ``PL[j][i]`` is the side of the segment from P_i to
P_(i+1) on which P_j lies, ``LP[j][i]`` that of the segment from P_j to P_(j+1) on which P_i lies; 1 is the inner side.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

Row = tuple[int, ...]
Line = tuple[int, int, int]
Values = list[list[int]]

CROSSING, ON_SEGMENT, ON_VERTEX, APART = -4, -2, -1, 0


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
    def separate(self) -> bool:
        """Property 1: the contours do not overlap."""
        return any(1 not in column for column in zip(*self.pl, strict=True)) or any(1 not in row for row in self.lp)

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

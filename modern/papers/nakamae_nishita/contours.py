"""Find pairs of polyhedra that may overlap in the picture, and compute the tables PL and LP of a pair (section 3.2).

Only pairs with overlapping bounding boxes are compared. The boxes are in floating point and are widened by more than
the rounding error, so no pair is lost. A superfluous pair costs only the time for its tables.

The tables are those of formulas (2) and (3). By the paper's properties 1 to 4, they tell if two contours are apart, if
one encloses the other, and which segments can intersect. The contour of V has the vertices
P_i, and the contour of V' the vertices P_j, both clockwise. ``PL[j][i]`` tells on which side of the segment from P_i to
P_(i+1) the vertex P_j lies. ``LP[j][i]`` tells on which side of the segment from P_j to P_(j+1) the vertex P_i lies.
The value 1 stands for the inner side, -1 for the outer side, and 0 for the line itself.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from modern.papers.nakamae_nishita.projection import Homogeneous

Box = tuple[float, float, float, float]

_MARGIN = 2.0**-50


def boxes(contours: Sequence[Sequence[Homogeneous]]) -> list[Box | None]:
    """Return the bounding box (left, right, low, high) of each contour in the picture, or None for an empty contour.

    All coordinates are divided by one power of two, so that they lie from -1 to 1. Python rounds quotients of integers
    correctly, so each side of a box has an error of at most 2**-54. Each side is moved outward by 2**-50.
    """
    shift = max(
        (max(abs(x), abs(y)).bit_length() - w.bit_length() + 1 for contour in contours for x, y, _, w in contour),
        default=0,
    )
    up, down = max(shift, 0), max(-shift, 0)
    all_boxes: list[Box | None] = []
    for contour in contours:
        if not contour:
            all_boxes.append(None)
            continue
        xs = [(x << down) / (w << up) for x, _, _, w in contour]
        ys = [(y << down) / (w << up) for _, y, _, w in contour]
        all_boxes.append((min(xs) - _MARGIN, max(xs) + _MARGIN, min(ys) - _MARGIN, max(ys) + _MARGIN))
    return all_boxes


def overlapping(all_boxes: Sequence[Box | None]) -> list[tuple[int, int]]:
    """Return the pairs of indices of boxes that overlap, in increasing order."""
    ordered = sorted((box, index) for index, box in enumerate(all_boxes) if box is not None)
    pairs = []
    for place, (a, index_a) in enumerate(ordered):
        # The boxes are sorted by their left sides, so the first box to the right of box a ends the search.
        for later in range(place + 1, len(ordered)):
            b, index_b = ordered[later]
            if b[0] > a[1]:
                break
            if a[2] <= b[3] and b[2] <= a[3]:
                pairs.append((min(index_a, index_b), max(index_a, index_b)))
    return sorted(pairs)


Row = tuple[int, ...]
Line = tuple[int, int, int]
Values = list[list[int]]

# The number d of formula (3) if two segments intersect.
CROSSING = -4


def values(lines: Sequence[Line], points: Sequence[tuple[int, int, int, int]]) -> Values | None:
    """Return the values of formula (1), a line's equation, for each line (rows) at each point (columns).

    A value is positive if the point is on the inner side of the line. Return None if there is a line with no
    point on its inner side. The contours then do not overlap (property 1).
    """
    columns = []
    # Formula (1) for a point (x, y, w) and the line of a segment: positive on its right, the inside of the contour.
    for a, b, c in lines:
        column = [a * x + b * y + c * w for x, y, _, w in points]
        if max(column) <= 0:
            return None
        columns.append(column)
    return columns


@dataclass(frozen=True, slots=True)
class Tables:
    """The paper's tables PL and LP for two contours V and V', as described at the head of this module.

    The rows belong to the vertices of V', and the columns to the vertices of V.
    """

    pl: tuple[Row, ...]
    lp: tuple[Row, ...]

    def crossing_number(self, i: int, j: int) -> int:
        """Return d of the paper's formula (3), which tells how segment i of V and segment j of V' meet.

        d is -4 if the segments intersect, -2 if an end of one segment lies on the other segment, and -1 if two ends
        coincide. Otherwise it is 0, even if the segments overlap in one line.
        """
        after_i, after_j = (i + 1) % len(self.pl[0]), (j + 1) % len(self.pl)
        # Both differences are 2 in absolute value if each segment has its ends on opposite sides of the other.
        return (self.lp[j][after_i] - self.lp[j][i]) * (self.pl[after_j][i] - self.pl[j][i])

    def crossings(self) -> Iterator[tuple[int, int]]:
        """Yield the pairs (i, j) for which segment i of V and segment j of V' intersect."""
        pl, lp = self.pl, self.lp
        nexts = range(1, len(pl[0]))
        for j, (row, after) in enumerate(zip(pl, (*pl[1:], pl[0]), strict=True)):
            sides = lp[j]
            for i, k in enumerate((*nexts, 0)):
                # The product is -4 only if both differences are 2 in absolute value and have opposite signs.
                if (sides[k] - sides[i]) * (after[i] - row[i]) == CROSSING:
                    yield i, j

    @property
    def encloses(self) -> bool:
        """True if contour V encloses contour V' in the picture (property 2 in the paper)."""
        return not any(-1 in row for row in self.pl)

    @property
    def enclosed(self) -> bool:
        """True if contour V' encloses contour V in the picture (property 2 in the paper)."""
        return not any(-1 in row for row in self.lp)


def tables(of_near: Values, of_far: Values) -> Tables:
    """Return the tables PL and LP of two contours V and V': the signs of their lines' equations at their vertices.

    ``of_near`` has the values of formula (1), the equation of a line, for the segments of V at the vertices of V', and
    ``of_far`` has those for the segments of V' at the vertices of V.
    """
    signs = [[(f > 0) - (f < 0) for f in column] for column in of_near]
    return Tables(tuple(zip(*signs, strict=True)), tuple(tuple((f > 0) - (f < 0) for f in row) for row in of_far))

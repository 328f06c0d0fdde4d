"""Find the points at which a segment passes behind a contour and emerges again (sections 3.4 and 3.5, formula (6)).

A point on a segment from P_A to P_B is given by its distance s from P_A in space, as a fraction of the segment's
length. The index of an intersection is +k if the segment enters the contour there and -k if the segment leaves the
contour. k is the number of intersections of the segment and the contour.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from modern.drawing.visible import line_through, sign
from modern.papers.nakamae_nishita.contours import CROSSING, Values
from modern.papers.nakamae_nishita.projection import Homogeneous

Mark = tuple[Fraction, int]


@dataclass(frozen=True, slots=True)
class Passage:
    """The course of a segment behind one contour.

    ``marks`` has the points at which the segment enters or leaves the contour, each as its distance s and its index,
    the paper's I_0. ``enclosed`` is True if the whole segment lies within the contour and has no such point.
    """

    marks: tuple[Mark, ...]
    enclosed: bool = False

    @property
    def order(self) -> int:
        """1 if this contour hides the segment's first end, else 0.

        The paper calls the sum of these numbers for all contours the order of invisibility. A contour hides the first
        end if the segment begins behind the contour and leaves it (index -1).
        """
        return sum(index == -1 for _, index in self.marks)


CLEAR = Passage(())
ENCLOSED = Passage((), True)


def clipped(values: Values, first: int, last: int) -> Passage:
    """Return the passage of a segment behind a contour.

    The result is correct also if the segment meets the contour's vertices. ``values`` has the values of formula (1), a
    line's equation, for each segment of the contour (rows) at all points (columns). ``first`` and ``last`` are the
    columns of the segment's ends. The segment is clipped to the inner side of each line of the contour. Therefore only
    a part of positive length strictly within the contour is hidden.
    """
    # The hidden part is from enter_up / enter_down to leave_up / leave_down, as fractions of the segment. Formula (1)
    # is linear along the segment, from a at P_A to b at P_B. The greatest entry and the least exit over all lines bound
    # the part inside. For speed, the fractions are compared by cross multiplication.
    enter_up, enter_down, leave_up, leave_down = 0, 1, 1, 1
    for column in values:
        a, b = column[first], column[last]
        if a < 0:
            if b <= 0:
                return CLEAR
            if -a * enter_down > enter_up * (b - a):
                enter_up, enter_down = -a, b - a
        elif b < 0:
            if not a:
                return CLEAR
            if a * leave_down < leave_up * (a - b):
                leave_up, leave_down = a, a - b
        elif not (a or b):
            return CLEAR
    # A part of length 0 is not hidden: the segment only touches the contour.
    if enter_up * leave_down >= leave_up * enter_down:
        return CLEAR
    enters, leaves = enter_up > 0, leave_up < leave_down
    if not (enters or leaves):
        return ENCLOSED
    # The index of formula (6) is +k where the segment enters and -k where it leaves, for k intersections.
    k = enters + leaves
    marks = [(Fraction(enter_up, enter_down), k)] if enters else []
    if leaves:
        marks.append((Fraction(leave_up, leave_down), -k))
    return Passage(tuple(marks))


def as_printed(
    values: Values, first: int, last: int, ends: tuple[Homogeneous, Homogeneous], contour: Sequence[Homogeneous]
) -> Passage:
    """Return the passage by the paper's formulas, which miss an intersection at a vertex of the contour.

    ``values``, ``first`` and ``last`` are as in ``clipped``. ``ends`` are the ends of the segment, and ``contour`` has
    the contour's vertices.
    """
    a, b, c = line_through(_flat(ends[0]), _flat(ends[1]))
    sides = [sign(a * x + b * y + c * w) for x, y, _, w in contour]
    places = []
    for i, column in enumerate(values):
        at_a, at_b = column[first], column[last]
        # Formula (3) for contour segment i: -4 if its ends and those of the segment lie on opposite sides.
        d = (sides[(i + 1) % len(sides)] - sides[i]) * (sign(at_b) - sign(at_a))
        if d == CROSSING:
            places.append((Fraction(at_a, at_a - at_b), sign(at_b - at_a)))
    if not places:
        # Properties 3 and 4: neither end is outside a segment of the contour, and not both ends are on one segment.
        within = all(min(column[first], column[last]) >= 0 < max(column[first], column[last]) for column in values)
        return ENCLOSED if within else CLEAR
    return Passage(tuple((place, len(places) * sense) for place, sense in sorted(places)))


def _flat(point: Homogeneous) -> tuple[int, int, int]:
    return point[0], point[1], point[3]

"""Search a quadtree for the second face at an edge of the envelope (Theorem 2 and section 4.6.2).

Angles are compared exactly. The angle between two integer normals p and q has a greater cosine if the number
(p . q) |p . q| / (q . q) is greater, because p, the normal of the known face, is the same in all comparisons.

``Search`` follows the paper square by square and counts the steps of its search. It can follow each statement of the
paper as printed instead of as corrected. ``Candidates`` finds the same
points in the same order by one pass over arrays of all points.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

import numpy as np

from modern.digital.intervals import Grid
from modern.papers.yau_srihari.octree import QUADRANTS, interleaved
from modern.papers.yau_srihari.printed import Printed
from modern.papers.yau_srihari.quadtree import NO_COLUMN, Point, Quadtree, bounds_by_level

Normal = tuple[int, int, int]
Bounds = tuple[Fraction | None, Fraction | None]


def normal_of(u: Point, v: Point, w: Point) -> Normal:
    """Return the normal of the plane of three points. From the side to which it points, they run counterclockwise."""
    ax, ay, az = v[0] - u[0], v[1] - u[1], v[2] - u[2]
    bx, by, bz = w[0] - u[0], w[1] - u[1], w[2] - u[2]
    return ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx


@dataclass(slots=True)
class Search:
    """A search for the second face at the directed edge from ``start`` to ``end``, as the paper describes it.

    ``normal`` is the outward normal of the edge's known face. ``best`` is the best score (see :meth:`score`) of the
    points examined so far, and ``points`` are the points with this score in the order of the search. ``sure`` is the
    paper's w, a score that at least one point is known to reach. ``visited`` is the number of visited nodes, and
    ``angles`` is the number of angles computed for points and for corners of squares.
    """

    start: Point
    end: Point
    normal: Normal
    printed: Printed
    best: Fraction | None = None
    points: list[Point] = field(default_factory=list)
    sure: Fraction | None = None
    visited: int = 0
    angles: int = 0

    def run(self, tree: Quadtree) -> list[Point]:
        """Return the unmarked points in the plane of the edge's second face."""
        levels = bounds_by_level(tree)
        self._visit(levels, len(levels) - 1, 0, 0)
        return self.points

    def score(self, point: Point) -> Fraction | None:
        """Return a number that grows with the cosine of the angle between the known face and the face through a point.

        Return None for a point on the line of the edge. The points of the second face have the greatest score. If
        Theorem 2 is applied as printed, the sign of the score is reversed.
        """
        self.angles += 1
        a, b, c = normal_of(self.start, self.end, point)
        if not (a or b or c):
            return None
        dot = a * self.normal[0] + b * self.normal[1] + c * self.normal[2]
        cosine = Fraction(dot * abs(dot), a * a + b * b + c * c)
        return -cosine if self.printed.angle else cosine

    def beyond(self, x: int, y: int) -> bool:
        """Return True if (x, y) is on the side of the edge on which the second face can lie, as seen from above."""
        ex, ey = self.end[0] - self.start[0], self.end[1] - self.start[1]
        return ex * (y - self.start[1]) < ey * (x - self.start[0])

    def _visit(self, levels: list[tuple[Grid, Grid]], up: int, i: int, j: int) -> None:
        """Search a square of the tree, and those of its quarters that the bounds of their scores do not exclude."""
        self.visited += 1
        low, side = levels[up][0].item(i, j), 1 << up
        # Rule 1 of section 4.6.2: a square on the known side of the edge, or without points, is skipped.
        if low == NO_COLUMN or not any(self.beyond(*corner) for corner in _corners(i * side, j * side, side)):
            return
        if not up:
            self.take((i, j, low))
            return
        least_of, most_of = levels[up - 1]
        half = side // 2
        sons = []
        for k, m in ((2 * i + a, 2 * j + b) for a, b in QUADRANTS):
            low = least_of.item(k, m)
            least = most = None
            if low != NO_COLUMN:
                least, most = self.bounds(low, most_of.item(k, m), k * half, m * half, half)
            sons.append((k, m, most))
            # w is the greatest delta_1 so far: at least one point of that son has this score or a greater score.
            if least is not None and (self.sure is None or least > self.sure):
                self.sure = least
        for k, m, most in sons:
            # Rule 2: a son whose delta_2 is below w cannot contain the best point. Sons without bounds are divided.
            if most is None or self.sure is None or most >= self.sure:
                self._visit(levels, up - 1, k, m)

    def bounds(self, low: int, high: int, x: int, y: int, side: int) -> Bounds:
        """Return bounds for the scores of points in a square: the paper's delta_1 and delta_2.

        At least one point of the square has a score (see :meth:`score`) of at least delta_1, and no point has a score
        above delta_2. Both bounds are None if the corners of the square do not determine them.

        The lower a point is, the smaller is the angle between the known face and the face through the point. The least
        height in the square therefore gives both bounds, because no point is lower and one point has this height. If
        Theorem 2 is applied as printed, the greatest height is needed.
        """
        places = list(_corners(x, y, side))
        # The corners are known to have the extreme scores only if the whole square lies beyond the edge.
        if not self.printed.corners and not all(self.beyond(*place) for place in places):
            return None, None
        z = high if self.printed.bound or self.printed.angle else low
        scores = [score for i, j in places if (score := self._corner((i, j, z))) is not None]
        return (min(scores), max(scores)) if scores else (None, None)

    def _corner(self, corner: Point) -> Fraction | None:
        """Return the score of a corner of a square.

        No point of the floor is below the plane of the known face, but a corner of a square may be. The angle would
        grow again on that side, so such a corner counts as lying in the plane, with the angle 0.
        """
        (a, b, c), (x, y, z) = self.normal, self.start
        outside = a * (corner[0] - x) + b * (corner[1] - y) + c * (corner[2] - z) > 0
        if not outside or self.printed.bound:
            return self.score(corner)
        angle_zero = Fraction(a * a + b * b + c * c)
        return -angle_zero if self.printed.angle else angle_zero

    def take(self, point: Point) -> None:
        score = self.score(point)
        assert score is not None
        if self.best is None or score > self.best:
            self.best, self.points = score, []
        if score == self.best:
            self.points.append(point)


def _corners(x: int, y: int, side: int) -> Iterator[tuple[int, int]]:
    last = side - 1
    for i, j in QUADRANTS if last else QUADRANTS[:1]:
        yield x + i * last, y + j * last


class Candidates:
    """The points that may be vertices of faces, as an array, which is searched faster than a tree."""

    def __init__(self, points: Sequence[Point]) -> None:
        table = np.array(points, dtype=np.int64).reshape(-1, 3).T
        order = np.argsort(interleaved(table[0], table[1]))
        self._points = [points[k] for k in order.tolist()]
        self._row = {point: k for k, point in enumerate(self._points)}
        self._unmarked = np.ones(len(points), dtype=np.bool_)
        self._table = table[:, order]

    def face_on(self, start: Point, end: Point) -> list[Point]:
        """Return the unmarked points in the plane of an edge's second face, in the same order as ``Search.run``."""
        ex, ey = end[0] - start[0], end[1] - start[1]
        x, y, _ = self._table
        candidates = np.flatnonzero((ex * y - ey * x < ex * start[1] - ey * start[0]) & self._unmarked)
        # Rotate a plane about the edge: as long as points are outside, it passes through the farthest of them. A point
        # that is not outside never is outside again.
        outermost = 0
        while len(candidates):
            a, b, c = normal_of(start, end, self._points[candidates[outermost]])
            x, y, z = self._table[:, candidates]
            heights = a * (x - start[0]) + b * (y - start[1]) + c * (z - start[2])
            if heights.max() <= 0:
                return [self._points[k] for k in candidates[heights == 0].tolist()]
            outside = heights > 0
            candidates, outermost = candidates[outside], int(heights[outside].argmax())
        return []

    def mark(self, in_face: Iterable[Point], vertices: Iterable[Point]) -> None:
        """Exclude the points of a face from later searches, but not its vertices, which neighbouring faces share."""
        shared = {*vertices}
        self._unmarked[[self._row[point] for point in in_face if point not in shared]] = False

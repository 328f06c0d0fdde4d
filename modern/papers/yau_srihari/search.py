"""The search of a quadtree for the face that stands on an edge (Theorem 2 and section 4.6.2).

Angles are compared exactly: the cosine of the angle between two integer normals p and q has the order of
(p . q) |p . q| / (q . q), p being the same for all that are compared.

``Search`` is the paper's, square after square, with its counts, and with statements taken as printed.  ``Candidates``
finds the same points, in the same order, by one pass over arrays of all points.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

import numpy as np

from modern.digital.columns import Grid
from modern.papers.yau_srihari.octree import QUADRANTS, interleaved
from modern.papers.yau_srihari.printed import Printed
from modern.papers.yau_srihari.quadtree import NO_COLUMN, Point, Quadtree, bounds_by_level

Normal = tuple[int, int, int]
Bounds = tuple[Fraction | None, Fraction | None]

ROUNDED = 2.0**-48
"""More than is rounded away of a score in float64: a product and a quotient, at most a part of 2 ** -53 each."""


def normal_of(u: Point, v: Point, w: Point) -> Normal:
    """The normal of the plane of three points, to the side from which they run counterclockwise."""
    ax, ay, az = v[0] - u[0], v[1] - u[1], v[2] - u[2]
    bx, by, bz = w[0] - u[0], w[1] - u[1], w[2] - u[2]
    return ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx


@dataclass(slots=True)
class Search:
    """The face on the directed edge ``start`` to ``end``, whose other face has the outward normal ``normal``.

    ``best``: the score of the best point found, ``points``: all that reach it, in the order of the search; ``sure``:
    the paper's w, a score that some point is known to reach; ``visited``: nodes looked at; ``angles``: how often an
    angle was computed, for a point or for a corner of a square.
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
        """The points of the tree, not marked, in the next face's plane beyond the edge; empty where there is none."""
        levels = bounds_by_level(tree)
        self._visit(levels, len(levels) - 1, 0, 0)
        return self.points

    def score(self, point: Point) -> Fraction | None:
        """What is to be greatest: the cosine of the angle to the other face in order, negative for Theorem 2 as
        printed; None on the edge's own line."""
        self.angles += 1
        a, b, c = normal_of(self.start, self.end, point)
        if not (a or b or c):
            return None
        dot = a * self.normal[0] + b * self.normal[1] + c * self.normal[2]
        cosine = Fraction(dot * abs(dot), a * a + b * b + c * c)
        return -cosine if self.printed.angle else cosine

    def beyond(self, x: int, y: int) -> bool:
        """Whether a place lies on the side of the edge where a face over it has a normal that points down."""
        ex, ey = self.end[0] - self.start[0], self.end[1] - self.start[1]
        return ex * (y - self.start[1]) < ey * (x - self.start[0])

    def _visit(self, levels: list[tuple[Grid, Grid]], up: int, i: int, j: int) -> None:
        """Look at the square (i, j) of the side 2 ** ``up``, and at those of its sons that are not ruled out."""
        self.visited += 1
        low, side = levels[up][0].item(i, j), 1 << up
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
            if least is not None and (self.sure is None or least > self.sure):
                self.sure = least
        for k, m, most in sons:
            if most is None or self.sure is None or most >= self.sure:
                self._visit(levels, up - 1, k, m)

    def bounds(self, low: int, high: int, x: int, y: int, side: int) -> Bounds:
        """The paper's delta_1 and delta_2 of a square at (x, y), by its least and greatest height: some point of it
        scores no less than the one, none more than the other.  None where they cannot be told from its corners.

        The lower a point, the less the plane through it is turned from the other face.  So the square's least height
        bounds both: no point of it is lower, and one is as low.  For Theorem 2 as printed it is the greatest height.
        """
        places = list(_corners(x, y, side))
        if not self.printed.corners and not all(self.beyond(*place) for place in places):
            return None, None
        z = high if self.printed.bound or self.printed.angle else low
        scores = [score for i, j in places if (score := self._corner((i, j, z))) is not None]
        return (min(scores), max(scores)) if scores else (None, None)

    def _corner(self, corner: Point) -> Fraction | None:
        """The score of a square's corner.

        No point of the floor is below the other face's plane, but a corner may be: there the plane would be turned
        the other way, and the angle grow again.  It counts as not turned at all.
        """
        (a, b, c), (x, y, z) = self.normal, self.start
        outside = a * (corner[0] - x) + b * (corner[1] - y) + c * (corner[2] - z) > 0
        if not outside or self.printed.bound:
            return self.score(corner)
        unturned = Fraction(a * a + b * b + c * c)
        return -unturned if self.printed.angle else unturned

    def take(self, point: Point) -> None:
        """A point found: it is kept if none found before scores more."""
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
    """The points a face may have as vertices, as arrays, in the order in which a search of their quadtree meets them.

    A face is found by one pass over all of them.  Of coordinates up to 1,024, the side of the largest cube, all sums of
    products of a score are whole numbers below 2 ** 53, so that float64 has them exactly; only the quotient is rounded,
    and all that may be the greatest are compared as fractions.
    """

    def __init__(self, points: Sequence[Point]) -> None:
        x, y, z = np.array(points, dtype=np.int64).reshape(-1, 3).T
        order = np.argsort(interleaved(x, y))
        self._points = [points[k] for k in order.tolist()]
        self._row = {point: k for k, point in enumerate(self._points)}
        self._open = np.ones(len(points), dtype=np.bool_)
        self._homogeneous = np.stack((x, y, z, np.ones_like(x)))[:, order].astype(np.float64)

    def face_on(self, start: Point, end: Point, normal: Normal) -> list[Point]:
        """The points of the face on an edge, beyond it and not marked, that ``Search.run`` finds."""
        ex, ey, ez = end[0] - start[0], end[1] - start[1], end[2] - start[2]
        divisor = math.gcd(*normal)
        a, b, c = (number // divisor for number in normal)
        # Rows: the normal of the plane of the edge and a point, and its product with the other face's normal.
        rows = np.array(
            [[0, -ez, ey], [ez, 0, -ex], [-ey, ex, 0], [b * ez - c * ey, c * ex - a * ez, a * ey - b * ex]],
            dtype=np.int64,
        )
        forms = np.concatenate((rows, -(rows @ np.array(start))[:, None]), axis=1).astype(np.float64)
        below = forms[2] @ self._homogeneous
        beyond = np.flatnonzero((below < 0) & self._open)
        if not len(beyond):
            return []
        p, q, r, product = forms @ self._homogeneous[:, beyond]
        scores = product * np.abs(product) / (p * p + q * q + r * r)
        best = scores.max()
        near = beyond[scores >= best - abs(best) * ROUNDED]
        if len(near) == 1:
            return [self._points[near[0]]]
        search = Search(start, end, normal, Printed())
        for k in near.tolist():
            search.take(self._points[k])
        return search.points

    def mark(self, found: Iterable[Point], vertices: Iterable[Point]) -> None:
        """Points of a face are not found again, except those that are its vertices and so its neighbours' too."""
        kept = {*vertices}
        self._open[[self._row[point] for point in found if point not in kept]] = False

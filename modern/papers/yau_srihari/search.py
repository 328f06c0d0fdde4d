"""The search of a quadtree for the face that stands on an edge (Theorem 2 and section 4.6.2).

Angles are compared exactly: the cosine of the angle between two integer normals p and q has the order of
(p . q) |p . q| / (q . q), p being the same for all that are compared.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from fractions import Fraction

from modern.papers.yau_srihari.octree import QUADRANTS
from modern.papers.yau_srihari.printed import Printed
from modern.papers.yau_srihari.quadtree import Point, Quadtree, sons_of

Normal = tuple[int, int, int]
Bounds = tuple[Fraction | None, Fraction | None]


def normal_of(u: Point, v: Point, w: Point) -> Normal:
    """The normal of the plane of three points, to the side from which they run counterclockwise."""
    ax, ay, az = v[0] - u[0], v[1] - u[1], v[2] - u[2]
    bx, by, bz = w[0] - u[0], w[1] - u[1], w[2] - u[2]
    return ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx


@dataclass(slots=True)
class Search:
    """The face on the directed edge ``start`` to ``end``, whose other face has the outward normal ``normal``.

    ``best``: the score of the best point found, ``points``: all that reach it, in the order of the search; ``sure``:
    the paper's w, a score that some point is known to reach; ``visited``: nodes looked at.
    """

    start: Point
    end: Point
    normal: Normal
    printed: Printed
    best: Fraction | None = None
    points: list[Point] = field(default_factory=list)
    sure: Fraction | None = None
    visited: int = 0

    def run(self, tree: Quadtree, side: int) -> list[Point]:
        """The points of the tree, not marked, in the next face's plane beyond the edge; empty where there is none."""
        self._visit(tree, 0, 0, side)
        return self.points

    def score(self, point: Point) -> Fraction | None:
        """What is to be greatest: the cosine of the angle to the other face in order, negative for Theorem 2 as
        printed; None on the edge's own line."""
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

    def _visit(self, tree: Quadtree, x: int, y: int, side: int) -> None:
        self.visited += 1
        if tree is None or tree.low is None or not any(self.beyond(i, j) for i, j in _corners(x, y, side)):
            return
        if side == 1:
            self._take((x, y, tree.low))
            return
        half = side // 2
        parts = []
        for (i, j), son in zip(QUADRANTS, sons_of(tree), strict=True):
            part = son, x + i * half, y + j * half, half
            least, most = self.bounds(*part)
            parts.append((part, most))
            if least is not None and (self.sure is None or least > self.sure):
                self.sure = least
        for part, most in parts:
            if most is None or self.sure is None or most >= self.sure:
                self._visit(*part)

    def bounds(self, tree: Quadtree, x: int, y: int, side: int) -> Bounds:
        """The paper's delta_1 and delta_2 of a square: some point of it scores no less than the one, none more than
        the other.  None where they cannot be told from its corners.

        The lower a point, the less the plane through it is turned from the other face.  So the square's least height
        bounds both: no point of it is lower, and one is as low.  For Theorem 2 as printed it is the greatest height.
        """
        if tree is None or tree.low is None or tree.high is None:
            return None, None
        places = list(_corners(x, y, side))
        if not self.printed.corners and not all(self.beyond(*place) for place in places):
            return None, None
        z = tree.high if self.printed.bound or self.printed.angle else tree.low
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

    def _take(self, point: Point) -> None:
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

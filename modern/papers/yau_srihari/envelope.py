"""The convex envelope of a floor: its faces one after the other, and their heights entered in the tree (section 5).

It is computed from the reduced set A of section 4.6.1, over the hull H(A) of A's places.  Both come from lower chains:
the paper finds them by Sklansky's scan, which goes once along a polygon and back where it turns the wrong way.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import pairwise

from modern.digital.intervals import lower_chain
from modern.papers.yau_srihari.printed import Printed
from modern.papers.yau_srihari.quadtree import Leaf, Place, Point, Quadtree, heights, line, written
from modern.papers.yau_srihari.search import Normal, Search, normal_of


def reduced_tree(tree: Quadtree, side: int) -> Quadtree:
    """The floor tree with only the columns that are vertices of the lower chain of their row, and among those of the
    rows' only the vertices of their own column's chain (sections 4.6.1 and 5)."""
    for axis in (0, 1):
        kept: dict[Place, Leaf] = {}
        for at in range(side):
            for t, z in lower_chain(line(tree, side, axis, at)):
                kept[(at, t) if axis == 0 else (t, at)] = Leaf(z)
        tree = written(None, side, kept)
    return tree


def outline(places: Iterable[Place]) -> list[Place]:
    """The vertices of the hull of places, counterclockwise, from their floor and ceiling in y (section 5).

    Of places on one line the two ends, of a single place that one.
    """
    least: dict[int, int] = {}
    most: dict[int, int] = {}
    for x, y in places:
        least[x] = min(y, least.get(x, y))
        most[x] = max(y, most.get(x, y))
    down = lower_chain(sorted(least.items()))
    up = [(x, -y) for x, y in lower_chain(sorted((x, -y) for x, y in most.items()))]
    return list(dict.fromkeys(down + up[::-1]))


def chain_above(start: Place, end: Place, heights: Mapping[Place, int]) -> list[Point]:
    """The lower chain of the points above the segment between two places, both included, from one to the other."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    above: dict[int, Point] = {}
    for (x, y), z in heights.items():
        ahead, aside = dx * (x - start[0]) + dy * (y - start[1]), dx * (y - start[1]) - dy * (x - start[0])
        if aside == 0 and 0 <= ahead <= dx * dx + dy * dy:
            above[ahead] = (x, y, z)
    return [above[t] for t, _ in lower_chain(sorted((t, point[2]) for t, point in above.items()))]


def over_edges(corners: list[Place], heights: Mapping[Place, int], whole: bool) -> list[tuple[Point, Point]]:
    """The edges above those of H(A), counterclockwise: all of the lower chains, or with ``whole`` one over each."""
    found: list[tuple[Point, Point]] = []
    for start, end in zip(corners, corners[1:] + corners[:1], strict=True):
        if whole:
            found.append(((*start, heights[start]), (*end, heights[end])))
        else:
            chain = chain_above(start, end, heights)
            found.extend(pairwise(chain))
    return found


Edge = tuple[Point, Point]


@dataclass(frozen=True, slots=True)
class Face:
    """A face of the envelope.

    ``vertices``: counterclockwise seen from outside, which is below; ``normal``: outward, as the vertices give it.
    """

    vertices: tuple[Point, ...]
    normal: Normal

    def height(self, x: int, y: int) -> tuple[int, int]:
        """The face's plane over a place: numerator and denominator, the latter positive."""
        a, b, c = self.normal
        p = self.vertices[0]
        return a * (x - p[0]) + b * (y - p[1]) - c * p[2], -c

    def places(self) -> Iterable[Place]:
        """The digital points of the face's projection, boundary included."""
        x = [vertex[0] for vertex in self.vertices]
        y = [vertex[1] for vertex in self.vertices]
        # Seen from above the vertices run clockwise: the face is to the right of every side.
        sides = list(zip(self.vertices, self.vertices[1:] + self.vertices[:1], strict=True))
        for i in range(min(x), max(x) + 1):
            for j in range(min(y), max(y) + 1):
                if all((q[0] - p[0]) * (j - p[1]) <= (q[1] - p[1]) * (i - p[0]) for p, q in sides):
                    yield i, j


@dataclass(frozen=True, slots=True)
class Step:
    """One turn of the loop of section 5: an entry taken from the queue, and what became of it.

    ``face`` is None where no point was found.  ``entered`` and ``removed``: edges entered in the queue and taken off
    it; ``marked``: places whose value was entered in the tree; ``visited``: nodes of the tree the search looked at;
    ``waiting``: the length of the queue afterwards.
    """

    edge: Edge
    normal: Normal
    face: Face | None
    entered: tuple[Edge, ...]
    removed: tuple[Edge, ...]
    marked: int
    visited: int
    waiting: int


@dataclass(frozen=True, slots=True)
class Envelope:
    """The convex envelope of a floor.

    ``reduced``: the points of the reduced set A; ``outline``: the corners of H(A), counterclockwise; ``faces``: none
    where A lies over one line, then ``chain`` has the envelope's vertices; ``tree``: the floor with the envelope's
    values; ``fault``: why the construction stopped early, which only a statement taken as printed can bring about.
    """

    reduced: tuple[Point, ...]
    outline: tuple[Place, ...]
    faces: tuple[Face, ...]
    chain: tuple[Point, ...]
    steps: tuple[Step, ...]
    tree: Quadtree
    fault: str = ""


def envelope(floor: Quadtree, side: int, printed: Printed) -> Envelope:
    """The convex envelope of the heights of a tree (algorithm Convex Envelope, sections 4.6 and 5)."""
    tree = reduced_tree(floor, side)
    points = heights(tree, side)
    corners = outline(points)
    if len(corners) < 3:
        chain = chain_above(corners[0], corners[-1], points)
        tree = written(tree, side, _along(chain, printed))
        return Envelope(_points(points), tuple(corners), (), tuple(chain), (), tree)
    queue = {(end, start): _upright(start, end) for start, end in over_edges(corners, points, whole=printed.start)}
    steps: list[Step] = []
    fault = ""
    while queue and not fault:
        edge, normal = next(iter(queue.items()))
        del queue[edge]
        step, tree = _step(edge, normal, queue, tree, side, printed)
        steps.append(step)
        if step.face is None and not printed.names():
            raise AssertionError(f"no face stands on the edge {edge}")
        if len(steps) > 8 * len(points) + 8:
            fault = f"the queue is not empty after {len(steps)} faces"
    faces = tuple(step.face for step in steps if step.face is not None)
    if not fault and len(faces) < len(steps):
        fault = f"no point is found for {len(steps) - len(faces)} of {len(steps)} edges"
    return Envelope(_points(points), tuple(corners), faces, (), tuple(steps), tree, fault)


def _points(heights_: dict[Place, int]) -> tuple[Point, ...]:
    return tuple(sorted((x, y, z) for (x, y), z in heights_.items()))


def _upright(start: Point, end: Point) -> Normal:
    """The outward normal of the upright face over an edge of the counterclockwise outline."""
    return normal_of(start, end, (start[0], start[1], start[2] + 1))


def _step(
    edge: Edge, normal: Normal, queue: dict[Edge, Normal], tree: Quadtree, side: int, printed: Printed
) -> tuple[Step, Quadtree]:
    search = Search(*edge, normal, printed)
    found = search.run(tree, side)
    if not found:
        return Step(edge, normal, None, (), (), 0, search.visited, len(queue)), tree
    start, end = edge
    vertices = (start, end, found[0]) if printed.triangles else _polygon(start, end, found)
    face = Face(vertices, normal_of(start, end, found[0]))
    entered, removed = [], []
    for p, q in zip(vertices, vertices[1:] + vertices[:1], strict=True):
        if (p, q) == edge:
            continue
        waiting = next((other for other in ((p, q), (q, p)) if other in queue), None)
        if waiting is None:
            queue[q, p] = face.normal
            entered.append((q, p))
        else:
            del queue[waiting]
            removed.append(waiting)
    cells = _values(face, printed)
    tree = written(tree, side, cells)
    step = Step(edge, normal, face, tuple(entered), tuple(removed), len(cells), search.visited, len(queue))
    return step, tree


def _polygon(start: Point, end: Point, found: list[Point]) -> tuple[Point, ...]:
    """The vertices of the face of all points in one supporting plane, from ``start`` and ``end`` on."""
    by_place = {(x, y): (x, y, z) for x, y, z in (start, end, *found)}
    turned = [by_place[place] for place in reversed(outline(by_place))]
    first = turned.index(start)
    return tuple(turned[first:] + turned[:first])


def _values(face: Face, printed: Printed) -> dict[Place, Leaf]:
    """The leaves a face enters in the tree: marked, but for its vertices, which its neighbours need."""
    kept = () if printed.marks else [vertex[:2] for vertex in face.vertices]
    return {place: Leaf(_whole(*face.height(*place), printed), marked=place not in kept) for place in face.places()}


def _whole(numerator: int, denominator: int, printed: Printed) -> int:
    """A height rounded up; truncated where that is taken as printed."""
    if printed.truncation and numerator > 0:
        return numerator // denominator
    return -(-numerator // denominator)


def _along(chain: list[Point], printed: Printed) -> dict[Place, Leaf]:
    """The leaves of an envelope over one line of places."""
    cells = {(x, y): Leaf(z) for x, y, z in chain}
    for (x, y, z), (i, j, k) in pairwise(chain):
        steps = math.gcd(i - x, j - y)
        for n in range(1, steps):
            place = x + n * (i - x) // steps, y + n * (j - y) // steps
            cells[place] = Leaf(_whole(z * (steps - n) + k * n, steps, printed), marked=True)
    return cells

"""The convex envelope of a floor: its faces one after the other, and their heights entered in the tree (section 5).

It is computed from the reduced set A of section 4.6.1, over the hull H(A) of A's places.  Both come from lower chains:
the paper finds them by Sklansky's scan, which goes once along a polygon and back where it turns the wrong way.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sized
from dataclasses import dataclass
from functools import cached_property, partial
from itertools import pairwise

import numpy as np

from modern.digital.columns import Grid
from modern.digital.intervals import lower_chain, write_heights
from modern.papers.yau_srihari.printed import Printed
from modern.papers.yau_srihari.quadtree import (
    NO_COLUMN,
    Leaf,
    Place,
    Point,
    Quadtree,
    line,
    no_columns,
    with_columns,
    written,
)
from modern.papers.yau_srihari.search import Candidates, Normal, Search, normal_of


def reduced_tree(tree: Quadtree) -> Quadtree:
    """The floor tree with only the columns that are vertices of the lower chain of their row, and among those of the
    rows' only the vertices of their own column's chain (sections 4.6.1 and 5)."""
    for axis in (0, 1):
        kept = [(at, t, z) for at in range(tree.side) for t, z in lower_chain(line(tree, axis, at))]
        own, other, z = np.array(kept, dtype=np.int64).T
        tree = with_columns(no_columns(tree.side), *((own, other) if axis == 0 else (other, own)), z)
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


def chain_above(start: Place, end: Place, points: Grid) -> list[Point]:
    """The lower chain of the points above the segment between two places, both included, from one to the other.

    points: shape (n, 3), one over a place.
    """
    dx, dy = end[0] - start[0], end[1] - start[1]
    x, y = points[:, 0] - start[0], points[:, 1] - start[1]
    ahead = dx * x + dy * y
    above = np.flatnonzero((dx * y == dy * x) & (ahead >= 0) & (ahead <= dx * dx + dy * dy))
    by_way: dict[int, Point] = {
        t: (x, y, z) for t, (x, y, z) in zip(ahead[above].tolist(), points[above].tolist(), strict=True)
    }
    return [by_way[t] for t, _ in lower_chain(sorted((t, point[2]) for t, point in by_way.items()))]


def over_edges(corners: list[Place], points: Grid, whole: bool) -> list[tuple[Point, Point]]:
    """The edges above those of H(A), counterclockwise: all of the lower chains, or with ``whole`` one over each."""
    found: list[tuple[Point, Point]] = []
    for start, end in zip(corners, corners[1:] + corners[:1], strict=True):
        chain = chain_above(start, end, points)
        found.extend([(chain[0], chain[-1])] if whole else pairwise(chain))
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
    ``angles``: how many it computed; ``waiting``: the length of the queue afterwards.
    """

    edge: Edge
    normal: Normal
    face: Face | None
    entered: tuple[Edge, ...]
    removed: tuple[Edge, ...]
    marked: int
    visited: int
    angles: int
    waiting: int


@dataclass(frozen=True, eq=False)
class Envelope:
    """The convex envelope of a floor.

    ``reduced``: the points of the reduced set A; ``outline``: the corners of H(A), counterclockwise; ``faces``: none
    where A lies over one line, then ``chain`` has the envelope's vertices; ``tree``: the floor with the envelope's
    values; ``fault``: why the construction stopped early, which only a statement taken as printed can bring about.
    ``construction``: what makes the paper's steps.
    """

    reduced: tuple[Point, ...]
    outline: tuple[Place, ...]
    faces: tuple[Face, ...]
    chain: tuple[Point, ...]
    tree: Quadtree
    construction: Callable[[], tuple[Step, ...]]
    fault: str = ""

    @cached_property
    def steps(self) -> tuple[Step, ...]:
        """The construction edge by edge, each face searched for in the quadtree; made when asked for first, as the
        faces alone are found without it."""
        return self.construction()


def envelope(floor: Quadtree, printed: Printed) -> Envelope:
    """The convex envelope of the heights of a tree (algorithm Convex Envelope, sections 4.6 and 5)."""
    tree = reduced_tree(floor)
    x, y = np.nonzero(tree.there)
    grid = np.stack((x, y, tree.values[x, y]), axis=1)
    points: tuple[Point, ...] = tuple((x, y, z) for x, y, z in grid.tolist())
    corners = outline((x, y) for x, y, _ in points)
    if len(corners) < 3:
        chain = chain_above(corners[0], corners[-1], grid)
        return Envelope(points, tuple(corners), (), tuple(chain), written(tree, _along(chain, printed)), tuple)
    edges = over_edges(corners, grid, whole=printed.start)
    if printed.names():
        steps, after, fault = _by_steps(edges, points, tree, printed)
        found = tuple(step.face for step in steps if step.face is not None)
        return Envelope(points, tuple(corners), found, (), after, lambda: steps, fault)
    faces = _by_candidates(edges, points)
    again = partial(_by_steps, edges, points, tree, printed)
    return Envelope(points, tuple(corners), faces, (), _entered(tree, faces), lambda: again()[0])


def _queue(edges: Iterable[Edge]) -> dict[Edge, Normal]:
    """The edges above those of H(A), turned, each with the outward normal of the upright face over it."""
    return {(end, start): normal_of(start, end, (start[0], start[1], start[2] + 1)) for start, end in edges}


def _by_candidates(edges: list[Edge], points: tuple[Point, ...]) -> tuple[Face, ...]:
    """The faces in the order of the queue, each found among all points at once."""
    queue, candidates = _queue(edges), Candidates(points)
    faces: list[Face] = []
    while queue:
        edge = next(iter(queue))
        found = candidates.face_on(*edge, queue.pop(edge))
        if not found or len(faces) > _most(points):
            raise AssertionError(f"no face stands on the edge {edge}")
        face = Face(_polygon(*edge, found), normal_of(*edge, found[0]))
        _join(face, edge, queue)
        candidates.mark(found, face.vertices)
        faces.append(face)
    return tuple(faces)


def _by_steps(
    edges: list[Edge], points: tuple[Point, ...], tree: Quadtree, printed: Printed
) -> tuple[tuple[Step, ...], Quadtree, str]:
    """The steps of section 5, each face searched for in the tree; the tree after them; why they stopped early."""
    queue = _queue(edges)
    steps: list[Step] = []
    while queue:
        edge = next(iter(queue))
        step, tree = _step(edge, queue.pop(edge), queue, tree, printed)
        steps.append(step)
        if step.face is None and not printed.names():
            raise AssertionError(f"no face stands on the edge {edge}")
        if len(steps) > _most(points):
            return tuple(steps), tree, f"the queue is not empty after {len(steps)} faces"
    open_ = sum(step.face is None for step in steps)
    return tuple(steps), tree, f"no point is found for {open_} of {len(steps)} edges" if open_ else ""


def _most(points: Sized) -> int:
    """More faces than an envelope of so many points has."""
    return 8 * len(points) + 8


def _step(
    edge: Edge, normal: Normal, queue: dict[Edge, Normal], tree: Quadtree, printed: Printed
) -> tuple[Step, Quadtree]:
    search = Search(*edge, normal, printed)
    found = search.run(tree)
    if not found:
        return Step(edge, normal, None, (), (), 0, search.visited, search.angles, len(queue)), tree
    start, end = edge
    vertices = (start, end, found[0]) if printed.triangles else _polygon(start, end, found)
    face = Face(vertices, normal_of(start, end, found[0]))
    entered, removed = _join(face, edge, queue)
    cells = _values(face, printed)
    step = Step(edge, normal, face, entered, removed, len(cells), search.visited, search.angles, len(queue))
    return step, written(tree, cells)


def _join(face: Face, edge: Edge, queue: dict[Edge, Normal]) -> tuple[tuple[Edge, ...], tuple[Edge, ...]]:
    """Enter the sides of a face in the queue, but for the edge it stands on, and take off it those that wait there
    already; both lists."""
    entered, removed = [], []
    for p, q in zip(face.vertices, face.vertices[1:] + face.vertices[:1], strict=True):
        if (p, q) == edge:
            continue
        waiting = next((other for other in ((p, q), (q, p)) if other in queue), None)
        if waiting is None:
            queue[q, p] = face.normal
            entered.append((q, p))
        else:
            del queue[waiting]
            removed.append(waiting)
    return tuple(entered), tuple(removed)


def _entered(tree: Quadtree, faces: Iterable[Face]) -> Quadtree:
    """The tree with the heights of all faces; their places are marked, but for the vertices."""
    triangles, planes = [], []
    for face in faces:
        first, *others = face.vertices
        a, b, c = face.normal
        plane = (-a, -b, -c, a * first[0] + b * first[1] + c * first[2])
        for p, q in pairwise(others):
            triangles.append((first, q, p))  # counterclockwise seen from above
            planes.append(plane)
    values = np.where(tree.there, tree.values, NO_COLUMN)
    write_heights(values, np.array(triangles), np.array(planes), rounded_up=True)
    there = values < NO_COLUMN
    marked = there.copy()
    x, y, _ = np.array([vertex for face in faces for vertex in face.vertices]).T
    marked[x, y] = False
    return Quadtree(np.where(there, values, 0), there, marked, np.ones_like(values))


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

"""Compute the convex envelope of a floor: the lower side of the hull of the lowest voxels of all columns (section 5).

The envelope consists of faces, which are found one after another. The faces are computed from the reduced set A of
section 4.6.1, the points that can be vertices of the envelope. The points of A lie above H(A), the plane hull of the
positions (x, y) of these points. A and H(A) are found by lower chains (the lower sides of plane hulls). The paper
computes such chains by Sklansky's scan, which follows a polygon once and steps back whenever the polygon turns the
wrong way.
"""

import math
from collections.abc import Callable, Iterable, Sized
from dataclasses import dataclass
from functools import cached_property, partial
from itertools import pairwise

import numpy as np

from modern.digital.intervals import Grid, lower_chain, write_heights
from modern.papers.yau_srihari import quadtree as trees
from modern.papers.yau_srihari.printed import Printed
from modern.papers.yau_srihari.quadtree import NO_COLUMN, Leaf, Place, Point, Quadtree, written
from modern.papers.yau_srihari.search import Candidates, Normal, Search, normal_of


def reduced_tree(tree: Quadtree) -> Quadtree:
    """Return a floor tree without the columns that cannot be vertices of the envelope (sections 4.6.1 and 5).

    For each x, only the vertices of the lower chain (the lower side of the plane hull) remain. Of these, for each y,
    only the vertices of the lower chain remain.
    """
    for axis in (0, 1):
        vertices = [(at, t, z) for at in range(tree.side) for t, z in lower_chain(trees.line(tree, axis, at))]
        at, t, z = np.array(vertices, dtype=np.int64).T
        tree = trees.with_columns(trees.no_columns(tree.side), *((at, t) if axis == 0 else (t, at)), z)
    return tree


def outline(places: Iterable[Place]) -> list[Place]:
    """Return the vertices of the plane hull of the columns' positions (x, y), counterclockwise (section 5).

    The hull of columns on one line has two vertices, and the hull of a single column has one.
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
    """Return the lower side of the hull of those points whose (x, y) lie on the segment from ``start`` to ``end``."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    x, y = points[:, 0] - start[0], points[:, 1] - start[1]
    # The product with the segment's direction orders the points along the segment.
    along = dx * x + dy * y
    above = np.flatnonzero((dx * y == dy * x) & (along >= 0) & (along <= dx * dx + dy * dy))
    point_at: dict[int, Point] = {
        t: (x, y, z) for t, (x, y, z) in zip(along[above].tolist(), points[above].tolist(), strict=True)
    }
    return [point_at[t] for t, _ in lower_chain(sorted((t, point[2]) for t, point in point_at.items()))]


def over_edges(corners: list[Place], points: Grid, whole: bool) -> list[tuple[Point, Point]]:
    """Return the envelope's edges above the border of H(A), the plane hull of the columns' positions, counterclockwise.

    The points above an edge of H(A) lie in an upright plane. The lower side of their hull consists of one or more edges
    of the envelope, which are returned. With ``whole``, as in the printed procedure, it is replaced by a single edge.
    """
    edges: list[tuple[Point, Point]] = []
    for start, end in zip(corners, corners[1:] + corners[:1], strict=True):
        chain = chain_above(start, end, points)
        edges.extend([(chain[0], chain[-1])] if whole else pairwise(chain))
    return edges


Edge = tuple[Point, Point]


@dataclass(frozen=True, slots=True)
class Face:
    """A face of the envelope: its vertices, counterclockwise seen from below, and its normal, which points outward."""

    vertices: tuple[Point, ...]
    normal: Normal

    def height(self, x: int, y: int) -> tuple[int, int]:
        """Return the height z of the face's plane at (x, y) as a numerator and a positive denominator."""
        a, b, c = self.normal
        p = self.vertices[0]
        return a * (x - p[0]) + b * (y - p[1]) - c * p[2], -c

    def places(self) -> Iterable[Place]:
        """Yield the integer positions (x, y) below or above which the face lies, including its boundary."""
        x = [vertex[0] for vertex in self.vertices]
        y = [vertex[1] for vertex in self.vertices]
        # Seen from above, the vertices run clockwise, so the face is to the right of each of its sides.
        sides = list(zip(self.vertices, self.vertices[1:] + self.vertices[:1], strict=True))
        for i in range(min(x), max(x) + 1):
            for j in range(min(y), max(y) + 1):
                if all((q[0] - p[0]) * (j - p[1]) <= (q[1] - p[1]) * (i - p[0]) for p, q in sides):
                    yield i, j


@dataclass(frozen=True, slots=True)
class Step:
    """One step of the construction in section 5: an edge taken from the queue, and the face found at this edge.

    ``normal`` is the normal of the known face at the edge. ``face`` is None if the search found no point. ``entered``
    and ``removed`` are the edges added to the queue and removed from it. ``marked`` is the number of columns whose
    heights were entered in the tree, ``visited`` is the number of nodes that the search visited, ``angles`` is the
    number of angles that it computed, and ``waiting`` is the number of edges in the queue afterwards.
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
    """The convex envelope of a floor: its faces, or a chain of vertices if all columns are in one line.

    ``reduced`` has the points that can be vertices (the reduced set A), and ``outline`` has the vertices of H(A), the
    plane hull of their positions, counterclockwise. If all columns are in one line, there are no ``faces``, and
    ``chain`` has the envelope's vertices. ``tree`` is the floor tree with the heights of the envelope. The function
    ``construction`` computes ``steps``. ``fault`` is the reason why the construction stopped early, or "" if it did
    not. Only statements applied as printed can stop it.
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
        """The steps of the paper's construction by searches of the quadtree, which are computed on first access."""
        return self.construction()


def envelope(floor: Quadtree, printed: Printed) -> Envelope:
    """Return the convex envelope (the lower side of the hull) of the heights in a tree (sections 4.6 and 5)."""
    # Section 4.6.1: the reduced set A and its outline H(A).
    tree = reduced_tree(floor)
    x, y = np.nonzero(tree.there)
    grid = np.stack((x, y, tree.values[x, y]), axis=1)
    points: tuple[Point, ...] = tuple((x, y, z) for x, y, z in grid.tolist())
    corners = outline((x, y) for x, y, _ in points)
    if len(corners) < 3:
        # The paper assumes that H(A) is a polygon. Over one line the envelope is the lower chain itself.
        chain = chain_above(corners[0], corners[-1], grid)
        return Envelope(points, tuple(corners), (), tuple(chain), written(tree, _along(chain, printed)), tuple)
    edges = over_edges(corners, grid, whole=printed.start)
    if printed.names():
        steps, tree_after, fault = _by_steps(edges, points, tree, printed)
        built = tuple(step.face for step in steps if step.face is not None)
        return Envelope(points, tuple(corners), built, (), tree_after, lambda: steps, fault)
    faces = _by_candidates(edges, points)
    construction = partial(_by_steps, edges, points, tree, printed)
    return Envelope(points, tuple(corners), faces, (), _entered(tree, faces), lambda: construction()[0])


def _queue(edges: Iterable[Edge]) -> dict[Edge, Normal]:
    """Return the initial queue: each edge of the border, reversed, with the normal of the upright face at this edge."""
    return {(end, start): normal_of(start, end, (start[0], start[1], start[2] + 1)) for start, end in edges}


def _by_candidates(edges: list[Edge], points: tuple[Point, ...]) -> tuple[Face, ...]:
    """Return the faces of the envelope, found by gift wrapping with one pass over all points for each face."""
    queue, candidates = _queue(edges), Candidates(points)
    faces: list[Face] = []
    while queue:
        # Gift wrapping: rotate a plane about the edge, from the known face to the first points that the plane meets.
        edge = next(iter(queue))
        in_plane = candidates.face_on(*edge)
        del queue[edge]
        if not in_plane or len(faces) > _most(points):
            raise AssertionError(f"no second face was found on the edge {edge}")
        face = Face(_polygon(*edge, in_plane), normal_of(*edge, in_plane[0]))
        _update_queue(face, edge, queue)
        candidates.mark(in_plane, face.vertices)
        faces.append(face)
    return tuple(faces)


def _by_steps(
    edges: list[Edge], points: tuple[Point, ...], tree: Quadtree, printed: Printed
) -> tuple[tuple[Step, ...], Quadtree, str]:
    """Run the construction of section 5 as in the paper, with a search of the tree for each face.

    Return the steps, the tree after the last step, and the reason why the construction stopped early, or "".
    """
    queue = _queue(edges)
    steps: list[Step] = []
    while queue:
        edge = next(iter(queue))
        step, tree = _step(edge, queue.pop(edge), queue, tree, printed)
        steps.append(step)
        if step.face is None and not printed.names():
            raise AssertionError(f"no second face was found on the edge {edge}")
        if len(steps) > _most(points):
            return tuple(steps), tree, f"the queue is not empty after {len(steps)} faces"
    without_face = sum(step.face is None for step in steps)
    return tuple(steps), tree, f"no point found for {without_face} of {len(steps)} edges" if without_face else ""


def _most(points: Sized) -> int:
    """Return a number of faces that no envelope can have. A construction that reaches this number is stopped."""
    return 8 * len(points) + 8


def _step(
    edge: Edge, normal: Normal, queue: dict[Edge, Normal], tree: Quadtree, printed: Printed
) -> tuple[Step, Quadtree]:
    """Find the face at an edge by a search of the tree, update the queue, and return the step and the new tree."""
    search = Search(*edge, normal, printed)
    in_plane = search.run(tree)
    if not in_plane:
        return Step(edge, normal, None, (), (), 0, search.visited, search.angles, len(queue)), tree
    start, end = edge
    vertices = (start, end, in_plane[0]) if printed.triangles else _polygon(start, end, in_plane)
    face = Face(vertices, normal_of(start, end, in_plane[0]))
    entered, removed = _update_queue(face, edge, queue)
    leaves = _leaves(face, printed)
    step = Step(edge, normal, face, entered, removed, len(leaves), search.visited, search.angles, len(queue))
    return step, written(tree, leaves)


def _update_queue(face: Face, edge: Edge, queue: dict[Edge, Normal]) -> tuple[tuple[Edge, ...], tuple[Edge, ...]]:
    """Add the edges of a new face to the queue, except the edge at which it was found.

    An edge that is already in the queue is removed instead, because both of its faces are then known. Return the edges
    added and the edges removed.
    """
    entered, removed = [], []
    for p, q in zip(face.vertices, face.vertices[1:] + face.vertices[:1], strict=True):
        if (p, q) == edge:
            continue
        queued = next((direction for direction in ((p, q), (q, p)) if direction in queue), None)
        if queued is None:
            # The second face at the edge runs along it in the opposite direction.
            queue[q, p] = face.normal
            entered.append((q, p))
        else:
            del queue[queued]
            removed.append(queued)
    return tuple(entered), tuple(removed)


def _entered(tree: Quadtree, faces: Iterable[Face]) -> Quadtree:
    """Return the tree with the heights of all faces. Mark all columns of faces as done, except those of vertices."""
    # From above the vertices run clockwise, and the plane's coefficient of z must be positive.
    reversed_faces = []
    for face in faces:
        a, b, c = face.normal
        x, y, z = face.vertices[0]
        reversed_faces.append((np.array(face.vertices[::-1]), (-a, -b, -c, a * x + b * y + c * z)))
    values = np.where(tree.there, tree.values, NO_COLUMN)
    write_heights(values, reversed_faces, rounded_up=True)
    there = values < NO_COLUMN
    marked = there.copy()
    x, y, _ = np.array([vertex for face in faces for vertex in face.vertices]).T
    marked[x, y] = False
    return Quadtree(np.where(there, values, 0), there, marked, np.ones_like(values))


def _polygon(start: Point, end: Point, in_plane: list[Point]) -> tuple[Point, ...]:
    """Return the vertices of the face of ``start``, ``end`` and the points ``in_plane``, beginning with ``start``."""
    point_at = {(x, y): (x, y, z) for x, y, z in (start, end, *in_plane)}
    clockwise = [point_at[place] for place in reversed(outline(point_at))]
    first = clockwise.index(start)
    return tuple(clockwise[first:] + clockwise[:first])


def _leaves(face: Face, printed: Printed) -> dict[Place, Leaf]:
    """Return the height of a face in each column. All columns except those of vertices are marked as done."""
    unmarked = () if printed.marks else [vertex[:2] for vertex in face.vertices]
    return {
        place: Leaf(_rounded(*face.height(*place), printed), marked=place not in unmarked) for place in face.places()
    }


def _rounded(numerator: int, denominator: int, printed: Printed) -> int:
    """Return a height rounded up to an integer, or truncated, as the paper says, if ``printed.truncation`` is set."""
    if printed.truncation and numerator > 0:
        return numerator // denominator
    return -(-numerator // denominator)


def _along(chain: list[Point], printed: Printed) -> dict[Place, Leaf]:
    leaves = {(x, y): Leaf(z) for x, y, z in chain}
    for (x, y, z), (i, j, k) in pairwise(chain):
        # Between its ends an edge has gcd - 1 digital points of the plane (x, y), at equal distances.
        steps = math.gcd(i - x, j - y)
        for n in range(1, steps):
            place = x + n * (i - x) // steps, y + n * (j - y) // steps
            leaves[place] = Leaf(_rounded(z * (steps - n) + k * n, steps, printed), marked=True)
    return leaves

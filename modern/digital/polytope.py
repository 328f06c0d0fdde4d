"""The convex polyhedron of points of a grid, exactly: quickhull over integers.

How far a point is outside a facet is the value of the facet's plane, an integer; a point on the plane is not outside.
Coplanar points therefore leave a face cut into triangles.  None of these is degenerate: an edge of the horizon that
lies on one line with the new point would lie in the plane of the facet that sees it.

The functions up to ``hull`` use flat sequences of integers only: one source runs over Python lists and, compiled, over
arrays of 64-bit integers.  With coordinates from 0 on, a plane's coefficients and its values at points of the box
of X by Y by Z cells are at most 12 XYZ: no volume that a memory can hold comes near 63 bits.
"""

from __future__ import annotations

from collections.abc import Callable, MutableSequence, Sequence
from functools import cache, partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from emulator.jit.functions import Compiled

Integers = MutableSequence[int]
Grid = NDArray[np.int64]


class Points(NamedTuple):
    """Coordinates, one sequence an axis."""

    x: Sequence[int]
    y: Sequence[int]
    z: Sequence[int]


class Surface(NamedTuple):
    """Facets under construction, in numbered slots, and the points outside them.

    corner: three points a facet, counterclockwise seen from outside, the first -1 in an empty slot.  across: three
    facets, beyond the edges from each corner to the next.  plane: four coefficients, positive outside.  head: the
    first of a facet's outside points, the farthest, -1 for none; after: the next one, by point.  depth: the value at
    the head.  mark: the number, from 1, of the point that last saw the facet.  The rest is room for one step: facets
    seen, edges of the horizon (start, end, facet beyond), the new facet whose edge starts at a point, empty slots.
    """

    corner: Integers
    across: Integers
    plane: Integers
    head: Integers
    after: Integers
    depth: Integers
    mark: Integers
    seen: Integers
    horizon: Integers
    starting: Integers
    spare: Integers


def value(at: Points, surface: Surface, f: int, p: int) -> int:
    """The plane of facet ``f`` at point ``p``: positive outside."""
    a = surface.plane
    return a[4 * f] * at.x[p] + a[4 * f + 1] * at.y[p] + a[4 * f + 2] * at.z[p] + a[4 * f + 3]


def place(at: Points, surface: Surface, f: int, p: int, q: int, r: int) -> None:
    """Slot ``f`` becomes the facet p, q, r."""
    ux, uy, uz = at.x[q] - at.x[p], at.y[q] - at.y[p], at.z[q] - at.z[p]
    vx, vy, vz = at.x[r] - at.x[p], at.y[r] - at.y[p], at.z[r] - at.z[p]
    a, b, c = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    surface.corner[3 * f], surface.corner[3 * f + 1], surface.corner[3 * f + 2] = p, q, r
    surface.plane[4 * f], surface.plane[4 * f + 1], surface.plane[4 * f + 2] = a, b, c
    surface.plane[4 * f + 3] = -(a * at.x[p] + b * at.y[p] + c * at.z[p])
    surface.head[f] = -1
    surface.mark[f] = 0


def hand_out(at: Points, surface: Surface, first: int, chosen: Integers, count: int) -> None:
    """Give each point of the list from ``first`` on to a chosen facet it is outside of; drop it where there is none."""
    head, after, depth = surface.head, surface.after, surface.depth
    p = first
    while p >= 0:
        following = after[p]
        for k in range(count):
            f = chosen[k]
            far = value(at, surface, f, p)
            if far > 0:
                if head[f] < 0 or far > depth[f]:
                    after[p], head[f], depth[f] = head[f], p, far
                else:
                    after[p], after[head[f]] = after[head[f]], p
                break
        p = following


def look(at: Points, surface: Surface, p: int, first: int) -> tuple[int, int]:
    """Mark and list the facets ``p`` sees, from one of them on, and the horizon; returns how many facets and edges."""
    seen, mark, across, horizon = surface.seen, surface.mark, surface.across, surface.horizon
    mark[first], seen[0] = p + 1, first
    count, edges, at_facet = 1, 0, 0
    while at_facet < count:
        f = seen[at_facet]
        at_facet += 1
        for k in range(3):
            g = across[3 * f + k]
            if mark[g] == p + 1:
                continue
            if value(at, surface, g, p) > 0:
                mark[g], seen[count] = p + 1, g
                count += 1
            else:
                horizon[3 * edges] = surface.corner[3 * f + k]
                horizon[3 * edges + 1] = surface.corner[3 * f + (k + 1) % 3]
                horizon[3 * edges + 2] = g
                edges += 1
    return count, edges


def cone(at: Points, surface: Surface, p: int, slots: Integers, edges: int) -> None:
    """Facets from ``p`` to every edge of the horizon, in the given slots, joined to their neighbours."""
    corner, across, horizon, starting = surface.corner, surface.across, surface.horizon, surface.starting
    for k in range(edges):
        a, b, g = horizon[3 * k], horizon[3 * k + 1], horizon[3 * k + 2]
        f = slots[k]
        place(at, surface, f, a, b, p)
        across[3 * f] = g
        starting[a] = f
        for side in range(3):
            if corner[3 * g + side] == b and corner[3 * g + (side + 1) % 3] == a:
                across[3 * g + side] = f
    for k in range(edges):
        f = slots[k]
        following = starting[horizon[3 * k + 1]]
        across[3 * f + 1] = following
        across[3 * following + 2] = f


def grow(at: Points, surface: Surface, used: int) -> int:
    """Add the farthest point of every facet that has points outside it until none has; returns the slots used."""
    head, after, seen, spare = surface.head, surface.after, surface.seen, surface.spare
    empty, f, idle = 0, 0, 0
    while idle < used:
        f = f + 1 if f + 1 < used else 0
        idle += 1
        if surface.corner[3 * f] < 0 or head[f] < 0:
            continue
        idle = 0
        p = head[f]
        head[f] = after[p]
        count, edges = look(at, surface, p, f)
        pool = -1
        for k in range(count):
            g = seen[k]
            q = head[g]
            while q >= 0:
                following = after[q]
                after[q] = pool
                pool, q = q, following
            surface.corner[3 * g] = -1
            spare[empty] = g
            empty += 1
        for k in range(edges):
            if empty:
                empty -= 1
                seen[k] = spare[empty]
            else:
                seen[k] = used
                used += 1
        cone(at, surface, p, seen, edges)
        hand_out(at, surface, pool, seen, edges)
    return used


def hull(at: Points, surface: Surface, a: int, b: int, c: int, d: int) -> int:
    """The polyhedron of all points, from a tetrahedron with d below the plane of a, b, c; returns the slots used."""
    place(at, surface, 0, a, b, c)
    place(at, surface, 1, b, a, d)
    place(at, surface, 2, c, b, d)
    place(at, surface, 3, a, c, d)
    across, after = surface.across, surface.after
    for f in range(1, 4):
        # The edges of facet 0 border facets 1, 2, 3 in turn; of each of these the second borders the one before.
        across[f - 1] = f
        across[3 * f] = 0
        across[3 * f + 1] = (f + 1) % 3 + 1
        across[3 * f + 2] = f % 3 + 1
        surface.seen[f] = f
    surface.seen[0] = 0
    for p in range(len(after) - 1):
        after[p] = p + 1
    after[len(after) - 1] = -1
    hand_out(at, surface, 0, surface.seen, 4)
    return grow(at, surface, 4)


@cache
def compiled_hull() -> Callable[..., Any]:
    """``hull`` compiled.  Raises NotInstalled."""
    one: Any = np.zeros(1, np.int64)
    # No array is made: numba need not count the users of each it is given.
    return Compiled(hull, _nrt=False).ready(Points(one, one, one), Surface(*[one] * len(Surface._fields)), 0, 0, 0, 0)


def polyhedron(points: Grid, simplex: tuple[int, int, int, int], fast: bool) -> tuple[Grid, Grid]:
    """The hull of points that do not lie in one plane: its facets' corners, shape (n, 3), and planes, shape (n, 4).

    points: distinct, int64 of shape (count, 3), none negative.  simplex: four of them not in a plane.  fast: compiled.
    Facets are triangles, counterclockwise seen from outside; several may lie in one plane.
    """
    work = compiled_hull() if fast else hull
    room = 2 * len(points) + 4
    table: Callable[[int, int], Any] = partial(np.full, dtype=np.int64) if fast else _listed
    axes: list[Any] = [np.ascontiguousarray(axis) if fast else axis.tolist() for axis in points.T]
    at = Points(*axes)
    surface = Surface(
        corner=table(3 * room, -1),
        across=table(3 * room, 0),
        plane=table(4 * room, 0),
        head=table(room, -1),
        after=table(len(points), -1),
        depth=table(room, 0),
        mark=table(room, 0),
        seen=table(room, 0),
        horizon=table(3 * room, 0),
        starting=table(len(points), 0),
        spare=table(room, 0),
    )
    used = work(at, surface, *_outward(points, simplex))
    corner = np.array(surface.corner[: 3 * used], dtype=np.int64).reshape(-1, 3)
    plane = np.array(surface.plane[: 4 * used], dtype=np.int64).reshape(-1, 4)
    kept = corner[:, 0] >= 0
    return corner[kept], plane[kept]


def _listed(count: int, number: int) -> list[int]:
    return [number] * count


def _outward(points: Grid, simplex: tuple[int, int, int, int]) -> tuple[int, int, int, int]:
    """The four points in an order in which the fourth is below the plane of the first three."""
    a, b, c, d = simplex
    normal = np.cross(points[b] - points[a], points[c] - points[a])
    return (a, b, c, d) if normal @ (points[d] - points[a]) < 0 else (b, a, c, d)

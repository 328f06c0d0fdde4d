"""The convex hull of grid points that span space, computed exactly by quickhull with integers.

The distance of a point outside a facet is measured by the value of the facet's plane, an integer. A point on the plane
is not outside, so coplanar points leave a face divided into triangles. No triangle is degenerate: an edge of the
horizon that is collinear with the new point would lie in the plane of the facet that sees the point.

The functions up to ``hull`` use flat sequences of integers only. The same source runs on Python lists and, compiled, on
arrays of 64-bit integers. With coordinates from 0 on, the coefficients of a plane and its values at points of a box of
X by Y by Z cells are at most 12 XYZ. Any volume that fits in memory needs far fewer than 63 bits.
"""

from collections.abc import Callable, MutableSequence, Sequence
from functools import cache, partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from emulator.jit.functions import Compiled

Integers = MutableSequence[int]
Grid = NDArray[np.int64]


class Points(NamedTuple):
    """Integer coordinates of points, as one sequence for each axis."""

    x: Sequence[int]
    y: Sequence[int]
    z: Sequence[int]


class Surface(NamedTuple):
    """A polyhedron under construction: facets in numbered slots, each with a linked list of points outside it.

    ``corner`` has three points for each facet, counterclockwise as seen from outside, the first -1 in an empty slot.
    ``across`` has the three facets beyond the edges from each corner to the next. ``plane`` has four coefficients,
    positive outside. ``head`` is the farthest of a facet's outside points, or -1, and ``depth`` its value. ``after``
    is the next outside point in a facet's list. ``mark`` is the number, from 1, of the point that last saw the facet.
    The other arrays are scratch space for one step: visible facets, edges of the horizon (start, end, facet beyond),
    the new facet whose edge starts at a point, and empty slots.
    """

    corner: Integers
    across: Integers
    plane: Integers
    head: Integers
    after: Integers
    depth: Integers
    mark: Integers
    visible: Integers
    horizon: Integers
    starting: Integers
    spare: Integers


def value(at: Points, surface: Surface, f: int, p: int) -> int:
    """Return the value of the plane of facet ``f`` at point ``p``, which is positive outside."""
    a = surface.plane
    return a[4 * f] * at.x[p] + a[4 * f + 1] * at.y[p] + a[4 * f + 2] * at.z[p] + a[4 * f + 3]


def set_facet(at: Points, surface: Surface, f: int, p: int, q: int, r: int) -> None:
    ux, uy, uz = at.x[q] - at.x[p], at.y[q] - at.y[p], at.z[q] - at.z[p]
    vx, vy, vz = at.x[r] - at.x[p], at.y[r] - at.y[p], at.z[r] - at.z[p]
    a, b, c = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    surface.corner[3 * f], surface.corner[3 * f + 1], surface.corner[3 * f + 2] = p, q, r
    surface.plane[4 * f], surface.plane[4 * f + 1], surface.plane[4 * f + 2] = a, b, c
    surface.plane[4 * f + 3] = -(a * at.x[p] + b * at.y[p] + c * at.z[p])
    surface.head[f] = -1
    surface.mark[f] = 0


def distribute(at: Points, surface: Surface, first: int, chosen: Integers, count: int) -> None:
    """Add each point of a linked list to the list of one of the chosen facets that it is outside of, or drop it.

    ``first`` is the first point of the linked list.
    """
    head, after, depth = surface.head, surface.after, surface.depth
    p = first
    while p >= 0:
        following = after[p]
        for k in range(count):
            f = chosen[k]
            distance = value(at, surface, f, p)
            if distance > 0:
                # The farthest point stays at the head of the list. The order of the others does not matter.
                if head[f] < 0 or distance > depth[f]:
                    after[p], head[f], depth[f] = head[f], p, distance
                else:
                    after[p], after[head[f]] = after[head[f]], p
                break
        p = following


def find_visible(at: Points, surface: Surface, p: int, first: int) -> tuple[int, int]:
    """Find the facets that point ``p`` is outside of, starting at facet ``first``, and the edges around them (the
    horizon).

    Return the numbers of both.
    """
    visible, mark, across, horizon = surface.visible, surface.mark, surface.across, surface.horizon
    mark[first], visible[0] = p + 1, first
    count, edges, at_facet = 1, 0, 0
    while at_facet < count:
        f = visible[at_facet]
        at_facet += 1
        for k in range(3):
            g = across[3 * f + k]
            # The mark is the number of the point plus 1, so that no marks need to be cleared.
            if mark[g] == p + 1:
                continue
            if value(at, surface, g, p) > 0:
                mark[g], visible[count] = p + 1, g
                count += 1
            else:
                horizon[3 * edges] = surface.corner[3 * f + k]
                horizon[3 * edges + 1] = surface.corner[3 * f + (k + 1) % 3]
                horizon[3 * edges + 2] = g
                edges += 1
    return count, edges


def cone(at: Points, surface: Surface, p: int, slots: Integers, edges: int) -> None:
    """Create a facet from ``p`` to each edge of the horizon, in the given slots, and link all facets."""
    corner, across, horizon, starting = surface.corner, surface.across, surface.horizon, surface.starting
    for k in range(edges):
        a, b, g = horizon[3 * k], horizon[3 * k + 1], horizon[3 * k + 2]
        f = slots[k]
        set_facet(at, surface, f, a, b, p)
        across[3 * f] = g
        starting[a] = f
        # Beyond the horizon, the neighbour's edge runs in the opposite direction, from b to a.
        for side in range(3):
            if corner[3 * g + side] == b and corner[3 * g + (side + 1) % 3] == a:
                across[3 * g + side] = f
    for k in range(edges):
        f = slots[k]
        # Two new facets share the edge from the horizon's vertex to p.
        following = starting[horizon[3 * k + 1]]
        across[3 * f + 1] = following
        across[3 * following + 2] = f


def grow(at: Points, surface: Surface, used: int) -> int:
    """Add to the hull the farthest outside point of each facet in turn, until no facet has outside points.

    Return the number of slots used.
    """
    head, after, visible, spare = surface.head, surface.after, surface.visible, surface.spare
    empty, f, idle = 0, 0, 0
    while idle < used:
        f = f + 1 if f + 1 < used else 0
        idle += 1
        if surface.corner[3 * f] < 0 or head[f] < 0:
            continue
        idle = 0
        # The farthest point outside this facet is a vertex of the hull of all points.
        p = head[f]
        head[f] = after[p]
        count, edges = find_visible(at, surface, p, f)
        # Collect the outside points of all visible facets. They are inside the new hull or outside a new facet.
        pool = -1
        for k in range(count):
            g = visible[k]
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
                visible[k] = spare[empty]
            else:
                visible[k] = used
                used += 1
        cone(at, surface, p, visible, edges)
        distribute(at, surface, pool, visible, edges)
    return used


def hull(at: Points, surface: Surface, a: int, b: int, c: int, d: int) -> int:
    """Grow the polyhedron from the tetrahedron a, b, c, d, where d is below the plane of a, b, c.

    Return the number of slots used.
    """
    set_facet(at, surface, 0, a, b, c)
    set_facet(at, surface, 1, b, a, d)
    set_facet(at, surface, 2, c, b, d)
    set_facet(at, surface, 3, a, c, d)
    across, after = surface.across, surface.after
    for f in range(1, 4):
        # The edges of facet 0 border facets 1, 2, 3 in turn. The second edge of each of these borders the next one.
        across[f - 1] = f
        across[3 * f] = 0
        across[3 * f + 1] = (f + 1) % 3 + 1
        across[3 * f + 2] = f % 3 + 1
        surface.visible[f] = f
    surface.visible[0] = 0
    for p in range(len(after) - 1):
        after[p] = p + 1
    after[len(after) - 1] = -1
    distribute(at, surface, 0, surface.visible, 4)
    return grow(at, surface, 4)


@cache
def compiled_hull() -> Callable[..., Any]:
    sample: Any = np.zeros(1, np.int64)
    # The kernel allocates no arrays, so numba need not count references.
    return Compiled(hull, _nrt=False).ready(
        Points(sample, sample, sample), Surface(*[sample] * len(Surface._fields)), 0, 0, 0, 0
    )


def polyhedron(points: Grid, simplex: tuple[int, int, int, int], fast: bool) -> tuple[Grid, Grid]:
    """Return the hull of points that are not coplanar: its facets' corners, shape (n, 3), and planes, shape (n, 4).

    ``points`` are distinct, int64 of shape (count, 3), none negative. ``simplex`` names four of them that are not
    coplanar. ``fast`` selects compiled code. Facets are triangles, counterclockwise as seen from outside, and several
    may be coplanar.
    """
    work = compiled_hull() if fast else hull
    capacity = 2 * len(points) + 4
    table: Callable[[int, int], Any] = partial(np.full, dtype=np.int64) if fast else _listed
    axes: list[Any] = [np.ascontiguousarray(axis) if fast else axis.tolist() for axis in points.T]
    at = Points(*axes)
    surface = Surface(
        corner=table(3 * capacity, -1),
        across=table(3 * capacity, 0),
        plane=table(4 * capacity, 0),
        head=table(capacity, -1),
        after=table(len(points), -1),
        depth=table(capacity, 0),
        mark=table(capacity, 0),
        visible=table(capacity, 0),
        horizon=table(3 * capacity, 0),
        starting=table(len(points), 0),
        spare=table(capacity, 0),
    )
    used = work(at, surface, *_outward(points, simplex))
    corner = np.array(surface.corner[: 3 * used], dtype=np.int64).reshape(-1, 3)
    plane = np.array(surface.plane[: 4 * used], dtype=np.int64).reshape(-1, 4)
    occupied = corner[:, 0] >= 0
    return corner[occupied], plane[occupied]


def _listed(count: int, number: int) -> list[int]:
    return [number] * count


def _outward(points: Grid, simplex: tuple[int, int, int, int]) -> tuple[int, int, int, int]:
    a, b, c, d = simplex
    normal = np.cross(points[b] - points[a], points[c] - points[a])
    return (a, b, c, d) if normal @ (points[d] - points[a]) < 0 else (b, a, c, d)

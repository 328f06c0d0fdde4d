"""The hull of points on the grid, one point at a time, in the part of Python that numba compiles.

What :mod:`modern.exact_hull.proposal` does in rounds, with the same signs: Quickhull (Barber, Dobkin and Huhdanpaa, ACM
Transactions on Mathematical Software 22 (1996), 469-483).  Points wait in lists, each at a triangle it sees; the
farthest of a list is inserted next.  A point whose triangle is gone is tried against the new triangles.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

LOW = (1 << 31) - 1
DOUBT = 2.0**-18
SEEN = 1e-300
"""The value of a point that plainly sees a triangle only in integers."""
NEAR = -4.0
"""Values of points that may lie on a surface of rounded points begin here."""


class Surface(NamedTuple):
    """Triangles in slots, a removed one's slot used again, and lists of points.

    grid (n, 3); corners, neighbours, normals (slots, 3) and images (slots, 4): as in the proposal's rounds.
    first, farthest, height: of each slot the first of its points, the farthest, and its value.  mark: at which step
    the triangle was looked at.  following: of each point the next in its list, -1 at the end.  leaving: of each point
    the new triangle whose first corner it is.
    """

    grid: NDArray[np.int64]
    corners: NDArray[np.int64]
    neighbours: NDArray[np.int64]
    normals: NDArray[np.int64]
    images: NDArray[np.float64]
    first: NDArray[np.int64]
    farthest: NDArray[np.int64]
    height: NDArray[np.float64]
    mark: NDArray[np.int64]
    following: NDArray[np.int64]
    leaving: NDArray[np.int64]


def surface(grid: NDArray[np.int64]) -> Surface:
    """Room for the hull of these points: a closed surface of v corners has 2 v - 4 triangles."""
    count = len(grid)
    slots = 2 * count
    return Surface(
        grid,
        corners=np.empty((slots, 3), np.int64),
        neighbours=np.empty((slots, 3), np.int64),
        normals=np.empty((slots, 3), np.int64),
        images=np.empty((slots, 4)),
        first=np.full(slots, -1),
        farthest=np.empty(slots, np.int64),
        height=np.empty(slots),
        mark=np.zeros(slots, np.int64),
        following=np.empty(count, np.int64),
        leaving=np.empty(count, np.int64),
    )


class Room(NamedTuple):
    """Room for what a step works out, so that the kernel makes no array: numba compiles those that do far longer.

    near: of each point whether it may lie on a triangle.  seen, fresh, heads: slots, and lists of points, of a step.
    edges (n, 2), outer (n, 3): those of a horizon.  todo, queued: slots with points.  free: empty slots.
    """

    near: NDArray[np.bool_]
    seen: NDArray[np.int64]
    fresh: NDArray[np.int64]
    heads: NDArray[np.int64]
    edges: NDArray[np.int64]
    outer: NDArray[np.int64]
    todo: NDArray[np.int64]
    queued: NDArray[np.bool_]
    free: NDArray[np.int64]


def room(count: int) -> Room:
    """Room for so many points."""
    seen, fresh, heads, todo = (np.empty(2 * count, np.int64) for _ in range(4))
    return Room(
        near=np.zeros(count, np.bool_),
        seen=seen,
        fresh=fresh,
        heads=heads,
        edges=np.empty((6 * count, 2), np.int64),
        outer=np.empty((2 * count, 3), np.int64),
        todo=todo,
        queued=np.zeros(2 * count, np.bool_),
        free=np.empty(4 * count, np.int64),
    )


def place_triangle(known: Any, slot: int, a: int, b: int, c: int) -> None:
    """Put a triangle into a slot, with its plane and no points."""
    grid, corners, normals, images = known.grid, known.corners, known.normals, known.images
    corners[slot, 0], corners[slot, 1], corners[slot, 2] = a, b, c
    u1, u2, u3 = grid[b, 0] - grid[a, 0], grid[b, 1] - grid[a, 1], grid[b, 2] - grid[a, 2]
    v1, v2, v3 = grid[c, 0] - grid[a, 0], grid[c, 1] - grid[a, 1], grid[c, 2] - grid[a, 2]
    n1, n2, n3 = u2 * v3 - u3 * v2, u3 * v1 - u1 * v3, u1 * v2 - u2 * v1
    normals[slot, 0], normals[slot, 1], normals[slot, 2] = n1, n2, n3
    size = float(max(abs(n1) + abs(n2) + abs(n3), 1))
    m1, m2, m3 = n1 / size, n2 / size, n3 / size
    images[slot, 0], images[slot, 1], images[slot, 2] = m1, m2, m3
    images[slot, 3] = -(m1 * grid[a, 0] + m2 * grid[a, 1] + m3 * grid[a, 2])
    known.first[slot] = -1
    known.height[slot] = 0.0


def value(known: Any, slot: int, p: int) -> float:
    """A point's value at a triangle's plane, its sign exact."""
    grid, images = known.grid, known.images
    x, y, z = grid[p, 0], grid[p, 1], grid[p, 2]
    found = images[slot, 0] * x + images[slot, 1] * y + images[slot, 2] * z + images[slot, 3]
    if abs(found) > DOUBT:
        return found  # type: ignore[no-any-return]
    a = known.corners[slot, 0]
    high, low = np.int64(0), np.int64(0)
    for axis in range(3):
        difference, number = grid[p, axis] - grid[a, axis], known.normals[slot, axis]
        high += (number >> 31) * difference
        low += (number & LOW) * difference
    high += low >> 31
    low &= LOW
    if high > 0 or (high == 0 and low > 0):
        return SEEN
    return -SEEN if high < 0 else 0.0


def wait(known: Any, slot: int, p: int, found: float) -> None:
    """Put a point into a triangle's list."""
    known.following[p] = known.first[slot]
    known.first[slot] = p
    if found > known.height[slot]:
        known.height[slot] = found
        known.farthest[slot] = p


def distribute(known: Any, p: int, slots: Any, count: int, exact: bool) -> bool:
    """Let a point wait at the first of the triangles that it sees; if at none, whether it may be on the surface."""
    largest = -np.inf
    for k in range(count):
        found = value(known, slots[k], p)
        if found > 0:
            wait(known, slots[k], p, found)
            return False
        largest = max(largest, found)
    return largest == 0.0 if exact else largest >= NEAR


def region(known: Any, p: int, start: int, step: int, seen: Any, edges: Any) -> Any:
    """The triangles a point sees, with ``start``, and the edges (slot, edge) of their region; how many of each."""
    mark, neighbours = known.mark, known.neighbours
    seen[0] = start
    mark[start] = 2 * step
    count, border, done = 1, 0, 0
    while done < count:
        slot = seen[done]
        done += 1
        for k in range(3):
            beyond = neighbours[slot, k]
            if mark[beyond] != 2 * step and mark[beyond] != 2 * step + 1:
                if value(known, beyond, p) > 0:
                    mark[beyond] = 2 * step
                    seen[count] = beyond
                    count += 1
                else:
                    mark[beyond] = 2 * step + 1
            if mark[beyond] == 2 * step + 1:
                edges[border, 0], edges[border, 1] = slot, k
                border += 1
    return count, border


def grow(known: Any, work: Any, start: NDArray[np.int64], exact: bool) -> int:
    """How many slots of triangles the hull has, those with a first corner below 0 empty; 0: the surface does not close.

    ``work.near`` is which points may lie on it.
    """
    corners, neighbours = known.corners, known.neighbours
    points = len(known.grid)
    near, seen, fresh, heads = work.near, work.seen, work.fresh, work.heads
    edges, outer, todo, queued, free = work.edges, work.outer, work.todo, work.queued, work.free
    a, b, c, d = start[0], start[1], start[2], start[3]
    place_triangle(known, 0, a, b, c)
    place_triangle(known, 1, b, a, d)
    place_triangle(known, 2, c, b, d)
    place_triangle(known, 3, a, c, d)
    for slot in range(4):
        fresh[slot] = todo[slot] = slot
        queued[slot] = True
        for k in range(3):
            neighbours[slot, k] = (1 + k if slot == 0 else 0) if k == 0 or slot == 0 else -1
    neighbours[1, 1], neighbours[1, 2] = 3, 2
    neighbours[2, 1], neighbours[2, 2] = 1, 3
    neighbours[3, 1], neighbours[3, 2] = 2, 1
    for p in range(points):
        if p != a and p != b and p != c and p != d:
            near[p] = distribute(known, p, fresh, 4, exact)
    made, waiting, step, spare = 4, 4, 0, 0
    while waiting:
        waiting -= 1
        slot = todo[waiting]
        queued[slot] = False
        if known.first[slot] < 0:
            continue
        step += 1
        p = known.farthest[slot]
        count, border = region(known, p, slot, step, seen, edges)
        if border < 3 or made + max(0, border - count - spare) > 2 * points:
            return 0
        for k in range(border):
            inner, edge = edges[k, 0], edges[k, 1]
            u, v = corners[inner, edge], corners[inner, (edge + 1) % 3]
            outer[k, 0], outer[k, 1], outer[k, 2] = u, v, neighbours[inner, edge]
        for k in range(count):
            heads[k] = known.first[seen[k]]
            known.first[seen[k]] = -1
            corners[seen[k], 0] = -1
            free[spare] = seen[k]
            spare += 1
        for k in range(border):
            if spare:
                spare -= 1
                fresh[k] = free[spare]
            else:
                fresh[k] = made
                made += 1
        for k in range(border):
            new, u, v, beyond = fresh[k], outer[k, 0], outer[k, 1], outer[k, 2]
            place_triangle(known, new, u, v, p)
            known.leaving[u] = new
            neighbours[new, 0] = beyond
            for other in range(3):
                if corners[beyond, other] == v:
                    neighbours[beyond, other] = new
        for k in range(border):
            new = fresh[k]
            after = known.leaving[outer[k, 1]]
            if after < 0 or after >= made or corners[after, 0] != outer[k, 1] or corners[after, 2] != p:
                return 0
            neighbours[new, 1] = after
            neighbours[after, 2] = new
        for k in range(count):
            q = heads[k]
            while q >= 0:
                following = known.following[q]
                if q != p:
                    near[q] = distribute(known, q, fresh, border, exact)
                q = following
        for k in range(border):
            if known.first[fresh[k]] >= 0 and not queued[fresh[k]]:
                queued[fresh[k]] = True
                todo[waiting] = fresh[k]
                waiting += 1
    return made

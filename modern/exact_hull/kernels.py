"""The hull of points on the integer grid, one point at a time, in the subset of Python that numba compiles.

This is Quickhull (Barber, Dobkin and Huhdanpaa, ACM Transactions on Mathematical Software 22 (1996), 469-483), with the
same exact signs as :mod:`modern.exact_hull.proposal`, which inserts points in rounds.  Waiting points are in linked
lists, each at a triangle that it sees, and the farthest point of a list is inserted next.  When a triangle is removed,
its points are compared with the new triangles.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

LOW = (1 << 31) - 1
DOUBT = 2.0**-18
# The value of a triangle's plane at a point that sees the triangle, if only integers could decide that it does.
SEEN = 1e-300
# The smallest value of a plane at a point that may have been on the surface before the points were rounded.
NEAR = -4.0


class Surface(NamedTuple):
    """Triangles in numbered slots, which are reused after removal, and linked lists of the points waiting outside each.

    grid (n, 3): the points. corners, neighbours, normals (slots, 3), images (slots, 4): as in ``proposal``. first,
    farthest, height: for each triangle the first and the farthest of its waiting points, and the value of its plane at
    the farthest. mark: twice the number of the step that last tested the triangle, plus 1 if it is not visible.
    following: the next waiting point in the list of each point, or -1. leaving: for each point, the new triangle whose
    first corner it is.
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
    """Allocate the arrays for the hull of these points: a closed surface of v corners has 2 v - 4 triangles."""
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
    """Work arrays of a step.  The kernel itself allocates none, because numba then compiles much faster.

    ``near`` is True for each point that may lie on the surface.  ``visible`` and ``fresh`` are the visible and the new
    triangles of a step.  ``heads`` has the first point in the list of each visible triangle.  ``edges`` (n, 2) holds
    the horizon as (slot, edge), and ``outer`` (n, 3) as (start, end, triangle beyond).  ``todo`` is a stack of slots
    with waiting points, ``queued`` is True for each slot on the stack, and ``free`` holds empty slots.
    """

    near: NDArray[np.bool_]
    visible: NDArray[np.int64]
    fresh: NDArray[np.int64]
    heads: NDArray[np.int64]
    edges: NDArray[np.int64]
    outer: NDArray[np.int64]
    todo: NDArray[np.int64]
    queued: NDArray[np.bool_]
    free: NDArray[np.int64]


def room(count: int) -> Room:
    visible, fresh, heads, todo = (np.empty(2 * count, np.int64) for _ in range(4))
    return Room(
        near=np.zeros(count, np.bool_),
        visible=visible,
        fresh=fresh,
        heads=heads,
        edges=np.empty((6 * count, 2), np.int64),
        outer=np.empty((2 * count, 3), np.int64),
        todo=todo,
        queued=np.zeros(2 * count, np.bool_),
        free=np.empty(4 * count, np.int64),
    )


def place_triangle(known: Any, slot: int, a: int, b: int, c: int) -> None:
    """Write a triangle with its plane and no waiting points into a slot."""
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
    """Return the value of a triangle's plane at a point; the sign is exact."""
    grid, images = known.grid, known.images
    x, y, z = grid[p, 0], grid[p, 1], grid[p, 2]
    approximate = images[slot, 0] * x + images[slot, 1] * y + images[slot, 2] * z + images[slot, 3]
    if abs(approximate) > DOUBT:
        return approximate  # type: ignore[no-any-return]
    # Compute the value exactly in two int64: each number of the normal is 2**31 high + low.
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


def wait(known: Any, slot: int, p: int, height: float) -> None:
    """Add a point to the points waiting outside a triangle, where the triangle's plane has the value ``height``."""
    known.following[p] = known.first[slot]
    known.first[slot] = p
    if height > known.height[slot]:
        known.height[slot] = height
        known.farthest[slot] = p


def distribute(known: Any, p: int, slots: Any, count: int, exact: bool) -> bool:
    """Let a point wait outside the first triangle that it sees. Return True if it may lie on the surface instead."""
    largest = -np.inf
    for k in range(count):
        height = value(known, slots[k], p)
        if height > 0:
            wait(known, slots[k], p, height)
            return False
        largest = max(largest, height)
    return largest == 0.0 if exact else largest >= NEAR


def region(known: Any, p: int, start: int, step: int, visible: Any, edges: Any) -> Any:
    """Find the triangles that a point sees, from ``start`` on, and the edges around them. Return both numbers."""
    mark, neighbours = known.mark, known.neighbours
    visible[0] = start
    mark[start] = 2 * step
    count, border, done = 1, 0, 0
    while done < count:
        slot = visible[done]
        done += 1
        for k in range(3):
            beyond = neighbours[slot, k]
            if mark[beyond] != 2 * step and mark[beyond] != 2 * step + 1:
                if value(known, beyond, p) > 0:
                    mark[beyond] = 2 * step
                    visible[count] = beyond
                    count += 1
                else:
                    mark[beyond] = 2 * step + 1
            if mark[beyond] == 2 * step + 1:
                edges[border, 0], edges[border, 1] = slot, k
                border += 1
    return count, border


def grow(known: Any, work: Any, start: NDArray[np.int64], exact: bool) -> int:
    """Grow the hull from four points, and return the number of slots used, or 0 if the surface does not close."""
    corners, neighbours = known.corners, known.neighbours
    points = len(known.grid)
    near, visible, fresh, heads = work.near, work.visible, work.fresh, work.heads
    edges, outer, todo, queued, free = work.edges, work.outer, work.todo, work.queued, work.free
    a, b, c, d = start[0], start[1], start[2], start[3]
    # The first tetrahedron: slot 0 is its base.  The other triangles share edges with the base and with each other.
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
    # Each other point waits at a triangle that it sees, unless it is inside the tetrahedron.
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
        # Insert the farthest point of the list.
        step += 1
        p = known.farthest[slot]
        count, border = region(known, p, slot, step, visible, edges)
        # If these conditions fail, the surface is not closed: the border of a disc has at least three edges, and there
        # are slots enough for a closed surface.
        if border < 3 or made + max(0, border - count - spare) > 2 * points:
            return 0
        # Copy the horizon before its triangles are overwritten.
        for k in range(border):
            inner, edge = edges[k, 0], edges[k, 1]
            u, v = corners[inner, edge], corners[inner, (edge + 1) % 3]
            outer[k, 0], outer[k, 1], outer[k, 2] = u, v, neighbours[inner, edge]
        # Remove the visible triangles, and remember their lists of points.
        for k in range(count):
            heads[k] = known.first[visible[k]]
            known.first[visible[k]] = -1
            corners[visible[k], 0] = -1
            free[spare] = visible[k]
            spare += 1
        # Choose a slot for each new triangle.
        for k in range(border):
            if spare:
                spare -= 1
                fresh[k] = free[spare]
            else:
                fresh[k] = made
                made += 1
        # Join each edge of the horizon to p, and link the new triangle with the one beyond.
        for k in range(border):
            new, u, v, beyond = fresh[k], outer[k, 0], outer[k, 1], outer[k, 2]
            place_triangle(known, new, u, v, p)
            known.leaving[u] = new
            neighbours[new, 0] = beyond
            for edge in range(3):
                if corners[beyond, edge] == v:
                    neighbours[beyond, edge] = new
        # Link the new triangles with each other.  If the horizon is not one cycle, the surface was not convex.
        for k in range(border):
            new = fresh[k]
            after = known.leaving[outer[k, 1]]
            if after < 0 or after >= made or corners[after, 0] != outer[k, 1] or corners[after, 2] != p:
                return 0
            neighbours[new, 1] = after
            neighbours[after, 2] = new
        # Compare the points of the removed triangles with the new ones.
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

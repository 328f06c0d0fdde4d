"""Construct a hull of doubles by Quickhull, one point at a time, compiled by numba.

The algorithm is that of Barber, Dobkin and Huhdanpaa, ACM Transactions on Mathematical Software 22 (1996), 469-483.  A
point that is not yet in the hull waits in the linked list of a triangle that it sees (is outside of), and the farthest
point of a list is inserted next.  When a triangle is removed, the points in its list are compared with the new
triangles.

Signs are exact.  With h = 2**-53 a difference of doubles has a relative error of at most h.  A component of the vector
product u x v, such as u2 v3 - u3 v2, has an error of at most 4h q, where q = |u2 v3| + |u3 v2|.  The product of this
component with the difference d from a corner, which is at most 1, has an error of at most 6h q.  The additions round by
less than 3h times the sum of all q.  The total is below 9h times this sum, and underflow adds less than 2**-1000.  A
value beyond BOUND = 16h times the sum, plus 2**-1000, has the true sign.  All others are computed as expansions: sums
of doubles that do not overlap (Shewchuk, Discrete & Computational Geometry 18 (1997), 305-363, theorem 10).  Expansions
are exact unless numbers underflow, which the caller excludes.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

BOUND, TINY = 2.0**-49, 2.0**-1000
# The value of a triangle's plane at a point that sees the triangle, if only an expansion could decide that it does.
SEEN = 1e-300
# Multiplication by this number splits a double into two halves (Dekker).
_SPLITTER = 2.0**27 + 1
# The six products of a determinant: the axes of its three rows, and the sign.
_PRODUCTS = ((0, 1, 2, 1), (1, 2, 0, 1), (2, 0, 1, 1), (0, 2, 1, -1), (1, 0, 2, -1), (2, 1, 0, -1))
# An expansion has at most this number of terms: six products of three sums of two doubles, each of four terms.
_TERMS = 6 * 8 * 4


class Surface(NamedTuple):
    """The growing hull: triangles in numbered slots, each with a linked list of the points outside it.

    places (n, 3): the points. corners, neighbours (slots, 3): the corners of each triangle, and the triangle beyond
    each edge. normals (slots, 3): vector products of the sides. bound: the bound for the values of each triangle's
    plane. first, farthest, height: for each triangle the first and the farthest of its waiting points, and the value of
    its plane at the farthest. mark: twice the number of the step that last tested the triangle, plus 1 if it is not
    visible. following: the next waiting point in the list of each point, or -1. leaving: for each point, the new
    triangle whose first corner it is. terms: an expansion. exact: True if all values are exact without expansions.
    """

    places: NDArray[np.float64]
    corners: NDArray[np.int64]
    neighbours: NDArray[np.int64]
    normals: NDArray[np.float64]
    bound: NDArray[np.float64]
    first: NDArray[np.int64]
    farthest: NDArray[np.int64]
    height: NDArray[np.float64]
    mark: NDArray[np.int64]
    following: NDArray[np.int64]
    leaving: NDArray[np.int64]
    terms: NDArray[np.float64]
    exact: bool


def surface(places: NDArray[np.float64], exact: bool) -> Surface:
    """Allocate a surface for the hull of these points.  A closed surface of v corners has 2 v - 4 triangles."""
    count = len(places)
    slots = 2 * count
    return Surface(
        places,
        corners=np.empty((slots, 3), np.int64),
        neighbours=np.empty((slots, 3), np.int64),
        normals=np.empty((slots, 3)),
        bound=np.empty(slots),
        first=np.full(slots, -1),
        farthest=np.empty(slots, np.int64),
        height=np.empty(slots),
        mark=np.zeros(slots, np.int64),
        following=np.empty(count, np.int64),
        leaving=np.empty(count, np.int64),
        terms=np.empty(_TERMS),
        exact=exact,
    )


class Room(NamedTuple):
    """Temporary arrays for the insertion of a point.

    They are allocated once, because numba compiles functions faster if they allocate nothing.  ``near`` has, for each
    point, a triangle in whose plane the point lay when it was last compared with triangles, or -1.  ``visible`` and
    ``fresh`` are the visible and the new triangles of a step.  ``heads`` has the first point in the list of each
    visible triangle. ``edges`` (n, 2) holds the horizon, the edges around the visible triangles, as (slot, edge), and
    ``outer`` (n, 3) as (start, end, triangle beyond).  ``todo`` is a stack of slots with waiting points, ``queued`` is
    True for each slot on the stack, and ``free`` holds empty slots.
    """

    near: NDArray[np.int64]
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
        near=np.full(count, -1),
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
    """Write a triangle and its plane into a slot, with an empty list of points."""
    places, corners, normals = known.places, known.corners, known.normals
    corners[slot, 0], corners[slot, 1], corners[slot, 2] = a, b, c
    total, flat = 0.0, -1
    for axis in range(3):
        j, k = (axis + 1) % 3, (axis + 2) % 3
        first = (places[b, j] - places[a, j]) * (places[c, k] - places[a, k])
        second = (places[b, k] - places[a, k]) * (places[c, j] - places[a, j])
        normals[slot, axis] = first - second
        total += abs(first) + abs(second)
        if places[a, axis] == places[b, axis] and places[a, axis] == places[c, axis]:
            flat = axis
    known.bound[slot] = 0.0 if known.exact else BOUND * total + TINY
    # If the plane is perpendicular to an axis, the value is a difference of coordinates, whose sign is exact.
    if flat >= 0 and abs(normals[slot, flat]) > known.bound[slot]:
        normals[slot, flat] = 1.0 if normals[slot, flat] > 0 else -1.0
        known.bound[slot] = 0.0
    known.first[slot] = -1
    known.height[slot] = 0.0


def add(terms: Any, count: int, number: float) -> int:
    """Add a number to an expansion, a sum of doubles that do not overlap.  Return the new count of nonzero terms."""
    size = 0
    for k in range(count):
        term = terms[k]
        total = number + term
        rounded = total - number
        error = (number - (total - rounded)) + (term - rounded)
        if error != 0.0:
            terms[size] = error
            size += 1
        number = total
    if number != 0.0:
        terms[size] = number
        size += 1
    return size


def product_error(x: float, y: float, product: float) -> float:
    """Return the exact rounding error of a product: x y - product."""
    scaled = _SPLITTER * x
    x_high = scaled - (scaled - x)
    x_low = x - x_high
    scaled = _SPLITTER * y
    y_high = scaled - (scaled - y)
    y_low = y - y_high
    return x_low * y_low - (((product - x_high * y_high) - x_low * y_high) - x_high * y_low)


def difference(x: float, y: float, part: int) -> float:
    """Return x - y rounded if ``part`` is 0, or the rounding error if it is 1."""
    rounded = x - y
    if part == 0:
        return rounded
    z = rounded - x
    return (x - (rounded - z)) - (y + z)


def orientation(terms: Any, places: Any, corners: Any, slot: int, p: int) -> float:
    """Return a number with the exact sign of the determinant that shows on which side of a triangle ``p`` is."""
    a, b, c = corners[slot, 0], corners[slot, 1], corners[slot, 2]
    count = 0
    for i, j, k, sign in _PRODUCTS:
        for parts in range(8):
            x = sign * difference(places[b, i], places[a, i], parts & 1)
            y = difference(places[c, j], places[a, j], parts >> 1 & 1)
            z = difference(places[p, k], places[a, k], parts >> 2)
            if x == 0.0 or y == 0.0 or z == 0.0:
                continue
            # The product x y is a sum of two doubles, and the product of each with z is one too.
            high = x * y
            low = product_error(x, y, high)
            count = add(terms, count, product_error(low, z, low * z))
            count = add(terms, count, low * z)
            count = add(terms, count, product_error(high, z, high * z))
            count = add(terms, count, high * z)
    return terms[count - 1] if count else 0.0


def value(known: Any, slot: int, p: int) -> float:
    """Return the value of a triangle's plane at a point.  The value is rounded, but its sign is exact."""
    places, normals, a = known.places, known.normals, known.corners[slot, 0]
    approximate = (
        normals[slot, 0] * (places[p, 0] - places[a, 0])
        + normals[slot, 1] * (places[p, 1] - places[a, 1])
        + normals[slot, 2] * (places[p, 2] - places[a, 2])
    )
    if abs(approximate) > known.bound[slot] or known.bound[slot] == 0.0:
        return approximate  # type: ignore[no-any-return]
    exact = orientation(known.terms, places, known.corners, slot, p)
    if exact == 0.0:
        return 0.0
    return SEEN if exact > 0.0 else -SEEN


def wait(known: Any, slot: int, p: int, height: float) -> None:
    """Add a point to the list of a triangle that it is outside of.

    ``height`` is the value of the triangle's plane at the point.
    """
    known.following[p] = known.first[slot]
    known.first[slot] = p
    if height > known.height[slot]:
        known.height[slot] = height
        known.farthest[slot] = p


def distribute(known: Any, p: int, slots: Any, count: int) -> int:
    """Add a point to the list of the first triangle that it is outside of.

    Return -1 if the point was added.  Otherwise return a triangle in whose plane the point lies, or -1 if there is no
    such triangle.
    """
    level = -1
    for k in range(count):
        height = value(known, slots[k], p)
        if height > 0:
            wait(known, slots[k], p, height)
            return -1
        if height == 0.0:
            level = slots[k]
    return level


def region(known: Any, p: int, start: int, step: int, visible: Any, edges: Any) -> Any:
    """Find the triangles that a point is outside of, and the edges around them.  Return the numbers of both."""
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


def grow(known: Any, work: Any, start: NDArray[np.int64]) -> int:
    """Grow the hull from the points ``start``.  Return the number of slots used, or 0 if the surface is not closed."""
    corners, neighbours = known.corners, known.neighbours
    points = len(known.places)
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
            near[p] = distribute(known, p, fresh, 4)
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
                    near[q] = distribute(known, q, fresh, border)
                q = following
        for k in range(border):
            if known.first[fresh[k]] >= 0 and not queued[fresh[k]]:
                queued[fresh[k]] = True
                todo[waiting] = fresh[k]
                waiting += 1
    return made

"""The vertices of a face in cyclic order, exactly."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cmp_to_key

from modern.port.arithmetic import Exact

IntPoint = tuple[int, int, int]


def cyclic(points: Sequence[IntPoint], normal: Sequence[Exact]) -> list[int]:
    """The order in which points of a plane stand around it, counterclockwise against ``normal``, the first first.

    ``points`` are the corners of a convex polygon, exactly or nearly so: the order is that of the directions
    from the lowest corner, in the projection along the normal's largest component.
    """
    sizes: list[Exact] = [component if component > 0 else -component for component in normal]
    axis = sizes.index(max(sizes))
    u, v = ((1, 2), (2, 0), (0, 1))[axis]
    if normal[axis] < 0:
        u, v = v, u
    flat = [(p[u], p[v]) for p in points]
    if len(flat) == 3 and (turn := _turn(*flat)):
        return [0, 1, 2] if turn > 0 else [0, 2, 1]
    start = min(range(len(flat)), key=lambda k: flat[k])
    x0, y0 = flat[start]

    def compare(i: int, j: int) -> int:
        (x1, y1), (x2, y2) = flat[i], flat[j]
        turn = _turn(flat[start], flat[i], flat[j])
        if turn:
            return -1 if turn > 0 else 1
        return -1 if abs(x1 - x0) + abs(y1 - y0) < abs(x2 - x0) + abs(y2 - y0) else 1

    order = [start, *sorted((k for k in range(len(flat)) if k != start), key=cmp_to_key(compare))]
    first = order.index(0)
    return order[first:] + order[:first]


def _turn(p: tuple[int, int], q: tuple[int, int], r: tuple[int, int]) -> int:
    """Positive where the way from p by q to r turns left."""
    return (q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1])

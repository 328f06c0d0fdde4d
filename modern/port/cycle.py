"""The vertices of a face in cyclic order, exactly."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import cmp_to_key

from modern.port.arithmetic import Exact

IntPoint = tuple[int, int, int]


def cyclic(points: Sequence[IntPoint], normal: Sequence[Exact]) -> list[int]:
    """The order in which points of a plane stand around it, counterclockwise against ``normal``, the first first.

    ``points`` are the corners of a convex polygon, exactly or nearly so: the order is that of the directions
    from the lowest corner, in the projection along the normal's largest component.
    """
    sizes = [abs(Fraction(component)) for component in normal]
    axis = sizes.index(max(sizes))
    u, v = ((1, 2), (2, 0), (0, 1))[axis]
    if normal[axis] < 0:
        u, v = v, u
    flat = [(p[u], p[v]) for p in points]
    start = min(range(len(flat)), key=lambda k: flat[k])
    x0, y0 = flat[start]

    def compare(i: int, j: int) -> int:
        (x1, y1), (x2, y2) = flat[i], flat[j]
        turn = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
        if turn:
            return -1 if turn > 0 else 1
        return -1 if abs(x1 - x0) + abs(y1 - y0) < abs(x2 - x0) + abs(y2 - y0) else 1

    order = [start, *sorted((k for k in range(len(flat)) if k != start), key=cmp_to_key(compare))]
    first = order.index(0)
    return order[first:] + order[:first]

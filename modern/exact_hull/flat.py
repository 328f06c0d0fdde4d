"""Hulls of points in one line or one plane, by sorting."""

from __future__ import annotations

from collections.abc import Sequence

from modern.exact_hull.coordinates import IntPoint
from modern.exact_hull.faces import rotated
from modern.exact_hull.planes import cross, lowest_terms, minus, plane_at, plane_through
from modern.exact_hull.result import Facet, Plane


def segment(points: Sequence[IntPoint]) -> list[Facet]:
    """The two ends of distinct points in a line: on a line the order of coordinates is the order of points."""
    places = range(len(points))
    low, high = min(places, key=points.__getitem__), max(places, key=points.__getitem__)
    along = minus(points[high], points[low])
    against = minus(points[low], points[high])
    return [
        Facet(lowest_terms(plane_at(along, points[high])), (high,)),
        Facet(lowest_terms(plane_at(against, points[low])), (low,)),
    ]


def positive(plane: Plane) -> Plane:
    """The plane in lowest terms with the first nonzero of A, B, C positive."""
    a, b, c, d = lowest_terms(plane)
    return (a, b, c, d) if (a, b, c) > (0, 0, 0) else (-a, -b, -c, -d)


def polygon(points: Sequence[IntPoint], three: Sequence[int]) -> tuple[Plane, tuple[int, ...], list[Facet]]:
    """The plane, the vertices in cyclic order and the edges of distinct points in a plane.

    ``three`` names three points not in a line.  Monotone chains (Andrew, Information Processing Letters 9 (1979))
    over two of the coordinates, chosen so that the normal does not vanish between them.
    """
    plane = positive(plane_through(points[three[0]], points[three[1]], points[three[2]]))
    normal = plane[:3]
    dropped = max(range(3), key=lambda axis: abs(normal[axis]))
    u, v = (dropped + 1) % 3, (dropped + 2) % 3
    if normal[dropped] < 0:
        u, v = v, u

    def left_turn(i: int, j: int, k: int) -> bool:
        p, q, r = points[i], points[j], points[k]
        return (q[u] - p[u]) * (r[v] - p[v]) > (q[v] - p[v]) * (r[u] - p[u])

    def chain(order: Sequence[int]) -> list[int]:
        kept: list[int] = []
        for index in order:
            while len(kept) >= 2 and not left_turn(kept[-2], kept[-1], index):
                kept.pop()
            kept.append(index)
        return kept[:-1]

    order = sorted(range(len(points)), key=lambda index: (points[index][u], points[index][v]))
    cycle = rotated(chain(order) + chain(order[::-1]))
    edges = []
    for start, end in zip(cycle, cycle[1:] + cycle[:1], strict=True):
        outward = cross(minus(points[end], points[start]), normal)
        edges.append(Facet(lowest_terms(plane_at(outward, points[start])), (min(start, end), max(start, end))))
    return plane, cycle, edges

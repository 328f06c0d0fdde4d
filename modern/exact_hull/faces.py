"""Triangles to faces: those in one plane become one polygon."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from modern.exact_hull.coordinates import IntPoint
from modern.exact_hull.incremental import Triangle
from modern.exact_hull.planes import cross, lowest_terms, minus
from modern.exact_hull.result import Facet, Plane


def rotated(polygon: Sequence[int]) -> tuple[int, ...]:
    """The same cycle, from its smallest member on."""
    start = polygon.index(min(polygon))
    return (*polygon[start:], *polygon[:start])


def corners_only(cycle: Sequence[int], points: Sequence[IntPoint]) -> list[int]:
    """A convex cycle of points without those that lie straight between their neighbours."""
    kept = []
    for before, here, after in zip((cycle[-1], *cycle[:-1]), cycle, (*cycle[1:], cycle[0]), strict=True):
        if any(cross(minus(points[here], points[before]), minus(points[after], points[here]))):
            kept.append(here)
    return kept


def _outline(triangles: Iterable[Triangle]) -> list[int]:
    """The border of triangles that fill a polygon, in their own sense."""
    edges = {edge for a, b, c in triangles for edge in ((a, b), (b, c), (c, a))}
    following = {a: b for a, b in edges if (b, a) not in edges}
    start = here = min(following)
    cycle = []
    while True:
        cycle.append(here)
        here = following[here]
        if here == start or len(cycle) > len(following):
            break
    if len(cycle) != len(following):
        raise RuntimeError("the triangles of one plane do not fill one polygon: the surface was not convex")
    return cycle


def faces(triangles: Iterable[tuple[Triangle, Plane]], points: Sequence[IntPoint]) -> list[Facet]:
    """The faces of a convex surface of triangles, by plane in lowest terms; polygons index ``points``."""
    groups: dict[Plane, list[Triangle]] = {}
    for corners, plane in triangles:
        groups.setdefault(lowest_terms(plane), []).append(corners)
    return [
        Facet(plane, rotated(group[0] if len(group) == 1 else corners_only(_outline(group), points)))
        for plane, group in groups.items()
    ]

"""The near plane of a perspective: what lies beyond it is drawn, what it cuts is cut exactly, the rest is left out.

The plane stands at right angles to the direction of view, at a distance from the eye.  That distance is measured in
fractions, within 1/10^15 of what was said; where edges meet the plane is then exact, and a cut polyhedron is convex
again, with a face in the plane.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from modern.geometry.mesh import sides
from modern.geometry.vectors import Vector, minus
from modern.papers.nakamae_nishita.polyhedron import Figure, Polyhedron, SceneError
from modern.papers.nakamae_nishita.projection import Observer


@dataclass(frozen=True, slots=True)
class Kept:
    """Polyhedra beyond the near plane, and the names of those it cuts and of those behind it."""

    polyhedra: tuple[Polyhedron, ...]
    cut: tuple[str, ...] = ()
    behind: tuple[str, ...] = ()


def beyond_near(polyhedra: Sequence[Polyhedron], observer: Observer) -> Kept:
    """The polyhedra as far as they lie beyond the near plane; all of them where the observer has none.

    Raises SceneError where nothing is left.
    """
    if observer.near is None or observer.point is None:
        return Kept(tuple(polyhedra))
    kept, cut, behind = [], [], []
    for polyhedron in polyhedra:
        depths = [_depth(point, observer) for point in polyhedron.vertices]
        if min(depths) >= 0:
            kept.append(polyhedron)
        elif max(depths) <= 0:
            behind.append(polyhedron.name)
        else:
            kept.append(_clipped(polyhedron, depths, observer))
            cut.append(polyhedron.name)
    if polyhedra and not kept:
        raise SceneError("everything lies behind the near plane")
    return Kept(tuple(kept), tuple(cut), tuple(behind))


def _depth(point: Vector, observer: Observer) -> Fraction:
    """How far beyond the near plane a point lies, times the length of ``observer.eye``; behind it negative."""
    assert observer.point is not None
    assert observer.near is not None
    x, y, z = minus(observer.point, point)
    a, b, c = observer.eye
    return a * x + b * y + c * z - observer.near * observer.stretch


def _clipped(polyhedron: Polyhedron, depths: Sequence[Fraction], observer: Observer) -> Polyhedron:
    """The part of a polyhedron beyond the plane, which cuts it; the last face is the cut's, which a plate has not."""
    points = list(polyhedron.vertices)
    cuts: dict[tuple[int, int], int] = {}

    def crossing(a: int, b: int) -> int:
        low, high = min(a, b), max(a, b)
        if (low, high) not in cuts:
            cuts[low, high] = len(points)
            points.append(_between(points[low], points[high], depths[low], depths[high]))
        return cuts[low, high]

    faces, orders = [], []
    for order, face in enumerate(polyhedron.faces):
        if max(depths[place] for place in face) <= 0:
            continue
        found: list[int] = []
        for a, b in sides(face):
            if depths[a] >= 0:
                found.append(a)
            if depths[a] * depths[b] < 0:
                found.append(crossing(a, b))
        faces.append(tuple(found))
        orders.append(order)
    edges = {edge for face in faces for edge in sides(face)}
    ahead = {b: a for a, b in edges if (b, a) not in edges}
    groups = [polyhedron.joined[order] for order in orders] if polyhedron.joined else []
    if ahead:
        chain = [min(ahead)]
        while ahead[chain[-1]] != chain[0]:
            chain.append(ahead[chain[-1]])
        faces.append(tuple(chain))
        groups += [max(groups) + 1] if groups else []
    used = sorted({place for face in faces for place in face})
    names = {place: order for order, place in enumerate(used)}
    return replace(
        polyhedron,
        vertices=tuple(points[place] for place in used),
        faces=tuple(tuple(names[place] for place in face) for face in faces),
        figures=tuple(
            Figure(orders.index(figure.face), corners)
            for figure in polyhedron.figures
            if figure.face in orders and (corners := _cut(figure.corners, observer))
        ),
        joined=tuple(groups),
    )


def _cut(corners: Sequence[Vector], observer: Observer) -> tuple[Vector, ...]:
    """The part of a figure beyond the plane, closed along the cut (Sutherland and Hodgman, CACM 17 (1974))."""
    depths = [_depth(point, observer) for point in corners]
    found = []
    for a, b in sides(range(len(corners))):
        if depths[a] >= 0:
            found.append(corners[a])
        if depths[a] * depths[b] < 0:
            found.append(_between(corners[a], corners[b], depths[a], depths[b]))
    return tuple(found) if max(depths) > 0 else ()


def _between(p: Vector, q: Vector, at_p: Fraction, at_q: Fraction) -> Vector:
    """The point from p to q where a linear function with these values at p and q, of opposite signs, is 0."""
    share = at_p / (at_p - at_q)
    x, y, z = (a + share * (b - a) for a, b in zip(p, q, strict=True))
    return x, y, z

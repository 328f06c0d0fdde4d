"""Clip a scene at the near plane of a perspective: omit polyhedra on the eye's side of it, cut those that it crosses.

The plane is perpendicular to the direction of view. The distance of the plane from the eye is a fraction. The relative
difference between this fraction and the requested distance is at most 1e-15. The intersections of edges with this plane
are exact, so a clipped polyhedron is convex again and has a face in the plane.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from modern.geometry.mesh import cycle_of, sides
from modern.geometry.vectors import Vector, minus
from modern.papers.nakamae_nishita.polyhedron import Figure, Polyhedron, SceneError
from modern.papers.nakamae_nishita.projection import Observer


@dataclass(frozen=True, slots=True)
class Clipped:
    """The polyhedra beyond the near plane, and the names of those that were cut and of those that were omitted."""

    polyhedra: tuple[Polyhedron, ...]
    cut: tuple[str, ...] = ()
    behind: tuple[str, ...] = ()


def beyond_near(polyhedra: Sequence[Polyhedron], observer: Observer) -> Clipped:
    """Return the parts of polyhedra beyond the near plane, or all if there is no such plane.

    Raise SceneError if nothing remains.
    """
    if observer.near is None or observer.point is None:
        return Clipped(tuple(polyhedra))
    remaining, cut, behind = [], [], []
    for polyhedron in polyhedra:
        depths = [_depth(point, observer) for point in polyhedron.vertices]
        if min(depths) >= 0:
            remaining.append(polyhedron)
        elif max(depths) <= 0:
            behind.append(polyhedron.name)
        else:
            remaining.append(_clipped(polyhedron, depths, observer))
            cut.append(polyhedron.name)
    if polyhedra and not remaining:
        raise SceneError("expected a polyhedron beyond the near plane, but all polyhedra lie on its near side")
    return Clipped(tuple(remaining), tuple(cut), tuple(behind))


def _depth(point: Vector, observer: Observer) -> Fraction:
    """Return the distance of a point beyond the near plane, multiplied by the length of the vector ``observer.eye``."""
    assert observer.point is not None
    assert observer.near is not None
    x, y, z = minus(observer.point, point)
    a, b, c = observer.eye
    return a * x + b * y + c * z - observer.near * observer.stretch


def _clipped(polyhedron: Polyhedron, depths: Sequence[Fraction], observer: Observer) -> Polyhedron:
    """Return the part of a polyhedron beyond the near plane. Unless it is a plate, its last face lies in that plane."""
    points = list(polyhedron.vertices)
    # The index of the new vertex on every edge that the plane cuts. Two faces share each new vertex.
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
        # Sutherland and Hodgman: keep the vertices beyond the plane and insert the crossings of the sides.
        clipped_face: list[int] = []
        for a, b in sides(face):
            if depths[a] >= 0:
                clipped_face.append(a)
            if depths[a] * depths[b] < 0:
                clipped_face.append(crossing(a, b))
        faces.append(tuple(clipped_face))
        orders.append(order)
    # After clipping, the edges with only one face lie in the near plane. In reverse, they bound the face in that plane.
    edges = {edge for face in faces for edge in sides(face)}
    ahead = {b: a for a, b in edges if (b, a) not in edges}
    groups = [polyhedron.joined[order] for order in orders] if polyhedron.joined else []
    if ahead:
        faces.append(tuple(cycle_of(ahead)))
        groups += [max(groups) + 1] if groups else []
    # Renumber the vertices that remain.
    used = sorted({place for face in faces for place in face})
    names = {place: order for order, place in enumerate(used)}
    vertices = tuple(points[place] for place in used)
    renumbered = tuple(tuple(names[place] for place in face) for face in faces)
    on_faces = ((orders.index(f.face), _cut(f.corners, observer)) for f in polyhedron.figures if f.face in orders)
    figures = tuple(Figure(order, corners) for order, corners in on_faces if corners)
    return replace(polyhedron, vertices=vertices, faces=renumbered, figures=figures, joined=tuple(groups))


def _cut(corners: Sequence[Vector], observer: Observer) -> tuple[Vector, ...]:
    """Clip a polygon at the near plane and close it along the plane (Sutherland and Hodgman, CACM 17 (1974))."""
    depths = [_depth(point, observer) for point in corners]
    clipped_corners = []
    for a, b in sides(range(len(corners))):
        if depths[a] >= 0:
            clipped_corners.append(corners[a])
        if depths[a] * depths[b] < 0:
            clipped_corners.append(_between(corners[a], corners[b], depths[a], depths[b]))
    return tuple(clipped_corners) if max(depths) > 0 else ()


def _between(p: Vector, q: Vector, at_p: Fraction, at_q: Fraction) -> Vector:
    """Return the point between p and q where a linear function with the values ``at_p`` and ``at_q`` is 0."""
    share = at_p / (at_p - at_q)
    x, y, z = (a + share * (b - a) for a, b in zip(p, q, strict=True))
    return x, y, z

"""A polyhedron as it is seen: the paper's second step, to contour and inner edges (section 4, time II)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final, Literal

from modern.drawing import visible
from modern.drawing.visible import Edge, line_through
from modern.geometry.mesh import sides
from modern.geometry.vectors import Vector
from modern.papers.nakamae_nishita.contours import Line
from modern.papers.nakamae_nishita.polyhedron import Polyhedron
from modern.papers.nakamae_nishita.projection import Homogeneous, Observer, project

Plane = tuple[int, int, int, int]
Flat = tuple[int, int, int]
Kind = visible.Kind | Literal["figure"]


@dataclass(frozen=True, slots=True)
class Segment:
    """A line that may be seen: an inner or contour edge, or a side of a figure; its ends by place in the points.

    ``first``, ``last``: the same ends by place in ``Solid.used``.  ``faces``: those beside it that are seen.
    """

    start: int
    end: int
    first: int
    last: int
    kind: Kind
    faces: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Solid:
    """A polyhedron with its images.

    points: those of the vertices, then of the figures' corners.  signs: of each face, 1 seen.  contour: places of
    vertices, clockwise; lines: formula (1) of its segments.  planes: formula (5) of each face, positive outside.
    used: places of all points of segments, those of the contour first.
    """

    number: int
    polyhedron: Polyhedron
    points: tuple[Homogeneous, ...]
    signs: tuple[int, ...]
    edges: tuple[Edge, ...]
    contour: tuple[int, ...]
    lines: tuple[Line, ...]
    planes: tuple[Plane, ...]
    segments: tuple[Segment, ...]
    used: tuple[int, ...]
    images: tuple[Homogeneous, ...]
    """The points of ``used``."""

    @property
    def vertices(self) -> tuple[Homogeneous, ...]:
        """The images of the vertices."""
        return self.points[: len(self.polyhedron.vertices)]


FIGURE: Final = "figure"
_DRAWN = (visible.INNER, visible.CONTOUR)


def solid(number: int, polyhedron: Polyhedron, observer: Observer, origin: Vector) -> Solid:
    """Project a polyhedron and search its faces, edges and contour.  Raises SceneError; see ``project``."""
    points = project(polyhedron, observer, origin)
    flat: list[Flat] = [(x, y, w) for x, y, _, w in points]
    signs = [visible.facing([flat[place] for place in face]) for face in polyhedron.faces]
    planes = [_face_plane([points[place] for place in face]) for face in polyhedron.faces]
    edges = visible.classify(polyhedron.faces, signs, lambda a, b: same_plane(planes[a], planes[b]))
    if polyhedron.joined:
        edges = tuple(_read_as_one(edge, polyhedron.joined) for edge in edges)
    chain = visible.contour(polyhedron.faces, signs)
    found: list[tuple[int, int, Kind, tuple[int, ...]]] = [
        (edge.start, edge.end, edge.kind, _seen(edge.faces, signs)) for edge in edges if edge.kind in _DRAWN
    ]
    corner = len(polyhedron.vertices)
    for figure in polyhedron.figures:
        places = range(corner, corner + len(figure.corners))
        corner += len(figure.corners)
        if signs[figure.face] > 0:
            found += [(a, b, FIGURE, (figure.face,)) for a, b in zip(places, [*places[1:], places[0]], strict=True)]
    used = tuple(dict.fromkeys((*chain, *(place for start, end, *_ in found for place in (start, end)))))
    where = {place: order for order, place in enumerate(used)}
    return Solid(
        number,
        polyhedron,
        tuple(points),
        tuple(signs),
        edges,
        chain,
        tuple(line_through(flat[a], flat[b]) for a, b in (sides(chain) if chain else ())),
        tuple(planes),
        tuple(Segment(a, b, where[a], where[b], kind, seen) for a, b, kind, seen in found),
        used,
        tuple(points[place] for place in used),
    )


def plane_through(p: Homogeneous, q: Homogeneous, r: Homogeneous) -> Plane:
    """The coefficients of formula (5) for three points clockwise from outside; 0,0,0,0 where they lie in a line."""
    # The two-rowed minors of q and r, each used twice.
    xy, xz, xw = q[0] * r[1] - q[1] * r[0], q[0] * r[2] - q[2] * r[0], q[0] * r[3] - q[3] * r[0]
    yz, yw, zw = q[1] * r[2] - q[2] * r[1], q[1] * r[3] - q[3] * r[1], q[2] * r[3] - q[3] * r[2]
    return (
        -(p[1] * zw - p[2] * yw + p[3] * yz),
        p[0] * zw - p[2] * xw + p[3] * xz,
        -(p[0] * yw - p[1] * xw + p[3] * xy),
        p[0] * yz - p[1] * xz + p[2] * xy,
    )


def height(plane: Plane, p: Homogeneous) -> int:
    """Formula (5): positive where the point is on the outer side of the face."""
    return plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + plane[3] * p[3]


def same_plane(u: Plane, v: Plane) -> bool:
    """Whether two planes are one, with one outer side."""
    k = next(k for k in range(4) if u[k])
    return u[k] * v[k] > 0 and all(u[k] * v[n] == v[k] * u[n] for n in range(4))


def _face_plane(corners: Sequence[Homogeneous]) -> Plane:
    for k in range(1, len(corners) - 1):
        plane = plane_through(corners[0], corners[k], corners[k + 1])
        if any(plane):
            return plane
    raise AssertionError("a face of a polyhedron is a polygon")


def _read_as_one(edge: Edge, joined: Sequence[int]) -> Edge:
    """The edge, which is not drawn where its faces are read as one and both are on its side of the contour."""
    first, last = edge.faces[0], edge.faces[-1]
    within = edge.kind in (visible.INNER, visible.BACK) and joined[first] == joined[last]
    return replace(edge, kind=visible.JOINED) if within else edge


def _seen(orders: Sequence[int], signs: Sequence[int]) -> tuple[int, ...]:
    return tuple(order for order in orders if signs[order] > 0)

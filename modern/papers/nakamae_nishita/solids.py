"""Project a polyhedron and classify its faces and edges: the paper's second step (section 4, time II)."""

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
    """A line that may be visible: an edge between front faces, a contour edge, or a side of a figure on a front face.

    ``start`` and ``end`` are the indices of its ends in ``Solid.points``, and ``first`` and ``last`` the indices of the
    same ends in ``Solid.used``. ``faces`` are the indices of the front faces at the line.
    """

    start: int
    end: int
    first: int
    last: int
    kind: Kind
    faces: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Solid:
    """A polyhedron and its projection.

    ``points`` are the images of the vertices and then of the corners of figures. ``signs`` has 1 for each front face,
    -1 for each back face and 0 for each face that is seen edge-on. ``contour`` lists the indices of the contour's
    vertices, clockwise, and ``lines`` has the coefficients of formula (1), a line's equation, for each segment of the
    contour. ``planes`` has for each face the coefficients of formula (5), its plane's equation, whose value is positive
    outside. ``used`` lists the indices of the ends of all segments, beginning with the points of the contour, and
    ``images`` has the projected points with these indices.
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

    @property
    def vertices(self) -> tuple[Homogeneous, ...]:
        return self.points[: len(self.polyhedron.vertices)]


FIGURE: Final = "figure"
_DRAWN = (visible.INNER, visible.CONTOUR)


def solid(number: int, polyhedron: Polyhedron, observer: Observer, origin: Vector) -> Solid:
    """Return a polyhedron's projection, with its faces and edges classified.

    Raise SceneError if a part of the polyhedron is not in front of the eye.
    """
    # Section 3.1: a face is a front face if its image runs clockwise. Its edges are classified by their two faces.
    points = project(polyhedron, observer, origin)
    flat: list[Flat] = [(x, y, w) for x, y, _, w in points]
    signs = [visible.facing([flat[place] for place in face]) for face in polyhedron.faces]
    planes = [_face_plane([points[place] for place in face]) for face in polyhedron.faces]
    edges = visible.classify(polyhedron.faces, signs, lambda a, b: same_plane(planes[a], planes[b]))
    # Edges between merged faces are not drawn, except on the contour.
    if polyhedron.joined:
        edges = tuple(_merged(edge, polyhedron.joined) for edge in edges)
    chain = visible.contour(polyhedron.faces, signs)
    visible_lines: list[tuple[int, int, Kind, tuple[int, ...]]] = [
        (edge.start, edge.end, edge.kind, tuple(face for face in edge.faces if signs[face] > 0))
        for edge in edges
        if edge.kind in _DRAWN
    ]
    # A figure is visible if its face is visible (section 1, merit 4). Its corners follow the vertices in ``points``.
    corner = len(polyhedron.vertices)
    for figure in polyhedron.figures:
        places = range(corner, corner + len(figure.corners))
        corner += len(figure.corners)
        if signs[figure.face] > 0:
            visible_lines += [(a, b, FIGURE, (figure.face,)) for a, b in sides(places)]
    # Formula (1) is evaluated only at the ends of segments. The contour's points come first, for the tables PL and LP.
    used = tuple(dict.fromkeys((*chain, *(place for start, end, *_ in visible_lines for place in (start, end)))))
    where = {place: order for order, place in enumerate(used)}
    lines = tuple(line_through(flat[a], flat[b]) for a, b in (sides(chain) if chain else ()))
    segments = tuple(Segment(a, b, where[a], where[b], kind, front) for a, b, kind, front in visible_lines)
    images = tuple(points[place] for place in used)
    classified = (tuple(signs), edges, chain, lines, tuple(planes))
    return Solid(number, polyhedron, tuple(points), *classified, segments, used, images)


def plane_through(p: Homogeneous, q: Homogeneous, r: Homogeneous) -> Plane:
    """Return the plane of formula (5) through three projected points, clockwise from outside, or zeros if collinear.

    The coefficients are cofactors of a determinant. The rows of the determinant are the homogeneous coordinates of the
    three points and of a variable point. The value of the determinant is the value of the plane's equation at the
    variable point.
    """
    # The 2 x 2 minors of q and r, each of which occurs in two cofactors.
    xy, xz, xw = q[0] * r[1] - q[1] * r[0], q[0] * r[2] - q[2] * r[0], q[0] * r[3] - q[3] * r[0]
    yz, yw, zw = q[1] * r[2] - q[2] * r[1], q[1] * r[3] - q[3] * r[1], q[2] * r[3] - q[3] * r[2]
    return (
        -(p[1] * zw - p[2] * yw + p[3] * yz),
        p[0] * zw - p[2] * xw + p[3] * xz,
        -(p[0] * yw - p[1] * xw + p[3] * xy),
        p[0] * yz - p[1] * xz + p[2] * xy,
    )


def height(plane: Plane, p: Homogeneous) -> int:
    """Return the value of formula (5), which is positive if the point is on the outer side of the plane."""
    return plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + plane[3] * p[3]


def same_plane(u: Plane, v: Plane) -> bool:
    """Return True if two equations describe the same plane with the same outer side."""
    k = next(k for k in range(4) if u[k])
    return u[k] * v[k] > 0 and all(u[k] * v[n] == v[k] * u[n] for n in range(4))


def _face_plane(corners: Sequence[Homogeneous]) -> Plane:
    for k in range(1, len(corners) - 1):
        plane = plane_through(corners[0], corners[k], corners[k + 1])
        if any(plane):
            return plane
    raise AssertionError("a face of a polyhedron is a polygon")


def _merged(edge: Edge, joined: Sequence[int]) -> Edge:
    """Return an edge with the kind ``joined`` if its two faces were merged and it is not on the contour.

    Return any other edge unchanged.
    """
    first, last = edge.faces[0], edge.faces[-1]
    within = edge.kind in (visible.INNER, visible.BACK) and joined[first] == joined[last]
    return replace(edge, kind=visible.JOINED) if within else edge

"""Which of two convex polyhedra is the nearer where their contours overlap (section 3.3, formulas (4) and (5)).

Where polyhedra touch, the paper's two formulas may both give 0.  A plane that separates the two then decides: the
nearer one is on the eye's side of it.  That plane also proves that they do not intersect.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final, Literal

from modern.drawing.visible import FLAT, line_through, sign, value
from modern.papers.nakamae_nishita.contours import Tables, Values
from modern.papers.nakamae_nishita.projection import Homogeneous
from modern.papers.nakamae_nishita.solids import Plane, Solid, height, plane_through

By = Literal["(4)", "(5)", "plane", "undecided"]
"""What decides: formula (4) at a crossing, formula (5) at a face, a separating plane, or nothing."""
BY_CROSSING: Final = "(4)"
BY_FACE: Final = "(5)"
BY_PLANE: Final = "plane"
UNDECIDED: Final = "undecided"


def by_formulas(v: Solid, w: Solid, found: Tables, of_v: Values, of_w: Values) -> tuple[int, By]:
    """1 where V is the nearer, -1 where V' is, 0 where the formulas do not say; and the formula that decided.

    v, w: V and V'.  of_v, of_w: formula (1) of V's segments at the points of V', and the other way round.
    """
    for i, j in found.crossings():
        dr = range_difference(crossing(v, i, of_w[j]), crossing(w, j, of_v[i]))
        if dr:
            return -dr, BY_CROSSING
    for outer, inner, encloses, which in ((v, w, found.encloses, -1), (w, v, found.enclosed, 1)):
        if encloses:
            for place in inner.contour:
                side = sign(height(_enclosing_face(outer, inner.points[place]), inner.points[place]))
                if side:
                    return which * side, BY_FACE
    return 0, UNDECIDED


def crossing(solid: Solid, order: int, values: list[int]) -> Homogeneous:
    """The point of a contour segment whose image is on another line; ``values`` of the line at the solid's points."""
    after = (order + 1) % len(solid.contour)
    p, q = solid.images[order], solid.images[after]
    return between(p, q, values[order], values[after])


def between(p: Homogeneous, q: Homogeneous, at_p: int, at_q: int) -> Homogeneous:
    """The point from p to q where a linear function with these values at p and q, of opposite signs, is 0."""
    m, n = abs(at_q), abs(at_p)
    return m * p[0] + n * q[0], m * p[1] + n * q[1], m * p[2] + n * q[2], m * p[3] + n * q[3]


def range_difference(p: Homogeneous, q: Homogeneous) -> int:
    """The sign of formula (4), dr = (P1 - P0).(P1 - P2), for two points with one image: negative where P1 is nearer.

    The eye P0 is far away on the z axis, so P1 - P0 points along -z.
    """
    return sign(q[2] * p[3] - p[2] * q[3])


def by_plane(v: Solid, w: Solid) -> tuple[int, Plane | None]:
    """1 where V is the nearer, -1 where V' is, by a separating plane, and the plane; None where they intersect.

    0 for two plates in one plane: neither hides the other.  Tried are the faces, then planes through an edge of one
    and a vertex of the other: if any plane separates two convex polyhedra, one of these does.
    """
    for near, other, which in ((v, w, -1), (w, v, 1)):
        for plane in near.planes:
            least, greatest = _range(plane, other.vertices)
            if plane[2] and least >= 0 and (greatest > 0 or not _is_plate(near)):
                return which * sign(plane[2]), plane
    if _is_plate(v) and _is_plate(w) and not any(height(v.planes[0], p) for p in w.vertices):
        return 0, v.planes[0]
    for plane in (*_edge_planes(v, w), *_edge_planes(w, v)):
        (low, high), (least, greatest) = _range(plane, v.vertices), _range(plane, w.vertices)
        if plane[2] and (low >= 0 >= greatest or high <= 0 <= least):
            return (1 if low >= 0 >= greatest else -1) * sign(plane[2]), plane
    return 0, None


def _range(plane: Plane, points: tuple[Homogeneous, ...]) -> tuple[int, int]:
    """The least and the greatest of formula (5)."""
    a, b, c, d = plane
    heights = [a * x + b * y + c * z + d * w for x, y, z, w in points]
    return min(heights), max(heights)


def _edge_planes(v: Solid, w: Solid) -> Iterator[Plane]:
    for edge in v.edges:
        if edge.kind != FLAT:
            for point in w.vertices:
                yield plane_through(v.points[edge.start], v.points[edge.end], point)


def _is_plate(solid: Solid) -> bool:
    return len(solid.planes) == 2


def _enclosing_face(solid: Solid, point: Homogeneous) -> Plane:
    """The plane of a front face whose image holds the point."""
    at = (point[0], point[1], point[3])
    for face, seen, plane in zip(solid.polyhedron.faces, solid.signs, solid.planes, strict=True):
        if seen > 0:
            corners = [(x, y, w) for x, y, _, w in (solid.points[place] for place in face)]
            if all(
                value(line_through(a, b), at) >= 0 for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)
            ):
                return plane
    raise AssertionError("the front faces cover the inside of the contour")

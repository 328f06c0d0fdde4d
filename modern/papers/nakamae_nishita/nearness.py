"""Decide which of two convex polyhedra that overlap in the picture is nearer (section 3.3, formulas (4) and (5)).

If the polyhedra touch, both formulas may give 0. A plane that separates the polyhedra then decides: the nearer
polyhedron is on the eye's side of this plane. Such a plane also proves that the polyhedra do not intersect.
"""

from collections.abc import Iterator
from typing import Final, Literal

from modern.drawing.visible import FLAT, line_through, sign, value
from modern.papers.nakamae_nishita.contours import Tables, Values
from modern.papers.nakamae_nishita.projection import Homogeneous
from modern.papers.nakamae_nishita.solids import Plane, Solid, height, plane_through

# The criterion that decided: formula (4) at a crossing of contours, formula (5) at a face, a separating plane, or none.
By = Literal["(4)", "(5)", "plane", "undecided"]
BY_CROSSING: Final = "(4)"
BY_FACE: Final = "(5)"
BY_PLANE: Final = "plane"
UNDECIDED: Final = "undecided"


def by_formulas(v: Solid, w: Solid, pair: Tables, of_v: Values, of_w: Values) -> tuple[int, By]:
    """Decide by the paper's formulas (4) and (5) which of the polyhedra V (``v``) and V' (``w``) is nearer.

    Return 1 if V is nearer, -1 if V' is nearer or 0 if undecided, and the formula that decided. ``of_v`` has the values
    of formula (1), a line's equation, for the contour segments of V at the points of V', and ``of_w`` has those for the
    contour segments of V' at the points of V.
    """
    # Formula (4): at an intersection of the contours compare the depths of the two points that have it as their image.
    for i, j in pair.crossings():
        # dr = (P1 - P0).(P1 - P2) is negative if P1, on V, is nearer than P2, on V'. The two points have one image, and
        # the eye P0 is at infinity on the z axis, so P1 - P0 points along -z.
        p, q = crossing(v, i, of_w[j]), crossing(w, j, of_v[i])
        dr = sign(q[2] * p[3] - p[2] * q[3])
        if dr:
            return -dr, BY_CROSSING
    # Formula (5): if one contour encloses the other, test a vertex of the inner contour against the face around it.
    for outer, inner, encloses, which in ((v, w, pair.encloses, -1), (w, v, pair.enclosed, 1)):
        if encloses:
            # If a vertex touches the face around it, formula (5) is 0. Another vertex then decides.
            for place in inner.contour:
                side = sign(height(_enclosing_face(outer, inner.points[place]), inner.points[place]))
                if side:
                    return which * side, BY_FACE
    return 0, UNDECIDED


def crossing(solid: Solid, order: int, values: list[int]) -> Homogeneous:
    """Return the point at which a segment of the contour crosses a line in the picture.

    ``values`` has the value of the line's equation, formula (1), at each point of the solid. ``order`` is the index of
    the segment.
    """
    after = (order + 1) % len(solid.contour)
    p, q = solid.images[order], solid.images[after]
    # The values at the two ends have opposite signs. Each end is weighted with the value at the other end.
    m, n = abs(values[after]), abs(values[order])
    return m * p[0] + n * q[0], m * p[1] + n * q[1], m * p[2] + n * q[2], m * p[3] + n * q[3]


def by_plane(v: Solid, w: Solid) -> tuple[int, Plane | None]:
    """Decide by a separating plane which of the polyhedra V and V' is nearer.

    Return 1 for V, -1 for V' or 0 for two plates in one plane, and the separating plane. The plane is None if the
    polyhedra intersect.
    """
    # If any plane separates two convex polyhedra, then the plane of a face does, or a plane through an edge of one
    # and a vertex of the other. Upright planes (plane[2] == 0) do not order the two in depth.
    for owner, opposite, which in ((v, w, -1), (w, v, 1)):
        # The opposite polyhedron must lie on the outer side. If the owner is a plate, a point must also be off the
        # plane.
        for plane in owner.planes:
            least, greatest = _range(plane, opposite.vertices)
            if plane[2] and least >= 0 and (greatest > 0 or len(owner.planes) > 2):
                return which * sign(plane[2]), plane
    if len(v.planes) == len(w.planes) == 2 and not any(height(v.planes[0], p) for p in w.vertices):
        return 0, v.planes[0]
    for plane in (*_edge_planes(v, w), *_edge_planes(w, v)):
        (low, high), (least, greatest) = _range(plane, v.vertices), _range(plane, w.vertices)
        if plane[2] and (low >= 0 >= greatest or high <= 0 <= least):
            return (1 if low >= 0 >= greatest else -1) * sign(plane[2]), plane
    return 0, None


def _range(plane: Plane, points: tuple[Homogeneous, ...]) -> tuple[int, int]:
    a, b, c, d = plane
    heights = [a * x + b * y + c * z + d * w for x, y, z, w in points]
    return min(heights), max(heights)


def _edge_planes(v: Solid, w: Solid) -> Iterator[Plane]:
    for edge in v.edges:
        if edge.kind != FLAT:
            for point in w.vertices:
                yield plane_through(v.points[edge.start], v.points[edge.end], point)


def _enclosing_face(solid: Solid, point: Homogeneous) -> Plane:
    at = (point[0], point[1], point[3])
    for face, facing, plane in zip(solid.polyhedron.faces, solid.signs, solid.planes, strict=True):
        if facing > 0:
            corners = [(x, y, w) for x, y, _, w in (solid.points[place] for place in face)]
            # A front face runs clockwise in the image, so its inside is on the right of every side.
            if all(value(line_through(corners[k - 1], corners[k]), at) >= 0 for k in range(len(corners))):
                return plane
    raise AssertionError("expected a front face at an inner point of the contour")

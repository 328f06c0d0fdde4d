"""Decide which faces and edges of a solid are visible, and find its contour (Nakamae and Nishita 1972, section 3.1).

Images are homogeneous, (x, y, w) for the point (x/w, y/w) with w > 0, y upward. Faces list the indices of their
vertices, clockwise as seen from outside, as in the paper (section 2). All numbers are integers or fractions.
"""

from collections import defaultdict
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Final, Literal, TypeVar

from modern.geometry.mesh import cycle_of, sides

N = TypeVar("N", int, Fraction)

# The kinds of edges.
#
# inner: both faces are visible. contour: one face is visible. outline: one face is edge-on and no face is visible, so
# that the edge lies behind the contour in the image. back: both faces are turned away from the eye. flat: both faces
# lie in one plane, so that the edge is none of the solid's edges. joined: both faces were merged into one face, and
# both are visible or both are turned away, so that the edge is not drawn.
Kind = Literal["inner", "contour", "outline", "back", "flat", "joined"]
INNER: Final = "inner"
CONTOUR: Final = "contour"
OUTLINE: Final = "outline"
BACK: Final = "back"
FLAT: Final = "flat"
JOINED: Final = "joined"


@dataclass(frozen=True, slots=True)
class Edge:
    """An edge: the indices of its two vertices, the smaller one first, its kind, and the indices of its faces."""

    start: int
    end: int
    kind: Kind
    faces: tuple[int, ...]


def line_through(a: tuple[N, N, N], b: tuple[N, N, N]) -> tuple[N, N, N]:
    """Return the coefficients a, b, c of formula (1), the equation of the line from one projected point to another."""
    return a[2] * b[1] - a[1] * b[2], a[0] * b[2] - a[2] * b[0], a[1] * b[0] - a[0] * b[1]


def value(line: tuple[N, N, N], point: tuple[N, N, N]) -> N:
    """Return the value of a line's equation, formula (1), at a point. It is positive to the right of the line."""
    return line[0] * point[0] + line[1] * point[1] + line[2] * point[2]


def sign(number: int | Fraction) -> int:
    return (number > 0) - (number < 0)


def facing(corners: Sequence[tuple[N, N, N]]) -> int:
    """Return 1 if a face is visible, -1 if it is turned away from the eye, 0 if it is edge-on.

    ``corners`` are the projected corners, clockwise as seen from outside. The paper evaluates formula (1) for one
    triangle of the face, which gives 0 if the triangle's corners are collinear. This function divides the face into
    triangles and adds their values, which all have the same sign or are 0.
    """
    first = corners[0]
    return sign(sum(value(line_through(first, corners[k]), corners[k + 1]) for k in range(1, len(corners) - 1)))


def classify(
    faces: Sequence[tuple[int, ...]], signs: Sequence[int], flat: Callable[[int, int], bool]
) -> tuple[Edge, ...]:
    """Return every edge of a solid once, sorted, with its kind (see ``Kind``).

    ``signs`` has the result of ``facing`` for each face: 1 if it is visible, -1 if it is turned away, 0 if edge-on. The
    function ``flat`` receives the indices of two faces and returns True if they are coplanar.
    """
    edge_faces: dict[tuple[int, int], list[int]] = defaultdict(list)
    for face_index, face in enumerate(faces):
        for a, b in sides(face):
            edge_faces[min(a, b), max(a, b)].append(face_index)
    return tuple(
        Edge(a, b, _kind(face_indices, signs, flat), tuple(face_indices))
        for (a, b), face_indices in sorted(edge_faces.items())
    )


def contour(faces: Sequence[tuple[int, ...]], signs: Sequence[int]) -> tuple[int, ...]:
    """Return the contour of a solid in the picture as a chain of vertex indices, clockwise.

    The contour consists of the sides of visible faces that have no visible face on the other side. A plate (a solid
    without thickness) that is seen edge-on has an empty contour.
    """
    directed = {(a, b) for face, sign in zip(faces, signs, strict=True) if sign > 0 for a, b in sides(face)}
    successor = {a: b for a, b in directed if (b, a) not in directed}
    return tuple(cycle_of(successor)) if successor else ()


def _kind(face_indices: Sequence[int], signs: Sequence[int], flat: Callable[[int, int], bool]) -> Kind:
    if len(face_indices) == 2 and flat(face_indices[0], face_indices[1]):
        return FLAT
    visible_faces = sum(signs[index] > 0 for index in face_indices)
    if visible_faces:
        return INNER if visible_faces > 1 else CONTOUR
    return BACK if all(signs[index] < 0 for index in face_indices) else OUTLINE

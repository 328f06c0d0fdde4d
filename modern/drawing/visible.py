"""Faces seen and turned away, inner and contour edges, and the contour line (Nakamae and Nishita 1972, section 3.1).

Images are homogeneous, (x, y, w) for the point (x/w, y/w) with w > 0, y upward.  Faces are named by the places of
their vertices, clockwise seen from outside, as the paper has them (section 2); all numbers are integers or fractions.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Final, Literal, TypeVar

from modern.geometry.mesh import sides

N = TypeVar("N", int, Fraction)

Kind = Literal["inner", "contour", "outline", "back", "flat", "joined"]
"""What an edge is: of two faces seen; of one seen; of none seen but one edge-on, behind the contour in the image; of
two turned away; of two in one plane, which is no edge of the solid; of two read as one, both seen or both turned away,
which is an edge and is not drawn."""
INNER: Final = "inner"
CONTOUR: Final = "contour"
OUTLINE: Final = "outline"
BACK: Final = "back"
FLAT: Final = "flat"
JOINED: Final = "joined"


@dataclass(frozen=True, slots=True)
class Edge:
    """An edge between two vertices, the smaller place first, what it is, and its faces by place."""

    start: int
    end: int
    kind: Kind
    faces: tuple[int, ...]


def line_through(a: tuple[N, N, N], b: tuple[N, N, N]) -> tuple[N, N, N]:
    """The coefficients a, b, c of formula (1) for the segment from one image to another."""
    return a[2] * b[1] - a[1] * b[2], a[0] * b[2] - a[2] * b[0], a[1] * b[0] - a[0] * b[1]


def value(line: tuple[N, N, N], point: tuple[N, N, N]) -> N:
    """Formula (1): positive where the point is on the right of the segment."""
    return line[0] * point[0] + line[1] * point[1] + line[2] * point[2]


def sign(number: int | Fraction) -> int:
    """-1, 0 or 1."""
    return (number > 0) - (number < 0)


def facing(corners: Sequence[tuple[N, N, N]]) -> int:
    """1 where a face with these images, clockwise from outside, is seen; -1 where it turns away, 0 where it is edge-on.

    The sum of formula (1) over the triangles from the first corner.  The face is convex, so no two terms differ in
    sign; the paper takes the first term alone, which is 0 where three corners lie in a line.
    """
    first = corners[0]
    return sign(sum(value(line_through(first, corners[k]), corners[k + 1]) for k in range(1, len(corners) - 1)))


def classify(
    faces: Sequence[tuple[int, ...]], signs: Sequence[int], flat: Callable[[int, int], bool]
) -> tuple[Edge, ...]:
    """Every edge once, sorted.

    signs: of each face, from :func:`facing`.  flat: whether two faces lie in one plane.
    """
    beside: dict[tuple[int, int], list[int]] = defaultdict(list)
    for order, face in enumerate(faces):
        for a, b in sides(face):
            beside[min(a, b), max(a, b)].append(order)
    return tuple(Edge(a, b, _kind(orders, signs, flat), tuple(orders)) for (a, b), orders in sorted(beside.items()))


def contour(faces: Sequence[tuple[int, ...]], signs: Sequence[int]) -> tuple[int, ...]:
    """The contour line as a chain of vertices, clockwise in the image, from its smallest place on.

    A front face runs clockwise in the image, and so does its side without another front face beyond.  Empty where no
    face is seen: of a plate that is edge-on.
    """
    directed = {(a, b) for face, seen in zip(faces, signs, strict=True) if seen > 0 for a, b in sides(face)}
    ahead = {a: b for a, b in directed if (b, a) not in directed}
    if not ahead:
        return ()
    chain = [min(ahead)]
    while ahead[chain[-1]] != chain[0]:
        chain.append(ahead[chain[-1]])
    return tuple(chain)


def _kind(orders: Sequence[int], signs: Sequence[int], flat: Callable[[int, int], bool]) -> Kind:
    if len(orders) == 2 and flat(orders[0], orders[1]):
        return FLAT
    seen = sum(signs[order] > 0 for order in orders)
    if seen:
        return INNER if seen > 1 else CONTOUR
    return BACK if all(signs[order] < 0 for order in orders) else OUTLINE

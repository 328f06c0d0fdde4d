"""Inside corners: points that cannot be vertices of the hull, found before any projection (Figs. 15, 16 and 18)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, get_args

from modern.geometry.vectors import cross, dot, lowest, minus
from modern.papers.appel_will.edges import IntPoint
from modern.papers.appel_will.surfaces import Line, Surface, area_normal, lines, oriented

Rule = Literal["any", "two", "concave"]
RULES: tuple[Rule, ...] = get_args(Rule)
PLANES = 3
"""A well behaved object has points with no more than three intersecting planes."""


@dataclass(frozen=True, slots=True)
class Corner:
    """A line with the scalar triple product [IKL] of its direction and the normals of its two surfaces (Fig. 18).

    All three vectors are in lowest terms, the normals point into the solid: of an inside corner the product is
    negative, of an outside one positive, and 0 where both surfaces are in one plane.
    """

    line: Line
    product: int


@dataclass(frozen=True, slots=True)
class Preprocessing:
    """What was deleted before the projections, and by which rule."""

    rule: Rule
    inside: tuple[Corner, ...]
    deleted: tuple[int, ...]
    crowded: tuple[int, ...]
    """Points on more than three planes: if there are any, the object is not well behaved."""


def triple_product(i: IntPoint, k: IntPoint, l: IntPoint) -> int:  # noqa: E741  # the paper's letters
    """[IKL]: the determinant with the columns I, K and L."""
    return dot(i, cross(k, l))


def corners(points: Sequence[IntPoint], surfaces: Sequence[Surface]) -> tuple[Corner, ...]:
    """The triple product of every line of oriented surfaces."""
    return tuple(Corner(line, triple_product(*vectors(points, surfaces, line))) for line in lines(surfaces))


def vectors(points: Sequence[IntPoint], surfaces: Sequence[Surface], line: Line) -> tuple[IntPoint, IntPoint, IntPoint]:
    """I, K and L of a line: its direction and the inward normals of its surfaces, each in lowest terms."""
    direction = lowest(minus(points[line.ends[1]], points[line.ends[0]]))
    return direction, _inward(points, surfaces[line.on]), _inward(points, surfaces[line.beyond])


def preprocess(points: Sequence[IntPoint], surfaces: Sequence[Surface], rule: Rule) -> Preprocessing:
    """Choose the points to delete.

    ``rule`` is one of RULES.  ``any``: every point on an inside corner, which is right for well behaved objects only
    (Fig. 15).  ``two``: a point on two inside corners and at most one outside corner (Fig. 16, 1), which is right for
    every object, as a vertex of the hull is on three outside corners at least.  ``concave``: a point on an inside
    corner that is a concave point of a surface (Fig. 16, 2), right for every object too, as a surface's angle at a
    vertex of the hull is below 180 degrees.  Raises MapError where the surfaces are no closed polyhedron.
    """
    turned = oriented(points, surfaces)
    found = corners(points, turned)
    inside = tuple(corner for corner in found if corner.product < 0)
    at_inside = Counter(end for corner in inside for end in corner.line.ends)
    at_outside = Counter(end for corner in found if corner.product > 0 for end in corner.line.ends)
    if rule == "any":
        deleted = set(at_inside)
    elif rule == "two":
        deleted = {point for point, count in at_inside.items() if count >= 2 and at_outside[point] <= 1}
    elif rule == "concave":
        deleted = set(at_inside).intersection(_concave(points, turned))
    else:
        raise ValueError(f"{rule!r} is not a rule; they are {', '.join(RULES)}")
    return Preprocessing(rule, inside, tuple(sorted(deleted)), _crowded(points, turned))


def _crowded(points: Sequence[IntPoint], surfaces: Sequence[Surface]) -> tuple[int, ...]:
    """The points on surfaces of more than three planes."""
    planes: dict[int, set[tuple[int, ...]]] = {}
    for surface in surfaces:
        normal = lowest(area_normal(points, surface))
        plane = max(normal, (-normal[0], -normal[1], -normal[2]))
        for index in surface:
            planes.setdefault(index, set()).add((*plane, dot(plane, points[surface[0]])))
    return tuple(sorted(index for index, found in planes.items() if len(found) > PLANES))


def _concave(points: Sequence[IntPoint], surfaces: Sequence[Surface]) -> set[int]:
    """Points where the angle of a surface is above 180 degrees."""
    found = set()
    for surface in surfaces:
        normal = area_normal(points, surface)
        for before, here, after in zip((surface[-1], *surface[:-1]), surface, (*surface[1:], surface[0]), strict=True):
            turn = cross(minus(points[here], points[before]), minus(points[after], points[here]))
            if dot(turn, normal) < 0:
                found.add(here)
    return found


def _inward(points: Sequence[IntPoint], surface: Surface) -> IntPoint:
    x, y, z = lowest(area_normal(points, surface))
    return -x, -y, -z

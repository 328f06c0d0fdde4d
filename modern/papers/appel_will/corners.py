"""Find points that cannot be vertices of the hull because an edge at them is reentrant (Figs. 15, 16 and 18)."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, get_args

from emulator.errors import quoted
from modern.geometry.vectors import area_vector, cross, dot, lowest, minus
from modern.papers.appel_will.star import IntPoint
from modern.papers.appel_will.surfaces import Line, Surface, lines, oriented

Rule = Literal["any", "two", "concave"]
RULES: tuple[Rule, ...] = get_args(Rule)
# At most this number of planes meet at each point of an object that the paper calls well behaved.
PLANES = 3


@dataclass(frozen=True, slots=True)
class Corner:
    """An edge of the polyhedron, and a number whose sign distinguishes reentrant from convex edges (Fig. 18).

    The number is the triple product [IKL] of the edge's direction I and the normals K and L of its two surfaces. All
    three vectors are in lowest terms, and the normals point into the solid. The product is negative for an inside
    corner (a reentrant edge), positive for an outside corner, and 0 if both surfaces lie in one plane.
    """

    line: Line
    product: int


@dataclass(frozen=True, slots=True)
class Preprocessing:
    """The points that a rule deleted before the projections, and all inside corners (reentrant edges)."""

    rule: Rule
    inside: tuple[Corner, ...]
    deleted: tuple[int, ...]
    # The points on more than three planes. If there is such a point, the object is not well behaved.
    crowded: tuple[int, ...]


def triple_product(i: IntPoint, k: IntPoint, l: IntPoint) -> int:  # noqa: E741  # the paper's letters
    """Return the triple product of three vectors ([IKL] in the paper), the determinant whose columns they are."""
    return dot(i, cross(k, l))


def corners(points: Sequence[IntPoint], surfaces: Sequence[Surface]) -> tuple[Corner, ...]:
    """Compute, for every edge of the polyhedron, the triple product whose sign tells if the edge is reentrant."""
    return tuple(Corner(line, triple_product(*vectors(points, surfaces, line))) for line in lines(surfaces))


def vectors(points: Sequence[IntPoint], surfaces: Sequence[Surface], line: Line) -> tuple[IntPoint, IntPoint, IntPoint]:
    """Return the direction of an edge and the inward normals of its two surfaces, each in lowest terms."""
    direction = lowest(minus(points[line.ends[1]], points[line.ends[0]]))
    return direction, _inward(points, surfaces[line.on]), _inward(points, surfaces[line.beyond])


def preprocess(points: Sequence[IntPoint], surfaces: Sequence[Surface], rule: Rule) -> Preprocessing:
    """Return the points to delete before the projections, chosen by a rule.

    An inside corner is a reentrant edge of the polyhedron, an outside corner an edge at which the polyhedron is convex.
    ``any`` deletes each point on at least one inside corner. This rule is correct only for objects that the paper calls
    well behaved (Fig. 15), which have at most three planes at each point. ``two`` deletes each point on at least two
    inside corners and at most one outside corner (Fig. 16, 1). This rule is correct for every object, because a vertex
    of the hull is on at least three outside corners. ``concave`` deletes each point that is on an inside corner and is
    also a concave point of a surface (Fig. 16, 2). This rule too is correct for every object, because the angle of a
    surface at a vertex of the hull is less than 180 degrees.

    Raise MapError if the surfaces do not form a closed polyhedron, and ValueError for an unknown rule.
    """
    # Fig. 18: the sign of [IKL] classifies a line only if the surfaces are oriented.
    surfaces_outward = oriented(points, surfaces)
    classified = corners(points, surfaces_outward)
    inside = tuple(corner for corner in classified if corner.product < 0)
    at_inside = Counter(end for corner in inside for end in corner.line.ends)
    at_outside = Counter(end for corner in classified if corner.product > 0 for end in corner.line.ends)
    if rule == "any":
        deleted = set(at_inside)
    elif rule == "two":
        deleted = {point for point, count in at_inside.items() if count >= 2 and at_outside[point] <= 1}
    elif rule == "concave":
        deleted = set(at_inside).intersection(_concave(points, surfaces_outward))
    else:
        raise ValueError(f"{quoted(rule)} is not a rule for inside corners; the rules are {', '.join(RULES)}")
    return Preprocessing(rule, inside, tuple(sorted(deleted)), _crowded(points, surfaces_outward))


def _crowded(points: Sequence[IntPoint], surfaces: Sequence[Surface]) -> tuple[int, ...]:
    planes_at: dict[int, set[tuple[int, ...]]] = {}
    for surface in surfaces:
        normal = lowest(area_vector(points, surface))
        # The greater of two opposite normals is the key, so that surfaces on both sides of a plane share it.
        key = max(normal, (-normal[0], -normal[1], -normal[2]))
        for index in surface:
            planes_at.setdefault(index, set()).add((*key, dot(key, points[surface[0]])))
    return tuple(sorted(index for index, planes in planes_at.items() if len(planes) > PLANES))


def _concave(points: Sequence[IntPoint], surfaces: Sequence[Surface]) -> set[int]:
    concave = set()
    for surface in surfaces:
        normal = area_vector(points, surface)
        for before, here, after in zip((surface[-1], *surface[:-1]), surface, (*surface[1:], surface[0]), strict=True):
            # The surface runs counterclockwise about its normal, so a clockwise turn is a reentrant angle.
            turn = cross(minus(points[here], points[before]), minus(points[after], points[here]))
            if dot(turn, normal) < 0:
                concave.add(here)
    return concave


def _inward(points: Sequence[IntPoint], surface: Surface) -> IntPoint:
    return lowest(area_vector(points, surface[::-1]))

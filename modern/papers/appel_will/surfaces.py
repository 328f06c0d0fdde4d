"""Surfaces of a polyhedron given with its points (Fig. 4): their sense, their normals, what becomes of them."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Sequence
from dataclasses import dataclass

from emulator.errors import EmulatorError
from modern.geometry.mesh import sides
from modern.geometry.vectors import area_vector, cross, dot, minus
from modern.papers.appel_will.edges import IntPoint, Pair

Surface = tuple[int, ...]
"""The points of a surface in the order they are connected, by index from 0."""


class MapError(EmulatorError):
    """A topological map that describes no polyhedron; the message names the surface, from 1, and its points."""


@dataclass(frozen=True, slots=True)
class Line:
    """A line of the polyhedron: ``ends`` as it runs counterclockwise on surface ``on``; ``beyond`` the other one."""

    ends: Pair
    on: int
    beyond: int


@dataclass(frozen=True, slots=True)
class Fates:
    """What becomes of the given surfaces on the hull (Fig. 4).

    ``of`` has for every given surface the number of the hull's surface in whose plane it lies, from 0, or None where
    it is to be deleted; ``kept`` those that are all of that surface; ``added`` the hull's surfaces without a given one.
    """

    of: tuple[int | None, ...]
    kept: frozenset[int]
    added: tuple[int, ...]


def fates(points: Sequence[IntPoint], given: Sequence[Surface], hull: Sequence[Surface]) -> Fates:
    """Compare the surfaces of a polyhedron with those of its hull."""
    of: list[int | None] = []
    for surface in given:
        of.append(next((number for number, other in enumerate(hull) if _lies_in(points, surface, other)), None))
    kept = {k for k, number in enumerate(of) if number is not None and set(given[k]) == set(hull[number])}
    return Fates(tuple(of), frozenset(kept), tuple(number for number in range(len(hull)) if number not in of))


def fates_by_points(given: Sequence[Surface], faces: Sequence[Collection[int]], hull: Sequence[Surface]) -> Fates:
    """Compare them where faces of the hull were joined: a surface lies in the joined face that has all of its points.

    faces: all points of each joined face; hull: those of its polygon.
    """
    of = [
        next((number for number, points in enumerate(faces) if set(points) >= set(surface)), None) for surface in given
    ]
    kept = {k for k, number in enumerate(of) if number is not None and set(given[k]) == set(hull[number])}
    return Fates(tuple(of), frozenset(kept), tuple(number for number in range(len(hull)) if number not in of))


def area_normal(points: Sequence[IntPoint], surface: Surface) -> IntPoint:
    """Twice the area of a plane surface along its normal, to the side from which its points run counterclockwise.

    The paper takes the cross product of two of its lines, which has the wrong sense at a concave point.
    """
    return area_vector(points, surface)


def check_surfaces(count: int, surfaces: Sequence[Surface]) -> None:
    """Refuse surfaces of fewer than three points, with a point twice or of none of the ``count`` points.

    Raises MapError.
    """
    for number, surface in enumerate(surfaces, 1):
        if len(surface) < 3:
            raise MapError(f"surface {number}: {len(surface)} points; a surface has at least three")
        if len(set(surface)) < len(surface):
            raise MapError(f"surface {number}: a point stands in it twice")
        if not 0 <= min(surface) <= max(surface) < count:
            raise MapError(f"surface {number}: it names a point that is not there")


def oriented(points: Sequence[IntPoint], surfaces: Sequence[Surface]) -> tuple[Surface, ...]:
    """The surfaces with their points counterclockwise seen from outside, each from its own first point.

    The map must be one closed surface: every line on two surfaces, all connected, every surface plane.  Its two
    sides are told apart by the sign of the volume.  Raises MapError.
    """
    check_surfaces(len(points), surfaces)
    beside: defaultdict[frozenset[int], list[int]] = defaultdict(list)
    for number, surface in enumerate(surfaces):
        normal = area_normal(points, surface)
        if not any(normal):
            raise MapError(f"surface {number + 1}: it has no area")
        if any(dot(normal, minus(points[index], points[surface[0]])) for index in surface):
            raise MapError(f"surface {number + 1}: its points do not lie in one plane")
        for line in sides(surface):
            beside[frozenset(line)].append(number)
    for ends, numbers in beside.items():
        if len(numbers) != 2:
            named = "-".join(str(end + 1) for end in sorted(ends))
            count = f"{len(numbers)} surface{'s' if len(numbers) > 1 else ''}"
            raise MapError(f"surface {numbers[0] + 1}: line {named} is on {count}; a line is on two")
    turned = _one_sense(surfaces, beside)
    # six times the volume: cones from the origin over the surfaces
    volume = sum(dot(area_normal(points, surface), points[surface[0]]) for surface in turned)
    if not volume:
        raise MapError("the surfaces enclose no volume")
    return tuple(turned) if volume > 0 else tuple((s[0], *s[:0:-1]) for s in turned)


def lines(surfaces: Sequence[Surface]) -> tuple[Line, ...]:
    """Every line of oriented surfaces once, with the surfaces on both sides of it, by its surface of lower number."""
    owner = {line: number for number, surface in enumerate(surfaces) for line in sides(surface)}
    return tuple(
        Line(line, number, owner[line[1], line[0]])
        for line, number in owner.items()
        if number < owner[line[1], line[0]]
    )


def _one_sense(surfaces: Sequence[Surface], beside: dict[frozenset[int], list[int]]) -> list[Surface]:
    """The surfaces so turned that two beside each other run along their line in opposite directions."""
    turned: dict[int, Surface] = {0: surfaces[0]}
    waiting = [0]
    for number in waiting:
        for start, end in sides(turned[number]):
            for other in beside[frozenset((start, end))]:
                if other == number:
                    continue
                surface = surfaces[other]
                if (start, end) in sides(turned.get(other, surface)):
                    if other in turned:
                        raise MapError(f"surface {other + 1}: the surfaces have no outside, like a Moebius strip")
                    surface = (surface[0], *surface[:0:-1])
                if other not in turned:
                    turned[other] = surface
                    waiting.append(other)
    if len(turned) < len(surfaces):
        alone = next(number for number in range(len(surfaces)) if number not in turned)
        raise MapError(f"surface {alone + 1}: it is not connected with surface 1")
    return [turned[number] for number in range(len(surfaces))]


def _lies_in(points: Sequence[IntPoint], surface: Surface, other: Surface) -> bool:
    """Whether all points of a surface are in the plane of another, whose points are a convex polygon."""
    origin = points[other[0]]
    normal = cross(minus(points[other[1]], origin), minus(points[other[2]], origin))
    return not any(dot(normal, minus(points[index], origin)) for index in surface)

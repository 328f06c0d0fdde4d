"""The surfaces of the given polyhedron (Fig. 4): orientation, normals, and what becomes of them on the hull."""

from collections import defaultdict
from collections.abc import Collection, Sequence
from dataclasses import dataclass

from emulator.errors import EmulatorError
from modern.geometry.mesh import sides
from modern.geometry.vectors import area_vector, dot, minus
from modern.papers.appel_will.star import IntPoint, Pair

# The indices of a surface's points, from 0, in the order in which they are connected.
Surface = tuple[int, ...]


class MapError(EmulatorError):
    """Raised if the surfaces do not describe a polyhedron. The message names the surface."""


@dataclass(frozen=True, slots=True)
class Line:
    """An edge of the polyhedron, in the direction that is counterclockwise on the surface ``on``.

    On its other surface, ``beyond``, the same direction is clockwise.
    """

    ends: Pair
    on: int
    beyond: int


@dataclass(frozen=True, slots=True)
class Fates:
    """What becomes of each surface of the given polyhedron on the hull (Fig. 4). Surfaces are numbered from 0.

    ``of`` has, for every given surface, the number of the hull's surface in whose plane it lies, or None if the given
    surface is deleted. ``unchanged`` has the numbers of the given surfaces that are surfaces of the hull too. ``added``
    has the numbers of the hull's surfaces in whose plane no given surface lies.
    """

    of: tuple[int | None, ...]
    unchanged: frozenset[int]
    added: tuple[int, ...]


def fates_by_points(original: Sequence[Surface], faces: Sequence[Collection[int]], hull: Sequence[Surface]) -> Fates:
    """Return what becomes of the given surfaces on a hull, some of whose faces may have been merged.

    For each face of the hull, ``faces`` holds all points that count as lying in the face, and ``hull`` holds its
    corners in order. A given surface lies in the face that contains all of the surface's points.
    """
    numbers = range(len(hull))
    of = tuple(next((number for number in numbers if set(faces[number]) >= set(s)), None) for s in original)
    unchanged = (k for k, number in enumerate(of) if number is not None and set(original[k]) == set(hull[number]))
    return Fates(of, frozenset(unchanged), tuple(number for number in numbers if number not in of))


def check_surfaces(count: int, surfaces: Sequence[Surface]) -> None:
    """Raise MapError for a surface with fewer than three points, a repeated point or an index beyond ``count``."""
    for number, surface in enumerate(surfaces, 1):
        if len(surface) < 3:
            raise MapError(f"surface {number}: expected at least 3 points, found {len(surface)}")
        if len(set(surface)) < len(surface):
            raise MapError(f"surface {number}: it contains a point twice")
        if not 0 <= min(surface) <= max(surface) < count:
            raise MapError(f"surface {number}: it names a point that does not exist")


def oriented(points: Sequence[IntPoint], surfaces: Sequence[Surface]) -> tuple[Surface, ...]:
    """Return the surfaces with their points counterclockwise as seen from outside.

    The first point of each surface remains its first point. Raise MapError unless the surfaces form one closed
    polyhedron: every surface is plane, every line is on two surfaces, all surfaces are connected, and they enclose a
    volume. The sign of the volume distinguishes inside from outside.
    """
    check_surfaces(len(points), surfaces)
    surfaces_at: defaultdict[frozenset[int], list[int]] = defaultdict(list)
    for number, surface in enumerate(surfaces):
        # The paper uses the cross product of two lines as the normal, which has the wrong sense at a concave point.
        normal = area_vector(points, surface)
        if not any(normal):
            raise MapError(f"surface {number + 1}: it has no area")
        if any(dot(normal, minus(points[index], points[surface[0]])) for index in surface):
            raise MapError(f"surface {number + 1}: its points do not lie in one plane")
        for line in sides(surface):
            surfaces_at[frozenset(line)].append(number)
    for ends, numbers in surfaces_at.items():
        if len(numbers) != 2:
            line_name = "-".join(str(end + 1) for end in sorted(ends))
            count = f"{len(numbers)} surface{'s' if len(numbers) > 1 else ''}"
            raise MapError(f"surface {numbers[0] + 1}: line {line_name} lies on {count}, expected 2 surfaces")
    consistent = _one_sense(surfaces, surfaces_at)
    # Six times the signed volume is the sum over the cones from the origin to the surfaces.
    volume = sum(dot(area_vector(points, surface), points[surface[0]]) for surface in consistent)
    if not volume:
        raise MapError("the surfaces enclose no volume")
    return tuple(consistent) if volume > 0 else tuple((s[0], *s[:0:-1]) for s in consistent)


def lines(surfaces: Sequence[Surface]) -> tuple[Line, ...]:
    """Return every line of the polyhedron once, in its direction on the surface with the lower number."""
    owner = {line: number for number, surface in enumerate(surfaces) for line in sides(surface)}
    both_sides = ((line, number, owner[line[1], line[0]]) for line, number in owner.items())
    return tuple(Line(line, on, beyond) for line, on, beyond in both_sides if on < beyond)


def _one_sense(surfaces: Sequence[Surface], surfaces_at: dict[frozenset[int], list[int]]) -> list[Surface]:
    """Return the surfaces, some of them reversed, so that any two neighbours run along their common line in opposite
    directions.
    """
    oriented_so_far: dict[int, Surface] = {0: surfaces[0]}
    queue = [0]
    # Breadth-first search over neighbouring surfaces, starting with surface 1 as it is given.
    for number in queue:
        for start, end in sides(oriented_so_far[number]):
            for neighbour in surfaces_at[frozenset((start, end))]:
                if neighbour == number:
                    continue
                surface = surfaces[neighbour]
                if (start, end) in sides(oriented_so_far.get(neighbour, surface)):
                    if neighbour in oriented_so_far:
                        raise MapError(f"surface {neighbour + 1}: the surfaces have no outside, like a Moebius strip")
                    surface = (surface[0], *surface[:0:-1])
                if neighbour not in oriented_so_far:
                    oriented_so_far[neighbour] = surface
                    queue.append(neighbour)
    if len(oriented_so_far) < len(surfaces):
        isolated = next(number for number in range(len(surfaces)) if number not in oriented_so_far)
        raise MapError(f"surface {isolated + 1}: it is not connected with surface 1")
    return [oriented_so_far[number] for number in range(len(surfaces))]

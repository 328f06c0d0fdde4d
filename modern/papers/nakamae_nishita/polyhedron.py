"""Convex polyhedra in the paper's form (section 2): vertices, and faces as vertex numbers, clockwise from outside.

A plate is a polyhedron without thickness: one polygon as two faces, one for each side.
"""

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from emulator.errors import EmulatorError
from modern.geometry.mesh import sides
from modern.geometry.vectors import N, Vector, area_vector, cross, dot, lowest, minus, six_volumes, whole


class SceneError(EmulatorError):
    """Raised if a scene cannot be drawn because a file, a shape or the arrangement is invalid."""


@dataclass(frozen=True, slots=True)
class Figure:
    """A closed figure drawn on a face: its corners in space, and the index of the face (section 1 of the paper)."""

    face: int
    corners: tuple[Vector, ...]


@dataclass(frozen=True, slots=True)
class Polyhedron:
    """A convex polyhedron.

    ``thing`` names the object of which the polyhedron is a part. Lines that only divide a face of an object are not
    drawn. ``joined`` has a group number for each face, or is empty. No edge is drawn between faces of one group
    (``modern.geometry.coplanar``).
    """

    name: str
    vertices: tuple[Vector, ...]
    faces: tuple[tuple[int, ...], ...]
    thing: str = ""
    figures: tuple[Figure, ...] = ()
    joined: tuple[int, ...] = ()


def outward(polyhedron: Polyhedron, face: tuple[int, ...]) -> Vector:
    """Return the outward normal of a face, whose length is twice the area of the face."""
    return area_vector(polyhedron.vertices, face[::-1])


def checked(polyhedron: Polyhedron) -> Polyhedron:
    """Prove that a polyhedron is closed and convex, and return it with its faces clockwise as seen from outside.

    Raise SceneError if it is not closed or not convex. The message names the polyhedron and the invalid face or edge.
    """
    name, points, faces = polyhedron.name, polyhedron.vertices, polyhedron.faces
    if not faces:
        raise SceneError(f"{name}: expected faces, found none")
    gaps = open_faults(dict(enumerate(faces)), dict(enumerate(points)), lambda a, b: f"{a + 1} and {b + 1}")
    for gap in gaps:
        raise SceneError(f"{name}: {gap}")
    reversed_faces = replace(polyhedron, faces=tuple(face[::-1] for face in faces))
    faults = [next(_faults(candidate), "") for candidate in (polyhedron, reversed_faces)]
    if not faults[0]:
        return polyhedron
    if not faults[1]:
        return reversed_faces
    # Report the fault for the direction in which most faces run: a negative volume means clockwise.
    raise SceneError(f"{name}: {faults[0] if six_volumes(points, faces) <= 0 else faults[1]}")


def open_faults(
    faces: Mapping[int, Sequence[int]], points: Mapping[int, Vector], edge_name: Callable[[int, int], str]
) -> Iterator[str]:
    """Yield the reasons why faces do not form a closed surface. Messages count faces and points from 1."""
    # In a closed surface every edge belongs to two faces, which follow it in opposite directions.
    directed: Counter[tuple[int, int]] = Counter()
    for order, face in faces.items():
        if len(face) < 3 or len(set(face)) < len(face):
            yield f"face {order + 1} does not have at least three different vertices"
        directed.update(sides(face))
    for (a, b), times in sorted(directed.items()):
        if times > 1:
            yield f"two faces run in the same direction along the edge of vertices {edge_name(a, b)}"
        if not directed[b, a]:
            yield f"not closed: only one face at the edge of vertices {edge_name(a, b)}"
    used = {place for edge in directed for place in edge}
    first: dict[Vector, int] = {}
    for place, point in points.items():
        if place not in used:
            yield f"vertex {place + 1} belongs to no face"
        if first.setdefault(point, place) != place:
            yield f"vertices {first[point] + 1} and {place + 1} are the same point"


def _faults(polyhedron: Polyhedron) -> Iterator[str]:
    """Yield the reasons why a closed surface is not a convex solid or plate with faces clockwise from outside."""
    points, faces = polyhedron.vertices, polyhedron.faces
    _, integers = whole(points)
    flat = True
    for order, face in enumerate(faces, 1):
        normal = outward(polyhedron, face)
        # The heights of all vertices over the plane of the face, in integers. They are at most 0 for a convex solid.
        a, b, c = lowest(normal)
        level = dot((a, b, c), integers[face[0]])
        heights = [a * x + b * y + c * z - level for x, y, z in integers]
        if not any(normal):
            yield f"face {order} is not a polygon"
        if any(heights[place] for place in face):
            yield f"face {order} is not plane"
        if any(height > 0 for height in heights):
            beyond = next(place for place, height in enumerate(heights) if height > 0)
            yield f"not convex: vertex {beyond + 1} lies beyond face {order}"
        if not turns_once([points[place] for place in face], (-normal[0], -normal[1], -normal[2])):
            yield f"face {order} is not convex"
        flat = flat and not any(heights)
    if flat and len(faces) != 2:
        yield "all vertices lie in one plane, and a plate has two faces"
    # Every face lies on the boundary of the convex hull, a sphere, so closed faces cover it at least once. Euler's
    # formula excludes that they cover it more than once.
    if len(points) - sum(map(len, faces)) // 2 + len(faces) != 2:
        yield "not one closed surface: vertices - edges + faces is not 2"


def turns_once(points: Sequence[tuple[N, N, N]], normal: tuple[N, N, N]) -> bool:
    """Return True if a plane polygon is convex and runs counterclockwise once, seen from the tip of ``normal``."""
    # The signs are those of integers, which are computed faster than fractions.
    (_, corners), up = whole(points), lowest(normal)
    lines = list(sides(range(len(corners))))
    steps = [minus(corners[b], corners[a]) for a, b in lines]
    bends = [dot(cross(steps[a], steps[b]), up) for a, b in lines]
    if any(bend < 0 for bend in bends) or not all(map(any, steps)):
        return False
    # A polygon that turns left at all corners may still run around twice. Then a corner is to the right of a side.
    return all(dot(cross(steps[a], minus(q, corners[a])), up) >= 0 for a, _ in lines for q in corners)

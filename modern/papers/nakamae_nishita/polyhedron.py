"""Convex polyhedra in the paper's form (section 2): vertices, and faces by vertex numbers, clockwise from outside.

A plate is a polyhedron without thickness: one polygon as two faces, one for each side. Polyhedra come from scenes, from
files with faces (``bodies``) and from hulls.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import PurePath

from emulator.errors import EmulatorError
from modern.exact_hull.coordinates import common_scale, to_integers
from modern.geometry.coplanar import Joined
from modern.geometry.hull import Hull
from modern.geometry.mesh import mesh, sides
from modern.geometry.vectors import Vector, area_vector, cross, dot, lowest, minus


class SceneError(EmulatorError):
    """A scene that cannot be drawn, because a file, a shape or the arrangement is invalid. The message is one line."""


@dataclass(frozen=True, slots=True)
class Figure:
    """A closed figure on a face: its corners in space, and the index of the face (section 1, merit 4)."""

    face: int
    corners: tuple[Vector, ...]


@dataclass(frozen=True, slots=True)
class Polyhedron:
    """A convex polyhedron.

    ``thing`` names the object it is a part of; lines that only divide an object are not drawn. ``joined`` has a group
    number for every face, and no edge is drawn between faces of one group (``modern.geometry.coplanar``). If it is
    empty, no faces are merged.
    """

    name: str
    vertices: tuple[Vector, ...]
    faces: tuple[tuple[int, ...], ...]
    thing: str = ""
    figures: tuple[Figure, ...] = ()
    joined: tuple[int, ...] = ()


def outward(polyhedron: Polyhedron, face: tuple[int, ...]) -> Vector:
    """Return the outward normal of a face, twice as long as its area."""
    return area_vector(polyhedron.vertices, face[::-1])


def checked(polyhedron: Polyhedron) -> Polyhedron:
    """Return the polyhedron after proving that it is closed and convex.

    If all faces run counterclockwise from outside, they are reversed. Raise SceneError with the name of the polyhedron
    and the number, from 1, of an invalid face or of the vertices of an invalid edge.
    """
    name = polyhedron.name
    _check_closed(polyhedron)
    reversed_faces = replace(polyhedron, faces=tuple(face[::-1] for face in polyhedron.faces))
    faults = [next(_faults(candidate), "") for candidate in (polyhedron, reversed_faces)]
    if not faults[0]:
        return polyhedron
    if not faults[1]:
        return reversed_faces
    raise SceneError(f"{name}: {faults[0] if _volume(polyhedron) >= 0 else faults[1]}")


def _check_closed(polyhedron: Polyhedron) -> None:
    name = polyhedron.name
    used: set[int] = set()
    directed: Counter[tuple[int, int]] = Counter()
    for order, face in enumerate(polyhedron.faces, 1):
        if len(face) < 3 or len(set(face)) < len(face):
            raise SceneError(f"{name}: face {order} does not have at least three different vertices")
        used.update(face)
        directed.update(sides(face))
    if not polyhedron.faces:
        raise SceneError(f"{name}: there are no faces")
    for (a, b), times in sorted(directed.items()):
        if times > 1:
            raise SceneError(f"{name}: two faces run in the same direction along vertices {a + 1} and {b + 1}")
        if not directed[b, a]:
            raise SceneError(f"{name}: not closed: only one face at vertices {a + 1} and {b + 1}")
    first: dict[Vector, int] = {}
    for place, point in enumerate(polyhedron.vertices):
        if place not in used:
            raise SceneError(f"{name}: vertex {place + 1} belongs to no face")
        if first.setdefault(point, place) != place:
            raise SceneError(f"{name}: vertices {first[point] + 1} and {place + 1} are the same point")


def _faults(polyhedron: Polyhedron) -> Iterator[str]:
    """Yield the reasons why closed faces are not a convex solid or a plate with faces clockwise from outside."""
    points, faces = polyhedron.vertices, polyhedron.faces
    integers = to_integers(points, common_scale(points))
    flat = True
    for order, face in enumerate(faces, 1):
        normal = outward(polyhedron, face)
        a, b, c = lowest(normal)
        level = dot((a, b, c), integers[face[0]])
        heights = [a * x + b * y + c * z - level for x, y, z in integers]
        if not any(normal):
            yield f"face {order} is not a polygon"
        if any(heights[place] for place in face):
            yield f"face {order} is not plane"
        if any(height > 0 for height in heights):
            yield f"not convex: vertex {_first(heights) + 1} lies beyond face {order}"
        if not turns_once([points[place] for place in face], (-normal[0], -normal[1], -normal[2])):
            yield f"face {order} is not convex"
        flat = flat and not any(heights)
    if flat and len(faces) != 2:
        yield "all vertices lie in one plane, and a plate has two faces"
    # Every face lies on the boundary of the convex hull, a sphere, so closed faces cover it at least once. Euler's
    # formula excludes that they cover it more than once.
    if len(points) - sum(map(len, faces)) // 2 + len(faces) != 2:
        yield "not one closed surface: vertices - edges + faces is not 2"


def _first(heights: Sequence[int]) -> int:
    return next(place for place, height in enumerate(heights) if height > 0)


def turns_once(points: Sequence[Vector], normal: Vector) -> bool:
    """Return True if a plane polygon is convex and runs counterclockwise once as seen from the side of ``normal``."""
    steps = [minus(q, p) for p, q in zip(points, [*points[1:], points[0]], strict=True)]
    bends = [dot(cross(u, v), normal) for u, v in zip(steps, [*steps[1:], steps[0]], strict=True)]
    if any(bend < 0 for bend in bends) or not all(map(any, steps)):
        return False
    # A polygon with left turns only may still run around twice. Then some corner is to the right of some side.
    lines = zip(points, steps, strict=True)
    return all(dot(cross(step, minus(q, p)), normal) >= 0 for p, step in lines for q in points)


def _volume(polyhedron: Polyhedron) -> Fraction:
    """Return six times the volume, which is negative if the faces run counterclockwise from outside."""
    points = polyhedron.vertices
    return sum(
        (
            dot(points[face[0]], cross(points[face[k + 1]], points[face[k]]))
            for face in polyhedron.faces
            for k in range(1, len(face) - 1)
        ),
        Fraction(0),
    )


def polyhedron_of_hull(hull: Hull, name: str = "hull", joined: Joined | None = None) -> Polyhedron:
    """Return the polyhedron of a hull, or the plate of a polygon, with the faces of ``joined`` merged.

    Raise ExportError if there is no hull. Raise SceneError for a hull of less than two dimensions, and for one whose
    faces are not plane or not convex, which rounded arithmetic can cause.
    """
    surface = mesh(hull)
    if surface.dimension < 2:
        raise SceneError(f"{name}: a {('point', 'segment')[surface.dimension]} is not a polyhedron")
    faces = tuple(face[::-1] for face in surface.faces)
    if surface.dimension == 2:
        faces = (faces[0], surface.faces[0])
    groups = () if joined is None else joined.group_of()
    return checked(Polyhedron(PurePath(name).name, surface.numbers(), faces, joined=groups))

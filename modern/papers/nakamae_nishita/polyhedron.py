"""A convex polyhedron as the paper has it (section 2): vertices, and faces by vertex numbers, clockwise from outside.

A plate is a polyhedron without thickness: one polygon as two faces, one for each side.  Polyhedra come from a
scene, from files of faces (``bodies``) and from every hull of this project.
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
    """A scene that cannot be drawn: no convex polyhedron, polyhedra that intersect, a file at fault; one line."""


@dataclass(frozen=True, slots=True)
class Figure:
    """A closed figure on a face: its corners in space, and the face by place (section 1, merit 4)."""

    face: int
    corners: tuple[Vector, ...]


@dataclass(frozen=True, slots=True)
class Polyhedron:
    """A convex polyhedron.  ``thing``: the object it is a part of; lines that only divide an object are not drawn.

    joined: for every face a number that it shares with those it is read as one with (``modern.geometry.coplanar``),
    between which no edge is drawn; empty: each face is its own.
    """

    name: str
    vertices: tuple[Vector, ...]
    faces: tuple[tuple[int, ...], ...]
    thing: str = ""
    figures: tuple[Figure, ...] = ()
    joined: tuple[int, ...] = ()


def outward(polyhedron: Polyhedron, face: tuple[int, ...]) -> Vector:
    """A vector at right angles to a face, outward: twice its area."""
    return area_vector(polyhedron.vertices, face[::-1])


def checked(polyhedron: Polyhedron) -> Polyhedron:
    """The polyhedron, proved closed and convex; faces all counterclockwise from outside are turned.

    Raises SceneError, naming the polyhedron and a face or edge at fault, counted from 1.
    """
    name = polyhedron.name
    _check_closed(polyhedron)
    turned = replace(polyhedron, faces=tuple(face[::-1] for face in polyhedron.faces))
    faults = [next(_faults(candidate), "") for candidate in (polyhedron, turned)]
    if not faults[0]:
        return polyhedron
    if not faults[1]:
        return turned
    raise SceneError(f"{name}: {faults[0] if _volume(polyhedron) >= 0 else faults[1]}")


def _check_closed(polyhedron: Polyhedron) -> None:
    name = polyhedron.name
    used: set[int] = set()
    directed: Counter[tuple[int, int]] = Counter()
    for order, face in enumerate(polyhedron.faces, 1):
        if len(face) < 3 or len(set(face)) < len(face):
            raise SceneError(f"{name}: face {order} is not of three or more different vertices")
        used.update(face)
        directed.update(sides(face))
    if not polyhedron.faces:
        raise SceneError(f"{name}: there are no faces")
    for (a, b), times in sorted(directed.items()):
        if times > 1:
            raise SceneError(f"{name}: two faces run the same way along vertices {a + 1} and {b + 1}")
        if not directed[b, a]:
            raise SceneError(f"{name}: not closed: one face only at vertices {a + 1} and {b + 1}")
    first: dict[Vector, int] = {}
    for place, point in enumerate(polyhedron.vertices):
        if place not in used:
            raise SceneError(f"{name}: vertex {place + 1} belongs to no face")
        if first.setdefault(point, place) != place:
            raise SceneError(f"{name}: vertices {first[point] + 1} and {place + 1} are one point")


def _faults(polyhedron: Polyhedron) -> Iterator[str]:
    """What keeps closed faces from being a convex solid, or a plate, clockwise from outside."""
    points, faces = polyhedron.vertices, polyhedron.faces
    whole = to_integers(points, common_scale(points))
    flat = True
    for order, face in enumerate(faces, 1):
        normal = outward(polyhedron, face)
        a, b, c = lowest(normal)
        level = dot((a, b, c), whole[face[0]])
        heights = [a * x + b * y + c * z - level for x, y, z in whole]
        if not any(normal):
            yield f"face {order} is no polygon"
        if any(heights[place] for place in face):
            yield f"face {order} is not plane"
        if any(height > 0 for height in heights):
            yield f"not convex: vertex {_first(heights) + 1} lies beyond face {order}"
        if not turns_once([points[place] for place in face], (-normal[0], -normal[1], -normal[2])):
            yield f"face {order} is not convex"
        flat = flat and not any(heights)
    if flat and len(faces) != 2:
        yield "all vertices lie in one plane, and a plate has two faces"
    # Every face lies on the boundary of the convex hull, which is a sphere: closed faces cover it once or more, and
    # twice would show in the number of edges at a vertex.
    if len(points) - sum(map(len, faces)) // 2 + len(faces) != 2:
        yield "not one closed surface: vertices - edges + faces is not 2"


def _first(heights: Sequence[int]) -> int:
    return next(place for place, height in enumerate(heights) if height > 0)


def turns_once(points: Sequence[Vector], normal: Vector) -> bool:
    """Whether a polygon in a plane is convex and runs counterclockwise once, seen from where ``normal`` points to."""
    steps = [minus(q, p) for p, q in zip(points, [*points[1:], points[0]], strict=True)]
    bends = [dot(cross(u, v), normal) for u, v in zip(steps, [*steps[1:], steps[0]], strict=True)]
    if any(bend < 0 for bend in bends) or not all(map(any, steps)):
        return False
    # A convex turn that runs around once has every corner on the left of every side; twice around has not.
    lines = zip(points, steps, strict=True)
    return all(dot(cross(step, minus(q, p)), normal) >= 0 for p, step in lines for q in points)


def _volume(polyhedron: Polyhedron) -> Fraction:
    """Six times the volume; negative where the faces run counterclockwise from outside."""
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
    """The polyhedron of a hull; of a polygon a plate.

    joined: which of its faces are read as one.  Raises ExportError where there is no hull, SceneError for one of less
    than two dimensions and for one whose faces, in rounded arithmetic, are not plane or not convex.
    """
    surface = mesh(hull)
    if surface.dimension < 2:
        raise SceneError(f"{name}: a {('point', 'segment')[surface.dimension]} is no polyhedron")
    faces = tuple(face[::-1] for face in surface.faces)
    if surface.dimension == 2:
        faces = (faces[0], surface.faces[0])
    groups = () if joined is None else joined.group_of()
    return checked(Polyhedron(PurePath(name).name, surface.numbers(), faces, joined=groups))

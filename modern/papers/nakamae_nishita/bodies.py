"""Convex polyhedra from a file of faces: its connected components, each proved convex, or what keeps it from that.

Faces are connected where two of them, and no more, share an edge.  A component is closed, its faces are plane and all
its edges convex; that its faces then lie on the hull of its vertices is checked by the exact hull.  Where a component
is not convex the edge with the deepest dent is named, since that is where to part it; or its hull is taken, or faces
within a distance of one plane are read as one.  Faces and vertices are counted from 1, as they stand in the file.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from modern.comparison.outcome import as_hull
from modern.exact_hull import exact_hull
from modern.exact_hull.coordinates import IntPoint, common_scale, to_integers
from modern.formats.meshes import parse_mesh, surface_kind
from modern.formats.points import parse_bytes
from modern.formats.tokens import FileMesh
from modern.geometry.coplanar import FLAT, CoplanarError, Joined, join, join_summary, root_text
from modern.geometry.hull import Hull
from modern.geometry.mesh import mesh, sides
from modern.geometry.numbers import coordinates
from modern.geometry.vectors import Vector, area_vector, cross, dot, lowest, minus
from modern.papers.nakamae_nishita.polyhedron import Polyhedron, SceneError, checked, polyhedron_of_hull, turns_once

Edge = tuple[int, int]


@dataclass(frozen=True, slots=True)
class Reading:
    """How a file is read: each component as its hull; with faces within a distance of one plane as one; a file that has
    points only as their hull, which ``hull`` allows too.

    as_hull, as_within: how a user asks for the first two, for messages.
    """

    hull: bool = False
    within: Fraction | None = None
    points: bool = False
    as_hull: str = "hull = true"
    as_within: str = 'coplanar_within = "E"'


@dataclass(frozen=True, slots=True)
class Bodies:
    """The convex polyhedra of a file, and what the reader should know of how they came about, a line each."""

    polyhedra: tuple[Polyhedron, ...]
    notes: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class _Component:
    """Faces that are connected, by place in the file, and the places of their vertices, sorted."""

    name: str
    faces: tuple[int, ...]
    vertices: tuple[int, ...]


def read_bodies(data: bytes, name: str, reading: Reading) -> Bodies:
    """The components of a file's surface, or the hull of a file's points.  Raises EmulatorError."""
    if surface_kind(data, name):
        found = parse_mesh(data, name)
        if found.faces:
            return bodies(found, reading, name)
    if not (reading.hull or reading.points):
        raise SceneError(f"{name}: there are no faces, only points; {reading.as_hull} takes their hull")
    given = parse_bytes(data, name)
    hull = as_hull(exact_hull(given.points))
    notes = [*given.notes]
    notes += (f"{name}: {given.places[k]}: the point of {given.places[first]} again" for k, first in hull.duplicates)
    joined = None if reading.within is None or hull.dimension < 3 else _joined(hull, reading.within, name)
    if reading.within is not None:
        notes.append(f"{name}: {FLAT if joined is None else join_summary(joined)}")
    return Bodies((_of_hull(hull, name, joined),), tuple(notes))


def bodies(found: FileMesh, reading: Reading, name: str) -> Bodies:
    """The components of a file as convex polyhedra.

    name: what messages call the file.  Raises SceneError where a component is not closed or not convex, CoplanarError
    for a distance that is too large for one.
    """
    components = _components(found, name)
    notes = [f"{name}: {len(components)} connected components"] if len(components) > 1 else []
    used = {place for component in components for place in component.vertices}
    loose = len(found.points) - len(used)
    if loose:
        notes.append(f"{name}: {loose} of {len(found.points)} vertices belong to no face")
    polyhedra = []
    for component in components:
        polyhedron, said = _body(found, component, reading)
        polyhedra.append(polyhedron)
        notes += [f"{component.name}: {words}" for words in said]
    return Bodies(tuple(polyhedra), tuple(notes))


def _components(found: FileMesh, name: str) -> list[_Component]:
    beside: dict[Edge, list[int]] = {}
    for order, face in enumerate(found.faces):
        for a, b in sides(face):
            beside.setdefault((min(a, b), max(a, b)), []).append(order)
    parent = list(range(len(found.faces)))

    def root(face: int) -> int:
        while parent[face] != face:
            parent[face] = parent[parent[face]]
            face = parent[face]
        return face

    for faces in beside.values():
        if len(faces) == 2:
            first, last = sorted(map(root, faces))
            parent[last] = first
    groups: dict[int, list[int]] = {}
    for order in range(len(found.faces)):
        groups.setdefault(root(order), []).append(order)
    return [
        _Component(
            f"{name}, component {number} of {len(groups)}" if len(groups) > 1 else name,
            tuple(group),
            tuple(sorted({place for order in group for place in found.faces[order]})),
        )
        for number, group in enumerate(groups.values(), 1)
    ]


def _body(found: FileMesh, component: _Component, reading: Reading) -> tuple[Polyhedron, list[str]]:
    """A component as a convex polyhedron, and what was done to make it one."""
    name = component.name
    fault = next(_faults(found, component), "")
    if fault and not reading.hull:
        raise SceneError(f"{name}: {fault}")
    hull = as_hull(exact_hull([coordinates(found.points[place]) for place in component.vertices]))
    if hull.dimension < 3:
        return _of_hull(hull, name, None) if reading.hull else checked(_as_given(_closed(found, component))), []
    joined = None if reading.within is None else _joined(hull, reading.within, name)
    said = [] if joined is None else [join_summary(joined)]
    if fault:
        return _of_hull(hull, name, joined), ["not closed, its hull is taken", *said]
    closed = _closed(found, component)
    dents = list(_dents(closed))
    if reading.hull:
        return _of_hull(hull, name, joined), [*(["not convex, its hull is taken"] if dents else []), *said]
    far = None if joined is None else _far(closed, hull, joined)
    if joined is not None and far is None:
        return _of_hull(hull, name, joined), said
    if dents:
        raise SceneError(f"{name}: {_advice(found, max(dents, key=lambda dent: (dent[0], -dent[1])), reading)}")
    if far is not None:
        raise SceneError(f"{name}: face {far + 1} does not lie within that distance of the hull of the vertices")
    given = _as_given(closed)
    flaw = next(_flaws(closed, hull, given, reading), "")
    if flaw:
        raise SceneError(f"{name}: {flaw}")
    return given, []


def _faults(found: FileMesh, component: _Component) -> Iterator[str]:
    """What keeps a component from being a closed surface."""
    directed: Counter[Edge] = Counter()
    for order in component.faces:
        face = found.faces[order]
        if len(face) < 3 or len(set(face)) < len(face):
            yield f"face {order + 1} is not of three or more different vertices"
        directed.update(sides(face))
    for (a, b), times in sorted(directed.items()):
        if times > 1:
            yield f"two faces run the same way along vertices {_two(found, a, b)}"
        if not directed[b, a]:
            yield f"not closed: one face only at vertices {_two(found, a, b)}"
    first: dict[object, int] = {}
    for place in component.vertices:
        point = coordinates(found.points[place])
        if first.setdefault(point, place) != place:
            yield f"vertices {first[point] + 1} and {place + 1} are one point"


@dataclass(frozen=True, slots=True)
class _Closed:
    """A closed component: its points, made whole numbers by ``scale``, and its faces with their normals, all by place
    in the file, counterclockwise from outside."""

    found: FileMesh
    component: _Component
    scale: int
    points: dict[int, IntPoint]
    faces: dict[int, tuple[int, ...]]
    normals: dict[int, IntPoint]


def _closed(found: FileMesh, component: _Component) -> _Closed:
    vectors = [coordinates(found.points[place]) for place in component.vertices]
    scale = common_scale(vectors)
    points = dict(zip(component.vertices, to_integers(vectors, scale), strict=True))
    faces = {order: found.faces[order] for order in component.faces}
    normals = {order: _normal(points, face) for order, face in faces.items()}
    if sum(dot(normals[order], points[face[0]]) for order, face in faces.items()) < 0:
        faces = {order: face[::-1] for order, face in faces.items()}
        normals = {order: (-x, -y, -z) for order, (x, y, z) in normals.items()}
    return _Closed(found, component, scale, points, faces, normals)


def _normal(points: dict[int, IntPoint], face: Sequence[int]) -> IntPoint:
    corners = [points[place] for place in face]
    return area_vector(corners, range(len(corners)))


def _dents(closed: _Closed) -> Iterator[tuple[Fraction, int, int, int, int]]:
    """The edges along which the surface turns inward: the square of how far one face reaches beyond the plane of the
    other, the two faces, and the two vertices."""
    points, normals = closed.points, closed.normals
    owner = {edge: order for order, face in closed.faces.items() for edge in sides(face)}
    for (a, b), order in owner.items():
        other, normal = owner[b, a], normals[order]
        if order < other and dot(cross(normal, normals[other]), minus(points[b], points[a])) < 0:
            depth = max(dot(normal, minus(points[place], points[a])) for place in closed.faces[other])
            yield Fraction(depth * depth, dot(normal, normal) * closed.scale**2), order, other, a, b


def _advice(found: FileMesh, dent: tuple[Fraction, int, int, int, int], reading: Reading) -> str:
    square, order, other, a, b = dent
    return (
        f"not convex: between faces {order + 1} and {other + 1} the edge of vertices {_two(found, a, b)}, is reflex by "
        f"{root_text(square)}; part the solid along the plane of face {order + 1}, or take its hull "
        f"({reading.as_hull}), or, where that is rounding, read faces within a distance as one ({reading.as_within})"
    )


def _two(found: FileMesh, a: int, b: int) -> str:
    """Two vertices by number, and where they are."""
    at = " and ".join(f"({', '.join(found.points[place])})" for place in (a, b))
    return f"{a + 1} and {b + 1}, {at}"


def _as_given(closed: _Closed) -> Polyhedron:
    """The component with the file's own faces, clockwise from outside."""
    component = closed.component
    places = {place: order for order, place in enumerate(component.vertices)}
    faces = tuple(tuple(places[place] for place in face[::-1]) for face in closed.faces.values())
    points = tuple(coordinates(closed.found.points[place]) for place in component.vertices)
    return Polyhedron(component.name, points, faces)


def _flaws(closed: _Closed, hull: Hull, given: Polyhedron, reading: Reading) -> Iterator[str]:
    """What keeps closed faces without a dent from being the hull of their vertices: each is plane, a convex polygon,
    and in the plane of a face of the hull; and together they cover it once."""
    points = closed.points
    planes = {face.lowest for face in hull.faces}
    for order, face in closed.faces.items():
        normal = closed.normals[order]
        if not any(normal):
            yield f"face {order + 1} is no polygon"
        off = max(abs(dot(normal, minus(points[place], points[face[0]]))) for place in face)
        if off:
            far = root_text(Fraction(off * off, dot(normal, normal) * closed.scale**2))
            yield f"face {order + 1} is not plane, by {far}; {reading.as_within} reads faces within a distance as one"
        a, b, c = lowest(normal)
        d = Fraction(-dot((a, b, c), points[face[0]]), closed.scale)
        if (a * d.denominator, b * d.denominator, c * d.denominator, d.numerator) not in planes:
            yield f"not convex: face {order + 1} does not lie on the hull of the vertices"
        if not turns_once([_fractions(points[place]) for place in face], _fractions(normal)):
            yield f"face {order + 1} is not convex"
    if len(given.vertices) - sum(map(len, given.faces)) // 2 + len(given.faces) != 2:
        yield "not one closed surface: vertices - edges + faces is not 2"


def _joined(hull: Hull, within: Fraction, name: str) -> Joined:
    try:
        return join(mesh(hull), within)
    except CoplanarError as error:
        raise CoplanarError(f"{name}: {error}") from None


def _far(closed: _Closed, hull: Hull, joined: Joined) -> int | None:
    """A face whose vertices do not all lie within the distance of the plane of one joined face of the hull."""
    planes, around = [], dict[int, set[int]]()
    for number, group in enumerate(joined.groups):
        a, b, c, d = hull.faces[group[0]].lowest
        limit = joined.within**2 * (a * a + b * b + c * c) * closed.scale**2
        planes.append(((a, b, c), d * closed.scale, limit))
        for face in group:
            for index in hull.faces[face].polygon:
                around.setdefault(closed.component.vertices[index], set()).add(number)

    def lies(polygon: Sequence[int], tried: Iterable[int]) -> bool:
        return any(
            all((dot(normal, closed.points[place]) + level) ** 2 <= limit for place in polygon)
            for normal, level, limit in (planes[number] for number in tried)
        )

    for order, polygon in closed.faces.items():
        # Mostly it is one of the faces around its own vertices.
        tried = set[int]().union(*(around.get(place, ()) for place in polygon))
        if not lies(polygon, tried) and not lies(polygon, range(len(planes))):
            return order
    return None


def _of_hull(hull: Hull, name: str, joined: Joined | None) -> Polyhedron:
    """The polyhedron of an exact hull, which its certificate has proved."""
    if hull.dimension < 3:
        return replace(polyhedron_of_hull(hull, name), name=name)
    surface = mesh(hull)
    faces = tuple(face[::-1] for face in surface.faces)
    return Polyhedron(name, surface.numbers(), faces, joined=() if joined is None else joined.group_of())


def _fractions(point: IntPoint) -> Vector:
    return Fraction(point[0]), Fraction(point[1]), Fraction(point[2])

"""Read the convex polyhedra in a file with faces: its connected components, each of which is proved to be convex.

Two faces are connected if they share an edge to which no third face belongs. A component must be closed, its faces must
be plane, and all its edges must be convex. The exact hull of its vertices then confirms that its faces lie on the hull.
If a component is not convex, the message names the deepest reflex edge, at which the solid can be divided. The
user can instead replace the component by its hull, or merge faces that lie within a given distance of one plane.
Messages count faces and vertices from 1 in the order of the file.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial

from modern.formats.points import parse_bytes, parse_mesh, surface_kind
from modern.formats.tokens import FileMesh
from modern.geometry.coplanar import FLAT, CoplanarError, Joined, join, join_summary, root_text
from modern.geometry.hull import Hull
from modern.geometry.mesh import mesh, sides
from modern.geometry.numbers import Point, coordinates
from modern.geometry.vectors import Vector, area_vector, cross, dot, lowest, minus, whole
from modern.papers.nakamae_nishita import polyhedron as solids
from modern.papers.nakamae_nishita.polyhedron import Polyhedron, SceneError, checked, turns_once

Edge = tuple[int, int]
IntPoint = tuple[int, int, int]


@dataclass(frozen=True, slots=True)
class Reading:
    """The options with which a file of faces is read.

    If ``hull`` is True, each component is replaced by its hull. ``within`` is a distance or None: faces within this
    distance of one plane are merged. If ``points`` or ``hull`` is True, a file may also contain only points. Messages
    name the options ``hull`` and ``within`` by the texts ``as_hull`` and ``as_within``.
    """

    hull: bool = False
    within: Fraction | None = None
    points: bool = False
    as_hull: str = "hull = true"
    as_within: str = 'coplanar_within = "E"'


@dataclass(frozen=True, slots=True)
class Bodies:
    """The convex polyhedra read from a file, and notes for the user on how they were obtained, one line each."""

    polyhedra: tuple[Polyhedron, ...]
    notes: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class _Component:
    """A connected part of a surface: its name in messages, and the sorted indices of its faces and vertices."""

    name: str
    faces: tuple[int, ...]
    vertices: tuple[int, ...]


def read_bodies(data: bytes, name: str, reading: Reading) -> Bodies:
    """Return the components of a file's surface, or the hull of a file's points. Raise EmulatorError if invalid."""
    if surface_kind(data, name):
        surface = parse_mesh(data, name)
        if surface.faces:
            return bodies(surface, reading, name)
    if not (reading.hull or reading.points):
        raise SceneError(f"{name}: expected faces, found only points; {reading.as_hull} uses their hull")
    table = parse_bytes(data, name)
    hull = _hull(table.points)
    notes = [*table.notes]
    if table.kind == "json" and b'"faces"' in data:
        notes.append(f"{name}: the faces of a JSON file are not read; the hull of its points is drawn")
    notes += (
        f"{name}: {table.places[k]}: this point repeats that of {table.places[first]}" for k, first in hull.duplicates
    )
    joined = None if reading.within is None or hull.dimension < 3 else _joined(hull, reading.within, name)
    if reading.within is not None:
        notes.append(f"{name}: {FLAT if joined is None else join_summary(joined)}")
    return Bodies((polyhedron_of_hull(hull, name, joined),), tuple(notes))


def bodies(surface: FileMesh, reading: Reading, name: str) -> Bodies:
    """Return the components of a file as convex polyhedra. ``name`` is the name of the file in messages.

    Raise SceneError if a component is not closed or not convex, and CoplanarError if the distance for merging faces is
    too large.
    """
    components = _components(surface, name)
    notes = [f"{name}: {len(components)} connected components"] if len(components) > 1 else []
    used = {place for component in components for place in component.vertices}
    loose = len(surface.points) - len(used)
    if loose:
        notes.append(f"{name}: {loose} of {len(surface.points)} vertices belong to no face")
    polyhedra = []
    for component in components:
        polyhedron, changes = _body(surface, component, reading)
        polyhedra.append(polyhedron)
        notes += [f"{component.name}: {change}" for change in changes]
    return Bodies(tuple(polyhedra), tuple(notes))


def _components(surface: FileMesh, name: str) -> list[_Component]:
    faces_at: dict[Edge, list[int]] = {}
    for order, face in enumerate(surface.faces):
        for a, b in sides(face):
            faces_at.setdefault((min(a, b), max(a, b)), []).append(order)
    # Section 2 describes an object as convex polyhedra, so the file is divided into the connected components of its
    # faces. Union-find over faces that share an edge; an edge of more than two faces connects none.
    parent = list(range(len(surface.faces)))

    def root(face: int) -> int:
        while parent[face] != face:
            parent[face] = parent[parent[face]]
            face = parent[face]
        return face

    for faces in faces_at.values():
        if len(faces) == 2:
            first, last = sorted(map(root, faces))
            parent[last] = first
    groups: dict[int, list[int]] = {}
    for order in range(len(surface.faces)):
        groups.setdefault(root(order), []).append(order)
    components = []
    for number, group in enumerate(groups.values(), 1):
        label = f"{name}, component {number} of {len(groups)}" if len(groups) > 1 else name
        vertices = {place for order in group for place in surface.faces[order]}
        components.append(_Component(label, tuple(group), tuple(sorted(vertices))))
    return components


def _body(surface: FileMesh, component: _Component, reading: Reading) -> tuple[Polyhedron, list[str]]:
    name = component.name
    faces = {order: surface.faces[order] for order in component.faces}
    points = {place: coordinates(surface.points[place]) for place in component.vertices}
    fault = next(solids.open_faults(faces, points, partial(_edge_name, surface)), "")
    if fault and not reading.hull:
        raise SceneError(f"{name}: {fault}")
    # The exact hull of the component's vertices either replaces the component or proves that it is convex.
    hull = _hull([*points.values()])
    if hull.dimension < 3:
        return polyhedron_of_hull(hull, name, None) if reading.hull else checked(
            _as_given(_closed(surface, component))
        ), []
    joined = None if reading.within is None else _joined(hull, reading.within, name)
    changes = [] if joined is None else [join_summary(joined)]
    if fault:
        return polyhedron_of_hull(hull, name, joined), ["not closed, replaced by its hull", *changes]
    closed = _closed(surface, component)
    dents = list(_dents(closed))
    if reading.hull:
        return polyhedron_of_hull(hull, name, joined), [
            *(["not convex, replaced by its hull"] if dents else []),
            *changes,
        ]
    far = None if joined is None else _far(closed, hull, joined)
    if joined is not None and far is None:
        return polyhedron_of_hull(hull, name, joined), changes
    if dents:
        raise SceneError(f"{name}: {_advice(surface, max(dents, key=lambda dent: (dent[0], -dent[1])), reading)}")
    if far is not None:
        raise SceneError(f"{name}: face {far + 1} does not lie within {reading.within} of the hull of the vertices")
    polyhedron = _as_given(closed)
    flaw = next(_flaws(closed, hull, polyhedron, reading), "")
    if flaw:
        raise SceneError(f"{name}: {flaw}")
    return polyhedron, []


@dataclass(frozen=True, slots=True)
class _Closed:
    """A closed component with its faces counterclockwise from outside. Coordinates are multiplied by ``scale``.

    The keys of points, faces and normals are indices in the file.
    """

    surface: FileMesh
    component: _Component
    scale: int
    points: dict[int, IntPoint]
    faces: dict[int, tuple[int, ...]]
    normals: dict[int, IntPoint]


def _hull(points: Sequence[Point] | Sequence[Vector]) -> Hull:
    # Not imported at the top, because these modules need numpy, and the scenes of the paper do not.
    from modern.comparison.outcome import as_hull
    from modern.exact_hull import exact_hull

    return as_hull(exact_hull(points))


def _closed(surface: FileMesh, component: _Component) -> _Closed:
    vectors = [coordinates(surface.points[place]) for place in component.vertices]
    scale, integers = whole(vectors)
    points = dict(zip(component.vertices, integers, strict=True))
    faces = {order: surface.faces[order] for order in component.faces}
    normals = {order: area_vector([points[place] for place in face], range(len(face))) for order, face in faces.items()}
    # The cones from the origin to the faces have a negative total volume if the faces are clockwise from outside.
    if sum(dot(normals[order], points[face[0]]) for order, face in faces.items()) < 0:
        faces = {order: face[::-1] for order, face in faces.items()}
        normals = {order: (-x, -y, -z) for order, (x, y, z) in normals.items()}
    return _Closed(surface, component, scale, points, faces, normals)


def _dents(closed: _Closed) -> Iterator[tuple[Fraction, int, int, int, int]]:
    """Yield the reflex edges of a component, at which it is not convex.

    An edge is given as the squared height of one of its faces above the plane of the other face, followed by the
    indices of the two faces and of the two vertices.
    """
    points, normals = closed.points, closed.normals
    owner = {edge: order for order, face in closed.faces.items() for edge in sides(face)}
    for (a, b), order in owner.items():
        neighbour, normal = owner[b, a], normals[order]
        # At a reflex edge the normals turn against the sense of the edge. Each edge is examined from one side only.
        if order < neighbour and dot(cross(normal, normals[neighbour]), minus(points[b], points[a])) < 0:
            depth = max(dot(normal, minus(points[place], points[a])) for place in closed.faces[neighbour])
            yield Fraction(depth * depth, dot(normal, normal) * closed.scale**2), order, neighbour, a, b


def _advice(surface: FileMesh, dent: tuple[Fraction, int, int, int, int], reading: Reading) -> str:
    square, order, neighbour, a, b = dent
    return (
        f"not convex: between faces {order + 1} and {neighbour + 1} the edge of vertices {_edge_name(surface, a, b)}, "
        f"is reflex: face {neighbour + 1} rises {root_text(square)} above the plane of face {order + 1}; divide the "
        f"solid along this plane, take its hull ({reading.as_hull}), or, if the cause is rounding, merge faces "
        f"within a distance ({reading.as_within})"
    )


def _edge_name(surface: FileMesh, a: int, b: int) -> str:
    at = " and ".join(f"({', '.join(surface.points[place])})" for place in (a, b))
    return f"{a + 1} and {b + 1}, {at}"


def _as_given(closed: _Closed) -> Polyhedron:
    component = closed.component
    places = {place: order for order, place in enumerate(component.vertices)}
    faces = tuple(tuple(places[place] for place in face[::-1]) for face in closed.faces.values())
    points = tuple(coordinates(closed.surface.points[place]) for place in component.vertices)
    return Polyhedron(component.name, points, faces)


def _flaws(closed: _Closed, hull: Hull, polyhedron: Polyhedron, reading: Reading) -> Iterator[str]:
    """Yield the reasons why a closed component without reflex edges is still not the hull of its vertices.

    Each face must be a plane convex polygon in the plane of a face of the hull, and the faces must cover the hull once.
    """
    points = closed.points
    planes = {face.lowest for face in hull.faces}
    for order, face in closed.faces.items():
        normal = closed.normals[order]
        if not any(normal):
            yield f"face {order + 1} is not a polygon"
        off = max(abs(dot(normal, minus(points[place], points[face[0]]))) for place in face)
        if off:
            far = root_text(Fraction(off * off, dot(normal, normal) * closed.scale**2))
            advice = f"{reading.as_within} merges faces within the distance E"
            yield f"face {order + 1} is not plane: a vertex is {far} away from its plane; {advice}"
        a, b, c = lowest(normal)
        d = Fraction(-dot((a, b, c), points[face[0]]), closed.scale)
        if (a * d.denominator, b * d.denominator, c * d.denominator, d.numerator) not in planes:
            yield f"not convex: face {order + 1} does not lie on the hull of the vertices"
        if not turns_once([points[place] for place in face], normal):
            yield f"face {order + 1} is not convex"
    if len(polyhedron.vertices) - sum(map(len, polyhedron.faces)) // 2 + len(polyhedron.faces) != 2:
        yield "not one closed surface: vertices - edges + faces is not 2"


def _joined(hull: Hull, within: Fraction, name: str) -> Joined:
    try:
        return join(mesh(hull), within)
    except CoplanarError as error:
        raise CoplanarError(f"{name}: {error}") from None


def _far(closed: _Closed, hull: Hull, joined: Joined) -> int | None:
    """Return the index of a face that is not within the allowed distance of the plane of any merged face, or None."""
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
        # The merged face is usually one of those at the face's own vertices.
        tried = set[int]().union(*(around.get(place, ()) for place in polygon))
        if not lies(polygon, tried) and not lies(polygon, range(len(planes))):
            return order
    return None


def polyhedron_of_hull(hull: Hull, name: str, joined: Joined | None = None) -> Polyhedron:
    """Convert an exact hull, which is proved to be convex, to a polyhedron of a scene. A polygon becomes a plate.

    ``joined`` tells which faces are drawn as one face. Raise SceneError for a point or a segment.
    """
    surface = mesh(hull)
    if surface.dimension < 2:
        raise SceneError(
            f"{name}: a {('point', 'segment')[surface.dimension]} is not a polyhedron; expected points not on one line"
        )
    faces = tuple(face[::-1] for face in surface.faces)
    if surface.dimension == 2:
        faces = (faces[0], surface.faces[0])
    return Polyhedron(name, surface.numbers(), faces, joined=() if joined is None else joined.group_of())

"""Read the parts of a scene file: shapes, solids from other files, their placement, and figures on their faces."""

import itertools
import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial

from emulator.errors import EmulatorError, quoted
from emulator.files import POINTS_LIMIT, read_bytes
from modern.geometry.coplanar import parse_distance
from modern.geometry.vectors import Vector, cross, dot, minus
from modern.papers.nakamae_nishita import shapes
from modern.papers.nakamae_nishita.bodies import Reading, read_bodies
from modern.papers.nakamae_nishita.fields import Fields
from modern.papers.nakamae_nishita.polyhedron import Figure, Polyhedron, SceneError, checked, outward
from modern.papers.nakamae_nishita.shapes import moved, placed, scaled, turned

_ZERO: Vector = (Fraction(0), Fraction(0), Fraction(0))
# The greatest number of polyhedra that one part may define.
MOST = 20_000


@dataclass(frozen=True, slots=True)
class Part:
    """A shape, its placement in the scene, and the number of its copies.

    ``place`` names the part in messages. The function ``build`` creates the shape at the origin with the name that it
    receives. ``thing`` names the object to which all copies belong. ``figures`` are in the coordinates of the shape.
    The shape is multiplied by ``scale``, then rotated by ``turn`` degrees about the z axis, then moved by ``at``.
    ``count`` has the numbers of copies along x, y and z, and ``step`` has the distances between them.
    """

    place: str
    build: Callable[[str], Polyhedron]
    thing: str = ""
    figures: tuple[tuple[Vector, ...], ...] = ()
    scale: Fraction = Fraction(1)
    turn: Fraction = Fraction(0)
    at: Vector = _ZERO
    count: tuple[int, ...] = (1, 1, 1)
    step: Vector = _ZERO


@dataclass(frozen=True, slots=True)
class Parts:
    """The contents of one table of a scene file: parts, the path of their file or "", and notes for the user."""

    parts: tuple[Part, ...]
    file: str = ""
    notes: tuple[str, ...] = ()


def part(fields: Fields, folder: str = "") -> Parts:
    """Return the parts that one table of a scene file defines. Paths of files are relative to ``folder``.

    Raise EmulatorError if a field or a file is invalid.
    """
    name = fields.text("name", "")
    place = f"{fields.place} ({name})" if name else fields.place
    if "file" in fields:
        if "shape" in fields:
            raise fields.wrong("file", "expected a shape or a file, found both")
        made = _from_file(fields, folder, place)
    else:
        name_of_shape = fields.text("shape", "")
        if name_of_shape not in _SHAPES:
            raise fields.wrong("shape", f"{quoted(name_of_shape)} is not one of {', '.join(_SHAPES)}")
        made = Parts((Part(place, _SHAPES[name_of_shape](fields)),))
    count = fields.whole("count", 3) or (1, 1, 1)
    if min(count) < 1 or count[0] * count[1] * count[2] * len(made.parts) > MOST:
        raise fields.wrong("count", f"expected at least 1 copy along each axis and at most {MOST:,} in all")
    step = fields.vector("step")
    if max(count) > 1 and step is None:
        raise fields.wrong("step", "several copies need the field step, the distance between them")
    scale = fields.number("scale")
    if scale is not None and scale <= 0:
        raise fields.wrong("scale", "expected a number greater than 0")
    figures = fields.polygons("figures")
    if figures and len(made.parts) > 1:
        raise fields.wrong("figures", f"figures need one connected component, but the file has {len(made.parts)}")
    thing, turn, at = fields.text("object", ""), fields.number("turn"), fields.vector("at")
    fields.done()
    # The components of a file are placed together, as one shape would be.
    sized = (figures, scale or Fraction(1), turn or Fraction(0), at or _ZERO, count, step or _ZERO)
    return replace(made, parts=tuple(Part(shape.place, shape.build, thing, *sized) for shape in made.parts))


def _from_file(fields: Fields, folder: str, place: str) -> Parts:
    """Return the connected components of a file with faces, or with ``hull = true`` the hull of a file of points."""
    path = fields.text("file", "")
    within = fields.take("coplanar_within")
    hull = fields.flag("hull")
    try:
        limit = None if within is None else parse_distance(within)
        location = os.path.join(folder, path) if path else path
        bodies = read_bodies(read_bytes(location, path, POINTS_LIMIT), path, Reading(hull, limit))
    except EmulatorError as error:
        raise SceneError(f"{place}: file: {error}") from None
    parts = tuple(Part(f"{place}{solid.name.removeprefix(path)}", partial(named, solid)) for solid in bodies.polyhedra)
    return Parts(parts, location, tuple(f"{place}: {note}" for note in bodies.notes))


def named(polyhedron: Polyhedron, name: str) -> Polyhedron:
    return replace(polyhedron, name=name)


def make(item: Part) -> Iterator[Polyhedron]:
    """Yield all copies of a part, each at its place in the scene. Raise SceneError for an invalid shape or figure."""
    shape = item.build(item.place)
    figures = tuple(_figure(item.place, shape, corners) for corners in item.figures)
    shape = replace(shape, thing=item.thing, figures=figures)
    if item.scale != 1 or item.turn:
        shape = placed(placed(shape, scaled(item.scale), item.place), turned(item.turn), item.place)
    for place in itertools.product(*map(range, item.count)):
        x, y, z = (start + k * step for start, k, step in zip(item.at, place, item.step, strict=True))
        copy = f", copy {','.join(str(k + 1) for k in place)}" if max(item.count) > 1 else ""
        yield placed(shape, moved((x, y, z)), item.place + copy)


def _figure(place: str, shape: Polyhedron, corners: tuple[Vector, ...]) -> Figure:
    """Return a figure with the index of the face that contains all its corners. Raise SceneError if there is none."""
    if len(corners) < 3:
        raise SceneError(f"{place}: figures: expected at least 3 corners, found {len(corners)}")
    for order, face in enumerate(shape.faces):
        # All corners must lie in the plane of the face and on the inner side of each of its sides.
        normal = outward(shape, face)
        points = [shape.vertices[k] for k in face]
        sides = list(zip(points, [*points[1:], points[0]], strict=True))
        if all(
            not dot(normal, minus(corner, points[0]))
            and all(dot(normal, cross(minus(q, p), minus(corner, p))) <= 0 for p, q in sides)
            for corner in corners
        ):
            return Figure(order, corners)
    raise SceneError(f"{place}: figures: expected all corners of a figure in one face; no face contains them")


def _cuboid(fields: Fields) -> Callable[[str], Polyhedron]:
    size = fields.vector("size")
    if size is None:
        raise fields.wrong("size", "a cuboid needs the lengths of its sides")
    return partial(shapes.cuboid, x=size[0], y=size[1], z=size[2])


def _parallelepiped(fields: Fields) -> Callable[[str], Polyhedron]:
    edges = fields.vectors("edges") or ()
    if len(edges) != 3:
        raise fields.wrong("edges", f"expected 3 edges of a parallelepiped, found {len(edges)}")
    return partial(shapes.parallelepiped, a=edges[0], b=edges[1], c=edges[2])


def _column(fields: Fields) -> Callable[[str], Polyhedron]:
    base, sides, radius = fields.vectors("base", flat=True), fields.count("sides"), fields.number("radius")
    along, height = fields.vector("along"), fields.number("height")
    if (base is None) == (sides is None) or (sides is None) != (radius is None):
        raise fields.wrong("base", "a column needs either a base, or a number of sides and a radius")
    if (along is None) == (height is None):
        raise fields.wrong("height", "a column needs either a height, or the vector along which it rises")
    rise = along or (Fraction(0), Fraction(0), height or Fraction(0))
    if sides is not None and radius is not None:
        base = tuple(shapes.round_base(fields.place, sides, radius))
    return partial(shapes.column, base=base or (), along=rise)


def _polyhedron(fields: Fields) -> Callable[[str], Polyhedron]:
    vertices, faces = fields.vectors("vertices") or (), fields.counts("faces")
    if not all(1 <= place <= len(vertices) for face in faces for place in face):
        raise fields.wrong("faces", f"expected vertex numbers from 1 to {len(vertices)}")
    from_zero = tuple(tuple(place - 1 for place in face) for face in faces)
    return lambda name: checked(Polyhedron(name, vertices, from_zero))


_SHAPES: dict[str, Callable[[Fields], Callable[[str], Polyhedron]]] = {
    "cuboid": _cuboid,
    "parallelepiped": _parallelepiped,
    "column": _column,
    "plate": lambda fields: partial(shapes.plate, corners=fields.vectors("corners", flat=True) or ()),
    "polyhedron": _polyhedron,
}

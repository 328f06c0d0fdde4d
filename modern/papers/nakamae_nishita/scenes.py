"""Read scene files: TOML files that list parts, each with a standard shape and its placement (section 2 of the paper).

All numbers are exact: integers, decimals, or fractions as text, such as "1/3". ``docs/papers/nakamae_nishita.md``
describes the format. The project's own scenes are in the folder ``scenes`` and are selected by name.
"""

import os
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from importlib.resources import files
from typing import Final, Literal

from emulator.errors import quoted
from emulator.files import parse_toml, read_text, source_name
from modern.drawing.view import EYES, choose
from modern.geometry.numbers import number
from modern.geometry.vectors import Vector
from modern.papers.nakamae_nishita.fields import Fields
from modern.papers.nakamae_nishita.parts import Part, make, named, part
from modern.papers.nakamae_nishita.polyhedron import Polyhedron, SceneError, outward
from modern.papers.nakamae_nishita.projection import Observer, parallel, perspective

Projection = Literal["parallel", "perspective"]
PARALLEL: Final = "parallel"
PERSPECTIVE: Final = "perspective"
_AT = re.compile(r"(.*) \(at (?:line (\d+), column (\d+)|end of document)\)", re.DOTALL)


@dataclass(frozen=True, slots=True)
class Sight:
    """The view of a scene.

    ``eye`` is the direction to the eye, or in perspective the observation point. In perspective, ``towards`` is the
    point looked at (by default the centre of the scene), and ``near`` is the distance of the near plane, if there is
    one.
    """

    eye: Vector
    projection: Projection = PARALLEL
    towards: Vector | None = None
    near: Fraction | None = None

    def observer(self, make: Callable[[], Sequence[Polyhedron]]) -> Observer:
        """Return the observer. The function ``make`` creates the polyhedra, if the centre of the scene is needed.

        Raise SceneError if the direction of view is 0,0,0.
        """
        if self.projection == PARALLEL:
            return parallel(self.eye)
        return perspective(self.eye, self.towards or _middle(make()), self.near)


@dataclass(frozen=True, slots=True)
class SceneFile:
    """A scene as read from a file. ``make`` creates its polyhedra, which is the first of the paper's three steps.

    ``files`` lists the files of the scene's parts, and ``notes`` are notes for the user on these files.
    """

    source: str
    title: str
    sight: Sight
    parts: tuple[Part, ...]
    files: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()

    def make(self) -> tuple[Polyhedron, ...]:
        """Create the polyhedra. Raise SceneError for a part that is not a convex polyhedron."""
        return tuple(polyhedron for part in self.parts for polyhedron in make(part))


DEFAULT_EYE: Vector = (Fraction(EYES[0][0]), Fraction(EYES[0][1]), Fraction(EYES[0][2]))


def names() -> tuple[str, ...]:
    folder = files("modern.papers.nakamae_nishita").joinpath("scenes")
    return tuple(sorted(item.name[:-5] for item in folder.iterdir() if item.name.endswith(".toml")))


def scene(name: str) -> SceneFile:
    """Return the project's own scene with this name. Raise SceneError if it does not exist."""
    if name not in names():
        raise SceneError(f"{quoted(name)} is not a scene of the project; its scenes are {', '.join(names())}")
    text = files("modern.papers.nakamae_nishita").joinpath("scenes", f"{name}.toml").read_text(encoding="utf-8")
    return parse(text, name)


def read(path: str) -> SceneFile:
    """Read a scene from a file. Paths in the file are relative to its folder.

    Raise FileError if the file cannot be read, and SceneError, with the position of the fault, if the scene is invalid.
    """
    return parse(read_text(path), source_name(path), os.path.dirname(path))


def of_polyhedra(polyhedra: Sequence[Polyhedron], title: str, notes: Sequence[str] = ()) -> SceneFile:
    """Return a scene of the given polyhedra, seen from a direction that shows their faces and vertices clearly."""
    # Two solids that touch may have a vertex in common.
    points = list(dict.fromkeys(point for polyhedron in polyhedra for point in polyhedron.vertices))
    eye = choose(points, [outward(polyhedron, face) for polyhedron in polyhedra for face in polyhedron.faces])
    sight = Sight((Fraction(eye[0]), Fraction(eye[1]), Fraction(eye[2])))
    parts = (Part(polyhedron.name, partial(named, polyhedron)) for polyhedron in polyhedra)
    return SceneFile(title, title, sight, tuple(parts), notes=tuple(notes))


def parse(text: str, source: str, folder: str = "") -> SceneFile:
    """Return the scene in the text of a scene file. Paths in the text are relative to ``folder``.

    Raise SceneError if the text is invalid.
    """
    try:
        # TOML floats are read as exact decimals. TOML allows underscores between digits.
        data = parse_toml(text, lambda decimal: number(decimal.replace("_", "")))
    except ValueError as error:
        raise SceneError(_located(source, text, str(error))) from None
    fields = Fields(data, source)
    title = fields.text("title", "")
    sight = _sight(Fields(fields.table("view"), f"{source}: view"))
    tables = fields.tables("part")
    fields.done()
    if not tables:
        raise SceneError(f"{source}: expected at least one part, found none")
    entries = [part(Fields(table, f"{source}: part {k}"), folder) for k, table in enumerate(tables, 1)]
    parts = tuple(item for entry in entries for item in entry.parts)
    paths = tuple(entry.file for entry in entries if entry.file)
    return SceneFile(source, title, sight, parts, paths, tuple(note for entry in entries for note in entry.notes))


def _sight(fields: Fields) -> Sight:
    eye = fields.vector("eye") or DEFAULT_EYE
    named = fields.text("projection", PARALLEL)
    if named not in (PARALLEL, PERSPECTIVE):
        raise fields.wrong("projection", f"{quoted(named)} is neither {PARALLEL} nor {PERSPECTIVE}")
    projection: Projection = PERSPECTIVE if named == PERSPECTIVE else PARALLEL
    towards = fields.vector("towards")
    if towards and projection == PARALLEL:
        raise fields.wrong("towards", "a parallel projection has only a direction, in the field eye")
    if projection == PARALLEL and not any(eye):
        raise fields.wrong("eye", "expected a direction of view other than 0,0,0")
    if towards == eye:
        raise fields.wrong("towards", "expected a point other than the observation point in the field eye")
    near = fields.number("near")
    if near is not None and projection == PARALLEL:
        raise fields.wrong("near", "a parallel projection has no near plane")
    if near is not None and near <= 0:
        raise fields.wrong("near", "expected a distance greater than 0")
    fields.done()
    return Sight(eye, projection, towards, near)


def _middle(polyhedra: Sequence[Polyhedron]) -> Vector:
    columns = list(zip(*(point for polyhedron in polyhedra for point in polyhedron.vertices), strict=True))
    x, y, z = ((min(column) + max(column)) / 2 for column in columns)
    return x, y, z


def _located(source: str, text: str, message: str) -> str:
    match = _AT.fullmatch(message)
    if not match:
        return f"{source}: {message}"
    line, column = (match[2], match[3]) if match[2] else (text.count("\n") + 1, len(text) - text.rfind("\n"))
    return f"{source}: line {line}, column {column}: {match[1][:1].lower()}{match[1][1:]}"

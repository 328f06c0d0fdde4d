"""A hull for other programs: as text in any format there is, or as a ``trimesh.Trimesh``.

OFF, OBJ and PLY keep the faces as polygons, STL cuts them into triangles; JSON keeps everything.  The vertices of a
mesh are those of ``Hull.vertices``, in that order; boundary and inside points are in JSON only.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

from emulator.files import write_text
from modern.formats import HULLS, MESHES, html, json
from modern.geometry.hull import Hull
from modern.geometry.mesh import ExportError, Mesh, mesh


def export_text(hull: Hull, form: str, digits: int | None = None) -> str:
    """The hull as the text of a file in one of ``HULLS``.

    digits: significant digits to round those coordinates to that have no finite decimal; None refuses them.  All
    other coordinates stay exact, and JSON keeps fractions.  Raises ExportError.
    """
    if form == "json":
        return json.write(hull)
    return html.write(mesh(hull), digits) if form == "html" else mesh_text(mesh(hull), form, digits)


def mesh_text(surface: Mesh, form: str, digits: int | None = None) -> str:
    """A surface as the text of a file in one of ``MESHES``.

    digits: as of ``export_text``.  Raises ExportError.
    """
    if form not in MESHES:
        raise ExportError(f"{form!r} is not a format of a mesh; they are {', '.join(MESHES)}")
    text: str = import_module(f"modern.formats.{form}").write(surface, digits)
    return text


def format_of(path: str) -> str:
    """The format a file's name ends with.  Raises ExportError."""
    ending = path.rpartition(".")[2].lower() if "." in path else ""
    if ending not in HULLS:
        raise ExportError(f"{path}: the name must end with one of {', '.join('.' + form for form in HULLS)}")
    return ending


def write_hull(hull: Hull, path: str, form: str | None = None, digits: int | None = None) -> None:
    """Write a hull to a file (``-``: standard output), whole or not at all.

    form: one of ``HULLS``; None takes it from the file's name.  Raises ExportError, and FileError where the file
    cannot be written.
    """
    write_text(path, export_text(hull, form or format_of(path), digits))


def to_trimesh(hull: Hull) -> Any:
    """A ``trimesh.Trimesh`` of the hull's vertices in their order and its faces cut into triangles.

    Coordinates are rounded to the nearest binary float; nothing is merged or reordered (``process=False``).
    Raises ExportError where trimesh is not installed, for a hull without area and for numbers too large for a float.
    """
    surface = mesh(hull)
    if surface.dimension < 2:
        raise ExportError(f"a Trimesh holds triangles; the hull has dimension {surface.dimension} and no area")
    try:
        trimesh = import_module("trimesh")
    except ImportError:
        raise ExportError("to_trimesh needs trimesh: pip install 'hull1620[mesh]'") from None
    import numpy as np  # here, so that no other format waits for it

    try:
        vertices = np.array([[float(number) for number in point] for point in surface.numbers()], dtype=np.float64)
    except OverflowError:
        raise ExportError("a coordinate is too large for a binary float") from None
    return trimesh.Trimesh(vertices=vertices, faces=np.array(surface.triangles(), dtype=np.int64), process=False)

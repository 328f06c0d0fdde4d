"""Hulls in the formats of other programs: OFF, OBJ, PLY and STL as text with exact decimals, and JSON.

OFF, OBJ and PLY keep the faces as polygons, STL cuts them into triangles; JSON keeps everything.  The vertices of a
mesh are those of ``Hull.vertices``, in that order; boundary and inside points are in JSON only.
"""

from __future__ import annotations

from emulator.files import write_text
from modern.formats import json as document
from modern.formats import obj, off, ply, stl
from modern.formats.off import OffMesh, parse_off, read_off
from modern.formats.trimesh import to_trimesh
from modern.geometry.hull import Hull
from modern.geometry.mesh import ExportError, Mesh, mesh

__all__ = [
    "FORMATS",
    "ExportError",
    "Mesh",
    "OffMesh",
    "export_text",
    "format_of",
    "mesh",
    "mesh_text",
    "parse_off",
    "read_off",
    "to_trimesh",
    "write_hull",
]

_MESHES = {"off": off.write, "obj": obj.write, "ply": ply.write, "stl": stl.write}
FORMATS = (*_MESHES, "json")


def export_text(hull: Hull, form: str, digits: int | None = None) -> str:
    """The hull as the text of a file in one of ``FORMATS``.

    digits: significant digits to round those coordinates to that have no finite decimal; None refuses them.  All
    other coordinates stay exact, and JSON keeps fractions.  Raises ExportError.
    """
    return document.write(hull) if form == "json" else mesh_text(mesh(hull), form, digits)


def mesh_text(surface: Mesh, form: str, digits: int | None = None) -> str:
    """A surface as the text of a file in one of ``FORMATS`` but JSON, which needs a ``Hull``.

    digits: as of ``export_text``.  Raises ExportError.
    """
    if form not in _MESHES:
        raise ExportError(f"{form!r} is not a format of a mesh; they are {', '.join(_MESHES)}")
    return _MESHES[form](surface, digits)


def format_of(path: str) -> str:
    """The format a file's name ends with.  Raises ExportError."""
    ending = path.rpartition(".")[2].lower() if "." in path else ""
    if ending not in FORMATS:
        raise ExportError(f"{path}: the name must end with one of {', '.join('.' + form for form in FORMATS)}")
    return ending


def write_hull(hull: Hull, path: str, form: str | None = None, digits: int | None = None) -> None:
    """Write a hull to a file (``-``: standard output), whole or not at all.

    form: one of ``FORMATS``; None takes it from the file's name.  Raises ExportError, and FileError where the file
    cannot be written.
    """
    write_text(path, export_text(hull, form or format_of(path), digits))

"""Export a hull to other programs, as text in any of the formats or as a ``trimesh.Trimesh``.

OFF, OBJ and PLY preserve the faces as polygons.  STL splits the faces into triangles.  JSON has all data of a hull.
The vertices of a mesh are those of ``Hull.vertices``, in that order.  Only JSON also contains the boundary and inside
points of the hull.
"""

from importlib import import_module
from typing import Any

from emulator.errors import quoted
from emulator.files import write_text
from modern.formats import HULLS, MESHES, html, json
from modern.geometry.hull import Hull
from modern.geometry.mesh import ExportError, Mesh, mesh


def export_text(hull: Hull, form: str, digits: int | None = None) -> str:
    """Return the text of a file in one of the formats ``HULLS``.

    Except in JSON, a coordinate without a finite decimal expansion is rounded to ``digits`` digits, or raises
    ExportError if ``digits`` is None.
    """
    if form == "json":
        return json.write(hull)
    return html.write(mesh(hull), digits) if form == "html" else mesh_text(mesh(hull), form, digits)


def mesh_text(surface: Mesh, form: str, digits: int | None = None) -> str:
    """Return a surface as the text of a file in one of the formats ``MESHES``.

    ``digits`` has the same meaning as in ``export_text``.
    """
    if form not in MESHES:
        raise ExportError(f"{quoted(form)} is not a mesh format; the formats are {', '.join(MESHES)}")
    text: str = import_module(f"modern.formats.{form}").write(surface, digits)
    return text


def format_of(path: str) -> str:
    """Return the format that the extension of a file name denotes.  Raise ExportError for an unknown extension."""
    extension = path.rpartition(".")[2].lower() if "." in path else ""
    if extension not in HULLS:
        raise ExportError(f"{path}: the name must end with one of {', '.join('.' + form for form in HULLS)}")
    return extension


def write_hull(hull: Hull, path: str, form: str | None = None, digits: int | None = None) -> None:
    """Write a hull to a file, or to standard output for ``-``, in the format ``form``, or else that of the extension.

    An existing file is replaced only after all of the text was written.  Raise ExportError if the format cannot hold
    the hull, and FileError if the file cannot be written.
    """
    write_text(path, export_text(hull, form or format_of(path), digits))


def to_trimesh(hull: Hull) -> Any:
    """Return a ``trimesh.Trimesh`` with the vertices in order, rounded to floats, and faces split into triangles.

    Raise ExportError if trimesh is not installed, for a hull without area, and for a number too large for a float.
    """
    surface = mesh(hull)
    if surface.dimension < 2:
        raise ExportError(f"a Trimesh holds triangles; the hull has dimension {surface.dimension} and no area")
    try:
        trimesh = import_module("trimesh")
    except ImportError:
        raise ExportError("to_trimesh needs trimesh: pip install 'hull1620[mesh]'") from None
    import numpy as np  # not at the top, because no other format needs it

    try:
        vertices = np.array([[float(number) for number in point] for point in surface.numbers()], dtype=np.float64)
    except OverflowError:
        raise ExportError("a coordinate is too large for a binary float") from None
    return trimesh.Trimesh(vertices=vertices, faces=np.array(surface.triangles(), dtype=np.int64), process=False)

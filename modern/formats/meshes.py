"""Read surfaces, points with faces, from OFF, OBJ, PLY and STL files, of which PLY and STL may be binary.

The readers do not check that the faces close.  Equal corners of an STL file are one point; every vertex of OFF, OBJ and
PLY is a separate point.
"""

from emulator.errors import FileError
from emulator.files import decoded
from modern.formats import MESHES, obj, off, ply, stl
from modern.formats.points import kind_of
from modern.formats.tokens import FileMesh


def surface_kind(data: bytes, source: str) -> str:
    """Return the format of a file if it is one of ``MESHES``, or "" if it is a format of points without faces.

    Raise FileError if the format is unknown.
    """
    kind = kind_of(data, source)
    return kind if kind in MESHES else ""


def parse_mesh(data: bytes, source: str) -> FileMesh:
    """Return the surface in a file, which may have no faces.  Raise FileError if it is not OFF, OBJ, PLY or STL."""
    kind = surface_kind(data, source)
    if not kind:
        raise FileError(f"{source}: expected faces in OFF, OBJ, PLY or STL; this file holds only points")
    if kind == "ply":
        return ply.surface(data, source)
    if kind == "stl" and stl.is_binary(data):
        return stl.surface_binary(data, source)
    reader = {"off": off.parse_off, "obj": obj.surface, "stl": stl.surface}[kind]
    return reader(decoded(data, source), source)

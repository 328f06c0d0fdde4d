"""Surfaces from files: OFF, OBJ and STL, in text or binary, told apart as points are (``modern.formats.points``).

What is read is what stands there: points, and faces that name them.  Whether the faces close, and what they enclose,
is for who uses them to say.  Of an STL file equal corners are one point; of OFF and OBJ every vertex is its own.
"""

from __future__ import annotations

from emulator.errors import FileError
from emulator.files import decoded
from modern.formats import obj, off, stl
from modern.formats.points import recognise
from modern.formats.tokens import FileMesh

SURFACES = ("off", "obj", "stl")
"""Kinds of file that faces are read from, of those that points are read from."""


def kind_of(data: bytes, source: str) -> str:
    """Which of ``SURFACES`` a file is, empty where it is none (a list of points, a deck).

    Raises FileError where it is nothing that is read.
    """
    if stl.is_binary(data):
        return "stl"
    if data.startswith((b"\x93NUMPY", b"ply\n", b"ply\r")):
        return ""
    kind = recognise(decoded(data, source), source)
    return kind if kind in SURFACES else ""


def parse_mesh(data: bytes, source: str) -> FileMesh:
    """The surface in a file's bytes; it may have no faces.  Raises FileError for a file of another kind."""
    kind = kind_of(data, source)
    if not kind:
        raise FileError(f"{source}: faces are read from OFF, OBJ and STL; this holds points only, or is another file")
    if kind == "stl" and stl.is_binary(data):
        return stl.surface_binary(data, source)
    reader = {"off": off.parse_off, "obj": obj.surface, "stl": stl.surface}[kind]
    return reader(decoded(data, source), source)

"""OBJ, the Wavefront object file: polygons and decimal text, both kept.

A polyhedron is written with its faces (``f``), a polygon with one, a segment as a line (``l``), a point as ``p``.
Read are its vertices (``v``), x y z and whatever follows them: a weight, a colour.
"""

from __future__ import annotations

from modern.formats.words import error, lines, point
from modern.geometry.mesh import Mesh
from modern.geometry.numbers import Point

KEYWORDS = frozenset(("v", "vn", "vt", "vp", "f", "l", "p", "o", "g", "s", "mtllib", "usemtl"))
"""Words that may begin the first line of an OBJ file."""


def write(mesh: Mesh, digits: int | None = None) -> str:
    """The text of an OBJ file; vertices count from 1, as the programs number them.  Raises ExportError."""
    lines = [f"v {point}" for point in mesh.decimals(digits)]
    elements = {0: ["p 1"], 1: ["l 1 2"]}
    lines += elements.get(mesh.dimension) or [
        " ".join(("f", *(str(place + 1) for place in face))) for face in mesh.faces
    ]
    return "".join(line + "\n" for line in lines)


def parse(text: str, source: str) -> tuple[tuple[Point, ...], tuple[int, ...]]:
    """The vertices of an OBJ file, as the text that stands there, and the line of each.

    Raises FileError, with line and column, for a vertex that is not three decimals.
    """
    points: list[Point] = []
    places: list[int] = []
    for line, words in lines(text):
        if words[0][0] != "v":
            continue
        if len(words) < 4:
            raise error(source, line, words[-1], f"a vertex is three numbers, x y z; here are {len(words) - 1}")
        points.append(point(source, line, words[1:4]))
        places.append(line)
    return tuple(points), tuple(places)

"""OBJ, the Wavefront object file: polygons and decimal text, both kept.

A polyhedron is written with its faces (``f``), a polygon with one, a segment as a line (``l``), a point as ``p``.
Read are its vertices (``v``), x y z and whatever follows them (a weight, a colour), and for a surface its faces; a
vertex of a face is counted from 1, or back from the last one with a minus, and what follows it after a slash is passed
over.
"""

from __future__ import annotations

import re

from modern.formats.tokens import FileMesh, Word, error, lines, point
from modern.geometry.mesh import Mesh
from modern.geometry.numbers import Point, quoted

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


def surface(text: str, source: str) -> FileMesh:
    """The vertices and faces of an OBJ file.

    Raises FileError, with line and column, for a vertex that is not three decimals and a face of vertices that are not
    there.
    """
    points, places = parse(text, source)
    faces = []
    known = 0
    for line, words in lines(text):
        if words[0][0] == "v":
            known += 1
        elif words[0][0] == "f":
            faces.append(tuple(_corner(source, line, word, known, len(points)) for word in words[1:]))
            if not faces[-1]:
                raise error(source, line, words[0], "a face has at least one vertex")
    return FileMesh(source, points, places, tuple(faces))


def _corner(source: str, line: int, word: Word, known: int, count: int) -> int:
    """A vertex of a face by place; one counted back is counted from the ``known`` ones before the face."""
    found = re.fullmatch(r"(-?)([0-9]{1,9})(?:/-?[0-9]*){0,2}", word[0])
    if not found:
        raise error(source, line, word, f"{quoted(word[0])} is not a vertex of a face")
    place = known - int(found[2]) if found[1] else int(found[2]) - 1
    if not 0 <= place < (known if found[1] else count):
        raise error(source, line, word, f"there is no vertex {quoted(word[0])}; they count from 1 to {count}")
    return place

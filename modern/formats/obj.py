"""Write and read the Wavefront OBJ format, which preserves polygons and the decimal text of coordinates.

A polyhedron is written with its faces (``f``), a polygon with one face, a segment as a line (``l``), a point as ``p``.
The readers ignore anything after the x, y and z of a vertex (``v``), such as a weight or a colour.  A face names its
vertices by their numbers, counted from 1, or by negative numbers, counted backwards from -1, which is the last vertex
before the face.  The readers ignore anything after a slash in a face.
"""

import re

from emulator.errors import quoted
from modern.formats.tokens import FileMesh, Token, error, lines, vertex
from modern.geometry.mesh import Mesh
from modern.geometry.numbers import Point

# The keywords with which an OBJ file may begin.
KEYWORDS = frozenset(("v", "vn", "vt", "vp", "f", "l", "p", "o", "g", "s", "mtllib", "usemtl"))


def write(mesh: Mesh, digits: int | None = None) -> str:
    """Return the text of an OBJ file.  Raise ExportError if a coordinate cannot be written."""
    lines = [f"v {point}" for point in mesh.decimals(digits)]
    elements = {0: ["p 1"], 1: ["l 1 2"]}
    lines += elements.get(mesh.dimension) or [
        " ".join(("f", *(str(index + 1) for index in face))) for face in mesh.faces
    ]
    return "".join(line + "\n" for line in lines)


def parse(text: str, source: str) -> tuple[tuple[Point, ...], tuple[int, ...]]:
    """Return the vertices as text, and the line of each vertex.  Raise FileError for an invalid vertex."""
    vertices = [(vertex(source, line, tokens, 1, True), line) for line, tokens in lines(text) if tokens[0][0] == "v"]
    return tuple(point for point, _ in vertices), tuple(line for _, line in vertices)


def surface(text: str, source: str) -> FileMesh:
    """Return the vertices and faces.  Raise FileError for an invalid vertex, or if a face names a missing vertex."""
    points, point_lines = parse(text, source)
    faces = []
    vertices_before = 0
    for line, tokens in lines(text):
        if tokens[0][0] == "v":
            vertices_before += 1
        elif tokens[0][0] == "f":
            faces.append(tuple(_corner(source, line, token, vertices_before, len(points)) for token in tokens[1:]))
            if not faces[-1]:
                raise error(source, line, tokens[0], "a face needs at least one vertex")
    return FileMesh(source, points, point_lines, tuple(faces))


def _corner(source: str, line: int, token: Token, vertices_before: int, count: int) -> int:
    """Return the index of a vertex of a face.  A negative number counts back from the last vertex before the face."""
    match = re.fullmatch(r"(-?)([0-9]{1,9})(?:/-?[0-9]*){0,2}", token[0])
    if not match:
        raise error(source, line, token, f"{quoted(token[0])} is not the number of a vertex")
    index = vertices_before - int(match[2]) if match[1] else int(match[2]) - 1
    if not 0 <= index < (vertices_before if match[1] else count):
        raise error(source, line, token, f"there is no vertex {quoted(token[0])}; they are numbered from 1 to {count}")
    return index

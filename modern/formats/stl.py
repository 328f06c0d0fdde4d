"""ASCII STL (3D Systems, "StereoLithography Interface Specification", 1989): triangles only.

A face is cut into triangles from its first vertex.  Corners are exact decimal text, the same text for the same
vertex; normals, which have no finite decimal, are cut to nine decimals.  A polygon becomes a sheet of triangles with
one side; a segment and a point have no area and are refused.  Read are the corners of triangles, in text or binary,
each point once, in order of appearance: a format that repeats every vertex in every triangle does not mean
duplicates; for a surface also which corners make a triangle.
"""

from __future__ import annotations

import math
import struct
from fractions import Fraction

from emulator.errors import FileError
from modern.formats.tokens import FileMesh, Word, error, lines, point
from modern.geometry.mesh import ExportError, Mesh
from modern.geometry.numbers import Point, coordinates, float_text
from modern.geometry.vectors import Vector, cross, dot, minus

_PLACES = 9
_HEAD, _TRIANGLE = 84, 50


def write(mesh: Mesh, digits: int | None = None) -> str:
    """The text of an STL file.  Raises ExportError for a hull without area."""
    if mesh.dimension < 2:
        what = ("a point", "a segment")[mesh.dimension]
        raise ExportError(f"STL holds triangles; the hull is {what} and has no area")
    points, texts = mesh.numbers(), mesh.decimals(digits)
    lines = ["solid hull1620"]
    for a, b, c in mesh.triangles():
        normal = cross(minus(points[b], points[a]), minus(points[c], points[a]))
        lines += [f"facet normal {unit_text(normal)}", "outer loop"]
        lines += [f"vertex {texts[place]}" for place in (a, b, c)]
        lines += ["endloop", "endfacet"]
    lines.append("endsolid hull1620")
    return "".join(line + "\n" for line in lines)


def unit_text(vector: Vector) -> str:
    """The vector at length 1, three numbers of nine decimals, cut; zero stays zero.  No binary float is used."""
    square = dot(vector, vector)
    return " ".join(_quotient(component, square) for component in vector)


def _quotient(component: Fraction, square: Fraction) -> str:
    ratio = component * component / square if square else Fraction(0)
    size = math.isqrt(ratio.numerator * 10 ** (2 * _PLACES) // ratio.denominator)
    whole, fraction = divmod(size, 10**_PLACES)
    text = f"{whole}.{fraction:0{_PLACES}d}".rstrip("0").rstrip(".")
    return f"-{text}" if component < 0 and text != "0" else text


def is_binary(data: bytes) -> bool:
    """Whether bytes are a binary STL file, by the number of triangles they announce."""
    return len(data) >= _HEAD and len(data) == _HEAD + _TRIANGLE * int(struct.unpack_from("<I", data, _HEAD - 4)[0])


def parse_binary(data: bytes, source: str) -> tuple[tuple[Point, ...], tuple[int, ...]]:
    """The corners of a binary STL file, singles taken exactly, and the triangle each is first met in, from 1.

    Raises FileError for a coordinate that is not finite.
    """
    found = surface_binary(data, source)
    return found.points, found.lines


def surface_binary(data: bytes, source: str) -> FileMesh:
    """The triangles of a binary STL file; see ``parse_binary``."""
    places: dict[Point, int] = {}
    first: list[int] = []
    faces = []
    for number in range(1, (len(data) - _HEAD) // _TRIANGLE + 1):
        values = struct.unpack_from("<9f", data, _HEAD + _TRIANGLE * (number - 1) + 12)
        if not all(map(math.isfinite, values)):
            raise FileError(f"{source}: triangle {number}: a coordinate is not finite")
        texts = [float_text(value) for value in values]
        corners = [places.setdefault((texts[k], texts[k + 1], texts[k + 2]), len(places)) for k in range(0, 9, 3)]
        first += [number] * (len(places) - len(first))
        faces.append(tuple(corners))
    return FileMesh(source, tuple(places), tuple(first), tuple(faces))


def parse(text: str, source: str) -> tuple[tuple[Point, ...], tuple[int, ...]]:
    """The corners of an STL file of text, as the text that stands there, and the line each is first met in.

    Raises FileError, with line and column, for a corner that is not three decimals.
    """
    found: dict[Vector, tuple[Point, int]] = {}
    for line, words in lines(text, ""):
        if words[0][0].lower() == "vertex":
            corner = _vertex(source, line, words)
            found.setdefault(coordinates(corner), (corner, line))
    return tuple(corner for corner, _ in found.values()), tuple(line for _, line in found.values())


def surface(text: str, source: str) -> FileMesh:
    """The triangles of an STL file of text.

    Raises FileError, with line and column, for a corner that is not three decimals and a loop that has not three.
    """
    points, first = parse(text, source)
    places = {coordinates(point): place for place, point in enumerate(points)}
    faces: list[tuple[int, ...]] = []
    loop: list[int] = []
    for line, words in lines(text, ""):
        word = words[0][0].lower()
        if word == "vertex":
            loop.append(places[coordinates(_vertex(source, line, words))])
        elif word in ("endloop", "endfacet", "facet", "outer") and loop:
            if len(loop) != 3:
                raise error(source, line, words[0], f"a triangle ends here after {len(loop)} vertices")
            faces.append(tuple(loop))
            loop = []
    if loop:
        raise error(source, line, words[0], f"the file ends within a triangle, after {len(loop)} of its vertices")
    return FileMesh(source, points, first, tuple(faces))


def _vertex(source: str, line: int, words: list[Word]) -> Point:
    if len(words) != 4:
        raise error(source, line, words[-1], f"a vertex is three numbers, x y z; here are {len(words) - 1}")
    return point(source, line, words[1:])

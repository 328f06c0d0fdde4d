"""Read ASCII and binary STL files, write ASCII ones (3D Systems, "StereoLithography Interface Specification", 1989).

Writing: each face is split into triangles from its first vertex.  The coordinates of a vertex are exact decimals, the
same in each of its triangles.  The components of unit normals are truncated to nine decimals.  A polygon becomes a
one-sided sheet of triangles.  A segment or a point has no area and raises ExportError.

Reading: STL repeats a vertex in each of its triangles, so equal corners become one point, in the order in which they
first appear.
"""

import math
import struct
from fractions import Fraction

from emulator.errors import FileError
from modern.formats.tokens import FileMesh, error, lines, vertex
from modern.geometry.mesh import ExportError, Mesh
from modern.geometry.numbers import Point, coordinates, float_text
from modern.geometry.vectors import Vector, cross, dot, minus

_DECIMALS = 9
# Bytes of the header of a binary file, and of each triangle.
_HEAD, _TRIANGLE = 84, 50


def write(mesh: Mesh, digits: int | None = None) -> str:
    """Return the text of an ASCII STL file.  Raise ExportError for a hull without area."""
    if mesh.dimension < 2:
        kind = ("a point", "a segment")[mesh.dimension]
        raise ExportError(f"STL holds triangles; the hull is {kind} and has no area")
    points, texts = mesh.numbers(), mesh.decimals(digits)
    lines = ["solid hull1620"]
    for a, b, c in mesh.triangles():
        normal = cross(minus(points[b], points[a]), minus(points[c], points[a]))
        lines += [f"facet normal {unit_text(normal)}", "outer loop"]
        lines += [f"vertex {texts[corner]}" for corner in (a, b, c)]
        lines += ["endloop", "endfacet"]
    lines.append("endsolid hull1620")
    return "".join(line + "\n" for line in lines)


def unit_text(vector: Vector) -> str:
    """Return the unit vector in this direction as text, truncated to nine decimals; a zero vector remains zero."""
    square = dot(vector, vector)
    return " ".join(_truncated_quotient(component, square) for component in vector)


def _truncated_quotient(component: Fraction, square: Fraction) -> str:
    """Return ``component / sqrt(square)`` as text, truncated to nine decimals."""
    ratio = component * component / square if square else Fraction(0)
    scaled = math.isqrt(ratio.numerator * 10 ** (2 * _DECIMALS) // ratio.denominator)
    whole, fraction = divmod(scaled, 10**_DECIMALS)
    text = f"{whole}.{fraction:0{_DECIMALS}d}".rstrip("0").rstrip(".")
    return f"-{text}" if component < 0 and text != "0" else text


def is_binary(data: bytes) -> bool:
    """Return True if the length of the data fits the number of triangles in the header of a binary STL file."""
    return len(data) >= _HEAD and len(data) == _HEAD + _TRIANGLE * int(struct.unpack_from("<I", data, _HEAD - 4)[0])


def surface_binary(data: bytes, source: str) -> FileMesh:
    """Return the triangles of a binary STL file, with coordinates as exact decimals.

    The member ``lines`` of the result has for each point the number of its first triangle, from 1.
    """
    indices: dict[Point, int] = {}
    first_triangles: list[int] = []
    faces = []
    for number in range(1, (len(data) - _HEAD) // _TRIANGLE + 1):
        # Each record begins with the normal, three floats, which is ignored.
        values = struct.unpack_from("<9f", data, _HEAD + _TRIANGLE * (number - 1) + 12)
        if not all(map(math.isfinite, values)):
            raise FileError(f"{source}: triangle {number}: a coordinate is not finite")
        texts = [float_text(value) for value in values]
        corners = [indices.setdefault((texts[k], texts[k + 1], texts[k + 2]), len(indices)) for k in range(0, 9, 3)]
        first_triangles += [number] * (len(indices) - len(first_triangles))
        faces.append(tuple(corners))
    return FileMesh(source, tuple(indices), tuple(first_triangles), tuple(faces))


def surface(text: str, source: str, check_triangles: bool = True) -> FileMesh:
    """Return the triangles of an ASCII STL file, with the line in which each corner first appears.

    Raise FileError for an invalid corner and, unless ``check_triangles`` is false, for an ``outer loop`` that does not
    have three corners.
    """
    indices: dict[Vector, int] = {}
    points: list[Point] = []
    first_lines: list[int] = []
    faces: list[tuple[int, ...]] = []
    loop: list[int] = []
    for line, tokens in lines(text, ""):
        keyword = tokens[0][0].lower()
        if keyword == "vertex":
            corner = vertex(source, line, tokens, 1)
            # Corners are equal if their values are: 1 and 1.0 are one point.
            index = indices.setdefault(coordinates(corner), len(points))
            if index == len(points):
                points.append(corner)
                first_lines.append(line)
            loop.append(index)
        elif keyword in ("endloop", "endfacet", "facet", "outer") and loop:
            if len(loop) != 3 and check_triangles:
                raise error(source, line, tokens[0], f"expected a triangle of 3 vertices, found {len(loop)}")
            faces.append(tuple(loop))
            loop = []
    if loop and check_triangles:
        raise error(source, line, tokens[0], f"the file ends after {len(loop)} of 3 vertices of a triangle")
    return FileMesh(source, tuple(points), tuple(first_lines), tuple(faces))

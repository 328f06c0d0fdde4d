"""ASCII STL (3D Systems, "StereoLithography Interface Specification", 1989): triangles only.

A face is cut into triangles from its first vertex.  Corners are exact decimal text, the same text for the same
vertex; normals, which have no finite decimal, are cut to nine decimals.  A polygon becomes a sheet of triangles with
one side; a segment and a point have no area and are refused.
"""

from __future__ import annotations

import math
from fractions import Fraction

from modern.geometry.mesh import ExportError, Mesh
from modern.geometry.vectors import Vector, cross, dot, minus

_PLACES = 9


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

"""ASCII PLY (Turk, "The PLY Polygon File Format", 1994): polygons and decimal text, both kept.

A polyhedron is written with its faces, a polygon with one, a segment as an element ``edge``, a point as one vertex.
The properties are declared ``double``: a reader may round what it reads, the text stays exact.
"""

from __future__ import annotations

from modern.geometry.mesh import Mesh

_UCHAR = 255


def write(mesh: Mesh, digits: int | None = None) -> str:
    """The text of a PLY file.  Raises ExportError."""
    size = "uchar" if all(len(face) <= _UCHAR for face in mesh.faces) else "int"
    lines = ["ply", "format ascii 1.0", f"element vertex {len(mesh.points)}"]
    lines += [f"property double {axis}" for axis in "xyz"]
    lines += [f"element face {len(mesh.faces)}", f"property list {size} int vertex_indices"]
    if mesh.dimension == 1:
        lines += ["element edge 1", "property int vertex1", "property int vertex2"]
    lines += ["end_header", *mesh.decimals(digits)]
    lines += [" ".join(map(str, (len(face), *face))) for face in mesh.faces]
    if mesh.dimension == 1:
        lines.append("0 1")
    return "".join(line + "\n" for line in lines)

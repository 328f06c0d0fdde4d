"""OBJ, the Wavefront object file: polygons and decimal text, both kept.

A polyhedron is written with its faces (``f``), a polygon with one, a segment as a line (``l``), a point as ``p``.
"""

from __future__ import annotations

from modern.geometry.mesh import Mesh


def write(mesh: Mesh, digits: int | None = None) -> str:
    """The text of an OBJ file; vertices count from 1, as the programs number them.  Raises ExportError."""
    lines = [f"v {point}" for point in mesh.decimals(digits)]
    elements = {0: ["p 1"], 1: ["l 1 2"]}
    lines += elements.get(mesh.dimension) or [
        " ".join(("f", *(str(place + 1) for place in face))) for face in mesh.faces
    ]
    return "".join(line + "\n" for line in lines)

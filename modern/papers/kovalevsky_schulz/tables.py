"""The cell list as the paper prints it: Tables 1, 2 and 3, a row each, columns apart by tabs.

And what it costs: how many integers an encoding of a surface needs, by the paper's formulas and as counted (section 4).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction

from modern.papers.kovalevsky_schulz.cells import CellList, IntPoint

VERTEX_HEADING = "Vertex\tCoordinates\tEdges"
EDGE_HEADING = "Edge\tStartP\tEndP\tLeftF\tRightF"
FACE_HEADING = "Face\tn\tPairs (P, L)"


def coordinates(_: int, point: IntPoint) -> str:
    """The coordinates of a vertex as they are; Table 1 has symbols in their place."""
    return str(point)


def vertex_rows(cells: CellList, shown: Callable[[int, IntPoint], str] = coordinates) -> Iterator[str]:
    """Table 1; ``shown``: what stands for the coordinates of a vertex, given its number and point."""
    for number, vertex in enumerate(cells.vertices, 1):
        yield f"{number}\t{shown(number, vertex.point)}\t{_listed(vertex.edges)}"


def edge_rows(cells: CellList) -> Iterator[str]:
    """Table 2."""
    for number, edge in enumerate(cells.edges, 1):
        yield f"{number}\t{edge.start}\t{edge.end}\t{edge.left}\t{edge.right}"


def face_rows(cells: CellList) -> Iterator[str]:
    """Table 3."""
    for number, face in enumerate(cells.faces, 1):
        yield f"{number}\t{len(face.pairs)}\t{_listed(face.pairs)}"


def all_rows(cells: CellList) -> Iterator[str]:
    """The three tables with their headings."""
    yield VERTEX_HEADING
    yield from vertex_rows(cells)
    yield EDGE_HEADING
    yield from edge_rows(cells)
    yield FACE_HEADING
    yield from face_rows(cells)


def _listed(items: Iterable[object]) -> str:
    return ", ".join(map(str, items))


def triangulation_size(triangles: int) -> Fraction:
    """Formula (5): 3 NV + 3 NT = (3/2 + 3) NT, with half as many vertices as triangles."""
    return (Fraction(3, 2) + 3) * triangles


def cell_list_size(vertices: int, faces: int) -> int:
    """Formula (6): 3 NV + 5 NF, with five vertices a face; Table 5 is computed by it."""
    return 3 * vertices + 5 * faces


def economical_size(cells: CellList) -> int:
    """What formula (6) estimates: three coordinates a vertex, and the vertices of every face as they are."""
    return 3 * len(cells.vertices) + sum(len(face.pairs) for face in cells.faces)


def cube_triangles(voxel_faces: int) -> int:
    """Triangles of Marching Cubes on a voxel object whose surface is a sphere of ``voxel_faces`` squares.

    Every square holds one vertex of the triangulation, and Euler's formula gives 2 V - 4 triangles.
    """
    return 2 * voxel_faces - 4

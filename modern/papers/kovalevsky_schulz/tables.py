"""The cell list as the paper prints it, and the size of encodings.

Tables 1, 2 and 3 are lines of cells separated by tabs. The number of integers that an encoding of a surface needs is
computed by the paper's formulas of section 4 and counted exactly.
"""

from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction

from modern.papers.kovalevsky_schulz.cells import CellList, IntPoint


def coordinates(_: int, point: IntPoint) -> str:
    return str(point)


def vertex_rows(cells: CellList, label: Callable[[int, IntPoint], str] = coordinates) -> Iterator[str]:
    """Yield the rows of Table 1.

    ``label`` formats the coordinates of a vertex from its number and point. The paper's Table 1 prints symbols.
    """
    for number, vertex in enumerate(cells.vertices, 1):
        yield f"{number}\t{label(number, vertex.point)}\t{_listed(vertex.edges)}"


def edge_rows(cells: CellList) -> Iterator[str]:
    """Yield the rows of Table 2: the two ends of an edge and the faces on its left and right."""
    for number, edge in enumerate(cells.edges, 1):
        yield f"{number}\t{edge.start}\t{edge.end}\t{edge.left}\t{edge.right}"


def face_rows(cells: CellList) -> Iterator[str]:
    """Yield the rows of Table 3: the number of a face's edges and its pairs (P, L)."""
    for number, face in enumerate(cells.faces, 1):
        yield f"{number}\t{len(face.pairs)}\t{_listed(face.pairs)}"


def all_rows(cells: CellList) -> Iterator[str]:
    yield from ("Vertex\tCoordinates\tEdges", *vertex_rows(cells))
    yield from ("Edge\tStartP\tEndP\tLeftF\tRightF", *edge_rows(cells))
    yield from ("Face\tn\tPairs (P, L)", *face_rows(cells))


def _listed(items: Iterable[object]) -> str:
    return ", ".join(map(str, items))


def triangulation_size(triangles: int) -> Fraction:
    """Return formula (5): 3 NV + 3 NT = (3/2 + 3) NT, with half as many vertices as triangles."""
    return (Fraction(3, 2) + 3) * triangles


def cell_list_size(vertices: int, faces: int) -> int:
    """Return formula (6): 3 NV + 5 NF, which assumes five vertices per face. Table 5 uses it."""
    return 3 * vertices + 5 * faces


def economical_size(cells: CellList) -> int:
    """Return the number that formula (6) estimates: three coordinates per vertex and the vertices of all faces."""
    return 3 * len(cells.vertices) + sum(len(face.pairs) for face in cells.faces)


def cube_triangles(voxel_faces: int) -> int:
    """Return the number of Marching Cubes triangles of a voxel object whose surface is a sphere of squares.

    Every square contains one vertex of the triangulation, and Euler's formula gives 2 V - 4 triangles.
    """
    return 2 * voxel_faces - 4

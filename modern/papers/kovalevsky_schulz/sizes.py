"""How many integers an encoding of a surface needs, by the paper's formulas and as counted (section 4)."""

from __future__ import annotations

from fractions import Fraction

from modern.papers.kovalevsky_schulz.cells import CellList


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

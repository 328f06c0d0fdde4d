"""Kovalevsky and Schulz, "Convex Hulls in a 3-dimensional Space": hulls of voxels by local corners and the cell list.

``voxel_hull(volume)`` is the whole way; the steps are ``local_corners``, ``convex_polyhedron``, ``merged`` and
``straightened``, or ``local_corners`` and ``hull_cells`` where nobody asks for triangles.  ``reconstructed`` leads back
from the economical encoding to the voxels.
"""

from modern.papers.kovalevsky_schulz.cells import CellList, CellListError, Economical, decoded, expanded
from modern.papers.kovalevsky_schulz.corners import CENTRES, VERTICES, Of, local_corners
from modern.papers.kovalevsky_schulz.hull import (
    RASTER,
    SHUFFLED,
    Order,
    Surface,
    VoxelHull,
    merged,
    straightened,
    voxel_hull,
)
from modern.papers.kovalevsky_schulz.outcome import hull_cells
from modern.papers.kovalevsky_schulz.polyhedron import INVISIBLE, VISIBLE, Coplanar, Flat, convex_polyhedron
from modern.papers.kovalevsky_schulz.reconstruction import reconstructed

__all__ = [
    "CENTRES",
    "INVISIBLE",
    "RASTER",
    "SHUFFLED",
    "VERTICES",
    "VISIBLE",
    "CellList",
    "CellListError",
    "Coplanar",
    "Economical",
    "Flat",
    "Of",
    "Order",
    "Surface",
    "VoxelHull",
    "convex_polyhedron",
    "decoded",
    "expanded",
    "hull_cells",
    "local_corners",
    "merged",
    "reconstructed",
    "straightened",
    "voxel_hull",
]

"""Kovalevsky and Schulz's algorithm: the hull of a voxel solid, computed from the points that can be its vertices.

These points are called local corners. The result is a cell list: vertices, edges and faces with references to each
other. ``voxel_hull(volume)`` runs all steps of the paper: ``local_corners``, ``convex_polyhedron`` (which inserts the
points one by one), ``merged`` and ``straightened``. If no order of insertion is requested, ``hull_cells`` replaces the
last three steps. ``reconstructed`` computes the voxels from the economical encoding of their hull, a short cell list.

References
----------
V. Kovalevsky and H. Schulz, "Convex Hulls in a 3-dimensional Space".
"""

from modern.papers.kovalevsky_schulz.cells import CellList, CellListError, Economical, expanded
from modern.papers.kovalevsky_schulz.corners import CENTRES, VERTICES, Of, local_corners
from modern.papers.kovalevsky_schulz.hull import (
    RASTER,
    SHUFFLED,
    Surface,
    VoxelHull,
    hull_cells,
    merged,
    straightened,
    voxel_hull,
)
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
    "Surface",
    "VoxelHull",
    "convex_polyhedron",
    "expanded",
    "hull_cells",
    "local_corners",
    "merged",
    "reconstructed",
    "straightened",
    "voxel_hull",
]

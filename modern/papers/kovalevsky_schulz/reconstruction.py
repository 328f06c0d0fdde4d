"""Reconstruct a convex digital object exactly from the short encoding of its hull (sections 2 and 5).

A digital object is convex if it contains every voxel whose centre lies in the hull of its voxels' centres. From the
hull of the centres, the object is reconstructed as the set of all voxels whose centres lie in that hull. From the hull
of the corners, it is reconstructed as the set of all voxels with all eight corners in that hull. The hull of the
corners is the Minkowski sum of the hull of the centres and a cube. So it contains the cube of a voxel only if the hull
of the centres contains the voxel's centre. For an object that is not convex, the result is the smallest convex object
around it.
"""

import numpy as np

from emulator.errors import quoted
from modern.digital.intervals import below_faces, fill
from modern.digital.solids import MAX_CELLS, Volume, VolumeError
from modern.papers.kovalevsky_schulz.cells import Economical, expanded
from modern.papers.kovalevsky_schulz.corners import CENTRES, VERTICES, Of


def reconstructed(encoding: Economical, of: Of = VERTICES) -> Volume:
    """Return the voxels of the digital object whose hull is encoded.

    ``of`` is ``centres`` or ``vertices``: the hull is that of the voxels' centres or that of their corners. Raise
    CellListError for an encoding that is not a convex polyhedron. Raise VolumeError for a polyhedron that is too large,
    or for a hull of vertices that contains no voxel.
    """
    if of not in (CENTRES, VERTICES):
        raise ValueError(f"expected the hull of {CENTRES} or {VERTICES}, found {quoted(of)}")
    extra = 1 if of == VERTICES else 0
    columns = list(zip(*encoding.points, strict=True))
    x, y, z = (min(column) for column in columns)
    sizes = [max(column) - least + 1 - extra for column, least in zip(columns, (x, y, z), strict=True)]
    if min(sizes) < 1 or np.prod(sizes, dtype=object) > MAX_CELLS:
        raise VolumeError(
            f"reconstruction: expected a box of 1 to {MAX_CELLS} voxels, found "
            f"a box of {' x '.join(map(str, sizes))} voxels"
        )
    shifted = tuple((p[0] - x, p[1] - y, p[2] - z) for p in encoding.points)
    cells, corners = expanded(Economical(shifted, encoding.faces)), np.array(shifted)
    faces = [
        (corners[np.array(face.vertices) - 1], plane) for face, plane in zip(cells.faces, cells.planes(), strict=True)
    ]
    # The grid points in the hull: centres of voxels, or corners.
    nx, ny, nz = (size + extra for size in sizes)
    array = fill(*below_faces(faces, (nx, ny)), nz)
    if of == VERTICES:
        # A voxel is in the hull if all of its eight corners are.
        for axis in range(3):
            view = np.moveaxis(array, axis, 0)
            array = np.moveaxis(view[:-1] & view[1:], 0, axis)
    if not array.any():
        raise VolumeError("reconstruction: the hull contains no whole voxel")
    return Volume(array, (x, y, z), "reconstruction")

"""Reconstruct a convex digital object exactly from the short encoding of its hull (sections 2 and 5).

A digital object is convex if it contains every voxel whose centre lies in the hull of its voxels' centres. From the
hull of the centres, the object is reconstructed as the set of all voxels whose centres lie in that hull. From the hull
of the corners, it is reconstructed as the set of all voxels with all eight corners in that hull. The hull of the
corners is the Minkowski sum of the hull of the centres and a cube. So it contains the cube of a voxel only if the hull
of the centres contains the voxel's centre. For an object that is not convex, the result is the smallest convex object
around it.
"""

import numpy as np
from numpy.typing import NDArray

from emulator.errors import quoted
from modern.digital.solids import MAX_CELLS, Volume, VolumeError
from modern.papers.kovalevsky_schulz.cells import Economical, Plane, expanded
from modern.papers.kovalevsky_schulz.corners import CENTRES, VERTICES, Of

Places = NDArray[np.int64]


def reconstructed(encoding: Economical, of: Of = VERTICES) -> Volume:
    """Return the voxels of the digital object whose hull is encoded.

    ``of`` is ``centres`` or ``vertices``, for the points of the voxels whose hull is encoded. Raise CellListError for
    an encoding that is not a convex polyhedron. Raise VolumeError for a polyhedron that is too large, or for a hull of
    vertices that contains no voxel.
    """
    if of not in (CENTRES, VERTICES):
        raise ValueError(f"expected the hull of {CENTRES} or {VERTICES}, found {quoted(of)}")
    extra = 1 if of == VERTICES else 0
    columns = list(zip(*encoding.points, strict=True))
    low = tuple(min(column) for column in columns)
    sizes = [max(column) - least + 1 - extra for column, least in zip(columns, low, strict=True)]
    if min(sizes) < 1 or np.prod(sizes, dtype=object) > MAX_CELLS:
        raise VolumeError(
            f"reconstruction: a box of {' x '.join(map(str, sizes))} voxels: expected 1 to {MAX_CELLS} voxels"
        )
    # All corners of a voxel are inside a plane if the corner that is farthest along its normal is inside.
    planes = [
        (a, b, c, d + a * low[0] + b * low[1] + c * low[2] + extra * (max(a, 0) + max(b, 0) + max(c, 0)))
        for a, b, c, d in expanded(encoding).planes()
    ]
    first, last = _intervals(planes, sizes)
    z = np.arange(sizes[2])
    array = (first[:, :, None] <= z) & (z <= last[:, :, None])
    if not array.any():
        raise VolumeError("reconstruction: the hull contains no whole voxel")
    return Volume(np.asarray(array, dtype=np.bool_), low, "reconstruction")


def _intervals(planes: list[Plane], sizes: list[int]) -> tuple[Places, Places]:
    """Return, for each (x, y) of the box, the first and the last z inside all planes, or first > last if none is."""
    # A component of a normal is at most twice the product of two sides of the box, so no term of a plane's value
    # exceeds twice MAX_CELLS, and all values fit into 64 bits.
    x = np.arange(sizes[0], dtype=np.int64)[:, None]
    y = np.arange(sizes[1], dtype=np.int64)[None, :]
    first = np.zeros((sizes[0], sizes[1]), dtype=np.int64)
    last = np.full((sizes[0], sizes[1]), sizes[2] - 1, dtype=np.int64)
    for a, b, c, d in planes:
        # a x + b y + c z + d <= 0 is c z <= bound: an upper or a lower limit of z, rounded inwards, or for an
        # upright plane a condition on the whole column.
        bound = -(a * x + b * y + d)
        if c > 0:
            np.minimum(last, bound // c, out=last)
        elif c < 0:
            np.maximum(first, -(bound // -c), out=first)
        else:
            last[bound < 0] = -1
    return first, last

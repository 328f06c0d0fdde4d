"""A convex digital object exactly from the economical encoding of its hull (sections 2 and 5).

An object is convex if it holds every voxel whose centre lies in the hull of its voxels' centres.  From the hull of the
centres it comes back as the voxels whose centres lie in it; from the hull of the voxels' corners as the voxels that lie
in it with all eight corners: that hull is the sum of the first and of a cube, so a voxel's cube is in it only if the
voxel's centre is in the first.  Of any other object the result is the convex object around it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from modern.digital.solids import MAX_CELLS, Volume, VolumeError
from modern.papers.kovalevsky_schulz.cells import Economical, Plane, expanded
from modern.papers.kovalevsky_schulz.corners import CENTRES, VERTICES, Of

Places = NDArray[np.int64]


def reconstructed(encoding: Economical, of: Of = VERTICES, source: str = "reconstruction") -> Volume:
    """The digital object whose hull is encoded.

    of: what the hull is of, ``centres`` or ``vertices``.  Raises CellListError for an encoding that is no convex
    polyhedron, VolumeError for one too large, or for a hull of vertices in which no voxel fits.
    """
    if of not in (CENTRES, VERTICES):
        raise ValueError(f"the hull is of {CENTRES} or {VERTICES}, not {of!r}")
    side = 1 if of == VERTICES else 0
    columns = list(zip(*encoding.points, strict=True))
    low = tuple(min(column) for column in columns)
    sizes = [max(column) - least + 1 - side for column, least in zip(columns, low, strict=True)]
    if min(sizes) < 1 or np.prod(sizes, dtype=object) > MAX_CELLS:
        raise VolumeError(f"{source}: a box of {' x '.join(map(str, sizes))} voxels is not made")
    # Of a voxel's corners the one farthest along the normal decides.
    planes = [
        (a, b, c, d + a * low[0] + b * low[1] + c * low[2] + side * (max(a, 0) + max(b, 0) + max(c, 0)))
        for a, b, c, d in expanded(encoding).planes()
    ]
    first, last = _intervals(planes, sizes)
    z = np.arange(sizes[2])
    array = (first[:, :, None] <= z) & (z <= last[:, :, None])
    if not array.any():
        raise VolumeError(f"{source}: no voxel fits into the hull")
    return Volume(np.asarray(array, dtype=np.bool_), low, source)


def _intervals(planes: list[Plane], sizes: list[int]) -> tuple[Places, Places]:
    """The first and last z within all planes over every (x, y) of the box; an empty column has first > last.

    A normal's component is at most twice the product of two sides of the box, so no term of a plane's value exceeds
    twice ``MAX_CELLS``: 64 bits hold all values.
    """
    x = np.arange(sizes[0], dtype=np.int64)[:, None]
    y = np.arange(sizes[1], dtype=np.int64)[None, :]
    first = np.zeros((sizes[0], sizes[1]), dtype=np.int64)
    last = np.full((sizes[0], sizes[1]), sizes[2] - 1, dtype=np.int64)
    for a, b, c, d in planes:
        rest = -(a * x + b * y + d)
        if c > 0:
            np.minimum(last, rest // c, out=last)
        elif c < 0:
            np.maximum(first, -(rest // -c), out=first)
        else:
            last[rest < 0] = -1
    return first, last

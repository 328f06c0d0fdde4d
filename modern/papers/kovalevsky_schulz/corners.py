"""Local corners: the voxels, or the corners of voxels, that can be vertices of the hull (section 2 of the paper).

A place of the set is no local corner if two places of the set lie opposite each other beside it, one step away: it
is halfway between them.  Looked at are the 3 pairs of its 6 nearest neighbours, or the 13 pairs of all 26.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from modern.digital.solids import Volume, VolumeError, Voxels

Of = Literal["centres", "vertices"]
"""What the hull is of: the centres of voxels, or their corners."""
CENTRES: Final = "centres"
VERTICES: Final = "vertices"
NEIGHBOURS = (6, 26)

Points = NDArray[np.int64]


def places(volume: Volume, of: Of = VERTICES) -> Voxels:
    """The places whose hull is wanted, as an array of truth values with the volume's origin.

    of: ``centres``: the voxels themselves (the paper's Int(M)); ``vertices``: their corners (Cl(M)), where voxel
    (x, y, z) has the eight corners from (x, y, z) to (x + 1, y + 1, z + 1), so that a corner has the coordinates of
    the farthest voxel from the origin that it bounds (Fig. 3 and Definition SG).  Raises VolumeError for a picture of
    two dimensions.
    """
    if volume.dimension != 3:
        raise VolumeError(f"{volume.source}: a picture of two dimensions; the paper's solids have three")
    if of == CENTRES:
        return volume.array
    if of != VERTICES:
        raise ValueError(f"places are {CENTRES} or {VERTICES}, not {of!r}")
    found = volume.array
    for axis in range(3):
        wider = np.zeros([size + (k == axis) for k, size in enumerate(found.shape)], dtype=np.bool_)
        lower, upper = (tuple(part if k == axis else slice(None) for k in range(3)) for part in (_FIRST, _REST))
        wider[lower] = found
        wider[upper] |= found
        found = wider
    return found


_FIRST, _REST = slice(None, -1), slice(1, None)


def corner_mask(array: Voxels, neighbours: int = 26) -> Voxels:
    """Which places of a set of three dimensions are its local corners, testing 6 or 26 neighbours of each."""
    if neighbours not in NEIGHBOURS:
        raise ValueError(f"6 or 26 neighbours are tested, not {neighbours}")
    wide = np.pad(array, 1)
    mask = array.copy()
    for step in _directions(neighbours):
        mask &= ~(_moved(wide, step, 1) & _moved(wide, step, -1))
    return mask


def points_of(mask: Voxels, origin: tuple[int, ...]) -> Points:
    """The coordinates of the places of a set, shape (n, 3), in raster order: x fastest, then y, then z."""
    return Volume(mask, origin).coordinates()


def local_corners(volume: Volume, of: Of = VERTICES, neighbours: int = 26) -> Points:
    """The list L of the paper: coordinates of the local corners, shape (n, 3), in raster order.

    Raises VolumeError for a picture of two dimensions.
    """
    return points_of(corner_mask(places(volume, of), neighbours), volume.origin)


def _directions(neighbours: int) -> Iterator[tuple[int, ...]]:
    """One neighbour of every pair: the steps whose first component other than 0 is 1."""
    for step in product((-1, 0, 1), repeat=3):
        if step > (0, 0, 0) and (neighbours == 26 or sum(map(abs, step)) == 1):
            yield step


def _moved(wide: Voxels, step: tuple[int, ...], sense: int) -> Voxels:
    """Of an array with a rim of one place: what lies one step from each place within."""
    return wide[tuple(slice(1 + sense * k, size - 1 + sense * k) for k, size in zip(step, wide.shape, strict=True))]

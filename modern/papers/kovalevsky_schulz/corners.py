"""Local corners: the voxels, or the corners of voxels, that can be vertices of the hull (section 2 of the paper).

A place of the set is no local corner if two places of the set lie opposite each other beside it, one step away: it
is halfway between them.  Looked at are the 3 pairs of its 6 nearest neighbours, or the 13 pairs of all 26.

The places are tested by 6 neighbours slab by slab, and the other pairs only where these 6 leave a corner.
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
_SLAB = 1 << 20
"""About so many places are tested at a time: they and what is made of them stay near the processor."""


def places(volume: Volume, of: Of = VERTICES) -> Voxels:
    """The places whose hull is wanted, as an array of truth values with the volume's origin.

    of: ``centres``: the voxels themselves (the paper's Int(M)); ``vertices``: their corners (Cl(M)), where voxel
    (x, y, z) has the eight corners from (x, y, z) to (x + 1, y + 1, z + 1), so that a corner has the coordinates of
    the farthest voxel from the origin that it bounds (Fig. 3 and Definition SG).  Raises VolumeError for a picture of
    two dimensions.
    """
    if not _side(volume, of):
        return volume.array
    nx, ny, nz = volume.array.shape
    found = np.zeros((nx + 1, ny + 1, nz + 1), dtype=np.bool_)
    found[:nx, :ny, :nz] = volume.array
    for axis in range(3):
        turned = np.moveaxis(found, axis, 0)
        turned[1:] |= turned[:-1].copy()
    return found


def _side(volume: Volume, of: Of) -> int:
    """How many places more than voxels there are along an axis of the box."""
    if volume.dimension != 3:
        raise VolumeError(f"{volume.source}: a picture of two dimensions; the paper's solids have three")
    if of not in (CENTRES, VERTICES):
        raise ValueError(f"places are {CENTRES} or {VERTICES}, not {of!r}")
    return int(of == VERTICES)


def corners_by_neighbours(volume: Volume, of: Of = VERTICES) -> dict[int, Points]:
    """The local corners that 6 and that 26 neighbours leave, each as ``local_corners``."""
    side = _side(volume, of)
    # Slabs lie across the axis along which voxels are farthest from each other in memory.
    order = sorted(range(3), key=lambda axis: -abs(volume.array.strides[axis]))
    solid = volume.array.transpose(order)
    found: dict[int, list[NDArray[np.intp]]] = {neighbours: [] for neighbours in NEIGHBOURS}
    for first, slab in _slabs(solid, side):
        flat = slab.ravel()
        sizes = (slab.shape[1] * slab.shape[2], slab.shape[2], 1)
        at = _of_six(flat, sizes)
        for neighbours in NEIGHBOURS:
            if neighbours != 6:
                for step in _steps():
                    if sum(map(abs, step)) > 1:
                        far = sum(way * size for way, size in zip(step, sizes, strict=True))
                        at = at[~(flat[at + far] & flat[at - far])]
            corner = np.stack(np.unravel_index(at, slab.shape), axis=1)
            found[neighbours].append(corner + np.array((first - 1, -1, -1)))
    return {neighbours: _in_raster_order(parts, order, volume.origin) for neighbours, parts in found.items()}


def _slabs(solid: Voxels, side: int) -> Iterator[tuple[int, Voxels]]:
    """Places in slabs along the first axis, with a rim of one place all around; and of each the first index within.

    The rim is of the slabs beside along the first axis, without any places along the others.
    """
    nx, ny, nz = solid.shape
    height = max(1, _SLAB // ((ny + side + 2) * (nz + side + 2)))
    for first in range(0, nx + side, height):
        rows = min(height, nx + side - first)
        slab = np.zeros((rows + 2, ny + side + 2, nz + side + 2), dtype=np.bool_)
        # Places first - 1 to first + rows are those of voxels with the same index and, of corners, with one less.
        for shift in range(side + 1):
            low, high = max(0, first - 1 - shift), min(nx, first + rows + 1 - shift)
            if low < high:
                begin = low + shift - (first - 1)
                slab[begin : begin + high - low, 1 : ny + 1, 1 : nz + 1] |= solid[low:high]
        flat = slab.ravel()
        for far in (slab.shape[2], 1) if side else ():
            # The place before the first of a row or a layer is one of the rim.
            flat[far:] |= flat[:-far].copy()
        yield first, slab


def _of_six(flat: Voxels, sizes: tuple[int, ...]) -> NDArray[np.intp]:
    """Where in a slab's row of places local corners by 6 neighbours are; sizes: how far on the next ones are."""
    edge = sizes[0]
    mask = flat[edge:-edge].copy()
    between = np.empty_like(mask)
    for size in sizes:
        np.logical_and(flat[edge - size : -edge - size], flat[edge + size : len(flat) - edge + size], out=between)
        np.greater(mask, between, out=mask)
    return np.flatnonzero(mask) + edge


def _in_raster_order(parts: list[NDArray[np.intp]], order: list[int], origin: tuple[int, ...]) -> Points:
    """Indices along axes in some order, as coordinates, x fastest, then y, then z."""
    found = np.concatenate([np.empty((0, 3), np.int64), *parts])[:, np.argsort(order)]
    return found[np.lexsort(found.T)] + np.array(origin, dtype=np.int64)


def local_corners(volume: Volume, of: Of = VERTICES, neighbours: int = 26) -> Points:
    """The list L of the paper: coordinates of the local corners, shape (n, 3), in raster order.

    neighbours: 6 or 26, how many of each place are tested.  Raises VolumeError for a picture of two dimensions,
    ValueError for another number of neighbours.
    """
    if neighbours not in NEIGHBOURS:
        raise ValueError(f"6 or 26 neighbours are tested, not {neighbours}")
    return corners_by_neighbours(volume, of)[neighbours]


def _steps() -> Iterator[tuple[int, ...]]:
    """One neighbour of every pair: the steps whose first component other than 0 is 1."""
    return (step for step in product((-1, 0, 1), repeat=3) if step > (0, 0, 0))

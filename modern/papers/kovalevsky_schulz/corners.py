"""Local corners: the voxels, or the corners of voxels, that can be vertices of the hull (section 2 of the paper).

A grid point of the set is not a local corner if it is halfway between two neighbours that belong to the set. The test
examines the 3 pairs of opposite points among its 6 nearest neighbours, or the 13 pairs among all 26 neighbours.

The test of the 6 neighbours runs over whole arrays, slab by slab. The other 10 pairs are tested only at the points that
remain.
"""

from collections.abc import Iterator
from itertools import product
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from emulator.errors import quoted
from modern.digital.solids import Volume, VolumeError, Voxels

# The two kinds of points whose hull can be computed: the centres of voxels or their corners.
Of = Literal["centres", "vertices"]
CENTRES: Final = "centres"
VERTICES: Final = "vertices"
NEIGHBOURS = (6, 26)

Points = NDArray[np.int64]
# Ten of the 26 neighbours of a grid point as steps to them: one of each pair of opposite ones, without the nearest six.
_DIAGONAL_STEPS = [step for step in product((-1, 0, 1), repeat=3) if step > (0, 0, 0) and sum(map(abs, step)) > 1]
# The approximate number of grid points tested at a time, which fit the processor's cache.
_SLAB = 1 << 20


def places(volume: Volume, of: Of = VERTICES) -> Voxels:
    """Return the grid points whose hull is computed, voxel centres or corners, as an array of truth values.

    For ``centres`` the grid points are the voxels themselves (the paper's Int(M)), for ``vertices`` their corners
    (Cl(M)). Voxel (x, y, z) has the eight corners from (x, y, z) to (x + 1, y + 1, z + 1). The coordinates of a corner
    thus equal those of the voxel with the largest x, y and z among the eight voxels around it (Fig. 3, Definition SG).

    Raise VolumeError for a volume of two dimensions.
    """
    return _with_corners(np.pad(volume.array, (0, 1))) if _extra(volume, of) else volume.array


def _with_corners(voxels: Voxels) -> Voxels:
    """Mark the eight corners of each voxel, by spreading the voxels by one step along each axis in turn."""
    for axis in range(3):
        view = np.moveaxis(voxels, axis, 0)
        view[1:] |= view[:-1].copy()
    return voxels


def _extra(volume: Volume, of: Of) -> int:
    """Return how many more grid points than voxels there are along each axis: 0 for centres, 1 for corners."""
    if volume.dimension != 3:
        raise VolumeError(f"{volume.source}: expected a volume of three dimensions, found two")
    if of not in (CENTRES, VERTICES):
        raise ValueError(f"expected the hull of {CENTRES} or {VERTICES}, found {quoted(of)}")
    return int(of == VERTICES)


def corners_by_neighbours(volume: Volume, of: Of = VERTICES) -> dict[int, Points]:
    """Return the local corners found by the test of 6 neighbours (key 6) and by that of 26 neighbours (key 26)."""
    extra = _extra(volume, of)
    # The slabs are cut across the axis with the largest stride, so that each is contiguous in memory.
    order = sorted(range(3), key=lambda axis: -abs(volume.array.strides[axis]))
    solid = volume.array.transpose(order)
    corners: dict[int, list[NDArray[np.intp]]] = {neighbours: [] for neighbours in NEIGHBOURS}
    for first, slab in _slabs(solid, extra):
        flat = slab.ravel()
        strides = (slab.shape[1] * slab.shape[2], slab.shape[2], 1)
        local = {6: _by_six_neighbours(flat, strides)}
        local[26] = local[6]
        for step in _DIAGONAL_STEPS:
            # In the flat array two opposite neighbours are ``offset`` entries after and before the point.
            offset = sum(way * stride for way, stride in zip(step, strides, strict=True))
            local[26] = local[26][~(flat[local[26] + offset] & flat[local[26] - offset])]
        for neighbours, at in local.items():
            indices = np.stack(np.unravel_index(at, slab.shape), axis=1)
            corners[neighbours].append(indices + np.array((first - 1, -1, -1)))
    return {neighbours: _in_raster_order(parts, order, volume.origin) for neighbours, parts in corners.items()}


def _slabs(solid: Voxels, extra: int) -> Iterator[tuple[int, Voxels]]:
    """Yield the grid points in slabs along the first axis, each with its first index on this axis.

    A slab has a margin of one point all around. Along the first axis the margin repeats points of the neighbouring
    slabs. Along the other axes it is empty.
    """
    nx, ny, nz = solid.shape
    height = max(1, _SLAB // ((ny + extra + 2) * (nz + extra + 2)))
    for first in range(0, nx + extra, height):
        # A corner with index i belongs to voxels with the indices i - 1 and i.
        begin, end = first - 1 - extra, first + height + 1
        missing = max(0, -begin), max(0, min(end, nx + extra + 1) - nx)
        slab = np.pad(solid[max(0, begin) : end], (missing, (1, 1 + extra), (1, 1 + extra)))
        yield first, (_with_corners(slab) if extra else slab)[extra:]


def _by_six_neighbours(flat: Voxels, strides: tuple[int, ...]) -> NDArray[np.intp]:
    edge = strides[0]
    mask = flat[edge:-edge].copy()
    between = np.empty_like(mask)
    for stride in strides:
        np.logical_and(
            flat[edge - stride : -edge - stride], flat[edge + stride : len(flat) - edge + stride], out=between
        )
        np.greater(mask, between, out=mask)
    return np.flatnonzero(mask) + edge


def _in_raster_order(parts: list[NDArray[np.intp]], order: list[int], origin: tuple[int, ...]) -> Points:
    """Convert indices along permuted axes to coordinates, sorted by z, then y, then x."""
    points = np.concatenate([np.empty((0, 3), np.int64), *parts])[:, np.argsort(order)]
    return points[np.lexsort(points.T)] + np.array(origin, dtype=np.int64)


def local_corners(volume: Volume, of: Of = VERTICES, neighbours: int = 26) -> Points:
    """Return the local corners, the paper's list L, as coordinates of shape (n, 3), sorted by z, then y, then x.

    Raise VolumeError for a volume of two dimensions, ValueError for another number of neighbours.
    """
    if neighbours not in NEIGHBOURS:
        raise ValueError(f"expected 6 or 26 neighbours, found {neighbours}")
    return corners_by_neighbours(volume, of)[neighbours]

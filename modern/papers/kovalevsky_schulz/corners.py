"""Local corners: the voxels, or the corners of voxels, that can be vertices of the hull (section 2 of the paper).

A grid point of the set is not a local corner if it is halfway between two neighbours that belong to the set. The test
covers the 3 pairs of opposite points among its 6 nearest neighbours, or the 13 pairs among all 26.

The test by 6 neighbours runs slab by slab over whole arrays. The other 10 pairs are tested only at the points that
remain.
"""

from collections.abc import Iterator, Sequence
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
# The approximate number of grid points tested at a time, which fit the processor's cache.
_SLAB = 1 << 20


def places(volume: Volume, of: Of = VERTICES) -> Voxels:
    """Return the grid points whose hull is computed, voxel centres or corners, as an array of truth values.

    ``centres`` are the voxels themselves (the paper's Int(M)), ``vertices`` their corners (Cl(M)). Voxel (x, y, z) has
    the eight corners from (x, y, z) to (x + 1, y + 1, z + 1). A corner thus has the coordinates of the voxel farthest
    from the origin among those it bounds (Fig. 3 and Definition SG).

    Raise VolumeError for a volume of two dimensions.
    """
    if not _extra(volume, of):
        return volume.array
    nx, ny, nz = volume.array.shape
    corners = np.zeros((nx + 1, ny + 1, nz + 1), dtype=np.bool_)
    corners[:nx, :ny, :nz] = volume.array
    # Spreading the voxels by one step along each axis in turn reaches all eight corners.
    for axis in range(3):
        view = np.moveaxis(corners, axis, 0)
        view[1:] |= view[:-1].copy()
    return corners


def _extra(volume: Volume, of: Of) -> int:
    """Return how many more grid points than voxels each axis has: 0 for centres, 1 for corners."""
    if volume.dimension != 3:
        raise VolumeError(f"{volume.source}: expected a volume of three dimensions, found two")
    if of not in (CENTRES, VERTICES):
        raise ValueError(f"expected the hull of {CENTRES} or {VERTICES}, found {quoted(of)}")
    return int(of == VERTICES)


def corners_by_neighbours(volume: Volume, of: Of = VERTICES, numbers: Sequence[int] = NEIGHBOURS) -> dict[int, Points]:
    """Return the local corners (points that can be vertices) by the number of neighbours of their test: 6 or 26."""
    extra = _extra(volume, of)
    # The slabs are cut across the axis with the largest stride, so that each is contiguous in memory.
    order = sorted(range(3), key=lambda axis: -abs(volume.array.strides[axis]))
    solid = volume.array.transpose(order)
    corners: dict[int, list[NDArray[np.intp]]] = {neighbours: [] for neighbours in numbers}
    for first, slab in _slabs(solid, extra):
        flat = slab.ravel()
        strides = (slab.shape[1] * slab.shape[2], slab.shape[2], 1)
        at = _by_six_neighbours(flat, strides)
        for neighbours in numbers:
            if neighbours != 6:
                for step in _steps():
                    if sum(map(abs, step)) > 1:
                        # In the flat array two opposite neighbours are ``offset`` entries after and before the point.
                        offset = sum(way * stride for way, stride in zip(step, strides, strict=True))
                        at = at[~(flat[at + offset] & flat[at - offset])]
            indices = np.stack(np.unravel_index(at, slab.shape), axis=1)
            corners[neighbours].append(indices + np.array((first - 1, -1, -1)))
    return {neighbours: _in_raster_order(parts, order, volume.origin) for neighbours, parts in corners.items()}


def _slabs(solid: Voxels, extra: int) -> Iterator[tuple[int, Voxels]]:
    """Yield the grid points in slabs along the first axis, each with its first index and a margin of one point all
    around.

    Along the first axis the margin repeats the neighbouring slabs. Along the other axes it is empty.
    """
    nx, ny, nz = solid.shape
    height = max(1, _SLAB // ((ny + extra + 2) * (nz + extra + 2)))
    for first in range(0, nx + extra, height):
        rows = min(height, nx + extra - first)
        slab = np.zeros((rows + 2, ny + extra + 2, nz + extra + 2), dtype=np.bool_)
        # Points first - 1 to first + rows come from voxels with the same index and, for corners, with one index less.
        for shift in range(extra + 1):
            low, high = max(0, first - 1 - shift), min(nx, first + rows + 1 - shift)
            if low < high:
                begin = low + shift - (first - 1)
                slab[begin : begin + high - low, 1 : ny + 1, 1 : nz + 1] |= solid[low:high]
        flat = slab.ravel()
        for stride in (slab.shape[2], 1) if extra else ():
            # The point before the first of a row or a layer belongs to the empty margin.
            flat[stride:] |= flat[:-stride].copy()
        yield first, slab


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
    return corners_by_neighbours(volume, of, (neighbours,))[neighbours]


def _steps() -> Iterator[tuple[int, ...]]:
    """Yield 13 of the 26 neighbours of a grid point, one of each pair of opposite ones, as steps to them."""
    return (step for step in product((-1, 0, 1), repeat=3) if step > (0, 0, 0))

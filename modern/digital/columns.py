"""The columns of a volume: their lowest and highest voxels, the candidates for vertices, and filled columns.

A column is a line of voxels along the last axis. The hull of a volume is the hull of the ends of its columns.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

# The approximate number of voxels processed at a time.
SLAB = 1 << 24
# Another round of removal runs while the last one removed at least one point in this number.
STILL_PAYS = 64

Grid = NDArray[np.int64]
Truth = NDArray[np.bool_]


def slabs(array: NDArray[Any]) -> list[slice]:
    step = max(1, SLAB // max(1, array[:1].size))
    return [slice(first, first + step) for first in range(0, len(array), step)]


def column_ends(volume: Truth) -> tuple[Grid, Grid, Grid, Grid]:
    """Return the non-empty columns in raster order: indices on axes 0 and 1, lowest and highest index on axis 2."""
    slab_ends: list[tuple[Any, Any, Any, Any]] = []
    last = volume.shape[2] - 1
    for part in slabs(volume):
        slab = volume[part]
        x, y = np.nonzero(slab.any(axis=2))
        lowest = slab.argmax(axis=2)[x, y]
        highest = last - slab[:, :, ::-1].argmax(axis=2)[x, y]
        slab_ends.append((x + part.start, y, lowest, highest))
    x, y, low, high = (np.concatenate(parts).astype(np.int64) for parts in zip(*slab_ends, strict=True))
    return x, y, low, high


def reduced(x: Grid, y: Grid, z: Grid) -> tuple[Grid, Grid, Grid]:
    """Remove points on or above a chord of their row or column of (x, y). They are never vertices of the lower side.

    The arrays x, y, z hold one point for each (x, y), in raster order, and so does the result.
    """
    x, y, z = _along(x, y, z)
    order = np.lexsort((x, y))
    y, x, z = _along(y[order], x[order], z[order])
    order = np.lexsort((y, x))
    return x[order], y[order], z[order]


def _along(line: Grid, t: Grid, z: Grid) -> tuple[Grid, Grid, Grid]:
    """Remove all points on or above the chord between their neighbours on the same line.

    The removal is repeated as long as it removes enough points.
    """
    removed = np.ones(len(line), dtype=np.bool_)
    while len(line) > 2 and STILL_PAYS * np.count_nonzero(removed) >= len(line):
        before, after = t[1:-1] - t[:-2], t[2:] - t[1:-1]
        # The chord's height at the point, multiplied by the distance of the neighbours to avoid a division.
        chord = z[:-2] * after + z[2:] * before
        removed = (line[:-2] == line[2:]) & (z[1:-1] * (before + after) >= chord)
        retained = np.concatenate(([True], ~removed, [True]))
        line, t, z = line[retained], t[retained], z[retained]
    return line, t, z


def fill(low: Grid, high: Grid, depth: int) -> Truth:
    """Return a volume whose column (x, y) of ``depth`` voxels is filled from low[x, y] to high[x, y]."""
    filled = np.empty((*low.shape, depth), dtype=np.bool_)
    index = np.arange(depth, dtype=np.int32)
    for part in slabs(filled):
        np.less_equal(low[part, :, None].astype(np.int32), index, out=filled[part])
        filled[part] &= index <= high[part, :, None].astype(np.int32)
    return filled

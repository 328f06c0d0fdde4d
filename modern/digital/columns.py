"""A volume by its columns: their lowest and highest voxels, those that can be extreme, and the columns filled again.

A column is a line of voxels along the last axis of an array.  Whatever lies between the ends of a column is in the hull
of the ends, so that the hull of a volume is that of its columns' ends, two a column.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

SLAB = 1 << 24
"""About so many voxels are worked on at a time."""
STILL_PAYS = 64
"""Points are struck in another round while the last one struck one in so many."""

Grid = NDArray[np.int64]
Truth = NDArray[np.bool_]


def slabs(array: NDArray[Any]) -> list[slice]:
    """Parts of the first axis, of about ``SLAB`` voxels each."""
    step = max(1, SLAB // max(1, array[:1].size))
    return [slice(first, first + step) for first in range(0, len(array), step)]


def column_ends(volume: Truth) -> tuple[Grid, Grid, Grid, Grid]:
    """The columns with voxels, in raster order: indices along axes 0 and 1, lowest and highest index along axis 2."""
    found: list[tuple[Any, Any, Any, Any]] = []
    last = volume.shape[2] - 1
    for part in slabs(volume):
        slab = volume[part]
        x, y = np.nonzero(slab.any(axis=2))
        lowest = slab.argmax(axis=2)[x, y]
        highest = last - slab[:, :, ::-1].argmax(axis=2)[x, y]
        found.append((x + part.start, y, lowest, highest))
    x, y, low, high = (np.concatenate(parts).astype(np.int64) for parts in zip(*found, strict=True))
    return x, y, low, high


def reduced(x: Grid, y: Grid, z: Grid) -> tuple[Grid, Grid, Grid]:
    """The points left when those on or above a chord of their row or column of (x, y) are struck.

    No struck point is a vertex of the lower side of the hull; other points may be left.  x, y, z: one point a
    place (x, y), in raster order, as is the result.
    """
    x, y, z = _along(x, y, z)
    order = np.lexsort((x, y))
    y, x, z = _along(y[order], x[order], z[order])
    order = np.lexsort((y, x))
    return x[order], y[order], z[order]


def _along(line: Grid, t: Grid, z: Grid) -> tuple[Grid, Grid, Grid]:
    """Strike points on or above the chord between their neighbours on the same line, all at once, while it pays."""
    struck = np.ones(len(line), dtype=np.bool_)
    while len(line) > 2 and STILL_PAYS * np.count_nonzero(struck) >= len(line):
        before, after = t[1:-1] - t[:-2], t[2:] - t[1:-1]
        chord = z[:-2] * after + z[2:] * before
        struck = (line[:-2] == line[2:]) & (z[1:-1] * (before + after) >= chord)
        kept = np.concatenate(([True], ~struck, [True]))
        line, t, z = line[kept], t[kept], z[kept]
    return line, t, z


def fill(low: Grid, high: Grid, depth: int) -> Truth:
    """The volume of ``depth`` voxels a column whose column (x, y) holds low[x, y] to high[x, y], none if low > high."""
    filled = np.empty((*low.shape, depth), dtype=np.bool_)
    index = np.arange(depth, dtype=np.int32)
    for part in slabs(filled):
        np.less_equal(low[part, :, None].astype(np.int32), index, out=filled[part])
        filled[part] &= index <= high[part, :, None].astype(np.int32)
    return filled

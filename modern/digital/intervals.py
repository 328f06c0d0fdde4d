"""The columns of a volume: their first and last voxels, and the part of each column that lies in a hull.

A column is a line of voxels along the last axis. The hull of a volume is the hull of the ends of its columns. The part
of a column in the hull is computed exactly: the height at which a face crosses the column is rounded to an integer, up
on the lower side of the hull and down on the upper side. A grid point on a face belongs to the hull.
"""

from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

# The approximate number of voxels processed at a time.
SLAB = 1 << 24
# Rounds of removing points are repeated as long as a round removes at least one in this number of points.
STILL_PAYS = 64

Grid = NDArray[np.int64]
Truth = NDArray[np.bool_]
# The coefficients a, b, c, d of a plane a x + b y + c z + d = 0.
Plane = tuple[int, int, int, int]


def slabs(array: NDArray[Any]) -> list[slice]:
    step = max(1, SLAB // max(1, array[:1].size))
    return [slice(first, first + step) for first in range(0, len(array), step)]


def column_ends(volume: Truth) -> tuple[Grid, Grid, Grid, Grid]:
    """Return the non-empty columns of a volume as four arrays: x, y, and the lowest and highest z of each column."""
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


def vertex_candidates(x: Grid, y: Grid, low: Grid, high: Grid) -> Grid:
    """Return the ends of columns that can be vertices of the hull, shape (n, 3), sorted by x, y and z.

    The four arrays are those of ``column_ends``, sorted by x and then y.
    """
    lower = np.stack(reduced(x, y, low), axis=1)
    upper = np.stack(reduced(x, y, -high), axis=1) * (1, 1, -1)
    return np.unique(np.concatenate((lower, upper)), axis=0)


def reduced(x: Grid, y: Grid, z: Grid) -> tuple[Grid, Grid, Grid]:
    """Remove points that cannot be vertices of the lower side of a hull.

    These points lie on or above the segment between two other points with the same x, or with the same y. The arrays
    x, y, z hold at most one point for each (x, y). They are sorted by x and then y, and so are the returned arrays.
    """
    x, y, z = _along(x, y, z)
    order = np.lexsort((x, y))
    y, x, z = _along(y[order], x[order], z[order])
    order = np.lexsort((y, x))
    return x[order], y[order], z[order]


def _along(line: Grid, t: Grid, z: Grid) -> tuple[Grid, Grid, Grid]:
    """Repeatedly remove each point on or above the segment between its two neighbours.

    ``line`` has the number of the line on which each point (t, z) lies. Only points on the same line are neighbours.
    The arrays are sorted by line and then by t.
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
    """Return a volume of ``depth`` layers in which each column (x, y) is filled from low[x, y] to high[x, y]."""
    filled = np.empty((*low.shape, depth), dtype=np.bool_)
    index = np.arange(depth, dtype=np.int32)
    for part in slabs(filled):
        np.less_equal(low[part, :, None].astype(np.int32), index, out=filled[part])
        filled[part] &= index <= high[part, :, None].astype(np.int32)
    return filled


def lower_chain(points: Iterable[tuple[int, int]]) -> list[tuple[int, int]]:
    """Return the vertices on the lower side of the hull of points (t, z), by Andrew's scan.

    The points are sorted by t, and no two have the same t.
    """
    chain: list[tuple[int, int]] = []
    for t, z in points:
        while len(chain) > 1:
            (t0, z0), (t1, z1) = chain[-2:]
            if (t1 - t0) * (z - z0) > (z1 - z0) * (t - t0):
                break
            chain.pop()
        chain.append((t, z))
    return chain


# The approximate number of columns processed at a time.
BATCH = 1 << 20


def below_faces(faces: Iterable[tuple[Grid, Plane]], shape: tuple[int, int]) -> tuple[Grid, Grid]:
    """Return two arrays: the lowest and the highest integer z of a polyhedron at each position (x, y) of a grid.

    Each face is a pair: its vertices, shape (n, 3), counterclockwise as seen from outside, and the coefficients of its
    plane's equation, whose value is positive outside. If a position has no grid point of the polyhedron, its lowest z
    is greater than its highest z.
    """
    low = np.ones(shape, dtype=np.int64)
    high = np.zeros(shape, dtype=np.int64)
    lower, upper = [], []
    for corners, (a, b, c, d) in faces:
        if c < 0:
            # Seen from above, the faces of the lower side run clockwise.
            lower.append((corners[::-1], (-a, -b, -c, -d)))
        elif c > 0:
            upper.append((corners, (a, b, c, d)))
    write_heights(low, lower, rounded_up=True)
    write_heights(high, upper, rounded_up=False)
    return low, high


def write_heights(grid: Grid, faces: Sequence[tuple[Grid, Plane]], rounded_up: bool) -> None:
    """Write the height of each face, rounded up or down to integers, into ``grid`` at the (x, y) that it covers.

    Each face is a pair: its vertices, counterclockwise as seen from above, and the four coefficients of its plane, of
    which the third is positive. A later face overwrites an earlier one.
    """
    fans = [(corners[0], *pair, plane) for corners, plane in faces for pair in pairwise(corners[1:])]
    if not fans:
        return
    triangles = np.array([fan[:3] for fan in fans])
    planes = np.array([fan[3] for fan in fans])
    # A vertex in line with its neighbours may give a triangle without area, which covers nothing else.
    (u, v), (s, t) = (triangles[:, k, :2].T - triangles[:, 0, :2].T for k in (1, 2))
    has_area = u * t > v * s
    triangles, planes = triangles[has_area], planes[has_area]
    x, y = triangles[:, :, 0], triangles[:, :, 1]
    first, rows = x.min(axis=1), np.ptp(x, axis=1) + 1
    which = np.repeat(np.arange(len(triangles)), rows)
    # One entry for every row of every triangle, with the interval of y that the triangle covers in it.
    row = first[which] + _count_up(rows)
    least, most = _sides(x[which], y[which], row, grid.shape[1])
    count = np.maximum(most - least + 1, 0)
    ends = np.cumsum(count)
    # Split the rows into batches of about BATCH positions, so that memory stays bounded.
    cuts = np.searchsorted(ends, np.arange(BATCH, int(ends[-1]), BATCH))
    for part in np.split(np.arange(len(which)), np.unique(cuts)):
        column = np.repeat(part, count[part])
        a, b, c, d = planes[which[column]].T
        at_x, at_y = row[column], least[column] + _count_up(count[part])
        # The plane a x + b y + c z + d = 0, solved for z by an integer division.
        above = a * at_x + b * at_y + d
        grid[at_x, at_y] = -(above // c) if rounded_up else (-above) // c


def _sides(x: Grid, y: Grid, row: Grid, width: int) -> tuple[Grid, Grid]:
    """Return the least and the greatest integer y of each triangle (x, y) in one row of the grid, at x = ``row``."""
    least, most = np.zeros(len(row), dtype=np.int64), np.full(len(row), width - 1, dtype=np.int64)
    for k in range(3):
        run, rise = x[:, (k + 1) % 3] - x[:, k], y[:, (k + 1) % 3] - y[:, k]
        over = rise * (row - x[:, k])
        unit = np.where(run == 0, 1, np.abs(run))
        # An edge that runs toward +x bounds y from below, one toward -x from above.
        np.maximum(least, y[:, k] - (-over // unit), out=least, where=run > 0)
        np.minimum(most, y[:, k] + (-over // unit), out=most, where=run < 0)
    return least, most


def _count_up(counts: Grid) -> Grid:
    """Return the numbers 0, 1, ..., count - 1 for the first count, then for the second one and so on, in one array."""
    ends = np.cumsum(counts)
    return np.arange(int(ends[-1]) if len(ends) else 0) - np.repeat(ends - counts, counts)

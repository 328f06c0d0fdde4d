"""Which grid points lie between the lower and the upper side of a hull: an interval for every column, exactly.

Where a plane or a line passes between two grid points the division is of integers, rounded up on the lower side and
down on the upper; where it passes through one, that one belongs to the hull.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from modern.digital.columns import Grid, Truth


def lower_chain(points: Iterable[tuple[int, int]]) -> list[tuple[int, int]]:
    """The vertices of the lower side of points (t, z) sorted by t, each t once: one scan, going back where it turns."""
    chain: list[tuple[int, int]] = []
    for t, z in points:
        while len(chain) > 1:
            (t0, z0), (t1, z1) = chain[-2:]
            if (t1 - t0) * (z - z0) > (z1 - z0) * (t - t0):
                break
            chain.pop()
        chain.append((t, z))
    return chain


BATCH = 1 << 20
"""About so many columns are worked on at a time."""


def below_facets(points: Grid, corner: Grid, plane: Grid, shape: tuple[int, int]) -> tuple[Grid, Grid]:
    """The lowest and the highest grid point of a polyhedron over every place (x, y) of a grid of this shape.

    points: shape (n, 3); corner: three of them a facet, counterclockwise seen from outside; plane: four coefficients a
    facet, positive outside.  Where the polyhedron has no grid point the lowest is above the highest.
    """
    low = np.ones(shape, dtype=np.int64)
    high = np.zeros(shape, dtype=np.int64)
    down, up = plane[:, 2] < 0, plane[:, 2] > 0
    # Seen from above, the facets of the lower side run clockwise.
    write_heights(low, points[corner[down][:, ::-1]], -plane[down], rounded_up=True)
    write_heights(high, points[corner[up]], plane[up], rounded_up=False)
    return low, high


def write_heights(grid: Grid, triangles: Grid, plane: Grid, rounded_up: bool) -> None:
    """Write the height of every triangle at the places below it, its boundary included; a later one overwrites.

    triangles: of grid points, shape (n, 3, 3), counterclockwise seen from above; plane: four coefficients each, with a
    positive third one.  A height that is no whole number is rounded up, or down.
    """
    x, y = triangles[:, :, 0], triangles[:, :, 1]
    first, rows = x.min(axis=1), np.ptp(x, axis=1) + 1
    which = np.repeat(np.arange(len(triangles)), rows)
    row = first[which] + _count_up(rows)
    least, most = _sides(x[which], y[which], row, grid.shape[1])
    count = np.maximum(most - least + 1, 0)
    ends = np.cumsum(count)
    cuts = np.searchsorted(ends, np.arange(BATCH, int(ends[-1]) if len(ends) else 0, BATCH))
    for part in np.split(np.arange(len(which)), np.unique(cuts)):
        column = np.repeat(part, count[part])
        a, b, c, d = plane[which[column]].T
        at_x, at_y = row[column], least[column] + _count_up(count[part])
        above = a * at_x + b * at_y + d
        grid[at_x, at_y] = -(above // c) if rounded_up else (-above) // c


def _sides(x: Grid, y: Grid, row: Grid, width: int) -> tuple[Grid, Grid]:
    """The least and the most y of triangles in a row of places: three edges each, with the triangle on their left."""
    least, most = np.zeros(len(row), dtype=np.int64), np.full(len(row), width - 1, dtype=np.int64)
    for k in range(3):
        run, rise = x[:, (k + 1) % 3] - x[:, k], y[:, (k + 1) % 3] - y[:, k]
        over = rise * (row - x[:, k])
        unit = np.where(run == 0, 1, np.abs(run))
        np.maximum(least, y[:, k] - (-over // unit), out=least, where=run > 0)
        np.minimum(most, y[:, k] + (-over // unit), out=most, where=run < 0)
    return least, most


def _count_up(counts: Grid) -> Grid:
    """0, 1, ... up to each count less one, one after the other."""
    ends = np.cumsum(counts)
    return np.arange(int(ends[-1]) if len(ends) else 0) - np.repeat(ends - counts, counts)


def below_edges(u: Grid, v: Grid, width: int) -> tuple[Grid, Grid]:
    """The lowest and the highest grid point of the polygon of points (u, v), for every u of 0 to ``width`` - 1."""
    low, high = np.ones(width, dtype=np.int64), np.zeros(width, dtype=np.int64)
    places = np.arange(u.min(), u.max() + 1)
    low[places] = _chain(u, v, places)
    high[places] = -_chain(u, -v, places)
    return low, high


def _chain(u: Grid, v: Grid, places: Grid) -> Grid:
    """The lower side of the points' hull, rounded up, at each place."""
    order = np.lexsort((v, u))
    u, v = u[order], v[order]
    lowest = np.concatenate(([True], u[1:] != u[:-1]))
    chain = lower_chain(zip(u[lowest].tolist(), v[lowest].tolist(), strict=True))
    t, z = np.array(chain, dtype=np.int64).T
    if len(chain) == 1:
        return np.broadcast_to(z, places.shape)
    k = np.minimum(np.searchsorted(t, places, side="right") - 1, len(t) - 2)
    run, rise = t[k + 1] - t[k], z[k + 1] - z[k]
    height: Grid = z[k] - (-(rise * (places - t[k])) // run)
    return height


def in_plane(low: Grid, high: Grid, depth: int) -> Truth:
    """The places (u, v) of a picture whose column u holds low[u] to high[u]; none if low[u] > high[u]."""
    v = np.arange(depth)
    return (low[:, None] <= v) & (v <= high[:, None])

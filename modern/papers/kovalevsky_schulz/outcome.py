"""The cell list of a hull without the procedure that leads to it: from the digital polytope of the local corners.

The polytope's triangles are merged as the paper merges its own; edges in one line are merged too, so that the vertices
are those of the hull.  In raster order, with coplanar faces counted as visible, the paper's procedure has the same
vertices, in the same order, and the same faces: its points come each further in raster order than the ones before, and
a point in line or in a plane with later ones goes, all faces at it being seen.  Only the numbers of faces and edges
differ: here a face comes before another if its vertices, from the lowest number on, do.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from modern.digital.columns import reduced
from modern.digital.hull import independent
from modern.digital.polytope import polyhedron
from modern.papers.kovalevsky_schulz.cells import CellList, Economical, IntPoint, expanded
from modern.papers.kovalevsky_schulz.corners import Points
from modern.papers.kovalevsky_schulz.polyhedron import Flat, flat_hull

Numbers = NDArray[np.int64]


def hull_cells(points: Points) -> CellList | Flat:
    """The cell list of the faces of the hull of points, or ``Flat``.

    points: distinct places of one volume in raster order, shape (n, 3), at least one.
    """
    low = points.min(axis=0)
    near = points - low
    found = column_ends_of(near)
    simplex = independent(found)
    if len(simplex) < 4:
        return flat_hull(_tuples(points))
    a, b, c, d = simplex
    corner, plane = polyhedron(found, (a, b, c, d), False)
    used, corner = np.unique(corner, return_inverse=True)
    raster = np.lexsort(found[used].T)
    number = np.empty_like(raster)
    number[raster] = np.arange(len(raster))
    cycles = _cycles(number[corner.reshape(-1, 3)], plane)
    kept, flat = np.unique(np.concatenate(cycles), return_inverse=True)
    bounds = np.cumsum([0, *map(len, cycles)]).tolist()
    names = (flat + 1).tolist()
    faces = sorted(tuple(names[start:end]) for start, end in pairwise(bounds))
    return expanded(Economical(tuple(_tuples(found[used[raster[kept]]] + low)), tuple(faces)))


def column_ends_of(points: Points) -> Points:
    """Of points none of which is negative those that can be vertices: ends of columns that are on no chord."""
    x, y, z = points[np.lexsort(points.T[::-1])].T
    new = np.concatenate(([True], (x[1:] != x[:-1]) | (y[1:] != y[:-1])))
    last = np.concatenate((new[1:], [True]))
    lower = np.stack(reduced(x[new], y[new], z[new]), axis=1)
    upper = np.stack(reduced(x[last], y[last], -z[last]), axis=1) * (1, 1, -1)
    return np.unique(np.concatenate((lower, upper)), axis=0)


def _tuples(points: Points) -> list[IntPoint]:
    return list(zip(*points.T.tolist(), strict=True))


def _cycles(corner: Numbers, plane: Numbers) -> list[list[int]]:
    """The vertices of the faces that triangles make, from the lowest number on, without those between two in line."""
    plane = plane // np.gcd.reduce(plane, axis=1)[:, None]
    group = np.repeat(np.unique(plane, axis=0, return_inverse=True)[1].reshape(-1), 3)
    start, end = corner.ravel(), np.roll(corner, -1, axis=1).ravel()
    # Every edge is there twice: next to each other in this order are the two triangles at it.
    twins = np.lexsort((np.maximum(start, end), np.minimum(start, end))).reshape(-1, 2)
    border = twins[group[twins[:, 0]] != group[twins[:, 1]]].ravel()
    corners = np.bincount(start[border], minlength=int(corner.max()) + 1) > 2
    border = border[np.lexsort((start[border], group[border]))]
    group, start, end = group[border], start[border], end[border]
    width = len(corners)
    following = np.searchsorted(group * width + start, group * width + end).tolist()
    firsts = np.flatnonzero(np.concatenate(([True], group[1:] != group[:-1])))
    numbers, stays = start.tolist(), corners.tolist()
    cycles = []
    for first in firsts.tolist():
        cycle, place = [], first
        while True:
            if stays[numbers[place]]:
                cycle.append(numbers[place])
            place = following[place]
            if place == first:
                break
        cycles.append(cycle)
    return cycles

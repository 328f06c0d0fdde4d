"""Compute the cell list of a hull directly, without inserting points one by one as the paper does.

The hull of the local corners is computed as triangles, which are merged as in the paper. Edges in one line are merged
too, so all vertices are vertices of the hull. The paper's procedure in raster order, with coplanar faces visible, has
the same vertices in the same order and the same faces: each of its points is later in raster order than the ones
before, and a point in line or in a plane with later points disappears, because all faces at it are visible. Only the
numbers of faces and edges differ. Here faces are sorted by their cycles of vertices, each beginning with its lowest
number.
"""

from itertools import pairwise

import numpy as np

from modern.digital.hull import independent
from modern.digital.intervals import reduced
from modern.digital.polytope import polyhedron
from modern.papers.kovalevsky_schulz.cells import CellList, Economical, IntPoint, Numbers, expanded
from modern.papers.kovalevsky_schulz.corners import Points
from modern.papers.kovalevsky_schulz.polyhedron import Flat, flat_hull


def hull_cells(points: Points) -> CellList | Flat:
    """Return the hull of distinct points (n, 3) in raster order as a cell list, or ``Flat`` if they are coplanar."""
    low = points.min(axis=0)
    candidates = column_ends_of(points - low)
    simplex = independent(candidates)
    if len(simplex) < 4:
        return flat_hull(_tuples(points))
    # The digital polytope replaces the insertion of points (section 2). It has the same triangles up to their division.
    a, b, c, d = simplex
    triangles, plane = polyhedron(candidates, (a, b, c, d), False)
    # Number the vertices of the triangles in raster order, as the paper's procedure does.
    used, triangles = np.unique(triangles, return_inverse=True)
    raster = np.lexsort(candidates[used].T)
    number = np.empty_like(raster)
    number[raster] = np.arange(len(raster))
    cycles = _cycles(number[triangles.reshape(-1, 3)], plane)
    # Vertices that are in no cycle after the merging lose their numbers.
    vertices, renumbered = np.unique(np.concatenate(cycles), return_inverse=True)
    bounds = np.cumsum([0, *map(len, cycles)]).tolist()
    numbers = (renumbered + 1).tolist()
    faces = sorted(tuple(numbers[start:end]) for start, end in pairwise(bounds))
    return expanded(Economical(tuple(_tuples(candidates[used[raster[vertices]]] + low)), tuple(faces)))


def column_ends_of(points: Points) -> Points:
    """Remove points that cannot be vertices of the hull; no coordinate may be negative.

    Only ends of columns (points with equal x and y) that lie on no chord of other ends remain.
    """
    x, y, z = points[np.lexsort(points.T[::-1])].T
    # A column is the points with one (x, y). Only its first and its last point can be vertices of the hull.
    new = np.concatenate(([True], (x[1:] != x[:-1]) | (y[1:] != y[:-1])))
    last = np.concatenate((new[1:], [True]))
    lower = np.stack(reduced(x[new], y[new], z[new]), axis=1)
    upper = np.stack(reduced(x[last], y[last], -z[last]), axis=1) * (1, 1, -1)
    return np.unique(np.concatenate((lower, upper)), axis=0)


def _tuples(points: Points) -> list[IntPoint]:
    return list(zip(*points.T.tolist(), strict=True))


def _cycles(triangles: Numbers, plane: Numbers) -> list[list[int]]:
    """Merge triangles in one plane into faces, and return the cycle of each face's vertices.

    A cycle begins with its lowest number and omits vertices in line with two others. ``triangles`` has the shape (n, 3)
    and ``plane`` the shape (n, 4).
    """
    plane = plane // np.gcd.reduce(plane, axis=1)[:, None]
    # Half-edge k belongs to triangle k // 3; group is the number of its plane.
    group = np.repeat(np.unique(plane, axis=0, return_inverse=True)[1].reshape(-1), 3)
    start, end = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
    # Every edge has two half-edges, which are neighbours in this order. It is on a border if their planes differ.
    twins = np.lexsort((np.maximum(start, end), np.minimum(start, end))).reshape(-1, 2)
    border = twins[group[twins[:, 0]] != group[twins[:, 1]]].ravel()
    # A vertex with only two border edges lies in line with its neighbours.
    is_vertex = np.bincount(start[border], minlength=int(triangles.max()) + 1) > 2
    border = border[np.lexsort((start[border], group[border]))]
    group, start, end = group[border], start[border], end[border]
    # In each plane a vertex starts at most one border half-edge, so (plane, vertex) determines the successor.
    width = len(is_vertex)
    following = np.searchsorted(group * width + start, group * width + end).tolist()
    firsts = np.flatnonzero(np.concatenate(([True], group[1:] != group[:-1])))
    numbers, remains = start.tolist(), is_vertex.tolist()
    cycles = []
    for first in firsts.tolist():
        cycle, half_edge = [], first
        while True:
            if remains[numbers[half_edge]]:
                cycle.append(numbers[half_edge])
            half_edge = following[half_edge]
            if half_edge == first:
                break
        cycles.append(cycle)
    return cycles

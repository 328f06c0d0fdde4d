"""Helpers for tests of digital hulls: random solids, and the grid points of a hull by the exact judge."""

import random
from typing import Any

import numpy as np

from modern.exact_hull import exact_hull


def random_solid(source: random.Random, side: int, steps: int = 120) -> Any:
    """Return a 6-connected solid: voxels added one by one next to existing ones, in a box with random sides."""
    shape = tuple(source.randint(1, side) for _ in range(3))
    voxels = [tuple(source.randrange(length) for length in shape)]
    array = np.zeros(shape, dtype=np.bool_)
    array[voxels[0]] = True
    for _ in range(source.randint(0, steps)):
        place = list(source.choice(voxels))
        axis = source.randrange(3)
        place[axis] += source.choice((-1, 1))
        if 0 <= place[axis] < shape[axis] and not array[tuple(place)]:
            array[tuple(place)] = True
            voxels.append(tuple(place))
    return array


def judged(array: Any) -> tuple[int, Any]:
    """Return dimension and grid points of the hull of a volume, testing every point of the box against every facet."""
    shape = array.shape + (1,) * (3 - array.ndim)
    hull = exact_hull(np.argwhere(array.reshape(shape)))
    points = np.array(hull.scaled, dtype=object)
    grid = np.argwhere(np.ones(shape, dtype=np.bool_)).astype(object)
    inside = np.ones(len(grid), dtype=np.bool_)
    if hull.dimension == 0:
        inside = (grid == points[0]).all(axis=1)
    elif hull.dimension == 1:
        first, last = (points[k] for k in hull.vertices)
        inside = ~np.cross(grid - first, last - first).any(axis=1)
    elif hull.plane is not None:
        inside = grid @ np.array(hull.plane[:3], dtype=object) + hull.plane[3] == 0
    for facet in hull.facets:
        inside &= (grid @ np.array(facet.plane[:3], dtype=object) + facet.plane[3] <= 0).astype(np.bool_)
    return hull.dimension, inside.reshape(array.shape)


def solid_of(voxels: Any) -> Any:
    """Return the smallest array that contains these voxels."""
    corners = np.array(voxels)
    corners -= corners.min(axis=0)
    array = np.zeros(corners.max(axis=0) + 1, dtype=np.bool_)
    array[tuple(corners.T)] = True
    return array

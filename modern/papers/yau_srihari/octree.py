"""Octrees of digital solids (section 5; Jackins and Tanimoto 1980), as arrays: linear octrees.

Of a tree the full leaves alone are kept, each by its code and its level, sorted (Gargantini, "Linear octtrees for fast
processing of three-dimensional objects", 1982): every divided node has a full leaf below it and an empty part, so all
other nodes follow.  The code of a node is the number of its lowest voxel where the cube's voxels are counted son by
son; three bits of it say which son to take at each level.  Son 2 i + k is the half k (0 lower, 1 upper) of the cube's
column over quadrant i: this is how section 5 associates octants with quadrants.  Quadrant i is x half (i mod 2), y half
(i div 2); the figures with the paper's numbers of quadrants are lost.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from modern.digital.columns import SLAB, Grid

QUADRANTS = ((0, 0), (1, 0), (0, 1), (1, 1))
"""The x and y half of each quadrant."""
ACROSS, UP, ALONG = 1, 2, 0
"""The bit of a son's number that is the half of x, of y and of z."""


@dataclass(frozen=True, slots=True, eq=False)
class Octree:
    """The full leaves of a tree over a cube.

    side: of the cube, a power of two.  codes, levels: of each full leaf, shape (n,), by increasing code; level 0 is the
    whole cube, and a leaf of level l has the side ``side >> l``.  No eight leaves fill a node together, so that two
    trees of one cube are equal where they hold the same voxels.
    """

    side: int
    codes: Grid
    levels: Grid

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Octree):
            return NotImplemented
        same = np.array_equal(self.codes, other.codes) and np.array_equal(self.levels, other.levels)
        return self.side == other.side and same

    __hash__ = None  # type: ignore[assignment]

    @property
    def depth(self) -> int:
        """The level of a single voxel."""
        return self.side.bit_length() - 1

    def voxels(self) -> Grid:
        """How many voxels each leaf has."""
        return np.int64(1) << 3 * (self.depth - self.levels)

    def corners(self) -> Grid:
        """The lowest voxel of each leaf, shape (n, 3)."""
        return np.stack([_gathered(self.codes, bit, self.depth) for bit in (ACROSS, UP, ALONG)], axis=1)

    def at_level(self, level: int) -> tuple[Grid, Grid, Grid]:
        """The full leaves of a level, counted in leaves along each axis, in the order of the sons."""
        codes = self.codes[self.levels == level] >> 3 * (self.depth - level)
        x, y, z = (_gathered(codes, bit, level) for bit in (ACROSS, UP, ALONG))
        return x, y, z


def interleaved(x: Grid, y: Grid) -> Grid:
    """Where places stand in the order of a quadtree's sons; coordinates from 0 up to 2 ** 20."""
    return _bits(x, 20, 1, 2) | _bits(y, 20, 1, 2) << 1


def side_for(length: int) -> int:
    """The least power of two that is not below ``length``."""
    return 1 << max(0, length - 1).bit_length()


def tree_of(side: int, leaves: Iterator[tuple[int, Grid, Grid, Grid]]) -> Octree:
    """The tree of full leaves: their level, and where they are, counted in leaves of this level along each axis."""
    depth = side.bit_length() - 1
    codes, levels = [np.zeros(0, dtype=np.int64)], [np.zeros(0, dtype=np.int64)]
    for level, x, y, z in leaves:
        code = _spread(x, level) << ACROSS | _spread(y, level) << UP | _spread(z, level) << ALONG
        codes.append(code << 3 * (depth - level))
        levels.append(np.full(len(code), level))
    code = np.concatenate(codes)
    order = np.argsort(code)
    return Octree(side, code[order], np.concatenate(levels)[order])


def octree(array: NDArray[np.bool_]) -> Octree:
    """The tree of voxels [x, y, z]; its cube has the side ``side_for`` the array's longest and is empty beyond it."""
    side = side_for(max(array.shape))
    return tree_of(side, _full_leaves(array, side.bit_length() - 1))


def intersection(a: Octree, b: Octree) -> Octree:
    """The tree that is full where both trees of one cube are (section 5).

    Of two nodes one lies in the other or they have no voxel in common: the leaves are those of each tree that lie in
    a leaf of the other, and those of both are taken once.  Eight of them fill no node, for it would be full in both.
    """
    ours, theirs = _within(a, b, 0), _within(b, a, 1)
    codes = np.concatenate((a.codes[ours], b.codes[theirs]))
    levels = np.concatenate((a.levels[ours], b.levels[theirs]))
    order = np.argsort(codes)
    return Octree(a.side, codes[order], levels[order])


def count(tree: Octree) -> int:
    """How many voxels are full."""
    return int(tree.voxels().sum())


def nodes(tree: Octree) -> int:
    """How many nodes the tree has, leaves included: a root, and eight sons of every divided node."""
    return 1 + 8 * sum(divided(tree, level) for level in range(tree.depth))


def divided(tree: Octree, level: int) -> int:
    """How many nodes of a level are divided: those above a full leaf of a deeper level."""
    above = tree.codes[tree.levels > level] >> 3 * (tree.depth - level)
    return int(np.count_nonzero(np.diff(above))) + bool(len(above))


def voxels_of(tree: Octree, shape: tuple[int, int, int]) -> NDArray[np.bool_]:
    """The voxels of a tree as an array [x, y, z] of a shape; those of its cube that lie beyond it are left out."""
    array = np.zeros((1, 1, 1), dtype=np.bool_)
    for level in range(tree.depth + 1):
        side = tree.side >> level
        if level:
            array = _doubled(array, tuple(-(-length // side) for length in shape))
        x, y, z = tree.at_level(level)
        there = (x < array.shape[0]) & (y < array.shape[1]) & (z < array.shape[2])
        array[x[there], y[there], z[there]] = True
    return array


def _full_leaves(array: NDArray[np.bool_], depth: int) -> Iterator[tuple[int, Grid, Grid, Grid]]:
    """The full cubes of each level, from the voxels up, that lie in no full cube of the level above."""
    for level in range(depth, -1, -1):
        above = _all_of_eight(array)
        step = 2 * max(1, SLAB // max(1, 2 * array[0].size))
        for first in range(0, len(array), step):
            own = array[first : first + step].copy()
            over = above[first // 2 : (first + step) // 2]
            apart = ~np.repeat(over, 2, axis=2)
            length, width, height = (2 * size for size in over.shape)
            for i, j in QUADRANTS:
                own[i:length:2, j:width:2, :height] &= apart
            x, y, z = np.unravel_index(np.flatnonzero(own), own.shape)
            yield level, x + first, y, z
        if not above.size:
            return
        array = above


def _all_of_eight(array: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Which cubes of two voxels a side are full; of those that reach out of the array none is."""
    for axis in range(3):
        length = array.shape[axis] // 2 * 2
        low, high = ((slice(None),) * axis + (slice(k, length, 2),) for k in (0, 1))
        array = array[low] & array[high]
    return array


def _doubled(array: NDArray[np.bool_], shape: tuple[int, ...]) -> NDArray[np.bool_]:
    """An array with eight voxels for each, cut to a shape."""
    found = np.empty(shape, dtype=np.bool_)
    along = np.repeat(array, 2, axis=2)[:, :, : shape[2]]
    for i, j in QUADRANTS:
        part = found[i::2, j::2]
        part[...] = along[: part.shape[0], : part.shape[1]]
    return found


def _spread(numbers: Grid, count: int) -> Grid:
    """Numbers of so many bits with their bits three apart."""
    return _bits(np.arange(1 << count), count, 1, 3)[numbers]


def _gathered(codes: Grid, first: int, count: int) -> Grid:
    """The number of so many bits that stand three apart in codes, from a first one on."""
    return _bits(codes >> first, count, 3, 1)


def _bits(numbers: Grid, count: int, apart: int, then: int) -> Grid:
    """So many bits of numbers, which stand so far apart, so far apart then."""
    found = np.zeros_like(numbers)
    for k in range(count):
        found |= (numbers >> apart * k & 1) << then * k
    return found


def _within(a: Octree, b: Octree, deeper: int) -> NDArray[np.bool_]:
    """Which leaves of a tree lie in a leaf of another, and at least so many levels deeper."""
    if not len(b.codes):
        return np.zeros(len(a.codes), dtype=np.bool_)
    at = np.searchsorted(b.codes, a.codes, side="right") - 1
    inside: NDArray[np.bool_] = (at >= 0) & (a.codes < (b.codes + b.voxels())[at]) & (a.levels >= b.levels[at] + deeper)
    return inside

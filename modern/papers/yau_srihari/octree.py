"""Octrees of voxel solids as arrays of codes: linear octrees (section 5; Jackins and Tanimoto 1980).

A linear octree stores only the full leaves, each as a code and a level, sorted by code. All other nodes can be derived
from the full leaves, because every divided node has a full leaf below it. The code of a leaf is the code of its first
voxel. The codes of voxels count the voxels of the cube from 0, son by son. Three bits of the code select the son at
each level.

As in section 5, each quadrant i of the square (x, y) belongs to two octants, sons of a node: son 2 i is the lower half
of the node's cube over the quadrant, and son 2 i + 1 is the upper half. Quadrant i is the half i mod 2 in x and the
half i div 2 in y. The paper may number the quadrants differently, but its figures, which showed the numbers, are lost.

References
----------
I. Gargantini, "Linear octtrees for fast processing of three-dimensional objects", 1982.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from modern.digital.intervals import Grid

# The halves of x and y that each quadrant covers: 0 lower, 1 upper.
QUADRANTS = ((0, 0), (1, 0), (0, 1), (1, 1))
# The bits of a son's number that select the half of x, of y and of z.
ACROSS, UP, ALONG = 1, 2, 0


@dataclass(frozen=True, slots=True, eq=False)
class Octree:
    """The cubes that together fill a solid: the full leaves of an octree, whose voxels all belong to the solid.

    ``side`` is the side of the octree's cube, a power of two. ``codes`` and ``levels``, of shape (n,), have an entry
    for each leaf, sorted by code. Level 0 is the whole cube, and a leaf of level l has the side ``side >> l``. Eight
    leaves never fill a node together, so two octrees of the same cube are equal if and only if they have the same
    voxels.
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
        """The lowest level of the tree, at which a cube is a single voxel."""
        return self.side.bit_length() - 1

    def voxels(self) -> Grid:
        return np.int64(1) << 3 * (self.depth - self.levels)

    def corners(self) -> Grid:
        """Return the lowest voxel of each leaf as an array of shape (n, 3)."""
        return np.stack([_gathered(self.codes, bit, self.depth) for bit in (ACROSS, UP, ALONG)], axis=1)

    def at_level(self, level: int) -> tuple[Grid, Grid, Grid]:
        """Return the positions x, y, z of the leaves of a level in units of their side, in the order of their codes."""
        codes = self.codes[self.levels == level] >> 3 * (self.depth - level)
        x, y, z = (_gathered(codes, bit, level) for bit in (ACROSS, UP, ALONG))
        return x, y, z


def interleaved(x: Grid, y: Grid) -> Grid:
    """Return the position of each cell (x, y) in a quadtree's order of cells, for coordinates from 0 to 2^20 - 1."""
    return _bits(x, 20, 1, 2) | _bits(y, 20, 1, 2) << 1


def side_for(length: int) -> int:
    """Return the side of the smallest cube for an octree: the least power of two that is at least ``length``."""
    return 1 << max(0, length - 1).bit_length()


def tree_of(side: int, leaves: Iterator[tuple[int, Grid, Grid, Grid]]) -> Octree:
    """Return the octree of full cubes, given level by level with their positions x, y, z in units of their side."""
    depth = side.bit_length() - 1
    codes, levels = [np.zeros(0, dtype=np.int64)], [np.zeros(0, dtype=np.int64)]
    for level, x, y, z in leaves:
        # The code interleaves the bits of z, x and y. The bits below the leaf's level are 0, as for its lowest voxel.
        code = _spread(x, level) << ACROSS | _spread(y, level) << UP | _spread(z, level) << ALONG
        codes.append(code << 3 * (depth - level))
        levels.append(np.full(len(code), level))
    code = np.concatenate(codes)
    order = np.argsort(code)
    return Octree(side, code[order], np.concatenate(levels)[order])


def octree(array: NDArray[np.bool_]) -> Octree:
    """Return the octree of an array of voxels indexed [x, y, z]. The part of its cube beyond the array is empty."""
    side = side_for(max(array.shape))
    return tree_of(side, _full_leaves(array, side.bit_length() - 1))


def intersection(a: Octree, b: Octree) -> Octree:
    """Return the octree of the voxels that two octrees of the same cube have in common (section 5).

    Two nodes are either nested or disjoint. The leaves of the intersection are therefore the leaves of each octree that
    lie in a leaf of the other octree. Eight of them never fill a node, because that node would be full in both octrees.
    """
    # A leaf of both trees counts once: a leaf of b must lie in a larger leaf of a.
    a_in_b, b_in_a = _within(a, b, 0), _within(b, a, 1)
    codes = np.concatenate((a.codes[a_in_b], b.codes[b_in_a]))
    levels = np.concatenate((a.levels[a_in_b], b.levels[b_in_a]))
    order = np.argsort(codes)
    return Octree(a.side, codes[order], levels[order])


def count(tree: Octree) -> int:
    """Return the number of voxels of an octree's solid."""
    return int(tree.voxels().sum())


def nodes(tree: Octree) -> int:
    """Return the number of nodes of an octree: the root, and eight sons for each divided node."""
    return 1 + 8 * sum(divided(tree, level) for level in range(tree.depth))


def divided(tree: Octree, level: int) -> int:
    """Return the number of nodes of a level that are divided because only some of their voxels belong to the solid."""
    ancestors = tree.codes[tree.levels > level] >> 3 * (tree.depth - level)
    return int(np.count_nonzero(np.diff(ancestors))) + bool(len(ancestors))


def voxels_of(tree: Octree, shape: tuple[int, int, int]) -> NDArray[np.bool_]:
    """Return the voxels of an octree that lie in an array of the given shape, indexed [x, y, z]."""
    array = np.zeros(shape, dtype=np.bool_)
    sides = tree.side >> tree.levels
    for (x, y, z), side in zip(tree.corners().tolist(), sides.tolist(), strict=True):
        array[x : x + side, y : y + side, z : z + side] = True
    return array


def _full_leaves(array: NDArray[np.bool_], depth: int) -> Iterator[tuple[int, Grid, Grid, Grid]]:
    """Yield the full cubes of an array that are in no larger full cube, level by level, starting with voxels."""
    for level in range(depth, -1, -1):
        parents = _all_of_eight(array)
        # A cube that lies in a full cube of twice its side is not a leaf.
        leaves = array.copy()
        length, width, height = (2 * size for size in parents.shape)
        for (i, j), k in product(QUADRANTS, (0, 1)):
            leaves[i:length:2, j:width:2, k:height:2] &= ~parents
        x, y, z = np.unravel_index(np.flatnonzero(leaves), leaves.shape)
        yield level, x, y, z
        if not parents.size:
            return
        array = parents


def _all_of_eight(array: NDArray[np.bool_]) -> NDArray[np.bool_]:
    for axis in range(3):
        length = array.shape[axis] // 2 * 2
        low, high = ((slice(None),) * axis + (slice(k, length, 2),) for k in (0, 1))
        array = array[low] & array[high]
    return array


def _spread(numbers: Grid, count: int) -> Grid:
    return _bits(np.arange(1 << count), count, 1, 3)[numbers]


def _gathered(codes: Grid, first: int, count: int) -> Grid:
    return _bits(codes >> first, count, 3, 1)


def _bits(numbers: Grid, count: int, old_distance: int, new_distance: int) -> Grid:
    """Return numbers whose ``count`` bits are ``new_distance`` apart instead of ``old_distance``."""
    moved = np.zeros_like(numbers)
    for k in range(count):
        moved |= (numbers >> old_distance * k & 1) << new_distance * k
    return moved


def _within(a: Octree, b: Octree, deeper: int) -> NDArray[np.bool_]:
    """Return a mask of the leaves of ``a`` that lie in a leaf of ``b`` and are at least ``deeper`` levels below it."""
    if not len(b.codes):
        return np.zeros(len(a.codes), dtype=np.bool_)
    # The voxels of a leaf have consecutive codes, so only the last leaf of b whose code is not greater can contain it.
    at = np.searchsorted(b.codes, a.codes, side="right") - 1
    inside: NDArray[np.bool_] = (at >= 0) & (a.codes < (b.codes + b.voxels())[at]) & (a.levels >= b.levels[at] + deeper)
    return inside

"""Quadtrees that hold a height for each column (x, y) of a solid: its floor or its ceiling (section 5).

A tree is stored as arrays over its square: the height of each column, whether the column exists (a dotted branch of the
paper's trees is a missing column), and whether it is marked. A node is a square of columns. The values of a node, the
least and the greatest height of its unmarked columns, are computed level by level. Sons are numbered as in
:mod:`modern.papers.yau_srihari.octree`.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from modern.digital.intervals import Grid, Truth
from modern.papers.yau_srihari.octree import QUADRANTS, Octree, tree_of

Place = tuple[int, int]
Point = tuple[int, int, int]

# The height stored for a missing column, greater than every height.
NO_COLUMN = np.iinfo(np.int64).max


@dataclass(frozen=True, slots=True)
class Leaf:
    """The height of one column, and True if the column is marked because it belongs to a face of the envelope."""

    value: int
    marked: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Quadtree:
    """Heights over a square of columns [x, y] whose side is a power of two.

    ``values`` has the height of each column, or 0 for a missing column. ``there`` is True for columns that exist, and
    ``marked`` is True for columns that are known to belong to a face. ``sides`` has, for each column, the side of the
    leaf (a square of columns of one height) that contains the column.
    """

    values: Grid
    there: Truth
    marked: Truth
    sides: NDArray[np.int64]

    @property
    def side(self) -> int:
        return len(self.values)

    @property
    def low(self) -> int | None:
        """The least height of unmarked columns (the value of a node of the paper's floor tree), or None without any."""
        unmarked = self.values[self.there & ~self.marked]
        return int(unmarked.min()) if unmarked.size else None

    @property
    def high(self) -> int | None:
        """The greatest height of unmarked columns, or None without any. Only section 4.6.2 as printed needs it."""
        unmarked = self.values[self.there & ~self.marked]
        return int(unmarked.max()) if unmarked.size else None

    def is_leaf(self) -> bool:
        """Return True if all columns of the square belong to one leaf and therefore have the same height."""
        return bool(self.there.all()) and int(self.sides.min()) >= self.side


def no_columns(side: int) -> Quadtree:
    none = np.zeros((side, side), dtype=np.bool_)
    return Quadtree(np.zeros((side, side), dtype=np.int64), none, none, np.ones((side, side), dtype=np.int64))


def sons_of(tree: Quadtree) -> tuple[Quadtree, ...]:
    half = tree.side // 2
    parts = [(slice(i * half, (i + 1) * half), slice(j * half, (j + 1) * half)) for i, j in QUADRANTS]
    return tuple(Quadtree(tree.values[p], tree.there[p], tree.marked[p], tree.sides[p]) for p in parts)


def floor(tree: Octree) -> Quadtree:
    """Return the quadtree of the height of the lowest voxel of each column of a solid (section 5)."""
    return _lowest(tree, downward=False)


def ceiling(tree: Octree) -> Quadtree:
    """Return the quadtree of the height of the highest voxel of each column of a solid (section 5)."""
    return mirrored(_lowest(tree, downward=True))


def _lowest(tree: Octree, downward: bool) -> Quadtree:
    """Return the height of the lowest voxel of each column of a solid, or of the solid reflected in z if ``downward``.

    Among the leaves of one level over a square, the first in the order of codes is the lowest and the last the highest.
    Leaves of other levels may be lower, so the minimum over all levels is taken.
    """
    values = np.full((1, 1), NO_COLUMN)
    sides = np.ones((1, 1), dtype=np.int64)
    for level in range(tree.depth + 1):
        if level:
            values, sides = (np.repeat(np.repeat(grid, 2, axis=0), 2, axis=1) for grid in (values, sides))
        side = tree.side >> level
        x, y, z = tree.at_level(level)
        of_level = np.full_like(values, NO_COLUMN)
        # NumPy assigns in order, so the last of several leaves over one square remains.
        if downward:
            of_level[x, y] = 1 - side * (z + 1)
        else:
            of_level[x[::-1], y[::-1]] = side * z[::-1]
        sides[of_level < values] = side
        np.minimum(values, of_level, out=values)
    there = values < NO_COLUMN
    return Quadtree(np.where(there, values, 0), there, np.zeros_like(there), sides)


def mirrored(tree: Quadtree) -> Quadtree:
    return replace(tree, values=-tree.values)


def heights(tree: Quadtree) -> dict[Place, int]:
    x, y = np.nonzero(tree.there)
    return dict(zip(zip(x.tolist(), y.tolist(), strict=True), tree.values[x, y].tolist(), strict=True))


def line(tree: Quadtree, axis: int, at: int) -> Iterator[tuple[int, int]]:
    """Return the columns whose coordinate on ``axis`` is ``at``, as pairs of their other coordinate and their height.

    In the paper this line is a binary subtree of the quadtree, with two sons at every node (section 5).
    """
    there, values = (grid[at] if axis == 0 else grid[:, at] for grid in (tree.there, tree.values))
    return zip(np.flatnonzero(there).tolist(), values[there].tolist(), strict=True)


def with_columns(tree: Quadtree, x: Grid, y: Grid, z: Grid, marked: Truth | bool = False) -> Quadtree:
    """Return the tree with the columns (x, y) set to the heights z, each as a separate leaf."""
    copy = Quadtree(tree.values.copy(), tree.there.copy(), tree.marked.copy(), tree.sides.copy())
    copy.values[x, y], copy.there[x, y], copy.marked[x, y], copy.sides[x, y] = z, True, marked, 1
    return copy


def written(tree: Quadtree, cells: Mapping[Place, Leaf]) -> Quadtree:
    """Return the tree with the heights and marks of the given columns replaced."""
    x, y = np.array([*cells], dtype=np.int64).reshape(-1, 2).T
    values = np.array([leaf.value for leaf in cells.values()], dtype=np.int64)
    return with_columns(tree, x, y, values, np.array([leaf.marked for leaf in cells.values()], dtype=np.bool_))


def bounds_by_level(tree: Quadtree) -> list[tuple[Grid, Grid]]:
    """Return the least and the greatest unmarked heights of all squares, for each level from columns to the whole tree.

    A square without unmarked columns has the least height ``NO_COLUMN`` and the greatest height ``-NO_COLUMN``.
    """
    unmarked = tree.there & ~tree.marked
    levels = [(np.where(unmarked, tree.values, NO_COLUMN), np.where(unmarked, tree.values, -NO_COLUMN))]
    while len(levels[-1][0]) > 1:
        low, high = (grid.reshape(len(grid) // 2, 2, -1, 2) for grid in levels[-1])
        levels.append((low.min(axis=(1, 3)), high.max(axis=(1, 3))))
    return levels


def graph_side(tree: Quadtree, above: bool) -> Octree:
    """Return the octree of the voxels at and above a tree's heights, or at and below if not ``above`` (section 5).

    The paper generates sons 2 i and 2 i + 1 of the octree from son i of the quadtree.
    """
    # The voxels above the heights are stacked from the top down, and the voxels below the heights from the bottom up.
    filled = tree.side - tree.values if above else tree.values + 1
    return tree_of(tree.side, _stacks(np.where(tree.there, np.clip(filled, 0, tree.side), 0), above))


def _stacks(filled: Grid, above: bool) -> Iterator[tuple[int, Grid, Grid, Grid]]:
    """Yield the leaves, level by level, of the octree in which each column has ``filled`` voxels at the bottom.

    If ``above``, the voxels are at the top. The shortest column over a square determines the number of full cubes over
    the square. The lowest of these cubes lie in full cubes of the next larger size, two in each, and are not leaves.
    """
    size = len(filled)
    for level in range(size.bit_length() - 1, -1, -1):
        side = size >> level
        cubes = filled // side
        filled = filled.reshape(len(filled) // 2, 2, -1, 2).min(axis=(1, 3)) if level else np.zeros((1, 1), np.int64)
        in_larger = 2 * (filled // (2 * side))
        first = np.repeat(np.repeat(in_larger, 2, axis=0), 2, axis=1)[: len(cubes), : len(cubes)]
        count = cubes - first
        x, y = np.nonzero(count)
        count, first = count[x, y], first[x, y]
        # Over each square the cubes first, first + 1, ..., first + count - 1 are leaves, listed in one flat array.
        z = np.arange(count.sum()) + np.repeat(first - np.cumsum(count) + count, count)
        x, y = np.repeat(x, count), np.repeat(y, count)
        yield level, x, y, (1 << level) - 1 - z if above else z

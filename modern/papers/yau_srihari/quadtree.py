"""Quadtrees of heights: floor and ceiling of a solid (section 5).

A tree is held by its columns, as arrays over its square: the height of each, whether there is a column (the figures'
dotted branches have none) and whether it is marked.  A node is a square of them; its values, the least and the
greatest height over the columns in it that are not marked, are found level by level.  Sons are numbered as in
:mod:`modern.papers.yau_srihari.octree`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from modern.digital.columns import Grid, Truth
from modern.papers.yau_srihari.octree import QUADRANTS, Octree, tree_of

Place = tuple[int, int]
Point = tuple[int, int, int]

NO_COLUMN = np.iinfo(np.int64).max
"""Above every height."""


@dataclass(frozen=True, slots=True)
class Leaf:
    """The height of a column; ``marked``: found to belong to a face."""

    value: int
    marked: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Quadtree:
    """Heights over a square of places [x, y] whose side is a power of two.

    values: whole numbers, 0 where there is no column.  there: where there is one.  marked: those found to belong to a
    face.  sides: of the leaf that each column is in, where one height holds in all of a square.
    """

    values: Grid
    there: Truth
    marked: Truth
    sides: NDArray[np.int64]

    @property
    def side(self) -> int:
        """Of the square."""
        return len(self.values)

    @property
    def low(self) -> int | None:
        """The least unmarked height, None if there is none: the value of the paper's floor tree."""
        found = self.values[self.there & ~self.marked]
        return int(found.min()) if found.size else None

    @property
    def high(self) -> int | None:
        """The greatest unmarked height, None if there is none.  It serves section 4.6.2 as printed only."""
        found = self.values[self.there & ~self.marked]
        return int(found.max()) if found.size else None

    def is_leaf(self) -> bool:
        """Whether one height holds in all of the square by one leaf."""
        return bool(self.there.all()) and int(self.sides.min()) >= self.side


def no_columns(side: int) -> Quadtree:
    """The tree without a column."""
    none = np.zeros((side, side), dtype=np.bool_)
    return Quadtree(np.zeros((side, side), dtype=np.int64), none, none, np.ones((side, side), dtype=np.int64))


def sons_of(tree: Quadtree) -> tuple[Quadtree, ...]:
    """The four sons of a node."""
    half = tree.side // 2
    parts = [(slice(i * half, (i + 1) * half), slice(j * half, (j + 1) * half)) for i, j in QUADRANTS]
    return tuple(Quadtree(tree.values[p], tree.there[p], tree.marked[p], tree.sides[p]) for p in parts)


def floor(tree: Octree) -> Quadtree:
    """The floor of a solid: visiting sons 0 to 7 in order, a value once assigned stays (section 5)."""
    return _lowest(tree, downward=False)


def ceiling(tree: Octree) -> Quadtree:
    """The ceiling of a solid: visiting sons 0 to 7 in order, a value is always overwritten (section 5)."""
    return mirrored(_lowest(tree, downward=True))


def _lowest(tree: Octree, downward: bool) -> Quadtree:
    """The floor level by level; or, seen downward, that of the negative heights.

    Of the leaves of one level over a square the first in the order of the sons is the lowest, the last the highest;
    those of other levels may lie lower or higher.
    """
    values = np.full((1, 1), NO_COLUMN)
    sides = np.ones((1, 1), dtype=np.int64)
    for level in range(tree.depth + 1):
        if level:
            values, sides = (np.repeat(np.repeat(grid, 2, axis=0), 2, axis=1) for grid in (values, sides))
        side = tree.side >> level
        x, y, z = tree.at_level(level)
        own = np.full_like(values, NO_COLUMN)
        if downward:
            own[x, y] = 1 - side * (z + 1)
        else:
            own[x[::-1], y[::-1]] = side * z[::-1]
        sides[own < values] = side
        np.minimum(values, own, out=values)
    there = values < NO_COLUMN
    return Quadtree(np.where(there, values, 0), there, np.zeros_like(there), sides)


def mirrored(tree: Quadtree) -> Quadtree:
    """The tree of the negative heights."""
    return replace(tree, values=-tree.values)


def heights(tree: Quadtree) -> dict[Place, int]:
    """Every column with its height."""
    x, y = np.nonzero(tree.there)
    return dict(zip(zip(x.tolist(), y.tolist(), strict=True), tree.values[x, y].tolist(), strict=True))


def line(tree: Quadtree, axis: int, at: int) -> Iterator[tuple[int, int]]:
    """The line of columns whose coordinate ``axis`` is ``at``: other coordinate and height, sorted.

    It is a binary subtree of the quadtree: at every node two sons (Yau and Srihari, TR-170; section 5).
    """
    there, values = (grid[at] if axis == 0 else grid[:, at] for grid in (tree.there, tree.values))
    return zip(np.flatnonzero(there).tolist(), values[there].tolist(), strict=True)


def with_columns(tree: Quadtree, x: Grid, y: Grid, z: Grid, marked: Truth | bool = False) -> Quadtree:
    """The tree with columns at places (x, y) written, each with a leaf of its own; all others stay as they are."""
    found = Quadtree(tree.values.copy(), tree.there.copy(), tree.marked.copy(), tree.sides.copy())
    found.values[x, y], found.there[x, y], found.marked[x, y], found.sides[x, y] = z, True, marked, 1
    return found


def written(tree: Quadtree, cells: Mapping[Place, Leaf]) -> Quadtree:
    """The tree with some columns' leaves written; the values of the nodes above follow."""
    x, y = np.array([*cells], dtype=np.int64).reshape(-1, 2).T
    values = np.array([leaf.value for leaf in cells.values()], dtype=np.int64)
    return with_columns(tree, x, y, values, np.array([leaf.marked for leaf in cells.values()], dtype=np.bool_))


def bounds_by_level(tree: Quadtree) -> list[tuple[Grid, Grid]]:
    """The least and the greatest unmarked height of every square, from the single columns up to the whole.

    Where all columns are marked, or there is none, the least is ``NO_COLUMN`` and the greatest its negative.
    """
    open_ = tree.there & ~tree.marked
    found = [(np.where(open_, tree.values, NO_COLUMN), np.where(open_, tree.values, -NO_COLUMN))]
    while len(found[-1][0]) > 1:
        low, high = (grid.reshape(len(grid) // 2, 2, -1, 2) for grid in found[-1])
        found.append((low.min(axis=(1, 3)), high.max(axis=(1, 3))))
    return found


def graph_side(tree: Quadtree, above: bool) -> Octree:
    """The epigraph of a tree's heights (``above``) or their hypograph as an octree (section 5).

    Sons 2 i and 2 i + 1 come from son i: a voxel is full if its third coordinate is not smaller (not greater) than
    the value of its column.
    """
    # The epigraph is the hypograph turned over; a column is as many full voxels from the bottom up.
    filled = tree.side - tree.values if above else tree.values + 1
    return tree_of(tree.side, _stacks(np.where(tree.there, np.clip(filled, 0, tree.side), 0), above))


def _stacks(filled: Grid, above: bool) -> Iterator[tuple[int, Grid, Grid, Grid]]:
    """The full leaves, level by level, of columns of so many voxels, from the bottom up or (``above``) the top down.

    Over a square stand as many full cubes as fit under its lowest column.  Those in a full cube of the level above are
    not leaves: they are the lowest, two for each of that cube's.
    """
    size = len(filled)
    for level in range(size.bit_length() - 1, -1, -1):
        side = size >> level
        cubes = filled // side
        filled = filled.reshape(len(filled) // 2, 2, -1, 2).min(axis=(1, 3)) if level else np.zeros((1, 1), np.int64)
        within = 2 * (filled // (2 * side))
        first = np.repeat(np.repeat(within, 2, axis=0), 2, axis=1)[: len(cubes), : len(cubes)]
        count = cubes - first
        x, y = np.nonzero(count)
        count, first = count[x, y], first[x, y]
        z = np.arange(count.sum()) + np.repeat(first - np.cumsum(count) + count, count)
        x, y = np.repeat(x, count), np.repeat(y, count)
        yield level, x, y, (1 << level) - 1 - z if above else z

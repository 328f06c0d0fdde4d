"""Octrees and quadtrees of heights as objects, a tuple a node: the plain way, for tests of those held in arrays.

An octree is True where every voxel of its cube is full, False where none is, else its eight sons.  A quadtree of
heights is None where it has no column, a number where one height holds in all of it, else its four sons.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from modern.papers.yau_srihari.octree import QUADRANTS, Octree
from modern.papers.yau_srihari.quadtree import Quadtree, sons_of


def octree(array: Any, side: int) -> Any:
    """The tree of a cube of which ``array`` is what lies in it."""
    if not array.any():
        return False
    if array.shape == (side, side, side) and array.all():
        return True
    h = side // 2
    parts = [array[i * h : (i + 1) * h, j * h : (j + 1) * h, k * h : (k + 1) * h] for i, j in QUADRANTS for k in (0, 1)]
    return tuple(octree(part, h) for part in parts)


def joined(sons: tuple[Any, ...]) -> Any:
    """A node, or a leaf where all sons are the same leaf."""
    return sons[0] if all(son is True for son in sons) or all(son is False for son in sons) else sons


def intersection(a: Any, b: Any) -> Any:
    """Full where both are."""
    if a is False or b is False:
        return False
    if a is True or b is True:
        return b if a is True else a
    return joined(tuple(intersection(p, q) for p, q in zip(a, b, strict=True)))


def count(tree: Any, side: int) -> int:
    """How many voxels are full."""
    return sum(count(son, side // 2) for son in tree) if isinstance(tree, tuple) else side**3 * tree


def nodes(tree: Any) -> int:
    """How many nodes there are, leaves included."""
    return 1 + sum(map(nodes, tree)) if isinstance(tree, tuple) else 1


def ends(tree: Any, side: int, top: bool, bottom: int = 0) -> Any:
    """The floor, or with ``top`` the ceiling: what sons 0 to 7 write, the first value, or the last."""
    if not isinstance(tree, tuple):
        return (bottom + side - 1 if top else bottom) if tree else None
    half = side // 2
    pairs = [[ends(tree[2 * i + k], half, top, bottom + k * half) for k in (0, 1)] for i in range(4)]
    sons = tuple(over(*(pair[::-1] if top else pair)) for pair in pairs)
    return None if all(son is None for son in sons) else sons


def over(first: Any, second: Any) -> Any:
    """The first tree, and the second where the first has no column."""
    if first is None or second is None:
        return second if first is None else first
    if not isinstance(first, tuple):
        return first
    seconds = second if isinstance(second, tuple) else (second,) * 4
    return tuple(over(p, q) for p, q in zip(first, seconds, strict=True))


def graph_side(tree: Any, side: int, above: bool, bottom: int = 0) -> Any:
    """The epigraph of heights, or their hypograph."""
    if tree is None:
        return False
    if not isinstance(tree, tuple):
        if (bottom >= tree) if above else (bottom + side - 1 <= tree):
            return True
        if (bottom + side - 1 < tree) if above else (bottom > tree):
            return False
    half, sons = side // 2, tree if isinstance(tree, tuple) else (tree,) * 4
    return joined(tuple(graph_side(son, half, above, bottom + k * half) for son in sons for k in (0, 1)))


def nested(tree: Octree) -> Any:
    """An octree in arrays as one of tuples: every full leaf sought from the root."""
    found: list[Any] = [False]
    for code, level in zip(tree.codes.tolist(), tree.levels.tolist(), strict=True):
        at, place = found, 0
        for k in range(level):
            if not isinstance(at[place], list):
                assert at[place] is False, "a leaf lies in another"
                at[place] = [False] * 8
            at, place = at[place], code >> 3 * (tree.depth - 1 - k) & 7
        assert at[place] is False
        assert code % 8 ** (tree.depth - level) == 0
        at[place] = True
    return frozen(found[0])


def frozen(tree: Any) -> Any:
    return tuple(map(frozen, tree)) if isinstance(tree, list) else tree


def nested_heights(tree: Quadtree) -> Any:
    """A quadtree in arrays as one of tuples."""
    if not tree.there.any():
        return None
    if tree.is_leaf():
        return int(np.unique(tree.values).item())
    return tuple(map(nested_heights, sons_of(tree)))

"""Octrees and quadtrees of heights as nested tuples, a direct implementation to compare the trees in arrays with.

An octree is True if every voxel of its cube is full, False if none is, otherwise the tuple of its eight sons. A
quadtree of heights is None if it has no column, a number if it is one leaf, otherwise the tuple of its four sons.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from modern.papers.yau_srihari.octree import QUADRANTS, Octree
from modern.papers.yau_srihari.quadtree import Quadtree, sons_of


def octree(array: Any, side: int) -> Any:
    """Build the tree of a cube that contains ``array`` at its origin and is empty otherwise."""
    if not array.any():
        return False
    if array.shape == (side, side, side) and array.all():
        return True
    h = side // 2
    parts = [array[i * h : (i + 1) * h, j * h : (j + 1) * h, k * h : (k + 1) * h] for i, j in QUADRANTS for k in (0, 1)]
    return tuple(octree(part, h) for part in parts)


def joined(sons: tuple[Any, ...]) -> Any:
    """Return a node with these sons, or a leaf if all sons are the same leaf."""
    return sons[0] if all(son is True for son in sons) or all(son is False for son in sons) else sons


def nodes(tree: Any) -> int:
    """Count the nodes, including leaves."""
    return 1 + sum(map(nodes, tree)) if isinstance(tree, tuple) else 1


def ends(tree: Any, side: int, top: bool, bottom: int = 0) -> Any:
    """Return the floor, or with ``top`` the ceiling: the first (last) height that sons 0 to 7 assign to a column."""
    if not isinstance(tree, tuple):
        return (bottom + side - 1 if top else bottom) if tree else None
    half = side // 2
    pairs = [[ends(tree[2 * i + k], half, top, bottom + k * half) for k in (0, 1)] for i in range(4)]
    sons = tuple(over(*(pair[::-1] if top else pair)) for pair in pairs)
    return None if all(son is None for son in sons) else sons


def over(first: Any, second: Any) -> Any:
    """Return the first tree with the columns that it lacks taken from the second."""
    if first is None or second is None:
        return second if first is None else first
    if not isinstance(first, tuple):
        return first
    seconds = second if isinstance(second, tuple) else (second,) * 4
    return tuple(over(p, q) for p, q in zip(first, seconds, strict=True))


def graph_side(tree: Any, side: int, above: bool, bottom: int = 0) -> Any:
    """Return the epigraph (``above``) or the hypograph of heights."""
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
    """Convert an octree in arrays to nested tuples by entering every full leaf from the root."""
    root: list[Any] = [False]
    for code, level in zip(tree.codes.tolist(), tree.levels.tolist(), strict=True):
        node, son = root, 0
        for k in range(level):
            if not isinstance(node[son], list):
                assert node[son] is False, "a leaf lies in another leaf"
                node[son] = [False] * 8
            node, son = node[son], code >> 3 * (tree.depth - 1 - k) & 7
        assert node[son] is False
        assert code % 8 ** (tree.depth - level) == 0
        node[son] = True
    return frozen(root[0])


def frozen(tree: Any) -> Any:
    return tuple(map(frozen, tree)) if isinstance(tree, list) else tree


def nested_heights(tree: Quadtree) -> Any:
    """Convert a quadtree in arrays to nested tuples."""
    if not tree.there.any():
        return None
    if tree.is_leaf():
        return int(np.unique(tree.values).item())
    return tuple(map(nested_heights, sons_of(tree)))

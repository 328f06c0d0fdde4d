"""Octrees of digital solids (section 5; Jackins and Tanimoto 1980).

A tree is True where every voxel of its cube is full, False where none is, else eight sons.  Son 2 i + k is the half
k (0 lower, 1 upper) of the cube's column over quadrant i: this is how section 5 associates octants with quadrants.
Quadrant i is x half (i mod 2), y half (i div 2); the figures with the paper's numbers of quadrants are lost.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Octree: TypeAlias = "bool | tuple[Octree, ...]"

QUADRANTS = ((0, 0), (1, 0), (0, 1), (1, 1))
"""The x and y half of each quadrant."""


def side_for(length: int) -> int:
    """The least power of two that is not below ``length``."""
    return 1 << max(0, length - 1).bit_length()


def octree(array: NDArray[np.bool_]) -> Octree:
    """The tree of voxels [x, y, z]; its cube has the side ``side_for`` the array's longest and is empty beyond it."""
    return _divided(array, side_for(max(array.shape)))


def joined(sons: tuple[Octree, ...]) -> Octree:
    """A node of eight sons; a leaf where all are full, or all empty."""
    if all(son is True for son in sons) or all(son is False for son in sons):
        return sons[0]
    return sons


def intersection(a: Octree, b: Octree) -> Octree:
    """Both trees in parallel: a node is full only if it is full in both (section 5)."""
    if a is False or b is False:
        return False
    if a is True or b is True:
        return b if a is True else a
    assert isinstance(a, tuple)
    assert isinstance(b, tuple)
    return joined(tuple(intersection(p, q) for p, q in zip(a, b, strict=True)))


def count(tree: Octree, side: int) -> int:
    """How many voxels are full."""
    if isinstance(tree, bool):
        return side**3 if tree else 0
    return sum(count(son, side // 2) for son in tree)


def nodes(tree: Octree) -> int:
    """How many nodes the tree has, leaves included."""
    return 1 if isinstance(tree, bool) else 1 + sum(nodes(son) for son in tree)


def voxels_of(tree: Octree, side: int, shape: tuple[int, int, int]) -> NDArray[np.bool_]:
    """The voxels of a tree as an array [x, y, z] of a shape; those of its cube that lie beyond it are left out."""
    array = np.zeros(shape, dtype=np.bool_)
    _paint(tree, array, side)
    return array


def _divided(part: NDArray[np.bool_], side: int) -> Octree:
    """The tree of a cube of which ``part`` is what lies in the array."""
    if not part.any():
        return False
    if part.shape == (side, side, side) and part.all():
        return True
    return tuple(_divided(octant, side // 2) for octant in _octants(part, side // 2))


def _paint(tree: Octree, part: NDArray[np.bool_], side: int) -> None:
    if isinstance(tree, bool):
        part[...] = tree
    elif part.size:
        for son, octant in zip(tree, _octants(part, side // 2), strict=True):
            _paint(son, octant, side // 2)


def _octants(part: NDArray[np.bool_], half: int) -> Iterator[NDArray[np.bool_]]:
    """The eight parts of a cube in the order of the sons, each as far as it lies in the array."""
    for i, j in QUADRANTS:
        for k in (0, 1):
            yield part[i * half : (i + 1) * half, j * half : (j + 1) * half, k * half : (k + 1) * half]

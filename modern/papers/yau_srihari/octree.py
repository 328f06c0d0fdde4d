"""Octrees of digital solids (section 5; Jackins and Tanimoto 1980).

A tree is True where every voxel of its cube is full, False where none is, else eight sons.  Son 2 i + k is the half
k (0 lower, 1 upper) of the cube's column over quadrant i: this is how section 5 associates octants with quadrants.
Quadrant i is x half (i mod 2), y half (i div 2); the figures with the paper's numbers of quadrants are lost.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Octree: TypeAlias = "bool | tuple[Octree, ...]"

QUADRANTS = ((0, 0), (1, 0), (0, 1), (1, 1))
"""The x and y half of each quadrant."""


def side_for(length: int) -> int:
    """The least power of two that is not below ``length``."""
    return 1 << max(0, length - 1).bit_length()


def octree(cube: NDArray[np.bool_]) -> Octree:
    """The tree of a cube of voxels [x, y, z] whose side is a power of two."""
    if cube.all():
        return True
    if not cube.any():
        return False
    half = len(cube) // 2
    return tuple(
        octree(cube[i * half : (i + 1) * half, j * half : (j + 1) * half, k * half : (k + 1) * half])
        for i, j in QUADRANTS
        for k in (0, 1)
    )


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


def cube_of(tree: Octree, side: int) -> NDArray[np.bool_]:
    """The voxels of a tree as an array [x, y, z]."""
    cube = np.zeros((side, side, side), dtype=np.bool_)
    _paint(tree, cube)
    return cube


def _paint(tree: Octree, cube: NDArray[np.bool_]) -> None:
    if isinstance(tree, bool):
        cube[...] = tree
        return
    half = len(cube) // 2
    for number, son in enumerate(tree):
        i, j = QUADRANTS[number // 2]
        k = number % 2
        _paint(son, cube[i * half : (i + 1) * half, j * half : (j + 1) * half, k * half : (k + 1) * half])

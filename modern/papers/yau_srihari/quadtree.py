"""Quadtrees of heights: floor and ceiling of a solid (section 5).

A tree is None where its square has no column (the figures' dotted branches), a leaf where one height holds in all of
it, else four sons, numbered as in :mod:`modern.papers.yau_srihari.octree`.  A node's values are over the leaves below
it that are not marked.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import TypeAlias

from modern.papers.yau_srihari.octree import QUADRANTS, Octree, joined

Place = tuple[int, int]
Point = tuple[int, int, int]


@dataclass(frozen=True, slots=True)
class Leaf:
    """One height in a whole square; ``marked``: found to belong to a face."""

    value: int
    marked: bool = False

    @property
    def low(self) -> int | None:
        """The height, None if marked."""
        return None if self.marked else self.value

    @property
    def high(self) -> int | None:
        """The height, None if marked."""
        return None if self.marked else self.value


@dataclass(frozen=True, slots=True)
class Node:
    """Four sons, and the least and the greatest unmarked height below; None if there is none.

    The least is the value of the paper's floor tree.  The greatest serves section 4.6.2 as printed only.
    """

    low: int | None
    high: int | None
    sons: tuple[Quadtree, Quadtree, Quadtree, Quadtree]


Quadtree: TypeAlias = "Leaf | Node | None"


def node(sons: list[Quadtree]) -> Quadtree:
    """A node of four sons; None where no son has a column."""
    there = [son for son in sons if son is not None]
    if not there:
        return None
    lows = [son.low for son in there if son.low is not None]
    highs = [son.high for son in there if son.high is not None]
    a, b, c, d = sons
    return Node(min(lows, default=None), max(highs, default=None), (a, b, c, d))


def sons_of(tree: Quadtree) -> tuple[Quadtree, Quadtree, Quadtree, Quadtree]:
    """The four sons; of a leaf, and of None, four times the same."""
    return tree.sons if isinstance(tree, Node) else (tree, tree, tree, tree)


def floor(tree: Octree, side: int, bottom: int = 0) -> Quadtree:
    """The floor of a solid: visiting sons 0 to 7 in order, a value once assigned stays (section 5)."""
    return _heights(tree, side, bottom, lambda size: 0, lambda first, second: over(first, second))


def ceiling(tree: Octree, side: int, bottom: int = 0) -> Quadtree:
    """The ceiling of a solid: visiting sons 0 to 7 in order, a value is always overwritten (section 5)."""
    return _heights(tree, side, bottom, lambda size: size - 1, lambda first, second: over(second, first))


def _heights(
    tree: Octree,
    side: int,
    bottom: int,
    above: Callable[[int], int],
    write: Callable[[Quadtree, Quadtree], Quadtree],
) -> Quadtree:
    if isinstance(tree, bool):
        return Leaf(bottom + above(side)) if tree else None
    half = side // 2
    return node(
        [
            write(
                _heights(tree[2 * i], half, bottom, above, write),
                _heights(tree[2 * i + 1], half, bottom + half, above, write),
            )
            for i in range(4)
        ]
    )


def over(first: Quadtree, second: Quadtree) -> Quadtree:
    """The first tree, and the second where the first has no column."""
    if first is None or second is None:
        return second if first is None else first
    if isinstance(first, Leaf):
        return first
    return node([over(p, q) for p, q in zip(first.sons, sons_of(second), strict=True)])


def mirrored(tree: Quadtree) -> Quadtree:
    """The tree of the negative heights."""
    if tree is None:
        return None
    if isinstance(tree, Leaf):
        return Leaf(-tree.value, tree.marked)
    return node([mirrored(son) for son in tree.sons])


def leaves(tree: Quadtree, side: int, x: int = 0, y: int = 0) -> Iterator[tuple[Place, Leaf]]:
    """Every column with its leaf, quadrant by quadrant."""
    if isinstance(tree, Leaf):
        for i in range(side):
            for j in range(side):
                yield (x + i, y + j), tree
    elif tree is not None:
        half = side // 2
        for (i, j), son in zip(QUADRANTS, tree.sons, strict=True):
            yield from leaves(son, half, x + i * half, y + j * half)


def heights(tree: Quadtree, side: int) -> dict[Place, int]:
    """Every column with its height."""
    return {place: leaf.value for place, leaf in leaves(tree, side)}


def line(tree: Quadtree, side: int, axis: int, at: int, start: int = 0) -> Iterator[tuple[int, int]]:
    """The line of columns whose coordinate ``axis`` is ``at``: other coordinate and height, sorted.

    It is a binary subtree of the quadtree: at every node two sons (Yau and Srihari, TR-170; section 5).
    """
    if isinstance(tree, Leaf):
        for t in range(side):
            yield start + t, tree.value
    elif tree is not None:
        half = side // 2
        near = int(at >= half)
        for far in (0, 1):
            number = QUADRANTS.index((near, far) if axis == 0 else (far, near))
            yield from line(tree.sons[number], half, axis, at - near * half, start + far * half)


def written(tree: Quadtree, side: int, cells: Mapping[Place, Leaf]) -> Quadtree:
    """The tree with some columns' leaves written; the values of the nodes above follow."""
    if not cells:
        return tree
    if side == 1:
        return cells[0, 0]
    half = side // 2
    parts: list[dict[Place, Leaf]] = [{}, {}, {}, {}]
    for (x, y), leaf in cells.items():
        i, j = int(x >= half), int(y >= half)
        parts[QUADRANTS.index((i, j))][x - i * half, y - j * half] = leaf
    return node([written(son, half, part) for son, part in zip(sons_of(tree), parts, strict=True)])


def graph_side(tree: Quadtree, side: int, above: bool, bottom: int = 0) -> Octree:
    """The epigraph of a tree's heights (``above``) or their hypograph as an octree (section 5).

    Sons 2 i and 2 i + 1 come from son i: a voxel is full if its third coordinate is not smaller (not greater) than
    the value of its column.
    """
    if tree is None:
        return False
    if isinstance(tree, Leaf):
        top = bottom + side - 1
        if (bottom >= tree.value) if above else (top <= tree.value):
            return True
        if (top < tree.value) if above else (bottom > tree.value):
            return False
    half = side // 2
    return joined(tuple(graph_side(son, half, above, bottom + k * half) for son in sons_of(tree) for k in (0, 1)))

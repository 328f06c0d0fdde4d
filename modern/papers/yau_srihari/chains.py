"""The reduced set of section 4.6.1 and the hull H(A) it is computed over, from lower chains.

The paper finds these by Sklansky's scan, which goes once along a polygon and back where it turns the wrong way.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import pairwise

from modern.digital.chain import lower_chain
from modern.papers.yau_srihari.quadtree import Leaf, Place, Quadtree, line, written

Point = tuple[int, int, int]


def reduced(tree: Quadtree, side: int) -> Quadtree:
    """The floor tree with only the columns that are vertices of the lower chain of their row, and among those of the
    rows' only the vertices of their own column's chain (sections 4.6.1 and 5)."""
    for axis in (0, 1):
        kept: dict[Place, Leaf] = {}
        for at in range(side):
            for t, z in lower_chain(line(tree, side, axis, at)):
                kept[(at, t) if axis == 0 else (t, at)] = Leaf(z)
        tree = written(None, side, kept)
    return tree


def outline(places: Iterable[Place]) -> list[Place]:
    """The vertices of the hull of places, counterclockwise, from their floor and ceiling in y (section 5).

    Of places on one line the two ends, of a single place that one.
    """
    least: dict[int, int] = {}
    most: dict[int, int] = {}
    for x, y in places:
        least[x] = min(y, least.get(x, y))
        most[x] = max(y, most.get(x, y))
    down = lower_chain(sorted(least.items()))
    up = [(x, -y) for x, y in lower_chain(sorted((x, -y) for x, y in most.items()))]
    return list(dict.fromkeys(down + up[::-1]))


def chain_above(start: Place, end: Place, heights: Mapping[Place, int]) -> list[Point]:
    """The lower chain of the points above the segment between two places, both included, from one to the other."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    above: dict[int, Point] = {}
    for (x, y), z in heights.items():
        ahead, aside = dx * (x - start[0]) + dy * (y - start[1]), dx * (y - start[1]) - dy * (x - start[0])
        if aside == 0 and 0 <= ahead <= dx * dx + dy * dy:
            above[ahead] = (x, y, z)
    return [above[t] for t, _ in lower_chain(sorted((t, point[2]) for t, point in above.items()))]


def over_edges(corners: list[Place], heights: Mapping[Place, int], whole: bool) -> list[tuple[Point, Point]]:
    """The edges above those of H(A), counterclockwise: all of the lower chains, or with ``whole`` one over each."""
    found: list[tuple[Point, Point]] = []
    for start, end in zip(corners, corners[1:] + corners[:1], strict=True):
        if whole:
            found.append(((*start, heights[start]), (*end, heights[end])))
        else:
            chain = chain_above(start, end, heights)
            found.extend(pairwise(chain))
    return found

"""Algorithm Digital Convex Hull (section 4.5) on octrees, step by step.

Section 3.1 asks for a solid of one 6-connected part; how many parts a volume has is counted here.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from modern.digital.columns import Grid
from modern.digital.solids import MAX_CELLS, NoVoxels, Volume, VolumeError, as_volume
from modern.papers.yau_srihari import octree as trees
from modern.papers.yau_srihari.envelope import Envelope, envelope
from modern.papers.yau_srihari.octree import Octree
from modern.papers.yau_srihari.printed import Printed
from modern.papers.yau_srihari.quadtree import Place, Quadtree, ceiling, floor, graph_side, heights, mirrored


def components(volume: NDArray[np.bool_]) -> int:
    """How many 6-connected parts the voxels of an array have: the runs along its last axis are joined to those beside
    them until none touches another part."""
    # One empty place behind every line keeps the runs of one line, and lines at two ends of an axis, apart.
    padded = np.zeros((volume.shape[0], *(length + 1 for length in volume.shape[1:])), dtype=np.bool_)
    padded[(slice(None), *(slice(-1) for _ in volume.shape[1:]))] = volume
    flat = padded.ravel()
    starts = np.flatnonzero(flat[1:] & ~flat[:-1]) + 1
    starts = np.concatenate(([0], starts)) if flat[0] else starts
    ends = np.flatnonzero(flat[:-1] & ~flat[1:]) + 1
    beside = [_touching(starts, ends, size // padded.itemsize) for size in padded.strides[:-1]]
    return _parts(len(starts), *(np.concatenate(side) for side in zip(*beside, strict=True)))


def _touching(starts: Grid, ends: Grid, step: int) -> tuple[Grid, Grid]:
    """The pairs of runs of which the second has a voxel ``step`` places behind one of the first."""
    first = np.searchsorted(ends, starts + step, side="right")
    count = np.searchsorted(starts, ends + step, side="left") - first
    pair = np.repeat(np.arange(len(starts)), count)
    return pair, np.arange(len(pair)) + np.repeat(first - np.cumsum(count) + count, count)


def _parts(count: int, a: Grid, b: Grid) -> int:
    """How many parts so many nodes have that are joined in pairs: each takes the least number that one of its pairs
    has, and then what the node of that number has taken, until nothing changes."""
    least = np.arange(count)
    while len(a):
        np.minimum.at(least, least[a], least[b])
        np.minimum.at(least, least[b], least[a])
        while not np.array_equal(least, above := least[least]):
            least = above
        apart = least[a] != least[b]
        a, b = a[apart], b[apart]
    return len(np.unique(least))


@dataclass(frozen=True, eq=False)
class OctreeHull:
    """The digital hull of a solid, with all that leads to it.

    side: of the cube the trees divide.  solid, hull: octrees.  lowest, highest: quadtrees of floor and
    ceiling.  lower: the convex envelope of the floor; upper: that of the negative ceiling, heights negative.
    filled: the hull as truth values of the volume's shape.  components: how many 6-connected parts the volume has; of
    one part the hull, the digital points of the Euclidean one, is what section 3.3 takes for the digital convex hull.
    """

    side: int
    solid: Octree
    hull: Octree
    lowest: Quadtree
    highest: Quadtree
    lower: Envelope
    upper: Envelope
    filled: NDArray[np.bool_]
    components: int

    @cached_property
    def floor(self) -> dict[Place, int]:
        """The lowest voxel of every column, by (x, y)."""
        return heights(self.lowest)

    @cached_property
    def ceiling(self) -> dict[Place, int]:
        """The highest voxel of every column, by (x, y)."""
        return heights(self.highest)

    @property
    def columns(self) -> int:
        """How many columns have voxels."""
        return int(np.count_nonzero(self.lowest.there))

    @property
    def given(self) -> int:
        """How many voxels the solid has."""
        return trees.count(self.solid)

    @property
    def voxels(self) -> int:
        """How many voxels the hull has."""
        return trees.count(self.hull)

    @property
    def faults(self) -> tuple[str, ...]:
        """Where a construction stopped early; empty for the corrected algorithm."""
        named = (("floor", self.lower), ("ceiling", self.upper))
        return tuple(f"{name}: {found.fault}" for name, found in named if found.fault)


def octree_hull(volume: Volume | NDArray[np.bool_], printed: Printed | None = None) -> OctreeHull:
    """The digital hull by octrees of a volume of truth values with two or three axes.

    printed: the statements of the paper taken as printed; none by default.  Raises VolumeError for another array, for
    one without voxels, and for one whose cube has more than ``MAX_CELLS``.
    """
    volume = as_volume(volume)
    printed = printed or Printed()
    array: NDArray[Any] = volume.array.reshape(volume.array.shape + (1,) * (3 - volume.dimension))
    if not array.any():
        raise NoVoxels(f"{volume.source}: there are no voxels")
    side = trees.side_for(max(array.shape))
    if side**3 > MAX_CELLS:
        raise VolumeError(f"{volume.source}: a cube of side {side}, more than {MAX_CELLS} voxels, is not divided")
    solid = trees.octree(array)
    lowest, highest = floor(solid), ceiling(solid)  # step 1
    lower = envelope(lowest, printed)  # step 2
    upper = envelope(mirrored(highest), printed)  # step 3: the envelope of -beta is that of beta, negated
    hull = trees.intersection(
        graph_side(lower.tree, above=True), graph_side(mirrored(upper.tree), above=False)
    )  # step 4
    nx, ny, nz = array.shape
    filled = trees.voxels_of(hull, (nx, ny, nz)).reshape(volume.array.shape)
    return OctreeHull(side, solid, hull, lowest, highest, lower, upper, filled, components(array))

"""Algorithm Digital Convex Hull (section 4.5) on octrees, step by step.

Section 3.1 asks for a solid of one 6-connected part; how many parts a volume has is counted here.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from modern.digital.solids import MAX_CELLS, NoVoxels, Volume, VolumeError, as_volume
from modern.papers.yau_srihari import octree as trees
from modern.papers.yau_srihari.envelope import Envelope, envelope
from modern.papers.yau_srihari.octree import Octree
from modern.papers.yau_srihari.printed import Printed
from modern.papers.yau_srihari.quadtree import Place, ceiling, floor, graph_side, heights, mirrored


def components(volume: NDArray[np.bool_]) -> int:
    """How many 6-connected parts the voxels of an array have: the runs along its last axis are joined to those beside
    them until none touches another part."""
    padded = np.zeros(tuple(length + 2 for length in volume.shape), dtype=np.bool_)
    padded[tuple(slice(1, -1) for _ in volume.shape)] = volume
    starts = padded & ~np.roll(padded, 1, axis=-1)
    run = np.cumsum(starts.ravel(), dtype=np.int64).reshape(padded.shape) - 1
    parent = list(range(int(np.count_nonzero(starts))))

    def root(k: int) -> int:
        while parent[k] != k:
            parent[k] = parent[parent[k]]
            k = parent[k]
        return k

    for axis in range(volume.ndim - 1):
        both = padded & np.roll(padded, 1, axis=axis)
        for a, b in np.unique(np.stack((run[both], np.roll(run, 1, axis=axis)[both])), axis=1).T.tolist():
            parent[root(a)] = root(b)
    return sum(parent[k] == k for k in range(len(parent)))


@dataclass(frozen=True, slots=True, eq=False)
class OctreeHull:
    """The digital hull of a solid, with all that leads to it.

    side: of the cube the trees divide.  solid, hull: octrees.  floor, ceiling: lowest and highest voxel of every
    column, by (x, y).  lower: the convex envelope of the floor; upper: that of the negative ceiling, heights negative.
    filled: the hull as truth values of the volume's shape.  components: how many 6-connected parts the volume has; of
    one part the hull is the digital convex hull of section 3.3, of more it is the digital points of the Euclidean hull.
    """

    side: int
    solid: Octree
    hull: Octree
    floor: dict[Place, int]
    ceiling: dict[Place, int]
    lower: Envelope
    upper: Envelope
    filled: NDArray[np.bool_]
    components: int

    @property
    def given(self) -> int:
        """How many voxels the solid has."""
        return trees.count(self.solid, self.side)

    @property
    def voxels(self) -> int:
        """How many voxels the hull has."""
        return trees.count(self.hull, self.side)

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
    lowest, highest = floor(solid, side), ceiling(solid, side)  # step 1
    lower = envelope(lowest, side, printed)  # step 2
    upper = envelope(mirrored(highest), side, printed)  # step 3: the envelope of -beta is that of beta, negated
    hull = trees.intersection(  # step 4
        graph_side(lower.tree, side, above=True), graph_side(mirrored(upper.tree), side, above=False)
    )
    nx, ny, nz = array.shape
    filled = trees.voxels_of(hull, side, (nx, ny, nz)).reshape(volume.array.shape)
    return OctreeHull(
        side, solid, hull, heights(lowest, side), heights(highest, side), lower, upper, filled, components(array)
    )

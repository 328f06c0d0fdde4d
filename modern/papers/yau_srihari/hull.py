"""Compute the digital convex hull with octrees, by the steps of the paper's algorithm (section 4.5).

Section 3.1 requires a 6-connected solid, so this module also counts the 6-connected components of a volume.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from modern.digital.intervals import Grid
from modern.digital.solids import MAX_CELLS, NoVoxels, Volume, VolumeError, as_volume
from modern.papers.yau_srihari import octree as trees
from modern.papers.yau_srihari.envelope import Envelope, envelope
from modern.papers.yau_srihari.octree import Octree
from modern.papers.yau_srihari.printed import Printed
from modern.papers.yau_srihari.quadtree import Place, Quadtree, ceiling, floor, graph_side, heights, mirrored


def components(volume: NDArray[np.bool_]) -> int:
    """Return the number of connected components of an array of voxels. Voxels with a common face are connected."""
    # An empty cell after every line separates the runs (consecutive voxels of a line) in the flat array.
    padded = np.zeros((volume.shape[0], *(length + 1 for length in volume.shape[1:])), dtype=np.bool_)
    padded[(slice(None), *(slice(-1) for _ in volume.shape[1:]))] = volume
    flat = padded.ravel()
    starts = np.flatnonzero(flat[1:] & ~flat[:-1]) + 1
    starts = np.concatenate(([0], starts)) if flat[0] else starts
    ends = np.flatnonzero(flat[:-1] & ~flat[1:]) + 1
    touching = [_touching(starts, ends, size // padded.itemsize) for size in padded.strides[:-1]]
    return _component_count(len(starts), *(np.concatenate(side) for side in zip(*touching, strict=True)))


def _touching(starts: Grid, ends: Grid, step: int) -> tuple[Grid, Grid]:
    """Return the pairs of touching runs (a run is a sequence of consecutive voxels of a line).

    Two runs touch if a voxel of one run has a face in common with a voxel of the other. In the flat array, neighbouring
    cells of adjacent lines are ``step`` cells apart.
    """
    first = np.searchsorted(ends, starts + step, side="right")
    count = np.searchsorted(starts, ends + step, side="left") - first
    pair = np.repeat(np.arange(len(starts)), count)
    return pair, np.arange(len(pair)) + np.repeat(first - np.cumsum(count) + count, count)


def _component_count(count: int, a: Grid, b: Grid) -> int:
    """Return the number of components of a graph with ``count`` nodes, whose edge k joins the nodes a[k] and b[k].

    The label of a node is the least node known to be connected with it. The loop merges the labels of the two ends of
    each edge. It then replaces the label of each node by the label of the node that this label names, until nothing
    changes (union-find on arrays).
    """
    label = np.arange(count)
    while len(a):
        np.minimum.at(label, label[a], label[b])
        np.minimum.at(label, label[b], label[a])
        while not np.array_equal(label, shortened := label[label]):
            label = shortened
        unequal = label[a] != label[b]
        a, b = a[unequal], b[unequal]
    return len(np.unique(label))


@dataclass(frozen=True, eq=False)
class OctreeHull:
    """The digital hull of a voxel solid, and all intermediate results of the paper's algorithm.

    ``side`` is the side of the cube that the octrees divide. ``solid`` and ``hull`` are the octrees of the solid and
    the hull. ``lowest`` is the quadtree of the floor (the lowest voxel of each column), and ``highest`` is that of the
    ceiling (the highest voxel of each column). ``lower`` is the convex envelope of the floor, and ``upper`` is the
    convex envelope of the ceiling with negated heights. ``filled`` has the voxels of the hull in the shape of the
    volume. ``components`` is the number of 6-connected components of the volume. If it is 1, section 3.3 equates the
    digital convex hull with the digital points of the Euclidean hull.
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
        """The height z of the lowest voxel of each column, with the column's (x, y) as key."""
        return heights(self.lowest)

    @cached_property
    def ceiling(self) -> dict[Place, int]:
        """The height z of the highest voxel of each column, with the column's (x, y) as key."""
        return heights(self.highest)

    @property
    def columns(self) -> int:
        """The number of columns (x, y) that contain voxels."""
        return int(np.count_nonzero(self.lowest.there))

    @property
    def solid_voxels(self) -> int:
        return trees.count(self.solid)

    @property
    def voxels(self) -> int:
        return trees.count(self.hull)

    @property
    def faults(self) -> tuple[str, ...]:
        """The reasons why a construction stopped early, which only statements applied as printed can cause."""
        envelopes = (("floor", self.lower), ("ceiling", self.upper))
        return tuple(f"{name}: {side.fault}" for name, side in envelopes if side.fault)


def octree_hull(volume: Volume | NDArray[np.bool_], printed: Printed | None = None) -> OctreeHull:
    """Return the digital hull of a volume, or of an array of truth values, computed by octrees.

    ``printed`` selects statements of the paper to apply as printed. Raise VolumeError for an invalid array, for a
    volume without voxels, or if the octree's cube has more than ``MAX_CELLS`` voxels.
    """
    volume = as_volume(volume)
    printed = printed or Printed()
    array: NDArray[Any] = volume.array.reshape(volume.array.shape + (1,) * (3 - volume.dimension))
    if not array.any():
        raise NoVoxels(f"{volume.source}: there are no voxels")
    side = trees.side_for(max(array.shape))
    if side**3 > MAX_CELLS:
        raise VolumeError(f"{volume.source}: the octree's cube of side {side} has more than {MAX_CELLS} voxels")
    solid = trees.octree(array)
    # Step 1: the floor alpha and the ceiling beta.
    lowest, highest = floor(solid), ceiling(solid)
    # Step 2: the convex envelope of the floor.
    lower = envelope(lowest, printed)
    # Step 3: the concave envelope of beta is the negated convex envelope of -beta.
    upper = envelope(mirrored(highest), printed)
    # Step 4: the hull is above the lower envelope and below the upper one.
    hull = trees.intersection(graph_side(lower.tree, above=True), graph_side(mirrored(upper.tree), above=False))
    nx, ny, nz = array.shape
    filled = trees.voxels_of(hull, (nx, ny, nz)).reshape(volume.array.shape)
    return OctreeHull(side, solid, hull, lowest, highest, lower, upper, filled, components(array))

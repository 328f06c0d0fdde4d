"""Hulls of voxels for a Python program: exact, proved, and in the world where the voxels have a place there."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from numpy.typing import NDArray

from hull1620.hulls import Hull, exact_hull
from modern.digital.hull import placed
from modern.digital.solids import Volume
from modern.papers import kovalevsky_schulz as voxels


def voxel_hull(
    volume: Volume | NDArray[Any],
    centres: bool = False,
    *,
    spacing: Sequence[Any] | None = None,
    origin: Sequence[Any] | None = None,
    directions: Sequence[Sequence[Any]] | None = None,
) -> Hull:
    """The exact hull of voxels, proved; its points are the hull's vertices, in the world where voxels have a place.

    volume: three axes; every value other than 0 is a voxel; or what ``read_volume`` gives.  centres: the hull of the
    voxels' centres; else of their corners, half a voxel from the centres.  spacing: of an array, a length an axis.
    origin: the position of its first voxel's centre.  directions: a vector for each axis, multiplied by the spacing.
    A float is the number it holds; decimal text is exact.  Without all three a position is an index, and voxel
    (x, y, z) has the corners (x, y, z) to (x + 1, y + 1, z + 1).

    Raises VolumeError for other arrays and places, NoVoxels (a PointsError) where there are no voxels.
    """
    of: voxels.Of = voxels.CENTRES if centres else voxels.VERTICES
    found = voxels.voxel_hull(placed(volume, spacing, origin, directions), of)
    return exact_hull(found.mesh(straight=True).points)

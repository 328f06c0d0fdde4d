"""Exact convex hulls of voxels for Python programs."""

from collections.abc import Sequence
from typing import Any

from numpy.typing import NDArray

from hull1620.hull import Hull
from hull1620.hulls import exact_hull
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
    """Return the exact convex hull of voxels, with a proof.

    Parameters
    ----------
    volume : Volume or array_like, shape (nx, ny, nz)
        A volume from ``read_volume``, a SimpleITK image with its spacing, origin and direction, or an array.  Every
        nonzero value of an image or array is a voxel.
    centres : bool, optional
        Compute the hull of the voxels' centres instead of the hull of their corners.
    spacing : sequence of 3 numbers, optional
        The size of a voxel along each axis.
    origin : sequence of 3 numbers, optional
        The position of the centre of the first voxel.
    directions : sequence of 3 vectors, optional
        The direction of each axis; it is multiplied by the spacing.

    Returns
    -------
    Hull
        Its points are the vertices of the hull, in physical coordinates if the volume or the arguments give them.
        Otherwise positions are indices: voxel (x, y, z) has the corners (x, y, z) to (x + 1, y + 1, z + 1).

    Raises
    ------
    VolumeError
        The array is not a volume, or its position is invalid.
    NoVoxels
        There are no voxels (a subclass of PointsError).

    Notes
    -----
    ``spacing``, ``origin`` and ``directions`` apply to arrays only.  A float stands for its binary value; decimal
    text is exact.

    Examples
    --------
    >>> import numpy as np
    >>> voxel_hull(np.ones((2, 2, 2))).volume
    Fraction(8, 1)
    """
    cells: voxels.Of = voxels.CENTRES if centres else voxels.VERTICES
    polyhedron = voxels.voxel_hull(placed(volume, spacing, origin, directions), cells)
    return exact_hull(polyhedron.mesh(straight=True).points)

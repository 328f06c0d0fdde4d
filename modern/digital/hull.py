"""The digital hull of a volume: all grid points in the convex hull of its voxel centres, computed exactly.

Only the first and the last voxel of a column can be vertices of the hull. The planes of their exact hull have integer
coefficients, so integer arithmetic decides exactly whether a voxel belongs to the digital hull. If the voxels are
connected through their faces, the digital hull is the digital convex hull of Yau and Srihari (section 3.3). It is also
the set of grid points in Kovalevsky and Schulz's polyhedron of voxel centres.
"""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from emulator.jit.functions import NotInstalled
from modern.digital.intervals import Truth, below_faces, column_ends, fill, vertex_candidates
from modern.digital.solids import NoVoxels, Volume, VolumeError
from modern.digital.world import World, voxel_volume, world_of
from modern.exact_hull import exact_hull

# The largest number of voxels for which the computation fits in 64 bits. No memory holds as many voxels.
MAX_VOXELS = 1 << 56
Kind = Literal["point", "segment", "polygon", "polyhedron"]
KINDS: tuple[Kind, ...] = get_args(Kind)


@dataclass(frozen=True, slots=True, eq=False)
class DigitalHull:
    """The digital hull of a volume.

    Attributes
    ----------
    filled
        An array that is True for each voxel of the hull, in the shape and memory order of the volume.
    dimension
        The dimension of the set of voxel centres: 3, 2 if they lie in one plane, 1 on one line, 0 for a single voxel.
    given
        The number of voxels of the volume.
    source
        The volume whose hull it is.
    """

    filled: Truth
    dimension: int
    given: int
    source: Volume

    @property
    def kind(self) -> Kind:
        return KINDS[self.dimension]

    @property
    def solidity(self) -> Fraction:
        return Fraction(self.given, self.voxels)

    @property
    def deficiency(self) -> int:
        """The convex deficiency: the number of voxels that are in the hull but not in the volume."""
        return self.voxels - self.given

    @property
    def world(self) -> World | None:
        """The map from indices of ``filled`` to physical coordinates, or None if it is unknown."""
        world = self.source.world
        return None if world is None else world.moved(self.source.origin)

    @property
    def volume(self) -> Fraction:
        """The exact volume of the hull's voxels in physical units, or their number if the position is unknown."""
        return self.voxels * voxel_volume(self.source.world)

    @property
    def voxels(self) -> int:
        return int(np.count_nonzero(self.filled))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write ``filled`` as .nrrd with the position of its voxels, or as .npy, which stores no position."""
        from modern.digital.volumes import write_array

        write_array(os.fspath(path), self.filled, self.source)


def digital_hull(
    volume: Volume | NDArray[Any],
    fast: bool | None = None,
    *,
    spacing: Sequence[Any] | None = None,
    origin: Sequence[Any] | None = None,
    directions: Sequence[Sequence[Any]] | None = None,
) -> DigitalHull:
    """Return the grid points in the convex hull of a volume's voxel centres.

    Parameters
    ----------
    volume
        A volume, a SimpleITK image, or an array with two or three axes; every value other than 0 is a voxel.
    fast
        As in :func:`modern.exact_hull.build.exact_hull`: True requires compiled code (numba, the extra ``fast``). The
        hull does not depend on this choice.
    spacing, origin, directions
        The position of an array's voxels, as in :func:`modern.digital.world.world_of`. The position affects the hull's
        ``world`` and ``volume`` but not its voxels.

    Raises
    ------
    VolumeError
        The array or its position is invalid, or ``fast`` is True and numba is missing.
    NoVoxels
        The volume has no voxels. NoVoxels is a subclass of PointsError too.
    """
    source = placed(volume, spacing, origin, directions)
    array, count = source.array, source.count
    solid = array.reshape((1,) * (3 - array.ndim) + array.shape)
    # Columns run along the axis whose voxels are next to each other in memory.
    order = sorted(range(3), key=lambda axis: -abs(solid.strides[axis]))
    dimension, filled = _hull(solid.transpose(order), fast)
    return DigitalHull(filled.transpose(np.argsort(order)).reshape(array.shape), dimension, count, source)


def placed(
    volume: Volume | NDArray[Any],
    spacing: Sequence[Any] | None = None,
    origin: Sequence[Any] | None = None,
    directions: Sequence[Sequence[Any]] | None = None,
) -> Volume:
    """Return a volume unchanged, or the nonzero elements of an array as a volume at the given position.

    A SimpleITK image states its position itself.
    """
    if hasattr(volume, "GetDirection"):
        return placed(*_of_image(volume))
    if not isinstance(volume, Volume):
        array = _truth(_array(volume))
        volume = Volume(array, (0,) * array.ndim, world=world_of(array.ndim, spacing, origin, directions))
    elif spacing is not None or origin is not None or directions is not None:
        raise VolumeError(
            f"{volume.source}: spacing, origin and directions are only for arrays; a Volume has its own position"
        )
    if not _truth(volume.array).any():
        raise NoVoxels("there are no points")
    return volume


def _array(values: object) -> NDArray[Any]:
    try:
        return np.asarray(values)
    except (TypeError, ValueError) as error:
        raise VolumeError(f"not an array: {str(error)[:100]}") from None


def _of_image(image: Any) -> tuple[NDArray[Any], Sequence[Any], Sequence[Any], Sequence[Sequence[Any]]]:
    """Return the array of a SimpleITK image, indexed [x, y, z], and its spacing, origin and directions."""
    from SimpleITK import GetArrayFromImage

    if image.GetNumberOfComponentsPerPixel() != 1:
        raise VolumeError("expected an image with one number for each voxel")
    # GetDirection has the rows of a matrix, whose columns are the directions of the axes.
    matrix = np.reshape(image.GetDirection(), (image.GetDimension(),) * 2)
    return GetArrayFromImage(image).T, image.GetSpacing(), image.GetOrigin(), matrix.T.tolist()


def _truth(array: NDArray[Any]) -> Truth:
    if array.ndim not in (2, 3) or array.dtype.kind not in "biuf":
        raise VolumeError(
            f"expected an array of numbers or truth values with two or three axes, found {array.dtype} "
            f"with {array.ndim} axes"
        )
    if array.size > MAX_VOXELS:
        raise VolumeError(f"the exact hull of more than {MAX_VOXELS} voxels cannot be computed in 64 bits")
    if array.dtype.kind == "f" and np.isnan(array).any():
        raise VolumeError("a value is not a number (nan), so its voxel cannot be classified")
    truth: Truth = array if array.dtype == np.bool_ else array != 0
    return truth


def _hull(solid: Truth, fast: bool | None) -> tuple[int, Truth]:
    """Return the dimension of the hull, and an array that is True for each voxel in the hull."""
    points = vertex_candidates(*column_ends(solid))
    try:
        hull = exact_hull(points, fast)
    except NotInstalled as error:
        raise VolumeError(str(error)) from None
    if hull.dimension < 2:
        filled = np.zeros(solid.shape, dtype=np.bool_)
        first, last = points[hull.vertices[0]], points[hull.vertices[-1]]
        steps = max(1, int(np.gcd.reduce(last - first)))
        filled[tuple((first + np.arange(steps + 1)[:, None] * ((last - first) // steps)).T)] = True
        return hull.dimension, filled
    axes = [0, 1, 2]
    if hull.plane is None:
        faces = [(points[list(facet.polygon)], facet.plane) for facet in hull.facets]
    else:
        # A polygon is filled as a polyhedron with two opposite faces, along the axis nearest to its normal.
        axes.append(axes.pop(int(np.abs(hull.plane[:3]).argmax())))
        a, b, c, d = (hull.plane[k] for k in (*axes, 3))
        # If the second axis is now the last, the orientation is reversed.
        corners = points[list(hull.polygon)][:: -1 if axes[2] == 1 else 1, axes]
        faces = [(corners, (a, b, c, d)), (corners[::-1], (-a, -b, -c, -d))]
    nx, ny, nz = (solid.shape[k] for k in axes)
    filled = fill(*below_faces(faces, (nx, ny)), nz).transpose(np.argsort(axes))
    return hull.dimension, np.ascontiguousarray(filled)

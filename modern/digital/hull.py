"""The digital hull of a volume: all grid points in the convex hull of its voxel centres, computed exactly.

Only the two ends of a column can be vertices of the hull. Of these ends, only the vertices of the hulls of rows and
columns are used. Planes have integer coefficients, and integers decide whether a voxel on a plane belongs to the hull.
For a 6-connected solid this is the digital convex hull of Yau and Srihari (section 3.3), and the set of grid points in
Kovalevsky and Schulz's polyhedron of voxel centres.
"""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from emulator.jit.functions import NotInstalled
from modern.digital.intervals import Grid, Truth, below_edges, below_facets, column_ends, fill, in_plane, reduced
from modern.digital.polytope import compiled_hull, polyhedron
from modern.digital.solids import NoVoxels, Volume, VolumeError
from modern.digital.world import World, voxel_volume, world_of

# The largest volume for which a product of three lengths fits in 64 bits. No memory holds as many voxels.
MAX_VOXELS = 1 << 56
# Compiled code is used if numba is installed and there are at least this number of candidates for vertices.
WORTH_COMPILING = 1000
Kind = Literal["point", "segment", "polygon", "polyhedron"]
KINDS: tuple[Kind, ...] = get_args(Kind)


@dataclass(frozen=True, slots=True, eq=False)
class DigitalHull:
    """The digital hull of a volume.

    Attributes
    ----------
    filled
        Truth values in the volume's shape and memory order.
    dimension
        The dimension of the set of voxel centres: 3, or 2 in one plane, 1 on one line, 0 for a single voxel.
    given
        The number of voxels of the volume.
    source
        The volume, which also holds the position of its voxels.
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
        """The number of voxels that are in the hull but not in the volume (the convex deficiency)."""
        return self.voxels - self.given

    @property
    def world(self) -> World | None:
        """The position of the hull's voxels in physical coordinates, or None if it is unknown."""
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
        True for compiled code (numba, the extra ``fast``), False for plain Python, None for the faster one. The result
        is the same.
    spacing, origin, directions
        The position of an array's voxels, as in :func:`modern.digital.world.world_of`. The position affects the hull's
        ``world`` and ``volume`` but not its voxels.

    Raises
    ------
    VolumeError
        For an invalid array or position, and if ``fast`` is True and numba is missing.
    NoVoxels
        If the volume has no voxels. This is also a PointsError.
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
    """Return a volume unchanged, or convert an array to the volume of its nonzero values, at the given position."""
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
            f"with {array.ndim}"
        )
    if array.size > MAX_VOXELS:
        raise VolumeError(f"a volume of more than {MAX_VOXELS} voxels has no exact hull in 64 bits")
    if array.dtype.kind == "f" and np.isnan(array).any():
        raise VolumeError("a value is not a number (nan), so its voxel cannot be classified")
    truth: Truth = array if array.dtype == np.bool_ else array != 0
    return truth


def _hull(solid: Truth, fast: bool | None) -> tuple[int, Truth]:
    # Candidates for vertices: the lower and the upper ends of the columns, reduced separately.
    x, y, low, high = column_ends(solid)
    lower = np.stack(reduced(x, y, low), axis=1)
    upper = np.stack(reduced(x, y, -high), axis=1) * (1, 1, -1)
    points = np.unique(np.concatenate((lower, upper)), axis=0)
    simplex = independent(points)
    if len(simplex) < 4:
        _compile(bool(fast), len(points))  # raises VolumeError if ``fast`` is True and numba is missing
        filled = np.zeros(solid.shape, dtype=np.bool_)
        if len(simplex) == 3:
            _fill_polygon(filled, points, simplex)
        else:
            _fill_segment(filled, points[simplex[0]], points[simplex[-1]])
        return len(simplex) - 1, filled
    a, b, c, d = simplex
    corner, plane = polyhedron(points, (a, b, c, d), _compile(fast, len(points)))
    return 3, fill(*below_facets(points, corner, plane, (solid.shape[0], solid.shape[1])), solid.shape[2])


def _compile(fast: bool | None, candidates: int) -> bool:
    """Decide whether to use compiled code.  Raise VolumeError if it was requested and is not available."""
    if not (candidates >= WORTH_COMPILING if fast is None else fast):
        return False
    try:
        compiled_hull()
    except NotInstalled as error:
        if fast:
            raise VolumeError(str(error)) from None
        return False
    return True


def independent(points: Grid) -> list[int]:
    """Return the indices of as many affinely independent points as possible, at most four.

    The two ends of a segment are always among them.
    """
    if len(points) == 1:
        return [0]
    # The points are sorted, so the first and the last are extreme.
    along = points[-1] - points[0]
    chosen = [0, len(points) - 1]
    normals = np.cross(points - points[0], along)
    third = int(np.abs(normals).max(axis=1).argmax())
    if not normals[third].any():
        return chosen
    heights = np.abs((points - points[0]) @ normals[third])
    fourth = int(heights.argmax())
    return [*chosen, third] + ([fourth] if heights[fourth] else [])


def _fill_segment(filled: Truth, first: Grid, last: Grid) -> None:
    steps = max(1, int(np.gcd.reduce(last - first)))
    filled[tuple((first + np.arange(steps + 1)[:, None] * ((last - first) // steps)).T)] = True


def _fill_polygon(filled: Truth, points: Grid, simplex: list[int]) -> None:
    """Fill the convex hull of coplanar points, given as the indices of voxels.

    The points are projected along the axis of the largest component of their plane's normal, and the projection is
    filled as a polygon.  A position in this polygon is lifted back to the plane, and its voxel is filled if the lifted
    coordinate is an integer.
    """
    origin = points[simplex[0]]
    normal = np.cross(points[simplex[1]] - origin, points[simplex[2]] - origin)
    normal //= np.gcd.reduce(normal)
    axis = int(np.abs(normal).argmax())
    first, second = (k for k in range(3) if k != axis)
    low, high = below_edges(points[:, first], points[:, second], filled.shape[first])
    inside = in_plane(low, high, filled.shape[second])
    if abs(normal[axis]) == np.abs(normal).sum():
        np.moveaxis(filled, axis, 0)[origin[axis]] = inside
        return
    u, v = np.nonzero(inside)
    over = -(normal[first] * (u - origin[first]) + normal[second] * (v - origin[second]))
    # A position has a grid point of the hull only if the plane passes through a grid point there.
    exact = over % normal[axis] == 0
    indices = {axis: origin[axis] + over[exact] // normal[axis], first: u[exact], second: v[exact]}
    filled[indices[0], indices[1], indices[2]] = True

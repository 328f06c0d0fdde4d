"""The filled digital hull of a volume: every grid point in the convex hull of its voxels' centres, exactly.

The hull is that of the two ends of every column; of these only the vertices of the rows' and columns' hulls are kept.
Planes are of integers, and whether a voxel on a plane belongs is decided by integers.  For a 6-connected solid this is
what Yau and Srihari take for its digital convex hull (section 3.3), and the grid points that Kovalevsky and Schulz's
polyhedron of voxel centres contains.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from emulator.jit.functions import NotInstalled
from modern.digital.columns import Grid, Truth, column_ends, fill, reduced
from modern.digital.intervals import below_edges, below_facets, in_plane
from modern.digital.polytope import compiled_hull, polyhedron
from modern.digital.solids import NoVoxels, Volume, VolumeError
from modern.digital.world import World, voxel_volume, world_of

MAX_VOXELS = 1 << 56
"""Beyond this a product of three lengths would leave 64 bits; no memory holds so much."""
WORTH_COMPILING = 1000
"""From so many candidates on compiled code is used where numba is installed."""
Kind = Literal["point", "segment", "polygon", "polyhedron"]
KINDS: tuple[Kind, ...] = get_args(Kind)


@dataclass(frozen=True, slots=True, eq=False)
class DigitalHull:
    """The digital hull of a volume.

    filled: truth values of the volume's shape, in its order of memory.  dimension: that of the voxels' centres: 3; 2 if
    they lie in one plane, 1 on one line; 0 for one voxel.  given: how many voxels the volume has.  source: the volume
    whose hull it is, for where its voxels lie.
    """

    filled: Truth
    dimension: int
    given: int
    source: Volume

    @property
    def kind(self) -> Kind:
        """``point``, ``segment``, ``polygon`` or ``polyhedron``."""
        return KINDS[self.dimension]

    @property
    def solidity(self) -> Fraction:
        """The share of the hull that the volume fills, in voxels."""
        return Fraction(self.given, self.voxels)

    @property
    def deficiency(self) -> int:
        """How many voxels the convex deficiency has: those of the hull that are not given."""
        return self.voxels - self.given

    @property
    def world(self) -> World | None:
        """Where the voxels of ``filled`` lie, by their indices; None where nothing says it."""
        world = self.source.world
        return None if world is None else world.moved(self.source.origin)

    @property
    def volume(self) -> Fraction:
        """The volume of the hull's voxels in the world, exactly; their number where there is no world."""
        return self.voxels * voxel_volume(self.source.world)

    @property
    def voxels(self) -> int:
        """How many voxels the hull has."""
        return int(np.count_nonzero(self.filled))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write ``filled``: as .nrrd with the place of its voxels, or as .npy, which holds none.

        Raises VolumeError for another ending, FileError where the file cannot be written.
        """
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
    """The grid points in the convex hull of a volume's voxel centres.

    volume: two or three axes; every value other than 0 is a voxel.  fast: True for compiled code (numba, the extra
    ``fast``), False for plain Python, None for whichever is quicker; the result is the same.  spacing, origin,
    directions: where the voxels of an array lie, see :func:`modern.digital.world.world_of`; the hull's voxels do not
    depend on it, its ``world`` and ``volume`` do.

    Raises VolumeError for other arrays, for a place that is not valid, and where ``fast`` is asked for without numba;
    NoVoxels, which is a PointsError, where there are no voxels.
    """
    source = placed(volume, spacing, origin, directions)
    array, given = source.array, source.count
    solid = array.reshape((1,) * (3 - array.ndim) + array.shape)
    # Columns run along the axis whose voxels are next to each other in memory.
    order = sorted(range(3), key=lambda axis: -abs(solid.strides[axis]))
    dimension, filled = _hull(solid.transpose(order), fast)
    return DigitalHull(filled.transpose(np.argsort(order)).reshape(array.shape), dimension, given, source)


def placed(
    volume: Volume | NDArray[Any],
    spacing: Sequence[Any] | None = None,
    origin: Sequence[Any] | None = None,
    directions: Sequence[Sequence[Any]] | None = None,
) -> Volume:
    """A volume as it is, or an array of two or three axes with its place; every value other than 0 is a voxel.

    Raises VolumeError and NoVoxels as ``digital_hull``.
    """
    if not isinstance(volume, Volume):
        array = _truth(np.asarray(volume))
        volume = Volume(array, (0,) * array.ndim, world=world_of(array.ndim, spacing, origin, directions))
    elif spacing is not None or origin is not None or directions is not None:
        raise VolumeError(f"{volume.source}: a Volume has its place; spacing, origin and directions are of arrays")
    if not _truth(volume.array).any():
        raise NoVoxels("there are no points")
    return volume


def _truth(array: NDArray[Any]) -> Truth:
    if array.ndim not in (2, 3) or array.dtype.kind not in "biuf":
        raise VolumeError(
            f"a volume is an array of numbers or truth values with two or three axes, not of {array.dtype} "
            f"with {array.ndim}"
        )
    if array.size > MAX_VOXELS:
        raise VolumeError(f"a volume of more than {MAX_VOXELS} voxels has no exact hull in 64 bits")
    if array.dtype.kind == "f" and np.isnan(array).any():
        raise VolumeError("a value is not a number (nan), so that nobody can say whether the voxel belongs")
    truth: Truth = array if array.dtype == np.bool_ else array != 0
    return truth


def _hull(solid: Truth, fast: bool | None) -> tuple[int, Truth]:
    """Dimension and filled hull of a volume of three axes that has voxels."""
    x, y, low, high = column_ends(solid)
    lower = np.stack(reduced(x, y, low), axis=1)
    upper = np.stack(reduced(x, y, -high), axis=1) * (1, 1, -1)
    points = np.unique(np.concatenate((lower, upper)), axis=0)
    simplex = independent(points)
    if len(simplex) < 4:
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
    """Whether compiled code is to be used.  Raises VolumeError where it is asked for and there is none."""
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
    """Affinely independent points, as many as there are and at most four; two of them are the ends of a segment."""
    if len(points) == 1:
        return [0]
    along = points[-1] - points[0]  # first and last in lexicographic order
    chosen = [0, len(points) - 1]
    normals = np.cross(points - points[0], along)
    third = int(np.abs(normals).max(axis=1).argmax())
    if not normals[third].any():
        return chosen
    heights = np.abs((points - points[0]) @ normals[third])
    fourth = int(heights.argmax())
    return [*chosen, third] + ([fourth] if heights[fourth] else [])


def _fill_segment(filled: Truth, first: Grid, last: Grid) -> None:
    """The grid points between two."""
    steps = max(1, int(np.gcd.reduce(last - first)))
    filled[tuple((first + np.arange(steps + 1)[:, None] * ((last - first) // steps)).T)] = True


def _fill_polygon(filled: Truth, points: Grid, simplex: list[int]) -> None:
    """The grid points in the hull of points of one plane, which is projected along an axis it does not contain."""
    origin = points[simplex[0]]
    normal = np.cross(points[simplex[1]] - origin, points[simplex[2]] - origin)
    normal //= np.gcd.reduce(normal)
    axis = int(np.abs(normal).argmax())
    first, second = (k for k in range(3) if k != axis)
    low, high = below_edges(points[:, first], points[:, second], filled.shape[first])
    places = in_plane(low, high, filled.shape[second])
    if abs(normal[axis]) == np.abs(normal).sum():
        np.moveaxis(filled, axis, 0)[origin[axis]] = places
        return
    u, v = np.nonzero(places)
    over = -(normal[first] * (u - origin[first]) + normal[second] * (v - origin[second]))
    exact = over % normal[axis] == 0
    found = {axis: origin[axis] + over[exact] // normal[axis], first: u[exact], second: v[exact]}
    filled[found[0], found[1], found[2]] = True

"""Voxel solids: the class Volume, volumes from arrays and from lists of coordinates, digital balls and half-balls.

A voxel is identified by its integer coordinates (x, y, z). Its centre is the point with these coordinates, and as a
cube it extends half a unit from the centre in each direction. The pixels of a picture are voxels with two coordinates.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from modern.digital.world import NoVoxels, VolumeError, World

__all__ = ["NoVoxels", "Volume", "VolumeError", "World", "as_volume", "ball", "half_ball", "listed"]

VOXEL, VERTEX = "voxel", "vertex"
MAX_CELLS = 2**31
DIGITS = 18
# A bound for coordinates, so that sums with the sides of a box fit in 64 bits.
FARTHEST = 10**DIGITS

Voxels = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, eq=False)
class Volume:
    """A finite set of voxels in a box.

    ``array`` holds truth values of shape (nx, ny) or (nx, ny, nz), indexed [x, y, z], in any memory order. ``origin``
    has the coordinates of the voxel at index 0, 0, 0, so array[i, j, k] is the voxel origin + (i, j, k). ``source`` is
    the name in messages, and ``notes`` are notes of the reader for the user, one line each. ``world`` maps the
    coordinates of voxels to physical coordinates, or is None if their position is unknown. Raise VolumeError if the
    array has another type or dimension, or if the number of axes of ``origin`` or ``world`` differs from that of the
    array.
    """

    array: Voxels
    origin: tuple[int, ...]
    source: str = "volume"
    notes: tuple[str, ...] = ()
    world: World | None = None

    def __post_init__(self) -> None:
        if self.array.dtype != np.bool_ or self.array.ndim not in (2, 3):
            raise VolumeError(
                f"{self.source}: expected an array of truth values with two or three dimensions, "
                f"found {self.array.dtype} with {self.array.ndim} dimensions"
            )
        if len(self.origin) != self.array.ndim:
            raise VolumeError(
                f"{self.source}: expected {self.array.ndim} coordinates of the origin, found {len(self.origin)}"
            )
        if self.world is not None and len(self.world.steps) != self.array.ndim:
            raise VolumeError(
                f"{self.source}: expected {self.array.ndim} spacing vectors, one for each axis of the array, "
                f"found {len(self.world.steps)}"
            )

    @property
    def dimension(self) -> int:
        """The number of axes: 2 for a picture, 3 for a volume."""
        return self.array.ndim

    @property
    def count(self) -> int:
        return int(np.count_nonzero(self.array))

    def coordinates(self) -> NDArray[np.int64]:
        """Return the voxels as an int64 array of shape (count, dimension) in raster order, x fastest."""
        indices = np.argwhere(self.array.T)[:, ::-1]
        return indices.astype(np.int64) + np.array(self.origin, dtype=np.int64)


def as_volume(volume: Volume | Voxels) -> Volume:
    """Return a volume unchanged, or an array of truth values as a volume whose coordinates are indices."""
    if isinstance(volume, Volume):
        return volume
    array = np.asarray(volume)
    return Volume(array, (0,) * array.ndim)


def listed(coordinates: Sequence[Sequence[int]] | NDArray[np.integer[Any]], source: str = "volume") -> Volume:
    """Return the volume of the voxels with these integer coordinates, of shape (n, 2) or (n, 3), in any order.

    Repeated voxels count once, and a note reports them. Raise VolumeError for coordinates of another shape or type or
    with more than ``DIGITS`` digits, and if the bounding box has more than ``MAX_CELLS`` voxels. Raise NoVoxels for an
    empty list.
    """
    rows = np.asarray(coordinates)
    if not rows.size:
        raise NoVoxels(f"{source}: there are no voxels")
    if rows.ndim != 2 or rows.shape[1] not in (2, 3) or rows.dtype.kind not in "iu":
        raise VolumeError(
            f"{source}: expected two or three integer coordinates for each voxel, "
            f"found an array of {rows.dtype} of shape {rows.shape}"
        )
    if int(rows.min()) <= -FARTHEST or int(rows.max()) >= FARTHEST:
        raise VolumeError(f"{source}: a coordinate has more than {DIGITS} digits")
    voxels = rows.astype(np.int64)
    low = [int(least) for least in voxels.min(axis=0)]
    sides = [int(most) - least + 1 for most, least in zip(voxels.max(axis=0), low, strict=True)]
    if math.prod(sides) > MAX_CELLS:
        size = " x ".join(map(str, sides))
        raise VolumeError(f"{source}: expected a box of at most {MAX_CELLS} voxels, found {size}")
    array = np.zeros(sides, dtype=np.bool_)
    array[tuple((voxels - voxels.min(axis=0)).T)] = True
    repeated = len(voxels) - int(np.count_nonzero(array))
    notes = (f"{source}: {repeated} of {len(voxels)} voxels are repetitions",) if repeated else ()
    return Volume(array, tuple(low), source, notes)


def ball(diameter: int, centre: str = VOXEL) -> Volume:
    """Return the digital ball of an integer diameter: the voxels whose centres lie in a ball or on its surface.

    If ``centre`` is ``voxel``, the centre of the ball is that of voxel (0, 0, 0), as in Kovalevsky and Schulz's ball of
    diameter 32 with 17077 voxels. If it is ``vertex``, the centre is (1/2, 1/2, 1/2), the common corner of voxels
    (0, 0, 0) and (1, 1, 1), as in the half-balls of their Table 5. Raise VolumeError for another value of ``centre``,
    or a diameter that is too small or too large.
    """
    return _ball(f"ball:{diameter}:{centre}", diameter, centre, half=False)


def half_ball(diameter: int, centre: str = VERTEX) -> Volume:
    """Return the voxels of ``ball(diameter, centre)`` whose centres are not below the centre of the ball in z.

    If ``centre`` is ``vertex``, these are exactly half of the voxels, in the layers z = 1, 2, ... (Kovalevsky and
    Schulz, Table 5). If it is ``voxel``, the whole layer z = 0 belongs to the half-ball. Raise VolumeError as ``ball``
    does.
    """
    return _ball(f"half-ball:{diameter}:{centre}", diameter, centre, half=True)


def _widest() -> int:
    size = round(MAX_CELLS ** (1 / 3)) + 1
    return next(d for d in range(size, 0, -1) if (d + 1) ** 3 <= MAX_CELLS)


def _ball(name: str, diameter: int, centre: str, half: bool) -> Volume:
    if centre not in (VOXEL, VERTEX):
        raise VolumeError(f"{name}: expected the centre {VOXEL} or {VERTEX}")
    if diameter < 1:
        raise VolumeError(f"{name}: expected a positive integer as the diameter")
    if (diameter + 1) ** 3 > MAX_CELLS:
        raise VolumeError(
            f"{name}: expected a diameter of at most {_widest()}; the box around a ball has at most {MAX_CELLS} voxels"
        )
    # Along each axis, twice the distance of a voxel from the ball's centre is an integer, even for the centre ``voxel``
    # and odd for ``vertex``.
    shift = 0 if centre == VOXEL else 1
    first = -((diameter - shift) // 2)
    twice = 2 * np.arange(first, (diameter + shift) // 2 + 1, dtype=np.int64) - shift
    low = max(first, shift) if half else first
    squares = twice**2
    plane = squares[:, None] + squares[None, low - first :]
    array = np.empty((len(squares), *plane.shape), dtype=np.bool_)
    for x, square in enumerate(squares):
        np.less_equal(plane, diameter**2 - square, out=array[x])
    if not array.any():
        raise NoVoxels(f"{name}: the ball contains no voxel; choose a larger diameter")
    return Volume(array, (first, first, low), name)

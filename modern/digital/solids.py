"""Sets of voxels: the type, sets from arrays and from lists of coordinates, digital balls and half-balls.

A voxel is named by its whole coordinates (x, y, z); its centre is that point, and as a cube it reaches half a unit
further each way.  Pixels of a plane picture are voxels with two coordinates.
"""

from __future__ import annotations

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
FARTHEST = 10**DIGITS
"""No coordinate is as far from 0: sums with the sides of a box stay within 64 bits."""

Voxels = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, eq=False)
class Volume:
    """A finite set of voxels in a box.

    ``array``: truth values of shape (nx, ny) or (nx, ny, nz), indexed [x, y, z]; any order of memory.  ``origin``: the
    coordinates of the voxel at index 0, 0, 0, so that array[i, j, k] is voxel origin + (i, j, k).  ``source``: what
    messages call it.  ``notes``: what the reader of the file should know, a line each.  ``world``: where voxels lie, by
    their coordinates; None where these are all that is known.

    Raises VolumeError for an array of another type or dimension, and for a world of another number of axes.
    """

    array: Voxels
    origin: tuple[int, ...]
    source: str = "volume"
    notes: tuple[str, ...] = ()
    world: World | None = None

    def __post_init__(self) -> None:
        if self.array.dtype != np.bool_ or self.array.ndim not in (2, 3):
            raise VolumeError(
                f"{self.source}: a volume is an array of truth values with two or three dimensions, "
                f"not of {self.array.dtype} with {self.array.ndim}"
            )
        if len(self.origin) != self.array.ndim:
            raise VolumeError(f"{self.source}: {len(self.origin)} coordinates of the origin for {self.array.ndim} axes")
        if self.world is not None and len(self.world.steps) != self.array.ndim:
            raise VolumeError(f"{self.source}: {len(self.world.steps)} steps in the world for {self.array.ndim} axes")

    @property
    def dimension(self) -> int:
        """2 for a picture, 3 for a volume."""
        return self.array.ndim

    @property
    def count(self) -> int:
        """The number of voxels."""
        return int(np.count_nonzero(self.array))

    def coordinates(self) -> NDArray[np.int64]:
        """The voxels as an int64 array of shape (count, dimension) in raster order: x runs fastest, then y, then z."""
        found = np.argwhere(self.array.T)[:, ::-1]
        return found.astype(np.int64) + np.array(self.origin, dtype=np.int64)


def as_volume(volume: Volume | Voxels) -> Volume:
    """A volume as it is; an array of truth values as one whose voxels have their indices for coordinates.

    Raises VolumeError as ``Volume`` does.
    """
    if isinstance(volume, Volume):
        return volume
    array = np.asarray(volume)
    return Volume(array, (0,) * array.ndim)


def listed(coordinates: Sequence[Sequence[int]] | NDArray[np.integer[Any]], source: str = "volume") -> Volume:
    """The volume of voxels by their whole coordinates, in any order, shape (n, 2) or (n, 3); it keeps them.

    A voxel that is listed again counts once, and a note says so.  Raises VolumeError for coordinates of another shape
    or type and for one of more than ``DIGITS``, NoVoxels for none, and for voxels in a box of more than ``MAX_CELLS``.
    """
    given = np.asarray(coordinates)
    if not given.size:
        raise NoVoxels(f"{source}: there are no voxels")
    if given.ndim != 2 or given.shape[1] not in (2, 3) or given.dtype.kind not in "iu":
        raise VolumeError(
            f"{source}: coordinates are whole numbers, two or three a voxel, "
            f"not an array of {given.dtype} of shape {given.shape}"
        )
    if int(given.min()) <= -FARTHEST or int(given.max()) >= FARTHEST:
        raise VolumeError(f"{source}: a coordinate has more than {DIGITS} digits")
    places = given.astype(np.int64)
    low = [int(least) for least in places.min(axis=0)]
    sides = [int(most) - least + 1 for most, least in zip(places.max(axis=0), low, strict=True)]
    if math.prod(sides) > MAX_CELLS:
        size = " x ".join(map(str, sides))
        raise VolumeError(f"{source}: the voxels lie in a box of {size}; more than {MAX_CELLS} places are not kept")
    array = np.zeros(sides, dtype=np.bool_)
    array[tuple((places - places.min(axis=0)).T)] = True
    again = len(places) - int(np.count_nonzero(array))
    notes = (f"{source}: {again} of {len(places)} voxels are listed before",) if again else ()
    return Volume(array, tuple(low), source, notes)


def ball(diameter: int, centre: str = VOXEL) -> Volume:
    """The digital ball of a whole diameter: the voxels whose centres lie in it, those on its surface included.

    centre: ``voxel``: the ball's centre is that of voxel (0, 0, 0), as of Kovalevsky and Schulz's ball of diameter 32
    with 17077 voxels; ``vertex``: it is the corner (1/2, 1/2, 1/2) that voxels (0, 0, 0) and (1, 1, 1) share, as of the
    half-balls of their Table 5.  Raises VolumeError for another centre, or a diameter too small or too large.
    """
    return _ball(f"ball:{diameter}:{centre}", diameter, centre, half=False)


def half_ball(diameter: int, centre: str = VERTEX) -> Volume:
    """The half of ``ball(diameter, centre)`` with z from its centre up.

    With the centre at a vertex these are the layers z = 1, 2, ... and just half of the voxels (Kovalevsky and Schulz,
    Table 5); with the centre at a voxel the layer z = 0 belongs to it whole.  Raises VolumeError as ``ball`` does.
    """
    return _ball(f"half-ball:{diameter}:{centre}", diameter, centre, half=True)


def _widest() -> int:
    """The largest diameter whose box has no more than ``MAX_CELLS`` voxels."""
    size = round(MAX_CELLS ** (1 / 3)) + 1
    return next(d for d in range(size, 0, -1) if (d + 1) ** 3 <= MAX_CELLS)


def _ball(name: str, diameter: int, centre: str, half: bool) -> Volume:
    if centre not in (VOXEL, VERTEX):
        raise VolumeError(f"{name}: the centre is {VOXEL} or {VERTEX}")
    if diameter < 1:
        raise VolumeError(f"{name}: the diameter is a whole number from 1 on")
    if (diameter + 1) ** 3 > MAX_CELLS:
        raise VolumeError(f"{name}: the diameter is at most {_widest()}, for a box of {MAX_CELLS} voxels")
    # Twice the distance from the ball's centre is a whole number: even for a centre in a voxel, else odd.
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
        raise NoVoxels(f"{name}: there is no voxel in it")
    return Volume(array, (first, first, low), name)

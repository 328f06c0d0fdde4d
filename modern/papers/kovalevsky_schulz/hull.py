"""The paper's route from a set of voxels to the cell list of its convex hull."""

from __future__ import annotations

from dataclasses import dataclass

from modern.digital.solids import Volume, VolumeError, Voxels, as_volume
from modern.papers.kovalevsky_schulz.cells import CellList
from modern.papers.kovalevsky_schulz.corners import VERTICES, Points, corner_mask, places, points_of
from modern.papers.kovalevsky_schulz.merging import merged, straightened
from modern.papers.kovalevsky_schulz.polyhedron import VISIBLE, Flat, convex_polyhedron


@dataclass(frozen=True, slots=True)
class Surface:
    """The surface of a polyhedron as three cell lists: of ``triangles``; of ``faces``, coplanar triangles merged; and
    ``straight``, edges in one line merged too, so that every vertex is one of the hull."""

    triangles: CellList
    faces: CellList
    straight: CellList


@dataclass(frozen=True, slots=True, eq=False)
class VoxelHull:
    """The convex hull of a solid and what was counted on the way.

    ``source``: what messages call the solid.  ``voxels``: how many it has.  ``corners``: how many local corners 6 and
    26 neighbours leave.  ``inserted``: those that were inserted, shape (n, 3), in raster order.  ``surface``: the hull,
    ``Flat`` where the places lie in one plane.
    """

    source: str
    voxels: int
    corners: dict[int, int]
    inserted: Points
    surface: Surface | Flat

    @property
    def polyhedron(self) -> Surface:
        """The surface where there is one.  Raises VolumeError for a flat hull."""
        if isinstance(self.surface, Flat):
            raise VolumeError(f"{self.source}: flat: the hull is a {self.surface.kind} and has no cell list")
        return self.surface


def voxel_hull(volume: Volume | Voxels, of: str = VERTICES, neighbours: int = 26, coplanar: str = VISIBLE) -> VoxelHull:
    """The hull of a solid's voxels (``of="centres"``) or of their corners (``of="vertices"``).

    volume: a volume, or an array of truth values indexed [x, y, z].
    neighbours: 6 or 26, the test that chooses local corners.  coplanar: ``visible`` or ``invisible``, see
    ``convex_polyhedron``.  The hull does not depend on either, the number of triangles does.  Raises VolumeError for a
    picture of two dimensions and for a volume without voxels.
    """
    volume = as_volume(volume)
    if not volume.count:
        raise VolumeError(f"{volume.source}: there are no voxels")
    array = places(volume, of)
    masks = {count: corner_mask(array, count) for count in (6, 26)}
    inserted = points_of(masks[neighbours], volume.origin)
    triangles = convex_polyhedron(inserted, coplanar)
    surface = triangles if isinstance(triangles, Flat) else _surface(triangles)
    counts = {count: int(mask.sum()) for count, mask in masks.items()}
    return VoxelHull(volume.source, volume.count, counts, inserted, surface)


def _surface(triangles: CellList) -> Surface:
    faces = merged(triangles)
    return Surface(triangles, faces, straightened(faces))

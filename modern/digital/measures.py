"""Exact measures of a voxel solid and of its hull: volumes, areas, solidity, convex deficiency.

The hull's vertices are voxel centres or corners with integer coordinates. Volumes are fractions. The area of a surface
is a sum of square roots, rounded to ``AREA_DIGITS`` significant digits.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction

from modern.digital.world import Position, VolumeError, World, voxel_volume
from modern.geometry.numbers import AREA_DIGITS, sum_of_roots
from modern.geometry.vectors import Vector, area_vector, dot, six_volumes, whole

Whole = tuple[int, int, int]


@dataclass(frozen=True, slots=True)
class Measures:
    """The measures of a solid and its hull, in physical units, or in voxels if the position is unknown.

    ``voxels`` is the number of the solid's voxels, and ``volume`` is their volume. A flat hull has the volume 0. The
    area of a polygon is that of one side. The area of a segment or a point is 0.
    """

    voxels: int
    volume: Fraction
    hull_volume: Fraction
    hull_area: Decimal

    @property
    def solidity(self) -> Fraction:
        """For the hull of the voxels' corners, the fraction of the hull's volume that the solid fills.

        Raise VolumeError for a flat hull.
        """
        if not self.hull_volume:
            raise VolumeError("a flat hull has no volume, so its solidity is undefined")
        return self.volume / self.hull_volume

    @property
    def deficiency(self) -> Fraction:
        """The convex deficiency: the volume of the part of the hull that the solid does not fill."""
        return self.hull_volume - self.volume


def measures(
    voxels: int, points: Sequence[Whole], faces: Iterable[Sequence[int]], world: World | None = None
) -> Measures:
    """Return the measures of a solid with ``voxels`` voxels and of its hull.

    ``points`` are the vertices of the hull. ``faces`` are cycles of indices of ``points``: all faces of a polyhedron in
    the same orientation, or a polygon as its only face, or no faces for other hulls. ``world`` is the position of the
    voxels. It must have three steps, each with three coordinates.
    """
    polygons = [tuple(face) for face in faces]
    # Exact physical positions, multiplied by a common scale to make them integers.
    scale, places = (1, points) if world is None else whole([_three(world.place(point)) for point in points])
    six = six_volumes(places, polygons) if len(polygons) > 1 else 0
    normals = [area_vector(places, face) for face in polygons]
    area = sum_of_roots([Fraction(dot(normal, normal), 4 * scale**4) for normal in normals], AREA_DIGITS)
    return Measures(voxels, voxels * voxel_volume(world), Fraction(abs(six), 6 * scale**3), area)


def _three(place: Position) -> Vector:
    x, y, z = place
    return x, y, z

"""Exact measures of a voxel solid and of its hull: volumes, areas, solidity, convex deficiency.

The hull's vertices are voxel centres or corners with integer coordinates. Volumes are fractions. The area of a surface
is a sum of square roots, rounded to ``AREA_DIGITS`` significant digits.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction

from modern.digital.world import Position, VolumeError, World, voxel_volume
from modern.geometry.numbers import AREA_DIGITS, sum_of_roots
from modern.geometry.vectors import area_vector, cross, six_volumes

_UNIT: tuple[Position, ...] = tuple(tuple(Fraction(int(k == axis)) for k in range(3)) for axis in range(3))
Whole = tuple[int, int, int]


@dataclass(frozen=True, slots=True)
class Measures:
    """The measures of a solid and its hull, in physical units, or in voxels if the position is unknown.

    ``voxels`` is the number of the solid's voxels, and ``volume`` their volume. A flat hull has the volume 0. The area
    of a polygon is that of one side; the area of a segment or a point is 0.
    """

    voxels: int
    volume: Fraction
    hull_volume: Fraction
    hull_area: Decimal

    @property
    def solidity(self) -> Fraction:
        """The fraction of the hull that the solid fills, if the hull is that of the voxels' corners.

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
    voxels, with three steps in a space with three axes.
    """
    polygons = [tuple(face) for face in faces]
    six = six_volumes(points, polygons) if len(polygons) > 1 else 0
    steps = _UNIT if world is None else world.steps
    cell = voxel_volume(world)
    # A linear map multiplies area vectors by its cofactor matrix, whose rows are vector products of the steps.
    rows = [cross(_three(steps[(k + 1) % 3]), _three(steps[(k + 2) % 3])) for k in range(3)]
    scale = math.lcm(*(number.denominator for row in rows for number in row))
    cofactors = [[int(number * scale) for number in row] for row in rows]
    squares = []
    for face in polygons:
        normal = area_vector(points, face)
        image = [sum(normal[k] * cofactors[k][j] for k in range(3)) for j in range(3)]
        squares.append(Fraction(sum(number * number for number in image), (2 * scale) ** 2))
    area = sum_of_roots(squares, AREA_DIGITS)
    return Measures(voxels, voxels * cell, Fraction(abs(six), 6) * cell, area)


def _three(step: Sequence[Fraction]) -> tuple[Fraction, Fraction, Fraction]:
    x, y, z = step
    return x, y, z

"""Exact measures of a solid of voxels and of its hull: volumes, areas, solidity, convex deficiency.

The hull's vertices are whole coordinates (of voxels' centres or corners).  Volumes are fractions.  The area of
a surface is a sum of square roots and has ``AREA_DIGITS`` significant digits; it is exact where every root is a
decimal of no more.
"""

from __future__ import annotations

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
    """What a solid and its hull measure, in the world's units, or in voxels where there is no world.

    voxels: how many the solid has.  volume: theirs.  hull_volume, hull_area: of the hull, 0 of what is flat; the area
    of a polygon is that of its one side.
    """

    voxels: int
    volume: Fraction
    hull_volume: Fraction
    hull_area: Decimal

    @property
    def solidity(self) -> Fraction:
        """The share of the hull that the solid fills, where the hull is of voxels' corners and so contains them.

        Raises VolumeError for a flat hull.
        """
        if not self.hull_volume:
            raise VolumeError("a flat hull has no volume, and a solid in it no solidity")
        return self.volume / self.hull_volume

    @property
    def deficiency(self) -> Fraction:
        """The volume of the convex deficiency, the hull without the solid (Yau and Srihari, section 1)."""
        return self.hull_volume - self.volume


def measures(
    voxels: int, points: Sequence[Whole], faces: Iterable[Sequence[int]], world: World | None = None
) -> Measures:
    """The measures of a solid with so many voxels and of the hull with these vertices and faces.

    points: whole coordinates.  faces: of a polyhedron all, of a polygon one, of other hulls none; places in ``points``
    from 0, in cyclic order; all of a polyhedron's in the same sense.  world: three steps in a space of three axes.
    """
    polygons = [tuple(face) for face in faces]
    six = six_volumes(points, polygons) if len(polygons) > 1 else 0
    steps = _UNIT if world is None else world.steps
    cell = voxel_volume(world)
    # Areas turn with the cofactors: of edges u, v the vector product of their images is that of the cofactors' rows.
    rows = [cross(_three(steps[(k + 1) % 3]), _three(steps[(k + 2) % 3])) for k in range(3)]
    scale = math.lcm(*(number.denominator for row in rows for number in row))
    whole = [[int(number * scale) for number in row] for row in rows]
    squares = []
    for face in polygons:
        normal = area_vector(points, face)
        image = [sum(normal[k] * whole[k][j] for k in range(3)) for j in range(3)]
        squares.append(Fraction(sum(number * number for number in image), (2 * scale) ** 2))
    area = sum_of_roots(squares, AREA_DIGITS)
    return Measures(voxels, voxels * cell, Fraction(abs(six), 6) * cell, area)


def _three(step: Sequence[Fraction]) -> tuple[Fraction, Fraction, Fraction]:
    x, y, z = step
    return x, y, z

"""The position of voxels: the exact affine map from a voxel's integer coordinates to physical coordinates.

The position of a voxel is that of its centre. The centre of voxel (0, 0, 0) is the origin, and the centres of
neighbouring voxels along an axis of the array differ by the step of that axis, a vector. As a solid, a voxel extends
half a step from its centre in each direction. Spacing, origin and directions are read exactly, as decimals. Therefore a
hull in physical coordinates is the exact image of the hull in voxel coordinates.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from decimal import Context
from fractions import Fraction
from itertools import permutations

from emulator.errors import EmulatorError, quoted
from modern.geometry.numbers import Exact, PointsError, decimal, finite_decimal, real, split_decimal

Position = tuple[Fraction, ...]

LPS, RAS, LAS = "left-posterior-superior", "right-anterior-superior", "left-anterior-superior"
# The anatomical spaces of NRRD, named after the directions in which x, y and z increase.
ANATOMICAL = (LPS, RAS, LAS)
_OPPOSITE = {"left": "right", "posterior": "anterior", "superior": "inferior"}
_OPPOSITE |= {there: here for here, there in _OPPOSITE.items()}
_MOST_DIGITS, _MOST_EXPONENT = 100, 400


class VolumeError(EmulatorError):
    """Raised for an invalid volume. The message names the file, if there is one, and the place in the file."""


class NoVoxels(VolumeError, PointsError):
    """Raised for a volume without voxels, which has no hull."""


@dataclass(frozen=True, slots=True)
class World:
    """The position of a volume in physical coordinates.

    ``steps`` has a vector for each axis of the array: from the centre of a voxel to the centre of the next voxel.
    ``origin`` is the centre of voxel (0, 0, 0). ``space`` names the directions of the physical axes, such as
    ``left-posterior-superior``, and ``unit`` names the unit of lengths, such as ``mm``. Either is empty if it is
    unknown. Raise VolumeError if steps and origin have different numbers of coordinates or if the steps are linearly
    dependent.
    """

    steps: tuple[Position, ...]
    origin: Position
    space: str = ""
    unit: str = ""

    def __post_init__(self) -> None:
        if any(len(step) != len(self.origin) for step in self.steps):
            raise VolumeError(f"expected {len(self.origin)} coordinates in each step, as in the origin")
        gram = [[sum(map(_product, first, second), Fraction(0)) for second in self.steps] for first in self.steps]
        if not determinant(gram):
            raise VolumeError("the spacing of an axis is 0, or the directions of the axes are linearly dependent")

    def place(self, voxel: Sequence[Exact]) -> Position:
        """Return the physical coordinates of the point with these voxel coordinates.

        Integers denote the centre of a voxel, and half-integers a corner.
        """
        return tuple(
            sum((step[k] * number for step, number in zip(self.steps, voxel, strict=True)), start)
            for k, start in enumerate(self.origin)
        )

    @property
    def mirrors(self) -> bool:
        """True if the three axes of the array form a left-handed system in space."""
        return len(self.steps) == len(self.origin) == 3 and determinant(self.steps) < 0

    def moved(self, voxel: Sequence[int]) -> "World":
        """Return the same position for shifted voxel coordinates, in which the given voxel is (0, 0, 0)."""
        return replace(self, origin=self.place(voxel))

    def turned(self, space: str) -> "World":
        """Return the same position in another anatomical space, such as ``right-anterior-superior``.

        Raise VolumeError if either space is not anatomical.
        """
        if space not in ANATOMICAL or self.space not in ANATOMICAL or len(self.origin) != 3:
            raise VolumeError(f"expected one of the spaces {', '.join(ANATOMICAL)}, found {self.space or 'none'}")
        signs = [
            1 if current == target else -1
            for current, target in zip(self.space.split("-"), space.split("-"), strict=True)
        ]
        steps = tuple(tuple(map(_product, signs, step)) for step in self.steps)
        return replace(self, steps=steps, origin=tuple(map(_product, signs, self.origin)), space=space)

    def spacings(self) -> tuple[tuple[str, bool], ...]:
        """Return the length of each step as text, and True if it is exact or False if it is rounded to six digits."""
        return tuple(_length(step) for step in self.steps)

    def bearings(self) -> tuple[tuple[str, bool], ...]:
        """Return the direction assigned to each axis, such as ``left``, and True if the axis has exactly this
        direction.

        The result is empty if the space is not anatomical.
        """
        if self.space not in ANATOMICAL or len(self.steps) != 3:
            return ()
        names = self.space.split("-")
        # Assign a different direction to each axis, with the largest product of cosines.
        best = max(
            permutations(range(3)),
            key=lambda order: math.prod(abs(step[k]) for step, k in zip(self.steps, order, strict=True)),
        )
        directions = []
        for step, k in zip(self.steps, best, strict=True):
            directions.append((names[k] if step[k] > 0 else _OPPOSITE[names[k]], sum(map(bool, step)) == 1))
        return tuple(directions)


def world_of(
    dimension: int,
    spacing: Sequence[object] | None = None,
    origin: Sequence[object] | None = None,
    directions: Sequence[Sequence[object]] | None = None,
    unit: str = "",
) -> World | None:
    """Return the position of the voxels of an array from the given numbers, or None if no argument is given.

    ``spacing`` has a length for each axis (default 1), ``origin`` is the centre of the first voxel (default 0), and
    ``directions`` has a vector for each axis, which is multiplied by the spacing (default: along x, y and z). Numbers
    may have any real type and are read exactly. Raise VolumeError for a wrong count or type of numbers, and as
    ``World`` does.
    """
    if spacing is None and origin is None and directions is None:
        return None
    lengths = _numbers("spacing", spacing, dimension) if spacing is not None else (Fraction(1),) * dimension
    if directions is None:
        rows = [tuple(Fraction(int(k == axis)) for k in range(dimension)) for axis in range(dimension)]
    else:
        if len(directions) != dimension:
            raise VolumeError(f"directions: expected {dimension} vectors, found {len(directions)}")
        width = len(directions[0])
        rows = [_numbers(f"direction of axis {axis}", row, width) for axis, row in enumerate(directions)]
    width = len(rows[0])
    start = _numbers("origin", origin, width) if origin is not None else (Fraction(0),) * width
    steps = tuple(tuple(length * number for number in row) for length, row in zip(lengths, rows, strict=True))
    return World(steps, start, "", unit)


def voxel_volume(world: World | None) -> Fraction:
    """Return the exact volume of a voxel, or the area of a pixel, or 1 if the position is unknown.

    Raise VolumeError for a picture in a space with three axes, because the area of its pixels may be irrational.
    """
    if world is None:
        return Fraction(1)
    if len(world.steps) != len(world.origin):
        raise VolumeError(
            f"{len(world.steps)} axes in a space of {len(world.origin)} dimensions: the area of a pixel may be "
            "irrational, and areas are computed as exact fractions"
        )
    return abs(determinant(world.steps))


def length_text(text: str) -> Fraction:
    """Return the exact value of a number in a file header.

    Raise ValueError for more than 100 digits or an exponent beyond 400.
    """
    _, whole, fraction, exponent = split_decimal(text)
    if len(whole) + len(fraction) > _MOST_DIGITS or abs(exponent) > _MOST_EXPONENT:
        raise ValueError(f"{quoted(text)} has more than {_MOST_DIGITS} digits or an exponent beyond {_MOST_EXPONENT}")
    return Fraction(decimal(text))


def decimal_or_fraction(value: Fraction) -> str:
    """Return the exact text of a number: a decimal if its expansion is finite, otherwise p/q."""
    return finite_decimal(value) or str(value)


def determinant(rows: Sequence[Sequence[Fraction]]) -> Fraction:
    """Return the determinant of a square matrix with one to three rows."""
    if len(rows) == 1:
        return rows[0][0]
    total = Fraction(0)
    for k, head in enumerate(rows[0]):
        minor = [[number for j, number in enumerate(row) if j != k] for row in rows[1:]]
        total += (-head if k % 2 else head) * determinant(minor)
    return total


def _product(first: Exact, second: Exact) -> Fraction:
    return Fraction(first * second)


def _numbers(what: str, values: Sequence[object], count: int) -> Position:
    if len(values) != count:
        raise VolumeError(f"{what}: expected {count} numbers, found {len(values)}")
    try:
        return tuple(Fraction(real(value)) for value in values)
    except ValueError as error:
        raise VolumeError(f"{what}: {error}") from None


def _length(step: Position) -> tuple[str, bool]:
    along = [abs(number) for number in step if number]
    if len(along) == 1:
        text = finite_decimal(along[0])
        if text is not None:
            return text, True
    square = sum((number * number for number in step), Fraction(0))
    work = Context(prec=30)
    root = work.sqrt(work.divide(work.create_decimal(square.numerator), work.create_decimal(square.denominator)))
    return format(Context(prec=6).plus(root).normalize(), "f"), False

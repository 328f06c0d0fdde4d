"""Where voxels lie: the affine map from a voxel's whole coordinates to a position in the world, in exact numbers.

A position is that of a voxel's centre: voxel (0, 0, 0) has its centre at the origin, and one step along an axis of the
array adds that axis's step.  The voxel as a body reaches half a step further each way.  Spacing, origin and directions
come from a file as decimal text and stay exact, so a hull in the world is the exact image of the hull of indices.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from decimal import Context
from fractions import Fraction
from itertools import permutations

from emulator.errors import EmulatorError
from modern.geometry.numbers import Exact, PointsError, decimal, finite_decimal, quoted, real, split_decimal

Position = tuple[Fraction, ...]

LPS, RAS, LAS = "left-posterior-superior", "right-anterior-superior", "left-anterior-superior"
"""The spaces of NRRD in which axes have anatomical names: to what side each of x, y and z grows."""
ANATOMICAL = (LPS, RAS, LAS)
_OPPOSITE = {"left": "right", "posterior": "anterior", "superior": "inferior"}
_OPPOSITE |= {there: here for here, there in _OPPOSITE.items()}
_MOST_DIGITS, _MOST_EXPONENT = 100, 400


class VolumeError(EmulatorError):
    """A volume that cannot be read or made; the message names file and place."""


class NoVoxels(VolumeError, PointsError):
    """A volume without a voxel: as with no points, there is no hull."""


@dataclass(frozen=True, slots=True)
class World:
    """The place of a volume in the world.

    steps: for each axis of the array, from a voxel's centre to that of the next along it.  origin: the centre of voxel
    (0, 0, 0).  space: what the world's axes mean, ``left-posterior-superior`` or whatever the file calls it; empty if
    nothing is said.  unit: of lengths, such as ``mm``; empty if nothing is said.

    Raises VolumeError for steps of different lengths, and for steps that lie in one plane or on one line.
    """

    steps: tuple[Position, ...]
    origin: Position
    space: str = ""
    unit: str = ""

    def __post_init__(self) -> None:
        if any(len(step) != len(self.origin) for step in self.steps):
            raise VolumeError(f"the steps and the origin have {len(self.origin)} coordinates each")
        gram = [[sum(map(_product, one, other), Fraction(0)) for other in self.steps] for one in self.steps]
        if not determinant(gram):
            raise VolumeError("the spacing of an axis is 0, or the directions of the axes depend on each other")

    def place(self, voxel: Sequence[Exact]) -> Position:
        """The position of a voxel's centre; of a corner, whose coordinates are halves, that corner's."""
        return tuple(
            sum((step[k] * number for step, number in zip(self.steps, voxel, strict=True)), start)
            for k, start in enumerate(self.origin)
        )

    @property
    def mirrors(self) -> bool:
        """Whether three steps turn a right hand into a left one."""
        return len(self.steps) == len(self.origin) == 3 and determinant(self.steps) < 0

    def moved(self, voxel: Sequence[int]) -> World:
        """The world in which the coordinates count from another voxel."""
        return replace(self, origin=self.place(voxel))

    def turned(self, space: str) -> World:
        """The same place in another anatomical space.  Raises VolumeError where one of the two is none."""
        if space not in ANATOMICAL or self.space not in ANATOMICAL or len(self.origin) != 3:
            raise VolumeError(
                f"the space is {self.space or 'not stated'}, and only {', '.join(ANATOMICAL)} are exchanged"
            )
        signs = [
            1 if here == there else -1 for here, there in zip(self.space.split("-"), space.split("-"), strict=True)
        ]
        steps = tuple(tuple(map(_product, signs, step)) for step in self.steps)
        return replace(self, steps=steps, origin=tuple(map(_product, signs, self.origin)), space=space)

    def spacings(self) -> tuple[tuple[str, bool], ...]:
        """The length of every step as decimal text, and whether it is exact; else it has six digits."""
        return tuple(_length(step) for step in self.steps)

    def bearings(self) -> tuple[tuple[str, bool], ...]:
        """To what side each axis of the array runs, and whether exactly so; none where the space has no such names."""
        if self.space not in ANATOMICAL or len(self.steps) != 3:
            return ()
        names = self.space.split("-")
        # Each axis has a side of its own: the three that lie best along the steps, as large a product as there is.
        best = max(permutations(range(3)), key=lambda order: _aligned(self.steps, order))
        found = []
        for step, k in zip(self.steps, best, strict=True):
            found.append((names[k] if step[k] > 0 else _OPPOSITE[names[k]], sum(map(bool, step)) == 1))
        return tuple(found)


def world_of(
    dimension: int,
    spacing: Sequence[object] | None = None,
    origin: Sequence[object] | None = None,
    directions: Sequence[Sequence[object]] | None = None,
    unit: str = "",
) -> World | None:
    """The world of an array with so many axes from numbers of any real type, None where nothing is given.

    spacing: a length for each axis (default: 1).  origin: the position of the first voxel's centre (default: 0).
    directions: for each axis a vector, which is multiplied by its spacing (default: along x, y, z).  A float is the
    number it holds; decimal text and fractions are exact.

    Raises VolumeError for numbers of another count or kind, and as ``World``.
    """
    if spacing is None and origin is None and directions is None:
        return None
    lengths = _numbers("spacing", spacing, dimension) if spacing is not None else (Fraction(1),) * dimension
    if directions is None:
        rows = [tuple(Fraction(int(k == axis)) for k in range(dimension)) for axis in range(dimension)]
    else:
        if len(directions) != dimension:
            raise VolumeError(f"directions: {len(directions)} vectors; the array has {dimension} axes")
        width = len(directions[0])
        rows = [_numbers(f"direction of axis {axis}", row, width) for axis, row in enumerate(directions)]
    width = len(rows[0])
    start = _numbers("origin", origin, width) if origin is not None else (Fraction(0),) * width
    steps = tuple(tuple(length * number for number in row) for length, row in zip(lengths, rows, strict=True))
    return World(steps, start, "", unit)


def voxel_volume(world: World | None) -> Fraction:
    """The volume (in a plane the area) of a voxel, exactly; 1 where there is no world.

    Raises VolumeError for a picture in a space of three axes, whose pixels have areas with roots.
    """
    if world is None:
        return Fraction(1)
    if len(world.steps) != len(world.origin):
        raise VolumeError(f"{len(world.steps)} axes in a space of {len(world.origin)}: a pixel's area is no fraction")
    return abs(determinant(world.steps))


def length_text(text: str) -> Fraction:
    """The number of a header: decimal text of at most 100 digits, its exponent within -400 to 400.

    Raises ValueError.
    """
    _, whole, fraction, exponent = split_decimal(text)
    if len(whole) + len(fraction) > _MOST_DIGITS or abs(exponent) > _MOST_EXPONENT:
        raise ValueError(f"{quoted(text)} has more than {_MOST_DIGITS} digits or an exponent beyond {_MOST_EXPONENT}")
    return Fraction(decimal(text))


def decimal_or_fraction(value: Fraction) -> str:
    """The exact text of a number: a decimal where it has a finite one, else p/q."""
    return finite_decimal(value) or str(value)


def determinant(rows: Sequence[Sequence[Fraction]]) -> Fraction:
    """The determinant of a square of one to three rows, by its definition."""
    if len(rows) == 1:
        return rows[0][0]
    total = Fraction(0)
    for k, head in enumerate(rows[0]):
        rest = [[number for j, number in enumerate(row) if j != k] for row in rows[1:]]
        total += (-head if k % 2 else head) * determinant(rest)
    return total


def _product(one: Exact, other: Exact) -> Fraction:
    return Fraction(one * other)


def _numbers(what: str, values: Sequence[object], count: int) -> Position:
    if len(values) != count:
        raise VolumeError(f"{what}: {len(values)} numbers; {count} are due")
    try:
        return tuple(Fraction(real(value)) for value in values)
    except ValueError as error:
        raise VolumeError(f"{what}: {error}") from None


def _aligned(steps: Sequence[Position], order: Sequence[int]) -> Fraction:
    total = Fraction(1)
    for step, k in zip(steps, order, strict=True):
        total *= step[k] * step[k] / sum((number * number for number in step), Fraction(0))
    return total


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

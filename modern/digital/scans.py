"""Arrays of values from a file, and the selection of voxels: all values except 0, those not below a threshold, or
labels.

Nothing is rounded: a threshold is a decimal, which is compared with the exact value of each binary floating-point
number.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from modern.digital.intervals import slabs
from modern.digital.solids import NoVoxels, Volume, VolumeError
from modern.digital.world import World, decimal_or_fraction
from modern.geometry.numbers import finite_decimal

# Values within a range of at most this size are counted in a table; otherwise they are sorted.
_TABLE_SIZE = 1 << 16


@dataclass(frozen=True, slots=True, eq=False)
class Scan:
    """An array of numbers or truth values, indexed [x, y] or [x, y, z], before voxels are selected.

    ``origin`` is the coordinates of the voxel at index 0. ``world`` is the position of the voxels, or None if it is
    unknown. ``source`` is the name in messages, and ``notes`` has one line for each note of the file reader to the
    user. Raise VolumeError if the array has another type or number of axes, or a value that is not a number.
    """

    values: NDArray[Any]
    origin: tuple[int, ...]
    source: str
    world: World | None = None
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        array = self.values
        if array.dtype.kind not in "biuf" or array.ndim not in (2, 3):
            raise VolumeError(
                f"{self.source}: expected numbers or truth values with two or three axes, found an array of "
                f"{array.dtype} with {array.ndim} axes"
            )
        if array.dtype.kind == "f" and any(np.isnan(part).any() for part in _parts(array)):
            raise VolumeError(f"{self.source}: a value is not a number (nan), so its voxel cannot be classified")
        if not array.size:
            raise NoVoxels(f"{self.source}: there are no voxels: the array is empty")


@dataclass(frozen=True, slots=True)
class Choice:
    """The user's choice of voxels: those with a value of at least ``threshold``, in ``labels``, or other than 0."""

    threshold: Fraction | None = None
    labels: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class Chosen:
    """The voxels selected from a scan, and facts about the scan.

    ``lowest`` and ``highest`` are the least and the greatest value of the scan, or None if that value is infinite. If
    the user chose labels, ``present`` has all labels of the scan. ``truth`` is True if the scan holds truth values.
    """

    volume: Volume
    choice: Choice
    lowest: Fraction | None
    highest: Fraction | None
    present: tuple[int, ...] = ()
    truth: bool = False


def chosen(scan: Scan, choice: Choice | None = None) -> Chosen:
    """Return the voxels of a scan whose values the user has selected.

    Raise VolumeError if both a threshold and labels are given. Raise NoVoxels if no voxel is selected or a label has no
    voxels.
    """
    choice = choice or Choice()
    if choice.threshold is not None and choice.labels:
        raise VolumeError(f"{scan.source}: a threshold and labels cannot be combined")
    lowest, highest = _range(scan.values)
    present: tuple[int, ...] = ()
    if choice.labels:
        present = labels_of(scan)
        truth = np.zeros(scan.values.shape, np.bool_)
        for label in choice.labels:
            _check_label(scan, label, present)
            truth |= scan.values == scan.values.dtype.type(label)
    elif choice.threshold is not None:
        truth = _at_least(scan.values, choice.threshold)
    else:
        truth = scan.values if scan.values.dtype == np.bool_ else scan.values != 0
    if not truth.any():
        if choice.threshold is None:
            raise NoVoxels(f"{scan.source}: there are no voxels: every value is 0")
        most, least = ("infinite" if n is None else decimal_or_fraction(n) for n in (highest, choice.threshold))
        raise NoVoxels(f"{scan.source}: there are no voxels: the greatest value is {most}, below the threshold {least}")
    notes = (*scan.notes, *label_notes(scan)) if choice.labels else scan.notes
    volume = Volume(truth, scan.origin, scan.source, notes, scan.world)
    return Chosen(volume, choice, lowest, highest, present, scan.values.dtype == np.bool_)


def labels_of(scan: Scan) -> tuple[int, ...]:
    """Return the labels of a scan, which are its integer values except 0, in increasing order."""
    return tuple(sorted({label for part in _parts(scan.values) for label in _labels(part)}))


def label_notes(scan: Scan) -> tuple[str, ...]:
    """Return a note with the number of voxels whose values are no labels because they are not integers, if any."""
    if scan.values.dtype.kind != "f":
        return ()
    count, distinct = 0, np.empty(0, scan.values.dtype)
    for part in _parts(scan.values):
        fractional = part[~(np.isfinite(part) & (part == np.floor(part)))]
        count += fractional.size
        distinct = np.unique(np.concatenate([distinct, fractional]))
    if not count:
        return ()
    values = f"distinct values: {len(distinct)}, such as {distinct[0]:.6g}"
    return (f"{scan.source}: voxels left out because their values are not integers: {count} ({values})",)


def label_boxes(scan: Scan, labels: Sequence[int] = ()) -> dict[int, tuple[slice, ...]]:
    """Return, for each label, the slices of the smallest box that contains its voxels.

    ``labels`` are the requested labels, by default all. Raise NoVoxels for a label without voxels.
    """
    sides: dict[int, list[slice]] = {}
    for axis in range(scan.values.ndim):
        first: dict[int, int] = {}
        last: dict[int, int] = {}
        for index, layer in enumerate(np.moveaxis(scan.values, axis, 0)):
            for label in _labels(layer):
                first.setdefault(label, index)
                last[label] = index
        for label, start in first.items():
            sides.setdefault(label, []).append(slice(start, last[label] + 1))
    present = sorted(sides)
    if not present:
        raise NoVoxels(f"{scan.source}: there are no labels: no value is an integer other than 0")
    for label in labels:
        _check_label(scan, label, present)
    return {label: tuple(sides[label]) for label in labels or present}


def label_volume(scan: Scan, label: int, box: tuple[slice, ...]) -> Volume:
    truth = scan.values[box] == scan.values.dtype.type(label)
    origin = tuple(start + side.start for start, side in zip(scan.origin, box, strict=True))
    return Volume(truth, origin, f"{scan.source}: label {label}", (), scan.world)


def _check_label(scan: Scan, label: int, present: Sequence[int]) -> None:
    if label not in present:
        available = f"the labels are {listed_labels(present)}" if present else "there are no labels"
        raise NoVoxels(f"{scan.source}: no voxel has the label {label}; {available}")


def _labels(part: NDArray[Any]) -> list[int]:
    distinct = _distinct(_counted(part))
    integers = (
        distinct[np.isfinite(distinct) & (distinct != 0) & (distinct == np.floor(distinct))]
        if distinct.dtype.kind == "f"
        else distinct
    )
    return [int(value) for value in integers if value]


def _counted(values: NDArray[Any]) -> NDArray[Any]:
    return values.view(np.uint8) if values.dtype == np.bool_ else values


def _distinct(part: NDArray[Any]) -> NDArray[Any]:
    if part.dtype.kind in "iu":
        low, high = int(part.min()), int(part.max())
        if high < 2**63 and high - low < _TABLE_SIZE:
            present = np.zeros(high - low + 1, np.bool_)
            present[part.astype(np.int64) - low] = True
            return np.flatnonzero(present) + low
    return np.unique(part)


def _at_least(values: NDArray[Any], threshold: Fraction) -> NDArray[np.bool_]:
    counted = _counted(values)
    kind: Any = counted.dtype.type
    if counted.dtype.kind in "iu":
        least, bounds = -(-threshold.numerator // threshold.denominator), np.iinfo(counted.dtype)
        if not bounds.min < least <= bounds.max:
            return np.full(values.shape, least <= bounds.min, np.bool_)
        return np.asarray(counted >= kind(least))
    if counted.dtype.itemsize < 8:
        kind = np.float64  # holds every number of the shorter types
    # An array of one element keeps its type. Some versions of numpy would convert a scalar to a shorter type.
    return np.asarray(counted >= np.full(1, _least(kind, threshold)))


def _least(kind: Any, threshold: Fraction) -> Any:
    """Return the least number of the floating-point type ``kind`` that is not below the threshold."""
    text = finite_decimal(threshold)
    try:
        near = kind(float(threshold) if text is None else text)
    except OverflowError:
        near = kind("inf" if threshold > 0 else "-inf")
    # The conversion may be off by a few units in the last place, so step to the exact bound.
    while np.isfinite(near) and Fraction(*near.as_integer_ratio()) >= threshold:
        near = np.nextafter(near, kind("-inf"))
    while near == kind("-inf") or (np.isfinite(near) and Fraction(*near.as_integer_ratio()) < threshold):
        near = np.nextafter(near, kind("inf"))
    return near


def _range(values: NDArray[Any]) -> list[Fraction | None]:
    counted = _counted(values)
    ends = counted.min(), counted.max()
    if counted.dtype.kind in "iu":
        return [Fraction(int(end)) for end in ends]
    return [Fraction(*end.as_integer_ratio()) if np.isfinite(end) else None for end in ends]


def _parts(values: NDArray[Any]) -> Iterator[NDArray[Any]]:
    return (values[part] for part in slabs(values))


def listed_labels(labels: Sequence[int]) -> str:
    """Return labels as text, such as ``1, 2, 3, 7``. If there are over 12, list the first four and the last one."""
    if len(labels) <= 12:
        return ", ".join(map(str, labels))
    return f"{', '.join(map(str, labels[:4]))}, ... {labels[-1]} ({len(labels)} labels)"

"""Scans: arrays of values, and which of their voxels are taken: those not 0, those from a threshold up, or labels.

Nothing is rounded: a threshold is a decimal, and a value that a binary float holds is compared as the number it is.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from modern.digital.columns import slabs
from modern.digital.solids import NoVoxels, Volume, VolumeError
from modern.digital.world import World, decimal_or_fraction
from modern.geometry.numbers import finite_decimal

_FEW = 1 << 16
"""Values of so many kinds at most are counted in a table, others sorted."""


@dataclass(frozen=True, slots=True, eq=False)
class Scan:
    """An array of numbers or truth values, indexed [x, y] or [x, y, z], before voxels are chosen.

    origin: the coordinates of the voxel at index 0.  world: where voxels lie; None where nothing says it.
    source: what messages call it.  notes: what the reader of the file should know, a line each.

    Raises VolumeError for another type or number of axes, and for a value that is not a number.
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
                f"{self.source}: an array of {array.dtype} with {array.ndim} axes; a volume has numbers or truth "
                "values, and two or three axes"
            )
        if array.dtype.kind == "f" and any(np.isnan(part).any() for part in _parts(array)):
            raise VolumeError(
                f"{self.source}: a value is not a number (nan), so that nobody can say whether the voxel belongs"
            )
        if not array.size:
            raise NoVoxels(f"{self.source}: there are no voxels: the array is empty")


@dataclass(frozen=True, slots=True)
class Choice:
    """Which values belong: from ``threshold`` up, or equal to one of ``labels``; with neither, those other than 0."""

    threshold: Fraction | None = None
    labels: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class Chosen:
    """The voxels chosen from a scan, and what there was to choose from.

    lowest, highest: of all values.  present: the labels there are, where labels were chosen: all whole values but 0.
    truth: whether the scan holds truth values, so that there was nothing to choose.
    """

    volume: Volume
    choice: Choice
    lowest: Fraction | None
    highest: Fraction | None
    present: tuple[int, ...] = ()
    truth: bool = False


def chosen(scan: Scan, choice: Choice | None = None) -> Chosen:
    """The voxels of a scan whose values are chosen.

    Raises VolumeError for both a threshold and labels and for a label that no voxel has, NoVoxels where none is left.
    """
    choice = choice or Choice()
    if choice.threshold is not None and choice.labels:
        raise VolumeError(f"{scan.source}: a threshold and labels are not asked for together")
    lowest, highest = _range(scan.values)
    present: tuple[int, ...] = ()
    if choice.labels:
        present = labels_of(scan)
        truth = np.zeros(scan.values.shape, np.bool_)
        for label in choice.labels:
            _check_label(scan, label, present)
            truth |= scan.values == scan.values.dtype.type(label)
    elif choice.threshold is not None:
        truth = _from(scan.values, choice.threshold)
    else:
        truth = scan.values if scan.values.dtype == np.bool_ else scan.values != 0
    if not truth.any():
        if choice.threshold is None:
            raise NoVoxels(f"{scan.source}: there are no voxels: every value is 0")
        most, least = (_text(number) for number in (highest, choice.threshold))
        raise NoVoxels(f"{scan.source}: there are no voxels: the greatest value is {most}, the threshold {least}")
    volume = Volume(truth, scan.origin, scan.source, scan.notes, scan.world)
    return Chosen(volume, choice, lowest, highest, present, scan.values.dtype == np.bool_)


def labels_of(scan: Scan) -> tuple[int, ...]:
    """The whole values of a scan other than 0, in order; values that are not whole are none."""
    return tuple(sorted({label for part in _parts(scan.values) for label in _labels(part)}))


def label_boxes(scan: Scan, labels: Sequence[int] = ()) -> dict[int, tuple[slice, ...]]:
    """The smallest box of indices that holds all voxels of a label: of some labels as asked, or of all in order.

    Raises NoVoxels for a label that no voxel has, and for a scan without any.
    """
    sides: dict[int, list[slice]] = {}
    for axis in range(scan.values.ndim):
        first: dict[int, int] = {}
        last: dict[int, int] = {}
        for place, layer in enumerate(np.moveaxis(scan.values, axis, 0)):
            for label in _labels(layer):
                first.setdefault(label, place)
                last[label] = place
        for label, start in first.items():
            sides.setdefault(label, []).append(slice(start, last[label] + 1))
    present = sorted(sides)
    if not present:
        raise NoVoxels(f"{scan.source}: there are no labels: no value is whole and not 0")
    for label in labels:
        _check_label(scan, label, present)
    return {label: tuple(sides[label]) for label in labels or present}


def label_volume(scan: Scan, label: int, box: tuple[slice, ...]) -> Volume:
    """The voxels of one label, in its box of ``label_boxes``."""
    truth = scan.values[box] == scan.values.dtype.type(label)
    origin = tuple(start + side.start for start, side in zip(scan.origin, box, strict=True))
    return Volume(truth, origin, f"{scan.source}: label {label}", (), scan.world)


def _check_label(scan: Scan, label: int, present: Sequence[int]) -> None:
    if label not in present:
        there = f"the labels are {listed_labels(present)}" if present else "there are no labels"
        raise NoVoxels(f"{scan.source}: no voxel has the label {label}; {there}")


def _labels(part: NDArray[Any]) -> list[int]:
    """The different whole values of a part other than 0."""
    found = _distinct(_counted(part))
    whole = found[np.isfinite(found) & (found != 0) & (found == np.floor(found))] if found.dtype.kind == "f" else found
    return [int(value) for value in whole if value]


def _counted(values: NDArray[Any]) -> NDArray[Any]:
    return values.view(np.uint8) if values.dtype == np.bool_ else values


def _distinct(part: NDArray[Any]) -> NDArray[Any]:
    """The different values of a part."""
    if part.dtype.kind in "iu":
        low, high = int(part.min()), int(part.max())
        if high < 2**63 and high - low < _FEW:
            there = np.zeros(high - low + 1, np.bool_)
            there[part.astype(np.int64) - low] = True
            return np.flatnonzero(there) + low
    return np.unique(part)


def _from(values: NDArray[Any], threshold: Fraction) -> NDArray[np.bool_]:
    """The voxels whose value is at least the threshold, exactly."""
    counted = _counted(values)
    kind: Any = counted.dtype.type
    if counted.dtype.kind in "iu":
        least, bounds = -(-threshold.numerator // threshold.denominator), np.iinfo(counted.dtype)
        if not bounds.min < least <= bounds.max:
            return np.full(values.shape, least <= bounds.min, np.bool_)
        return np.asarray(counted >= kind(least))
    if counted.dtype.itemsize < 8:
        kind = np.float64  # holds every number of the shorter types
    # As an array of one the bound keeps its type: some versions of numpy would shorten a single number.
    return np.asarray(counted >= np.full(1, _least(kind, threshold)))


def _least(kind: Any, threshold: Fraction) -> Any:
    """The least number of a binary type that is not below the threshold."""
    text = finite_decimal(threshold)
    try:
        near = kind(float(threshold) if text is None else text)
    except OverflowError:
        near = kind("inf" if threshold > 0 else "-inf")
    while np.isfinite(near) and Fraction(*near.as_integer_ratio()) >= threshold:
        near = np.nextafter(near, kind("-inf"))
    while near == kind("-inf") or (np.isfinite(near) and Fraction(*near.as_integer_ratio()) < threshold):
        near = np.nextafter(near, kind("inf"))
    return near


def _range(values: NDArray[Any]) -> tuple[Fraction | None, Fraction | None]:
    """The lowest and the highest value; None for an infinite one."""
    counted = _counted(values)
    return _finite(counted.min()), _finite(counted.max())


def _finite(number: Any) -> Fraction | None:
    if number.dtype.kind in "iu":
        return Fraction(int(number))
    return Fraction(*number.as_integer_ratio()) if np.isfinite(number) else None


def _parts(values: NDArray[Any]) -> Iterator[NDArray[Any]]:
    return (values[part] for part in slabs(values))


def _text(number: Fraction | None) -> str:
    return "infinite" if number is None else decimal_or_fraction(number)


def listed_labels(labels: Sequence[int]) -> str:
    """``1, 2, 3, 7``; of many the first and the last, and how many."""
    if len(labels) <= 12:
        return ", ".join(map(str, labels))
    return f"{', '.join(map(str, labels[:4]))}, ... {labels[-1]} ({len(labels)} labels)"

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
        absent = [label for label in choice.labels if label not in present]
        if absent:
            raise NoVoxels(f"{scan.source}: no voxel has the label {absent[0]}; {_listed(present)}")
        truth = np.zeros(scan.values.shape, np.bool_)
        for label in choice.labels:
            truth |= scan.values == _kind(scan.values)(label)
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
    found: set[int] = set()
    for part in _parts(_counted(scan.values)):
        for value in _distinct(part).tolist():
            if value and value == value // 1 and abs(value) != float("inf"):
                found.add(int(value))
    return tuple(sorted(found))


def of_each_label(scan: Scan, labels: Sequence[int] = ()) -> Iterator[tuple[int, Volume]]:
    """For each of some labels, or of all, its voxels, in the smallest box that holds them.

    Raises NoVoxels for a label that no voxel has, and for a scan without any.
    """
    present = labels_of(scan)
    absent = [label for label in labels if label not in present]
    if absent or not present:
        what = f"no voxel has the label {absent[0]}" if absent else "there are no labels: no value is whole and not 0"
        raise NoVoxels(f"{scan.source}: {what}{'; ' + _listed(present) if present else ''}")
    boxes = _boxes(_counted(scan.values))
    for label in dict.fromkeys(labels or present):
        box = boxes[label]
        truth = scan.values[box] == _kind(scan.values)(label)
        origin = tuple(start + part.start for start, part in zip(scan.origin, box, strict=True))
        yield label, Volume(truth, origin, f"{scan.source}: label {label}", (), scan.world)


def _boxes(values: NDArray[Any]) -> dict[int, tuple[slice, ...]]:
    """The smallest box of every whole value but 0: per axis, the first and the last layer that has it."""
    sides: dict[int, list[slice]] = {}
    for axis in range(values.ndim):
        first: dict[Any, int] = {}
        last: dict[Any, int] = {}
        for place, layer in enumerate(np.moveaxis(values, axis, 0)):
            for value in _distinct(layer).tolist():
                first.setdefault(value, place)
                last[value] = place
        for value, start in first.items():
            sides.setdefault(value, []).append(slice(start, last[value] + 1))
    return {label: tuple(box) for label, box in sides.items()}


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


def _kind(values: NDArray[Any]) -> Any:
    """What makes a label a value of the array; labels that are compared are in it."""
    return values.dtype.type


def _range(values: NDArray[Any]) -> tuple[Fraction | None, Fraction | None]:
    """The lowest and the highest value; None for an infinite one."""
    counted = _counted(values)
    low, high = (getattr(counted, name)().item() for name in ("min", "max"))
    lowest, highest = (None if number in (float("inf"), -float("inf")) else Fraction(number) for number in (low, high))
    return lowest, highest


def _parts(values: NDArray[Any]) -> Iterator[NDArray[Any]]:
    return (values[part] for part in slabs(values))


def _text(number: Fraction | None) -> str:
    return "infinite" if number is None else decimal_or_fraction(number)


def _listed(labels: Sequence[int]) -> str:
    return f"the labels are {listed_labels(labels)}" if labels else "there are no labels"


def listed_labels(labels: Sequence[int]) -> str:
    """``1, 2, 3, 7``; of many the first and the last, and how many."""
    if len(labels) <= 12:
        return ", ".join(map(str, labels))
    return f"{', '.join(map(str, labels[:4]))}, ... {labels[-1]} ({len(labels)} labels)"

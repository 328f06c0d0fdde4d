"""The selection of a scan's voxels: thresholds and labels, compared exactly in every type of number."""

from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from hull1620 import digital_hull, read_volume
from modern.digital.scans import Choice, Scan, chosen, label_boxes, label_notes, label_volume, labels_of, listed_labels
from modern.digital.solids import NoVoxels, VolumeError

TYPES = ["?", "i1", "u1", ">i2", "u2", "i4", "i8", "u8", "f2", "f4", "f8", ">f8"]
values = arrays.arrays(
    st.sampled_from([np.dtype(kind) for kind in TYPES]),
    arrays.array_shapes(min_dims=2, max_dims=3, max_side=4),
    elements={"allow_nan": False},
)


def scan(array: Any) -> Scan:
    array = np.asarray(array)
    return Scan(array, (0,) * array.ndim, "scan")


def exact(value: Any) -> Fraction | float:
    number = value.item()
    return number if number in (float("inf"), -float("inf")) else Fraction(number)


@settings(deadline=None)
@given(values, st.data())
def test_a_threshold_selects_the_values_not_below_it(array: np.ndarray, data: st.DataObject) -> None:
    finite = [exact(v) for v in array.ravel() if np.isfinite(v)] or [Fraction(0)]
    near = data.draw(st.sampled_from(finite))
    little = Fraction(1, 10**40)
    threshold = near + data.draw(st.sampled_from([0, little, -little, Fraction(1, 3), 10**30]))
    expected = np.array([exact(v) >= threshold for v in array.ravel()]).reshape(array.shape)
    if expected.any():
        assert np.array_equal(chosen(scan(array), Choice(Fraction(threshold))).volume.array, expected)
    else:
        with pytest.raises(NoVoxels, match="the threshold"):
            chosen(scan(array), Choice(Fraction(threshold)))


@pytest.mark.parametrize("kind", ["f4", "f8", "g"])
def test_thresholds_are_compared_exactly_with_floats(kind: str) -> None:
    """The float written 0.1 is above one tenth, in single precision too. The double 0.3 is below three tenths."""
    narrow = np.float32 if kind == "f4" else np.float64
    assert chosen(scan(np.full((1, 1, 1), narrow(0.1), kind)), Choice(Fraction(1, 10))).volume.count == 1
    with pytest.raises(NoVoxels):
        chosen(scan(np.full((1, 1, 1), np.float64(0.3), "f8" if kind == "f4" else kind)), Choice(Fraction(3, 10)))


def test_wide_thresholds_and_values_that_are_not_integers() -> None:
    # The double next to 5/3 is above it, and a wider type has numbers between the two.
    threshold = Fraction(5, 3)
    value = np.longdouble(float(threshold))
    while Fraction(*np.nextafter(value, np.longdouble(0)).as_integer_ratio()) >= threshold:
        value = np.nextafter(value, np.longdouble(0))
    below = np.nextafter(value, np.longdouble(0))
    selection = chosen(scan(np.array([[below, value]])), Choice(threshold))
    assert selection.volume.array.tolist() == [[False, True]]
    volume = Scan(np.array([[0, 1, 1.25], [2.25, 1.25, np.inf]]), (0, 0), "scan")
    note = "scan: voxels left out because their values are not integers: 4 (distinct values: 3, such as 1.25)"
    assert label_notes(volume) == (note,)
    assert chosen(volume, Choice(labels=(1,))).volume.notes == (note,)
    assert chosen(volume).volume.notes == ()
    assert label_notes(Scan(np.array([[0.0, 1.0, 3.0]]), (0, 0), "scan")) == ()
    assert label_notes(Scan(np.array([[0, 1, 3]]), (0, 0), "scan")) == ()


@settings(deadline=None)
@given(values)
def test_labels_are_the_integer_values_except_zero(array: np.ndarray) -> None:
    whole = {int(v) for v in array.ravel() if np.isfinite(v) and v and v == np.floor(v)}
    assert labels_of(scan(array)) == tuple(sorted(whole))
    boxes = label_boxes(scan(array)) if whole else {}
    assert set(boxes) == whole
    for label, box in boxes.items():
        volume = label_volume(scan(array), label, box)
        voxels = {tuple(voxel) for voxel in volume.coordinates().tolist()}
        assert voxels == {tuple(index) for index in np.argwhere(array == array.dtype.type(label)).tolist()}
        for axis in range(array.ndim):
            # In the smallest box every side has a voxel.
            other_axes = tuple(k for k in range(array.ndim) if k != axis)
            assert volume.array.any(axis=other_axes)[[0, -1]].all()


def test_labels_are_selected_listed_and_reported_if_missing() -> None:
    array = np.array([[[0, 1, 2, 3, 3, 7]]], np.uint8)
    selection = chosen(scan(array), Choice(labels=(3, 1)))
    assert selection.volume.array.ravel().tolist() == [False, True, False, True, True, False]
    assert (selection.present, selection.lowest, selection.highest) == ((1, 2, 3, 7), 0, 7)
    assert chosen(scan(-array.astype(">f4")), Choice(labels=(-7,))).volume.count == 1
    with pytest.raises(NoVoxels, match="there are no labels: no value is an integer other than 0"):
        label_boxes(scan([[0.5, 0.0]]))
    with pytest.raises(NoVoxels, match="no voxel has the label 9; the labels are 1, 2"):
        label_boxes(scan([[1, 2]]), (1, 9))
    assert listed_labels([1, 2]) == "1, 2"
    assert listed_labels(range(1, 40)) == "1, 2, 3, 4, ... 39 (39 labels)"


@pytest.mark.parametrize(
    ("array", "choice", "message"),
    [
        ([[0, 1, 3]], Choice(labels=(3, 2)), "scan: no voxel has the label 2; the labels are 1, 3"),
        ([[0.5, 0.25]], Choice(labels=(1,)), "scan: no voxel has the label 1; there are no labels"),
        ([[0, 1]], Choice(Fraction(1), (1,)), "scan: a threshold and labels cannot be combined"),
        ([[0, 3]], Choice(Fraction(7, 2)), "there are no voxels: the greatest value is 3, below the threshold 3.5"),
        ([[0, 0]], Choice(), "there are no voxels: every value is 0"),
        ([[0.0, np.nan]], Choice(), "a value is not a number (nan)"),
        (np.zeros((0, 2, 2)), Choice(), "there are no voxels: the array is empty"),
        (np.zeros((2, 2), complex), Choice(), "found an array of complex128 with 2"),
    ],
)
def test_invalid_selections_are_reported(array: Any, choice: Choice, message: str) -> None:
    with pytest.raises(VolumeError) as caught:
        chosen(scan(array), choice)
    assert message in str(caught.value)


def test_read_volume_selects_by_threshold_and_by_label(tmp_path: Any) -> None:
    path = tmp_path / "a.npy"
    np.save(path, np.array([[[0, 1, 2, 3]]], np.int16))
    assert read_volume(path).count == 3
    assert read_volume(path, threshold="1.5").count == 2
    assert read_volume(path, labels=[2]).coordinates().tolist() == [[0, 0, 2]]
    placed = read_volume(path, labels=[1, 3], spacing=("0.5", 1, 2), origin=(1, 1, 1))
    hull = digital_hull(placed)
    assert (hull.voxels, hull.deficiency, hull.volume, hull.solidity) == (3, 1, 3, Fraction(2, 3))
    assert hull.world is not None
    assert hull.world.place((0, 0, 1)) == (1, 1, 3)
    with pytest.raises(VolumeError, match="threshold: 'x' is not a decimal"):
        read_volume(path, threshold="x")
    with pytest.raises(VolumeError, match="spacing: expected 3 numbers, found 2"):
        read_volume(path, spacing=(1, 2))

"""Compare the digital hull with the planes of the exact hull, evaluated at every grid point, and with scikit-image."""

import itertools
import random
import subprocess
import sys
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from emulator.jit.functions import NotInstalled
from modern.digital import intervals
from modern.digital.hull import KINDS, digital_hull
from modern.digital.solids import VERTEX, NoVoxels, VolumeError, ball
from tests.support.digital_judge import judged, random_solid, solid_of

VOLUMES = st.one_of(
    arrays.arrays(np.bool_, arrays.array_shapes(min_dims=2, max_dims=3, max_side=8)),
    arrays.arrays(
        np.bool_, arrays.array_shapes(min_dims=2, max_dims=3, max_side=12), elements=st.just(True), fill=st.just(False)
    ),
).filter(np.any)


def agrees(array: Any, fast: bool = False) -> bool:
    hull = digital_hull(array, fast)
    dimension, filled = judged(array)
    return hull.dimension == dimension and np.array_equal(hull.filled, filled)


@given(VOLUMES)
def test_hull_has_the_grid_points_of_the_judge(array: np.ndarray) -> None:
    assert agrees(array)


@given(st.integers(0, 10**9))
def test_hull_of_a_connected_solid_has_the_grid_points_of_the_judge(seed: int) -> None:
    assert agrees(random_solid(random.Random(seed), side=9))


@given(st.integers(0, 10**9), st.tuples(*[st.integers(-3, 3)] * 3), st.integers(-4, 9))
def test_coplanar_voxels_have_the_grid_points_of_the_judge(seed, normal, offset) -> None:
    source = np.random.default_rng(seed)
    array = source.random((7, 6, 8)) < 0.4
    positions = np.indices(array.shape).reshape(3, -1).T
    array &= (positions @ np.array(normal) == offset).reshape(array.shape)
    assert not array.any() or agrees(array)


def test_the_comparison_with_the_judge_can_fail(monkeypatch) -> None:
    array = solid_of([(0, 0, 0), (2, 0, 0), (0, 2, 1), (0, 0, 3)])
    assert agrees(array)
    monkeypatch.setattr(intervals, "_along", lambda line, t, z: (line[:1], t[:1], z[:1]))
    assert not agrees(array)


@pytest.mark.parametrize(
    ("voxels", "kind"),
    [
        ([(2, 1, 0)], "point"),
        ([(0, 0, 0), (6, 3, 9)], "segment"),
        ([(0, 0, 3), (3, 0, 0), (0, 3, 0)], "polygon"),
        ([(0, 0, 0), (0, 0, 5), (4, 2, 0)], "polygon"),  # an upright plane
        ([(0, 0, 0), (3, 0, 0), (0, 3, 0), (0, 0, 3)], "polyhedron"),
    ],
)
def test_hulls_of_every_dimension_have_the_grid_points_of_the_judge(voxels, kind) -> None:
    array = solid_of(voxels)
    for hull in (digital_hull(array), digital_hull(np.asfortranarray(array)), digital_hull(array.astype(float))):
        assert hull.kind == kind == KINDS[hull.dimension]
        assert hull.given == len(voxels)
        assert hull.voxels == np.count_nonzero(hull.filled)
        assert np.array_equal(hull.filled, judged(array)[1])


@pytest.mark.parametrize("shape", [(3, 4), (3, 4, 5), (0, 4), (3, 0, 5)])
def test_an_empty_volume_has_no_hull(shape: tuple[int, ...]) -> None:
    with pytest.raises(NoVoxels, match=r"^there are no points$"):
        digital_hull(np.zeros(shape, dtype=np.uint8))


def test_hull_of_a_picture_is_a_polygon() -> None:
    picture = np.zeros((5, 6), dtype=np.bool_)
    picture[0, 0] = picture[4, 1] = picture[2, 5] = True
    hull = digital_hull(picture)
    assert hull.kind == "polygon"
    assert np.array_equal(hull.filled, judged(picture)[1])


@pytest.mark.parametrize("axes", list(itertools.permutations(range(3))))
def test_result_has_the_axes_of_the_volume_in_any_memory_order(axes: tuple[int, int, int]) -> None:
    array = np.zeros((3, 5, 7), dtype=np.bool_)
    array[0, 0, 0] = array[2, 1, 3] = array[1, 4, 2] = array[0, 2, 6] = True
    assert agrees(array.transpose(axes))


@given(VOLUMES)
def test_the_hull_holds_its_volume_and_is_its_own_hull(array: np.ndarray) -> None:
    hull = digital_hull(array)
    repeated = digital_hull(hull.filled)
    assert not (array & ~hull.filled).any()
    assert np.array_equal(repeated.filled, hull.filled)
    assert repeated.dimension == hull.dimension


@pytest.mark.parametrize("diameter", [12, 33])
def test_ball_is_its_own_hull(diameter: int) -> None:
    volume = ball(diameter, VERTEX)
    assert np.array_equal(digital_hull(volume).filled, volume.array)


def test_batch_size_does_not_change_the_hull(monkeypatch) -> None:
    array = ball(15).array & (np.indices((15, 15, 15)).sum(axis=0) % 5 == 0)
    whole = digital_hull(array)
    monkeypatch.setattr(intervals, "SLAB", 1)
    monkeypatch.setattr(intervals, "BATCH", 7)
    assert np.array_equal(digital_hull(array).filled, whole.filled)
    assert agrees(array)


def test_compiled_code_finds_the_same_hull() -> None:
    pytest.importorskip("numba")
    source = random.Random(3)
    for _ in range(30):
        assert agrees(random_solid(source, side=8), fast=True)


def test_compiled_code_without_numba_is_an_error(monkeypatch) -> None:
    def no_numba() -> None:
        raise NotInstalled("compiled code needs numba")

    monkeypatch.setattr("modern.exact_hull.build.require_numba", no_numba)
    for volume in (ball(6), np.ones((3, 3)), np.ones((1, 2, 1)), np.ones((1, 1))):
        with pytest.raises(VolumeError, match="needs numba"):
            digital_hull(volume, fast=True)


@pytest.mark.parametrize(
    ("array", "message"),
    [
        (np.ones(5), "two or three axes"),
        (np.ones((2, 2, 2, 2)), "two or three axes"),
        (np.array([["a", "b"]]), "numbers or truth values"),
        (np.array([[0.0, np.nan]]), "not a number"),
        (np.broadcast_to(np.True_, (1 << 30, 1 << 30)), "exact hull of more than 72057594037927936 voxels"),
    ],
)
def test_invalid_arrays_are_refused(array: np.ndarray, message: str) -> None:
    with pytest.raises(VolumeError, match=message):
        digital_hull(array)


@given(VOLUMES)
def test_hull_agrees_with_scikit_image(array: np.ndarray) -> None:
    """With ``offset_coordinates=False`` its hull is one of voxel centres too. It returns nothing for flat volumes."""
    morphology = pytest.importorskip("skimage.morphology")
    hull = digital_hull(array)
    if hull.dimension == array.ndim:
        reference = morphology.convex_hull_image(array, offset_coordinates=False)
        assert np.array_equal(reference, hull.filled)


def test_numba_is_not_imported_for_a_small_volume() -> None:
    code = "import sys, numpy, hull1620; hull1620.digital_hull(numpy.ones((3, 3, 3))); sys.exit('numba' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0

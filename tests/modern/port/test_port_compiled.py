"""The compiled kernels (extra ``fast``) equal numpy bit for bit, and numpy runs if numba is missing."""

import subprocess
import sys
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from emulator.jit.functions import Compiled
from modern.geometry.hull import DETERMINED, ERROR, NOT_ACCEPTABLE, TABLE_FULL, Hull
from modern.port import fast, kernels, workspace
from modern.port.binary import FloatArithmetic
from modern.port.growth import LAST_PAIR, TABLE_OF_PLANES, THROUGH_CENTRE
from modern.port.table import PointTable
from tests.support.ported import convex_hull

Points = NDArray[np.float64]
Source = np.random.Generator


def ball(source: Source, count: int) -> Points:
    points = source.normal(size=(count, 3))
    return points * (source.random(count) ** (1 / 3) / np.linalg.norm(points, axis=1))[:, None]


def sphere(source: Source, count: int) -> Points:
    points = source.normal(size=(count, 3))
    return points / np.linalg.norm(points, axis=1)[:, None]


def whole_ball(source: Source, count: int) -> Points:
    return np.rint(ball(source, count) * 80_000)


def small_sphere(source: Source, count: int) -> Points:
    return np.rint(sphere(source, count) * 30)


def cube_surface(source: Source, count: int) -> Points:
    points = source.integers(-20, 21, size=(count, 3)).astype(np.float64)
    points[np.arange(count), source.integers(0, 3, count)] = source.choice([-20.0, 20.0], count)
    return points


def grid(source: Source, count: int) -> Points:
    return source.integers(-2, 3, size=(count, 3)).astype(np.float64)


def near_coplanar(source: Source, count: int) -> Points:
    points = source.integers(-9, 10, size=(count, 3)).astype(np.float64)
    points[:, 2] = points[:, 0] + points[:, 1] + source.choice([0.0, 2.0**-40], count)
    return points


def lens(source: Source, count: int) -> Points:
    points = sphere(source, count)
    points[:, 2] *= 1e-9
    return points


def cone(source: Source, count: int) -> Points:
    """Return the apex and base of a cone: a fan of planes about one point."""
    angle = np.arange(count) * (2 * np.pi / count)
    points = np.rint(np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1) * 1000)
    points[source.integers(0, count)] = (0, 0, 2000)
    return points


def tiny(source: Source, count: int) -> Points:
    """Return points whose products underflow."""
    return ball(source, count) * 1e-108


FAMILIES = (whole_ball, small_sphere, cube_surface, grid, near_coplanar, lens, cone, tiny, ball, sphere)
EPSILONS = (None, "0", "rel:1e-12", "rel:1e-6", "1e-7", "5")


def same(points: Any, arithmetic: str, **options: Any) -> Hull:
    """Compare both implementations, watched (one stage at a time) and unwatched (all stages at once)."""
    watched = convex_hull(points, arithmetic, history=True, fast=False, **options)
    assert convex_hull(points, arithmetic, history=True, fast=True, **options) == watched
    unwatched = convex_hull(points, arithmetic, fast=True, **options)
    assert unwatched == convex_hull(points, arithmetic, fast=False, **options)
    return watched


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("arithmetic", ["float64", "float32"])
def test_kernels_equal_numpy_bit_for_bit(family: Callable[[Source, int], Points], arithmetic: str) -> None:
    pytest.importorskip("numba")
    for seed in range(12):
        source = np.random.default_rng(seed)
        points = family(source, int(source.integers(4, 60))).astype(arithmetic)
        same(points, arithmetic, epsilon=EPSILONS[seed % len(EPSILONS)], translate=seed % 4 == 3)


def test_kernels_equal_numpy_for_every_kind_of_ending() -> None:
    """The comparison must include refused sets and the corrections."""
    pytest.importorskip("numba")
    hulls = [
        same(family(np.random.default_rng(seed), 40).astype(arithmetic), arithmetic, epsilon=epsilon)
        for family in (grid, cone, near_coplanar, lens)
        for seed in (2, 3, 5)
        for arithmetic in ("float64", "float32")
        for epsilon in (None, "rel:1e-6", "0.5")
    ]
    assert {hull.status for hull in hulls} == {DETERMINED, NOT_ACCEPTABLE, ERROR, TABLE_FULL}
    assert {name for hull in hulls for name in hull.corrected} >= {LAST_PAIR, THROUGH_CENTRE}


def test_kernels_equal_numpy_for_many_points_and_stages() -> None:
    """Slots are closed up, run out and are allocated again."""
    pytest.importorskip("numba")
    hull = same(whole_ball(np.random.default_rng(1), 4000), "float64")
    assert hull.status == DETERMINED
    assert TABLE_OF_PLANES in hull.corrected
    assert same(sphere(np.random.default_rng(3), 500), "float64", epsilon="rel:1e-11").status == DETERMINED


small = st.integers(-3, 3).map(float)


@given(st.lists(st.tuples(small, small, small), min_size=4, max_size=20), st.sampled_from(EPSILONS), st.booleans())
def test_kernels_run_as_python_equal_numpy(points, epsilon, translate) -> None:
    """Run the functions that numba compiles without numba."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(fast, "load", lambda _: fast.with_kernels(kernels.grow, kernels.satisfied))
        same(np.array(points), "float64", epsilon=epsilon, translate=translate)


@given(st.lists(st.tuples(st.integers(0, 3), st.integers(0, 3)), min_size=1, max_size=30))
def test_doubles_pairs_equal_planes_like_a_dictionary(edges: list[tuple[int, int]]) -> None:
    """Equal planes pair in order of appearance: first with second, third with fourth."""
    defining = np.array([(low, low + high + 1, 99) for low, high in edges], np.int64).T
    waiting: dict[tuple[int, ...], int] = {}
    partner = [-1] * len(edges)
    for k, key in enumerate(map(tuple, defining.T.tolist())):
        if key in waiting:
            earlier = waiting.pop(key)
            partner[k], partner[earlier] = earlier, k
        else:
            waiting[key] = k
    shuffled = np.array([np.roll(column, k) for k, column in enumerate(defining.T)]).T
    for columns in (defining, shuffled):
        scratch = workspace.scratch_for(len(edges), float)
        kernels.doubles(columns, 0, len(edges), scratch)
        assert scratch.partner.tolist() == partner


@given(st.lists(st.integers(1, 9).map(float), max_size=60))
def test_sort_descending_equals_a_reversed_stable_sort(values: list[float]) -> None:
    """Among equal values the later plane comes first."""
    order, sorted_ = np.arange(len(values) + 1), np.array([0.0, *values])
    kernels.sort_descending(order, sorted_, 1, len(order))
    assert order[1:].tolist() == (1 + np.argsort(values, kind="stable")[::-1]).tolist()
    assert sorted_[1:].tolist() == sorted(values, reverse=True)


def test_compiler_does_not_fuse_products_with_sums() -> None:
    """(1+e)(1-e) - 1 is 0 if the product is rounded first, and -e**2 if it is not."""
    pytest.importorskip("numba")
    e = 2.0**-30
    slots = workspace.Slots(
        np.array([[1 + e], [0.0], [0.0], [-1.0]]), np.zeros((3, 1), np.int64), np.array([-1.0]), np.array([True])
    )
    counts, indices = np.zeros(1, np.int64), np.full(2, -1)
    arguments = slots, np.array([[1 - e, 1.0], [0.0, 0.0], [0.0, 0.0]]), counts, indices
    assert Compiled(kernels.satisfied).ready(*arguments)(*arguments) == 1
    assert (counts.tolist(), indices.tolist()) == ([1], [0, -1])


def test_numpy_runs_without_numba(monkeypatch) -> None:
    monkeypatch.setitem(sys.modules, "numba", None)
    fast.load.cache_clear()
    points = whole_ball(np.random.default_rng(1), 6000)
    try:
        table = PointTable(points.T.copy(), np.arange(len(points)))
        assert fast.choose(FloatArithmetic(np.float64), table, None, None) is fast.PLAIN
        assert convex_hull(points, "float64").status == DETERMINED
        with pytest.raises(
            ValueError, match=r"^compiled code needs numba: pip install 'hull1620\[fast\]' \([^\n]*numba[^\n]*\)$"
        ):
            convex_hull(points, "float64", fast=True)
    finally:
        fast.load.cache_clear()


def test_few_points_do_not_load_numba() -> None:
    script = "import sys; from modern.port import convex_hull; import numpy as np;"
    script += "points = np.random.default_rng(1).integers(-99, 100, size=(60, 3)).astype(float);"
    script += "convex_hull(points, 'float64'); sys.exit('numba' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", script], check=False).returncode == 0

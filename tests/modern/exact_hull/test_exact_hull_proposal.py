"""The hull that is proposed for points rounded to a grid, and the treatment of a wrong proposal."""

import contextlib
import itertools
import math
import random
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from emulator.jit.functions import NotInstalled
from modern.exact_hull import CertificateError, ExactHull, exact_hull, kernels, proposal
from modern.exact_hull import build as build_module
from modern.exact_hull import certificate as checks
from modern.exact_hull.coordinates import Coordinates, read_points
from modern.exact_hull.facets import merged, planes_of, rotated
from modern.exact_hull.planes import long_signs
from modern.exact_hull.proposal import Proposal, _simplex, load, on_grid, propose
from tests.support.corrupted import BIG, GRID, OCTAHEDRON, PRISM, ball

LAW = settings(deadline=None, max_examples=200)
WIDE = st.integers(-(2**61) + 1, 2**61 - 1)
STEP = st.integers(-(2**30) + 1, 2**30 - 1)


def sphere(count: int, seed: int) -> list[tuple[int, ...]]:
    rng = random.Random(seed)
    rows = ([rng.gauss(0, 1) for _ in range(3)] for _ in range(count))
    return [tuple(round(10**8 * n / math.hypot(*row)) for n in row) for row in rows]


CUBE = list(itertools.product(range(6), repeat=3))
SETS = {
    "grid": GRID[:27],
    "cube": CUBE,
    "octahedron": OCTAHEDRON,
    "octahedral ball": [p for p in itertools.product(range(-4, 5), repeat=3) if sum(map(abs, p)) <= 4],
    "prism": PRISM,
    "big": BIG[:27],
    "ball": ball(300, 1),
    "sphere": sphere(400, 2),
    "lens": [(x * x - y, x * y, (x + y) % 2) for x in range(9) for y in range(9)],
}


@pytest.fixture
def _proposed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Propose hulls also for few points, and prevent the exact construction."""
    monkeypatch.setattr(build_module, "MANY", 4)
    monkeypatch.setattr(build_module, "_polyhedron", None)


def built(points, monkeypatch: pytest.MonkeyPatch) -> ExactHull:
    """Return the hull without a proposal."""
    monkeypatch.setattr(build_module, "MANY", math.inf)
    return exact_hull(points)


@pytest.mark.parametrize("name", SETS)
@pytest.mark.usefixtures("_proposed")
def test_the_proposed_hull_is_the_exact_hull(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    points = SETS[name]
    hull = exact_hull(points)
    monkeypatch.undo()
    assert hull == built(points, monkeypatch)


@pytest.mark.parametrize("name", SETS)
def test_the_kernel_and_numpy_propose_the_same_polytope(name: str) -> None:
    """The kernel runs in Python, and compiled if numba is installed."""
    points = SETS[name]
    hull = exact_hull(points)
    grid, exact = on_grid(read_points(points))
    start = np.array(_simplex(grid))
    ways = [kernels.grow]
    with contextlib.suppress(NotInstalled):
        ways.append(load())
    for grow in ways:
        known, room = kernels.surface(grid), kernels.room(len(grid))
        corners = known.corners[: grow(known, room, start, exact)]
        triangles, near = corners[corners[:, 0] >= 0], room.near
        assert set(planes_of(triangles, read_points(points))) == {facet.plane for facet in hull.facets}
        named = {*triangles.ravel().tolist(), *np.flatnonzero(near).tolist()}
        assert named >= {*hull.vertices, *hull.boundary}


def test_a_missing_kernel_raises_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    load.cache_clear()
    monkeypatch.setattr(build_module, "MANY", 4)
    monkeypatch.setitem(sys.modules, "numba", None)
    assert exact_hull(SETS["ball"], fast=False) == exact_hull(SETS["ball"])
    with pytest.raises(NotInstalled, match=r"needs numba: pip install 'hull1620\[fast\]'"):
        exact_hull(SETS["ball"], fast=True)
    monkeypatch.setattr(proposal, "_VERY_MANY", 1)
    assert exact_hull(SETS["ball"]) == exact_hull(SETS["ball"], fast=False)


@pytest.mark.usefixtures("_proposed")
def test_few_points_of_a_small_grid_have_the_exact_hull() -> None:
    """Many points are coplanar, collinear or equal."""
    rng = random.Random(12)
    solids = 0
    for _ in range(300):
        side = rng.choice((2, 3, 4))
        points = [tuple(rng.randrange(side) for _ in range(3)) for _ in range(rng.randint(4, 30))]
        hull = exact_hull(points)
        solids += hull.dimension == 3
        assert checks.certify(points, hull) == hull.certificate
    assert solids > 200


@given(st.lists(st.tuples(WIDE, WIDE, WIDE, STEP, STEP, STEP), min_size=1, max_size=20))
@LAW
def test_signs_of_long_products_are_exact(rows: list[tuple[int, ...]]) -> None:
    normals, steps = np.array(rows, np.int64).reshape(-1, 6)[:, :3], np.array(rows, np.int64).reshape(-1, 6)[:, 3:]
    true = [sum(a * b for a, b in zip(row[:3], row[3:], strict=True)) for row in rows]
    assert long_signs(normals, steps).tolist() == [(value > 0) - (value < 0) for value in true]


@given(STEP, STEP, STEP, st.integers(-3, 3))
@LAW
def test_signs_close_to_zero_are_exact(a: int, b: int, c: int, off: int) -> None:
    """Products of 60 digits cancel except for a few units."""
    normal = np.array([[a * b, -a * c, off]], np.int64)
    assert long_signs(normal, np.array([[c, b, 1]], np.int64))[0] == np.sign(off)


def test_points_are_rounded_to_the_grid() -> None:
    near, exact = on_grid(read_points([(5, -7, 2**29), (6, 9, -(2**29) + 1)]))
    assert exact
    assert near.tolist() == [[0, 0, 2**30 - 1], [1, 16, 0]]
    far, exact = on_grid(read_points([(10**40, 0, 0), (10**40 + 2**40, 1, 0), (10**40 + 2**40 - 1, 0, 1)]))
    assert not exact
    assert far.max() < 2**30
    assert far[:, 0].tolist() == [0, 2**29, 2**29 - 1]


def test_points_that_are_coplanar_after_rounding_have_no_proposal() -> None:
    """The points become coplanar when they are rounded, so the hull is constructed without a proposal."""
    points = [(x << 45, y << 45, (x + y << 45) + x * y % 3) for x in range(20) for y in range(20)]
    assert propose(read_points(points)) is None
    assert exact_hull(points).dimension == 3


def dropped(count: int):
    """Return a proposal without ``count`` of the points."""

    def wrong(points, fast) -> Proposal | None:
        found = propose(Coordinates(points.numbers[count:]), fast)
        return found and Proposal(found.triangles + count, found.near + count)

    return wrong


def turned(points, fast) -> Proposal | None:
    found = propose(points, fast)
    return found and Proposal(found.triangles[:, ::-1], found.near)


def torn(points, fast) -> Proposal | None:
    found = propose(points, fast)
    return found and Proposal(found.triangles[1:], found.near)


def pinched(points, fast) -> Proposal | None:
    found = propose(points, fast)
    return found and Proposal(np.concatenate([found.triangles, found.triangles[:1, [0, 0, 1]]]), found.near)


def unaware(points, fast) -> Proposal | None:
    """The proposal names no points that may lie on the surface."""
    found = propose(points, fast)
    return found and Proposal(found.triangles, found.near[:0])


@pytest.mark.parametrize("wrong", [dropped(1), dropped(9), turned, torn, pinched, unaware, lambda points, fast: None])
@pytest.mark.parametrize("name", ["cube", "ball", "sphere", "octahedral ball"])
def test_after_a_wrong_proposal_the_hull_is_constructed(wrong, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    points = SETS[name]
    expected = built(points, monkeypatch)
    monkeypatch.setattr(build_module, "MANY", 4)
    monkeypatch.setattr(build_module, "propose", wrong)
    assert exact_hull(points) == expected


def test_a_hull_constructed_after_a_refusal_is_proved_too(monkeypatch: pytest.MonkeyPatch) -> None:
    points = SETS["sphere"]
    monkeypatch.setattr(build_module, "propose", dropped(2))
    monkeypatch.setattr(build_module, "insertion_order", lambda count, simplex: [])
    with pytest.raises(CertificateError, match="is outside of facet"):
        exact_hull(points)


def test_vectorised_planes_equal_those_of_single_triangles() -> None:
    """The coordinates are below and above 2**30, and some faces have several triangles."""
    for points in (CUBE, BIG[:27], ball(40, 8), [tuple(10**9 * n for n in p) for p in CUBE]):
        triangles = propose(read_points(points)).triangles
        for plane, (a, b, c) in zip(planes_of(triangles, read_points(points)), triangles.tolist(), strict=True):
            p, q, r = points[a], points[b], points[c]
            assert all(plane[0] * x + plane[1] * y + plane[2] * z + plane[3] == 0 for x, y, z in (p, q, r))
            assert math.gcd(*plane) == 1
            x, y, z = (sum(axis) for axis in zip(*points, strict=True))
            assert plane[0] * x + plane[1] * y + plane[2] * z + plane[3] * len(points) < 0
        corners = [rotated(corners) for corners in triangles.tolist()]
        found = merged(corners, planes_of(triangles, read_points(points)), points)
        assert sorted(found, key=lambda facet: facet.plane) == list(exact_hull(points).facets)

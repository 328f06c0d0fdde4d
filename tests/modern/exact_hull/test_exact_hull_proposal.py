"""The hull that is proposed for points rounded to a grid, and the treatment of a wrong proposal."""

import contextlib
import itertools
import math
import random
import sys
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from emulator.jit.functions import NotInstalled
from modern.exact_hull import CertificateError, ExactHull, exact_hull, kernels, proposal
from modern.exact_hull import build as build_module
from modern.exact_hull import certificate as checks
from modern.exact_hull.coordinates import Coordinates, read_points
from modern.exact_hull.facets import independent, merged, planes_of
from modern.exact_hull.planes import long_signs
from modern.exact_hull.proposal import Proposal, _simplex, in_doubles, load
from modern.exact_hull.proposal import propose as proposed
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


FLOATS = [tuple(random.Random(k).gauss(0, 1) for k in range(3 * n, 3 * n + 3)) for n in range(300)]
# The surface of a box, turned so that its faces are plane only up to rounding.
TURNED = [(0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y, z + 0.1 * x) for x, y, z in CUBE if {x, y, z} & {0, 5}]


@pytest.fixture
def _proposed(monkeypatch) -> None:
    """Propose hulls also for few points, and prevent the exact construction."""
    monkeypatch.setattr(build_module, "MANY", 4)
    monkeypatch.setattr(build_module, "convex_surface", None)


def built(points, monkeypatch) -> ExactHull:
    """Return the hull without a proposal."""
    monkeypatch.setattr(build_module, "MANY", math.inf)
    return exact_hull(points)


@pytest.mark.parametrize("name", SETS)
@pytest.mark.usefixtures("_proposed")
def test_the_proposed_hull_is_the_exact_hull(name: str, monkeypatch) -> None:
    points = SETS[name]
    hull = exact_hull(points)
    monkeypatch.undo()
    assert hull == built(points, monkeypatch)


def propose(points, fast: bool | None = None) -> Proposal:
    coordinates = read_points(points)
    proposal = proposed(coordinates, independent(coordinates), fast)
    assert proposal is not None
    return proposal


@pytest.mark.parametrize("name", [*SETS, "floats", "turned box"])
def test_the_kernel_and_numpy_propose_the_same_polytope(name: str) -> None:
    """The kernel runs in Python, and compiled if numba is installed."""
    points = {**SETS, "floats": FLOATS, "turned box": TURNED}[name]
    hull = exact_hull(points)
    coordinates = read_points(points)
    start = np.array(_simplex(coordinates, independent(coordinates)))
    proposals = [propose(points)]
    ways = [kernels.grow]
    with contextlib.suppress(NotInstalled):
        ways.append(load())
    for grow in ways:
        if (places := in_doubles(coordinates)) is None:
            continue
        known, room = kernels.surface(places, False), kernels.room(len(places))
        corners = known.corners[: grow(known, room, start)]
        near = np.flatnonzero(room.near >= 0)
        proposals.append(Proposal(corners[corners[:, 0] >= 0], near, near))
    assert len(proposals) == 1 + len(ways) * (name not in ("big",))
    for way in proposals:
        assert set(map(tuple, planes_of(way.triangles, coordinates).tolist())) == {facet.plane for facet in hull.facets}
        named = {*way.triangles.ravel().tolist(), *way.near.tolist()}
        assert named >= {*hull.vertices, *hull.boundary}


NUMBERS = st.builds(math.ldexp, st.integers(-(2**53), 2**53).map(float), st.integers(-120, -53))


@given(st.lists(st.tuples(NUMBERS, NUMBERS, NUMBERS), min_size=4, max_size=4), st.integers(0, 3))
@LAW
def test_expansions_have_the_exact_sign(rows: list[tuple[float, ...]], flat: int) -> None:
    """The fourth point may lie near the plane of the others, so that the determinant cancels almost completely."""
    if flat:
        rows[3] = tuple(a + (b - a) * 0.25 * flat + (c - a) * 0.5 for a, b, c in zip(*rows[:3], strict=True))
    a, b, c, d = ([Fraction(number) for number in row] for row in rows)
    u, v, w = ([x - y for x, y in zip(row, a, strict=True)] for row in (b, c, d))
    true = sum(w[i] * (u[i - 2] * v[i - 1] - u[i - 1] * v[i - 2]) for i in range(3))
    computed = kernels.orientation(np.empty(192), np.array(rows), np.array([[0, 1, 2]]), 0, 3)
    assert np.sign(computed) == (true > 0) - (true < 0)


@given(st.lists(st.tuples(NUMBERS, NUMBERS, NUMBERS), min_size=5, max_size=9, unique=True))
@LAW
def test_values_in_the_kernel_have_the_exact_sign(rows: list[tuple[float, ...]]) -> None:
    """Half of the triangles are perpendicular to an axis."""
    for points in (rows, [*((0.25, y, z) for _, y, z in rows[:3]), *rows[3:]]):
        known = kernels.surface(np.array(points), False)
        kernels.place_triangle(known, 0, 0, 1, 2)
        a, *others = ([Fraction(number) for number in row] for row in points)
        u, v, *rest = ([x - y for x, y in zip(row, a, strict=True)] for row in others)
        for p, w in enumerate(rest, 3):
            true = sum(w[i] * (u[i - 2] * v[i - 1] - u[i - 1] * v[i - 2]) for i in range(3))
            assert np.sign(kernels.value(known, 0, p)) == (true > 0) - (true < 0)


@pytest.mark.parametrize("name", ["big", "huge", "mixed"])
def test_points_that_doubles_do_not_hold_are_left_to_numpy(name: str) -> None:
    huge = [tuple(number << 70 for number in point) for point in ball(30, 3)] + [(1, 2, 3)]
    mixed = [(x * 2.0**-900, y * 2.0**900, z * 2.0**900 + x * 2.0**-900) for x, y, z in CUBE]
    points = {"big": BIG[:27], "huge": huge, "mixed": mixed}[name]
    assert in_doubles(read_points(points)) is None
    assert propose(points, fast=False).triangles.tolist() == propose(points).triangles.tolist()


def test_a_missing_kernel_raises_an_error(monkeypatch) -> None:
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


@pytest.mark.usefixtures("_proposed")
def test_images_that_are_coplanar_are_told_apart() -> None:
    """The images of the points are coplanar, so the first four points are those that span space."""
    points = [(x << 60, y << 60, (x + y << 60) + x * y % 3) for x in range(20) for y in range(20)]
    assert exact_hull(points).dimension == 3


def dropped(count: int):
    """Return a proposal without ``count`` of the points."""

    def wrong(points, basis, fast) -> Proposal:
        proposal = propose(Coordinates(points.numbers[count:]), fast)
        return Proposal(proposal.triangles + count, proposal.near + count, proposal.at)

    return wrong


def turned(points, basis, fast) -> Proposal:
    made = propose(points, fast)
    return replace(made, triangles=made.triangles[:, ::-1])


def torn(points, basis, fast) -> Proposal:
    made = propose(points, fast)
    return replace(made, triangles=made.triangles[1:], at=made.at * 0)


def pinched(points, basis, fast) -> Proposal:
    made = propose(points, fast)
    return replace(made, triangles=np.concatenate([made.triangles, made.triangles[:1, [0, 0, 1]]]))


def unaware(points, basis, fast) -> Proposal:
    """The proposal names no points that may lie on the surface."""
    made = propose(points, fast)
    return replace(made, near=made.near[:0], at=made.at[:0])


@pytest.mark.parametrize(
    "wrong", [dropped(1), dropped(9), turned, torn, pinched, unaware, lambda points, basis, fast: None]
)
@pytest.mark.parametrize("name", ["cube", "ball", "sphere", "octahedral ball"])
def test_after_a_wrong_proposal_the_hull_is_constructed(wrong, name: str, monkeypatch) -> None:
    points = SETS[name]
    expected = built(points, monkeypatch)
    monkeypatch.setattr(build_module, "MANY", 4)
    monkeypatch.setattr(build_module, "propose", wrong)
    assert exact_hull(points) == expected


def test_a_hull_constructed_after_a_refusal_is_proved_too(monkeypatch) -> None:
    points = SETS["sphere"]
    monkeypatch.setattr(build_module, "propose", dropped(2))
    monkeypatch.setattr(build_module, "insertion_order", lambda count, simplex: [])
    with pytest.raises(CertificateError, match="is outside of facet"):
        exact_hull(points)


def test_vectorised_planes_equal_those_of_single_triangles() -> None:
    """The coordinates are below and above 2**30, and some faces have several triangles."""
    for points in (CUBE, BIG[:27], ball(40, 8), [tuple(10**9 * n for n in p) for p in CUBE]):
        triangles = propose(points).triangles
        planes = planes_of(triangles, read_points(points))
        for plane, (a, b, c) in zip(planes.tolist(), triangles.tolist(), strict=True):
            p, q, r = points[a], points[b], points[c]
            assert all(plane[0] * x + plane[1] * y + plane[2] * z + plane[3] == 0 for x, y, z in (p, q, r))
            assert math.gcd(*plane) == 1
            x, y, z = (sum(axis) for axis in zip(*points, strict=True))
            assert plane[0] * x + plane[1] * y + plane[2] * z + plane[3] * len(points) < 0
        facets, face = merged(triangles, planes, read_points(points))
        assert facets == exact_hull(points).facets
        assert [facets[number].plane for number in face] == list(map(tuple, planes.tolist()))

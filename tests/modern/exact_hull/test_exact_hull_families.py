"""Families of points that are difficult in floating point, mostly those of Qhull's rbox, with known hulls."""

import itertools
import math
import random
from fractions import Fraction

import pytest

from modern.exact_hull import ExactHull, exact_hull

SKEW = ((123456789012345, -3, 98765432109), (7, 10**15 + 37, -11), (10**14 + 3, 5, 10**15 - 9))
(_A, _B, _C), (_D, _E, _F), (_G, _H, _I) = SKEW
assert _A * (_E * _I - _F * _H) - _B * (_D * _I - _F * _G) + _C * (_D * _H - _E * _G) > 0


def skewed(points):
    """Map points, without reflection, to coordinates whose products exceed float64 and int64."""
    return [tuple(sum(a * b for a, b in zip(row, point, strict=True)) for row in SKEW) for point in points]


def counts(hull: ExactHull) -> tuple[int, ...]:
    return hull.dimension, len(hull.vertices), len(hull.edges()), len(hull.facets), len(hull.boundary), len(hull.inside)


def both(points) -> ExactHull:
    """Return the hull, after checking that the mapped points have the same faces and classes."""
    hull, other = exact_hull(points), exact_hull(skewed(points))
    assert {facet.polygon for facet in hull.facets} == {facet.polygon for facet in other.facets}
    assert (hull.vertices, hull.boundary, hull.inside) == (other.vertices, other.boundary, other.inside)
    return hull


@pytest.mark.parametrize("n", [2, 3, 4, 7])
def test_a_cubic_grid_has_six_faces(n: int) -> None:
    hull = both(list(itertools.product(range(n), repeat=3)))
    inside = (n - 2) ** 3
    assert counts(hull) == (3, 8, 12, 6, n**3 - 8 - inside, inside)


@pytest.mark.parametrize("seed", range(3))
def test_points_on_the_faces_of_a_cube_are_boundary_points(seed: int) -> None:
    """As rbox W0: 300 points on the surface of a cube with 8-digit coordinates."""
    rng, side = random.Random(seed), 10**8
    points = list(itertools.product((0, side), repeat=3))
    for _ in range(300):
        point = [rng.randrange(1, side) for _ in range(3)]
        point[rng.randrange(3)] = rng.choice((0, side))
        points.append(tuple(point))
    rng.shuffle(points)
    assert counts(both(points)) == (3, 8, 12, 6, 300, 0)


@pytest.mark.parametrize("square", [14, 41, 89, 314, 1001])
def test_all_grid_points_on_a_sphere_are_vertices(square: int) -> None:
    """As rbox s, but exact: every point of a sphere is a vertex, and the centre is not."""
    radius = math.isqrt(square)
    points = [p for p in itertools.product(range(-radius, radius + 1), repeat=3) if sum(n * n for n in p) == square]
    hull = both([*points, (0, 0, 0)])
    assert len(points) >= 24
    assert hull.vertices == tuple(range(len(points)))
    assert hull.inside == (len(points),)
    assert any(len(facet.polygon) > 3 for facet in hull.facets)


def test_all_rational_points_on_the_unit_sphere_are_vertices() -> None:
    """The points are stereographic images of fractions, whose common scale has more than 100 digits."""
    rng = random.Random(8)
    points = []
    for _ in range(60):
        u, v = (Fraction(rng.randint(-300, 300), rng.randint(1, 200)) for _ in range(2))
        w = 1 + u * u + v * v
        points.append((2 * u / w, 2 * v / w, (w - 2) / w))
    points += [(-x, -y, z) for x, y, z in points]
    hull = exact_hull(points)
    assert len(hull.vertices) == len(set(points))
    assert hull.scale > 10**100
    assert hull.boundary == hull.inside == ()


def rational_circle(count: int) -> list[tuple[int, int, int]]:
    """Return Pythagorean triples (x, y, r), so that (x/r, y/r) is on the unit circle."""
    return [(a * a - b * b, 2 * a * b, a * a + b * b) for a, b in ((k + 2, k + 1) for k in range(count))]


@pytest.mark.parametrize("n", [3, 4, 5, 40])
def test_a_prism_and_a_pyramid_have_the_known_faces(n: int) -> None:
    circle = [(Fraction(x, r), Fraction(y, r)) for x, y, r in rational_circle(n)]
    prism = exact_hull([(x, y, z) for x, y in circle for z in (0, 1)])
    assert counts(prism) == (3, 2 * n, 3 * n, n + 2, 0, 0)
    assert sorted(len(facet.polygon) for facet in prism.facets) == sorted([4] * n + [n] * 2)
    pyramid = exact_hull([(x, y, 0) for x, y in circle] + [(0, 0, 1), (0, 0, 1)])
    assert counts(pyramid) == (3, n + 1, 2 * n, n + 1, 0, 0)
    assert exact_hull([(x, y, 7) for x, y in circle]).dimension == 2


@pytest.mark.parametrize("power", [1, 12, 27])
def test_pairs_of_close_points_are_told_apart(power: int) -> None:
    """Every corner of a cube of side 10**power has a copy one unit further in along an edge."""
    side = 10**power
    corners = list(itertools.product((-side, side), repeat=3))
    inner = [(x - (1 if x > 0 else -1), y, z) for x, y, z in corners]
    hull = both([*corners, *inner])
    assert counts(hull) == (3, 8, 12, 6, 8, 0)
    outer = [(x + (1 if x > 0 else -1), y, z) for x, y, z in corners]
    cut = [(x, y - (1 if y > 0 else -1), z - (1 if z > 0 else -1)) for x, y, z in outer]
    hull = both([*corners, *cut])
    assert len(hull.vertices) == 16
    assert hull.inside == hull.boundary == ()


@pytest.mark.parametrize("height", [1, 5, 10**4])
def test_all_points_of_a_narrow_lens_are_classified(height: int) -> None:
    """As rbox L: two shallow caps over a disc of radius 10**8, with many coplanar points if it is thin."""
    rng = random.Random(height)
    points = []
    for _ in range(400):
        angle, radius = rng.random() * 2 * math.pi, math.sqrt(rng.random())
        cap = rng.choice((-1, 1)) * round(height * (1 - radius * radius))
        points.append((round(10**8 * radius * math.cos(angle)), round(10**8 * radius * math.sin(angle)), cap))
    hull = both(points)
    assert hull.dimension == 3
    if height == 1:
        levels = {points[index][2] for index in hull.vertices}
        assert levels == {-1, 0, 1}
        assert max(len(facet.polygon) for facet in hull.facets) > 10


@pytest.mark.parametrize("m", [2, 3, 10])
def test_a_grid_on_a_paraboloid_has_one_face_for_each_cell(m: int) -> None:
    """Every point is a vertex; there is one face for each cell of the grid, four walls and a lid."""
    points = [(i, j, i * i + j * j - (m - 1) * (i + j)) for i in range(m) for j in range(m)]
    hull = both(points)
    cells = (m - 1) ** 2
    if m == 2:
        assert counts(hull) == (2, 4, 4, 4, 0, 0)
    else:
        assert counts(hull) == (3, m * m, m * m + cells + 5 - 2, cells + 5, 0, 0)


def test_points_on_the_moment_curve_form_a_cyclic_polytope() -> None:
    """It has 2n - 4 triangles, no four coplanar points, and coordinates of very different sizes."""
    n = 80
    hull = both([(t, t * t, t**3) for t in range(-n // 2, n // 2)])
    assert counts(hull) == (3, n, 3 * n - 6, 2 * n - 4, 0, 0)


def test_one_unit_decides_whether_a_square_is_flat() -> None:
    """The fourth corner of a 30-digit square is one unit above, on and below the plane of the others."""
    a, b, c = (10**29 + 7, 1, 3), (5, 10**29 + 3, 10), (1, 10**28, 10**29 + 9)
    fourth = tuple(q + r - p for p, q, r in zip(a, b, c, strict=True))
    assert exact_hull([a, b, c, fourth]).dimension == 2
    for step in (-1, 1):
        moved = (*fourth[:2], fourth[2] + step)
        assert counts(exact_hull([a, b, c, moved])) == (3, 4, 6, 4, 0, 0)


def test_collinear_and_coplanar_points_with_many_digits_are_recognised() -> None:
    line = skewed([(k, 2 * k, -3 * k) for k in (3, -1, 4, 1, 5, 9, -2, 6)])
    hull = exact_hull(line)
    assert (counts(hull), hull.vertices) == ((1, 2, 1, 2, 0, 6), (5, 6))
    plane = skewed([(i, j, i + 2 * j) for i in range(5) for j in range(4)])
    hull = exact_hull(plane)
    assert counts(hull) == (2, 4, 4, 4, 10, 6)
    a, b, c, d = hull.plane_of(hull.plane)
    assert all(a * x + b * y + c * z + d == 0 for x, y, z in plane)


def test_ten_thousand_points_are_proved() -> None:
    rng = random.Random(10)
    points = [tuple(rng.randrange(10**8) for _ in range(3)) for _ in range(10**4)]
    hull = exact_hull(points)
    assert hull.dimension == 3
    assert 60 < len(hull.vertices) < 300
    assert len(hull.vertices) + len(hull.boundary) + len(hull.inside) + len(hull.duplicates) == 10**4

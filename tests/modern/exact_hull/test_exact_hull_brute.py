"""Compare the exact hull with one that tries every triple of points, on highly degenerate sets of a small grid."""

import itertools
import math
import random

import pytest

from modern.exact_hull import ExactHull, exact_hull
from tests.support.visibility import cross, dot, minus

Point = tuple[int, int, int]
Plane = tuple[int, ...]
Summary = tuple[int, set[int], set[int], set[int], dict[Plane, tuple[int, ...]]]


def reduced(normal, point) -> Plane:
    plane = (*normal, -dot(normal, point))
    return tuple(number // math.gcd(*plane) for number in plane)


def from_smallest(cycle):
    start = cycle.index(min(cycle))
    return tuple(cycle[start:] + cycle[:start])


def outline(members: list[int], points: list[Point], normal) -> list[int]:
    """The corners of coplanar points: a is followed by b if all others are left of a-b or between a and b."""
    following = {}
    for a, b in itertools.permutations(members, 2):
        along = minus(points[b], points[a])
        # The points to the left of a-b have a positive product with this vector.
        leftward = cross(normal, along)
        for c in members:
            offset = minus(points[c], points[a])
            side = dot(leftward, offset)
            if side < 0 or (side == 0 and not 0 <= dot(offset, along) <= dot(along, along)):
                break
        else:
            assert a not in following
            following[a] = b
    cycle = [min(following)]
    while following[cycle[-1]] != cycle[0]:
        cycle.append(following[cycle[-1]])
    assert len(cycle) == len(following)
    return cycle


def brute(points: list[Point]) -> Summary:
    """Return dimension, vertices, boundary, inside and facets of distinct points, by trying all triples."""
    everyone = set(range(len(points)))
    if len(points) == 1:
        return 0, {0}, set(), set(), {}
    triples = [
        (a, normal)
        for a, b, c in itertools.combinations(sorted(everyone), 3)
        if any(normal := cross(minus(points[b], points[a]), minus(points[c], points[a])))
    ]
    if not triples:
        low, high = min(
            itertools.permutations(everyone, 2),
            key=lambda pair: (-dot(d := minus(points[pair[0]], points[pair[1]]), d), points[pair[0]]),
        )
        along = minus(points[high], points[low])
        facets = {reduced(along, points[high]): (high,), reduced(minus((0, 0, 0), along), points[low]): (low,)}
        return 1, {low, high}, set(), everyone - {low, high}, facets
    start, normal = triples[0]
    if all(dot(normal, minus(point, points[start])) == 0 for point in points):
        plane = reduced(normal, points[start])
        normal = max(plane[:3], tuple(-number for number in plane[:3]))
        cycle = outline(sorted(everyone), points, normal)
        facets, edge_points = {}, set()
        for a, b in zip(cycle, cycle[1:] + cycle[:1], strict=True):
            outward = cross(minus(points[b], points[a]), normal)
            facets[reduced(outward, points[a])] = (min(a, b), max(a, b))
            edge_points |= {p for p in everyone if dot(outward, minus(points[p], points[a])) == 0}
        return 2, set(cycle), edge_points - set(cycle), everyone - edge_points, facets
    facets, outer = {}, set()
    for start, normal in triples:
        level = dot(normal, points[start])
        heights = [dot(normal, point) - level for point in points]
        if max(heights) > 0 > min(heights):
            continue
        if max(heights) > 0:
            normal, heights = tuple(-number for number in normal), [-height for height in heights]
        plane = reduced(normal, points[start])
        if plane in facets:
            continue
        members = [p for p in everyone if heights[p] == 0]
        facets[plane] = from_smallest(outline(members, points, normal))
        outer.update(members)
    vertices = {p for polygon in facets.values() for p in polygon}
    return 3, vertices, outer - vertices, everyone - outer, facets


def summary(hull: ExactHull) -> Summary:
    facets = {facet.plane: facet.polygon for facet in hull.facets}
    assert len(facets) == len(hull.facets)
    return hull.dimension, set(hull.vertices), set(hull.boundary), set(hull.inside), facets


def compare(points: list[Point], rng: random.Random, orders: int = 1) -> int:
    """Compare both hulls of shuffled points, and return how many signs needed integers."""
    in_integers = 0
    for _ in range(orders):
        rng.shuffle(points)
        hull = exact_hull(points)
        assert summary(hull) == brute(points), points
        assert hull.duplicates == ()
        in_integers += hull.certificate.in_integers
    return in_integers


def grid(*sizes: int) -> list[Point]:
    return [(x, y, z) for x in range(sizes[0]) for y in range(sizes[1]) for z in range(sizes[2])]


def symmetries(points: list[Point]) -> list[list[int]]:
    """Return the symmetries of a grid as permutations of the indices of its points."""
    indices = {point: index for index, point in enumerate(points)}
    top = tuple(map(max, zip(*points, strict=True)))
    permutations = []
    for axes in itertools.permutations(range(3)):
        for flips in itertools.product((False, True), repeat=3):
            images = [tuple(top[k] - p[axes[k]] if flips[k] else p[axes[k]] for k in range(3)) for p in points]
            if all(image in indices for image in images):
                permutations.append([indices[image] for image in images])
    return permutations


def classes(points: list[Point], sizes: range):
    """Yield one set of every class of subsets under the symmetries of the grid."""
    maps = symmetries(points)
    for size in sizes:
        for chosen in itertools.combinations(range(len(points)), size):
            if all(tuple(sorted([image[index] for index in chosen])) >= chosen for image in maps):
                yield [points[index] for index in chosen]


def test_trying_all_triples_finds_the_faces_of_a_cube() -> None:
    points = grid(3, 3, 3)
    dimension, vertices, boundary, inside, facets = brute(points)
    assert (dimension, len(vertices), len(boundary), inside, len(facets)) == (3, 8, 18, {13}, 6)
    assert facets[(0, 0, 1, -2)] == (2, 20, 26, 8)
    assert facets[(0, 0, -1, 0)] == (0, 6, 24, 18)


@pytest.mark.parametrize("size", [1, 2, 3, 4])
def test_every_small_set_of_the_3_3_3_grid_has_the_hull_of_all_triples(size: int) -> None:
    rng = random.Random(size)
    for points in classes(grid(3, 3, 3), range(size, size + 1)):
        compare(points, rng)


def test_small_sets_in_space_a_plane_and_a_line_have_the_hull_of_all_triples() -> None:
    rng = random.Random(223)
    for points in classes(grid(2, 2, 3), range(1, 13)):
        compare(points, rng)
    square = [(x + 2 * y, 3 * x - y, y - 2 * x) for x in range(3) for y in range(3)]
    rng = random.Random(33)
    for bits in range(1, 512):
        compare([point for index, point in enumerate(square) if bits >> index & 1], rng)
    line = [(2 * k - 3, 5 - k, 3 * k) for k in range(6)]
    rng = random.Random(6)
    for bits in range(1, 64):
        compare([point for index, point in enumerate(line) if bits >> index & 1], rng, 2)


def test_random_sets_of_grids_have_the_hull_of_all_triples() -> None:
    rng = random.Random(0)
    points = grid(3, 3, 3)
    for _ in range(400):
        compare(rng.sample(points, rng.randint(5, 14)), rng)
    for _ in range(10):
        compare(rng.sample(points, rng.randint(15, 27)), rng)
    rng = random.Random(5)
    for _ in range(200):
        side = rng.choice((4, 5, 9))
        compare(list({tuple(rng.randrange(side) for _ in range(3)) for _ in range(rng.randint(4, 14))}), rng)


@pytest.mark.parametrize("digits", [8, 15, 30])
def test_grids_under_a_skew_map_need_integers(digits: int) -> None:
    """Faces have many points in planes that float64 cannot represent, so every sign near 0 needs integers."""
    rng = random.Random(digits)
    in_integers = 0
    for _ in range(60):
        rows = [[rng.randrange(-(10**digits), 10**digits) for _ in range(3)] for _ in range(3)]
        points = [tuple(dot(row, p) for row in rows) for p in rng.sample(grid(3, 3, 3), rng.randint(5, 14))]
        if len(set(points)) == len(points):
            in_integers += compare(points, rng)
    assert in_integers > 1000


@pytest.mark.parametrize("power", [2, 8, 20])
def test_close_pairs_and_flat_lenses_have_the_hull_of_all_triples(power: int) -> None:
    """Pairs of points one unit apart, and points one unit above a wide plane."""
    rng = random.Random(power)
    for _ in range(20):
        ends = [tuple(rng.randrange(10**power) for _ in range(3)) for _ in range(6)]
        compare(list({tuple(n + rng.randrange(2) for n in p) for p in ends * 2}), rng)
        lens = {(rng.randrange(-3, 4) * 10**power, rng.randrange(10**power), rng.randrange(-1, 2)) for _ in range(12)}
        compare([(x + 3 * z, y - x, z + 2 * x + 5 * y) for x, y, z in lens], rng)


def test_duplicates_change_nothing_but_the_list_of_duplicates() -> None:
    rng = random.Random(7)
    for _ in range(100):
        points = [tuple(rng.randrange(3) for _ in range(3)) for _ in range(rng.randint(2, 16))]
        hull = exact_hull(points)
        first = list(dict.fromkeys(points))
        names = [points.index(point) for point in first]
        dimension, vertices, boundary, inside, facets = brute(first)
        assert hull.dimension == dimension
        assert hull.vertices == tuple(sorted(names[v] for v in vertices))
        assert hull.boundary == tuple(sorted(names[v] for v in boundary))
        assert hull.inside == tuple(sorted(names[v] for v in inside))
        assert {facet.plane: facet.polygon for facet in hull.facets} == {
            plane: tuple(names[v] for v in polygon) for plane, polygon in facets.items()
        }
        assert hull.duplicates == tuple(
            (index, points.index(point)) for index, point in enumerate(points) if points.index(point) < index
        )

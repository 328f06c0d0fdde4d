"""Checks of Kovalevsky and Schulz on voxels: local corners and corners of voxels.

A *local corner* is a voxel (or a corner of voxels) that is not halfway between two of its neighbours in the same set.
"""

from collections.abc import Iterable
from itertools import combinations, product
from random import Random

import numpy as np

from modern.claims.evidence import Check, Generator, claim, exhausted, exhibited, refuted, search
from modern.claims.hulls import convex_polyhedron, exact_hull
from modern.claims.invariants import numbers_of_ball
from modern.claims.sampled_sets import Point, counterexample_points, plane_value
from modern.digital.solids import VERTEX, VOXEL, Volume, ball, listed
from modern.geometry.vectors import dot, minus, plus
from modern.papers.kovalevsky_schulz import CENTRES, INVISIBLE, VERTICES, VISIBLE, local_corners
from modern.papers.kovalevsky_schulz.corners import Of
from modern.papers.kovalevsky_schulz.polyhedron import Coplanar
from modern.papers.kovalevsky_schulz.results import hull_of_ball

Voxels = tuple[Point, ...]
KINDS: tuple[Of, ...] = (CENTRES, VERTICES)
STEPS: Voxels = tuple((x, y, z) for x, y, z in product((0, 1), repeat=3))
DIRECTIONS: Voxels = tuple((x, y, z) for x, y, z in product((-1, 0, 1), repeat=3) if (x, y, z) != (0, 0, 0))


def _draw_solid(random: Random) -> Voxels:
    return tuple((x, y, z) for x, y, z in product(range(4), repeat=3) if random.random() < 0.4)


SOLIDS: Generator[Voxels] = Generator("sets of about 26 voxels of a block of 64", 1, _draw_solid, lambda s: len(s) > 3)


def local(solid: Voxels, of: Of = CENTRES, neighbours: int = 26) -> set[Point]:
    return {(x, y, z) for x, y, z in local_corners(listed(solid), of, neighbours).tolist()}


@claim("kovalevsky-schulz.11", full=2_000)
def hull_of_few_voxels(cases: int = 3) -> Check:
    def among(solid: Voxels) -> bool:
        sets = ((points_of(solid, of), of) for of in KINDS)
        return all({points[k] for k in exact_hull(points).vertices} <= local(solid, of) for points, of in sets)

    check = search(SOLIDS, among, cases, "the vertices of the hull of each solid are local corners")
    zigzag: Voxels = tuple((x, x % 2, x // 2 % 2) for x in range(20))
    refutes = exact_hull(zigzag).dimension == 3 and local(zigzag) == {*zigzag}
    return check.unless(refutes, "20 voxels of a zigzag in space, all local corners")


@claim("kovalevsky-schulz.23")
def local_corner_inside_hull() -> Check:
    *around, middle = points = tuple(counterexample_points("tetrapod.csv"))
    near = all(max(abs(a - b) for a, b in zip(p, middle, strict=True)) == 1 for p in around)
    wrong = middle in local(points) and near and len(around) not in exact_hull(points).vertices
    return refuted(wrong, f"{middle} passes the test of 13 pairs and is a combination of its {len(around)} neighbours")


@claim("kovalevsky-schulz.18", full=4_000)
def fewer_corners_with_more_neighbours(cases: int = 5) -> Check:
    message = "local corners found with 26 neighbours are found with 6 too, among voxels and among corners of voxels"
    return search(SOLIDS, lambda solid: all(local(solid, of) <= local(solid, of, 6) for of in KINDS), cases, message)


@claim("kovalevsky-schulz.34", full=4_000)
def local_corners_of_vertices(cases: int = 5) -> Check:
    def agrees(solid: Voxels) -> bool:
        points = _corners(solid)
        between = {p for p in points if any({plus(p, d), minus(p, d)} <= points for d in DIRECTIONS)}
        return local(solid, VERTICES) == local(tuple(points)) == points - between

    return search(SOLIDS, agrees, cases, "the procedure for voxels drops the corners between two opposite neighbours")


def _corners(solid: Voxels) -> set[Point]:
    return {plus(voxel, step) for voxel in solid for step in STEPS}


def points_of(solid: Voxels, of: Of) -> Voxels:
    return solid if of == CENTRES else tuple(_corners(solid))


def _triangles(corners: Iterable[Iterable[int]], coplanar: Coplanar = INVISIBLE) -> int:
    """Return the number of triangles of the hull that results from adding the corners in the given order."""
    return len(convex_polyhedron(corners, coplanar).faces)  # type: ignore[union-attr]


def _ball_without_sphere() -> Volume:
    return listed([voxel for voxel in ball(32).coordinates().tolist() if dot(voxel, voxel) < 16**2])


@claim("kovalevsky-schulz.20")
def voxels_of_ball() -> Check:
    printed, numbers = numbers_of_ball()[0], [ball(32, centre).count for centre in (VOXEL, VERTEX)]
    inner = _ball_without_sphere().count
    check = exhibited(numbers[0] == printed, f"the ball centred on a voxel has {numbers[0]} voxels")
    case = f"a ball centred on a corner, of {numbers[1]} voxels, and one without those on its sphere, of {inner} voxels"
    return check.unless(printed not in (numbers[1], inner), case)


@claim("kovalevsky-schulz.21")
def numbers_of_local_corners() -> Check:
    corners, voxels = ([len(local_corners(ball(32), of, n)) for n in (6, 26)] for of in (VERTICES, CENTRES))
    # (x - 1/40)^2 + (y - 1/40)^2 + z^2 <= 16^2 means for integers: 20 (x^2 + y^2 + z^2 - 16^2) < x + y.
    beside = listed([v for v in ball(33).coordinates().tolist() if 20 * (dot(v, v) - 16**2) < v[0] + v[1]])
    balls = ball(32, VERTEX), _ball_without_sphere(), beside
    moved, inner, near = ([len(local_corners(other, VERTICES, n)) for n in (6, 26)] for other in balls)
    printed, message = numbers_of_ball()[1:3], f"{corners[0]} and {corners[1]} corners of the voxels are local corners"
    case = f"the voxels, of which {voxels[0]} and {voxels[1]} are local corners, a ball centred on a corner of "
    case += f"voxels, with {moved[0]} and {moved[1]}, one centred at (1/40, 1/40, 0), of {beside.count} voxels, with "
    case += f"{near[0]} and {near[1]}, and one without the six voxels, with {inner[0]} and {inner[1]}"
    return exhibited(corners == printed, message).unless(printed not in (voxels, moved, near, inner), case)


def _most_triangles() -> int:
    """Return a bound for the triangles of the ball's hull in any order of the points, if coplanar faces are visible."""
    # Each point in the plane of a face that counts as visible replaces the triangles of this plane. So at most one
    # point remains inside the face: the one that was inserted last. The corners by 26 neighbours form fewer triangles.
    most = list[int]()
    for corners in (local_corners(ball(32), of, 6) for of in KINDS):
        planes = np.array([face.plane for face in exact_hull(corners.tolist()).facets])
        # A table with a row for each corner and a column for each face.
        on_face = corners @ planes[:, :3].T == -planes[:, 3]
        replaced = np.maximum(on_face[on_face.sum(axis=1) == 1].sum(axis=0) - 1, 0).sum()
        most.append(2 * int(on_face.any(axis=1).sum() - replaced) - 4)
    return max(most)


@claim("kovalevsky-schulz.64")
def printed_faces() -> Check:
    hull = hull_of_ball(32, INVISIBLE).polyhedron
    numbers = [len(hull.triangles.faces), len(hull.faces.faces)]
    balls = (ball(32), 6), (ball(32), 26), (ball(32, VERTEX), 6), (_ball_without_sphere(), 6)
    corners, fewer, moved, inner = (local_corners(solid, VERTICES, n).tolist() for solid, n in balls)
    most = _most_triangles()
    others = {
        f"coplanar faces that count as visible (at most {most} triangles in any order)": _triangles(corners, VISIBLE),
        "a random order of the corners": _triangles(Random(1).sample(corners, len(corners))),
        f"the {len(fewer)} corners found with 26 neighbours": _triangles(fewer),
        "a ball centred on a corner of voxels": _triangles(moved),
        "a ball without the voxels on its sphere": _triangles(inner),
        "the voxels' centres": _triangles(local_corners(ball(32), CENTRES, 6).tolist()),
    }
    case = "; ".join(f"{change}: {number} triangles" for change, number in others.items())
    check = exhibited(numbers == numbers_of_ball()[3:], f"{numbers[0]} triangles and {numbers[1]} faces")
    return check.unless(most < numbers[0] not in others.values(), case)


@claim("kovalevsky-schulz.12", full=1_000)
def corners_against_centres(cases: int = 2) -> Check:
    def agrees(solid: Voxels) -> bool:
        outer = exact_hull(sorted(_corners(solid)))
        grown = exact_hull(sorted(_corners(tuple(solid[k] for k in exact_hull(solid).vertices))))
        centres = [(2 * x + 1, 2 * y + 1, 2 * z + 1) for x, y, z in solid]
        within = all(plane_value((*f.plane[:3], 2 * f.plane[3]), c) < 0 for f in outer.facets for c in centres)
        return within and {f.plane for f in outer.facets} == {f.plane for f in grown.facets}

    message = "the corners' hull contains the centres and is that of unit cubes around vertices of the centres' hull"
    return search(SOLIDS, agrees, cases, message)


@claim("kovalevsky-schulz.28")
def corner_of_single_voxel() -> Check:
    objects = tuple(counterexample_points("two_voxels.csv")), ((0, 0, 0), (0, 0, 1), (0, 0, 2), (0, 1, 0), (0, 1, 2))
    single = [{c for c in _corners(v) if sum(c in _corners((w,)) for w in v) == 1} for v in objects]
    corners = [local(v, VERTICES, 6) for v in objects]
    wrong, others = (sorted(s - c) for s, c in zip(single, corners, strict=True))
    message = f"of {len(single[0])} corners of only one voxel, these are no local corners: {', '.join(map(str, wrong))}"
    message += f"; of {len(single[1])} such corners of an object in one piece, {len(others)} are no local corners"
    return refuted(wrong and others and corners[0] <= single[0], message)


@claim("kovalevsky-schulz.155", "kovalevsky-schulz.154")
def corners_of_eight_voxels() -> Check:
    subsets = [(STEPS[0], *rest) for n in range(8) for rest in combinations(STEPS[1:], n)]
    # The edges of the first voxel at (1, 1, 1) continue to these corners if they belong to another voxel.
    beyond = {(2, 1, 1), (1, 2, 1), (1, 1, 2)}
    outcomes = [
        ((1, 1, 1) in local(voxels, VERTICES, 6)) == (len(voxels) == 1) == beyond.isdisjoint(_corners(voxels))
        for voxels in subsets
    ]
    message = "if there are no other voxels, a corner is between two neighbours exactly if several voxels meet there; "
    domain = "sets of the eight voxels at a corner that contain the first of them, or mirror images of these sets"
    return exhausted(domain, outcomes, f"{message}an edge then continues past it")


@claim("kovalevsky-schulz.79")
def marching_cubes() -> Check:
    # The vertices of Marching Cubes around two voxels with a gap between them. All coordinates are doubled.
    surface = [plus(voxel, d) for voxel in ((0, 0, 0), (4, 0, 0)) for d in DIRECTIONS if dot(d, d) == 1]
    inner = [p for p in surface if max(plane_value(f.plane, p) for f in exact_hull(surface).facets) < 0]
    message = f"{len(inner)} of the {len(surface)} vertices that Marching Cubes makes around two separate voxels are "
    return exhibited(inner, f"{message}inside the hull of these vertices")

"""Checks of Yau and Srihari: theorems 1 and 2, the printed algorithm, and envelopes (lower and upper hull surfaces)."""

from collections.abc import Iterable
from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import combinations, product
from math import ceil, comb, floor
from random import Random

import numpy as np
from numpy.typing import NDArray

from modern.claims.evidence import Check, Generator, claim, exhausted, refuted, search, searched, slip
from modern.claims.hulls import exact_hull, octree_hull
from modern.claims.sampled_sets import SETS, Point, counterexample_points, plane_through, plane_value, sampled_sets
from modern.digital.solids import listed
from modern.geometry.mesh import sides
from modern.geometry.vectors import dot
from modern.papers.yau_srihari import OctreeHull, Printed
from modern.papers.yau_srihari.convexity import convex_deficiency, half_cell_expansion, is_digitally_convex, is_simple
from modern.papers.yau_srihari.hull import components
from modern.papers.yau_srihari.octree import count, voxels_of
from modern.papers.yau_srihari.quadtree import Leaf, graph_side, no_columns, written
from modern.papers.yau_srihari.search import Search, normal_of

SOLID: tuple[Point, ...] = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (2, 1, 0), (2, 1, 1), (2, 2, 1), (2, 2, 2), (1, 2, 2))


def array_of(voxels: tuple[Point, ...] | list[Point]) -> NDArray[np.bool_]:
    return listed(voxels).array


def _draw_solid(random: Random) -> tuple[Point, ...]:
    """Return a random connected solid, grown from one voxel by adding neighbours of its voxels."""
    voxels: list[Point] = [(2, 2, 2)]
    axes = random.sample(range(3), random.choice((1, 2, 3, 3, 3)))
    for _ in range(random.randint(4, 40)):
        axis, step = random.choice(axes), random.choice((-1, 1))
        start = random.choice(voxels)
        new = tuple(min(5, max(0, c + step * (k == axis))) for k, c in enumerate(start))
        voxels += [new] if new not in voxels else []  # type: ignore[list-item]
    return tuple(voxels)


def _is_solid(voxels: tuple[Point, ...]) -> bool:
    return components(array_of(voxels)) == 1


SOLIDS: Generator[tuple[Point, ...]] = Generator(
    "connected solids of up to 41 voxels in a cube of 6, some of them flat", 421, _draw_solid, _is_solid
)


def hull_of(voxels: tuple[Point, ...]) -> OctreeHull:
    return octree_hull(array_of(voxels))


def _placed(voxels: tuple[Point, ...]) -> tuple[Point, ...]:
    """Return the coordinates of a solid's voxels as indices into its array."""
    low = [min(axis) for axis in zip(*voxels, strict=True)]
    return tuple((x - low[0], y - low[1], z - low[2]) for x, y, z in voxels)


@cache
def judge_agrees(voxels: tuple[Point, ...]) -> bool:
    """Return True if the envelopes have the exact hull's faces, and digital hulls of solid and projection are exact."""
    points, hull = _placed(voxels), hull_of(voxels)
    for envelope, sign in ((hull.lower, 1), (hull.upper, -1)):
        # Copies of all points beyond the other side leave the faces of this side as they are.
        judge = exact_hull([*points, *((x, y, z + 9 * sign) for x, y, z in points)])
        # If all columns are in one line, the copies lie in one plane, and the facets are edges.
        cycles = [f.polygon for f in judge.facets if sign * f.plane[2] < 0 and judge.dimension == 3]
        expected = {frozenset(points[k] for k in cycle) for cycle in cycles}
        # The program's fast construction, and the paper's steps with searches of the quadtree, must find these faces.
        for faces in (envelope.faces, [step.face for step in envelope.steps if step.face]):
            if {frozenset((x, y, sign * z) for x, y, z in face.vertices) for face in faces} != expected:
                return False
    return _fills(points) and _fills(tuple(dict.fromkeys((x, y, 0) for x, y, _ in points)))


def _fills(voxels: tuple[Point, ...]) -> bool:
    """Return True if the digital hull of a solid consists of the points of its array that are in its exact hull."""
    filled = hull_of(voxels).filled
    # A flat solid gets a second layer.
    steps = product(*((0, 1) if length == 1 else (0,) for length in filled.shape))
    thick = [(x + i, y + j, z + k) for (x, y, z), (i, j, k) in product(voxels, steps)]
    planes = [facet.plane for facet in exact_hull(thick).facets]
    return all(filled[at] == all(dot(p[:3], at) + p[3] <= 0 for p in planes) for at in np.ndindex(filled.shape))


@claim("yau-srihari.66", name="bound")
@claim("yau-srihari.83", name="start")
@claim("yau-srihari.86", name="truncation")
@claim("yau-srihari.87", name="marks")
def algorithm_as_printed(name: str) -> Check:
    """Check that a statement, as printed, gives a wrong hull for its counterexample, whose envelope has faces."""
    array = array_of(counterexample_points(f"yau_{name}.csv"))
    wrong, hull = octree_hull(array, Printed.only(name)).filled, octree_hull(array)
    missing, more = int((hull.filled & ~wrong).sum()), int((wrong & ~hull.filled).sum())
    message = f"as printed, the algorithm misses {missing} of the hull's {hull.voxels} voxels and adds {more}"
    return refuted(hull.lower.faces and (missing or more), message)


@claim("yau-srihari.48", "yau-srihari.53", "yau-srihari.54", "yau-srihari.59", "yau-srihari.103", full=500)
@claim("yau-srihari.2", "yau-srihari.4", "yau-srihari.49", full=500)
def envelopes_against_judge(cases: int = 3) -> Check:
    message = "the envelopes have the exact hull's faces, and the digital points between them are those of the hull"
    return search(SOLIDS, judge_agrees, cases, message)


@claim("yau-srihari.120", names="angle triangles", full=400)
def corrected_step(names: str, cases: int = 2) -> Check:
    as_printed = {name: algorithm_as_printed(name) for name in names.split()}
    case = "; ".join(f"yau_{name}.csv: {step.message}" for name, step in as_printed.items())
    return envelopes_against_judge(cases).unless(not any(step.holds for step in as_printed.values()), case)


@claim("yau-srihari.70", full=100)
def lower_bound_as_printed(cases: int = 2) -> Check:
    def is_lower_bound(voxels: tuple[Point, ...]) -> bool:
        outcomes, lower = [judge_agrees(voxels)], hull_of(voxels).lower
        surface = {at: Fraction(*face.height(*at)) for face in lower.faces for at in face.places()}
        for step, side, x, y in product(lower.steps, (1, 2, 4), range(6), range(6)):
            known = Search(*step.edge, step.normal, Printed.only("bound"))
            if step.face and (above := {*product(range(x, x + side), range(y, y + side))} & {*surface}):
                delta_1, _ = known.bounds(0, max(surface[at] for at in above), x, y, side)  # type: ignore[arg-type]
                outcomes.append(delta_1 is None or delta_1 <= (known.score(step.face.vertices[2]) or 0))
        return all(outcomes)

    message = "delta_1, at the largest height of the envelope over a square, is at most the angle of the next face"
    case = corrected_step("angle", 1).evidence.violation
    return search(SOLIDS, is_lower_bound, cases, message).unless(case, case)


@claim("yau-srihari.68", full=400)
def rule_2(cases: int = 2) -> Check:
    # A search at an edge of a face in the plane z = 10 x, over a square with the points (2, 0, 25) and (3, 0, 30).
    of_edge, as_printed = Search((0, 0, 0), (0, 1, 0), (10, 0, -1), Printed()), corrected_step("angle bound", cases)
    *corners, of_point = (of_edge.score(p) or 0 for p in ((2, 0, 25), (2, 1, 25), (3, 0, 25), (3, 1, 25), (3, 0, 30)))
    is_needed = max(corners) < of_point == of_edge.bounds(25, 30, 2, 0, 2)[1]
    case = f"{as_printed.evidence.violation}; and a square with a point whose angle is larger than those at its corners"
    return envelopes_against_judge(cases).unless(is_needed and as_printed.evidence.violation, case)


@claim("yau-srihari.36")
def disconnected_hull() -> Check:
    stairs = counterexample_points("yau_stairs.csv")
    planes = [facet.plane for facet in exact_hull(stairs).facets]
    inside = [p for p in product(range(5), repeat=3) if all(plane_value(plane, p) <= 0 for plane in planes)]  # type: ignore[arg-type]
    alone = [p for p in inside if not any(sum(abs(a - b) for a, b in zip(p, q, strict=True)) == 1 for q in inside)]
    message = f"the hull of {len(stairs)} connected voxels has {len(inside)} digital points; {alone[0]} is next to none"
    return refuted(octree_hull(array_of(stairs)).components == len(alone) == 1, message)


@claim("yau-srihari.5", full=500)
def solid_from_deficiency(cases: int = 3) -> Check:
    def is_described(voxels: tuple[Point, ...]) -> object:
        solid, hull = array_of(voxels), hull_of(voxels).filled
        return judge_agrees(voxels) and np.array_equal(hull & ~convex_deficiency(solid), solid)

    message = "the digital points in the exact hull of each solid, without the deficiency, are those of the solid"
    return search(SOLIDS, is_described, cases, message)


@claim("yau-srihari.30", "yau-srihari.33")
def convex_solid_fails_test() -> Check:
    """Check one simple solid that Kim and Rosenfeld's test of convexity rejects, but definition 3.2.3 calls convex.

    By this definition, the half-cell expansion is the image of a convex body.  The expansion has cells [a, a + 1] with
    integers a.  Let Q be the hull of cubes of side 1/4 around the solid's points.  Q meets each of these cells, because
    a corner of a cube is inside the cell.  Q meets another cell, open or closed, only if a is in the hull of the points
    of Q moved by -1 or 0 along each axis.
    """
    solid = counterexample_points("yau_near.csv")
    cells = {(x - 1, y - 1, z - 1) for x, y, z in np.argwhere(half_cell_expansion(array_of(solid))).tolist()}
    hull = exact_hull(tuple(moved(solid, (-9, 1), 8)))
    neighbours = moved(cells, (-1, 0, 1))
    met = {a for a in neighbours if all(8 * hull.scale * dot(f.plane[:3], a) + f.plane[3] <= 0 for f in hull.facets)}
    fails_test = is_simple(array_of(solid)) and not is_digitally_convex(array_of(solid))
    message = f"{len(solid)} voxels fail the test, but their half-cell expansion is the image of a convex solid"
    return refuted(fails_test and met == cells, message)


def moved(points: Iterable[Point], steps: tuple[int, ...], scale: int = 1) -> set[Point]:
    """Return scaled points, moved by one of the steps along each axis."""
    return {(scale * x + i, scale * y + j, scale * z + k) for x, y, z in points for i, j, k in product(steps, repeat=3)}


@claim("yau-srihari.67", full=500)
def rule_1(cases: int = 5) -> Check:
    # Each face, seen from below, is on one side of its directed edges, and no two faces share one.
    def are_opposite(voxels: tuple[Point, ...]) -> bool:
        faces = hull_of(voxels).lower.faces
        edges = [(u, v, f) for f in faces for u, v in sides(f.vertices)]
        on_one_side = all(normal_of(u, v, w)[2] < 0 for u, v, f in edges for w in {*f.vertices} - {u, v})
        return on_one_side and len({(u, v) for u, v, _ in edges}) == len(edges)

    return search(SOLIDS, are_opposite, cases, "faces with a common edge are on opposite sides of it")


@claim("yau-srihari.50", "yau-srihari.76", full=500)
def first_and_last_heights(cases: int = 5) -> Check:
    def agree(voxels: tuple[Point, ...]) -> bool:
        hull, leaves = hull_of(voxels), []
        # The codes of the leaves increase in the order in which sons are visited.
        for (x, y, z), level in zip(hull.solid.corners().tolist(), hull.solid.levels.tolist(), strict=True):
            side = hull.side >> level
            leaves += [(at, z, z + side - 1) for at in product(range(x, x + side), range(y, y + side))]
        floor = {at: low for at, low, _ in reversed(leaves)}
        points = sorted(_placed(voxels), key=lambda point: point[2])
        least, greatest = {(x, y): z for x, y, z in reversed(points)}, {(x, y): z for x, y, z in points}
        return (floor, {at: high for at, _, high in leaves}) == (least, greatest) == (hull.floor, hull.ceiling)

    return search(SOLIDS, agree, cases, "the first leaf in each column gives its floor, and the last one its ceiling")


@claim("yau-srihari.100", full=400)
def triangles_of_a_hull(cases: int = 2) -> Check:
    outcomes, sets = [], 0
    for sampled in sampled_sets(3, 4 * cases):
        points = sampled.points[:6]
        planes = {three: plane_through(*(points[k] for k in three)) for three in combinations(range(6), 3)}
        # A number is positive for the points below the plane of a triangle.
        values = {three: [-p[2] * plane_value(p, q) for q in points] for three, p in planes.items() if p[2]}
        supporting = [three for three, row in values.items() if max(row) <= 0]
        if {values[three].count(0) for three in supporting} == {3}:
            sets += 1
            faces = {frozenset(facet.polygon) for facet in exact_hull(points).facets if facet.plane[2] < 0}
            outcomes += [(frozenset(three) in faces) == (three in supporting) for three in values]
    generator = replace(SETS[3], name=f"the first six points of {SETS[3].name}, without four in the plane of a face")
    check = searched(generator, sets, outcomes, f"the statement is true for {len(outcomes)} triangles")
    # A face that is seen from below and has more than three corners is none of the triangles of its corners.
    facets = exact_hull(counterexample_points("yau_triangles.csv")).facets
    parts_of_faces = sum(comb(len(f.polygon), 3) for f in facets if f.plane[2] < 0 and len(f.polygon) > 3)
    as_printed = algorithm_as_printed("triangles")
    case = f"{parts_of_faces} triangles of points of a solid that lie in a supporting plane, but are only parts of a "
    case += f"face with more than three corners; {as_printed.message}"
    return check.unless(parts_of_faces and not as_printed.holds, case)


@claim("yau-srihari.99")
def another_vertex() -> Check:
    lower = hull_of(SOLID).lower
    reversed_ = [normal_of(*reversed(face.vertices[:3])) for face in lower.faces]
    # The construction finds each face on an edge of another face.
    another = [{*step.edge} < {*step.face.vertices} and step.face.normal[2] < 0 for step in lower.steps if step.face]
    message = f"the normals of {len(reversed_)} reversed faces point up, unlike those of faces of the envelope"
    right = len(another) == len(lower.faces) and all(another)
    return slip(all(n[2] < 0 for n in reversed_), right, "v3, v2 and another vertex", message)


@claim("yau-srihari.90")
def epigraph_at_inner_nodes() -> Check:
    rounded_up, truncated = list[bool](), list[bool]()
    for first, last in product(range(4), repeat=2):
        # Of three columns in a row, only the outer ones have points, so that the envelope between them is straight.
        envelope = [Fraction(first), Fraction(first + last, 2), Fraction(last)]
        for values, outcomes in ((map(ceil, envelope), rounded_up), (map(floor, envelope), truncated)):
            tree = written(no_columns(4), {(x, 0): Leaf(value) for x, value in enumerate(values)})
            full = voxels_of(graph_side(tree, above=True), (3, 1, 4))
            outcomes.append(all(full[x, 0, z] == (z >= envelope[x]) for x, z in product(range(3), range(4))))
    tree = written(no_columns(2), {divmod(k, 2): Leaf(k // 3) for k in range(4)})
    voxels = count(graph_side(tree, above=True))
    case = f"the root for the heights 0, 0, 0, 1, which would have 8 voxels instead of {voxels}, and by the truncated "
    case += f"heights of {truncated.count(False)} of {len(truncated)} envelopes"
    message = "a voxel is full exactly if its z is not below the envelope"
    check = exhausted("envelopes over three columns in a row, heights from 0 to 3 at the ends", rounded_up, message)
    return check.unless(tree.low == 0 and voxels < 8 and not all(truncated), case)

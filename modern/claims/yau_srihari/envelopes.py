"""Checks of Yau and Srihari: envelopes, the two theorems, floor and ceiling, and the algorithm as printed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction
from functools import cache
from itertools import combinations, product
from random import Random

import numpy as np
from numpy.typing import NDArray

from modern.claims.evidence import Check, claim, holds_if, refuted
from modern.claims.sampled_sets import Point, counterexample_points, plane_through, plane_value, sampled_sets
from modern.digital.solids import VERTEX, ball, listed
from modern.exact_hull import exact_hull
from modern.geometry.vectors import dot, minus
from modern.papers.yau_srihari import OctreeHull, Printed, octree_hull
from modern.papers.yau_srihari.convexity import convex_deficiency, is_digitally_convex, is_simple
from modern.papers.yau_srihari.envelope import reduced_tree
from modern.papers.yau_srihari.octree import count
from modern.papers.yau_srihari.quadtree import Leaf, Place, graph_side, heights, no_columns, written
from modern.papers.yau_srihari.search import Search, normal_of

Voxels = NDArray[np.bool_]
SOLID: tuple[Point, ...] = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (2, 1, 0), (2, 1, 1), (2, 2, 1), (2, 2, 2), (1, 2, 2))

_GRID: tuple[Point, ...] = tuple((x, y, z) for x in range(3) for y in range(3) for z in range(3))


def array_of(voxels: tuple[Point, ...] | list[Point]) -> Voxels:
    return listed(voxels).array


@cache
def _hull() -> OctreeHull:
    return octree_hull(array_of(SOLID))


@claim("yau-srihari.58", name="triangles")
@claim("yau-srihari.61", "yau-srihari.122", "yau-srihari.105", name="angle")
@claim("yau-srihari.66", name="bound")
@claim("yau-srihari.71", name="corners")
@claim("yau-srihari.83", name="start")
@claim("yau-srihari.86", name="truncation")
@claim("yau-srihari.87", name="marks")
def algorithm_as_printed(name: str) -> Check:
    """Compare one statement as printed with the corrected algorithm, on its counterexample."""
    array = array_of(counterexample_points(f"yau_{name}.csv"))
    wrong, right = octree_hull(array, Printed.only(name)).filled, octree_hull(array).filled
    missing, more = int((right & ~wrong).sum()), int((wrong & ~right).sum())
    message = f"of {int(right.sum())} voxels {missing} are missing, and {more} voxels are too many"
    return refuted(missing or more, message)


@claim("yau-srihari.1", "yau-srihari.109")
def minimum_not_unique() -> Check:
    """Check that two voxels with a common corner have two smallest digitally convex solids, of three voxels."""
    both: list[Point] = [(0, 0, 0), (1, 1, 0)]
    least = [is_digitally_convex(array_of([*both, third])) for third in ((1, 0, 0), (0, 1, 0))]
    return holds_if(all(least) and not is_simple(array_of(both)), "either of two voxels makes a convex solid of three")


@claim(
    "yau-srihari.2",
    "yau-srihari.45",
    "yau-srihari.95",
    "yau-srihari.48",
    "yau-srihari.51",
    "yau-srihari.53",
    "yau-srihari.54",
    "yau-srihari.97",
    "yau-srihari.120",
)
@claim("yau-srihari.4", "yau-srihari.38", "yau-srihari.49", kind="condition")
def envelopes_against_judge(kind: str = "") -> Check:
    """Check that the faces of the envelopes are those of the exact hull that look down or up.

    Between them lie the digital points of the Euclidean hull. With ``kind``, also check that those of the
    counterexample do not form a digital solid.
    """
    judge = exact_hull(SOLID)
    checks = []
    for envelope, sign in ((_hull().lower, 1), (_hull().upper, -1)):
        expected = {frozenset(f.polygon) for f in judge.facets if sign * f.plane[2] < 0}
        faces = {frozenset(SOLID.index((x, y, sign * z)) for x, y, z in face.vertices) for face in envelope.faces}
        checks.append(faces == expected)
    inside = {p for p in _GRID if max(plane_value(f.plane, p) for f in judge.facets) <= 0}
    checks.append({*map(tuple, np.argwhere(_hull().filled).tolist())} == inside)
    message = f"a solid of {len(SOLID)} voxels, whose hull has {len(inside)} voxels"
    if kind:
        return holds_if(all(checks) and not disconnected_hull().holds, message, conditional=True)
    return holds_if(all(checks), message)


@claim("yau-srihari.5")
def deficiency_of_solid() -> Check:
    """Check that the hull without the convex deficiency is the solid."""
    array = array_of(SOLID)
    missing = convex_deficiency(array)
    message = f"voxels of the hull that are not in the solid: {int(missing.sum())}"
    return holds_if(bool((_hull().filled & ~missing == array).all()), message)


@claim("yau-srihari.8", "yau-srihari.9", "yau-srihari.41")
def euclidean_convexity() -> Check:
    """Check that the hull of the vertices is the hull, and that midpoints of vertices are in it."""
    checks = []
    for sampled in sampled_sets(3, 1):
        again = exact_hull([sampled.points[k] for k in sampled.judge.vertices])
        checks.append(len(again.facets) == len(sampled.judge.facets))
        for i, j in combinations(sampled.judge.vertices, 2):
            checks.append(
                max(
                    plane_value(f.plane, sampled.points[i]) + plane_value(f.plane, sampled.points[j])
                    for f in sampled.judge.facets
                )
                <= 0
            )
    return holds_if(all(checks), f"{len(checks)} cases hold")


@claim("yau-srihari.14")
@claim("yau-srihari.16", kind="complexity")
def light_cap(kind: str = "") -> Check:
    """Check that the light faces seen from a point in general position form one cap with one closed boundary."""
    points: list[Point] = [(0, 0, 0), (7, 1, 2), (1, 8, 3), (2, 3, 9), (9, 9, 8)]
    judge, new = exact_hull(points), (11, -4, 13)
    light = [f for f in judge.facets if plane_value(f.plane, new) > 0]
    rim = [e for e in judge.edges() if sum({*e} <= {*f.polygon} for f in light) == 1]
    after = [end for edge in rim for end in edge]
    closed = bool(rim) and all(after.count(end) == 2 for end in after)
    if kind:
        bounds = [len(sampled.judge.edges()) <= 3 * len(sampled.points) - 6 for sampled in sampled_sets(3, 2)]
        return holds_if(all(bounds), "a hull of n points has at most 3n - 6 edges")
    message = f"{len(light)} light faces are surrounded by {len(rim)} edges, and two of these meet at each end"
    return holds_if(closed, message)


@claim("yau-srihari.19")
def voxels_fill_space() -> Check:
    """Check that every multiple of 1/4 is in exactly one half-open voxel, x - 1/2 < V <= x + 1/2."""
    checks = []
    for k in range(-8, 9):
        checks.append(sum(in_voxel(Fraction(k, 4), v) for v in range(-4, 5)) == 1)
    return holds_if(all(checks), f"{len(checks)} coordinates are each in one voxel")


def in_voxel(x: Fraction, v: int) -> bool:
    return x - Fraction(1, 2) < v <= x + Fraction(1, 2)


@claim("yau-srihari.36")
def disconnected_hull() -> Check:
    """Check the counterexample: nine connected voxels whose hull contains a voxel without neighbours, midway."""
    stairs = counterexample_points("yau_stairs.csv")
    hull = octree_hull(array_of(stairs))
    (x, y, z), (u, v, w) = stairs[0], stairs[-1]
    middle = ((x + u) // 2, (y + v) // 2, (z + w) // 2)
    inside = [(i, j, k) for i, j, k in np.argwhere(hull.filled).tolist()]
    alone = middle in inside and not any(sum(abs(a - b) for a, b in zip(p, middle, strict=True)) == 1 for p in inside)
    whole = tuple(2 * m for m in middle) == (x + u, y + v, z + w)
    wrong = hull.components == 1 and whole and alone and not is_simple(hull.filled)
    message = f"the hull of {len(stairs)} connected voxels has {len(inside)}, and {middle} has no neighbour among them"
    return refuted(wrong, message)


@claim("yau-srihari.35")
def smallest_convex_solid() -> Check:
    """Check that the digital points of a solid's hull pass the convexity test, and that a path of six voxels does not.

    The path contains all digital points of its hull. Two solids of seven voxels that contain the path pass, so there is
    no smallest one.
    """
    hull = _hull()
    passed = hull.components == 1 and is_simple(hull.filled) and is_digitally_convex(hull.filled)
    path, middle = counterexample_points("yau_path.csv"), (Fraction(1), Fraction(1, 2), Fraction(1))
    far = all(max(abs(a - b) for a, b in zip(middle, p, strict=True)) >= 1 for p in path)
    passed &= (
        far and (octree_hull(array_of(path)).filled == array_of(path)).all() and not is_digitally_convex(array_of(path))
    )
    completions = [p for p in _GRID if p not in path and is_digitally_convex(array_of([*path, p]))]
    message = (
        f"the hull of {hull.solid_voxels} connected voxels has {hull.voxels}; "
        f"each of {len(completions)} voxels makes the path convex"
    )
    return holds_if(passed and len(completions) > 1, message, conditional=True)


@claim("yau-srihari.39")
@claim("yau-srihari.50", kind="condition")
def floor_and_ceiling(kind: str = "") -> Check:
    """Check that floor and ceiling are the smallest and the largest z of each column; ``kind`` names them alpha and
    beta.
    """
    columns = {(x, y): sorted(z for a, b, z in SOLID if (a, b) == (x, y)) for x, y, _ in SOLID}
    passed = all(_hull().floor[at] == zs[0] and _hull().ceiling[at] == zs[-1] for at, zs in columns.items())
    return holds_if(passed, f"{len(columns)} columns agree", conditional=kind)


@claim("yau-srihari.52", "yau-srihari.103")
def ceiling_by_negation() -> Check:
    """Check that the envelope found for -beta has the negated heights of the upper hull."""
    judge = exact_hull(SOLID)
    envelope_points = {(x, y, -z) for face in _hull().upper.faces for x, y, z in face.vertices}
    upper = {SOLID[k] for f in judge.facets if f.plane[2] > 0 for k in f.polygon}
    message = f"{len(envelope_points)} vertices agree with negated heights"
    return holds_if(envelope_points == upper, message, conditional=True)


@claim("yau-srihari.55", "yau-srihari.98", "yau-srihari.56", "yau-srihari.64")
def extreme_points() -> Check:
    """Check that the vertices of the lower envelope are points of the floor and of the reduced set."""
    floor = {(x, y, z) for (x, y), z in _hull().floor.items()}
    vertices = {v for face in _hull().lower.faces for v in face.vertices}
    message = f"{len(vertices)} vertices are among the points of {len(floor)} columns"
    return holds_if(vertices <= floor and vertices <= {*_hull().lower.reduced}, message)


@claim("yau-srihari.84")
def integer_normals() -> Check:
    """Check that all normals of faces and in the queue are integers and perpendicular to their edges or sides."""
    checks, upright = [], 0
    for side in (_hull().lower, _hull().upper):
        normals = [(face.normal, face.vertices) for face in side.faces]
        normals += [(step.normal, step.edge) for step in side.steps]
        upright += sum(normal[2] == 0 for normal, _ in normals)
        for normal, (first, *others) in normals:
            checks.append(any(normal) and all(type(n) is int for n in normal))
            checks += [dot(normal, minus(vertex, first)) == 0 for vertex in others]
    message = f"{len(checks)} conditions hold; {upright} normals belong to starting faces"
    return holds_if(upright > 0 and all(checks), message)


@claim("yau-srihari.100")
def supporting_triangle() -> Check:
    """Check the counterexample: a supporting plane contains a triangle of three corners that is not the whole face."""
    points = counterexample_points("yau_triangles.csv")
    judge = exact_hull(points)
    larger = [f for f in judge.facets if f.plane[2] < 0 and len(f.polygon) > 3]
    support = all(max(plane_value(f.plane, p) for p in points) == 0 for f in larger)
    message = ", ".join(str(len(f.polygon)) for f in larger)
    return refuted(larger and support, f"supporting planes that look down have {message} corners")


@claim("yau-srihari.101")
def opposite_sides() -> Check:
    """Check that planes through an edge of the lower envelope support unless a point lies on the opposite side."""
    checks = []
    floor = [(x, y, z) for (x, y), z in _hull().floor.items()]
    for face in _hull().lower.faces:
        v1, v2, v3 = face.vertices[:3]
        for plane in (plane_through(v3, v2, third_point) for third_point in floor):
            if any(plane[:3]):
                values = [plane_value(plane, p) for p in floor]
                opposite = any(v * plane_value(plane, v1) < 0 for v in values)
                checks.append((max(values) <= 0 or min(values) >= 0) == (not opposite))
    return holds_if(all(checks) and bool(checks), f"{len(checks)} planes agree")


@claim("yau-srihari.99")
def another_vertex() -> Check:
    """Check that the faces of the lower envelope have normals that point up when reversed, as v3 v2 v1."""
    normals = [normal_of(*reversed(face.vertices[:3])) for face in _hull().lower.faces]
    passed = all(n[2] > 0 for n in normals) and all(face.normal[2] < 0 for face in _hull().lower.faces)
    return holds_if(passed, f"the normals of {len(normals)} reversed faces point up", conditional=True)


@claim("yau-srihari.90")
def epigraph_at_inner_nodes() -> Check:
    """Check an inner node with the heights 0, 1, 1, 1: as printed it is full, but the epigraph is not."""
    tops = {(0, 0): 0, (0, 1): 1, (1, 0): 1, (1, 1): 1}
    tree = written(no_columns(2), {place: Leaf(top) for place, top in tops.items()})
    voxels_as_printed = 8 if tree.low == 0 else 0
    epigraph = count(graph_side(tree, above=True))
    columns = sum(z >= top for top in tops.values() for z in (0, 1))
    passed = voxels_as_printed == 8 > epigraph == columns == 5 and tree.high == 1
    message = f"as printed the root has {voxels_as_printed} voxels, and the epigraph has {epigraph}"
    return holds_if(passed, message, conditional=True)


@claim("yau-srihari.113")
def pairs_of_points() -> Check:
    """Count the segments between n points for n up to 12."""
    counts = {n: len([*combinations(range(n), 2)]) for n in range(2, 13)}
    message = "the number is n (n - 1) / 2 for n from 2 to 12"
    return holds_if(all(2 * count == n * (n - 1) for n, count in counts.items()), message)


@claim("yau-srihari.119")
def outward_normals() -> Check:
    """Check that the normals of the lower envelope point down and away from all points of the floor."""
    floor = [(x, y, z) for (x, y), z in _hull().floor.items()]
    checks = []
    for face in _hull().lower.faces:
        normal, first = face.normal, face.vertices[0]
        ways = [sum(n * (a - b) for n, a, b in zip(normal, p, first, strict=True)) for p in floor]
        checks.append(max(ways) == 0 and normal[2] < 0 and normal_of(*face.vertices[:3])[2] < 0)
    return holds_if(bool(checks) and all(checks), f"the normals of {len(checks)} faces point outward")


@claim("yau-srihari.85")
def queued_edges_reversed() -> Check:
    """Check that edges entered in the queue as u1 u3 or u3 u2 are always removed in the reverse direction."""
    random = Random(8)
    same, reverse, neither = 0, 0, 0
    for _ in range(6):
        hull = octree_hull(array_of([p for p in _GRID if random.random() < 0.6]))
        for step in (*hull.lower.steps, *hull.upper.steps):
            ring = step.face.vertices if step.face else ()
            # Section 4.6: u1 u3 and u3 u2 are the printed directions of the edges entered.
            entries = {*zip((*ring[1:], *ring[:1]), ring, strict=True)}
            for p, q in step.removed:
                same += (p, q) in entries
                reverse += (q, p) in entries
                neither += (p, q) not in entries and (q, p) not in entries
    message = (
        f"{reverse} edges are removed in the reverse direction, and {same} in the direction in which they were entered"
    )
    return holds_if(reverse and not same and not neither, message, conditional=True)


@claim("yau-srihari.128")
def row_and_column_steps() -> Check:
    """Compare points extreme in both row and column with those left after a step by rows and one by columns."""
    random = Random(29)
    checks, larger = [], 0
    for _ in range(40):
        heights_ = {(x, y): random.randint(0, 3) for x in range(4) for y in range(4) if random.random() < 0.8}
        extreme_in_both = {place for place in heights_ if all(_extreme(place, axis, heights_) for axis in (0, 1))}
        tree = written(no_columns(4), {place: Leaf(z) for place, z in heights_.items()})
        after_steps = {*heights(reduced_tree(tree))}
        floor: list[Point] = [(x, y, z) for (x, y), z in heights_.items()]
        # The lower hull of the floor: copies of all points far above leave its lower vertices unchanged.
        hull = exact_hull([*floor, *((x, y, z + 9) for x, y, z in floor)])
        checks.append({floor[k][:2] for k in hull.vertices if k < len(floor)} <= extreme_in_both <= after_steps)
        larger += extreme_in_both < after_steps
    message = f"{len(checks)} floors; in {larger} the second step keeps a point that is not extreme in its whole column"
    return holds_if(all(checks) and larger, message, conditional=True)


@claim("yau-srihari.129")
def angle_counts() -> Check:
    """Count angles in the lower halves of two balls, one for each point beyond an edge, and those the tree search
    computes.
    """
    counts = []
    for diameter in (8, 40):
        hull = octree_hull(ball(diameter, VERTEX).array)
        steps, reduced = hull.lower.steps, [(x, y) for x, y, _ in hull.lower.reduced]
        all_angles, reduced_angles = (
            sum(_beyond(step.edge, places) for step in steps) for places in (hull.floor, reduced)
        )
        counts.append((all_angles, reduced_angles, sum(step.angles for step in steps)))
    (all_8, left_8, search_8), (all_40, left_40, search_40) = counts
    passed = left_8 < all_8 and left_40 < all_40 and left_8 < search_8 and search_40 < left_40
    message = "; ".join(f"{a:,} for the floor, {b:,} for the reduced set, {c:,} by the search" for a, b, c in counts)
    return holds_if(passed, message, conditional=True)


def _beyond(edge: tuple[Point, Point], places: Iterable[Place]) -> int:
    """Return the number of columns that can contain the third point of a face on an edge."""
    search = Search(*edge, (0, 0, -1), Printed())
    return sum(search.beyond(x, y) for x, y in places)


def _extreme(place: Place, axis: int, heights_: Mapping[Place, int]) -> bool:
    """Return True if a point is a vertex of the lower chain of its row or column."""
    at, z = place[axis], heights_[place]
    line = [(p[axis], h) for p, h in heights_.items() if p[1 - axis] == place[1 - axis]]
    around = product([entry for entry in line if entry[0] < at], [entry for entry in line if entry[0] > at])
    return all((z - h) * (b - a) < (k - h) * (at - a) for (a, h), (b, k) in around)

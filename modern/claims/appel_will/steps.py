"""Checks of single steps of Appel and Will: new and collinear lines, the star test, loops, and inside corners."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations, pairwise, product

from modern.claims.appel_will.convexity import CUBE, Flat
from modern.claims.evidence import Check, claim, holds_if, refuted
from modern.claims.sampled_sets import CASES, Point, counterexample_points, sampled_sets
from modern.exact_hull import exact_hull
from modern.papers.appel_will import Method, appel_will, printed
from modern.papers.appel_will.corners import triple_product
from modern.papers.appel_will.star import as_corrected, as_printed, project, star_polygon, vorticity

# The vectors I, K and L of [512], [723] and [643].
FIG_18: tuple[tuple[Point, Point, Point], ...] = (
    ((-1, 0, 0), (0, 0, -1), (0, -1, 0)),
    ((-1, 0, 0), (0, -1, 0), (0, 0, -1)),
    ((1, 0, 0), (0, -1, 0), (0, 0, -1)),
)


@claim("appel-will.128")
def new_lines() -> Check:
    """Check that the hull of a polygon with a notch has fewer points and a line that the polygon does not have."""
    ring: list[Flat] = [(0, 0), (6, 0), (6, 6), (3, 2), (0, 6)]
    polygon = exact_hull([(x, y, 0) for x, y in ring]).polygon
    sides = {frozenset((k, (k + 1) % len(ring))) for k in range(len(ring))}
    new = [pair for pair in zip(polygon, (*polygon[1:], polygon[0]), strict=True) if frozenset(pair) not in sides]
    message = ", ".join(f"{ring[a]} to {ring[b]}" for a, b in new)
    return holds_if(len(polygon) < len(ring) and len(new) == 1, f"the new line is {message}")


@claim("appel-will.133")
def collinear_points() -> Check:
    """Check that the middle of three collinear points that are projected to one point is not a vertex of the hull."""
    checks = []
    for sampled in sampled_sets(3, CASES):
        doubled = [(2 * x, 2 * y, 2 * z) for x, y, z in sampled.points]
        for p, q in combinations(doubled[:6], 2):
            middle: Point = ((p[0] + q[0]) // 2, (p[1] + q[1]) // 2, (p[2] + q[2]) // 2)
            if middle not in doubled:
                points = [*doubled, middle]
                line = project(points, (points.index(p), points.index(q)), range(len(points))).line
                checks.append(len(doubled) in line and len(doubled) not in exact_hull(points).vertices)
    return holds_if(bool(checks) and all(checks), f"{len(checks)} points between two others are not vertices")


@claim("appel-will.131")
@claim("appel-will.58", kind="change")
def star_test(kind: str = "") -> Check:
    """Check that the senses around the star polygon decide which grid points are inside the hull of five points.

    A point on the border counts as inside (Fig. 12, III). ``change``: a point is outside if two sides turn differently.
    """
    five = [(0, 0), (6, 0), (7, 5), (0, 6), (3, 3)]
    checks, border = [], 0
    for x, y in product(range(-1, 9), range(0, 8, 2)):
        images = [(a - x, b - y) for a, b in five]
        if (0, 0) in images:
            continue
        hull = exact_hull([*((a, b, 0) for a, b in five), (x, y, 0)])
        held = 5 not in hull.vertices
        border += 5 in hull.boundary
        star = star_polygon(images)
        senses = {turn > 0 for a, b in zip(star, (*star[1:], star[0]), strict=True) if (turn := vorticity(a, b))}
        checks.append(as_corrected(images) != held if not kind else len(senses) == 1 or not held)
    return holds_if(all(checks) and border > 0, f"{len(checks)} points agree, {border} of them on the border")


@claim("appel-will.134", "appel-will.135")
@claim("appel-will.145", "yau-srihari.112", kind="twice")
def closed_loops(kind: str = "") -> Check:
    """Check that consecutive lines of a loop share an end, and that each line is in two loops, once each way."""
    checks, signs = [], []
    for points in (CUBE, *(sampled.points for sampled in sampled_sets(3, CASES))):
        hull = appel_will(points)
        all_entries: list[int] = []
        for loop in hull.table.loops:
            checks.append(_joined(loop.entries, hull.edges))
            all_entries += loop.entries
        signs.append(sorted(map(abs, all_entries)) == sorted([*range(1, len(hull.edges) + 1)] * 2))
    message = f"{len(checks)} loops are closed"
    return holds_if(all(checks) and all(signs), f"{message}, and every line is in two" if kind else message)


@claim("appel-will.111")
def fourth_loop() -> Check:
    """Check that the last entry of the fourth loop of Fig. 22 needs its minus."""
    hull = appel_will(counterexample_points("fig14.csv"))
    (loop,) = (loop.entries for loop in hull.table.loops if {4, 6, 9} <= {*loop.entries})
    as_it_is, without = (_joined(entries, hull.edges) for entries in (loop, (*loop[:-1], abs(loop[-1]))))
    checks = [*loop] == [4, 6, 9, -5] and as_it_is and not without
    return holds_if(checks, f"{' '.join(map(str, loop))} runs around a face, and 4 6 9 5 does not", conditional=True)


@claim("appel-will.148")
def limit_of_searches() -> Check:
    """Check step 9 on a pentagon: as printed it never ends, and with a limit it reports an open loop."""
    points = counterexample_points("pentagon.csv")
    hull = appel_will(points, method=printed("step9", "step3"))
    ring = exact_hull(points).polygon
    endless = sum(_comes_again(hull.edges, ring[k - 2], ring[k - 1], ring[k]) for k in range(len(ring)))
    ended = hull.fault.endswith("does not return to its start")
    return holds_if(ended and endless > 0, f"{endless} of {len(ring)} starts do not end; with the limit: {hull.fault}")


def _comes_again(edges: Sequence[tuple[int, int]], start: int, common: int, match: int) -> bool:
    visited: set[int] = set()
    while match != start and match not in visited:
        visited.add(match)
        line = next(edge for edge in edges if match in edge and common not in edge)
        match = sum(line) - match
    return match != start


def _joined(entries: Sequence[int], edges: Sequence[tuple[int, int]]) -> bool:
    ends = [edges[abs(e) - 1] if e > 0 else edges[abs(e) - 1][::-1] for e in entries]
    return all(a[1] == b[0] for a, b in pairwise([*ends, ends[0]]))


@claim("appel-will.159")
def product_with_repeated_vector() -> Check:
    """Check the determinants of Fig. 18 with L as displayed, which is I again, and with the normal of l."""
    determinants = []
    for i, k, m in FIG_18:
        determinants.append((triple_product(i, k, i), triple_product(i, k, m)))
    with_i, with_l = (", ".join(map(str, column)) for column in zip(*determinants, strict=True))
    message = f"the determinants are {with_l} with l, and {with_i} with i as displayed"
    return holds_if(determinants == [(0, 1), (0, -1), (0, 1)], message, conditional=True)


@claim("appel-will.132")
def star_as_described() -> Check:
    """Check the star test on a cube as the text on Fig. 12 describes it."""
    cube = counterexample_points("cube.csv")
    edges = appel_will(cube, method=Method(star=as_printed)).edges
    return refuted(len(edges) > 12, f"the test finds {len(edges)} edges of a cube, which has 12")

"""Claims of Appel and Will that are steps on the way: lines that come and go, the star test, loops, inside corners."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations, pairwise, product

from modern.claims.appel_will.convexity import CUBE, Flat
from modern.claims.register import CONDITION, FAILS, HOLDS, Seen, seen
from modern.claims.sampled_sets import Point, sampled_sets
from modern.claims.thesis.chapter3_equations import COUNT, points_of
from modern.exact_hull import exact_hull
from modern.papers.appel_will import Method, appel_will, printed
from modern.papers.appel_will.corners import triple_product
from modern.papers.appel_will.edges import project
from modern.papers.appel_will.star import as_corrected, as_printed, star_polygon, vorticity

FIG_18: tuple[tuple[Point, Point, Point], ...] = (
    ((-1, 0, 0), (0, 0, -1), (0, -1, 0)),
    ((-1, 0, 0), (0, -1, 0), (0, 0, -1)),
    ((1, 0, 0), (0, -1, 0), (0, 0, -1)),
)
"""I, K and L of [512], [723] and [643]."""


def new_lines() -> Seen:
    """A polygon with a notch: its hull has fewer points, and a line that the polygon does not have."""
    ring: list[Flat] = [(0, 0), (6, 0), (6, 6), (3, 2), (0, 6)]
    polygon = exact_hull([(x, y, 0) for x, y in ring]).polygon
    sides = {frozenset((k, (k + 1) % len(ring))) for k in range(len(ring))}
    new = [pair for pair in zip(polygon, (*polygon[1:], polygon[0]), strict=True) if frozenset(pair) not in sides]
    words = ", ".join(f"{ring[a]} to {ring[b]}" for a, b in new)
    return seen(len(polygon) < len(ring) and len(new) == 1, f"new: {words}")


def points_in_line() -> Seen:
    """Of three points in a line that are projected to one, the middle one is no vertex of any set's hull."""
    good = []
    for one in sampled_sets(3, int(COUNT)):
        doubled = [(2 * x, 2 * y, 2 * z) for x, y, z in one.points]
        for p, q in combinations(doubled[:6], 2):
            middle: Point = ((p[0] + q[0]) // 2, (p[1] + q[1]) // 2, (p[2] + q[2]) // 2)
            if middle not in doubled:
                points = [*doubled, middle]
                line = project(points, (points.index(p), points.index(q)), range(len(points))).line
                good.append(len(doubled) in line and len(doubled) not in exact_hull(points).vertices)
    return seen(bool(good) and all(good), f"{len(good)} points between two others")


def star_tells_inside(kind: str = "") -> Seen:
    """Grid points against five points of a plane: the senses around the star tell who is in their hull.

    A point on the border counts as inside (Fig. 12, III).  ``change``: outside, whenever two sides turn differently.
    """
    five = [(0, 0), (6, 0), (7, 5), (0, 6), (3, 3)]
    good, border = [], 0
    for x, y in product(range(-1, 9), range(0, 8, 2)):
        images = [(a - x, b - y) for a, b in five]
        if (0, 0) in images:
            continue
        hull = exact_hull([*((a, b, 0) for a, b in five), (x, y, 0)])
        held = 5 not in hull.vertices
        border += 5 in hull.boundary
        star = star_polygon(images)
        senses = {turn > 0 for a, b in zip(star, (*star[1:], star[0]), strict=True) if (turn := vorticity(a, b))}
        good.append(as_corrected(images) != held if not kind else len(senses) == 1 or not held)
    return seen(all(good) and border > 0, f"{len(good)} points, {border} of them on the border")


def closed_loops(kind: str = "") -> Seen:
    """Loops of cubes and small sets: lines beside each other share an end, the last one shares one with the first.

    Each line is in two loops, once in each direction: a positive entry runs from its first point to its second.
    """
    good, signs = [], []
    for points in (CUBE, *(one.points for one in sampled_sets(3, int(COUNT)))):
        hull = appel_will(points)
        found: list[int] = []
        for loop in hull.table.loops:
            good.append(_joined(loop.entries, hull.edges))
            found += loop.entries
        signs.append(sorted(map(abs, found)) == sorted([*range(1, len(hull.edges) + 1)] * 2))
    words = f"{len(good)} loops"
    return seen(all(good) and all(signs), f"{words}, every line in two" if kind else words)


def fourth_loop() -> Seen:
    """Fig. 22's fourth loop: its last entry has a minus, and without it line 5 would begin where it ends."""
    hull = appel_will(points_of("fig14.csv"))
    (loop,) = (loop.entries for loop in hull.table.loops if {4, 6, 9} <= {*loop.entries})
    as_it_is, without = (_joined(entries, hull.edges) for entries in (loop, (*loop[:-1], abs(loop[-1]))))
    good = [*loop] == [4, 6, 9, -5] and as_it_is and not without
    return Seen(CONDITION if good else FAILS, f"{' '.join(map(str, loop))} runs around a face, 4 6 9 5 does not")


def limit_of_searches() -> Seen:
    """Step 9 as printed on a pentagon: without a limit it comes to a point again, and so on for ever.

    With the limit the program ends, and says that the loop does not close.
    """
    points = points_of("pentagon.csv")
    hull = appel_will(points, method=printed("step9", "step3"))
    ring = exact_hull(points).polygon
    endless = sum(_comes_again(hull.edges, ring[k - 2], ring[k - 1], ring[k]) for k in range(len(ring)))
    ended = hull.fault.endswith("does not return to its start")
    return seen(ended and endless > 0, f"{endless} of {len(ring)} beginnings do not end; with the limit: {hull.fault}")


def _comes_again(edges: Sequence[tuple[int, int]], start: int, common: int, match: int) -> bool:
    """Whether steps 9 and 10 as printed, from the lines start-common-match on, come to a point twice."""
    visited: set[int] = set()
    while match != start and match not in visited:
        visited.add(match)
        line = next(edge for edge in edges if match in edge and common not in edge)
        match = sum(line) - match
    return match != start


def _joined(entries: Sequence[int], edges: Sequence[tuple[int, int]]) -> bool:
    """Whether each entry begins where the one before it ends, the first one where the last ends."""
    ends = [edges[abs(e) - 1] if e > 0 else edges[abs(e) - 1][::-1] for e in entries]
    return all(a[1] == b[0] for a, b in pairwise([*ends, ends[0]]))


def product_with_i_twice() -> Seen:
    """Fig. 18's determinants with L as displayed, which is I again, and with the normal of l."""
    found = []
    for i, k, m in FIG_18:
        found.append((triple_product(i, k, i), triple_product(i, k, m)))
    words = (
        f"{', '.join(str(right) for _, right in found)} with l, {', '.join(str(wrong) for wrong, _ in found)} with i"
    )
    return Seen(CONDITION if found == [(0, 1), (0, -1), (0, 1)] else FAILS, words)


def star_in_the_text() -> Seen:
    """Of a cube the text on Fig. 12, as printed, gives more edges than twelve."""
    cube = points_of("cube.csv")
    found = appel_will(cube, method=Method(star=as_printed)).edges
    return Seen(FAILS if len(found) > 12 else HOLDS, f"{len(found)} edges of a cube")

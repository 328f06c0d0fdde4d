"""Checks of single steps of Appel and Will: new and collinear lines, the star test, loops, and inside corners."""

from collections.abc import Sequence
from itertools import combinations, pairwise, permutations, product

from modern.claims.appel_will.convexity import Flat
from modern.claims.evidence import Check, claim, exhausted, exhibited, slip
from modern.claims.sampled_sets import Point, counterexample_points
from modern.exact_hull import exact_hull
from modern.papers.appel_will import Method, appel_will, printed
from modern.papers.appel_will.corners import triple_product
from modern.papers.appel_will.results import found_solid
from modern.papers.appel_will.star import as_corrected, as_printed, star_polygon, vorticity

# The vectors I, K and L of [512], [723] and [643].
FIG_18: tuple[tuple[Point, Point, Point], ...] = (
    ((-1, 0, 0), (0, 0, -1), (0, -1, 0)),
    ((-1, 0, 0), (0, -1, 0), (0, 0, -1)),
    ((1, 0, 0), (0, -1, 0), (0, 0, -1)),
)


@claim("appel-will.128")
def new_lines() -> Check:
    """Check that the hull of a notched polygon has fewer points, and a line that the polygon does not have."""
    ring: list[Flat] = [(0, 0), (6, 0), (6, 6), (3, 2), (0, 6)]
    polygon = exact_hull([(x, y, 0) for x, y in ring]).polygon
    sides = {frozenset((k, (k + 1) % len(ring))) for k in range(len(ring))}
    new = [pair for pair in zip(polygon, (*polygon[1:], polygon[0]), strict=True) if frozenset(pair) not in sides]
    message = ", ".join(f"{ring[a]} to {ring[b]}" for a, b in new)
    return exhibited(len(polygon) < len(ring) and len(new) == 1, f"the new line is {message}")


@claim("appel-will.131")
@claim("appel-will.58", test="change")
def star_test(test: str = "") -> Check:
    """Check that the senses of turn around the star polygon tell which grid points are in the hull of five points.

    The test as printed is right if no two projections are in line with the point. test: ``change`` only asks whether
    two sides turn differently. A point on the border counts as inside (Fig. 12).
    """
    five = [(0, 0), (6, 0), (7, 5), (0, 6), (3, 3)]
    border = 0
    checks: list[bool] = []
    in_line: list[bool] = []
    for x, y in product(range(-1, 9), range(0, 8, 2)):
        images = [(a - x, b - y) for a, b in five]
        if (0, 0) in images:
            continue
        hull = exact_hull([*((a, b, 0) for a, b in five), (x, y, 0)])
        held = 5 not in hull.vertices
        border += 5 in hull.boundary
        star = star_polygon(images)
        senses = {turn > 0 for a, b in zip(star, (*star[1:], star[0]), strict=True) if (turn := vorticity(a, b))}
        if test:
            checks.append(len(senses) == 1 or not held)
        else:
            general = all(vorticity(a, b) for a, b in combinations(images, 2))
            (checks if general else in_line).append(as_printed(images) != held)
    check = exhausted("grid points about five points", [*checks, border], f"right for {len(checks)} points")
    return check.unless(in_line and not all(in_line), "grid points in line with two of the five points")


@claim("appel-will.119")
def images_on_one_ray() -> Check:
    """Check that the star test gives the same result for each order of the projections, two of which are on one ray."""
    outcomes = []
    for images in ([(1, 1), (2, 2), (-1, 0), (0, -1)], [(1, 0), (2, 0), (1, 2), (0, 1)]):
        outcomes += [as_corrected([*order]) == as_corrected(images) for order in permutations(images)]
    return exhausted("orders of two sets of four images", outcomes, f"{len(outcomes)} orders give the same results")


@claim("appel-will.60")
def between_opposite_images() -> Check:
    """Check that a point between two opposite projections is not outside, but is outside without one of them."""
    passed = not as_corrected([(1, 0), (-1, 0), (0, 1), (0, -1)]) and as_corrected([(1, 0), (0, 1)])
    return exhibited(passed, "the origin is inside the star of four images around it, and outside that of two")


@claim("appel-will.101")
def step_3_as_printed() -> Check:
    """Check that step 3 needs its preference for a positive product only for the direction of some loops."""
    solids = [found_solid(name).points for name in ("fig14", "fig23")]
    preferred, plain = ([appel_will(p, method=m) for p in solids] for m in (Method(), printed("step3")))
    same = all(
        {*map(frozenset, a.surfaces)} == {*map(frozenset, b.surfaces)} for a, b in zip(preferred, plain, strict=True)
    )
    differing = sum(
        x.entries != y.entries
        for a, b in zip(preferred, plain, strict=True)
        for x, y in zip(a.table.loops, b.table.loops, strict=True)
    )
    check = exhibited(same, "step 3 finds the faces of Figs. 14 and 23 from any other edge")
    return check.unless(
        differing == 3, "the step as printed, which runs three of the twelve printed loops the other way"
    )


@claim("appel-will.90")
def points_inside() -> Check:
    """Check that points inside a box add no edges or loops, but cost projections of further pairs."""
    corners = [(x, y, z) for x in (0, 9) for y in (0, 8) for z in (0, 7)]
    few, many = appel_will(corners), appel_will([*corners, *((x, x + 1, x) for x in (2, 3, 4, 5))])
    check = exhibited((few.edges, few.surfaces) == (many.edges, many.surfaces), "edges and loops are those of the box")
    return check.unless(
        many.projections > few.projections,
        f"points inside: {many.projections} projections instead of {few.projections}",
    )


@claim("appel-will.111")
def fourth_loop() -> Check:
    """Check that the last entry of the fourth loop of Fig. 22 must have its minus sign."""
    hull = appel_will(counterexample_points("fig14.csv"))
    (loop,) = (loop.entries for loop in hull.table.loops if {4, 6, 9} <= {*loop.entries})
    as_it_is, without = (_joined(entries, hull.edges) for entries in (loop, (*loop[:-1], abs(loop[-1]))))
    corrected = [*loop] == [4, 6, 9, -5] and as_it_is
    return slip(without, corrected, "4 6 9 -5", "4 6 9 5 does not run around a face, and 4 6 9 -5 does")


@claim("appel-will.148")
def limit_of_searches() -> Check:
    """Check that step 9 as printed never ends on a pentagon, and reports an open loop if searches are limited."""
    points = counterexample_points("pentagon.csv")
    hull = appel_will(points, method=printed("step9", "step3"))
    ring = exact_hull(points).polygon
    endless = sum(_comes_again(hull.edges, ring[k - 2], ring[k - 1], ring[k]) for k in range(len(ring)))
    ended = hull.fault.endswith("does not return to its start")
    return exhibited(ended and endless > 0, f"{endless} of {len(ring)} searches never end; with a limit: {hull.fault}")


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
    """Check the determinants of Fig. 18: with the displayed third vector I they are 0, with l they are right."""
    determinants = []
    for i, k, m in FIG_18:
        determinants.append((triple_product(i, k, i), triple_product(i, k, m)))
    with_i, with_l = (", ".join(map(str, column)) for column in zip(*determinants, strict=True))
    message = f"the determinants are {with_l} with l, and {with_i} with i as displayed"
    return slip(any(d[0] for d in determinants), [d[1] for d in determinants] == [1, -1, 1], "l", message)

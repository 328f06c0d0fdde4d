"""Checks of single steps of Appel and Will: new and collinear lines, the star test, loops, and inside corners."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations, pairwise, permutations
from random import Random

from modern.claims.appel_will.convexity import RINGS, Flat, area, holds_origin
from modern.claims.evidence import Check, Generator, claim, exhibited, search, slip
from modern.claims.hulls import exact_hull
from modern.claims.sampled_sets import Point, counterexample_points
from modern.papers.appel_will import Method, appel_will, printed
from modern.papers.appel_will.corners import triple_product
from modern.papers.appel_will.results import found_solid
from modern.papers.appel_will.star import as_corrected, as_printed, on_one_ray, star_polygon, vorticity

# The vectors I, K and L of [512], [723] and [643].
FIG_18: tuple[tuple[Point, Point, Point], ...] = (
    ((-1, 0, 0), (0, 0, -1), (0, -1, 0)),
    ((-1, 0, 0), (0, -1, 0), (0, 0, -1)),
    ((1, 0, 0), (0, -1, 0), (0, 0, -1)),
)


# Only polygons that are not convex; without them, nothing has to be deleted.
NONCONVEX: Generator[tuple[Flat, ...]] = replace(
    RINGS, name=f"{RINGS.name}, not convex", accepts=lambda ring: RINGS.accepts(ring) and not _is_convex(ring)
)


def _is_convex(ring: Sequence[Flat]) -> bool:
    return all(area(ring[k - 2], ring[k - 1], ring[k]) > 0 for k in range(len(ring)))


@claim("appel-will.128", full=5_000)
def new_lines(cases: int = 10) -> Check:
    """Check that the hull of a polygon that is not convex has fewer points, and a line that is not one of its sides."""

    def is_changed(ring: Sequence[Flat]) -> bool:
        polygon = exact_hull([(x, y, 0) for x, y in ring]).polygon
        sides = {frozenset((k, (k + 1) % len(ring))) for k in range(len(ring))}
        new = [pair for pair in zip(polygon, (*polygon[1:], polygon[0]), strict=True) if frozenset(pair) not in sides]
        return len(polygon) < len(ring) and bool(new)

    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    check = search(NONCONVEX, is_changed, cases, "the hull of each polygon has fewer points and a new line")
    return check.unless(not is_changed(square), "a square, which is its own hull")


def _draw_images(random: Random) -> tuple[Flat, ...]:
    return tuple((random.randint(-4, 4), random.randint(-4, 4)) for _ in range(random.randint(3, 5)))


IMAGES: Generator[tuple[Flat, ...]] = Generator(
    "3 to 5 projected points around the origin", 12, _draw_images, lambda i: len({*i}) == len(i) > 2 and (0, 0) not in i
)


@claim("appel-will.131", full=5_000)
def star_test(cases: int = 20) -> Check:
    """Check that the senses of rotation about a point tell whether the point is in the hull of a set of images.

    The star polygon test is used with the corrected rule for images on one ray. As printed, it gives the same result if
    no two images are on one ray.
    """

    def is_right(images: tuple[Flat, ...]) -> bool:
        is_outside = as_corrected(images)
        on_ray = any(on_one_ray(a, b) for a, b in combinations(images, 2))
        return is_outside != holds_origin(images) and (on_ray or as_printed(images) == is_outside)

    return search(IMAGES, is_right, cases, "the senses of rotation tell whether the point is in the hull of each set")


@claim("appel-will.55", "appel-will.58", full=5_000)
def change_of_sense(cases: int = 20) -> Check:
    """Check that a change of sense shows a point outside its star polygon, and that it then is outside the hull."""

    def is_right(images: tuple[Flat, ...]) -> bool:
        star = star_polygon(images)
        sides = [*zip(star, (*star[1:], star[0]), strict=True)]
        turns = [vorticity(a, b) for a, b in sides]
        # The point is outside if it is on no side, and a ray from it crosses an even number of sides.
        crossings = [(a[1] > 0) != (b[1] > 0) and vorticity(a, b) * (b[1] - a[1]) > 0 for a, b in sides]
        on_side = any(not vorticity(a, b) and not on_one_ray(a, b) for a, b in sides)
        is_outside = not on_side and sum(crossings) % 2 == 0
        return (is_outside or min(turns) >= 0 or max(turns) <= 0) and not (is_outside and holds_origin(images))

    return search(IMAGES, is_right, cases, "a change of sense is seen only from outside the star polygon and the hull")


@claim("appel-will.119", full=1_000)
def order_on_one_ray(cases: int = 10) -> Check:
    """Check that two images on one ray keep, in the star polygon, the order in which they are listed."""

    def is_listed_order(images: tuple[Flat, ...]) -> bool:
        near, far = images[0], (2 * images[0][0], 2 * images[0][1])
        rest = [image for image in images if image not in (near, far)]
        return all(
            [p for p in star_polygon([a, b, *rest]) if p not in rest] == [a, b] for a, b in permutations((near, far))
        )

    return search(IMAGES, is_listed_order, cases, "sorting by angle leaves two images on one ray in either order")


@claim("appel-will.60", full=1_000)
def opposite_images(cases: int = 10) -> Check:
    """Check that the star polygon test finds a point between two opposite images inside, for all orders of images."""

    def is_inside(images: tuple[Flat, ...]) -> bool:
        opposite = (*images[:3], (-images[0][0], -images[0][1]))
        return holds_origin(opposite) and not any(as_corrected([*order]) for order in permutations(opposite))

    return search(IMAGES, is_inside, cases, "all orders of the images give the same result")


@claim("appel-will.101")
def step_3_as_printed() -> Check:
    """Check that step 3 of the loop algorithm, as printed, changes only the direction of some loops."""
    solids = [found_solid(name).points for name in ("fig14", "fig23")]
    preferred, plain = ([appel_will(p, method=m) for p in solids] for m in (Method(), printed("step3")))
    same = all(
        {*map(frozenset, a.surfaces)} == {*map(frozenset, b.surfaces)} for a, b in zip(preferred, plain, strict=True)
    )
    reversed_loops = sum(
        {*x.entries} == {-entry for entry in y.entries}
        for a, b in zip(preferred, plain, strict=True)
        for x, y in zip(a.table.loops, b.table.loops, strict=True)
    )
    check = exhibited(same, "step 3 finds the faces of Figs. 14 and 23 from any other edge")
    return check.unless(
        reversed_loops == 3, "the step as printed, which runs three of the twelve printed loops the other way"
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
    """Check that step 9 of the loop algorithm, as printed, needs a limit of searches: it never ends on a pentagon."""
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
    """Check that the determinants of Fig. 18 are right with the index l, and 0 with the printed index i."""
    determinants = []
    for i, k, m in FIG_18:
        determinants.append((triple_product(i, k, i), triple_product(i, k, m)))
    with_i, with_l = (", ".join(map(str, column)) for column in zip(*determinants, strict=True))
    message = f"the determinants are {with_l} with l, and {with_i} with i as displayed"
    return slip(any(d[0] for d in determinants), [d[1] for d in determinants] == [1, -1, 1], "l", message)

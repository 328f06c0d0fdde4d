"""Checks of single steps of Appel and Will: new and collinear lines, the star test, loops, and inside corners."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations, permutations
from random import Random

from modern.claims.appel_will.convexity import RINGS, Flat, area, holds_origin
from modern.claims.evidence import Check, Generator, claim, exhibited, search, slip
from modern.claims.hulls import exact_hull
from modern.claims.invariants import corrected_print, is_closed_loop, numbers_in
from modern.claims.published import PAPERS, results_of
from modern.claims.sampled_sets import Point, counterexample_points
from modern.papers.appel_will import appel_will, printed
from modern.papers.appel_will.corners import triple_product
from modern.papers.appel_will.star import as_corrected, as_printed, on_one_ray, star_polygon, vorticity


def fig_18() -> list[tuple[Point, Point, Point, int]]:
    """Return the printed vectors I, K and L (the columns) and the printed value of [512], [723] and [643]."""
    rows = [numbers_in(line.partition("=")[2]) for line in corrected_print("appel-will")["fig18"][::2]]
    return [((a, b, c), (d, e, f), (g, h, i), value) for a, d, g, b, e, h, c, f, i, value in rows]


def _turns(ring: Sequence[Flat]) -> list[int]:
    return [area(ring[k - 2], ring[k - 1], ring[k]) for k in range(len(ring))]


# Two collinear sides make one side of the hull, which is no new line.
NONCONVEX: Generator[tuple[Flat, ...]] = replace(
    RINGS,
    name=f"{RINGS.name}, not convex and without angles of 180 degrees",
    accepts=lambda ring: RINGS.accepts(ring) and min(_turns(ring)) < 0 and 0 not in _turns(ring),
)


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

    message = "a change of sense occurs only at points outside the star polygon, and these are outside its hull"
    return search(IMAGES, is_right, cases, message)


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


@claim("appel-will.111")
def fourth_loop() -> Check:
    """Check that the fourth loop of Fig. 22 is closed only if its last entry has a minus sign."""
    lines = {label: (start, end) for label, start, end in map(numbers_in, corrected_print("appel-will")["fig14"])}
    (result,) = (result for result in results_of(PAPERS[0]) if result.id == "fig22-loops-4-5")
    as_printed, corrected = (numbers_in(text.split("\t")[1]) for text in (result.printed[0], result.corrected[0]))
    reading = " ".join(map(str, corrected))
    message = f"the loop {' '.join(map(str, as_printed))} of the lines of Fig. 14 is not closed, but {reading} is"
    return slip(is_closed_loop(as_printed, lines), is_closed_loop(corrected, lines), reading, message)


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


@claim("appel-will.159")
def product_with_repeated_vector() -> Check:
    """Check that the determinants of Fig. 18 are right with the index l, and 0 with the printed index i."""
    determinants = [(triple_product(i, k, i), triple_product(i, k, m), value) for i, k, m, value in fig_18()]
    with_i, with_l, printed_values = zip(*determinants, strict=True)
    shown_i, shown_l = (", ".join(map(str, values)) for values in (with_i, with_l))
    message = f"the determinants are {shown_l} with l, and {shown_i} with i as displayed"
    return slip(any(with_i), with_l == printed_values, "l", message)

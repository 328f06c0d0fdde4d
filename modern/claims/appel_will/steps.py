"""Checks of steps of Appel and Will: new and collinear lines, star test, loops, inside corners (reentrant edges)."""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from itertools import combinations, permutations

from modern.claims.appel_will.convexity import RINGS, Flat, draw_points, holds_origin, turns
from modern.claims.evidence import Check, Generator, claim, exhibited, search, slip
from modern.claims.hulls import exact_hull
from modern.claims.invariants import corrected_print, is_closed_loop, numbers_in
from modern.claims.published import PAPERS, results_of
from modern.claims.sampled_sets import counterexample_points
from modern.geometry.mesh import sides
from modern.papers.appel_will import appel_will, printed
from modern.papers.appel_will.corners import triple_product
from modern.papers.appel_will.star import as_corrected, as_printed, on_one_ray, star_polygon, vorticity

# Two collinear sides make one side of the hull, which is no new line.
NONCONVEX: Generator[tuple[Flat, ...]] = replace(
    RINGS,
    name=f"{RINGS.name}, not convex and without angles of 180 degrees",
    accepts=lambda ring: RINGS.accepts(ring) and min(turns(ring)) < 0 and 0 not in turns(ring),
)


@claim("appel-will.128", full=5_000)
def new_lines(cases: int = 10) -> Check:
    def is_changed(ring: Sequence[Flat]) -> bool:
        polygon = exact_hull([(x, y, 0) for x, y in ring]).polygon
        lines, edges = ({*map(frozenset, sides(corners))} for corners in (range(len(ring)), polygon))
        return len(polygon) < len(ring) and not edges <= lines

    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    check = search(NONCONVEX, is_changed, cases, "the hull of each polygon has fewer points and a new line")
    return check.unless(not is_changed(square), "a square, which is its own hull")


IMAGES: Generator[tuple[Flat, ...]] = Generator(
    "3 to 5 images with coordinates from -4 to 4, none at the origin",
    12,
    partial(draw_points, count=(3, 5), coordinates=(-4, 4)),
    lambda images: len({*images}) == len(images) > 2 and (0, 0) not in images,
)


@claim("appel-will.131", full=5_000)
def star_test(cases: int = 20) -> Check:
    def is_right(images: tuple[Flat, ...]) -> bool:
        # The test as printed must give the same result as the corrected one if no two images are on one ray.
        is_outside = as_corrected(images)
        on_ray = any(on_one_ray(a, b) for a, b in combinations(images, 2))
        return is_outside != holds_origin(images) and (on_ray or as_printed(images) == is_outside)

    return search(IMAGES, is_right, cases, "the senses of rotation tell whether the point is in the hull of each set")


@claim("appel-will.55", "appel-will.58", full=5_000)
def change_of_sense(cases: int = 20) -> Check:
    def is_right(images: tuple[Flat, ...]) -> bool:
        star = [*sides(star_polygon(images))]
        senses = [vorticity(a, b) for a, b in star]
        # The point is outside if it is on no side, and a ray from it crosses an even number of sides.
        crossings = [(a[1] > 0) != (b[1] > 0) and vorticity(a, b) * (b[1] - a[1]) > 0 for a, b in star]
        on_side = any(not vorticity(a, b) and not on_one_ray(a, b) for a, b in star)
        is_outside = not on_side and sum(crossings) % 2 == 0
        return not holds_origin(images) if is_outside else min(senses) >= 0 or max(senses) <= 0

    message = "a change of sense occurs only at points outside the star polygon, and these are outside its hull"
    return search(IMAGES, is_right, cases, message)


@claim("appel-will.119", full=1_000)
def order_on_one_ray(cases: int = 10) -> Check:
    def is_listed_order(images: tuple[Flat, ...]) -> bool:
        near, far = images[0], (2 * images[0][0], 2 * images[0][1])
        rest = [image for image in images if image not in (near, far)]
        orders = [[near, far], [far, near]]
        return all([p for p in star_polygon([*order, *rest]) if p not in rest] == order for order in orders)

    return search(IMAGES, is_listed_order, cases, "an image and one twice as far can be in either order by angle")


@claim("appel-will.60", full=1_000)
def opposite_images(cases: int = 10) -> Check:
    def is_inside(images: tuple[Flat, ...]) -> bool:
        opposite = (*images[:3], (-images[0][0], -images[0][1]))
        return holds_origin(opposite) and not any(as_corrected([*order]) for order in permutations(opposite))

    message = "C is in the hull of three images and one opposite to the first, and the test finds this in any order"
    return search(IMAGES, is_inside, cases, message)


@claim("appel-will.111")
def fourth_loop() -> Check:
    lines = {label: (start, end) for label, start, end in map(numbers_in, corrected_print("appel-will")["fig14"])}
    (result,) = (result for result in results_of(PAPERS[0]) if result.id == "fig22-loops-4-5")
    as_printed, corrected = (numbers_in(text.split("\t")[1]) for text in (result.printed[0], result.corrected[0]))
    reading = " ".join(map(str, corrected))
    message = f"the loop {' '.join(map(str, as_printed))} of the lines of Fig. 14 is not closed, but {reading} is"
    return slip(is_closed_loop(as_printed, lines), is_closed_loop(corrected, lines), reading, message)


@claim("appel-will.148")
def limit_of_searches() -> Check:
    points = counterexample_points("pentagon.csv")
    hull = appel_will(points, method=printed("step9", "step3"))
    ring = exact_hull(points).polygon
    endless = sum(_comes_again(hull.edges, ring[k - 2], ring[k - 1], ring[k]) for k in range(len(ring)))
    message = f"{endless} of {len(ring)} searches in a pentagon never end; with a limit: {hull.fault}"
    return exhibited(endless > 0 and hull.fault.endswith("does not return to its start"), message)


def _comes_again(edges: Sequence[tuple[int, int]], start: int, common: int, match: int) -> bool:
    visited: set[int] = set()
    while match != start and match not in visited:
        visited.add(match)
        line = next(edge for edge in edges if match in edge and common not in edge)
        match = sum(line) - match
    return match != start


@claim("appel-will.159")
def product_with_repeated_vector() -> Check:
    # The columns of each printed determinant are the vectors I, K and L. Its value follows.
    rows = [numbers_in(line.partition("=")[2]) for line in corrected_print("appel-will")["fig18"][::2]]
    with_i = [triple_product((a, b, c), (d, e, f), (a, b, c)) for a, d, _, b, e, _, c, f, _, _ in rows]
    with_l = [triple_product((a, b, c), (d, e, f), (g, h, i)) for a, d, g, b, e, h, c, f, i, _ in rows]
    shown_i, shown_l = (", ".join(map(str, values)) for values in (with_i, with_l))
    message = f"the determinants are {shown_l} with l, and {shown_i} with i as displayed"
    return slip(any(with_i), with_l == [row[-1] for row in rows], "l", message)

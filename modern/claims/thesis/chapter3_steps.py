"""Checks of the steps of chapter 3: the first points, inside points, new planes and boundary points."""

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import combinations, permutations
from math import prod
from operator import ne
from typing import Any

from modern.claims.evidence import Check, Generator, claim, proved, refuted, searched, slip
from modern.claims.hulls import convex_hull, exact_hull
from modern.claims.sampled_sets import (
    BOTH,
    CASES,
    SETS,
    Approximation,
    SampledSet,
    counterexample_points,
    flat_and_spatial_sets,
    plane_through,
    plane_value,
    reduced_plane,
    sampled_sets,
)
from modern.claims.thesis.chapter3_equations import plane_as_printed
from modern.claims.thesis.chapter3_stages import in_tetrahedron, stage_property
from modern.geometry.vectors import cross, dot, minus


def all_hold(generator: Generator[Any], cases: int, outcomes: Iterable[object], message: str) -> Check:
    """Return the check that all outcomes are true; its message starts with the numbers of true and of all outcomes."""
    checks = list(outcomes)
    return searched(generator, cases, checks, f"{sum(map(bool, checks))} of {len(checks)} {message}")


@claim("thesis.49", "thesis.53", "thesis.138", full=400)
def third_point(cases: int = CASES) -> Check:
    checks = []
    for sampled in flat_and_spatial_sets(cases):
        p, q, r = (sampled.points[k] for k in sampled.hull.history[0].added[:3])
        areas = [cross(minus(q, p), minus(x, p)) for x in (r, *sampled.points)]
        checks.append(dot(areas[0], areas[0]) == max(dot(area, area) for area in areas))
    message = "sets show: no point is farther from the line through the first two points than the third point"
    return all_hold(BOTH, 2 * cases, checks, message)


@claim("thesis.59", full=300)
def members_by_signs(cases: int = 1) -> Check:
    checks, members = [], []
    for sampled in flat_and_spatial_sets(cases):
        # By Caratheodory's theorem, the combinations of points in space are those of the corners of a tetrahedron.  A
        # point outside the plane of a flat set makes a tetrahedron of each triangle.
        x, y, z = sampled.points[0]
        apex = [(x, y, z + 1)] if sampled.flat else []
        bodies = [[*some, *apex] for some in combinations(sampled.points, 4 - len(apex))]
        bodies = [body for body in bodies if plane_value(plane_through(*body[:3]), body[3])]
        for p, q, r in zip(sampled.points, sampled.points[1:], sampled.points[2:], strict=False):
            # The fourth corner of a parallelogram is in the plane of a flat set.
            x, y, z = (a + b - c for a, b, c in zip(p, q, r, strict=True))
            members.append(any(in_tetrahedron((x, y, z), body) for body in bodies))
            checks.append(members[-1] == all(plane_value(f.plane, (x, y, z)) <= 0 for f in sampled.judge.facets))
    message = f"points, {sum(members)} of them in the hull, are convex combinations exactly if no equation is positive"
    return all_hold(BOTH, 2 * cases, checks, message)


@claim("thesis.213", "thesis.58", full=300)
def classification_by_signs(cases: int = CASES) -> Check:
    checks = []
    some_boundary = bool(exact_hull([(0, 0, 0), (2, 0, 0), (1, 0, 0), (0, 2, 0)]).boundary)
    for sampled in flat_and_spatial_sets(cases):
        for k, point in enumerate(sampled.points):
            largest = max(plane_value(facet.plane, point) for facet in sampled.judge.facets)
            checks.append(largest <= 0 and (largest == 0) == (k not in sampled.judge.inside))
    message = f"at {len(checks)} points of sets, no equation of the hull is positive, and one or more are 0 exactly if "
    message += "the point is not inside the hull; the midpoint of a side is a boundary point and no vertex"
    return searched(BOTH, 2 * cases, [*checks, some_boundary], message)


@claim("thesis.61", "thesis.64", "thesis.88", full=300)
def mean_of_first_hull(cases: int = CASES) -> Check:
    right, negative = [], []
    for sampled in flat_and_spatial_sets(cases):
        first = sampled.stages()[0]
        judge = exact_hull([sampled.points[k] for k in first.vertices])
        right.append({reduced_plane(plane) for plane in first.equations} == {f.plane for f in judge.facets})
        # The sum of the values at the vertices has the sign of the value at their mean.
        negative += [sum(plane_value(f.plane, sampled.points[k]) for k in first.vertices) < 0 for f in judge.facets]
    message = f"{sum(right)} of {len(right)} first hulls H_1 have the equations of the exact hull, and "
    message += f"{sum(negative)} of their {len(negative)} equations are negative at the inside point C"
    return searched(BOTH, 2 * cases, [*right, *negative], message)


@claim("thesis.67")
def outside_convention() -> Check:
    ((x, _, _),) = counterexample_points("both_sides.csv")
    inside, positive = [value < 0 for value in (x, -x)], [value > 0 for value in (x, -x)]
    # Each of the two points, on opposite sides of the line, must be either inside or outside.
    as_printed, as_corrected = (all(map(ne, inside, outside)) for outside in (inside, positive))
    message = f"as printed, the point x = {x} is both an inside and an outside point with respect to the line x = 0"
    return slip(as_printed, as_corrected, "a positive value at an outside point", message)


def between_by_distances() -> Check:
    """Prove that sums of distances tell which of three collinear points lies between the others.

    A position a u + b v on the line is written as (a, b); u and v are the distances between neighbouring points.
    """
    steps = []
    for mm, nn, i in permutations(((0, 0), (1, 0), (1, 1))):
        # Page 27: D_1 is the distance between MM and NN, D_2 that between MM and P_i, D_3 that between NN and P_i.
        d1, d2, d3 = ([abs(p - q) for p, q in zip(*ends, strict=True)] for ends in ((mm, nn), (mm, i), (nn, i)))
        first, second = ([a + b - c for a, b, c in zip(d1, *ds, strict=True)] for ds in ((d2, d3), (d3, d2)))
        # Neither sum has amounts of both signs, so it is 0 for positive u and v only if both amounts are 0.
        decided = all(min(amounts) * max(amounts) >= 0 for amounts in (first, second))
        between = mm if not any(first) else nn if not any(second) else i
        steps.append(decided and between == (1, 0))
    argument = "In each of the six orders, D_1 + D_2 - D_3 and D_1 - D_2 + D_3 are 0, 2 u or 2 v. Here u and v are the "
    argument += "distances of the middle point from the others, which are positive because the points are distinct"
    return proved(argument, steps, "sums of distances tell which of three collinear points is between the others")


@claim("thesis.87")
def fourth_point_by_largest() -> Check:
    points = counterexample_points("negative_side.csv")
    values = [plane_value(plane_as_printed(*points[:3]), point) for point in points]
    text, listing = convex_hull(points, text=True, on_refusal="return"), convex_hull(points)
    wrong = max(values) == 0 and not text.determined and listing.determined
    message = f"the plane's equation has the values {', '.join(map(str, values))} at the points, so that points in the "
    return refuted(wrong, f"{message}plane have the largest value; the listing finds the hull")


@claim("thesis.225", full=300)
def vertices_of_first_hull(cases: int = CASES) -> Check:
    of_text = fourth_point_by_largest()
    return stage_property("counts", cases).unless(not of_text.holds, f"the rule of page 29: {of_text.message}")


@claim("thesis.89", "thesis.94", full=300)
def new_planes(cases: int = CASES) -> Check:
    checks, named = [], dict[frozenset[int], tuple[int, ...]]()
    for _, before, after, visible in _visible(cases):
        named = {frozenset(d): d for d in combinations(before.vertices, 3)} if len(before.vertices) == 4 else named
        replaced = [named.pop(frozenset(before.defining[k]), ()) for k in visible]
        # Page 32 names MM, NN or KK of a plane in their order, and then the new point. Page 33 eliminates equal names.
        made = Counter((*two, after.vertices[-1]) for names in replaced for two in combinations(names, 2))
        named |= {frozenset(names): names for names, count in made.items() if count == 1}
        checks.append({*named} == {frozenset(defining) for defining in after.defining})
    message = "hulls have the planes of the rule: the new point and the sides of each replaced plane give three, and "
    return all_hold(SETS[3], cases, checks, f"{message}two that name the same points in the same order are eliminated")


@claim("thesis.97", full=300)
def planes_at_common_edge(cases: int = CASES) -> Check:
    checks = []
    for sampled, before, after, i, m, edge in _with_common_edge(cases):
        plane = plane_through(*(sampled.points[k] for k in (*edge, after.vertices[-1])))
        thirds = [sampled.points[k] for replaced in (i, m) for k in {*before.defining[replaced]} - edge]
        checks.append(prod(plane_value(plane, third) for third in thirds) < 0)
    return all_hold(SETS[3], cases, checks, "pairs of planes have third points on opposite sides of the new plane")


def _visible(cases: int) -> Iterator[tuple[SampledSet, Approximation, Approximation, list[int]]]:
    """Yield each set with two successive hulls and the numbers of the planes that the added point is outside of."""
    for sampled in sampled_sets(3, cases):
        for before, after in zip(sampled.stages(), sampled.stages()[1:], strict=False):
            point = sampled.points[after.vertices[-1]]
            yield sampled, before, after, [k for k, p in enumerate(before.equations) if plane_value(p, point) > 0]


def _with_common_edge(cases: int) -> Iterator[tuple[SampledSet, Approximation, Approximation, int, int, set[int]]]:
    """Yield each set with two successive hulls, the numbers of two planes as in ``_visible``, and their common edge."""
    for sampled, before, after, visible in _visible(cases):
        for i, m in combinations(visible, 2):
            edge = {*before.defining[i]} & {*before.defining[m]}
            if len(edge) == 2:
                yield sampled, before, after, i, m, edge


@claim("thesis.199")
def planes_i_and_m() -> Check:
    with_j = []
    for sampled, before, _, i, _, _ in _with_common_edge(CASES):
        j = sampled.stages().index(before)
        with_j.append(len({*before.defining[i]} & {*before.defining[j]}) == 2)
    message = f"{len(with_j)} pairs of planes i and m have two common points; of as many pairs of planes i and j, "
    message += f"with j the index of the hull H_j, {sum(with_j)} have"
    return slip(all(with_j), planes_at_common_edge().holds, "the indices i and m", message)


@claim("thesis.98", full=300)
def planes_of_same_points(cases: int = CASES) -> Check:
    check = new_planes(cases)
    return replace(check, message=f"{check.message}; the rule would miss {orders_of_program_3(cases)}")


def orders_of_program_3(cases: int = CASES) -> str:
    pairs = []
    for _, before, _, i, m, edge in _with_common_edge(cases):
        # In program 3, the new point takes the place of the point of the replaced plane that is not on the edge.
        first, second = (tuple(k if k in edge else None for k in before.defining[plane]) for plane in (i, m))
        pairs.append(first == second)
    differ = f"{pairs.count(False)} of {len(pairs)}"
    return f"{differ} pairs of equal planes, whose points program 3 names in different orders"


# A fourth point is necessary to follow the text (thesis.87).
WITH_FOURTH_POINT = replace(
    SETS[3],
    name=f"{SETS[3].name}, for which the rule of page 29 finds a fourth point",
    accepts=lambda p: SETS[3].accepts(p) and convex_hull(p, text=True, on_refusal="return").determined,
)


@claim("thesis.95", full=300)
def order_of_replacement(cases: int = CASES) -> Check:
    outcomes, reordered = [], 0
    for points in WITH_FOURTH_POINT.cases(cases):
        hulls = convex_hull(points, text=True), convex_hull(points)
        text, listing = ([f.lowest for f in hull.faces] for hull in hulls)
        outcomes.append(sorted(text) == sorted(listing) == sorted(f.plane for f in exact_hull(points).facets))
        reordered += text != listing
    message = f"text and listing give {sum(outcomes)} of {cases} sets the same planes, in another order for {reordered}"
    return searched(WITH_FOURTH_POINT, cases, [*outcomes, reordered], message)


@claim("thesis.96")
def without_constant_term() -> Check:
    *corners, middle = counterexample_points("without_d.csv")
    planes = [facet.plane for facet in exact_hull(corners).facets]
    values = [(dot(plane[:3], middle), plane_value(plane, middle)) for plane in planes]
    wrong = sum(without > 0 for without, _ in values)
    message = f"without D, {wrong} of {len(planes)} equations are positive at the cube's centre, and with D none is"
    return slip(not wrong, max(value for _, value in values) < 0, "a condition that includes D_g", message)

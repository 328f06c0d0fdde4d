"""Checks of chapters 1 and 3 as worded: steps of the text compared with the listings, and other ways to start."""

import re
from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise, product

from emulator.objectdeck.extent import code_positions
from modern.claims.evidence import Check, claim, exhibited, refuted, searched, slip
from modern.claims.hulls import convex_hull, exact_hull
from modern.claims.sampled_sets import (
    BOTH,
    CASES,
    Plane,
    Point,
    SampledSet,
    added_points,
    counterexample_points,
    flat_and_spatial_sets,
    plane_through,
    plane_value,
    reduced_plane,
)
from modern.claims.thesis import chapter3_steps as steps
from modern.claims.thesis.chapter2 import above
from modern.claims.thesis.chapter3_boundary import LATTICE_SETS, PYRAMID, on_line
from modern.claims.thesis.chapter3_equations import first_two_points
from modern.claims.thesis.chapter3_stages import stage_property
from modern.claims.thesis.chapter4_examples import EXTREMES_IN_A_PLANE
from modern.claims.thesis.chapter7 import construction
from modern.edition import programs
from modern.geometry.vectors import six_volumes
from modern.thesis.cards import read_hull

# Rules of the text for each stage of the construction, as named in ``chapter3_stages``.
_RULES_OF_STAGES = ("equations", "struck_inside", "accepted", "farthest_outside", "replaced_line", "renumbering")


@claim("thesis.267", full=100)
def text_against_listing(cases: int = CASES) -> Check:
    losing = (steps.fourth_point_by_largest(), line_duplicates_as_printed())
    same_result = (order_of_elimination(cases), steps.order_of_replacement(cases), plane_duplicates_as_printed(cases))
    rules = [step(cases) for step in (first_two_points, steps.third_point, steps.mean_of_first_hull, steps.new_planes)]
    rules += [stage_property(kind, cases) for kind in _RULES_OF_STAGES]
    # Other sets meet a fault of a program, which must be corrected (thesis.1).
    sets = [s for s in flat_and_spatial_sets(cases) if not convex_hull(s.points, "truncating").corrected]
    agree = [_punches_same_hull(sampled) for sampled in sets]
    alone = [len(construction(s.points[:3], programs.program).run.steps) == 1 for s in flat_and_spatial_sets(cases)]
    message = f"{sum(agree)} of {len(agree)} runs that meet no fault of the programs punch the hull that the port "
    message += f"finds by {len(rules)} rules of the text; {len(same_result)} steps that the text describes differently "
    message += "lead to the same hull"
    check = searched(BOTH, 2 * cases, [*agree, *(step.holds for step in (*rules, *same_result))], message)
    case = "two other steps, which lose the hull or a line; by three points, of which program 1 alone finds the hull; "
    case += f"and by {steps.orders_of_program_3()}"
    return check.unless(all(alone) and not any(step.holds for step in losing), case)


def _punches_same_hull(sampled: SampledSet) -> bool:
    """Return True if the programs punch the same points and equations as the port, in the same order."""
    hull = convex_hull(sampled.points, "truncating", history=True)
    cards = read_hull(construction(sampled.points, programs.program).run.final.result.punched)
    parts = [[(*map(Fraction, hull.points[k]),) for k in part] for part in (hull.vertices, hull.boundary, hull.inside)]
    equations = [(*map(Fraction, face.coefficients),) for face in hull.faces]
    punched = [*map(list, (cards.vertices, cards.boundary, cards.inside, cards.equations))]
    # The rules of the text are checked at the stages in exact arithmetic.
    return hull.history == sampled.hull.history and punched == [*parts, equations]


@claim("thesis.275", full=400)
def line_duplicates(cases: int = CASES) -> Check:
    sets = [*LATTICE_SETS[2].cases(cases)]
    left, numbers = zip(*(_lines_left(points, keep_last=True) for points in sets), strict=True)
    outcomes = [len(k) == len({*k}) == len(exact_hull(points).facets) for k, points in zip(left, sets, strict=True)]
    removed = sum(numbers)
    message = f"in {cases} sets, the rule leaves one equation of each line if it never removes the last equation of a "
    check = searched(LATTICE_SETS[2], cases, [*outcomes, removed], f"{message}line; equations removed: {removed}")
    lost = line_duplicates_as_printed()
    return check.unless(not lost.holds, f"the six points of line_lost.csv: {lost.message}")


def line_duplicates_as_printed() -> Check:
    points = counterexample_points("line_lost.csv")
    lines, all_lines = len({*_lines_left(points, keep_last=False)[0]}), len(exact_hull(points).facets)
    message = f"by the rule as worded, {lines} of {all_lines} lines remain; the listing keeps all of them"
    return refuted(lines < all_lines == len({face.lowest for face in convex_hull(points).faces}), message)


def _lines_left(points: Sequence[Point], keep_last: bool) -> tuple[list[frozenset[int]], int]:
    """Apply pages 26 to 28 as worded; return the lines of the equations that are left, and how many were removed."""
    hull = convex_hull(points, history=True)
    lines = {pair: frozenset(on_line(points, *pair)) for pair in hull.history[-1].equations}
    left, vertices = [*lines.values()], {*(used := added_points(hull))}
    for i, (pair, line) in product(used, [*lines.items()]):
        # If a third point satisfies an equation, this equation is eliminated, and so is the middle of the three points.
        if pair in lines and i in vertices and i not in pair and i in line:
            # Page 28 says to continue until one equation of each line remains.
            if left.count(line) > 1 or (not keep_last and len({*left}) < len(left)):
                left.remove(lines.pop(pair))
            vertices.discard(sorted((i, *pair), key=lambda k: points[k])[1])
    return left, len(hull.history[-1].equations) - len(left)


@claim("thesis.103", "thesis.276", full=300)
def plane_duplicates_as_printed(cases: int = CASES) -> Check:
    checks, differing, consecutive = [], 0, 0
    for points in (PYRAMID, *LATTICE_SETS[3].cases(cases)):
        hull = convex_hull(points, history=True)
        last = hull.history[-1].equations
        planes = [plane_through(*(points[k] for k in defining)) for defining in last]
        # Page 34 removes plane j if it contains the three points of a later plane i.
        keeps = [all(any(plane_value(p, points[k]) for k in i) for i in last[j:]) for j, p in enumerate(planes, 1)]
        kept_planes = [_unsigned(plane) for plane, keep in zip(planes, keeps, strict=True) if keep]
        consecutive += (False, False) in pairwise(keeps)
        checks.append(sorted(kept_planes) == sorted(_unsigned(facet.plane) for facet in exact_hull(points).facets))
        differing += kept_planes != [_unsigned(face.lowest) for face in hull.faces]
    message = f"for {sum(checks)} of {len(checks)} sets, one of them fixed, the rule keeps one equation of each plane, "
    message += f"for {differing} in another order than the listing; for {consecutive}, it removes successive equations"
    return searched(LATTICE_SETS[3], cases, [*checks, differing, consecutive], message)


def _unsigned(plane: Plane) -> Plane:
    a, b, c, d = reduced_plane(plane)
    return max((a, b, c, d), (-a, -b, -c, -d))


@claim("thesis.272")
def program3_against_program2() -> Check:
    two, three = (programs.deck(f"program{k}").text() for k in (2, 3))
    code = [code_positions(programs.program(f"program{k}")) for k in (2, 3)]
    passed = code[0] < code[1] and "ELIMINATING INSIDE PLANES" in three and "ELIMINATING INSIDE" not in two
    message = f"the code of program 2 takes about {code[0]} positions, that of program 3 about {code[1]}; only "
    return exhibited(passed, f"{message}program 3 eliminates inside planes")


@claim("thesis.269")
def consecutive_hulls() -> Check:
    numbers = [[stage.number for stage in sampled.hull.history] for sampled in flat_and_spatial_sets(CASES)]
    checks = [of_set == [*range(1, len(of_set) + 1)] for of_set in numbers]
    message = f"in {sum(checks)} of {len(checks)} sets H_2 is the first hull that has a predecessor"
    # As printed, j + 1 may be 1, and then H_0 is the hull before.
    return slip(any(0 in of_set for of_set in numbers), all(checks), "2 in place of 1", message)


@claim("thesis.219", "thesis.265", full=100)
def first_equation_tested(cases: int = CASES) -> Check:
    outcomes, numbers = [], []
    for sampled in flat_and_spatial_sets(cases):
        # The test of H_1 begins with equation 1.
        stopped = 1
        for (before, last), (step, netc) in pairwise(construction(sampled.points, programs.program).steps):
            outcomes.append(netc == {"EC": stopped, "CC": last + 1, "CG": last}.get(before + step, netc))
            numbers += [netc] if before + step == "EC" else []
            stopped = netc if step == "G" else stopped
    later = sum(number > 1 for number in numbers)
    message = "the tests of a hull begin with equation 1 for H_1, else with the one at which those of the hull before "
    message += f"stopped ({later} of {len(numbers)} times not equation 1); then the next is tested, or a point is added"
    return searched(BOTH, 2 * cases, [*outcomes, later], message)


@claim("thesis.286", full=100)
def order_of_elimination(cases: int = CASES) -> Check:
    in_order, hulls, untested = [], 0, 0
    for sampled in flat_and_spatial_sets(cases):
        steps = "".join(step for step, _ in construction(sampled.points, programs.program).steps)
        # The last hull is not tested if no point remains, and a run can end with an error after a new point.
        in_order.append(re.fullmatch("(EC+G)*(EC*)?", steps))
        hulls += steps.count("E")
        untested += steps[-1:] == "E"
    message = f"in {len(in_order)} runs, inside points are eliminated before each test of a hull; not tested: "
    message += f"{untested} of {hulls} hulls, at which no points but vertices remain"
    return searched(BOTH, 2 * cases, [*in_order, hulls > len(in_order)], message)


@claim("thesis.39", full=200)
def first_hull_against_extremes(cases: int = CASES) -> Check:
    within, fewer = [], []
    for sampled in flat_and_spatial_sets(cases):
        # Flat hulls are compared by cones with one apex, which have one more plane and volumes in proportion to areas.
        apex = [above(sampled, sampled.points[0])] if sampled.flat else []
        first, six_extremes = _volumes_and_planes(sampled.points, apex)
        fewer.append(first[1] <= six_extremes[1] or not six_extremes[1])
        if {sampled.points[k] for k in sampled.hull.history[0].added} <= {*_extreme_points(sampled.points)}:
            within.append(six_extremes[0] - first[0])
    flat = [_volumes_and_planes(p) for p in (*EXTREMES_IN_A_PLANE, ((1, 1, 1), (0, 1, 1), (1, 0, 1), (1, 0, 0)))]
    first, six_extremes = _volumes_and_planes(counterexample_points("first_hull.csv"))
    passed = [volume >= 0 for volume in within] + [any(within), *fewer]
    larger = all(own[0] > of_six[0] == 0 for own, of_six in flat) and first[0] > six_extremes[0] > 0
    own, of_six = _volumes_and_planes(((0, 1, 1), (3, 2, 1), (1, 3, 0), (2, 0, 3)))
    says = f"{len(within)} of {len(fewer)} hulls H_1 use only the six extreme points, and are not larger than their "
    says += "hull; no H_1 has more planes or lines than that hull, unless this one has no volume or area"
    case = f"a set for which H_1 has the volume {first[0]}/6, and the hull of the extreme points {six_extremes[0]}/6"
    case += f"; and by a tetrahedron, for which both have the volume {own[0]}/6 and {own[1]} planes"
    return searched(BOTH, 2 * cases, passed, says).unless(larger and own == of_six and own[0], case)


def _volumes_and_planes(points: Sequence[Point], apex: Sequence[Point] = ()) -> tuple[tuple[int, int], tuple[int, int]]:
    """Return six times the volume and the number of planes of H_1, then of the six points' hull, each with the apex."""
    first = [points[k] for k in convex_hull(points, history=True).history[0].added]
    measures = []
    for body in ([*first, *apex], [*_extreme_points(points), *apex]):
        judge = exact_hull(body)
        faces = [facet.polygon for facet in judge.facets] if judge.dimension == 3 else []
        measures.append((six_volumes(body, faces), len(faces)))
    return measures[0], measures[1]


def _extreme_points(points: Sequence[Point]) -> list[Point]:
    """Return the extreme points of a set: of several equal ones the last, as in program 1 (statements 134 to 146)."""
    extreme = {choose(reversed(points), key=lambda p, k=k: p[k]) for choose in (min, max) for k in range(3)}  # type: ignore[misc]
    return [point for point in points if point in extreme]

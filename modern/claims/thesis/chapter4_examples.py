"""Checks of the worked examples of chapter 4: each equation and claim, and the programs' hulls of their point sets.

The claims are computed exactly from the printed points. The programs read the points from cards, on which each number
is truncated to eight digits.
"""

import re
from collections.abc import Callable, Mapping, Sequence
from decimal import ROUND_DOWN, Context
from fractions import Fraction
from functools import cache
from itertools import product

from emulator.machine.result import Options
from modern.claims.evidence import Check, claim, exhibited, slip
from modern.claims.hulls import convex_hull, exact_hull
from modern.claims.sampled_sets import added_points, counterexample_points
from modern.comparison.difference import disagreement
from modern.comparison.outcome import Vector, from_cards, from_judge
from modern.edition import chapter4, programs
from modern.edition.apparatus import build
from modern.edition.chapter4 import THEOREMS, Point, Theorem, load_text, load_theorems, printed_point, theorem_faults
from modern.formats.deck import data_deck
from modern.geometry.hull import NOT_ACCEPTABLE
from modern.geometry.vectors import independent
from modern.thesis.cards import scaled
from modern.thesis.job import Load, run_hull

_NUMBERS = {"six": 6, "nine": 9}
# A number on a card has eight significant digits; further digits are truncated.
_CARD = Context(prec=8, rounding=ROUND_DOWN)


def theorem_of(name: str) -> Theorem:
    """Return a theorem of chapter 4 that has a worked example. Raise KeyError for any other."""
    return {theorem.id: theorem for theorem in load_theorems()}[name]


def worked_example_checks(theorem: Theorem, load: Load = programs.program) -> Mapping[str, Check]:
    """Run all checks of a worked example; return them by function name. ``load`` returns a program by its name."""
    checks: list[Callable[[Theorem], Check]] = [_points, _equations, *([_signs] if theorem.signs else [])]
    checks += {
        "4.1": [_outside_plane, _lost_point],
        "4.2": [_not_supporting],
        "4.8": [_growing, _supporting, _last_outside],
    }[theorem.id]
    results = {function.__name__.lstrip("_"): function(theorem) for function in checks}
    return results | {"programs": _programs(theorem, load)}


@cache
def computed_checks(theorem: str) -> Mapping[str, Check]:
    return worked_example_checks(theorem_of(theorem))


@claim("thesis.111", theorem="4.1", claim="points")
@claim("thesis.118", theorem="4.2", claim="points")
@claim("thesis.152", theorem="4.8", claim="points")
@claim("thesis.233", theorem="4.1", claim="outside_plane")
@claim("thesis.109", "thesis.110", theorem="4.1", claim="lost_point")
@claim("thesis.112", theorem="4.2", claim="not_supporting")
@claim("thesis.146", "thesis.151", theorem="4.8", claim="last_outside")
@claim("thesis.111", theorem="4.1", claim="programs")
@claim("thesis.109", "thesis.110", theorem="4.1", claim="equations")
@claim("thesis.118", theorem="4.2", claim="programs")
@claim("thesis.115", theorem="4.2", claim="equations")
@claim("thesis.116", theorem="4.2", claim="signs")
@claim("thesis.152", theorem="4.8", claim="programs")
@claim("thesis.147", theorem="4.8", claim="growing")
@claim("thesis.150", theorem="4.8", claim="supporting")
@claim("thesis.149", theorem="4.8", claim="equations")
@claim("thesis.151", theorem="4.8", claim="signs")
def worked_example(theorem: str, claim: str) -> Check:
    return computed_checks(theorem)[claim]


# Each set in space has three to six distinct extreme points, all in one plane; its last point is not in this plane.
EXTREMES_IN_A_PLANE: tuple[tuple[tuple[int, int, int], ...], ...] = (
    ((0, 3, 3), (2, 4, 2), (4, 1, -3), (1, 2, -2)),
    ((0, 2, -2), (3, 0, -3), (4, 2, -6), (1, 4, -5), (1, 1, -5)),
    ((1, 0, 2), (0, 3, -6), (2, 4, -4), (4, 3, 2), (3, 1, 4), (1, 1, -5)),
    ((0, 1, -1), (3, 1, 2), (4, 3, 1), (3, 4, -1), (1, 3, -2), (1, 0, 1), (1, 1, -1)),
)


def _points(theorem: Theorem) -> Check:
    texts = [m[1] for line in build(load_text()) if (m := re.search(r"the following set of (\w+) points", line.text))]
    number = texts[THEOREMS.index(theorem.id)]
    known = {point.name: point.at for point in theorem.points}
    # A point that the OCR lost counts if the text names it as an extreme point.
    names = known.keys() | ({*theorem.lost} & {*theorem.extremes.values()})
    first = theorem.points[0].name[0]
    is_complete = names == {f"{first}{k}" for k in range(1, _NUMBERS[number] + 1)}
    is_spatial = exact_hull(known.values()).dimension == len("xyz")
    lost = f", and names {', '.join(theorem.lost)}, which the OCR lost" if theorem.lost else ""
    message = f"the text states {number} points and prints coordinates of {len(known)} different ones{lost}"
    return exhibited(is_complete and is_spatial and len({*known.values()}) == len(known), message)


def _equations(theorem: Theorem) -> Check:
    faults = theorem_faults(theorem, load_text())
    message = f"theorem {theorem.id}: {theorem.points_stated} points; each equation is 0 at the points named for it"
    message += ", and the text names the right extreme points" if theorem.extremes else ""
    return exhibited(not faults, faults[0] if faults else message)


def _signs(theorem: Theorem) -> Check:
    right = sum(theorem.plane(n).at(_point(theorem, p)) * int(f"{sign}1") > 0 for n, p, sign in theorem.signs)
    return exhibited(right == len(theorem.signs), f"{right} of {len(theorem.signs)} values have the signs of the text")


def _point(theorem: Theorem, name: str) -> Point:
    point = theorem.point(name)
    assert point is not None
    return point


def lost_candidates(theorem: Theorem) -> list[Vector]:
    """Return the possible values of the lost point P3 of theorem 4.1.

    They are the points of its plane that have integer coordinates, the largest y, and no x or z beyond other points.
    """
    (plane,) = theorem.planes
    known = [point.at for point in theorem.points]
    low, high = ([choose(p[k] for p in known) for k in range(3)] for choose in (min, max))
    candidates: list[Vector] = []
    for x, z in product(range(int(low[0]), int(high[0]) + 1), range(int(low[2]), int(high[2]) + 1)):
        a, b, c, d = plane.coefficients
        y = -(a * x + c * z + d) / b
        point = (Fraction(x), y, Fraction(z))
        if y.denominator == 1 and y >= high[1] and point not in known:
            candidates.append(point)
    return candidates


def _outside_plane(theorem: Theorem) -> Check:
    values = {name: theorem.planes[0].at(_point(theorem, name)) for name in theorem.outside_plane}
    message = ", ".join(f"{value} at {name}" for name, value in values.items())
    return exhibited(values and all(values.values()), f"the value of the equation is {message}")


def _lost_point(theorem: Theorem) -> Check:
    candidates = lost_candidates(theorem)
    points = [point.at for point in theorem.points]
    nonplanar = [len(independent([*points, candidate])) == 4 for candidate in candidates]  # type: ignore[list-item]
    message = f"{len(candidates)} points with integer coordinates can be the lost P3; with each, the nine points are "
    return exhibited(candidates and all(nonplanar), f"{message}not coplanar")


def _faces(points: Sequence[Vector]) -> set[Vector]:
    hull = exact_hull(points)
    return {scaled(tuple(Fraction(c) for c in hull.plane_of(facet)), True) for facet in hull.facets}


def _not_supporting(theorem: Theorem) -> Check:
    faces = _faces([point.at for point in theorem.points])
    table = [scaled(plane.coefficients, True) for plane in theorem.planes]
    inside = [number for number, plane in enumerate(table, 1) if plane in faces]
    message = f"the hull of the six points has the equations {', '.join(map(str, inside))} of Table 1 and "
    return exhibited(inside == [1, 2, 3, 4, 5, 6], f"{message}{len(faces) - len(inside)} others")


@cache
def points_of_h_5() -> tuple[str, ...]:
    """Return the names of the vertices of H_5, the fifth hull of the construction in theorem 4.8, as printed.

    The vertices of the first hull H_1 come first, then the point that each step adds.
    """
    (sentences,) = (line.text for line in build(load_text()) if "are the vertices of H_1" in line.text)
    names = {point.at: point.name for point in theorem_of("4.8").points}
    return tuple(names[printed_point(point)] for point in re.findall(r"\([^)]*\)", sentences))


def _growing(theorem: Theorem) -> Check:
    points = [_point(theorem, name).at for name in points_of_h_5()]
    vertices = [len(exact_hull(points[:n]).vertices) for n in range(4, 9)]
    return exhibited(vertices == [4, 5, 6, 7, 8], f"H_1 to H_5 have {', '.join(map(str, vertices))} vertices")


def _supporting(theorem: Theorem) -> Check:
    faces = _faces([_point(theorem, name).at for name in points_of_h_5()])
    table = {scaled(plane.coefficients, True) for plane in theorem.planes}
    message = f"{len(faces & table)} of the {len(table)} listed equations are, up to a factor, those of planes of H_5"
    return exhibited(faces == table, f"{message}; H_5 has {len(faces)} planes")


def _last_outside(theorem: Theorem) -> Check:
    points = [_point(theorem, name).at for name in points_of_h_5()]
    outside = [plane.number for plane in theorem.planes if plane.at(_point(theorem, "Q9")) > 0]
    passed = outside == [3, 4, 5, 6, 7, 8] and _point(theorem, "Q9").at not in points
    return exhibited(passed, f"the last point is outside the planes {', '.join(map(str, outside))}")


def _programs(theorem: Theorem, load: Load) -> Check:
    truncated_points = [[_CARD.divide(x.numerator, x.denominator) for x in point.at] for point in theorem.points]
    points: list[Vector] = [tuple(map(Fraction, point)) for point in truncated_points]
    deck = data_deck([list(map(str, point)) for point in truncated_points], "theorem")
    is_exact = all(card_point == point.at for card_point, point in zip(points, theorem.points, strict=True))
    judge = from_judge(exact_hull(points), points)
    outcome = from_cards("listing", run_hull(deck, load, Options(limit=200_000)), points)
    agrees = outcome.determined and disagreement(outcome, judge, points).agrees
    description = "the printed points" if is_exact else "the truncated points"
    missing = f", without {', '.join(theorem.lost)}" if theorem.lost else ""
    sizes = [f"{len(hull.vertices)} vertices, {len(hull.equations)} planes" for hull in (outcome, judge)]
    verdict = f"the programs find {sizes[0]}, {'like' if agrees else 'unlike'} the exact hull"
    if not outcome.determined:
        verdict = f"the programs end with {outcome.status}; the exact hull has {sizes[1]}"
    # If the cards truncate coordinates, the listing must reject the points.
    passed = agrees if is_exact else outcome.status == NOT_ACCEPTABLE
    return exhibited(passed, f"for {description}{missing}, {verdict}")


@claim("thesis.245")
def procedure_of_4_8() -> Check:
    theorem = theorem_of("4.8")
    points = [point.at for point in theorem.points]
    hull = convex_hull(points, history=True)
    used = [theorem.points[k].name for k in added_points(hull)]
    same = [set(used[:n]) == set(points_of_h_5()[:n]) for n in range(4, 9)]
    as_worded = convex_hull(points, text=True, on_refusal="return")
    farthest = []
    for n, name in enumerate(points_of_h_5()[4:], 4):
        judge = exact_hull(_point(theorem, before).at for before in points_of_h_5()[:n])
        planes = [chapter4.Plane(0, tuple(map(Fraction, judge.plane_of(facet))), (), "", "") for facet in judge.facets]
        largest = [(plane.at(_point(theorem, name)), max(map(plane.at, theorem.points))) for plane in planes]
        farthest.append(any(0 < value == most for value, most in largest))
    right = same[0] and same[1] and same[4] and used[8:] == ["Q9"] and hull.history[-1].outside == 6 and all(farthest)
    message = f"the procedure makes H_1, H_2 and H_5; {sum(farthest)} of the 4 points that the text adds are "
    message += "farthest from a plane of the hull before"
    others = not same[2] and not same[3] and not as_worded.determined
    case = "H_3 and H_4 of the procedure, which have other points, and by the rule of page 29, which makes no H_1"
    return exhibited(right, message).unless(others, case)


@claim("thesis.246", name="Q1", at=(-4, 4, 2))
@claim("thesis.247", name="Q6", at=(3, 4, 1))
def slips_of_4_8(name: str, at: tuple[int, int, int]) -> Check:
    """Check that the coordinates printed for a point are wrong in the list (Q1) or in the table (Q6)."""
    theorem = theorem_of("4.8")
    in_list, in_table = counterexample_points("slips_4_8.csv")
    printed = Point("", tuple(map(Fraction, in_list if name == "Q1" else in_table)), "", "")
    planes, point = [plane for plane in theorem.planes if name in plane.vertices], _point(theorem, name)
    nonzero = [plane.number for plane in planes if plane.at(printed)]
    numbers = ", ".join(map(str, nonzero))
    if name == "Q1":
        wrong = nonzero == [1, 2, 7]
        message = f"equations {numbers}, which name this point, are not 0 at {in_list}"
    else:
        wrong = nonzero == [1, 6] and printed.at not in [point.at for point in theorem.points]
        message = f"{in_table} is none of the nine points, and equations {numbers}, which name {at}, are not 0 there"
    right = point.at == tuple(map(Fraction, at)) and not any(plane.at(point) for plane in planes)
    return slip(not wrong, right, f"{at}", message)

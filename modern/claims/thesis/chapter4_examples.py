"""The worked examples of chapter 4 judged: every equation and every claim, and the point sets through the programs.

Each claim is computed anew from the points the thesis prints (transcripts/chapter4), exactly; the programs take
them as cards hold them, cut to eight digits.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from decimal import ROUND_DOWN, Context
from fractions import Fraction
from functools import cache
from itertools import product

from emulator.machine.result import Options
from modern.claims.register import CONDITION, HOLDS, CheckResult, counterexample, fails_if, holds_if
from modern.comparison.difference import disagreement
from modern.comparison.outcome import Outcome, Vector, from_cards, from_judge
from modern.edition import programs
from modern.edition.chapter4 import Point, Theorem, load_text, load_theorems, theorem_faults
from modern.exact_hull import exact_hull
from modern.formats.csv import points as csv_points
from modern.formats.deck import data_deck
from modern.geometry.hull import NOT_ACCEPTABLE
from modern.port import convex_hull
from modern.thesis.cards import scaled
from modern.thesis.job import Load, run_hull

_CARD = Context(prec=8, rounding=ROUND_DOWN)
"""What a card holds of a number: eight significant digits, the rest cut."""


def theorem_of(name: str) -> Theorem:
    """A theorem with a worked example.  Raises KeyError."""
    return {theorem.id: theorem for theorem in load_theorems()}[name]


def worked_example_checks(theorem: Theorem, load: Load = programs.program) -> Mapping[str, CheckResult]:
    """Every claim of a worked example, by the name of its function.  ``load`` gives the programs."""
    checks: list[Callable[[Theorem], CheckResult]] = [_equations, *([_signs] if theorem.signs else [])]
    checks += {"4.1": [_six_extremes], "4.2": [_not_supporting], "4.8": [_growing, _supporting, _last_outside]}[
        theorem.id
    ]
    results = {function.__name__.lstrip("_"): function(theorem) for function in checks}
    return results | {"programs": _programs(theorem, load)}


@cache
def _computed(theorem: str) -> Mapping[str, CheckResult]:
    return worked_example_checks(theorem_of(theorem))


def worked_example(theorem: str, claim: str, kind: str = "") -> CheckResult:
    """A claim of a worked example: ``4.1 six_extremes``, with a condition if ``kind`` is given.  Raises KeyError."""
    result = _computed(theorem)[claim]
    return replace(result, verdict=CONDITION) if kind and result.verdict == HOLDS else result


EXTREMES_IN_A_PLANE: tuple[tuple[tuple[int, int, int], ...], ...] = (
    ((0, 3, 3), (2, 4, 2), (4, 1, -3), (1, 2, -2)),
    ((0, 2, -2), (3, 0, -3), (4, 2, -6), (1, 4, -5), (1, 1, -5)),
    ((1, 0, 2), (0, 3, -6), (2, 4, -4), (4, 3, 2), (3, 1, 4), (1, 1, -5)),
    ((0, 1, -1), (3, 1, 2), (4, 3, 1), (3, 4, -1), (1, 3, -2), (1, 0, 1), (1, 1, -1)),
)
"""Sets in space whose extreme points, three to six, lie in one plane; one point, the last, does not."""


def number_of_extremes(claim: str) -> CheckResult:
    """Theorem 4.1 for three to six distinct extreme points, coplanar with one more point beside; and its example."""
    checks = []
    for points in EXTREMES_IN_A_PLANE:
        extreme = {f(points, key=lambda p, k=k: p[k]) for f in (min, max) for k in range(3)}  # type: ignore[misc]
        checks.append(extreme == {*points[:-1]})
        checks.append((exact_hull(points[:-1]).dimension, exact_hull(points).dimension) == (2, 3))
    example = worked_example("4.1", claim)
    message = f"three to six distinct extreme points; the example: {example.message}"
    return holds_if(all(checks) and example.verdict == HOLDS, message)


def _equations(theorem: Theorem) -> CheckResult:
    """The printed equations hold at the points they are said to contain."""
    faults = theorem_faults(theorem, load_text())
    return holds_if(not faults, faults[0] if faults else "exactly")


def _signs(theorem: Theorem) -> CheckResult:
    """The stated points lie outside or inside of the stated equations."""
    right = sum((theorem.plane(n).at(_point(theorem, p)) > 0) == (sign == "+") for n, p, sign in theorem.signs)
    return holds_if(right == len(theorem.signs), f"{right} of {len(theorem.signs)} signs as stated")


def _point(theorem: Theorem, name: str) -> Point:
    point = theorem.point(name)
    assert point is not None
    return point


def lost_candidates(theorem: Theorem) -> list[Vector]:
    """The whole-number points P3 of theorem 4.1 can have been: in the plane, largest in y, extreme in nothing else."""
    (plane,) = theorem.planes
    known = [point.at for point in theorem.points]
    low = [min(p[k] for p in known) for k in range(3)]
    high = [max(p[k] for p in known) for k in range(3)]
    candidates: list[Vector] = []
    for x, z in product(range(int(low[0]), int(high[0]) + 1), range(int(low[2]), int(high[2]) + 1)):
        a, b, c, d = plane.coefficients
        y = -(a * x + c * z + d) / b
        point = (Fraction(x), y, Fraction(z))
        if y.denominator == 1 and y >= high[1] and point not in known:
            candidates.append(point)
    return candidates


def _six_extremes(theorem: Theorem) -> CheckResult:
    """Six extreme points in one plane, the others not in it, whatever point P3 was."""
    candidates = lost_candidates(theorem)
    off = [_point(theorem, name) for name in theorem.outside_plane]
    nonplanar = 0
    for candidate in candidates:
        points = [*(p.at for p in theorem.points), candidate]
        nonplanar += exact_hull([*map(list, points)]).dimension == 3
    return holds_if(
        bool(candidates) and nonplanar == len(candidates) and all(theorem.planes[0].at(point) for point in off),
        f"P3 is lost to the OCR; the claim holds for all {len(candidates)} whole-number points it can have been",
    )


def _faces(points: Sequence[Vector]) -> set[Vector]:
    hull = exact_hull([*map(list, points)])
    return {scaled(tuple(Fraction(c) for c in hull.plane_of(facet)), True) for facet in hull.facets}


def _not_supporting(theorem: Theorem) -> CheckResult:
    """Equations 7 and 8 of Table 1 are no supporting planes."""
    faces = _faces([point.at for point in theorem.points])
    table = [scaled(plane.coefficients, True) for plane in theorem.planes]
    inside = [number for number, plane in enumerate(table, 1) if plane in faces]
    return holds_if(
        inside == [1, 2, 3, 4, 5, 6],
        f"the hull of the six points has equations {', '.join(map(str, inside))} of the table "
        f"and {len(faces) - len(inside)} others",
    )


ADDED = ("Q1", "Q6", "Q7", "Q2", "Q8", "Q5", "Q3", "Q4")
"""The vertices of H_5 of theorem 4.8: of H_1, then one added at a time."""


def _growing(theorem: Theorem) -> CheckResult:
    """H_1 to H_5 have the points added in turn as vertices."""
    points = [_point(theorem, name).at for name in ADDED]
    vertices = [len(exact_hull([*map(list, points[:n])]).vertices) for n in range(4, 9)]
    return holds_if(vertices == [4, 5, 6, 7, 8], f"{', '.join(map(str, vertices))} vertices")


def _supporting(theorem: Theorem) -> CheckResult:
    """The table lists the supporting planes of H_5."""
    faces = _faces([_point(theorem, name).at for name in ADDED])
    table = {scaled(plane.coefficients, True) for plane in theorem.planes}
    return holds_if(faces == table, f"{len(faces & table)} of {len(table)} are, up to a factor; H5 has {len(faces)}")


def _last_outside(theorem: Theorem) -> CheckResult:
    """The last point lies outside equations 3 to 8."""
    points = [_point(theorem, name).at for name in ADDED]
    outside = [plane.number for plane in theorem.planes if plane.at(_point(theorem, "Q9")) > 0]
    passed = outside == [3, 4, 5, 6, 7, 8] and _point(theorem, "Q9").at not in points
    return holds_if(passed, f"outside {', '.join(map(str, outside))}")


def _programs(theorem: Theorem, load: Load) -> CheckResult:
    """The printed points through the listing: as the exact hull, or refused."""
    cut = [[_CARD.divide(x.numerator, x.denominator) for x in point.at] for point in theorem.points]
    points: list[Vector] = [tuple(map(Fraction, point)) for point in cut]
    deck = data_deck([list(map(str, point)) for point in cut], "theorem")
    exactly = all(card_point == point.at for card_point, point in zip(points, theorem.points, strict=True))
    judge = from_judge(exact_hull([*map(list, points)]), points)
    outcome = from_cards("listing", run_hull(deck, load, Options(limit=200_000)), points)
    agrees = outcome.determined and disagreement(outcome, judge, points).agrees
    taken = "the points" if exactly else "the points cut to eight digits"
    missing = f", {', '.join(theorem.lost)} left out" if theorem.lost else ""
    fine = agrees if exactly else outcome.status == NOT_ACCEPTABLE
    return holds_if(fine, f"{taken}{missing}: {_seen(outcome, agrees, judge)}")


def procedure_of_4_8(kind: str = "") -> CheckResult:
    """The procedure on the nine points: H_1, H_2 and H_5 are the text's; as page 29 has it there is no H_1.

    In between the procedure takes the points in another order.  The last point is then outside of six planes, which is
    what the ``theorem`` needs.
    """
    theorem = theorem_of("4.8")
    points = [point.at for point in theorem.points]
    hull = convex_hull(points, history=True)
    used = [theorem.points[k].name for stage in hull.history for k in stage.added]
    same = [set(used[:n]) == set(ADDED[:n]) for n in range(4, 9)]
    letter = convex_hull(points, text=True, on_refusal="return")
    six = same[-1] and used[8:] == ["Q9"] and hull.history[-1].outside == 6
    if kind:
        return holds_if(six, "H_5 as the procedure makes it has six planes that the last point is outside of")
    passed = six and same == [True, True, False, False, True] and not letter.determined
    message = "H_1, H_2 and H_5 are made, H_3 and H_4 of other points; the last point is outside of six planes"
    return holds_if(passed, message, conditional=True)


def slips_of_4_8(which: str) -> CheckResult:
    """The two points as page 56 prints them: in the list (-4, -4, 2), in the table (3, 4, -1)."""
    theorem = theorem_of("4.8")
    printed_points, _ = csv_points(counterexample("slips_4_8.csv"), "slips_4_8.csv")
    listed, in_table = (Point("", tuple(map(Fraction, map(str, p))), "", "") for p in printed_points)
    if which == "list":
        off = [plane.number for plane in theorem.planes if "Q1" in plane.vertices and plane.at(listed)]
        return fails_if(off == [1, 2, 7], f"equations {', '.join(map(str, off))} are not 0 at (-4, -4, 2)")
    off = [plane.number for plane in theorem.planes if "Q6" in plane.vertices and plane.at(in_table)]
    none = in_table.at not in [point.at for point in theorem.points]
    message = (
        f"(3, 4, -1) is none of the nine points; equations {', '.join(map(str, off))} of (3, 4, 1) are not 0 there"
    )
    return fails_if(none and off == [1, 6], message)


def _seen(outcome: Outcome, agrees: bool, judge: Outcome) -> str:
    if not outcome.determined:
        hull = f"{len(judge.vertices)} vertices, {len(judge.equations)} planes"
        return f"the listing ends with {outcome.status}; the hull has {hull}"
    verdict = "as the exact hull" if agrees else "unlike the exact hull"
    return f"{len(outcome.vertices)} vertices, {len(outcome.equations)} planes, {verdict}"

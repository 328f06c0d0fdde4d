"""The worked examples of chapter 4 judged: every equation and every claim, and the point sets through the programs.

Each claim is computed anew from the points the thesis prints (transcripts/chapter4), exactly; the programs take
them as cards hold them, cut to eight digits.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from decimal import ROUND_DOWN, Context
from fractions import Fraction
from itertools import product

from emulator.machine.result import Options
from modern.comparison.difference import disagreement
from modern.comparison.outcome import Outcome, Vector, from_cards, from_judge
from modern.edition import programs
from modern.edition.chapter4 import THEOREMS, Point, Theorem, load_text, load_theorems, theorem_faults
from modern.exact_hull import exact_hull
from modern.formats.deck import data_deck
from modern.thesis.cards import scaled
from modern.thesis.job import Load, run_hull

_CARD = Context(prec=8, rounding=ROUND_DOWN)
"""What a card holds of a number: eight significant digits, the rest cut."""


@dataclass(frozen=True, slots=True)
class Claim:
    """One published result: what the thesis says, whether it holds, and what was seen.

    ``holds`` is None for an observation the thesis makes no claim about.
    """

    theorem: str
    pages: str
    says: str
    holds: bool | None
    seen: str


def claims(theorem: Theorem, load: Load = programs.program) -> Iterator[Claim]:
    """Every claim of a worked example.  ``load`` gives the programs."""
    faults = theorem_faults(theorem, load_text())
    count = len(theorem.planes)
    equations = f"{count} equations hold" if count > 1 else "the equation holds"
    yield _claim(theorem, f"{equations} at the points named", not faults, faults[0] if faults else "exactly")
    if theorem.signs:
        right = sum((theorem.plane(n).at(_point(theorem, p)) > 0) == (sign == "+") for n, p, sign in theorem.signs)
        seen = f"{right} of {len(theorem.signs)} signs as stated"
        yield _claim(theorem, "the stated points lie outside or inside", right == len(theorem.signs), seen)
    yield from {"4.1": _four_one, "4.2": _four_two, "4.8": _four_eight}[theorem.id](theorem)
    yield _through_the_programs(theorem, load)


def all_claims(names: Sequence[str] = THEOREMS, load: Load = programs.program) -> Iterator[Claim]:
    """The claims of the theorems named, in the order of the chapter."""
    for theorem in load_theorems():
        if theorem.id in names:
            yield from claims(theorem, load)


def _claim(theorem: Theorem, says: str, holds: bool | None, seen: str) -> Claim:
    return Claim(theorem.id, theorem.pages, says, holds, seen)


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
    found: list[Vector] = []
    for x, z in product(range(int(low[0]), int(high[0]) + 1), range(int(low[2]), int(high[2]) + 1)):
        a, b, c, d = plane.coefficients
        y = -(a * x + c * z + d) / b
        point = (Fraction(x), y, Fraction(z))
        if y.denominator == 1 and y >= high[1] and point not in known:
            found.append(point)
    return found


def _four_one(theorem: Theorem) -> Iterator[Claim]:
    candidates = lost_candidates(theorem)
    off = [_point(theorem, name) for name in theorem.outside_plane]
    good = 0
    for candidate in candidates:
        points = [*(p.at for p in theorem.points), candidate]
        good += exact_hull([*map(list, points)]).dimension == 3
    names = ", ".join(theorem.outside_plane)
    yield _claim(
        theorem,
        f"six extreme points in one plane, {names} not in it",
        bool(candidates) and good == len(candidates) and all(theorem.planes[0].at(point) for point in off),
        f"P3 is lost to the OCR; the claim holds for all {len(candidates)} whole-number points it can have been",
    )


def _faces(points: Sequence[Vector]) -> set[Vector]:
    hull = exact_hull([*map(list, points)])
    return {scaled(tuple(Fraction(c) for c in hull.plane_of(facet)), True) for facet in hull.facets}


def _four_two(theorem: Theorem) -> Iterator[Claim]:
    faces = _faces([point.at for point in theorem.points])
    table = [scaled(plane.coefficients, True) for plane in theorem.planes]
    inside = [number for number, plane in enumerate(table, 1) if plane in faces]
    yield _claim(
        theorem,
        "equations 7 and 8 of Table 1 are no supporting planes",
        inside == [1, 2, 3, 4, 5, 6],
        f"the hull of the six points has equations {', '.join(map(str, inside))} of the table "
        f"and {len(faces) - len(inside)} others",
    )


def _four_eight(theorem: Theorem) -> Iterator[Claim]:
    order = ["Q1", "Q6", "Q7", "Q2", "Q8", "Q5", "Q3", "Q4"]
    points = [_point(theorem, name).at for name in order]
    vertices = [len(exact_hull([*map(list, points[:n])]).vertices) for n in range(4, 9)]
    yield _claim(
        theorem,
        "H1 to H5 have the points added in turn as vertices",
        vertices == [4, 5, 6, 7, 8],
        f"{', '.join(map(str, vertices))} vertices",
    )
    faces, table = _faces(points), {scaled(plane.coefficients, True) for plane in theorem.planes}
    yield _claim(
        theorem,
        "the table lists the supporting planes of H5",
        faces == table,
        f"{len(faces & table)} of {len(table)} are, up to a factor; H5 has {len(faces)}",
    )
    last = _point(theorem, "Q9").at
    outside = [plane.number for plane in theorem.planes if plane.at(_point(theorem, "Q9")) > 0]
    yield _claim(
        theorem,
        "the last point lies outside equations 3 to 8",
        outside == [3, 4, 5, 6, 7, 8] and last not in points,
        f"outside {', '.join(map(str, outside))}",
    )


def _through_the_programs(theorem: Theorem, load: Load) -> Claim:
    """The printed points through the listing, compared with the exact hull of what the cards hold."""
    cut = [[_CARD.divide(x.numerator, x.denominator) for x in point.at] for point in theorem.points]
    points: list[Vector] = [tuple(map(Fraction, point)) for point in cut]
    deck = data_deck([list(map(str, point)) for point in cut], "theorem")
    exactly = all(one == point.at for one, point in zip(points, theorem.points, strict=True))
    judge = from_judge(exact_hull([*map(list, points)]), points)
    outcome = from_cards("listing", run_hull(deck, load, Options(limit=200_000)), points)
    agrees = outcome.determined and disagreement(outcome, judge, points).agrees
    taken = "the points" if exactly else "the points cut to eight digits"
    missing = f", {', '.join(theorem.lost)} left out" if theorem.lost else ""
    return _claim(
        theorem,
        "through the 1963 programs (the thesis does not say)",
        None,
        f"{taken}{missing}: {_seen(outcome, agrees, judge)}",
    )


def _seen(outcome: Outcome, agrees: bool, judge: Outcome) -> str:
    if not outcome.determined:
        hull = f"{len(judge.vertices)} vertices, {len(judge.equations)} planes"
        return f"the listing ends with {outcome.status}; the hull has {hull}"
    verdict = "as the exact hull" if agrees else "unlike the exact hull"
    return f"{len(outcome.vertices)} vertices, {len(outcome.equations)} planes, {verdict}"

"""Every sample of every route is filed under exactly one outcome.

=====================  ============================================================================================
outcome                what it says (detail)
=====================  ============================================================================================
right                  the judge's vertices, boundary and inside points, and each of its planes once
reordered              right, but vertices or planes stand in another order than the cell's reference route has them
doubled plane          right, but a plane stands more than once
DATA NOT ACCEPTABLE    typed (program and statement)
ERROR IN PROGRAM       typed (program and the statement that decided it)
endless                stopped at the statement limit (program and the loop's statements)
table full             an element of program 3's table of planes past its last (which)
out of bounds          another subscript out of bounds (which)
undefined value        computed with or put out (program and statement)
wrong hull             the first of these that holds: dimension wrong, coordinates changed, vertex missed, vertex
                       too many, plane missed, plane too many, point misfiled, equations wrong, vertices of a plane
                       wrong
stopped otherwise      any other ending (its kind, program and statement), or a number out of the arithmetic's range
=====================  ============================================================================================

Of a line the programs punch the ends only, and of three points or fewer no inside points; equations of the judge and
of a route are the same plane within :data:`modern.comparison.difference.NEAR`, the error of coefficients being a
figure.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from decimal import Context, Decimal
from fractions import Fraction

from emulator.machine.result import Options
from emulator.numbers.decimal import DecimalNumbers
from modern.comparison.difference import NEAR, Disagreement, disagreement
from modern.comparison.outcome import Outcome, from_card_hull, from_hull
from modern.geometry.hull import ERROR, NOT_ACCEPTABLE, TABLE_FULL, Hull
from modern.study.causes import looping_at, out_of_bounds, refused_at, stopped_at
from modern.study.judged import Judged, held
from modern.thesis.batch import Runs
from modern.thesis.cards import CardHull, read_hull
from modern.thesis.job import HullRun, refusal

RIGHT, REORDERED, DOUBLED = "right", "reordered", "doubled plane"
ENDLESS, TABLE, BOUNDS, UNDEFINED = "endless", "table full", "out of bounds", "undefined value"
WRONG, OTHERWISE = "wrong hull", "stopped otherwise"
OUTCOMES = (
    RIGHT,
    REORDERED,
    DOUBLED,
    NOT_ACCEPTABLE,
    ERROR,
    ENDLESS,
    TABLE,
    BOUNDS,
    UNDEFINED,
    WRONG,
    OTHERWISE,
)
DETERMINED = (RIGHT, REORDERED, DOUBLED)
"""The outcomes that give the hull."""

Figures = Mapping[str, int | str]
_SHOWN = Context(prec=6)


@dataclass(frozen=True, slots=True)
class Filed:
    """Where a sample is filed: outcome, detail, figures, and for a hull that is right the order of its cards."""

    outcome: str
    detail: str = ""
    figures: Figures = field(default_factory=dict)
    order: tuple[tuple[int, ...], ...] = ()


def file_run(run: HullRun, judged: Judged, options: Options, runs: Runs) -> Filed:
    """File a run of the programs.  ``runs`` makes the further runs that tell where an error was decided."""
    refused = next((step for step in run.steps if refusal(step.result)), None)
    if refused is not None:
        message = refusal(refused.result)
        return Filed(message, refused_at(refused, message, options, runs))
    step = next((step for step in run.steps if not step.result.ending.normal), None)
    if step is None:
        final = run.final
        hull = read_hull(final.result.punched)
        numbers = options.numbers
        points = held(judged, numbers.profile.rules) if isinstance(numbers, DecimalNumbers) else judged.points
        outcome = from_card_hull(final.name, final.name, hull, points)
        return _judged(outcome, judged, hull)
    kind = step.result.ending.kind
    if kind == "limit":
        return Filed(ENDLESS, looping_at(step))
    if kind in ("bounds", "outside"):
        full, what = out_of_bounds(step)
        return Filed(TABLE if full else BOUNDS, what)
    if kind == "undefined":
        return Filed(UNDEFINED, stopped_at(step))
    return Filed(OTHERWISE, f"{kind} in {stopped_at(step)}")


def file_hull(hull: Hull, judged: Judged) -> Filed:
    """File a result of the port."""
    if hull.status == TABLE_FULL:
        return Filed(TABLE, hull.statement)
    if not hull.determined:
        return Filed(hull.status, hull.statement)
    return _judged(from_hull(hull.arithmetic, hull), judged, hull)


def reordered(filed: Filed, reference: Filed) -> Filed:
    """The sample filed as reordered where it and the reference are right and their orders differ."""
    differs = filed.outcome == reference.outcome == RIGHT and filed.order != reference.order
    return replace(filed, outcome=REORDERED) if differs else filed


def number_text(value: Fraction) -> str:
    """A figure as text: six significant digits, correctly rounded."""
    return str(_SHOWN.divide(Decimal(value.numerator), Decimal(value.denominator)).normalize(_SHOWN))


def _judged(outcome: Outcome, judged: Judged, hull: CardHull | Hull) -> Filed:
    """File a hull that was determined."""
    found = disagreement(outcome, judged.outcome, judged.points)
    figures = {"coefficient_error": number_text(found.error), "excluded": number_text(found.excluded)}
    fault = _fault(outcome, judged, found, hull)
    if fault:
        return Filed(WRONG, fault, figures)
    if found.planes_doubled:
        return Filed(DOUBLED, f"{found.planes_doubled}", figures)
    return Filed(RIGHT, "", figures, (_order(outcome, judged, hull), found.places))


def _fault(outcome: Outcome, judged: Judged, found: Disagreement, hull: CardHull | Hull) -> str:
    """What is wrong with a hull, in the order of the table above; empty where nothing is."""
    faults = (
        (outcome.dimension != judged.hull.dimension, "dimension wrong"),
        (outcome.strange, "coordinates changed"),
        (found.missed, "vertex missed"),
        (found.added, "vertex too many"),
        (found.planes_missing, "plane missed"),
        (found.planes_extra, "plane too many"),
        (found.misfiled, "point misfiled"),
    )
    fault = next((words for holds, words in faults if holds), "")
    if fault:
        return fault
    if outcome.faulty or not _plane_right(hull, judged):
        return "equations wrong"
    return "" if _numbers_right(hull, judged, found) else "vertices of a plane wrong"


def _plane_right(hull: CardHull | Hull, judged: Judged) -> bool:
    """Whether the plane of coplanar points, where the route gives it, is the judge's."""
    if judged.hull.plane is None or not isinstance(hull, CardHull) or not hull.plane:
        return True
    right = judged.hull.plane_of(judged.hull.plane)
    best = max(range(3), key=lambda k: abs(right[k]))
    for plane in hull.plane:
        if not plane[best]:
            return False
        ratio = Fraction(right[best]) / plane[best]
        size = [abs(ratio * c - r) / abs(right[best]) for c, r in zip(plane, right, strict=True)]
        if max(size[:3]) > NEAR or size[3] > NEAR * max(Fraction(1), Fraction(abs(right[3]), abs(right[best]))):
            return False
    return True


def _numbers_right(hull: CardHull | Hull, judged: Judged, found: Disagreement) -> bool:
    """Whether the vertices said to satisfy each equation are those that do."""
    if not found.places:
        return True
    said: list[set[int]] = [set() for _ in found.places]
    if isinstance(hull, Hull):
        said = [set(face.polygon) for face in hull.faces]
    else:
        where = {point: index for index, point in enumerate(judged.points)}
        for numbers, equation in hull.satisfied:
            if not 1 <= equation <= len(said) or max(numbers, default=1) > len(hull.vertices):
                return False
            said[equation - 1].update(where.get(hull.vertices[k - 1], -1) for k in numbers)
    return all(judged.on[place] == one for place, one in zip(found.places, said, strict=True))


def _order(outcome: Outcome, judged: Judged, hull: CardHull | Hull) -> tuple[int, ...]:
    """The vertices in the order given, by place in the input."""
    if isinstance(hull, Hull):
        return hull.vertices
    where = {point: index for index, point in enumerate(judged.points)}
    return tuple(where.get(point, -1) for point in hull.vertices)

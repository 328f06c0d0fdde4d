"""Every sample of every route has exactly one outcome, with a detail that says where or what.

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
from typing import Literal, get_args

from emulator.language.objectcode import Line, Program
from emulator.machine.result import Options
from emulator.numbers.decimal import DecimalNumbers
from modern.comparison import outcome as compared
from modern.comparison.difference import NEAR, Disagreement, disagreement
from modern.geometry.hull import ERROR, NOT_ACCEPTABLE, TABLE_FULL, Hull
from modern.study.sample import Sample
from modern.thesis.cards import CardHull, read_hull
from modern.thesis.job import HullRun, Step, refusal

Outcome = Literal[
    "right",
    "reordered",
    "doubled plane",
    "DATA NOT ACCEPTABLE",
    "ERROR IN PROGRAM",
    "endless",
    "table full",
    "out of bounds",
    "undefined value",
    "wrong hull",
    "stopped otherwise",
]
Fault = Literal[
    "dimension wrong",
    "coordinates changed",
    "vertex missed",
    "vertex too many",
    "plane missed",
    "plane too many",
    "point misfiled",
    "equations wrong",
    "vertices of a plane wrong",
]
"""The details of a wrong hull."""

OUTCOMES: tuple[Outcome, ...] = get_args(Outcome)
DETERMINED: tuple[Outcome, ...] = ("right", "reordered", "doubled plane")
"""The outcomes that give the hull."""
TABLE: Outcome = "table full"
WRONG: Outcome = "wrong hull"
OTHERWISE: Outcome = "stopped otherwise"
_REFUSED: Mapping[str, Outcome] = {NOT_ACCEPTABLE: "DATA NOT ACCEPTABLE", ERROR: "ERROR IN PROGRAM"}
_PLANE_TABLE = frozenset({"A", "B", "C", "D", "E", "MM", "NN", "KK"})
"""The arrays of program 3 that hold a number a plane (thesis p. 88)."""

Figures = Mapping[str, int | str]
_SHOWN = Context(prec=6)


@dataclass(frozen=True, slots=True)
class Answer:
    """What a route made of a sample: outcome, detail, figures; of a right hull the order of vertices and planes."""

    outcome: Outcome
    detail: str = ""
    figures: Figures = field(default_factory=dict)
    order: tuple[tuple[int, ...], ...] = ()


def answer_of_run(run: HullRun, sample: Sample, options: Options) -> Answer:
    """The answer of a run of the programs with these options."""
    for step in run.steps:
        message = refusal(step.result)
        if message:
            return Answer(_REFUSED[message], _refused_at(step, message))
    step = next((step for step in run.steps if not step.result.ending.normal), run.final)
    ending = step.result.ending
    match ending.kind:
        case "limit":
            return Answer("endless", _looping_at(step))
        case "bounds" | "outside":
            full = step.number == 3 and ending.name in _PLANE_TABLE and ending.subscripts > ending.shape
            return Answer(TABLE if full else "out of bounds", _reached(step))
        case "undefined":
            return Answer("undefined value", _stopped_at(step))
        case kind if not ending.normal:
            return Answer(OTHERWISE, f"{kind} in {_stopped_at(step)}")
    hull, numbers = read_hull(step.result.punched), options.numbers
    points = sample.points_read(numbers.profile.rules) if isinstance(numbers, DecimalNumbers) else sample.points
    return _determined(compared.from_card_hull(step.name, step.name, hull, points), sample, hull)


def answer_of_hull(hull: Hull, sample: Sample) -> Answer:
    """The answer of a run of the port."""
    if hull.determined:
        return _determined(compared.from_hull(hull.arithmetic, hull), sample, hull)
    return Answer(TABLE if hull.status == TABLE_FULL else _REFUSED[hull.status], hull.statement)


def reordered(answer: Answer, reference: Answer) -> Answer:
    """The answer as reordered where it and the reference are right and their orders differ."""
    differs = answer.outcome == reference.outcome == "right" and answer.order != reference.order
    return replace(answer, outcome="reordered") if differs else answer


def place(program: Program, line: Line) -> str:
    """A statement's place as the apparatus names cards: its number, ``147``, or the number before it and how many
    statements after that it stands, ``132+3``; before the first number, ``+3``."""
    for after, other in enumerate(reversed(program.statements[: line.index + 1])):
        if other.label:
            return f"{other.label}+{after}" if after else str(other.label)
    return f"+{line.index}"


def _refused_at(step: Step, message: str) -> str:
    """Where a program was that typed DATA NOT ACCEPTABLE or ERROR IN PROGRAM: ``program3 119``.

    All errors of a program are typed by one statement; of them the decision before it is named.
    """
    typed = next(event for event in reversed(step.result.events) if event.what == "type" and event.text == message)
    line = typed.decision if message == ERROR and typed.decision else typed.line
    return f"{step.name} {place(step.program, line)}" if line else step.name


def _looping_at(step: Step) -> str:
    """The span of numbered statements an endless run was in: ``program3 142-160``."""
    span = step.result.ending.span
    if span is None:
        return step.name
    within = [line for line in step.program.statements if span[0] <= line.place.card <= span[1]]
    labels = [line.label for line in within if line.label]
    start = f"{step.name} {place(step.program, within[0])}"
    return f"{start}-{labels[-1]}" if labels else start


def _reached(step: Step) -> str:
    """The element that was reached for, ``program3 A(99)``, or where a subscript reached outside the data."""
    ending = step.result.ending
    if not ending.name:
        return _stopped_at(step)
    return f"{step.name} {ending.name}({','.join(map(str, ending.subscripts))})"


def _stopped_at(step: Step) -> str:
    """Where a run stopped that reached for an undefined value, or for another reason."""
    line = step.result.ending.line
    return f"{step.name} {place(step.program, line)}" if line else step.name


def number_text(value: Fraction) -> str:
    """A figure as text: six significant digits, correctly rounded."""
    return str(_SHOWN.divide(Decimal(value.numerator), Decimal(value.denominator)).normalize(_SHOWN))


def _determined(outcome: compared.Outcome, sample: Sample, hull: CardHull | Hull) -> Answer:
    """The answer that a hull is."""
    found = disagreement(outcome, sample.outcome, sample.points)
    figures = {"coefficient_error": number_text(found.error), "excluded": number_text(found.excluded)}
    fault = _fault(outcome, sample, found, hull)
    if fault:
        return Answer(WRONG, fault, figures)
    if found.planes_doubled:
        return Answer("doubled plane", f"{found.planes_doubled}", figures)
    return Answer("right", "", figures, (_order(outcome, sample, hull), found.places))


def _fault(outcome: compared.Outcome, sample: Sample, found: Disagreement, hull: CardHull | Hull) -> Fault | None:
    """What is wrong with a hull, in the order of the table above; None where nothing is."""
    faults: tuple[tuple[object, Fault], ...] = (
        (outcome.dimension != sample.hull.dimension, "dimension wrong"),
        (outcome.strange, "coordinates changed"),
        (found.missed, "vertex missed"),
        (found.added, "vertex too many"),
        (found.planes_missing, "plane missed"),
        (found.planes_extra, "plane too many"),
        (found.misfiled, "point misfiled"),
    )
    fault = next((name for holds, name in faults if holds), None)
    if fault:
        return fault
    if outcome.faulty or not _plane_right(hull, sample):
        return "equations wrong"
    return None if _numbers_right(hull, sample, found) else "vertices of a plane wrong"


def _plane_right(hull: CardHull | Hull, sample: Sample) -> bool:
    """Whether the plane of coplanar points, where the route gives it, is the judge's."""
    if sample.hull.plane is None or not isinstance(hull, CardHull) or not hull.plane:
        return True
    right = sample.hull.plane_of(sample.hull.plane)
    best = max(range(3), key=lambda k: abs(right[k]))
    for plane in hull.plane:
        if not plane[best]:
            return False
        ratio = Fraction(right[best]) / plane[best]
        size = [abs(ratio * c - r) / abs(right[best]) for c, r in zip(plane, right, strict=True)]
        if max(size[:3]) > NEAR or size[3] > NEAR * max(Fraction(1), Fraction(abs(right[3]), abs(right[best]))):
            return False
    return True


def _numbers_right(hull: CardHull | Hull, sample: Sample, found: Disagreement) -> bool:
    """Whether the vertices said to satisfy each equation are those that do."""
    if not found.places:
        return True
    said: list[set[int]] = [set() for _ in found.places]
    if isinstance(hull, Hull):
        said = [set(face.polygon) for face in hull.faces]
    else:
        where = {point: index for index, point in enumerate(sample.points)}
        for numbers, equation in hull.satisfied:
            if not 1 <= equation <= len(said) or max(numbers, default=1) > len(hull.vertices):
                return False
            said[equation - 1].update(where.get(hull.vertices[k - 1], -1) for k in numbers)
    return all(sample.on[place] == one for place, one in zip(found.places, said, strict=True))


def _order(outcome: compared.Outcome, sample: Sample, hull: CardHull | Hull) -> tuple[int, ...]:
    """The vertices in the order given, by place in the input."""
    if isinstance(hull, Hull):
        return hull.vertices
    where = {point: index for index, point in enumerate(sample.points)}
    return tuple(where.get(point, -1) for point in hull.vertices)

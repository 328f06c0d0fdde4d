"""Find the outcome of a sample on a route: exactly one of eleven, with a detail (a location or the kind of fault).

docs/explanation/studies.md describes the outcomes.  For collinear points, the programs punch only the two ends of the
segment.  For three points or fewer, the programs punch no inside points.  Two equations describe the same plane if
their coefficients agree within :data:`modern.comparison.difference.NEAR`.  The largest error of a coefficient is stored
with the outcome as a figure.
"""

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
# The details of the outcome "wrong hull".  If a hull has several faults, the detail is the first in this order.
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

OUTCOMES: tuple[Outcome, ...] = get_args(Outcome)
# The outcomes with the right hull.
DETERMINED: tuple[Outcome, ...] = ("right", "reordered", "doubled plane")
# The same outcomes as a list in SQL.
DETERMINED_SQL = str(DETERMINED)
TABLE: Outcome = "table full"
WRONG: Outcome = "wrong hull"
OTHERWISE: Outcome = "stopped otherwise"
_REFUSED: Mapping[str, Outcome] = {NOT_ACCEPTABLE: "DATA NOT ACCEPTABLE", ERROR: "ERROR IN PROGRAM"}
# The arrays of program 3 that hold one number for each plane (thesis p. 88).
_PLANE_TABLE = frozenset({"A", "B", "C", "D", "E", "MM", "NN", "KK"})

Figures = Mapping[str, int | str]
_SHOWN = Context(prec=6)


@dataclass(frozen=True, slots=True)
class Answer:
    """The result of one route for one sample.

    order: for a right hull, the order of its vertices and the order of its planes.
    """

    outcome: Outcome
    detail: str = ""
    figures: Figures = field(default_factory=dict)
    order: tuple[tuple[int, ...], ...] = ()


def answer_of_run(run: HullRun, sample: Sample, options: Options) -> Answer:
    """Return the answer of a run of the programs; ``options`` are the options of its machine."""
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
    if hull.determined:
        return _determined(compared.from_hull(hull.arithmetic, hull), sample, hull)
    return Answer(TABLE if hull.status == TABLE_FULL else _REFUSED[hull.status], hull.statement)


def reordered(answer: Answer, reference: Answer) -> Answer:
    """Return ``answer``, with the outcome "reordered" if both hulls are right but their orders differ."""
    differs = answer.outcome == reference.outcome == "right" and answer.order != reference.order
    return replace(answer, outcome="reordered") if differs else answer


def position(program: Program, line: Line) -> str:
    """Return the position of a statement in the notation of the apparatus, such as ``132+3``.

    A statement with a number has the position ``147``.  Other statements are counted from the last number, ``132+3``,
    or from the beginning of the program, ``+3``.
    """
    for distance, earlier in enumerate(reversed(program.statements[: line.index + 1])):
        if earlier.label:
            return f"{earlier.label}+{distance}" if distance else str(earlier.label)
    return f"+{line.index}"


def _refused_at(step: Step, message: str) -> str:
    """Return the statement that made a program type DATA NOT ACCEPTABLE or ERROR IN PROGRAM: ``program3 119``.

    One statement of a program types ERROR IN PROGRAM for every error.  The result for an error is therefore the last
    decision before that statement.
    """
    typed = next(event for event in reversed(step.result.events) if event.what == "type" and event.text == message)
    line = typed.decision if message == ERROR and typed.decision else typed.line
    return f"{step.name} {position(step.program, line)}" if line else step.name


def _looping_at(step: Step) -> str:
    """Return the range of numbered statements in which an endless run was: ``program3 142-160``."""
    span = step.result.ending.span
    if span is None:
        return step.name
    within = [line for line in step.program.statements if span[0] <= line.place.card <= span[1]]
    labels = [line.label for line in within if line.label]
    start = f"{step.name} {position(step.program, within[0])}"
    return f"{start}-{labels[-1]}" if labels else start


def _reached(step: Step) -> str:
    """Return the array element that is out of bounds, ``program3 A(99)``, or the statement if the name is unknown."""
    ending = step.result.ending
    if not ending.name:
        return _stopped_at(step)
    return f"{step.name} {ending.name}({','.join(map(str, ending.subscripts))})"


def _stopped_at(step: Step) -> str:
    line = step.result.ending.line
    return f"{step.name} {position(step.program, line)}" if line else step.name


def number_text(value: Fraction) -> str:
    """Return a figure as text with six significant digits, correctly rounded."""
    return str(_SHOWN.divide(Decimal(value.numerator), Decimal(value.denominator)).normalize(_SHOWN))


def _determined(outcome: compared.Outcome, sample: Sample, hull: CardHull | Hull) -> Answer:
    difference = disagreement(outcome, sample.outcome, sample.points)
    figures = {"coefficient_error": number_text(difference.error), "excluded": number_text(difference.excluded)}
    fault = _fault(outcome, sample, difference, hull)
    if fault:
        return Answer(WRONG, fault, figures)
    if difference.planes_doubled:
        return Answer("doubled plane", f"{difference.planes_doubled}", figures)
    return Answer("right", "", figures, (_order(outcome, sample, hull), difference.places))


def _fault(outcome: compared.Outcome, sample: Sample, difference: Disagreement, hull: CardHull | Hull) -> Fault | None:
    """Return the first of the faults listed in ``Fault`` that a hull has, or None if it has none."""
    faults: tuple[tuple[object, Fault], ...] = (
        (outcome.dimension != sample.hull.dimension, "dimension wrong"),
        (outcome.strange, "coordinates changed"),
        (difference.missed, "vertex missed"),
        (difference.added, "vertex too many"),
        (difference.planes_missing, "plane missed"),
        (difference.planes_extra, "plane too many"),
        (difference.misfiled, "point misfiled"),
    )
    fault = next((name for applies, name in faults if applies), None)
    if fault:
        return fault
    if outcome.faulty or not _plane_is_right(hull, sample):
        return "equations wrong"
    return None if _incidences_are_right(hull, sample, difference) else "vertices of a plane wrong"


def _plane_is_right(hull: CardHull | Hull, sample: Sample) -> bool:
    if sample.hull.plane is None or not isinstance(hull, CardHull) or not hull.plane:
        return True
    exact = sample.hull.plane_of(sample.hull.plane)
    largest = max(range(3), key=lambda k: abs(exact[k]))
    for plane in hull.plane:
        if not plane[largest]:
            return False
        # Scale the plane to the exact one by its largest coefficient and compare relative to that coefficient.  The
        # constant term may be larger; its own size then bounds its error.
        ratio = Fraction(exact[largest]) / plane[largest]
        errors = [abs(ratio * c - e) / abs(exact[largest]) for c, e in zip(plane, exact, strict=True)]
        if max(errors[:3]) > NEAR or errors[3] > NEAR * max(Fraction(1), Fraction(abs(exact[3]), abs(exact[largest]))):
            return False
    return True


def _incidences_are_right(hull: CardHull | Hull, sample: Sample, difference: Disagreement) -> bool:
    if not difference.places:
        return True
    listed: list[set[int]] = [set() for _ in difference.places]
    if isinstance(hull, Hull):
        listed = [set(face.polygon) for face in hull.faces]
    else:
        # On the cards, vertices are numbered in the order in which the program punched them.
        index_of = {point: index for index, point in enumerate(sample.points)}
        for numbers, equation in hull.satisfied:
            if not 1 <= equation <= len(listed) or max(numbers, default=1) > len(hull.vertices):
                return False
            listed[equation - 1].update(index_of.get(hull.vertices[k - 1], -1) for k in numbers)
    return all(sample.on[place] == vertices for place, vertices in zip(difference.places, listed, strict=True))


def _order(outcome: compared.Outcome, sample: Sample, hull: CardHull | Hull) -> tuple[int, ...]:
    if isinstance(hull, Hull):
        return hull.vertices
    index_of = {point: index for index, point in enumerate(sample.points)}
    return tuple(index_of.get(point, -1) for point in hull.vertices)

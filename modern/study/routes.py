"""A route carried out: a chunk's samples through the programs or the port, each answer."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache

from emulator.errors import EmulatorError
from emulator.language.cards import Deck
from emulator.language.compiler import compile_deck
from emulator.language.objectcode import Program
from emulator.machine.result import Options
from emulator.numbers import numbers
from modern.edition import programs
from modern.formats.deck import with_epsilon
from modern.geometry.hull import Hull
from modern.port import RangeError, convex_hull
from modern.study.measures import MEASURES, measure_of
from modern.study.outcomes import OTHERWISE, Answer, Figures, answer_of_hull, answer_of_run
from modern.study.plan import PlanError, Port, Programs, Route, own_code
from modern.study.sample import Sample
from modern.thesis.batch import Runs, run_hulls
from modern.thesis.job import HullRun, Load, run_hull


def carry_out(route: Route, samples: Sequence[Sample], runs: Runs) -> list[Answer]:
    """Each sample through the route.  ``runs`` carries runs over to the other routes of the same samples."""
    return _programs(route, samples, runs) if isinstance(route, Programs) else [_port(route, one) for one in samples]


def options_of(route: Programs) -> Options:
    """The machine a route runs on.  Raises PlanError."""
    try:
        found = numbers(route.arithmetic)
    except ValueError as error:
        raise PlanError(f"route {route.name}: {error}") from None
    return Options(found, core=route.core, bounds=route.bounds, limit=route.limit, uncut=route.uncut)


def programs_of(route: Programs) -> tuple[str, Load]:
    """The built-in that plays program 1, and the programs by name.  Raises PlanError."""
    first = "program1_examples" if route.state == "examples" else "program1"
    present = {row.layer for name in programs.TEXTS for row in programs.text(name).rows}
    missing = [layer for layer in route.layers if layer not in present]
    if missing:
        raise PlanError(f"route {route.name}: no program has rows of a layer {missing[0]!r}")
    known = {row.id for name in programs.TEXTS for row in programs.text(name).rows}
    missing = [row for row in route.rows if row not in known]
    if missing:
        raise PlanError(f"route {route.name}: the apparatus has no row {missing[0]!r}")
    return first, lambda name: _program(name, route.layers, route.rows)


@cache
def _program(name: str, layers: tuple[str, ...], rows: tuple[str, ...]) -> Program:
    """A built-in with layers added, and single rows: those rows' layers without their other rows."""
    chosen = [
        row for row in programs.text(programs.built_in(name).text).rows if row.id in rows and row.layer not in layers
    ]
    if not chosen:
        return programs.with_layers(name, layers)
    single = {row.layer for row in chosen}
    text = programs.text(programs.built_in(name).text)
    others = {row.id for row in text.rows if row.layer in single and row.id not in rows}
    present = {row.layer for row in text.rows}
    wanted = (*(layer for layer in layers if layer in present), *sorted(single))
    try:
        return compile_deck(programs.built(name, wanted, others))
    except EmulatorError as error:
        raise PlanError(f"rows {', '.join(rows)} of {name} do not stand without others: {error}") from None


def _programs(route: Programs, samples: Sequence[Sample], runs: Runs) -> list[Answer]:
    options, (first, load) = options_of(route), programs_of(route)
    data = [with_epsilon(one.deck, route.epsilon) if route.epsilon else one.deck for one in samples]
    found = []
    ran = _uncut(data, load, options, first) if route.uncut else run_hulls(data, load, options, first, runs)
    for one, run in zip(samples, ran, strict=True):
        if isinstance(run, EmulatorError):
            found.append(Answer(OTHERWISE, str(run)))
            continue
        answer = answer_of_run(run, one, options)
        statements = sum(step.result.statements for step in run.steps)
        found.append(_with(answer, {"statements": statements, **_measured(route, one, run)}))
    return found


def _uncut(decks: Sequence[Deck], load: Load, options: Options, first: str) -> Iterator[HullRun | EmulatorError]:
    """Each deck's hull run with numbers whole between the programs, or the error it raised."""
    for deck in decks:
        try:
            yield run_hull(deck, load, options, first)
        except EmulatorError as error:
            yield error


def _port(route: Port, one: Sample) -> Answer:
    try:
        hull = convex_hull(
            one.drawn.points,
            route.arithmetic,
            route.epsilon or None,
            route.translate,
            history=route.history,
            on_refusal="return",
        )
    except RangeError as error:
        return Answer(OTHERWISE, str(error))
    return _with(answer_of_hull(hull, one), _measured(route, one, hull))


def _measured(route: Route, one: Sample, run: HullRun | Hull) -> Figures:
    figures: dict[str, int | str] = {}
    for name in route.measures:
        try:
            if name in MEASURES:
                found = measure_of(name)(one, run)
            else:
                with own_code(f"route {route.name}: measure {name}", name.partition(":")[0]):
                    found = measure_of(name)(one, run)
        except (TypeError, ValueError) as error:
            raise PlanError(f"route {route.name}: measure {name}: {error}") from error
        wrong = [what for what, value in found.items() if type(value) not in (int, str)]
        if wrong:
            raise PlanError(f"route {route.name}: measure {name}: the figure {wrong[0]} is not a whole number or text")
        figures.update(found)
    return figures


def _with(answer: Answer, figures: Figures) -> Answer:
    return Answer(answer.outcome, answer.detail, {**answer.figures, **figures}, answer.order)

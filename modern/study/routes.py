"""Compute the hulls of a chunk of samples by one route: the programs of 1963 or their modern port, with options."""

from collections.abc import Iterator, Sequence
from contextlib import nullcontext
from dataclasses import replace
from functools import cache

from emulator.errors import EmulatorError, quoted
from emulator.language.cards import Deck
from emulator.language.compiler import compile_deck
from emulator.language.objectcode import Program
from emulator.machine.result import Options
from emulator.numbers import numbers
from modern.edition import programs
from modern.formats.deck import with_epsilon
from modern.geometry.hull import Hull
from modern.port import RangeError, convex_hull
from modern.study.measures import MEASURES
from modern.study.outcomes import OTHERWISE, Answer, Figures, answer_of_hull, answer_of_run
from modern.study.plan import PlanError, Port, Programs, Route, named, user_code
from modern.study.sample import Sample
from modern.thesis.batch import Runs, run_hulls
from modern.thesis.job import HullRun, Load, run_hull


def carry_out(route: Route, samples: Sequence[Sample], runs: Runs) -> list[Answer]:
    """Compute the hull of each sample by the route.  ``runs`` keeps the runs that several routes have in common."""
    if isinstance(route, Programs):
        return _programs(route, samples, runs)
    return [_port(route, sample) for sample in samples]


def options_of(route: Programs) -> Options:
    """Return the options of the machine that a route runs on.  Raise PlanError if the arithmetic is unknown."""
    try:
        arithmetic = numbers(route.arithmetic)
    except ValueError as error:
        raise PlanError(f"route {route.name}: {error}") from None
    return Options(arithmetic, core=route.core, bounds=route.bounds, limit=route.limit, uncut=route.uncut)


def programs_of(route: Programs) -> tuple[str, Load]:
    """Return the name of the route's version of program 1, and a function that returns a program by its name.

    Raise PlanError if the route names an unknown layer or row.
    """
    first = "program1_examples" if route.state == "examples" else "program1"
    rows = [row for name in programs.TEXTS for row in programs.text(name).rows]
    missing = [layer for layer in route.layers if layer not in {row.layer for row in rows}]
    if missing:
        raise PlanError(
            f"route {route.name}: expected the name of a layer, found {quoted(missing[0])}, which no program has"
        )
    missing = [row for row in route.rows if row not in {row.id for row in rows}]
    if missing:
        raise PlanError(f"route {route.name}: expected a row of the apparatus, found {quoted(missing[0])}")
    return first, lambda name: _program(name, route.layers, route.rows)


@cache
def _program(name: str, layers: tuple[str, ...], rows: tuple[str, ...]) -> Program:
    rows_of_text = programs.text(programs.built_in(name).text).rows
    partial_layers = {row.layer for row in rows_of_text if row.id in rows and row.layer not in layers}
    if not partial_layers:
        return programs.with_layers(name, layers)
    excluded = {row.id for row in rows_of_text if row.layer in partial_layers and row.id not in rows}
    present = {row.layer for row in rows_of_text}
    try:
        all_layers = (*(layer for layer in layers if layer in present), *sorted(partial_layers))
        return compile_deck(programs.built(name, all_layers, excluded))
    except EmulatorError as error:
        raise PlanError(f"rows {', '.join(rows)} of {name} depend on other rows: {error}") from None


def _programs(route: Programs, samples: Sequence[Sample], runs: Runs) -> list[Answer]:
    options, (first, load) = options_of(route), programs_of(route)
    decks = [with_epsilon(sample.deck, route.epsilon) if route.epsilon else sample.deck for sample in samples]
    answers = []
    hull_runs = _uncut(decks, load, options, first) if route.uncut else run_hulls(decks, load, options, first, runs)
    for sample, run in zip(samples, hull_runs, strict=True):
        if isinstance(run, EmulatorError):
            answers.append(Answer(OTHERWISE, str(run)))
            continue
        answer = answer_of_run(run, sample, options)
        statements = sum(step.result.statements for step in run.steps)
        figures = {**answer.figures, "statements": statements, **_measured(route, sample, run)}
        answers.append(replace(answer, figures=figures))
    return answers


def _uncut(decks: Sequence[Deck], load: Load, options: Options, first: str) -> Iterator[HullRun | EmulatorError]:
    for deck in decks:
        try:
            yield run_hull(deck, load, options, first)
        except EmulatorError as error:
            yield error


def _port(route: Port, sample: Sample) -> Answer:
    try:
        hull = convex_hull(
            sample.drawn.points,
            route.arithmetic,
            route.epsilon or None,
            route.translate,
            history=route.history,
            on_refusal="return",
        )
    except RangeError as error:
        return Answer(OTHERWISE, str(error))
    answer = answer_of_hull(hull, sample)
    return replace(answer, figures={**answer.figures, **_measured(route, sample, hull)})


def _measured(route: Route, sample: Sample, run: HullRun | Hull) -> Figures:
    figures: dict[str, int | str] = {}
    for name in route.measures:
        in_module = user_code(f"route {route.name}: measure {name}", name.partition(":")[0])
        try:
            with nullcontext() if name in MEASURES else in_module:
                measured = named("measure", name, MEASURES)(sample, run)
        except (TypeError, ValueError) as error:
            raise PlanError(f"route {route.name}: measure {name}: {error}") from error
        invalid = [figure for figure, value in measured.items() if type(value) not in (int, str)]
        if invalid:
            raise PlanError(f"route {route.name}: measure {name}: the figure {invalid[0]} is not an integer or text")
        figures.update(measured)
    return figures

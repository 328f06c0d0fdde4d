"""A study from plan to report, in a folder: checked, begun, interrupted, resumed, finished."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Sequence
from contextlib import ExitStack, closing, suppress
from pathlib import Path
from typing import Any

from emulator.compiled.runner import compile_engine, why_plain
from emulator.files import UNFINISHED
from emulator.jit.functions import NotInstalled
from emulator.language.cards import deck_from_lines
from emulator.machine.machine import Machine
from emulator.numbers import numbers
from emulator.numbers.decimal import DecimalNumbers
from emulator.progress import Progress
from modern.edition import programs
from modern.formats.deck import coordinate_field
from modern.port import convex_hull
from modern.study.chartfile import write_charts
from modern.study.families import draw_sample
from modern.study.interrupt import Interrupt, watching
from modern.study.manifest import NAME, differences, manifest, read_manifest, versions, write_manifest
from modern.study.measures import measure_of
from modern.study.parquet import write_parquet
from modern.study.plan import Cell, Plan, PlanError, Programs, Route, StudyFileError
from modern.study.plots import can_plot, draw
from modern.study.report import Report, outcome_report, write_report
from modern.study.routes import options_of, programs_of
from modern.study.sample import CARD_DIGITS
from modern.study.store import Store
from modern.study.workers import connect, in_processes, on_cluster, processes

MOST_FILES = 1_000_000
"""Files of rows a study may have: their names are held in memory while it runs."""

Reporter = Callable[[Plan, Store], Report]


def run_study(
    plan: Plan,
    folder: str | Path,
    report: Reporter = outcome_report,
    *,
    workers: int = 0,
    dask: str = "",
    resume: bool = False,
    quiet: bool = False,
    command: Sequence[str] = (),
) -> Report:
    """Carry out a plan in ``folder`` and write its report there.

    report: makes the report from the finished rows.  workers: processes, 0 for as many as there are processors;
    with 1 nothing but this process works.  dask: the address of a dask.distributed scheduler, instead of processes.
    resume: go on with a study begun in the folder; where none is, it is begun.  quiet: no progress.  command: the
    command line, for the manifest.

    Interrupted in whatever way, the chunks finished are kept, and ``resume`` does the others; a first Ctrl-C lets those
    begun be finished, a second stops at once, both with KeyboardInterrupt.  The rows, and so the report, do not
    depend on interruptions, workers or machine.  Where a script calls this with more than one worker, it must do so
    under ``if __name__ == "__main__":``, as the processes begin by importing it.

    Raises PlanError (one line) for a plan that cannot be carried out, for a folder that holds a study and ``resume``
    is not asked for, or another one and it is, and for files that cannot be written; what is done is kept.
    """
    check_plan(plan)
    folder = Path(folder)
    with ExitStack() as stack:
        client = stack.enter_context(closing(connect(dask))) if dask else None
        document = _begin(plan, folder, resume, command)
        # The engine of a cluster's workers is theirs; nothing is known of it here.
        for line in () if quiet or client else plain_lines(plan):
            print(line, file=sys.stderr)
        store = stack.enter_context(closing(Store.open(folder, plan)))
        # The worker processes load the machine code from numba's cache. The workers of a cluster compile it themselves.
        if not client and _needs_engine(plan):
            with suppress(NotInstalled):
                compile_engine()
        with watching() as interrupt:
            _complete(plan, store, client, workers or processes(), quiet, interrupt)
        found = report(plan, store)
        without = can_plot()
        if without and not quiet:
            print(without, file=sys.stderr)
        write_charts(folder, found.charts)
        for chart in () if without else found.charts:
            draw(chart, folder)
        write_report(folder, plan, found, not without)
        write_parquet(folder, plan, store)
        write_manifest(folder, {**document, "decks_sha256": store.decks_sha256(), "complete": True})
    return found


def plain_lines(plan: Plan) -> tuple[str, ...]:
    """Why routes of a plan run on the plain engine, a line for each reason; none where all can be compiled."""
    return tuple(line for line in dict.fromkeys(why_plain(options_of(route)) for route in _of_programs(plan)) if line)


def _needs_engine(plan: Plan) -> bool:
    """Return True if the compiled engine can run at least one route of the plan."""
    return any(not why_plain(options_of(route)) for route in _of_programs(plan))


def _of_programs(plan: Plan) -> Iterable[Programs]:
    """Routes of a plan that run the programs, each once."""
    return dict.fromkeys(route for cell in plan.cells for route in cell.routes if isinstance(route, Programs))


def cut_lines(plan: Plan) -> tuple[str, ...]:
    """Where digits beyond those of a card are lost between the programs, a line a route."""
    return tuple(
        f"route {route.name}: the cards between the programs hold {CARD_DIGITS} digits of a number; "
        "uncut = true keeps them all"
        for route in _of_programs(plan)
        if not route.uncut and not _fits_cards(route)
    )


def _fits_cards(route: Programs) -> bool:
    found = numbers(route.arithmetic)
    return isinstance(found, DecimalNumbers) and found.profile.rules.digits <= CARD_DIGITS


def _complete(
    plan: Plan,
    store: Store,
    client: Any,
    workers: int,
    quiet: bool,
    interrupt: Interrupt,
) -> None:
    """The chunks that are not there, done and kept one by one.  Raises KeyboardInterrupt after a first Ctrl-C."""
    missing = store.missing()
    left = sum(chunk.stop - chunk.start for chunk in missing)
    progress = Progress(plan.samples, plan.samples - left, quiet=quiet)
    if client:
        done = on_cluster(plan, missing, client)
    else:
        done = in_processes(plan, missing, workers, interrupt)
    try:
        with closing(done):
            for chunk, text in done:
                store.add(chunk, text)
                progress.add(chunk.stop - chunk.start)
                interrupt.finished += 1
    finally:
        progress.close()
    if interrupt.asked:
        raise KeyboardInterrupt


def _begin(plan: Plan, folder: Path, resume: bool, command: Sequence[str]) -> dict[str, object]:
    """The folder made ready, and the study's manifest."""
    here = manifest(plan, command, versions())
    try:
        begun = (folder / NAME).exists()
        if resume and begun:
            there = read_manifest(folder)
            differing = differences(there, here)
            if differing:
                raise StudyFileError(f"{folder}: cannot resume: {differing}")
            return there
        if begun:
            raise StudyFileError(f"{folder}: holds a study; --resume goes on with it, --out puts another elsewhere")
        # A run killed before its first file was in place leaves the file beside.
        strange = folder.is_dir() and any(not path.name.startswith(UNFINISHED) for path in folder.iterdir())
        if strange or (folder.exists() and not folder.is_dir()):
            raise StudyFileError(f"{folder}: is there and is not empty; --out names another folder")
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise StudyFileError(f"{folder}: {(error.strerror or str(error)).lower()}") from None
    write_manifest(folder, here)
    return here


def check_plan(plan: Plan) -> None:
    """Look through a plan before it is begun.  Raises PlanError (or FamilyError), one line, for what is wrong."""
    if not plan.name or not plan.name.replace("-", "").replace("_", "").isalnum():
        raise PlanError(f"a study's name is letters, digits, - and _; {plan.name!r} is not")
    if not plan.cells:
        raise PlanError(f"{plan.name}: the plan has no cells")
    _differ((cell.name for cell in plan.cells), f"{plan.name}: two cells have the key")
    files = 0
    for cell in plan.cells:
        _check_cell(cell, plan.seed)
        files += -(-cell.samples // cell.chunk)
    if files > MOST_FILES:
        raise PlanError(
            f"{plan.name}: {plan.samples:,} samples are {files:,} files of rows; a study has at most {MOST_FILES:,}"
        )


def _check_cell(cell: Cell, seed: int) -> None:
    where = f"cell {cell.name}".rstrip()
    if cell.samples < 1 or cell.chunk < 1:
        raise PlanError(f"{where}: samples and chunk are 1 or more")
    if not cell.routes:
        raise PlanError(f"{where}: no routes")
    _differ((route.name for route in cell.routes), f"{where}: two routes have the name")
    if cell.reference and cell.reference not in {route.name for route in cell.routes}:
        raise PlanError(f"{where}: no route is called {cell.reference!r}, the reference")
    for route in cell.routes:
        _check_route(route)
    draw_sample(cell, seed, 0)


def _check_route(route: Route) -> None:
    if not route.name:
        raise PlanError("a route has no name")
    for name in route.measures:
        measure_of(name)
    if not isinstance(route, Programs):
        try:
            convex_hull([(0, 0, 0)], route.arithmetic, route.epsilon or None)
        except ValueError as error:
            raise PlanError(f"route {route.name}: {error}") from None
        return
    if route.state not in ("listing", "examples") or route.bounds not in ("strict", "core") or route.limit < 1:
        raise PlanError(f"route {route.name}: state is listing or examples, bounds strict or core, limit 1 or more")
    if bool(route.epsilon) != ("epsilon" in route.layers):
        raise PlanError(f"route {route.name}: an epsilon needs the layer 'epsilon', and that layer an epsilon")
    try:
        coordinate_field(route.epsilon or "0")
    except ValueError as error:
        raise PlanError(f"route {route.name}: epsilon: {error}") from None
    options = options_of(route)
    first, load = programs_of(route)
    for name in (first, *(text for text in programs.TEXTS if text != "program1")):
        Machine(load(name), deck_from_lines(route.name, ["1"]), options)


def _differ(names: Iterable[str], words: str) -> None:
    seen: set[str] = set()
    for name in names:
        if name in seen:
            raise PlanError(f"{words} {name!r}")
        seen.add(name)

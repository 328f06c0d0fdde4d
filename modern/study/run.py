"""Run a study in a folder: check the plan, begin or resume the study, compute its chunks, and write the report."""

import os
import sqlite3
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path
from typing import Any

from emulator.compiled.replay import must_compile_repetitions
from emulator.compiled.runner import must_compile, why_plain
from emulator.errors import expect, quoted
from emulator.files import UNFINISHED, reason
from emulator.language.cards import deck_from_lines
from emulator.machine.machine import Machine
from emulator.numbers import Numbers, numbers
from emulator.numbers.decimal import DecimalNumbers
from emulator.progress import Progress
from modern.edition import programs
from modern.formats.deck import with_epsilon
from modern.port import convex_hull
from modern.study.chartfile import write_charts
from modern.study.families import draw_sample
from modern.study.manifest import NAME, first_difference, manifest, plan_sum, read_manifest, versions, write_manifest
from modern.study.measures import MEASURES, OF_PORT
from modern.study.plan import Cell, Plan, PlanError, Port, Programs, Route, StudyFileError, named
from modern.study.plots import can_plot, draw
from modern.study.report import Report, outcome_report, write_report
from modern.study.routes import options_of, programs_of
from modern.study.sample import CARD_DIGITS
from modern.study.store import ROWS, Store
from modern.study.workers import connect, in_processes, on_cluster, processes

# A study has at most this number of files of rows, because their names are held in memory while it runs.
MOST_FILES = 1_000_000

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
    """Run the study of a plan in a folder, write its report there and return the report.

    The rows, and therefore the report, do not depend on interruptions, on the number of workers or on the machine.

    Parameters
    ----------
    plan
        The study.
    folder
        The folder for all files.  It is created; it must be empty unless a study is resumed.
    report
        The function that makes the report from the finished rows.
    workers
        The number of worker processes; 0 starts one for each processor.  With 1, this process does all the work.
    dask
        The address of a dask.distributed scheduler, whose workers are used instead of processes.
    resume
        Continue the study in the folder.  If the folder holds none, the study is begun.
    quiet
        Do not print progress.
    command
        The command line, for the manifest.

    Raises
    ------
    PlanError
        With a one-line message, if the plan cannot be carried out, if the folder holds a study and ``resume`` is
        false, if the folder holds a different study, or if a file cannot be written.  Finished chunks are kept.
    KeyboardInterrupt
        Ctrl-C stops the study at once.  Finished chunks are kept, and ``resume`` computes the others.

    Notes
    -----
    A script that uses more than one worker must call this function under ``if __name__ == "__main__":``, because each
    worker process begins by importing the script.
    """
    expect(plan, Plan, "plan")
    expect(folder, (str, os.PathLike), "folder")
    check_plan(plan)
    folder = Path(folder)
    with ExitStack() as stack:
        client = stack.enter_context(closing(connect(dask))) if dask else None
        document = _begin(plan, folder, resume, command)
        # This process does not know which engine the workers of a cluster have.
        for line in () if quiet or client else plain_lines(plan):
            print(line, file=sys.stderr)
        store = stack.enter_context(closing(Store.open(folder, plan)))
        if not client:  # the workers of a cluster compile the code themselves
            stack.enter_context(_compiling(plan, quiet))
        _complete(plan, store, client, workers or processes(), quiet)
        finished_report = report(plan, store)
        no_plots = can_plot()
        if no_plots and not quiet:
            print(no_plots, file=sys.stderr)
        write_charts(folder, finished_report.charts)
        for chart in () if no_plots else finished_report.charts:
            draw(chart, folder)
        write_report(folder, plan, finished_report, not no_plots)
        write_manifest(folder, {**document, "decks_sha256": store.decks_sha256(), "complete": True})
    return finished_report


def verify_study(folder: Path) -> tuple[Plan, int, list[str]]:
    """Return a study's plan, the number of its intact rows, and a message for each damaged file."""
    document = read_manifest(folder)
    try:
        plan = Plan.of_document(document["plan"])
        is_plan = plan.document() == document["plan"]
        is_plan &= document.get("plan_sha256") in (None, plan_sum(document["plan"]))  # earlier manifests lack it
    except (KeyError, TypeError, ValueError, AttributeError):
        is_plan = False
    if not is_plan:
        raise StudyFileError(f"{folder / NAME}: the plan in the manifest is damaged")
    # The index is not needed, and another run may be using it.
    with closing(Store(folder, plan, sqlite3.connect(":memory:"))) as store:
        intact, messages = store.verify()
        if document.get("complete") and not messages:
            if intact < plan.samples:
                messages.append(f"{folder / ROWS}: {plan.samples - intact:,} rows are missing; --resume computes them")
            elif document.get("decks_sha256") != store.decks_sha256():
                messages.append(f"{folder / NAME}: decks_sha256 is not the SHA-256 of the decks in the rows")
    return plan, intact, messages


def plain_lines(plan: Plan) -> tuple[str, ...]:
    """Return a line for each reason why routes of a plan must run in the interpreter instead of compiled code."""
    reasons = dict.fromkeys(why_plain(options_of(route)) for route in _program_routes(plan))
    return tuple(reason for reason in reasons if reason)


@contextmanager
def _compiling(plan: Plan, quiet: bool) -> Iterator[subprocess.Popen[bytes] | None]:
    """Compile the code that a plan needs in another process, while the workers use the interpreter.

    If the compilation fails, print a note at the end of the ``with`` block, unless ``quiet`` is true.
    """
    calls = []
    if must_compile() and any(not why_plain(options_of(route)) for route in _program_routes(plan)):
        calls += ["from emulator.compiled.runner import compile_engine", "compile_engine()"]
    if any("alarms" in route.measures for route in _program_routes(plan)) and must_compile_repetitions():
        calls += ["from emulator.compiled.replay import compile_repetitions", "compile_repetitions()"]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    command, silent = [sys.executable, "-c", "; ".join(calls)], subprocess.DEVNULL
    process = subprocess.Popen(command, env=environment, stdout=silent, stderr=silent) if calls else None
    try:
        yield process
        if process and process.poll() and not quiet:
            print("the engine could not be compiled; the study used the interpreter", file=sys.stderr)
    finally:
        if process:
            process.terminate()
            process.wait()


def _program_routes(plan: Plan) -> Iterable[Programs]:
    return dict.fromkeys(route for cell in plan.cells for route in cell.routes if isinstance(route, Programs))


def cut_lines(plan: Plan) -> tuple[str, ...]:
    """Return a note for each route in which numbers lose digits when one program passes them to the next on cards."""

    def fits_cards(arithmetic: Numbers) -> bool:
        return isinstance(arithmetic, DecimalNumbers) and arithmetic.profile.rules.digits <= CARD_DIGITS

    return tuple(
        f"route {route.name}: the cards between the programs hold {CARD_DIGITS} digits of a number; "
        "uncut = true keeps all digits"
        for route in _program_routes(plan)
        if not route.uncut and not fits_cards(numbers(route.arithmetic))
    )


def _complete(plan: Plan, store: Store, client: Any, workers: int, quiet: bool) -> None:
    missing = store.missing()
    samples_missing = sum(chunk.stop - chunk.start for chunk in missing)
    progress = Progress(plan.samples, plan.samples - samples_missing, quiet=quiet)
    finished = on_cluster(plan, missing, client) if client else in_processes(plan, missing, workers)
    try:
        with closing(finished):
            for chunk, rows in finished:
                store.add(chunk, rows)
                progress.add(chunk.stop - chunk.start)
    finally:
        progress.close()


def _begin(plan: Plan, folder: Path, resume: bool, command: Sequence[str]) -> dict[str, object]:
    current = manifest(plan, command, versions())
    try:
        holds_study = (folder / NAME).exists()
        if resume and holds_study:
            earlier = read_manifest(folder)
            difference = first_difference(earlier, current)
            if difference:
                raise StudyFileError(f"{folder}: cannot resume: {difference}")
            return earlier
        if holds_study:
            raise StudyFileError(
                f"{folder}: already holds a study; --resume continues it, --out chooses another folder"
            )
        # A run that was killed before its first file was in place leaves a temporary file.
        occupied = folder.is_dir() and any(not path.name.startswith(UNFINISHED) for path in folder.iterdir())
        if occupied or (folder.exists() and not folder.is_dir()):
            raise StudyFileError(f"{folder}: exists and is not empty; --out chooses another folder")
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise StudyFileError(f"{folder}: {reason(error)}") from None
    write_manifest(folder, current)
    return current


def check_plan(plan: Plan) -> None:
    """Check a plan before it is begun.  Raise PlanError (or FamilyError) with one line for the first fault."""
    if not plan.name or not plan.name.replace("-", "").replace("_", "").isalnum():
        raise PlanError(f"the name of a study consists of letters, digits, - and _; {quoted(plan.name)} does not")
    if not plan.cells:
        raise PlanError(f"{plan.name}: expected at least one cell in the plan, found none")
    _check_distinct((cell.name for cell in plan.cells), f"{plan.name}: two cells have the key")
    files = 0
    for route in dict.fromkeys(route for cell in plan.cells for route in cell.routes):
        check_route(route)
    for cell in plan.cells:
        check_cell(cell, plan.seed)
        files += -(-cell.samples // cell.chunk)
    if files > MOST_FILES:
        raise PlanError(
            f"{plan.name}: {plan.samples:,} samples would be stored in {files:,} files; expected at most "
            f"{MOST_FILES:,}: enlarge chunk, the number of samples in a file"
        )


def check_cell(cell: Cell, seed: int) -> None:
    """Check the fields of a cell except its routes, and draw its first sample.  Raise PlanError or FamilyError."""
    where = f"cell {cell.name}".rstrip()
    if cell.samples < 1 or cell.chunk < 1:
        raise PlanError(f"{where}: samples and chunk must be at least 1")
    if not cell.routes:
        raise PlanError(f"{where}: expected at least one route, found none")
    _check_distinct((route.name for route in cell.routes), f"{where}: two routes have the name")
    if cell.reference and cell.reference not in {route.name for route in cell.routes}:
        raise PlanError(f"{where}: the reference {quoted(cell.reference)} is not one of its routes")
    draw_sample(cell, seed, 0)


def check_route(route: Route) -> None:
    """Raise PlanError if a route has an unknown measure or a wrong value, or if its programs do not fit in core."""
    if not route.name:
        raise PlanError("expected a name for every route; one has none")
    for name in route.measures:
        named("measure", name, MEASURES)
        if name in MEASURES and (name in OF_PORT) != isinstance(route, Port):
            possible = [known for known in MEASURES if (known in OF_PORT) == isinstance(route, Port)]
            kind = "the port" if isinstance(route, Port) else "the programs"
            raise PlanError(
                f"route {route.name}: the measure {name} does not exist for {kind}, which has {', '.join(possible)}"
            )
        if name in OF_PORT and isinstance(route, Port) and not route.history:
            raise PlanError(f"route {route.name}: the measure {name} needs history = true")
    if not isinstance(route, Programs):
        try:
            convex_hull([(0, 0, 0)], route.arithmetic, route.epsilon or None)
        except ValueError as error:
            raise PlanError(f"route {route.name}: {error}") from None
        return
    if route.state not in ("listing", "examples") or route.bounds not in ("strict", "core") or route.limit < 1:
        raise PlanError(
            f"route {route.name}: state must be listing or examples, bounds strict or core, limit 1 or more"
        )
    if bool(route.epsilon) != ("epsilon" in route.layers):
        raise PlanError(f"route {route.name}: an epsilon and the layer 'epsilon' must be given together")
    try:
        with_epsilon(deck_from_lines(route.name, ["1"]), route.epsilon or "0")
    except ValueError as error:
        raise PlanError(f"route {route.name}: {error}") from None
    # Making a machine for each program checks that the program fits into core storage.
    options = options_of(route)
    first, load = programs_of(route)
    for name in (first, *(text for text in programs.TEXTS if text != "program1")):
        Machine(load(name), deck_from_lines(route.name, ["1"]), options)


def _check_distinct(names: Iterable[str], message: str) -> None:
    earlier: set[str] = set()
    for name in names:
        if name in earlier:
            raise PlanError(f"{message} {quoted(name)}")
        earlier.add(name)

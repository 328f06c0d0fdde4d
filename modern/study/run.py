"""A study from plan to report, in a folder: begun, interrupted, resumed, finished."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from contextlib import ExitStack, closing
from pathlib import Path
from typing import Any

from emulator.compiled.engine import why_plain
from modern.study.check import check_plan
from modern.study.dasked import carry_out_on_dask, connect
from modern.study.files import BESIDE, StudyFileError
from modern.study.manifest import NAME, differences, manifest, read_manifest, versions, write_manifest
from modern.study.plan import Plan, Programs
from modern.study.plots import can_plot, draw
from modern.study.progress import Progress
from modern.study.report import Report, outcome_report, write_report
from modern.study.routes import options_of
from modern.study.runner import carry_out, processes
from modern.study.store import Store

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

    Interrupted in whatever way, the chunks finished are kept, and ``resume`` does the others; the rows, and so the
    report, do not depend on interruptions, workers or machine.  Where a script calls this with more than one worker,
    it must do so under ``if __name__ == "__main__":``, as the processes begin by importing it.

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
        _complete(plan, store, client, workers or processes(), quiet)
        found = report(plan, store)
        without = can_plot()
        if without and not quiet:
            print(without, file=sys.stderr)
        for chart in () if without else found.charts:
            draw(chart, folder)
        write_report(folder, plan, found, not without)
        store.parquet()
        write_manifest(folder, {**document, "decks_sha256": store.decks_sha256(), "complete": True})
    return found


def plain_lines(plan: Plan) -> tuple[str, ...]:
    """Why routes of a plan run on the plain engine, a line for each reason; none where all can be compiled."""
    routes = dict.fromkeys(route for cell in plan.cells for route in cell.routes if isinstance(route, Programs))
    return tuple(line for line in dict.fromkeys(why_plain(options_of(route)) for route in routes) if line)


def _complete(plan: Plan, store: Store, client: Any, workers: int, quiet: bool) -> None:
    """The chunks that are not there, done and kept one by one."""
    missing = store.missing()
    left = sum(chunk.stop - chunk.start for chunk in missing)
    progress = Progress(plan.samples, plan.samples - left, quiet=quiet)
    done = carry_out_on_dask(plan, missing, client) if client else carry_out(plan, missing, workers)
    try:
        with closing(done):
            for chunk, text in done:
                store.add(chunk, text)
                progress.add(chunk.stop - chunk.start)
    finally:
        progress.close()


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
        strange = folder.is_dir() and any(not path.name.startswith(BESIDE) for path in folder.iterdir())
        if strange or (folder.exists() and not folder.is_dir()):
            raise StudyFileError(f"{folder}: is there and is not empty; --out names another folder")
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise StudyFileError(f"{folder}: {(error.strerror or str(error)).lower()}") from None
    write_manifest(folder, here)
    return here

"""The work of a study: chunks of samples become rows, here, in worker processes, or on a dask.distributed cluster."""

from __future__ import annotations

import json
import logging
import multiprocessing
import os
import re
import signal
import threading
from collections.abc import Generator, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from importlib import import_module
from itertools import islice
from typing import Any

from emulator.errors import EmulatorError
from modern.study.families import draw_sample
from modern.study.index import Row
from modern.study.interrupt import Interrupt
from modern.study.manifest import versions
from modern.study.outcomes import Answer, reordered
from modern.study.plan import Cell, Chunk, Plan, PlanError
from modern.study.routes import carry_out
from modern.study.sample import Sample, judge
from modern.thesis.batch import Runs

AHEAD = 2
"""Chunks under way for each worker: enough that none waits, few enough that memory stays flat."""
TIMEOUT = 10
"""Seconds to wait for a scheduler."""
_ADDRESS = re.compile(r"(\w+://)?[^\s:/]+:\d{1,5}|\w+://\[[0-9a-fA-F:]+\]:\d{1,5}")

Done = tuple[Chunk, str]
Stamped = tuple[dict[str, str], str, str]
"""Versions of the worker, a chunk's rows, or why there are none."""


def chunk_text(cell: Cell, seed: int, chunk: Chunk) -> str:
    """The chunk's rows as JSONL text, one line a sample; ``cell`` is the chunk's, ``seed`` the study's."""
    return "".join(json.dumps(row, separators=(",", ":")) + "\n" for row in chunk_rows(cell, seed, chunk))


def chunk_rows(cell: Cell, seed: int, chunk: Chunk) -> Iterator[Row]:
    """The chunk's rows: seed, deck, the judge's figures, and by route outcome, detail and figures.

    Raises EmulatorError where the plan cannot be carried out.
    """
    samples = [judge(draw_sample(cell, seed, index), f"sample {index}") for index in range(chunk.start, chunk.stop)]
    runs = Runs()
    found = {route.name: carry_out(route, samples, runs) for route in cell.routes}
    reference = found[cell.reference or cell.routes[0].name]
    for place, sample in enumerate(samples):
        index = chunk.start + place
        answers = {name: reordered(answer[place], reference[place]) for name, answer in found.items()}
        yield _row(chunk.cell, index, cell.seed(seed, index), sample, answers)


def _row(cell: int, index: int, seed: str, sample: Sample, answers: dict[str, Answer]) -> Row:
    row: Row = {
        "cell": cell,
        "index": index,
        "seed": seed,
        "tags": dict(sample.drawn.tags),
        "deck": [card.text for card in sample.deck.cards],
        "judge": sample.figures(),
        "runs": {
            name: {"outcome": one.outcome, "detail": one.detail, "figures": dict(one.figures)}
            for name, one in answers.items()
        },
    }
    if not row["tags"]:
        del row["tags"]
    return row


def task(cell: Cell, seed: int, chunk: Chunk) -> tuple[str, str]:
    """A chunk's rows, or in a line why there are none; errors are sent as text, which every process can read."""
    try:
        return chunk_text(cell, seed, chunk), ""
    except EmulatorError as error:
        return "", str(error)


def rows_or_error(text: str, error: str) -> str:
    """The rows, where :func:`task` gave any.  Raises PlanError."""
    if error:
        raise PlanError(error)
    return text


def processes() -> int:
    """How many processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def in_processes(
    plan: Plan,
    chunks: Sequence[Chunk],
    workers: int,
    interrupt: Interrupt | None = None,
) -> Generator[Done]:
    """Each chunk with its rows, in whatever order they are done; one worker is this process itself.

    ``interrupt`` receives the number of chunks in hand. After a request to stop, only these are finished. Raise
    PlanError if a chunk fails or a worker process dies.
    """
    interrupt = interrupt or Interrupt()
    if workers == 1 or len(chunks) <= 1:
        interrupt.in_hand = 1
        for chunk in chunks:
            if interrupt.asked:
                return
            yield chunk, rows_or_error(*task(plan.cells[chunk.cell], plan.seed, chunk))
        return
    context = multiprocessing.get_context("spawn")
    pool = ProcessPoolExecutor(min(workers, len(chunks)), context, initializer=_begin_worker)
    try:
        yield from _from_pool(plan, chunks, pool, workers, interrupt)
    except BrokenProcessPool:
        raise PlanError("a worker process died (was it killed, or out of memory?); --resume goes on") from None
    finally:
        # Where Ctrl-C fell before the pool had begun its thread there is nothing to wait for, and it says so by this.
        with suppress(RuntimeError):
            pool.shutdown(wait=True, cancel_futures=True)


def _from_pool(
    plan: Plan,
    chunks: Sequence[Chunk],
    pool: ProcessPoolExecutor,
    workers: int,
    interrupt: Interrupt,
) -> Generator[Done]:
    waiting = iter(chunks)
    under_way: dict[Future[tuple[str, str]], Chunk] = {}
    while True:
        for chunk in islice(waiting, 0 if interrupt.asked else AHEAD * workers - len(under_way)):
            under_way[pool.submit(task, plan.cells[chunk.cell], plan.seed, chunk)] = chunk
        if interrupt.asked:
            for future in [future for future in under_way if future.cancel()]:
                del under_way[future]
        interrupt.in_hand = len(under_way)
        if not under_way:
            return
        done, _ = wait(under_way, return_when=FIRST_COMPLETED)
        for future in done:
            yield under_way.pop(future), rows_or_error(*future.result())


def _begin_worker() -> None:
    """Leave Ctrl-C to the process that began the study, and end when that ends, however it does."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()

    def watch() -> None:
        if parent is not None:
            parent.join()
            os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


def connect(address: str) -> Any:
    """A client of the cluster at ``tcp://HOST:PORT``.  Raises PlanError without dask, and without a cluster there."""
    try:
        distributed = import_module("distributed")
    except ImportError:
        raise PlanError("--dask needs dask.distributed: pip install 'hull1620[dask]'") from None
    if not _ADDRESS.fullmatch(address):
        raise PlanError(f"--dask {address}: an address is tcp://HOST:PORT")
    # A scheduler lost is said in one line by on_cluster, not in forty by the client's log.
    logging.getLogger("distributed.client").setLevel(logging.CRITICAL)
    try:
        return distributed.Client(address, timeout=TIMEOUT, set_as_default=False)
    except (OSError, ValueError, ImportError) as error:
        raise PlanError(f"--dask {address}: {_first_line(error)}") from None


def on_cluster(plan: Plan, chunks: Sequence[Chunk], client: Any) -> Generator[Done]:
    """As :func:`in_processes`, by the workers of the cluster ``client`` is connected to.

    A chunk whose worker dies is begun anew by another, as often as the scheduler's ``allowed-failures`` has it.
    Raises PlanError where the cluster has no workers or goes away, and where a worker has other versions than this
    process.
    """
    distributed = import_module("distributed")
    try:
        yield from _from_cluster(plan, chunks, client, distributed.as_completed(loop=client.loop))
    except distributed.client.FutureCancelledError:
        raise PlanError("--dask: the cluster has gone away; --resume goes on") from None
    except (distributed.KilledWorker, OSError) as failure:
        raise PlanError(f"--dask: {_first_line(failure)}; --resume goes on") from None


def _from_cluster(plan: Plan, chunks: Sequence[Chunk], client: Any, completed: Any) -> Iterator[Done]:
    threads = sum(client.nthreads().values())
    if not threads:
        raise PlanError("--dask: the cluster has no workers")
    try:
        client.run(_loaded)
    except Exception as error:
        # A worker that cannot load a task tells nobody; asked this way, it says why.
        raise PlanError(f"--dask: a worker cannot load hull1620: {_first_line(error)}") from None
    waiting = iter(chunks)
    under_way: dict[str, Chunk] = {}
    own = versions()

    def submit(count: int) -> None:
        for chunk in islice(waiting, count):
            future = client.submit(_stamped, plan.cells[chunk.cell], plan.seed, chunk, pure=False)
            under_way[future.key] = chunk
            completed.add(future)

    submit(AHEAD * threads)
    for future in completed:
        made, text, failed = future.result()
        chunk = under_way.pop(future.key)
        future.release()
        for name, version in own.items():
            if made.get(name) != version:
                raise PlanError(
                    f"--dask: a worker has {name} {made.get(name) or '(not installed)'}, "
                    f"this process {version or '(not installed)'}"
                )
        submit(1)
        yield chunk, rows_or_error(text, failed)


def _loaded() -> None:
    """What a worker can call that has hull1620."""


def _stamped(cell: Cell, seed: int, chunk: Chunk) -> Stamped:
    text, failed = task(cell, seed, chunk)
    return versions(), text, failed


def _first_line(error: BaseException) -> str:
    return str(error).splitlines()[0] if str(error) else type(error).__name__

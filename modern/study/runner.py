"""Chunks carried out by worker processes; their rows as they come."""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
from collections.abc import Generator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool

from emulator.errors import EmulatorError
from modern.study.chunks import chunk_text
from modern.study.plan import Cell, Chunk, Plan, PlanError

Done = tuple[Chunk, str]
AHEAD = 2
"""Chunks under way for each worker: enough that none waits, few enough that memory stays flat."""


def processes() -> int:
    """How many processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def carry_out(plan: Plan, chunks: Sequence[Chunk], workers: int) -> Generator[Done]:
    """Each chunk with its rows, in whatever order they are done; one worker is this process itself.

    Raises PlanError where a chunk cannot be carried out, or a worker dies.
    """
    if workers == 1 or len(chunks) <= 1:
        for chunk in chunks:
            yield chunk, rows_or_error(*task(plan.cells[chunk.cell], plan.seed, chunk))
        return
    context = multiprocessing.get_context("spawn")
    pool = ProcessPoolExecutor(min(workers, len(chunks)), context, initializer=_begin_worker)
    try:
        yield from _streamed(plan, chunks, pool, workers)
    except BrokenProcessPool:
        raise PlanError("a worker process died (was it killed, or out of memory?); --resume goes on") from None
    finally:
        pool.shutdown(wait=True, cancel_futures=True)


def _streamed(plan: Plan, chunks: Sequence[Chunk], pool: ProcessPoolExecutor, workers: int) -> Generator[Done]:
    waiting = iter(chunks)
    under_way: dict[Future[tuple[str, str]], Chunk] = {}
    while True:
        for chunk in waiting:
            under_way[pool.submit(task, plan.cells[chunk.cell], plan.seed, chunk)] = chunk
            if len(under_way) >= AHEAD * workers:
                break
        if not under_way:
            return
        done, _ = wait(under_way, return_when=FIRST_COMPLETED)
        for future in done:
            yield under_way.pop(future), rows_or_error(*future.result())


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


def _begin_worker() -> None:
    """Leave Ctrl-C to the process that began the study, and end when that ends, however it does."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()

    def watch() -> None:
        if parent is not None:
            parent.join()
            os._exit(1)

    threading.Thread(target=watch, daemon=True).start()

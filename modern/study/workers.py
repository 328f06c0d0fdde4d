"""Compute the chunks of a study in this process, in worker processes or on a dask.distributed cluster.

The result of a chunk is the JSONL text of its rows.  Worker processes and clusters are both executors of
:mod:`concurrent.futures` and share one loop, which submits chunks and waits for them.
"""

import json
import logging
import multiprocessing
import os
import re
import signal
import threading
from collections.abc import Callable, Generator, Sequence
from concurrent.futures import FIRST_COMPLETED, CancelledError, Executor, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from functools import partial
from importlib import import_module
from itertools import islice
from typing import Any

from emulator.compiled.replay import compile_repetitions
from emulator.compiled.runner import must_compile
from emulator.errors import EmulatorError
from modern.study.families import draw_sample
from modern.study.manifest import versions
from modern.study.outcomes import reordered
from modern.study.plan import Cell, Chunk, Plan, PlanError
from modern.study.routes import carry_out
from modern.study.sample import judge
from modern.thesis.batch import Runs

# The number of chunks submitted for each worker: enough to keep it busy, few enough to limit memory use.
AHEAD = 2
# The number of seconds to wait for a scheduler.
TIMEOUT = 10
_ADDRESS = re.compile(r"(\w+://)?[^\s:/]+:\d{1,5}|\w+://\[[0-9a-fA-F:]+\]:\d{1,5}")

# A chunk and its rows.
FinishedChunk = tuple[Chunk, str]
# The rows of a chunk and an empty text, or an empty text and an error message.  Text can always be sent to another
# process, whereas an exception might not be unpickled there.
RowsOrError = tuple[str, str]


def chunk_text(cell: Cell, seed: int, chunk: Chunk, soon: bool = False) -> str:
    """Return the rows of a chunk as JSONL text, one line per sample.

    seed: the seed of the study.  soon: True to use the interpreter until another process has compiled the
    engine.
    """
    samples = [judge(draw_sample(cell, seed, index), f"sample {index}") for index in range(chunk.start, chunk.stop)]
    runs = Runs(soon and must_compile())
    answers = {route.name: carry_out(route, samples, runs) for route in cell.routes}
    reference = answers[cell.reference or cell.routes[0].name]
    text = ""
    for position, sample in enumerate(samples):
        of_sample = {name: reordered(answer[position], reference[position]) for name, answer in answers.items()}
        index = chunk.start + position
        row = {
            "cell": chunk.cell,
            "index": index,
            "seed": cell.seed(seed, index),
            **({"tags": dict(sample.drawn.tags)} if sample.drawn.tags else {}),
            "deck": [card.text for card in sample.deck.cards],
            "judge": sample.figures(),
            "runs": {
                name: {"outcome": answer.outcome, "detail": answer.detail, "figures": dict(answer.figures)}
                for name, answer in of_sample.items()
            },
        }
        text += json.dumps(row, separators=(",", ":")) + "\n"
    return text


def work_on(cell: Cell, seed: int, chunk: Chunk, soon: bool = False) -> RowsOrError:
    """Return a pair: the rows of a chunk, and an empty text.  After an error, return an empty text and the message."""
    try:
        return chunk_text(cell, seed, chunk, soon), ""
    except EmulatorError as error:
        return "", str(error)


def processes() -> int:
    """Return the number of processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def in_processes(plan: Plan, chunks: Sequence[Chunk], workers: int) -> Generator[FinishedChunk]:
    """Yield each chunk with its rows when the chunk is finished, in any order. Closing the generator ends the workers.

    Raise PlanError if a chunk cannot be carried out or a worker dies.
    """
    alone = workers == 1 or len(chunks) <= 1
    # Workers take seconds to start.  If no compiled code exists, this process computes the first sample before that.
    number = len(chunks) if alone else int(chunks[0].stop == 1 and must_compile())
    for chunk in chunks[:number]:
        yield chunk, chunk_text(plan.cells[chunk.cell], plan.seed, chunk, soon=True)
    chunks = chunks[number:]
    if not chunks:
        return
    earlier_children = set(multiprocessing.active_children())
    context = multiprocessing.get_context("spawn")
    pool = ProcessPoolExecutor(min(workers, len(chunks)), context, initializer=_begin_worker)
    try:
        yield from _submit_and_wait(plan, chunks, pool, AHEAD * workers, partial(work_on, soon=True))
    except BaseException as reason:
        # Unfinished chunks are abandoned.  A stored file of rows is always complete.
        for child in set(multiprocessing.active_children()) - earlier_children:
            child.terminate()
        if isinstance(reason, BrokenProcessPool):
            message = "a process of the study died (killed, or out of memory?); --resume continues the study"
            raise PlanError(message) from None
        raise
    finally:
        # shutdown() raises RuntimeError if Ctrl-C arrived before the pool had started its own thread.
        with suppress(RuntimeError):
            pool.shutdown(wait=True, cancel_futures=True)


def _submit_and_wait(
    plan: Plan,
    chunks: Sequence[Chunk],
    pool: Executor,
    most_submitted: int,
    work: Callable[[Cell, int, Chunk], RowsOrError],
) -> Generator[FinishedChunk]:
    """Yield each chunk with its rows when it is finished, while at most ``most_submitted`` chunks are in the pool."""
    waiting = iter(chunks)
    submitted: dict[Future[RowsOrError], Chunk] = {}
    while True:
        for chunk in islice(waiting, most_submitted - len(submitted)):
            submitted[pool.submit(work, plan.cells[chunk.cell], plan.seed, chunk)] = chunk
        if not submitted:
            return
        finished, _ = wait(submitted, return_when=FIRST_COMPLETED)
        for future in finished:
            chunk = submitted.pop(future)
            rows, error = future.result()
            if error:
                raise PlanError(error)
            yield chunk, rows


def _begin_worker() -> None:
    """Make a worker process ignore Ctrl-C, which its parent handles, and end when its parent ends or is killed."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()

    def watch() -> None:
        if parent is not None:
            parent.join()
            os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


def connect(address: str) -> Any:
    """Return a client of the cluster whose scheduler is at ``tcp://HOST:PORT``.

    Raise PlanError if dask.distributed is not installed or the scheduler does not answer.
    """
    try:
        distributed = import_module("distributed")
    except ImportError:
        raise PlanError("--dask needs dask.distributed: pip install 'hull1620[dask]'") from None
    if not _ADDRESS.fullmatch(address):
        raise PlanError(f"--dask {address}: expected an address of the form tcp://HOST:PORT")
    # on_cluster() reports a lost scheduler in one line; the client's log would add forty.
    logging.getLogger("distributed.client").setLevel(logging.CRITICAL)
    try:
        return distributed.Client(address, timeout=TIMEOUT, set_as_default=False)
    except (OSError, ValueError, ImportError) as error:
        raise PlanError(f"--dask {address}: {_first_line(error)}") from None


def on_cluster(plan: Plan, chunks: Sequence[Chunk], client: Any) -> Generator[FinishedChunk]:
    """Yield each chunk with its rows when the cluster of ``client`` has finished it, in any order.

    The scheduler repeats the chunk of a dead worker. Raise PlanError if the cluster fails, or if a worker has other
    versions of packages than this process.
    """
    distributed = import_module("distributed")
    threads = sum(client.nthreads().values())
    if not threads:
        raise PlanError("--dask: the cluster has no workers")
    try:
        client.run(_loaded)
    except Exception as error:
        # A worker that cannot unpickle a task fails silently.  Called this way, it reports the reason.
        raise PlanError(f"--dask: a worker cannot load hull1620: {_first_line(error)}") from None
    work = partial(_work_on_cluster, versions())
    try:
        yield from _submit_and_wait(plan, chunks, client.get_executor(pure=False), AHEAD * threads, work)
    except CancelledError:
        raise PlanError("--dask: the cluster has disappeared; --resume continues the study") from None
    except (distributed.KilledWorker, OSError) as failure:
        raise PlanError(f"--dask: {_first_line(failure)}; --resume continues the study") from None


def _loaded() -> None:
    """Do nothing. A worker of a cluster can call this function only if it can import hull1620."""


def _work_on_cluster(expected: dict[str, str], cell: Cell, seed: int, chunk: Chunk) -> RowsOrError:
    """Return the rows of a chunk, or an error message if this worker has other versions of packages than expected."""
    installed = versions()
    for name, version in expected.items():
        if installed.get(name) != version:
            return "", (
                f"--dask: a worker has {name} {installed.get(name) or '(not installed)'}, "
                f"this process {version or '(not installed)'}"
            )
    if any("alarms" in route.measures for route in cell.routes):
        compile_repetitions()
    return work_on(cell, seed, chunk)


def _first_line(error: BaseException) -> str:
    return str(error).splitlines()[0] if str(error) else type(error).__name__

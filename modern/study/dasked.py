"""Chunks carried out by the workers of a dask.distributed cluster; their rows as they come."""

from __future__ import annotations

import logging
import re
from collections.abc import Generator, Iterator, Sequence
from importlib import import_module
from itertools import islice
from typing import Any

from modern.study.manifest import versions
from modern.study.plan import Cell, Chunk, Plan, PlanError
from modern.study.runner import AHEAD, Done, rows_or_error, task

TIMEOUT = 10
"""Seconds to wait for a scheduler."""
_ADDRESS = re.compile(r"(\w+://)?[^\s:/]+:\d{1,5}|\w+://\[[0-9a-fA-F:]+\]:\d{1,5}")

Stamped = tuple[dict[str, str], str, str]
"""Versions of the worker, a chunk's rows, or why there are none."""


def connect(address: str) -> Any:
    """A client of the cluster at ``tcp://HOST:PORT``.  Raises PlanError without dask, and without a cluster there."""
    try:
        distributed = import_module("distributed")
    except ImportError:
        raise PlanError("--dask needs dask.distributed: pip install 'hull1620[dask]'") from None
    if not _ADDRESS.fullmatch(address):
        raise PlanError(f"--dask {address}: an address is tcp://HOST:PORT")
    # A scheduler lost is said in one line by carry_out_on_dask, not in forty by the client's log.
    logging.getLogger("distributed.client").setLevel(logging.CRITICAL)
    try:
        return distributed.Client(address, timeout=TIMEOUT, set_as_default=False)
    except (OSError, ValueError, ImportError) as error:
        raise PlanError(f"--dask {address}: {_words(error)}") from None


def carry_out_on_dask(plan: Plan, chunks: Sequence[Chunk], client: Any) -> Generator[Done]:
    """As :func:`modern.study.runner.carry_out`, by the workers of the cluster ``client`` is connected to.

    A chunk whose worker dies is begun anew by another, as often as the scheduler's ``allowed-failures`` has it.
    Raises PlanError where the cluster has no workers or goes
    away, and where a worker has other versions than this process.
    """
    distributed = import_module("distributed")
    try:
        yield from _streamed(plan, chunks, client, distributed.as_completed(loop=client.loop))
    except distributed.client.FutureCancelledError:
        raise PlanError("--dask: the cluster has gone away; --resume goes on") from None
    except (distributed.KilledWorker, OSError) as failure:
        raise PlanError(f"--dask: {_words(failure)}; --resume goes on") from None


def _streamed(plan: Plan, chunks: Sequence[Chunk], client: Any, completed: Any) -> Iterator[Done]:
    threads = sum(client.nthreads().values())
    if not threads:
        raise PlanError("--dask: the cluster has no workers")
    try:
        client.run(_loaded)
    except Exception as error:
        # A worker that cannot load a task tells nobody; asked this way, it says why.
        raise PlanError(f"--dask: a worker cannot load hull1620: {_words(error)}") from None
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


def _words(error: BaseException) -> str:
    return str(error).splitlines()[0] if str(error) else type(error).__name__

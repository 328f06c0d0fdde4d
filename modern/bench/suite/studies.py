"""Time the built-in studies: the rows that two cores compute in a second, and the time to the first rows.

``python -m modern.bench.suite.studies [NAME ...]`` prints a row of the table in ``docs/explanation/studies.md`` for
each study.  The rate is measured in processor time, so that other activity on the machine affects it little. The rate
is measured on a few samples of each cell, and each cell counts in proportion to the number of its samples.  To measure
the time to the first rows, a study is started in a new process without compiled code.  The time ends when the first
file of rows exists.
"""

import os
import resource
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from emulator.compiled.replay import compile_repetitions
from modern.study.builtin import names, study
from modern.study.plan import Chunk
from modern.study.workers import chunk_text

SAMPLES = 4
CORES = 2
_POLL = 0.02


def rows_per_second(name: str) -> float:
    """Return how many rows of a study two cores compute in a second, on average over its samples."""
    module = study(name)
    plan = module.plan(module.SAMPLES, 1963)
    compile_repetitions()
    for number in (0, len(plan.cells) - 1):
        chunk_text(plan.cells[number], plan.seed, Chunk(number, 0, 1))  # load the compiled code
    total = 0.0
    for number, cell in enumerate(plan.cells):
        count = min(SAMPLES, cell.samples)
        start = time.process_time()
        chunk_text(cell, plan.seed, Chunk(number, 0, count))
        total += cell.samples * (time.process_time() - start) / count
    return CORES * plan.samples / total


def first_rows(name: str) -> tuple[float, float]:
    """Run a study with no compiled code in the cache.  Return elapsed and processor seconds until its first rows."""
    with tempfile.TemporaryDirectory() as folder:
        out, environment = Path(folder) / "out", {**os.environ, "NUMBA_CACHE_DIR": f"{folder}/numba"}
        command = [sys.executable, "-m", "hull1620", "study", name, "--quiet"]
        command += ["--workers", str(CORES), "--out", str(out)]
        before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
        process = subprocess.Popen(command, env=environment, start_new_session=True)
        while process.poll() is None and not any(out.glob("rows/0*.jsonl")):
            time.sleep(_POLL)
        elapsed = time.perf_counter() - start
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGINT)
        elif process.returncode:
            raise SystemExit(f"{name}: the study failed with exit code {process.returncode}")
        process.wait()
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return elapsed, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


if __name__ == "__main__":
    for each in sys.argv[1:] or names():
        elapsed, used = first_rows(each)
        print(f"| {each} | {rows_per_second(each):.3g} | {elapsed:.1f} | {used:.1f} |", flush=True)

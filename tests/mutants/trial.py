"""Runs of an area's tests in copies of the tree: first without a mutant, then with one mutant after another."""

import compileall
import json
import os
import py_compile
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass
from pathlib import Path

from tests.mutants.areas import Area
from tests.mutants.sample import Mutant, mutated

TIMES = 4
"""The limit of a mutant is this multiple of the processor time of the unmutated tests, plus two seconds."""
WALL = 10
"""The limit in elapsed time is this multiple of the other limit. It stops mutants that wait for something."""
MEMORY = 4 * 1024**3
"""The limit of memory in bytes."""

KILLED, SURVIVED, TIMEOUT, EQUIVALENT = "killed", "survived", "timeout", "equivalent"
_NOTHING_TO_RUN = 5


class TrialError(Exception):
    """The tests cannot judge mutants. The message contains the last lines of pytest, if any."""


@dataclass(frozen=True, slots=True)
class Unmutated:
    """The tests of an area without a mutant: their number, seconds of processor time and seconds elapsed.

    ``order`` is the file with the seconds of each test, which order the tests of a mutant.
    """

    tests: int
    processor: float
    wall: float
    order: Path

    @property
    def limit(self) -> int:
        return int(TIMES * self.processor) + 2


@dataclass(frozen=True, slots=True)
class Verdict:
    """The outcome of a mutant."""

    mutant: Mutant
    outcome: str
    seconds: float


def copy_tree(root: Path, to: Path) -> Path:
    """Copy the files of the working tree that git does not ignore, and compile them. Return the copy.

    Python checks the compiled files by a hash of the source and not by its time, so a mutant is never taken for another
    one of the same length and the same second.
    """
    command = ["git", "-C", str(root), "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    names = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split("\0")
    for name in filter(None, names):
        if (root / name).is_file():
            (to / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(root / name, to / name)
    compileall.compile_dir(str(to), quiet=1, invalidation_mode=py_compile.PycInvalidationMode.CHECKED_HASH)
    return to


def unmutated(copy: Path, area: Area) -> Unmutated:
    """Run the tests twice: to measure the time of each, then in the order of these times.

    Raise TrialError if they fail or do not load every file of the area from this copy.
    """
    log = copy / f"{area.name}.json"
    for order in ({}, {"MUTANT_ORDER": str(log)}):
        start = time.monotonic()
        process = _start(copy, area, {"MUTANT_LOG": str(log), **order})
        output, _ = process.communicate()
        if process.returncode:
            last = "\n".join(output.strip().splitlines()[-15:])
            raise TrialError(f"{area.name}: the tests fail without any mutant\n{last}")
    wall = time.monotonic() - start
    measured = json.loads(log.read_text(encoding="utf-8"))
    for file in area.files:
        if str(copy / file) not in measured["files"]:
            raise TrialError(f"{area.name}: its tests never load {file}")
    return Unmutated(len(measured["seconds"]), measured["processor"], wall, log)


def judged(copies: Sequence[Path], area: Area, drawn: Sequence[Mutant], usual: Unmutated) -> Iterator[Verdict]:
    """Yield the verdicts as they arrive. Each copy of the tree runs one mutant at a time."""
    waiting = list(reversed(drawn))
    free = list(copies)
    running: dict[Future[Verdict], Path] = {}
    with ThreadPoolExecutor(len(copies)) as pool:
        while waiting or running:
            while waiting and free:
                copy = free.pop()
                running[pool.submit(trial, copy, area, waiting.pop(), usual)] = copy
            done, _ = wait(running, return_when=FIRST_COMPLETED)
            for future in done:
                free.append(running.pop(future))
                yield future.result()


def trial(copy: Path, area: Area, mutant: Mutant, usual: Unmutated) -> Verdict:
    """Change one file of the copy, run the tests until one fails, and restore the file."""
    path = copy / mutant.file
    source = path.read_text(encoding="utf-8")
    start = time.monotonic()
    try:
        path.write_text(mutated(source, mutant), encoding="utf-8")
        limits = {"MUTANT_SECONDS": str(usual.limit), "MUTANT_BYTES": str(MEMORY)}
        process = _start(copy, area, {"MUTANT_ORDER": str(usual.order), **limits})
        try:
            output, _ = process.communicate(timeout=WALL * max(usual.limit, usual.wall))
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            output, _ = process.communicate()
    finally:
        path.write_text(source, encoding="utf-8")
    seconds = time.monotonic() - start
    if process.returncode == _NOTHING_TO_RUN:
        raise TrialError(f"{area.name}: no test ran\n{output}")
    if process.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        return Verdict(mutant, TIMEOUT, seconds)
    return Verdict(mutant, KILLED if process.returncode else SURVIVED, seconds)


def _start(copy: Path, area: Area, settings: Mapping[str, str]) -> subprocess.Popen[str]:
    """Start pytest with the modules of the copy. With CI set, hypothesis draws the same examples each time."""
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", "-p", "_hypothesis_pytestplugin"]
    command += ["-p", "tests.mutants.plugin", f"--basetemp={copy / 'tmp'}", *area.tests]
    command += ["-k", area.select] if area.select else []
    environment = {
        **os.environ,
        **settings,
        "CI": "1",
        "PYTHONPATH": str(copy),
        "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1",
        "XDG_CACHE_HOME": str(copy / "cache"),
    }
    return subprocess.Popen(
        command,
        cwd=copy,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        start_new_session=True,
    )

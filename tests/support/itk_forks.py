"""A fast form of the process that reads volumes with SimpleITK: the library is loaded once and each file is read in a
fork.

Loading the library takes longer than reading a small file. A fork behaves and ends like a new process.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

import pytest

from modern.digital import itk

_SERVER = """
import importlib.util, json, os, signal, sys
spec = importlib.util.spec_from_file_location("itk_child", sys.argv[1])
child = importlib.util.module_from_spec(spec)
spec.loader.exec_module(child)
import numpy, SimpleITK
print(flush=True)
for line in sys.stdin:
    number = os.fork()
    if not number:
        nothing = os.open(os.devnull, os.O_RDWR)
        for stream in (0, 1, 2):
            os.dup2(nothing, stream)
        signal.alarm(int(sys.argv[2]))
        code = 1
        try:
            child.main(json.loads(line))
            code = 0
        finally:
            os._exit(code)
    print(os.waitstatus_to_exitcode(os.waitpid(number, 0)[1]), flush=True)
"""


Run = Callable[[Sequence[str], str, float], int]
"""A replacement of ``itk._run``."""


@contextmanager
def fork_server(seconds: int = 60) -> Iterator[tuple[Run, Counter[int]]]:
    """Start a process that loads the library once and forks for each file, with SIGALRM after ``seconds``.

    Yield a replacement of ``itk._run``, and a count of the exit codes: 0, or a negative signal after a crash.
    """
    command = [sys.executable, "-P", "-W", "ignore", "-c", _SERVER, itk._CHILD, str(seconds)]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    ) as server:
        assert server.stdin is not None
        assert server.stdout is not None
        requests, answers = server.stdin, server.stdout
        answers.readline()
        endings: Counter[int] = Counter()

        def run(arguments: Sequence[str], _: str, __: float) -> int:
            requests.write(json.dumps(list(arguments)) + "\n")
            requests.flush()
            code = int(answers.readline())
            endings[code] += 1
            return code

        yield run, endings
        requests.close()


@contextmanager
def forks(monkeypatch: pytest.MonkeyPatch, seconds: int = 60) -> Iterator[Counter[int]]:
    """Read volumes in forks of one server process. Yield the count of exit codes."""
    with fork_server(seconds) as (run, endings), monkeypatch.context() as patched:
        patched.setattr(itk, "_run", run)
        yield endings

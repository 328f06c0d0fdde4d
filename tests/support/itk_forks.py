"""A fast form of the process that reads volumes with SimpleITK: the library is loaded once and each file is read in a
fork.

Loading the library takes longer than reading a small file. A fork behaves and ends like a new process.
"""

import importlib.util
import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

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


def fork_server_is_possible() -> bool:
    return importlib.util.find_spec("SimpleITK") is not None and hasattr(os, "fork")


@contextmanager
def fork_server(seconds: int = 60) -> Iterator[Run]:
    """Start a process that loads the library once and forks for each file, with SIGALRM after ``seconds``.

    Yield a replacement of ``itk._run``. Its result is the exit code of a fork, which is negative after a crash.
    """
    command = [sys.executable, "-P", "-W", "ignore", "-c", _SERVER, itk._CHILD, str(seconds)]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    ) as server:
        assert server.stdin is not None
        assert server.stdout is not None
        requests, answers = server.stdin, server.stdout
        answers.readline()

        def run(arguments: Sequence[str], _: str, __: float) -> int:
            requests.write(json.dumps(list(arguments)) + "\n")
            requests.flush()
            return int(answers.readline())

        yield run
        requests.close()

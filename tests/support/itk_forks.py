"""The child that reads volumes by SimpleITK, many times over: the library is loaded once, each file read in a fork.

Loading it takes longer than reading a small file.  What a fork does, and what becomes of it, is as in a new process.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
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


@contextmanager
def forks(monkeypatch: pytest.MonkeyPatch, seconds: int = 60) -> Iterator[Counter[int]]:
    """Within this, a volume is read in a fork; one that takes longer than so many seconds ends by SIGALRM.

    Gives how often each exit code came: 0, or a negative signal where the library crashed.
    """
    words = [sys.executable, "-P", "-W", "ignore", "-c", _SERVER, itk._CHILD, str(seconds)]
    with subprocess.Popen(
        words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    ) as server:
        assert server.stdin is not None
        assert server.stdout is not None
        asked, answered = server.stdin, server.stdout
        answered.readline()
        endings: Counter[int] = Counter()

        def run(words: Sequence[str], _: str, __: float) -> int:
            asked.write(json.dumps(list(words)) + "\n")
            asked.flush()
            code = int(answered.readline())
            endings[code] += 1
            return code

        with monkeypatch.context() as patched:
            patched.setattr(itk, "_run", run)
            yield endings
        asked.close()

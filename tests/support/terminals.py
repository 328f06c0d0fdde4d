"""A pseudo-terminal that runs a command as a person at a keyboard would."""

from __future__ import annotations

import fcntl
import os
import select
import signal
import struct
import subprocess
import sys
import termios
import time
from pathlib import Path
from types import TracebackType
from typing import IO

from tests.support.paths import ROOT

_STARTED = (
    "import fcntl, os, sys, termios; fcntl.ioctl(int(sys.argv[1]), termios.TIOCSCTTY, 0); "
    "os.close(int(sys.argv[1])); os.execv(sys.executable, [sys.executable, '-m', 'modern.cli.main', *sys.argv[2:]])"
)


class Person:
    """A person at a terminal of ``columns``, on which one command of hull1620 runs in ``folder``.

    The streams in ``elsewhere`` (``stdin``, ``stdout``, ``stderr``) are open files instead of the terminal. ``output``
    is all output so far, with plain line ends.
    """

    def __init__(
        self,
        folder: Path,
        *arguments: str,
        columns: int = 80,
        term: str = "xterm",
        elsewhere: dict[str, IO[str]] | None = None,
    ) -> None:
        self._master, slave = os.openpty()
        fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
        streams = {"stdin": slave, "stdout": slave, "stderr": slave, **(elsewhere or {})}
        self._process = subprocess.Popen(
            [sys.executable, "-c", _STARTED, str(slave), *arguments],
            cwd=folder,
            env={**os.environ, "PYTHONPATH": str(ROOT), "TERM": term},
            start_new_session=True,
            pass_fds=(slave,),
            **streams,
        )
        self._slave = slave
        self.output = ""
        self._from = 0

    def __enter__(self) -> Person:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        if self._process.poll() is None:
            self._process.kill()
            self._process.wait()
        for handle in (self._master, self._slave):
            if handle >= 0:
                os.close(handle)

    def sees(self, text: str, seconds: float = 30.0) -> str:
        """Wait for ``text`` in the output after the last match, and return the output up to its end."""
        until = time.monotonic() + seconds
        while text not in self.output[self._from :]:
            assert time.monotonic() < until, f"{text!r} is not shown:\n{self.output}"
            if not self._look(0.1) and self._process.poll() is not None and not self._look(0.1):
                assert text in self.output[self._from :], f"ended without {text!r}:\n{self.output}"
        first = self._from
        self._from = self.output.index(text, first) + len(text)
        return self.output[first : self._from]

    def types(self, text: str) -> None:
        r"""Press keys. A line ends with ``\n``."""
        os.write(self._master, text.replace("\n", "\r").encode())

    def leaves(self) -> None:
        """Close the terminal."""
        os.close(self._slave)
        os.close(self._master)
        self._slave = self._master = -1

    def interrupts(self) -> None:
        """Send the signal of ``kill -INT`` to the process."""
        self._process.send_signal(signal.SIGINT)

    def ended(self, seconds: float = 60.0) -> int:
        """Return the exit code, after all output has been shown."""
        until = time.monotonic() + seconds
        while self._process.poll() is None:
            assert time.monotonic() < until, f"does not end:\n{self.output}"
            if self._master >= 0:
                self._look(0.1)
            else:
                time.sleep(0.05)
        while self._master >= 0 and self._look(0.1):
            pass
        return self._process.returncode

    def settings(self) -> list[object]:
        """The settings of the terminal."""
        return termios.tcgetattr(self._slave)

    def _look(self, seconds: float) -> bool:
        if not select.select([self._master], [], [], seconds)[0]:
            return False
        self.output += os.read(self._master, 65536).decode("utf-8", "replace").replace("\r\n", "\n")
        return True

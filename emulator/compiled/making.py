"""The compiled engine made by a process of its own, while the plain engine runs the first decks.

Both engines give the same results, so nobody need wait for a compiler.  A file is there as long as the process works:
whoever runs decks, in this process or another, asks for it before each.  The code is kept where numba keeps it and
loaded from there; where that fails, it is compiled again by whoever needs it.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from emulator.compiled.runner import Runner, run_decks
from emulator.jit.functions import NotInstalled
from emulator.language.cards import deck_from_lines
from emulator.language.compiler import compile_deck
from emulator.machine.result import Options

_COMMAND = "from emulator.compiled.making import make; make()"


def make() -> None:
    """Compile the engine and keep it, or find it kept.  Raises NotInstalled."""
    Runner(compile_deck(deck_from_lines("nothing", ["END"])), Options())


@contextmanager
def being_made() -> Iterator[Path | None]:
    """A file that is there while another process compiles the engine.

    None where there is nothing to wait for: the engine is kept already, cannot be kept, or cannot be compiled.  The
    process goes on if it is not done at the end, and the file is taken away.
    """
    if not _wanted():
        yield None
        return
    with tempfile.TemporaryDirectory(prefix="hull1620-", ignore_cleanup_errors=True) as folder:
        working = Path(folder) / "compiling"
        working.touch()
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)}
        try:
            # In a session of its own: Ctrl-C is not for it.
            process = subprocess.Popen(
                [sys.executable, "-c", _COMMAND],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                env=environment,
                start_new_session=True,
            )
        except OSError:
            working.unlink()
            yield None
            return

        def wait() -> None:
            process.wait()
            working.unlink(missing_ok=True)

        threading.Thread(target=wait, daemon=True).start()
        yield working


def _wanted() -> bool:
    try:
        code = run_decks()
    except NotInstalled:
        return False
    return code.keeps and not code.kept

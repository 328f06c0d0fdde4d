"""Ctrl-C while a study works: the first lets what is begun be finished, the second stops at once.

Where nothing has been finished yet, as while code is still being compiled, the first stops at once too.

A compiler's library calls back into Python, and what is raised there Python prints and drops.  A Ctrl-C that falls
there is pressed again a moment later, until it is heeded.
"""

from __future__ import annotations

import _thread
import multiprocessing
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from types import FrameType
from typing import Any

_MOMENT = 0.05
"""Seconds until a Ctrl-C that was dropped is pressed again."""


@dataclass
class Interrupt:
    """What Ctrl-C is to do: ``in_hand`` chunks are being worked on, ``finished`` were kept; ``asked``: it was pressed.

    A run that waits for chunks looks at ``asked`` after each and gives out no more.
    """

    in_hand: int = 0
    finished: int = 0
    asked: bool = False
    others: frozenset[int] = frozenset()
    """The processes that this one had begun before."""

    def press(self, signum: int = 0, frame: FrameType | None = None) -> None:
        """Ctrl-C.  Raises KeyboardInterrupt where nothing is to be waited for."""
        if self.asked or not (self.in_hand and self.finished):
            self.stop_workers()
            raise KeyboardInterrupt
        self.asked = True
        chunks = "the chunk" if self.in_hand == 1 else f"the {self.in_hand} chunks"
        words = f"hull1620: {chunks} in hand will be finished first; Ctrl-C again stops now"
        print(f"\n{words}" if sys.stderr.isatty() else words, file=sys.stderr, flush=True)

    def stop_workers(self) -> None:
        """End the study's processes at once.  Rows are put in place whole, so that nothing kept is lost."""
        for child in multiprocessing.active_children():
            if child.pid not in self.others:
                child.terminate()


@contextmanager
def watching() -> Iterator[Interrupt]:
    """Ctrl-C means this while the block runs; only where it means what it means to every Python program."""
    found = Interrupt(others=frozenset(child.pid or 0 for child in multiprocessing.active_children()))
    ours = (
        threading.current_thread() is threading.main_thread()
        and signal.getsignal(signal.SIGINT) is signal.default_int_handler
    )
    if not ours:
        yield found
        return
    dropped = sys.unraisablehook
    presses: list[threading.Timer] = []

    def again(unraisable: Any) -> None:
        if not issubclass(unraisable.exc_type, KeyboardInterrupt):
            dropped(unraisable)
        elif not any(press.is_alive() for press in presses):
            presses.append(threading.Timer(_MOMENT, _thread.interrupt_main))
            presses[-1].start()

    signal.signal(signal.SIGINT, found.press)
    sys.unraisablehook = again
    try:
        yield found
    finally:
        try:
            for press in presses:
                press.cancel()
                press.join()
        finally:
            sys.unraisablehook = dropped
            signal.signal(signal.SIGINT, signal.default_int_handler)

"""The progress of a study, as a bar on a terminal, or as one line a minute in a file."""

import shutil
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TextIO

# Seconds between two updates of the bar on a terminal, and between two lines in a file.
_REDRAW, _LINES = 0.2, 60.0


@dataclass
class Progress:
    """A counter of completed samples, which shows the count on ``file``.

    ``what`` names the samples in the display.  ``before`` is the number of samples that earlier runs completed.
    """

    total: int
    before: int = 0
    file: TextIO = field(default_factory=lambda: sys.stderr)
    quiet: bool = False
    what: str = "samples"
    clock: Callable[[], float] = time.monotonic
    done: int = field(init=False, default=0)
    _shown: float = field(init=False, default=0.0)
    _began: float = field(init=False, default=0.0)

    def __post_init__(self) -> None:
        self._began = self._shown = self.clock()
        self.quiet = self.quiet or self.file is None
        self._bar = not self.quiet and self.file.isatty()

    def add(self, samples: int) -> None:
        """Add to the count of completed samples, and update the display if the last update was long enough ago."""
        self.done += samples
        now = self.clock()
        if not self.quiet and now - self._shown >= (_REDRAW if self._bar else _LINES):
            self._shown = now
            self._show(now)

    def close(self) -> None:
        """Show the final count of completed samples, and end the line on the terminal."""
        if self._bar:
            self._show(self.clock())
            self._say("\n")

    def _show(self, now: float) -> None:
        at = self.before + self.done
        seconds = now - self._began
        rate = self.done / seconds if seconds > 0 else 0.0
        remaining = f", {_duration((self.total - at) / rate)} left" if rate and at < self.total else ""
        text = f"{at:,} of {self.total:,} {self.what}, {rate:,.0f} a second{remaining}"
        if not self._bar:
            self._say(text + "\n")
            return
        columns = shutil.get_terminal_size().columns - 1
        room = columns - len(text) - 3
        if room >= 10:
            full = room * at // max(self.total, 1)
            text = f"[{'#' * full}{'.' * (room - full)}] {text}"
        self._say("\r" + text[:columns].ljust(columns))

    def _say(self, text: str) -> None:
        try:
            self.file.write(text)
            self.file.flush()
        except (OSError, ValueError):
            # The file can no longer be written, for example because a pipe was closed.  The study continues.
            self.quiet, self._bar = True, False


def _duration(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours} h {minutes:02d} min" if hours else f"{minutes} min {rest:02d} s" if minutes else f"{rest} s"

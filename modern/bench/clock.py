"""Timing, as ``hull1620 bench`` does it."""

from __future__ import annotations

from modern.bench.timing import RUNS, Figure, timed, timed_once

__all__ = ["RUNS", "Figure", "timed", "timed_once"]

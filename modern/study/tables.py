"""A table, as text, CSV and Markdown."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass
from math import isinf

from modern.study.statistics import Interval

_NUMERIC = frozenset("0123456789.+-%eE to(),")


@dataclass(frozen=True, slots=True)
class Table:
    """Named columns and rows of text; ``name`` is its file's (``table`` for the main one), ``notes`` stand below."""

    name: str
    title: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    notes: tuple[str, ...] = ()

    def text(self) -> str:
        """Aligned columns, numbers to the right."""
        widths = [max(len(row[k]) for row in (self.head, *self.rows)) for k in range(len(self.head))]
        right = self._right()
        lines = [
            "  ".join(
                cell.rjust(width) if aside else cell.ljust(width)
                for cell, width, aside in zip(row, widths, right, strict=True)
            ).rstrip()
            for row in (self.head, *self.rows)
        ]
        return "\n".join([self.title, *lines, *self.notes]) + "\n"

    def csv(self) -> str:
        """The rows under their heads; no title, no notes."""
        file = io.StringIO()
        csv.writer(file, lineterminator="\n").writerows([self.head, *self.rows])
        return file.getvalue()

    def markdown(self) -> str:
        """A table of Markdown under its title in bold."""
        rule = ["--:" if aside else ":--" for aside in self._right()]
        lines = ["| " + " | ".join(c.replace("|", "\\|") for c in row) + " |" for row in (self.head, rule, *self.rows)]
        return "\n".join([f"**{self.title}**", "", *lines, *(f"\n{note}" for note in self.notes)]) + "\n"

    def _right(self) -> list[bool]:
        return [
            any(row[k] for row in self.rows) and all(set(row[k]) <= _NUMERIC for row in self.rows)
            for k in range(len(self.head))
        ]


def percent(share: Interval) -> str:
    """A proportion with its interval, in percent: ``2.9 (0.8 to 9.8) %``."""
    digits = 1 if share.high >= 0.1 else 2 if share.high >= 0.01 else 3
    return f"{100 * share.value:.{digits}f} ({100 * share.low:.{digits}f} to {100 * share.high:.{digits}f}) %"


def with_interval(estimate: Interval, digits: int = 2) -> str:
    """An estimate with its interval: ``1.43 (1.38 to 1.48)``; of one value alone, which has none, the value."""
    if isinf(estimate.high):
        return f"{estimate.value:.{digits}f}"
    return f"{estimate.value:.{digits}f} ({estimate.low:.{digits}f} to {estimate.high:.{digits}f})"

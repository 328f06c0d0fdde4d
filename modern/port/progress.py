"""What the parts of the procedure tell each other besides the hull: how far it got, and why it stopped."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from modern.port.equations import Equations

LAST_PAIR, LAST_REPEAT, THROUGH_CENTRE, TABLE_OF_PLANES = "P3-025", "P3-026", "P3-027", "P3-028"
TABLE_OF_LINES, BETWEEN, NUMBERING = "P2-023", "P2-024", "P2-025"
"""Rows of the layer ``corrected`` in the apparatus of programs 3 and 2 that can change what is punched."""


class Stopped(Exception):
    """The procedure ends without a hull: the message typed, and the label that decided."""

    def __init__(self, status: str, label: str) -> None:
        super().__init__(status, label)
        self.status, self.label = status, label


@dataclass
class Progress:
    """What is known so far: points of the input struck as inside or as boundary points, and mends that mattered."""

    inside: list[int] = field(default_factory=list)
    boundary: list[int] = field(default_factory=list)
    mended: dict[str, None] = field(default_factory=dict)

    def mend(self, name: str) -> None:
        self.mended[name] = None


Watcher = Callable[[Equations, tuple[int, ...], int, int, list[int]], None]
"""Called at each H_j: its table, the points added, NETC, how many equations they lay outside of, the points struck."""

"""HPGL, the language of Hewlett-Packard's plotters: pen up, pen down, absolute moves (instructions IN SP LT PU PD)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

Point = tuple[int, int]
Stroke = tuple[Point, Point]

WIDTH, HEIGHT = 10_000, 7_200
"""Plotter units, of 0.025 mm, that lie within a sheet of A4 on every such plotter."""

SOLID, DASHED = "LT;", "LT2,2;"


def plot(groups: Iterable[tuple[str, Iterable[Stroke]]]) -> str:
    """The text of a plot: each group has a type of line and straight strokes, drawn in the order given.

    The pen stays down where a stroke begins at the end of the one before.
    """
    lines = ["IN;", "SP1;"]
    for kind, strokes in groups:
        drawn = list(_moves(strokes))
        lines += [kind, *drawn] if drawn else []
    return "\n".join((*lines, "PU;", "SP0;")) + "\n"


def _moves(strokes: Iterable[Stroke]) -> Iterator[str]:
    at: Point | None = None
    for start, end in strokes:
        if start != at:
            yield f"PU{start[0]},{start[1]};"
        yield f"PD{end[0]},{end[1]};"
        at = end

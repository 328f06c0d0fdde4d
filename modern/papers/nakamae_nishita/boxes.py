"""Pairs of polyhedra whose images may overlap: those whose bounding boxes do, found on a grid of cells.

Boxes are in floating point, widened by more than its rounding, so that no pair is lost; a pair too many costs a
table.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterator, Sequence

from modern.papers.nakamae_nishita.projection import Homogeneous

Box = tuple[float, float, float, float]

_ROOM = 2.0**-50
_CELLS = 1 << 12


def boxes(contours: Sequence[Sequence[Homogeneous]]) -> list[Box | None]:
    """The box of each contour, left, right, low, high, within -1 to 1; None of an empty one.

    All images are divided by one power of two that brings them within -1 to 1.  Integers divided by integers are
    rounded correctly at any length, so an end is off by 2**-54 at the most, and is moved outward by 2**-50.
    """
    shift = max(
        (max(abs(x), abs(y)).bit_length() - w.bit_length() + 1 for contour in contours for x, y, _, w in contour),
        default=0,
    )
    up, down = max(shift, 0), max(-shift, 0)
    found: list[Box | None] = []
    for contour in contours:
        if not contour:
            found.append(None)
            continue
        xs = [(x << down) / (w << up) for x, _, _, w in contour]
        ys = [(y << down) / (w << up) for _, y, _, w in contour]
        found.append((min(xs) - _ROOM, max(xs) + _ROOM, min(ys) - _ROOM, max(ys) + _ROOM))
    return found


def overlapping(found: Sequence[Box | None]) -> Iterator[tuple[int, int]]:
    """The pairs of places, the smaller first, sorted, whose boxes overlap.

    The grid has about one cell for each box, so that boxes of like size which lie apart cost a fixed time each.
    """
    kept = [(place, box) for place, box in enumerate(found) if box is not None]
    if len(kept) < 2:
        return
    left, right = min(box[0] for _, box in kept), max(box[1] for _, box in kept)
    low, high = min(box[2] for _, box in kept), max(box[3] for _, box in kept)
    many = min(math.isqrt(len(kept)) + 1, _CELLS)
    across, upward = many / (right - left), many / (high - low)
    cells: dict[tuple[int, int], list[tuple[int, Box, int, int]]] = defaultdict(list)
    for place, box in kept:
        first, lowest = int((box[0] - left) * across), int((box[2] - low) * upward)
        for column in range(first, int((box[1] - left) * across) + 1):
            for row in range(lowest, int((box[3] - low) * upward) + 1):
                cells[column, row].append((place, box, first, lowest))
    pairs = []
    for (column, row), group in cells.items():
        for order, (place, a, first, lowest) in enumerate(group):
            for other, b, second, second_low in group[:order]:
                # Two boxes share several cells; the pair is taken in the first of them.
                if (
                    max(first, second) == column
                    and max(lowest, second_low) == row
                    and a[0] <= b[1]
                    and b[0] <= a[1]
                    and a[2] <= b[3]
                    and b[2] <= a[3]
                ):
                    pairs.append((other, place))
    yield from sorted(pairs)

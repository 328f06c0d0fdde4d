"""Kovalevsky and Schulz's cell list of digital balls: seconds, and microseconds a local corner inserted.

``python -m modern.bench.voxels`` prints the figures.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from modern.bench.clock import Figure, timed
from modern.digital.volumes import Volume, ball
from modern.papers.kovalevsky_schulz import (
    CENTRES,
    INVISIBLE,
    VERTICES,
    VISIBLE,
    Coplanar,
    Of,
    local_corners,
    voxel_hull,
)

LARGEST = 128
WAYS: tuple[tuple[Of, int, Coplanar], ...] = (
    (VERTICES, 26, VISIBLE),
    (VERTICES, 6, INVISIBLE),
    (CENTRES, 26, VISIBLE),
)
BAR = 32
"""The diameter of the paper's ball, for which the bar of 2 s is set."""


def figures(largest: int = LARGEST) -> Iterator[Figure]:
    """Volume in memory to merged cell list, diameters 32, 64, ...; then the step without merging."""
    diameter = BAR
    while diameter <= largest:
        volume = ball(diameter)
        for of, neighbours, coplanar in WAYS:
            yield cell_list(volume, of, neighbours, coplanar, "bar 2 s" if diameter == BAR else "")
        yield timed(f"  its local corners alone, {volume.source}", lambda v=volume: local_corners(v))  # type: ignore[misc]
        diameter *= 2


def cell_list(volume: Volume, of: Of, neighbours: int, coplanar: Coplanar, bar: str) -> Figure:
    """The cell list of a solid's hull, with the time a corner in the note."""
    corners = len(local_corners(volume, of, neighbours))
    found = timed(
        f"cell list, {volume.source}, {of}, {neighbours}, {coplanar}",
        lambda: voxel_hull(volume, of, neighbours, coplanar),
    )
    each = f"{corners} corners, {found.median / corners * 1e6:.0f} microseconds each"
    return replace(found, note=f"{bar}; {each}" if bar else each)


def main() -> None:
    """Print every figure."""
    for figure in figures():
        print(figure.line())


if __name__ == "__main__":
    main()

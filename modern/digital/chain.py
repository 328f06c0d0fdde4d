"""The lower side of points in a plane."""

from __future__ import annotations

from collections.abc import Iterable


def lower_chain(points: Iterable[tuple[int, int]]) -> list[tuple[int, int]]:
    """The vertices of the lower side of points (t, z) sorted by t, each t once: one scan, going back where it turns."""
    chain: list[tuple[int, int]] = []
    for t, z in points:
        while len(chain) > 1:
            (t0, z0), (t1, z1) = chain[-2:]
            if (t1 - t0) * (z - z0) > (z1 - z0) * (t - t0):
                break
            chain.pop()
        chain.append((t, z))
    return chain

"""Hulls: the exact judge and the port in float64, beside Qhull (through scipy) where it is installed."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from benchmarks.timing import Figure, timed
from modern.exact_hull import exact_hull
from modern.port import convex_hull


def ball(count: int, seed: int = 1) -> Any:
    """Points uniform in the unit ball, shape (count, 3), float64."""
    source = np.random.default_rng(seed)
    directions = source.normal(size=(count, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    return directions * source.random(count)[:, None] ** (1 / 3)


def exact_in_doubles(points: Any) -> Any:
    """Coordinates in [-1, 1] as whole numbers up to 80,000: every determinant of them is exact in float64.

    Of arbitrary doubles the port, like the programs, ends at DATA NOT ACCEPTABLE: the defining points do not
    satisfy their rounded equations.
    """
    return np.rint(points * 80_000)


def eight_digits(points: Any) -> Any:
    """Coordinates in [-1, 1] as whole numbers of eight digits."""
    return np.rint(points * 99_999_999).astype(np.int64)


def figures(largest: int = 100_000) -> Iterator[Figure]:
    """Every figure, smallest first."""
    source = np.random.default_rng(2)
    sphere = source.normal(size=(10_000, 3))
    sphere /= np.linalg.norm(sphere, axis=1)[:, None]
    cube = eight_digits(source.uniform(-1, 1, size=(10_000, 3)))
    yield timed("judge, 10,000 points of 8 digits uniform in a cube", lambda: exact_hull(cube), "bar 2 s")
    ball_on_sphere = eight_digits(sphere)
    yield timed("judge, 10,000 points of 8 digits on a sphere", lambda: exact_hull(ball_on_sphere), "bar 20 s")
    count = 100
    while count <= largest:
        points = exact_in_doubles(ball(count))
        ours = timed(f"port float64, {count:,} points uniform in a ball", lambda p=points: convex_hull(p, "float64"))  # type: ignore[misc]
        yield ours
        other = qhull(points, count)
        if other is not None:
            yield Figure(other.what, other.seconds, f"the port takes {ours.median / other.median:.1f} times as long")
        whole = eight_digits(points / 80_000)
        yield timed(f"judge, {count:,} points of 8 digits in a ball", lambda p=whole: exact_hull(p))  # type: ignore[misc]
        count *= 10


def qhull(points: Any, count: int) -> Figure | None:
    """Qhull through scipy, or None where scipy is not installed."""
    try:
        from scipy.spatial import ConvexHull
    except ImportError:
        return None
    return timed(f"Qhull (scipy), {count:,} points uniform in a ball", lambda: ConvexHull(points))

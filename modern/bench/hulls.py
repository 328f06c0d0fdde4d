"""Hulls: the exact judge and the port in float64, beside Qhull (through scipy) where it is installed.

``python -m modern.bench.hulls FILE.svg`` measures how their time grows with the number of points and plots it (extra
``plot``).
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from importlib.util import find_spec
from typing import Any

import numpy as np

from modern.bench.timing import Curve, Figure, plot, timed, timed_once
from modern.exact_hull import exact_hull
from modern.port import convex_hull

COUNTS = (100, 1_000, 10_000, 100_000, 1_000_000)
LARGEST_FOR_JUDGE = 100_000
PORT = ("port, float64, numpy", "port, float64, fast")
STYLES = (
    {"marker": "o", "linestyle": "-", "color": "0"},
    {"marker": "D", "linestyle": "-.", "color": "0"},
    {"marker": "s", "linestyle": "--", "color": "0.35"},
    {"marker": "^", "linestyle": ":", "color": "0.5"},
)


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
    yield from starts()
    count = 100
    while count <= largest:
        points = exact_in_doubles(ball(count))
        ours = list(port(points))
        yield from ours
        other = qhull(points, count)
        if other is not None:
            times = " and ".join(f"{figure.median / other.median:.1f}" for figure in ours)
            yield Figure(other.what, other.seconds, f"the port takes {times} times as long")
        whole = eight_digits(points / 80_000)
        yield timed(f"judge, {count:,} points of 8 digits in a ball", lambda p=whole: exact_hull(p))  # type: ignore[misc]
        count *= 10


def port(points: Any) -> Iterator[Figure]:
    """The port in float64 by numpy alone, and by compiled kernels where numba is installed."""
    what = f"port float64, {len(points):,} points uniform in a ball"
    yield timed(f"{what}, numpy", lambda: convex_hull(points, "float64", fast=False))
    if find_spec("numba"):
        yield timed(f"{what}, fast", lambda: convex_hull(points, "float64", fast=True))


def starts() -> Iterator[Figure]:
    """A process that makes one small hull: without the kernels, with them, and with them to be compiled first."""
    if not find_spec("numba"):
        return
    yield timed("a process with one small hull, numpy", small_hull(False))
    yield timed("a process with one small hull, fast", small_hull(True))
    with tempfile.TemporaryDirectory() as folder:
        yield timed_once("a process with one small hull, fast, nothing compiled", small_hull(True, folder))


def small_hull(fast: bool, cache: str = "") -> Callable[[], object]:
    """A process with the hull of a cube; ``cache``: a folder for machine code other than the user's."""
    text = "import numpy as np; from modern.port import convex_hull; p = np.indices((2, 2, 2)).reshape(3, 8).T * 2.0;"
    text += f"convex_hull(p, 'float64', fast={fast})"
    environment = {**os.environ, "NUMBA_CACHE_DIR": cache} if cache else dict(os.environ)
    return lambda: subprocess.run([sys.executable, "-c", text], check=True, env=environment)


def qhull(points: Any, count: int) -> Figure | None:
    """Qhull through scipy, or None where scipy is not installed."""
    try:
        from scipy.spatial import ConvexHull
    except ImportError:
        return None
    return timed(f"Qhull (scipy), {count:,} points uniform in a ball", lambda: ConvexHull(points))


def growth() -> dict[str, list[tuple[int, float]]]:
    """Median seconds by route and number of points, uniform in a ball."""
    found: dict[str, list[tuple[int, float]]] = {name: [] for name in (*PORT, "judge, exact", "Qhull (scipy)")}
    for count in COUNTS:
        points = exact_in_doubles(ball(count))
        for name, figure in zip(PORT, port(points), strict=False):
            found[name].append((count, figure.median))
        other = qhull(points, count)
        if other is not None:
            found["Qhull (scipy)"].append((count, other.median))
        if count <= LARGEST_FOR_JUDGE:
            whole = eight_digits(points / 80_000)
            found["judge, exact"].append((count, timed("", lambda p=whole: exact_hull(p)).median))  # type: ignore[misc]
    return found


def main() -> None:
    """Measure the growth, print and plot it."""
    if len(sys.argv) != 2:
        sys.exit("usage: python -m modern.bench.hulls FILE.svg")
    found = growth()
    for name, points in found.items():
        print(name, ", ".join(f"{count:,}: {seconds:.4f} s" for count, seconds in points))
    curves = [Curve(name, points, style) for (name, points), style in zip(found.items(), STYLES, strict=True)]
    plot(curves, sys.argv[1], "points, uniform in a ball")


if __name__ == "__main__":
    main()

"""Hulls: the exact judge and the port in float64, each row beside its peers, Qhull and CGAL, in one run.

``python -m modern.bench.suite.hulls FILE.svg`` measures how their time grows with the number of points, and plots it
with the slope of each curve (extra ``plot``).
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Any

import numpy as np

from modern.bench.suite.peers import Peers, Work
from modern.bench.timing import Curve, Figure, plotted, side_by_side, timed, timed_once
from modern.exact_hull import exact_hull
from modern.geometry.hull import as_tuple
from modern.port import convex_hull

COUNTS = (100, 1_000, 10_000, 100_000, 1_000_000)
SLOPES_FROM = 1_000
"""Fewer points measure what a call costs."""
WITH_FACES = "port, fast, with its faces as text"
STYLES = (
    {"marker": "o", "linestyle": "-", "color": "0"},
    {"marker": "o", "linestyle": "--", "color": "0"},
    {"marker": "D", "linestyle": "-", "color": "0.4"},
    {"marker": "D", "linestyle": "--", "color": "0.4"},
    {"marker": "s", "linestyle": "-.", "color": "0.6"},
    {"marker": "^", "linestyle": ":", "color": "0.6"},
)


def ball(count: int, seed: int = 1) -> Any:
    """Points uniform in the unit ball, shape (count, 3), float64."""
    source = np.random.default_rng(seed)
    directions = source.normal(size=(count, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    return directions * source.random(count)[:, None] ** (1 / 3)


def sphere(count: int) -> Any:
    """Points uniform on the unit sphere, shape (count, 3), float64."""
    points = np.random.default_rng(2).normal(size=(count, 3))
    return points / np.linalg.norm(points, axis=1)[:, None]


def cube(count: int) -> Any:
    """Points uniform in the cube from -1 to 1, shape (count, 3), float64."""
    return np.random.default_rng(2).uniform(-1, 1, size=(count, 3))


def exact_in_doubles(points: Any) -> Any:
    """Coordinates in [-1, 1] as whole numbers up to 80,000: every determinant of them is exact in float64.

    Of arbitrary doubles the port, like the programs, ends at DATA NOT ACCEPTABLE: the defining points do not
    satisfy their rounded equations.
    """
    return np.rint(points * 80_000)


def eight_digits(points: Any) -> Any:
    """Coordinates in [-1, 1] as whole numbers of eight digits."""
    return np.rint(points * 99_999_999).astype(np.int64)


def judge(points: Any) -> dict[str, Work]:
    """The judge by numpy alone, and with its proposals by the kernel where numba is installed."""
    works: dict[str, Work] = {"judge, numpy": lambda: exact_hull(points, fast=False)}
    if find_spec("numba"):
        works["judge, fast"] = lambda: exact_hull(points, fast=True)
    return works


def port(points: Any) -> dict[str, Work]:
    """The port in float64 by numpy alone, and by compiled kernels where numba is installed; faces are made if asked."""
    works: dict[str, Work] = {"port, numpy": lambda: convex_hull(points, "float64", fast=False)}
    if find_spec("numba"):
        works["port, fast"] = lambda: convex_hull(points, "float64", fast=True)
        works[WITH_FACES] = lambda: as_tuple(convex_hull(points, "float64", fast=True).faces)
    return works


@dataclass(frozen=True, slots=True)
class Table:
    """Works on one set of points, measured in turn in seconds of the processor; the peers are the last of them."""

    points: str
    rows: tuple[Figure, ...]
    peers: tuple[str, ...]

    def peer(self, name: str) -> Figure:
        return next(row for row in self.rows if row.what == name)

    def lines(self) -> list[str]:
        """The table as text, 78 columns: median seconds, and how many times a peer's."""
        widths = [max(12, len(name) + 4) for name in self.peers]
        first = 78 - 10 - sum(widths)
        heads = "".join(f"{'/ ' + name:>{width}}" for name, width in zip(self.peers, widths, strict=True))
        found = [f"{self.points:<{first}}{'seconds':>10}{heads}"]
        for row in self.rows:
            ratios = (row.median / self.peer(name).median for name in self.peers)
            cells = "".join(f"{ratio:>{width}.1f}" for ratio, width in zip(ratios, widths, strict=True))
            found.append(f"  {row.what:<{first - 2}}{row.median:>10.4f}{cells}")
        return found


def table(name: str, points: Any, works: Mapping[str, Work], peers: Peers) -> Table:
    """Measure works and peers in turn on the same points."""
    others = {peer: of(points) for peer, of in peers.found.items()}
    return Table(name, tuple(side_by_side({**works, **others}, clock=time.process_time)), tuple(others))


def tables(peers: Peers, largest: int = 100_000) -> Iterator[Table]:
    """Every table, smallest first; ``largest``: no larger set of points."""
    counts = [count for count in COUNTS if count <= min(largest, 100_000)]
    for count in counts:
        points = exact_in_doubles(ball(count))
        yield table(f"{count:,} whole points in a ball", points, port(points), peers)
    for count in counts:
        points = eight_digits(ball(count))
        yield table(f"{count:,} of 8 digits in a ball", points, judge(points), peers)
    for name, made in (("in a cube", cube), ("on a sphere", sphere)):
        count = min(largest, 10_000)
        points = eight_digits(made(count))
        yield table(f"{count:,} of 8 digits {name}", points, judge(points), peers)


def lines(largest: int = 100_000) -> Iterator[str]:
    """Every table as text, process starts, and what is missing."""
    with Peers() as peers:
        for one in tables(peers, largest):
            yield from one.lines()
        for figure in starts():
            yield figure.line()
        yield from peers.remarks


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


def growth(peers: Peers, counts: Sequence[int] = COUNTS) -> list[Curve]:
    """Median seconds by route and number of points, uniform in a ball; the judge and the peers get 8 digits."""
    found: dict[str, list[tuple[int, float]]] = {}
    for count in counts:
        whole, long = exact_in_doubles(ball(count)), eight_digits(ball(count))
        works = {**judge(long), **port(whole)}
        works.pop(WITH_FACES, None)
        for figure in table("", long, works, peers).rows:
            found.setdefault(figure.what, []).append((count, figure.median))
    return [Curve(name, points, style) for (name, points), style in zip(found.items(), STYLES, strict=False)]


def main() -> None:
    """Measure the growth, print and plot it."""
    if len(sys.argv) != 2:
        sys.exit("usage: python -m modern.bench.suite.hulls FILE.svg")
    with Peers() as peers:
        curves = growth(peers)
        print(*peers.remarks, sep="\n", end="\n" if peers.remarks else "")
    for line in plotted(curves, sys.argv[1], f"points, uniform in a ball; slopes from {SLOPES_FROM:,} on", SLOPES_FROM):
        print(line)


if __name__ == "__main__":
    main()

"""Benchmarks of convex hulls: the exact hull and Butler's procedure in float64, compared with Qhull and CGAL.

``python -m modern.bench.suite.hulls FILE.svg`` measures the growth of time with the number of points and plots it with
the slope of each curve (extra ``plot``).
"""

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from modern.bench.suite.peers import Peer, Work, installed
from modern.bench.timing import Curve, Figure, plotted, side_by_side, timed, timed_once
from modern.comparison.outcome import as_hull
from modern.exact_hull import exact_hull
from modern.geometry.hull import as_tuple
from modern.geometry.mesh import mesh
from modern.port import convex_hull

# The number of runs of which the median is taken.
RUNS = 7
COUNTS = (100, 1_000, 10_000, 100_000, 1_000_000)
# The slope of a curve is fitted from this number of points on; smaller sets measure the cost of a call.
SLOPES_FROM = 1_000
WITH_FACES = "port, fast, with its faces as text"


def ball(count: int, seed: int = 1) -> Any:
    """Return points that are uniformly distributed in the unit ball, as an array of shape (count, 3), float64."""
    source = np.random.default_rng(seed)
    directions = source.normal(size=(count, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    return directions * source.random(count)[:, None] ** (1 / 3)


def sphere(count: int) -> Any:
    """Return points that are uniformly distributed on the unit sphere, as an array of shape (count, 3), float64."""
    points = np.random.default_rng(2).normal(size=(count, 3))
    return points / np.linalg.norm(points, axis=1)[:, None]


def cube(count: int) -> Any:
    """Return points that are uniformly distributed in the cube from -1 to 1, in an array of shape (count, 3)."""
    return np.random.default_rng(2).uniform(-1, 1, size=(count, 3))


def box(count: int) -> Any:
    """Return points on the surface of the cube from -1 to 1, in an array of shape (count, 3), float64."""
    source = np.random.default_rng(3)
    points = source.uniform(-1, 1, size=(count, 3))
    points[np.arange(count), source.integers(0, 3, count)] = source.choice([-1.0, 1.0], count)
    return points


def lattice(side: int) -> Any:
    """Return all integer points of a cube with ``side`` points on an edge, as an array of shape (side**3, 3), int64."""
    return np.indices((side, side, side)).reshape(3, -1).T.copy()


def exact_in_doubles(points: Any) -> Any:
    """Scale coordinates in [-1, 1] to integers up to 80,000, so that Butler's determinants are exact in float64."""
    return np.rint(points * 80_000)


def eight_digits(points: Any) -> Any:
    return np.rint(points * 99_999_999).astype(np.int64)


def judge(points: Any) -> dict[str, Work]:
    """Return functions that compute the exact hull of points: with numpy alone and, if numba is installed, compiled.

    Each function computes the vertices and triangles of the hull, and the certificate of the judge.
    """
    works: dict[str, Work] = {"judge, numpy": lambda: mesh(as_hull(exact_hull(points, fast=False))).triangles()}
    if find_spec("numba"):
        works["judge, fast"] = lambda: mesh(as_hull(exact_hull(points, fast=True))).triangles()
    return works


def port(points: Any) -> dict[str, Work]:
    """Return functions that run Butler's procedure in float64: with numpy and, if numba is installed, compiled."""
    works: dict[str, Work] = {"port, numpy": lambda: convex_hull(points, "float64", fast=False)}
    if find_spec("numba"):
        works["port, fast"] = lambda: convex_hull(points, "float64", fast=True)
        works[WITH_FACES] = lambda: as_tuple(convex_hull(points, "float64", fast=True).faces)
    return works


@dataclass(frozen=True, slots=True)
class Table:
    """The times of several hull functions on one point set.  The rows named in ``peers`` belong to other programs."""

    points: str
    rows: tuple[Figure, ...]
    peers: tuple[str, ...]

    def peer(self, name: str) -> Figure:
        return next(row for row in self.rows if row.what == name)

    def lines(self) -> list[str]:
        """Return the table as lines of 78 columns: the median seconds of each function, and their ratios to peers."""
        widths = [max(12, len(name) + 4) for name in self.peers]
        first = 78 - 10 - sum(widths)
        heads = "".join(f"{'/ ' + name:>{width}}" for name, width in zip(self.peers, widths, strict=True))
        rows_of_text = [f"{self.points:<{first}}{'seconds':>10}{heads}"]
        for row in self.rows:
            ratios = (row.median / self.peer(name).median for name in self.peers)
            cells = "".join(f"{ratio:>{width}.1f}" for ratio, width in zip(ratios, widths, strict=True))
            rows_of_text.append(f"  {row.what:<{first - 2}}{row.median:>10.4f}{cells}")
        return rows_of_text


def table(name: str, points: Any, works: Mapping[str, Work], peers: Mapping[str, Peer]) -> Table:
    peer_works = {name_of_peer: peer(points) for name_of_peer, peer in peers.items()}
    figures = side_by_side({**works, **peer_works}, clock=time.process_time, runs=RUNS)
    return Table(name, tuple(figures), tuple(peer_works))


def tables(peers: Mapping[str, Peer], largest: int = 1_000_000) -> Iterator[Table]:
    counts = [count for count in COUNTS if count <= largest]
    for count in counts:
        points = exact_in_doubles(ball(count))
        yield table(f"{count:,} integer points in a ball", points, port(points), peers)
    sets: list[tuple[str, Any]] = []
    for count in counts:
        points = ball(count)
        sets += [(f"{count:,} floats in a ball", points), (f"{count:,} of 8 digits in a ball", eight_digits(points))]
    count = min(largest, 10_000)
    for name, family in (("in a cube", cube), ("on a sphere", sphere)):
        sets.append((f"{count:,} floats {name}", family(count)))
    sets += [(f"{10 * count:,} floats on a box", box(10 * count)), ("a lattice of 20 x 20 x 20", lattice(20))]
    for name, points in sets:
        yield table(name, points, judge(points), peers)


def lines(largest: int = 1_000_000) -> Iterator[str]:
    with tempfile.TemporaryDirectory() as folder:
        peers, remarks = installed(Path(folder))
        for measured_table in tables(peers, largest):
            yield from measured_table.lines()
        for figure in starts():
            yield figure.line()
        yield from remarks


def starts() -> Iterator[Figure]:
    """Time processes that compute one small hull: with numpy, with compiled code, and with code that they compile."""
    if not find_spec("numba"):
        return
    yield timed("a process with one small hull, numpy", small_hull(False))
    yield timed("a process with one small hull, fast", small_hull(True))
    with tempfile.TemporaryDirectory() as folder:
        yield timed_once("a process with one small hull, fast, nothing compiled", small_hull(True, folder))


def small_hull(fast: bool, cache: str = "") -> Callable[[], object]:
    """Return a function that computes the hull of a cube in a new process.

    ``cache`` is the folder of compiled code; if it is empty, the process uses the user's folder.
    """
    script = "import numpy as np; from modern.port import convex_hull; p = np.indices((2, 2, 2)).reshape(3, 8).T * 2.0;"
    script += f"convex_hull(p, 'float64', fast={fast})"
    environment = {**os.environ, "NUMBA_CACHE_DIR": cache} if cache else dict(os.environ)
    return lambda: subprocess.run([sys.executable, "-c", script], check=True, env=environment)


def growth(peers: Mapping[str, Peer], counts: Sequence[int] = COUNTS) -> list[Curve]:
    """Measure the median seconds for hulls of growing numbers of points in a ball, as one curve for each method."""
    points_by_route: dict[str, list[tuple[int, float]]] = {}
    for count in counts:
        points = ball(count)
        works = {**judge(points), **port(exact_in_doubles(points))}
        works.pop(WITH_FACES, None)
        for figure in table("", points, works, peers).rows:
            points_by_route.setdefault(figure.what, []).append((count, figure.median))
    return [Curve(name, points) for name, points in points_by_route.items()]


def main() -> None:
    if len(sys.argv) != 2:
        sys.exit("usage: python -m modern.bench.suite.hulls FILE.svg")
    with tempfile.TemporaryDirectory() as folder:
        peers, remarks = installed(Path(folder))
        for remark in remarks:
            print(remark)
        curves = growth(peers)
    for line in plotted(curves, sys.argv[1], f"points, uniform in a ball; slopes from {SLOPES_FROM:,} on", SLOPES_FROM):
        print(line)


if __name__ == "__main__":
    main()

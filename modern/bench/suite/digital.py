"""Benchmarks of digital hulls of balls: time compared with scikit-image, memory, octree hull and cell list.

``python -m modern.bench.suite.digital FILE.svg`` measures the growth of time with the number of voxels and plots it
with the slope of each curve (extra ``plot``).
"""

import statistics
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from importlib.util import find_spec
from typing import Any

import numpy as np

from modern.bench.suite.hulls import Table
from modern.bench.suite.peers import Work
from modern.bench.timing import Curve, Figure, plotted, side_by_side, timed, timed_once
from modern.digital.hull import digital_hull
from modern.digital.solids import VERTEX, Volume, ball
from modern.papers.kovalevsky_schulz import CENTRES, reconstructed, voxel_hull
from modern.papers.yau_srihari import octree_hull

BARS = {128: "bar 1 s", 256: "bar 4 s", 512: "bar 30 s"}

# The diameters of the balls whose octree hulls are measured. The octrees' cubes have sides of 16, 32, ... 256.
DIAMETERS = (15, 31, 63, 127, 254)
# Complete processes: the hull, the diameter of a ball, and the bars.
COMMANDS = (
    ("octree", 127, "bar 2 s, 500 MB"),
    ("octree", 254, "bar 10 s, 500 MB"),
    ("voxel", 255, "bar 1.4 s"),
    ("voxel", 511, "bar 10 s"),
)
# The slope of a curve is fitted from this number of voxels on; smaller solids measure the cost of a call.
SLOPES_FROM = 10_000
OCTREE, CELLS, FILLED, SCIKIT_IMAGE = "octree hull", "voxel hull, cell list", "digital hull", "skimage"
# The largest diameter measured with scikit-image in a table. In the plot it is 63, which takes half a minute.
SCIKIT_UP_TO = 31

PEAK = """
import resource, sys
from modern.digital.hull import digital_hull
from modern.digital.solids import ball
from modern.papers.kovalevsky_schulz import voxel_hull
from modern.papers.yau_srihari import octree_hull
side, way = int(sys.argv[1]), sys.argv[2]
hulls = {"octree": octree_hull, "voxel": voxel_hull}
array = ball(side, "voxel" if way in hulls else "vertex").array
hulls[way](array) if way in hulls else digital_hull(array, way == "compiled")
try:
    with open("/proc/self/status") as status:  # the figure of getrusage has that of the starting process in it
        peak = next(int(line.split()[1]) * 1024 for line in status if line.startswith("VmHWM"))
except OSError:
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1 if sys.platform == "darwin" else 1024)
print(array.size, peak)
"""


def figures(largest: int = 512) -> Iterator[Figure]:
    ways = ([("compiled", True)] if find_spec("numba") else []) + [("plain", False)]
    small = ball(64, VERTEX).array
    own_figures = {}
    for name, fast in ways:
        own_figures[name] = timed(f"filled hull of a ball of 64^3, {name}", lambda fast=fast: digital_hull(small, fast))  # type: ignore[misc]
        yield own_figures[name]
    scikit_figure = scikit_image(small)
    if scikit_figure is not None:
        ratios = (
            f"{name} {scikit_figure.median / figure.median:,.0f} times as fast" for name, figure in own_figures.items()
        )
        yield Figure(scikit_figure.what, scikit_figure.seconds, ", ".join(ratios) + ", bar 100")
    for side in (128, 256, 512):
        if side > largest:
            break
        array = ball(side, VERTEX).array
        for name, fast in ways:
            what = f"filled hull of a ball of {side}^3, {name}"
            note = f"{BARS[side]}; {memory(side, name)}"
            yield timed(what, lambda array=array, fast=fast: digital_hull(array, fast), note)  # type: ignore[misc]
    for name, diameter, bars in COMMANDS:
        if diameter < largest:
            note = f"{peak(diameter, name)[1] / 1e6:.0f} MB; {bars}"
            yield timed(f"{name}-hull ball:{diameter}, a whole process", process_of(name, diameter), note)


def lines(largest: int = 512) -> Iterator[str]:
    for figure in figures(largest):
        yield figure.line()
    for diameter in DIAMETERS:
        if diameter < largest:
            yield from table(ball(diameter), diameter <= SCIKIT_UP_TO).lines()


def process_of(name: str, diameter: int) -> Work:
    """Return a function that runs ``octree-hull`` or ``voxel-hull`` on a ball in a process and discards the output."""
    command = [sys.executable, "-m", "modern.cli.main", f"{name}-hull", f"ball:{diameter}"]
    return lambda: subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def works(volume: Volume) -> dict[str, Work]:
    """Return the functions to be timed, by name.  Each computes a hull of a solid's voxel centres."""
    return {
        OCTREE: lambda: octree_hull(volume),
        CELLS: lambda: voxel_hull(volume, CENTRES),
        FILLED: lambda: digital_hull(volume, False),
    }


def table(volume: Volume, slow: bool) -> Table:
    """Time the hulls of a solid in turn, in processor seconds.  If ``slow``, run scikit-image once too."""
    rows = side_by_side(works(volume), clock=time.process_time)
    peers = [FILLED]
    filled = digital_hull(volume).filled
    cells = voxel_hull(volume, CENTRES).polyhedron.faces
    same = np.array_equal(octree_hull(volume).filled, filled)
    same = same and np.array_equal(reconstructed(cells.economical(), CENTRES).array, filled)
    if slow and find_spec("skimage"):
        scikit_results: list[Any] = []
        by_scikit_image(np.ones((2, 2, 2), dtype=np.bool_))  # loads it
        rows.append(timed_once(SCIKIT_IMAGE, lambda: scikit_results.append(by_scikit_image(volume.array))))
        peers.append(SCIKIT_IMAGE)
        same = same and np.array_equal(scikit_results[0], filled)
    name = f"{volume.source}, {volume.count:,} voxels" + ("" if same else ", OTHER HULLS")
    return Table(name, tuple(rows), tuple(peers))


def growth(diameters: Sequence[int] = DIAMETERS) -> list[Curve]:
    """Measure median seconds for balls of growing size, as one curve for each method."""
    points_by_way: dict[str, list[tuple[int, float]]] = {}
    for diameter in diameters:
        volume = ball(diameter)
        for figure in table(volume, diameter <= 2 * SCIKIT_UP_TO + 1).rows:
            points_by_way.setdefault(figure.what, []).append((volume.count, figure.median))
    return [Curve(name, points) for name, points in points_by_way.items()]


def scikit_image(array: Any) -> Figure | None:
    """Run scikit-image once on the same voxels and compare the results. Return None if it is not installed."""
    if not find_spec("skimage"):
        return None
    results: list[Any] = []
    figure = timed_once("", lambda: results.append(by_scikit_image(array)))
    same = "same voxels" if np.array_equal(results[0], digital_hull(array).filled) else "OTHER VOXELS"
    return Figure(f"scikit-image, ball of {len(array)}^3, once, {same}", figure.seconds)


def by_scikit_image(array: Any) -> Any:
    from skimage.morphology import convex_hull_image

    return convex_hull_image(array, offset_coordinates=False)  # type: ignore[no-untyped-call]


def memory(side: int, way: str) -> str:
    """Measure the peak memory of filling the hull of a ball.  Return it as text, with the limit it must not exceed."""
    size, most = peak(side, way)
    return f"{most / 1e6:.0f} MB, bar {(4 * size + 300e6) / 1e6:.0f} MB"


def peak(side: int, way: str) -> tuple[int, float]:
    """Return the voxels in a ball's box, and the peak memory in bytes of filling its hull (median of three)."""
    runs = []
    for _ in range(3):
        run = subprocess.run([sys.executable, "-c", PEAK, str(side), way], check=True, capture_output=True, text=True)
        runs.append([*map(int, run.stdout.split())])
    return runs[0][0], statistics.median(most for _, most in runs)


def main() -> None:
    what = f"voxels of a ball; slopes from {SLOPES_FROM:,} on"
    for line in plotted(growth(), sys.argv[1], what, SLOPES_FROM) if len(sys.argv) == 2 else lines():
        print(line, flush=True)


if __name__ == "__main__":
    main()

"""Benchmarks of the digital hulls of balls: times and memory, compared with octree hulls, cell lists and scikit-image.

``python -m modern.bench.suite.digital FILE.svg`` measures the growth of time with the number of voxels and plots it
with the slope of each curve (extra ``plot``).
"""

import statistics
import subprocess
import sys
import time
from collections.abc import Iterator
from functools import partial
from importlib.util import find_spec
from typing import Any

import numpy as np

from modern.bench.suite.hulls import Table
from modern.bench.timing import Curve, Figure, command, plotted, side_by_side, timed, timed_once
from modern.digital.hull import digital_hull
from modern.digital.solids import VERTEX, Volume, ball
from modern.papers.kovalevsky_schulz import CENTRES, reconstructed, voxel_hull
from modern.papers.yau_srihari import octree_hull

# The required time for the hull of a ball in a box with this number of voxels on a side.
REQUIRED = {128: "required: 1 s", 256: "required: 4 s", 512: "required: 30 s"}

# The diameters of the balls whose octree hulls are measured. The octrees' cubes have sides of 16, 32, ... 256.
DIAMETERS = (15, 31, 63, 127, 254)
# Complete processes: the hull, the diameter of a ball, and the required limits.
COMMANDS = (
    ("octree", 127, "2 s, 500 MB"),
    ("octree", 254, "10 s, 500 MB"),
    ("voxel", 255, "1.4 s"),
    ("voxel", 511, "10 s"),
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
    with open("/proc/self/status") as status:  # getrusage also counts the memory of the starting process
        peak = next(int(line.split()[1]) * 1024 for line in status if line.startswith("VmHWM"))
except OSError:
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1 if sys.platform == "darwin" else 1024)
print(array.size, peak)
"""


def figures() -> Iterator[Figure]:
    """Time the filling of balls' hulls with and without compiled code and by scikit-image, and time whole commands."""
    ways = ([("compiled", True)] if find_spec("numba") else []) + [("plain", False)]
    for side in (64, *REQUIRED):
        array = ball(side, VERTEX).array
        own_figures = []
        for name, fast in ways:
            note = f"{REQUIRED[side]}; {memory(side, name)}" if side in REQUIRED else ""
            what = f"filled hull of a ball of {side}^3, {name}"
            own_figures.append(timed(what, partial(digital_hull, array, fast), note))
        yield from own_figures
        if side == 64 and find_spec("skimage"):
            figure, same = scikit_image(array, digital_hull(array).filled)
            ratios = [
                f"{name} {figure.median / own.median:,.0f} times as fast"
                for (name, _), own in zip(ways, own_figures, strict=True)
            ]
            what = f"scikit-image, ball of {side}^3, once, {'same voxels' if same else 'OTHER VOXELS'}"
            yield Figure(what, figure.seconds, f"{', '.join(ratios)}, required: 100 times")
    for name, diameter, required in COMMANDS:
        note = f"{peak(diameter, name)[1] / 1e6:.0f} MB; required: {required}"
        yield timed(f"{name}-hull ball:{diameter}, a whole process", command(f"{name}-hull", f"ball:{diameter}"), note)


def lines() -> Iterator[str]:
    for figure in figures():
        yield figure.line()
    for diameter in DIAMETERS:
        yield from table(ball(diameter), diameter <= SCIKIT_UP_TO).lines()


def table(volume: Volume, slow: bool) -> Table:
    """Time three ways to find the hull of a solid's voxel centres.  If ``slow``, also time one run of scikit-image.

    Times are in processor seconds.  The title of the table reports if the hulls are not the same.
    """
    works = {
        OCTREE: lambda: octree_hull(volume),
        CELLS: lambda: voxel_hull(volume, CENTRES),
        FILLED: lambda: digital_hull(volume, False),
    }
    rows = side_by_side(works, clock=time.process_time)
    peers = [FILLED]
    filled = digital_hull(volume).filled
    cells = voxel_hull(volume, CENTRES).polyhedron.faces
    same = np.array_equal(octree_hull(volume).filled, filled)
    same = same and np.array_equal(reconstructed(cells.economical(), CENTRES).array, filled)
    if slow and find_spec("skimage"):
        scikit_figure, scikit_same = scikit_image(volume.array, filled)
        rows.append(scikit_figure)
        peers.append(SCIKIT_IMAGE)
        same = same and scikit_same
    name = f"{volume.source}, {volume.count:,} voxels" + ("" if same else ", OTHER HULLS")
    return Table(name, tuple(rows), tuple(peers))


def growth() -> list[Curve]:
    """Measure median seconds for balls of growing size, as one curve for each method."""
    points_by_way: dict[str, list[tuple[int, float]]] = {}
    for diameter in DIAMETERS:
        volume = ball(diameter)
        for figure in table(volume, diameter <= 2 * SCIKIT_UP_TO + 1).rows:
            points_by_way.setdefault(figure.what, []).append((volume.count, figure.median))
    return [Curve(name, points) for name, points in points_by_way.items()]


def scikit_image(array: Any, filled: Any) -> tuple[Figure, bool]:
    """Time scikit-image's hull of an array once.  Return the time, and True if that hull equals ``filled``."""
    results: list[Any] = []
    by_scikit_image(np.ones((2, 2, 2), dtype=np.bool_))  # The first call loads scikit-image.
    figure = timed_once(SCIKIT_IMAGE, lambda: results.append(by_scikit_image(array)))
    return figure, np.array_equal(results[0], filled)


def by_scikit_image(array: Any) -> Any:
    from skimage.morphology import convex_hull_image

    return convex_hull_image(array, offset_coordinates=False)  # type: ignore[no-untyped-call]


def memory(side: int, way: str) -> str:
    """Measure the peak memory of filling the hull of a ball.  Return the memory and the permitted maximum as text."""
    size, most = peak(side, way)
    return f"{most / 1e6:.0f} MB, required: at most {(4 * size + 300e6) / 1e6:.0f} MB"


def peak(side: int, way: str) -> tuple[int, float]:
    """Return the number of voxels in a ball's bounding box, and the peak memory in bytes of computing the hull.

    The peak is the median of three processes.
    """
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

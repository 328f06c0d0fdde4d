"""Digital hulls: the filled hull of solid balls, beside scikit-image where it is installed, and its memory."""

from __future__ import annotations

import statistics
import subprocess
import sys
import time
from collections.abc import Iterator
from importlib.util import find_spec
from typing import Any

import numpy as np

from modern.bench.timing import Figure, timed
from modern.digital.hull import digital_hull
from modern.digital.solids import VERTEX, ball
from modern.papers.yau_srihari import octree_hull

BARS = {128: "bar 1 s", 256: "bar 4 s", 512: "bar 30 s"}

PEAK = """
import resource, sys
from modern.digital.hull import digital_hull
from modern.digital.solids import ball
array = ball(int(sys.argv[1]), "vertex").array
digital_hull(array, sys.argv[2] == "compiled")
peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1 if sys.platform == "darwin" else 1024)
print(array.size, peak)
"""


def figures(largest: int = 512) -> Iterator[Figure]:
    """Every figure, smallest first."""
    ways = ([("compiled", True)] if find_spec("numba") else []) + [("plain", False)]
    small = ball(64, VERTEX).array
    ours = {}
    for name, fast in ways:
        ours[name] = timed(f"filled hull of a ball of 64^3, {name}", lambda fast=fast: digital_hull(small, fast))  # type: ignore[misc]
        yield ours[name]
    theirs = scikit_image(small)
    if theirs is not None:
        ratios = (f"{name} {theirs.median / figure.median:,.0f} times as fast" for name, figure in ours.items())
        yield Figure(theirs.what, theirs.seconds, ", ".join(ratios) + ", bar 100")
    for side in (128, 256, 512):
        if side > largest:
            break
        array = ball(side, VERTEX).array
        for name, fast in ways:
            what = f"filled hull of a ball of {side}^3, {name}"
            note = f"{BARS[side]}; {memory(side, name)}"
            yield timed(what, lambda array=array, fast=fast: digital_hull(array, fast), note)  # type: ignore[misc]
    octrees = ball(32)
    yield timed("octree hull (Yau and Srihari), ball of diameter 32", lambda: octree_hull(octrees))


def scikit_image(array: Any) -> Figure | None:
    """Once scikit-image on the same voxels, and whether it finds the same; None where it is not installed.

    ``offset_coordinates=False`` is the hull of the voxels' centres.  It takes long, so it is timed once.
    """
    try:
        from skimage.morphology import convex_hull_image
    except ImportError:
        return None
    start = time.perf_counter()
    filled = convex_hull_image(array, offset_coordinates=False)  # type: ignore[no-untyped-call]
    seconds = time.perf_counter() - start
    same = "same voxels" if np.array_equal(filled, digital_hull(array).filled) else "OTHER VOXELS"
    return Figure(f"scikit-image, ball of {len(array)}^3, once, {same}", (seconds,))


def memory(side: int, way: str) -> str:
    """The most memory a process holds that makes the ball and fills its hull, beside the bar."""
    peaks = []
    for _ in range(3):
        run = subprocess.run([sys.executable, "-c", PEAK, str(side), way], check=True, capture_output=True, text=True)
        size, peak = map(int, run.stdout.split())
        peaks.append(peak)
    return f"{statistics.median(peaks) / 1e6:.0f} MB, bar {(4 * size + 300e6) / 1e6:.0f} MB"


def main() -> None:
    """Print every figure."""
    for figure in figures():
        print(figure.line(), flush=True)


if __name__ == "__main__":
    main()

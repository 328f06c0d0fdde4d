"""How the hulls' time grows with the number of points: ``python -m modern.bench.growth FILE.svg`` (extra ``plot``)."""

from __future__ import annotations

import sys
from typing import Any

from modern.bench.clock import timed
from modern.bench.hulls import ball, eight_digits, exact_in_doubles, port, qhull
from modern.exact_hull import exact_hull

COUNTS = (100, 1_000, 10_000, 100_000, 1_000_000)
LARGEST_FOR_JUDGE = 100_000
PORT = ("port, float64, numpy", "port, float64, fast")


def measured() -> dict[str, list[tuple[int, float]]]:
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


def plot(found: dict[str, list[tuple[int, float]]], path: str) -> None:
    """Log-log lines that can be told apart in grey."""
    import matplotlib

    matplotlib.use("svg")
    matplotlib.rcParams["svg.hashsalt"] = "hull1620"
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(7, 4.5))
    styles: list[dict[str, Any]] = [
        {"marker": "o", "linestyle": "-", "color": "0"},
        {"marker": "D", "linestyle": "-.", "color": "0"},
        {"marker": "s", "linestyle": "--", "color": "0.35"},
        {"marker": "^", "linestyle": ":", "color": "0.5"},
    ]
    for (name, points), style in zip(found.items(), styles, strict=True):
        if points:
            axes.loglog(*zip(*points, strict=True), label=name, **style)
    axes.set_xlabel("points, uniform in a ball")
    axes.set_ylabel("seconds, median of five")
    axes.grid(True, which="major", color="0.9")
    axes.legend()
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})


def main() -> None:
    """Measure, print and plot."""
    if len(sys.argv) != 2:
        sys.exit("usage: python -m modern.bench.growth FILE.svg")
    found = measured()
    for name, points in found.items():
        print(name, ", ".join(f"{count:,}: {seconds:.4f} s" for count, seconds in points))
    plot(found, sys.argv[1])


if __name__ == "__main__":
    main()

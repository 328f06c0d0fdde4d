"""Benchmarks of hidden-line drawings by Nakamae and Nishita's method, also with growing numbers of cuboids.

``python -m modern.bench.suite.hidden_line FILE.svg`` measures the growth and plots it (extra ``plot``).
"""

import math
import sys
from collections.abc import Iterator
from fractions import Fraction
from functools import partial

from modern.bench.timing import Curve, Figure, plot, timed
from modern.papers.nakamae_nishita.hidden import Drawing, draw
from modern.papers.nakamae_nishita.polyhedron import Polyhedron
from modern.papers.nakamae_nishita.projection import parallel
from modern.papers.nakamae_nishita.scenes import scene
from modern.papers.nakamae_nishita.shapes import cuboid, moved, placed

COUNTS = (10, 20, 50, 100, 200, 500, 1000)
EYE = (30, -46, 27)


def array(x: int, y: int, z: int, step: Fraction) -> list[Polyhedron]:
    unit_cuboid = cuboid("cuboid", Fraction(1), Fraction(1), Fraction(1))
    places = ((i, j, k) for i in range(x) for j in range(y) for k in range(z))
    return [placed(unit_cuboid, moved((step * i, step * j, step * k)), "cuboid") for i, j, k in places]


def field(count: int) -> list[Polyhedron]:
    """Return ``count`` cuboids on a floor, so far apart that few of them overlap in the picture."""
    side = math.isqrt(count - 1) + 1
    return array(side, side, 1, Fraction(2))[:count]


def block(count: int) -> list[Polyhedron]:
    """Return ``count`` cuboids in a three-dimensional grid, in which more of them overlap in the picture."""
    side = next(n for n in range(1, count + 1) if n**3 >= count)
    return array(side, side, side, Fraction(7, 4))[:count]


def drawn(polyhedra: list[Polyhedron]) -> Drawing:
    """Draw the polyhedra by steps II and III of the paper, including the proof that no two polyhedra intersect."""
    return draw(polyhedra, parallel(EYE))


def figures() -> Iterator[Figure]:
    cuboids = scene("cuboids")
    observer = cuboids.sight.observer(cuboids.make)
    yield timed("hidden lines, 60 cuboids, all steps", lambda: draw(cuboids.make, observer), "bar 0.3 s")
    yield timed("hidden lines, 1,000 cuboids in a grid, all steps", lambda: drawn(block(1000)), "bar 10 s")
    yield timed("hidden lines, 1,000 cuboids on a floor, all steps", lambda: drawn(field(1000)))


def growth() -> dict[str, list[tuple[int, float, int]]]:
    """Measure median seconds of all steps, and the overlapping pairs, by arrangement and number of cuboids."""
    rows_by_arrangement: dict[str, list[tuple[int, float, int]]] = {}
    for name, arrangement in (("in a grid of three dimensions", block), ("on a floor, few overlap", field)):
        rows_by_arrangement[name] = [
            (count, timed("", partial(drawn, arrangement(count))).median, len(drawn(arrangement(count)).relations))
            for count in COUNTS
        ]
    return rows_by_arrangement


def curves(rows_by_arrangement: dict[str, list[tuple[int, float, int]]]) -> list[Curve]:
    *_, (count, seconds, _) = rows_by_arrangement["on a floor, few overlap"]
    scale = seconds / (count * math.log(count))
    guide = Curve("n log n", [(n, scale * n * math.log(n)) for n in COUNTS])
    return [*(Curve(name, [row[:2] for row in rows]) for name, rows in rows_by_arrangement.items()), guide]


def main() -> None:
    if len(sys.argv) != 2:
        sys.exit("usage: python -m modern.bench.suite.hidden_line FILE.svg")
    for figure in figures():
        print(figure.line())
    rows_by_arrangement = growth()
    for name, rows in rows_by_arrangement.items():
        print(name, ", ".join(f"{count:,}: {seconds:.4f} s, {pairs} pairs" for count, seconds, pairs in rows))
    plot(curves(rows_by_arrangement), sys.argv[1], "cuboids")


if __name__ == "__main__":
    main()

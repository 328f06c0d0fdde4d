"""Benchmarks of hidden-line drawings of cuboids by Nakamae and Nishita's method.

``python -m modern.bench.suite.hidden_line FILE.svg`` also measures growing numbers of
cuboids and plots the times (extra ``plot``).
"""

import math
import sys
from collections.abc import Iterator
from fractions import Fraction
from functools import partial

from modern.bench.timing import Curve, Figure, plotted, timed
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
    """Return cuboids on a floor, so far apart that few of them overlap in the picture."""
    side = math.isqrt(count - 1) + 1
    return array(side, side, 1, Fraction(2))[:count]


def block(count: int) -> list[Polyhedron]:
    """Return cuboids in a three-dimensional grid, in which more of them overlap in the picture than on a floor."""
    side = next(n for n in range(1, count + 1) if n**3 >= count)
    return array(side, side, side, Fraction(7, 4))[:count]


def drawn(polyhedra: list[Polyhedron]) -> Drawing:
    """Check that no two polyhedra intersect, and draw them without hidden lines by Nakamae and Nishita's method."""
    return draw(polyhedra, parallel(EYE))


def figures() -> Iterator[Figure]:
    cuboids = scene("cuboids")
    observer = cuboids.sight.observer(cuboids.make)
    yield timed("hidden lines, 60 cuboids, all steps", lambda: draw(cuboids.make, observer), "required: 0.3 s")
    for name, arrangement, required in (("in a grid", block, "required: 10 s, "), ("on a floor", field, "")):
        pairs = len(drawn(arrangement(1000)).relations)
        what = f"hidden lines, 1,000 cuboids {name}, all steps"
        yield timed(what, partial(drawn, arrangement(1000)), f"{required}{pairs} overlapping pairs")


def growth() -> list[Curve]:
    """Measure the median seconds for growing numbers of cuboids, as one curve for each arrangement.

    The last curve is n log n, for comparison.
    """
    curves = [
        Curve(name, [(count, timed("", partial(drawn, arrangement(count))).median) for count in COUNTS])
        for name, arrangement in (("in a grid of three dimensions", block), ("on a floor, few overlap", field))
    ]
    # The curve n log n ends in the last point of the cuboids on a floor.
    count, seconds = curves[1].points[-1]
    scale = seconds / (count * math.log(count))
    return [*curves, Curve("n log n", [(n, scale * n * math.log(n)) for n in COUNTS])]


def main() -> None:
    if len(sys.argv) != 2:
        sys.exit("usage: python -m modern.bench.suite.hidden_line FILE.svg")
    for figure in figures():
        print(figure.line())
    for line in plotted(growth(), sys.argv[1], "cuboids"):
        print(line)


if __name__ == "__main__":
    main()

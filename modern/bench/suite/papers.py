"""Benchmarks of the later papers: Appel and Will's convex edges, hidden lines, Kovalevsky and Schulz's cell lists.

The hull of 60 points by Appel and Will's method is computed exactly, with sorted star polygons and with the test in
one pass. For Kovalevsky and Schulz's cell list, the table gives seconds, and microseconds for each inserted local
corner.
"""

import random
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from modern.bench.suite import hidden_line
from modern.bench.suite.hulls import ball, eight_digits
from modern.bench.timing import Figure, timed
from modern.digital import solids
from modern.exact_hull import exact_hull
from modern.papers.appel_will import CORRECTED, Method, appel_will
from modern.papers.appel_will.star import as_corrected
from modern.papers.kovalevsky_schulz import (
    CENTRES,
    INVISIBLE,
    VERTICES,
    VISIBLE,
    Coplanar,
    Of,
    local_corners,
    voxel_hull,
)

POINTS = 60
ON_SPHERE = 200
LARGEST_BALL = 128
WAYS: tuple[tuple[Of, int, Coplanar], ...] = (
    (VERTICES, 26, VISIBLE),
    (VERTICES, 6, INVISIBLE),
    (CENTRES, 26, VISIBLE),
)
# The ball of this diameter, which the paper uses, must take less than 2 s.
BAR = 32


def figures() -> Iterator[Figure]:
    yield from convex_edges()
    yield from hidden_line.figures()
    yield from cell_lists()


def on_sphere(count: int, seed: int = 3) -> list[tuple[int, int, int]]:
    """Return points of eight digits close to a sphere.  All are vertices of their hull, so it has the most edges."""
    directions = np.random.default_rng(seed).normal(size=(count, 3))
    return [tuple(p) for p in eight_digits(directions / np.linalg.norm(directions, axis=1)[:, None]).tolist()]


def on_grid(count: int) -> list[tuple[int, int, int]]:
    """Return distinct points of a 5 x 5 x 5 grid, many of them collinear or coplanar."""
    cells = [(x, y, z) for x in range(5) for y in range(5) for z in range(5)]
    return random.Random(4).sample(cells, count)


def convex_edges() -> Iterator[Figure]:
    in_ball = [tuple(p) for p in eight_digits(ball(POINTS)).tolist()]
    sets = {"in a ball": in_ball, "on a sphere": on_sphere(POINTS), "of a grid": on_grid(POINTS)}
    by_star = Method(star=as_corrected)
    for name, points in sets.items():
        what = f"Appel & Will, {POINTS} points {name}"
        short_form = timed(what, lambda p=points: appel_will(p, method=CORRECTED), "bar 2 s")  # type: ignore[misc]
        yield short_form
        star = timed(f"{what}, star polygons", lambda p=points: appel_will(p, method=by_star))  # type: ignore[misc]
        yield Figure(star.what, star.seconds, f"{star.median / short_form.median:.1f} times as long")
        judge = timed(f"judge, {POINTS} points {name}", lambda p=points: exact_hull(p))  # type: ignore[misc]
        yield Figure(judge.what, judge.seconds, f"Appel & Will {short_form.median / judge.median:.1f} times as long")
    many = on_sphere(ON_SPHERE)
    yield timed(f"Appel & Will, {ON_SPHERE} points on a sphere", lambda: appel_will(many, method=CORRECTED))


def cell_lists() -> Iterator[Figure]:
    """Measure the cell lists of balls with diameters 32, 64, ..., and their local corners alone."""
    diameter = BAR
    while diameter <= LARGEST_BALL:
        volume = solids.ball(diameter)
        for of, neighbours, coplanar in WAYS:
            yield cell_list(volume, of, neighbours, coplanar, "bar 2 s" if diameter == BAR else "")
        yield timed(f"  its local corners alone, {volume.source}", lambda v=volume: local_corners(v))  # type: ignore[misc]
        diameter *= 2


def cell_list(volume: solids.Volume, of: Of, neighbours: int, coplanar: Coplanar, bar: str) -> Figure:
    """Measure the cell list of a solid's hull.  The note of the result has the time for each local corner."""
    corners = len(local_corners(volume, of, neighbours))
    figure = timed(
        f"cell list, {volume.source}, {of}, {neighbours}, {coplanar}",
        lambda: voxel_hull(volume, of, neighbours, coplanar),
    )
    cost = f"{corners} corners, {figure.median / corners * 1e6:.0f} microseconds each"
    return replace(figure, note=f"{bar}; {cost}" if bar else cost)

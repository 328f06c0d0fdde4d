"""Benchmarks of the later papers: Appel and Will's convex edges, hidden lines, and Kovalevsky and Schulz's cell lists.

Appel and Will's method is timed on 60 points in exact arithmetic with two tests for an edge. Both tests project the
points along a line. One test sorts the images by angle, and the other makes a single pass over the unsorted images.
For Kovalevsky and Schulz's cell list, the output gives the seconds, and the microseconds for each local corner.
"""

import random
from collections.abc import Iterator
from dataclasses import replace
from functools import partial

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
# The diameter of the ball that the paper uses.  Its cell list must take less than 2 s.
PAPER_BALL = 32


def figures() -> Iterator[Figure]:
    yield from convex_edges()
    yield from hidden_line.figures()
    yield from cell_lists()


def on_sphere(count: int, seed: int = 3) -> list[tuple[int, int, int]]:
    """Return points with coordinates of eight digits close to a sphere.  All of them are vertices of their hull."""
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
        short_form = timed(what, partial(appel_will, points, method=CORRECTED), "required: 2 s")
        yield short_form
        star = timed(f"{what}, star polygons", partial(appel_will, points, method=by_star))
        yield Figure(star.what, star.seconds, f"{star.median / short_form.median:.1f} times as long")
        judge = timed(f"judge, {POINTS} points {name}", partial(exact_hull, points))
        yield Figure(judge.what, judge.seconds, f"Appel & Will {short_form.median / judge.median:.1f} times as long")
    many = on_sphere(ON_SPHERE)
    yield timed(f"Appel & Will, {ON_SPHERE} points on a sphere", lambda: appel_will(many, method=CORRECTED))


def cell_lists() -> Iterator[Figure]:
    """Time the cell lists of balls with diameters 32, 64 and 128, and the search for their local corners alone."""
    diameter = PAPER_BALL
    while diameter <= LARGEST_BALL:
        volume = solids.ball(diameter)
        for of, neighbours, coplanar in WAYS:
            yield cell_list(volume, of, neighbours, coplanar, "required: 2 s" if diameter == PAPER_BALL else "")
        yield timed(f"  its local corners alone, {volume.source}", partial(local_corners, volume))
        diameter *= 2


def cell_list(volume: solids.Volume, of: Of, neighbours: int, coplanar: Coplanar, required: str) -> Figure:
    """Time the cell list of a solid's hull.  The note has the number of local corners and the time for each."""
    corners = len(local_corners(volume, of, neighbours))
    figure = timed(
        f"cell list, {volume.source}, {of}, {neighbours}, {coplanar}",
        lambda: voxel_hull(volume, of, neighbours, coplanar),
    )
    cost = f"{corners} corners, {figure.median / corners * 1e6:.0f} microseconds each"
    return replace(figure, note=f"{required}; {cost}" if required else cost)

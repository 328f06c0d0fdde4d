"""Appel & Will's method: 60 points exactly, by the star polygon itself and by its short form, beside the judge."""

from __future__ import annotations

import random
from collections.abc import Iterator

import numpy as np

from modern.bench.clock import Figure, timed
from modern.bench.hulls import ball, eight_digits
from modern.exact_hull import exact_hull
from modern.papers.appel_will import MENDED, Method, appel_will
from modern.papers.appel_will.star import as_mended

POINTS = 60
LARGEST = 200


def on_sphere(count: int, seed: int = 3) -> list[tuple[int, int, int]]:
    """Points of eight digits close to a sphere: all of them vertices, the most edges there can be."""
    directions = np.random.default_rng(seed).normal(size=(count, 3))
    return [tuple(p) for p in eight_digits(directions / np.linalg.norm(directions, axis=1)[:, None]).tolist()]


def on_grid(count: int, seed: int = 4) -> list[tuple[int, int, int]]:
    """Distinct points of a 5 x 5 x 5 grid: many in one line and in one plane."""
    cells = [(x, y, z) for x in range(5) for y in range(5) for z in range(5)]
    return random.Random(seed).sample(cells, count)


def figures() -> Iterator[Figure]:
    """Every figure."""
    in_ball = [tuple(p) for p in eight_digits(ball(POINTS)).tolist()]
    sets = {"in a ball": in_ball, "on a sphere": on_sphere(POINTS), "of a grid": on_grid(POINTS)}
    by_star = Method(star=as_mended)
    for name, points in sets.items():
        what = f"Appel & Will, {POINTS} points {name}"
        ours = timed(what, lambda p=points: appel_will(p, method=MENDED), "bar 2 s")  # type: ignore[misc]
        yield ours
        star = timed(f"{what}, star polygons", lambda p=points: appel_will(p, method=by_star))  # type: ignore[misc]
        yield Figure(star.what, star.seconds, f"{star.median / ours.median:.1f} times as long")
        judge = timed(f"judge, {POINTS} points {name}", lambda p=points: exact_hull(p))  # type: ignore[misc]
        yield Figure(judge.what, judge.seconds, f"Appel & Will {ours.median / judge.median:.1f} times as long")
    many = on_sphere(LARGEST)
    yield timed(f"Appel & Will, {LARGEST} points on a sphere", lambda: appel_will(many, method=MENDED))


if __name__ == "__main__":
    for figure in figures():
        print(figure.line())

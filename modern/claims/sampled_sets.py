"""Small sets of whole points for the claims, always the same, with the construction and the judge's hull of each."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from random import Random

from modern.exact_hull import ExactHull, exact_hull
from modern.geometry.hull import Hull
from modern.geometry.vectors import cross, dot, minus
from modern.port import convex_hull

Point = tuple[int, int, int]
Plane = tuple[int, int, int, int]
_SIZE, _LEAST, _MOST = 5, 7, 11
_BEGIN = {2: 1965, 3: 313}
"""So that the first two sets of each dimension have what claims are about: points inside, one on the boundary, and in
space a face of four corners."""


@dataclass(frozen=True, slots=True)
class Grown:
    """One H_j: the points that are vertices so far, and its equations, each outward, with their defining points."""

    vertices: tuple[int, ...]
    equations: tuple[Plane, ...]
    defining: tuple[tuple[int, ...], ...]


@dataclass(frozen=True, slots=True, eq=False)
class SampledSet:
    """Distinct points, what the procedure of chapter 3 makes of them exactly, and the judge's hull."""

    points: tuple[Point, ...]
    hull: Hull
    judge: ExactHull

    @property
    def flat(self) -> bool:
        return self.judge.dimension == 2

    def stages(self) -> tuple[Grown, ...]:
        """H_1, H_2, ... with their equations as integers."""
        found: list[Grown] = []
        vertices: tuple[int, ...] = ()
        for stage in self.hull.history:
            vertices += stage.added
            start = self.hull.history[0].added
            planes = tuple(_outward(self.points, defining, start, self.flat) for defining in stage.equations)
            found.append(Grown(vertices, planes, stage.equations))
        return tuple(found)


def value(plane: Plane, point: Point) -> int:
    """A x + B y + C z + D."""
    return dot(plane[:3], point) + plane[3]


def through(p: Point, q: Point, r: Point) -> Plane:
    """The plane through three points, by a cross product, not by (3.4)."""
    normal = cross(minus(q, p), minus(r, p))
    return (*normal, -dot(normal, p))


def _outward(points: tuple[Point, ...], defining: tuple[int, ...], start: tuple[int, ...], flat: bool) -> Plane:
    """An equation with the mean of the first points on its negative side; of a line the upright plane through it."""
    if flat:
        p, q = (points[k] for k in defining)
        normal = cross(_normal(points, start), minus(q, p))
        plane: Plane = (*normal, -dot(normal, p))
    else:
        p, q, r = (points[k] for k in defining)
        plane = through(p, q, r)
    mean = sum(value(plane, points[k]) for k in start)
    return (-plane[0], -plane[1], -plane[2], -plane[3]) if mean > 0 else plane


def _normal(points: tuple[Point, ...], start: tuple[int, ...]) -> Point:
    p, q, r = (points[k] for k in start[:3])
    return cross(minus(q, p), minus(r, p))


@cache
def sampled_sets(dimension: int, count: int) -> tuple[SampledSet, ...]:
    """``count`` sets in space (3) or in a plane that is no coordinate plane (2), some of them with points in line."""
    random = Random(_BEGIN[dimension])
    found: list[SampledSet] = []
    while len(found) < count:
        number = random.randint(_LEAST, _MOST)
        drawn: dict[Point, None] = {}
        while len(drawn) < number:
            x, y, z = (random.randint(-_SIZE, _SIZE) for _ in range(3))
            drawn[(x, y, z) if dimension == 3 else (x, y, x - 2 * y + 3)] = None
        points = tuple(drawn)
        judge = exact_hull(points)
        if judge.dimension == dimension:
            found.append(SampledSet(points, convex_hull(points, history=True), judge))
    return tuple(found)

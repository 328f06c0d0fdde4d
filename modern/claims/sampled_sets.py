"""Data that the checks of several documents share: sampled point sets and counterexamples."""

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import cache, partial
from importlib.resources import files
from random import Random

from modern.claims.evidence import Generator
from modern.claims.hulls import convex_hull, exact_hull
from modern.exact_hull import ExactHull
from modern.formats.csv import points as csv_points
from modern.geometry.hull import Hull
from modern.geometry.vectors import cross, dot, minus

Point = tuple[int, int, int]
Plane = tuple[int, int, int, int]
# The number of sets of each dimension that ``reproduce`` samples; the tests sample more.
CASES = 2
_COORDINATE_LIMIT, _FEWEST_POINTS, _MOST_POINTS = 5, 7, 11


def _draw_set(random: Random, dimension: int) -> tuple[Point, ...]:
    size = random.randint(_FEWEST_POINTS, _MOST_POINTS)
    a, b, c = (random.randint(-2, 2) for _ in range(3)) if dimension == 2 else (0, 0, 0)
    distinct: dict[Point, None] = {}
    while len(distinct) < size:
        x, y, z = (random.randint(-_COORDINATE_LIMIT, _COORDINATE_LIMIT) for _ in range(3))
        distinct[x, y, z if dimension == 3 else a * x + b * y + c] = None
    return tuple(distinct)


def _has_dimension(points: tuple[Point, ...], dimension: int) -> bool:
    return exact_hull(points).dimension == dimension


# Generators by dimension: 2, sets each in a drawn plane; 3, sets in space. The first two sets of each have the cases
# that some checks need: points inside the hull, a point on its boundary and, in space, a face with four corners.
# Samples of another dimension, for example coplanar points in space, are skipped.
_PLANE = "a plane z = ax + by + c with a, b and c from -2 to 2, x and y"
SETS = {
    dimension: Generator(
        f"sets of 7 to 11 points in {place} from -5 to 5",
        seed,
        partial(_draw_set, dimension=dimension),
        partial(_has_dimension, dimension=dimension),
    )
    for dimension, seed, place in ((2, 1963, _PLANE), (3, 313, "space, coordinates"))
}


# This generator draws the same number of sets in a plane and in space, with a separate seed for each kind.
BOTH = Generator(
    "as many sets of 7 to 11 points in planes z = ax + by + c (seed 1963) as in space", SETS[3].seed, SETS[3].draw
)


def counterexample(name: str) -> str:
    return files("transcripts").joinpath("counterexamples", name).read_text(encoding="utf-8")


@dataclass(frozen=True, slots=True)
class Approximation:
    """A stage H_j in the construction of a hull: its vertices, and its outward equations with their defining points."""

    vertices: tuple[int, ...]
    equations: tuple[Plane, ...]
    defining: tuple[tuple[int, ...], ...]


@dataclass(frozen=True, slots=True, eq=False)
class SampledSet:
    """Distinct points, their exact hull by the procedure of chapter 3, and the hull that ``exact_hull`` computes."""

    points: tuple[Point, ...]
    hull: Hull
    judge: ExactHull

    @property
    def flat(self) -> bool:
        return self.judge.dimension == 2

    def stages(self) -> tuple[Approximation, ...]:
        """Return the stages H_1, H_2, ... of the construction, each with integer equations."""
        approximations: list[Approximation] = []
        vertices: tuple[int, ...] = ()
        start = self.hull.history[0].added
        for stage in self.hull.history:
            vertices += stage.added
            planes = tuple(_outward(self.points, defining, start, self.flat) for defining in stage.equations)
            approximations.append(Approximation(vertices, planes, stage.equations))
        return tuple(approximations)


def plane_value(plane: Plane, point: Point) -> int:
    """Return A x + B y + C z + D for the plane (A, B, C, D) and the point (x, y, z)."""
    return dot(plane[:3], point) + plane[3]


def is_closed_curve(edges: Collection[tuple[int, int]]) -> bool:
    """Return True if edges form one closed curve: they are connected, and each end belongs to two of them."""
    ends = [end for edge in edges for end in edge]
    reached = {*ends[:1]}
    for _ in edges:
        reached |= {end for edge in edges if reached & {*edge} for end in edge}
    return bool(ends) and reached == {*ends} and all(ends.count(end) == 2 for end in ends)


def plane_through(p: Point, q: Point, r: Point) -> Plane:
    """Return the plane through three points by a cross product, independently of equation (3.4) of the thesis."""
    normal = cross(minus(q, p), minus(r, p))
    return (*normal, -dot(normal, p))


def reduced_plane(plane: Plane) -> Plane:
    """Divide the coefficients of a plane by their greatest common divisor."""
    divisor = math.gcd(*plane)
    a, b, c, d = (coefficient // divisor for coefficient in plane)
    return a, b, c, d


def _outward(points: tuple[Point, ...], defining: tuple[int, ...], start: tuple[int, ...], flat: bool) -> Plane:
    """Return the integer equation through the defining points that is negative at the mean of the points ``start``.

    If the set is flat, the equation is that of an edge: the plane through the edge perpendicular to the plane of the
    set.
    """
    if flat:
        p, q = (points[k] for k in defining)
        normal = cross(_normal(points, start), minus(q, p))
        plane: Plane = (*normal, -dot(normal, p))
    else:
        p, q, r = (points[k] for k in defining)
        plane = plane_through(p, q, r)
    return oriented(plane, [points[k] for k in start])


def oriented(plane: Plane, points: Sequence[Point]) -> Plane:
    """Return an equation of the plane that is negative at the mean of the points."""
    total = sum(plane_value(plane, point) for point in points)
    return plane if total < 0 else (-plane[0], -plane[1], -plane[2], -plane[3])


def _normal(points: tuple[Point, ...], start: tuple[int, ...]) -> Point:
    p, q, r = (points[k] for k in start[:3])
    return cross(minus(q, p), minus(r, p))


def added_points(hull: Hull) -> list[int]:
    """Return the indices of the points that the procedure added to its hulls, in order."""
    return [k for stage in hull.history for k in stage.added]


@cache
def _drawn(dimension: int) -> tuple[list[SampledSet], Random]:
    """Return the sets drawn so far and the state of the generator; :func:`sampled_sets` extends the list."""
    return [], Random(SETS[dimension].seed)


def sampled_sets(dimension: int, count: int) -> tuple[SampledSet, ...]:
    """Return ``count`` sets in space (dimension 3) or each in a plane (2); some have three collinear points."""
    sets, random = _drawn(dimension)
    while len(sets) < count:
        points = SETS[dimension].draw(random)
        judge = exact_hull(points)
        if judge.dimension == dimension:
            sets.append(SampledSet(points, convex_hull(points, history=True), judge))
    return tuple(sets[:count])


def flat_and_spatial_sets(count: int) -> tuple[SampledSet, ...]:
    """Return ``count`` sets that lie in a plane, followed by ``count`` sets in space."""
    return (*sampled_sets(2, count), *sampled_sets(3, count))


def counterexample_points(name: str) -> list[Point]:
    """Return the points with integer coordinates of a CSV file in ``transcripts/counterexamples``."""
    rows, _ = csv_points(counterexample(name), name)
    return [(int(x), int(y), int(z)) for x, y, z in rows]

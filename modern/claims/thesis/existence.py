"""Proofs by exact instances of theorems 4.1, 4.2 and 4.8 of the thesis, which claim that something exists."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import combinations, product

from modern.claims.evidence import Check, claim, proved
from modern.claims.hulls import convex_hull, exact_hull
from modern.claims.invariants import is_sphere, plane_at
from modern.claims.sampled_sets import added_points
from modern.claims.thesis.chapter4_examples import points_of_h_5, theorem_of
from modern.geometry.vectors import cross, dot, minus

# An extreme is an axis and a sign: (0, 1) is the largest x, (0, -1) the smallest.
Extreme = tuple[int, int]
EXTREMES: tuple[Extreme, ...] = tuple(product(range(3), (1, -1)))
Lattice = tuple[int, int, int]
# The coordinates of the points of theorem 4.1 are from -SIDE to SIDE, and only extreme points reach these.
SIDE = 4
# Planes A x + B y + C z = D: for each way in which extremes can coincide, one of them has suitable points.
PLANES: tuple[tuple[Lattice, int], ...] = (
    *(((1, b, c), -2) for b, c in ((1, -1), (1, 1))),
    *((normal, 0) for normal in ((1, -2, -2), (1, -2, 2), (0, 1, -1), (0, 1, 1), (1, -1, 0), (1, 1, 0))),
    *(((1, 0, c), 0) for c in (-1, 1)),
    *((normal, d) for normal in ((2, -3, -2), (2, -3, 2), (2, -2, -3), (2, -2, 3)) for d in (4, -4)),
)


def coincidences(extremes: Sequence[Extreme] = EXTREMES) -> Iterator[tuple[frozenset[Extreme], ...]]:
    """Yield each way in which some of the six extreme points of a set can be the same point.

    Extreme points that coincide form a group.  No group contains both the largest and the smallest value of a
    coordinate, because all points would then be equal in this coordinate.
    """
    if not extremes:
        yield ()
        return
    first, *rest = extremes
    for division in coincidences(rest):
        yield (frozenset([first]), *division)
        for k, block in enumerate(division):
            if (first[0], -first[1]) not in block:
                yield (*division[:k], block | {first}, *division[k + 1 :])


def _lattice(side: int) -> list[Lattice]:
    return [(x, y, z) for x, y, z in product(range(-side, side + 1), repeat=3)]


def coplanar_extremes() -> Iterator[bool]:
    """Yield, for each way in which extreme points can coincide, True if they can be coplanar in a set that is not."""
    on_planes: list[dict[frozenset[Extreme], Lattice]] = [
        {_extremes_of(p): p for p in _lattice(SIDE) if dot(normal, p) == d} for normal, d in PLANES
    ]
    # The points of this cube are not coplanar and never extreme.
    cube = _lattice(1)
    for division in coincidences():
        possible = [plane for plane in on_planes if {*division} <= {*plane}]
        points = [plane[block] for plane in possible[:1] for block in division]
        largest = {(k, sign): max(sign * q[k] for q in (*points, *cube)) for k, sign in EXTREMES}
        attained = {(k, s): [p for p in (*points, *cube) if s * p[k] == most] for (k, s), most in largest.items()}
        alone = [attained[e] == [p] for block, p in zip(division, points, strict=False) for e in block]
        yield len(alone) == len(EXTREMES) and all(alone)


def _extremes_of(p: Lattice) -> frozenset[Extreme]:
    return frozenset((k, 1 if c > 0 else -1) for k, c in enumerate(p) if abs(c) == SIDE)


def table_1() -> Iterator[bool]:
    """Yield the facts that show that Table 1 of theorem 4.2 describes a nonconvex polyhedron on six extreme points."""
    theorem = theorem_of("4.2")
    # The coordinates are multiples of 1/4.
    at: dict[str, Lattice] = {p.name: tuple(int(4 * c) for c in p.at) for p in theorem.points}  # type: ignore[misc]
    for label, name in theorem.extremes.items():
        axis, sign = "xyz".index(label[1]), 1 if label[0] == "l" else -1
        yield all(sign * at[name][axis] >= sign * p[axis] for p in at.values())
    faces = [plane.vertices for plane in theorem.planes]
    # Each side belongs to two triangles, and Euler's formula holds: the surface is a sphere.
    yield is_sphere(faces) and {name for face in faces for name in face} == {*at}
    yield all(plane.at(p) == 0 for plane in theorem.planes for p in theorem.points if p.name in plane.vertices)
    # No two triangles meet except in their common corners and sides.
    yield from (_are_separate(a, b, at) for a, b in combinations(faces, 2))
    # Faces 7 and 8 have corners of the polyhedron on both sides.
    signs = [{plane.at(p) > 0 for p in theorem.points if plane.at(p)} for plane in theorem.planes]
    yield sum(len(sides_of_face) == 2 for sides_of_face in signs) == 2


def _are_separate(first: Sequence[str], second: Sequence[str], at: Mapping[str, Lattice]) -> bool:
    """Return True if two triangles do not meet except in their common corners and sides.

    Two triangles with a common side must not be coplanar.  If two triangles have no common side, a plane must separate
    them.  The only point of the triangles that this plane may contain is a common corner.
    """
    shared = {*first} & {*second}
    rest = [[at[name] for name in face if name not in shared] for face in (first, second)]
    if len(shared) == 2:
        p, q = (at[name] for name in sorted(shared))
        return dot(cross(minus(q, p), minus(rest[0][0], p)), minus(rest[1][0], p)) != 0
    for normal in _lattice(2):
        above, below = (sorted(dot(normal, p) for p in points) for points in rest)
        between = [dot(normal, at[name]) for name in shared]
        if below[-1] < above[0] and all(below[-1] < value < above[0] for value in between):
            return True
    return False


def outside_several_planes() -> Iterator[bool]:
    """Yield the facts of theorem 4.8: the procedure makes the hull H_5, then adds a point outside six planes of H_5."""
    theorem = theorem_of("4.8")
    points = [point.at for point in theorem.points]
    hull = convex_hull(points, history=True)
    used = added_points(hull)
    yield [theorem.points[k].name for k in used[8:]] == ["Q9"]
    yield {theorem.points[k].name for k in used[:8]} == {*points_of_h_5()}
    # The exact hull of the first eight points is computed without the procedure.
    judge = exact_hull([[*points[k]] for k in used[:8]])
    planes = [[*map(Fraction, judge.plane_of(facet))] for facet in judge.facets]
    yield len(judge.vertices) == 8
    yield [sum(plane_at(plane, points[k]) > 0 for plane in planes) for k in used[8:]] == [6]


@claim("thesis.107")
def theorem_4_1() -> Check:
    argument = "If the extreme points of one coordinate coincide, all points are coplanar. For each other way in which "
    argument += "extreme points can coincide, a set that is not coplanar has exactly these extreme points in one plane"
    return proved(argument, coplanar_extremes(), "the six points can be coplanar, whichever of them coincide (87 ways)")


@claim("thesis.112", "thesis.115")
def theorem_4_2() -> Check:
    argument = "The faces of Table 1 form a sphere without self-intersection. Its corners are the six extreme points. "
    argument += "Two faces are not in supporting planes"
    return proved(argument, table_1(), "the faces of Table 1 bound a polyhedron that is not convex")


@claim("thesis.146", "thesis.148")
def theorem_4_8() -> Check:
    argument = "The procedure makes H_5 of the nine points, and the last point is outside six of its planes"
    message = "eight points are the vertices of H_5, and the ninth is outside six of its planes"
    return proved(argument, outside_several_planes(), message)

"""Claims about the approximations H_1, H_2, ...: what stands in every stage of the construction of small sets.

A kind is a function that looks at one set and yields a verdict for each case in it; ``reproduce`` takes two sets of
each dimension, the tests more.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise, product

from modern.claims.register import CONDITION, FAILS, HOLDS, Seen
from modern.claims.sampled_sets import Grown, Plane, Point, SampledSet, sampled_sets, through, value
from modern.claims.thesis.chapter3_equations import COUNT, both, lowest_terms
from modern.exact_hull import exact_hull
from modern.geometry.hull import Stage
from modern.geometry.vectors import cross, dot, minus
from modern.port import convex_hull


def approximations(kind: str, count: str = COUNT) -> Seen:
    """One property of H_1, H_2, ... in every stage of some sets: ``contain``, ``hulls``, ``struck``, ..."""
    sets = (
        sampled_sets(2, int(count)) if kind in _FLAT else sampled_sets(3, int(count)) if kind in _SPACE else both(count)
    )
    looked = good = 0
    for one in sets:
        for right in _PROPERTIES[kind](one):
            looked += 1
            good += right
    words = f"{good} of {looked} cases in the construction of {len(sets)} sets"
    if good < looked or not looked:
        return Seen(FAILS, words)
    return Seen(CONDITION if kind in _WITH_CONDITION else HOLDS, words)


def eliminated(count: str = COUNT) -> Seen:
    """What is struck at each stage, and a square with its middle and the middle of a side, of which one stays."""
    points = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (1, 0, 0), (1, 1, 0)]
    hull = convex_hull(points, history=True)
    stays = hull.boundary == (4,) and {k for stage in hull.history for k in stage.struck} == {5}
    found = approximations("struck_inside", count)
    words = f"{found.words}; of a square the middle of a side is on it and is not struck"
    return Seen(CONDITION if stays and found.verdict == HOLDS else FAILS, words)


def _steps(one: SampledSet) -> Iterator[tuple[Grown, Grown, Stage, int]]:
    """Each stage but the first with the one before it: both, what the port says of it, and the point added."""
    stages = one.stages()
    for before, after, news in zip(stages, stages[1:], one.hull.history[1:], strict=False):
        yield before, after, news, news.added[0]


def _contain(one: SampledSet) -> Iterator[bool]:
    """H_j lies in H_j+1, and less of the point added lies in it: the next one is larger."""
    for before, after, _, new in _steps(one):
        yield all(value(plane, one.points[k]) <= 0 for plane in after.equations for k in before.vertices)
        yield any(value(plane, one.points[new]) > 0 for plane in before.equations)


def _hulls(one: SampledSet) -> Iterator[bool]:
    for stage in one.stages():
        judge = exact_hull([one.points[k] for k in stage.vertices])
        yield {lowest_terms(plane) for plane in stage.equations} == {facet.plane for facet in judge.facets}


def _final(one: SampledSet) -> Iterator[bool]:
    """The equations of a stage all support if and only if they are those of the hull of all points."""
    wanted = {facet.plane for facet in one.judge.facets}
    stages = one.stages()
    for stage in stages:
        support = all(value(plane, point) <= 0 for plane in stage.equations for point in one.points)
        yield support == ({lowest_terms(plane) for plane in stage.equations} == wanted) == (stage is stages[-1])


def _struck(one: SampledSet) -> Iterator[bool]:
    for stage in one.hull.history:
        yield not set(stage.struck) & {*one.judge.vertices}


def _eliminated(one: SampledSet) -> Iterator[bool]:
    """Struck at a stage are just the points inside of it that are left: those on its boundary stay."""
    gone: set[int] = set()
    for stage, news in zip(one.stages(), one.hull.history, strict=True):
        left = set(range(len(one.points))) - gone - {*stage.vertices}
        inside = {k for k in left if all(value(plane, one.points[k]) < 0 for plane in stage.equations)}
        yield inside == set(news.struck)
        gone |= inside


def _contained(one: SampledSet) -> Iterator[bool]:
    """What an H_j holds, inside or on its boundary, and is not one of its vertices, is no vertex of the last hull."""
    for stage in one.stages():
        for k, point in enumerate(one.points):
            if k not in stage.vertices and all(value(plane, point) <= 0 for plane in stage.equations):
                yield k not in one.judge.vertices


def _never_back(one: SampledSet) -> Iterator[bool]:
    """N_j, the points still looked at, is that of the stage before less those struck, and no struck one is used."""
    left = len(one.points)
    gone: set[int] = set()
    for stage in one.hull.history:
        yield not gone & ({*stage.struck} | {*stage.added})
        gone.update(stage.struck)
        yield len(one.points) - len(gone) <= left
        left = len(one.points) - len(gone)


def _finite(one: SampledSet) -> Iterator[bool]:
    yield len(one.hull.history) - 1 <= len(one.points) - one.judge.dimension - 1


def _settled(one: SampledSet) -> Iterator[bool]:
    for before, _, news, _ in _steps(one):
        for plane in before.equations[: news.checked - 1]:
            yield all(value(plane, point) <= 0 for point in one.points)


def _outside(one: SampledSet) -> Iterator[bool]:
    gone: set[int] = set()
    for (before, _, news, new), struck in zip(_steps(one), one.hull.history, strict=False):
        gone.update(struck.struck)
        plane = before.equations[news.checked - 1]
        most = max(value(plane, point) for k, point in enumerate(one.points) if k not in gone)
        yield value(plane, one.points[new]) == most > 0


def _largest_of_all(one: SampledSet) -> Iterator[bool]:
    """The largest value among the points left is the largest among all: what is struck is below zero."""
    for before, _, news, new in _steps(one):
        plane = before.equations[news.checked - 1]
        yield value(plane, one.points[new]) == max(value(plane, point) for point in one.points)


def _one_more(one: SampledSet) -> Iterator[bool]:
    """Where a point is outside of one equation only, that one goes and a face on each of its sides comes."""
    for before, after, news, new in _steps(one):
        if news.outside == 1:
            gone = {*before.defining[news.checked - 1]}
            kept = [d for k, d in enumerate(before.defining) if k != news.checked - 1]
            made = [{*d} for d in after.defining if {*d} not in [{*k} for k in kept]]
            yield len(after.defining) == len(kept) + len(made) == len(before.defining) + one.judge.dimension - 1
            yield sorted(map(sorted, made)) == sorted(sorted({new} | (gone - {k})) for k in gone)


def _both_new(one: SampledSet) -> Iterator[bool]:
    """No given point is outside of both new lines; the corner they make is the new vertex."""
    for _, after, _, new in _steps(one):
        lines = [plane for plane, ends in zip(after.equations, after.defining, strict=True) if new in ends]
        yield len(lines) == 2
        yield all(min(value(plane, point) for plane in lines) <= 0 for point in one.points)


def _counted(one: SampledSet) -> Iterator[bool]:
    """In a plane NV and NE are 3 of H_1 and one more of each further one; in space H_1 has four of both."""
    first = one.judge.dimension + 1
    for number, stage in enumerate(one.stages()):
        yield len(stage.vertices) == first + number
        if one.flat or not number:
            yield len(stage.equations) == first + number


def _moved_up(one: SampledSet) -> Iterator[bool]:
    """The equations after the one removed have its number and the next ones, and the two new ones come last."""
    for before, after, news, _ in _steps(one):
        kept = [d for k, d in enumerate(before.defining) if k != news.checked - 1]
        yield [{*d} for d in after.defining[:-2]] == [{*d} for d in kept]


def _turned_at_one(one: SampledSet) -> Iterator[bool]:
    """NETC of a stage is not less than that of the stage before."""
    yield all(a.checked <= b.checked for a, b in pairwise(one.hull.history))


def _vertices_among_used(one: SampledSet) -> Iterator[bool]:
    yield {*one.judge.vertices} <= {k for stage in one.hull.history for k in stage.added}


def _vertex_once(one: SampledSet) -> Iterator[bool]:
    """Each point is a vertex of the hull of the points so far when it is added."""
    for stage, news in zip(one.stages(), one.hull.history, strict=True):
        judge = exact_hull([one.points[k] for k in stage.vertices])
        yield {stage.vertices.index(k) for k in news.added} <= {*judge.vertices}


def _triangle_added(one: SampledSet) -> Iterator[bool]:
    """Points of a lattice are in H_k+1 if and only if they are in H_k or in the triangle that is added."""
    plane = one.judge.plane
    assert plane is not None
    lattice = [
        (x, y, (-plane[3] - plane[0] * x - plane[1] * y) // plane[2]) for x, y in product(range(-5, 6, 2), repeat=2)
    ]
    for before, after, news, new in _steps(one):
        a, b = (one.points[k] for k in before.defining[news.checked - 1])
        for point in lattice:
            old, now = (max(value(e, point) for e in stage.equations) <= 0 for stage in (before, after))
            yield now == (old or _in_triangle(point, a, b, one.points[new]))


def _tetrahedra_added(one: SampledSet) -> Iterator[bool]:
    """Points of a lattice are in H_k+1 if and only if in H_k or in a tetrahedron of the new point.

    Its other three corners define an equation that the new point is outside of; where no equation but NETC is such,
    it is the only one.
    """
    lattice: list[Point] = [(x, y, z) for x, y, z in product(range(-5, 6, 2), repeat=3)]
    for before, after, news, new in _steps(one):
        apex = one.points[new]
        seen = [k for k, plane in enumerate(before.equations) if value(plane, apex) > 0]
        yield news.checked - 1 in seen
        corners = [[apex, *(one.points[k] for k in before.defining[at])] for at in seen]
        for point in lattice:
            old, now = (max(value(e, point) for e in stage.equations) <= 0 for stage in (before, after))
            yield now == (old or any(_in_tetrahedron(point, four) for four in corners))


def _in_tetrahedron(point: Point, corners: list[Point]) -> bool:
    """Whether a point is on no other side of any face than the corner that is not on it."""
    for k, corner in enumerate(corners):
        plane = through(*(c for m, c in enumerate(corners) if m != k))
        if value(plane, point) * value(plane, corner) < 0:
            return False
    return True


def _in_triangle(point: Point, a: Point, b: Point, c: Point) -> bool:
    """Whether a point of the triangle's plane is a combination of its corners: none of the three areas turns back."""
    normal = cross(minus(b, a), minus(c, a))
    return all(dot(normal, cross(minus(q, p), minus(point, p))) >= 0 for p, q in ((a, b), (b, c), (c, a)))


def _convex_if(one: SampledSet) -> Iterator[bool]:
    """With equation NETC alone replaced the polyhedron is convex if and only if no other value was above zero."""
    inner = [one.points[k] for k in one.hull.history[0].added]
    for before, after, news, new in _steps(one):
        others = [plane for k, plane in enumerate(before.equations) if k != news.checked - 1]
        i, j, k = (one.points[k] for k in before.defining[news.checked - 1])
        made = [_turned(through(p, q, one.points[new]), inner) for p, q in ((i, j), (i, k), (j, k))]
        values = [value(plane, one.points[k]) for plane in (*others, *made) for k in after.vertices]
        yield (max(values) <= 0) == all(value(plane, one.points[new]) <= 0 for plane in others)


def _turned(plane: Plane, inner: list[Point]) -> Plane:
    total = sum(value(plane, point) for point in inner)
    return plane if total < 0 else (-plane[0], -plane[1], -plane[2], -plane[3])


_PROPERTIES = {
    "contain": _contain,
    "hulls": _hulls,
    "final": _final,
    "struck": _struck,
    "struck_inside": _eliminated,
    "contained": _contained,
    "never_back": _never_back,
    "finite": _finite,
    "settled": _settled,
    "outside": _outside,
    "largest": _largest_of_all,
    "lines": _one_more,
    "planes": _one_more,
    "both_new": _both_new,
    "counted": _counted,
    "moved": _moved_up,
    "next": _turned_at_one,
    "used": _vertices_among_used,
    "once": _vertex_once,
    "triangle": _triangle_added,
    "tetrahedra": _tetrahedra_added,
    "convex": _convex_if,
}
KINDS = tuple(_PROPERTIES)
_FLAT = ("lines", "moved", "both_new", "triangle")
_SPACE = ("convex", "tetrahedra")
_WITH_CONDITION = ("planes",)

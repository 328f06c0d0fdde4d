"""Checks of the stages H_1, H_2, ... through which the construction of a hull goes by adding points.

A property is a function that examines the stages of one set and yields True or False for each test. NV and NE are the
numbers of vertices and equations of a stage, and NETC is the number of the first equation that a point is outside of.
"""

from collections.abc import Iterator
from itertools import combinations, product

from modern.claims.evidence import Check, claim, searched, slip
from modern.claims.hulls import exact_hull
from modern.claims.sampled_sets import (
    BOTH,
    CASES,
    SETS,
    Approximation,
    Point,
    SampledSet,
    flat_and_spatial_sets,
    oriented,
    plane_through,
    plane_value,
    reduced_plane,
    sampled_sets,
)
from modern.geometry.hull import Stage


@claim("thesis.2", "thesis.29", kind="nested", full=300)
@claim("thesis.204", "thesis.69", "thesis.79", "thesis.101", "thesis.224", "thesis.265", kind="last_hull", full=300)
@claim("thesis.205", "thesis.224", kind="struck_inside", full=300)
@claim("thesis.30", "thesis.60", kind="contained_points", full=300)
@claim("thesis.204", "thesis.31", "thesis.78", "thesis.100", kind="finite", full=300)
@claim("thesis.216", "thesis.72", "thesis.220", kind="counts", full=300)
@claim("thesis.75", kind="decreasing", full=300)
@claim("thesis.68", kind="supporting", full=300)
@claim("thesis.76", "thesis.79", "thesis.101", "thesis.255", "thesis.265", kind="accepted", full=300)
@claim("thesis.70", kind="farthest_outside", full=300)
@claim("thesis.73", "thesis.220", kind="replaced_line", full=300)
@claim("thesis.224", "thesis.89", kind="replaced_plane", full=300)
@claim("thesis.218", kind="renumbering", full=300)
@claim("thesis.77", kind="largest_of_all", full=300)
@claim("thesis.206", "thesis.228", "thesis.99", "thesis.189", "thesis.225", kind="equations", full=300)
@claim("thesis.222", "thesis.232", kind="vertex_when_added", full=300)
@claim("thesis.92", "thesis.266", kind="convexity", full=300)
@claim("thesis.89", "thesis.266", kind="added_tetrahedra", full=300)
@claim("thesis.89", "thesis.241", "thesis.240", kind="added_triangle", full=300)
@claim("thesis.278", kind="two_new_lines", full=300)
def stage_property(kind: str, cases: int = CASES) -> Check:
    """Check one property, a key of ``_PROPERTIES``, of all stages H_1, H_2, ... in the construction of sampled sets."""
    dimension = 2 if kind in _FLAT else 3 if kind in _SPACE else 0
    sets = sampled_sets(dimension, cases) if dimension else flat_and_spatial_sets(cases)
    examine, says = _PROPERTIES[kind]
    checks = [right for sampled in sets for right in examine(sampled)]
    message = f"{sum(checks)} of {len(checks)} tests in the construction of {len(sets)} hulls show: {says}"
    return searched(SETS.get(dimension, BOTH), len(sets), checks, message)


@claim("thesis.264", kind="equations", reading="H_j in place of H_1")
@claim("thesis.239", kind="added_triangle", reading="j = k in place of j = 1")
def number_of_the_hull(kind: str, reading: str) -> Check:
    # With the number 1, both statements would be about H_1 and H_2 at most.
    is_later = any(len(sampled.stages()) > 2 for sampled in sampled_sets(2, CASES))
    return stage_property(kind).misprinted(is_later, reading)


@claim("thesis.227", full=300)
def one_of_several_planes(cases: int = CASES) -> Check:
    sets = sampled_sets(3, cases)
    several = sum(record.outside > 1 for sampled in sets for _, _, record, _ in _steps(sampled))
    outcomes = [several > 0, *(right for sampled in sets for right in _convexity(sampled))]
    message = f"in {several} steps with points outside several planes, replacing one plane gives no convex body"
    return searched(SETS[3], cases, outcomes, message)


@claim("thesis.226")
def third_new_plane() -> Check:
    outcomes = [ok for sampled in sampled_sets(3, CASES) for ok in _replaced_facet(sampled)]
    pairs = [*combinations(("MM", "NN", "KK"), 2)]
    printed = [("MM", "NN"), ("MM", "KK"), ("MM", "KK"), ("MM", "KK")]
    message = f"in {len(outcomes) // 2} steps, the new planes contain the points {', '.join(map(' and '.join, pairs))}"
    return slip({*printed} == {*pairs}, all(outcomes) and outcomes, "NN and KK for the third plane", message)


def _steps(sampled: SampledSet) -> Iterator[tuple[Approximation, Approximation, Stage, int]]:
    """Yield, for each hull H_j except H_1: the hull before it, H_j, its record in ``history``, and the added point."""
    stages = sampled.stages()
    for before, after, record in zip(stages, stages[1:], sampled.hull.history[1:], strict=False):
        yield before, after, record, record.added[0]


def _contains(stage: Approximation, point: Point) -> bool:
    return all(plane_value(plane, point) <= 0 for plane in stage.equations)


def _nested(sampled: SampledSet) -> Iterator[bool]:
    for before, after, _, added in _steps(sampled):
        yield all(_contains(after, sampled.points[k]) for k in before.vertices)
        yield not _contains(before, sampled.points[added])


def _equations(sampled: SampledSet) -> Iterator[bool]:
    for stage in sampled.stages():
        judge = exact_hull([sampled.points[k] for k in stage.vertices])
        yield {reduced_plane(plane) for plane in stage.equations} == {facet.plane for facet in judge.facets}


def _last_hull(sampled: SampledSet) -> Iterator[bool]:
    hull_planes = {facet.plane for facet in sampled.judge.facets}
    stages = sampled.stages()
    for stage in stages:
        support = all(_contains(stage, point) for point in sampled.points)
        yield support == ({reduced_plane(plane) for plane in stage.equations} == hull_planes) == (stage is stages[-1])


def _struck_inside(sampled: SampledSet) -> Iterator[bool]:
    eliminated_points: set[int] = set()
    for stage, record in zip(sampled.stages(), sampled.hull.history, strict=True):
        remaining = set(range(len(sampled.points))) - eliminated_points - {*stage.vertices}
        inside = {k for k in remaining if all(plane_value(plane, sampled.points[k]) < 0 for plane in stage.equations)}
        yield inside == set(record.struck)
        eliminated_points |= inside


def _contained_points(sampled: SampledSet) -> Iterator[bool]:
    for stage in sampled.stages():
        judge = exact_hull([sampled.points[k] for k in stage.vertices])
        corners = {stage.vertices[k] for k in judge.vertices}
        for k, point in enumerate(sampled.points):
            if k not in corners and _contains(stage, point):
                yield k not in sampled.judge.vertices


def _decreasing(sampled: SampledSet) -> Iterator[bool]:
    before, eliminated = len(sampled.points), 0
    for stage, record in zip(sampled.stages(), sampled.hull.history, strict=True):
        remaining = sum(max(plane_value(e, point) for e in stage.equations) >= 0 for point in sampled.points)
        eliminated += len(record.struck)
        yield remaining == len(sampled.points) - eliminated <= before
        before = remaining


def _finite(sampled: SampledSet) -> Iterator[bool]:
    yield len(sampled.hull.history) - 1 <= len(sampled.points) - sampled.judge.dimension - 1


def _accepted_planes(sampled: SampledSet) -> Iterator[bool]:
    for before, _, record, _ in _steps(sampled):
        for plane in before.equations[: record.checked - 1]:
            yield all(plane_value(plane, point) <= 0 for point in sampled.points)
        yield any(plane_value(before.equations[record.checked - 1], point) > 0 for point in sampled.points)


def _supporting(sampled: SampledSet) -> Iterator[bool]:
    remaining, planes = {*range(len(sampled.points))}, {facet.plane for facet in sampled.judge.facets}
    for stage, record in zip(sampled.stages(), sampled.hull.history, strict=True):
        remaining -= {*record.struck}
        for plane in stage.equations:
            is_positive = any(plane_value(plane, sampled.points[k]) > 0 for k in remaining)
            yield is_positive != (reduced_plane(plane) in planes)


def _farthest_outside(sampled: SampledSet) -> Iterator[bool]:
    eliminated_so_far: set[int] = set()
    for (before, _, record, added), elimination in zip(_steps(sampled), sampled.hull.history, strict=False):
        eliminated_so_far.update(elimination.struck)
        plane = before.equations[record.checked - 1]
        largest = max(plane_value(plane, point) for k, point in enumerate(sampled.points) if k not in eliminated_so_far)
        yield plane_value(plane, sampled.points[added]) == largest > 0


def _largest_of_all(sampled: SampledSet) -> Iterator[bool]:
    for before, _, record, added in _steps(sampled):
        plane = before.equations[record.checked - 1]
        yield plane_value(plane, sampled.points[added]) == max(plane_value(plane, point) for point in sampled.points)


def _replaced_facet(sampled: SampledSet) -> Iterator[bool]:
    """Yield, for each new point outside a single facet, True if a new facet on each edge of this facet replaces it."""
    # In a plane, every new point must be outside a single line.
    for before, after, record, added in _steps(sampled):
        if sampled.flat or record.outside == 1:
            replaced = {*before.defining[record.checked - 1]}
            kept_lines = [d for k, d in enumerate(before.defining) if k != record.checked - 1]
            new_facets = [{*d} for d in after.defining if {*d} not in [{*k} for k in kept_lines]]
            expected = len(before.defining) + sampled.judge.dimension - 1
            yield len(after.defining) == len(kept_lines) + len(new_facets) == expected
            yield sorted(map(sorted, new_facets)) == sorted(sorted({added} | (replaced - {k})) for k in replaced)


def _two_new_lines(sampled: SampledSet) -> Iterator[bool]:
    for _, after, _, added in _steps(sampled):
        lines = [plane for plane, ends in zip(after.equations, after.defining, strict=True) if added in ends]
        yield len(lines) == 2
        yield all(min(plane_value(plane, point) for plane in lines) <= 0 for point in sampled.points)


def _counts(sampled: SampledSet) -> Iterator[bool]:
    first = sampled.judge.dimension + 1
    for number, stage in enumerate(sampled.stages()):
        yield len(stage.vertices) == first + number
        if sampled.flat or not number:
            yield len(stage.equations) == first + number


def _renumbering(sampled: SampledSet) -> Iterator[bool]:
    for before, after, record, added in _steps(sampled):
        kept_lines = [d for k, d in enumerate(before.defining) if k != record.checked - 1]
        new_are_last = all(added in d for d in after.defining[-2:])
        yield new_are_last and [{*d} for d in after.defining[:-2]] == [{*d} for d in kept_lines]


def _vertex_when_added(sampled: SampledSet) -> Iterator[bool]:
    for stage, record in zip(sampled.stages(), sampled.hull.history, strict=True):
        judge = exact_hull([sampled.points[k] for k in stage.vertices])
        yield {stage.vertices.index(k) for k in record.added} <= {*judge.vertices}


def _added_bodies(sampled: SampledSet) -> Iterator[bool]:
    lattice: list[Point] = [(x, y, z) for x, y, z in product(range(-5, 6, 2), repeat=3)]
    tops: list[Point] = []
    if sampled.judge.plane:
        a, b, c, d = map(int, sampled.judge.plane)
        lattice = [(x, y, (-d - a * x - b * y) // c) for x, y in product(range(-5, 6, 2), repeat=2)]
        # A triangle is the part in this plane of a tetrahedron with another corner outside the plane.
        tops = [(0, 0, -d // c + 1)]
    for before, after, record, added in _steps(sampled):
        apex, visible = sampled.points[added], [record.checked - 1]
        if not sampled.flat:
            visible = [k for k, plane in enumerate(before.equations) if plane_value(plane, apex) > 0]
            yield record.checked - 1 in visible
        # One triangle or tetrahedron stands on each equation that is positive at the new point.
        corners = [[apex, *(sampled.points[k] for k in before.defining[at]), *tops] for at in visible]
        for point in lattice:
            is_in_either = _contains(before, point) or any(in_tetrahedron(point, four) for four in corners)
            yield _contains(after, point) == is_in_either


def in_tetrahedron(point: Point, corners: list[Point]) -> bool:
    """Return True if, for every face, the point is not on the opposite side from the remaining corner."""
    planes = [(plane_through(*corners[:k], *corners[k + 1 :]), corner) for k, corner in enumerate(corners)]
    return all(plane_value(plane, point) * plane_value(plane, corner) >= 0 for plane, corner in planes)


def _convexity(sampled: SampledSet) -> Iterator[bool]:
    inner = [sampled.points[k] for k in sampled.hull.history[0].added]
    for before, after, record, added in _steps(sampled):
        # Page 30: replace only equation NETC, by the planes through its sides and the new point.
        other_planes = [plane for k, plane in enumerate(before.equations) if k != record.checked - 1]
        ends = combinations([sampled.points[k] for k in before.defining[record.checked - 1]], 2)
        planes = [*other_planes, *(oriented(plane_through(p, q, sampled.points[added]), inner) for p, q in ends)]
        values = [plane_value(plane, sampled.points[k]) for plane in planes for k in after.vertices]
        yield (max(values) <= 0) == all(plane_value(plane, sampled.points[added]) <= 0 for plane in other_planes)


# The function that examines the stages of a set for each property, and the property as a sentence.
_PROPERTIES = {
    "nested": (_nested, "each hull contains the hull before it and a point outside that hull"),
    "equations": (_equations, "the equations of each H_j, negative at the inside point C, are those of the exact hull"),
    "last_hull": (_last_hull, "all equations of H_j support the set exactly if H_j is the last hull, that of the set"),
    "struck_inside": (_struck_inside, "each H_j eliminates exactly the remaining points that are inside it"),
    "contained_points": (_contained_points, "a point in H_j that is no vertex of H_j is no vertex of the last hull"),
    "decreasing": (_decreasing, "N_j is the number of points not inside H_j, and it never grows"),
    "finite": (_finite, "for N points, at most N - 3 hulls follow H_1 in a plane, and at most N - 4 in space"),
    "accepted": (_accepted_planes, "equation NETC is positive at some point, but no equation before it is"),
    "supporting": (_supporting, "an equation supports the last hull exactly if it is positive at no remaining point"),
    "farthest_outside": (_farthest_outside, "the new point has the largest value of equation NETC, which is positive"),
    "largest_of_all": (_largest_of_all, "equation NETC is largest at the new point, even among eliminated points"),
    "replaced_line": (_replaced_facet, "two lines from the new point to the ends of one line replace this line"),
    "replaced_plane": (_replaced_facet, "a facet is replaced by facets on its sides if the point is outside it alone"),
    "two_new_lines": (_two_new_lines, "each step adds two lines, and no point is outside both"),
    "counts": (_counts, "NV and NE of H_1 are 3, or 4 in space; each step adds 1 to NV, and in a plane also to NE"),
    "renumbering": (_renumbering, "later lines move up by one number, and the two new lines are last"),
    "vertex_when_added": (_vertex_when_added, "each added point is a vertex of the hull of the points added so far"),
    "added_triangle": (_added_bodies, "a lattice point is in H_k+1 exactly if it is in H_k or the added triangle"),
    "convexity": (_convexity, "replacing one plane gives a convex body exactly if the point is outside no other plane"),
    "added_tetrahedra": (_added_bodies, "a lattice point is in H_k+1 exactly if it is in H_k or an added tetrahedron"),
}
_FLAT = ("replaced_line", "renumbering", "two_new_lines", "added_triangle")
_SPACE = ("convexity", "added_tetrahedra")

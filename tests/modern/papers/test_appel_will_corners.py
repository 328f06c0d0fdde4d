"""Inside corners (Figs. 15, 16 and 18): the rules on suitable objects, and the rejection of invalid maps."""

import random
from collections.abc import Sequence

import pytest

from modern.claims.published import PAPERS, printed_lines
from modern.exact_hull import exact_hull
from modern.papers.appel_will import RULES, MapError, Method, appel_will
from modern.papers.appel_will.corners import corners, preprocess
from modern.papers.appel_will.results import found_solid, printed_solid
from modern.papers.appel_will.surfaces import Surface, oriented

Point = tuple[int, int, int]
Solid = tuple[list[Point], list[Surface]]


def crown(apex: int) -> Solid:
    """Return a pyramid over a four-pointed star. Four of the eight lines at its apex are inside corners."""
    base = [(3, 0, 0), (1, 1, 0), (0, 3, 0), (-1, 1, 0), (-3, 0, 0), (-1, -1, 0), (0, -3, 0), (1, -1, 0)]
    sides = [(k, (k + 1) % 8, 8) for k in range(8)]
    return [*base, (0, 0, apex)], [tuple(range(7, -1, -1)), *sides]


def dented(source: random.Random) -> Solid:
    """Return a star-shaped solid: a convex one around the origin with its vertices moved along their rays."""
    while True:
        ball = [tuple(source.randint(-9, 9) for _ in range(3)) for _ in range(12)]
        hull = exact_hull(ball)
        if hull.dimension == 3 and all(facet.plane[3] < 0 for facet in hull.facets):
            break
    places = {index: place for place, index in enumerate(hull.vertices)}
    points = []
    for index in hull.vertices:
        times = source.choice((1, 1, 2, 3, 5))
        x, y, z = (times * value for value in hull.scaled[index])
        points.append((x, y, z))
    polygons = [[places[index] for index in facet.polygon] for facet in hull.facets]
    return points, [(p[0], p[k], p[k + 1]) for p in polygons for k in range(1, len(p) - 1)]


def extruded(source: random.Random) -> Solid:
    """Return a prism over a star-shaped polygon. It has three planes at every point and two concave surfaces."""
    rays = [(3, 0), (2, 1), (1, 2), (0, 3), (-1, 2), (-2, 1), (-3, 0), (-2, -1), (-1, -2), (0, -3), (1, -2), (2, -1)]
    outline = []
    for x, y in rays:
        times = source.randint(1, 4)
        outline.append((times * x, times * y))
    n = len(outline)
    points = [(x, y, z) for z in (0, 5) for x, y in outline]
    sides = [(k, (k + 1) % n, n + (k + 1) % n, n + k) for k in range(n)]
    return points, [tuple(range(n - 1, -1, -1)), tuple(range(n, 2 * n)), *sides]


def test_the_step_of_fig_18_has_one_inside_corner() -> None:
    solid = found_solid("fig18")
    classified = corners(solid.points, oriented(solid.points, solid.surfaces))
    assert sorted(corner.product for corner in classified) == [-1] + [1] * 17
    (inside,) = [corner for corner in classified if corner.product < 0]
    assert {inside.line.on, inside.line.beyond} == {1, 2}


def test_the_one_inside_corner_of_fig_4_is_deleted() -> None:
    fig4 = printed_solid(printed_lines(PAPERS[0]))
    plain = appel_will(fig4.points, fig4.surfaces)
    for rule, deleted in (("any", (2, 3)), ("two", ()), ("concave", (2, 3))):
        hull = appel_will(fig4.points, fig4.surfaces, Method(inside_corners=rule))
        assert hull.preprocessing is not None
        assert [set(corner.line.ends) for corner in hull.preprocessing.inside] == [{2, 3}]
        assert hull.preprocessing.deleted == deleted
        assert hull.preprocessing.crowded == ()
        assert hull.edges == plain.edges
        assert (hull.projections < plain.projections) == bool(deleted)


def test_rule_any_is_wrong_if_more_than_three_planes_meet() -> None:
    """Fig. 15 warns of this case: the apex is on inside corners and still a vertex of the hull."""
    points, surfaces = crown(4)
    judge = exact_hull(points)
    wrong = appel_will(points, surfaces, Method(inside_corners="any"))
    assert wrong.preprocessing is not None
    assert 8 in wrong.preprocessing.deleted
    assert wrong.preprocessing.crowded == (8,)
    assert wrong.edges != judge.edges()
    for rule in ("two", "concave"):
        assert appel_will(points, surfaces, Method(inside_corners=rule)).edges == judge.edges()


def test_safe_rules_never_delete_a_vertex_of_the_hull() -> None:
    source = random.Random(16)
    wrong, deleted = 0, dict.fromkeys(RULES, 0)
    for _ in range(60):
        points, surfaces = dented(source)
        vertices = set(exact_hull(points).vertices)
        for rule in RULES:
            lost = preprocess(points, surfaces, rule).deleted
            deleted[rule] += len(lost)
            if rule == "any":
                wrong += not vertices.isdisjoint(lost)
            else:
                assert vertices.isdisjoint(lost)
    assert wrong > 20, "rule any must be wrong on many of the samples"
    assert deleted["two"] > 20
    assert deleted["concave"] == 0, "a triangle has no concave point"


def test_all_rules_are_right_if_three_planes_meet_at_every_point() -> None:
    source = random.Random(15)
    concave = 0
    for _ in range(30):
        points, surfaces = extruded(source)
        judge = exact_hull(points)
        lost: dict[str, set[int]] = {}
        for rule in RULES:
            hull = appel_will(points, surfaces, Method(inside_corners=rule))
            assert hull.preprocessing is not None
            assert hull.preprocessing.crowded == ()
            assert (hull.edges, hull.fault) == (judge.edges(), "")
            lost[rule] = set(hull.preprocessing.deleted)
            assert lost[rule].isdisjoint(judge.vertices)
        assert lost["any"] >= lost["concave"] >= lost["two"]
        assert lost["any"]
        concave += len(lost["concave"])
    assert concave > 20, "the samples must have points that are concave on a face"


def test_senses_and_duplicates_of_surfaces_do_not_matter() -> None:
    source = random.Random(18)
    points, surfaces = extruded(source)
    reversed_at_random = [s if source.random() < 0.5 else s[::-1] for s in surfaces]
    expected, actual = preprocess(points, surfaces, "any"), preprocess(points, reversed_at_random, "any")
    assert actual.deleted == expected.deleted
    assert {frozenset(c.line.ends) for c in actual.inside} == {frozenset(c.line.ends) for c in expected.inside}
    points, surfaces = crown(4)
    doubled = [*points, points[8]]
    renamed = [*surfaces[:5], *(tuple(9 if index == 8 else index for index in s) for s in surfaces[5:])]
    hull = appel_will(doubled, renamed, Method(inside_corners="two"))
    assert hull.duplicates == ((9, 8),)
    assert hull.edges == exact_hull(points).edges()


TETRAHEDRON: Solid = ([(0, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 4)], [(0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3)])


@pytest.mark.parametrize(
    ("points", "surfaces", "message"),
    [
        (TETRAHEDRON[0], [(0, 1)], "surface 1: expected at least 3 points, found 2"),
        (TETRAHEDRON[0], [(0, 1, 0)], "surface 1: it contains a point twice"),
        (TETRAHEDRON[0], [(0, 1, 4)], "surface 1: it names a point that does not exist"),
        (TETRAHEDRON[0], TETRAHEDRON[1][:3], "surface 1: line 2-3 lies on 1 surface, expected 2 surfaces"),
        ([(0, 0, 0), (1, 0, 0), (2, 0, 0), (0, 0, 4)], TETRAHEDRON[1], "surface 1: it has no area"),
        ([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 1)], [(0, 1, 2, 3)] * 2, "surface 1: its points do not lie"),
        ([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2), (0, 2, 1)], "the surfaces enclose no volume"),
        (TETRAHEDRON[0], [*TETRAHEDRON[1], (0, 1, 2)], "surface 1: line 1-2 lies on 3 surfaces, expected 2 surfaces"),
        (
            [p for at in (0, 9) for p in ((x + at, y, z) for x, y, z in TETRAHEDRON[0])],
            [tuple(k + at for k in s) for at in (0, 4) for s in TETRAHEDRON[1]],
            "surface 5: it is not connected with surface 1",
        ),
    ],
    ids=["two points", "twice", "unknown point", "open", "thrice", "no area", "not plane", "no volume", "two solids"],
)
def test_maps_of_no_polyhedron_are_rejected(points: Sequence[Point], surfaces: Sequence[Surface], message: str) -> None:
    with pytest.raises(MapError) as caught:
        appel_will(points, surfaces, Method(inside_corners="any"))
    assert message in str(caught.value)


def test_maps_without_outside_and_unknown_rules_are_rejected() -> None:
    # In this projective plane of six points every line is on two surfaces, but it has only one side.
    triangles = "012 023 034 045 051 124 235 341 452 513"
    surfaces = [tuple(int(digit) for digit in triangle) for triangle in triangles.split()]
    points = [(0, 0, 0), (5, 0, 1), (0, 7, 2), (3, 1, 9), (-4, 2, 6), (1, -8, 3)]
    with pytest.raises(MapError, match="have no outside"):
        oriented(points, surfaces)
    with pytest.raises(ValueError, match="'all' is not a rule"):
        preprocess(*TETRAHEDRON, "all")

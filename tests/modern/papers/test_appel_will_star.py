"""The star polygon test as printed, as corrected and in one pass without sorting (Appel & Will, Figs. 8 to 12)."""

from itertools import combinations, product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from modern.exact_hull import exact_hull
from modern.papers.appel_will import CORRECTED, Method, appel_will
from modern.papers.appel_will import star as stars

PRINTED = Method(star=stars.as_printed)
CUBE = list(product((0, 1), repeat=3))
FIG_4 = [(1, 0, 2), (0, 0, 2), (0, 1, 1), (1, 1, 1), (0, 2, 1), (1, 2, 1), (0, 0, 0), (1, 0, 0), (1, 2, 0), (0, 2, 0)]


def is_corner(images: list[stars.Image]) -> bool:
    """Return True if C is a corner of the hull of C and the images, according to the exact hull."""
    return 0 in exact_hull([(0, 0, 0), *((x, y, 0) for x, y in images)]).vertices


images_near = st.tuples(st.integers(-3, 3), st.integers(-3, 3)).filter(any)
images_far = st.tuples(st.integers(-(10**12), 10**12), st.integers(-(10**12), 10**12)).filter(any)


@given(st.lists(st.one_of(images_near, images_far), max_size=9))
def test_the_corrected_test_and_the_one_pass_test_agree_with_the_exact_hull(images: list[stars.Image]) -> None:
    assert stars.as_corrected(images) == stars.in_one_pass(images) == is_corner(images)


@given(st.lists(images_near, min_size=1, max_size=9))
def test_the_printed_test_differs_only_if_two_images_are_on_one_ray(images: list[stars.Image]) -> None:
    distinct = {*images}
    shared_ray = any(stars.on_one_ray(a, b) for a, b in combinations(distinct, 2))
    # Case III: two images are opposite, and all others are on one side of the line through them.
    between = any(
        stars.vorticity(a, b) == 0 and not stars.on_one_ray(a, b) and len({stars.vorticity(a, c) > 0 for c in off}) <= 1
        for a, b in combinations(distinct, 2)
        for off in [[c for c in distinct if stars.vorticity(a, c)]]
    )
    assert stars.as_printed(images) == (not between and (stars.as_corrected(images) or shared_ray))


@given(st.lists(images_near, min_size=1, max_size=9))
def test_the_star_polygon_goes_around_once(images: list[stars.Image]) -> None:
    """The angles increase: the upper half turn comes first, and within each half no rotation is clockwise."""
    star = stars.star_polygon(images)
    assert sorted(star) == sorted(images)
    upper = [y > 0 or (y == 0 and x > 0) for x, y in star]
    assert upper == sorted(upper, reverse=True)
    for a, b, a_upper, b_upper in zip(star, star[1:], upper, upper[1:], strict=False):
        assert a_upper != b_upper or stars.vorticity(a, b) >= 0


@pytest.mark.parametrize(
    ("images", "printed", "corrected"),
    [
        ([(1, 0), (2, 0), (-1, 2), (-1, -2)], True, False),
        ([(1, 0), (1, 0), (-1, 2), (-1, -2)], False, False),
        ([(1, 0), (2, 0), (0, 1)], True, True),
        ([(1, 0), (0, 1), (-1, 0)], False, False),
        ([(1, 1), (2, 2)], True, True),
        ([(1, 0), (-1, 0)], False, False),
        ([], True, True),
    ],
    ids=["on one ray", "equal", "on one ray, C outside", "III", "all on one ray", "III alone", "nothing else"],
)
def test_the_collinear_cases_of_fig_12(images: list[stars.Image], printed: bool, corrected: bool) -> None:
    assert stars.as_printed(images) == printed
    assert stars.as_corrected(images) == stars.in_one_pass(images) == corrected


def test_the_printed_test_accepts_a_pair_with_two_images_on_one_ray() -> None:
    points = [(2, 0, 2), (1, 1, 3), (4, 0, 1), (4, 3, 4), (2, 0, 3), (4, 1, 2)]
    printed, corrected = appel_will(points, method=PRINTED), appel_will(points, method=CORRECTED)
    assert {*printed.edges} - {*corrected.edges} == {(0, 3)}
    assert printed.fault
    assert not corrected.fault
    assert {*corrected.edges} == {*exact_hull(points).edges()}


def test_lines_are_sorted_and_edges_at_deleted_points_dropped() -> None:
    # In Fig. 4 the printed test accepts edges to points 3 and 4 before these points are deleted.
    hull = appel_will(FIG_4, method=PRINTED)
    assert set(appel_will(FIG_4).edges) < set(hull.edges)
    assert {deleted.point for deleted in hull.deleted} == {2, 3}
    assert not {2, 3} & set(hull.vertices)
    points = [(0, 0, 5), (0, 0, 9), (1, 0, 3), (0, 1, -4), (0, 0, 7), (0, 0, -1)]
    projection = stars.project(points, (0, 1), range(6))
    assert [points[index][2] for index in projection.line] == [-1, 5, 7, 9]
    assert len(projection.images) == 2
    assert stars.vorticity(*projection.images) > 0
    assert stars.vorticity(*stars.project(points, (1, 0), range(6)).images) > 0

"""The two other treatments of coplanar faces (Figs. 7 and 8) against the judge."""

from __future__ import annotations

import random
from itertools import product

import pytest

from modern.exact_hull import exact_hull
from modern.papers.kovalevsky_schulz.coplanar import EXTENDED, QUADRANGLES, Treatment, coplanar_hull

TREATMENTS: list[Treatment] = [QUADRANGLES, EXTENDED]
GRID = [*product(range(3), repeat=3)]


def judged(points: list[tuple[int, int, int]]) -> list[tuple[int, ...]]:
    return sorted(facet.polygon for facet in exact_hull(points).facets)


@pytest.mark.parametrize("treatment", TREATMENTS)
def test_sets_of_a_small_grid_have_the_faces_of_the_judge(treatment: Treatment) -> None:
    draw, solid = random.Random(8), 0
    for _ in range(300):
        points = draw.sample(GRID, draw.randint(4, 14))
        if exact_hull(points).dimension == 3:
            solid += 1
            assert list(coplanar_hull(points, treatment).faces) == judged(points), points
    assert solid > 200


@pytest.mark.parametrize("treatment", TREATMENTS)
def test_points_at_random_have_no_coplanar_face_and_triangles_only(treatment: Treatment) -> None:
    draw = random.Random(9)
    points = [(draw.randint(-99, 99), draw.randint(-99, 99), draw.randint(-99, 99)) for _ in range(20)]
    found = coplanar_hull(points, treatment)
    assert list(found.faces) == judged(points)
    assert (found.larger, found.extended, found.straightened) == (0, 0, 0)


def test_fig_8_a_face_is_extended_and_no_new_face_made_of_it() -> None:
    """A pyramid over the square 0, 1; the point (2, 0, 0) lies in the square's plane and sees one side."""
    pyramid = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 2)]
    before, after = (coplanar_hull(points, EXTENDED) for points in (pyramid, [*pyramid, (3, 2, 0)]))
    assert after.extended > before.extended
    assert list(after.faces) == judged([*pyramid, (3, 2, 0)])


def test_fig_7_a_quadrangle_has_two_edges_in_common_with_the_face_it_is_merged_with() -> None:
    pyramid = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 2)]
    found = coplanar_hull([*pyramid, (3, 3, 0)], QUADRANGLES)
    assert found.larger == 1
    assert found.merged >= 1
    assert list(found.faces) == judged([*pyramid, (3, 3, 0)])


def test_a_point_on_the_crossing_line_of_two_faces_extends_both() -> None:
    """The line of an edge of a tetrahedron: two faces hold the point, two edges of each come to lie in one line."""
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (2, 0, 0)]
    found = coplanar_hull(points, EXTENDED)
    assert found.extended == 2
    assert found.straightened >= 2
    assert list(found.faces) == judged(points)


def test_flat_points_and_other_treatments_are_refused() -> None:
    with pytest.raises(ValueError, match="in one plane"):
        coplanar_hull([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)], EXTENDED)
    with pytest.raises(ValueError, match="not 'visible'"):
        coplanar_hull(GRID, "visible")  # type: ignore[arg-type]

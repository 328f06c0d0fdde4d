"""The two alternative treatments of coplanar faces (Figs. 7 and 8) compared with the exact hull."""

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
def test_subsets_of_a_small_grid_have_the_faces_of_the_exact_hull(treatment: Treatment) -> None:
    source, solid = random.Random(8), 0
    for _ in range(300):
        points = source.sample(GRID, source.randint(4, 14))
        if exact_hull(points).dimension == 3:
            solid += 1
            assert list(coplanar_hull(points, treatment).faces) == judged(points), points
    assert solid > 200


@pytest.mark.parametrize("treatment", TREATMENTS)
def test_points_in_general_position_give_triangles_only(treatment: Treatment) -> None:
    source = random.Random(9)
    points = [(source.randint(-99, 99), source.randint(-99, 99), source.randint(-99, 99)) for _ in range(20)]
    hull = coplanar_hull(points, treatment)
    assert list(hull.faces) == judged(points)
    assert (hull.larger, hull.extended, hull.straightened) == (0, 0, 0)


def test_figures_7_and_8_faces_are_merged_and_extended() -> None:
    # The point (3, 2, 0) lies in the plane of the pyramid's square.
    pyramid = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 2)]
    before, after = (coplanar_hull(points, EXTENDED) for points in (pyramid, [*pyramid, (3, 2, 0)]))
    assert after.extended > before.extended
    assert list(after.faces) == judged([*pyramid, (3, 2, 0)])
    # The new face has two edges in common with the face it is merged with.
    pyramid = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 2)]
    hull = coplanar_hull([*pyramid, (3, 3, 0)], QUADRANGLES)
    assert hull.larger == 1
    assert hull.merged >= 1
    assert list(hull.faces) == judged([*pyramid, (3, 3, 0)])


def test_points_on_an_edge_extend_both_faces_and_flat_points_are_rejected() -> None:
    # Two faces of a tetrahedron contain the point, and two edges of each then lie in one line.
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (2, 0, 0)]
    hull = coplanar_hull(points, EXTENDED)
    assert hull.extended == 2
    assert hull.straightened >= 2
    assert list(hull.faces) == judged(points)
    with pytest.raises(ValueError, match="in one plane"):
        coplanar_hull([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)], EXTENDED)
    with pytest.raises(ValueError, match="found 'visible'"):
        coplanar_hull(GRID, "visible")

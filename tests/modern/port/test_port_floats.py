"""The port in binary: floats in vectors, multiprecision; beside scipy."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from numpy.typing import NDArray

from modern.exact_hull import exact_hull
from modern.geometry.hull import DETERMINED, NOT_ACCEPTABLE
from modern.port import RangeError
from tests.support.ported import convex_hull


def ball(count: int, bits: int | None = None, seed: int = 1963) -> NDArray[np.float64]:
    """Points uniform in the unit ball, rounded to so many binary places."""
    r = np.random.default_rng(seed)
    points = r.normal(size=(count, 3))
    points *= (r.random(count) ** (1 / 3) / np.linalg.norm(points, axis=1))[:, None]
    return points if bits is None else np.round(points * 2.0**bits) / 2.0**bits


def test_products_that_fit_a_double_are_exact() -> None:
    """17 bits a coordinate: every number of the procedure is exact, and so is the hull."""
    points = ball(3000, 16)
    hull = convex_hull(points, "float64")
    judge = exact_hull(points.tolist())
    assert hull.status == DETERMINED
    assert sorted(hull.vertices) == list(judge.vertices)
    assert {face.lowest for face in hull.faces} == {judge.plane_of(facet) for facet in judge.facets}


def test_one_text_of_the_procedure() -> None:
    """Where nothing is rounded every arithmetic decides alike, in the same order."""
    points = (ball(60, 6) * 64).astype(int)
    first = convex_hull(points, "exact", history=True)
    for arithmetic in ("float64", "float32", "mp:80", "truncating", "truncating:20", "rounding:12", "ibm1962"):
        other = convex_hull(points, arithmetic, history=True)
        assert other.history == first.history
        assert (other.vertices, other.boundary, other.inside) == (first.vertices, first.boundary, first.inside)
        assert [face.lowest for face in other.faces] == [face.lowest for face in first.faces]
        assert [face.polygon for face in other.faces] == [face.polygon for face in first.faces]


def test_vectors_decide_as_single_numbers() -> None:
    """float64 is 53 bits: the vectors of numpy and mpmath's numbers one by one agree, rounding included."""
    for seed in range(6):
        points = ball(40, None, seed).tolist()
        one = convex_hull(points, "float64", epsilon="rel:1e-13", history=True)
        other = convex_hull(points, "mp:53", epsilon="rel:1e-13", history=True)
        assert one.history == other.history
        assert one.status == other.status
        assert [face.coefficients for face in one.faces] == [face.coefficients for face in other.faces]


def test_rounded_products_end_as_chapter_7_says() -> None:
    """Thesis p. 117: the three points of a plane do not satisfy it."""
    assert convex_hull(ball(50), "float64").status == NOT_ACCEPTABLE
    assert convex_hull(ball(50), "float32").status == NOT_ACCEPTABLE
    assert convex_hull(ball(50), "mp:200").status == DETERMINED


def test_scipy_finds_the_same_vertices() -> None:
    spatial = pytest.importorskip("scipy.spatial")
    points = ball(10_000)
    hull = convex_hull(points, "float64", epsilon="rel:1e-9")
    assert sorted(hull.vertices) == sorted(spatial.ConvexHull(points).vertices.tolist())


def test_floats_are_told_exactly() -> None:
    hull = convex_hull([(0.1, -0.0, 2.0**-60), (1.0, 0.0, 0.0)], "float64")
    assert hull.points[0][:2] == ("0.1000000000000000055511151231257827021181583404541015625", "-0")
    assert Fraction(hull.points[0][2]) == Fraction(1, 2**60)
    assert convex_hull([("0.1", 0, 0)], "float32").points[0][0] == "0.100000001490116119384765625"


def test_a_product_beyond_the_largest_number_is_one_clear_line() -> None:
    points = [(0, 0, 0), ("1e110", 0, 0), (0, "1e110", 0), (0, 0, "1e110")]
    with pytest.raises(RangeError, match=r"^float64: a product of coordinates exceeds the largest number$"):
        convex_hull(points, "float64")
    assert convex_hull(points, "mp:53").status == DETERMINED


def test_equal_floats_are_duplicates_whatever_their_zeros() -> None:
    points = np.array([(0.0, 1.0, 2.0), (1.0, 0.0, 0.5), (-0.0, 1.0, 2.0), (1.0, -0.0, 0.5)])
    assert convex_hull(points, "float64").duplicates == ((2, 0), (3, 1))

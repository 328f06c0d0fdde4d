"""The port in binary arithmetics: floats in vectors, and multiprecision."""

from fractions import Fraction

import numpy as np
import pytest
from numpy.typing import NDArray

from modern.exact_hull import exact_hull
from modern.geometry.hull import DETERMINED, NOT_ACCEPTABLE
from modern.port import RangeError
from tests.support.ported import convex_hull


def ball(count: int, bits: int | None = None, seed: int = 1963) -> NDArray[np.float64]:
    """Draw points uniform in the unit ball, rounded to the given number of binary places."""
    r = np.random.default_rng(seed)
    points = r.normal(size=(count, 3))
    points *= (r.random(count) ** (1 / 3) / np.linalg.norm(points, axis=1))[:, None]
    return points if bits is None else np.round(points * 2.0**bits) / 2.0**bits


def test_hull_is_exact_if_all_products_fit_in_a_double() -> None:
    """With 17 bits in each coordinate every number of the procedure is exact, and so is the hull."""
    points = ball(3000, 16)
    hull = convex_hull(points, "float64")
    judge = exact_hull(points.tolist())
    assert hull.status == DETERMINED
    assert sorted(hull.vertices) == list(judge.vertices)
    assert {face.lowest for face in hull.faces} == {judge.plane_of(facet) for facet in judge.facets}


def test_all_arithmetics_decide_alike_if_nothing_is_rounded() -> None:
    points = (ball(60, 6) * 64).astype(int)
    exact = convex_hull(points, "exact", history=True)
    for arithmetic in ("float64", "float32", "mp:80", "truncating", "truncating:20", "rounding:12", "ibm1962"):
        hull = convex_hull(points, arithmetic, history=True)
        assert hull.history == exact.history
        assert (hull.vertices, hull.boundary, hull.inside) == (exact.vertices, exact.boundary, exact.inside)
        assert [face.lowest for face in hull.faces] == [face.lowest for face in exact.faces]
        assert [face.polygon for face in hull.faces] == [face.polygon for face in exact.faces]


def test_numpy_doubles_and_53_bit_multiprecision_numbers_decide_alike() -> None:
    for seed in range(4):
        points = ball(40, None, seed).tolist()
        doubles = convex_hull(points, "float64", epsilon="rel:1e-13", history=True)
        multiprecision = convex_hull(points, "mp:53", epsilon="rel:1e-13", history=True)
        assert doubles.history == multiprecision.history
        assert doubles.status == multiprecision.status
        assert [face.coefficients for face in doubles.faces] == [face.coefficients for face in multiprecision.faces]


def test_rounding_and_overflow_are_reported() -> None:
    # Thesis p. 117: the three points of a plane do not satisfy its equation.
    assert convex_hull(ball(50), "float64").status == NOT_ACCEPTABLE
    assert convex_hull(ball(50), "float32").status == NOT_ACCEPTABLE
    assert convex_hull(ball(50), "mp:200").status == DETERMINED
    points = [(0, 0, 0), ("1e110", 0, 0), (0, "1e110", 0), (0, 0, "1e110")]
    with pytest.raises(RangeError, match=r"^float64: a product of coordinates exceeds the largest number$"):
        convex_hull(points, "float64")
    assert convex_hull(points, "mp:53").status == DETERMINED


def test_floats_have_their_exact_values_and_signed_zeros_are_duplicates() -> None:
    hull = convex_hull([(0.1, -0.0, 2.0**-60), (1.0, 0.0, 0.0)], "float64")
    assert hull.points[0][:2] == ("0.1000000000000000055511151231257827021181583404541015625", "-0")
    assert Fraction(hull.points[0][2]) == Fraction(1, 2**60)
    assert convex_hull([("0.1", 0, 0)], "float32").points[0][0] == "0.100000001490116119384765625"
    points = np.array([(0.0, 1.0, 2.0), (1.0, 0.0, 0.5), (-0.0, 1.0, 2.0), (1.0, -0.0, 0.5)])
    assert convex_hull(points, "float64").duplicates == ((2, 0), (3, 1))

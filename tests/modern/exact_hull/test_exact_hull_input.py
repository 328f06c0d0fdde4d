"""Valid and invalid points, small hulls, and the error bounds of the floating-point filters."""

import re
from decimal import Decimal
from fractions import Fraction
from math import lcm

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from modern.exact_hull import PointsError, certify, exact_hull
from modern.exact_hull.coordinates import read_exact, read_points
from modern.exact_hull.facets import lowest_terms, plane_at, plane_through, value
from modern.exact_hull.planes import BOUND, Planes, normal_image
from modern.geometry.numbers import decimal

LAW = settings(deadline=None, max_examples=150)


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("12", 12),
        ("-1.5", Fraction(-3, 2)),
        ("-.25E-3", Fraction(-1, 4000)),
        ("+.20000000E+01", 2),
        ("  7. ", 7),
        ("1.50", Fraction(3, 2)),
        ("-0", 0),
        ("1e30", 10**30),
        ("0.1", Fraction(1, 10)),
        ("1E-9999", Fraction(1, 10**9999)),
    ],
)
def test_decimal_strings_have_their_exact_values(text: str, number: Fraction) -> None:
    assert decimal(text) == number


@pytest.mark.parametrize(
    "text", ["", " ", ".", "-", "1,5", "1/0", "1/x", "0x10", "nan", "inf", "1e", "1 2", "١", "1e10000"]
)
def test_texts_that_are_not_decimal_numbers_are_rejected(text: str) -> None:
    with pytest.raises(PointsError, match="point 1, coordinate z: "):
        exact_hull([(0, 0, 0), (0, 0, text)])


def test_floats_and_integers_have_their_binary_values() -> None:
    with pytest.raises(PointsError, match="point 0, coordinate x: 4001 digits; at most 4000 are read"):
        exact_hull([("1" * 4001, 0, 0)])
    assert exact_hull([(0.1, 0, 0)]).scale == 2**55
    assert exact_hull([("0.1", 0, 0)]).scale == 10
    line = [(0.1, 0, 0), (0.2, 0, 0), (0.3, 0, 0), (0, "0.1", 0)]
    assert exact_hull(line).dimension == 2
    edge = 2**63 - 1
    points = np.array([(-edge, 0, 0), (edge, 0, 0), (0, edge, 0), (0, -edge, 1), (0, 0, edge)], dtype=np.int64)
    assert exact_hull(points).vertices == (0, 1, 2, 3, 4)
    assert exact_hull(np.array([(2**64 - 1, 0, 0), (0, 0, 0)], dtype=np.uint64)).scaled[0][0] == 2**64 - 1


def test_all_types_of_coordinates_give_the_same_hull() -> None:
    numbers = [(0, 0, 0), (3, 0, 0), (0, 5, 0), (0, 0, 7), (1, 1, 1), (3, 0, 0)]
    expected = exact_hull(numbers)
    assert expected.scale == 1
    as_halves = exact_hull([tuple(Fraction(n, 2) for n in p) for p in numbers])
    assert as_halves == exact_hull([tuple(n / 2 for n in p) for p in numbers])
    assert as_halves == exact_hull([tuple(str(n / 2) for n in p) for p in numbers])
    assert (as_halves.scale, as_halves.scaled, as_halves.facets) == (2, expected.scaled, expected.facets)
    assert as_halves == exact_hull([tuple(f"{n}/2" for n in p) for p in numbers])
    assert as_halves == exact_hull([tuple(Decimal(n) / 2 for n in p) for p in numbers])
    for kind in (np.float16, np.float32, np.float64, np.longdouble):
        assert as_halves == exact_hull(np.array(numbers, dtype=kind) / kind(2))
        assert as_halves == exact_hull([tuple(kind(n) / kind(2) for n in p) for p in numbers])
    for kind in (np.int8, np.uint16, np.int64, np.uint64, object, str):
        assert exact_hull(np.array(numbers, dtype=kind)) == expected
    assert exact_hull([np.array(p) for p in numbers]) == expected
    assert exact_hull(iter(numbers)) == exact_hull(map(iter, numbers)) == expected
    assert exact_hull([[f"{n}.0" for n in p] for p in numbers]) == expected


@pytest.mark.parametrize(
    ("points", "message"),
    [
        ([], "there are no points"),
        ([(1, 2)], "point 0: expected 3 coordinates, found 2"),
        ([(1, 2, 3), (1, 2, 3, 4)], "point 1: expected 3 coordinates, found 4"),
        ([(1, 2, 3), 5], "point 1: expected 3 coordinates, found int"),
        (["123"], "point 0: expected 3 coordinates, found str"),
        ([(1, 2, float("nan"))], "point 0, coordinate z: nan is not finite"),
        ([(1, float("-inf"), 0)], "point 0, coordinate y: -inf is not finite"),
        ([(1, True, 0)], "point 0, coordinate y: expected an int, .*; found bool"),
        ([(None, 0, 0)], "point 0, coordinate x: expected an int, .*; found NoneType"),
        ([(1, 2, np.bool_(1))], "point 0, coordinate z: expected an int, .*; found bool"),
        ([(1, 2, 1j)], "point 0, coordinate z: expected an int, .*; found complex"),
        ([(1, 2, Decimal("inf"))], "point 0, coordinate z: Infinity is not finite"),
        (np.array([(0.0, 0, float("nan"))]), "point 0, coordinate z: nan is not finite"),
        (np.zeros((4, 3), dtype=bool), "expected an array of real numbers, found bool"),
        (np.zeros((4, 3), dtype=complex), "expected an array of real numbers, found complex128"),
        (np.zeros((0, 3)), "^there are no points$"),
        (np.zeros(0), "^there are no points$"),
        (np.zeros(3, dtype=int), r"expected an array of shape \(n, 3\), found \(3,\)"),
        (np.zeros((4, 2), dtype=int), r"expected an array of shape \(n, 3\), found \(4, 2\)"),
    ],
)
def test_invalid_points_are_rejected_with_their_index(points, message: str) -> None:
    with pytest.raises(PointsError, match=message):
        exact_hull(points)


def test_equal_and_collinear_points_form_hulls_of_dimensions_0_and_1() -> None:
    hull = exact_hull([("1.5", 2, 3)] * 3)
    assert (hull.dimension, hull.scale, hull.scaled[0]) == (0, 2, (3, 4, 6))
    assert (hull.vertices, hull.facets, hull.duplicates, hull.edges()) == ((0,), (), ((1, 0), (2, 0)), ())
    hull = exact_hull([(1, 1, 1), ("0.5", "0.5", "0.5"), (3, 3, 3), (1, 1, 1)])
    assert (hull.dimension, hull.vertices, hull.inside, hull.boundary) == (1, (1, 2), (0,), ())
    assert [(facet.plane, facet.polygon) for facet in hull.facets] == [((-1, -1, -1, 3), (1,)), ((1, 1, 1, -18), (2,))]
    assert [hull.plane_of(facet) for facet in hull.facets] == [(-2, -2, -2, 3), (1, 1, 1, -9)]
    assert hull.edges() == ((1, 2),)


def test_coplanar_points_form_a_hull_of_dimension_2() -> None:
    points = [(0, 0, "0.5"), (2, 0, "0.5"), (2, 2, "0.5"), (0, 2, "0.5"), (1, 0, "0.5"), (1, 1, "0.5")]
    hull = exact_hull(points)
    assert (hull.dimension, hull.plane, hull.polygon) == (2, (0, 0, 1, -1), (0, 1, 2, 3))
    assert hull.plane_of(hull.plane) == (0, 0, 2, -1)
    assert (hull.boundary, hull.inside) == ((4,), (5,))
    assert {facet.polygon: facet.plane for facet in hull.facets} == {
        (0, 1): (0, -1, 0, 0),
        (1, 2): (1, 0, 0, -4),
        (2, 3): (0, 1, 0, -4),
        (0, 3): (-1, 0, 0, 0),
    }
    assert hull.edges() == ((0, 1), (0, 3), (1, 2), (2, 3))


def test_points_in_space_form_a_hull_of_dimension_3() -> None:
    hull = exact_hull([(0, 0, 0), (3, 0, 0), (0, 3, 0), (0, 0, 3), (1, 1, 1), (1, 1, "0.5")])
    assert [(facet.plane, facet.polygon) for facet in hull.facets] == [
        ((-1, 0, 0, 0), (0, 3, 2)),
        ((0, -1, 0, 0), (0, 1, 3)),
        ((0, 0, -1, 0), (0, 2, 1)),
        ((1, 1, 1, -6), (1, 2, 3)),
    ]
    assert (hull.scale, hull.plane_of(hull.facets[3])) == (2, (1, 1, 1, -3))
    assert (hull.boundary, hull.inside) == ((4,), (5,))
    assert hull.polygon == ()
    assert hull.plane is None


@pytest.mark.parametrize("exponent", [308, 400, 9999])
def test_coordinates_beyond_the_range_of_floats_are_exact(exponent: int) -> None:
    """With a large and a tiny unit together, no image overflows and no message prints the numbers."""
    big, tiny = f"1E{exponent}", f"1E-{exponent}"
    points = [(0, 0, 0), (big, 0, 0), (0, big, 0), (0, 0, tiny), (tiny, tiny, 0), (tiny, tiny, tiny), (tiny, 0, tiny)]
    hull = exact_hull(points)
    assert certify(points, hull).arithmetic == "float64 and integers"
    assert (hull.dimension, hull.boundary, hull.inside) == (3, (4,), ())
    assert hull.vertices == (0, 1, 2, 3, 5, 6)


short = st.from_regex(r"[+-]?([0-9]{1,9}\.?[0-9]{0,7}|\.[0-9]{1,16})", fullmatch=True)
long = st.sampled_from(["1e3", "123456789012345.5", "0." + "0" * 22 + "1", "-999999999999999", " 1", "1\n2", "1/3"])


@given(st.lists(st.tuples(short, short, short | long), min_size=1, max_size=6))
@example([("0", "-0", "0." + "0" * 18)])
def test_strings_have_the_same_coordinates_as_their_fractions(points) -> None:
    try:
        exact = read_exact(points)
    except PointsError as error:
        with pytest.raises(PointsError, match=re.escape(str(error))):
            read_points(points)
        return
    coordinates = read_points(points)
    assert coordinates.scale == lcm(*(number.denominator for point in exact for number in point))
    assert list(coordinates) == [tuple(number * coordinates.scale for number in point) for point in exact]


def test_tiny_and_huge_floats_have_the_hull_of_fractions() -> None:
    most = 1.7976931348623157e308
    floats = [(5e-324, 1e-300, 1e-300), (0.0, most, 1e300), (0.0, 0.0, 1e300), (1e-300, -most, 5e-324)]
    floats += [(0.0, -most, -most), (0.0, 1.0, 0.0), (5e-324, 0.0, 0.0)]
    assert exact_hull(floats) == exact_hull([tuple(map(Fraction, point)) for point in floats])
    for side, are_small in ((2**16 - 1, True), (2**16, False)):
        corners = [(0, 0, 0), (side, 0, 0), (0, side, 0), (0, 0, side)]
        assert read_points(corners).images.are_small == are_small


coordinate = st.one_of(
    st.integers(-5, 5), st.integers(-57250, 57250), st.integers(-(10**8), 10**8), st.integers(-(10**40), 10**40)
)
triples = st.tuples(coordinate, coordinate, coordinate)


@LAW
@given(st.lists(triples, min_size=4, max_size=8))
def test_errors_in_the_construction_are_within_the_bound(points) -> None:
    """The image of every value is within the bound of the exact quotient, or equal to it if the points are small."""
    coordinates = read_points(points)
    images, places = coordinates.images, coordinates.images.places.tolist()
    for k in range(len(points) - 2):
        plane = plane_through(*points[k : k + 3])
        if not any(plane[:3]):
            continue
        a, b, c = normal_image(plane, images.shifts)
        x, y, z = places[k]
        d = -(a * x + b * y + c * z)
        power = max(abs(n).bit_length() + s if n else 0 for n, s in zip(plane[:3], images.shifts, strict=True))
        for (x, y, z), integers in zip(places, points, strict=True):
            computed = Fraction(a * x + b * y + c * z + d)
            true = Fraction(value(plane, integers), 1 << power)
            assert abs(computed - true) < BOUND
            if images.are_small:
                assert computed == true


def signs(planes, points, filtered: bool = False) -> dict[tuple[int, int], int]:
    """Return the signs, 0 or 1, by plane and point.  The first point is in every plane."""
    table = np.array(planes, object)
    evaluated = Planes(read_points(points), table, np.zeros(len(planes), int))
    if filtered:
        evaluated.whole = evaluated._small = None
    blocks = [zip(*block, strict=True) for block in evaluated.near(np.arange(len(points)))]
    return {(int(plane), int(row)): int(sign) for block in blocks for row, plane, sign in block if sign >= 0}


@pytest.mark.parametrize("size", [1, 10**5, 10**12, 10**40])
def test_a_point_one_unit_outside_is_detected(size: int) -> None:
    """The value is 1, the smallest positive integer, for coefficients of any size."""
    plane = (size, size + 1, 1, 0)
    on, above, below = (size + 1, -size, 0), (size + 1, -size, 1), (size + 1, -size, -1)
    assert signs([plane], [on, below]) == {(0, 0): 0}
    assert signs([plane], [on, below, above]) == {(0, 0): 0, (0, 2): 1}


@LAW
@given(st.lists(triples, min_size=4, max_size=8, unique=True), st.lists(triples, min_size=1, max_size=3))
def test_signs_of_planes_at_points_are_exact(points, normals) -> None:
    """All signs are computed from floats, and if possible in int64."""
    planes = [lowest_terms(plane_at(normal, points[0])) for normal in normals if any(normal)]
    values = {(k, n): value(plane, point) for k, plane in enumerate(planes) for n, point in enumerate(points)}
    expected = {pair: int(number > 0) for pair, number in values.items() if number >= 0}
    if planes:
        assert signs(planes, points) == signs(planes, points, filtered=True) == expected

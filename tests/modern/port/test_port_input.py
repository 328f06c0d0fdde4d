"""Input and output of the port: points, names of arithmetics, exact text."""

import pickle
from collections.abc import Iterator
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from emulator.numbers.arithmetic import TRUNCATING
from emulator.numbers.fields import FALLBACK, read_floating, write_floating
from modern.geometry.hull import LazyTuple, as_tuple
from modern.geometry.numbers import exact_text
from modern.port import PointsError, convex_hull
from modern.port.points import NAMES, fixed_arithmetic
from tests.support.punched import e_field

ORIGIN = (0, 0, 0)
INVALID_POINTS = (
    ((1, 2), "point 1: expected 3 coordinates, found 2"),
    ((1, 2, "three"), "point 1, coordinate z: 'three' is not a decimal number"),
    ((1, "", 3), "point 1, coordinate y: '' is not a decimal number"),
    ((float("nan"), 2, 3), "point 1, coordinate x: nan is not finite"),
    (
        (1, 2, None),
        "point 1, coordinate z: expected an int, a float, a Fraction, a Decimal or a decimal string; found NoneType",
    ),
    (
        (True, 2, 3),
        "point 1, coordinate x: expected an int, a float, a Fraction, a Decimal or a decimal string; found bool",
    ),
    ("123", "point 1: expected 3 coordinates, found str"),
    (7, "point 1: expected 3 coordinates, found int"),
    ((1, 2, "1e99999"), "point 1, coordinate z: the exponent of '1e99999' is not within -9999 to 9999"),
)


@pytest.mark.parametrize(("invalid", "message"), INVALID_POINTS)
def test_error_names_an_invalid_point(invalid: object, message: str) -> None:
    with pytest.raises(PointsError) as caught:
        convex_hull([ORIGIN, invalid])
    assert str(caught.value) == message


@pytest.mark.parametrize(
    ("arithmetic", "number", "message"),
    [
        ("truncating", "1e99", "point 1, coordinate y: expected a number with an exponent from -99 to 99"),
        ("truncating", "1e-101", "point 1, coordinate y: expected a number with an exponent from -99 to 99"),
        ("float64", "1e400", "point 1, coordinate y: the number is too large for float64"),
        ("float32", "1e39", "point 1, coordinate y: the number is too large for float32"),
    ],
)
def test_error_names_a_point_out_of_range(arithmetic: str, number: str, message: str) -> None:
    with pytest.raises(PointsError) as caught:
        convex_hull([ORIGIN, (0, number, 0)], arithmetic)
    assert str(caught.value) == message


@pytest.mark.parametrize("huge", ["1e5000", "-1e5000", "1e-5000", "9e9999"])
@pytest.mark.parametrize("name", [n.replace("BITS", "60").replace(":P", ":12").replace("SEED", "1") for n in NAMES])
def test_numbers_of_thousands_of_digits_are_kept_or_refused(name: str, huge: str) -> None:
    """``str`` refuses such integers. A number is stored, vanishes in doubles, or is refused in one line."""
    points = [(huge, "0", "0"), ("0", "1", "0")]
    vanishes = name.startswith("float") and huge == "1e-5000"
    if name != "exact" and ":60" not in name and not vanishes:
        with pytest.raises(PointsError, match=r"^point 0, coordinate x: [^\n]+$"):
            convex_hull(points, name)
        return
    stored, exact = Fraction(Decimal(convex_hull(points, name).points[0][0])), Fraction(Decimal(huge))
    if name == "exact":
        assert stored == exact
    elif vanishes:
        assert stored == 0
    else:
        assert abs(stored - exact) <= abs(exact) / 2**59


def test_arrays_are_read_and_their_shape_checked() -> None:
    integers = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)])
    assert convex_hull(integers).vertices == convex_hull(integers.tolist()).vertices
    assert convex_hull(integers.astype(float), "float64").dimension == 3
    with pytest.raises(PointsError, match=r"shape \(n, 3\), found \(4, 2\)"):
        convex_hull(integers[:, :2].astype(float), "float64")
    with pytest.raises(PointsError, match="point 2: a coordinate is not finite"):
        convex_hull(np.array([(0.0, 0, 0), (1, 0, 0), (0, float("inf"), 0)]), "float64")


@pytest.mark.parametrize("points", [[], np.empty((0, 3))])
@pytest.mark.parametrize("arithmetic", ["exact", "float64"])
def test_empty_input_is_a_points_error(points: object, arithmetic: str) -> None:
    with pytest.raises(PointsError, match=r"^there are no points$"):
        convex_hull(points, arithmetic)


@pytest.mark.parametrize(
    "name", ["", "float", "mp", "mp:1", "mp:x", "truncating:1", "truncating:x", "rounding", "exact:3"]
)
def test_unknown_arithmetic_is_a_value_error(name: str) -> None:
    with pytest.raises(ValueError, match=r"."):
        convex_hull([ORIGIN], name)


numbers = st.one_of(st.integers(), st.fractions(), st.decimals(allow_nan=False, allow_infinity=False).map(Fraction))


@given(numbers)
def test_text_is_exact(number: int | Fraction) -> None:
    text = exact_text(number)
    assert Fraction(text) == number
    if "/" in text:
        denominator = Fraction(number).denominator
        assert any(denominator % p == 0 for p in range(3, 2000, 2) if p % 5) or denominator > 2000


@pytest.mark.parametrize(
    ("number", "text"),
    [(0, "0"), (-12, "-12"), (Fraction(1, 8), "0.125"), (Fraction(-1, 3), "-1/3"), (Fraction(7, 20), "0.35")],
)
def test_text_is_decimal_if_a_finite_decimal_exists(number: int | Fraction, text: str) -> None:
    assert exact_text(number) == text


def test_text_of_many_digits_is_exact() -> None:
    assert Decimal(exact_text(10**9000 + 1)) == Decimal(10**9000 + 1)
    assert exact_text(10**5000) == "1E+5000"


@given(st.integers(-(10**12), 10**12), st.integers(-90, 80))
def test_number_is_truncated_as_read_truncates_it(digits: int, exponent: int) -> None:
    """Compare with the emulator's READ of the same decimal (C26-5619 p. 35-38)."""
    value = Fraction(digits) * Fraction(10) ** exponent
    arithmetic = fixed_arithmetic("truncating")
    assert arithmetic is not None
    number = arithmetic.number(value)
    read = read_floating(FALLBACK, f"{digits}.E{exponent:+03d}", TRUNCATING.rules)
    assert number.value == (read.mantissa, read.exponent)
    card = write_floating(FALLBACK, read.mantissa, read.exponent, TRUNCATING.rules)[0].strip()
    assert e_field(arithmetic.text(number, 1)) == card


def test_later_behaves_like_the_tuple_it_becomes_and_is_built_once() -> None:
    made: list[int] = []

    def make() -> Iterator[str]:
        made.append(1)
        yield from "abc"

    later = LazyTuple(3, make)
    assert len(later) == 3
    assert bool(later)
    assert not made
    assert later == ("a", "b", "c") == later
    assert later != ("a", "b")
    assert later == LazyTuple(3, make)
    assert made == [1, 1]
    assert (later[0], later[-1], later[1:], list(later)) == ("a", "c", ("b", "c"), ["a", "b", "c"])
    assert (hash(later), repr(later)) == (hash(("a", "b", "c")), "('a', 'b', 'c')")
    assert pickle.loads(pickle.dumps(later)) == later
    assert as_tuple(later) is as_tuple(later)
    assert as_tuple(later) is as_tuple(as_tuple(later))
    with pytest.raises(IndexError):
        later[3]
    assert made == [1, 1]

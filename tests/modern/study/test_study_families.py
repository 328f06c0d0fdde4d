"""Families return distinct points that fit a card, reproducibly, with the properties of each family."""

from fractions import Fraction
from random import Random
from typing import Any

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from emulator.errors import EmulatorError
from modern.exact_hull import exact_hull
from modern.formats.deck import coordinate_field
from modern.study import Cell, PlanError
from modern.study.families import FAMILIES, draw_sample
from modern.study.families.draws import Draw, Drawn, FamilyError
from modern.study.families.given import published_sets
from modern.study.families.thesis import KINDS, SHEET

DRAWN: dict[str, dict[str, Any]] = {
    "thesis": {},
    "integers": {"digits": 3, "n": [1, 51]},
    "decimals": {"digits": 5, "n": [1, 51], "exponent": [-3, 2]},
    "box": {"most": 350, "n": [1, 51], "centre": -10_000},
    "ball": {"digits": 2, "n": [1, 51]},
    "sphere": {"digits": 4, "n": [1, 51]},
    "cube": {"digits": 2, "n": [1, 51]},
    "prism": {"digits": 3, "n": [6, 51]},
    "pyramid": {"digits": 3, "n": [4, 51]},
    "near-coplanar": {"digits": 3, "n": [4, 51], "gap": 3},
    "published": {},
    "points": {"points": [["1", "2", "3.5"], ["4", "5", "6"], ["7", "8", "1e3"]], "n": 2, "shuffle": True},
}
seeds = st.integers(0, 2**32)


def draw(family: str, seed: int, index: int = 0, **parameters: Any) -> Drawn:
    return draw_sample(Cell({"f": family}, family, parameters or DRAWN[family], (), 1), seed, index)


def numbers(drawn: Drawn) -> list[tuple[Fraction, ...]]:
    return [tuple(map(Fraction, point)) for point in drawn.points]


def test_families_have_cases_and_equally_frequent_kinds() -> None:
    assert DRAWN.keys() == FAMILIES.keys()
    seen = [str(draw("thesis", 1, index).tags["kind"]) for index in range(1200)]
    # Each is binomial of 1200 and 1/6: 200 with a standard deviation of 13.
    assert all(abs(seen.count(kind) - 200) < 6 * 13 for kind in KINDS)
    found = [x for k in range(200) for p in numbers(draw("thesis", 1, k, kinds={SHEET: 1}, decimals=333)) for x in p]
    # Binomial of 4,800 and .333: 1,598 with a standard deviation of 33.
    assert abs(sum(x.denominator > 1 for x in found) - 1598) < 6 * 33


@given(st.sampled_from(sorted(DRAWN)), seeds, st.integers(0, 40))
def test_points_are_distinct_fit_a_card_and_are_reproducible(family: str, seed: int, index: int) -> None:
    drawn = draw(family, seed, index)
    assert drawn == draw(family, seed, index)
    points = numbers(drawn)
    assert 1 <= len(points) == len(set(points)) <= 51
    for point in drawn.points:
        for text in point:
            assert Fraction(coordinate_field(text)) == Fraction(text)


@given(seeds, st.integers(1, 8))
def test_integers_have_at_most_the_given_digits(seed: int, digits: int) -> None:
    for point in numbers(draw("integers", seed, digits=digits, n=8)):
        assert all(c.denominator == 1 and abs(c) < 10**digits for c in point)


@given(seeds, st.integers(3, 10**6), st.integers(-(10**6), 10**6))
def test_points_of_a_box_are_around_its_centre(seed: int, most: int, centre: int) -> None:
    for point in numbers(draw("box", seed, most=most, n=8, centre=centre)):
        assert all(c.denominator == 1 and abs(c - centre) <= most for c in point)


@pytest.mark.parametrize("parameters", [{"most": 0}, {"most": 10**8}, {"most": 1, "centre": 99_999_999}])
def test_box_with_coordinates_too_long_for_a_card_is_rejected(parameters: dict[str, int]) -> None:
    with pytest.raises(FamilyError, match=r"family box: .* coordinates of at most 8 digits, found most = "):
        draw("box", 1, n=4, **parameters)


@given(seeds, st.integers(1, 8))
def test_decimals_have_exactly_the_given_digits(seed: int, digits: int) -> None:
    for point in draw("decimals", seed, digits=digits, n=8).points:
        assert all(len(coordinate_field(text)[2:10].rstrip("0")) == digits for text in point)


@given(seeds)
def test_points_of_ball_sphere_and_cube_are_in_place(seed: int) -> None:
    for x, y, z in numbers(draw("ball", seed)):
        assert x * x + y * y + z * z <= 99 * 99
    for x, y, z in numbers(draw("sphere", seed)):
        # Each coordinate is rounded by a half at most, and |x| + |y| + |z| is at most the root of 3 times the radius.
        assert abs(x * x + y * y + z * z - 9999 * 9999) <= Fraction("1.7321") * 9999 + Fraction(3, 4)
    assert all(max(map(abs, point)) == 99 for point in numbers(draw("cube", seed)))


@given(seeds)
@example(348884)
def test_prisms_and_pyramids_have_a_face_of_many_points(seed: int) -> None:
    prism = numbers(draw("prism", seed))
    # A polygon's points may have two values of a coordinate too.
    two = [(k, {p[k] for p in prism}) for k in range(3) if len({p[k] for p in prism}) == 2]
    sides = [[{p[:k] + p[k + 1 :] for p in prism if p[k] == height} for height in ends] for k, ends in two]
    assert any(low == high for low, high in sides)
    pyramid = numbers(draw("pyramid", seed))
    assert any(sum(p[k] == 0 for p in pyramid) >= len(pyramid) - 1 for k in range(3))
    assert exact_hull(draw("pyramid", seed).points).dimension == 3


@given(seeds, st.integers(0, 4))
def test_near_coplanar_points_are_within_the_gap_of_a_plane_and_not_all_in_it(seed: int, gap: int) -> None:
    points = numbers(draw("near-coplanar", seed, digits=3, n=[4, 20], gap=gap))
    size = Fraction(1, 10**gap)
    fits = [
        (p, q)
        for p in (-1, 0, 1)
        for q in (-1, 0, 1)
        if all(z - p * x - q * y in (-size, 0, size) for x, y, z in points)
        and any(z - p * x - q * y for x, y, z in points)
    ]
    assert fits


@given(seeds)
def test_kinds_of_the_thesis_have_their_dimensions(seed: int) -> None:
    dimensions = {"three points": {2}, "line": {1}, "one point": {0}, "plane": {1, 2}, "slab": {1, 2, 3}}
    for kind, possible in dimensions.items():
        drawn = draw("thesis", seed, kinds={kind: 1})
        assert drawn.tags == {"kind": kind}
        assert exact_hull(drawn.points).dimension in possible
    slab = numbers(draw("thesis", seed, kinds={"slab": 1}))
    assert any(all(1 <= p[k] <= 4 for p in slab) for k in range(3))


@given(seeds, st.integers(0, 1000))
def test_data_sheet_has_eight_points_of_integers_and_decimals(seed: int, share: int) -> None:
    parameters = {"kinds": {SHEET: 1}, "decimals": share}
    alone, added = (numbers(draw("thesis", seed, **parameters, form=form)) for form in ("alone", "added"))
    assert len(alone) == len(added) == 8
    for point in alone:
        assert all(abs(x) <= 12 if x.denominator == 1 else Fraction(1, 100) <= x < Fraction(1, 10) for x in point)
    assert all(abs(x) <= 12 or x.denominator > 1 for point in added for x in point)
    for fixed, whole in ((0, True), (1000, False)):
        points = numbers(draw("thesis", seed, kinds={SHEET: 1}, decimals=fixed))
        assert all((x.denominator == 1) is whole for point in points for x in point)


def test_published_and_user_defined_families_are_drawn() -> None:
    names = list(published_sets())
    assert names[:6] == [f"example {k}" for k in range(1, 7)]
    assert [draw("published", 0, k).tags["kind"] for k in range(len(names) + 1)] == [*names, names[0]]
    shuffled = draw("published", 0, 4, sets=["example 5"], shuffle=True)
    assert sorted(shuffled.points) == sorted(published_sets()["example 5"])
    with pytest.raises(FamilyError, match="distinct points"):
        Draw(Random(0)).distinct(3, lambda: (0, 0, 0))
    assert draw("modern.study.families.scattered:integers", 3, digits=2, n=4).points
    with pytest.raises(PlanError):
        draw("modern.study.families.scattered:nothing", 3, n=4)
    for name in (":f", ".x:f"):
        with pytest.raises(PlanError, match=f"family {name}: "):
            draw(name, 3, n=4)


@pytest.mark.parametrize(
    ("family", "parameters", "message"),
    [
        ("integers", {"digits": 9, "n": 5}, "as many as a card holds, found 9"),
        ("integers", {"digits": 1, "n": 52}, "n is 52"),
        ("integers", {"digits": 1, "n": [9, 3]}, "n is 9 to 3"),
        ("integers", {"digits": 1}, "missing"),
        ("integers", {"digits": 1, "n": 3, "x": 1}, "unexpected"),
        ("integers", {"digits": 1.5, "n": 3}, "as many as a card holds, found 1.5"),
        ("integers", {"digits": 1, "n": [9]}, "an integer, or a range of two integers such as [4, 20], found [9]"),
        ("decimals", {"digits": 3, "n": 5, "exponent": "x"}, "a range of two integers such as [4, 20], found 'x'"),
        ("box", {"most": 1.5, "n": 5}, "most = 1.5"),
        ("near-coplanar", {"digits": 2, "n": 5, "gap": 1.5}, "for a gap of 10**-gap, found 1.5"),
        ("decimals", {"digits": 3, "n": 5, "exponent": 40}, "exponent: expected -20 to 20, found 40"),
        ("near-coplanar", {"digits": 5, "n": 5, "gap": 6}, "significant digits"),
        ("near-coplanar", {"digits": 2, "n": 5, "gap": -1}, "for a gap of 10**-gap, found -1"),
        ("thesis", {"kinds": {"star": 1}}, "kinds: expected three points"),
        ("thesis", {"decimals": 1001}, "0 to 1000, found 1001"),
        ("thesis", {"decimals": 0.5}, "0 to 1000, found 0.5"),
        ("thesis", {"form": "both"}, "form: expected alone or added, found 'both'"),
        ("published", {"sets": ["example 9"]}, "'example 9'"),
        ("points", {"points": [["1", "2", "x"]]}, "'x' is not a decimal number"),
        ("points", {"points": [["1", "2", "3.123456789"]]}, "significant digits"),
        ("points", {"points": [["1", "2", "3"], ["1.0", "2", "3"]]}, "two points are equal"),
        ("points", {"points": [["1", "2", "3"]], "n": 2}, "there are only 1 points"),
        ("points", {"points": []}, "there are no points"),
        ("points", {"points": [["1", "2", str(k)] for k in range(52)]}, "52 points"),
        ("nowhere", {}, "no family is called 'nowhere'"),
        ("os:nothing", {}, "nothing"),
    ],
)
def test_impossible_parameters_give_a_one_line_error(family: str, parameters: dict[str, Any], message: str) -> None:
    def drawn() -> list[Drawn]:
        return [draw_sample(Cell({"f": family}, family, parameters, (), 1), 1, index) for index in range(20)]

    with pytest.raises(EmulatorError) as rejection:
        drawn()
    assert message in str(rejection.value)
    assert "\n" not in str(rejection.value)

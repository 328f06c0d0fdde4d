"""Intervals against published values and against scipy's."""

from __future__ import annotations

import math
import statistics as plain

import pytest
from hypothesis import given
from hypothesis import strategies as st

from modern.study.statistics import Interval, count, exact, incomplete_beta, mean, mean_of, student, wilson


def test_published_intervals() -> None:
    """R. G. Newcombe, Two-sided confidence intervals for the single proportion,
    Statist. Med. 17 (1998) 857-872, Table I.

    Method 3 is Wilson's without correction, method 5 Clopper and Pearson's, both of 95 %.
    """
    for hits, of, by_wilson, by_exact in (
        (81, 263, (0.2553, 0.3662), (0.2527, 0.3676)),
        (15, 148, (0.0624, 0.1605), (0.0578, 0.1617)),
        (0, 20, (0.0000, 0.1611), (0.0000, 0.1684)),
        (1, 29, (0.0061, 0.1718), (0.0009, 0.1776)),
    ):
        for interval, (low, high) in ((wilson(hits, of), by_wilson), (exact(hits, of), by_exact)):
            assert (round(interval.low, 4), round(interval.high, 4)) == (low, high)
            assert interval.value == hits / of


def test_an_interval_of_the_manual_of_r() -> None:
    """R's help of binom.test, after W. J. Conover, Practical Nonparametric Statistics (1971) 97-104: 682 of 925."""
    found = exact(682, 925)
    assert (found.low, found.high) == pytest.approx((0.7076683, 0.7654066), abs=5e-8)


@pytest.mark.parametrize("of", [5, 20, 70])
def test_the_exact_interval_keeps_its_level_whatever_the_proportion_is(of: int) -> None:
    """The probability that it holds the true proportion, summed over all counts; Wilson's does not keep it."""
    truths = [k / 400 for k in range(1, 400)]
    for method, keeps in ((exact, True), (wilson, False)):
        held = [method(hits, of) for hits in range(of + 1)]
        coverage = [
            sum(
                math.comb(of, k) * p**k * (1 - p) ** (of - k) for k in range(of + 1) if held[k].low <= p <= held[k].high
            )
            for p in truths
        ]
        assert (min(coverage) >= 0.95) is keeps


@given(st.integers(1, 2000), st.data())
def test_a_count_lies_between_none_and_all(of: int, data: st.DataObject) -> None:
    stats = pytest.importorskip("scipy.stats")
    hits = data.draw(st.integers(0, of))
    found = count(hits, of, 70)
    assert 0 <= found.low <= found.value <= found.high <= 70
    assert found.value == pytest.approx(70 * hits / of)
    low = 70 * stats.beta.ppf(0.025, hits, of - hits + 1) if hits else 0
    high = 70 * stats.beta.ppf(0.975, hits + 1, of - hits) if hits < of else 70
    assert (found.low, found.high) == pytest.approx((low, high), abs=1e-6)


def test_ten_seventies_with_two_failures_have_no_count_below_none() -> None:
    """By Student's t their mean of .2 ends below 0, at .2 - 2.262*.133."""
    failures = [1, 1, 0, 0, 0, 0, 0, 0, 0, 0]
    assert mean(failures).low == pytest.approx(-0.1016, abs=5e-5)
    found = count(sum(failures), 700, 70)
    assert (round(found.low, 3), round(found.high, 3)) == (0.024, 0.72)


def test_a_mean_is_cut_at_the_bounds_of_its_quantity() -> None:
    """1 and 3 by Student's t: 2 +- 12.706."""
    assert (mean([1, 3]).low, mean([1, 3]).high) == pytest.approx((-10.706, 14.706), abs=5e-4)
    assert mean([1, 3], least=0.0, most=4.0) == Interval(2.0, 0.0, 4.0)
    assert mean([1, 3], least=-20.0, most=20.0) == mean([1, 3])


def test_published_values_of_students_t() -> None:
    """NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.2, upper critical values of Student's t."""
    for degrees, level, value in ((1, 0.95, 12.706), (5, 0.95, 2.571), (10, 0.90, 1.812), (100, 0.99, 2.626)):
        assert round(student(degrees, level), 3) == value


@given(st.integers(1, 500), st.data(), st.sampled_from([0.8, 0.95, 0.99]))
def test_intervals_are_scipys(of: int, data: st.DataObject, level: float) -> None:
    stats = pytest.importorskip("scipy.stats")
    hits = data.draw(st.integers(0, of))
    test = stats.binomtest(hits, of)
    for own, method in ((wilson, "wilson"), (exact, "exact")):
        found, other = own(hits, of, level), test.proportion_ci(level, method)
        assert math.isclose(found.low, other.low, abs_tol=1e-8)
        assert math.isclose(found.high, other.high, abs_tol=1e-8)
        assert found.low <= found.value <= found.high


@given(st.floats(0.5, 400), st.floats(0.5, 400), st.floats(0, 1))
def test_the_incomplete_beta_function_is_scipys(a: float, b: float, x: float) -> None:
    special = pytest.importorskip("scipy.special")
    assert math.isclose(incomplete_beta(a, b, x), special.betainc(a, b, x), rel_tol=1e-8, abs_tol=1e-12)


@given(st.lists(st.floats(-1e6, 1e6), min_size=2, max_size=50))
def test_means(values: list[float]) -> None:
    found = mean(iter(values))
    assert math.isclose(found.value, plain.fmean(values), rel_tol=1e-9, abs_tol=1e-6)
    half = student(len(values) - 1) * plain.stdev(values) / math.sqrt(len(values))
    assert math.isclose(found.high - found.low, 2 * half, rel_tol=1e-6, abs_tol=1e-6)


def test_what_is_no_sample() -> None:
    for hits, of in ((1, 0), (-1, 5), (6, 5)):
        for method in (wilson, exact):
            with pytest.raises(ValueError, match="is not a proportion"):
                method(hits, of)
    with pytest.raises(ValueError, match="needs a value"):
        mean([])
    assert mean([3.0]) == mean_of(1, 3.0, 0.0) == Interval(3.0, -math.inf, math.inf)

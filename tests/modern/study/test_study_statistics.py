"""The confidence intervals agree with published values and with scipy."""

import math
import statistics as plain

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from modern.study.statistics import Interval, count, exact, incomplete_beta, mean, mean_of, student


def test_exact_intervals_agree_with_published_values() -> None:
    """R. G. Newcombe, Two-sided confidence intervals for the single proportion,
    Statist. Med. 17 (1998) 857-872, Table I, method 5 (Clopper and Pearson, 95 %).
    """
    for hits, of, published in (
        (81, 263, (0.2527, 0.3676)),
        (15, 148, (0.0578, 0.1617)),
        (0, 20, (0.0000, 0.1684)),
        (1, 29, (0.0009, 0.1776)),
    ):
        interval = exact(hits, of)
        assert (round(interval.low, 4), round(interval.high, 4)) == published
        assert interval.value == hits / of


@pytest.mark.parametrize("of", [5, 20, 70])
def test_exact_interval_covers_every_proportion_at_its_level(of: int) -> None:
    """The probability that the interval contains the true proportion, summed over all counts, is at least .95."""
    intervals = [exact(hits, of) for hits in range(of + 1)]
    for p in (k / 400 for k in range(1, 400)):
        assert (
            sum(
                math.comb(of, k) * p**k * (1 - p) ** (of - k)
                for k in range(of + 1)
                if intervals[k].low <= p <= intervals[k].high
            )
            >= 0.95
        )


@given(st.integers(1, 2000), st.data())
@settings(max_examples=50)
def test_interval_of_a_count_lies_between_zero_and_the_total(of: int, data: st.DataObject) -> None:
    stats = pytest.importorskip("scipy.stats")
    hits = data.draw(st.integers(0, of))
    interval = count(hits, of, 70)
    assert 0 <= interval.low <= interval.value <= interval.high <= 70
    assert interval.value == pytest.approx(70 * hits / of)
    low = 70 * stats.beta.ppf(0.025, hits, of - hits + 1) if hits else 0
    high = 70 * stats.beta.ppf(0.975, hits + 1, of - hits) if hits < of else 70
    assert (interval.low, interval.high) == pytest.approx((low, high), abs=1e-6)


def test_intervals_of_means_use_students_t_and_bounds() -> None:
    # 1 and 3 by Student's t: 2 +- 12.706.
    assert (mean([1, 3]).low, mean([1, 3]).high) == pytest.approx((-10.706, 14.706), abs=5e-4)
    assert mean([1, 3], least=0.0, most=4.0) == Interval(2.0, 0.0, 4.0)
    assert mean([1, 3], least=-20.0, most=20.0) == mean([1, 3])
    # NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.2, upper critical values of Student's t.
    for degrees, level, value in ((1, 0.95, 12.706), (5, 0.95, 2.571), (10, 0.90, 1.812), (100, 0.99, 2.626)):
        assert round(student(degrees, level), 3) == value
    for hits, of in ((1, 0), (-1, 5), (6, 5)):
        with pytest.raises(ValueError, match="expected hits from 0 to the number of samples"):
            exact(hits, of)
    with pytest.raises(ValueError, match="at least one value"):
        mean([])
    assert mean([3.0]) == mean_of(1, 3.0, 0.0) == Interval(3.0, -math.inf, math.inf)


@given(st.integers(1, 500), st.data(), st.sampled_from([0.8, 0.95, 0.99]))
@settings(max_examples=50)
def test_exact_interval_agrees_with_scipy(of: int, data: st.DataObject, level: float) -> None:
    stats = pytest.importorskip("scipy.stats")
    hits = data.draw(st.integers(0, of))
    interval, expected = exact(hits, of, level), stats.binomtest(hits, of).proportion_ci(level, "exact")
    assert math.isclose(interval.low, expected.low, abs_tol=1e-8)
    assert math.isclose(interval.high, expected.high, abs_tol=1e-8)
    assert interval.low <= interval.value <= interval.high


@given(st.floats(0.5, 400), st.floats(0.5, 400), st.floats(0, 1))
def test_incomplete_beta_function_agrees_with_scipy(a: float, b: float, x: float) -> None:
    special = pytest.importorskip("scipy.special")
    assert math.isclose(incomplete_beta(a, b, x), special.betainc(a, b, x), rel_tol=1e-8, abs_tol=1e-12)


@given(st.lists(st.floats(-1e6, 1e6), min_size=2, max_size=50))
def test_interval_of_a_mean_agrees_with_the_standard_library(values: list[float]) -> None:
    interval = mean(iter(values))
    assert math.isclose(interval.value, plain.fmean(values), rel_tol=1e-9, abs_tol=1e-6)
    half = student(len(values) - 1) * plain.stdev(values) / math.sqrt(len(values))
    assert math.isclose(interval.high - interval.low, 2 * half, rel_tol=1e-6, abs_tol=1e-6)
